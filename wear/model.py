"""The model of a scene: one interface of all solvers to all generated variants.

It has the wear rate, its slope and gradient, the fields, and where contact ends at h = 3 sigma the
margin of contact. `wear.binding` makes it from a scene.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np

from wear import pressure_root
from wear.faults import UsageError

Real = Any  # a float or an array of floats
Fields = Any  # the named tuple of a generated module: the fields that its variant has, mm and MPa
Summation = Callable[[Real], Real]
SAMPLED = 4.0  # times the rounding errors of a contact law, which are known at single values


def unchanged(values: Real) -> Real:
    """Return the values unchanged."""
    return values


class BoundModule(NamedTuple):
    """A generated module with its numbers: the constants of a run, and the physical parameters and
    the sign of pin wear from which they are computed."""

    module: ModuleType
    constants: Any
    data: Any
    signs: tuple[Real, ...]

    def changed(self, change: Callable[[Real], Real]) -> BoundModule:
        """Return the module with all its numbers changed, as rows of one array."""
        rows = iter(change(np.array([*self.constants, *self.data, *self.signs])))
        constants, data = (
            numbers._make(islice(rows, len(numbers))) for numbers in (self.constants, self.data)
        )
        return BoundModule(self.module, constants, data, tuple(rows))

    def gradient(self, by_constants: Any) -> dict[str, Real]:
        """Return derivatives with respect to the parameters from those to the constants."""
        by_parameters = self.module.parameter_gradient(by_constants, self.data, *self.signs)
        return dict(by_parameters._asdict())


@dataclass(frozen=True)
class Model:
    """A generated variant with its numbers bound.

    `u` is the wear u_c of the bearing and `U_a` the displacement of the pin, both in mm; they
    broadcast with each other and with the constants, which for a model of many scenes are arrays
    of shape (scenes, 1). `loss` is None where contact is never lost.
    """

    bound: BoundModule
    loss: BoundModule | None = None

    @property
    def module(self) -> Any:
        """Return the generated module."""
        return self.bound.module

    @property
    def constants(self) -> Any:
        """Return the constants of a run."""
        return self.bound.constants

    @property
    def operations(self) -> Mapping[str, int]:
        """Return the number of arithmetic operations of each generated function."""
        return {**self.module.OPERATIONS, **(self.loss.module.OPERATIONS if self.loss else {})}

    @property
    def compliant(self) -> bool:
        """Return whether the support of the bearing is compliant."""
        return "compliance" in self.constants._fields

    @property
    def ends_at_3_sigma(self) -> bool:
        """Return whether contact is lost at h > 3 sigma."""
        return self.loss is not None

    def select(self, index: Any) -> Model:
        """Return the model of the scenes with this index along the scene axis."""
        return self._changed(lambda rows: rows[:, index])

    def reshaped(self, shape: tuple[int, ...]) -> Model:
        """Return the model of many scenes with its numbers in this shape."""
        return self._changed(lambda rows: rows.reshape(len(rows), *shape))

    def _changed(self, change: Callable[[Real], Real]) -> Model:
        return Model(self.bound.changed(change), self.loss and self.loss.changed(change))

    def rate(self, u: Real, U_a: Real, near: Real | None = None) -> Real:
        """Return the wear rate du_c/dt in mm/s, Eq. (9) or (10).

        With a rigid support the rate is that in contact; the margin decides on contact, since the
        rate jumps there. With a compliant support a known `near` rate saves time.
        """
        if not self.compliant:
            return self.module.rate(u, U_a, self.constants)
        start = None if near is None else near / self.module.rate(1.0, self.constants)
        return self.module.rate(self.pressure(u, U_a, start), self.constants)

    def slope(self, u: Real, U_a: Real) -> Real:
        """Return the derivative of the wear rate with respect to u_c, in 1/s."""
        if not self.compliant:
            return self.law_rate_and_slope(u, U_a)[1]
        p = self._law_pressure(u, U_a)
        by_law = self.module.slope(p, u, U_a, self.constants)
        if self.loss is None:
            return by_law
        margin = self.margin(u, U_a)
        limited = self._limited(p, margin) < p
        return np.where(limited, np.where(margin > 0.0, self._edge_slope(u), 0.0), by_law)

    def rate_gradient(self, u: Real, U_a: Real, summed: Summation = unchanged) -> dict[str, Real]:
        """Return the derivatives of the wear rate by the contact law with respect to the load
        `U_a` and to every physical parameter, by symbol, as if contact were never lost.

        Those with respect to parameters are `summed`: some linear function of them, such as an
        integral over the cycle, which costs less before the chain rule than after it.
        """
        if self.compliant:
            p = self._law_pressure(u, U_a)
            by_load, by_constants = self.module.rate_gradient(p, u, U_a, self.constants)
        else:
            by_load, by_constants = self.module.rate_gradient(u, U_a, self.constants)
        by_constants = type(by_constants)._make(map(summed, by_constants))
        return {"U_a": by_load, **self.bound.gradient(by_constants)}

    def pressure(self, u: Real, U_a: Real, near: Real | None = None) -> Real:
        """Return the contact pressure in MPa on a compliant support, sought from a `near` one."""
        p = self._law_pressure(u, U_a, near)
        return p if self.loss is None else self._limited(p, self.margin(u, U_a))

    def fields(self, u: Real, U_a: Real) -> Fields:
        """Return the fields of the variant at given wear and load."""
        if self.compliant:
            return self.fields_under(self.pressure(u, U_a), u, U_a)
        fields = self.module.fields(u, U_a, self.constants)
        if self.loss is None:
            return fields
        return fields._replace(p=np.where(self.margin(u, U_a) >= 0.0, fields.p, 0.0))

    def fields_under(self, p: Real, u: Real, U_a: Real) -> Fields:
        """Return the fields on a compliant support at a known contact pressure `p` (MPa)."""
        return self.module.fields(p, u, U_a, self.constants)

    def law_rate(self, u: Real, U_a: Real) -> Real:
        """Return the wear rate (mm/s) by the contact law, as if contact were never lost."""
        if not self.compliant:
            return self.module.rate(u, U_a, self.constants)
        return self.module.rate(self._law_pressure(u, U_a), self.constants)

    def law_rate_and_slope(self, u: Real, U_a: Real) -> tuple[Real, Real]:
        """Return the wear rate (mm/s) by the contact law, as if contact were never lost, and its
        derivative with respect to u_c (1/s)."""
        if not self.compliant:
            rate, slope = self.module.rate_and_slope(u, U_a, self.constants)
            return rate, slope
        p = self._law_pressure(u, U_a)
        return self.module.rate(p, self.constants), self.module.slope(p, u, U_a, self.constants)

    def edge_rate_and_slope(self, u: Real, U_a: Real) -> tuple[Real, Real]:
        """Return the wear rate (mm/s) while a compliant support keeps h at 3 sigma, which is
        proportional to the margin, and its derivative with respect to u_c (1/s)."""
        p = self._limited(np.inf, 1.0) * self.margin(u, U_a)
        return self.module.rate(p, self.constants), self._edge_slope(u) + np.zeros_like(U_a)

    def edge_rate_gradient(
        self, u: Real, U_a: Real, summed: Summation = unchanged
    ) -> dict[str, Real]:
        """Return the derivatives of the wear rate while a compliant support keeps h at 3 sigma,
        with respect to the load and to every physical parameter, by symbol; those with respect to
        parameters `summed`."""
        rate, _ = self.edge_rate_and_slope(u, U_a)
        per_margin = self.module.rate(self._limited(np.inf, 1.0), self.constants)
        by_constants = dict.fromkeys(self.constants._fields, 0.0 * rate)
        # The pressure there is the margin over the compliance.
        by_constants["wear_per_pressure"] = rate / self.module.rate(1.0, self.constants)
        by_constants["compliance"] = -rate / self.constants.compliance
        parts = {name: summed(part) for name, part in by_constants.items()}
        by_rate = self.bound.gradient(type(self.constants)(**parts))
        by_load, by_margin = per_margin + 0.0 * rate, self.margin_gradient(u, U_a, summed)
        return {
            "U_a": by_load,
            **{key: own + per_margin * by_margin.get(key, 0.0) for key, own in by_rate.items()},
        }

    @property
    def held_margin(self) -> Real:
        """Return the margin (mm) up to which a compliant support keeps h at 3 sigma; 0 with a rigid
        one.

        There the pressure that keeps it is that of the contact law: the residual at zero pressure.
        """
        if not self.compliant:
            return 0.0
        law = -self.module.residual(0.0, 0.0, -self.margin(0.0, 0.0), self.constants)
        return law / self._limited(np.inf, 1.0)

    def margin(self, u: Real, U_a: Real) -> Real:
        """Return 3 sigma - h with an undeflected support, in mm; not negative in contact."""
        return self._loss.module.margin(u, U_a, self._loss.constants)

    def margin_slope(self, u: Real, U_a: Real) -> Real:
        """Return the derivative of the margin with respect to u_c; with respect to U_a it is 1."""
        return self._loss.module.margin_slope(u, self._loss.constants) + np.zeros_like(U_a)

    def margin_gradient(self, u: Real, U_a: Real, summed: Summation = unchanged) -> dict[str, Real]:
        """Return the derivatives of the margin with respect to `U_a` and to every physical
        parameter that it depends on, by symbol; those with respect to parameters `summed`."""
        by_constants = self._loss.module.margin_gradient(u, U_a, self._loss.constants)
        parts = type(by_constants)._make(summed(part + 0.0 * u) for part in by_constants)
        return {"U_a": 1.0 + 0.0 * u, **self._loss.gradient(parts)}

    def law_roundoff(self, ratio: Real) -> Real:
        """Return the relative rounding errors of an own contact law at closures over the roughness;
        those of the package have none of their own."""
        known = getattr(self.module, "rounding_errors", ((0.0,), (0.0,)))
        return np.asarray(SAMPLED * np.interp(ratio, *known))

    def margin_terms(self, u: Real, U_a: Real) -> Real:
        """Return the sum of the absolute terms of the margin, in mm: times the unit roundoff it
        bounds the rounding error."""
        return self._loss.module.margin_terms(u, U_a, self._loss.constants)

    @property
    def _loss(self) -> BoundModule:
        if self.loss is None:
            raise UsageError("this scene never loses contact: it has no margin")
        return self.loss

    def _law_pressure(self, u: Real, U_a: Real, near: Real | None = None) -> Real:
        return pressure_root.pressure(self.module, u, U_a, self.constants, near).p

    def _limited(self, p: Real, margin: Real) -> Real:
        compliance = self.constants.compliance
        return self._loss.module.limited_pressure(p, margin, compliance, self._loss.constants)

    def _edge_slope(self, u: Real) -> Real:
        loss, of = self._loss, self.constants
        change = loss.module.margin_slope(u, loss.constants)
        return loss.module.limited_slope(
            change, of.compliance, of.wear_per_pressure, loss.constants
        )


def stacked(models: Sequence[Model]) -> Model:
    """Return one model for those of scenes of one variant; its constants have shape (scenes,)."""

    def joined(bounds: Sequence[BoundModule]) -> BoundModule:
        first, parts = bounds[0], zip(*(bound[1:] for bound in bounds), strict=True)
        constants, data, signs = (map(np.array, zip(*part, strict=True)) for part in parts)
        numbers = first.constants._make(constants), first.data._make(data), tuple(signs)
        return BoundModule(first.module, *numbers)

    losses = [model.loss for model in models if model.loss is not None]
    return Model(joined([model.bound for model in models]), joined(losses) if losses else None)
