"""Studies: designs, whole chunks or none, the same bits however they come about."""

import dataclasses
import json
import os
import signal
import subprocess
import sys
import time
from concurrent.futures import Executor, Future, ProcessPoolExecutor
from types import FunctionType
from typing import Any

import numpy as np
import pytest
import xarray
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

import wear
from tests.programs import ended
from wear.faults import UsageError, WorkersLost
from wear.studies import design as designs
from wear.studies.design import Design, permuted
from wear.studies.rows import RowStatus
from wear.studies.run import study
from wear.studies.vary import Distribution, Levels, parse

GROWTH, HARDNESS = "bearing.roughness_growth", "bearing.hardness_MPa"


@pytest.fixture
def small_chunks(monkeypatch):
    monkeypatch.setattr(designs, "ROWS", 8)


def same(one: xarray.Dataset, other: xarray.Dataset) -> bool:
    return bool(one.load().identical(other.load()))


# What varies


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a.b=1,3,2", Levels("a.b", (1.0, 3.0, 2.0))),
        ("a.b=0.1:0.3:3", Levels("a.b", (0.1, 0.2, 0.3))),
        ("a.b = 1e-8:1e-6:3:log", Levels("a.b", (1e-8, 1e-7, 1e-6))),
        ("a.b=normal(2, 0.5)", Distribution("a.b", "normal", (2.0, 0.5))),
    ],
)
def test_what_varies_is_read(text, expected):
    assert parse(text) == expected


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("bearing.hardness_MPa", "KEY=VALUES"),
        ("a.b=1:2", "low:high:count"),
        ("a.b=2:1:5", "low < high"),
        ("a.b=0:1:5:log", "0 < low"),
        ("a.b=1:2:2.5", "whole number"),
        ("a.b=1,nan", "finite"),
        ("a.b=1,1", "twice"),
        ("a.b=gauss(1,2)", "choose one of"),
        ("a.b=uniform(2,1)", "low < high"),
        ("a.b=lognormal(1,0.5)", "factor > 1"),
        ("a.b=normal(1)", "normal(mean,sd)"),
        ("a.b=__import__('os')", "finite"),
    ],
)
def test_what_cannot_vary_is_refused_with_the_remedy(text, word):
    with pytest.raises(UsageError, match=word.replace("(", r"\(").replace(")", r"\)")):
        parse(text)


@pytest.mark.parametrize(
    ("made", "word"),
    [
        (lambda: Levels("a.b", ()), "finite"),
        (lambda: Levels("a.b", (1.0, 1.0)), "twice"),
        (lambda: Distribution("a.b", "gauss", (1.0, 2.0)), "choose one of"),
        (lambda: Distribution("a.b", "uniform", (2.0, 1.0)), "low < high"),
        (lambda: Distribution("a.b", "normal", (0.0, np.inf)), "finite"),
    ],
)
def test_what_cannot_vary_is_refused_without_a_text_too(made, word):
    with pytest.raises(UsageError, match=word):
        made()


def test_a_scene_that_no_row_can_solve_is_refused_at_once(tmp_path):
    sine, place = wear.load_scene("section4"), tmp_path / "none.zarr"
    load = wear.HistoryLoad((0.0, 0.03, 0.06), (0.0, 5e-4, 0.0), 0.06)
    with pytest.raises(UsageError, match="no load of kind history"):
        study(dataclasses.replace(sine, load=load), "bearing.hardness_MPa=1,2", 5, place)
    with pytest.raises(UsageError, match="is zero"):
        study(sine, "bearing.hardness_MPa=0,-1", 5, place)


def test_blocks_are_studied_as_they_are_run(tmp_path):
    blocks = wear.Blocks(tuple(wear.Block(wear.Sine(swing, 0.06), 3) for swing in (2e-4, 5e-4)))
    scene = dataclasses.replace(wear.load_scene("section4"), load=blocks)
    made = study(scene, "bearing.hardness_MPa=100,200", 5, tmp_path / "blocks.zarr")
    assert made.bearing_wear_mm.values[1, 0] == pytest.approx(wear.solve(scene, [5]).u_c[0], 1e-7)


