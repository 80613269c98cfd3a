"""Every step of every derivation proves itself, and no wrong step can."""

import re
from contextlib import suppress
from dataclasses import replace
from functools import cache

import pytest
import sympy as sp

from derive import catalogue
from derive.check import step_checks
from derive.equations import TEXTS, Equation, Status, numbered
from derive.falsifier.verdict import try_on_models
from derive.hypotheses import Hypothesis
from derive.kernel import Judgement, RuleError, chain, infer, replay_fault
from derive.laws import EXPONENTIAL, GENERAL, LAWS, TANH
from derive.note import condensed, governing
from derive.note.condensed import CondensedProblem
from derive.note.governing import NoteModel, Pin
from derive.note.problems import problem_i, problem_ii, undetermined
from derive.rules.assumption import Assume, assume
from derive.symbols import symbol, symbols
from derive.typeset.derivation import Derivations
from derive.verification import verify
from derive.written import evaluated
from derive.zero import same
from tests.derive.mutation import mutants

NOTE = [
    *("1", "2a", "2b", "3", "4", "5", "6", "7a", "7b", "7c", "7d", "7e", "7f", "7g", "8", "9"),
    *("10", "11", "12", "13", "14", "15", "16a", "16b", "17a", "17b", "18", "19", "20", "21", "22"),
]
SEVERAL = (
    *("groups-one-solid", "groups-compliant", "expansion-drift", "elasticities"),
    "static-solution-compliant",
)


@cache
def _steps() -> list[Judgement]:
    """Return the steps of all equations, each claim by each rule once."""
    found: dict[tuple[sp.Basic, str], Judgement] = {}
    for equation in catalogue.all_equations():
        for step in equation.steps:
            found.setdefault((step.relation, repr(step.rule)), step)
    return [step for step in found.values() if not isinstance(step.rule, Assume)]


def test_the_note_is_there_in_its_order():
    ids = [equation.id for equation in catalogue.all_equations()]
    assert [i for i in ids if i[0].isdigit()] == NOTE
    assert sorted(ids) == sorted(TEXTS)


def test_no_model_breaks_an_equation():
    """Of several results of one kind the first is tried, of some all; ``derive verify`` tries every
    step. Models decide all but two of them: the expansion, and what is claimed of any law."""
    for found in catalogue.all_equations():
        tried = found.statements if found.id in {*NOTE, *SEVERAL} else found.statements[:1]
        for answer in map(try_on_models, tried):
            assert answer.passed, (found.id, str(answer))
            assert bool(answer.decided) is (found.id not in {"expansion", "log-drift-any-law"})


def test_what_is_typeset_is_what_was_derived():
    for equation in catalogue.all_equations():
        assert len(equation.shown) == len(equation.claims), equation.id
        assert equation.typeset_agrees, equation.id
        if not equation.where:
            for shown, claim in zip(equation.shown, equation.claims, strict=True):
                assert same(evaluated(shown), claim), equation.id


def test_one_identifier_may_be_given_as_it_is():
    assert [verdict.id for verdict in verify("21")] == ["21"]


def test_every_step_follows_again_and_dimensions_agree():
    for step in _steps():
        assert [outcome for outcome in step_checks(step) if not outcome.passed] == []
        assert {outcome.kind for outcome in step_checks(step)} >= {"dimensions", "proof"}


def test_no_wrong_step_passes():
    """Of the steps whose claim an author wrote down: a mutant each, its kinds in turn."""
    authored = [step for step in _steps() if "claim" in vars(step.rule)]
    for place, step in enumerate(authored):
        written = step.rule.claim
        found = list(mutants(written))
        turn = place % len(found)
        wrong = ((w, c) for w, c in (*found[turn:], *found[:turn]) if not same(c, written))
        what, claim = next(wrong)
        # SymPy itself may fail to compare what a mutant says: no judgement is made then either.
        with pytest.raises((ValueError, TypeError), match=r".") as refusal:
            infer(replace(step.rule, claim=claim), *step.parents)
        assert str(refusal.value), (written, what)


def _sections_2_and_3(model: CondensedProblem) -> tuple[Equation, ...]:
    return numbered(governing.results(model) | condensed.results(model))


HYPOTHESES = [(name, None) for name in ("closure", "support", "roughness", "pressure")] + [
    (name, place)
    for name in ("archard", "start")
    for place in range(len(getattr(NoteModel(), name)))
]


def _with_wrong(name: str, place: int | None, what: int) -> CondensedProblem:
    """Return a model in which one hypothesis is mutated, before anything is derived from it."""
    model = CondensedProblem()
    stated = getattr(model, name)
    target = stated if place is None else stated[place]
    wrong = [claim for _, claim in mutants(target.relation) if not same(claim, target.relation)]
    made = assume(Hypothesis(wrong[min(what, len(wrong) - 1)]))
    model.__dict__[name] = made if place is None else (*stated[:place], made, *stated[place + 1 :])
    return model


