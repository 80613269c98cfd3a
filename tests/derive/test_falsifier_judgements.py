"""Judgements of the chain are tried on models, and every hypothesis has a reason."""

import sympy as sp

from derive import catalogue
from derive.falsifier.verdict import counterexample_without, try_on_models
from derive.hypotheses import CONTINUOUS
from derive.reasons import outdated, table
from derive.rules.assumption import assume
from derive.rules.drift import LeadingTerm
from derive.symbols import symbols
from tests.derive.judgements import eq, gt


def test_a_relation_towards_an_end_of_a_field_is_tried_where_the_field_tends_to_it():
    G, q, sigma_c = symbols("G q sigma_c")
    leading = LeadingTerm(sp.Eq(sp.log(G), sp.log(q / sigma_c)))
    answer = try_on_models(leading(eq(G, q / sigma_c + 1 / q), gt(q, 0, False)))
    assert answer.passed, str(answer)
    assert answer.decided


def test_no_model_decides_that_a_field_is_continuous():
    continuous = assume(CONTINUOUS)
    answer = try_on_models(continuous)
    assert not answer.vacuous
    assert answer.decided == 0


def test_a_condition_of_the_threshold_is_needed():
    (statement,) = catalogue.equation("threshold").statements
    (grows,) = (h for h in statement.conditions if h.brief == "f_c > 0")
    assert "f_c = 0" in str(counterexample_without(statement, grows))


def test_the_table_of_reasons_is_of_these_equations():
    """`python -m derive.reasons` renews it."""
    of_the_note = [found for found in catalogue.all_equations() if found.id[0].isdigit()]
    assert outdated(of_the_note, table()) == []


def test_a_reason_is_missing_for_a_condition_that_is_new():
    found = catalogue.equation("13")
    rows = [row for row in table() if row.condition != "smooth pin"]
    assert outdated([found], rows) == ["13"]
