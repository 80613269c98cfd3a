"""The falsifier: every false statement is broken by a model, no true neighbour is."""

import pytest
import sympy as sp

from derive.falsifier.verdict import falsify, needed
from derive.symbols import initial, rate, symbols
from tests.derive.false_statements import (
    BOUNDED,
    CASES,
    CONSTANT,
    GAP,
    RATE,
    SIZE,
    STEADY,
    Case,
    forever,
)

MANY = 400
f_c, h_0, u_c, U_a, p, p_max = symbols("f_c h_0 u_c U_a p p_max")


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.said)
def test_a_false_statement_is_falsified(case: Case):
    answer = falsify(case.given, case.false, MANY, enough=MANY)
    assert answer.counterexample is not None
    assert str(answer.counterexample) or not case.false.free_symbols


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.said)
def test_its_true_neighbour_is_not(case: Case):
    answer = falsify(*case.neighbour, enough=4)
    assert answer.passed, str(answer.counterexample)
    assert answer.decided >= 4


def test_hypotheses_that_exclude_each_other_are_vacuous():
    assert falsify((sp.Gt(f_c, 1), sp.Lt(f_c, 0)), sp.Eq(h_0, 1)).vacuous


def test_the_same_counterexample_is_found_again():
    case = CASES[0]
    assert falsify(case.given, case.false) == falsify(case.given, case.false)


def test_each_hypothesis_of_the_steady_rate_is_needed():
    claim = sp.Eq(forever(rate("u_c")), STEADY)
    given = (RATE, sp.Eq(initial("u_c"), 0), sp.Gt(f_c, 0), BOUNDED)
    found = {row.hypothesis: row.counterexample for row in needed(given, claim, 30)}
    assert found[sp.Gt(f_c, 0)] is not None
    assert "f_c = -" in str(found[sp.Gt(f_c, 0)]) or "f_c = 0" in str(found[sp.Gt(f_c, 0)])
    assert found[BOUNDED] is not None
    assert found[RATE] is not None


def test_a_superfluous_hypothesis_has_no_counterexample():
    claim = sp.Le(
        GAP / SIZE, 1 / f_c + (symbols("sigma_c0")[0] / f_c + h_0 + symbols("U")[0]) / SIZE
    )
    given = (sp.Gt(f_c, 0), BOUNDED, sp.Ge(u_c, 0), CONSTANT)
    found = {row.hypothesis: row.counterexample for row in needed(given, claim)}
    assert found[CONSTANT] is None
    assert found[sp.Gt(f_c, 0)] is not None


def test_the_domain_of_a_quantity_is_a_hypothesis_too():
    positive = sp.Gt(p_max, 0, evaluate=False)
    (row,) = needed((positive,), sp.Ge(2 * p_max, p_max, evaluate=False))
    assert row.counterexample is not None
