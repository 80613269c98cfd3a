"""The paper: what the report says, put together from its sections.

Overview
    `paper` makes the document from what was computed (`wear.report.material`). One module a
    section, in the order of reading: introduction, model, derivation, asymptotics, beyond, figures,
    crosscheck, claims, speed, hard, reproduce.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from wear.report import (
    paper_asymptotics,
    paper_beyond,
    paper_claims,
    paper_crosscheck,
    paper_derivation,
    paper_figures,
    paper_hard,
    paper_introduction,
    paper_model,
    paper_reproduce,
    paper_speed,
)
from wear.report.document import Block, Document, Equation, Number, Prose, Reference, Section
from wear.report.material import Material, count, mm
from wear.report.paper_equations import blocks_of
from wear.report.reconcile import PRINTED
from wear.report.runs import known
from wear.report.walk import all_prose
from wear.report.words import words

if TYPE_CHECKING:
    from derive import equations as derived
    from wear.benchmark import Measurement
    from wear.report.claims import Entry
    from wear.report.runs import Runs
    from wear.report.verification import Verification

TITLE = "Wear of a bearing under cyclic contact: its stabilised response re-examined"

#: Steps are shown below the first of these that needs them: what others rest on comes first.
_FIRST = (
    "1", "2a", "2b", "3", "4", "5", "6", "7a", "7b", "7c", "7d", "7e", "7f", "7g", "8", "9",
    "pressure-root", "pressure-iteration", "10", "rigid-limit-error", "13", "bearing-rate",
    "deviation", "growth", "general-rate", "closure-ratio", "general-law",
    "17b", "18", "14", "20", "21", "22",
)  # fmt: skip


def paper(
    equations: Sequence[derived.Equation],
    verification: Verification,
    runs: Runs,
    ledger: Sequence[Entry],
    speed: Sequence[Measurement],
) -> Document:
    """The document. Equations that no section names stand with the results beyond the note."""
    order = (*_FIRST, *(e.id for e in equations if e.id not in _FIRST))
    material = Material(
        equations, verification, runs, ledger, speed, blocks_of(equations, order, verification)
    )
    before = (
        paper_model.section(material),
        paper_derivation.section(material),
        paper_asymptotics.section(material),
    )
    placed = frozenset(block.label.removeprefix("eq:") for block in _equations(before))
    written = Document(
        title=TITLE,
        subtitle=words("A machine-checked reading of a note on stabilised wear"),
        abstract=_abstract(material),
        sections=(
            paper_introduction.section(material),
            *before,
            paper_beyond.section(material, placed),
            paper_figures.section(material),
            paper_crosscheck.section(material),
            paper_claims.section(material),
            paper_speed.section(material.speed),
            paper_hard.section(material),
            paper_reproduce.section(),
        ),
        colophon=words("Written by `wear reproduce`."),
    )
    references = paper_reproduce.references(dict.fromkeys(_cited(written)))
    return replace(written, sections=(*written.sections, references))


def _cited(document: Document) -> Iterator[str]:
    """The keys of the works that the text cites, in reading order."""
    for text in all_prose(document):
        for piece in text:
            if isinstance(piece, Reference) and piece.label.startswith("ref:"):
                yield piece.label.removeprefix("ref:")


def _equations(blocks: Sequence[Block]) -> Iterator[Equation]:
    for block in blocks:
        if isinstance(block, Section):
            yield from _equations(block.blocks)
        elif isinstance(block, Equation):
            yield block


def _abstract(material: Material) -> Prose:
    runs = material.runs
    fate, stop = runs.fate("section4"), runs.fate("section4.cutoff")
    per_cycle = known(fate.wear_per_cycle_mm)
    return words(
        "A published note models a pin on a bearing under cyclic load by an Archard law coupled "
        "with roughness and gives formulas for the wear per cycle and the pressure in a "
        "stabilised state. All its equations were derived anew by machine, in {steps} steps, each "
        "of which was checked, and its {claims} claims judged. The limits [(eq:17b)], [(eq:18)], "
        "[(eq:21)] and [(eq:22)] are *confirmed*, from weaker hypotheses and for any positive, "
        "continuous, decreasing contact law. The step [(eq:16b)] that leads there in the note is "
        "*false*; the condition $f_c>1/8$ is a limit of resolution, not of validity; the wear has "
        "no straight asymptote but drifts logarithmically. The printed wear per cycle, {printed}, "
        "does not follow from the data, which give {formula}; after the {cycles} cycles said to "
        "suffice for stabilisation the wear per cycle is still {ratio} times its limit, and the "
        "criterion of the note is met, on average over a cycle, after {needed} cycles. With the "
        "cutoff of the contact law, which the note states and then drops, wear arrests in cycle "
        "{stop}. *New* are the first integral, the closed solution under constant load, the "
        "expansion for long times, the map of regimes, arrest, rigorous bounds, and a solver "
        "whose cost does not grow with the number of cycles.",
        steps=count(material.verification.steps, "verification"),
        claims=count(len(material.ledger), "ledger"),
        printed=mm(PRINTED.formula_mm, 3, "printed in the note"),
        formula=mm(per_cycle, 5, "Eq. (21) with the data of section 4"),
        cycles=count(PRINTED.cycles, "the note"),
        ratio=Number(runs.printed_increment / per_cycle, 3, source="section 4"),
        needed=Number(
            known(fate.cycles_to_stabilise["mean_rate_within_1e-6"]), 2, source="A/u_cum"
        ),
        stop=count(known(stop.arrest_cycle), "section 4 with cutoff"),
    )
