"""What a third hostile reading got through the public rules, and a true neighbour of each.

Every false statement follows a comment with the model in which it fails, or what is wrong with it.
"""

from __future__ import annotations

from collections.abc import Callable

import pytest
import sympy as sp

from derive.check import checks
from derive.claims import Equality
from derive.equations import Equation
from derive.faults import UsageError
from derive.hypotheses import Kind
from derive.kernel import Judgement, RuleError, replayed
from derive.own_law import own_law
from derive.rules.algebra import Consequence, Insert, Multiply, restrict, substitute
from derive.rules.assumption import assume, defined
from derive.rules.averages import SlowTime
from derive.rules.calculus import ParameterLimit, change_clock
from derive.rules.data import Differentiated
from derive.rules.drift import LogarithmicGrowth
from derive.rules.inequalities import Arithmetic
from derive.rules.limits import (
    AtInfinity,
    Passes,
    forever,
    intermittent,
    later,
    one_period_later,
    unbounded,
)
from derive.rules.proving import LAW
from derive.rules.reading import CONTINUOUS, PERIODIC, SINE
from derive.symbols import initial, rate, symbols, t
from tests.derive.judgements import (
    BOUNDED,
    DEEP,
    ROUGHENS,
    equal,
    given,
    slow_time,
    supposed,
    tends,
)

u_c, u_a, U_a, h, p, G, sigma = symbols("u_c u_a U_a h p G sigma")
h_0, f_c, C, T, N, q, b_0, d, b, L = symbols("h_0 f_c C T N q b_0 d b L")
theta, u_cum, U_mean, tau, c_1, m, p_max, kappa = symbols(
    "theta u_cum U_mean tau c_1 m p_max kappa"
)
x, y = sp.symbols("x y", real=True)
du = rate("u_c")
v, w = (sp.Function(name, real=True)(tau) for name in "vw")
CLOCK = defined(t, T * tau)
AT_ZERO = sp.Subs(du, t, 0)
GAP = (h_0**2 - L**2) / (h_0 - L) - h_0 - L
"""Zero, but where h_0 = L."""
STEEP = sp.diff(LAW(y), y)
LATER_ON = sp.exp(t / T)


def called(relation: sp.Basic, kind: Kind) -> Judgement:
    return assume(supposed(relation, kind))


def defined_as(relation: sp.Basic) -> Judgement:
    return called(relation, Kind.DEFINITION)


def passing(expr: sp.Expr, value: sp.Expr, known: Judgement) -> Judgement:
    return Passes(equal(forever(expr), value))(known)


def at_times(contact: sp.Basic, on: sp.Expr, *facts: Judgement) -> Judgement:
    """Wear at a rate ``on`` while the load makes contact."""
    law = given(sp.Eq(du, sp.Piecewise((on, contact), (0, True))))
    part = sp.Integral(sp.Piecewise((1, contact), (0, True)), (t, 0, T)) / T
    loads = assume(PERIODIC), assume(CONTINUOUS), BOUNDED
    return intermittent(law, defined(d, part), given(sp.Ge(u_c, 0)), *loads, *facts)


def faded(field: sp.Expr, *facts: Judgement) -> Judgement:
    """Wear at a rate that depends on another field."""
    on = C * (2 + sp.tanh(field * q / (u_c**2 + q**2)))
    return at_times(sp.Ge(U_a, h_0), on, *facts)


def tied(low: Judgement, high: Judgement) -> Judgement:
    """The slope of u_cum = f_c h_0, after h_0 = f_c L was inserted."""
    value = Arithmetic(equal(h_0, f_c * L))(low, high)
    known = Insert(equal(u_cum, f_c**2 * L))(defined(u_cum, f_c * h_0), value)
    return Differentiated(equal(sp.Derivative(u_cum, h_0, evaluate=False), 0), h_0)(known)


def untied() -> Judgement:
    claim = equal(sp.Derivative(u_cum, h_0, evaluate=False), f_c)
    return Differentiated(claim, h_0)(defined(u_cum, f_c * h_0))


def both(*relations: sp.Basic) -> Judgement:
    return Arithmetic(equal(u_c, u_a))(*map(defined_as, relations))


def multiplied(factor: sp.Expr, *facts: Judgement) -> Judgement:
    return Multiply(factor)(given(equal(h, u_a)), *facts)


def slow(added: sp.Expr) -> Judgement:
    known = slow_time()
    claim = equal(known.claim.lhs, known.claim.rhs + added * h_0**5 / m**5)
    return SlowTime(claim)(*known.parents)


def logarithmic() -> Judgement:
    return LogarithmicGrowth(q)(tends(du * sp.exp((u_c - U_a) / q), C), assume(SINE))


