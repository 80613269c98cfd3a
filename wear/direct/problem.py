"""The differential equation for an integrator: d(u_c/unit)/dphase for one scene.

Wear is of the order of 1e-4 mm, so that an absolute tolerance needs a scaled variable: the unit is
about the wear of the first cycle. The time is the phase (in cycles) since the start of a whole
cycle, so that after any number of cycles the load is evaluated with a small argument.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from wear.load import Load
from wear.model import Model
from wear.numerics.floating_point import TINY

Real = Any  # a float or an array of floats: loads and models broadcast
PHASES = 2048  # samples of a cycle for estimates of scale and sharpness
STEP_PER_PULSE = 0.75  # longest step over the standard deviation of a contact pulse
DEPTHS = np.linspace(0.0, 20.0, 81)  # closures in roughnesses at which the contact law is sampled


class Setting(NamedTuple):
    """The settings of an integration: SciPy's `method`, its tolerance, and the share of the widest
    step.

    Two runs whose difference estimates an error must differ in both: where the widest step limits
    the steps, the tolerance has no effect.
    """

    method: str
    tolerance: float
    share: float


@dataclass(frozen=True)
class WearODE:
    """The wear equation of a model under its load, with the scale of its wear.

    `unit` (mm) is about the wear of the first cycle. `limit` (mm) is the wear at which the only
    rough surface has become perfectly smooth (infinity if that cannot happen): there the model,
    in which lengths are measured in roughnesses, ends.
    """

    model: Model
    load: Load
    unit: float
    limit: float

    def speed(self, phase: Real, u: Real) -> Real:
        """Return the wear in mm per cycle at `phase` and wear `u`, contact assumed."""
        return self.load.period * self.model.rate(u, self.load(phase))

    def margin(self, phase: Real, u: Real) -> Real:
        """Return the margin of contact in mm: negative when open (with loss of contact only)."""
        return self.model.margin(u, self.load(phase))


def scaled_ode(model: Model, load: Load) -> WearODE:
    """Return the equation of a model under a load, with its scale of wear."""
    U_a = load(_grid(load))
    rate = model.rate(0.0, U_a)
    if model.ends_at_3_sigma:
        rate = np.where(model.margin(0.0, U_a) >= 0.0, rate, 0.0)
    first_cycle = load.period * float(np.mean(rate))
    roughness = float(model.fields(0.0, load.maximum).sigma)
    unit = min(first_cycle, roughness) or roughness
    return WearODE(model, load, unit, _smooth_at(model, load, roughness))


def widest_step(ode: WearODE, u: float, end: float) -> float:
    """Return the longest step, in cycles, that cannot jump over a contact pulse when the wear is
    `u`.

    Around a peak of the load the pressure falls like exp(lambda (U_a - peak)), lambda being the
    steepest logarithmic slope of the contact law; to second order in phase that is a bell of
    standard deviation 1/sqrt(-lambda U_a''). A flatter pulse, of a saturated contact, is longer.
    `end` is the length of the integration, returned where there are no pulses.
    """
    steepness = _logarithmic_slope(ode.model, ode.load, u)
    curvature = _sharpest_curvature(ode.load)
    if steepness * curvature <= 0.0:
        return end
    return min(end, STEP_PER_PULSE / float(np.sqrt(steepness * curvature)))


def _grid(load: Load) -> Any:
    """Return the phases of a cycle, with its peaks, so that no narrow pulse is missed."""
    return np.concatenate([np.arange(PHASES) / PHASES, load.peaks])


def _logarithmic_slope(model: Model, load: Load, u: float) -> float:
    """Return the largest d ln(rate)/dU_a (1/mm) while the closure at the highest load opens.

    The search starts where the surfaces touch: deeper, a saturated law has no slope.
    """
    deepest = model.fields(u, load.maximum)
    touching = load.maximum + min(float(deepest.h), 0.0)
    displacement = touching - float(deepest.sigma) * DEPTHS
    rate = np.asarray(model.rate(u, displacement))
    positive = rate > TINY
    if np.count_nonzero(positive) < 2:
        return 0.0
    return float(np.max(np.diff(np.log(rate[positive])) / np.diff(displacement[positive])))


def _sharpest_curvature(load: Load) -> float:
    """Return the largest -U_a'' (mm per cycle squared) where the load is smooth.

    The integrator stops at kinks and cannot step over them.
    """
    phases = np.arange(PHASES + 1) / PHASES
    curvature = -np.diff(load.slope(phases)) * PHASES
    for kink in load.kinks:
        curvature[np.abs((phases[:-1] + 0.5 / PHASES - kink + 0.5) % 1.0 - 0.5) < 1.0 / PHASES] = (
            0.0
        )
    return float(max(0.0, np.max(curvature)))


def _smooth_at(model: Model, load: Load, roughness: float) -> float:
    """Return the wear at which the only rough surface is smooth, infinite if there is none."""
    initial, worn = (model.fields(u, load.maximum) for u in (0.0, roughness))
    if "sigma_a" in initial._fields or worn.sigma_c >= initial.sigma_c:
        return np.inf
    return float(roughness * initial.sigma_c / (initial.sigma_c - worn.sigma_c))
