"""Conditions as data: words or LaTeX, a guard for numbers, what each equation needs."""

from __future__ import annotations

import re

import pytest
import sympy as sp

from derive import catalogue
from derive.claims import Asymptotic, Equality, Limit
from derive.equations import Equation
from derive.hypotheses import Hypothesis, Kind
from derive.kernel import Judgement, RuleError
from derive.results import validity
from derive.rules.algebra import Insert
from derive.rules.assumption import assume, defined
from derive.rules.inequalities import Arithmetic
from derive.rules.reading import CONSTANT, PERIODIC
from derive.symbols import symbols, t
from derive.typeset.mathml import display
from tests.derive.rules.algebra import defined_as

b_0, f_c, h_0, kappa, G, U_a = symbols("b_0 f_c h_0 kappa G U_a")


def test_every_condition_reads_as_latex() -> None:
    for condition in {h for e in catalogue.all_equations() for h in e.hypotheses if h.shown}:
        assert condition.text
        assert condition.latex
        for words in re.findall(r"\\text\{([^}]*)\}", condition.latex):
            assert not set(words) & set("_^()/=$\\"), "a formula in words"
        assert "<math" in display(condition.latex)


def test_a_value_that_meets_a_condition_leaves_none() -> None:
    threshold, special = (catalogue.equation(i).conditions for i in ("threshold", "one-eighth"))
    assert set(threshold) - set(special) == {validity.RESOLVED}
    assert set(special) < set(threshold)


def test_what_cannot_be_is_no_hypothesis() -> None:
    with pytest.raises(RuleError, match="cannot be assumed"):
        assume(Hypothesis("nothing", sp.Gt(sp.Integer(0), 1)))


def test_a_name_has_a_value_under_the_conditions_that_are_shown() -> None:
    """b_0 = sqrt(f_c) and b_0 = 1/f_c hide a condition on f_c from who sees b_0 alone."""
    for value, condition in ((sp.sqrt(f_c), sp.Ge(f_c, 0)), (1 / f_c, sp.Ne(f_c, 0))):
        claim = Arithmetic(condition)(defined(b_0, value))
        (shown,) = Equation("own", "", "", (claim,)).conditions
        assert shown.relation == condition
        growing = Arithmetic(sp.Gt(f_c**3, 0))(claim, assume(Hypothesis("grows", sp.Gt(f_c, 0))))
        assert [h.text for h in Equation("own", "", "", (growing,)).conditions] == ["grows"]


@pytest.mark.parametrize(
    ("made", "shown"),
    [
        (defined_as(sp.Eq(G - sp.log(f_c), 0)), "f_c > 0"),
        (defined(sp.Symbol("scale", positive=True), f_c), "scale > 0"),
        (
            Insert(sp.Eq(kappa, sp.exp(b_0)))(
                defined(b_0, sp.log(kappa)), defined_as(sp.Eq(kappa, f_c))
            ),
            "kappa > 0",
        ),
    ],
    ids=str,
)
def test_a_definition_shows_what_it_hides(made: Judgement, shown: str) -> None:
    stated = Equation("x", "1", "hidden", (Arithmetic(sp.Ge(h_0, 0, evaluate=False))(made),))
    assert shown in [str(condition.relation) for condition in stated.conditions]


def test_a_sign_that_the_vocabulary_does_not_tell_is_shown() -> None:
    scale = sp.Symbol("scale", positive=True)
    stated = Equation("x", "1", "sign", (Arithmetic(sp.Gt(scale, 0, evaluate=False))(),))
    assert [str(condition.relation) for condition in stated.conditions] == ["scale > 0"]


def test_a_limit_that_only_a_definition_supposes_is_shown() -> None:
    """Of U_a = U sin(t) there is none."""
    end = sp.Limit(U_a, t, sp.oo)
    made = Insert(sp.Eq(end, b_0, evaluate=False))(defined(b_0, end))
    assert [c.text for c in Equation("x", "1", "end", (made,)).conditions] == ["U_a has a limit"]


def test_every_equation_of_section_4_says_what_it_needs() -> None:
    """(14) to (22): smooth, unworn pin; rigid support; no loss of contact; f_c > 0; bounded."""
    for identifier in ("14", "15", "16a", "16b", "17a", "17b", "18", "21", "22"):
        said = {h.text for h in catalogue.equation(identifier).conditions}
        assert said == {
            "smooth pin",
            "unworn pin",
            "no cross coupling of roughness",
            "rigid support",
            "no loss of contact",
            "the bearing roughens as it wears",
            "the load is bounded by U",
        }


CHAIN = {
    "saturating-wear": (Asymptotic, {"constant load", "the bearing smoothens as it wears"}),
    "logarithmic-wear": (
        Asymptotic,
        {"wear does not change the roughness", "load U sin(2 pi t/T)"},
    ),
    "one-third": (Equality, {"gap and cutoff grow alike", PERIODIC.text}),
    "two-solids-log-drift": (Limit, {"load of period T", "the load is bounded by U"}),
    "static-wear-smooth": (Equality, {"constant load", "wear does not change the roughness"}),
    "slope-from-pressure": (Equality, {"there is wear", "the mean surfaces do not coincide"}),
    "static-solution-compliant": (Equality, {"the pressure is not that of steady wear"}),
    "arrest-depth": (Equality, {"the gap outgrows the roughness"}),
    "permanent-contact": (Equality, {"the roughness outgrows the gap"}),
    "13": (Equality, {"smooth pin", "unworn pin", "rigid support", "no loss of contact"}),
}


@pytest.mark.parametrize("identifier", CHAIN)
def test_what_said_less_than_it_needs_says_it_now(identifier: str) -> None:
    """Each was recorded without these once, and was false as recorded."""
    kind, needed = CHAIN[identifier]
    first = catalogue.equation(identifier).statements[0]
    assert type(first.claim) is kind
    assert needed <= {h.text for h in first.conditions}


def test_what_a_definition_and_the_model_say_is_not_a_condition() -> None:
    equation = catalogue.equation("21")
    kinds = {h.kind for h in equation.hypotheses} - {h.kind for h in equation.conditions}
    assert kinds == {Kind.MODEL, Kind.DEFINITION, Kind.INITIAL}


def test_words_are_kept_where_a_relation_is_long_or_missing() -> None:
    assert CONSTANT.typed == "constant load"
    long = Hypothesis("the roughness is real", sp.Gt(sum(sp.symbols("a:z")), 0))
    assert long.typed == "the roughness is real"


def test_a_guard_says_no() -> None:
    slope = sp.Symbol("f_c", real=True)
    condition = Hypothesis("the bearing roughens", sp.Gt(slope, 0))
    assert condition.guard({"f_c": -0.05}) is False
    assert condition.guard({"f_a": 0.05}) is None


def test_the_sign_of_a_name_is_a_condition_unless_it_follows() -> None:
    """The gap h* is positive by the vocabulary, which h_0 - sigma_c0/f_c - U_a need not be."""
    shown = {i: catalogue.equation(i).conditions for i in ("saturating-wear", "22", "20")}
    assert "h_star > 0" in {h.text for h in shown["saturating-wear"]}
    assert not {"p_inf > 0", "u_cum > 0"} & {h.text for i in ("20", "22") for h in shown[i]}
