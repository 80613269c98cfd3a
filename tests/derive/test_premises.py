"""Every rule refuses when one of its premises is dropped, and says what is missing.

The applications are the true neighbours of false statements, and those below. A rule without an
application fails here, and so does a refusal that no case brings about: whoever adds a rule, or a
side condition, adds the case in which it is not met.
"""

from __future__ import annotations

import ast
import inspect
import traceback
from collections.abc import Callable, Iterator
from functools import cache, partial
from pathlib import Path

import pytest
import sympy as sp

from derive import rules
from derive.claims import Drift, FirstZero, Oscillation
from derive.kernel import Judgement, Rule, RuleError, infer, replayed
from derive.language import names
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
from derive.rules.averages import EXPANSION, Averaging, OrderEquation, SlowTime, term_of
from derive.rules.calculus import (
    ParameterLimit,
    change_clock,
    differentiate,
    integrate,
    rigid,
)
from derive.rules.data import Differentiated, OneSign
from derive.rules.drift import LeadingTerm, LogarithmicGrowth, first_order, logarithmic_drift
from derive.rules.inequalities import Arithmetic, Lipschitz, LogarithmicSlope, Threshold
from derive.rules.limits import (
    AtInfinity,
    Diverges,
    Passes,
    accumulates,
    forever,
    intermittent,
    one_period_later,
    unbounded,
    vanishes,
)
from derive.rules.proving import DIFFERENTIABLE
from derive.rules.reading import CONTINUOUS, PERIODIC, SINE
from derive.rules.solutions import FirstRoot, Integrated, Lambert, Separate
from derive.symbols import initial, rate, symbol, symbols, t
from tests.derive import (
    test_hostile,
    test_hostile_again,
    test_hostile_third,
    test_language,
    test_rules,
)
from tests.derive.judgements import (
    APPROACH,
    BOUNDED,
    CONSTANTLY,
    DEEP,
    FIRST_DRIFT,
    GROWING,
    PIN_START,
    RATE,
    ROUGHENS,
    SLOPE,
    START,
    averaged_as,
    drift_premises,
    end,
    eq,
    equal,
    expansion_premises,
    first_order_terms,
    forgotten,
    ge,
    given,
    gt,
    integral,
    le,
    lt,
    ne,
    opened,
    slow_time,
    supposed,
    tends,
    timed,
)

ROOM = Path(inspect.getfile(rules)).parent

u_c, u_a, U_a, h, p, G = symbols("u_c u_a U_a h p G")
h_0, sigma_c0, sigma_c, f_c, C, T, N, q, k, b_0 = symbols("h_0 sigma_c0 sigma_c f_c C T N q k b_0")
U_max, L = symbols("U_max L")
U, u_cum, theta, tau, h_star, epsilon, d, M = symbols("U u_cum theta tau h_star epsilon d M")
p_max, u_stop, c_1, m, p_s, u_s = symbols("p_max u_stop c_1 m p_s u_s")
x = sp.Symbol("x", positive=True)
y = sp.Symbol("y", real=True)
v = sp.Function("v", real=True)(tau)
RATIO = (h - U_a) / sigma_c0
LAW, STEADY = C * sp.exp(-RATIO), C * sp.exp(-q)
FALLS = sp.Lt(f_c, 0)
LOG_N = sp.log(N)
FEW = sp.log(-h_star / (f_c * sigma_c))
TOUCHING = sp.Ge(U_a, b_0)


def ordered(
    law: sp.Expr = LAW, rest: sp.Expr = U_a, end: sp.Expr = sp.S.Zero, speed: sp.Expr = STEADY
) -> Judgement:
    """Apply FirstOrder, with one thing wrong."""
    approach = tends(u_c * (RATIO - q) - rest, end)
    limits = approach, tends(RATIO, q), tends(rate("u_c"), speed)
    return first_order(eq(rate("u_c"), law), *limits, BOUNDED)


def some_of_the_time(
    contact: sp.Basic = TOUCHING,
    on: sp.Expr = C,
    off: sp.Expr = sp.S.Zero,
    part: sp.Basic = TOUCHING,
    least: sp.Expr = sp.S.Zero,
) -> Judgement:
    """Apply Intermittent, with one thing wrong."""
    law = eq(rate("u_c"), sp.Piecewise((on, contact), (off, True)))
    share = sp.Integral(sp.Piecewise((1, part), (0, True)), (t, 0, T)) / T
    above = ge(u_c, least)
    loads = assume(PERIODIC), assume(CONTINUOUS), BOUNDED
    return intermittent(law, defined(d, share), above, *loads)


