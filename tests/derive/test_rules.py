"""The rules refuse what their theorems do not cover, and name the premise that is missing.

Every refusal is a statement that is false, with a model in which it fails in the comment; beside it
stands a true one, with the missing premise stated.
"""

from __future__ import annotations

from collections.abc import Callable

import pytest
import sympy as sp

from derive.claims import Drift, FirstZero, Oscillation, Term
from derive.hypotheses import Hypothesis, Kind
from derive.kernel import Judgement, RuleError, infer, replayed
from derive.laws import GENERAL, ContactLaw, r
from derive.results.expansion import Expansion
from derive.results.steady_state import BOUNDED_LOAD, steady_state
from derive.rules.algebra import (
    Alike,
    Consequence,
    Identity,
    Insert,
    Logarithm,
    Multiply,
    Solve,
    Substitute,
    discharge,
    forget,
    restrict,
    substitute,
)
from derive.rules.assumption import assume, defined
from derive.rules.averages import EXPANSION, OFFSET, SATURATION, Averaging, SlowTime, term_of
from derive.rules.calculus import (
    SPRINGS,
    ParameterLimit,
    change_clock,
    differentiate,
    grows,
    integrate,
    rigid,
)
from derive.rules.data import Differentiated, OneSign
from derive.rules.drift import (
    MEAN,
    LastCycles,
    LogarithmicGrowth,
    first_order,
    logarithmic_drift,
)
from derive.rules.inequalities import (
    Arithmetic,
    Lipschitz,
    LogarithmicSlope,
    Monotone,
    Threshold,
)
from derive.rules.limits import (
    AtInfinity,
    Diverges,
    Passes,
    accumulates,
    forever,
    later,
    one_period_later,
    unbounded,
    vanishes,
)
from derive.rules.proving import sign
from derive.rules.reading import CONSTANT, CONTINUOUS, PERIODIC, SINE
from derive.rules.solutions import FirstRoot, Inverted, Parametric, Solution
from derive.symbols import initial, rate, symbol, symbols, t
from derive.zero import is_zero

u_c, u_a, U_a, U_c, h, p, G, G_inf = symbols("u_c u_a U_a U_c h p G G_inf")
h_0, sigma_c0, f_c, C, T, N, q, L, k = symbols("h_0 sigma_c0 f_c C T N q L k")
U, U_mean, M, u_cum, kappa, omega, theta, x_inf = symbols(
    "U U_mean M u_cum kappa omega theta x_inf"
)
p_max, U_max, h_star, epsilon, tau, b, R_a = symbols("p_max U_max h_star epsilon tau b R_a")
sigma = symbol("sigma")
y = sp.Symbol("y", real=True)


def given(relation: sp.Basic, text: str = "known") -> Judgement:
    return assume(Hypothesis(text, relation, kind=Kind.STATE))


def tends(expr: sp.Expr, value: sp.Expr, point: sp.Expr = sp.oo) -> Judgement:
    return given(sp.Eq(sp.Limit(expr, t, point), value, evaluate=False))


START = given(sp.Eq(initial("u_c"), 0))
BOUNDED = assume(BOUNDED_LOAD)
DEEP = tends(u_c, sp.oo)
ROUGHENS = given(sp.Gt(f_c, 0))
ABOVE = given(sp.Gt(h, f_c))

Case = tuple[Callable[[], Judgement], Callable[[], Judgement]]

