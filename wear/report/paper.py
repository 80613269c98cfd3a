"""The paper: its text (``paper.md``) with the values, equations and figures of a run."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from importlib.resources import files
from typing import TYPE_CHECKING

from wear.figure_style import pdf, svg
from wear.report import drawing, figures_of_note, speed
from wear.report.document import Document, Figure
from wear.report.equations import shown
from wear.report.text import parsed
from wear.report.values import Material, values

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawn

    from derive import equations as derived
    from wear.benchmark import Measurement
    from wear.report.claims import Entry
    from wear.report.runs import Runs
    from wear.report.verification import Verification

_EQUATIONS = re.compile(r"^```equations\n(.*?)^```", re.MULTILINE | re.DOTALL)


def paper(
    equations: Sequence[derived.Equation],
    verification: Verification,
    runs: Runs,
    ledger: Sequence[Entry],
    measured: Sequence[Measurement],
) -> Document:
    """Return the paper. Equations that its text does not name stand in the appendix."""
    material = Material(equations, shown(equations), verification, runs, ledger, measured)
    template = files("wear.report").joinpath("paper.md").read_text(encoding="utf-8")
    text = template.partition("{#app:")[0]
    named = [name for names in _EQUATIONS.findall(text) for name in names.split()]
    found = parsed(template, {**values(material), "in_text": named})
    return Document(found, material.shown, _figures(runs, measured))


def _figures(runs: Runs, measured: Sequence[Measurement]) -> Mapping[str, Figure]:
    """Return the figures by label: each with a description for those who do not see it."""
    drawn = {
        "system": (drawing.system(), drawing.DESCRIPTION, "system"),
        "wear": (
            figures_of_note.wear_curve(runs),
            "Wear over eleven decades of cycles: a curve that bends ever less and joins a straight "
            "line from above only at the end; a dashed curve that becomes constant before the "
            "cycle of the note; far above, the steep line of the printed wear per cycle.",
            "wear-curve",
        ),
        "regimes": (
            figures_of_note.regimes(runs),
            "Two maps with coloured regions that are named for what becomes of the wear, over the "
            "change of roughness and the gap at the peak of the load, with three dots for the "
            "examples of the note.",
            "regimes",
        ),
        "approach": (
            figures_of_note.approach(runs.approach),
            "Two rows of points that bend towards a straight line of slope minus one and follow it "
            "over five decades.",
            "approach",
        ),
        "speed": (
            speed.figure(measured),
            "Times of several methods against their errors on logarithmic axes: the exact cycle "
            "jump is at the lower right, fast and accurate; the others need more time for fewer "
            "digits.",
            "speed",
        ),
        "2a": (
            figures_of_note.wear_of_both(runs),
            "Wear over cycles, that of the bearing above that of the pin: both rise steeply at "
            "first and then ever more slowly; with loss of contact both become constant early.",
            "figure-2a",
        ),
        "2b": (
            figures_of_note.roughness_of_both(runs),
            "Roughness over cycles: that of the bearing falls a little, that of the pin, far "
            "below, rises a little; with loss of contact both become constant early.",
            "figure-2b",
        ),
        "3a": (
            figures_of_note.wear_and_asymptote(runs),
            "A concave curve below a nearly horizontal straight line that it reaches at the end; a "
            "dashed curve that becomes constant.",
            "figure-3a",
        ),
        "3b": (
            figures_of_note.wear_coefficients(runs),
            "Four rising curves, each shifted to the left of the one for a tenth of the wear "
            "coefficient; a dashed curve that becomes constant.",
            "figure-3b",
        ),
    }
    return {f"fig:{name}": _figure(*figure) for name, figure in drawn.items()}


def _figure(figure: Drawn, description: str, file: str) -> Figure:
    return Figure(description, svg(figure), pdf(figure), file)
