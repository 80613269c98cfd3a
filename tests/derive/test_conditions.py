"""Conditions as data: their words and LaTeX, and what each equation needs."""

from __future__ import annotations

import re
from dataclasses import fields

import pytest
import sympy as sp

from derive import catalogue, hypotheses
from derive.claims import Asymptotic, Equality, Equivalence, Limit
from derive.equations import Equation
from derive.hypotheses import (
    CONSTANT,
    CONTINUOUS,
    KEPT,
    NOT_SMOOTHING,
    PERIODIC,
    RIGID,
    ROUGHENING,
    SLOPED,
    SMOOTH_PIN,
    SMOOTHING,
    UNCOUPLED,
    UNWORN_PIN,
    Hypothesis,
    Kind,
)
from derive.kernel import RuleError
from derive.language import names
from derive.laws import EXPONENTIAL, GENERAL, TANH
from derive.note.model import CLOSURE, FIELDS, SLIP, at_every_closure, contact
from derive.results import validity
from derive.rules.algebra import Insert
from derive.rules.assumption import assume, defined
from derive.rules.inequalities import Arithmetic
from derive.symbols import DATA, symbols, t
from derive.typeset.mathml import display
from tests.derive.judgements import eq, equal

b_0, f_c, h_0, kappa, U, U_a, U_c, T, tau = symbols("b_0 f_c h_0 kappa U U_a U_c T tau")
h, sigma = symbols("h sigma")


def test_every_condition_reads_as_latex() -> None:
    for condition in {h for e in catalogue.all_equations() for h in e.hypotheses if h.shown}:
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
        assume(Hypothesis(sp.false))


def test_a_definition_shows_what_it_supposes() -> None:
    """b_0 = sqrt(f_c) and b_0 = 1/f_c hide a condition on f_c from who sees b_0 alone."""
    scale = sp.Symbol("scale", positive=True)
    for name, value, condition in (
        (b_0, sp.sqrt(f_c), sp.Ge(f_c, 0)),
        (b_0, 1 / f_c, sp.Ne(f_c, 0)),
        (scale, f_c, sp.Gt(f_c, 0)),
        (b_0, sp.Integral(U_a, (t, 0, 1)), CONTINUOUS.relation),
    ):
        (shown,) = defined(name, value).conditions
        assert shown.relation == condition
    assert defined(b_0, 1 / f_c, assume(ROUGHENING)).conditions == (ROUGHENING,)


def test_names_are_shown_with_what_they_mean() -> None:
    """That of b_0, and of kappa, which that has; none that says nothing of the claim."""
    positive = Arithmetic(sp.Ge(b_0, 1))(
        defined(b_0, 1 + kappa**2),
        defined(kappa, sp.exp(h_0)),
        defined(sp.Symbol("z", real=True), h_0),
    )
    shown = Equation("x", "1", "names", (positive,)).definitions
    assert [h.relation.lhs for h in shown] == [b_0, kappa]
    assert not Equation("x", "1", "itself", (defined(kappa, sp.exp(h_0)),)).definitions


def test_a_name_stands_in_no_setting_and_no_condition_of_its_definition() -> None:
    """The load of "b_0 = U_a if b_0 = U_a(0)" would be any that begins at zero."""
    still, known = defined(b_0, U_a, assume(CONSTANT)), eq(U_a, U)
    gap = Insert(equal(h, h_0 - b_0))(eq(h, h_0 - U_a), still)
    for stated in (still, gap):
        assert CONSTANT in Equation("x", "1", "load", (stated,)).conditions
    assert Equation("x", "1", "load", (defined(b_0, U_a, known),)).conditions == known.conditions


def test_what_is_negligible_is_so_in_a_limit_that_is_shown() -> None:
    for identifier, end in (
        ("logarithmic-wear", r"o_{N \to \infty}\left(1\right)"),
        ("saturating-wear", r"o_{\sigma_c \to 0}\left(1\right)"),
        ("expansion", r"o_{m \to \infty}\left(\frac{1}{m^{3}}\right)"),
    ):
        assert end in catalogue.equation(identifier).latex


def test_a_sign_that_the_vocabulary_does_not_tell_is_shown() -> None:
    scale = sp.Symbol("scale", positive=True)
    stated = Equation("x", "1", "sign", (Arithmetic(sp.Gt(scale, 0, evaluate=False))(),))
    assert [str(condition.relation) for condition in stated.conditions] == ["scale > 0"]


def test_every_equation_of_section_4_says_what_it_needs() -> None:
    """(14) to (22): smooth, unworn pin; rigid support; no loss of contact; f_c > 0; bounded.

    (16b) and (17b) speak of the roughness of the bearing alone, which wear makes grow under a rough
    pin, too.
    """
    for identifier in ("14", "15", "16a", "16b", "17a", "17b", "18", "21", "22"):
        said = {h.text for h in catalogue.equation(identifier).conditions}
        smooth = set() if identifier in ("16b", "17b") else {"smooth pin"}
        assert said == smooth | {
            "unworn pin",
            "rigid support",
            "no loss of contact",
            "wear of the bearing roughens it",
            "the load is bounded by U",
        }