CASES: dict[str, Case] = {
    # ---- relations and algebra
    "u_a >= h_0 is no equation": (  # 2 >= 1
        lambda: substitute(given(sp.Eq(h, u_a)), given(sp.Ge(u_a, h_0))),
        lambda: substitute(given(sp.Eq(h, u_a)), given(sp.Eq(u_a, h_0))),
    ),
    "u_a != h_0 is no equation": (
        lambda: substitute(given(sp.Eq(h, u_a)), given(sp.Ne(u_a, h_0))),
        lambda: substitute(given(sp.Ne(h, u_a)), given(sp.Eq(u_a, h_0))),
    ),
    "an inequality is not solved": (
        lambda: Solve(u_a)(given(sp.Ge(u_a, h_0))),
        lambda: Solve(h_0)(given(sp.Eq(u_a, h_0))),
    ),
    "an inequality times a factor of either sign": (  # f_c = -1
        lambda: Multiply(f_c)(given(sp.Ge(u_a, h_0))),
        lambda: Multiply(q)(given(sp.Ge(u_a, h_0))),
    ),
    "f_c u_a = f_c h_0 at f_c = 0": (
        lambda: Solve(u_a)(given(sp.Eq(f_c * u_a, f_c * h_0))),
        lambda: Solve(u_a)(given(sp.Eq(f_c * u_a, f_c * h_0)), ROUGHENS),
    ),
    "divided by what may vanish": (
        lambda: Multiply(1 / f_c)(given(sp.Eq(h, u_a))),
        lambda: Multiply(1 / f_c)(given(sp.Eq(h, u_a)), ROUGHENS),
    ),
    "solved under a derivative": (  # G = 1 - e^-t
        lambda: Solve(G)(given(sp.Eq(T * rate("G") + G, theta))),
        lambda: Solve(rate("G"))(given(sp.Eq(T * rate("G") + G, theta))),
    ),
    "a claim with more parts than the premise": (  # u_a = 2, L = 1
        lambda: Consequence(sp.And(sp.Le(-G, h_0), sp.Lt(u_a, L)))(
            given(sp.Le(-G, L)), given(sp.Eq(L, h_0))
        ),
        lambda: Consequence(sp.Le(-G, h_0))(given(sp.Le(-G, L)), given(sp.Eq(L, h_0))),
    ),
    # ---- special cases: the value stays a hypothesis
    "a hypothesis that is not met is dropped": (
        lambda: discharge(
            Solve(u_a)(given(sp.Eq(f_c * u_a, h_0)), ROUGHENS), ROUGHENS.hypotheses[0], START
        ),
        lambda: discharge(
            Solve(u_a)(given(sp.Eq(f_c * u_a, h_0)), ROUGHENS),
            ROUGHENS.hypotheses[0],
            given(sp.Eq(f_c, 1)),
        ),
    ),
    "a hypothesis discharged by itself": (
        lambda: discharge(ROUGHENS, ROUGHENS.hypotheses[0], ROUGHENS),
        lambda: discharge(ROUGHENS, ROUGHENS.hypotheses[0], given(sp.Gt(f_c, 1))),
    ),
    "a value forgotten that the claim still has": (
        lambda: forget(given(sp.Eq(f_c, 1)), given(sp.Eq(f_c, 1)).hypotheses[0]),
        lambda: forget(
            discharge(
                substitute(ABOVE, given(sp.Eq(f_c, 1))),
                ABOVE.hypotheses[0],
                given(sp.Eq(f_c, 1)),
                given(sp.Gt(h, 1)),
            ),
            given(sp.Eq(f_c, 1)).hypotheses[0],
        ),
    ),
    # ---- integrals and limits of a parameter
    "an inequality between rates is no equation": (  # f_c = 1, u_a = t, u_c = 2 t
        lambda: integrate(
            given(sp.Ge(rate("u_c"), f_c * rate("u_a"))), START, given(sp.Eq(initial("u_a"), 0))
        ),
        lambda: integrate(
            given(sp.Eq(rate("u_c"), f_c * rate("u_a"))), START, given(sp.Eq(initial("u_a"), 0))
        ),
    ),
    "a second derivative": (
        lambda: integrate(
            given(sp.Eq(rate("u_c"), T * sp.Derivative(u_a, (t, 2)))),
            START,
            given(sp.Eq(initial("u_a"), 0)),
        ),
        lambda: integrate(
            given(sp.Eq(rate("u_c"), T * rate("u_a") / T)), START, given(sp.Eq(initial("u_a"), 0))
        ),
    ),
    "an initial value that is only bounded": (  # u_c(0) = 5 h_0
        lambda: integrate(
            given(sp.Eq(rate("u_c"), f_c * rate("u_a"))),
            given(sp.Ge(initial("u_c"), h_0)),
            given(sp.Eq(initial("u_a"), 0)),
        ),
        lambda: integrate(
            given(sp.Eq(rate("u_c"), f_c * rate("u_a"))),
            given(sp.Eq(initial("u_c"), h_0)),
            given(sp.Eq(initial("u_a"), 0)),
        ),
    ),
    "a derivative with respect to a parameter": (
        lambda: integrate(
            given(sp.Eq(sp.Derivative(u_c, f_c), sp.Derivative(u_a, f_c))),
            START,
            given(sp.Eq(initial("u_a"), 0)),
        ),
        lambda: integrate(
            given(sp.Eq(rate("u_c"), rate("u_a"))), START, given(sp.Eq(initial("u_a"), 0))
        ),
    ),
    "f_c N/(1 + f_c N) for N -> oo": (  # f_c = 0
        lambda: ParameterLimit(f_c * N / (1 + f_c * N), N)(),
        lambda: ParameterLimit(f_c * N / (1 + f_c * N), N)(ROUGHENS),
    ),
    "h_0^(1/N) for N -> oo": (  # h_0 = 0
        lambda: ParameterLimit(h_0 ** (1 / N), N)(),
        lambda: ParameterLimit(h_0 ** (1 / N), N)(given(sp.Gt(h_0, 0))),
    ),
    "floor(2 - 1/N) for N -> oo": (
        lambda: ParameterLimit(sp.floor(2 - 1 / N), N)(),
        lambda: ParameterLimit(2 - 1 / N, N)(),
    ),
    "k -> oo with U_c held fixed": (  # R_a = k b L (U_c - U)
        lambda: rigid(given(sp.Eq(R_a, k * b * L * (U_c - U)))),
        lambda: rigid(substitute(given(sp.Eq(h, h_0 + U_c - U_a)), Solve(U_c)(assume(SPRINGS)))),
    ),
    "k -> oo under a bounded load": (
        lambda: rigid(
            Insert(sp.Eq(h, h_0 + p / k - U_a))(
                given(sp.Eq(h, h_0 + U_c - U_a)), Solve(U_c)(assume(SPRINGS)), BOUNDED
            )
        ),
        lambda: rigid(
            Insert(sp.Eq(h, h_0 + p / k - U_a))(
                given(sp.Eq(h, h_0 + U_c - U_a)), Solve(U_c)(assume(SPRINGS))
            )
        ),
    ),
    # ---- divergence
    "bounded below by a constant": (  # u_c = h_0
        lambda: Diverges(u_c)(given(sp.Ge(u_c, h_0))),
        lambda: Diverges(u_c)(given(sp.Ge(u_c, h_0 + C * t))),
    ),
    "sigma_c0 + f_c u_c for any f_c": (  # f_c = -0.05
        lambda: Diverges(sigma_c0 + f_c * u_c)(given(sp.Ge(u_c, C * t))),
        lambda: Diverges(sigma_c0 + f_c * u_c)(given(sp.Ge(u_c, C * t)), ROUGHENS),
    ),
    "u_c - C t": (  # u_c = C t
        lambda: Diverges(u_c - C * t)(given(sp.Ge(u_c, C * t))),
        lambda: Diverges(u_c - h_0)(given(sp.Ge(u_c, C * t))),
    ),
    "a rate that fades with time": (  # u_c < C T
        lambda: unbounded(given(sp.Eq(rate("u_c"), C / (1 + t / T) ** 2))),
        lambda: unbounded(given(sp.Eq(rate("u_c"), C / (1 + u_c**2 / h_star**2)))),
    ),
    "a rate under an unbounded load": (  # U_a = h_star t/T
        lambda: unbounded(given(sp.Eq(rate("u_c"), C * sp.exp(-U_a / h_star)))),
        lambda: unbounded(given(sp.Eq(rate("u_c"), C * sp.exp(-U_a / h_star))), BOUNDED),
    ),
    "a positive field that fades": (  # sigma = h_star e^(-t/T)
        lambda: unbounded(
            given(sp.Eq(rate("u_c"), C * sigma / h_star)), given(sp.Le(sigma, h_star))
        ),
        lambda: unbounded(
            given(sp.Eq(rate("u_c"), C * (1 + sigma / h_star))), given(sp.Le(sigma, h_star))
        ),
    ),
    "a rate that is not continuous": (
        lambda: unbounded(
            given(
                sp.Eq(
                    rate("u_c"),
                    sp.Piecewise((C, u_c < h_star), (C / (1 + u_c**2 / h_star**2), True)),
                )
            )
        ),
        lambda: unbounded(given(sp.Eq(rate("u_c"), C))),
    ),
    # ---- limits in time
    "h/u_c with h held fixed": (  # h = u_c
        lambda: AtInfinity(sp.Eq(forever(h / u_c), 0), 1 / u_c)(DEEP),
        lambda: AtInfinity(sp.Eq(forever(U_a / u_c), 0), 1 / u_c)(DEEP, BOUNDED),
    ),
    "T u_c'/u_c": (  # u_c = L e^(t/T)
        lambda: AtInfinity(sp.Eq(forever(T * rate("u_c") / u_c), 0), 1 / u_c)(DEEP),
        lambda: Passes(sp.Eq(forever(rate("u_c") / u_c), 0))(tends(rate("u_c"), C), DEEP),
    ),
    "U_a has no limit": (  # U sin t
        lambda: AtInfinity(sp.Eq(forever(U_a + h_0**2 / u_c), U_a), 1 / u_c)(DEEP, BOUNDED),
        lambda: AtInfinity(sp.Eq(forever(h_0 + U_a * h_0 / u_c), h_0), 1 / u_c)(DEEP, BOUNDED),
    ),
    "a squeeze between constants": (  # u_c = h_0, G = 1
        lambda: vanishes(
            given(sp.And(sp.Le(G, h_0 / u_c), sp.Ge(G, -h_0 / u_c))), given(sp.Ge(u_c, h_0))
        ),
        lambda: vanishes(given(sp.And(sp.Le(G, h_0 / u_c), sp.Ge(G, -h_0 / u_c))), DEEP),
    ),
    "u_c G/(h_0 + u_c G)": (  # G = h_0/u_c
        lambda: Passes(sp.Eq(forever(G / (h_0 / u_c + G)), 1))(tends(G, 0), DEEP),
        lambda: Passes(sp.Eq(forever(G / (h_0 / u_c + G)), 1))(
            tends(G, theta), DEEP, given(sp.Ne(theta, 0))
        ),
    ),
    "e^(-u_c G/h_0)": (  # G = h_0/u_c
        lambda: Passes(sp.Eq(forever(sp.exp(-u_c * G / h_0)), 1))(tends(G, 0), DEEP),
        lambda: Passes(sp.Eq(forever(sp.exp(-G)), 1))(tends(G, 0)),
    ),
    "a limit that is only bounded": (  # u_c = 2 C t
        lambda: accumulates(given(sp.Ge(sp.Limit(rate("u_c"), t, sp.oo), C))),
        lambda: accumulates(tends(rate("u_c"), C)),
    ),
    "the limit of the second derivative": (  # u_c = V t
        lambda: accumulates(tends(sp.Derivative(u_c, (t, 2)), 0)),
        lambda: accumulates(tends(rate("u_c"), 0)),
    ),
    "a limit at t = 0": (  # u_c = C T (1 - e^(-t/T))
        lambda: accumulates(tends(rate("u_c"), C, sp.S.Zero)),
        lambda: accumulates(tends(rate("u_c"), C)),
    ),
    "lim u_c <= oo": (
        lambda: AtInfinity(sp.Eq(forever(U_a / u_c), 0), 1 / u_c)(
            given(sp.Le(sp.Limit(u_c, t, sp.oo), h_0)), BOUNDED
        ),
        lambda: AtInfinity(sp.Eq(forever(U_a / u_c), 0), 1 / u_c)(DEEP, BOUNDED),
    ),
    "a limit at 0 for one at infinity": (  # tanh t
        lambda: Passes(sp.Eq(forever(G), theta))(tends(G, theta, sp.S.Zero)),
        lambda: Passes(sp.Eq(forever(2 * G), 2 * theta))(tends(G, theta)),
    ),
    "a sign is not continuous": (
        lambda: Passes(sp.Eq(forever(sp.sign(G)), 0))(tends(G, 0)),
        lambda: Passes(sp.Eq(forever(sp.tanh(G)), 0))(tends(G, 0)),
    ),
    # ---- bounds
    "a derivative with respect to the period": (  # G = omega T
        lambda: grows(given(sp.Ge(sp.Derivative(G, T), omega)), given(sp.Eq(initial("G"), 0))),
        lambda: grows(given(sp.Ge(rate("G"), omega)), given(sp.Eq(initial("G"), 0))),
    ),
    "the bound of a second derivative": (
        lambda: grows(given(sp.Ge(sp.Derivative(u_c, (t, 2)), C / T)), START),
        lambda: grows(given(sp.Ge(rate("u_c"), C / T)), START),
    ),
    "a start that is only bounded": (  # u_c(0) = 0
        lambda: grows(given(sp.Ge(rate("u_c"), C)), given(sp.Le(initial("u_c"), h_0))),
        lambda: grows(given(sp.Ge(rate("u_c"), C)), given(sp.Eq(initial("u_c"), h_0))),
    ),
    "a bound that varies": (
        lambda: grows(given(sp.Ge(rate("u_c"), C * u_c / h_0)), START),
        lambda: grows(given(sp.Ge(rate("u_c"), C)), START),
    ),
    "a function that jumps": (  # 0, -1/2
        lambda: Monotone(sp.Lambda(y, sp.Piecewise((y, y < 0), (y - 1, True))))(
            given(sp.Ge(x_inf, theta))
        ),
        lambda: Monotone(sp.Lambda(y, y - 1))(given(sp.Ge(x_inf, theta))),
    ),
    "a jump where no sample lies": (
        lambda: Monotone(sp.Lambda(y, sp.Piecewise((y, y < 1000), (y - 2000, True))))(
            given(sp.Ge(x_inf, theta))
        ),
        lambda: Monotone(sp.Lambda(y, 2 * y))(given(sp.Ge(x_inf, theta))),
    ),
    "tan": (  # 2, 1
        lambda: Monotone(sp.Lambda(y, sp.tan(y)))(given(sp.Ge(x_inf, theta))),
        lambda: Monotone(sp.Lambda(y, sp.tanh(y)))(given(sp.Ge(x_inf, theta))),
    ),
    "-1/x across its pole": (  # 1, -1
        lambda: Monotone(sp.Lambda(y, -1 / y))(given(sp.Ge(x_inf, theta))),
        lambda: Monotone(sp.Lambda(y, -1 / y))(given(sp.Ge(h_0 + q, q, evaluate=False))),
    ),
    "the slope of any law as a function": (  # phi = e^-r
        lambda: Monotone(sp.Lambda(y, sp.diff(GENERAL.phi, r).subs(r, y)))(
            given(sp.Ge(-q, -2 * q, evaluate=False))
        ),
        lambda: Monotone(sp.Lambda(y, GENERAL.phi.subs(r, y)))(
            given(sp.Ge(-q, -2 * q, evaluate=False))
        ),
    ),
    "a slope that is too steep": (
        lambda: infer(Lipschitz(sp.Lambda(y, -2 * y), theta, q, L)),
        lambda: infer(Lipschitz(sp.Lambda(y, -y), theta, q, L)),
    ),
    "a step of either sign": (
        lambda: infer(Lipschitz(sp.Lambda(y, -y), theta, f_c, L)),
        lambda: infer(Lipschitz(sp.Lambda(y, -y), theta, f_c, L), ROUGHENS),
    ),
    "a slope of the logarithm beyond its bound": (
        lambda: infer(LogarithmicSlope(sp.Lambda(y, 1 + sp.tanh(y)), theta, q, sp.S.One)),
        lambda: infer(LogarithmicSlope(sp.Lambda(y, 1 + sp.tanh(y)), theta, q, sp.Integer(2))),
    ),
    # ---- data and signs
    "a name that has f_c inside": (  # theta = tanh(4 - 2/f_c)
        lambda: Differentiated(sp.Eq(sp.Derivative(u_cum, f_c), 0, evaluate=False), f_c)(
            defined(u_cum, M * (1 + theta) / 2)
        ),
        lambda: Differentiated(sp.Eq(sp.Derivative(u_cum, h_0), 2 * h_0, evaluate=False), h_0)(
            defined(u_cum, h_0**2)
        ),
    ),
    "the derivative of a bound": (  # u_cum = 5 M
        lambda: Differentiated(sp.Eq(sp.Derivative(u_cum, f_c), h_0, evaluate=False), f_c)(
            given(sp.Ge(u_cum, h_0 * f_c))
        ),
        lambda: Differentiated(sp.Eq(sp.Derivative(u_cum, f_c), h_0, evaluate=False), f_c)(
            defined(u_cum, h_0 * f_c)
        ),
    ),
    "the derivative at a fixed value": (
        lambda: Differentiated(sp.Eq(sp.Derivative(u_cum, f_c), 0, evaluate=False), f_c)(
            substitute(
                substitute(defined(u_cum, h_0 * f_c), given(sp.Eq(f_c, 1))),
                given(sp.Eq(h_0, 2)),
            )
        ),
        lambda: Differentiated(sp.Eq(sp.Derivative(u_cum, f_c), h_0, evaluate=False), f_c)(
            defined(u_cum, h_0 * f_c)
        ),
    ),
    "the arcsine of a sine": (  # omega T = 2
        lambda: Insert(sp.Eq(T, sp.asin(kappa - 1) / omega))(
            given(sp.Eq(kappa, 1 + sp.sin(omega * T)))
        ),
        lambda: Insert(sp.Eq(T, (kappa - 1) / omega))(given(sp.Eq(kappa, 1 + omega * T))),
    ),
    "U_max > 0": (
        lambda: Arithmetic(sp.Gt(U_max, 0))(),
        lambda: Arithmetic(sp.Gt(U_max, 0))(given(sp.Gt(U_max, h_0))),
    ),
    "f_c > -1": (
        lambda: Arithmetic(sp.Gt(f_c, -1))(),
        lambda: Arithmetic(sp.Gt(f_c, -1))(ROUGHENS),
    ),
    "p < 10^6 p_max": (
        lambda: Arithmetic(sp.Lt(p, 10**6 * p_max))(),
        lambda: Arithmetic(sp.Lt(p, 10**6 * p_max))(given(sp.Lt(p, p_max))),
    ),
    "the effect of a datum of either sign": (
        lambda: OneSign(h_0)(given(sp.Eq(rate("u_c"), C * f_c * h_0))),
        lambda: OneSign(h_0)(given(sp.Eq(rate("u_c"), C * f_c * h_0)), ROUGHENS),
    ),
    # ---- identities
    "|f_c| = f_c": (
        lambda: Identity(sp.Eq(sp.Abs(f_c), f_c))(),
        lambda: Identity(sp.Eq(sp.Abs(f_c) ** 2, f_c**2, evaluate=False))(),
    ),
    "log(x^2) = 2 log(x)": (
        lambda: Identity(sp.Eq(sp.log(x_inf**2), 2 * sp.log(x_inf)))(),
        lambda: Identity(sp.Eq(sp.log(2 * q), sp.log(2) + sp.log(q), evaluate=False))(),
    ),
    "W(x e^x) = x": (
        lambda: Identity(sp.Eq(sp.LambertW(theta * sp.exp(theta)), theta))(),
        lambda: Identity(sp.Eq(theta * sp.exp(theta) * sp.exp(-theta), theta, evaluate=False))(),
    ),
    "atan(tan x) = x": (
        lambda: Identity(sp.Eq(sp.atan(sp.tan(theta)), theta))(),
        lambda: Identity(sp.Eq(sp.tanh(-theta), -sp.tanh(theta), evaluate=False))(),
    ),
    "(f_c^2 - 1)/(f_c - 1) at f_c = 1": (
        lambda: Identity(sp.Eq((f_c**2 - 1) / (f_c - 1), f_c + 1))(),
        lambda: Identity(sp.Eq((f_c**2 - 1) / (f_c - 1), f_c + 1))(given(sp.Ne(f_c, 1))),
    ),
    "the logarithm of a bound": (  # kappa = 5, f_c = 0.1
        lambda: Logarithm(sp.Eq(sp.log(kappa), f_c))(given(sp.Ge(kappa, sp.exp(f_c)))),
        lambda: Logarithm(sp.Eq(sp.log(kappa), f_c))(given(sp.Eq(kappa, sp.exp(f_c)))),
    ),
    "0/0": (  # h = u_a
        lambda: Insert(sp.Eq((h - u_a) / (u_c - h_0), 1, evaluate=False))(
            given(sp.Eq(u_c, h_0 + h - u_a))
        ),
        lambda: Insert(sp.Eq((h - u_a) / (u_c - h_0), 1, evaluate=False))(
            given(sp.Eq(u_c, h_0 + h - u_a)), given(sp.Ne(u_c, h_0))
        ),
    ),
    "a bound inserted as an equation": (
        lambda: Insert(sp.Eq(u_a, h_0))(given(sp.Le(u_a, h_0))),
        lambda: Insert(sp.Eq(u_a, h_0))(given(sp.Eq(u_a, h_0))),
    ),
    # ---- solutions
    "a load that varies": (  # U_a = t
        lambda: Solution(sp.Eq(t, u_c * h_star / (C * U)))(
            given(sp.Eq(rate("u_c"), C * U / h_star)), START
        ),
        lambda: Solution(sp.Eq(t, u_c * h_star / (C * U)))(
            given(sp.Eq(rate("u_c"), C * U / h_star)), START, assume(CONSTANT)
        ),
    ),
    "the wrong branch of W": (  # u_c = 3 h_star
        lambda: Inverted(sp.Eq(u_c, -h_star * sp.LambertW(-t / T)))(
            given(sp.Eq(t, T * u_c / h_star * sp.exp(-u_c / h_star)))
        ),
        lambda: Inverted(sp.Eq(u_c, h_star * t / T))(given(sp.Eq(t, T * u_c / h_star))),
    ),
    "a multiple of the rate": (  # u_c = C t/2
        lambda: Solution(sp.Eq(t, u_c / C))(
            given(sp.Eq(2 * rate("u_c"), C)), START, assume(CONSTANT)
        ),
        lambda: Solution(sp.Eq(t, u_c / C))(given(sp.Eq(rate("u_c"), C)), START, assume(CONSTANT)),
    ),
    "the bound of a rate": (  # u_c = 2 C t
        lambda: Solution(sp.Eq(t, u_c / C))(given(sp.Ge(rate("u_c"), C)), START, assume(CONSTANT)),
        lambda: Solution(sp.Eq(t, u_c / C))(given(sp.Eq(rate("u_c"), C)), START, assume(CONSTANT)),
    ),
    "the rate of one solid and the wear of the other": (
        lambda: Parametric(sp.Eq(t, (p - initial("p")) * h_0 / (C * p_max)))(
            given(sp.Eq(rate("u_a"), C)),
            given(sp.Eq(u_c, h_0 * (p - initial("p")) / p_max)),
            START,
            assume(CONSTANT),
        ),
        lambda: Solution(sp.Eq(t, u_c / C))(given(sp.Eq(rate("u_c"), C)), START, assume(CONSTANT)),
    ),
    # ---- logic
    "u_a <= h_0 if and only if u_a < h_0": (
        lambda: Alike(sp.Equivalent(sp.Le(u_a, h_0), sp.Lt(u_a, h_0)))(),
        lambda: Alike(sp.Equivalent(sp.Le(u_a, h_0), sp.Le(u_a - h_0, 0)))(),
    ),
    "strict if and only if not strict": (
        lambda: Threshold(sp.Equivalent(sp.Gt(2 * f_c, epsilon), sp.Ge(f_c, epsilon / 2)), f_c)(
            ROUGHENS
        ),
        lambda: Threshold(sp.Equivalent(sp.Gt(2 * f_c, epsilon), sp.Gt(f_c, epsilon / 2)), f_c)(
            ROUGHENS
        ),
    ),
    "a threshold for a slope of either sign": (  # f_c = -0.04
        lambda: Threshold(sp.Equivalent(sp.Gt(f_c**2, epsilon**2), sp.Gt(f_c, epsilon)), f_c)(),
        lambda: Threshold(sp.Equivalent(sp.Gt(f_c**2, epsilon**2), sp.Gt(f_c, epsilon)), f_c)(
            ROUGHENS
        ),
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_what_is_false_is_refused_and_a_true_neighbour_is_not(name: str) -> None:
    false, true = CASES[name]
    with pytest.raises(
        RuleError, match=r"missing premise|cannot|does not occur|no (rate|value|kind)"
    ):
        false()
    assert replayed(true()) is None


def drift_premises(**changed: sp.Expr) -> tuple[Judgement, ...]:
    approach = changed.get("approach", t * (rate("u_c") - C) - f_c * U_a)
    return (
        tends(approach, sp.S.Zero),
        assume(PERIODIC),
        assume(CONTINUOUS),
        defined(MEAN.lhs, MEAN.rhs),
    )


@pytest.mark.parametrize("dropped", [1, 2, 3])
def test_a_drift_needs_a_periodic_continuous_load_and_its_mean(dropped: int) -> None:
    """A bounded load 1 - e^(-t/T) has a mean over its first period that is not its limit."""
    premises = drift_premises()
    found = logarithmic_drift(*premises).claim
    assert found.value == f_c * U_mean
    with pytest.raises(RuleError, match="missing premise"):
        logarithmic_drift(*premises[:dropped], *premises[dropped + 1 :])


@pytest.mark.parametrize(
    "approach",
    [
        t * (rate("u_c") - C) - U_a**2 / U,
        t**2 * (rate("u_c") - C) - f_c * U_a,
        t * (rate("u_c") - C) - u_a,
    ],
)
def test_a_drift_needs_its_form(approach: sp.Expr) -> None:
    with pytest.raises(RuleError, match="linear in the load"):
        logarithmic_drift(*drift_premises(approach=approach))


def test_the_approach_of_a_rate_needs_a_bounded_load() -> None:
    """U_a = sqrt t would give another limit: -3/2."""
    law = given(sp.Eq(rate("u_c"), C * sp.exp(-(h - U_a) / sigma_c0)))
    ratio, speed = tends((h - U_a) / sigma_c0, q), tends(rate("u_c"), C * sp.exp(-q))
    deviation = tends(u_c * ((h - U_a) / sigma_c0 - q) - U_a, 0)
    assert replayed(first_order(law, deviation, ratio, speed, BOUNDED)) is None
    with pytest.raises(RuleError, match="missing premise: U_a is bounded"):
        first_order(law, deviation, ratio, speed)


@pytest.mark.parametrize("dropped", [0, 1])
def test_logarithmic_growth_needs_its_tail_and_a_sine_load(dropped: int) -> None:
    """A square load has the mean cosh z, not I_0."""
    grown = rate("u_c") * sp.exp((u_c - U_a) / sigma_c0)
    premises = [tends(grown, C), assume(SINE)]
    assert replayed(LogarithmicGrowth(sigma_c0)(*premises)) is None
    premises[dropped] = START
    with pytest.raises(RuleError, match="missing premise"):
        LogarithmicGrowth(sigma_c0)(*premises)


def expansion_premises(name: str, kind: type[Term] = Drift, n: int = 1) -> tuple[Judgement, ...]:
    """Return the pressure, the load, b_0, theta and a name for a coefficient of the expansion."""
    pressure = steady_state().pressure_at_wear
    named = defined(symbol(name), term_of(kind, n, pressure.claim.rhs))
    return pressure, assume(SINE), defined(*OFFSET.args), defined(*SATURATION.args), named


FIRST_DRIFT = 2 * (1 - theta) * symbol("b_0")


@pytest.mark.parametrize("name", ["c_1", "A"])
def test_a_formula_of_the_expansion_belongs_to_the_name_defined_as_it(name: str) -> None:
    """A = the formula of c_1 holds where A is a name for c_1, and nowhere else."""
    premises = expansion_premises(name)
    found = Averaging(sp.Eq(symbol(name), FIRST_DRIFT))(*premises)
    assert replayed(found) is None
    assert premises[-1].hypotheses[0] in found.hypotheses
    other = {"c_1": "A", "A": "c_1"}[name]
    missing = f"missing premise: {other} is a coefficient of the expansion, by definition"
    with pytest.raises(RuleError, match=missing):
        Averaging(sp.Eq(symbol(other), FIRST_DRIFT))(*premises)


@pytest.mark.parametrize("dropped", [1, 2, 3, 4])
def test_a_term_of_the_expansion_needs_each_premise(dropped: int) -> None:
    premises = expansion_premises("c_1")
    with pytest.raises(RuleError, match="missing premise"):
        Averaging(sp.Eq(symbol("c_1"), FIRST_DRIFT))(*premises[:dropped], *premises[dropped + 1 :])


@pytest.mark.parametrize(("kind", "n"), [(Drift, 2), (Drift, 5)])
def test_a_formula_of_the_expansion_is_not_that_of_another_term(kind: type[Term], n: int) -> None:
    with pytest.raises(RuleError, match="missing premise: c_1 "):
        Averaging(sp.Eq(symbol("c_1"), FIRST_DRIFT))(*expansion_premises("c_1", kind, n))


def test_an_oscillation_is_no_constant() -> None:
    with pytest.raises(RuleError, match="is constant"):
        expansion_premises("c_1", Oscillation)


def test_a_term_of_the_expansion_is_that_of_the_given_pressure() -> None:
    *premises, _ = expansion_premises("c_1")
    foreign = defined(symbol("c_1"), term_of(Drift, 1, premises[0].claim.rhs.subs(h_0, 2 * h_0)))
    with pytest.raises(RuleError, match="of this pressure"):
        Averaging(sp.Eq(symbol("c_1"), FIRST_DRIFT))(*premises, foreign)


def test_the_slow_time_is_rho_tau_and_needs_the_drifts() -> None:
    with pytest.raises(RuleError, match="c_3 and c_4"):
        SlowTime(sp.Eq(L, symbol("m")))()
    known = Expansion().slow_time.claim
    claim = sp.Eq(known.lhs, known.rhs)
    drifts = [expansion_premises(f"c_{n}", Drift, n)[-1] for n in (1, 2, 3, 4)]
    assert replayed(SlowTime(claim)(*drifts, assume(EXPANSION))) is None
    with pytest.raises(RuleError, match="m is the averaged roughness"):
        SlowTime(claim)(*drifts)
    with pytest.raises(RuleError, match="dtau/dm"):
        SlowTime(sp.Eq(L, claim.rhs))(*drifts, assume(EXPANSION))
    values = [defined(symbol(f"c_{n}"), sp.S.Zero) for n in (1, 2, 3, 4)]
    with pytest.raises(RuleError, match="c_3 and c_4"):
        SlowTime(claim)(*values, assume(EXPANSION))


def test_a_first_zero_needs_its_definition() -> None:
    """u_stop = h_star for a function of the caller's."""
    x = sp.Symbol("x", positive=True)
    u_stop = symbol("u_stop")
    meaning = defined(u_stop, FirstZero(h_star - x, x))
    assert FirstRoot(sp.S.One)(meaning).claim.rhs == h_star
    for wrong in (given(sp.Eq(u_stop, h_star)), given(sp.Ge(u_stop, h_star))):
        with pytest.raises(RuleError, match=r"definition of a first zero|no equality"):
            FirstRoot(sp.S.One)(wrong)
    with pytest.raises(RuleError, match="missing premise"):
        FirstRoot(h_star - x)(meaning)


def test_the_last_cycles_need_a_constant_load() -> None:
    with pytest.raises(RuleError, match="missing premise"):
        LastCycles(sp.Eq(sp.log(N), h_star / symbol("sigma_c")))(
            given(sp.Eq(rate("u_c"), C)),
            given(sp.Eq(symbol("sigma_c"), sigma_c0 + f_c * u_c)),
            defined(N, t / T),
            defined(h_star, h_0 - U_a),
        )


def test_a_clock_is_needed_to_scale_a_rate() -> None:
    v = sp.Function("v", real=True)(tau)
    scaled = defined(u_c, sigma_c0 * v)
    assert replayed(change_clock(scaled, defined(t, T * tau))) is None
    for wrong in (defined(t, tau * T * 2), given(sp.Ge(u_c, u_a))):
        with pytest.raises(RuleError, match="missing premise"):
            change_clock(scaled, wrong)


def test_a_piece_is_kept_where_its_relation_holds() -> None:
    law = given(sp.Eq(p, sp.Piecewise((p_max, sp.Le(h, L)), (0, True))))
    assert restrict(law, given(sp.Le(h, L))).claim.rhs == p_max
    with pytest.raises(RuleError, match="has no branch"):
        restrict(law, given(sp.Le(h, 2 * L)))
    assert restrict(given(sp.Eq(h, sp.Abs(f_c))), ROUGHENS).claim.rhs == f_c
    with pytest.raises(RuleError, match="has no branch"):
        restrict(given(sp.Eq(h, sp.Abs(f_c))), given(sp.Lt(f_c, 0)))


def test_special_values_stay_hypotheses() -> None:
    special = substitute(given(sp.Eq(h, f_c * u_a)), given(sp.Eq(f_c, 1)))
    assert sp.Eq(f_c, 1) in {hypothesis.relation for hypothesis in special.hypotheses}


def test_what_varies_is_not_substituted() -> None:
    derivative = given(sp.Eq(sp.Derivative(u_cum, f_c, evaluate=False), h_0, evaluate=False))
    with pytest.raises(RuleError, match="may take every value"):
        infer(Substitute(), derivative, given(sp.Eq(f_c, 1)))


def test_rates_and_later_times_of_what_always_holds() -> None:
    assert differentiate(given(sp.Eq(h, 2 * u_c))).claim.rhs == 2 * rate("u_c")
    with pytest.raises(RuleError, match="missing premise"):
        differentiate(given(sp.Ge(h, 2 * u_c)))
    assert one_period_later(given(sp.Ge(u_c, h_0))).claim.greater == later(u_c)


@pytest.mark.parametrize(
    ("expr", "found"),
    [
        (sp.exp(y), 1),
        (1 + sp.tanh(y), 1),
        (sp.tanh(y) - 2, -1),
        (sp.tanh(y), None),
        (y, None),
        (1 - sp.tanh(y) ** 2, 1),
    ],
)
def test_sign_is_told_only_where_it_is_proved(expr: sp.Expr, found: int | None) -> None:
    assert sign(expr) == found


@pytest.mark.parametrize("shift", [0, 2])
def test_a_law_of_square_roots_has_a_steady_state(shift: int) -> None:
    """Its positivity is no matter of exponentials: a root outweighs what it is of."""
    distance = r - shift
    phi = (1 - distance / sp.sqrt(1 + distance**2)) / 2
    limit = steady_state(ContactLaw("algebraic", phi, sp.Integer(shift), "a test"))
    assert is_zero(limit.pressure.claim.value / symbol("p_max") - phi.subs(r, 1 / symbol("f_c")))
    assert replayed(limit.growth) is None
