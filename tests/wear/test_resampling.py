"""Rows of a measured load that are merged: what is left, and that the error is known."""

import tracemalloc
from pathlib import Path

import numpy as np
import pytest

import wear
from tests.wear.reference_scenes import made
from wear.cycles import cycles_to_depth, sweep
from wear.orbit import period_map
from wear.resampling import resampled

ROWS = 801
TIMES = np.linspace(0.0, 0.06, ROWS)


def measured(
    folder: Path, noise_mm: float = 0.0, name: str = "section4", **entries: object
) -> wear.Scene:
    """A sine of half a micrometre as an instrument writes it, with noise."""
    noise = noise_mm * np.random.default_rng(3).standard_normal(ROWS)
    values = 5e-4 * np.sin(2 * np.pi * TIMES / 0.06) + noise
    values[-1] = values[0]
    rows = "\n".join(f"{t!r},{U!r}" for t, U in zip(TIMES.tolist(), values.tolist(), strict=True))
    (folder / "pin.csv").write_text(f"t_s,U_a_mm\n{rows}\n")
    table = {"kind": "table", "file": "pin.csv", **entries}
    tables = wear.load_scene(name).to_tables() | {"load": table}
    return wear.Scene.from_dict(tables, folder=folder)


@pytest.mark.parametrize("name", ["section4", "section3"])
@pytest.mark.parametrize(
    ("noise_mm", "rtol", "merged"),
    [(0.0, 1e-3, True), (0.0, 1e-5, True), (1e-6, 1e-3, True), (1e-5, 1e-5, False)],
)
def test_merging_stays_within_the_error_that_it_tells(tmp_path, name, noise_mm, rtol, merged):
    cycles = [1, 9000, 10**8]
    exact = wear.solve(measured(tmp_path, noise_mm, name, resample=False), cycles)
    scene = measured(tmp_path, noise_mm, name)
    found = wear.solve(scene, cycles, rtol)
    assert np.all(np.abs(found.u_c / exact.u_c - 1.0) <= found.error + exact.error)
    assert np.all(found.error <= rtol)
    words = "are merged to" if merged else f"all {ROWS - 1} rows of the load are kept"
    assert [notice for notice in found.notices if words in notice]
    assert found.definition.load is scene.load
    assert not [notice for notice in exact.notices if "rows of the load" in notice]


def test_the_looser_the_fewer_and_the_mean_is_kept(tmp_path):
    scene = measured(tmp_path, 1e-6)
    left = []
    for rtol in (1e-2, 1e-4, 1e-6):
        load = resampled(scene, rtol).scene.load
        assert isinstance(load, wear.Table)
        assert load.mean == pytest.approx(scene.load.mean, abs=1e-15)
        left.append(len(load.times_s))
    assert left == sorted(left)
    assert left[0] < 100 < left[-1]


def test_unequal_steps_and_a_force_are_merged_too(tmp_path):
    times = np.append(0.0, np.cumsum(np.random.default_rng(1).uniform(0.5, 1.5, 400)))
    force = 1000.0 * (1.0 - np.cos(2 * np.pi * times / times[-1]))
    force[-1] = force[0]
    lines = [f"{t!r},{R!r}" for t, R in zip(times.tolist(), force.tolist(), strict=True)]
    (tmp_path / "cell.csv").write_text("t_s,R_a_N\n" + "\n".join(lines))
    tables = wear.load_scene("section4").to_tables()
    tables["contact"] |= {"width_mm": 20.0, "length_mm": 30.0}
    tables["load"] = {"kind": "force", "file": "cell.csv"}
    scene = wear.Scene.from_dict(tables, folder=tmp_path)
    exact = wear.solve(scene.with_({"load.resample": False}), [5])
    found = wear.solve(scene, [5], 1e-3)
    assert [notice for notice in found.notices if "are merged to" in notice]
    assert abs(found.u_c[0] / exact.u_c[0] - 1.0) <= found.error[0] + exact.error[0]


def test_nothing_is_merged_where_contact_is_lost(tmp_path):
    scene = measured(tmp_path).with_({"contact.ends_at_3_sigma": True})
    assert resampled(scene, 1e-2).scene is scene


def test_many_scenes_share_what_their_load_is_merged_to(tmp_path):
    scene = measured(tmp_path)
    scenes = [scene.with_({"bearing.roughness_growth": f}) for f in (0.2, 0.25, 0.3)]
    loads = [resampled(each, 1e-3).scene.load for each in scenes]
    assert loads[0] is loads[1] is loads[2]
    found = sweep(scenes, np.array([1.0, 1e6]), rtol=1e-4)
    exact = [wear.solve(each.with_({"load.resample": False}), [1, 10**6]).u_c for each in scenes]
    assert np.all(np.abs(found.u_c / exact - 1.0) <= found.error)
    assert np.all((found.error > 1e-9) & (found.error <= 1e-4))


