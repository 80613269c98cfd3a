"""What would reconcile the note's irreproducible numbers: another f_c in section 4.

Overview
    (21) with the data of section 4 does not give the printed wear per cycle.  All data but f_c
    enter it as factors.  One f_c gives the printed value; the simulation with it then tells how
    well the printed simulated value, which no fit has seen, comes out.
Key results
    reconciliation         the f_c that the printed wear per cycle needs, and the simulation with it
    slope_for_simulation   the f_c that the printed simulated value needs
"""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

from wear.generated import asymptotics as formula
from wear.report import note
from wear.report.note import PRINTED

_GROWTH = "bearing.roughness_growth"


class Reconciliation(NamedTuple):
    """The f_c with which (21) gives the printed wear per cycle, and the simulated one (mm)."""

    value: float
    simulated_mm: float

    @property
    def misfit(self) -> float:
        """Relative distance of the simulated wear from the printed one."""
        return self.simulated_mm / PRINTED.simulated_mm - 1.0

    @property
    def sentence(self) -> str:
        """The change and how well it does."""
        distance = self.simulated_mm / PRINTED.formula_mm - 1.0
        was = note.scene("section4").bearing.roughness_growth
        return (
            f"f_c = {self.value:.8g} instead of {was:g} would give "
            f"{PRINTED.formula_mm:.2e} mm by (21) and {self.simulated_mm:.4e} mm by the solution, "
            f"{100 * self.misfit:+.2f} % from the printed one and {100 * distance:+.2f} % from "
            "(21)"
        )


def _simulated(slope: float) -> float:
    """Return the wear (mm) of the cycle after the printed number of cycles with an f_c."""
    changed = note.scene("section4").with_({_GROWTH: slope})
    return float(note.increments_after(changed, PRINTED.cycles)[0])


@cache
def reconciliation() -> Reconciliation:
    """Return the f_c for which (21) gives the printed value: the threshold of that share."""
    numbers = note.scene("section4").parameters()
    data = {name: numbers[name] for name in ("T", "K_c", "H_c", "R", "n")}
    largest = formula.wear_per_cycle(**data, p_inf=numbers["p_max"])
    slope = float(formula.slope_threshold(epsilon=PRINTED.formula_mm / largest))
    return Reconciliation(slope, _simulated(slope))


@cache
def slope_for_simulation() -> float:
    """Return the f_c with which the simulation gives the printed simulated value."""
    from scipy.optimize import brentq

    least = note.scene("section4").bearing.roughness_growth
    return float(
        brentq(lambda slope: _simulated(slope) - PRINTED.simulated_mm, least, 0.5, rtol=1e-10)
    )
