"""Pictures of a study: a map over two keys, lines over one, a band over cycles, the life.

Lengths come in mm and are shown in micrometres.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm, Normalize
from matplotlib.figure import Figure

from wear.faults import UsageError
from wear.figure_style import COLUMN, COLUMN_AND_HALF, canvas, stroke, styled
from wear.numerics.gauss import FloatArray
from wear.quantities import in_short, label_of

if TYPE_CHECKING:
    import xarray

_MICROMETRES_PER_MM = 1e3
_WEAR = r"Bearing wear  $u_c$  ($\mathrm{\mu m}$)"
_SHARES = (0.05, 0.25, 0.5, 0.75, 0.95)  # of the samples, for the band
_FAILED = 0.1  # share of contacts beyond the wear depth at the 10 % life
_DECADES = 30.0  # ratio of the largest to the smallest value from which an axis is logarithmic


def picture(results: xarray.Dataset) -> Figure:
    """Return the picture that suits a study.

    A grid over one key gives lines of wear, one for each number of cycles; over two and more a map
    over the first two, at the last number of cycles and the first value of the others. Samples give
    a band over cycles and, where a wear depth was asked for, the distribution of the life.
    """
    _require(results, "bearing_wear_mm")
    if "sample" in results.dims:
        if "cycles_to_wear" in results:
            return life(results)
        with styled():
            figure, axes = canvas(COLUMN, 0.7 * COLUMN)
            _band(axes, results)
        return figure
    keys = [str(name) for name in results["bearing_wear_mm"].dims if name != "cycle"]
    return lines(results, keys[0]) if len(keys) == 1 else heat_map(results, keys[0], keys[1])


def lines(results: xarray.Dataset, key: str) -> Figure:
    """Return the wear against one key, a line for each number of cycles."""
    with styled():
        figure, axes = canvas(COLUMN, 0.7 * COLUMN)
        for place, cycles in enumerate(results["cycle"].values.tolist()):
            wear = results["bearing_wear_mm"].isel(cycle=place).values * _MICROMETRES_PER_MM
            color, label = stroke(place)["color"], f"{in_short(cycles)} cycles"
            axes.plot(results[key].values, wear, color=color, label=label)
        _scale(axes, "x", results[key].values)
        _scale(axes, "y", results["bearing_wear_mm"].values)
        axes.set_xlabel(label_of(key))
        axes.set_ylabel(_WEAR)
        axes.legend()
    return figure


def heat_map(results: xarray.Dataset, across: str, up: str) -> Figure:
    """Return a map of the wear over two keys; rows without an answer stay white."""
    wear = results["bearing_wear_mm"].isel(cycle=-1)
    wear = wear.isel({name: 0 for name in wear.dims if name not in (across, up)})
    values = wear.transpose(up, across).values * _MICROMETRES_PER_MM
    with styled():
        figure, axes = canvas(COLUMN_AND_HALF, 0.7 * COLUMN_AND_HALF)
        norm = LogNorm() if _spans_decades(values) else Normalize()
        image = axes.pcolormesh(
            results[across].values, results[up].values, values, norm=norm, cmap="viridis",
            shading="nearest", rasterized=True,
        )  # fmt: skip
        cycles = float(results["cycle"].values[-1])
        figure.colorbar(image, ax=axes, label=f"{_WEAR} after {in_short(cycles)} cycles")
        _scale(axes, "x", results[across].values)
        _scale(axes, "y", results[up].values)
        axes.set_xlabel(label_of(across))
        axes.set_ylabel(label_of(up))
    return figure


def life(results: xarray.Dataset) -> Figure:
    """Return the band of the wear, and the distribution of the cycles to the wear depth.

    Where wear ends below the depth the distribution ends below one. A cross marks the 10 % life.
    """
    count = results["cycles_to_wear"].values[results["status"].values == 0]
    with styled():
        figure, axes = canvas(COLUMN, 1.2 * COLUMN)
        axes.remove()
        top, bottom = figure.subplots(2, 1)
        _band(top, results)
        look = stroke(1)
        _distribution(bottom, count, look["color"])
        bottom.set_xlabel("Cycles to the wear depth")
        if len(count) and np.isfinite(ten := ten_percent_life(results)):
            bottom.plot([ten], [_FAILED], "x", color=look["color"])
            note = f"10 % life: {in_short(ten)} cycles"
            bottom.annotate(note, (ten, _FAILED), (6, -2), textcoords="offset points", va="top")
    return figure


def indices(results: xarray.Dataset) -> Figure:
    """Return the Sobol' indices at the last number of cycles as bars with their confidence."""
    last = results.isel(cycle=-1)
    place = np.arange(last.sizes["key"])
    with styled():
        figure, axes = canvas(COLUMN, 12.0 + 9.0 * len(place))
        for offset, name, words in ((0.2, "first_order", "alone"), (-0.2, "total_order", "in all")):
            value = last[name].values
            ends = np.abs(
                np.stack([last[f"{name}_low"].values, last[f"{name}_high"].values]) - value
            )
            color = stroke(0 if offset > 0 else 1)["color"]
            axes.barh(place + offset, value, 0.36, xerr=ends, color=color, label=words)
        axes.set_yticks(place, [key.split(".")[-1].replace("_", " ") for key in last["key"].values])
        axes.set_xlabel("Share of the variance of the wear")
        axes.legend()
    return figure


