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
from ..kernel import Judgement
from ..laws import TANH, ContactLaw
from ..rules.algebra import Solve, substitute
from ..rules.calculus import rigid
from ..symbols import initial, rate, symbols
from ..typeset.display import as_written, minus
from . import printed
from .governing import Model, Pin

U_a, U_c, u_a, u_c, h = symbols("U_a U_c u_a u_c h")
sigma, sigma_a, sigma_c, sigma_a0, sigma_c0 = symbols("sigma sigma_a sigma_c sigma_a0 sigma_c0")
p, p_max, k, V, h_0, kappa = symbols("p p_max k V h_0 kappa")
f_a, f_c, K_a, K_c, H_a, H_c = symbols("f_a f_c K_a K_c H_a H_c")


@dataclass(frozen=True)
class Condensed:
    """Section 3 for one model."""

    model: Model

    @cached_property
    def deflection(self) -> Judgement:
        """Eq. (7c)."""
        return Solve(U_c)(self.model.support)

    @cached_property
    def pressure_from_rate(self) -> Judgement:
        """Archard's law of the bearing, read as the pressure that a wear rate needs."""
        return Solve(p)(self.model.wear_laws[2])

    @cached_property
    def pressure_at_wear(self) -> Judgement:
        """The contact law with closure and roughness written in terms of wear and load."""
        model = self.model
        closed = substitute(model.pressure, model.closure, self.deflection)
        return substitute(closed, model.roughness_at_wear)

    @cached_property
    def implicit(self) -> Judgement:
        """Eq. (8), first line: everything but u_a and u_c eliminated."""
        eliminated = substitute(self.pressure_at_wear, self.pressure_from_rate)
        return eliminated.named("condensed problem")

    @cached_property
    def pressure_of_bearing_wear(self) -> Judgement:
        """The pressure in terms of u_c and U_a: explicit but for the deflection p/k."""
        made = self.pressure_at_wear
        return substitute(made, self.model.wear_of_pin) if made.relation.has(u_a) else made

    @cached_property
    def scalar(self) -> Judgement:
        """Eq. (9): u_c alone, solved for its rate where that stands outside the contact law."""
        explicit = substitute(self.model.wear_laws[2], self.pressure_of_bearing_wear)
        return substitute(explicit, self.pressure_from_rate).named("general form")

    @cached_property
    def rigid(self) -> Judgement:
        """Eq. (10): the limit of an infinitely stiff support."""
        return rigid(self.scalar, name="rigid support")

    @cached_property
    def rigid_condensed(self) -> Judgement:
        """Eq. (13), first line: (8) for a rigid support."""
        condensed = rigid(self.implicit)
        if condensed.relation.has(u_a):
            condensed = substitute(condensed, self.model.wear_of_pin)
        return condensed.named("condensed problem, rigid support")


@cache
def bearing_only(law: ContactLaw = TANH) -> Condensed:
    """Return the problem of a pin that is smooth and does not wear: section 4."""
    return Condensed(Model(law, pin=Pin.ABSENT))


@cache
def two_solids(law: ContactLaw = TANH, opening: bool = False) -> Condensed:
    """Return the problem of two worn, rough solids: section 3."""
    return Condensed(Model(law, opening))


with as_written():
    half_rate = K_c * V * p_max / (6 * H_c)
    deflection_at_rate = 3 * H_c / (k * K_c * V) * rate("u_c")
    wear_ratio = sp.Eq(kappa, K_a * H_c / (K_c * H_a))
    roughness_of_both = sp.sqrt((sigma_a0 + f_a * (kappa * u_c)) ** 2 + (sigma_c0 + f_c * u_c) ** 2)


@dataclass(frozen=True)
class _Display:
    """A problem as an author lays it out, and the abbreviations in it."""

    shown: tuple[sp.Basic, ...]
    where: tuple[sp.Eq, ...]


def _eq_8() -> _Display:
    with as_written():
        law = p_max / 2 * (1 + sp.tanh((4 * sigma - 2 * h) / sigma))
        closure = h_0 + (u_c + deflection_at_rate) - (u_a + U_a)
        roughness = sp.sqrt((sigma_a0 + f_a * u_a) ** 2 + (sigma_c0 + f_c * u_c) ** 2)
        first = sp.Eq(3 * H_c / (K_c * V) * rate("u_c"), law)
        return _Display((first, *printed.EQ_8[1:]), (sp.Eq(h, closure), sp.Eq(sigma, roughness)))


def _eq_9() -> _Display:
    with as_written():
        law = half_rate * (1 + sp.tanh(sp.Add(4, minus(2 * h / sigma))))
        closure = sp.Add(h_0, (1 - kappa) * u_c, deflection_at_rate, -U_a)
        return _Display(
            (sp.Eq(rate("u_c"), law), sp.Eq(initial("u_c"), 0)),
            (wear_ratio, sp.Eq(h, closure), sp.Eq(sigma, roughness_of_both)),
        )


def _eq_10() -> _Display:
    with as_written():
        closure = sp.Add(h_0, (1 - kappa) * u_c, -U_a)
        argument = sp.Add(4, minus(2 * closure / roughness_of_both))
        law = half_rate * (1 + sp.tanh(argument))
        return _Display((sp.Eq(rate("u_c"), law), sp.Eq(initial("u_c"), 0)), (wear_ratio,))


def equations(model: Model) -> tuple[Equation, ...]:
    """Return equations (8) to (10) and (13) of a model with two worn, rough solids."""
    two = Condensed(model)
    one = Condensed(replace(model, pin=Pin.ABSENT))
    start = model.start[1]
    eq_8, eq_9, eq_10 = _eq_8(), _eq_9(), _eq_10()
    return (
        Equation(
            "8",
            "3",
            "condensed problem",
            (two.implicit, model.wear_of_pin, start),
            printed.EQ_8,
            eq_8.shown,
            where=eq_8.where,
        ),
        Equation(
            "9",
            "3",
            "general implicit form",
            (two.scalar, start),
            display=eq_9.shown,
            where=eq_9.where,
        ),
        Equation(
            "10",
            "3",
            "rigid support",
            (two.rigid, start),
            display=eq_10.shown,
            where=eq_10.where,
        ),
        Equation(
            "13",
            "4.2",
            "condensed problem, bearing wear only",
            (one.rigid_condensed, start),
            printed.EQ_13,
        ),
        Equation("bearing-rate", "3", "wear rate, bearing wear only, rigid support", (one.rigid,)),
    )
