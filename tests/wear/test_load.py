"""Loads: values, slopes and extremes against independent computations."""

import math
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from wear.load import Block, Blocks, Constant, Harmonics, HistoryLoad, Load, Sine, Table
from wear.load.spans import most_cycles, span
from wear.loss_of_contact.edge import turning_points

EPS = np.finfo(float).eps
SAW = Table((0.0, 0.5, 1.5, 2.0), (1e-4, 5e-4, -3e-4, 1e-4))
TWO_TONES = Harmonics(1e-4, (2e-4, -1e-4), (5e-4, 0.0, 3e-4), 0.06)
LOADS: list[Load] = [
    Sine(5e-4, 0.06),
    Sine(-5e-4, 0.06),
    Sine(0.0, 0.06),
    Constant(-2e-4, 0.06),
    TWO_TONES,
    Harmonics(3e-4, (), (), 1.0),
    SAW,
    Table((0.0, 1.0), (2e-4, 2e-4)),
]

# as in a scene, no magnitude but 0 lies below 1e-30
displacements = st.floats(-1.0, 1.0).map(lambda x: x if abs(x) >= 1e-30 else 0.0)
coefficients = st.lists(displacements, max_size=8).map(tuple)
harmonics = st.builds(Harmonics, displacements, coefficients, coefficients, st.just(0.06))


@st.composite
def tables(draw: st.DrawFn) -> Table:
    values = draw(st.lists(displacements, min_size=1, max_size=12))
    steps = draw(st.lists(st.floats(0.01, 1.0), min_size=len(values), max_size=len(values)))
    times = np.concatenate([[0.0], np.cumsum(steps)])
    return Table(tuple(times.tolist()), (*values, values[0]))


def size(load: Load) -> float:
    return max(abs(load.minimum), abs(load.maximum)) + load.maximum - load.minimum


@pytest.mark.parametrize("load", LOADS)
def test_extremes_bound_the_load_and_are_reached(load):
    values = load(np.linspace(0.0, 1.0, 100_001))
    slack = 8 * EPS * size(load)
    assert values.max() <= load.maximum + slack
    assert values.min() >= load.minimum - slack
    assert float(load(np.asarray(load.peaks)).max()) == pytest.approx(load.maximum, abs=slack)


@given(harmonics)
def test_extremes_of_harmonics_are_those_of_a_fine_grid(load):
    values = load(np.linspace(0.0, 1.0, 20_001))
    order = max(len(load.cosine_mm), len(load.sine_mm), 1)
    amplitude = sum(map(abs, (*load.cosine_mm, *load.sine_mm)))
    # between grid points the sum rises by no more than half its curvature times the gap squared
    gap = 0.5 * amplitude * (2.0 * math.pi * order) ** 2 * (0.5 / 20_000) ** 2
    slack = 64 * EPS * (abs(load.mean_mm) + amplitude)
    assert values.max() - slack <= load.maximum <= values.max() + gap + slack
    assert values.min() - gap - slack <= load.minimum <= values.min() + slack


@given(harmonics)
def test_slope_vanishes_at_the_peaks_of_harmonics(load):
    steepest = sum(
        2.0 * math.pi * order * (abs(cosine) + abs(sine))
        for order, cosine, sine in load.terms().T.tolist()
    )
    peaks = np.asarray(load.peaks)
    assert np.all(np.abs(load.slope(peaks)) <= 1e-7 * steepest)  # double zeros: root of roundoff
    assert all(0.0 <= peak < 1.0 for peak in load.peaks)
    assert list(load.peaks) == sorted(set(load.peaks))


def test_peaks_of_two_tones_found_by_hand():
    load = Harmonics(0.0, (), (1.0, 0.0, 1.0), 1.0)  # sin x + sin 3x = 4 sin x cos^2 x
    # slope: cos x + 3 cos 3x = cos x (12 cos^2 x - 8), zero at cos x = 0 and cos^2 x = 2/3
    top = math.acos(math.sqrt(2.0 / 3.0)) / (2.0 * math.pi)
    assert load.peaks == pytest.approx((top, 0.5 - top, 0.75), abs=4 * EPS)
    cosine = math.sqrt(2.0 / 3.0)
    assert load.maximum == pytest.approx(4.0 * math.sqrt(1.0 / 3.0) * cosine**2, rel=4 * EPS)
    assert load.minimum == pytest.approx(-load.maximum, rel=4 * EPS)


@pytest.mark.parametrize("order", [1, 10, 100])
def test_one_harmonic_of_high_order(order):
    load = Harmonics(0.0, (), (*([0.0] * (order - 1)), 1.0), 1.0)
    assert len(load.peaks) == order
    assert load.maximum == 1.0
    expected = (np.arange(order) + 0.25) / order
    np.testing.assert_allclose(load.peaks, expected, atol=1e-14)


