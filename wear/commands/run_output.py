"""The forms in which `wear run` shows and writes a history, beyond those that a history has."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from derive import files, terminal

if TYPE_CHECKING:
    from wear.history import History
    from wear.history_files import Column

SUFFIXES = (".csv", ".nc", ".tex")
SYMBOLS = {  # of the columns for which a page is wide enough
    "bearing_wear_mm": "u_c",
    "pin_wear_mm": "u_a",
    "bearing_roughness_mm": r"\sigma_c",
    "pin_roughness_mm": r"\sigma_a",
    "closure_mm": "h",
    "pressure_at_start_MPa": "p",
    "bearing_displacement_mm": "U_c",
    "pin_reaction_N": "R_a",
}


def text(history: History) -> str:
    """Return a table for the eye, with what it took."""
    quantities = _modelled(history)
    header = ["cycle", *(_heading(column) for column in quantities), "relative\nerror"]
    rows = [
        [
            str(cycle),
            *(_shown(float(column.values[row])) for column in quantities),
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


def worth_telling(history: History) -> tuple[str, ...]:
    """Return the notices but that of the usual choice of a method, which the table's head names."""
    usual = f"auto: {history.method}, because the load repeats"
    return tuple(notice for notice in history.notices if notice != usual)


def until_text(until: Mapping[str, Any]) -> str:
    """Return a table of the cycles after which wears are reached."""
    found = until["cycles_until"]
    rows = [
        [f"{wear:.10g}", str(cycles) if reached == "counted" else
         f"{cycles:.6g} (± {error * cycles:.1g})" if reached == "extrapolated" else reached]
        for wear, cycles, error, reached in zip(
            *(found[name] for name in ("bearing_wear_mm", "cycles", "error_estimate", "reached")),
            strict=True,
        )
    ]  # fmt: skip
    return terminal.table(["bearing\nwear\n(mm)", "reached\nafter\ncycle"], rows)


def latex(history: History) -> str:
    r"""Return a `tabular` to `\input` into a document that loads booktabs."""
    quantities = [column for column in _modelled(history) if column.name in SYMBOLS]
    symbols = ["$N$", *(f"${SYMBOLS[column.name]}$" for column in quantities)]
    units = ["", *(rf"\textnormal{{{column.unit}}}" for column in quantities)]
    rows = [
        [f"${latex_number(cycle, 15)}$", *(f"${latex_number(x, 8)}$" for x in state)]
        for cycle, *state in zip(history.cycles, *(c.values for c in quantities), strict=True)
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


def latex_number(number: float, digits: int) -> str:
    r"""Return a number for math mode, to so many significant digits.

    >>> latex_number(4.41333e-3, 3), latex_number(1e8, 15), latex_number(12.0, 3)
    ('4.41\\times 10^{-3}', '10^{8}', '12')
    """
    if not math.isfinite(number):
        return r"\text{--}"
    if number == 0.0 or (1e-2 <= abs(number) < 1e6 and abs(number) < 10.0**digits):
        return f"{number:.{digits}g}"
    mantissa, _, exponent = f"{number:.{digits - 1}e}".partition("e")
    power = f"10^{{{int(exponent)}}}"
    mantissa = mantissa.rstrip("0").rstrip(".") if "." in mantissa else mantissa
    return power if mantissa == "1" else rf"{mantissa}\times {power}"


def write(history: History, path: Path) -> None:
    """Write a file with one of the `SUFFIXES`, whole or not at all."""
    if path.suffix == ".tex":
        files.write_atomically(path, latex(history))
    else:
        history.write(path)


def _modelled(history: History) -> Sequence[Column]:
    """Return the physical columns that say something: not those of contact that is never lost or of
    cycles whose pressures are unknown."""
    import numpy as np

    return [
        column
        for column in history.columns()
        if column.name != "error_estimate"
        and not np.isnan(column.values).all()
        and (column.name != "contact_fraction" or np.any(column.values < 1.0))
    ]


def _heading(column: Column) -> str:
    unit = column.unit.replace("/", "_per_").replace("^", "")
    words = column.name.removesuffix(f"_{unit}").split("_")
    return "\n".join(words if column.unit == "1" else [*words, f"({column.unit})"])
