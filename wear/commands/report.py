"""`wear report`: the report of a scene.

examples:
  wear report scene.toml              into the folder scene-report
  wear report section4 -o elsewhere   model, data, equations, wear, life
  wear report scene.toml --data readings.csv      with measured wear
"""

from __future__ import annotations

import shlex
from pathlib import Path

from derive import files, terminal
from derive.command_line import Answer, Options, Parser
from wear.commands import arguments


def add_arguments(parser: Parser) -> None:
    """Declare the scene and the folder."""
    arguments.add_scene(parser)
    about = "compare readings with the prediction: columns cycles, wear_mm or wear_um, specimen"
    arguments.add_readings(parser, about)
    arguments.add_folder(parser, "folder (default: NAME-report)")


def execute(options: Options) -> Answer:
    """Solve the scene and write its report."""
    name = options.scene
    faults = arguments.read(options)
    folder = options.output or Path(f"{Path(name).stem}-report")
    if obstacle := files.obstacle_to_folder(folder):
        faults.append(obstacle)
    faults.stop_if_any()
    from wear.report.publish import published
    from wear.report.scene_report import report

    changes = [part for entry in options.overrides for part in ("--set", entry)]
    data = [] if options.data is None else ["--data", options.data]
    command = shlex.join(["wear", "report", name, *changes, *data])
    with terminal.busy("solving the scene and deriving its equations"):
        contents, typeset = published(report(options.scene, command, options.readings))
        files.write_all(folder, contents)
    document = {"folder": str(folder), "files": sorted(contents)}
    return Answer(document, lambda: f"report: {folder / 'report.html'}", typeset.notices)
