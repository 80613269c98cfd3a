"""Figures of a fit: readings with the fitted wear and its band, residuals, profile likelihoods."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from wear.figure_style import COLUMN, COLUMN_AND_HALF, GREY, canvas, stroke, styled

if TYPE_CHECKING:
    from wear.fitting.estimate import Fit

_MICROMETRES_PER_MM = 1e3
_POINTS = 40  # of a curve
_COLUMNS = 3


def data_and_band(fit: Fit) -> Figure:
    """Return the readings of every specimen with the fitted wear and its 95 % band, and below them
    the residuals."""
    first = min(specimen.cycles[0] for specimen in fit.model.specimens)
    last = 3.0 * max(specimen.cycles[-1] for specimen in fit.model.specimens)
    cycles = np.unique(np.round(np.geomspace(first, last, _POINTS)))
    curves = list(fit.forecast(cycles.tolist()))
    with styled():
        figure, axes = canvas(COLUMN_AND_HALF, COLUMN_AND_HALF)
        axes.remove()
        top, bottom = figure.subplots(2, 1, sharex=True, height_ratios=[3, 1])
        at = 0
        for place, specimen in enumerate(fit.model.specimens):
            own, look = curves[place * len(cycles) : (place + 1) * len(cycles)], stroke(place)
            middle = np.array([each.bearing_wear_mm for each in own]) * _MICROMETRES_PER_MM
            ends = np.array([each.interval_95 for each in own]).T * _MICROMETRES_PER_MM
            top.fill_between(cycles, *ends, color=look.colour, alpha=0.15, lw=0)
            top.plot(cycles, middle, color=look.colour)
            top.plot(specimen.cycles, specimen.wear_mm * _MICROMETRES_PER_MM, look.marker,
                     color=look.colour, label=specimen.name)  # fmt: skip
            residuals = fit.residuals[at : at + len(specimen.cycles)]
            at += len(specimen.cycles)
            bottom.plot(specimen.cycles, residuals, look.marker, color=look.colour)
        bottom.axhline(0.0, color=GREY, lw=0.6)
        top.set_xscale("log")
        top.set_yscale("log")
        top.set_ylabel(r"Bearing wear  $u_c$  ($\mathrm{\mu m}$)")
        bottom.set_xlabel("Cycles  $N$")
        bottom.set_ylabel("Residual of ln $u_c$" if fit.relative else "Residual")
        if len(fit.model.specimens) > 1:
            top.legend(ncols=2, title="specimen")
    return figure


def profiles(fit: Fit) -> Figure:
    """Return the profile likelihood of every parameter; the line across is the 95 % level."""
    rows = math.ceil(len(fit.profiles) / _COLUMNS)
    with styled():
        figure, axes = canvas(2 * COLUMN, 45.0 * rows)
        axes.remove()
        cells = figure.subplots(rows, _COLUMNS, squeeze=False).ravel()
        for cell, parameter, profile in zip(cells, fit.parameters, fit.profiles, strict=False):
            cell.plot(profile.values, profile.roots, "o-", color=stroke(0).colour)
            cell.axhline(fit.quantile, color=GREY, lw=0.6)
            if parameter.positive:
                cell.set_xscale("log")
            cell.set_title(str(parameter).split(".")[-1].replace("_", " "))
        for cell in cells[len(fit.profiles) :]:
            cell.remove()
        figure.supylabel("root of the deviance (standard deviations)", size=8.5)
    return figure
