"""The first integral stays what it is along histories that no step of its proof has seen."""

import math

import pytest
import sympy as sp
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from derive.results.first_integral import first_integral, first_integral_compliant
from derive.symbols import symbols

h, h_0, U_a, U_c, u_c, sigma, sigma_c0 = symbols("h h_0 U_a U_c u_c sigma sigma_c0")
p, p_max, k, f_c = symbols("p p_max k f_c")

START, CLOSURE, LARGEST, GAIN = 3.6e-4, 1.08e-3, 300.0, 2e-6


def _load(time: float) -> float:
    """A load that never repeats."""
    return 3e-4 * math.sin(time) + 2e-4 * math.sin(math.sqrt(2.0) * time) + 1e-5 * time


def _pressure(wear: float, load: float, slope: float, stiffness: float) -> float:
    def residual(pressure: float) -> float:
        gap = CLOSURE + wear + pressure / stiffness - load
        return pressure - LARGEST / (1.0 + math.exp(4.0 * gap / (START + slope * wear) - 8.0))

    return float(brentq(residual, 0.0, LARGEST, xtol=1e-300, rtol=1e-14))


@pytest.mark.parametrize("slope", [0.25, -0.05])
@pytest.mark.parametrize("stiffness", [1e5, math.inf])
def test_it_is_conserved_under_a_load_that_never_repeats(slope: float, stiffness: float) -> None:
    history = solve_ivp(
        lambda t, u: [GAIN * _pressure(u[0], _load(t), slope, stiffness)],
        (0.0, 5.0),
        [0.0],
        method="DOP853",
        rtol=1e-10,
        atol=1e-16,
        max_step=0.1,
    )
    claim = (first_integral if math.isinf(stiffness) else first_integral_compliant).claim
    left = sp.lambdify((sigma, p, U_a, f_c, p_max, k), claim.lhs, "math")
    expected = 4.0 * (START / slope - CLOSURE)
    for time, wear in zip(history.t[::7], history.y[0][::7], strict=True):
        pressure = _pressure(wear, _load(time), slope, stiffness)
        found = left(START + slope * wear, pressure, _load(time), slope, LARGEST, stiffness)
        assert found == pytest.approx(expected, rel=1e-11)
    assert history.y[0][-1] > 5e-5