def by_pressure(g: sp.Expr = -h_0 / (C * p_s), wear: sp.Expr = U_a - h_0 * p / p_max) -> Judgement:
    """Separate the variables in terms of the pressure, with one thing wrong."""
    law, claim = eq(rate("u_c"), C * p / p_max), sp.Integral(g, (p_s, initial("p"), p))
    root = eq(p, p_max * (U_a - u_c) / h_0)
    return Separate(equal(t, claim))(law, eq(u_c, wear), root, CONSTANTLY)


def separated(law: Judgement) -> Judgement:
    return Separate(equal(t, sp.Integral(1 / C, (u_s, 0, u_c))))(law, START, CONSTANTLY)


def exponential_tail(scale: sp.Expr = sigma_c0, size: sp.Expr = sigma_c0) -> Judgement:
    grown = rate("u_c") * sp.exp((u_c - U_a) / size)
    return LogarithmicGrowth(scale)(tends(grown, C), assume(SINE))


def last(cycles: sp.Expr = FEW, of: sp.Expr = LOG_N, sign: sp.Basic = FALLS) -> Judgement:
    """Apply LeadingTerm where N is as the reciprocal of the roughness, with one thing wrong."""
    exact = eq(f_c * N, theta - h_star / sigma_c)
    return LeadingTerm(sp.Eq(of, cycles))(exact, given(sign))


def root(function: sp.Expr, factor: sp.Expr = sp.S.One) -> Judgement:
    return FirstRoot(factor)(defined(u_stop, FirstZero(function, x)))


def faded(value: sp.Expr, inside: sp.Expr, small: sp.Expr) -> Judgement:
    return AtInfinity(end(inside, value), small)(DEEP, BOUNDED)


def exceeds(function: sp.Expr, level: sp.Expr, point: sp.Expr) -> Judgement:
    claim = sp.Equivalent(sp.Gt(function, level), sp.Gt(f_c, point))
    return Threshold(claim, f_c)(ROUGHENS)


def sloped(claim: sp.Equality, datum: sp.Symbol = f_c) -> Judgement:
    return Differentiated(claim, datum)(GROWING)


FADING = sp.exp(-u_c / sigma_c0)


def slow(place: int | None = None, lhs: sp.Expr | None = None) -> Judgement:
    known = slow_time()
    claim = sp.Eq(lhs or known.claim.lhs, known.claim.rhs)
    premises = [j for i, j in enumerate(known.parents) if i != place]
    return infer(SlowTime(claim), *premises)


def drifting(approach: sp.Expr) -> Judgement:
    return logarithmic_drift(*drift_premises(approach))


def of_another_pressure() -> Judgement:
    *premises, _, wave = expansion_premises()
    other = premises[0].claim.rhs.subs(h_0, 2 * h_0)
    return OrderEquation(sp.S.One)(*premises, defined(c_1, term_of(Drift, 1, other)), wave)


def vanishing_drifts() -> Judgement:
    values = [defined(symbol(f"c_{n}"), sp.S.Zero) for n in (1, 2, 3, 4)]
    known = slow_time().claim
    return SlowTime(sp.Eq(known.lhs, known.rhs))(*values, assume(EXPANSION))