def test_rows_whose_load_ends_too_early_fail_and_a_study_of_them_alone_is_refused(tmp_path):
    blocks = wear.Blocks((wear.Block(wear.Sine(5e-4, 0.06), 3),))
    scene = dataclasses.replace(wear.load_scene("section4"), load=blocks)
    with pytest.raises(UsageError, match="load is 3; name cycles up to that"):
        study(scene, "bearing.hardness_MPa=100,200", 5, tmp_path / "none.zarr")
    made = study(scene, "load.blocks[0].cycles=3,6", 5, tmp_path / "study.zarr")
    assert made.status.values.tolist() == [RowStatus.FAILED, 0]
    assert "name cycles up to that" in str(made.reason.values[0])


def test_an_invalid_first_row_is_a_row(tmp_path):
    made = study("section4", "bearing.hardness_MPa=0,100,-5", 5, tmp_path / "study.zarr")
    assert made.status.values.tolist() == [1, 0, 1]


def test_a_study_that_another_process_has_just_made_is_told(tmp_path, monkeypatch):
    place = tmp_path / "study.zarr"
    monkeypatch.setattr(
        "zarr.consolidate_metadata", lambda _: (place / "other").mkdir(parents=True)
    )
    with pytest.raises(UsageError, match="another process has just made it"):
        study("section4", "bearing.hardness_MPa=100,200", 5, place)
    assert [path.name for path in tmp_path.iterdir()] == ["study.zarr"]


def test_two_thirds_of_a_lognormal_quantity_are_within_its_factor():
    law = Distribution("a.b", "lognormal", (3.0, 2.0))
    low, high = stats.norm.cdf([-1.0, 1.0])
    np.testing.assert_allclose(law.quantile(np.array([low, 0.5, high])), [1.5, 3.0, 6.0])


# Designs


@pytest.mark.usefixtures("small_chunks")
@given(st.lists(st.integers(1, 9), min_size=1, max_size=3))
def test_the_chunks_of_a_grid_cover_it_once(lengths):
    vary = tuple(Levels(f"k.{i}", tuple(range(n))) for i, n in enumerate(lengths))  # type: ignore[arg-type]
    plan = Design("grid", vary)
    seen = np.zeros(plan.shape, dtype=int)
    for chunk in plan.chunks():
        columns = plan.columns(chunk)
        places = tuple(columns[v.key].astype(int) for v in vary)
        assert len(places[0]) <= designs.ROWS
        np.add.at(seen, places, 1)
    assert np.all(seen == 1)


@pytest.mark.usefixtures("small_chunks")
@pytest.mark.parametrize("kind", ["sobol", "latin-hypercube", "random"])
def test_samples_follow_their_distribution_whatever_the_chunks(kind):
    vary = (Distribution("a.b", "uniform", (0.0, 1.0)), Distribution("a.c", "normal", (0.0, 1.0)))
    plan = Design(kind, vary, samples=512, seed=7)
    columns = [plan.columns(chunk) for chunk in plan.chunks()]
    uniform = np.concatenate([column["a.b"] for column in columns])
    normal = np.concatenate([column["a.c"] for column in columns])
    assert stats.kstest(uniform, "uniform").pvalue > 1e-3
    assert stats.kstest(normal, "norm").pvalue > 1e-3
    assert abs(np.corrcoef(uniform, normal)[0, 1]) < 0.15
    if kind != "random":  # every 512th of the range is met once
        assert len(set(np.floor(uniform * 512).astype(int))) == 512
    other = Design(kind, vary, samples=512, seed=8)
    assert not np.array_equal(other.columns((slice(0, 8),))["a.b"], uniform[:8])


@given(st.integers(1, 3000), st.integers(0, 2**40))
def test_a_permutation_meets_everything_once(size, key):
    assert sorted(permuted(np.arange(size), size, (key,)).tolist()) == list(range(size))


# Results


@pytest.mark.usefixtures("small_chunks")
def test_a_study_is_what_its_scenes_give_one_by_one(tmp_path):
    vary = [f"{GROWTH}=0.1:0.3:3", f"{HARDNESS}=100:300:5"]
    found = study("section4", vary, [10, 9000], tmp_path / "a.zarr", until_wear=1e-3)
    assert found["bearing_wear_mm"].dims == (GROWTH, HARDNESS, "cycle")
    assert found["bearing_wear_mm"].attrs["units"] == "mm"
    assert found[HARDNESS].attrs["units"] == "MPa"
    scene = wear.load_scene("section4").with_({GROWTH: 0.2, HARDNESS: 250.0})
    history = wear.solve(scene, [10, 9000], rtol=1e-12)
    row = found.sel({GROWTH: 0.2, HARDNESS: 250.0})
    off = np.abs(row["bearing_wear_mm"].values / history.u_c - 1.0)
    assert np.all(off <= row["error_estimate"].values + 1e-12)
    count = int(row["cycles_to_wear"])
    around = wear.solve(scene, [count - 1, count], rtol=1e-12).u_c
    assert around[0] < 1e-3 <= around[1]
    assert 0.0 < found["cycles_to_wear_error"].values.max() < 1e-5


