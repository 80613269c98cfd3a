"""The paper's section on speed against error."""

from __future__ import annotations

from collections.abc import Sequence

from wear.benchmark import QUICK, Measurement, benchmark
from wear.benchmark.cases import CYCLES, ONE, cases
from wear.benchmark.curves import curves
from wear.benchmark.machine import footer, machine
from wear.benchmark.output import DIGITS, speed_table
from wear.benchmark.own import OWN
from wear.benchmark.summary import at, figure_cycles, sentences
from wear.report.document import Block, Column, Given, Items, Section, Table
from wear.report.material import count, drawn
from wear.report.plain import plain
from wear.report.words import paragraph, words

_SCENE = ONE[0]
_MEASURED = "measured in this run"


def measured() -> tuple[Measurement, ...]:
    """The methods of the software and of SciPy on the note's application, in a few seconds."""
    runs, _ = benchmark(OWN, cases("speed", ONE, CYCLES), QUICK)
    return runs


def section(runs: Sequence[Measurement]) -> Section:
    """Time against true error."""
    return Section(
        "sec:speed",
        "Speed against error",
        (
            paragraph(
                "The wear of a cycle depends on the wear at its start alone. The number of cycles "
                "as a function of the wear therefore solves Abel's functional equation, which a "
                "few dozen cycles determine; the cost of the method called cycle-count does not "
                "grow with the number of cycles. The other methods integrate every cycle: those of "
                "the software with steps that cannot jump over a contact pulse, those called "
                "defaults as SciPy comes. The true error is known from references of far higher "
                "precision. A quick measurement of this run, in which other programs may have "
                "taken part of the machine:"
            ),
            *(_table(runs, digits) for digits in DIGITS),
            *_figures(runs),
            Items(tuple(plain(text, _MEASURED) for text in sentences(runs, _SCENE))),
            paragraph("{machine}.", machine=Given(footer(machine()), _MEASURED)),
        ),
    )


def _table(runs: Sequence[Measurement], digits: int) -> Table:
    found = speed_table(runs, _SCENE, digits)
    first, *others = (plain(heading, "number of cycles") for heading in found.header)
    columns = (Column(first), *(Column(heading, numeric=True) for heading in others))
    rows = tuple(
        tuple((Given(cell, _MEASURED),) for cell in (_short(name), *rest))
        for name, *rest in found.rows
    )
    caption = words(
        "Time to {digits} correct digits of the wear after $N$ cycles, and its ratio to the "
        "fastest; a time behind a tilde was not tried but expected, and where a method does not "
        "reach the accuracy its best true error is given.",
        digits=count(digits, "request"),
    )
    return Table(f"tab:speed-{digits}", caption, columns, rows)


def _short(method: str) -> str:
    return method.removeprefix("wear ").removeprefix("solve_ivp ")


def _figures(runs: Sequence[Measurement]) -> tuple[Block, ...]:
    """Time against error for the numbers of cycles that enough methods have solved."""
    from wear.figures import speed_against_error

    return tuple(
        drawn(
            f"fig:speed-{cycles}",
            speed_against_error(curves(at(runs, _SCENE, cycles))),
            paragraph(
                "Time against true error of the wear after {cycles} cycles of the note's "
                "application; accuracy grows to the right. Hollow marks missed the requested "
                "tolerance.",
                cycles=count(cycles, "benchmark"),
            ),
            "Times of several methods against their errors on logarithmic axes.",
            f"speed-{cycles}",
        )
        for cycles in figure_cycles(runs, _SCENE)
    )
