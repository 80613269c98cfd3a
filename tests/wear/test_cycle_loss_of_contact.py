"""The cutoff: arrest in the very cycle, kinks crossed, permanent contact counted."""

import re
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from tests.judges import honest, true_wear
from tests.wear.reference_scenes import SHARP, SINE, made, reference_scene
from tests.wear.test_cycle_count import between
from wear import cycles as count
from wear.binding import bind
from wear.faults import AccuracyError
from wear.load import Harmonics, Load, Sine, Table
from wear.loss_of_contact import wear_ranges
from wear.loss_of_contact.edge import edge_of_contact, turning_points
from wear.loss_of_contact.grazing import grazing_wears
from wear.loss_of_contact.period_map import switched_period_map
from wear.orbit import abel
from wear.scene import Scene, load_scene
from wear.solver import solve

UNEVEN = {  # rise slowly, then fast, and slowly again
    "harmonics": Harmonics(0.0, (), (5e-4, -2e-4), 0.06),
    "table": Table((0.0, 0.125, 0.375, 0.5, 0.625, 1.0), (-5e-4, -4e-4, -3e-4, 3e-4, 4e-4, -5e-4)),
}


def with_load(load: Load, K: float, f_c: float, pin: bool = False, closure: float = 9e-4) -> Scene:
    return made(K, f_c, load, pin=pin, closure=closure, cutoff=True)


def agrees_with_the_judge(scene: Scene, cycles: list[int], rtol: float) -> None:
    found = count.wear_after(bind(scene), scene.periodic_load, np.array(cycles, float), rtol)
    assert np.all(found.error <= rtol)
    assert honest(found.u_c, found.error, true_wear(scene, cycles))


@pytest.mark.parametrize("scene", ["section4-cutoff", "section5-cutoff"])
@pytest.mark.parametrize(("nodes", "tolerance"), [(6, 1e-3), (8, 1e-5)])
def test_a_cycle_knows_what_its_nodes_miss(scene, nodes, tolerance):
    """Rates on few nodes: the map with many is exact beside it."""
    of = load_scene(scene)
    model, load = bind(of), of.periodic_load
    of_scene = [model], [load], [edge_of_contact(model, load)]
    wear, which = 1e-4 * np.geomspace(0.1, 5.0, 12), np.zeros(12, dtype=int)
    few, many = (
        switched_period_map(*of_scene, number, accuracy).advance(wear, which)
        for number, accuracy in ((nodes, tolerance), (30, 1e-14))
    )
    off = np.abs(few.increment - many.increment)
    assert np.max(off / many.increment) > 1e-12
    assert np.all(off <= 3 * few.error + 1e-13 * many.increment)


def test_cycles_end_at_their_deadline():
    model, load = bind(load_scene("section4-cutoff")), SINE
    cycle = switched_period_map([model], [load], [edge_of_contact(model, load)], 8, 1e-10)
    with pytest.raises(TimeoutError):
        cycle._replace(deadline=0.0).advance(np.zeros(1), np.zeros(1, dtype=int))


@pytest.mark.parametrize("k", [None, 1e5])
def test_rows_on_which_contact_lasts_are_taken_together(k):
    """A noisy record took as many steps as it has rows."""
    noise = 1e-5 * np.random.default_rng(1).standard_normal(200)
    times, values = np.arange(201) / 200, 5e-4 * np.sin(2 * np.pi * np.arange(200) / 200) + noise
    load = Table(tuple((0.06 * times).tolist()), (*values.tolist(), float(values[0])))
    model = bind(made(1e-5, 0.25, load, pin=True, k=k, cutoff=True))
    cycle = switched_period_map([model], [load], [edge_of_contact(model, load)], 8, 1e-10)
    wear, scene = np.linspace(0.0, 1e-3, 7), np.zeros(7, dtype=int)
    one_by_one = [run for _, run in cycle.pieces_from(wear, scene)]
    together = list(cycle.pieces_from(wear, scene, (64, 16)))
    assert len(together) <= len(one_by_one) / 2
    found, added = cycle.advance(wear, scene), sum(run.added for run in one_by_one)
    assert found.converged.all()
    allowed = found.error + sum(run.error for run in one_by_one) + 1e-14 * added
    assert np.all(np.abs(found.increment - added) <= allowed)


@pytest.mark.parametrize("kind", ["harmonics", "table"])
@pytest.mark.parametrize(("K", "f_c"), [(3e-4, 0.0), (5e-3, 0.0), (3e-3, 0.5)])
def test_contact_lost_and_found_again_on_one_rise(kind, K, f_c):
    agrees_with_the_judge(with_load(UNEVEN[kind], K, f_c), [1, 2], 1e-10)