@pytest.mark.usefixtures("small_chunks")
def test_a_study_takes_no_more_disk_than_it_says(tmp_path):
    from wear.studies.run import prepare
    from wear.studies.store import disk_bytes

    words = ("section4", [f"{GROWTH}=0.1:0.3:160"], [1, 9000])
    study(*words, tmp_path / "a.zarr")
    files = [file for file in (tmp_path / "a.zarr").rglob("*") if file.is_file()]
    taken = sum(-(-file.stat().st_size // 4096) * 4096 + 4096 for file in files)
    assert taken <= disk_bytes(prepare(*words, "grid", 0, 0, None, 1e-7)) <= 2 * taken


@pytest.mark.usefixtures("small_chunks")
def test_an_invalid_scene_is_a_row_with_its_reason(tmp_path):
    found = study("section4", [f"{HARDNESS}=100,-1"], [10], tmp_path / "a.zarr")
    assert found["status"].values.tolist() == [RowStatus.DONE, RowStatus.INVALID_SCENE]
    assert "hardness_MPa" in str(found["reason"].values[1])
    assert np.isnan(found["bearing_wear_mm"].values[1, 0])


@pytest.mark.usefixtures("small_chunks")
def test_what_is_missing_is_all_that_is_solved_again(tmp_path, monkeypatch):
    from wear.studies import run

    request: dict[str, Any] = {"design": "latin-hypercube", "samples": 40, "seed": 3}
    vary = [f"{GROWTH}=uniform(0.1,0.3)"]
    whole = study("section4", vary, [9000], tmp_path / "whole.zarr", **request)
    solved = run.solve_chunk

    def fails_at_the_third(*arguments: Any) -> Any:
        if (tmp_path / "part.zarr" / "status" / "c" / "1").exists():
            raise KeyboardInterrupt
        return solved(*arguments)

    monkeypatch.setattr(run, "solve_chunk", fails_at_the_third)
    with pytest.raises(KeyboardInterrupt):
        study("section4", vary, [9000], tmp_path / "part.zarr", **request)
    kept = sorted((tmp_path / "part.zarr" / "status" / "c").iterdir())
    written = [file.stat().st_mtime_ns for file in kept]
    assert len(kept) == 2
    monkeypatch.setattr(run, "solve_chunk", solved)
    part = study("section4", vary, [9000], tmp_path / "part.zarr", **request)
    assert [file.stat().st_mtime_ns for file in kept] == written
    assert same(part, whole)


@pytest.mark.usefixtures("small_chunks")
def test_another_study_at_the_same_place_is_refused(tmp_path):
    study("section4", [f"{GROWTH}=0.1,0.2"], [10], tmp_path / "a.zarr")
    with pytest.raises(UsageError, match=r"another study, which differs in: vary, cycles"):
        study("section4", [f"{GROWTH}=0.1,0.3"], [11], tmp_path / "a.zarr")
    (tmp_path / "b.zarr").mkdir()
    with pytest.raises(UsageError, match="is not a study"):
        study("section4", [f"{GROWTH}=0.1,0.2"], [10], tmp_path / "b.zarr")
    with pytest.raises(UsageError, match="make it first"):
        study("section4", [f"{GROWTH}=0.1,0.2"], [10], tmp_path / "no" / "a.zarr")


def test_all_that_is_wrong_with_a_request_is_said_at_once(tmp_path):
    vary = ["bearing.hardnes_MPa=1,2", f"{GROWTH}=2:1:3", "support.x=1,2", "radius=1,2"]
    with pytest.raises(UsageError) as caught:
        study("section4", vary, [], tmp_path / "a.zarr", rtol=1.0, until_wear=-1.0)
    for word in (
        "hardness_MPa",
        "low < high",
        "support",
        "mean motion.radius_mm",
        "cycles",
        "rtol",
        "until_wear",
    ):
        assert word in str(caught.value)
    assert list(tmp_path.iterdir()) == []


def test_a_study_larger_than_the_disk_is_refused(tmp_path, monkeypatch):
    from wear.studies import store

    free = type("Usage", (), {"free": 1000})
    monkeypatch.setattr(store.shutil, "disk_usage", lambda _: free)
    with pytest.raises(UsageError, match="are free"):
        study("section4", [f"{GROWTH}=0.1:0.2:1000"], [10], tmp_path / "a.zarr")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.usefixtures("small_chunks")
def test_a_scene_that_fails_is_a_row_with_its_reason(tmp_path, monkeypatch):
    from wear import cycles

    solved = cycles.sweep

    def fails(scenes: Any, *more: Any) -> Any:
        if any(scene.bearing.hardness_MPa == 150.0 for scene in scenes):
            raise ZeroDivisionError("division by zero")
        return solved(scenes, *more)

    monkeypatch.setattr(cycles, "sweep", fails)
    found = study("section4", [f"{HARDNESS}=100,150,200,250,300"], [10], tmp_path / "a.zarr")
    assert found["status"].values.tolist() == [0, RowStatus.FAILED, 0, 0, 0]
    assert str(found["reason"].values[1]) == "ZeroDivisionError: division by zero"
    assert np.isnan(found["bearing_wear_mm"].values[:, 0]).tolist() == [False, True] + [False] * 3


@pytest.mark.usefixtures("small_chunks")
def test_a_study_without_any_answer_has_no_picture(tmp_path):
    vary, seed = [f"{HARDNESS}=uniform(-2,200)"], np.int64(1)
    found = study("section4", vary, 9, tmp_path / "a.zarr", design="random", samples=8, seed=seed)
    found["status"][:] = RowStatus.INVALID_SCENE
    for picture in (wear.picture, wear.ten_percent_life):
        with pytest.raises(UsageError, match=r"no row has an answer|is missing"):
            picture(found)


# Implausible magnitudes


@pytest.mark.usefixtures("small_chunks")
def test_what_is_hardly_meant_is_said_once_a_kind_with_the_count_and_the_worst_row(tmp_path):
    vary = ["bearing.roughness_mm=0.36,0.00036", "motion.radius_mm=1:22:9", f"{HARDNESS}=200,-1"]
    found = study("section4", vary, [10, 10**8], tmp_path / "a.zarr").attrs["notices"]
    entry, depth, rough = found
    assert "[bearing] roughness_mm = 0.36 is outside" in entry
    assert "um typed as mm? (9 of 36 rows;" in entry
    rows = {
        (roughness, radius): wear.solve(wear.load_scene("section4").with_(
            {"bearing.roughness_mm": roughness, "motion.radius_mm": radius}), [10**8])
        for roughness in (0.36, 0.00036) for radius in np.linspace(1, 22, 9)
    }  # fmt: skip
    for text, words in ((depth, "% of the radius"), (rough, "ISO 1302")):
        alone = [name for name, row in rows.items() if any(words in n for n in row.notices)]
        assert words in text
        assert f"({len(alone)} of 36 rows; the worst has bearing.roughness_mm = " in text
    roughness, radius = max(rows, key=lambda name: rows[name].u_c[0] / name[1])
    assert f"bearing.roughness_mm = {roughness:g}, motion.radius_mm = {radius:g}, " in depth


def test_strict_refuses_a_study_whose_rows_are_implausible(call, tmp_path):
    words = ["section4", "--vary", f"{HARDNESS}=200,2e8", "--cycles", "9", "--workers", "1"]
    words += ["-o", str(tmp_path / "a.zarr")]
    status, _, messages = call("study", *words)
    assert (status, "Pa typed as MPa? (1 of 2 rows; the worst has" in messages) == (0, True)
    status, shown, messages = call("study", *words, "--strict")
    assert (status, shown, "Pa typed as MPa?" in messages) == (2, "", True)


# Workers


class Unreliable(ProcessPoolExecutor):
    """A pool whose workers are killed once two chunks were handed over."""

    submitted = 0

    def submit(self, *arguments: Any, **named: Any) -> Any:
        future = super().submit(*arguments, **named)
        self.submitted += 1
        if self.submitted == 2:
            for process in self._processes.values():
                os.kill(process.pid, signal.SIGKILL)
        return future


@pytest.mark.usefixtures("small_chunks")
def test_lost_workers_are_said_and_the_study_goes_on_to_the_same_bits(tmp_path):
    vary = [f"{GROWTH}=0.1:0.3:40"]
    whole = study("section4", vary, [9000], tmp_path / "whole.zarr")
    with Unreliable(2) as pool, pytest.raises(WorkersLost, match="goes on"):
        study("section4", vary, [9000], tmp_path / "part.zarr", executor=pool)
    with ProcessPoolExecutor(2) as pool:
        part = study("section4", vary, [9000], tmp_path / "part.zarr", executor=pool)
    assert same(part, whole)


class Confused(Executor):
    """An executor whose futures fail as Dask's do while its scheduler goes away, or in a chunk."""

    def __init__(self, module: str):
        self.taken_apart = FunctionType(_taken_apart.__code__, {"__name__": module})

    def submit(self, *_: Any, **__: Any) -> Future[Any]:
        future: Future[Any] = Future()
        try:
            self.taken_apart((1, 2, 3, 4))
        except ValueError as fault:
            future.set_exception(fault)
        return future


def _taken_apart(answers: Any) -> None:
    _kind, _fault, _traceback = answers


@pytest.mark.parametrize(
    ("module", "fault"),
    [("distributed.cfexecutor", WorkersLost), ("wear.studies.rows", ValueError)],
)
def test_a_fault_of_the_executor_is_told_from_one_of_a_chunk(tmp_path, module, fault):
    with pytest.raises(fault, match="too many values"):
        study(
            "section4",
            f"{GROWTH}=0.1:0.3:4",
            [9000],
            tmp_path / "a.zarr",
            executor=Confused(module),
        )


def _command(*words: str, rows: int = 8) -> list[str]:
    """Return the command line `wear study` with small chunks."""
    code = (
        "import sys; from wear.studies import design; design.ROWS = int(sys.argv.pop(1)); "
        "from wear.cli import main; sys.exit(main(sys.argv[1:]))"
    )
    return [sys.executable, "-c", code, str(rows), "study", *words]


@pytest.mark.usefixtures("small_chunks")
def test_a_study_killed_at_random_moments_ends_with_the_same_bits(tmp_path):
    vary = f"{GROWTH}=0.1:0.3:160"
    whole = study("section4", [vary], [9000], tmp_path / "whole.zarr")
    words = ["section4", "--vary", vary, "--cycles", "9000", "--workers", "1"]
    random = np.random.default_rng(5)
    part = tmp_path / "part.zarr"
    for _ in range(2):
        process = subprocess.Popen(_command(*words, "-o", str(part)))
        begun = time.monotonic()
        while not part.exists() and process.poll() is None and time.monotonic() < begun + 60:
            time.sleep(0.01)
        time.sleep(random.uniform(0.0, 0.15))
        process.kill()
        process.wait()
    subprocess.run(_command(*words, "-o", str(part)), check=True)
    assert same(xarray.open_zarr(part, consolidated=False), whole)


def _begun_on(cluster, out, vary: str) -> subprocess.Popen[str]:
    """Return a study that runs on a cluster and has finished its first chunk."""
    words = ["section4", "--vary", vary, "--cycles", "9000", "-o", str(out)]
    command = _command(*words, "--scheduler", cluster.scheduler_address)
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    while not (out / "status" / "c" / "0").exists() and process.poll() is None:
        time.sleep(0.01)
    return process


@pytest.mark.usefixtures("small_chunks")
def test_nothing_is_lost_with_a_worker_and_a_scheduler_that_goes_away_is_a_clear_error(tmp_path):
    """One cluster for both: it is what takes time."""
    from distributed import LocalCluster

    vary, out = f"{GROWTH}=0.1:0.3:80", tmp_path / "c.zarr"
    whole = study("section4", [vary], [9000], tmp_path / "whole.zarr")
    options = {"dashboard_address": ":0", "silence_logs": "CRITICAL"}
    with LocalCluster(n_workers=2, threads_per_worker=1, **options) as cluster:
        process = _begun_on(cluster, out, vary)
        os.kill(next(iter(cluster.workers.values())).pid, signal.SIGKILL)
        _, complaint = process.communicate(timeout=120)
        assert process.returncode == 0, complaint
        assert same(xarray.open_zarr(out, consolidated=False), whole)
        process = _begun_on(cluster, tmp_path / "d.zarr", f"{GROWTH}=0.1:0.3:4000")
    _, complaint = process.communicate(timeout=120)
    assert process.returncode == 130, complaint
    assert "the same command goes on" in complaint
    assert "Traceback" not in complaint


def test_a_full_disk_keeps_what_is_finished(tmp_path, monkeypatch):
    import resource

    out, vary = str(tmp_path / "a.zarr"), f"{GROWTH}=0.1:0.3:1024"
    words = ["section4", "--vary", vary, "--cycles", "9000", "--workers", "1"]
    limit = (4096, resource.getrlimit(resource.RLIMIT_FSIZE)[1])
    full = ended(
        *_command(*words, "-o", out, rows=1024),
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, limit),
    )
    assert full.returncode == 2
    assert "File too large" in full.stderr
    assert "Traceback" not in full.stderr
    monkeypatch.setattr(designs, "ROWS", 1024)
    found = study("section4", [vary], [9000], out)
    assert bool((found["status"] == RowStatus.DONE).all())


def test_a_scheduler_that_is_not_there_is_a_clear_error(call, monkeypatch):
    monkeypatch.setattr("wear.commands.study.LONGEST_WAIT", 1)
    words = ("section4", "--vary", f"{GROWTH}=0.1,0.2", "-o", "never.zarr")
    status, _, messages = call("study", *words, "--scheduler", "tcp://127.0.0.1:9")
    assert status == 2
    assert "nothing answers at tcp://127.0.0.1:9" in messages


# Sobol' indices


def test_the_indices_of_a_product_are_those_of_its_logarithms():
    """After one cycle of little wear u ~ K p_max/H: a product, whose indices are known."""
    from wear.studies.figures import indices
    from wear.studies.indices import sobol_indices

    spread = (0.2, 0.1)
    vary = [f"bearing.wear_coefficient=lognormal(1e-10,{np.exp(spread[0])})",
            f"{HARDNESS}=lognormal(200,{np.exp(spread[1])})"]  # fmt: skip
    found = sobol_indices("section4", vary, [1], samples=512, seed=2)
    each = np.expm1(np.square(spread))
    total = np.prod(1 + each) - 1
    for place in range(2):
        row = found.isel(key=place, cycle=0)
        assert float(row["first_order_low"]) < each[place] / total < float(row["first_order_high"])
        assert float(row["first_order_high"] - row["first_order_low"]) < 0.5
    assert indices(found).axes


def test_a_seed_makes_indices_and_their_confidence_reproducible():
    from wear.studies.indices import sobol_indices

    vary = [f"{HARDNESS}=uniform(100,300)", f"{GROWTH}=uniform(0.1,0.3)"]
    one, other = (sobol_indices("section4", vary, [9], samples=16, seed=3) for _ in range(2))
    assert one.identical(other)


def test_a_single_key_has_no_indices():
    from wear.studies.indices import sobol_indices

    with pytest.raises(UsageError, match="two keys or more"):
        sobol_indices("section4", f"{HARDNESS}=normal(200,10)", [1, 2], samples=4)


def test_indices_of_scenes_without_an_answer_are_refused():
    from wear.studies.indices import sobol_indices

    with pytest.raises(UsageError, match="narrow the distributions"):
        sobol_indices(
            "section4", [f"{HARDNESS}=normal(10,10)", f"{GROWTH}=uniform(0,1)"], 1, samples=16
        )


# The command


def test_a_dry_run_says_what_a_study_takes_and_writes_nothing(call, tmp_path, monkeypatch):
    monkeypatch.setattr("wear.commands.study.LEAST_SECONDS", 0.01)  # the first few rows are timed
    out = tmp_path / "a.zarr"
    words = ("section4", "--vary", f"{GROWTH}=0.1:0.3:21", "-o", str(out), "--dry-run")
    status, shown, _ = call("study", *words, "--json")
    said = json.loads(shown)
    assert (status, said["scenes"], said["disk_bytes"]) == (0, 21, 21 * 17 + 15 * 8192)
    assert said["core_seconds"] > 0
    assert not out.exists()


def test_the_command_writes_a_picture_and_says_what_became_of_the_rows(call, tmp_path):
    out, figure = tmp_path / "a.zarr", tmp_path / "a.svg"
    words = ["section4", "--vary", f"{HARDNESS}=normal(200,20)", "--design", "sobol"]
    words += ["--samples", "16", "--cycles", "9000", "--until-wear", "0.001", "-o", str(out)]
    status, shown, _ = call("study", *words, "--workers", "1", "--figure", str(figure), "--json")
    assert (status, json.loads(shown)["rows"]["done"]) == (0, 16)
    assert figure.read_text().startswith("<?xml")
