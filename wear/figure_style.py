"""How every figure looks, and how it becomes a file.

Overview
    Figures are matplotlib `Figure` objects without pyplot: nothing global is opened or changed.
    The settings hold only inside `styled`, which every drawing function enters by itself.
Legibility
    Colours are those of Okabe and Ito, which the colour-blind tell apart, orange and sky blue
    darker: every line has a contrast of at least three to white and to the page in dark mode. Lines
    also differ in marker and dash, so that they survive grey print. Ink is pure black and paper
    pure white or transparent: the page replaces both in dark mode.
Files
    SVG has its text as paths, since no reader can be expected to have the fonts; PDF embeds them.
    Both are the same to the byte from run to run.
"""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.typing import ColorType, LineStyleType

from wear.figure_data import FloatArray

#: Widths of a journal's single, one and a half, and double column, in mm.
COLUMN = 90.0
COLUMN_AND_HALF = 140.0
PAGE = 190.0

INK = "#000000"
PAPER = "#ffffff"
GREY = "#6b7480"

_MILLIMETRES_PER_INCH = 25.4
_STYLE = {
    "font.family": "STIXGeneral",
    "font.size": 8.5,
    "mathtext.fontset": "stix",
    "axes.labelsize": 8.5,
    "axes.titlesize": 8.5,
    "xtick.labelsize": 8.0,
    "ytick.labelsize": 8.0,
    "legend.fontsize": 8.0,
    "legend.frameon": False,
    "text.color": INK,
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "xtick.color": INK,
    "ytick.color": INK,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.minor.width": 0.4,
    "ytick.minor.width": 0.4,
    "lines.linewidth": 1.2,
    "lines.markersize": 4.0,
    "axes.formatter.use_mathtext": True,
    "axes.unicode_minus": True,
    "figure.facecolor": "none",
    "axes.facecolor": "none",
    "savefig.facecolor": "none",
    "hatch.linewidth": 0.4,
    "svg.fonttype": "path",
    "svg.hashsalt": "derive-wear",
    "pdf.fonttype": 42,
}


@dataclass(frozen=True)
class Stroke:
    """How a line is drawn."""

    colour: ColorType
    marker: str
    dash: LineStyleType
    face: ColorType


_FAMILIES: tuple[tuple[str, str], ...] = (
    ("#0072B2", "o"),
    ("#D55E00", "s"),
    ("#009E73", "^"),
    ("#CC79A7", "D"),
    ("#BD8300", "v"),
    ("#3A95CB", "P"),
    (INK, "X"),
)
_DASHES: tuple[LineStyleType, ...] = ("-", (0, (5.0, 2.0)), (0, (1.0, 1.5)))


def stroke(family: int, variant: int = 0) -> Stroke:
    """Colour and marker by family (seven, then again), dash by variant (solid, dashed, dotted);
    the markers of variants are hollow."""
    colour, marker = _FAMILIES[family % len(_FAMILIES)]
    return Stroke(colour, marker, _DASHES[variant % len(_DASHES)], PAPER if variant else colour)


@contextmanager
def styled() -> Iterator[None]:
    """The settings of this module, until the block ends."""
    with mpl.rc_context(_STYLE):  # type: ignore[arg-type]
        yield


def panels(rows: int, width: float, height: float) -> tuple[Figure, list[Axes]]:
    """A figure of that size in mm with axes one above the other. Call inside `styled`."""
    size = (width / _MILLIMETRES_PER_INCH, height / _MILLIMETRES_PER_INCH)
    figure = Figure(figsize=size, layout="constrained")
    return figure, list(figure.subplots(rows, 1, sharex=True, squeeze=False)[:, 0])


def side_by_side(columns: int, width: float, height: float) -> tuple[Figure, list[Axes]]:
    """A figure of that size in mm with axes side by side. Call inside `styled`."""
    size = (width / _MILLIMETRES_PER_INCH, height / _MILLIMETRES_PER_INCH)
    figure = Figure(figsize=size, layout="constrained")
    return figure, list(figure.subplots(1, columns, sharey=True, squeeze=False)[0])


