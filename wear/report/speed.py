"""Speed against error, measured in a few seconds by the run that writes the report."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from wear.benchmark import QUICK, Measurement, benchmark
from wear.benchmark.machine import footer, machine
from wear.benchmark.methods import CYCLES, ONE, OWN, cases
from wear.benchmark.results import DIGITS, at, best, curves, cycles_of, duration, speed_table
from wear.report.number import Number
from wear.report.text import escaped

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_SCENE = ONE[0]
_METHOD = OWN[0].name
_MEASURED = "measured in this run"
#: So few cycles that every method can be tried at every tolerance.
_FEW = 10


def measured() -> tuple[Measurement, ...]:
    """Return the methods of the software and of SciPy on the note's application."""
    runs, _ = benchmark(OWN, cases("speed", ONE, (_FEW, *CYCLES[1:])), QUICK)
    return runs


def values(runs: Sequence[Measurement]) -> dict[str, Any]:
    """Return the table of the paper, the sentence on it, and the machine."""
    digits = DIGITS[0]
    found = speed_table(runs, _SCENE, digits)
    return {
        "speed_header": [escaped(heading.capitalize()) for heading in found.header],
        "speed_rows": [[escaped(_short(row[0])), *map(_cell, row[1:])] for row in found.rows],
        "speed_digits": Number(digits, "request"),
        "speed_cycles": Number(figure_cycles(runs), "benchmark"),
        "machine": escaped(footer(machine())),
        **_sentence(runs, digits),
    }


def _sentence(runs: Sequence[Measurement], digits: int) -> dict[str, Any]:
    """Return the time of the exact cycle jump, and how the best other method compares."""
    ranking = {n: best(at(runs, _SCENE, n), digits) for n in cycles_of(runs)}
    own = [
        entry.seconds for found in ranking.values() for entry in found if entry.method == _METHOD
    ]
    others = {
        cycles: min(entry.seconds for entry in found if entry.method != _METHOD)
        for cycles, found in ranking.items()
        if any(entry.method != _METHOD for entry in found)
    }
    if not (own and others):
        return {"compared": False}
    most = max(others)
    mine = min(entry.seconds for entry in ranking[most] if entry.method == _METHOD)
    return {
        "compared": True,
        "least_time": escaped(duration(min(own))),
        "longest_time": escaped(duration(max(own))),
        "last_count": Number(float(max(ranking)), "benchmark", 1),
        "times_as_long": Number(others[most] / mine, _MEASURED, 2),
        "most_count": Number(most, "benchmark"),
    }


def _cell(text: str) -> str:
    """A time with its ratio, or an error, in Markdown."""
    return escaped(text.replace("x)", "\u00d7)").replace("~ ", "≈\u2009"))


def _short(method: str) -> str:
    return (
        method.removeprefix("wear ").removeprefix("solve_ivp ").replace(_METHOD, "exact cycle jump")
    )


def figure_cycles(runs: Sequence[Measurement]) -> int:
    """Return the number of cycles at which most runs took place, the largest of several."""
    tried = {n: sum(run.repeats > 0 for run in at(runs, _SCENE, n)) for n in cycles_of(runs)}
    return max(tried, key=lambda cycles: (tried[cycles], cycles))


def figure(runs: Sequence[Measurement]) -> Figure:
    """Draw time against error for one number of cycles."""
    from wear.figures import speed_against_error

    found = curves(at(runs, _SCENE, figure_cycles(runs)))
    return speed_against_error([replace(curve, name=_short(curve.name)) for curve in found])
