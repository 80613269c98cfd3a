"""Fits to synthetic readings of known parameters: coverage of the 95 % intervals, and times.

    python docs/bench/coverage.py

Wear coefficient and roughness growth are free. A set leaves a direction open if a combination of
them has a standard error beyond a factor e at the true parameters, by differences of counts. Its
intervals are open, and not counted among those that cover the truth.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

import wear
from wear.fitting.readings import Specimen
from wear.numerics.gauss import FloatArray
from wear.parameters import parameters_of
from wear.scene import Scene, load_scene

SETS, SEED = 200, 1
FREE = K, GROWTH = "bearing.wear_coefficient", "bearing.roughness_growth"
KINDS = {
    "rigid support": ("section4", {}),
    "compliant support": ("section4", {"support.stiffness_MPa_per_mm": 1e5}),
    "two solids": ("section5", {}),
    "loss of contact": ("section4-cutoff", {"contact.closure_mm": 1e-3}),
    "late readings": ("section4", {}),
}
AHEAD = 10  # times the cycles of the last reading: the forecast
STEP = 1e-3  # of a difference, relative to the parameter


class Trial(NamedTuple):
    """A fit: whether the intervals (2,) and the band of the forecast cover the truth, whether the
    readings leave a direction open, whether one is named, and the CPU time in s."""

    intervals: tuple[bool, ...]
    forecast: bool
    leaves_open: bool
    named: bool
    seconds: float


def main() -> None:
    """Print a table of the sets by kind, and the times of fits to 100 readings."""
    print("| readings | sets | intervals | forecasts | open | named | named of others | s |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |", flush=True)
    every = list[Trial]()
    for place, kind in enumerate(KINDS):
        seeds = [(SEED, place, number) for number in range(SETS // len(KINDS))]
        trials = [trial(kind, np.random.default_rng(seed)) for seed in seeds]
        every += trials
        print(row(kind, trials), flush=True)
    print(row("all", every))
    for kind in KINDS:
        random = np.random.default_rng(SEED)
        print(f"100 readings, {kind}: {trial(kind, random, 100).seconds:.2f} s", flush=True)


def trial(kind: str, random: np.random.Generator, readings: int | None = None) -> Trial:
    """Return the fit of a random set of readings, from a start that is off."""
    builtin, changes = KINDS[kind]
    scatter, known = random.uniform(0.02, 0.08), random.random() < 0.5
    values = {K: 10 ** random.uniform(-7, -5), GROWTH: random.uniform(0.1, 0.3)}
    truth = load_scene(builtin).with_({**changes, **values})
    first, last = (1e6, 2e6) if kind == "late readings" else (1.0, 10 ** random.uniform(3, 5))
    number = readings or int(random.integers(6, 13))
    cycles = np.rint(np.geomspace(first, last, number))
    clean = wear.sweep([truth], cycles, 1e-9).u_c[0]
    read = clean * np.exp(scatter * random.standard_normal(number))
    specimen = Specimen("", cycles, read, scatter * read if known else None, {})
    off = {K: values[K] * 10 ** random.uniform(-1, 1), GROWTH: random.uniform(0.1, 0.3)}
    start = time.process_time()
    found = wear.fit([specimen], truth.with_(off), FREE)
    seconds = time.process_time() - start
    (ahead,) = found.forecast(AHEAD * cycles[-1])
    after = float(wear.sweep([truth], [AHEAD * cycles[-1]], 1e-9).u_c[0, 0])
    return Trial(
        tuple(covers(p.interval, values[key]) for p, key in zip(found.profiles, FREE, strict=True)),
        covers(ahead.interval_95, after),
        leaves_open(truth, cycles, scatter),
        bool(found.undetermined()),
        seconds,
    )


def covers(interval: tuple[float, float], truth: float) -> bool:
    """Return whether an interval contains the truth."""
    return interval[0] <= truth <= interval[1]


def leaves_open(truth: Scene, cycles: FloatArray, scatter: float) -> bool:
    """Return whether a combination of ln(K) and the relative growth is open."""
    numbers = parameters_of(truth)
    moved = [truth.with_({key: numbers[key] * (1 + s)}) for key in FREE for s in (STEP, -STEP)]
    level = np.log(wear.sweep(moved, cycles, 1e-12).u_c)
    slope = (level[::2] - level[1::2]) / (2 * STEP)
    return bool(np.linalg.svd(slope)[1].min() < scatter)


def row(kind: str, trials: Sequence[Trial]) -> str:
    """Return a line of the table."""
    leave_open = [each for each in trials if each.leaves_open]
    others = [each for each in trials if not each.leaves_open]
    covered = [inside for each in others for inside in each.intervals]
    of_intervals = f"{np.mean(covered):.1%}" if covered else "-"
    forecasts = np.mean([each.forecast for each in trials])
    named, named_of_others = (sum(each.named for each in some) for some in (leave_open, others))
    longest = max(each.seconds for each in trials)
    return (
        f"| {kind} | {len(trials)} | {of_intervals} | {forecasts:.1%} | {len(leave_open)} | "
        f"{named} | {named_of_others} | {longest:.2f} |"
    )


if __name__ == "__main__":
    main()
