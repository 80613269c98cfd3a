"""The figures, drawn from plain arrays.

Overview
    history                 wear, roughness, pressure, contact against cycles or time
    pressure_in_cycles      contact pressure over the phase of chosen cycles
    speed_against_error     time against true error, one line a method
    speed_against_cycles    time against the number of cycles, one line a method
    tornado                 elasticities as bars, the largest on top
    plot, plot_pressure     a user's runs, and the pressure inside their cycles
    Each returns a matplotlib `Figure`; `wear.figure_style` makes files of it.
Units
    Lengths come in mm and are shown in micrometres, pressures in MPa, times in s.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from wear.faults import UsageError
from wear.figure_data import (
    PRESSURE,
    Abscissa,
    Line,
    Panel,
    TimingCurve,
    name_of,
    panels_of,
    pressure_inside,
    spans_decades,
)
from wear.figure_style import (
    COLUMN,
    COLUMN_AND_HALF,
    GREY,
    INK,
    PAGE,
    PAPER,
    Stroke,
    canvas,
    label_ends,
    panels,
    stroke,
    styled,
)
from wear.history import History
from wear.numerics.gauss import FloatArray
from wear.quantities import words_of
from wear.scene import Scene, as_scene

#: Distance of a line's markers, in diagonals of the axes.
_MARK_EVERY = 0.14


def plot(histories: Mapping[str, History], *, logarithmic: bool = True) -> Figure:
    """Return a Matplotlib figure of named runs over the cycles.

    Wear, roughness, pressure and, where contact is lost, the fraction of the period in contact
    stand one above the other; each run has its colour.

    Raises
    ------
    UsageError
        if `histories` is empty, or holds anything but runs.
    """
    runs = [*histories.values()] if hasattr(histories, "values") else []
    if not runs or not all(isinstance(run, History) for run in runs):
        raise UsageError("histories: give runs by their names, as in {'mine': wear.solve(...)}")
    return history(panels_of(runs, tuple(histories)), logarithmic=logarithmic)


def plot_pressure(scene: Scene | str | os.PathLike[str], cycles: Sequence[int]) -> Figure:
    """Return a Matplotlib figure of the contact pressure (MPa) over the phase of some cycles.

    `cycles` are the numbers of cycles after which those shown begin: 0 for the first.

    Raises
    ------
    UsageError
        if the load does not repeat, or the scene's cycles cannot be counted.
    """
    return pressure_in_cycles(pressure_inside(as_scene(scene), cycles))


def history(
    shown: Sequence[Panel],
    *,
    abscissa: Abscissa = Abscissa.CYCLES,
    logarithmic: bool = False,
) -> Figure:
    """Draw panels one above the other, lengths in mm and pressures in MPa, along one abscissa.

    If that is logarithmic, quantities that grow by decades have a logarithmic axis too: powers of
    the cycles are then straight lines. Pressures that fall by decades always have one, without the
    zero pressures.
    """
    x = np.concatenate([line.x for each in shown for line in (*each.lines, *each.points)])
    logarithmic = logarithmic and bool(np.any(x > 0.0))
    height = 0.66 if len(shown) == 1 else 0.44 * len(shown)
    with styled():
        figure, rows = panels(len(shown), 1, COLUMN, height * COLUMN)
        for axes, panel in zip(rows, shown, strict=True):
            if panel.quantity is PRESSURE:
                pressed = tuple(
                    line.where(line.y > 0.0) for line in panel.lines if line.y[line.x > 0.0].any()
                )
                if pressed and spans_decades(pressed):
                    panel = replace(panel, lines=pressed)
                    axes.set_yscale("log")
            elif logarithmic and len(shown) > 1 and spans_decades(panel.lines):
                axes.set_yscale("log")
            _panel(axes, panel, logarithmic)
        first, last = x[x > 0.0].min() if logarithmic else x.min(), x.max()
        if first < last:
            rows[-1].set_xlim(first, last)
        rows[-1].set_xlabel(abscissa.value)
        figure.align_ylabels()
    return figure


def pressure_in_cycles(lines: Sequence[Line]) -> Figure:
    """Draw the contact pressure in MPa over the phase in [0, 1] of cycles, a line for each, named
    beside the axes at the height of its peak as far as there is room."""
    with styled():
        figure, axes = canvas(COLUMN, 0.6 * COLUMN)
        _draw(axes, lines, 1.0)
        axes.set(xlabel=r"Phase in the cycle", ylabel=PRESSURE.label)
        highest = max(float(line.y.max()) for line in lines) or 1.0  # out of contact: no pressure
        axes.set(xlim=(0.0, 1.0), ylim=(0.0, 1.1 * highest))
        label_ends(axes, [(float(line.y.max()), line.name, _look(line)) for line in lines])
    return figure


def speed_against_error(methods: Sequence[TimingCurve]) -> Figure:
    """Draw seconds against true relative error, both logarithmic; accuracy grows to the right."""
    figure = _speed(methods, "True relative error of the wear", "missed its tolerance")
    figure.axes[0].invert_xaxis()
    return figure


def speed_against_cycles(methods: Sequence[TimingCurve]) -> Figure:
    """Draw seconds to equal true error against the number of cycles, both logarithmic."""
    return _speed(methods, "Cycles  $N$", "expected, not run")


def _speed(methods: Sequence[TimingCurve], quantity: str, failed: str) -> Figure:
    with styled():
        figure, axes = canvas(PAGE, 0.5 * PAGE)
        for family, method in enumerate(methods):
            again = family // 7  # colours repeat, with another marker
            dash, mark = stroke(0, again)["linestyle"], stroke(family + 2 * again)["marker"]
            look = stroke(family) | {"linestyle": dash, "marker": mark}
            axes.loglog(method.x, method.seconds, linewidth=0.9, label=method.name, **look)
            x, seconds = method.x[method.failed], method.seconds[method.failed]
            hollow = {"linestyle": "", "markersize": 5.5, "markerfacecolor": PAPER}
            axes.loglog(x, seconds, **look | hollow)
        if any(method.failed.any() for method in methods):
            axes.plot([], [], "o", color=INK, markerfacecolor=PAPER, label=failed)
        axes.set(xlabel=quantity, ylabel="Processor time (s)")
        axes.grid(which="major", color=GREY, alpha=0.35, linewidth=0.4)
        axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), handlelength=3.0)
    return figure


def tornado(keys: Sequence[str], elasticity: FloatArray, cycles: Sequence[int]) -> Figure:
    """Draw the elasticities (k, n) of the numbers with these keys as bars, the largest on top, a
    set of bars for each of the n numbers of cycles. NaN has no bar."""
    values = np.nan_to_num(elasticity)
    largest = np.max(np.abs(values), axis=1)
    order = np.argsort(np.round(largest, 6), kind="stable")  # not by rounding errors
    thick = 0.8 / len(cycles)
    with styled():
        figure, axes = canvas(COLUMN_AND_HALF, 12.0 + (2.5 + 1.8 * len(cycles)) * len(keys))
        for place, count in enumerate(cycles):
            at = np.arange(len(keys)) + thick * ((len(cycles) - 1) / 2 - place)
            look = {"color": stroke(place)["color"], "label": name_of(count)}
            axes.barh(at, values[order, place], thick, **look)
        axes.axvline(0.0, color=INK, linewidth=0.6)
        axes.set_yticks(np.arange(len(keys)), [words_of(keys[i]) for i in order])
        axes.set_ylim(-0.6, len(keys) - 0.4)
        axes.set_xlabel("Change of the wear in % for 1 % more")
        axes.legend()
    return figure


def _panel(axes: Axes, panel: Panel, logarithmic: bool) -> None:
    lines, scale = panel.lines, panel.quantity.scale
    if logarithmic:
        axes.set_xscale("log")
        lines = tuple(line.where(line.x > 0.0) for line in lines)
    for line in panel.behind:
        _plot(axes, line, scale, linewidth=0.9, zorder=1, marker="")
    _draw(axes, lines, scale)
    axes.set_ylabel(panel.quantity.label)
    limits = [panel.limit] if panel.limit is not None else []
    if axes.get_yscale() == "log":
        axes.autoscale(axis="y")
    else:  # zero is in sight
        extremes = [*limits, 0.0]
        extremes += [y for line in (*lines, *panel.points) for y in (line.y.min(), line.y.max())]
        low, high = min(extremes) * scale, max(extremes) * scale
        margin = 0.05 * (high - low) or 1.0
        axes.set_ylim(low - margin if low < 0.0 else 0.0, high + margin)
    hollow = {"linestyle": "", "markerfacecolor": PAPER}
    for points in panel.points:
        _plot(axes, points, scale, markersize=5.0, zorder=4, clip_on=False, **hollow)
    for limit in limits:
        axes.axhline(limit * scale, color=INK, linewidth=0.7, linestyle=(0, (5.0, 2.0)))
        axes.text(0.01, limit * scale, "limit", transform=axes.get_yaxis_transform(), va="bottom")
    looks = [(line, _look(line)) for line in lines]
    looks += [(line, _look(line) | {"marker": ""}) for line in panel.behind]
    looks += [(line, _look(line) | hollow) for line in panel.points]
    label_ends(axes, [(float(line.y[-1]) * scale, line.name, look) for line, look in looks])


def _look(line: Line) -> Stroke:
    return stroke(line.family, line.variant)


def _plot(axes: Axes, line: Line, scale: float, **style: Any) -> None:
    axes.plot(line.x, line.y * scale, **_look(line) | style)


def _draw(axes: Axes, lines: Sequence[Line], scale: float) -> None:
    """Draw lines with a few markers each, shifted from line to line so that none coincide."""
    for position, line in enumerate(lines):
        start = _MARK_EVERY * (position + 0.5) / len(lines)
        _plot(axes, line, scale, markevery=(start, _MARK_EVERY), clip_on=False)