@pytest.mark.parametrize("noise", [1e-30, 1e-20, 1e-17, 1e-16, 1e-15, 1e-12])
def test_a_small_lead_does_not_spoil_the_extremes(noise):
    noisy = Harmonics(0.0, (0.0,) * 19 + (noise,), (1.0,), 1.0)
    assert noisy.maximum == pytest.approx(1.0 + noise, rel=4 * EPS)
    assert noisy.peaks == pytest.approx((0.25,), abs=1e-10)


def test_flat_extremes():
    # (1 + cos x)^4: the minimum is flat to the eighth order
    powers = [math.comb(8, 4 - j) * 2.0**-3 for j in range(5)]
    load = Harmonics(powers[0] / 2.0, tuple(powers[1:]), (), 1.0)
    assert load.maximum == pytest.approx(16.0, rel=4 * EPS)
    assert load.minimum == pytest.approx(0.0, abs=32 * EPS)
    assert load.peaks[0] == 0.0


@pytest.mark.parametrize("order", [2, 3])
def test_peaks_and_troughs_flat_to_higher_order_are_found_at_any_phase(order):
    # of slope sin x (1 - cos x)^order, flat at x = 0, its trough or peak at x = pi
    x = 2.0 * math.pi * np.arange(16) / 16
    sines = np.fft.rfft(np.sin(x) * (1.0 - np.cos(x)) ** order).imag[1 : order + 2] / -8
    harmonic = np.arange(1, order + 2)
    for shift in np.linspace(0.0, 1.0, 41):
        turn = 2.0 * math.pi * harmonic * shift
        for size in sines / harmonic, -sines / harmonic:
            load = Harmonics(0.0, tuple(size * np.cos(turn)), tuple(size * np.sin(turn)), 1.0)
            slack, turns = 64 * EPS * load.maximum, load(turning_points(load))
            assert max(load(np.array(load.peaks))) == pytest.approx(load.maximum, abs=slack)
            assert min(turns) == pytest.approx(load.minimum, abs=slack)


def test_harmonics_with_one_sine_is_a_sine():
    phase = np.linspace(-2.0, 3.0, 1001)
    np.testing.assert_array_equal(Harmonics(0.0, (), (5e-4,), 0.06)(phase), Sine(5e-4, 0.06)(phase))


@given(st.one_of(harmonics, tables()), st.integers(0, 2**20 - 1), st.integers(-(2**32), 2**32))
@example(Harmonics(0.0, (), (1.0,), 0.06), 2**19, 1)  # a half is as near to 0 as to 1
def test_whole_periods_change_nothing(load, numerator, periods):
    phase = numerator / 2**20  # so that adding the periods is exact
    np.testing.assert_array_equal(load(phase + periods), load(phase))
    np.testing.assert_array_equal(load.slope(phase + periods), load.slope(phase))


@given(st.floats(-1e12, 1e12))
def test_a_large_phase_keeps_its_fraction(phase):
    fraction = float(Fraction(phase) % 1)
    assert float(Sine(1.0, 1.0)(phase)) == pytest.approx(
        math.sin(2.0 * math.pi * fraction), abs=8 * EPS
    )


@pytest.mark.parametrize("load", [Sine(5e-4, 0.06), TWO_TONES])
def test_slope_is_the_derivative(load):
    phase = np.linspace(0.0, 1.0, 257)
    errors = [
        np.max(np.abs((load(phase + step) - load(phase - step)) / (2 * step) - load.slope(phase)))
        for step in (1e-2, 5e-3, 2.5e-3)
    ]
    rates = [math.log2(coarse / fine) for coarse, fine in pairwise(errors)]
    assert rates == pytest.approx([2.0, 2.0], abs=0.1)


@given(st.one_of(harmonics, tables()))
def test_mean_is_the_integral_over_a_period(load):
    if isinstance(load, Table):
        ends = np.asarray([*load.kinks, 1.0])
        middles, widths = 0.5 * (ends[1:] + ends[:-1]), np.diff(ends)
        integral = float(np.sum(widths * load(middles)))  # the midpoint rule is exact on lines
    else:
        integral = float(np.mean(load(np.arange(64) / 64)))  # and the equal one on harmonics
    assert load.mean == pytest.approx(integral, abs=1e-14)


def test_table_values_slopes_and_kinks():
    assert SAW.kinks == (0.0, 0.25, 0.75)
    assert SAW.peaks == (0.25,)
    assert (SAW.minimum, SAW.maximum) == (-3e-4, 5e-4)
    np.testing.assert_allclose(SAW([0.0, 0.125, 0.25, 0.5, 0.75]), [1e-4, 3e-4, 5e-4, 1e-4, -3e-4])
    np.testing.assert_allclose(SAW.slope([0.0, 0.25, 0.75]), [16e-4, -16e-4, 16e-4])
    np.testing.assert_allclose(SAW.slope(1.0 - 1e-9), 16e-4)


