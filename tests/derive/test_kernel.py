"""Only rules make judgements; what is forged or changed is refused, or found."""

import dataclasses
from collections.abc import Callable, Iterator
from copy import copy
from types import SimpleNamespace

import pytest
import sympy as sp
from sympy.core.cache import clear_cache
from sympy.core.parameters import global_parameters

from derive.check import step_checks
from derive.claims import Equality, Inequality
from derive.cli import main
from derive.equations import Equation, abbreviated
from derive.hypotheses import PERIODIC, ROUGHENING, Hypothesis, Kind
from derive.kernel import Conclusion, Judgement, Rule, RuleError, chain, infer, replay_fault
from derive.laws import EXPONENTIAL, GENERAL, TANH
from derive.note.model import CLOSURE, at_every_closure, contact
from derive.reals import holds
from derive.rules.algebra import Insert, substitute
from derive.rules.assumption import Assume, assume, defined
from derive.rules.calculus import rigid
from derive.rules.data import DataDerivative
from derive.rules.growth import Diverges
from derive.rules.inequalities import Arithmetic, Monotone
from derive.rules.limits import Passes
from derive.rules.proving import lasts
from derive.symbols import rate, symbols, t
from derive.time_limit import TimeLimitError, time_limit
from derive.verification import verification_of
from tests.derive.judgements import (
    ROUGHENS,
    START,
    eq,
    equal,
    ge,
    gt,
    lt,
    ne,
    sloped,
    supposed,
    tends,
)
from tests.derive.test_language import Positive

h, f_c, h_0, q, L, C, G, U_a, u_c = symbols("h f_c h_0 q L C G U_a u_c")
FALSE = Equality(h_0, 2 * h_0)


def test_nothing_is_made_by_hand() -> None:
    with pytest.raises(TypeError, match="only a rule"):
        Judgement((), FALSE, Insert(sp.Eq(h_0, h_0)), (), "", "", object())
    made = Insert(sp.Eq(2 * h_0, h_0 + h_0, evaluate=False))()
    with pytest.raises((ValueError, TypeError), match="token"):  # the latter since Python 3.13
        dataclasses.replace(made, claim=FALSE)
    with pytest.raises(dataclasses.FrozenInstanceError):
        made.claim = FALSE  # type: ignore[misc]
    alike = SimpleNamespace(**vars(made) | {"claim": FALSE, "is_made": True})
    with pytest.raises(TypeError, match="only a rule"):
        Judgement.named(alike, "a look-alike")  # type: ignore[arg-type]


def test_a_rule_of_ones_own_is_no_rule() -> None:
    class Believe(Rule):
        def conclude(self, *premises: Judgement) -> Conclusion:
            return Conclusion(FALSE)

    with pytest.raises(RuleError, match="no rule"):
        infer(Believe())
    Believe.__module__ = "derive.rules.algebra"
    with pytest.raises(RuleError, match="no rule"):
        infer(Believe())


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("claim", FALSE),
        ("claim", Inequality(sp.Gt(f_c, 1))),
        ("hypotheses", ()),
        ("parents", (Insert(sp.Eq(h_0 + h_0, 2 * h_0, evaluate=False))(),)),
        ("rule", Insert(sp.Eq(h_0, 2 * h_0))),
    ],
)
def test_what_was_changed_behind_the_back_is_found(field: str, value: object) -> None:
    made = assume(ROUGHENING)
    assert replay_fault(made) is None
    object.__setattr__(made, field, value)
    assert replay_fault(made)


def test_what_was_changed_inside_a_claim_is_found() -> None:
    """The same application is worked out once, but not believed when its claim has changed."""
    relation = sp.And(sp.Ge(h_0, -h_0, evaluate=False), sp.Le(h_0, 2 * h_0, evaluate=False))
    made = Arithmetic(relation)()
    assert replay_fault(made) is None
    object.__setattr__(made.claim.first, "written", sp.Ge(h_0, h_0 + 1, evaluate=False))
    assert replay_fault(made)
    assert Arithmetic(relation)().relation == relation


class Forged:
    """What looks like a judgement."""

    claim, hypotheses, parents, rule = FALSE, (), (), Insert(sp.Eq(h_0, h_0))


