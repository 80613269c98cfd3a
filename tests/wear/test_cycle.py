"""The iteration over one cycle: exact to its tolerance, from whatever it starts."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tests.wear.reference_scenes import REFERENCE, reference_scene
from wear.equation import equation_of
from wear.numerics.collocation import InitialGuess
from wear.orbit.period_map import PeriodMap, period_map, resolved, settings

START = np.zeros((1, 1))


def fine_cycle(name: str) -> PeriodMap:
    """A cycle of a reference scene, on a mesh that resolves all of its wear."""
    equation = equation_of([reference_scene(name)])
    size = settings(1e-12)._replace(phase_tolerance=1e-15)
    states = np.array([[0.0, 1e-4, 1e-3]])
    ((_, found),) = resolved(equation, equation.breakpoints, states, size)
    return found


@pytest.mark.parametrize("tolerance", [1e-4, 1e-7, 1e-10, 1e-13])
@pytest.mark.parametrize("name", ["S1", "S2", "S3a", "S3c", "S3d", "S6", "S7", "S8_2"])
def test_the_first_cycle_to_a_tolerance(name: str, tolerance: float) -> None:
    run = fine_cycle(name)._replace(tolerance=tolerance).advance(START)
    assert run.converged.all()
    assert run.iteration_error[0, 0] <= tolerance
    assert_allclose(run.increment[0, 0], REFERENCE[name][1], rtol=tolerance)


def test_fast_wear_needs_few_rates() -> None:
    """Picard iteration diverges here."""
    cycle = fine_cycle("S4")
    run = cycle.advance(START)
    assert_allclose(run.increment[0, 0], REFERENCE["S4"][1], rtol=1e-14)
    assert run.evaluations <= 16 * cycle.forcing.size


def test_starts_in_any_order() -> None:
    cycle = fine_cycle("S3c")
    starts = np.array([[3e-4, 0.0, 1e-2, 1e-4, 0.0]])
    found = cycle.advance(starts)
    for start, increment, inside in zip(
        starts[0], found.increment[0], found.inside[0], strict=True
    ):
        alone = cycle.advance(np.array([[start]]))
        assert_allclose(increment, alone.increment[0, 0], rtol=3e-15)
        assert_allclose(inside, alone.inside[0, 0], rtol=1e-13)


def test_a_good_guess_saves_rates_and_a_bad_one_does_no_harm() -> None:
    cycle = fine_cycle("S1")
    finer = period_map(cycle.equation, cycle.over.edges[:, 0], 30)
    starts = np.array([[0.0, 1e-4, 3e-4]])
    plain = finer.advance(starts)
    good = finer.advance(starts, cycle.advance(starts).guess(30))
    assert_allclose(good.increment, plain.increment, rtol=3e-15)
    assert good.evaluations <= 2 * starts.size * finer.forcing.size
    shape = (1, 3, *finer.forcing.shape[2:])
    increment, rate, shift = (np.full(shape, value) for value in (1e-4, 1e-3, 1e-5))
    bad = InitialGuess(increment, rate, shift, np.ones((1, 3)))
    assert_allclose(finer.advance(starts, bad).increment, plain.increment, rtol=3e-15)


def test_what_a_loose_iteration_leaves_a_strict_one_finds() -> None:
    """The error estimate of sweeps rests on it: the judge starts from what it judges."""
    cycle = fine_cycle("S3d")
    loose = cycle._replace(tolerance=1e-6).advance(START)
    judge = cycle._replace(tolerance=1e-9).advance(START, loose.guess(24))
    true = abs(loose.increment[0, 0] / REFERENCE["S3d"][1] - 1)
    told = abs(judge.increment[0, 0] / loose.increment[0, 0] - 1) + judge.iteration_error[0, 0]
    assert true <= 3 * told
