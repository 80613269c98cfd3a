"""First integral: what pressure, roughness and load keep constant while the bearing wears.

Overview
    Wear opens the gap and roughens the bearing in proportion, so closure and roughness stay on
    a straight line: h + U_a - U_c - sigma/f_c does not change.  With the note's contact law the
    closure is a logarithm of the pressure, and the line becomes a relation between pressure,
    roughness and load that holds at every instant of every history, periodic or not, on a
    rigid or a compliant support.
Key results
    FirstIntegral.line       any contact law
    FirstIntegral.log_odds   ln(p/(p_max - p)) = 8 - 4 h/sigma, for (4)
    FirstIntegral.compliant  the relation for (4), with the deflection p/k
    FirstIntegral.rigid      its limit for k -> oo
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ..equations import Proved, stated
from ..hypotheses import Hypothesis, Kind
from ..kernel import Judgement
from ..laws import GENERAL, TANH, ContactLaw
from ..note.condensed import bearing_only
from ..note.governing import Model
from ..rules.algebra import Insert, Logarithm, Solve
from ..rules.assumption import assume
from ..rules.calculus import RIGID
from ..symbols import symbols

h, sigma = symbols("h sigma")
p, p_max, f_c = symbols("p p_max f_c")

SLOPED = Hypothesis("the roughness changes with wear", sp.Ne(f_c, 0))
UNSATURATED = Hypothesis(
    "the pressure is below its largest value", sp.Lt(p, p_max), kind=Kind.STATE
)


@dataclass(frozen=True)
class FirstIntegral:
    """The first integral of one worn solid, for one contact law."""

    law: ContactLaw = TANH

    @property
    def model(self) -> Model:
        """Bearing wear only."""
        return bearing_only(self.law).model

    @cached_property
    def line(self) -> Judgement:
        """Closure and roughness lie on a line that the load shifts."""
        model = self.model
        parents = (model.closure, model.roughness_at_wear, model.wear_of_pin)
        (claim,) = stated("closure-line")
        return Insert(claim)(*parents, assume(SLOPED), name="line of closure")

    @cached_property
    def log_odds(self) -> Judgement:
        """Eq. (4) solved for the closure."""
        claim = sp.Eq(sp.log(p / (p_max - p)), 8 - 4 * h / sigma)
        parents = (self.model.pressure, assume(UNSATURATED))
        return Logarithm(claim)(*parents, name="log-odds of pressure")

    @cached_property
    def compliant(self) -> Judgement:
        """What stays constant, with a support of stiffness k."""
        deflection = bearing_only(self.law).deflection
        return self._from("first-integral-compliant", deflection).named(
            "first integral, compliant support"
        )

    @cached_property
    def rigid(self) -> Judgement:
        """What stays constant, on a rigid support."""
        return self._from("first-integral", assume(RIGID)).named("first integral")

    def _from(self, identifier: str, deflection: Judgement) -> Judgement:
        parents = (self.log_odds, Solve(h)(self.line), deflection)
        (claim,) = stated(identifier)
        return Insert(claim)(*parents)


def results() -> dict[str, Proved]:
    """Return the first integrals."""
    tanh = FirstIntegral(TANH)
    return {
        "closure-line": FirstIntegral(GENERAL).line,
        "first-integral": tanh.rigid,
        "first-integral-compliant": tanh.compliant,
    }
