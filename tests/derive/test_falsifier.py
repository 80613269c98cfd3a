"""The falsifier: every false statement is broken by a model, no true neighbour is."""

import os

import pytest
import sympy as sp
from flint import arb, fmpq

from derive import catalogue
from derive.claims import Drift, FirstZero, Oscillation
from derive.falsifier import trend
from derive.falsifier.balls import ZERO, UndecidedError, UndefinedError, integral
from derive.falsifier.verdict import counterexample_without, falsify
from derive.symbols import initial, rate, symbols, t
from tests.derive.false_statements import BOUNDED, CASES, CONSTANT, GAP, RATE, SIZE, STEADY, forever
from tests.programs import python

MANY = range(400)
f_c, h_0, u_c, U_a, G, p_max = symbols("f_c h_0 u_c U_a G p_max")


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.said)
def test_a_false_statement_is_falsified(case):
    answer = falsify(case.given, case.false, MANY, enough=len(MANY))
    assert answer.counterexample is not None
    assert str(answer.counterexample) or not case.false.free_symbols


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.said)
def test_its_true_neighbour_is_not(case):
    answer = falsify(*case.neighbour, enough=2)
    assert answer.passed, str(answer.counterexample)
    assert answer.decided >= 2


def test_hypotheses_that_exclude_each_other_are_vacuous():
    assert falsify((sp.Gt(f_c, 1), sp.Lt(f_c, 0)), sp.Eq(h_0, 1)).vacuous


def test_a_false_hypothesis_is_vacuous():
    assert falsify((sp.false,), sp.Eq(h_0, 1)).vacuous


def test_an_infinite_side_is_shown_with_its_sign():
    sinking = falsify((), sp.Eq(forever(-h_0 * t), -sp.oo))
    assert "0 on the left, -oo on the right" in str(sinking)


def test_a_counterexample_has_no_values_that_equations_determine():
    """The deflection of a support under pressure is the root of its equation."""
    p, U_c, k = symbols("p U_c k")
    given = (sp.Eq(p, p_max * sp.exp(-(h_0 + U_c) / h_0)), sp.Eq(k * U_c - p, 0))
    broken = falsify(given, sp.Eq(U_c, 1)).counterexample
    assert {str(e.lhs) for e in broken.model} == {"h_0", "k", "p_max"}
    assert "0.358912 on the left, 1 on the right" in broken.where


def test_a_condition_against_the_model_is_vacuous_however_it_is_spelled():
    """A support under pressure is deflected."""
    p, U_c, k = symbols("p U_c k")
    law = sp.Eq(p, p_max * sp.exp(-(h_0 + U_c) / h_0))
    for condition in (sp.Eq(U_c, 0), sp.Eq(2 * U_c, 0), sp.Le(p, 0)):
        said = (law, sp.Eq(k * U_c - p, 0), condition)
        assert "vacuous" in str(falsify(said, sp.Eq(h_0, 1)))


def test_what_models_cannot_decide_is_not_vacuous():
    unknown = sp.Eq(h_0, sp.besselj(0, p_max))
    assert "not tried" in str(falsify((unknown,), sp.Eq(h_0, 1)))


def test_the_same_counterexample_is_found_again():
    case = CASES[0]
    assert falsify(case.given, case.false) == falsify(case.given, case.false)


def test_every_process_draws_the_same_models():
    """The parts of a condition are in the order of their hashes, which differ by process."""
    code = """
from derive.falsifier.draws import draw_model
from derive.written import read
given = (read("0 < h_0 < U < f_c < k < L < b < C"),)
print(*(sorted(map(str, draw_model(given, (), seed).values.items())) for seed in range(6)))
"""
    runs = {python(code, env={**os.environ, "PYTHONHASHSEED": str(seed)}) for seed in range(3)}
    assert len(runs) == 1


def test_each_hypothesis_of_the_steady_rate_is_needed():
    claim = sp.Eq(forever(rate("u_c")), STEADY)
    given = (RATE, sp.Eq(initial("u_c"), 0), sp.Gt(f_c, 0), BOUNDED)
    grows, bounded, law = (
        falsify(given, claim, range(30), dropped=dropped)
        for dropped in (sp.Gt(f_c, 0), BOUNDED, RATE)
    )
    assert any(f"f_c = {end}" in str(grows) for end in "-0")
    assert not bounded.passed
    assert not law.passed


