"""The quantities of scenes and results by their names in files, which end in the unit.

Key results
    COLUMNS     the columns of a result along its cycles
    SMALLEST, LARGEST, MOST_CYCLES     bounds of all numbers
    in_short    a number with few digits
    unit_of     the unit of a name
    words_of    a name in words, `label_of` with its unit
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

# Magnitudes are bounded so that no product of a scene's numbers can overflow or underflow.
SMALLEST = 1e-30
LARGEST = 1e30
MOST_CYCLES = 10**12

_UNITS = {
    "MPa_per_mm": "MPa/mm", "mJ_per_mm2": "mJ/mm^2", "MPa": "MPa", "mJ": "mJ", "mm": "mm",
    "rpm": "rpm", "s": "s", "N": "N",
}  # fmt: skip


def _ending(name: str) -> str:
    return next((f"_{end}" for end in _UNITS if name.endswith(f"_{end}")), "")


def in_short(number: float, digits: int = 4) -> str:
    """Return a number with some digits and a short exponent.

    >>> in_short(9000.0), in_short(1e6), in_short(1.25e-7)
    ('9000', '1e6', '1.25e-7')
    """
    return f"{number:.{digits}g}".replace("e+", "e").replace("e0", "e").replace("e-0", "e-")


def unit_of(name: str) -> str:
    """Return the unit that a name ends in, '' if none.

    >>> unit_of("stiffness_MPa_per_mm"), unit_of("radius_mm"), unit_of("roughness_growth")
    ('MPa/mm', 'mm', '')
    """
    return _UNITS.get(_ending(name)[1:], "")


def words_of(key: str) -> str:
    """Return a name, or a key of the scene file, in words without its unit.

    >>> words_of("closure_mm"), words_of("bearing.roughness_growth"), words_of("load.values_mm[2]")
    ('closure', 'bearing: roughness growth', 'load: values[2]')
    """
    place, dot, name = key.rpartition(".")
    name, bracket, rest = name.partition("[")
    words = name.removesuffix(_ending(name)).replace("_", " ")
    return f"{place}{': ' if dot else ''}{words}{bracket}{rest}"


def label_of(key: str) -> str:
    """Return a key of the scene file in words, with its unit, for an axis.

    >>> label_of("motion.radius_mm"), label_of("bearing.roughness_growth")
    ('motion: radius (mm)', 'bearing: roughness growth')
    """
    unit = unit_of(key)
    return f"{words_of(key)} ({unit})" if unit else words_of(key)


class Column(NamedTuple):
    """The meaning of a column of a result; its `symbol` in a `History` or in the fields of a model;
    and that symbol in LaTeX, if a printed table has room for the column."""

    meaning: str
    symbol: str = ""
    latex: str = ""


COLUMNS: Mapping[str, Column] = {
    "cycle": Column("number of completed load cycles"),
    "bearing_wear_mm": Column("wear of the bearing", "u_c", "u_c"),
    "pin_wear_mm": Column("wear of the pin", "u_a", "u_a"),
    "bearing_roughness_mm": Column("roughness of the bearing", "sigma_c", r"\sigma_c"),
    "pin_roughness_mm": Column("roughness of the pin", "sigma_a", r"\sigma_a"),
    "closure_mm": Column("closure of the mean surfaces", "h", "h"),
    "pressure_at_start_MPa": Column("contact pressure at the start of the next cycle", "p", "p"),
    "pressure_MPa": Column("contact pressure"),
    "bearing_displacement_mm": Column("displacement of the bearing", "U_c", "U_c"),
    "pin_displacement_mm": Column("displacement of the pin", "U_a"),
    "peak_pressure_MPa": Column("largest pressure in the cycle"),
    "mean_pressure_MPa": Column("mean pressure over the cycle"),
    "contact_fraction": Column("fraction of the cycle in contact"),
    "pin_reaction_N": Column("reaction force on the pin", "R_a", "R_a"),
    "peak_pin_reaction_N": Column("peak reaction force over the cycle"),
    "mean_pin_reaction_N": Column("mean reaction force over the cycle"),
    "sliding_distance_mm": Column("sliding distance in the cycle"),
    "friction_work_mJ_per_mm2": Column("work of friction per area in the cycle"),
    "friction_work_mJ": Column("work of friction"),
    "error_estimate": Column("estimated relative error of the bearing wear", "error"),
}
"""The columns of results, in the order of files and tables."""


def columns_of(state: object) -> dict[str, Any]:
    """Return by name the columns whose symbols are attributes of an object."""
    values = {
        name: getattr(state, each.symbol, None) for name, each in COLUMNS.items() if each.symbol
    }
    return {name: each for name, each in values.items() if each is not None}
