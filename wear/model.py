"""A scene's model: the generated variant that it needs, with its numbers bound.

What a scene leaves out has no symbol, no state and no operation in the code that runs. The model
gives solvers one interface to all variants: wear rate, its slope, the fields, and with cutoff the
margin of contact.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from wear import root
from wear.faults import UsageError
from wear.scene import Scene

Array = NDArray[np.float64]
Real = Any  # a float or an array of floats


class Fields(NamedTuple):
    """Every field, in mm and MPa; what a scene does not model is zero."""

    u_a: Real
    sigma_a: Real
    sigma_c: Real
    sigma: Real
    h: Real
    U_c: Real
    p: Real


@dataclass(frozen=True)
class Model:
    """A generated variant with its constants bound.

    `u` is the wear u_c of the bearing and `U_a` the displacement of the pin, both in mm;
    they broadcast with each other and, for a model of many scenes, with shape (scenes, 1).
    """

    module: ModuleType
    constants: Any

    @property
    def variant(self) -> str:
        """The name of the generated module."""
        return str(self.module.VARIANT)

    @property
    def law(self) -> str:
        """The name of the contact law."""
        return str(self.module.LAW)

    @property
    def operations(self) -> Mapping[str, int]:
        """How many arithmetic operations each generated function costs."""
        return dict(self.module.OPERATIONS)

    @property
    def compliant(self) -> bool:
        """Whether the bearing stands on springs."""
        return "k" in self.module.PARAMETERS

    @property
    def cutoff(self) -> bool:
        """Whether contact ends at h = 3 sigma."""
        return "margin" in self.module.OPERATIONS

    def rate(self, u: Real, U_a: Real, near: Real | None = None) -> Real:
        """Wear rate du_c/dt in mm/s, Eq. (9) or (10).

        With cutoff and a rigid support: the rate in contact; whether there is contact is the
        margin's to say, since the rate jumps there. With a compliant support a rate `near` by,
        where it is known, saves time.
        """
        if not self.compliant:
            return self.module.rate(u, U_a, self.constants)
        start = None if near is None else near / self.module.rate(1.0, self.constants)
        return self.module.rate(self.pressure(u, U_a, start), self.constants)

    def pressure(self, u: Real, U_a: Real, near: Real | None = None) -> Real:
        """Contact pressure in MPa on a compliant support, sought from a pressure `near` by."""
        p = root.pressure(self.module, u, U_a, self.constants, near).p
        return self.module.limited(p, u, U_a, self.constants) if self.cutoff else p

    def law_rate(self, u: Real, U_a: Real) -> Real:
        """Wear rate in mm/s by the contact law, whatever the cutoff makes of it."""
        if not self.compliant:
            return self.module.rate(u, U_a, self.constants)
        return self.module.rate(
            root.pressure(self.module, u, U_a, self.constants).p, self.constants
        )

    def by_law(self, u: Real, U_a: Real) -> tuple[Real, Real]:
        """Wear rate (mm/s) by the contact law, whatever the cutoff makes of it, and its derivative
        with respect to u_c (1/s)."""
        if not self.compliant:
            return self.module.rate(u, U_a, self.constants), self.slope(u, U_a)
        p = root.pressure(self.module, u, U_a, self.constants).p
        return self.module.rate(p, self.constants), self.module.slope(p, u, U_a, self.constants)

    def at_edge(self, u: Real, U_a: Real) -> tuple[Real, Real]:
        """Wear rate (mm/s) while a compliant support holds the contact at its edge, proportional to
        the margin, and its derivative with respect to u_c (1/s)."""
        p = self._edge_pressure / self.held * self.margin(u, U_a)
        slope = self.module.limited_slope(u, self.constants)
        return self.module.rate(p, self.constants), slope + np.zeros_like(U_a)

    @property
    def held(self) -> float:
        """The margin (mm) up to which a compliant support holds the contact at its edge; none with
        a rigid one."""
        if not self.compliant:
            return 0.0
        unit = self.module.limited(np.inf, 0.0, 1.0 - self.margin(0.0, 0.0), self.constants)
        return float(self._edge_pressure / unit)

    @property
    def _edge_pressure(self) -> Real:
        """The pressure of the contact law at its edge, MPa: all that is missing at no pressure."""
        return -self.module.residual(0.0, 0.0, -self.margin(0.0, 0.0), self.constants)

    def slope(self, u: Real, U_a: Real) -> Real:
        """Derivative of the wear rate with respect to u_c, in 1/s."""
        if not self.compliant:
            return self.module.slope(u, U_a, self.constants)
        p = root.pressure(self.module, u, U_a, self.constants).p
        smooth = self.module.slope(p, u, U_a, self.constants)
        if not self.cutoff:
            return smooth
        margin = self.margin(u, U_a)
        limited = self.module.limited(p, u, U_a, self.constants) < p
        followed = self.module.limited_slope(u, self.constants)
        return np.where(limited, np.where(margin > 0.0, followed, 0.0), smooth)

    def fields(self, u: Real, U_a: Real) -> Fields:
        """Every field at given wear and load."""
        if self.compliant:
            return self.fields_under(self.pressure(u, U_a), u, U_a)
        made = _made(self.module.fields(u, U_a, self.constants), u, U_a)
        if self.cutoff:
            made = made._replace(p=np.where(self.margin(u, U_a) >= 0.0, made.p, 0.0))
        return made

    def fields_under(self, p: Real, u: Real, U_a: Real) -> Fields:
        """Every field on a compliant support, whose contact pressure `p` (MPa) is known."""
        return _made(self.module.fields(p, u, U_a, self.constants), u, U_a)

    def margin(self, u: Real, U_a: Real) -> Real:
        """3 sigma - h with an undeflected support, in mm; with cutoff, contact where >= 0."""
        return self.module.margin(u, U_a, self.constants)

    def margin_slope(self, u: Real, U_a: Real) -> Real:
        """Derivative of the margin with respect to u_c; with respect to U_a it is 1."""
        return self.module.margin_slope(u, self.constants) + np.zeros_like(U_a)

    def margin_terms(self, u: Real, U_a: Real) -> Real:
        """Sum of the absolute terms of the margin, in mm: it is known to as many roundoffs."""
        return self.module.margin_terms(u, U_a, self.constants)


def _made(found: Any, u: Real, U_a: Real) -> Fields:
    """The fields that a generated module gives, and zero for those that it does not model."""
    zero = np.zeros(np.broadcast(u, U_a).shape)
    return Fields(**(dict.fromkeys(Fields._fields, zero) | found._asdict()))


def _module(scene: Scene) -> ModuleType:
    key = scene.variant
    return import_module(f"wear.generated.{key.package}.{key.module}")


def _constants(module: ModuleType, values: Mapping[str, Real]) -> Any:
    return module.bind(**{name: values[name] for name in module.PARAMETERS})


def bind(scene: Scene) -> Model:
    """The model of one scene."""
    module = _module(scene)
    return Model(module, _constants(module, scene.parameters()))


def bind_many(scenes: Sequence[Scene]) -> Model:
    """One model of many scenes; its constants have shape (scenes, 1).

    Raises
    ------
    UsageError
        if the scenes need different variants.
    """
    variants = {scene.variant for scene in scenes}
    if len(variants) != 1:
        raise UsageError("scenes that are solved together must model the same things")
    module = _module(scenes[0])
    rows = [scene.parameters() for scene in scenes]
    columns = {
        name: np.array([[row[name]] for row in rows], dtype=float) for name in module.PARAMETERS
    }
    return Model(module, _constants(module, columns))
