"""Under a constant load the variables separate: the solver, the derived closed form, its judge."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from tests import judges
from tests.wear.reference_scenes import REFERENCE, made, reference_scene
from wear.binding import bind
from wear.load import Constant
from wear.report.runs import static_wear
from wear.scene import Scene
from wear.solver import solve


def _scene(slope: float, load: float, stiffness: float | None = None) -> Scene:
    return made(f_c=slope, k=stiffness, load=Constant(load, 0.06))


def test_the_closed_form_has_the_wear_of_the_reference():
    cycles, wear = list(REFERENCE["S7"]), list(REFERENCE["S7"].values())
    found = static_wear(reference_scene("S7"), cycles, wear)
    assert found == pytest.approx(wear, rel=1e-15)


@pytest.mark.parametrize("slope", [0.25, 0.02, -0.05])
def test_the_solver_agrees_with_the_closed_form(slope):
    scene, cycles = _scene(slope, 2e-4), [1, 100, 10_000, 10**8]
    found = solve(scene, cycles, rtol=1e-11).u_c
    assert found == pytest.approx(static_wear(scene, cycles, found.tolist()), rel=1e-11)
    assert found == pytest.approx(judges.static_wear(scene, np.array(cycles), found), rel=1e-11)


@pytest.mark.parametrize("slope", [0.25, -0.05])
def test_on_a_compliant_support_cycles_are_an_integral_over_the_wear(slope):
    scene, cycles = _scene(slope, 2e-4, 1e5), [1, 100, 10_000, 10**8]
    model = bind(scene)

    def slowness(u: float) -> float:
        return 1.0 / (float(model.rate(u, 2e-4)) * 0.06)

    depths = [0.0, *solve(scene, cycles, rtol=1e-11).u_c.tolist()]
    parts = [quad(slowness, *ends, epsrel=1e-11, epsabs=0.0)[0] for ends in pairwise(depths)]
    assert np.cumsum(parts) == pytest.approx(cycles, rel=1e-9)
