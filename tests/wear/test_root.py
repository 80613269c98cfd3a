"""The pressure on a compliant support: found from anywhere, monotonically, to roundoff."""

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from wear import root
from wear.faults import AccuracyError
from wear.generated.exponential import compliant_bearing as exponential
from wear.generated.tanh import compliant_bearing as tanh

LAWS = {"tanh": tanh, "exponential": exponential}
ROUNDOFF = float(np.finfo(float).eps)
P_MAX = 300.0
EXPONENTS = {"tanh": lambda r: 8 - 4 * r, "exponential": lambda r: -r}


def constants(module, sigma, k, h_0=0.0):
    numbers = {"h_0": h_0, "sigma_c0": sigma, "f_c": 0.0, "K_c": 1e-6, "H_c": 200.0, "k": k}
    return module.bind(**numbers, p_max=P_MAX, R=22.0, n=2000.0)


def exact(law, sigma, k, U_a):
    """The root with 60 digits, by bisection: shares nothing with Newton's iteration."""
    with mpmath.workdps(60):
        sigma, k, U_a = (mpmath.mpf(float(x)) for x in (sigma, k, U_a))
        lower, upper = mpmath.mpf(0), mpmath.mpf(P_MAX) * mpmath.exp(400)

        def residual(p):
            y = EXPONENTS[law]((p / k - U_a) / sigma)
            share = mpmath.exp(y) if law == "exponential" else 1 / (1 + mpmath.exp(-y))
            return p - P_MAX * share

        lower = mpmath.mpf(10) ** -1000
        for _ in range(260):
            # geometric while they are far apart
            far = upper > 2 * lower
            middle = mpmath.sqrt(lower * upper) if far else (lower + upper) / 2
            lower, upper = (middle, upper) if residual(middle) < 0 else (lower, middle)
        return upper


@pytest.mark.parametrize("law", LAWS)
@settings(max_examples=60)
@given(
    argument=st.floats(-690, 690),
    log_k=st.floats(0, 12),
    log_sigma=st.floats(-9, -2),
)
def test_the_root_is_exact_to_the_condition_of_the_law(law, argument, log_k, log_sigma):
    """Stiffness from 1 to 1e12 MPa/mm, roughness near 0, exponents of the law from -700 to 700."""
    sigma, k = 10.0**log_sigma, 10.0**log_k
    slope = 4.0 if law == "tanh" else 1.0
    shift = 8.0 if law == "tanh" else 0.0
    U_a = (min(argument, 0.0 if law == "exponential" else argument) - shift) * sigma / slope
    found = root.pressure(LAWS[law], 0.0, U_a, constants(LAWS[law], sigma, k))
    expected = exact(law, sigma, k, U_a)
    terms = abs(U_a) + float(expected) / k
    condition = 1.0 + slope * terms / sigma
    assert abs(float(found.p / expected - 1)) <= 8 * ROUNDOFF * condition
    assert found.iterations <= 60


@settings(max_examples=100)
@given(argument=st.floats(-690, 690), log_k=st.floats(0, 12), log_sigma=st.floats(-9, -2))
def test_newton_never_steps_over_the_root(argument, log_k, log_sigma):
    sigma, k = 10.0**log_sigma, 10.0**log_k
    U_a = (argument - 8.0) * sigma / 4.0
    c = constants(tanh, sigma, k)
    found = root.pressure(tanh, 0.0, U_a, c).p
    p, signs = tanh.start(0.0, U_a, c), []
    for _ in range(200):
        residual = tanh.residual(p, 0.0, U_a, c)
        if abs(p - found) <= 1e-9 * found:
            break
        signs.append(np.sign(residual))
        p = p - residual / tanh.residual_slope(p, 0.0, U_a, c)
    else:
        pytest.fail("did not come near the root")
    assert len(set(signs)) <= 1


def test_a_vector_has_the_roots_of_its_elements():
    c = constants(tanh, 3.6e-4, 1e5)
    displacement = np.linspace(-0.02, 0.02, 41)
    together = root.pressure(tanh, 0.0, displacement, c).p
    alone = [root.pressure(tanh, 0.0, U_a, c).p for U_a in displacement]
    np.testing.assert_allclose(together, alone, rtol=1e-13)


def test_the_smallest_pressures_keep_their_digits():
    sigma, k = 1e-4, 1e6
    U_a = -(690.0 + 8.0) * sigma / 4.0
    found = root.pressure(tanh, 0.0, U_a, constants(tanh, sigma, k)).p
    assert 0.0 < found < 1e-296
    assert abs(float(found / exact("tanh", sigma, k, U_a) - 1)) < 8 * ROUNDOFF * 700


def test_what_is_no_number_is_refused():
    with pytest.raises(AccuracyError):
        root.pressure(tanh, np.nan, 0.0, constants(tanh, 1e-4, 1e5))
