"""The paper's section on the derivation of the condensed problems."""

from __future__ import annotations

from derive.rules import SAMPLES
from derive.sample import DIGITS
from wear.report.document import Section
from wear.report.material import Material, count
from wear.report.words import paragraph


def section(material: Material) -> Section:
    """From the governing equations to (8), (9), (10) and (13)."""
    checked = material.verification
    return Section(
        "sec:derivation",
        "Derivation of the condensed problems",
        (
            paragraph(
                "Every equation of this report was derived by machine, with SymPy "
                "[ref:meurer2017], in the run that wrote it. A derivation is a chain of small "
                "moves (insert, solve, integrate, take a limit); each is told once, in the "
                "derivation of the first equation that needs it. The derivations are folded below "
                "their equations on the page and stand in the appendix of the PDF. The forms that "
                "the note prints are transcribed apart and only compared with what was derived."
            ),
            paragraph(
                "{equations} equations rest on {steps} distinct steps, and these on {checks} "
                "checks: {proofs} proofs, {samples} numerical evaluations, {dimensions} "
                "comparisons of dimensions; {failed} failed. Each step is checked on its own. An "
                "algebraic move is made again and compared; where a step rests on a theorem, its "
                "words say on which, and the hypotheses of the theorem are checked; both sides "
                "are evaluated at {points} random points inside the hypotheses of the step with "
                "{digits} digits, limits on the way to the limit, solutions against quadrature. "
                "The bearing is taken to be rough, $\\sigma_c>0$, in all of it; other hypotheses "
                "stand with the equations.",
                points=count(SAMPLES, "derivation"),
                digits=count(DIGITS, "derivation"),
                equations=count(checked.equations, "catalogue of equations"),
                steps=count(checked.steps, "verification"),
                checks=count(checked.checks, "verification"),
                proofs=count(checked.of_kind("proof"), "verification"),
                samples=count(checked.of_kind("sample"), "verification"),
                dimensions=count(checked.of_kind("dimensions"), "verification"),
                failed=count(len(checked.failures), "verification"),
            ),
            Section(
                "sec:system",
                "The system of equations",
                (
                    paragraph(
                        "The note collects its model in one system. Three of its members repeat "
                        "[eq:1], [eq:3] and [eq:6]."
                    ),
                    *material.show("7a", "7b", "7c", "7d", "7e", "7f", "7g"),
                ),
            ),
            Section(
                "sec:condensed",
                "Prescribed displacement of the pin",
                (
                    paragraph(
                        "Pressure, closure, displacement of the support and roughness can be "
                        "eliminated; the wear of the pin is proportional to that of the bearing. "
                        "What remains is one equation for $u_c$, in which the rate stands on both "
                        "sides as long as the support gives way."
                    ),
                    *material.show("8", "9"),
                    paragraph(
                        "The implicit equation is well posed. At given wear and load it is an "
                        "equation for the pressure, "
                        "$p=p_{\\max}\\,\\phi((h_{\\mathrm{rigid}}+p/k)/\\bar\\sigma)$, with the "
                        "closure $h_{\\mathrm{rigid}}$ on an undeflected support. Left minus right "
                        "side is negative at zero pressure, positive at $p_{\\max}$ and increases "
                        "in between: there is exactly one pressure."
                    ),
                    *material.show("pressure-root"),
                    paragraph(
                        "Newton's iteration finds it. The unknown is the share $x=p/p_{\\max}$, "
                        "which solves $x=\\phi(a+sx)$ with $a=h_{\\mathrm{rigid}}/\\bar\\sigma$ "
                        "and $s=p_{\\max}/(k\\bar\\sigma)$; let $y$ be the root. The first line of "
                        "[eq:pressure-iteration] has the step from $x$, the second how far it ends "
                        "from the root, where $y=\\phi_y$: this has the sign of the distance of "
                        "the law from its tangent. The last two lines are the curvature of the law "
                        "at $h/\\bar\\sigma=2\\pm x$ for any $x>0$: on either side of "
                        "$h=2\\bar\\sigma$ it has one sign, and the iteration does not cross the "
                        "root."
                    ),
                    *material.show("pressure-iteration", "10", "rigid-limit-error"),
                    paragraph(
                        "[eq:10] is the limit of a rigid support, which does not move "
                        "([claim:C15]). At the same wear and load the pressure on springs lies "
                        "below that on a rigid support, by no more than [eq:rigid-limit-error] "
                        "allows; the wear itself converges on bounded times only, since its drift "
                        "depends on $k$ ([sec:compliant-support])."
                    ),
                    paragraph(
                        "For a smooth pin that does not wear the square root disappears. What "
                        "follows rests on the rate [(eq:bearing-rate)]."
                    ),
                    *material.show("13", "bearing-rate"),
                ),
            ),
            Section(
                "sec:problems",
                "The two problems of the note",
                (
                    paragraph(
                        "With a given load the pressure is known and everything else follows, as "
                        "long as the contact can carry the load; with a given displacement the "
                        "wear must be solved for first."
                    ),
                    *material.show("problem-i", "problem-ii"),
                ),
            ),
        ),
    )
