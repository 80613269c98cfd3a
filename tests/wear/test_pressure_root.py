"""The pressure on a compliant support: found from anywhere, monotonically, to roundoff."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import mpmath
import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from derive.codegen.sources import source
from derive.laws import ContactLaw, r
from derive.note.governing import Pin
from derive.program import program
from derive.variant import Variant
from tests.derive.exact import loaded
from wear import pressure_root
from wear.faults import AccuracyError
from wear.generated.exponential import compliant_bearing as exponential
from wear.generated.tanh import compliant_bearing as tanh

ROUNDOFF = float(np.finfo(float).eps)
P_MAX = 300.0
_ROOT = sp.sqrt(1 + r**2)
ALGEBRAIC = ContactLaw(
    "algebraic",
    1 / (2 * _ROOT * (_ROOT + r)),
    sp.Integer(0),
    "(1 - r/sqrt(1 + r^2))/2: a law without an exponential tail",
)


class Law(NamedTuple):
    """Generated code of a law, the law itself in multiple precision, its largest |phi'/phi|, and
    the least h/sigma: deeper the exponential law has pressures far above its largest, and the
    algebraic one as it is written loses digits."""

    module: Any
    phi: Callable[[mpmath.mpf], mpmath.mpf]
    steepness: float
    least: float = -20.0

    def constants(self, sigma: float, k: float):
        numbers = {"h_0": 0.0, "sigma_c0": sigma, "f_c": 0.0, "K_c": 1e-6, "H_c": 200.0, "k": k}
        return self.module.bind(self.module.Parameters(**numbers, p_max=P_MAX, R=22.0, n=2000.0))


TANH = Law(tanh, lambda x: 1 / (1 + mpmath.exp(4 * x - 8)), 4.0)


@pytest.fixture(scope="module", params=["tanh", "exponential", "algebraic"])
def law(request):
    if request.param == "tanh":
        return TANH
    if request.param == "exponential":
        return Law(exponential, lambda x: mpmath.exp(-x), 1.0, least=-2.0)
    module = loaded(source(program(Variant(ALGEBRAIC, True, Pin.ABSENT)), "numpy"))
    return Law(module, lambda x: (1 - x / mpmath.sqrt(1 + x**2)) / 2, 2.0, least=-1.0)


def exact(law: Law, at: float, give: float, near: float) -> mpmath.mpf:
    """The root with 50 digits, by bisection: shares nothing with Newton's iteration."""
    with mpmath.workdps(60):
        at, give = mpmath.mpf(at), mpmath.mpf(give)
        lower, upper = mpmath.mpf(near) / 2, 2 * mpmath.mpf(near)

        def below(p: mpmath.mpf) -> bool:
            return p < P_MAX * law.phi(at + give * p)

        assert below(lower)
        assert not below(upper)
        for _ in range(180):
            middle = (lower + upper) / 2
            lower, upper = (middle, upper) if below(middle) else (lower, middle)
        return upper


# Stiffness from 1 to 1e12 MPa/mm, roughness from 1e-9 to 1e-2 mm: roughnesses per pressure.
gives = st.floats(-10, 9).map(lambda exponent: 10.0**exponent)
ratios = st.floats(-20, 20) | st.floats(-20, 170)  # h/sigma in the end
settled = settings(max_examples=60)


def state(law: Law, ratio: float, give: float):
    """A state in which h/sigma is about `ratio`: its pressure, displacement and constants."""
    sigma, p = 1e-4, P_MAX * float(law.phi(mpmath.mpf(max(ratio, law.least))))
    U_a = (give * p - max(ratio, law.least)) * sigma
    return p, U_a, law.constants(sigma, 1.0 / (give * sigma))


@settled
@given(ratio=ratios, give=gives)
def test_the_root_is_exact_to_the_condition_of_the_law(law, ratio, give):
    about, U_a, c = state(law, ratio, give)
    at, give = law.module.undeflected(0.0, U_a, c), law.module.softness(0.0, c)
    found = pressure_root.pressure(law.module, 0.0, U_a, c)
    expected = exact(law, at, give, about)
    condition = 1.0 + law.steepness * (abs(at) + give * float(expected))
    assert abs(float(found.p / expected - 1)) <= 8 * ROUNDOFF * condition


