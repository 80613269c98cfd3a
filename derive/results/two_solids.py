"""Two worn solids: the steady state, its cases, and the logarithmic drift.

Overview
    With pin wear u_a = kappa u_c the equivalent roughness is a root of a quadratic in u_c,
    sigma^2 = sigma_a0^2 + sigma_c0^2 + 2 p_1 u_c + q^2 u_c^2, and the gap opens by g per wear.
    If wear roughens one of the solids and smooths none, it is unbounded and h/sigma tends to g/q:
    x_inf = 4 - 2 g/q.  (With a negative slope no motion lasts: a roughness would be negative.)
Key results
    TwoSolids.definitions  q, g and p_1
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

from ..hypotheses import BOUNDED_LOAD, NOT_SMOOTHING, Hypothesis
from ..kernel import Judgement
from ..laws import TANH, ContactLaw
from ..note import condensed
from ..note.condensed import CondensedProblem
from ..rules.algebra import Consequence, Solve, substitute
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

ROUGHENED = (Hypothesis(sp.Ge(f_a, 0)), NOT_SMOOTHING, Hypothesis(sp.Gt(f_a + f_c, 0)))
"""Wear smooths neither solid, and roughens one of them."""


@dataclass(frozen=True)
class TwoSolids:
    """The long-time limit of (10) for two worn, rough solids."""

    law: ContactLaw = TANH
    opening: bool = False

    @cached_property
    def definitions(self) -> tuple[Judgement, Judgement, Judgement]:
        """q, g and p_1."""
        return (
            defined(q, sp.sqrt((f_a * kappa) ** 2 + f_c**2), *map(assume, ROUGHENED)),
            defined(g, 1 + kappa if self.opening else 1 - kappa),
            defined(p_1, f_a * kappa * sigma_a0 + f_c * sigma_c0),
        )

    @property
    def facts(self) -> tuple[Judgement, ...]:
        """The premises by which the roughness does not fall."""
        growth = Arithmetic(sp.Ge(p_1, 0))(self.definitions[2], *map(assume, ROUGHENED))
        return growth, worn(self.problem)

    @cached_property
    def rough(self) -> Judgement:
        """The roughness does not fall below its value at the start."""
        least = sigma_a0**2 + sigma_c0**2
        return Arithmetic(sp.Ge(squared, least))(*self.facts, name="lower bound of the roughness")

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
two_solids_roughness = _printed.rough
two_solids_closure_ratio = _printed.ratio
two_solids_rate = _printed.rate
two_solids_log_drift = _printed.drift