def curved(order: int) -> Judgement:
    """The limit of the law's remainder behind its Taylor polynomial of lower order."""
    known = sp.S.Zero if order == 1 else u_c / q * STEEP.subs(y, 0)
    expr = (u_c / q) ** order * (LAW(q / u_c) - LAW(0)) - known
    value = (sp.diff(LAW(y), y, order) / order).subs(y, 0)
    return AtInfinity(equal(forever(expr), value), 1 / u_c)(DEEP)


def ends(added: sp.Expr) -> Judgement:
    return AtInfinity(equal(forever(q / u_c), added), 1 / u_c)(DEEP)


Case = tuple[Callable[[], Judgement], Callable[[], Judgement], str]

CASES: dict[str, Case] = {
    # ---- one period later, time in formulas moves on too
    "G e^(t/T) -> theta, one period later": (  # theta/e
        lambda: passing(LATER_ON * later(G), theta, tends(LATER_ON * G, theta)),
        lambda: passing(later(G), theta, tends(G, theta)),
        "the limit of all that varies",
    ),
    "u_c - C t -> h_0, one period later": (  # h_0 + C T
        lambda: passing(later(u_c) - C * t, h_0, tends(u_c - C * t, h_0)),
        lambda: passing(2 * u_c - 2 * C * t, 2 * h_0, tends(u_c - C * t, h_0)),
        "the limit of all that varies",
    ),
    "the first rate, one period later": (  # u_c = C t e^(-t/T)
        lambda: one_period_later(given(equal(AT_ZERO, C))),
        lambda: one_period_later(given(equal(du, C))),
        "at one time",
    ),
    # ---- another clock, under a derivative or an integral over time
    "u_c = h_0 N, under the rate": (  # d(h_0 N)/dt is h_0/T
        lambda: substitute(given(equal(du, C)), given(equal(u_c, h_0 * N))),
        lambda: substitute(given(equal(du, C)), given(equal(u_c, u_a))),
        "for every",
    ),
    "U_a = h_0 v(tau), under the mean": (
        lambda: substitute(
            defined(U_mean, sp.Integral(U_a, (t, 0, T)) / T), given(equal(U_a, h_0 * v))
        ),
        lambda: substitute(
            defined(U_mean, sp.Integral(U_a, (t, 0, T)) / T), given(equal(U_a, h_0 * G))
        ),
        "for every",
    ),
    "a branch for N times the load": (
        lambda: restrict(
            given(equal(G, sp.Integral(sp.Piecewise((1, N * U_a >= h_0), (0, True)), (t, 0, T)))),
            given(N * U_a >= h_0),
        ),
        lambda: restrict(
            given(equal(G, sp.Integral(sp.Piecewise((1, U_a >= h_0), (0, True)), (t, 0, T)))),
            given(U_a >= h_0),
        ),
        "for every",
    ),
    "the rate of w(tau) = q v(tau), with time held": (  # the left side is 0 to SymPy
        lambda: change_clock(given(equal(w, q * v)), CLOCK),
        lambda: change_clock(given(equal(u_c, q * v)), CLOCK),
        "Derivative",
    ),
    # ---- ranges that are not closed, fields that are not bounded
    "a rate that goes with a roughness that fades": (  # sigma = h_0 e^(-t/T)
        lambda: unbounded(
            given(equal(du, C * sigma / h_0)),
            Arithmetic(sp.Gt(sigma, 0, evaluate=False))(),
            given(sp.Le(sigma, h_0)),
        ),
        lambda: unbounded(given(equal(du, C * (1 + sigma / L))), given(sp.Le(sigma, h_0))),
        "positive and continuous",
    ),
    "a rate in contact with a field that grows": (  # G = u_c^2
        lambda: faded(G),
        lambda: faded(G, given(sp.Le(sp.Abs(G), q))),
        "G is bounded",
    ),
    "contact where t U_a exceeds a level": (  # later for half of a period
        lambda: at_times(sp.Ge(t * U_a, h_0 * T), C),
        lambda: at_times(sp.Ge(2 * U_a, h_0), C),
        "the load alone",
    ),
    # ---- definitions that hide a condition
    "two names for one field": (  # u_c = 1, u_a = 2
        lambda: both(equal(G, u_c), equal(G - u_a, 0)),
        lambda: Arithmetic(equal(u_c, u_a))(defined_as(equal(G, u_c)), given(equal(G, u_a))),
        "two definitions",
    ),
    "t = 5, by definition": (  # t = 4
        lambda: Arithmetic(equal(u_c, 5 * C))(given(equal(u_c, C * t)), defined(t, sp.Integer(5))),
        lambda: Arithmetic(equal(u_c, C * T * tau))(given(equal(u_c, C * t)), CLOCK),
        "another time",
    ),
    # ---- facts about a free variable, for a bound one of the same name
    "1/theta over -1 to 1, for theta > 0": (
        lambda: multiplied(sp.Integral(1 / theta, (theta, -1, 1)), given(theta > 0)),
        lambda: multiplied(sp.Integral(x / theta, (x, 1, 2)), given(theta > 0)),
        "Ne",
    ),
    "ln x at -1, for x > 0": (
        lambda: multiplied(sp.Subs(sp.log(x), x, -1), given(x > 0)),
        lambda: multiplied(sp.log(1 + q)),
        "> 0",
    ),
    "a piecewise number without the other case": (  # f_c = -1
        lambda: multiplied(sp.Piecewise((1, f_c > 0))),
        lambda: multiplied(sp.Piecewise((1, f_c > 0)), ROUGHENS),
        "f_c > 0",
    ),
    # ---- a law that is differentiable once
    "the second slope of a law": (  # phi has none at 0
        lambda: curved(2),
        lambda: curved(1),
        "phi",
    ),
    # ---- 0/0 where h_0 = L
    "a limit that is not reached": (
        lambda: ends(sp.S.One),
        lambda: ends(sp.S.Zero),
        "the limit is 0",
    ),
    "a limit with 0/0": (lambda: ends(GAP), lambda: ends(sp.S.Zero), "Ne"),
    "a limit that passes, with 0/0": (
        lambda: passing(2 * G, 2 * theta + GAP / L, tends(G, theta)),
        lambda: passing(2 * G, 2 * theta, tends(G, theta)),
        "Ne",
    ),
    "a slow time with 0/0": (lambda: slow(GAP), lambda: slow(sp.S.One), "Ne"),
    # ---- data that fields tie
    "two loads that tie h_0 and f_c": (  # the slope is f_c
        lambda: tied(called(equal(U_a, f_c * L), Kind.LOAD), called(equal(U_a, h_0), Kind.LOAD)),
        untied,
        "may vary",
    ),
    "two starts that tie h_0 and f_c": (
        lambda: tied(
            called(equal(initial("h"), h_0), Kind.INITIAL), given(equal(initial("h"), f_c * L))
        ),
        untied,
        "may vary",
    ),
    # ---- what an asymptotic relation and a limit bind
    "the number of cycles in an asymptotic relation": (  # G(0) = 1
        lambda: substitute(logarithmic(), given(equal(N, initial("G")))),
        logarithmic,
        "may take every value",
    ),
    "a name held fixed while a datum grows": (  # b_0 = sigma_c0/f_c - h_0
        lambda: Consequence(equal(sp.Limit(b_0 / h_0, h_0, sp.oo), 0))(
            ParameterLimit(L / h_0, h_0)(), given(equal(b_0, L))
        ),
        lambda: Consequence(equal(sp.Limit(T * L / h_0, h_0, sp.oo), 0))(
            ParameterLimit(b * L / h_0, h_0)(), given(equal(T, b))
        ),
        "data alone",
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_what_got_through_is_refused_and_its_true_neighbour_is_not(name: str) -> None:
    false, true, said = CASES[name]
    with pytest.raises(RuleError, match=said):
        false()
    assert replayed(true()) is None


def test_a_judgement_that_rests_on_itself_is_found() -> None:
    made = Arithmetic(sp.Gt(f_c, 0))(given(sp.Gt(f_c, 0)))
    object.__setattr__(made, "hypotheses", ())
    object.__setattr__(made, "parents", (made,))
    assert replayed(made) == "f_c > 0 rests on itself"


def test_a_claim_that_is_changed_after_its_check_is_found() -> None:
    made = substitute(given(equal(h, h_0)), given(equal(h_0, L)))
    assert all(check.passed for check in checks(made))
    object.__setattr__(made, "claim", Equality(h, 2 * L))
    assert not all(check.passed for check in checks(made))


@pytest.mark.parametrize("statements", [(), ("f_c > 0",)])
def test_an_equation_states_judgements(statements: tuple[Judgement, ...]) -> None:
    with pytest.raises(TypeError):
        Equation("x", "1", "none", statements)


@pytest.mark.parametrize(
    ("made", "shown"),
    [
        (called(equal(G - sp.log(f_c), 0), Kind.DEFINITION), "f_c > 0"),
        (defined(sp.Symbol("scale", positive=True), f_c), "scale > 0"),
        (
            Insert(equal(kappa, sp.exp(b_0)))(
                defined(b_0, sp.log(kappa)), called(equal(kappa, f_c), Kind.DEFINITION)
            ),
            "kappa > 0",
        ),
    ],
    ids=str,
)
def test_a_definition_shows_what_it_hides(made: Judgement, shown: str) -> None:
    stated = Equation("x", "1", "hidden", (Arithmetic(sp.Ge(h_0, 0, evaluate=False))(made),))
    assert shown in [str(condition.relation) for condition in stated.conditions]


@pytest.mark.parametrize("text", ["exp(-r - sqrt(r^2)/2)", "(3 - (r-2)/sqrt((r-2)^2)) exp(-r)"])
def test_a_law_with_a_kink_or_a_jump_is_refused(text: str) -> None:
    with pytest.raises(UsageError, match="kink"):
        own_law(text.replace(") exp", ")*exp"))