#: What holds by one rule, and is false without any of its premises; in the comment, a model.
NEEDED: dict[str, Callable[[], Judgement]] = {
    "f_c u_a = f_c h_0 at f_c = 0": lambda: Solve(u_a)(eq(f_c * u_a, f_c * h_0), ROUGHENS),
    "divided by what may vanish": lambda: Multiply(1 / f_c)(eq(h, u_a), ROUGHENS),
    "f_c N/(1 + f_c N)": lambda: ParameterLimit(f_c * N / (1 + f_c * N), N)(ROUGHENS),  # f_c = 0
    "h_0^(1/N) for N -> oo": lambda: ParameterLimit(h_0 ** (1 / N), N)(gt(h_0, 0)),  # h_0 = 0
    "a roughness that may shrink": (  # f_c = -0.05
        lambda: Diverges(sigma_c0 + f_c * u_c)(ge(u_c, C * t), ROUGHENS)
    ),
    "an unbounded load": (  # U_a = h_star t/T
        lambda: unbounded(eq(rate("u_c"), C * sp.exp(-U_a / h_star)), BOUNDED)
    ),
    "a step of either sign": lambda: infer(Lipschitz(sp.Lambda(y, -y), theta, f_c, L), ROUGHENS),
    "U_max > 0": lambda: Arithmetic(sp.Gt(U_max, 0))(gt(U_max, h_0)),
    "f_c > -1": lambda: Arithmetic(sp.Gt(f_c, -1))(ROUGHENS),
    "p < 10^6 p_max": lambda: Arithmetic(sp.Lt(p, 10**6 * p_max))(lt(p, p_max)),
    "a datum of either sign": lambda: OneSign(h_0)(eq(rate("u_c"), C * f_c * h_0), ROUGHENS),
    "(f_c^2 - 1)/(f_c - 1)": (  # f_c = 1
        lambda: Identity(sp.Eq((f_c**2 - 1) / (f_c - 1), f_c + 1))(ne(f_c, 1))
    ),
    "0/0": (  # h = u_a
        lambda: Insert(equal((h - u_a) / (u_c - h_0), 1))(eq(u_c, h_0 + h - u_a), ne(u_c, h_0))
    ),
    "a load that varies": lambda: timed(h_star / (C * U), C * U / h_star, START),  # U_a = t
    "the load of another time": (  # U_a = t: u_c = t^2/2
        lambda: timed(h_0 / (C * U_a), C * U_a / h_0, START, given(U_a > 0))
    ),
    "a threshold": lambda: exceeds(f_c**2, epsilon**2, epsilon),  # f_c = -0.04
    "ln f_c": lambda: Logarithm(equal(sp.log(f_c), sp.log(f_c)))(ROUGHENS),  # f_c = -1
    "a root that starts at 0": lambda: differentiate(eq(h, sp.sqrt(u_c)), gt(u_c, 0)),  # u_c = t^2
    "a constant that is the load": lambda: defined(b_0, U_a, "", CONSTANTLY),  # sin t
    "a load that jumps": lambda: differentiate(eq(h, h_0 - U_a), assume(DIFFERENTIABLE)),
    "the square of an unbounded load": (  # U_a^2 = q u_c
        lambda: AtInfinity(end(u_c / (u_c + U_a**2 / q), 1), 1 / u_c)(DEEP, BOUNDED)
    ),
    "the approach of a rate": ordered,  # U_a = sqrt t
    "the reciprocal of what grows": lambda: Passes(end(1 / u_c, 0))(DEEP),
    "one period later": lambda: one_period_later(ge(u_c, h_0)),
    "a double root": lambda: root(h_star - x),
    "a mean over contact": some_of_the_time,
    "a drift": lambda: logarithmic_drift(*drift_premises()),
    "an exponential tail": exponential_tail,
    "the last cycles": last,
    "time by pressure": by_pressure,
    "w for f_c < 0": lambda: Lambert(f_c)(eq(f_c * sp.exp(f_c), theta), ROUGHENS),
    "1/s^2 across 0": lambda: Integrated(-1 / u_s)(
        eq(G, sp.Integral(u_s**-2, (u_s, f_c, 2))), ROUGHENS
    ),
    "the terms of an order": first_order_terms,
    "a term of the expansion": lambda: averaged_as(FIRST_DRIFT),
    "slow time": slow,
    "scaled": lambda: change_clock(defined(u_c, sigma_c0 * v), defined(t, T * tau)),
    "a slope in a sum": lambda: sloped(equal(SLOPE, h_0)),
}

