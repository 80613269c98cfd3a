"""Chains of rule applications at random: no model breaks what comes out.

Hypotheses, rules, their fields and their premises are drawn from small pools in which much is
false, degenerate or of the wrong kind; most applications are refused.  What a chain concludes is
tried on models by the falsifier, which shares nothing with the rules.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import sympy as sp
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from derive.falsifier.verdict import try_on_models
from derive.hypotheses import CONSTANT, PERIODIC, Hypothesis, Kind
from derive.kernel import Judgement, Rule, RuleError, infer
from derive.rules import algebra, calculus, data, drift, growth, inequalities, limits, solutions
from derive.rules.assumption import Assume, assume
from derive.rules.limits import forever, later
from derive.symbols import initial, rate, symbols, t
from derive.time_limit import TimeLimitError

u_c, u_a, U_a, h, G = symbols("u_c u_a U_a h G")
h_0, f_c, C, T, q, U, b_0, theta, u_cum, M = symbols("h_0 f_c C T q U b_0 theta u_cum M")
y = sp.Symbol("y", real=True)
du = rate("u_c")

RELATIONS: tuple[sp.Basic, ...] = (
    sp.Eq(du, C),
    sp.Eq(du, f_c * C),
    sp.Eq(du, C * sp.exp(-U_a / q)),
    sp.Eq(du, C * sp.exp(-u_c / q)),
    sp.Eq(du, rate("u_a") * f_c),
    sp.Ge(du, C),
    sp.Ge(du, b_0),
    sp.Eq(initial("u_c"), 0),
    sp.Eq(initial("u_c"), b_0),
    sp.Eq(initial("u_a"), 0),
    sp.Gt(f_c, 0),
    sp.Lt(f_c, 0),
    sp.Ne(f_c, 0),
    sp.Eq(f_c, 0),
    sp.Eq(f_c, 1),
    sp.Ge(u_c, 0),
    sp.Ge(u_c, C * t),
    sp.Gt(h + h_0 * T / t, u_a),
    sp.Eq(forever(h - u_a), theta),
    sp.Le(sp.Abs(U_a), U),
    sp.Eq(h, h_0 + u_c - U_a),
    sp.Eq(h, f_c * u_a),
    sp.Eq(h, sp.Abs(b_0)),
    sp.Eq(G, sp.Piecewise((f_c, sp.Ge(u_c, 0)), (1, True))),
    sp.Eq(G, u_c / f_c),
    sp.Eq(u_a, f_c * h_0),
    sp.Eq(f_c * u_a, f_c * h_0),
    sp.Ge(b_0, theta),
    sp.Eq(b_0, sp.log(f_c)),
    sp.Eq(u_cum, f_c**2 * h_0),
    sp.Eq(forever(u_c), sp.oo),
    sp.Eq(forever(du), C),
    sp.Eq(forever(G), theta),
    sp.Eq(forever(G), 0),
    sp.And(sp.Le(G, h_0 / u_c), sp.Ge(G, -h_0 / u_c)),
)
EXPRESSIONS: tuple[sp.Expr, ...] = (
    *(u_c, u_a, U_a, h, G, h_0, f_c, b_0, theta, C, du, u_cum),
    *(f_c * u_c, u_c / f_c, 1 / f_c, f_c**2, u_c - b_0, C * t, b_0 + C * t, h_0 + f_c * u_c),
    *(sp.sqrt(f_c), sp.log(f_c), sp.exp(-f_c), sp.Abs(f_c), U_a / u_c, C * t / u_c, G * u_c),
    *(sp.S.Zero, sp.S.One, -sp.S.One, sp.tanh(b_0), (f_c**2 - 1) / (f_c - 1), later(u_c) - u_c),
)
FUNCTIONS = tuple(sp.Lambda(y, e) for e in (2 * y, -y, 1 / y, sp.exp(y), sp.tanh(y), y**2, f_c * y))
LOADS = (assume(CONSTANT), assume(PERIODIC))

expressions = st.sampled_from(EXPRESSIONS)
functions = st.sampled_from(FUNCTIONS)
equations = st.builds(lambda a, b: sp.Eq(a, b, evaluate=False), expressions, expressions)
ends = st.builds(lambda a, b: sp.Eq(forever(a), b, evaluate=False), expressions, expressions)
orders = st.sampled_from([sp.Ge, sp.Gt, sp.Le, sp.Lt, sp.Ne, sp.Eq])
relations = st.builds(lambda r, a, b: r(a, b, evaluate=False), orders, expressions, expressions)
hypotheses = st.builds(
    Hypothesis,
    st.sampled_from(RELATIONS),
    st.sampled_from([Kind.CONDITION, Kind.CONDITION, Kind.DEFINITION]),
)
FREE: tuple[Callable[[], Rule], ...] = (
    algebra.Substitute,
    calculus.Integrate,
    calculus.Grows,
    calculus.Differentiate,
    limits.OnePeriodLater,
    growth.Unbounded,
    limits.Vanishes,
    limits.Accumulates,
    drift.FirstOrder,
)
rules = st.one_of(
    st.sampled_from(FREE).map(lambda kind: kind()),
    st.builds(algebra.Solve, expressions),
    st.builds(algebra.Insert, equations),
    st.builds(algebra.Consequence, relations),
    st.builds(inequalities.Arithmetic, relations),
    st.builds(inequalities.Monotone, functions),
    st.builds(inequalities.Lipschitz, functions, expressions, expressions, expressions),
    st.builds(data.DataDerivative, equations, st.sampled_from([f_c, h_0])),
    st.builds(growth.Diverges, expressions),
    st.builds(growth.AtInfinity, ends, st.just(1 / u_c)),
    st.builds(limits.Passes, ends),
    st.builds(solutions.Separate, equations),
    st.builds(solutions.ByParts, expressions),
    st.builds(solutions.Lambert, expressions),
)
drawn_chains = st.tuples(
    st.lists(hypotheses, min_size=2, max_size=5),
    st.lists(st.tuples(rules, st.lists(st.integers(0, 9), max_size=4)), min_size=4, max_size=12),
)
Chain = tuple[Sequence[Hypothesis], Sequence[tuple[Rule, Sequence[int]]]]


def concluded(chain: Chain) -> list[Judgement]:
    """Return what the rules make of hypotheses, one after the other, but what they refuse."""
    supposed, steps = chain
    known = list(LOADS)
    for hypothesis in supposed:
        known += filter(None, [applied(Assume(hypothesis))])
    found = []
    for rule, places in steps:
        made = applied(rule, *(known[-1 - place % len(known)] for place in places))
        if made is not None and made.claim not in [judgement.claim for judgement in known]:
            known.append(made)
            found.append(made)
    return found


def applied(rule: Rule, *premises: Judgement) -> Judgement | None:
    try:
        return infer(rule, *premises)
    except (RuleError, TimeLimitError):
        return None


@settings(max_examples=300, deadline=None, suppress_health_check=list(HealthCheck))
@given(drawn_chains)
def test_no_model_breaks_what_rules_conclude(chain: Chain) -> None:
    for judgement in concluded(chain):
        answer = try_on_models(judgement)
        assert answer.passed, (judgement.hypotheses, judgement.relation, str(answer))
