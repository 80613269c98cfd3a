"""A document with every kind of node, for the tests of both writers."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.figure import Figure as Drawn

from wear import figure_style, figures
from wear.figure_data import Line
from wear.report import drawing
from wear.report.document import (
    Bibliography,
    Claim,
    Claims,
    Column,
    Document,
    Equation,
    Figure,
    Given,
    Items,
    Link,
    Listing,
    Number,
    Section,
    Step,
    Steps,
    Table,
    Text,
    Work,
)
from wear.report.words import paragraph, words

CONDENSED = r"""
\frac{3H_c}{K_cV}\,\frac{\mathrm{d}u_c}{\mathrm{d}t} &= \tfrac12\,p_{\max}\Biggl[1 + \tanh\Biggl(
\frac{4\sqrt{(\sigma_{a0}+f_au_a)^2+(\sigma_{c0}+f_cu_c)^2}}
{\sqrt{(\sigma_{a0}+f_au_a)^2+(\sigma_{c0}+f_cu_c)^2}} \\
&\qquad\qquad {}- \frac{2\bigl[h_0+u_c+\frac{3H_c}{kK_cV}\frac{\mathrm{d}u_c}{\mathrm{d}t}
-u_a-U_a(t)\bigr]}
{\sqrt{(\sigma_{a0}+f_au_a)^2+(\sigma_{c0}+f_cu_c)^2}}\Biggr)\Biggr], \\
u_a &= \frac{K_aH_c}{K_cH_a}\,u_c
"""

PRESSURE = r"\tfrac12 p_{\max}\left[1+\tanh\left(4-\frac{2}{f_c}\right)\right]"
PER_CYCLE = r"u_{\mathrm{cum}} = \frac{K_cVT}{3H_c} \cdot " + PRESSURE


@pytest.fixture(scope="session")
def sample() -> Document:
    """Three sections, two figures, two tables, four equations."""
    return Document(
        title="Wear of a bearing & its limit – é",
        subtitle=words("A sample, with {year}", year=Given("2026", "reference")),
        abstract=words(
            "The wear per cycle tends to {rate}, see [eq:21] and [fig:wear]. *Nothing* else.",
            rate=Number(4.63554742752e-8, 6, "mm", source="equation 21 with the data of section 4"),
        ),
        sections=(_model(), _limit(), _ledger()),
        colophon=words("Made by `wear reproduce`."),
    )


def _model() -> Section:
    return Section(
        "sec:model",
        "The model & its terms",
        (
            paragraph("The pin presses on the bearing ([fig:system]); wear follows [eq:8]."),
            figure("fig:system", drawing.system(), "The system.", drawing.DESCRIPTION, "system"),
            Equation(
                "eq:8",
                CONDENSED,
                number="8",
                title=words("Condensed problem"),
                status="derived",
                macro="EqCondensedProblem",
            ),
            Steps(
                "der:8",
                "eq:8",
                (
                    Step(words("Put the closure into the contact law."), r"h = h_0 + u_c - U_a"),
                    Step(
                        words("Eliminate $U_c$ by [eq:cases]."),
                        r"U_c = \frac{p}{k}",
                        words("proved, then sampled in the assumptions"),
                    ),
                ),
            ),
            Section(
                "sec:names",
                "Names",
                (
                    Table(
                        "tab:names",
                        words("Quantities"),
                        (
                            Column(words("Symbol")),
                            Column(words("Unit")),
                            Column(words("Value"), numeric=True),
                        ),
                        tuple(
                            (words(f"${s}$"), (Text(u),), (Number(v, 4, source="scene"),))
                            for s, u, v in (
                                ("h_0", "mm", 1.08e-3),
                                ("H_c", "MPa", 200),
                                ("K_c", "–", 1e-6),
                                ("N", "cycles", 123456),
                            )
                        ),
                    ),
                ),
            ),
        ),
    )


def _limit() -> Section:
    x = np.linspace(0.0, 100.0, 51)
    lines = [
        Line("bearing", x, 1e-4 * np.log1p(x)),
        Line("pin", x, 3e-5 * np.log1p(x), 1),
    ]
    return Section(
        "sec:limit",
        "The limit",
        (
            Equation("eq:21", PER_CYCLE, number="21", status="derived", macro="EqWearPerCycle"),
            Equation(
                "eq:cases",
                r"\lim_{t\to\infty} p = \begin{cases} \tfrac12 p_{\max}\bigl[1+\tanh(4-2/f_c)\bigr]"
                r" & f_c > 0,\\ 0 & \text{otherwise} \end{cases}",
                title=words("All signs of $f_c$"),
                status="corrected",
                printed=r"p_\infty = " + PRESSURE,
            ),
            Equation(
                "eq:static",
                r"Ct = \frac{u}{2} + \frac{\mathrm{e}^{-2x_\infty}}{2f}\left[s\,\mathrm{e}^{-2b/s}"
                r" + 2b\operatorname{Ei}\left(-\frac{2b}{s}\right)\right]"
                r"_{s=\sigma_0}^{\sigma_0+fu} \qquad (\sigma_0 > 0,\; f \neq 0)",
                macro="EqStaticSolution",
            ),
            figure(
                "fig:wear",
                figures.wear_history(lines),
                "Wear of both solids.",
                "Wear grows quickly, then ever more slowly.",
                "wear",
            ),
            Items(
                (words("first, [sec:model];"), words("then [tab:ledger] and [claim:C24].")),
                ordered=True,
            ),
            Listing(
                "make reproduce\n"
                "wear run section4 --cycles 1,10,100,1000,9000,1e8 --rtol 1e-12 --json",
                "How to run it",
            ),
        ),
    )


def _ledger() -> Section:
    claims = (
        Claim(
            "C24",
            words("[eq:cases]"),
            words("The second line of the passage to the limit vanishes."),
            "refuted",
            words(
                "It is constant, {value} at the start, not zero; see [der:8].",
                value=Number(-6.123e-4, 3, "mm", source="claim C24"),
            ),
        ),
        Claim(
            "C29",
            words("[eq:21]"),
            words("The wear per cycle has a closed form, $u_{\\mathrm{cum}}$."),
            "confirmed-with-conditions",
            words("Holds for $f_c > 0$ without the cutoff."),
        ),
    )
    link = Link("the note", "https://example.org/note?a=1&b=2%20#x")
    return Section(
        "sec:ledger",
        "Claims",
        (
            paragraph(
                "Each claim of {note} has < its verdict >, {all} % of them; see [ref:b].",
                note=link,
                all=Number(100, 3, source="count"),
            ),
            Claims("tab:ledger", words("The ledger"), claims),
            Bibliography((Work("ref:a", words("One & Other: A")), Work("ref:b", words("B")))),
        ),
    )


def figure(label: str, drawn: Drawn, caption: str, description: str, file: str) -> Figure:
    """A figure node from a matplotlib figure."""
    return Figure(
        label,
        words(caption),
        description,
        figure_style.svg(drawn),
        figure_style.pdf(drawn),
        file,
    )