#: What is refused, by what the refusal says.
REFUSED: tuple[tuple[str, Callable[[], Judgement]], ...] = (
    # algebra
    ("has no value", lambda: substitute(eq(h, 1 / b_0), eq(b_0, 0))),
    ("does not occur", lambda: substitute(eq(h, u_a), eq(b_0, q))),
    ("every value", lambda: substitute(integral(theta), eq(theta, b_0))),
    ("is an equality or", lambda: Multiply(q)(ne(h, u_a))),
    ("has no branch", lambda: restrict(eq(h, q), ROUGHENS)),
    ("every value", lambda: infer(Substitute(), given(equal(SLOPE, h_0)), eq(f_c, 1))),
    ("has no branch", lambda: restrict(eq(p, sp.Piecewise((q, h <= L), (0, True))), le(h, 2 * L))),
    ("has no branch", lambda: restrict(eq(h, sp.Abs(f_c)), lt(f_c, 0))),
    ("is an equality", lambda: Identity(sp.Ge(f_c, q))()),
    ("Ne", lambda: Consequence(sp.Eq(h / f_c, u_a / f_c))(eq(h, u_a))),
    ("Ne", lambda: Alike(sp.Equivalent(sp.Le(u_a, 1 / f_c), sp.Le(u_a - 1 / f_c, 0)))()),
    ("constant", lambda: forget(eq(b_0, U_a), supposed(sp.Eq(b_0, U_a)))),
    ("may be -1", lambda: forgotten(equal(q, -1), sp.Ge(h_0, 0, evaluate=False))),
    # calculus
    ("dy/dt = c dx/dt", lambda: integrate(eq(rate("u_c"), C), START, START)),
    ("is constant", lambda: integrate(eq(rate("u_c"), u_a * rate("u_a")), START, START)),
    ("at t = 0", lambda: integrate(eq(rate("u_c"), 2 * rate("u_a")), PIN_START, START)),
    ("continuous for k", lambda: rigid(Multiply(k)(opened()))),
    ("t = T tau", lambda: change_clock(defined(u_c, sigma_c0 * v), defined(t, 2 * T * tau))),
    ("is constant", lambda: change_clock(eq(u_c, h * v), defined(t, T * tau))),
    ("missing premise", lambda: change_clock(ge(u_c, u_a), defined(t, T * tau))),
    ("missing premise", lambda: differentiate(ge(h, 2 * u_c))),
    # data
    ("one of the data", lambda: sloped(equal(sp.Derivative(u_cum, b_0), 0), b_0)),
    ("Ne", lambda: sloped(equal(SLOPE / (f_c - 1), h_0 / (f_c - 1)))),
    (  # d(2 f_c)/d f_c at f_c = 1
        "may vary",
        lambda: infer(
            Differentiated(equal(SLOPE, 0), f_c), substitute(defined(u_cum, f_c * h_0), eq(f_c, 1))
        ),
    ),
    ("the derivative is", lambda: sloped(equal(SLOPE, 2 * h_0))),
    ("Ne|> 0", lambda: OneSign(h_0)(eq(G, sp.sqrt(h_0)))),
    # drift
    ("with that limit", lambda: ordered(end=sp.S.One)),
    ("with that limit", lambda: ordered(law=C * sp.exp(-RATIO) * (1 + G**2))),
    ("differentiable at the limit", lambda: ordered(law=C * sp.Abs(RATIO), speed=C * q)),
    ("is bounded", lambda: ordered(rest=U_a + h_0 * t / T)),
    ("at the limit", lambda: ordered(speed=C)),
    ("f_c", lambda: ordered(law=f_c * C * sp.exp(-RATIO), speed=f_c * C * sp.exp(-q))),
    (
        "linear in the load",
        lambda: logarithmic_drift(*drift_premises(approach=t**2 * (rate("u_c") - C) - U_a)),
    ),
    ("the limit of exp", lambda: exponential_tail(size=h_star)),
    ("b_0 > 0", lambda: exponential_tail(scale=b_0, size=b_0)),
    ("is about", lambda: last(of=N)),
    ("is about", lambda: last(FEW + G**2)),
    ("grows without bound", lambda: last(-FEW)),
    ("quotient of the slopes", lambda: last(2 * FEW)),
    ("f_c", lambda: last(sign=sp.Ne(f_c, 0))),
    ("b_0", lambda: last(FEW + 1 / b_0)),
    ("linear in the load", lambda: drifting(t * (rate("u_c") - C) - U_a**2 / U)),
    ("linear in the load", lambda: drifting(t * (rate("u_c") - C) - u_a)),
    # inequalities
    (">= 0", lambda: infer(Lipschitz(sp.Lambda(y, -sp.sqrt(y)), theta, q, M))),
    ("f_c", lambda: infer(Lipschitz(sp.Lambda(y, -y), 1 / f_c, q, M))),
    (">= 0", lambda: infer(LogarithmicSlope(sp.Lambda(y, sp.exp(sp.sqrt(y))), q, M, M))),
    ("Ne", lambda: exceeds(1 / (f_c - 1), epsilon, 1 + 1 / epsilon)),
    ("b_0 > 0", lambda: exceeds(2 * f_c, 2 * b_0, b_0)),
    ("increases with", lambda: exceeds(-2 * f_c, -2 * q, q)),
    ("the left side is", lambda: exceeds(2 * f_c, q, q)),
    # limits
    ("smooth function at", lambda: AtInfinity(end(sp.log(u_c) / u_c, 0), 1 / u_c)(DEEP)),
    ("is smooth", lambda: AtInfinity(end(1 / (U_a + h_0 / u_c), 0), 1 / u_c)(DEEP, BOUNDED)),
    ("is bounded", lambda: AtInfinity(end(u_c, 0), 1 / u_c)(DEEP)),
    ("-> 0 as", lambda: faded(sp.S.Zero, FADING, 1 / u_c**2)),
    ("f_c/q > 0", lambda: faded(sp.S.Zero, FADING, sp.exp(-f_c * u_c / q))),
    ("smooth function at", lambda: faded(sp.S.Zero, sp.sqrt(FADING), FADING)),
    ("encloses", lambda: vanishes(given(sp.And(sp.Le(G, h_0 / u_c), sp.Ge(h, 0))), DEEP)),
    (
        "is a constant over",
        lambda: vanishes(given(sp.And(sp.Le(G, U_a / u_c), sp.Ge(G, -U_a / u_c))), DEEP),
    ),
    ("the limit of", lambda: Passes(end(2 * G, theta))(tends(G, theta))),
    ("is finite", lambda: accumulates(tends(rate("u_c"), sp.oo))),
    ("no limit for t", lambda: accumulates(tends(rate("u_c"), C, sp.S.Zero))),
    ("is no limit", lambda: AtInfinity(end(U_a / u_c, 0), 1 / u_c)(le(forever(u_c), h_0), BOUNDED)),
    ("only words say", lambda: discharge(drifting(APPROACH), CONTINUOUS, START)),
    ("-> oo", lambda: AtInfinity(end(1 / u_c, 0), 1 / u_c)(tends(u_c, h_0))),
    ("is finite", lambda: Passes(end(2 * G, -sp.oo))(tends(G, -sp.oo))),
    ("solved for the rate", lambda: unbounded(eq(rate("u_c"), C + rate("u_a")))),
    ("above a constant", lambda: some_of_the_time(least=G)),
    ("0 out of contact", lambda: some_of_the_time(off=C / 2)),
    ("on the load alone", lambda: some_of_the_time(contact=sp.Ge(U_a, u_c))),
    ("fraction of the period", lambda: some_of_the_time(part=sp.Ge(U_a, 2 * b_0))),
    ("positive and continuous", lambda: some_of_the_time(on=C * f_c)),
    ("rate in contact", lambda: some_of_the_time(on=C * (1 + U_a**2 / U**2))),
    # solutions
    ("is no equality", lambda: separated(ge(rate("u_c"), C))),
    ("alone", lambda: separated(eq(rate("u_a"), C))),
    ("one integral", lambda: Separate(sp.Eq(t, u_c))(RATE, START, CONSTANTLY)),
    ("Ne", lambda: timed(1 / f_c, f_c, START)),
    ("separates", lambda: timed(2 / C, C, START)),
    ("of what moves", lambda: timed(1 / C, C, eq(initial("u_c"), 1))),
    ("smooth functions", lambda: by_pressure(wear=U_a - sp.Abs(b_0 - p))),
    ("separates", lambda: by_pressure(-2 * h_0 / (C * p_s))),
    ("Ne", lambda: Integrated(1 / b_0)(eq(G, sp.Integral(p_s, (p_s, 1, 2))))),
    ("has the derivative", lambda: Integrated(p_s)(eq(G, sp.Integral(p_s, (p_s, 1, 2))))),
    ("q is w e^w|w e^w", lambda: Lambert(q)(eq(q * sp.exp(h), theta))),
    ("f_c >= 0", lambda: Lambert(f_c)(eq(f_c * sp.exp(f_c), theta))),
    ("a first zero", lambda: FirstRoot(sp.S.One)(eq(u_stop, h_star))),
    ("is quadratic", lambda: root(h_star - x**3)),
    ("Ne", lambda: root((h_star - x) / (x - 1), x - 1)),
    ("f_c > 0", lambda: root(h_star - x, f_c)),
    ("f_c > 0", lambda: root(f_c - x)),
    ("missing premise", lambda: root(h_star - x, h_star - x)),
    ("no equality", lambda: FirstRoot(sp.S.One)(ge(u_stop, h_star))),
    # averages
    ("by the mean", lambda: averaged_as(FIRST_DRIFT, "A")),
    ("by the mean", lambda: averaged_as(2 * FIRST_DRIFT)),
    ("is of an oscillation", lambda: Averaging(sp.Eq(c_1, 0))(RATE)),
    ("at given wear", lambda: OrderEquation(sp.S.One)(eq(h, u_c), *expansion_premises())),
    ("the drift c_2", lambda: OrderEquation(sp.Integer(2))(*expansion_premises())),
    ("is constant", lambda: defined(c_1, term_of(Oscillation, 1, U_a))),
    ("the drift c_1", of_another_pressure),
    ("c_3 and c_4", lambda: SlowTime(sp.Eq(L, m))()),
    ("c_3 and c_4", vanishing_drifts),
    ("the drifts", lambda: slow(0)),
    ("averaged roughness", lambda: slow(4)),
    ("dtau/dm", lambda: slow(lhs=h_0)),
)


