"""Legal and absurd magnitudes are told with the likely slip, and refused by --strict."""

from typing import Any

import pytest

from wear.scene import builtin_names, hard_names, load_scene
from wear.sensitivities import sensitivity
from wear.solver import solve

SECTION4 = load_scene("section4")


def told(**changes: float) -> list[str]:
    scene = SECTION4.with_({key.replace("__", "."): value for key, value in changes.items()})
    return [text for text in scene.notices if text.startswith("implausible")]


@pytest.mark.parametrize(
    ("key", "value", "slip"),
    [
        ("bearing__roughness_mm", 0.36, "um typed as mm?"),
        ("bearing__hardness_MPa", 2e8, "Pa typed as MPa?"),
        ("bearing__hardness_MPa", 0.2, "GPa typed as MPa?"),
        ("motion__radius_mm", 0.022, "m typed as mm?"),
        ("bearing__wear_coefficient", 1e-15, "K = k H"),
        ("contact__closure_mm", 1.08, "um typed as mm?"),
        ("load__amplitude_mm", 5.0, "um typed as mm?"),
        ("contact__max_pressure_MPa", 3000.0, "times the hardness"),
        ("bearing__roughness_growth", -50.0, "part of the wear"),
    ],
)
def test_a_slip_is_named(key: str, value: float, slip: str) -> None:
    sentences = told(**{key: value})
    assert any(slip in text for text in sentences)


def test_scenes_of_the_note_are_plausible() -> None:
    for name in set(builtin_names()) - set(hard_names()):
        assert not [n for n in load_scene(name).notices if n.startswith("implausible")]


@pytest.mark.parametrize(
    ("cycles", "phrases"),
    [
        (9000, ()),
        (10**8, ("% of the radius", "ISO 1302")),
        (10**12, ("% of the radius", "ISO 1302", "no wear coefficient is known for so many")),
    ],
)
def test_results_out_of_range_are_told(cycles: int, phrases: tuple[str, ...]) -> None:
    for result in (solve(SECTION4, cycles), sensitivity(SECTION4, cycles)):
        found = [text for text in result.notices if text.startswith("implausible")]
        assert len(found) == len(phrases)
        assert all(phrase in text for phrase, text in zip(phrases, found, strict=True))


def test_strict_refuses_entries_and_results(call: Any) -> None:
    request = ("run", "section4", "--cycles", "10", "--set", "motion.radius_mm=0.022")
    for more, wanted in ((), 0), (("--strict",), 2):
        status, _, messages = call(*request, *more)
        assert (status, "m typed as mm?" in messages) == (wanted, True)
    status, shown, messages = call("run", "section4", "--cycles", "1e8", "--strict")
    assert (status, shown, "% of the radius" in messages) == (2, "", True)
    assert call("asymptote", "section4", "--strict")[0] == 0


def test_what_is_given_twice_is_said(call: Any) -> None:
    assert "cycles: 10 given more than once" in solve(SECTION4, [10, 1, 10]).notices
    twice = ("--set", "bearing.hardness_MPa=1", "--set", "bearing.hardness_MPa=2")
    assert call("run", "section4", *twice)[0] == 2