@settled
@given(ratio=ratios, give=gives, near=st.floats(-1e3, 1e3) | st.floats(0, 1) | st.just(math.inf))
def test_any_start_leads_there_and_from_the_second_step_on_never_beyond(law, ratio, give, near):
    # The other laws are computed well in their convex part alone.
    _, U_a, c = state(law, ratio if law is TANH else abs(ratio), give)
    found = pressure_root.pressure(law.module, 0.0, U_a, c).p
    again = pressure_root.pressure(law.module, 0.0, U_a, c, near).p
    # The same root to the accuracy of the residual, whose slope is one at least.
    noise = 8 * ROUNDOFF * (1.0 + law.steepness * (abs(ratio) + 2 * give * found))
    assert again == pytest.approx(found, rel=noise)
    at, give = law.module.undeflected(0.0, U_a, c), law.module.softness(0.0, c)
    low, high = law.module.lower(at, give, c), law.module.upper(at, give, c)
    assert low * (1 - noise) <= found <= high * (1 + noise)
    p, signs = near, set()
    for count in range(pressure_root.MOST_ITERATIONS):
        last = min(max(p, low), high)
        p = law.module.newton(last, at, give, c)
        if count > 0 and abs(p - last) > noise * p:
            signs.add(np.sign(p - last))
    assert len(signs) <= 1


@settled
@given(ratio=st.floats(2.0, 170.0), give=gives)
def test_few_iterations_do_where_the_law_falls_exponentially(ratio, give):
    p, U_a, c = state(TANH, ratio, give)
    assert pressure_root.pressure(tanh, 0.0, U_a, c).iterations <= 5
    near = p * (1 + 1e-6 / (1 + give * p))
    assert pressure_root.pressure(tanh, 0.0, U_a, c, near).iterations <= 3


def test_iterations_are_bounded_where_a_soft_support_is_pressed_down():
    """Down to p_max but for 1e-12: where the start is worst."""
    for ratio in np.linspace(-5.0, 2.0, 50):
        for give in 10.0 ** np.linspace(-10, 9, 50):
            _, U_a, c = state(TANH, float(ratio), give)
            assert pressure_root.pressure(tanh, 0.0, U_a, c).iterations <= 40


def test_a_vector_has_the_roots_of_its_elements(law):
    c = law.constants(3.6e-4, 1e5)
    displacement = np.linspace(-0.02, 0.001, 41)
    together = pressure_root.pressure(law.module, 0.0, displacement, c).p
    alone = [pressure_root.pressure(law.module, 0.0, U_a, c).p for U_a in displacement]
    np.testing.assert_allclose(together, alone, rtol=1e-13)


def test_the_smallest_pressures_keep_their_digits():
    sigma, k = 1e-4, 1e6
    U_a, c = -(690.0 + 8.0) * sigma / 4.0, TANH.constants(sigma, k)
    found = pressure_root.pressure(tanh, 0.0, U_a, c).p
    assert 0.0 < found < 1e-296
    expected = exact(TANH, tanh.undeflected(0.0, U_a, c), tanh.softness(0.0, c), found)
    assert abs(float(found / expected - 1)) < 8 * ROUNDOFF * 700


def test_a_state_without_a_pressure_is_refused_alone_and_told_among_many(law):
    c = law.constants(1e-4, 1e5)
    with pytest.raises(AccuracyError):
        pressure_root.pressure(law.module, np.nan, 0.0, c)
    alone = pressure_root.pressure(law.module, 1e-4, 0.0, c).p
    found = pressure_root.pressure(law.module, np.array([1e-4, np.nan]), 0.0, c).p
    np.testing.assert_allclose(found, [alone, np.nan], rtol=1e-13)


def test_a_start_where_the_law_overflows_is_given_up():
    law = Law(exponential, lambda x: mpmath.exp(-x), 1.0)
    U_a, c = 0.5, law.constants(1e-4, 1e3)
    at, give = exponential.undeflected(0.0, U_a, c), exponential.softness(0.0, c)
    with np.errstate(all="ignore"):
        found = pressure_root.pressure(exponential, 0.0, U_a, c, near=0.0).p
    assert float(found / exact(law, at, give, found) - 1) < 1e-11
