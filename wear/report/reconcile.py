"""What would reconcile the note's irreproducible numbers: a change of one datum of section 4.

Overview
    (21) with the data of section 4 does not give the printed wear per cycle.  For each datum
    that (21) depends on there is one value that does; the simulation with it then tells how
    well the printed simulated value, which no fit has seen, comes out.
Key results
    reconciliations    the changes, the best first
    slope_for_simulation   the f_c that the printed simulated value needs
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

from wear.generated import asymptotics as formula
from wear.report import note
from wear.report.note import PRINTED
from wear.scene import Scene


@dataclass(frozen=True)
class Reconciliation:
    """A changed datum with which (21) gives the printed wear per cycle."""

    datum: str
    value: float
    was: float
    simulated_mm: float

    @property
    def misfit(self) -> float:
        """Relative distance of the simulated wear from the printed one."""
        return self.simulated_mm / PRINTED.simulated_mm - 1.0

    @property
    def sentence(self) -> str:
        """The change and how well it does."""
        distance = self.simulated_mm / PRINTED.formula_mm - 1.0
        return (
            f"{self.datum} = {self.value:.8g} instead of {self.was:g} would give "
            f"{PRINTED.formula_mm:.2e} mm by (21) and {self.simulated_mm:.4e} mm by the solution, "
            f"{100 * self.misfit:+.2f} % from the printed one and {100 * distance:+.2f} % from "
            "(21)"
        )


def _simulated(scene: Scene) -> float:
    """Return the wear of the cycle after the printed number of cycles."""
    return float(note.increments_after(scene, PRINTED.cycles)[0])


def _slope(scene: Scene) -> float:
    """Return the f_c for which (21) gives the printed value: the threshold of that share."""
    numbers = scene.parameters()
    data = {name: numbers[name] for name in ("T", "K_c", "H_c", "R", "n")}
    largest = formula.wear_per_cycle(**data, p_inf=numbers["p_max"])
    return float(formula.slope_threshold(epsilon=PRINTED.formula_mm / largest))


@cache
def reconciliations() -> tuple[Reconciliation, ...]:
    """Return the changes of one datum, the best first.

    (21) depends on K_c, p_max, 1/H_c, R and T by one factor only, and so does the simulation;
    n drops out, since the period is 120/n.
    """
    given = note.scene("section4")
    factor = PRINTED.formula_mm / note.required(note.limit("section4").wear_per_cycle_mm)
    changes = (
        ("f_c", "bearing.roughness_growth", _slope(given) / given.bearing.roughness_growth),
        ("K_c", "bearing.wear_coefficient", factor),
        ("p_max", "contact.max_pressure_MPa", factor),
        ("H_c", "bearing.hardness_MPa", 1.0 / factor),
        ("R", "motion.radius_mm", factor),
    )
    found = (_changed(given, *change) for change in changes)
    return tuple(sorted(found, key=lambda change: abs(change.misfit)))


@cache
def slope_for_simulation() -> float:
    """Return the f_c with which the simulation gives the printed simulated value."""
    from scipy.optimize import brentq

    given = note.scene("section4")

    def distance(slope: float) -> float:
        changed = given.with_({"bearing.roughness_growth": slope})
        return _simulated(changed) - PRINTED.simulated_mm

    return float(brentq(distance, given.bearing.roughness_growth, 0.5, rtol=1e-10))


def _changed(scene: Scene, datum: str, key: str, factor: float) -> Reconciliation:
    """Multiply one datum of a scene by a factor, and simulate."""
    was = scene.parameters()[datum]
    simulated = _simulated(scene.with_({key: was * factor}))
    return Reconciliation(datum, was * factor, was, simulated)