def ten_percent_life(results: xarray.Dataset) -> float:
    """Return the number of cycles by which 10 % of the contacts have reached the wear depth."""
    _require(results, "cycles_to_wear")
    count = results["cycles_to_wear"].values[results["status"].values == 0]
    return float(np.quantile(count, _FAILED, method="higher"))


def _require(results: xarray.Dataset, name: str) -> None:
    if name not in getattr(results, "data_vars", ()):
        raise UsageError(f"results: {name} is missing; give the results of a study that has it")
    if not np.any(results["status"] == 0):
        raise UsageError("results: no row has an answer; their status and reason say why")


def _band(axes: Axes, results: xarray.Dataset) -> None:
    """Draw the median of the wear and the bands of 50 % and 90 % of the samples over cycles; for
    one number of cycles, the distribution of the wear."""
    wear = results["bearing_wear_mm"].values[results["status"].values == 0]
    low, lower, middle, upper, high = np.quantile(wear, _SHARES, axis=0) * _MICROMETRES_PER_MM
    cycles, look = results["cycle"].values, stroke(0)
    if len(cycles) == 1:
        _distribution(axes, wear[:, 0] * _MICROMETRES_PER_MM, look["color"])
        axes.set_xlabel(f"{_WEAR} after {in_short(cycles[0])} cycles")
        return
    axes.fill_between(cycles, low, high, color=look["color"], alpha=0.2, lw=0, label="90 %")
    axes.fill_between(cycles, lower, upper, color=look["color"], alpha=0.4, lw=0, label="50 %")
    axes.plot(cycles, middle, color=look["color"], marker=look["marker"], label="median")
    _scale(axes, "x", cycles)
    _scale(axes, "y", np.concatenate([low, high]))
    axes.set_xlabel("Cycles  $N$")
    axes.set_ylabel(_WEAR)
    axes.legend()


def _distribution(axes: Axes, values: FloatArray, colour: str) -> None:
    """Draw the share of samples up to each value; infinite ones count, and are not drawn."""
    ordered = np.sort(values)
    share, finite = np.arange(1, len(ordered) + 1) / len(ordered), np.isfinite(ordered)
    axes.step(ordered[finite], share[finite], where="post", color=colour)
    if finite.any():
        _scale(axes, "x", ordered[finite])
    axes.set(ylim=(0.0, 1.0), ylabel="Share of contacts")


def _spans_decades(values: FloatArray) -> bool:
    positive = values[values > 0.0]
    return bool(np.nanmin(values) > 0.0 and positive.max() > _DECADES * positive.min())


def _scale(axes: Axes, axis: str, values: FloatArray) -> None:
    if _spans_decades(np.asarray(values, dtype=float)):
        axes.set(**{f"{axis}scale": "log"})