class Changing(Hypothesis):
    pass


class Same(Hypothesis):
    """A hypothesis that says it is another."""

    def __eq__(self, other: object) -> bool:
        return True

    def __hash__(self) -> int:
        return hash(ROUGHENS.hypotheses[0])


class Turning:
    """A function that is another one once it has been judged."""

    def __call__(self, at: sp.Expr) -> sp.Expr:
        return at if isinstance(at, sp.Dummy) else -at


def with_a_conclusion_of_its_own() -> Judgement:
    rule = Insert(sp.Eq(h_0, h_0))
    object.__setattr__(rule, "conclude", lambda: Conclusion(FALSE))
    return infer(rule)


FORGERIES: tuple[tuple[Callable[[], object], str], ...] = (
    (with_a_conclusion_of_its_own, "fields that are not its own"),
    (lambda: substitute(eq(h, h_0), Forged()), "a judgement"),  # type: ignore[arg-type]
    (lambda: infer(Assume(supposed(sp.Gt(f_c, 0))), START), "cannot be assumed"),
    (lambda: assume(Changing("rough", sp.Gt(f_c, 0))), "nor a hypothesis"),
    (lambda: assume(supposed(sp.Gt(f_c, 0), "odd")), "nor a hypothesis"),  # type: ignore[arg-type]
    (lambda: assume(supposed(equal(f_c, 5), "model")), "nor a hypothesis"),  # type: ignore[arg-type]
    (lambda: assume(Same("any", sp.Gt(q, 0))), "nor a hypothesis"),
    (lambda: Monotone(Turning())(ge(h, h_0)), "nor a hypothesis"),
    (lambda: rigid(ge(h, h_0), ge(h, h_0)), "another form: too many"),
    (lambda: Passes(sp.Eq(h_0, L))(), "another form: tuple index"),
    (lambda: Monotone(sp.Lambda((), h_0))(ge(h, h_0)), "another form"),
    (lambda: DataDerivative(equal(h, L), h * L)(eq(L, h_0)), "another form"),
)


@pytest.mark.parametrize(("forged", "said"), FORGERIES)
def test_what_is_forged_is_refused(forged: Callable[[], object], said: str) -> None:
    with pytest.raises(RuleError, match=said):
        forged()


def test_a_look_alike_is_found() -> None:
    assert replay_fault(Forged()) == "no rule made it"  # type: ignore[arg-type]


class Hiding(tuple):  # type: ignore[type-arg]
    """A tuple whose parts only some see."""

    def __iter__(self) -> Iterator[object]:
        return iter(())

    def __eq__(self, other: object) -> bool:
        return True

    __hash__ = tuple.__hash__


@pytest.mark.parametrize("field", ["parents", "hypotheses"])
def test_parts_that_hide_are_found(field: str) -> None:
    made = substitute(eq(h, h_0), eq(h_0, q))
    object.__setattr__(made, field, Hiding())
    assert replay_fault(made)


def test_a_side_that_says_it_is_another_is_found() -> None:
    made = eq(h, f_c)
    assert isinstance(made.claim, Equality)
    object.__setattr__(made.claim, "rhs", Positive("theta", real=True))
    assert replay_fault(made) == "no rule made it"


def test_an_expression_that_was_changed_in_place_is_found() -> None:
    """The relation that the rule was asked for is the one that the claim shows."""
    relation = sp.Gt(q + L, 0, evaluate=False)
    made = Arithmetic(relation)()
    relation._args = (f_c + 7, sp.S.Zero)
    assert replay_fault(made) == "no rule made it"


def test_an_expression_that_is_changed_in_place_for_a_while_is_no_premise() -> None:
    relation = sp.Gt(f_c, -5)
    premise = Arithmetic(relation)(assume(Hypothesis(sp.Gt(f_c, -4))))
    honest, relation._args = relation._args, (f_c, sp.Integer(8))
    with pytest.raises(RuleError, match="nobody changed"):
        Arithmetic(sp.Gt(f_c, 7))(premise)
    with pytest.raises(RuleError, match="f_c > 8 was changed"):
        Arithmetic(relation)(ROUGHENS)
    relation._args = honest


