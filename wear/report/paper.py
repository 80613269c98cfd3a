"""The paper: its text (``paper.md``) with the values, equations and figures of a run."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from importlib.resources import files
from typing import TYPE_CHECKING

from wear.benchmark.results import DIGITS, READER, committed, curves_by_cycles
from wear.figures import speed_against_cycles
from wear.report import drawing, figures_of_note, note
from wear.report.document import Document, Figure, drawn
from wear.report.equations import shown
from wear.report.text import parsed
from wear.report.values import Material, values

if TYPE_CHECKING:
    from derive import equations as derived
    from derive.verification import Verification
    from wear.report.claims import Entry
    from wear.report.runs import Runs

_EQUATIONS = re.compile(r"^```equations\n(.*?)^```", re.MULTILINE | re.DOTALL)


def paper(
    equations: Sequence[derived.Equation],
    verification: Verification,
    runs: Runs,
    ledger: Sequence[Entry],
    figures: Mapping[str, Figure],
) -> Document:
    """Return the paper. Equations that its text does not name stand in the appendix."""
    material = Material(equations, shown(equations), verification, runs, ledger)
    template = files("wear.report").joinpath("paper.md").read_text(encoding="utf-8")
    text = template.partition("{#app:")[0]
    named = [name for names in _EQUATIONS.findall(text) for name in names.split()]
    found = parsed(template, {**values(material), "in_text": named})
    return Document(found, material.shown, figures)


def drawings(runs: Runs) -> Mapping[str, Figure]:
    """Return the figures of the paper by label."""
    return drawn(
        {
            "system": drawing.system(),
            "wear-curve": figures_of_note.wear_curve(runs),
            "regimes": figures_of_note.regimes(
                {f"§\u2009{name[-1]}": runs.cases[name].scene for name in note.EXAMPLES}
            ),
            "approach": figures_of_note.approach(runs.approach),
            "speed": speed_against_cycles(curves_by_cycles(committed().runs, READER, DIGITS[0])),
            "figure-2a": figures_of_note.wear_of_both(runs),
            "figure-2b": figures_of_note.roughness_of_both(runs),
            "figure-3a": figures_of_note.wear_and_asymptote(runs),
            "figure-3b": figures_of_note.wear_coefficients(runs),
        }
    )