def test_a_superfluous_hypothesis_has_no_counterexample():
    claim = sp.Le(
        GAP / SIZE, 1 / f_c + (symbols("sigma_c0")[0] / f_c + h_0 + symbols("U")[0]) / SIZE
    )
    given = (sp.Gt(f_c, 0), BOUNDED, sp.Ge(u_c, 0), CONSTANT)
    assert falsify(given, claim, dropped=CONSTANT).passed
    assert not falsify(given, claim, dropped=sp.Gt(f_c, 0)).passed


def test_the_domain_of_a_quantity_is_a_hypothesis_too():
    positive = sp.Gt(p_max, 0, evaluate=False)
    doubled = sp.Ge(2 * p_max, p_max, evaluate=False)
    assert falsify((positive,), doubled).passed
    assert not falsify((positive,), doubled, dropped=positive).passed


def test_a_field_without_a_value_breaks_no_claim():
    """Solved for G, the hypothesis leaves it without a value at a time at which trends are read."""
    late = symbols("T")[0] * (10**8 + sp.Rational(1, 20))
    assert falsify((sp.Eq(G * (t - late), h_0),), sp.Eq(forever(G), 0)).passed


def test_a_limit_over_a_datum_holds_the_others_fixed():
    """Only a name may follow the datum: u_cum, and not h_0."""
    named = sp.Eq(symbols("u_cum")[0], f_c**2 * h_0)
    assert falsify((named,), sp.Eq(sp.Limit(h_0, f_c, sp.oo), h_0), MANY, enough=len(MANY)).passed


def test_a_rate_that_is_lost_in_rounding_breaks_no_claim():
    slow = 1 - sp.tanh(100 * p_max)
    given = (sp.Eq(rate("u_c"), slow), sp.Eq(initial("u_c"), 0))
    assert falsify(given, sp.Eq(u_c, slow * t)).passed


def test_a_change_that_is_slow_is_no_change_for_ever():
    """As long as the fields are known, the rate falls by about 1e-9 of itself in a period."""
    C, T, L = symbols("C T L")
    slow = sp.Eq(rate("u_c"), C * sp.exp(-u_c * C * T / (10**9 * L**2)))
    change = slow.lhs.subs(u_c, u_c.subs(t, t + T)) - slow.lhs
    assert falsify((slow, sp.Eq(initial("u_c"), 0)), sp.Eq(forever(change), 0)).passed


def test_a_field_that_creeps_has_not_stopped():
    """It grows for ever, by less than a digit in all the time for which it is known."""
    creeping = (sp.Eq(rate("u_c"), sp.exp(-100)), sp.Eq(initial("u_c"), 1))
    found = falsify(creeping, sp.Eq(sp.Limit(u_c, t, sp.oo), sp.oo))
    assert found.passed
    assert found.models > found.decided == 0


def test_a_model_whose_fields_leave_their_domains_late_is_none():
    """The roughness is positive at the early times at which hypotheses are tried first."""
    smoothing = sp.Eq(symbols("sigma_c")[0], 1 - u_c / 1000)
    given = (sp.Eq(rate("u_c"), 1), sp.Eq(initial("u_c"), 0), smoothing)
    found = falsify(given, sp.Eq(sp.Limit(u_c, t, sp.oo), 1))
    assert found.passed
    assert found.models == 0


@pytest.mark.parametrize("constant", symbols("theta C q"), ids=str)
def test_a_constant_makes_constant_what_it_equals(constant):
    given = (sp.Eq(constant, h_0 - U_a),)
    later = sp.Eq(constant, h_0 - U_a.subs(t, t + symbols("T")[0]))
    holds_but_not(given, later, sp.Eq(constant, h_0))


def test_a_branch_is_taken_if_its_condition_is_decided():
    """At late times h is above L by less than all digits."""
    h, L, q = symbols("h L q")
    closed = sp.Piecewise((q, h <= L), (0, True))
    assert falsify((sp.Eq(G, closed), sp.Eq(h, L + sp.exp(-t)), sp.Gt(q, 0)), sp.Eq(G, 0)).passed


