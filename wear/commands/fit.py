"""`wear fit`: parameters of a scene from measured wear.

examples:
  wear fit readings.csv scene.toml --free bearing.wear_coefficient
  wear fit readings.csv scene.toml --free bearing.wear_coefficient bearing.roughness_growth \\
      --free-each bearing.roughness_mm --ignore load_g --forecast 1e5,1e6 -o fitted
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from derive import files, terminal
from derive.command_line import Answer, Options, Parser, declare
from wear.commands import arguments

if TYPE_CHECKING:
    from wear.fitting.fit import Fit
    from wear.numerics.gauss import FloatArray

ERRORS = ("relative", "absolute")
QUANTILES = (0.025, 0.5, 0.975)  # of the posterior
WORTHWHILE = 0.995  # of the band of a forecast: a reading that narrows it less is not suggested


def add_arguments(parser: Parser) -> None:
    """Declare the data, the scene, its free entries and the requested results."""
    about = (
        "columns cycles and wear_mm or wear_um; if need be standard_error_mm, specimen, and "
        "entries of the scene such as load.value_mm"
    )
    declare(parser, "DATA.csv", about, dest="data")
    arguments.add_scene(parser)
    kept: dict[str, Any] = {"action": "extend", "default": []}
    declare(parser, "--free KEY ...", "estimate one value for all specimens", **kept)
    declare(parser, "--free-each KEY ...", "estimate one value for each specimen", **kept)
    declare(parser, "--ignore COLUMN ...", "columns of the data to drop", **kept)
    about = "the scatter of readings: relative (default) or absolute"
    arguments.add_choice(parser, "--error ERROR", lambda: ERRORS, about, default=ERRORS[0])
    about = "the wear after these cycles, with band"
    arguments.add_cycles(parser, about, usage="--forecast N,...")
    arguments.add_depth(parser, "cycles to a wear depth, with band")
    about = "also sample the posterior by emcee, with this number of steps for each walker"
    declare(parser, "--posterior STEPS", about, type=arguments.whole(10, 10**6))
    arguments.add_folder(parser, "write fit.json, fitted.toml and the figures there")


def execute(options: Options) -> Answer:
    """Fit the free entries to the data."""
    import numpy as np

    from wear.faults import UsageError
    from wear.fitting.fit import Fit
    from wear.fitting.model import FitModel
    from wear.fitting.posterior import posterior

    faults = arguments.read(options)
    cycles, wear = options.forecast or (), options.until_wear
    if 0 in cycles:
        faults.append("--forecast: 0 is the fresh state; give cycles from 1 on")
    if options.posterior is not None and not find_spec("emcee"):
        faults.append("--posterior needs emcee: pip install 'derive-wear[fit]'")
    model = None
    if options.scene is not None:
        keys = _keys(options.free), _keys(options.free_each)
        error = options.error or ERRORS[0]
        try:
            model = FitModel.of(options.data, options.scene, *keys, error, options.ignore)
        except UsageError as fault:
            faults.append(str(fault))
    faults.stop_if_any()
    assert model is not None
    with terminal.busy("fitting") as tell:
        result = Fit.of(model, progress=tell)
        tell("sampling the posterior")
        samples = posterior(result, options.posterior) if options.posterior else None
        tell("forecasting")
        document = {"scene": "", "data": options.data} | result.as_json(cycles, wear)
    arguments.strict_faults(document["notices"], options).stop_if_any()
    if samples is not None:
        for row, ends in zip(document["parameters"], np.quantile(samples, QUANTILES, axis=0).T,
                             strict=True):  # fmt: skip
            row |= {"posterior_median": ends[1], "posterior_95": [ends[0], ends[2]]}
    if options.output is not None:
        _write(options.output, result, document, samples)
    return Answer(document, lambda: "\n".join(_lines(document)), document["notices"])


def _keys(words: Sequence[str]) -> list[str]:
    """Return the keys among some words, with spaces or commas between them."""
    return " ".join(words).replace(",", " ").split()


def _lines(document: dict[str, Any]) -> Iterator[str]:
    """Yield the lines of the fit report."""
    yield document["scene"]
    yield (f"{document['observations']} readings of "
           f"{terminal.count(document['specimens'], 'specimen')}, rms {document['rms']:.3g}"
           + f", AICc {document['aicc']:.1f}" * math.isfinite(document["aicc"]))  # fmt: skip
    yield ""
    sampled = "posterior_95" in document["parameters"][0]
    yield terminal.table(
        ["parameter", "estimate", "standard\nerror", "95 %\nfrom", "\nto",
         *(["posterior\nfrom", "\nto"] if sampled else [])],
        [[f"{row['key']} {row['specimen'] or ''}".strip(), f"{row['estimate']:.4g}",
          _end(row["standard_error"], 2), *map(_end, row["interval_95"]),
          *map(_end, row.get("posterior_95", []))]
         for row in document["parameters"]],
    )  # fmt: skip
    for row in document["undetermined"]:
        yield f"\n{row['sentence']}"
    both = ("cycles", "bearing_wear_mm")
    for (asked, answer), rows in ((both, document["forecast"]),
                                  (both[::-1], document["cycles_to_wear"])):  # fmt: skip
        if rows:
            yield ""
            yield terminal.table(
                ["specimen", *(name.replace("_mm", "\n(mm)").replace("_", " ")
                               for name in (asked, answer)), "95 %\nfrom", "\nto"],
                [[row["specimen"], f"{row[asked]:.6g}", _end(row[answer], infinite="not reached"),
                  *map(_end, row["interval_95"])] for row in rows],
            )  # fmt: skip
    yield ""
    own = {"law": "this scene"} | {key: document[key] for key in ("rms", "aicc", "forecast_rms")}
    yield terminal.table(
        ["law", "rms", "AICc", "rms of the last reading,\npredicted from the first half"],
        [[row["law"], *(format(x, digits) if math.isfinite(x) else "–" for x, digits in
                        ((row["rms"], ".3g"), (row["aicc"], ".1f"), (row["forecast_rms"], ".3g")))]
         for row in (own, *document["alternatives"])],
    )  # fmt: skip
    after = document["next_reading"]
    if after["band_of_forecast_times"] > WORTHWHILE:
        return
    which = f"of specimen {after['specimen']} " * bool(after["specimen"])
    what = "the forecast" if document["forecast"] else "a forecast to ten times the cycles read"
    yield (f"\nOne more reading {which}after cycle {after['cycles']:.6g} narrows {what} "
           f"most, to {after['band_of_forecast_times']:.0%} of its band.")  # fmt: skip


def _end(value: float, digits: int = 4, infinite: str = "open") -> str:
    """Return a number, or the word for an infinite one.

    >>> _end(0.12345), _end(-float("inf")), _end(float("inf"), infinite="not reached")
    ('0.1235', 'open', 'not reached')
    """
    return f"{value:.{digits}g}" if abs(value) < float("inf") else infinite


def _write(folder: Path, result: Fit, document: dict[str, Any], samples: FloatArray | None) -> None:
    """Write the document, the fitted scenes and the figures, all or none."""
    from wear.figure_style import encoded
    from wear.fitting import figures

    drawn = {"data.svg": figures.data_and_band(result), "profiles.svg": figures.profiles(result)}
    if samples is not None:
        drawn["corner.svg"] = figures.corner(result, samples)
    contents: dict[str, str | bytes] = {"fit.json": terminal.json_text(document)}
    scenes = result.scenes
    for place, (specimen, scene) in enumerate(zip(result.model.specimens, scenes, strict=True)):
        safe = "".join(c if c.isalnum() or c in "-_" else "_" for c in specimen.name)
        name = f"fitted-{safe or place + 1}.toml" if len(scenes) > 1 else "fitted.toml"
        contents[name] = scene.to_toml()
    drawings = {name: encoded(figure, ".svg") for name, figure in drawn.items()}
    files.write_all(folder, contents | drawings)
