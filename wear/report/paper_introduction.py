"""The paper's introduction: what was examined, and what was found."""

from __future__ import annotations

from wear.report.document import Emphasis, Items, Number, Section
from wear.report.material import Material, count, mm
from wear.report.reconcile import PRINTED
from wear.report.runs import known
from wear.report.words import paragraph, words

NOTE = "On the stabilized asymptotic response of a system of solids in contact with wear"


def section(material: Material) -> Section:
    """Purpose and findings."""
    return Section(
        "sec:introduction",
        "What was examined, and what was found",
        (
            paragraph(
                "The note {note} [ref:note] models the wear of journal bearings in the simplest "
                "setting that keeps the coupling of contact, wear and roughness: two rigid, rough "
                "solids, Archard's law of wear [ref:archard1953], a contact pressure that depends "
                "on closure over roughness, and a prescribed cyclic displacement. Its result is "
                "attractive, since it would replace long simulations: after a transient the wear "
                "per cycle is constant and known in closed form. This report derives all of it "
                "anew, solves the note's examples, judges each claim by a computation "
                "([tab:ledger]), and adds what the model gives beyond.",
                note=Emphasis(NOTE),
            ),
            _findings(material),
        ),
    )


def _findings(material: Material) -> Items:
    runs = material.runs
    fate, stop = runs.fate("section4"), runs.fate("section4.cutoff")
    per_cycle = known(fate.wear_per_cycle_mm)
    return Items(
        (
            words(
                "*The formulas hold.* Wear rate, wear per cycle and pressure tend to the values "
                "[(eq:18)], [(eq:21)] and [(eq:22)] for $f_c>0$ under any bounded load, periodic "
                "or not, and the proof covers every positive, continuous, decreasing contact law "
                "([sec:sound-route])."
            ),
            words(
                "*The argument for them does not.* In passing to the limit the note drops a "
                "denominator that grows without bound; [eq:16b] then sets to zero what does not "
                "depend on the wear and is not zero ([sec:note-route])."
            ),
            words(
                "*One eighth is no limit of validity.* The printed condition on $\\tanh$ always "
                "holds; the number marks a resolution ([sec:validity])."
            ),
            words(
                "*The wear has no straight asymptote,* but for one value of $f_c$. The distance "
                "from any line grows like the logarithm of the cycles, and the limit is approached "
                "like one over the cycles ([sec:drift], [tab:approach])."
            ),
            words(
                "*The printed application is not reproducible.* With its data the wear per cycle "
                "tends to {formula}, not {printed}; after {cycles} cycles it is still {ratio} "
                "times its limit ([sec:crosscheck]).",
                formula=mm(per_cycle, 5, "Eq. (21) with the data of section 4"),
                printed=mm(PRINTED.formula_mm, 3, "printed in the note"),
                cycles=count(PRINTED.cycles, "the note"),
                ratio=Number(runs.printed_increment / per_cycle, 3, source="section 4"),
            ),
            words(
                "*The cutoff changes everything.* With the contact law as the text of the note "
                "has it, wear stops for good, in cycle {stop} of that application; steady wear "
                "needs $f_c\\ge 1/3$ ([sec:regimes]).",
                stop=count(known(stop.arrest_cycle), "section 4 with cutoff"),
            ),
            words(
                "*More can be had in closed form*: a first integral, the solution under constant "
                "load, the drift to high order, bounds that are proofs, sensitivities and their "
                "inverses ([sec:beyond])."
            ),
        )
    )
