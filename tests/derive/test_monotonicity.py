"""Directions of effects: proved for every law, and only under the conditions stated."""

from __future__ import annotations

from dataclasses import replace

import pytest
import sympy as sp

from derive.laws import LAWS, ContactLaw
from derive.results.monotonicity import APART, DECREASING, INCREASING, WHILE_APART, effect


@pytest.mark.parametrize("law", LAWS.values(), ids=lambda law: law.name)
@pytest.mark.parametrize("datum", [*INCREASING, *DECREASING], ids=str)
def test_every_direction_is_proved(law: ContactLaw, datum: sp.Expr) -> None:
    assert [c for c in effect(law, datum).checks if not c.passed] == []


@pytest.mark.parametrize("datum", WHILE_APART, ids=str)
def test_roughness_would_lower_the_wear_of_surfaces_that_interpenetrate(datum: sp.Expr) -> None:
    """Without h > 0 neither the proof nor the samples hold."""
    stated = effect(LAWS["tanh"], datum)
    wider = replace(stated, conditions=tuple(c for c in stated.conditions if c is not APART))
    assert {c.kind for c in wider.checks if not c.passed} == {"proof", "sample"}
