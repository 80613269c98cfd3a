"""The rules refuse what their theorems do not cover, and name the premise that is missing.

Every refusal is a statement that is false, with a model in which it fails in the comment; beside it
stands a true one. What a dropped premise makes false is in `test_premises`.
"""

from __future__ import annotations

from collections.abc import Callable

import pytest
import sympy as sp

from derive.kernel import Judgement, RuleError, infer, replayed
from derive.laws import GENERAL, ContactLaw, r
from derive.results.steady_state import steady_state
from derive.rules.algebra import (
    Alike,
    Consequence,
    Identity,
    Insert,
    Logarithm,
    Multiply,
    Solve,
    discharge,
    forget,
    restrict,
    substitute,
)
from derive.rules.assumption import assume, defined
from derive.rules.averages import Averaging
from derive.rules.calculus import SPRINGS, differentiate, grows, integrate, rigid
from derive.rules.data import Differentiated
from derive.rules.inequalities import Lipschitz, LogarithmicSlope, Monotone, Threshold
from derive.rules.limits import (
    AtInfinity,
    Diverges,
    Passes,
    accumulates,
    later,
    one_period_later,
    unbounded,
    vanishes,
)
from derive.rules.proving import sign
from derive.rules.solutions import Integrated, Lambert, Separate
from derive.symbols import initial, rate, symbol, symbols, t
from derive.zero import is_zero
from tests.derive.judgements import (
    BOUNDED,
    CONSTANTLY,
    DEEP,
    FIRST_DRIFT,
    PIN_START,
    ROUGHENS,
    START,
    end,
    eq,
    equal,
    first_order_terms,
    ge,
    given,
    gt,
    le,
    ne,
    opened,
    tends,
)

u_c, u_a, U_a, U_c, h, p, G = symbols("u_c u_a U_a U_c h p G")
h_0, f_c, C, T, q, L, k = symbols("h_0 f_c C T q L k")
U, M, u_cum, kappa, omega, theta, x_inf = symbols("U M u_cum kappa omega theta x_inf")
p_max, h_star, epsilon, b, R_a = symbols("p_max h_star epsilon b R_a")
sigma, p_s, u_s = symbols("sigma p_s u_s")
y = sp.Symbol("y", real=True)
ABOVE = gt(h, f_c)

WORN = equal(t, sp.Integral(1 / C, (u_s, 0, u_c)))


def integral_over(body: sp.Expr, s: sp.Symbol, low: int = 1) -> Judgement:
    return eq(G, sp.Integral(body, (s, low, 2)))


Case = tuple[Callable[[], Judgement], Callable[[], Judgement]]

