"""Scenes that a study solves per second of one core, by kind of scene, and the cost of workers.

    python docs/bench/many_scenes.py

Times are CPU times, so that other work of the machine does not count. The cost of workers is
the time of all processes for handing over a chunk and its answers, without solving it.
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
from wear.studies.rows import Answers, Study, solve_rows
from wear.studies.run import prepare

CYCLES = (9_000, 1_000_000)
WORKERS, TASKS = 2, 200
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
            solve_rows(asked, asked.design.random_rows(2))  # imports, caches
            start = time.process_time()
            answers = solve_rows(asked, asked.design.columns((slice(0, rows),)))
            seconds = time.process_time() - start
            assert not answers.status.any()
            print(f"| {kind} | {rows} | {rows / seconds:.0f} |", flush=True)
    print("\nhanding over a chunk and its answers:")
    for name, executor in (("process pool", pool), ("Dask", dask)):
        seconds = (taken(executor, 2 * TASKS) - taken(executor, TASKS)) / TASKS
        print(f"{name}, {WORKERS} workers: {1e3 * seconds:.2f} ms", flush=True)


def study(scene: Scene, rows: int) -> Study:
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


def taken(executor, tasks: int) -> float:
    """Return the time of all processes for handing over so many chunks, the start included."""
    before, asked = spent(), study(load_scene("section4"), ROWS)
    with executor() as workers:
        for number in range(0, tasks, WORKERS):
            some = [workers.submit(unsolved, asked, number + k) for k in range(WORKERS)]
            assert all(len(each.result().reason) == ROWS for each in some)
    return spent() - before


def unsolved(asked: Study, number: int) -> Answers:
    """Return answers of the size of a chunk, of a task that differs by its number."""
    wear = np.full((2, ROWS, len(asked.cycles)), float(number))
    return Answers(*wear, wear[0, :, 0], np.zeros(ROWS, dtype=np.uint8), [""] * ROWS)


def spent() -> float:
    """Return the processor's time of this process and those that it has ended."""
    both = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(each.ru_utime + each.ru_stime for each in both)


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

    settings = {"n_workers": WORKERS, "threads_per_worker": 1, "dashboard_address": ":0"}
    with LocalCluster(**settings) as cluster, Client(cluster) as client:
        yield client.get_executor()


if __name__ == "__main__":
    main()