CHAIN = {
    "saturating-wear": (Asymptotic, {"constant load", "wear of the bearing smooths it"}),
    "logarithmic-wear": (
        Asymptotic,
        {"wear of the bearing does not change its roughness", "U_a = U*sin(2*pi*t/T)"},
    ),
    "one-third": (Equality, {"f_c = 1/3", "continuous load", "load of period T"}),
    "two-solids-log-drift": (
        Limit,
        {"load of period T", "continuous load", "f_a >= 0", NOT_SMOOTHING.text, "f_a + f_c > 0"},
    ),
    "closed-gap": (Equivalence, {"wear of the bearing changes its roughness"}),
    "static-wear-smooth": (
        Equality,
        {"constant load", "wear of the bearing does not change its roughness"},
    ),
    "slope-from-pressure": (Equality, {"the mean surfaces do not coincide"}),
    "static-solution-compliant": (Equality, {"4/f_c + log(p/(p_max - p)) - 8 != 0"}),
    "arrest-depth": (Equality, {"f_c < 1/3"}),
    "permanent-contact": (Equality, {"f_c > 1/3"}),
    "13": (Equality, {"smooth pin", "unworn pin", "rigid support", "no loss of contact"}),
}


def test_a_periodic_and_continuous_load_needs_no_bound() -> None:
    for found in catalogue.all_equations():
        said = {h.text for h in found.conditions}
        assert not said >= {"load of period T", "continuous load", "the load is bounded by U"}


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


def test_words_belong_to_a_relation() -> None:
    """Nobody can give a relation words of his own, or none; what is equal reads alike."""
    assert [field.name for field in fields(Hypothesis)] == ["relation", "kind"]
    assert Hypothesis(sp.Eq(U_c, 0)) == RIGID
    assert Hypothesis(sp.Eq(U_c, 0)).text == "rigid support"
    with pytest.raises(TypeError, match="text"):
        Hypothesis(sp.Gt(U_c, 0), text="rigid support")  # type: ignore[call-arg]
    with pytest.raises(RuleError, match="no claim"):
        assume(Hypothesis("rigid support"))  # type: ignore[arg-type]


def test_conditions_with_words_read_differently() -> None:
    settings = (SMOOTH_PIN, UNWORN_PIN, RIGID, *UNCOUPLED, PERIODIC, CONSTANT, CONTINUOUS)
    signs = (ROUGHENING, KEPT, SMOOTHING, NOT_SMOOTHING, SLOPED)
    texts = [condition.text for condition in (*settings, *signs)]
    assert len(set(texts)) == len(texts)


def test_what_has_no_words_is_shown_as_it_is_typed() -> None:
    """Among them what has words for other names, or another contact law."""
    scale = sp.Symbol("scale", real=True)
    for relation, text in (
        (sp.Ne(scale, 0), "scale != 0"),
        (sp.Eq(U_c, h_0), "U_c = h_0"),
        (sp.And(scale > 0, scale < h_0), "scale > 0, scale < h_0"),
        (at_every_closure(EXPONENTIAL), "p = p_max*exp(-h/sigma)"),
    ):
        assert Hypothesis(relation).text == text
        assert not Hypothesis(relation).is_setting


def test_another_contact_law_than_the_notes_is_a_condition() -> None:
    touches = assume(Hypothesis(sp.Le(h, 3 * sigma)))
    for law, shown in ((TANH, 0), (GENERAL, 1), (EXPONENTIAL, 1)):
        model = Hypothesis(contact(law), Kind.MODEL)
        conditions = Arithmetic(at_every_closure(law))(assume(model), touches).conditions
        assert conditions == (*[model] * shown, *touches.conditions)


def test_words_are_about_quantities_that_nobody_defines() -> None:
    """The load is not steady where beta = 2 (b_0 + U_a) is not zero: beta may stand for others.

    A contact law decreases at every r, whatever r is.
    """
    meant = {*DATA, *(field.__name__ for field in FIELDS), "f_aa", "f_cc", "omega", "phi", "r", "t"}
    for table in (hypotheses._SETTINGS, hypotheses._OTHERS):
        for relation in table:
            assert {name for name, _ in names(relation)} <= meant, relation


def test_an_equation_in_phi_says_what_phi_is() -> None:
    for found in catalogue.all_equations():
        if found.relation.has(GENERAL.phi.func):
            assert any("decreasing contact law phi" in h.text for h in found.conditions)


def test_every_hypothesis_with_words_is_one_of_the_catalogue() -> None:
    every = catalogue.all_equations()
    used = {h.relation for e in every for h in (*e.hypotheses, *e.signs)}
    unused = {*hypotheses._SETTINGS, *hypotheses._OTHERS} - used
    assert unused == {*SLIP, CLOSURE[True]}


def test_the_sign_of_a_name_is_a_condition_unless_it_follows() -> None:
    """The gap h* is positive by the vocabulary, which h_0 - sigma_c0/f_c - U_a need not be; it is
    said in the names that the equation has."""
    shown = {i: catalogue.equation(i).conditions for i in ("saturating-wear", "21", "22")}
    assert "h_star > 0" in {h.text for h in shown["saturating-wear"]}
    assert [h.text for h in catalogue.equation("20").conditions] == ["u_cum > 0"]
    assert not any("Limit" in h.text for i in ("21", "22") for h in shown[i])
