"""What a reader takes away from a benchmark: times at equal true error, ratios, sentences."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from wear.benchmark import Measurement, Status

FEWEST_DRAWN = 4  # methods in a figure
YEAR = 3.15576e7  # s
UNITS = (
    (1e-3, 1e-6, "µs"),
    (1.0, 1e-3, "ms"),
    (120.0, 1.0, "s"),
    (7200.0, 60.0, "min"),
    (172800.0, 3600.0, "h"),
    (YEAR, 86400.0, "days"),
)


class Best(NamedTuple):
    """The fastest run of a method at a case that has so many correct digits."""

    method: str
    seconds: float
    evaluations: int | None


def best(runs: Sequence[Measurement], digits: int) -> tuple[Best, ...]:
    """Each method's fastest run with a true relative error of at most 10^-digits, fastest first.

    `runs` are those of one scene and number of cycles.
    """
    found: dict[str, Best] = {}
    for run in runs:
        good = abs(run.error) <= 10.0**-digits and run.repeats > 0
        if good and (run.method not in found or run.seconds < found[run.method].seconds):
            found[run.method] = Best(run.method, run.seconds, run.evaluations)
    return tuple(sorted(found.values(), key=lambda entry: entry.seconds))


def at(runs: Sequence[Measurement], scene: str, cycles: int) -> tuple[Measurement, ...]:
    """The runs of one case."""
    return tuple(run for run in runs if (run.scene, run.cycles) == (scene, cycles))


def unique(names: Sequence[str]) -> tuple[str, ...]:
    """Without repetition, in order of appearance."""
    return tuple(dict.fromkeys(names))


def cycles_of(runs: Sequence[Measurement]) -> tuple[int, ...]:
    """The numbers of cycles that were asked for."""
    return tuple(sorted({run.cycles for run in runs}))


def cell(runs: Sequence[Measurement], method: str, digits: int) -> str:
    """A method's time to so many digits with its ratio to the fastest, or what became of it."""
    ranking = best(runs, digits)
    for entry in ranking:
        if entry.method == method:
            ratio = entry.seconds / ranking[0].seconds
            return duration(entry.seconds) + ("" if ratio == 1.0 else f" ({_rounded(ratio)}x)")
    own = [run for run in runs if run.method == method]
    errors = [abs(run.error) for run in own if math.isfinite(run.error)]
    waits = [run.seconds for run in own if run.status is Status.SKIPPED]
    if waits:
        return f"~ {duration(min(waits))}"
    if errors:
        return f"off by {magnitude(min(errors))}"
    return "-"


def duration(seconds: float) -> str:
    """A time in the unit that suits.

    >>> duration(0.00213), duration(47.0), duration(9e4), duration(3e5), duration(4e9)
    ('2.1 ms', '47 s', '25 h', '3.5 days', '127 years')
    """
    for limit, unit, name in UNITS:
        if seconds < limit:
            return f"{_rounded(seconds / unit)} {name}"
    return f"{_rounded(seconds / YEAR)} years"


def magnitude(error: float) -> str:
    """The size of a relative error.

    >>> magnitude(0.41), magnitude(-2.3e-7), magnitude(17.0)
    ('41 %', '2e-7', '17-fold')
    """
    if abs(error) >= 10.0:
        return f"{_rounded(abs(error))}-fold"
    if abs(error) >= 0.01:
        return f"{_rounded(100.0 * abs(error))} %"
    return f"{abs(error):.0e}".replace("e-0", "e-")


def cycle_count(cycles: int) -> str:
    """A number of cycles, short.

    >>> cycle_count(9000), cycle_count(10**8)
    ('9000', '1e8')
    """
    return str(cycles) if cycles < 10**5 else f"{cycles:.3g}".replace("e+0", "e")


def _rounded(number: float) -> str:
    return f"{number:.2g}" if number < 99.5 else f"{number:.0f}"


def sentences(runs: Sequence[Measurement], scene: str, digits: int = 6) -> tuple[str, ...]:
    """For so many digits use X, it takes Y: a sentence a number of cycles."""
    told = []
    for cycles in cycles_of(runs):
        ranking = best(at(runs, scene, cycles), digits)
        if not ranking:
            told.append(
                f"{cycle_count(cycles)} cycles, {digits} digits: nothing that was tried gets there."
            )
            continue
        first, *others = ranking
        text = (
            f"For {digits} digits of the wear after {cycle_count(cycles)} "
            f"{'cycle' if cycles == 1 else 'cycles'} use {first.method}: "
            f"it takes {duration(first.seconds)}"
        )
        if others:
            ratio = others[0].seconds / first.seconds
            text += f"; {others[0].method} takes {_rounded(ratio)} times as long."
        else:
            text += "; nothing else got there in the time given to it."
        told.append(text)
    return tuple(told)


def silent_failures(runs: Sequence[Measurement]) -> tuple[Measurement, ...]:
    """Runs that were off by more than a percent and did not say so, the worst of each method and
    scene."""
    worst: dict[tuple[str, str], Measurement] = {}
    for run in runs:
        key = (run.method, run.scene)
        if run.status is Status.WRONG and (
            key not in worst or abs(run.error) > abs(worst[key].error)
        ):
            worst[key] = run
    return tuple(worst.values())


def figure_cycles(runs: Sequence[Measurement], scene: str) -> tuple[int, ...]:
    """The numbers of cycles, beyond one, at which enough methods have run to compare them."""
    ran = {
        cycles: {run.method for run in at(runs, scene, cycles) if run.repeats}
        for cycles in cycles_of(runs)
    }
    return tuple(cycles for cycles in ran if cycles > 1 and len(ran[cycles]) >= FEWEST_DRAWN)
