"""Judgements of the chain are tried on models, and every hypothesis has a reason."""

import pytest

from derive import catalogue
from derive.falsifier.judgements import reasons, tried


@pytest.mark.parametrize("identifier", ["7c", "8", "13", "share", "threshold", "deviation"])
def test_models_agree_with_an_equation(identifier: str):
    for statement in catalogue.equation(identifier).statements:
        answer = tried(statement)
        assert answer.passed, str(answer)
        assert answer.decided


def test_a_condition_of_the_threshold_is_needed():
    (statement,) = catalogue.equation("threshold").statements
    found = {row.hypothesis.typed: row.counterexample for row in reasons(statement)}
    assert "f_c = 0" in found["f_c > 0"]