@st.composite
def loads(draw: st.DrawFn) -> Load:
    """A few harmonics, or straight lines with plateaus."""
    swing = 3.6e-4 * 10 ** draw(between(-1, 0.6))
    if draw(st.booleans()):
        parts = [swing * draw(between(-1, 1)) for _ in range(5)]
        return Harmonics(parts[0] / 2, tuple(parts[1:3]), tuple(parts[3:]), 0.06)
    heights = [swing * draw(between(-1, 1)) for _ in range(draw(st.integers(1, 5)))]
    times = np.linspace(0.0, 1.0, 2 * len(heights) + 1)
    return Table(tuple(times), (*np.repeat(heights, 2), heights[0]))


@settings(max_examples=4)
@given(loads(), between(-8, -1), between(-0.2, 1.0), st.booleans())
def test_drawn_scenes_agree_with_the_judge(load, K, f_c, pin):
    scene = with_load(load, 10**K, f_c, pin)
    assume(float(bind(scene).margin(0.0, load.maximum)) > 1e-6)
    agrees_with_the_judge(scene, [1, 2], 1e-9)


def test_in_permanent_contact_the_cutoff_changes_nothing():
    cycles = np.array([1.0, 30.0, 1e6])
    found, want = (
        count.wear_after(bind(one), one.periodic_load, cycles, 1e-11)
        for one in (made(f_c=0.5, closure=4e-4, cutoff=cutoff) for cutoff in (True, False))
    )
    assert_allclose(found.u_c, want.u_c, rtol=1e-11)


@pytest.mark.parametrize("f_c", [1 / 3, 0.25])
def test_the_margin_of_one_solid_keeps_its_digits(f_c):
    """Near f = 1/3 roughness and closure outgrow their difference by orders of magnitude."""
    scene = made(f_c=f_c, cutoff=True)
    p, u = scene.parameters(), 1e3
    start = 3 * Fraction(p["sigma_c0"]) - Fraction(p["h_0"])
    true = start + (3 * Fraction(f_c) - 1) * Fraction(u)
    assert float(bind(scene).margin(u, 0.0)) == pytest.approx(float(true), rel=4e-16)


def test_kinks_are_where_contact_grazes():
    scene = made(f_c=0.25, cutoff=True)
    model, load = bind(scene), scene.periodic_load
    # Section 4: (1 - 3 f) u = U_a at the edge, of which only the peak, 5e-4 mm, is ahead.
    (grazing,) = grazing_wears(model, load, edge_of_contact(model, load), 1e-4)
    assert grazing.wear == pytest.approx(2e-3, rel=1e-14)


def test_a_load_turns_where_its_slope_vanishes():
    load = Harmonics(0.0, (1e-4, -2e-4), (3e-4, 1e-4), 0.06)
    turns = turning_points(load)[1:-1]
    assert len(turns) == 4
    assert np.max(np.abs(load.slope(turns))) < 1e-13
    assert turning_points(reference_scene("S2").periodic_load).tolist() == [0.0, 0.25, 0.75, 1.0]


def test_the_wear_at_which_contact_ends_is_known_better_than_the_cycle():
    """f just below 1/3: arrest at U/(1 - 3 f), in a cycle that double precision cannot tell."""
    scene = load_scene("f-just-below-one-third")
    found = count.wear_after(bind(scene), scene.periodic_load, np.array([1e8, 1e12]), 1e-10)
    slope = scene.parameters()["f_c"]
    assert_allclose(found.u_c[1], 5e-4 / (1 - 3 * slope), rtol=1e-9)
    assert np.all(found.error <= 1e-10)
    assert "(to within" in found.notices[0]


def test_contact_in_a_fixed_part_of_the_cycle_has_no_kinks():
    """In double precision f is less than 1/3: after 1e12 cycles the pace is lower by 1e-7."""
    scene = load_scene("f-one-third")
    model, load = bind(scene), scene.periodic_load
    found, fine = (count.wear_after(model, load, np.array([1e12]), x) for x in (1e-10, 1e-13))
    assert found.cost.cycles_integrated <= 420  # seven panels of 54, cut one by one
    assert found.error[0] <= 1e-10
    assert abs(found.u_c[0] / fine.u_c[0] - 1) <= found.error[0] + fine.error[0]


def test_cycles_until_a_wear_with_a_cutoff():
    scene = load_scene("section4-cutoff")
    model, load = bind(scene), scene.periodic_load
    wear = count.wear_after(model, load, np.array([7.0, 500.0]), 1e-11).u_c
    wanted = np.array([*wear, 0.002, 0.0021])
    found = count.first_passage(model, load, wanted, 1e-11)
    assert found.cycles.tolist() == [7.0, 500.0, 2045.0, np.inf]


