"""Output of `wear run` as text and as LaTeX."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from derive import terminal
from wear.quantities import COLUMNS, label_of, unit_of

if TYPE_CHECKING:
    from wear.history import History
    from wear.life import Life
    from wear.numerics.gauss import FloatArray


def text(history: History) -> str:
    """Return a table for the terminal, with the cost of the run."""
    quantities = _modelled(history)
    heads = [label_of(name).replace(" ", "\n") for name in quantities]
    rows = [
        [str(n), *("-" if math.isnan(x) else f"{x:.10g}" for x in state), f"{error:.1e}"]
        for n, *state, error in zip(
            history.cycles, *quantities.values(), history.error, strict=True
        )
    ]
    return "\n".join(
        [
            history.scene,
            f"model {history.variant}, method {history.method}, rtol {history.rtol:g}",
            "",
            terminal.table(["cycle", *heads, "relative\nerror"], rows)
            if rows
            else "No requested cycle was reached.",
            "",
            f"{history.cost['cycles_integrated']} cycles integrated, "
            f"{history.cost['rhs_evaluations']} evaluations of the rate, {history.seconds:.3g} s",
        ]
    )


def notices_of(history: History) -> tuple[str, ...]:
    """Return the notices, without the usual choice of a method: the table's head names it."""
    usual = f"auto: {history.method}, because the load repeats"
    return tuple(notice for notice in history.notices if notice != usual)


def until_text(life: Life) -> str:
    """Return a table of the cycles to depths of wear."""
    rows = [
        [f"{wear:.10g}", life_text(cycles, error, reached.value)]
        for wear, cycles, error, reached in zip(*life[:4], strict=True)
    ]
    return terminal.table(["bearing\nwear\n(mm)", "reached\nafter\ncycle"], rows)


def life_text(cycles: float, error: float, reached: str) -> str:
    """Return a number of cycles to a depth of wear with its error, or why there is none.

    >>> life_text(140, 1e-9, "counted"), life_text(1.5e13, 1e-6, "extrapolated")
    ('140', '1.5e+13 (to within 2e+07)')
    >>> life_text(41060, 0.065, "counted")
    '41060 (to within 3e+03)'
    """
    if reached not in ("counted", "extrapolated"):
        return reached
    number = f"{cycles:.0f}" if reached == "counted" else f"{cycles:.6g}"
    return number if error * cycles < 1.0 else f"{number} (to within {error * cycles:.1g})"


def latex(history: History) -> str:
    r"""Return a `tabular` to `\input` into a document that loads booktabs."""
    quantities = {name: each for name, each in _modelled(history).items() if COLUMNS[name].latex}
    symbols = ["$N$", *(f"${COLUMNS[name].latex}$" for name in quantities)]
    units = ["", *(rf"\textnormal{{{unit_of(name)}}}" for name in quantities)]
    rows = [
        [f"${_number(cycle, 15)}$", *(f"${_number(x, 8)}$" for x in state)]
        for cycle, *state in zip(history.cycles, *quantities.values(), strict=True)
    ]
    title = " ".join(history.scene.split())
    return "\n".join(
        [
            f"% {title}: model {history.variant}, method {history.method}, rtol {history.rtol:g}",
            rf"\begin{{tabular}}{{{'r' * len(symbols)}}}",
            r"\toprule",
            *(rf"{' & '.join(row)} \\" for row in (symbols, units)),
            r"\midrule",
            *(rf"{' & '.join(row)} \\" for row in rows),
            r"\bottomrule",
            r"\end{tabular}",
            "",
        ]
    )


def _number(value: float, digits: int) -> str:
    """Return a number for math mode, to so many significant digits."""
    from wear.report.number import TextNumber, significant

    if not math.isfinite(value):
        return r"\text{--}"
    return TextNumber(value, "run", significant(value, digits)).latex


def _modelled(history: History) -> dict[str, FloatArray]:
    """Return the informative physical columns: without contact fractions that are always 1, and
    without columns of unknown values."""
    import numpy as np

    return {
        name: values
        for name, values in history.columns().items()
        if name != "error_estimate"
        and not np.isnan(values).all()
        and (name != "contact_fraction" or np.any(values < 1.0))
    }
