"""The hard catalogue: the default method keeps its word, the references are what they say."""

import math

import pytest

from tests.independent import Judge, wear_after
from tests.independent_loss_of_contact import CutoffJudge
from tests.judges import problem
from wear.benchmark import Measurement, Status
from wear.benchmark import hard as hard_cases
from wear.benchmark.hard import attempt, methods_of, worst
from wear.benchmark.methods import REFERENCE, cases
from wear.scene import hard_names, load_scene

BLURRED = {"grazing": 1e-8}  # contact by 1e-9 mm of 1e-3: the data's own roundoff is 1e-9 of it


def test_every_hard_scene_has_references():
    assert {*hard_names(), "a-billion-cycles"} == set(REFERENCE["hard"])


@pytest.mark.parametrize("name", REFERENCE["hard"])
def test_the_default_method_keeps_its_word(name):
    tolerance = BLURRED.get(name, 1e-10)
    for case in cases("hard", [name]):
        found = attempt(case, "auto", tolerance, 60.0)
        assert found.status is Status.MET, found
        assert found.honest, found


@pytest.mark.parametrize("method", [*hard_cases.SCIPY])
def test_methods_that_step_keep_their_word_or_say_so(method):
    for name in ("fast-wear", "large-swing", "soft-support", "chatter", "grazing"):
        (case,) = cases("hard", [name], [1])
        found = attempt(case, method, 1e-6, 60.0)
        assert found.honest, found
        assert found.status in (Status.MET, Status.REPORTED), found


def test_defaults_of_scipy_are_wrong_without_a_word():
    """What the catalogue is there to show."""
    (case,) = cases("hard", ["large-swing"], [1])
    found = attempt(case, "solve_ivp RK45", 1e-3, 60.0)
    assert found.status is Status.WRONG
    assert "silently" in found.remark


def test_the_judge_of_the_cutoff_without_an_edge_is_the_other_judge():
    """Deep in contact, 3 sigma is never reached."""
    data = problem(load_scene("tiny-amplitude", ["contact.closure_mm=2e-4"]))
    assert wear_after(CutoffJudge(data), [1]) == wear_after(Judge(data), [1])


def entry(method="auto", status=Status.MET, error=1e-12, cycles=1, **changes) -> Measurement:
    made = Measurement(method, "made", cycles, 1e-10, 0.1, 1, error, 1e-11, None, status, "because")
    return made._replace(**changes)


def test_an_estimate_below_the_error_outranks_all_else():
    lying = entry(error=1e-9, cycles=10)
    assert not lying.honest
    assert entry(estimate=None, error=1.0).honest
    assert entry(error=math.nan).honest
    assert worst([entry(), entry(status=Status.WRONG, estimate=None), lying]) == lying


def test_the_tables_say_how_a_method_fails():
    found = [
        entry(),
        entry("b", Status.REPORTED, math.nan),
        entry("c", Status.WRONG, 0.3, estimate=None),
        entry("d", error=1e-9),
    ]
    row = hard_cases.overview(found).rows[0]
    assert row == ("made", "1e-12", "reported", "30 % wrong", "1e-9 estimate")
    assert [line[2] for line in hard_cases.failures(found).rows] == ["b", "c", "d"]
    assert "claims an error of 1.0e-11, has one of 1.0e-09" in hard_cases.markdown(found, "here")


def test_a_method_that_was_too_slow_is_not_asked_for_more(monkeypatch):
    tried = []

    def slow(case, method, *_):
        tried.append((method, case.cycles))
        seconds = 9.0 if method == "Radau" else 0.1
        return entry(method, cycles=case.cycles, scene=case.name, seconds=seconds)

    monkeypatch.setattr(hard_cases, "attempt", slow)
    found = hard_cases.hard_cases(cases("hard", ["f-zero"]), time_limit=2.0)
    assert [call for call in tried if call[0] == "Radau"] == [("Radau", 1)]
    assert len(found) == len(tried)


def test_far_cycles_are_for_the_method_that_counts_them():
    far = [case for case in cases("hard") if case.cycles > hard_cases.EVERY_CYCLE]
    assert {name for case in far for name, _ in methods_of(case)} == {"auto"}