def test_rows_are_kept_where_wear_accelerates_beyond_their_error(tmp_path):
    scene = measured(tmp_path).with_({"contact.closure_mm": 2.5e-3})
    assert resampled(scene, 1e-3).error > 0.0
    found = wear.solve(scene, [10**6, 10**10], 1e-3)
    assert [notice for notice in found.notices if "are kept" in notice]


def test_a_sweep_keeps_the_rows_of_just_the_scenes_that_need_them(tmp_path):
    calm = measured(tmp_path)
    accelerating = calm.with_({"contact.closure_mm": 2.5e-3})
    cycles = [10**6, 10**10]
    found = sweep([calm, accelerating], cycles, 1e-3)
    assert np.all(found.error <= 1e-3)
    assert found.error[0, 1] > 1e-9 > found.error[1, 1]
    exact = wear.solve(accelerating.with_({"load.resample": False}), cycles)
    assert np.all(np.abs(found.u_c[1] / exact.u_c - 1.0) <= found.error[1] + exact.error)


def test_all_rows_of_a_long_record_take_little_memory(tmp_path, monkeypatch):
    scene = measured(tmp_path, resample=False)

    def run() -> tuple[wear.History, int]:
        tracemalloc.start()
        history = wear.solve(scene, [1, 10**6])
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        return history, peak

    at_once, large = run()
    monkeypatch.setattr(period_map, "MOST_AT_ONCE", ROWS * 30)
    in_parts, small = run()
    assert small < large / 2
    assert np.all(np.abs(in_parts.u_c / at_once.u_c - 1.0) <= in_parts.error + at_once.error)


def test_cycles_to_a_depth_are_counted_with_the_merged_rows(tmp_path):
    """Of whole numbers of cycles the errors are whole, too."""
    scene, depths = measured(tmp_path), np.geomspace(1e-4, 1e-2, 200)
    merged = resampled(scene, 1e-2).error
    exact = wear.cycles_until(scene.with_({"load.resample": False}), depths, rtol=1e-8)
    one = wear.cycles_until(scene, depths, rtol=1e-2)
    (many,), (error,) = cycles_to_depth([scene], depths, rtol=1e-2)
    assert many.tolist() == one.cycles.tolist()
    for estimate in (error, one.error):
        assert np.all(estimate >= merged)
        assert np.all(np.abs(one.cycles / exact.cycles - 1.0) <= estimate + exact.error)


def test_spiky_rows_are_resolved_between_many_breakpoints():
    """Jumps of a roughness from row to row: eight nodes do not do there, and cutting cures it."""
    level = 4e-4 * np.random.default_rng(5).uniform(-1.0, 1.0, 150)
    level[-1] = level[0]
    times = np.linspace(0.0, 0.06, 150)
    more = np.linspace(0.0, 0.06, 149 * 5 + 1)  # the same lines
    tables = [wear.Table(at, np.interp(at, times, level)) for at in (times, more)]
    found, again = (wear.solve(made(load=table), [1, 10**6]) for table in tables)
    assert np.all(np.abs(found.u_c / again.u_c - 1.0) <= found.error + again.error)
    assert np.all(found.error < 1e-11)


def test_blocks_of_several_records_follow_each_other(tmp_path):
    one, two = measured(tmp_path).load, wear.Table((0.0, 0.02, 0.06), (0.0, 4e-4, 0.0))
    (tmp_path / "two.csv").write_text("t_s,U_a_mm\n0,0\n0.02,4e-4\n0.06,0\n")
    blocks = [
        {"kind": "table", "file": "pin.csv", "cycles": 20},
        {"kind": "table", "file": "two.csv", "cycles": 30},
    ]
    tables = wear.load_scene("section4").to_tables() | {
        "load": {"kind": "blocks", "blocks": blocks}
    }
    scene = wear.Scene.from_dict(tables, folder=tmp_path)
    assert isinstance(scene.load, wear.Blocks)
    assert [block.load.mean for block in scene.load.blocks] == [one.mean, two.mean]
    first = wear.solve(scene, [20, 50], 1e-8).u_c
    assert first[0] == pytest.approx(wear.solve(measured(tmp_path), [20], 1e-8).u_c[0], rel=1e-7)
    assert first[1] > first[0]