def test_a_judgement_that_rests_on_itself_is_found() -> None:
    made = Arithmetic(sp.Gt(f_c, 0))(ROUGHENS)
    object.__setattr__(made, "hypotheses", ())
    object.__setattr__(made, "parents", (made,))
    assert replay_fault(made) == "no rule made it"
    with pytest.raises(RuleError, match="f_c > 0 rests on itself"):
        chain(made)


class Odd(Inequality):
    """A claim that says it is any other."""

    def __eq__(self, other: object) -> bool:
        return True

    def __hash__(self) -> int:
        return hash(ge(h_0, L).claim)


def swapped() -> Judgement:
    """Return a copy of a judgement, with another claim that calls itself equal."""
    made = copy(ge(h_0, L))
    object.__setattr__(made, "claim", Odd(sp.Ge(h_0, 100 * L)))
    return made


def test_what_was_copied_or_swapped_is_no_premise() -> None:
    """Otherwise what is concluded from it would be kept as the conclusion from the other."""
    for forged in (copy(ge(h_0, L)), swapped()):
        assert replay_fault(forged) == "no rule made it"
        with pytest.raises(RuleError, match="a judgement that a rule made"):
            Arithmetic(sp.Ge(h_0, 50 * L))(forged)


def test_a_swapped_step_is_not_taken_for_the_one_that_was_checked() -> None:
    honest, forged = (Equation("13", "2", "any", (made,)) for made in (ge(h_0, L), swapped()))
    assert verification_of([honest]).passed
    assert not verification_of([honest, forged]).passed


def test_there_are_no_other_judgements() -> None:
    with pytest.raises(TypeError, match="only a rule"):
        type("Other", (Judgement,), {})


@pytest.mark.parametrize("sign", ["class", "instance"])
def test_a_function_with_signs_of_its_own_is_refused(sign: str) -> None:
    function = sp.Function(f"w_{sign}", positive=True)  # SymPy would give an equal one again
    owner = function if sign == "class" else function(t)
    owner.is_negative = True
    claim = sp.Lt(function(t) if sign == "class" else owner, 0, evaluate=False)
    with pytest.raises(RuleError, match="no claim"):
        Arithmetic(claim)()


def test_other_settings_of_sympy_leave_no_trace() -> None:
    """exp(x) is then the power of a base, and so all exponentials would have one argument, e."""
    x, y, z = symbols("theta x_inf f_c")
    goal = sp.Ge(sp.tanh(x) - sp.tanh(y) + sp.exp(z), 0, evaluate=False)  # -2 for -5, 5, -5
    global_parameters.exp_is_pow = True
    try:
        holds(goal, frozenset())
        with pytest.raises(RuleError, match="other settings"):
            Arithmetic(goal)()
    finally:
        global_parameters.exp_is_pow = False
    assert not holds(goal, frozenset())
    with pytest.raises(RuleError, match="missing premise"):
        Arithmetic(goal)()


def test_nothing_is_concluded_while_sympy_does_not_evaluate() -> None:
    """Then it holds 0/f_c apart from 0, and its modulus for positive."""
    apart = ne(f_c, 0)
    with sp.evaluate(False), pytest.raises(RuleError, match="other settings"):
        Arithmetic(sp.Eq(h_0 * sp.Abs(0 * (1 / f_c)), 5 * sp.Abs(0 * (1 / f_c))))(apart)


def test_a_claim_that_is_changed_after_its_check_is_found() -> None:
    made = substitute(eq(h, h_0), eq(h_0, L))
    assert all(check.passed for check in step_checks(made))
    object.__setattr__(made, "claim", Equality(h, 2 * L))
    assert not all(check.passed for check in step_checks(made))


@pytest.mark.parametrize("statements", [(), ("f_c > 0",)])
def test_an_equation_states_judgements(statements: tuple[Judgement, ...]) -> None:
    with pytest.raises(TypeError):
        Equation("x", "1", "none", statements)


def test_a_step_that_takes_too_long_is_given_up() -> None:
    def endless() -> None:
        while True:
            pass

    with pytest.raises(TimeLimitError, match=r"a step: not done after 0\.05 s"):  # noqa: SIM117
        with time_limit(0.05, "a step"):
            endless()