CASES = tuple(
    case
    for room in (test_rules, test_hostile, test_hostile_again, test_hostile_third)
    for case in room.CASES.values()
)


def applications() -> Iterator[Callable[[], Judgement]]:
    yield from (true for _, true, *_ in CASES)
    yield from NEEDED.values()


def kinds(kind: type[Rule] = Rule) -> Iterator[type[Rule]]:
    for rule in kind.__subclasses__():
        if rule.__module__.startswith(rules.__name__):
            yield rule
        yield from kinds(rule)


@cache
def made() -> dict[type[Rule], list[Judgement]]:
    """Return the applications of each rule."""
    found: dict[type[Rule], list[Judgement]] = {}
    for judgement in [build() for build in applications()]:
        found.setdefault(type(judgement.rule), []).append(judgement)
    return found


@cache
def dropped(known: Judgement) -> tuple[RuleError | Judgement, ...]:
    """Return how a rule refuses without each of its premises in turn, or what it gives then."""
    refusals: list[RuleError | Judgement] = []
    for place in range(len(known.parents)):
        try:
            refusals.append(infer(known.rule, *known.parents[:place], *known.parents[place + 1 :]))
        except RuleError as refusal:
            refusals.append(refusal)
    return tuple(refusals)


@cache
def refusal(false: Callable[[], Judgement]) -> RuleError:
    with pytest.raises(RuleError) as caught:
        false()
    return caught.value


