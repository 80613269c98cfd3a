"""Problem (i): the reaction of the pin is given, and wear is its integral.

The pressure follows from the reaction alone, the wear rate from the pressure; neither depends on
the wear. Roughness, closure and displacement of the pin follow from the wear. All formulas are
those of the variants with a compliant support, which take the pressure as an argument; a rigid
support has the compliance zero.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from wear.generated import reaction
from wear.model import Fields, Model, Real, Summation, unchanged


class Area(NamedTuple):
    """Width b and length L of the contact in mm, by their symbols."""

    b: Real
    L: Real


@dataclass(frozen=True)
class GivenLoad(Model):
    """A model whose load is the reaction R_a of the pin in N, not its displacement."""

    area: Area = field(kw_only=True)

    @property
    def operations(self) -> Mapping[str, int]:
        return {name: self.module.OPERATIONS[name] for name in ("rate", "fields")}

    @property
    def compliant(self) -> bool:
        return bool(np.all(self.constants.compliance > 0.0))

    def _changed(self, change: Callable[[Real], Real]) -> GivenLoad:
        return GivenLoad(self.bound.changed(change), area=Area(*change(np.array([*self.area]))))

    def pressure(self, u: Real, R_a: Real, near: Real | None = None) -> Real:
        """Return the contact pressure in MPa, Eq. (7b)."""
        return reaction.pressure(R_a, **self.area._asdict()) + 0.0 * u

    def rate(self, u: Real, R_a: Real, near: Real | None = None) -> Real:
        """Return the wear rate du_c/dt in mm/s, Eq. (7f)."""
        return self.module.rate(self.pressure(u, R_a), self.constants)

    def law_rate(self, u: Real, R_a: Real) -> Real:
        return self.rate(u, R_a)

    def slope(self, u: Real, R_a: Real) -> Real:
        """Return zero: the wear rate does not depend on the wear."""
        return np.zeros(np.broadcast(u, R_a).shape)

    def law_rate_and_slope(self, u: Real, R_a: Real) -> tuple[Real, Real]:
        return self.rate(u, R_a), self.slope(u, R_a)

    def rate_gradient(self, u: Real, R_a: Real, summed: Summation = unchanged) -> dict[str, Real]:
        """Return the derivatives of the wear rate with respect to every physical parameter, by
        symbol, and to the load as "U_a"; those with respect to parameters `summed`."""
        area, per_pressure = self.area._asdict(), self.module.rate(1.0, self.constants)
        nothing = 0.0 * (u + R_a)
        changes = dict.fromkeys(self.constants._fields, summed(nothing))
        changes["wear_per_pressure"] = summed(self.pressure(u, R_a))
        return {
            "U_a": per_pressure * reaction.by_force(**area) + nothing,
            **self.bound.gradient(type(self.constants)(**changes)),
            "b": summed(per_pressure * reaction.by_width(R_a, **area) + nothing),
            "L": summed(per_pressure * reaction.by_length(R_a, **area) + nothing),
        }

    def fields(self, u: Real, R_a: Real) -> Fields:
        return self.fields_under(self.pressure(u, R_a), u, R_a)

    def fields_under(self, p: Real, u: Real, R_a: Real) -> Fields:
        return self._closed(self._resting(p, u))

    def displacement(self, u: Real, R_a: Real) -> Real:
        """Return the displacement U_a in mm that causes the reaction; NaN for a zero reaction,
        since the contact law never vanishes."""
        resting = self._resting(self.pressure(u, R_a), u)
        return resting.h - self._closed(resting).h

    def _resting(self, p: Real, u: Real) -> Fields:
        """Return the fields without displacement of the pin, whose closure is too large by U_a."""
        return super().fields_under(p, u, 0.0 * p)

    def _closed(self, resting: Fields) -> Fields:
        """Return fields with the closure at which the contact law has their pressure: a difference
        of wear and displacement would lose its digits where the wear is deep."""
        from scipy.optimize.elementwise import bracket_root, find_root

        level = self.constants._replace(h_0=0.0 * self.constants.h_0, compliance=0.0)
        initial = self.module.fields(0.0, 0.0, 0.0, level).sigma

        def residual(ratio: Real, p: Real, initial: Real, *constants: Real) -> Real:
            return self.module.residual(p, 0.0, -ratio * initial, type(level)(*constants))

        known = resting.p, initial, *level
        with np.errstate(all="ignore"):  # NaN without a root
            bracket = bracket_root(residual, 0.0, 4.0, args=known).bracket
            ratio = find_root(residual, bracket, args=known).x
        return resting._replace(h=np.where(resting.p > 0.0, ratio * resting.sigma, np.nan))
