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
from dataclasses import replace
from pathlib import Path

from derive import files, terminal
from derive.command_line import Answer, Options, Parser, declare
from wear.commands import arguments, run_output
from wear.faults import Faults

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
    scenes, inside = options.scene, options.inside
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
    if inside is None:
        return _against_cycles(options)

    from wear.figure_data import pressure_inside
    from wear.figure_style import encoded
    from wear.figures import pressure_in_cycles

    (scene,), output = scenes, options.output
    drawn = pressure_in_cycles(pressure_inside(scene, inside))
    files.write_atomically(output, encoded(drawn, output.suffix))
    ends = [min(inside), max(inside)]
    summary = {"scene": scene.title or scene.name, "file": str(output), "cycles": ends}
    return Answer(summary, notices=scene.notices)


def _check_inside(options: Options, faults: Faults) -> None:
    """Add the faults of a request for the pressure inside cycles."""
    from wear.load import Blocks
    from wear.request import obstacle

    others = ("cycles", "until-wear", "data", "log")
    given = [f"--{name}" for name in others if getattr(options, name.replace("-", "_"))]
    if options.axis != ABSCISSAE[0]:
        given.append("--axis")
    if given:
        faults.append(f"--inside: does not go with {', '.join(given)}; leave one or the other out")
    if (number := len(options.inside)) > MOST_AT_ONCE:
        faults.append(f"--inside: {number} cycles in one figure; name up to {MOST_AT_ONCE}")
    for scene in options.scene:
        against = "the load does not repeat" if isinstance(scene.load, Blocks) else obstacle(scene)
        if against is not None:
            faults.append(f"--inside: {against}; leave --inside out")


def _against_cycles(options: Options) -> Answer:
    import numpy as np

    from wear.figure_data import Abscissa, panels_of, points_of
    from wear.figure_style import encoded
    from wear.figures import history
    from wear.life import cycles_until
    from wear.load.spans import most_cycles
    from wear.request import cycles_along
    from wear.solver import solve

    scenes, readings, limit = options.scene, options.readings, options.until_wear
    if options.cycles:
        (last,) = options.cycles
    elif readings:
        last = max(int(each.cycles[-1]) for each in readings)
    else:
        last = min(LAST, *(most_cycles(scene.load) for scene in scenes))
    if any(each.changes for each in readings):
        runs = {each.name: scenes[0].with_(each.changes) for each in readings}
    else:
        runs = {Path(scene.name).stem: scene for scene in scenes}
        if len(runs) < len(scenes):  # files of one name in several folders
            runs = {scene.name: scene for scene in scenes}
    cycles = cycles_along(1, last, POINTS, [] if options.log else np.linspace(0, last, POINTS))
    with terminal.busy("counting cycles") as tell:
        histories = [solve(scene, cycles, rtol=1e-6, progress=tell) for scene in runs.values()]
    summary = {
        "scene": histories[0].scene,
        "file": str(options.output),
        "cycles": [cycles[0], cycles[-1]],
        "scenes": list(runs),
    }
    lines: list[str] = []
    found = [[*run_output.notices_of(each)] for each in histories]
    if limit is not None:
        lives = [cycles_until(scene, limit, rtol=1e-6) for scene in runs.values()]
        summary["cycles_until"] = [float(life.cycles[0]) for life in lives]
        summary["reached"] = [life.reached[0].value for life in lives]
        for name, life, texts in zip(runs, lives, found, strict=True):
            text = run_output.life_text(life.cycles[0], life.error[0], life.reached[0].value)
            number = life.cycles[0]
            unit = "" if not math.isfinite(number) else " cycle" if number == 1 else " cycles"
            lines.append(f"{name}: {limit:g} mm: {text}{unit}")
            texts += life.notices
    notices = [
        f"{name}: {text}" if len(runs) > 1 else text
        for name, texts in zip(runs, found, strict=True)
        for text in dict.fromkeys(texts)
    ]
    arguments.strict_faults(notices, options).stop_if_any()
    abscissa = Abscissa[options.axis.upper()]
    wear, *others = panels_of(histories, tuple(runs), abscissa)
    drawn_readings = [each.first(int(np.sum(each.cycles <= last))) for each in readings]
    points = points_of([each for each in drawn_readings if len(each.cycles)], runs, abscissa)
    panels = [replace(wear, points=points, limit=limit), *others]
    drawn = history(panels, abscissa=abscissa, logarithmic=options.log)
    files.write_atomically(options.output, encoded(drawn, options.output.suffix))
    return Answer(summary, lambda: "\n".join(lines), tuple(notices))
