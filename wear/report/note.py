"""The examples of the note: scenes and asymptotes, each computed once, and the printed numbers.

The printed numbers of section 4 contradict each other.  All data except f_c enter (21) as factors;
one value of f_c gives the printed wear per cycle, and the simulation with it predicts the printed
simulated value, to which nothing was fitted: the `reconciliation`.
"""

from __future__ import annotations

from functools import cache
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from wear.equation import equation_of
from wear.generated import asymptotics as formula
from wear.orbit.period_map import resolved, settings
from wear.regime import Asymptote, asymptote
from wear.scene import Scene, load_scene
from wear.solver import solve

FloatArray = NDArray[np.float64]
Some = TypeVar("Some")

EXAMPLES = ("section3", "section4", "section5")
SECTION_5 = ("section5-k1e-7", "section5", "section5-k1e-5", "section5-k1e-4")
"""The scenes of Fig. 3b, by rising wear coefficient."""
CUTOFF = ".cutoff"
"""Suffix of the name of an example with loss of contact."""
RTOL = 1e-12
"""Requested relative error of the analysis."""


class PrintedValues(NamedTuple):
    """Numbers that the note prints for section 4."""

    simulated_mm: float = 2.34e-5
    formula_mm: float = 2.35e-5
    cycles: int = 9000
    criterion: float = 1e-6


PRINTED = PrintedValues()


@cache
def scene(name: str) -> Scene:
    """Return an example."""
    ends = name.endswith(CUTOFF)
    return load_scene(name.removesuffix(CUTOFF), ["contact.ends_at_3_sigma=true"] * ends)


@cache
def limit(name: str) -> Asymptote:
    """Return the asymptote of an example."""
    return asymptote(scene(name))


def required(value: Some | None) -> Some:
    """Return a constant of the regime of the scene; raise if the regime does not have it."""
    if value is None:
        raise ValueError("the report speaks of a constant that this regime does not have")
    return value


def increments(scene: Scene, wear: FloatArray) -> FloatArray:
    """Return the increment (mm) of the next cycle at each wear (mm), integrated, not subtracted."""
    equation, size = equation_of([scene]), settings(RTOL)
    ((_, maps),) = resolved(equation, equation.breakpoints, wear[None], size)
    return np.asarray(maps.finer(size).advance(wear[None]).increment[0])


def increments_after(scene: Scene, *cycles: int) -> FloatArray:
    """Return the wear (mm) of the cycle that follows each number of cycles."""
    return increments(scene, solve(scene, cycles, rtol=RTOL).u_c)


class Reconciliation(NamedTuple):
    """The f_c with which (21) gives the printed wear per cycle, and the simulated one (mm)."""

    value: float
    simulated_mm: float

    @property
    def misfit(self) -> float:
        """Return the relative distance of the simulated wear from the printed one."""
        return self.simulated_mm / PRINTED.simulated_mm - 1.0

    @property
    def sentence(self) -> str:
        """Return the sentence on the changed f_c and its consequences."""
        distance = self.simulated_mm / PRINTED.formula_mm - 1.0
        was = scene("section4").bearing.roughness_growth
        return (
            f"f_c = {self.value:.8g} instead of {was:g} would give "
            f"{PRINTED.formula_mm:.2e} mm by (21) and {self.simulated_mm:.4e} mm by the solution, "
            f"{100 * self.misfit:+.2f} % from the printed one and {100 * distance:+.2f} % from "
            "(21)"
        )


def _simulated(growth: float) -> float:
    """Return the wear (mm) of the cycle after the printed number of cycles, with another f_c."""
    changed = scene("section4").with_({"bearing.roughness_growth": growth})
    return float(increments_after(changed, PRINTED.cycles)[0])


@cache
def reconciliation() -> Reconciliation:
    """Return the f_c for which (21) gives the printed value, by the threshold of its share."""
    numbers = scene("section4").parameters()
    data = {name: numbers[name] for name in ("T", "K_c", "H_c", "R", "n")}
    largest = formula.wear_per_cycle(**data, p_inf=numbers["p_max"])
    growth = float(formula.slope_threshold(epsilon=PRINTED.formula_mm / largest))
    return Reconciliation(growth, _simulated(growth))


@cache
def growth_for_simulation() -> float:
    """Return the f_c with which the simulation gives the printed simulated value."""
    from scipy.optimize import brentq

    least = scene("section4").bearing.roughness_growth
    return float(
        brentq(lambda growth: _simulated(growth) - PRINTED.simulated_mm, least, 0.5, rtol=1e-10)
    )
