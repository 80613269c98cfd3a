"""Section 3: the condensed problem, equations (8) to (10), and (13).

Overview
    Eliminating p, h, U_c, sigma and the roughnesses from (7) leaves one differential equation
    for the bearing wear u_c: implicit in the rate when the support is compliant, explicit in
    the limit of a rigid one.
Key results
    Condensed.implicit       (8), first line
    Condensed.scalar         (8) with u_a eliminated as well: Q of (9)
    Condensed.rigid          (10), the limit k -> oo of (8), taken by the machine
    Condensed.rigid_condensed (13), for a smooth pin that does not wear
    bearing_only, two_solids  the problems that all results rest on, each derived once
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache, cached_property

import sympy as sp

from ..equations import Equation
from ..laws import TANH, ContactLaw
from ..statement import Statement
from ..symbols import symbols
from . import printed
from .governing import Model, Pin

U_a, U_c, u_a, u_c, h = symbols("U_a U_c u_a u_c h")
sigma, sigma_a, sigma_c, sigma_a0, sigma_c0 = symbols("sigma sigma_a sigma_c sigma_a0 sigma_c0")
p, p_max, k, V = symbols("p p_max k V")
f_a, f_c, K_a, K_c, H_a, H_c = symbols("f_a f_c K_a K_c H_a H_c")


@dataclass(frozen=True)
class Condensed:
    """Section 3 for one model."""

    model: Model

    @cached_property
    def deflection(self) -> Statement:
        """Eq. (7c)."""
        return self.model.support.solve_for(U_c)

    @cached_property
    def pressure_from_rate(self) -> Statement:
        """Archard's law of the bearing, read as the pressure that a wear rate needs."""
        return self.model.wear_laws[2].solve_for(p)

    @cached_property
    def pressure_at_wear(self) -> Statement:
        """The contact law with closure and roughness written in terms of wear and load."""
        model = self.model
        closed = model.pressure.substitute(model.closure).substitute(self.deflection)
        return closed.substitute(model.roughness_at_wear)

    @cached_property
    def implicit(self) -> Statement:
        """Eq. (8), first line: everything but u_a and u_c eliminated."""
        eliminated = self.pressure_at_wear.substitute(self.pressure_from_rate)
        return eliminated.named("condensed problem")

    @cached_property
    def pressure_of_bearing_wear(self) -> Statement:
        """The pressure in terms of u_c and U_a: explicit but for the deflection p/k."""
        made = self.pressure_at_wear
        return made.substitute(self.model.wear_of_pin) if made.claim.has(u_a) else made

    @cached_property
    def scalar(self) -> Statement:
        """Eq. (9): u_c alone, solved for its rate where that stands outside the contact law."""
        explicit = self.model.wear_laws[2].substitute(self.pressure_of_bearing_wear)
        return explicit.substitute(self.pressure_from_rate).named("general form")

    @cached_property
    def rigid(self) -> Statement:
        """Eq. (10): the limit of an infinitely stiff support."""
        return self.scalar.limit(k, sp.oo).named("rigid support")

    @cached_property
    def rigid_condensed(self) -> Statement:
        """Eq. (13), first line: (8) for a rigid support."""
        condensed = self.implicit.limit(k, sp.oo)
        if condensed.claim.has(u_a):
            condensed = condensed.substitute(self.model.wear_of_pin)
        return condensed.named("condensed problem, rigid support")


@cache
def bearing_only(law: ContactLaw = TANH) -> Condensed:
    """Return the problem of a pin that is smooth and does not wear: section 4."""
    return Condensed(Model(law, pin=Pin.ABSENT))


@cache
def two_solids(law: ContactLaw = TANH, opening: bool = False) -> Condensed:
    """Return the problem of two worn, rough solids: section 3."""
    return Condensed(Model(law, opening))


def equations(model: Model) -> tuple[Equation, ...]:
    """Return equations (8) to (10) and (13) of a model with two worn, rough solids."""
    two = Condensed(model)
    one = Condensed(replace(model, pin=Pin.ABSENT))
    start = model.start[1]
    return (
        Equation(
            "8", "3", "condensed problem", (two.implicit, model.wear_of_pin, start), printed.EQ_8
        ),
        Equation("9", "3", "general implicit form", (two.scalar, start)),
        Equation("10", "3", "rigid support", (two.rigid, start)),
        Equation(
            "13",
            "4.2",
            "condensed problem, bearing wear only",
            (one.rigid_condensed, start),
            printed.EQ_13,
        ),
    )
