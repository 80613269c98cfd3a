"""The data of the figures: arrays with names. No matplotlib here."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from wear.faults import Faults
from wear.fitting.readings import Specimen
from wear.generated import reaction
from wear.inside import fields_inside
from wear.load import Blocks, HistoryLoad
from wear.numerics.gauss import FloatArray
from wear.quantities import in_short
from wear.request import whole_cycles
from wear.scene import Scene

if TYPE_CHECKING:
    from wear.history import History

PHASES = 800  # of a cycle, besides the peaks of the load
_SECONDS_PER_HOUR = 3600.0
_MILLIMETRES_PER_METRE = 1e3
_MEASURED = 6  # family of readings that belong to no run


@dataclass(frozen=True)
class Line:
    """One curve: `name` may hold mathtext, `x` and `y` are of one shape (n,).

    Lines of one `family` share colour and marker; `variant` distinguishes them by dash (with loss
    of contact, or an asymptote).
    """

    name: str
    x: FloatArray
    y: FloatArray
    family: int = 0
    variant: int = 0

    def where(self, shown: NDArray[np.bool_]) -> Line:
        """Return the points that are shown (n,), on a logarithmic axis for instance."""
        return replace(self, x=self.x[shown], y=self.y[shown])


class Curve(NamedTuple):
    """A column of a history as a line: its name in files, and name and family in a figure."""

    column: str
    name: str
    family: int


class Ordinate(NamedTuple):
    """The quantity along an ordinate: its label, the `scale` from our unit to that of the figure,
    and the columns of a history of this kind."""

    label: str
    scale: float
    curves: tuple[Curve, ...] = ()


WEAR = Ordinate(
    r"Wear  $u$  ($\mathrm{\mu m}$)", 1e3,
    (Curve("bearing_wear_mm", "bearing", 0), Curve("pin_wear_mm", "pin", 1)),
)  # fmt: skip
BEARING_WEAR = Ordinate(r"Bearing wear  $u_c$  ($\mathrm{\mu m}$)", WEAR.scale)
ROUGHNESS = Ordinate(
    r"Roughness  $\sigma$  ($\mathrm{\mu m}$)", 1e3,
    (Curve("bearing_roughness_mm", "bearing", 0), Curve("pin_roughness_mm", "pin", 1)),
)  # fmt: skip
PRESSURE = Ordinate(
    r"Pressure  $p$  (MPa)", 1.0,
    (
        Curve("peak_pressure_MPa", "peak", 2), Curve("mean_pressure_MPa", "mean", 3),
        Curve("pressure_at_start_MPa", "start of cycle", 4),
    ),
)  # fmt: skip
CONTACT = Ordinate("Fraction in contact", 1.0, (Curve("contact_fraction", "in contact", 5),))
_PLAIN = ("bearing", "in contact")  # omitted from the names of lines of several runs


@dataclass(frozen=True)
class Panel:
    """One pair of axes: lines of a quantity, measured `points`, thin lines `behind` them (their
    asymptotes), and the `limit`, a value not to be exceeded."""

    quantity: Ordinate
    lines: tuple[Line, ...]
    points: tuple[Line, ...] = ()
    behind: tuple[Line, ...] = ()
    limit: float | None = None


class Abscissa(Enum):
    """The abscissa of the states of a run, with its label."""

    CYCLES = r"Cycles  $t/T$"
    HOURS = "Running time  (h)"
    DISTANCE = "Sliding distance  (m)"

    def of(self, scene: Scene, cycles: FloatArray) -> FloatArray:
        """Return the abscissae of numbers of cycles (n,)."""
        if self is Abscissa.CYCLES:
            return cycles
        load = scene.load
        if isinstance(load, Blocks | HistoryLoad):
            seconds = load.time_at(cycles)
        else:
            seconds = cycles * scene.periodic_load.period
        if self is Abscissa.HOURS:
            return seconds / _SECONDS_PER_HOUR
        numbers = scene.parameters()
        slid = reaction.sliding_distance(R=numbers["R"], T=seconds, n=numbers["n"])
        return np.asarray(slid / _MILLIMETRES_PER_METRE)


def panels_of(
    histories: Sequence[History],
    names: Sequence[str] = ("",),
    abscissa: Abscissa = Abscissa.CYCLES,
) -> tuple[Panel, ...]:
    """Return panels of wear, roughness, pressure and, where contact is lost, the contact fraction.

    For one run each quantity has its colour; for several runs each run has one, and the quantities
    of a panel differ by dash. Quantities that a variant does not have are left out, for several
    runs also the pressure at the start of a cycle.
    """
    several = len(histories) > 1
    panels = []
    for quantity in (WEAR, ROUGHNESS, PRESSURE, CONTACT):
        lines: list[Line] = []
        for place, (history, name) in enumerate(zip(histories, names, strict=True)):
            x = abscissa.of(history.definition, history.cycles.astype(float))
            curves = list(_curves(history, quantity))[: 2 if several else None]
            for variant, (curve, values) in enumerate(curves):
                known = np.isfinite(values)
                line = Line(curve.name, x[known], values[known], curve.family)
                if several:
                    full = as_typed(name)
                    full += "" if curve.name in _PLAIN else f", {curve.name}"
                    line = replace(line, name=full, family=place, variant=variant)
                lines.append(line)
        if lines:
            panels.append(Panel(quantity, tuple(lines)))
    return tuple(panels)


def _curves(history: History, quantity: Ordinate) -> Iterator[tuple[Curve, FloatArray]]:
    """Yield the columns of the variant; the contact fraction only where contact is lost."""
    columns = history.columns()
    trivial = 1.0 if quantity is CONTACT else 0.0
    for place, curve in enumerate(quantity.curves):
        values = columns.get(curve.column, np.array([np.nan]))
        known = values[np.isfinite(values)]
        always = place == 0 and quantity is not CONTACT
        if len(known) and (always or np.any(known != trivial)):
            yield curve, values


def points_of(
    specimens: Sequence[Specimen], runs: Mapping[str, Scene], abscissa: Abscissa
) -> tuple[Line, ...]:
    """Return the readings of each specimen, in the colour of the run of its name if any."""
    first, families = next(iter(runs.values())), dict(zip(runs, range(len(runs)), strict=True))
    return tuple(
        Line(
            f"{as_typed(each.name)} measured".strip(),
            abscissa.of(runs.get(each.name, first), each.cycles),
            each.wear_mm,
            families.get(each.name, _MEASURED + place),
        )
        for place, each in enumerate(specimens)
    )


def as_typed(name: str) -> str:
    """Return a user's name for a figure, in which dollars would otherwise enclose mathtext."""
    return name.replace("$", r"\$")