def canvas(width: float, height: float) -> tuple[Figure, Axes]:
    """A figure of that size in mm with one pair of axes. Call inside `styled`."""
    figure, [axes] = panels(1, width, height)
    return figure, axes


def label_ends(
    axes: Axes, ends: Sequence[tuple[float, str, Stroke]], least_gap: float = 0.08
) -> None:
    """Name lines at their right ends, outside the axes, each behind a sample of its stroke.

    `ends` has the y value, the name and the stroke of each line. Names keep the order of the ends
    and stay `least_gap` of the axes' height apart. Call when the limits are final.
    """
    to_axes = axes.transData + axes.transAxes.inverted()
    heights = np.array([to_axes.transform((axes.get_xlim()[1], y))[1] for y, _, _ in ends])
    order = np.argsort(heights, kind="stable")
    for height, index in zip(spread(heights[order], least_gap), order, strict=True):
        _, name, look = ends[index]
        axes.plot(
            [1.03, 1.085, 1.14],
            [float(height)] * 3,
            color=look.colour,
            linestyle=look.dash,
            marker=look.marker,
            markerfacecolor=look.face,
            markevery=[1],
            transform=axes.transAxes,
            clip_on=False,
            scalex=False,
            scaley=False,
        )
        axes.text(1.16, float(height), name, transform=axes.transAxes, va="center")


def spread(heights: FloatArray, gap: float) -> FloatArray:
    """The nearest positions (least squares) at least `gap` apart, moved into [0, 1] if they fit.

    `heights` has shape (n,) and increases.

    >>> spread(np.array([0.1, 0.5, 0.5]), 0.2)
    array([0.1, 0.4, 0.6])
    """
    steps = gap * np.arange(len(heights))
    blocks: list[tuple[float, int]] = []  # pool adjacent violators: mean and size
    for height in heights - steps:
        mean, size = float(height), 1
        while blocks and blocks[-1][0] > mean:
            earlier, count = blocks.pop()
            mean, size = (earlier * count + mean * size) / (count + size), count + size
        blocks.append((mean, size))
    means, sizes = zip(*blocks, strict=True)
    apart = np.repeat(means, sizes) + steps
    return np.asarray(np.maximum(np.minimum(apart, 1.0 - steps[::-1]), steps), dtype=np.float64)


def _settle(figure: Figure) -> None:
    """Lay the figure out once for all files: each drawing would move the axes a little more."""
    if figure.get_layout_engine() is not None:
        figure.draw_without_rendering()
        figure.set_layout_engine("none")


def svg(figure: Figure) -> str:
    """The figure as SVG text, without date."""
    return _written(figure, "svg", metadata={"Date": None}).decode()


def pdf(figure: Figure) -> bytes:
    """The figure as PDF, without date."""
    return _written(figure, "pdf", metadata={"CreationDate": None})


def png(figure: Figure, dots_per_inch: float = 300.0) -> bytes:
    """The figure as PNG on white paper."""
    return _written(figure, "png", dpi=dots_per_inch, facecolor=PAPER)


def encoded(figure: Figure, suffix: str) -> bytes:
    """The figure as a file of that suffix: ``.svg``, ``.pdf`` or ``.png``."""
    match suffix.lower():
        case ".svg":
            return svg(figure).encode()
        case ".pdf":
            return pdf(figure)
        case ".png":
            return png(figure)
    raise ValueError(f"no figure can be written as {suffix!r}: use .svg, .pdf or .png")


def _written(figure: Figure, kind: str, **options: Any) -> bytes:
    buffer = io.BytesIO()
    with styled():
        _settle(figure)
        figure.savefig(buffer, format=kind, **options)
    return buffer.getvalue()
