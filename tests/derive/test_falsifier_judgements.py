"""Judgements of the chain are tried on models, and every hypothesis has a reason."""

import pytest

from derive import catalogue
from derive.falsifier.judgements import tried, without


@pytest.mark.parametrize("identifier", ["7c", "8", "13", "share", "threshold", "deviation"])
def test_models_agree_with_an_equation(identifier: str):
    for statement in catalogue.equation(identifier).statements:
        answer = tried(statement)
        assert answer.passed, str(answer)
        assert answer.decided


def test_a_condition_of_the_threshold_is_needed():
    (statement,) = catalogue.equation("threshold").statements
    (grows,) = (h for h in statement.conditions if h.typed == "f_c > 0")
    assert "f_c = 0" in without(statement, grows)