def test_the_two_sides_are_shown_to_as_many_digits_as_part_them():
    close = sp.Eq(h_0, 2 + sp.Rational(1, 10**9))
    broken = falsify((sp.Eq(h_0, 2),), close)
    assert "2 on the left, 2.000000001 on the right" in str(broken)


def holds_but_not(given, true, false):
    """The true claim holds in models of what is given, the false one fails in one of them."""
    answer = falsify(given, true, range(30))
    assert answer.passed, str(answer)
    assert answer.decided >= 2
    assert not falsify(given, false, range(30)).passed


def test_a_field_may_be_a_parameter_of_an_integral():
    wear = sp.Dummy("x")
    area = sp.Integral(wear + U_a, (wear, 0, h_0))
    value = h_0**2 / 2 + U_a * h_0
    holds_but_not((), sp.Eq(area, value), sp.Eq(area, h_0**2 / 2))


def test_an_integrand_that_varies_by_orders_of_magnitude_is_resolved():
    wear = sp.Dummy("x")
    area = sp.Integral(1 / wear**2, (wear, h_0, h_0 * sp.exp(20)))
    holds_but_not(
        (sp.Gt(h_0, 0),), sp.Eq(area, (1 - sp.exp(-20)) / h_0), sp.Eq(area, 1 / (2 * h_0))
    )


def test_a_first_zero_is_found_and_no_later_one():
    wear = sp.Dummy("x", real=True)
    zero = FirstZero((wear - h_0) * (wear - 3 * h_0), wear)
    holds_but_not((sp.Gt(h_0, 0),), sp.Eq(zero, h_0), sp.Eq(zero, 3 * h_0))


def test_coefficients_of_an_expansion_are_those_of_their_law():
    """Of F = 1 + (a + b sin)/s: w_1' = rho b sin, c_1 = a, c_2 = 0."""
    a, b, rho, tau = symbols("h_0 U rho tau")
    s = sp.Symbol("s", positive=True)
    law = 1 + (a + b * sp.sin(2 * sp.pi * tau)) / s
    c_1, c_2 = (Drift(sp.Integer(n), law, s, tau, rho) for n in (1, 2))
    wave = Oscillation(sp.S.One, law, s, tau, rho)
    v = sp.Function("v", real=True)(tau)
    named = (sp.Eq(v, wave),)
    holds_but_not((), sp.Eq(c_1, a), sp.Eq(c_1, a + b))
    holds_but_not((), sp.Eq(c_2, 0), sp.Eq(c_2, a))
    wanted = -rho * b * sp.cos(2 * sp.pi * tau) / (2 * sp.pi)
    holds_but_not(named, sp.Eq(v, wanted), sp.Eq(v, 2 * wanted))
    holds_but_not(named, sp.Eq(v.diff(tau), wanted.diff(tau)), sp.Eq(v.diff(tau), wanted))


def test_the_limit_of_an_increment_is_known_under_a_load_that_oscillates():
    """From 100 periods, at which the increment is still 1 % off."""
    T, u_cum = symbols("T u_cum")
    load = sp.Eq(U_a, sp.sin(2 * sp.pi * t / T))
    given = (
        load, RATE, sp.Eq(initial("u_c"), 0), sp.Eq(f_c, 1),
        sp.Eq(u_cum, forever(u_c.subs(t, t + T) - u_c)),
    )  # fmt: skip
    holds_but_not(given, sp.Eq(u_cum, STEADY.subs(f_c, 1) * T), sp.Eq(u_cum, STEADY.subs(f_c, 1)))


def test_scaled_time_needs_no_clock():
    v, tau = sp.Function("v", real=True), symbols("tau")[0]
    given = (sp.Eq(u_c, h_0 * v(tau)), sp.Eq(initial("u_c"), 0))
    holds_but_not(given, sp.Eq(u_c**2, h_0**2 * v(tau) ** 2), sp.Eq(u_c, h_0 * v(tau) + 1))


