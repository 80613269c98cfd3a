"""How many scenes a second of one core a study solves, by kind of scene, and what workers cost.

    python docs/bench/many_scenes.py

Times are of the processor, so that other work of the machine does not count. Workers are compared
with the same chunks in one process: what they take beyond is the cost of handing chunks over. Half
as many chunks are taken off, and with them the start of the workers, which is paid once.
"""

from __future__ import annotations

import resource
import tempfile
import time
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from wear import processes
from wear.scene import Scene, load_scene
from wear.studies.design import ROWS
from wear.studies.rows import solve_rows
from wear.studies.run import prepare, run

CYCLES = (9_000, 1_000_000)
WORKERS, CHUNKS = 2, 8
KINDS = {"smooth": 1024, "compliant support": 512, "measured load": 64, "loss of contact": 32}
NAMES = {
    "smooth": "section4",
    "compliant support": "soft-support",
    "loss of contact": "section4-cutoff",
}


def main() -> None:
    """Print two tables."""
    print("| scenes | rows | scenes a second of one core |\n| --- | ---: | ---: |")
    with tempfile.TemporaryDirectory() as folder:
        for kind, rows in KINDS.items():
            scene = load_scene(NAMES[kind]) if kind in NAMES else measured(Path(folder))
            asked = study(scene, rows)
            solve_rows(asked, asked.design.some(2))  # imports, caches
            start = time.process_time()
            answers = solve_rows(asked, asked.design.columns((slice(0, rows),)))
            seconds = time.process_time() - start
            assert not answers.status.any()
            print(f"| {kind} | {rows} | {rows / seconds:.0f} |", flush=True)
    alone = half(none)
    print(f"\na chunk alone: {alone / (CHUNKS // 2):.2f} s; time of all processes over that:")
    for name, executor in (("process pool", pool), ("Dask", dask)):
        print(f"{name}, {WORKERS} workers: {half(executor) / alone:.3f}", flush=True)


def study(scene: Scene, rows: int):
    """Return the study of so many roughness growths."""
    vary = [f"bearing.roughness_growth=0.2:0.3:{rows}"]
    return prepare(scene, vary, CYCLES, "grid", 0, 0, None, 1e-7)


def measured(folder: Path) -> Scene:
    """Return section 4 under a record of its load, with noise of 1 nm."""
    times = np.linspace(0.0, 0.06, 2001)
    values = 5e-4 * np.sin(2 * np.pi * times / 0.06)
    values += 1e-6 * np.random.default_rng(1).standard_normal(2001)
    values[-1] = values[0]
    np.savetxt(folder / "pin.csv", np.column_stack([times, values]), "%.17g", ",",
               header="t_s,U_a_mm", comments="")  # fmt: skip
    tables = load_scene("section4").to_tables()
    tables["load"] = {"kind": "table", "file": "pin.csv"}
    return Scene.from_dict(tables, folder=folder)


def half(executor) -> float:
    """Return the time of half of the chunks, once the workers are at work."""
    return taken(executor, ROWS * CHUNKS) - taken(executor, ROWS * CHUNKS // 2)


def taken(executor, rows: int) -> float:
    """Return the time of all processes for a study of so many rows."""
    before = spent()
    with tempfile.TemporaryDirectory() as folder, executor() as workers:
        store = run(study(load_scene("section4"), rows), Path(folder) / "out.zarr", workers, silent)
        assert store.counts()["done"] == rows
    return spent() - before


def spent() -> float:
    """Return the processor's time of this process and those that it has ended."""
    both = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(each.ru_utime + each.ru_stime for each in both)


def silent(_: str) -> None:
    """Say nothing."""


@contextmanager
def none() -> Iterator[None]:
    """Give no workers: all is solved here."""
    yield None


@contextmanager
def pool() -> Iterator[Executor]:
    """Give processes, all of them begun."""
    with processes.workers(WORKERS) as workers:
        list(workers.map(time.sleep, [1.0] * WORKERS))
        yield workers


@contextmanager
def dask() -> Iterator[Executor]:
    """Give the workers of a local cluster."""
    from distributed import Client, LocalCluster

    settings = {"n_workers": WORKERS, "threads_per_worker": 1, "dashboard_address": None}
    with LocalCluster(**settings) as cluster, Client(cluster) as client:
        yield client.get_executor()


if __name__ == "__main__":
    main()
