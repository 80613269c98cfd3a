"""Section 3: the condensed problem, equations (8) to (10), and (13).

Overview
    Eliminating p, h, U_c, sigma and the roughnesses from (7) leaves one differential equation
    for the bearing wear u_c: implicit in the rate when the support is compliant, explicit in
    the limit of a rigid one.
Key results
    CondensedProblem   its properties are
        implicit           (8), first line
        scalar             (8) with u_a eliminated as well: Q of (9)
        rigid              (10), the limit k -> oo of (8), taken by the machine
        rigid_condensed    (13), for a smooth pin that does not wear
    condensed          the condensed problem of a law, sign and pin, derived once
    bearing_only       that of section 4
    two_solids         that of section 3
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache, cached_property

from ..equations import Proved
from ..kernel import Judgement
from ..laws import TANH, ContactLaw
from ..rules.algebra import Solve, substitute
from ..rules.calculus import rigid
from ..symbols import symbols
from .governing import NoteModel, Pin

U_c, u_a = symbols("U_c u_a")
(p,) = symbols("p")


@dataclass(frozen=True)
class CondensedProblem(NoteModel):
    """The model with every unknown but the wear eliminated."""

    @cached_property
    def deflection(self) -> Judgement:
        """Eq. (7c)."""
        return Solve(U_c)(self.support)

    @cached_property
    def pressure_from_rate(self) -> Judgement:
        """Archard's law of the bearing, solved for the pressure."""
        return Solve(p)(self.wear_laws[2])

    @cached_property
    def pressure_at_wear(self) -> Judgement:
        """The contact law with closure and roughness written in terms of wear and load."""
        pressure = substitute(self.pressure, self.closure, self.deflection)
        return substitute(pressure, self.roughness_at_wear)

    @cached_property
    def implicit(self) -> Judgement:
        """Eq. (8), first line: everything but u_a and u_c eliminated."""
        eliminated = substitute(self.pressure_at_wear, self.pressure_from_rate)
        return eliminated.named("condensed problem")

    @cached_property
    def pressure_of_bearing_wear(self) -> Judgement:
        """The pressure in terms of u_c and U_a: explicit except for the deflection p/k."""
        pressure = self.pressure_at_wear
        return substitute(pressure, self.wear_of_pin) if pressure.relation.has(u_a) else pressure

    @cached_property
    def scalar(self) -> Judgement:
        """Eq. (9): u_c alone, solved for its rate, which the contact law may contain too."""
        explicit = substitute(self.wear_laws[2], self.pressure_of_bearing_wear)
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
            condensed = substitute(condensed, self.wear_of_pin)
        return condensed.named("condensed problem, rigid support")


condensed = cache(CondensedProblem)
"""The problem of a law, a sign of pin wear and a kind of pin, whose results are derived once."""


def bearing_only(law: ContactLaw = TANH) -> CondensedProblem:
    """Return the problem of a pin that is smooth and does not wear: section 4."""
    return condensed(law, False, Pin.ABSENT)


def two_solids(law: ContactLaw = TANH, opening: bool = False) -> CondensedProblem:
    """Return the problem of two worn, rough solids: section 3."""
    return condensed(law, opening, Pin.WORN_ROUGH)


def results(two: CondensedProblem) -> dict[str, Proved]:
    """Return equations (8) to (10) and (13) of two worn, rough solids."""
    one, start = replace(two, pin=Pin.ABSENT), two.start[1]  # one worn solid; u_c(0) = 0
    return {
        "8": (two.implicit, two.wear_of_pin, start),
        "9": (two.scalar, start),
        "10": (two.rigid, start),
        "13": (one.rigid_condensed, start),
        "bearing-rate": one.rigid,
    }
