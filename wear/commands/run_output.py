"""Output of `wear run`: text, LaTeX, and files of a history."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from derive import files, terminal
from wear.quantities import COLUMNS, unit_of, words_of

if TYPE_CHECKING:
    from wear.history import History
    from wear.numerics.gauss import FloatArray

SUFFIXES = (".csv", ".nc", ".tex")


def text(history: History) -> str:
    """Return a table for the terminal, with the cost of the run."""
    quantities = _modelled(history)
    header = ["cycle", *map(_heading, quantities), "relative\nerror"]
    rows = [
        [
            str(cycle),
            *(_shown(float(values[row])) for values in quantities.values()),
            f"{history.error[row]:.1e}",
        ]
        for row, cycle in enumerate(history.cycles.tolist())
    ]
    return "\n".join(
        [
            history.scene,
            f"model {history.variant}, method {history.method}, rtol {history.rtol:g}",
            "",
            terminal.table(header, rows) if rows else "No requested cycle was reached.",
            "",
            f"{history.cost['cycles_integrated']} cycles integrated, "
            f"{history.cost['rhs_evaluations']} evaluations of the rate, {history.seconds:.3g} s",
        ]
    )


def _shown(value: float) -> str:
    return "-" if math.isnan(value) else f"{value:.10g}"


def notices_of(history: History) -> tuple[str, ...]:
    """Return the notices, without the usual choice of a method: the table's head names it."""
    usual = f"auto: {history.method}, because the load repeats"
    return tuple(notice for notice in history.notices if notice != usual)


def until_text(until: Mapping[str, Any]) -> str:
    """Return a table of the cycles to depths of wear."""
    columns = until["cycles_until"]
    rows = [
        [f"{wear:.10g}", life_text(*life)]
        for wear, *life in zip(
            *(columns[name] for name in ("bearing_wear_mm", "cycles", "error_estimate", "reached")),
            strict=True,
        )
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


def write(history: History, path: Path) -> None:
    """Write a file with one of the `SUFFIXES`, completely or not at all."""
    if path.suffix == ".tex":
        files.write_atomically(path, latex(history))
    else:
        history.write(path)


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


def _heading(name: str) -> str:
    unit = unit_of(name)
    return "\n".join([*words_of(name).split(), *([f"({unit})"] if unit else [])])
