"""Two worn solids: the steady state, its cases, and the logarithmic drift.

Overview
    With pin wear u_a = kappa u_c the equivalent roughness is a root of a quadratic in u_c,
    sigma^2 = sigma_a0^2 + sigma_c0^2 + 2 p_1 u_c + q^2 u_c^2, and the gap opens by g per wear.
    If the roughness changes and never vanishes (p_1 > -q S with S the roughness at the start),
    wear is unbounded and h/sigma tends to g/q: x_inf = 4 - 2 g/q.  (A negative slope would make a
    roughness negative in the end, which the note excludes.)
Key results
    TwoSolids.definitions  q, g and p_1
    TwoSolids.squares      the identity by which sigma does not vanish
    TwoSolids.ratio        h/sigma -> g/q
    TwoSolids.rate         the steady wear rate
    TwoSolids.drift        the coefficient of ln t
Remarks
    g = 1 - kappa with Eq. (1) as printed, 1 + kappa with the physical sign.  As printed,
    kappa = 1 keeps the gap bounded and x_inf = 4; kappa > 1 gives x_inf > 4 while h tends to
    -oo, an artefact of the printed sign of u_a.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ..hypotheses import BOUNDED_LOAD, Hypothesis
from ..kernel import Judgement
from ..laws import TANH, ContactLaw
from ..note import condensed
from ..note.condensed import CondensedProblem
from ..rules.algebra import Consequence, Insert, Solve, substitute
from ..rules.assumption import assume, defined
from ..rules.drift import first_order
from ..rules.growth import AtInfinity, unbounded
from ..rules.inequalities import Arithmetic
from ..rules.limits import Passes, forever
from ..symbols import rate, symbols
from .steady_state import drift, worn

h_0, U_a, u_c, kappa, q, g, p_1 = symbols("h_0 U_a u_c kappa q g p_1")
f_a, f_c, sigma_a0, sigma_c0 = symbols("f_a f_c sigma_a0 sigma_c0")
p_max, K_a, K_c, H_a, H_c, V = symbols("p_max K_a K_c H_a H_c V")

squared = sigma_a0**2 + sigma_c0**2 + 2 * p_1 * u_c + q**2 * u_c**2
sigma = sp.sqrt(squared)
closure_ratio = (h_0 + g * u_c - U_a) / sigma

start = sp.sqrt(sigma_a0**2 + sigma_c0**2)
"""The equivalent roughness at the start."""

NEVER_SMOOTH = Hypothesis(
    sp.sqrt((f_a * kappa) ** 2 + f_c**2) * start > -f_a * kappa * sigma_a0 - f_c * sigma_c0
)
"""Wear changes the roughness, which never vanishes: as vectors, the slopes of the two roughnesses
and their values at the start are not opposite."""


@dataclass(frozen=True)
class TwoSolids:
    """The long-time limit of (10) for two worn, rough solids."""

    law: ContactLaw = TANH
    opening: bool = False

    @cached_property
    def definitions(self) -> tuple[Judgement, Judgement, Judgement]:
        """q, g and p_1."""
        return (
            defined(q, sp.sqrt((f_a * kappa) ** 2 + f_c**2), assume(NEVER_SMOOTH)),
            defined(g, 1 + kappa if self.opening else 1 - kappa),
            defined(p_1, f_a * kappa * sigma_a0 + f_c * sigma_c0),
        )

    @cached_property
    def rough_enough(self) -> Judgement:
        """The condition on the roughness, in terms of q and p_1."""
        roughening, _, cross = self.definitions
        condition = sp.Gt(p_1 + q * start, 0)
        return Arithmetic(condition)(assume(NEVER_SMOOTH), roughening, cross)

    @cached_property
    def squares(self) -> Judgement:
        """sigma^2 is a square plus a term that is positive once the bearing has worn."""
        claim = sp.Eq(squared, (start - q * u_c) ** 2 + 2 * (p_1 + q * start) * u_c)
        return Insert(claim)(name="lower bound of the roughness")

    @property
    def facts(self) -> tuple[Judgement, ...]:
        """The premises by which the roughness does not vanish."""
        return self.squares, self.rough_enough, worn(self.problem)

    @cached_property
    def rough(self) -> Judgement:
        """The roughness does not vanish at any wear."""
        return Arithmetic(sp.Gt(squared, 0))(*self.facts)

    @cached_property
    def problem(self) -> CondensedProblem:
        """The condensed problem of two worn solids."""
        return condensed.two_solids(self.law, self.opening)

    @cached_property
    def rate_at_wear(self) -> Judgement:
        """Eq. (10) in terms of kappa, q, g and p_1."""
        ratio_of_wears = defined(kappa, K_a * H_c / (K_c * H_a))
        proportional = substitute(self.problem.rigid, Solve(K_a)(ratio_of_wears))
        claim = sp.Eq(rate("u_c"), K_c * V / (3 * H_c) * p_max * self.law.ratio(closure_ratio))
        return Consequence(claim)(proportional, *self.definitions, self.rough, name="wear rate")

    @cached_property
    def unbounded(self) -> Judgement:
        """Wear grows without bound."""
        return unbounded(self.rate_at_wear, *self.facts, assume(BOUNDED_LOAD), name="growth")

    @cached_property
    def ratio(self) -> Judgement:
        """h/sigma tends to g/q."""
        claim = sp.Eq(forever(closure_ratio), g / q)
        return AtInfinity(claim, 1 / u_c)(
            self.unbounded, self.rough, name="limit of h/sigma, two solids"
        )

    @cached_property
    def rate(self) -> Judgement:
        """The steady wear rate."""
        claim = sp.Eq(forever(rate("u_c")), K_c * V / (3 * H_c) * p_max * self.law.ratio(g / q))
        return Passes(claim)(self.rate_at_wear, self.ratio, name="steady wear rate")

    @cached_property
    def first_order(self) -> Judgement:
        """The first-order deviation of h/sigma from its limit."""
        offset = (h_0 - U_a) / q - g * p_1 / q**3
        claim = sp.Eq(forever(u_c * (closure_ratio - g / q) - offset), 0)
        return AtInfinity(claim, 1 / u_c)(self.unbounded, self.rough, name="approach of h/sigma")

    @cached_property
    def drift(self) -> Judgement:
        """The coefficient of ln t in the wear."""
        parents = (self.rate_at_wear, self.first_order, self.ratio, self.rate)
        return drift(first_order(*parents))


_printed = TwoSolids()
two_solids = _printed.definitions
two_solids_opening = TwoSolids(opening=True).definitions
two_solids_roughness = _printed.rough, _printed.squares
two_solids_closure_ratio = _printed.ratio
two_solids_rate = _printed.rate
two_solids_log_drift = _printed.drift