def test_peaks_of_tables_on_the_seam_and_on_flat_tops():
    assert Table((0.0, 1.0, 2.0), (1.0, 0.0, 1.0)).peaks == (0.0,)
    assert Table((0.0, 1.0, 2.0, 3.0, 4.0), (0.0, 1.0, 1.0, -1.0, 0.0)).peaks == (0.25,)
    assert Table((0.0, 1.0, 3.0, 4.0), (1.0, 1.0, 0.0, 1.0)).peaks == (0.0,)
    assert Table((0.0, 1.0, 2.0), (1.0, 1.0, 1.0)).peaks == (0.0,)


@given(tables())
def test_peaks_of_tables_are_tops(load):
    for peak in load.peaks:
        assert load(peak) == pytest.approx(max(load(peak), load(peak - 1e-6), load(peak + 1e-6)))
    assert load.maximum in load(np.asarray(load.peaks))


def test_shape_of_the_answer_is_that_of_the_phase():
    for load in LOADS:
        for shape in ((), (3,), (2, 3)):
            assert load(np.zeros(shape)).shape == shape
            assert load.slope(np.zeros(shape)).shape == shape


# Loads that do not repeat

RECORD = HistoryLoad((0.0, 1.0, 1.5, 4.0), (0.0, 2e-4, 2e-4, -1e-4), 0.5)
SERIES = Blocks((Block(Sine(5e-4, 0.1), 3), Block(SAW, 2), Block(Constant(1e-4, 1.0), 1)), 4)


def test_history_between_its_rows():
    np.testing.assert_allclose(RECORD([0.0, 0.5, 1.25, 4.0]), [0.0, 1e-4, 2e-4, -1e-4])
    np.testing.assert_allclose(RECORD.slope([0.0, 1.0, 1.5, 4.0]), [2e-4, 0.0, -1.2e-4, -1.2e-4])
    assert RECORD.breakpoints(0.0, 4.0).tolist() == [1.0, 1.5]
    assert (RECORD.cycles, RECORD.time_at(2.0)) == (8.0, 1.0)
    assert (RECORD.minimum, RECORD.maximum) == (-1e-4, 2e-4)
    assert RECORD.mean == pytest.approx((1e-4 + 1e-4 + 1.25e-4) / 4.0)


@pytest.mark.parametrize("share", [-0.01, 1.01, math.nan])
def test_no_value_outside_the_duration(share):
    with pytest.raises(ValueError, match="outside"):
        RECORD(share * RECORD.duration)
    with pytest.raises(ValueError, match="outside"):
        RECORD.time_at(share * RECORD.cycles)


def test_blocks_are_spans_one_after_the_other():
    spans, done = [], 0
    while done < most_cycles(SERIES):
        spans.append(span(SERIES, done))
        assert span(SERIES, spans[-1].until - 1) == spans[-1]
        done = spans[-1].until
    assert [each.load for each in spans] == [block.load for block in SERIES.blocks] * 4
    assert [each.until for each in spans] == [3, 5, 6, 9, 11, 12, 15, 17, 18, 21, 23, 24]
    assert [each.place for each in spans[:4]] == [f"load.blocks[{i}]" for i in (0, 1, 2, 0)]
    assert span(SERIES, 24) == spans[-1]


def test_time_at_which_cycles_of_blocks_are_done():
    times = SERIES.time_at(np.array([0, 2, 3, 4, 5, 6, 6 + 4, 24]))
    np.testing.assert_allclose(times, [0.0, 0.2, 0.3, 2.3, 4.3, 5.3, 5.3 + 2.3, 4 * 5.3])


def test_a_cycle_of_a_history_is_a_load():
    window = span(RECORD, 2).load
    phases = np.array([0.0, 0.5, 1.0])
    np.testing.assert_allclose(window(phases), RECORD(1.0 + 0.5 * phases), rtol=1e-15)
    assert (window.period, window.maximum) == (0.5, 2e-4)
    after = span(RECORD, 8).load  # beyond the last row nothing changes
    assert after(0.0) == RECORD(4.0)
    assert after.slope(0.0) == RECORD.slope(4.0) * 0.5
    assert span(RECORD, 7).until == most_cycles(RECORD) == 8


def test_blocks_of_one_load_are_that_load():
    twice = Blocks((Block(TWO_TONES, 2), Block(TWO_TONES, 3)), 2)
    assert twice.mean == pytest.approx(TWO_TONES.mean)
    assert (twice.minimum, twice.maximum) == (TWO_TONES.minimum, TWO_TONES.maximum)