def test_the_last_cycles_before_arrest_are_known_as_well_as_rounding_permits():
    """Two solids and slow wear: contact ends where its margin is hardly more than its rounding."""
    load = Sine(1.7387680687168289e-4, 0.06)
    scene = with_load(load, 3.678394561303414e-8, 0.15051080555767343, True, 9.391617219250994e-4)
    found = count.wear_after(bind(scene), load, np.array([1e6, 1e12]), 1e-11)
    assert np.all(found.error <= 1e-11)
    assert found.notices[0].startswith("wear stops for good in cycle")


@pytest.mark.parametrize(
    ("K", "f_c", "cycles"), [(1e-5, -0.1, [5, 20]), (1e-6, 0.1, [3, 20]), (3e-5, 0.1, [4, 12])]
)
def test_at_a_sharp_peak_wear_fades(K, f_c, cycles):
    """Each cycle takes the same part of the distance that is left: no cycle is the last."""
    scene = with_load(SHARP, K, f_c)
    agrees_with_the_judge(scene, cycles, 1e-12)
    last = count.wear_after(bind(scene), SHARP, np.array([1e12]), 1e-12)
    assert last.notices[0].startswith("wear approaches its limit; within rounding from cycle")
    assert last.cost.cycles_integrated <= 1000
    # B(u) = (1 - 3 f) u + h_0 - 3 sigma_0 has come to the peak.
    assert_allclose(last.u_c, (3 * 3.6e-4 - 9e-4 + 3e-4) / (1 - 3 * f_c), rtol=4e-15)
    assert last.error[0] < 1e-14


def test_the_edge_of_contact_turns_twice_between_two_samples():
    """The load rises ever more slowly and faster again; at its slowest, wear just wins."""
    slowest, swing = 0.1, 2 * np.pi * np.array([5e-4, -2e-4])
    turn = 2 * np.pi * slowest * np.array([1, 2])
    wave = np.array([5e-4, -2e-4])
    cosine, sine = (-wave * np.sin(turn)).tolist(), (wave * np.cos(turn)).tolist()
    load = Harmonics(0.0, tuple(cosine), tuple(sine), 0.06)
    assert load.slope(slowest) == pytest.approx(swing[0] + 2 * swing[1])
    model = bind(with_load(load, 1e-6, 0.0))
    at_edge = float(load(slowest)) + float(model.margin(0.0, 0.0))  # wear, as f = 0
    opens = load.period * float(model.rate(at_edge, float(load(slowest))))
    K = 1e-6 * float(load.slope(slowest)) / opens * (1 + 1e-9)
    edge = edge_of_contact(bind(with_load(load, K, 0.0)), load)
    assert np.min(np.abs(edge.pieces.end - slowest)) < 1e-4


def test_cycles_until_a_wear_that_fades():
    model = bind(with_load(SHARP, 3e-6, 0.1))
    wear = count.wear_after(model, SHARP, np.array([30.0, 60.0, 90.0]), 1e-11).u_c
    rest = count.wear_after(model, SHARP, np.array([1e6]), 1e-11).u_c
    found = count.first_passage(model, SHARP, np.array([*(wear - 1e-16), *(rest * 1.01)]), 1e-11)
    assert found.cycles.tolist() == [30.0, 60.0, 90.0, np.inf]


def test_a_loose_request_has_an_estimate_too():
    """The map that judges once took longer stretches than the map it judged: both missed alike."""
    heights = np.array([6.827e-4, 6.7253e-4, 1.4235e-4])
    load = Table(tuple(np.linspace(0.0, 1.0, 7)), (*np.repeat(heights, 2), heights[0]))
    scene = with_load(load, 7.660896067204755e-05, 0.8818842290643083, closure=5.879284e-4)
    agrees_with_the_judge(scene, [1], 1e-6)


def supported(K: float, f_c: float, pin: bool, k: float, load: Load = SINE) -> Scene:
    """Contact with cutoff on a compliant support."""
    return made(K, f_c, load, pin=pin, k=k, cutoff=True)


