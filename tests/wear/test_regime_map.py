"""The derived map of regimes and the regimes that scenes are told meet, everywhere."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from derive import catalogue
from derive.results.regime_map import REGIMES, regime
from tests.wear.reference_scenes import made
from wear import regime as wear_regime
from wear.load import Sine
from wear.regime import asymptote

THIRD = 1 / 3


@pytest.fixture(autouse=True)
def _without_integration(monkeypatch):
    """The regime is asked for, not the cycle of arrest or the offset."""
    monkeypatch.setattr(wear_regime, "_arrest_cycle", lambda _case: (None, ()))
    monkeypatch.setattr(wear_regime, "offset", lambda *_: None)


@settings(max_examples=60)
@given(
    slope=st.sampled_from([-0.3, -0.05, -1e-9, 0.0, 1e-9, 0.125, 0.25, 0.5, 2.0])
    | st.floats(-0.5, 2.0).filter(lambda f: abs(f) > 1e-6 and abs(f - THIRD) > 1e-6),
    amplitude=st.sampled_from([1e-5, 5e-4, 2e-3, 9e-3]) | st.floats(1e-6, 2e-2),
    closure=st.floats(5e-4, 3e-3),
    cutoff=st.booleans(),
)
def test_a_scene_is_in_the_regime_of_the_map(slope, amplitude, closure, cutoff):
    scene = made(f_c=slope, load=Sine(amplitude, 0.06), closure=closure, cutoff=cutoff)
    data = {"f_c": slope, "h_0": closure, "sigma_c0": 3.6e-4, "U_max": amplitude}
    assert asymptote(scene).regime == regime(data, cutoff).name


def test_the_map_names_equations_that_exist():
    for row in REGIMES:
        for identifier in row.equations:
            assert catalogue.equation(identifier).id == identifier


@pytest.mark.parametrize(
    ("amplitude", "said"),
    [(2.0**-11, "just reaches h = 3 sigma"), (2.0**-12, "never makes contact")],
)
def test_a_peak_that_just_touches_is_told_apart(amplitude, said):
    sigma = 2.0**-10
    load = Sine(amplitude, 0.06)
    scene = made(f_c=0.5, load=load, closure=3 * sigma + 2.0**-11, roughness=sigma, cutoff=True)
    found = asymptote(scene)
    assert found.regime == "arrest"
    assert said in found.notices[-1]
