"""The system of the model: pin, rough surfaces, bearing on springs, and its unknowns.

The four displacements are drawn pointing down, the sense in which Eq. (1) counts them: those of the
pin close the gap, those of the bearing open it.
"""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc, FancyArrowPatch
from numpy.typing import NDArray

from wear.binding import bind
from wear.figure_data import WEAR
from wear.figure_style import COLUMN, GREY, INK, canvas, panels, stroke, styled
from wear.load import HistoryLoad
from wear.scene import Scene

_LEFT, _RIGHT = 2.2, 8.2
_PIN, _BEARING, _SPRINGS, _GROUND = 4.9, 3.75, 2.2, 0.8  # heights of surfaces and supports
_TOP = 6.6


def system() -> Figure:
    """Draw the system, as wide as a column."""
    middle, side = (_LEFT + _RIGHT) / 2.0, _RIGHT + 0.5
    between, under = (_PIN + _BEARING) / 2.0, (_SPRINGS + _GROUND) / 2.0
    bearing, pin = stroke(0)["color"], stroke(1)["color"]
    moves = (
        (6.5, r"$U_a$ pin moves", pin), (5.6, r"$u_a$ pin wears", pin),
        (3.6, r"$u_c$ bearing wears", bearing), (2.7, r"$U_c$ bearing moves", bearing),
    )  # fmt: skip
    with styled():
        figure, axes = canvas(COLUMN, 62.0)
        axes.set(xlim=(1.2, 11.6), ylim=(0.3, 7.85), aspect="equal")
        axes.axis("off")
        _solids(axes)
        _springs(axes)
        _arrow(axes, (side, _BEARING), (side, _PIN), style="<|-|>")
        for x in (middle - 1.2, middle, middle + 1.2):
            _arrow(axes, (x, _BEARING + 0.22), (x, _PIN - 0.2), size=6.0, linewidth=0.6)
        for top, words, colour in moves:
            _arrow(axes, (side, top), (side, top - 0.6), colour=colour)
            axes.text(side + 0.15, top - 0.3, words, va="center")
        _arrow(axes, (middle, 7.6), (middle, _TOP))
        turn = Arc((middle, 5.85), 1.1, 1.0, theta1=20.0, theta2=300.0, color=INK, linewidth=0.8)
        axes.add_patch(turn)
        _arrow(axes, (middle + 0.27, 5.42), (middle + 0.4, 5.52))
        for x, y, words, where in (
            (2.5, 6.15, "pin", "left"), (2.5, 2.6, "bearing", "left"),
            (_LEFT - 0.5, _PIN, r"$\sigma_a$", "right"),
            (_LEFT - 0.5, _BEARING, r"$\sigma_c$", "right"),
            (_LEFT - 0.05, under, "$k$", "right"), (side + 0.15, between, "$h$", "left"),
            (middle + 0.12, between, "$p$", "left"), (middle + 0.15, 7.25, "$R_a$", "left"),
            (middle, 5.85, r"$\omega$", "center"),
        ):  # fmt: skip
            axes.text(x, y, words, ha=where, va="center")
    return figure


def of_scene(scene: Scene) -> Figure:
    """Draw the rough surfaces before any wear, heights to scale, and the path of the pin."""
    sigma_c = scene.bearing.roughness_mm * WEAR.scale
    sigma_a = scene.pin.roughness_mm * WEAR.scale if scene.pin is not None else 0.0
    x, waves = _profile(1.1, 0.0)
    _, others = _profile(0.3, 0.0)
    paths, label = _paths(scene)
    with styled():
        figure, [left, right] = panels(1, 2, COLUMN, 0.72 * COLUMN)
        bearing, pin = stroke(0)["color"], stroke(1)["color"]
        surface = sigma_c * waves / np.std(waves)
        above = paths[0][1][0]
        lower = above + sigma_a * others / np.std(others)
        span = np.concatenate([surface, lower, *(y for _, y in paths)])
        low, high = span.min() - 0.35 * np.ptp(span), span.max() + 0.35 * np.ptp(span)
        left.fill_between(x, low, surface, color=bearing, alpha=0.18, linewidth=0.0)
        left.plot(x, surface, color=bearing)
        left.fill_between(x, lower, high, color=pin, alpha=0.18, linewidth=0.0)
        left.plot(x, lower, color=pin)
        left.text(x[6], high, " pin", va="top")
        left.text(x[6], low, " bearing", va="bottom")
        left.annotate("", (x[120], 0.0), (x[120], above), arrowprops={"arrowstyle": "<|-|>"})
        left.text(x[126], 0.5 * above, "$h$", va="center")
        left.set(ylabel=r"Height  ($\mathrm{\mu m}$)", ylim=(low, high), xticks=[])
        left.spines["bottom"].set_visible(False)
        right.axhline(0.0, color=bearing, linewidth=0.8)
        right.axhspan(-sigma_c, sigma_c, color=bearing, alpha=0.18, linewidth=0.0)
        for time, height in paths:
            right.plot(time, height, color=pin)
        right.set(xlabel=label, xlim=(paths[0][0][0], paths[0][0][-1]))
    return figure


