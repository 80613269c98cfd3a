"""`wear figure`: wear, roughness and pressure against cycles.

examples:
  wear figure section4 -o wear.pdf                          9000 cycles
  wear figure section4 -o wear.svg --cycles 1e8 --log       on a logarithmic axis
  wear figure scene.toml -o wear.png --set contact.ends_at_3_sigma=true
  wear figure mild.toml hard.toml -o both.svg --until-wear 2e-3 --axis hours
  wear figure scene.toml -o wear.pdf --data readings.csv    with measured wear
  wear figure section4 -o pulses.svg --inside 0,10,100      the pressure within three cycles
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from derive import files, terminal
from derive.command_line import Answer, Options, Parser, declare
from wear.commands import arguments, run_output
from wear.faults import Faults

if TYPE_CHECKING:
    from wear.fitting.readings import Specimen
    from wear.scene import Scene

POINTS = 160
LAST = 9000  # cycle shown, unless the load ends before or readings go on
MOST_AT_ONCE = 7  # scenes or cycles in one figure: as many as there are colours
ABSCISSAE = ("cycles", "hours", "distance")


def add_arguments(parser: Parser) -> None:
    """Declare the scenes, the file and the range of cycles."""
    arguments.add_scene(parser, several=True)
    about = "a .pdf, .png or .svg file"
    pictures = arguments.file(*arguments.PICTURES)
    declare(parser, "-o, --output FILE", about, type=pictures, required=True)
    about = f"last cycle shown (default: that of the last reading, or {LAST})"
    arguments.add_cycles(parser, about, usage="--cycles N")
    about = "cycles, hours, or distance, that of sliding (default: cycles)"
    arguments.add_choice(parser, "--axis AXIS", lambda: ABSCISSAE, about, default="cycles")
    about = "logarithmic axes: of cycles, and of wear or roughness that span decades"
    declare(parser, "--log", about)
    about = "draw readings beside the wear: columns cycles, wear_mm or wear_um, and specimen"
    arguments.add_readings(parser, about)
    arguments.add_depth(parser, "draw this limit of the wear, and the cycle that reaches it")
    about = (
        "instead: the contact pressure within the cycles that begin after these numbers of "
        "cycles, 0 for the first"
    )
    arguments.add_cycles(parser, about, usage="--inside N,...")


def execute(options: Options) -> Answer:
    """Solve the scenes and draw them."""
    faults = arguments.read(options)
    scenes, inside, output = options.scene, options.inside, options.output
    specimens, last = options.readings, options.cycles or ()
    if len(last) > 1 or last == (0,):
        faults.append("--cycles: give one number of cycles, from 1 on")
    if len(scenes) > MOST_AT_ONCE:
        faults.append(f"{len(scenes)} scenes in one figure; name up to {MOST_AT_ONCE}")
    if len({scene.name for scene in scenes}) < len(scenes):
        faults.append("a scene is named twice; keep one")
    if len(scenes) > 1 and (inside is not None or any(each.changes for each in specimens)):
        faults.append("--inside, or readings with entries of the scene, go with one scene")
    if inside is not None:
        _check_inside(options, faults)
    faults.stop_if_any()
    if inside is not None:
        return _pressure_inside(scenes[0], inside, output)
    return _against_cycles(options, last[0] if last else _default_last(scenes, specimens))


def _default_last(scenes: Sequence[Scene], specimens: Sequence[Specimen]) -> int:
    from wear.load.spans import most_cycles

    read = [int(each.cycles[-1]) for each in specimens]
    return max(read) if read else min(LAST, *(most_cycles(scene.load) for scene in scenes))


def _against_cycles(options: Options, last: int) -> Answer:
    import numpy as np

    from wear.figure_data import Abscissa, panels_of, points_of
    from wear.figures import history
    from wear.life import cycles_until
    from wear.request import cycles_along
    from wear.solver import solve

    abscissa, limit = Abscissa[options.axis.upper()], options.until_wear
    stems = {Path(scene.name).stem for scene in options.scene}
    same = len(stems) < len(options.scene)  # files of one name in several folders
    runs = {scene.name if same else Path(scene.name).stem: scene for scene in options.scene}
    if any(each.changes for each in options.readings):
        runs = {each.name: options.scene[0].with_(each.changes) for each in options.readings}
    cycles = cycles_along(1, last, POINTS, [] if options.log else np.linspace(0, last, POINTS))
    with terminal.busy("counting cycles") as tell:
        histories = [solve(scene, cycles, rtol=1e-6, progress=tell) for scene in runs.values()]
    wear, *others = panels_of(histories, tuple(runs), abscissa)
    summary = _summary(histories[0].scene, cycles, options.output) | {"scenes": list(runs)}
    lines: list[str] = []
    found = [[*run_output.notices_of(each)] for each in histories]
    if limit is not None:
        lives = [cycles_until(scene, limit, rtol=1e-6) for scene in runs.values()]
        summary["cycles_until"] = [float(life.cycles[0]) for life in lives]
        summary["reached"] = [life.reached[0].value for life in lives]
        for name, life, texts in zip(runs, lives, found, strict=True):
            text = run_output.life_text(life.cycles[0], life.error[0], life.reached[0].value)
            unit = " cycles" if math.isfinite(life.cycles[0]) else ""
            lines.append(f"{name}: {limit:g} mm: {text}{unit}")
            texts += life.notices
    notices = [
        f"{name}: {text}" if len(runs) > 1 else text
        for name, texts in zip(runs, found, strict=True)
        for text in dict.fromkeys(texts)
    ]
    arguments.strict_faults(notices, options).stop_if_any()
    readings = [each.first(int(np.sum(each.cycles <= last))) for each in options.readings]
    points = points_of([each for each in readings if len(each.cycles)], runs, abscissa)
    shown = replace(wear, points=points, limit=limit)
    drawn = history([shown, *others], abscissa=abscissa, logarithmic=options.log)
    _write(drawn, options.output)
    return Answer(summary, lambda: "\n".join(lines), tuple(notices))


def _write(drawn: object, output: Path) -> None:
    from wear.figure_style import encoded

    files.write_atomically(output, encoded(drawn, output.suffix))  # type: ignore[arg-type]


def _check_inside(options: Options, faults: Faults) -> None:
    from wear.load import Blocks
    from wear.request import obstacle

    inside, scenes = options.inside, options.scene
    others = ("cycles", "until-wear", "data", "log")
    given = [f"--{name}" for name in others if getattr(options, name.replace("-", "_"))]
    if options.axis != ABSCISSAE[0]:
        given.append("--axis")
    if given:
        faults.append(f"--inside: does not go with {', '.join(given)}; leave one or the other out")
    if len(inside) > MOST_AT_ONCE:
        faults.append(f"--inside: {len(inside)} cycles in one figure; name up to {MOST_AT_ONCE}")
    for scene in scenes:
        against = "the load does not repeat" if isinstance(scene.load, Blocks) else obstacle(scene)
        if against is not None:
            faults.append(f"--inside: {against}; leave --inside out")


def _pressure_inside(scene: Scene, inside: Sequence[int], output: Path) -> Answer:
    from wear.figure_data import pressure_inside
    from wear.figures import pressure_in_cycles

    _write(pressure_in_cycles(pressure_inside(scene, inside)), output)
    summary = _summary(scene.title or scene.name, sorted(inside), output)
    return Answer(summary, notices=scene.notices)


def _summary(scene: str, cycles: Sequence[int], output: Path) -> dict[str, object]:
    return {"scene": scene, "file": str(output), "cycles": [cycles[0], cycles[-1]]}
