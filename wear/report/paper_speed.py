"""The paper's section on speed against error."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from wear.benchmark import QUICK, Measurement, benchmark
from wear.benchmark.machine import footer, machine
from wear.benchmark.methods import CYCLES, ONE, OWN, cases
from wear.benchmark.results import DIGITS, at, best, curves, cycles_of, duration, speed_table
from wear.report.document import Block, Column, Given, Number, Paragraph, Prose, Section, Table
from wear.report.material import count, drawn
from wear.report.plain import plain
from wear.report.words import paragraph, words

_SCENE = ONE[0]
_COUNT = OWN[0].name
_MEASURED = "measured in this run"
#: So few cycles that every method can be tried at every tolerance.
_FEW = 10


def measured() -> tuple[Measurement, ...]:
    """The methods of the software and of SciPy on the note's application, in a few seconds."""
    runs, _ = benchmark(OWN, cases("speed", ONE, (_FEW, *CYCLES[1:])), QUICK)
    return runs


def section(runs: Sequence[Measurement]) -> Section:
    """Time against true error."""
    drawn_at = _figure_cycles(runs)
    return Section(
        "sec:speed",
        "Speed against error",
        (
            paragraph(
                "The wear of a cycle depends on the wear at its start alone. The number of cycles "
                "$n(u)$ as a function of the wear therefore solves Abel's functional equation "
                "[ref:kuczma1990], $n(u+D(u))=n(u)+1$ with the wear $D(u)$ of a cycle, which few "
                "cycles determine; the cost of this method, the cycle count, does not grow with "
                "the number of cycles. The other methods integrate every cycle by the solvers of "
                "SciPy [ref:virtanen2020], `DOP853` [ref:hairer1993], `Radau` [ref:hairer1996], "
                "`BDF` [ref:shampine1997], `LSODA` [ref:petzold1983] and `RK45` "
                "[ref:dormand1980]: those of the software with steps that cannot jump over a "
                "contact pulse, those called defaults as SciPy comes. The true error is known "
                "from references of far higher precision."
            ),
            paragraph(
                "This is a quick measurement of the run that wrote the report, in which other "
                "programs may have taken part of the machine; the documentation of the software "
                "has a longer one, with other programs for the same task. "
                + ", ".join(f"[tab:speed-{digits}]" for digits in DIGITS)
                + f" and [fig:speed-{drawn_at}] show the time that so many correct digits take."
            ),
            _sentence(runs),
            *(_table(runs, digits) for digits in DIGITS),
            _figure(runs, drawn_at),
            paragraph("{machine}.", machine=Given(footer(machine()), _MEASURED)),
        ),
    )


def _sentence(runs: Sequence[Measurement]) -> Paragraph:
    """What a reader takes away: the time of the cycle count, and how the best other compares."""
    digits = DIGITS[0]
    ranking = {n: best(at(runs, _SCENE, n), digits) for n in cycles_of(runs)}
    own = [entry.seconds for found in ranking.values() for entry in found if entry.method == _COUNT]
    others = {
        cycles: min(entry.seconds for entry in found if entry.method != _COUNT)
        for cycles, found in ranking.items()
        if any(entry.method != _COUNT for entry in found)
    }
    if not (own and others):
        return paragraph("Too little could be measured on this machine for a comparison.")
    most = max(others)
    mine = min(entry.seconds for entry in ranking[most] if entry.method == _COUNT)
    return paragraph(
        "In short: for {digits} correct digits of the wear use the cycle count. It takes {least} "
        "to {longest}, whatever the number of cycles up to {last}; the fastest of the others "
        "takes {ratio} times as long for {most} cycles, the most at which one got there in the "
        "time given to it.",
        digits=count(digits, "request"),
        least=Given(duration(min(own)), _MEASURED),
        longest=Given(duration(max(own)), _MEASURED),
        last=Number(max(ranking), 1, source="benchmark"),
        ratio=Number(others[most] / mine, 2, source=_MEASURED),
        most=count(most, "benchmark"),
    )


def _table(runs: Sequence[Measurement], digits: int) -> Table:
    found = speed_table(runs, _SCENE, digits)
    first, *others = (plain(heading.capitalize(), "number of cycles") for heading in found.header)
    columns = (Column(first), *(Column(heading, numeric=True) for heading in others))
    rows = tuple(
        (words("{name}", name=Given(_short(name), _MEASURED)), *(_cell(cell) for cell in rest))
        for name, *rest in found.rows
    )
    caption = words(
        "Time to {digits} correct digits of the wear after $N$ cycles, with its ratio to the "
        "fastest. A tilde marks an estimate for the loosest tolerance, at which the run was not "
        "made for want of time, whatever its accuracy would have been; *off by* is the best true "
        "error of runs that missed the accuracy.",
        digits=count(digits, "request"),
    )
    return Table(f"tab:speed-{digits}", caption, columns, rows)


def _cell(text: str) -> Prose:
    """A time with its ratio, or an error."""
    if text.startswith("off by"):
        return plain(text, _MEASURED)
    return (Given(text.replace("x)", "\u00d7)").replace("~ ", "~\u2009"), _MEASURED),)


def _short(method: str) -> str:
    return method.removeprefix("wear ").removeprefix("solve_ivp ").replace(_COUNT, "cycle count")


def _figure_cycles(runs: Sequence[Measurement]) -> int:
    """The number of cycles at which most runs took place, the largest of several."""
    tried = {n: sum(run.repeats > 0 for run in at(runs, _SCENE, n)) for n in cycles_of(runs)}
    return max(tried, key=lambda cycles: (tried[cycles], cycles))


def _figure(runs: Sequence[Measurement], cycles: int) -> Block:
    """Time against error for one number of cycles."""
    from wear.figures import speed_against_error

    return drawn(
        f"fig:speed-{cycles}",
        speed_against_error(
            [replace(curve, name=_short(curve.name)) for curve in curves(at(runs, _SCENE, cycles))]
        ),
        paragraph(
            "Time against true error of the wear after {cycles} cycles of the note's application; "
            "accuracy grows to the right. Hollow marks missed the requested tolerance.",
            cycles=count(cycles, "benchmark"),
        ),
        "Times of several methods against their errors on logarithmic axes: the cycle count is at "
        "the lower right, fast and accurate; the others need more time for fewer digits.",
        f"speed-{cycles}",
    )
