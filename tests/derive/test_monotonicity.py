"""Directions of effects: proved for every law, and only under the hypotheses stated."""

import pytest
import sympy as sp

from derive.kernel import RuleError, replay_fault
from derive.laws import LAWS, ContactLaw
from derive.results.monotonicity import DECREASING, INCREASING, WHILE_APART, effect


@pytest.mark.parametrize("law", LAWS.values(), ids=lambda law: law.name)
@pytest.mark.parametrize("datum", [*INCREASING, *DECREASING], ids=str)
def test_every_direction_is_proved(law: ContactLaw, datum: sp.Expr) -> None:
    found = effect(law, datum)
    assert replay_fault(found) is None
    assert isinstance(found.relation, sp.Ge if datum in INCREASING else sp.Le)


@pytest.mark.parametrize("datum", WHILE_APART, ids=str)
def test_roughness_would_lower_the_wear_of_surfaces_that_interpenetrate(datum: sp.Expr) -> None:
    """Without h > 0 there is no proof."""
    with pytest.raises(RuleError, match="missing premise"):
        effect(LAWS["tanh"], datum, apart=False)
