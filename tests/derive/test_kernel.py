"""Only rules make judgements; what is forged or changed is refused, or found."""

from __future__ import annotations

import dataclasses

import pytest
import sympy as sp

from derive.claims import Equality, Inequality
from derive.hypotheses import Hypothesis
from derive.kernel import Conclusion, Judgement, Rule, RuleError, infer, replayed
from derive.rules.algebra import Identity
from derive.rules.assumption import assume
from derive.rules.inequalities import Arithmetic
from derive.symbols import symbols
from derive.time_limit import TimeLimitError, time_limit

f_c, h_0 = symbols("f_c h_0")
FALSE = Equality(h_0, 2 * h_0)


def test_nothing_is_made_by_hand() -> None:
    with pytest.raises(TypeError, match="only a rule"):
        Judgement((), FALSE, Identity(sp.Eq(h_0, h_0)), (), "", "", object())
    made = Identity(sp.Eq(2 * h_0, h_0 + h_0, evaluate=False))()
    with pytest.raises((ValueError, TypeError), match="token"):  # the latter since Python 3.13
        dataclasses.replace(made, claim=FALSE)
    with pytest.raises(dataclasses.FrozenInstanceError):
        made.claim = FALSE  # type: ignore[misc]


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
        ("parents", (Identity(sp.Eq(h_0 + h_0, 2 * h_0, evaluate=False))(),)),
        ("rule", Identity(sp.Eq(h_0, 2 * h_0))),
    ],
)
def test_what_was_changed_behind_the_back_is_found(field: str, value: object) -> None:
    made = assume(Hypothesis("rough", sp.Gt(f_c, 0)))
    assert replayed(made) is None
    object.__setattr__(made, field, value)
    assert replayed(made)


def test_what_was_changed_inside_a_claim_is_found() -> None:
    """The same application is worked out once, but not believed when its claim has changed."""
    relation = sp.And(sp.Ge(h_0, -h_0, evaluate=False), sp.Le(h_0, 2 * h_0, evaluate=False))
    made = Arithmetic(relation)()
    assert replayed(made) is None
    object.__setattr__(made.claim.first, "written", sp.Ge(h_0, h_0 + 1, evaluate=False))
    assert replayed(made)
    assert Arithmetic(relation)().relation == relation


def test_a_look_alike_is_found() -> None:
    class Forged:
        claim, hypotheses, parents, rule = FALSE, (), (), Identity(sp.Eq(h_0, h_0))

    assert replayed(Forged()) == "it is no judgement"  # type: ignore[arg-type]


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
