"""The figures, drawn from plain arrays.

Overview
    history                 wear, roughness and pressure against cycles, of one scene
    wear_history            wear against cycles, one line a solid or model        (Fig. 2a)
    roughness_history       roughness against cycles                              (Fig. 2b)
    wear_with_asymptote     wear with the straight lines or curves it tends to    (Fig. 3a)
    wear_by_coefficient     wear for several wear coefficients                    (Fig. 3b)
    pressure_in_cycles      contact pressure over the phase of chosen cycles
    speed_against_error     time against true error, one line a method
    speed_against_cycles    time against the number of cycles, one line a method
    wear_by_decades         wear over all decades with straight lines behind it
    regime_map              the regimes over f_c and the gap at the peak
    Each returns a matplotlib `Figure`; `wear.figure_style` makes files of it.
Units
    Lengths come in mm and are shown in micrometres, pressures in MPa, times in s.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from numpy.typing import NDArray

from wear.figure_data import Example, FloatArray, Line, Method, spans_decades
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
    side_by_side,
    stroke,
    styled,
)

_MICROMETRES_PER_MM = 1e3
_CYCLES = r"Cycles  $t/T$"
_WEAR = r"Wear  $u$  ($\mathrm{\mu m}$)"
_BEARING_WEAR = r"Bearing wear  $u_c$  ($\mathrm{\mu m}$)"
_ROUGHNESS = r"Roughness  $\sigma$  ($\mathrm{\mu m}$)"
_PRESSURE = r"Contact pressure  $p$  (MPa)"
#: Distance of a line's markers, in diagonals of the axes.
_MARK_EVERY = 0.14


def history(
    wear: Sequence[Line],
    roughness: Sequence[Line],
    pressure: Sequence[Line],
    *,
    logarithmic: bool = False,
    width: float = COLUMN,
) -> Figure:
    """Wear and roughness in mm and contact pressure in MPa against cycles, one above the other.

    On a logarithmic axis of cycles, what grows by decades has a logarithmic axis too: as a power
    of the cycles it is then a straight line, not one that is flat but for its end.
    """
    with styled():
        figure, (top, middle, bottom) = panels(3, width, 1.3 * width)
        for axes, lines, quantity, scale in (
            (top, wear, _WEAR, _MICROMETRES_PER_MM),
            (middle, roughness, _ROUGHNESS, _MICROMETRES_PER_MM),
            (bottom, pressure, _PRESSURE, 1.0),
        ):
            if logarithmic and spans_decades(lines):
                axes.set_yscale("log")
            _panel(axes, lines, quantity, scale, logarithmic)
        bottom.set_xlabel(_CYCLES)
        figure.align_ylabels()
    return figure


def wear_history(
    lines: Sequence[Line], *, logarithmic: bool = False, width: float = COLUMN
) -> Figure:
    """Wear in mm against cycles (Fig. 2a)."""
    return _history(lines, _WEAR, logarithmic, width)


def roughness_history(
    lines: Sequence[Line], *, logarithmic: bool = False, width: float = COLUMN
) -> Figure:
    """Roughness in mm against cycles (Fig. 2b)."""
    return _history(lines, _ROUGHNESS, logarithmic, width)


def wear_with_asymptote(
    wear: Sequence[Line], asymptotes: Sequence[Line], *, width: float = COLUMN
) -> Figure:
    """Bearing wear in mm against cycles with what it tends to (Fig. 3a): the asymptotes are drawn
    thin and behind."""
    with styled():
        figure, axes = canvas(width, 0.66 * width)
        for line in asymptotes:
            axes.plot(
                line.x,
                line.y * _MICROMETRES_PER_MM,
                color=_look(line).colour,
                linestyle=_look(line).dash,
                linewidth=0.9,
                zorder=1,
            )
        _draw(axes, wear, _MICROMETRES_PER_MM)
        axes.set(xlabel=_CYCLES, ylabel=_BEARING_WEAR)
        _frame(axes, wear, _MICROMETRES_PER_MM)
        _name(axes, wear, _MICROMETRES_PER_MM, bare=asymptotes)
    return figure


def wear_by_decades(
    wear: Sequence[Line],
    lines: Sequence[Line],
    mark: tuple[float, str],
    *,
    width: float = COLUMN,
) -> Figure:
    """Bearing wear in mm against cycles, both logarithmic, with straight lines behind and a number
    of cycles marked."""
    with styled():
        figure, axes = canvas(width, 0.72 * width)
        axes.set_xscale("log")
        axes.set_yscale("log")
        top = 10.0 * _MICROMETRES_PER_MM * max(float(line.y.max()) for line in wear)
        for line in (*lines, *wear):
            look = _look(line)
            axes.plot(
                line.x, line.y * _MICROMETRES_PER_MM, color=look.colour, linestyle=look.dash,
                linewidth=0.9 if line in lines else 1.4, label=line.name,
            )  # fmt: skip
        axes.axvline(mark[0], color=GREY, linewidth=0.6, linestyle=(0, (4.0, 2.0)))
        axes.text(
            mark[0], 0.98, f"{mark[1]} ", transform=axes.get_xaxis_transform(), va="top", ha="right"
        )
        low = 1e-3 * _MICROMETRES_PER_MM * float(wear[0].y[0])  # room for the legend
        axes.set(xlabel=r"Cycles  $N$", ylabel=_BEARING_WEAR, ylim=(low, top))
        axes.set_xlim(float(wear[0].x[0]), float(wear[0].x[-1]))
        axes.legend(loc="lower right", borderpad=0.0, handlelength=2.5)
    return figure


def wear_by_coefficient(
    lines: Sequence[Line], *, logarithmic: bool = False, width: float = COLUMN
) -> Figure:
    """Bearing wear in mm against cycles for several wear coefficients K (Fig. 3b)."""
    return _history(lines, _BEARING_WEAR, logarithmic, width)


def pressure_in_cycles(lines: Sequence[Line], *, width: float = COLUMN) -> Figure:
    """Contact pressure in MPa over the phase in [0, 1] of chosen cycles, one line a cycle."""
    with styled():
        figure, axes = canvas(width, 0.6 * width)
        _draw(axes, lines, 1.0)
        axes.set(xlabel=r"Phase in the cycle", ylabel=_PRESSURE)
        axes.set(xlim=(0.0, 1.0), ylim=(0.0, 1.1 * max(float(line.y.max()) for line in lines)))
        _name_peaks(axes, lines)
    return figure


def speed_against_error(methods: Sequence[Method], *, width: float = PAGE) -> Figure:
    """Draw seconds against true relative error, both logarithmic; accuracy grows to the right."""
    figure = _speed(methods, "True relative error of the wear", "missed its tolerance", width)
    figure.axes[0].invert_xaxis()
    return figure


def speed_against_cycles(methods: Sequence[Method], *, width: float = PAGE) -> Figure:
    """Draw seconds to equal true error against the number of cycles, both logarithmic."""
    return _speed(methods, "Cycles  $N$", "expected, not run", width)


def _speed(methods: Sequence[Method], quantity: str, failed: str, width: float) -> Figure:
    with styled():
        figure, axes = canvas(width, 0.5 * width)
        for family, method in enumerate(methods):
            again = family // 7  # colours come again, with another marker
            look = replace(stroke(family, again), marker=stroke(family + 2 * again).marker)
            _draw_method(axes, method, look)
        if any(method.failed.any() for method in methods):
            axes.plot([], [], "o", color=INK, markerfacecolor=PAPER, label=failed)
        axes.set(xlabel=quantity, ylabel="Processor time (s)")
        axes.grid(which="major", color=GREY, alpha=0.35, linewidth=0.4)
        axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), handlelength=3.0)
    return figure


_REGIMES = {
    "steady": "#0072B2",
    "saturating": "#009E73",
    "finite-time": "#D55E00",
    "arrest": "#CC79A7",
}


def regime_map(
    regime: Callable[[FloatArray, FloatArray, bool], NDArray[np.str_]],
    titles: tuple[str, str],
    examples: Sequence[Example],
    *,
    width: float = COLUMN_AND_HALF,
) -> Figure:
    """Regions of f_c against the gap at the peak over the roughness, without and with loss of
    contact.

    `regime` returns the names of the regimes for arrays of f_c and of the gap.
    """
    slopes, gaps = np.meshgrid(np.linspace(-0.6, 0.6, 480), np.linspace(-3.0, 4.0, 560))
    with styled():
        figure, [left, right] = side_by_side(2, width, 0.5 * width)
        for axes, title, ends in ((left, titles[0], False), (right, titles[1], True)):
            named = regime(slopes, gaps, ends)
            for name, colour in _REGIMES.items():
                _region(axes, slopes, gaps, named == name, colour, name)
            _example_points(axes, examples)
            axes.set(title=title, xlabel=r"Change of roughness with wear  $f_c$")
            axes.set(xlim=(-0.6, 0.6), ylim=(-3.0, 4.0))
        left.set_ylabel(r"Gap at the peak over roughness  $(h_0-\max U_a)/\bar\sigma(0)$")
    return figure


def _region(
    axes: Axes, x: FloatArray, y: FloatArray, inside: NDArray[np.bool_], colour: str, name: str
) -> None:
    """A region in its colour, its name in the middle of it."""
    if not inside.any():
        return
    axes.contourf(x, y, inside.astype(float), levels=[0.5, 1.5], colors=[colour], alpha=0.3)
    level = np.argmax(inside.sum(axis=1))  # the row where the region is widest
    across = x[level][inside[level]]
    if np.ptp(across) > 0.05:
        axes.text(
            float(across.mean()), float(y[inside].mean()), name, ha="center", va="center",
            path_effects=[withStroke(linewidth=2.0, foreground=PAPER)],
        )  # fmt: skip


def _example_points(axes: Axes, examples: Sequence[Example]) -> None:
    for example in examples:
        face = INK if example.one_solid else PAPER
        axes.plot(example.slope, example.gap, "o", color=INK, markerfacecolor=face)
        axes.annotate(
            example.name, (example.slope, example.gap), xytext=(0.0, 5.0),
            textcoords="offset points", ha="center", va="bottom",
            path_effects=[withStroke(linewidth=2.0, foreground=PAPER)],
        )  # fmt: skip


def _draw_method(axes: Axes, method: Method, look: Stroke) -> None:
    axes.loglog(
        method.x,
        method.seconds,
        color=look.colour,
        linestyle=look.dash,
        linewidth=0.9,
        marker=look.marker,
        label=method.name,
    )
    axes.loglog(
        method.x[method.failed],
        method.seconds[method.failed],
        color=look.colour,
        linestyle="",
        marker=look.marker,
        markersize=5.5,
        markerfacecolor=PAPER,
    )


def _history(lines: Sequence[Line], quantity: str, logarithmic: bool, width: float) -> Figure:
    with styled():
        figure, axes = canvas(width, 0.66 * width)
        _panel(axes, lines, quantity, _MICROMETRES_PER_MM, logarithmic)
        axes.set_xlabel(_CYCLES)
    return figure


def _panel(
    axes: Axes, lines: Sequence[Line], quantity: str, scale: float, logarithmic: bool
) -> None:
    if logarithmic:
        axes.set_xscale("log")
        lines = [line.positive() for line in lines]
    _draw(axes, lines, scale)
    axes.set_ylabel(quantity)
    _frame(axes, lines, scale)
    _name(axes, lines, scale)


def _look(line: Line) -> Stroke:
    return stroke(line.family, line.variant)


def _draw(axes: Axes, lines: Sequence[Line], scale: float) -> None:
    """Lines with a few markers each, shifted from line to line so that they do not coincide."""
    for position, line in enumerate(lines):
        axes.plot(
            line.x,
            line.y * scale,
            color=_look(line).colour,
            linestyle=_look(line).dash,
            marker=_look(line).marker,
            markerfacecolor=_look(line).face,
            markevery=(_MARK_EVERY * (position + 0.5) / len(lines), _MARK_EVERY),
            clip_on=False,
        )


def _frame(axes: Axes, lines: Sequence[Line], scale: float) -> None:
    """Limits that end with the data in x and, on a linear axis, contain zero in y."""
    axes.set_xlim(min(float(line.x[0]) for line in lines), max(float(line.x[-1]) for line in lines))
    if axes.get_yscale() == "log":
        axes.autoscale(axis="y")
        return
    low = min(0.0, *(float(line.y.min()) for line in lines)) * scale
    high = max(0.0, *(float(line.y.max()) for line in lines)) * scale
    margin = 0.05 * (high - low) or 1.0
    axes.set_ylim(low - margin if low < 0.0 else 0.0, high + margin)


def _name(axes: Axes, lines: Sequence[Line], scale: float, bare: Sequence[Line] = ()) -> None:
    """Names at the right ends; `bare` lines have no markers."""
    ends = [(float(line.y[-1]) * scale, line.name, _look(line)) for line in lines]
    ends += [
        (float(line.y[-1]) * scale, line.name, replace(_look(line), marker="")) for line in bare
    ]
    label_ends(axes, ends)


def _name_peaks(axes: Axes, lines: Sequence[Line]) -> None:
    """Names above the highest points, on a halo of paper."""
    for line in lines:
        peak = int(np.argmax(line.y))
        axes.annotate(
            line.name,
            (float(line.x[peak]), float(line.y[peak])),
            xytext=(0.0, 3.0),
            textcoords="offset points",
            ha="center",
            va="bottom",
            path_effects=[withStroke(linewidth=2.0, foreground=PAPER)],
        )
