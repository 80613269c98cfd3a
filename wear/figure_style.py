"""The style of all figures, and their files.

Overview
    Figures are matplotlib `Figure` objects without pyplot: nothing global is opened or changed.
    The settings hold only inside `styled`, which every drawing function enters by itself.
Legibility
    Colours are those of Okabe and Ito, which colour-blind readers can distinguish, with orange and
    sky blue darker: every line has a contrast of at least three to white and to the page in dark
    mode. Lines also differ in marker and dash, so that grey print keeps them apart. Ink is pure
    black and paper pure white or transparent: the page replaces both in dark mode.
Files
    SVG has its text as paths, since no reader can be expected to have the fonts; PDF embeds them.
    Both are the same to the byte from run to run.
"""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from importlib.resources import files
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.typing import LineStyleType
from scipy.optimize import isotonic_regression

from wear.numerics.gauss import FloatArray

#: Widths of a journal's single, one and a half, and double column, in mm.
COLUMN = 90.0
COLUMN_AND_HALF = 140.0
PAGE = 190.0

INK = "#000000"
PAPER = "#ffffff"
GREY = "#6b7480"
HALO = withStroke(linewidth=2.0, foreground=PAPER)
"""Keeps names legible on top of lines and colours."""

LEAST_GAP = 0.08  # between the names of lines, of the height of the axes
_MILLIMETRES_PER_INCH = 25.4
_SETTINGS = mpl.rc_params_from_file(
    str(files("wear").joinpath("data", "wear.mplstyle")), use_default_template=False
)


_FORMATS: Mapping[str, dict[str, Any]] = {
    ".svg": {"metadata": {"Date": None}},
    ".pdf": {"metadata": {"CreationDate": None}},
    ".png": {"dpi": 300.0, "facecolor": PAPER},
}


Stroke = dict[str, Any]
"""The style of a line: matplotlib's color, linestyle, marker and markerfacecolor."""

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
    """Return the colour and marker of a family (seven, then again) and the dash of a variant
    (solid, dashed, dotted); the markers of variants are hollow."""
    colour, marker = _FAMILIES[family % len(_FAMILIES)]
    dash, face = _DASHES[variant % len(_DASHES)], PAPER if variant else colour
    return {"color": colour, "linestyle": dash, "marker": marker, "markerfacecolor": face}


@contextmanager
def styled() -> Iterator[None]:
    """Apply the settings of ``wear.mplstyle`` until the block ends."""
    with mpl.rc_context(_SETTINGS):
        yield


def panels(rows: int, columns: int, width: float, height: float) -> tuple[Figure, list[Axes]]:
    """Return a figure of that size in mm with its axes, row by row. Call inside `styled`.

    Axes one above the other share their abscissa, axes side by side their ordinate.
    """
    size = (width / _MILLIMETRES_PER_INCH, height / _MILLIMETRES_PER_INCH)
    figure = Figure(figsize=size, layout="constrained")
    axes = figure.subplots(rows, columns, sharex="col", sharey="row", squeeze=False)
    return figure, list(axes.flat)


def canvas(width: float, height: float) -> tuple[Figure, Axes]:
    """Return a figure of that size in mm with one pair of axes. Call inside `styled`."""
    figure, [axes] = panels(1, 1, width, height)
    return figure, axes


def label_ends(axes: Axes, ends: Sequence[tuple[float, str, Stroke]]) -> None:
    """Name lines at their right ends, outside the axes, each behind a sample of its stroke.

    `ends` has the y value, the name and the stroke of each line. Names keep the order of the ends
    and stay `LEAST_GAP` of the axes' height apart. Call when the limits are final.
    """
    to_axes = axes.transData + axes.transAxes.inverted()
    heights = np.array([to_axes.transform((axes.get_xlim()[1], y))[1] for y, _, _ in ends])
    order = np.argsort(heights, kind="stable")
    for height, index in zip(spread(heights[order], LEAST_GAP), order, strict=True):
        _, name, look = ends[index]
        axes.plot(
            [1.03, 1.085, 1.14], [float(height)] * 3, markevery=[1], transform=axes.transAxes,
            clip_on=False, scalex=False, scaley=False, **look,
        )  # fmt: skip
        axes.text(1.16, float(height), name, transform=axes.transAxes, va="center")


def label_above(axes: Axes, name: str, at: tuple[float, float], gap: float) -> None:
    """Write a name above a point, with a `gap` in points of type, on a halo of paper."""
    axes.annotate(
        name, at, xytext=(0.0, gap), textcoords="offset points", ha="center", va="bottom",
        path_effects=[HALO],
    )  # fmt: skip


def spread(heights: FloatArray, gap: float) -> FloatArray:
    """Return the nearest positions (least squares) at least `gap` apart, in [0, 1] if they fit.

    `heights` has shape (n,) and increases.

    >>> spread(np.array([0.1, 0.5, 0.5]), 0.2)
    array([0.1, 0.4, 0.6])
    """
    steps = gap * np.arange(len(heights))
    apart = isotonic_regression(heights - steps).x + steps
    return np.asarray(np.maximum(np.minimum(apart, 1.0 - steps[::-1]), steps), dtype=np.float64)


def encoded(figure: Figure, suffix: str) -> bytes:
    """Return the figure as a file of that suffix: ``.svg``, ``.pdf`` or ``.png``, without date."""
    if suffix.lower() not in _FORMATS:
        raise ValueError(f"no figure can be written as {suffix!r}: use {', '.join(_FORMATS)}")
    buffer = io.BytesIO()
    with styled():
        # The figure is laid out once for all files: each drawing would move the axes a little more.
        # The layout engine "none" would leave a placeholder, for which every file is drawn twice.
        if (layout := figure.get_layout_engine()) is not None:
            layout.execute(figure)
            with mpl.rc_context({"figure.constrained_layout.use": False}):
                figure.set_layout_engine(None)
        figure.savefig(buffer, format=suffix[1:].lower(), **_FORMATS[suffix.lower()])
    return buffer.getvalue()
