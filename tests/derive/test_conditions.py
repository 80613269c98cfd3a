"""Conditions as data: words or LaTeX, a guard for numbers, samples that respect them."""

from __future__ import annotations

import re

import pytest
import sympy as sp

from derive import catalogue
from derive.conditions import Condition
from derive.results import static_solution, validity
from derive.rules import Given, sources
from derive.sample import atoms, holds, satisfying
from derive.statement import Statement
from derive.typeset.mathml import mathml

STATED: dict[Condition, Statement] = {}
for _equation in catalogue.equations():
    for _step in _equation.steps:
        for _condition in _step.conditions:
            if not isinstance(_step.rule, Given) and isinstance(_condition.relation, sp.Basic):
                STATED.setdefault(_condition, _step)


@pytest.mark.parametrize("condition", STATED, ids=lambda c: c.text)
def test_a_condition_reads_as_latex(condition: Condition) -> None:
    assert condition.text
    assert condition.latex
    for words in re.findall(r"\\text\{([^}]*)\}", condition.latex):
        assert not set(words) & set("_^()/=$\\"), "a formula in words"
    assert "<math" in mathml(condition.latex)


@pytest.mark.parametrize("condition", STATED, ids=lambda c: c.text)
def test_a_condition_can_be_met_and_its_guard_says_so(condition: Condition) -> None:
    if condition.relation is sp.true:
        assert condition.guard({}) is None
        return
    found = sources(STATED[condition])
    (world,) = satisfying(found.values(), condition.relation, (condition,), 1)
    names = {str(a.func) if a.args else str(a): float(world[a]) for a in atoms(condition.relation)}
    assert holds(condition.relation, world)
    assert condition.guard(names) is True


def test_a_value_that_meets_a_condition_leaves_none() -> None:
    threshold, special = (catalogue.equation(i).conditions for i in ("threshold", "one-eighth"))
    assert set(threshold) - set(special) == {validity.RESOLVED}
    assert set(special) < set(threshold)


def test_words_are_kept_where_a_relation_is_long_or_missing() -> None:
    assert static_solution.CONSTANT_LOAD.typed == "the load does not vary"
    assert not static_solution.CONSTANT_LOAD.met_by({})
    long = Condition("the roughness is real", sp.Gt(sum(sp.symbols("a:z")), 0))
    assert long.typed == "the roughness is real"


def test_a_guard_says_no() -> None:
    slope = sp.Symbol("f_c", real=True)
    condition = Condition("the bearing roughens", sp.Gt(slope, 0))
    assert condition.guard({"f_c": -0.05}) is False
    assert condition.guard({"f_a": 0.05}) is None