@pytest.mark.parametrize("kind", sorted(kinds(), key=str), ids=lambda kind: kind.__name__)
def test_a_rule_needs_each_of_its_premises(kind: type[Rule]) -> None:
    """The refusal says a name of the dropped premise, what the rule rests on, or the claim."""
    assert made()[kind]
    for known in made()[kind]:
        for premise, found in zip(known.parents, dropped(known), strict=True):
            if isinstance(found, Judgement):
                assert found.claim != known.claim, premise.relation
                continue
            said = [name for name, _ in names(premise.relation)] + [
                *kind.asks,
                str(known.relation),
                premise.claim.text.split()[0] if premise.relation == sp.true else "",
            ]
            assert any(word and word in str(found) for word in said), (premise.relation, found)


@pytest.mark.parametrize("name", NEEDED)
def test_what_is_false_without_a_premise_is_true_with_it(name: str) -> None:
    known = NEEDED[name]()
    assert replayed(known) is None


@pytest.mark.parametrize(("said", "false"), REFUSED, ids=[said for said, _ in REFUSED])
def test_a_side_condition_is_asked_for(said: str, false: Callable[[], Judgement]) -> None:
    assert said in str(refusal(false)) or any(s in str(refusal(false)) for s in said.split("|"))


def test_every_refusal_of_the_rules_is_brought_about() -> None:
    """A line of a rule that refuses, or asks for a condition, and never did is not tested."""
    known = [judgement for of_a_rule in made().values() for judgement in of_a_rule]
    errors = [error for one in known for error in dropped(one) if isinstance(error, RuleError)]
    errors += [refusal(false) for false in (*(c[0] for c in CASES), *(f for _, f in REFUSED))]
    errors += [
        refusal(partial(assume, supposed(relation, kind)))
        for kind, relation, _ in test_language.MISCALLED
    ]
    hit = {
        (Path(frame.filename).name, frame.lineno)
        for error in errors
        for frame in traceback.extract_tb(error.__traceback__)
    }
    sites = {(path.name, line) for path in ROOM.glob("*.py") for line in asked(path)}
    assert sorted(sites - hit) == []


def asked(path: Path) -> Iterator[int]:
    """Yield the lines of a module on which a rule refuses or asks for a condition."""
    helpers = {"require", "require_defined", "require_hypothesis"}
    for node in ast.walk(ast.parse(path.read_text())):
        called = node.func if isinstance(node, ast.Call) else None
        if isinstance(called, ast.Name) and called.id in helpers:
            yield called.lineno
        if isinstance(node, ast.Raise):
            yield node.lineno