@pytest.mark.parametrize(("name", "place"), HYPOTHESES)
@pytest.mark.parametrize("what", [0, 1])
def test_a_wrong_hypothesis_shows_in_sections_2_and_3(name, place, what):
    """What follows from a wrong hypothesis is not what the note prints, or nothing follows."""
    as_printed = False
    with suppress(RuleError):
        model = _with_wrong(name, place, what)
        as_printed = all(equation.agrees for equation in _sections_2_and_3(model))
    assert not as_printed


def test_printed_forms_of_sections_2_and_3_follow():
    for equation in _sections_2_and_3(CondensedProblem()):
        assert equation.agrees, equation.id
        assert equation.status in (Status.DEFINITION, Status.DERIVED)


def test_a_physical_sign_is_told_from_the_printed_one():
    parted = {e.id for e in _sections_2_and_3(CondensedProblem(opening=True)) if not e.agrees}
    assert parted == {"7a", "8"}


@pytest.mark.parametrize("law", [TANH, EXPONENTIAL, GENERAL], ids=lambda law: law.name)
@pytest.mark.parametrize(
    ("pin", "opening"), [(pin, opening) for pin in Pin for opening in sorted({False, pin.wears})]
)
def test_the_condensed_problem_follows_for_every_law_and_pin(law, pin, opening):
    problem = CondensedProblem(law, opening, pin)
    for step in chain(problem.scalar, problem.rigid):
        assert replay_fault(step) is None, step.relation


def test_a_law_is_written_once():
    """The exponential law's condensed problem, made by hand, is the derived one."""
    problem = CondensedProblem(LAWS["exponential"], pin=Pin.ABSENT)
    h_0, u_c, U_a, sigma_c0, f_c = symbols("h_0 u_c U_a sigma_c0 f_c")
    p_max, K_c, V, H_c = symbols("p_max K_c V H_c")
    by_hand = K_c * V * p_max / (3 * H_c) * sp.exp(-(h_0 + u_c - U_a) / (sigma_c0 + f_c * u_c))
    assert same(problem.rigid.claim.rhs, by_hand)


@pytest.mark.parametrize(
    ("order", "given", "other"), [(problem_i, "R_a", "U_a"), (problem_ii, "U_a", "R_a")]
)
def test_every_field_follows_in_both_problems(order, given, other):
    assert undetermined(symbol(given), order) == ()
    fields = {"p", "u_a", "u_c", "sigma_a", "sigma_c", "sigma", "U_c", "h"}
    left = (step.claim.lhs for step in order)
    assert {str(getattr(side, "expr", side).func) for side in left} == fields | {other}


def test_an_order_that_uses_what_it_has_not_is_told():
    assert undetermined(symbol("U_a"), problem_ii[::-1]) != ()


def test_a_step_shows_the_hypotheses_that_it_uses():
    steps = Derivations(catalogue.equations_up_to("arrest-depth")).steps("arrest-depth")
    solved, inserted = (step.sentence for step in steps)
    assert solved.startswith(r"Solve $\max U_a")
    assert solved.endswith(r"= 0$ for $u_{\mathrm{stop}}$.")
    assert inserted == "Both sides are equal by step 1 and $f_c < 1 / 3$."


def test_no_step_follows_from_the_equation_that_it_proves():
    steps = Derivations(catalogue.equations_up_to("expansion-drift")).steps("expansion-drift")
    assert not any("[eq:expansion-drift]" in step.sentence for step in steps)


def test_a_sentence_has_no_raw_formula():
    steps = Derivations(catalogue.equations_up_to("expansion-drift")).steps("expansion-drift")
    words = [re.sub(r"\$[^$]*\$|\[[^\]]*\]", "", step.sentence) for step in steps]
    assert not [said for said in words if set("_^=") & set(said)]
    solved = [step.sentence[-5:-1] for step in steps if step.part]
    assert solved == ["c_1$", "c_2$", "c_3$", "c_4$"]


def test_no_step_cites_a_system_that_collects_relations():
    steps = Derivations(catalogue.all_equations()).steps("bearing-rate")
    assert not any("[eq:problem-" in step.sentence for step in steps)


def test_no_step_cites_a_result_under_other_conditions() -> None:
    """(18) and the general law are of a rigid support; the bound of a periodic load is dropped."""
    derivations = Derivations(catalogue.all_equations())
    compliant = [derivations.steps(i) for i in ("compliant-pressure", "log-drift-any-law")]
    sentences = [step.sentence for steps in compliant for step in steps]
    assert not any(
        "[eq:general-law]" in sentence or "[eq:18]" in sentence for sentence in sentences
    )
    assert "general-law" not in derivations.origins("log-drift-any-law")
    bounded = [s.sentence for s in Derivations(catalogue.all_equations()).steps("one-third")]
    without = next(i for i, sentence in enumerate(bounded, 1) if "needs no bound" in sentence)
    assert bounded[-1].endswith(f"step {without}.")


def test_a_derivation_starts_from_what_its_equation_rests_on() -> None:
    """The springs of (2b) and a rigid support would contradict each other."""
    derivations = Derivations(catalogue.equations_up_to("22"))
    start, dropped = derivations.start("22"), derivations.dropped("22")
    assert "2b" not in {step.equation for step in start}
    assert "2b" in {step.equation for step in dropped}
    assert any(step.latex == "U_c = 0" for step in start)
