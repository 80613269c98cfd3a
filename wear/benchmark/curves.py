"""What a figure draws of a benchmark: time against true error, a curve a method."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from wear.benchmark import Measurement, Status
from wear.benchmark.summary import unique
from wear.figure_data import Method


def curves(runs: Sequence[Measurement]) -> list[Method]:
    """The runs of one case that took place, by method and rising tolerance."""
    shown = [run for run in runs if run.repeats and math.isfinite(run.error)]
    shown.sort(key=lambda run: run.tolerance)
    return [
        Method(
            name,
            np.array([abs(run.error) for run in shown if run.method == name]),
            np.array([run.seconds for run in shown if run.method == name]),
            np.array([run.status is not Status.MET for run in shown if run.method == name]),
        )
        for name in unique([run.method for run in runs if run in shown])
    ]