def spans_decades(lines: Sequence[Line]) -> bool:
    """Return whether all values after the initial state are positive and span two decades."""
    values = np.concatenate([line.y[line.x > 0.0] for line in lines])
    return bool(values.min() > 0.0 and values.max() >= 100.0 * values.min())


def pressure_inside(scene: Scene, cycles: Sequence[int], rtol: float = 1e-6) -> list[Line]:
    """Return the contact pressure (MPa) over the phase of the cycles that begin after `cycles`, a
    line for each in ascending order.

    Raises
    ------
    UsageError
        if the load does not repeat, or the scene's cycles cannot be counted.
    """
    faults, load = Faults(), scene.periodic_load
    begin = whole_cycles(cycles, faults)
    faults.stop_if_any()
    phases = np.union1d(np.linspace(0.0, 1.0, PHASES + 1), load.peaks)
    rows = [
        row
        for part in fields_inside(scene, np.unique(begin), phases, rtol)
        for row in zip(part.cycles, part.fields.p, strict=True)
    ]
    return [
        Line(name_of(cycle), phases, pressure, family)
        for family, (cycle, pressure) in enumerate(rows)
    ]


def name_of(cycles: float) -> str:
    """Return a number of cycles as figures name a line by it.

    >>> name_of(9000), name_of(1000000), name_of(2500000)
    ('$N = 9000$', '$N = 10^{6}$', '$N = 2.5\\\\times10^{6}$')
    """
    mantissa, _, power = in_short(cycles, 6).partition("e")
    if not power:
        return f"$N = {mantissa}$"
    factor = "" if mantissa == "1" else rf"{mantissa}\times"
    return f"$N = {factor}10^{{{power}}}$"


@dataclass(frozen=True)
class TimingCurve:
    """Time of a method against its true error or the number of cycles: arrays of shape (n,).

    `failed` marks runs that missed their tolerance, or were not made; they are drawn hollow.
    """

    name: str
    x: FloatArray
    seconds: FloatArray
    failed: NDArray[np.bool_]