def _paths(scene: Scene) -> tuple[list[tuple[NDArray[np.float64], NDArray[np.float64]]], str]:
    """Return the heights (um) of the pin under each load over the phase of its period, or over time
    (s)."""
    load = scene.load
    if isinstance(load, HistoryLoad):
        times = np.asarray(load.times_s)
        return [(times, (scene.closure - load(times)) * WEAR.scale)], "Time  (s)"
    phase = np.linspace(0.0, 1.0, 801)
    heights = (
        bind(scene).fields(0.0 * phase, each(phase)).h
        if scene.given_load
        else scene.closure - each(phase)
        for each in scene.loads.values()
    )
    return [(phase, height * WEAR.scale) for height in heights], "Phase in the cycle"


def _profile(seed: float, height: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return a rough profile: a few incommensurable waves, the same in every run."""
    x = np.linspace(_LEFT, _RIGHT, 241)
    waves = ((0.055, 7.3), (0.045, 13.1), (0.035, 23.7), (0.02, 41.0))
    rough = np.sum([a * np.sin(w * x + seed * w) for a, w in waves], axis=0)
    return x, height + rough


def _solids(axes: Axes) -> None:
    x, lower = _profile(0.3, _PIN)
    _, upper = _profile(1.1, _BEARING)
    for low, high, surface, end, family in (
        (lower, _TOP, lower, _TOP, 1), (_SPRINGS, upper, upper, _SPRINGS, 0),
    ):  # fmt: skip
        colour, sides = stroke(family)["color"], [_LEFT, _LEFT, _RIGHT, _RIGHT]
        axes.fill_between(x, low, high, color=colour, alpha=0.18, linewidth=0.0)
        axes.plot(x, surface, color=colour)
        axes.plot(sides, [surface[0], end, end, surface[-1]], color=colour)
    for height in (_PIN, _BEARING):
        axes.plot(
            [_LEFT - 0.4, _RIGHT + 0.75], [height, height], color=GREY, lw=0.6, ls=(0, (6, 2, 1, 2))
        )


def _springs(axes: Axes) -> None:
    zigzag = np.array([0.0, 0.0, 1.0, -1.0, 1.0, -1.0, 1.0, 0.0, 0.0])
    heights = _SPRINGS - (_SPRINGS - _GROUND) * np.array(
        [0.0, 0.15, 0.22, 0.36, 0.5, 0.64, 0.78, 0.85, 1.0]
    )
    for x in np.linspace(_LEFT + 0.5, _RIGHT - 0.5, 6):
        axes.plot(x + 0.16 * zigzag, heights, color=INK, linewidth=0.8)
    axes.plot([_LEFT, _RIGHT], [_GROUND, _GROUND], color=INK)
    for x in np.linspace(_LEFT + 0.15, _RIGHT, 22):
        axes.plot([x, x - 0.2], [_GROUND, _GROUND - 0.22], color=INK, linewidth=0.5)


def _arrow(
    axes: Axes, start: tuple[float, float], end: tuple[float, float], *, style: str = "-|>",
    size: float = 8.0, linewidth: float = 0.9, colour: str = INK,
) -> None:  # fmt: skip
    drawn = FancyArrowPatch(
        start, end, arrowstyle=style, mutation_scale=size, linewidth=linewidth, color=colour,
        shrinkA=0.0, shrinkB=0.0,
    )  # fmt: skip
    axes.add_patch(drawn)