@pytest.mark.parametrize("load", [SINE, SHARP])
def test_on_a_compliant_support_wear_fades(load):
    """The pressure vanishes with the distance that is left: as d^(3/2) in a cycle at a smooth peak,
    as d^2 at a sharp one."""
    scene = supported(1e-5, 0.25, False, 1e5, load)
    model, acting = bind(scene), scene.periodic_load
    cycles = np.array([1e4, 4e4, 1e5, 4e5, 1e8, 1e12])
    found = count.wear_after(model, acting, cycles, 1e-11)
    assert np.all(found.error <= 1e-11)
    left = 4 * acting.maximum - found.u_c[:4]
    power = 2 if load is SINE else 1
    assert_allclose(left[::2] / left[1::2], 4.0**power, rtol=0.05)
    assert found.cost.cycles_integrated <= 1000
    if load is SINE:
        # Beyond what can be integrated the decay goes on: to a quarter of the wear's roundoff.
        end = re.search(r"within rounding from cycle (\d+)", found.notices[0])
        assert end is not None
        reached = left[3] * (4e5 / int(end[1])) ** power
        assert reached / (2.0**-54 * 4 * acting.maximum) == pytest.approx(1.0, rel=0.05)


def test_a_count_on_a_compliant_support_goes_on_from_any_cycle():
    """Sixty cycles, counted and one by one."""
    scene = supported(1e-5, 0.25, True, 1e5)
    model, load = bind(scene), scene.periodic_load
    found = count.wear_after(model, load, np.array([40.0, 100.0]), 1e-12)
    fine = switched_period_map([model], [load], [edge_of_contact(model, load)], 24)
    wear = found.u_c[0]
    with np.errstate(all="ignore"):  # of a load that does not rise on a stretch
        for _ in range(60):
            wear += float(fine.advance(np.array([wear]), np.zeros(1, dtype=int)).increment[0])
    assert abs(found.u_c[1] / wear - 1) <= found.error[1] + found.error[0] + 1e-14


def test_a_trial_state_far_beyond_the_edge_ends_no_iteration():
    """Under a falling load the first guess is worn so much that its margin hardly changes."""
    cosine, sine = (-8.890226218723552e-5, 1.1996065136084995e-4), (7.6918511e-5, -2.62846186e-5)
    load = Harmonics(3.965692608849733e-5, cosine, sine, 0.06)
    scene = with_load(load, 4.846613339856077e-4, -0.15365579871590224, closure=6.12588782e-4)
    agrees_with_the_judge(scene, [1, 2], 1e-6)


def test_a_phase_that_is_rounded_under_a_steep_load_is_no_lack_of_nodes():
    """The load rises by a roughness in 5e-3 of a cycle: no finer mesh smooths the rate."""
    times = (0.0, 0.0313, 0.0359, 0.0438, 0.0445, 0.06)
    load = Table(times, (0.0, 7.6e-4, -7.1e-4, 8e-5, 8.6e-4, 0.0))
    scene = with_load(load, 2.8e-3, 0.013, closure=9.577e-4)
    agrees_with_the_judge(scene, [1, 10], 1e-7)


def test_what_newtons_method_leaves_of_a_cycle_is_in_the_estimate():
    """It converges slowly where contact ends: what is left shrinks no faster than it did before."""
    changes = {
        "bearing.wear_coefficient": 5.4e-6,
        "bearing.roughness_growth": 0.14,
        "support.stiffness_MPa_per_mm": 1.3e4,
    }
    scene = load_scene("section4-cutoff").with_(changes)
    model, load = bind(scene), scene.periodic_load
    alone, first = (
        count.wear_after(model, load, np.array(cycles), 1e-12) for cycles in ([1.0], [1.0, 1e5])
    )
    assert honest(alone.u_c, alone.error, first.u_c[:1], first.error[:1])


def test_wear_that_hardly_changes_itself_is_counted_to_a_depth():
    """All the panels together are narrower than rounding."""
    numbers = {"bearing.wear_coefficient": 1e-30, "bearing.roughness_growth": 1e5}
    scene = load_scene("section4-cutoff").with_(numbers)
    found = count.first_passage(bind(scene), scene.periodic_load, np.array([1e-24, 1.0]), 1e-7)
    assert_allclose(found.cycles, [32221, np.inf], atol=1)


def test_increments_that_are_rounding_errors_are_not_cut_on_and_on(monkeypatch):
    """The closure is three roughnesses, up to rounding: contact is lost at once."""
    panels, solve_abel = [0], abel.solve

    def counted(grid, steps):
        panels.append(len(grid.c))
        return solve_abel(grid, steps)

    monkeypatch.setattr(abel, "solve", counted)
    scene = load_scene("section4-cutoff").with_(
        {"support.stiffness_MPa_per_mm": 1e5, "load.kind": "constant", "load.value_mm": 0.0}
    )
    with pytest.raises(AccuracyError):
        solve(scene, [10], rtol=1e-10, method="abel")
    assert max(panels) <= 2 * wear_ranges.MOST_PANELS
