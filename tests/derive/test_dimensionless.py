"""Dimensionless groups: the numbers of them, and that scenes with equal groups wear alike."""

import pytest
import sympy as sp

from derive.kernel import replay_fault
from derive.note.condensed import bearing_only
from derive.results.dimensionless import (
    DEFINITIONS,
    GROUPS_COMPLIANT,
    GROUPS_OF_ONE,
    GROUPS_OF_TWO,
    ONE,
    TWO,
    count,
    groups_compliant,
    groups_one_solid,
    groups_two_solids,
)
from derive.symbols import symbols

k, U_a, u_c, T, sigma_c0 = symbols("k U_a u_c T sigma_c0")


@pytest.mark.parametrize(
    ("scaled", "groups", "number"),
    [
        (groups_one_solid[0], GROUPS_OF_ONE, 4),
        (groups_two_solids[0], GROUPS_OF_TWO, 7),
        (groups_compliant[0], GROUPS_COMPLIANT, 4),
    ],
)
def test_the_number_of_groups(scaled, groups, number):
    """No datum is left but the groups."""
    assert replay_fault(scaled) is None
    names = {s.name for s in scaled.relation.free_symbols} - {"tau"}
    assert names == {group.name for group in groups}
    assert len(groups) == number


def test_buckingham_leaves_more_groups_than_occur():
    assert count(ONE) == (9, 3)
    assert count(TWO) == (13, 3)
    assert count((*ONE, k)) == (10, 3)


def test_other_units_and_another_pair_of_materials_change_nothing():
    """Two scenes that share no number but their groups have the same scaled rate."""
    parent = bearing_only().rigid.claim.rhs
    names = symbols("K_c H_c V p_max T f_c sigma_c0 h_0 U")
    numbers = ("1e-6", "200", "4600", "300", "0.06", "0.25", "3.6e-4", "1.08e-3", "5e-4")
    first = [sp.Rational(x) for x in numbers]
    factors = [3, 5, 7, 11, sp.Rational(13 * 5, 3 * 7 * 11), 1, 13, 13, 13]
    rates = []
    for data in (first, [a * b for a, b in zip(first, factors, strict=True)]):
        scene = dict(zip(names, data, strict=True))
        for group in ("mu", "eta", "nu"):
            definition = next(d for s, d in DEFINITIONS.items() if s.name == group)
            rates.append(definition.claim.rhs.subs(scene))
        state = {u_c: scene[sigma_c0] * 2, U_a: scene[names[-1]] / 3}
        rates.append(sp.N((parent * T / sigma_c0).subs(state).subs(scene), 40))
    assert rates[:4] == pytest.approx(rates[4:], rel=1e-30)
