"""The wear of scenes as an equation for `wear.orbit`: du/dphase = T r(u, U_a(phase)).

The state u is the bearing wear in mm, the forcing the displacement U_a in mm. Scenes of one variant
of the model go together: their constants are arrays along the first axis.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise

import numpy as np

from wear.binding import bind, bind_many
from wear.given_load import GivenLoad
from wear.load import Load, sampled
from wear.model import Model
from wear.numerics.collocation import Tangent
from wear.numerics.floating_point import ROUNDOFF, SMALLEST, TINY
from wear.numerics.gauss import FloatArray, IntArray
from wear.orbit.general import CONDITION
from wear.scene import Scene

DEEPEST = 1e12  # roughnesses of wear: more than in any count
HALF_DIFFERENCE = 1e-4  # of the roughness: half the step of the central difference in displacement
USABLE_SHARE = 0.99  # of the wear at which the roughness vanishes
PHASES = np.arange(256) / 256  # of a cycle, for its mean rate
SAME = 1e-9  # of a cycle: phases nearer to its ends are the ends


@dataclass(frozen=True)
class WearEquation:
    """The wear of scenes of one variant: the model of all, its constants of shape (scenes, 1), or
    plain numbers for one scene; and the load of each. Rates after the `deadline`
    (`time.monotonic()`) raise a `TimeoutError`: one evaluation over many rows takes seconds."""

    model: Model
    loads: tuple[Load, ...]
    deadline: float = field(default=np.inf, kw_only=True)

    @property
    def scenes(self) -> int:
        """Return the number of scenes."""
        return len(self.loads)

    def take(self, rows: slice | IntArray) -> WearEquation:
        """Return some of the scenes."""
        if self.scenes == 1:
            return self
        if isinstance(rows, slice):
            loads = self.loads[rows]
        else:
            loads = tuple(self.loads[i] for i in rows.tolist())
        return WearEquation(self.model.select(rows), loads)

    def forcing(self, phases: FloatArray) -> FloatArray:
        """Return the displacement in mm at phases (scenes, ...)."""
        if len(phases) == 1:
            return self.loads[0](phases)
        return sampled(self.loads, phases)

    def rate(
        self,
        u: FloatArray,
        forcing: FloatArray,
        lengths: FloatArray | float = 1.0,
        near: Tangent | None = None,
    ) -> FloatArray:
        """Return the wear in mm per cycle, times `lengths`, at wear (scenes, starts, intervals,
        nodes) under a displacement, both in mm. On a compliant support the root search for the
        pressure starts from that at the end of a tangent."""
        if time.monotonic() > self.deadline:
            raise TimeoutError
        times = self._period * lengths
        known = near.end / times if self.model.compliant and near is not None else None
        rate: FloatArray = self._model.rate(u, forcing, known)
        rate *= times
        return rate

    def slope(self, u: FloatArray, forcing: FloatArray) -> FloatArray:
        """Return the derivative of the rate with respect to the wear."""
        slope: FloatArray = self._model.slope(u, forcing) * self._period
        return slope

    def roundoff(self, u: FloatArray) -> FloatArray:
        """Return the relative rounding error (scenes, k) of the rate at the peak of the load."""
        peak = np.array([load.maximum for load in self.loads])[:, None] + np.zeros_like(u)
        return roundoff(self.model, peak, u)

    @cached_property
    def scale(self) -> FloatArray:
        """Return the wear (scenes,) in mm that changes the pressure by a factor of order one: a
        quarter of the roughness."""
        return self._roughness(np.zeros((self.scenes, 1))) / 4

    @cached_property
    def limit(self) -> FloatArray:
        """Return the largest wear (scenes,) in mm that may be solved for: `USABLE_SHARE` of that at
        which the equivalent roughness vanishes, infinite if it does not.

        The roughness of one solid is linear in the wear; that of two never vanishes.
        """
        far = DEEPEST * self.scale
        start, end = 4 * self.scale, self._roughness(far[:, None])
        decrease = np.where(end <= 0, start - end, 1.0)
        return np.where(end <= 0, USABLE_SHARE * far * start / decrease, np.inf)

    @cached_property
    def breakpoints(self) -> list[FloatArray]:
        """Return the phases at which the load of each scene cuts the cycle."""
        return [breakpoints(load) for load in self.loads]

    def _roughness(self, u: FloatArray) -> FloatArray:
        sigma: FloatArray = self.model.fields(u, np.zeros_like(u)).sigma
        return sigma.ravel()

    @cached_property
    def _model(self) -> Model:
        """Return the model with its constants along the first of four axes."""
        if self.scenes == 1:
            return self.model
        return self.model.reshaped((-1, 1, 1, 1))

    @cached_property
    def _period(self) -> FloatArray | float:
        if self.scenes == 1:
            return self.loads[0].period
        return np.array([load.period for load in self.loads]).reshape(-1, 1, 1, 1)


def equation_of(scenes: Sequence[Scene]) -> WearEquation:
    """Return the equation of scenes of one variant with periodic loads."""
    loads = tuple(scene.periodic_load for scene in scenes)
    return WearEquation(bind(scenes[0]) if len(scenes) == 1 else bind_many(scenes), loads)


def breakpoints(load: Load) -> FloatArray:
    """Return the phases from 0 to 1 that cut a cycle: kinks, across which the load is not smooth;
    peaks, near which nodes should cluster; and the phases a quarter of the way from peak to peak,
    where a smooth pulse ends."""
    inner = {*load.kinks, *load.peaks}
    if load.peaks and not load.kinks and load.minimum < load.maximum:
        for peak, after in pairwise([*load.peaks, load.peaks[0] + 1.0]):
            quarter = (after - peak) / 4
            inner |= {(peak + quarter) % 1.0, (after - quarter) % 1.0}
    return np.array([0.0, *sorted(x for x in inner if SAME < x < 1.0 - SAME), 1.0])


def growth(model: Model, load: Load, start: float, end: float) -> float:
    """Return the factor, at least 1, by which a small difference in wear grows from `start` to
    `end`."""
    U_a = load(PHASES)
    before, after = (float(np.mean(model.rate(u, U_a))) for u in (start, end))
    return max(1.0, after / before) if before > 0.0 else 1.0


def roundoff(model: Model, displacement: FloatArray, wear: FloatArray) -> FloatArray:
    """Return the relative rounding error of the rate: its condition with respect to the terms of
    the closure and the roughness, whose quotient is the argument of the contact law; with a given
    force neither enters."""
    if isinstance(model, GivenLoad):
        return np.full(np.broadcast(displacement, wear).shape, CONDITION * ROUNDOFF)
    fields = model.fields(wear, displacement)
    sigma, initial = fields.sigma, model.fields(np.zeros_like(wear), displacement).sigma
    cancellation = (initial + np.abs(sigma - initial)) / sigma  # where roughness vanishes
    terms = np.abs(fields.h) * (1 + cancellation) + np.abs(displacement)
    terms += np.abs(getattr(fields, "U_c", 0.0))
    half = HALF_DIFFERENCE * sigma
    more, less = (model.rate(wear, displacement + sign * half) for sign in (1.0, -1.0))
    steepness = np.abs(more - less) / (2 * half * (np.minimum(more, less) + TINY))
    underflow = SMALLEST / np.maximum(less, SMALLEST)
    result: FloatArray = ROUNDOFF * (CONDITION + steepness * terms) + underflow
    return np.asarray(result + model.law_roundoff(fields.h / sigma))
