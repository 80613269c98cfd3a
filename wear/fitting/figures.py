"""Figures of a fit: readings with the fitted wear and its band, profiles, corner of two
parameters."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure
from scipy.interpolate import PchipInterpolator

from wear.figure_data import as_typed
from wear.figure_style import COLUMN, COLUMN_AND_HALF, GREY, PAGE, canvas, stroke, styled
from wear.fitting.model import Parameter
from wear.fitting.profiles import Profile, moved
from wear.numerics.gauss import FloatArray
from wear.quantities import label_of

if TYPE_CHECKING:
    from wear.fitting.fit import Fit

_MICROMETRES_PER_MM = 1e3
_POINTS = 40  # of a curve
_COLUMNS = 3
_BINS = 40
_DECADE = 10.0  # ratio of values from which an axis is logarithmic


def data_and_band(fit: Fit) -> Figure:
    """Draw the readings of every specimen with the fitted wear and its 95 % band, and below them
    the excess of the readings."""
    first = min(specimen.cycles[0] for specimen in fit.model.specimens)
    last = min(3.0 * max(specimen.cycles[-1] for specimen in fit.model.specimens), 1e12)
    cycles = np.unique(np.rint(np.geomspace(first, last, _POINTS)))
    curves = _curves(fit, cycles)
    ends = np.cumsum([len(specimen.cycles) for specimen in fit.model.specimens])[:-1]
    relative = fit.model.residuals.relative
    size = COLUMN_AND_HALF if len(curves) > 1 else COLUMN
    with styled():
        figure, axes = canvas(size, size)
        axes.remove()
        top, bottom = figure.subplots(2, 1, sharex=True, height_ratios=[3, 1])
        for place, (specimen, (middle, low, high), residuals) in enumerate(
            zip(fit.model.specimens, curves, np.split(-fit.residuals, ends), strict=True)
        ):
            look = stroke(place, place // 7)
            drawn = look | {"linestyle": ""}
            top.fill_between(cycles, low, high, color=look["color"], alpha=0.15, lw=0)
            top.plot(cycles, middle, **look | {"marker": ""})
            wear = specimen.wear_mm * _MICROMETRES_PER_MM
            top.plot(specimen.cycles, wear, label=as_typed(specimen.name), **drawn)
            bottom.plot(specimen.cycles, residuals, **drawn)
        bottom.axhline(0.0, color=GREY, lw=0.6)
        top.set(xscale="log", yscale="log", ylabel=r"Bearing wear  $u_c$  ($\mathrm{\mu m}$)")
        words = "Residual / scatter" if fit.model.residuals.known else (
            r"Residual of $\ln\,u_c$" if relative else "Residual (mm)"
        )  # fmt: skip
        bottom.set(xlabel="Cycles  $N$", ylabel=words)
        if len(curves) > 1:
            top.legend(ncols=2, title="specimen")
    return figure


def _curves(fit: Fit, cycles: FloatArray) -> FloatArray:
    """Return the wear of each specimen after cycles (n,) and the ends of its band (s, 3, n), in
    micrometres."""
    rows = [(each.bearing_wear_mm, *each.interval_95) for each in fit.forecast(cycles.tolist())]
    curves = np.array(rows).reshape(-1, len(cycles), 3) * _MICROMETRES_PER_MM
    return np.swapaxes(curves, 1, 2)


def profiles(fit: Fit) -> Figure:
    """Return the profile likelihoods; the line across is the 95 % level."""
    drawn = moved(fit)
    rows, columns = math.ceil(len(drawn) / _COLUMNS), min(len(drawn), _COLUMNS)
    with styled():
        figure, axes = canvas(PAGE * columns / _COLUMNS, 45.0 * rows)
        axes.remove()
        cells = figure.subplots(rows, columns, squeeze=False, sharey=True).ravel()
        for cell, index in zip(cells, drawn, strict=False):
            parameter, profile = fit.parameters[index], fit.profiles[index]
            color = stroke(0)["color"]
            cell.plot(profile.values, profile.roots, "o", color=color, ms=3)
            cell.plot(*_curve(profile, parameter.positive), color=color)
            cell.axhline(fit.quantile, color=GREY, lw=0.6)
            cell.set(ylim=(0.0, 1.5 * fit.quantile), xlabel=_label(parameter))
            if parameter.positive and profile.values[-1] > _DECADE * profile.values[0]:
                cell.set_xscale("log")
            else:
                cell.locator_params(axis="x", nbins=4)
                cell.ticklabel_format(axis="x", scilimits=(-3, 4))
        for cell in cells[len(drawn) :]:
            cell.remove()
        level = {"xycoords": ("axes fraction", "data"), "ha": "center", "va": "bottom", "size": 7}
        cells[0].annotate("95 %", (0.5, fit.quantile), **level)
        figure.supylabel("Root of the deviance", size=8.5)
    return figure


def _curve(profile: Profile, positive: bool) -> tuple[FloatArray, FloatArray]:
    """Return a profile between its points: the values as a monotone function of the signed root."""
    values, roots = profile.values, profile.roots
    signed = np.where(np.arange(len(roots)) < np.argmin(roots), -roots, roots)
    if len(values) < 2 or not np.all(np.diff(signed) > 0.0):
        return values, roots
    along = np.linspace(signed[0], signed[-1], _POINTS)
    curve = PchipInterpolator(signed, np.log(values) if positive else values)(along)
    return np.exp(curve) if positive else curve, np.abs(along)


def corner(fit: Fit, samples: FloatArray) -> Figure:
    """Return the posterior of the two parameters that are correlated most, each and together.

    `samples` (m, p) are those of `posterior`; with one parameter there is its own alone.
    """
    count = samples.shape[1]
    related = np.abs(np.corrcoef(samples.T)).reshape(count, count) - np.eye(count)
    pair = sorted(set(np.unravel_index(np.argmax(related), related.shape)))
    with styled():
        figure, axes = canvas(COLUMN, COLUMN)
        axes.remove()
        cells = figure.subplots(len(pair), len(pair), squeeze=False, sharex="col")
        for place, index in enumerate(pair):
            cell, values = cells[place, place], _shown(fit.parameters[index], samples[:, index])
            cell.hist(values, _BINS, color=stroke(0)["color"], histtype="step")
            cell.set_yticks([])
            cells[-1, place].set_xlabel(_label(fit.parameters[index], log=True))
        if len(pair) == 2:
            across, up = (_shown(fit.parameters[i], samples[:, i]) for i in pair)
            cells[1, 0].hist2d(across, up, _BINS, cmap="Greys", rasterized=True)
            cells[1, 0].set_ylabel(_label(fit.parameters[pair[1]], log=True))
            cells[0, 1].remove()
    return figure


def _shown(parameter: Parameter, values: FloatArray) -> FloatArray:
    return np.log10(values) if parameter.positive else values


def _label(parameter: Parameter, log: bool = False) -> str:
    """Return the key of a parameter in words, with its unit."""
    _, _, name = label_of(parameter.key).partition(": ")
    words = f"{name} {as_typed(parameter.specimen)}".rstrip()
    return f"log10 of {words}" if log and parameter.positive else words