def test_limits_of_time_may_be_nested() -> None:
    def endless() -> None:
        with time_limit(10.0, "inner"):
            pass
        while True:
            pass

    with pytest.raises(TimeLimitError, match="outer"), time_limit(0.1, "outer"):
        endless()


@pytest.mark.parametrize(
    "known",
    [
        (tends(h, 0), gt(h, 0)),
        (tends(h, 0), ne(h, 0)),
        (tends(h, sp.oo), ge(h, h_0), tends(h - h_0, sp.oo)),
        (tends(h, h_0), eq(f_c * h, h_0), tends(f_c * h, h_0)),
        (assume(PERIODIC), tends(U_a, h_0), tends(u_c, sp.oo)),
        (ge(rate("u_c"), C), ge(u_c, h_0), gt(G, u_c)),
    ],
    ids=str,
)
def test_limits_that_do_not_contradict_hypotheses(known: tuple[Judgement, ...]) -> None:
    """A limit need not be reached, and keeps no strictness."""
    assert Arithmetic(sp.Gt(L, -L, evaluate=False))(*known)


def test_a_hypothesis_that_is_changed_in_place_is_found() -> None:
    known = gt(f_c, 3)
    object.__setattr__(known.hypotheses[0], "kind", Kind.INITIAL)
    with pytest.raises(RuleError, match="nobody changed"):
        Arithmetic(sp.Gt(f_c + 1, 4))(known)


def test_signs_of_names_of_ones_own_are_shown() -> None:
    own, field = sp.Symbol("w", positive=True), sp.Function("F", positive=True)(t)
    for quantity, name in ((f_c, own), (h, field)):
        known = eq(quantity, name)
        shown = Equation("x", "", "", (Insert(equal(2 * quantity, 2 * name))(known),)).conditions
        assert sp.Gt(name, 0, evaluate=False) in [hypothesis.relation for hypothesis in shown]


def test_a_field_is_one_of_time_or_of_scaled_time() -> None:
    """v(tau) is typeset as v, like a field at the present time."""
    v = sp.Function("v", real=True)
    with pytest.raises(RuleError, match="of scaled time, too"):
        Arithmetic(sp.Lt(v(t), v(symbols("tau")[0]) + 1))(eq(v(t), v(symbols("tau")[0])))


def test_a_name_that_is_printed_like_e_is_refused() -> None:
    for value in (sp.E + 1, sp.S(2)):
        with pytest.raises(RuleError, match="E is no real quantity"):
            defined(sp.Symbol("E", real=True), value)


def test_the_other_sign_of_the_closure_is_shown() -> None:
    other, printed = (assume(Hypothesis(CLOSURE[opens], Kind.MODEL)) for opens in (True, False))
    assert [shown.text for shown in other.conditions] == ["wear of the pin opens the gap"]
    assert printed.conditions == ()


def test_two_contact_laws_are_refused() -> None:
    """Both would be shown as "no loss of contact"; they may agree at one closure."""
    laws = (assume(Hypothesis(at_every_closure(law))) for law in (TANH, GENERAL))
    with pytest.raises(RuleError, match="two contact laws"):
        Arithmetic(sp.Gt(L, -L, evaluate=False))(*laws)


def test_slopes_under_two_laws_are_not_compared() -> None:
    """As f_c varies, p_inf is another function of it under another law."""
    slopes = [sloped(assume(Hypothesis(at_every_closure(law)))) for law in (TANH, EXPONENTIAL)]
    with pytest.raises(RuleError, match="further conditions"):
        Arithmetic(sp.Gt(L, -L, evaluate=False))(*slopes)


def test_an_equation_shows_a_condition_that_it_repeats() -> None:
    known = eq(u_c, h_0)
    bound = Arithmetic(sp.Ge(u_c, h_0 / 2))(known)
    assert [h.relation for h in Equation("x", "", "", (known, bound)).conditions] == [
        known.relation
    ]
    assert Equation("x", "", "", (known,)).conditions == ()


def test_an_abbreviation_does_not_capture_a_bound_variable() -> None:
    name, u_s = sp.Symbol("n_1", real=True), symbols("u_s")[0]
    relation = equal(h_0, sp.Integral(2 * u_s / L, (u_s, 0, L)))
    assert abbreviated(relation, [sp.Eq(name, 2 * u_s / L)]) == relation


