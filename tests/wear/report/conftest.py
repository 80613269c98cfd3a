"""A document with every kind of block and mark, for the tests of both writers."""

from collections.abc import Mapping
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from wear import figures
from wear.figure_data import WEAR, Line, Panel
from wear.report import schematic
from wear.report.document import DisplayedEquation as Equation
from wear.report.document import Document, FigureFiles, drawn
from wear.report.number import TextNumber
from wear.report.text import parsed

CONDENSED = r"""\left\{\begin{aligned}
\frac{3H_c}{K_cV}\,\frac{\mathrm{d}u_c}{\mathrm{d}t} &= \tfrac12\,p_{\max}\left(1 + \tanh\left(
\frac{4\sqrt{(\sigma_{a0}+f_au_a)^2+(\sigma_{c0}+f_cu_c)^2}
- 2\left(h_0+u_c+\frac{3H_c}{kK_cV}\frac{\mathrm{d}u_c}{\mathrm{d}t} -u_a-U_a(t)\right)}
{\sqrt{(\sigma_{a0}+f_au_a)^2+(\sigma_{c0}+f_cu_c)^2}}\right)\right) \\
u_a &= \frac{K_aH_c}{K_cH_a}\,u_c \end{aligned}\right."""
PRESSURE = r"\tfrac12 p_{\max}\left[1+\tanh\left(4-\frac{2}{f_c}\right)\right]"

TEXT = Path(__file__).with_name("sample.md").read_text(encoding="utf-8")

VALUES = {
    "rate": TextNumber(4.63554742752e-8, "equation 21 with the data of section 4", 6, "mm"),
    "closure": TextNumber(1.08e-3, "scene", 4),
    "many": TextNumber(123456, "scene"),
    "share": TextNumber(100.0, "count", 3, "%"),
    "start": TextNumber(-6.123e-4, "claim C24", 3, "mm"),
}

EQUATIONS = (
    Equation("8", CONDENSED, "Condensed problem", "derived", macro="EqCondensedProblem",
             also=("7",)),
    Equation("21", r"u_{\mathrm{cum}} = \frac{K_cVT}{3H_c} \cdot " + PRESSURE, status="derived",
             macro="EqWearPerCycle"),
    Equation("cases", r"\lim_{t\to\infty} p = \begin{cases} \tfrac12 p_{\max} & f_c > 0,\\ 0 & "
             r"\text{otherwise} \end{cases}", "All signs of $f_c$", "corrected",
             r"p_\infty = " + PRESSURE, "EqCases", where=("p_1 = 2, \\quad p_2 = 3", "q = 1")),
    Equation("static", r"Ct = \frac{u}{2} + \operatorname{Ei}\left(-\frac{2b}{s}\right)",
             macro="EqStaticSolution"),
)  # fmt: skip


@cache
def _figures() -> Mapping[str, FigureFiles]:
    x = np.linspace(0.0, 100.0, 51)
    lines = (Line("bearing", x, 1e-4 * np.log1p(x)), Line("pin", x, 3e-5 * np.log1p(x), 1))
    return drawn(
        {
            "system": schematic.system(),
            "wear": figures.history([Panel(WEAR, lines)]),
            "again": figures.history([Panel(WEAR, lines[:1])]),
        }
    )


def document(text: str, **values: object) -> Document:
    """A document with the equations and figures of the sample and another text."""
    return Document(parsed(text, values), {e.id: e for e in EQUATIONS}, _figures())


@pytest.fixture(scope="session")
def sample() -> Document:
    """Sections and an appendix, figures, tables, equations, a derivation, claims, works."""
    return document(TEXT, **VALUES)
