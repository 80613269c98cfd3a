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
                "Every equation below was derived by machine in the run that wrote this report. A "
                "derivation is a chain of small moves (insert, solve, integrate, take a limit). "
                "Each is checked on its own, by an exact proof and, where it can be evaluated, at "
                "random points with many digits inside its hypotheses. The forms that the note "
                "prints are transcribed apart and only compared with what was derived. "
                "{equations} equations rest on {steps} distinct steps, which took {checks} checks; "
                "{failed} failed. Each step is shown once, below the first equation that needs it. "
                "Where nothing is said of its check, the move was made again and the result "
                "compared, and both sides were evaluated at {points} random points with {digits} "
                "digits. The bearing is taken to be rough, $\\sigma_c>0$, in all of it; other "
                "hypotheses stand with the equations.",
                points=count(SAMPLES, "derivation"),
                digits=count(DIGITS, "derivation"),
                equations=count(checked.equations, "catalogue of equations"),
                steps=count(checked.steps, "verification"),
                checks=count(checked.checks, "verification"),
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
                        "The implicit equation is well posed. Written for the pressure, its "
                        "residual is negative at zero pressure and positive at $p_{\\max}$ and "
                        "increases in between, so that there is exactly one pressure; the "
                        "generated code finds it from any start."
                    ),
                    *material.show("pressure-root", "10", "rigid-limit-error"),
                    paragraph(
                        "[eq:10] holds for a rigid support; the pressure differs from that on "
                        "springs by no more than [eq:rigid-limit-error] allows. For a smooth pin "
                        "that does not wear the square root disappears:"
                    ),
                    *material.show("13"),
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