CASES: dict[str, Case] = {
    # ---- relations and algebra
    "u_a >= h_0 is no equation": (  # 2 >= 1
        lambda: substitute(eq(h, u_a), ge(u_a, h_0)),
        lambda: substitute(eq(h, u_a), eq(u_a, h_0)),
    ),
    "an inequality is not solved": (
        lambda: Solve(u_a)(ge(u_a, h_0)),
        lambda: Solve(h_0)(eq(u_a, h_0)),
    ),
    "an inequality times a factor of either sign": (  # f_c = -1
        lambda: Multiply(f_c)(ge(u_a, h_0)),
        lambda: Multiply(q)(ge(u_a, h_0)),
    ),
    "solved under a derivative": (  # G = 1 - e^-t
        lambda: Solve(G)(eq(T * rate("G") + G, theta)),
        lambda: Solve(rate("G"))(eq(T * rate("G") + G, theta)),
    ),
    "a claim with more parts than the premise": (  # u_a = 2, L = 1
        lambda: Consequence(sp.And(sp.Le(-G, h_0), sp.Lt(u_a, L)))(le(-G, L), eq(L, h_0)),
        lambda: Consequence(sp.Le(-G, h_0))(le(-G, L), eq(L, h_0)),
    ),
    # ---- special cases: the value stays a hypothesis
    "a hypothesis that is not met is dropped": (
        lambda: discharge(Solve(u_a)(eq(f_c * u_a, h_0), ROUGHENS), ROUGHENS.hypotheses[0], START),
        lambda: discharge(
            Solve(u_a)(eq(f_c * u_a, h_0), ROUGHENS), ROUGHENS.hypotheses[0], eq(f_c, 1)
        ),
    ),
    "a hypothesis discharged by itself": (
        lambda: discharge(ROUGHENS, ROUGHENS.hypotheses[0], ROUGHENS),
        lambda: discharge(ROUGHENS, ROUGHENS.hypotheses[0], gt(f_c, 1)),
    ),
    "a value forgotten that the claim still has": (
        lambda: forget(eq(f_c, 1), eq(f_c, 1).hypotheses[0]),
        lambda: forget(
            discharge(substitute(ABOVE, eq(f_c, 1)), ABOVE.hypotheses[0], eq(f_c, 1), gt(h, 1)),
            eq(f_c, 1).hypotheses[0],
        ),
    ),
    # ---- integrals and limits of a parameter
    "an inequality between rates is no equation": (  # f_c = 1, u_a = t, u_c = 2 t
        lambda: integrate(ge(rate("u_c"), f_c * rate("u_a")), START, PIN_START),
        lambda: integrate(eq(rate("u_c"), f_c * rate("u_a")), START, PIN_START),
    ),
    "a second derivative": (
        lambda: integrate(eq(rate("u_c"), T * sp.Derivative(u_a, (t, 2))), START, PIN_START),
        lambda: integrate(eq(rate("u_c"), T * rate("u_a") / T), START, PIN_START),
    ),
    "an initial value that is only bounded": (  # u_c(0) = 5 h_0
        lambda: integrate(eq(rate("u_c"), f_c * rate("u_a")), ge(initial("u_c"), h_0), PIN_START),
        lambda: integrate(eq(rate("u_c"), f_c * rate("u_a")), eq(initial("u_c"), h_0), PIN_START),
    ),
    "a derivative with respect to a parameter": (
        lambda: integrate(eq(sp.Derivative(u_c, f_c), sp.Derivative(u_a, f_c)), START, PIN_START),
        lambda: integrate(eq(rate("u_c"), rate("u_a")), START, PIN_START),
    ),
    "k -> oo with U_c held fixed": (  # R_a = k b L (U_c - U)
        lambda: rigid(eq(R_a, k * b * L * (U_c - U))),
        lambda: rigid(substitute(eq(h, h_0 + U_c - U_a), Solve(U_c)(assume(SPRINGS)))),
    ),
    "k -> oo under a bounded load": (lambda: rigid(opened(BOUNDED)), lambda: rigid(opened())),
    # ---- divergence
    "bounded below by a constant": (  # u_c = h_0
        lambda: Diverges(u_c)(ge(u_c, h_0)),
        lambda: Diverges(u_c)(ge(u_c, h_0 + C * t)),
    ),
    "u_c - C t": (  # u_c = C t
        lambda: Diverges(u_c - C * t)(ge(u_c, C * t)),
        lambda: Diverges(u_c - h_0)(ge(u_c, C * t)),
    ),
    "a rate that fades with time": (  # u_c < C T
        lambda: unbounded(eq(rate("u_c"), C / (1 + t / T) ** 2)),
        lambda: unbounded(eq(rate("u_c"), C / (1 + u_c**2 / h_star**2))),
    ),
    "a positive field that fades": (  # sigma = h_star e^(-t/T)
        lambda: unbounded(eq(rate("u_c"), C * sigma / h_star), le(sigma, h_star)),
        lambda: unbounded(eq(rate("u_c"), C * (1 + sigma / h_star)), le(sigma, h_star)),
    ),
    "a rate that is not continuous": (
        lambda: unbounded(
            eq(rate("u_c"), sp.Piecewise((C, u_c < h_star), (C / (1 + u_c**2 / h_star**2), True)))
        ),
        lambda: unbounded(eq(rate("u_c"), C)),
    ),
    # ---- limits in time
    "h/u_c with h held fixed": (  # h = u_c
        lambda: AtInfinity(end(h / u_c, 0), 1 / u_c)(DEEP),
        lambda: AtInfinity(end(U_a / u_c, 0), 1 / u_c)(DEEP, BOUNDED),
    ),
    "T u_c'/u_c": (  # u_c = L e^(t/T)
        lambda: AtInfinity(end(T * rate("u_c") / u_c, 0), 1 / u_c)(DEEP),
        lambda: Passes(end(rate("u_c") / u_c, 0))(tends(rate("u_c"), C), DEEP),
    ),
    "U_a has no limit": (  # U sin t
        lambda: AtInfinity(end(U_a + h_0**2 / u_c, U_a), 1 / u_c)(DEEP, BOUNDED),
        lambda: AtInfinity(end(h_0 + U_a * h_0 / u_c, h_0), 1 / u_c)(DEEP, BOUNDED),
    ),
    "a squeeze between constants": (  # u_c = h_0, G = 1
        lambda: vanishes(given(sp.And(sp.Le(G, h_0 / u_c), sp.Ge(G, -h_0 / u_c))), ge(u_c, h_0)),
        lambda: vanishes(given(sp.And(sp.Le(G, h_0 / u_c), sp.Ge(G, -h_0 / u_c))), DEEP),
    ),
    "u_c G/(h_0 + u_c G)": (  # G = h_0/u_c
        lambda: Passes(end(G / (h_0 / u_c + G), 1))(tends(G, 0), DEEP),
        lambda: Passes(end(G / (h_0 / u_c + G), 1))(tends(G, theta), DEEP, ne(theta, 0)),
    ),
    "e^(-u_c G/h_0)": (  # G = h_0/u_c
        lambda: Passes(end(sp.exp(-u_c * G / h_0), 1))(tends(G, 0), DEEP),
        lambda: Passes(end(sp.exp(-G), 1))(tends(G, 0)),
    ),
    "a limit that is only bounded": (  # u_c = 2 C t
        lambda: accumulates(ge(sp.Limit(rate("u_c"), t, sp.oo), C)),
        lambda: accumulates(tends(rate("u_c"), C)),
    ),
    "the limit of the second derivative": (  # u_c = V t
        lambda: accumulates(tends(sp.Derivative(u_c, (t, 2)), 0)),
        lambda: accumulates(tends(rate("u_c"), 0)),
    ),
    "a limit at 0 for one at infinity": (  # tanh t
        lambda: Passes(end(G, theta))(tends(G, theta, sp.S.Zero)),
        lambda: Passes(end(2 * G, 2 * theta))(tends(G, theta)),
    ),
    "a sign is not continuous": (
        lambda: Passes(end(sp.sign(G), 0))(tends(G, 0)),
        lambda: Passes(end(sp.tanh(G), 0))(tends(G, 0)),
    ),
    # ---- bounds
    "a derivative with respect to the period": (  # G = omega T
        lambda: grows(ge(sp.Derivative(G, T), omega), eq(initial("G"), 0)),
        lambda: grows(ge(rate("G"), omega), eq(initial("G"), 0)),
    ),
    "the bound of a second derivative": (
        lambda: grows(ge(sp.Derivative(u_c, (t, 2)), C / T), START),
        lambda: grows(ge(rate("u_c"), C / T), START),
    ),
    "a start that is only bounded": (  # u_c(0) = 0
        lambda: grows(ge(rate("u_c"), C), le(initial("u_c"), h_0)),
        lambda: grows(ge(rate("u_c"), C), eq(initial("u_c"), h_0)),
    ),
    "a function that jumps": (  # 0, -1/2
        lambda: Monotone(sp.Lambda(y, sp.Piecewise((y, y < 0), (y - 1, True))))(ge(x_inf, theta)),
        lambda: Monotone(sp.Lambda(y, y - 1))(ge(x_inf, theta)),
    ),
    "a jump where no sample lies": (
        lambda: Monotone(sp.Lambda(y, sp.Piecewise((y, y < 1000), (y - 2000, True))))(
            ge(x_inf, theta)
        ),
        lambda: Monotone(sp.Lambda(y, 2 * y))(ge(x_inf, theta)),
    ),
    "-1/x across its pole": (  # 1, -1
        lambda: Monotone(sp.Lambda(y, -1 / y))(ge(x_inf, theta)),
        lambda: Monotone(sp.Lambda(y, -1 / y))(ge(h_0 + q, q, evaluate=False)),
    ),
    "the slope of any law as a function": (  # phi = e^-r
        lambda: Monotone(sp.Lambda(y, sp.diff(GENERAL.phi, r).subs(r, y)))(
            ge(-q, -2 * q, evaluate=False)
        ),
        lambda: Monotone(sp.Lambda(y, GENERAL.phi.subs(r, y)))(ge(-q, -2 * q, evaluate=False)),
    ),
    "a slope that is too steep": (
        lambda: infer(Lipschitz(sp.Lambda(y, -2 * y), theta, q, L)),
        lambda: infer(Lipschitz(sp.Lambda(y, -y), theta, q, L)),
    ),
    "a slope of the logarithm beyond its bound": (
        lambda: infer(LogarithmicSlope(sp.Lambda(y, 1 + sp.tanh(y)), theta, q, sp.S.One)),
        lambda: infer(LogarithmicSlope(sp.Lambda(y, 1 + sp.tanh(y)), theta, q, sp.Integer(2))),
    ),
    # ---- data and signs
    "the derivative of a bound": (  # u_cum = 5 M
        lambda: Differentiated(equal(sp.Derivative(u_cum, f_c), h_0), f_c)(ge(u_cum, h_0 * f_c)),
        lambda: Differentiated(equal(sp.Derivative(u_cum, f_c), h_0), f_c)(
            defined(u_cum, h_0 * f_c)
        ),
    ),
    # ---- identities
    "|f_c| = f_c": (
        lambda: Identity(sp.Eq(sp.Abs(f_c), f_c))(),
        lambda: Identity(equal(sp.Abs(f_c) ** 2, f_c**2))(),
    ),
    "log(x^2) = 2 log(x)": (
        lambda: Identity(sp.Eq(sp.log(x_inf**2), 2 * sp.log(x_inf)))(),
        lambda: Identity(equal(sp.log(2 * q), sp.log(2) + sp.log(q)))(),
    ),
    "W(x e^x) = x": (
        lambda: Identity(sp.Eq(sp.LambertW(theta * sp.exp(theta)), theta))(),
        lambda: Identity(equal(theta * sp.exp(theta) * sp.exp(-theta), theta))(),
    ),
    "the logarithm of a bound": (  # kappa = 5, f_c = 0.1
        lambda: Logarithm(sp.Eq(sp.log(kappa), f_c))(ge(kappa, sp.exp(f_c))),
        lambda: Logarithm(sp.Eq(sp.log(kappa), f_c))(eq(kappa, sp.exp(f_c))),
    ),
    "a bound inserted as an equation": (
        lambda: Insert(sp.Eq(u_a, h_0))(le(u_a, h_0)),
        lambda: Insert(sp.Eq(u_a, h_0))(eq(u_a, h_0)),
    ),
    # ---- solutions
    "the wrong branch of W": (  # u_c = 3 h_star
        lambda: Lambert(-u_c / h_star)(eq(-u_c / h_star * sp.exp(-u_c / h_star), -t / T)),
        lambda: Lambert(q)(eq(q * sp.exp(q), theta)),
    ),
    "a multiple of the rate": (  # u_c = C t/2
        lambda: Separate(WORN)(eq(2 * rate("u_c"), C), START, CONSTANTLY),
        lambda: Separate(WORN)(eq(rate("u_c"), C), START, CONSTANTLY),
    ),
    "the primitive of another function": (
        lambda: Integrated(p_s**2)(integral_over(p_s, p_s)),
        lambda: Integrated(p_s**2 / 2)(integral_over(p_s, p_s)),
    ),
    "a primitive that jumps": (  # from -1 to 1
        lambda: Integrated(-1 / u_s)(integral_over(u_s**-2, u_s, -1)),
        lambda: Integrated(-1 / p_s)(integral_over(p_s**-2, p_s)),
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
}


@pytest.mark.parametrize("name", CASES)
def test_what_is_false_is_refused_and_a_true_neighbour_is_not(name: str) -> None:
    false, true = CASES[name]
    with pytest.raises(RuleError, match=r"missing|cannot|does not occur|no (rate|value|kind)"):
        false()
    assert replayed(true()) is None


@pytest.mark.parametrize("name", ["c_1", "A"])
def test_a_formula_of_the_expansion_belongs_to_the_name_defined_as_it(name: str) -> None:
    """A = the formula of c_1 holds where A is a name for c_1, and nowhere else."""
    order = first_order_terms(name)
    found = Averaging(sp.Eq(symbol(name), FIRST_DRIFT))(order)
    assert replayed(found) is None
    assert any(getattr(h.relation, "lhs", None) == symbol(name) for h in found.hypotheses)
    other = {"c_1": "A", "A": "c_1"}[name]
    with pytest.raises(RuleError, match=f"missing premise: {other} = "):
        Averaging(sp.Eq(symbol(other), FIRST_DRIFT))(order)


def test_a_piece_is_kept_where_its_relation_holds() -> None:
    law = eq(p, sp.Piecewise((p_max, sp.Le(h, L)), (0, True)))
    assert restrict(law, le(h, L)).claim.rhs == p_max
    assert restrict(eq(h, sp.Abs(f_c)), ROUGHENS).claim.rhs == f_c


def test_special_values_stay_hypotheses() -> None:
    special = substitute(eq(h, f_c * u_a), eq(f_c, 1))
    assert sp.Eq(f_c, 1) in {hypothesis.relation for hypothesis in special.hypotheses}


def test_rates_and_later_times_of_what_always_holds() -> None:
    assert differentiate(eq(h, 2 * u_c)).claim.rhs == 2 * rate("u_c")
    assert one_period_later(ge(u_c, h_0)).claim.greater == later(u_c)


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