def test_a_slow_start_and_a_decay_by_fits_are_no_lack_of_a_limit():
    for middles in ([6.483, 6.483, 6.482, 6.480, 6.440], [1, 0.1, 0.05, 0.3, 0.01]):
        windows = [[arb(m * (1 - k * k / 1000)) for k in range(5)] for m in middles]
        with pytest.raises(UndecidedError):
            trend.limit(windows)
    for values in ([1, 2, 4, 8, 16], [1, 2, 3, 4, 5]):
        with pytest.raises(UndefinedError, match="no finite limit"):
            trend.limit([[arb(v)] for v in values])
    waves = [[arb(v) for v in (1, -1, 1, 0, -1)]] * 5
    with pytest.raises(UndefinedError, match="vary"):
        trend.limit(waves)


def test_what_falls_ever_faster_has_no_trend_yet():
    times = [10**k for k in (2, 3, 4, 5, 6)]
    slow = [[1 / (1 + arb(time * part) / 10**9) for part in (1, 2, 3)] for time in times]
    assert trend.tends_to(slow, arb(0)) is None
    settles = [[1 + 1 / arb(time * part) for part in (1, 2, 3)] for time in times]
    assert trend.tends_to(settles, arb(0)) is False
    waves = [[arb(1), arb(-1), arb(size) / 10] for size in (9, 9, 9, 9, 8)]
    assert trend.tends_to(waves, arb(0)) is False


def test_slow_trends_are_told_from_limits():
    """log log t grows, if by a few per cent; 1/log t brings a field near other numbers first."""
    T = symbols("T")[0]
    slow = sp.Eq(G, 50 + sp.log(1 + sp.log(1 + t / T)))
    assert falsify((slow,), sp.Eq(forever(1 / G), 0)).passed
    near = (sp.Eq(G, h_0 * (1 + 100 / (1 + sp.log(1 + t / T)))), sp.Gt(h_0, 0))
    assert falsify(near, sp.Eq(forever(G), h_0)).decided
    for part in (-2, 0, sp.Rational(1, 2)):
        assert not falsify(near, sp.Eq(forever(G), part * h_0)).decided


def test_a_load_that_goes_on_to_vary_leaves_a_limit_refutable():
    """Late times are then out of reach; faster wear confirms that the rate has no limit."""
    (statement,) = catalogue.equation("14").statements
    (bounded,) = (h for h in statement.conditions if h.brief == "|U_a| <= U")
    broken = counterexample_without(statement, bounded)
    assert "sin(t/T)" in str(broken)


def test_a_condition_may_be_there_for_the_meaning_of_a_name():
    """Without it no positive u_cum exists, so that the equation has no instance."""
    (statement,) = catalogue.equation("20").statements
    (grows,) = statement.conditions
    broken = counterexample_without(statement, grows)
    assert broken is not None
    assert "u_cum > 0 fails" in str(broken)


@pytest.mark.parametrize(
    ("function", "value"),
    [
        (lambda x: arb(x) ** arb("-0.9"), 10),
        (lambda x: 1 / arb(x).sqrt(), 2),
        (lambda x: arb(x).log(), -1),
        (lambda x: arb(x < fmpq(1, 3)), arb(1) / 3),
    ],
    ids=["power -9/10", "root", "logarithm", "step"],
)
def test_the_error_of_an_integral_to_a_singularity_bounds_it(function, value):
    found = integral(function, ZERO, fmpq(1))
    assert found.contains(value)
    assert found.rad() < 1


@pytest.mark.parametrize(
    "function",
    [lambda x: 1 / arb(x), lambda x: arb(x) ** arb("-1.1"), lambda x: 1 / (arb(x) - arb(1) / 3)],
    ids=["inverse", "power -11/10", "pole inside"],
)
def test_a_divergent_integral_has_no_value(function):
    with pytest.raises(UndecidedError, match="diverge"):
        integral(function, ZERO, fmpq(1))


def test_a_sharp_peak_that_decays_goes_on_to_vary_for_no_window() -> None:
    """A pressure that falls like 1/t and swings by a factor of 55 within a period of the load."""
    values = (
        (0.604, 0.467, 0.333, 0.037, 0.026), (0.009, 0.0086, 0.0046, 0.031, 0.019),
        (0.011, 0.0076, 0.0013, 0.003, 0.0005), (0.016, 0.036, 0.005, 0.011, 0.0003),
    )  # fmt: skip
    windows = [[arb(value) for value in window] for window in values]
    with pytest.raises(UndecidedError):
        trend.limit(windows)
