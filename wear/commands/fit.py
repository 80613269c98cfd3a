"""`wear fit`: the parameters of a scene from measured wear, and how certain they are."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from derive import files, terminal
from derive.command_line import Command
from wear.commands.arguments import Faults, add_scene

if TYPE_CHECKING:
    from wear.fitting.estimate import Fit

EXAMPLE = """\
  wear fit readings.csv scene.toml --free bearing.wear_coefficient
  wear fit readings.csv scene.toml --free bearing.wear_coefficient bearing.roughness_growth \\
      --free-each bearing.roughness_mm --ignore load_g --forecast 1e5,1e6 -o fitted
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare data, scene, what is free and what is asked."""
    parser.add_argument(
        "data",
        metavar="DATA.csv",
        help="columns cycles and wear_mm or wear_um; if need be standard_error_mm, specimen, and "
        "entries of the scene such as load.value_mm",
    )
    add_scene(parser)
    parser.add_argument(
        "--free", metavar="KEY", nargs="+", default=[], help="estimate one value for all specimens"
    )
    parser.add_argument(
        "--free-each", metavar="KEY", nargs="+", default=[], help="estimate one for each specimen"
    )
    parser.add_argument(
        "--error", default="relative", help="relative (default) or absolute: what scatters"
    )
    parser.add_argument(
        "--ignore", metavar="COLUMN", nargs="+", default=[], help="columns of the data to drop"
    )
    parser.add_argument(
        "--forecast", metavar="N,...", help="the wear after these cycles, with band"
    )
    parser.add_argument("--until-wear", metavar="MM", help="cycles to a wear depth, with band")
    parser.add_argument(
        "-o", "--output", metavar="DIR", help="write fit.json, fitted.toml and the figures there"
    )


def execute(options: argparse.Namespace) -> int:
    """Fit, and print what came out."""
    from wear.fitting.estimate import fit

    faults = Faults()
    scene = faults.scene(options)
    error = faults.choice("--error", options.error, ("relative", "absolute"))
    cycles = faults.cycles("--forecast", options.forecast) if options.forecast else ()
    wear = None
    if options.until_wear is not None:
        wear = faults.number("--until-wear", options.until_wear, 1e-30, 1e30)
    if options.output is not None and (problem := files.obstacle_to_folder(options.output)):
        faults.add(f"--output: {problem}")
    faults.stop_if_any()
    assert scene is not None
    found = fit(options.data, scene, options.free, options.free_each,
                error=error, ignore=options.ignore)  # fmt: skip
    document = as_json(found, options.data, cycles, wear)
    if options.output is not None:
        _write(Path(options.output), found, document)
    if options.json:
        terminal.print_json(document)
    else:
        print("\n".join(_lines(document)))
    for notice in document["notices"]:
        terminal.complain("wear fit", notice)
    return terminal.DONE


def as_json(found: Fit, data: str, cycles: tuple[int, ...], wear: float | None) -> dict[str, Any]:
    """Return the document of `wear fit --json`."""
    from wear.fitting.laws import aicc, alternatives

    rows = zip(found.parameters, found.estimates, found.standard_errors, found.intervals,
               strict=True)  # fmt: skip
    others = alternatives(found.model.specimens)
    own = aicc(found.residuals, len(found.theta) + 1)
    farthest = max(cycles, default=int(max(s.cycles[-1] for s in found.model.specimens)))
    after, factor = found.next_reading(farthest)
    better = [other.law for other in others if other.aicc < own]
    return {
        "scene": found.model.scene.title or found.model.scene.name,
        "data": data,
        "observations": len(found.residuals),
        "specimens": len(found.model.specimens),
        "parameters": [
            {"key": p.key, "specimen": p.specimen, "estimate": e, "standard_error": s,
             "interval_95": list(ends)}
            for p, e, s, ends in rows
        ],
        "correlation": found.correlation,
        "rms": found.rms,
        "chi_square": found.chi_square,
        "degrees_of_freedom": found.degrees_of_freedom,
        "aicc": own,
        "undetermined": [{"combination": c, "sentence": s} for c, s in found.undetermined()],
        "forecast": [each._asdict() for each in found.forecast(cycles)] if cycles else [],
        "cycles_to_wear": [each._asdict() for each in found.life(wear)] if wear else [],
        "alternatives": [asdict(other) for other in others],
        "next_reading": {"cycles": after, "band_of_forecast_times": factor},
        "notices": [f"the {law} law describes these data better (AICc)" for law in better],
    }  # fmt: skip


def _lines(document: dict[str, Any]) -> Iterator[str]:
    """Yield what came out, for a reader."""
    yield document["scene"]
    yield (f"{document['observations']} readings of "
           f"{terminal.count(document['specimens'], 'specimen')}, rms {document['rms']:.2%}, "
           f"AICc {document['aicc']:.1f}")  # fmt: skip
    yield ""
    yield terminal.table(
        ["parameter", "estimate", "standard\nerror", "95 %\nfrom", "\nto"],
        [[f"{row['key']} {row['specimen']}".strip(), f"{row['estimate']:.4g}",
          f"{row['standard_error']:.2g}", *(f"{end:.4g}" for end in row["interval_95"])]
         for row in document["parameters"]],
    )  # fmt: skip
    for row in document["undetermined"]:
        yield f"\n{row['sentence']}"
    for title, value, rows in (("cycles", "bearing_wear_mm", document["forecast"]),
                               ("wear (mm)", "cycles", document["cycles_to_wear"])):  # fmt: skip
        if rows:
            given = "cycles" if title == "cycles" else "bearing_wear_mm"
            yield ""
            yield terminal.table(
                ["specimen", title, value.replace("_mm", " (mm)").replace("_", " "), "95 %\nfrom",
                 "\nto"],
                [[row["specimen"], f"{row[given]:.6g}", f"{row[value]:.4g}",
                  *(f"{end:.4g}" for end in row["interval_95"])] for row in rows],
            )  # fmt: skip
    yield ""
    yield terminal.table(
        ["law", "rms", "AICc", "rms of the last reading,\nforecast from the first half"],
        [[row["law"], f"{row['rms']:.2%}", f"{row['aicc']:.1f}", f"{row['forecast_rms']:.2%}"]
         for row in document["alternatives"]],
    )  # fmt: skip
    after = document["next_reading"]
    yield (f"\nOne more reading of every specimen after {after['cycles']:.6g} cycles narrows the "
           f"forecast most, to {after['band_of_forecast_times']:.0%} of its band.")  # fmt: skip


def _write(folder: Path, found: Fit, document: dict[str, Any]) -> None:
    """Write the document, the scenes with the estimates, and the figures."""
    import json

    from wear.figure_style import encoded
    from wear.fitting.figures import data_and_band, profiles

    folder.mkdir(parents=True, exist_ok=True)
    text = json.dumps(terminal.plain(document), indent=2, allow_nan=False)
    files.write_atomically(folder / "fit.json", text)
    for specimen, scene in zip(found.model.specimens, found.model.scenes(found.theta), strict=True):
        name = f"fitted-{specimen.name}.toml" if specimen.name else "fitted.toml"
        files.write_atomically(folder / name, scene.to_toml())
    for name, figure in (("data.svg", data_and_band(found)), ("profiles.svg", profiles(found))):
        files.write_atomically(folder / name, encoded(figure, ".svg"))


COMMAND = Command(
    "fit", "parameters of a scene from measured wear", EXAMPLE, add_arguments, execute
)