@pytest.mark.parametrize(("shown", "where"), [("2 h_0 = h_0", "2 = 1"), ("u_c = u_c", "u_c = h_0")])
def test_a_typeset_form_abbreviates_by_new_names_alone(shown: str, where: str) -> None:
    trivial = Insert(equal(u_c, u_c))()
    said = {"shown": shown, "where": where}
    assert not Equation("x", "", "", (trivial,), texts=said).typeset_agrees


def test_a_law_that_is_not_the_notes_is_shown() -> None:
    law = assume(Hypothesis(contact(GENERAL), Kind.MODEL))
    assert [shown.words for shown in law.conditions] == [""]
    assert "phi" in law.conditions[0].text
    assert "phi" in Hypothesis(at_every_closure(GENERAL)).text
    assert not assume(Hypothesis(contact(TANH), Kind.MODEL)).conditions


LOOKING = [
    "du_c",
    "dt",
    "dT",
    "dx",
    "maxU_a",
    "minh",
    "E",
    "O",
    "inf",
    "lim_t",
    "max_t",
    "ln_2",
    "sin2",
]


@pytest.mark.parametrize("name", LOOKING)
def test_no_name_looks_like_an_operation(name: str) -> None:
    with pytest.raises(RuleError, match="no real quantity"):
        eq(sp.Symbol(name, real=True), h_0)


def test_a_field_of_ones_own_is_told_from_a_constant() -> None:
    field, constant = sp.Function("x", real=True), sp.Symbol("x", real=True)
    fields = (Hypothesis(sp.Gt(field(time), 0)) for time in (t, symbols("tau")[0]))
    for mine in fields:
        assert mine.text != Hypothesis(sp.Gt(constant, 0)).text
        assert mine.latex != Hypothesis(sp.Gt(constant, 0)).latex


def test_the_sign_of_a_name_of_ones_own_is_a_condition_of_each_step(capsys) -> None:
    positive = sp.Symbol("x", positive=True)
    assert [sign.text for sign in Arithmetic(sp.Gt(positive, 0, evaluate=False))().signs] == [
        "x > 0"
    ]
    assert main(["steps", "pressure-iteration"]) == 0
    assert "if x > 0" in capsys.readouterr().out


def _other(**own: object) -> sp.Function:
    """Return a function that SymPy calls equal to u_c, with a method or sign of its own."""
    clear_cache()
    other = sp.Function("u_c", real=True)
    for name, value in own.items():
        setattr(other, name, value)
    return other


def test_what_sympy_calls_equal_leaves_no_result() -> None:
    clear_cache()
    one = _other(_eval_expand_basic=lambda *_, **__: sp.Integer(1))
    sp.expand(one(t) - 1, log=False, power_base=False)  # 0, kept as that of u_c(t) - 1
    with pytest.raises(RuleError, match="no identity"):
        Insert(equal(u_c, sp.Integer(1)))()
    holds(sp.Gt(_other(is_positive=True)(t), 0, evaluate=False), frozenset())
    with pytest.raises(RuleError, match="missing premise"):
        Arithmetic(sp.Gt(u_c, 0, evaluate=False))()
    sp.tanh(_other(is_zero=True)(t))
    steep = substitute(eq(U_a, sp.tanh(h)), eq(h, u_c))
    assert steep.relation == equal(U_a, sp.tanh(u_c))


def test_a_change_that_is_undone_leaves_no_trace() -> None:
    changed = substitute(eq(U_a, q * rate("u_c")), eq(q * rate("u_c"), h))
    sides = vars(changed.claim)
    kept = dict(sides)
    sides["lhs"] = sides["rhs"] = sp.S.Zero
    assert not lasts(changed)
    sides.update(kept)
    assert changed.is_made
    assert not lasts(changed)


def test_a_changed_field_of_a_rule_is_found() -> None:
    """The hashes of -1 and -2 are equal."""
    growth = ge(u_c, C * t)
    found = Diverges((L - 1) * u_c)(growth, gt(L, 1), lt(L, 2))
    assert replay_fault(found) is None
    vars(found.rule)["expr"] = (L - 2) * u_c
    assert not found.is_made
    assert replay_fault(found) == "no rule made it"
