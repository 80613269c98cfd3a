"""`wear run`: the state of a scene after given numbers of cycles.

examples:
  wear run section4                                    a table
  wear run section4 --cycles 1,9000,1e8 --rtol 1e-12   the wear after 1e8 cycles, 12 digits
  wear run section4 --set bearing.roughness_growth=0.3  with one entry changed
  wear run section4 --until-wear 1e-3,2e-3             cycles to a wear of 1 and 2 micrometres
  wear run scene.toml --method DOP853 -o wear.csv      a scene of your own, into a file
  wear run section4 --cycles 0:8999 --phases 100 -o inside.nc        900,000 states
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from derive import files, terminal
from derive.command_line import Answer, Options, Parser, declare
from wear.commands import arguments, run_output
from wear.faults import Faults

if TYPE_CHECKING:
    from wear.scene import Scene

_OF_PHASES = (".csv", ".nc")
"""Files of the states inside the cycles, which are written a part at a time."""


def add_arguments(parser: Parser) -> None:
    arguments.add_scene(parser)
    about = "numbers of cycles, 0 for the initial state; 0:9000 for all from 0 to 9000"
    arguments.add_cycles(parser, about, "1,10,100,1000,10000")
    arguments.add_rtol(parser, 1e-15, "1e-10", " of the bearing wear")
    about = (
        "auto, abel, collocation (of a measured history), or an integrator of SciPy "
        "that integrates every cycle: DOP853, RK45, RK23, Radau, BDF, LSODA (default: "
        "%(default)s)"
    )
    arguments.add_choice(parser, "--method METHOD", _methods, about, default="auto")
    about = "also print the number of cycles to these depths of wear"
    declare(parser, "--until-wear MM,...", about, type=_depths)
    about = "stop after this time and keep what was computed"
    declare(parser, "--time-limit SECONDS", about, type=arguments.number(1e-3, 1e9))
    about = (
        "write the state at M phases of the cycle that begins after each of the numbers of "
        "cycles, to a .nc or .csv file, a part at a time"
    )
    declare(parser, "--phases M", about, type=arguments.whole(1, 10**6))
    about = "write the states to a .csv, .nc or .tex file"
    declare(parser, "-o, --output FILE", about, type=arguments.file(".csv", ".nc", ".tex"))


def execute(options: Options) -> Answer:
    from wear.faults import AccuracyError, Interrupted
    from wear.life import cycles_until
    from wear.request import ONE_PERIOD, obstacle
    from wear.solver import solve

    faults = arguments.read(options)
    if options.until_wear and options.scene and (against := obstacle(options.scene)):
        faults.append(f"--until-wear: cycles cannot be counted: {against}; {ONE_PERIOD}")
    if options.phases is not None:
        _check_inside(options, faults)
    faults.stop_if_any()
    scene, cycles, rtol = options.scene, options.cycles, options.rtol
    wears, output = options.until_wear, options.output
    if options.phases is not None:
        return _inside(scene, cycles, options.phases, rtol, output)

    status, faulty = terminal.DONE, list[str]()
    try:
        with terminal.busy("counting cycles") as tell:
            history = solve(scene, cycles, rtol, options.method, options.time_limit, tell)
    except Interrupted as stop:
        history, status, faulty = stop.history, terminal.INTERRUPTED, [str(stop)]
    except AccuracyError as miss:
        if miss.best is None:
            raise
        history, status, faulty = miss.best, terminal.INACCURATE, [str(miss)]
    document, notices = history.as_json(), [*run_output.notices_of(history), *faulty]
    parts = [run_output.text(history)] if output is None else []
    life = None
    if wears is not None and status is not terminal.INTERRUPTED:
        try:
            with terminal.busy("counting cycles to the wear"):
                life = cycles_until(scene, wears, rtol)
        except KeyboardInterrupt:  # the history is kept
            status = terminal.INTERRUPTED
            notices.append("interrupted before the cycles to the wear were counted")
    if life is not None:
        document["cycles_until"] = {
            "bearing_wear_mm": list(life.wear_mm),
            "cycles": [None if math.isnan(cycles) else int(cycles) for cycles in life.cycles],
            "error_estimate": life.error,
            "reached": [way.value for way in life.reached],
        }
        more = [text for text in life.notices if text not in history.notices]
        document["notices"] = [*history.notices, *more]
        notices += more
        parts.append(f"\n{run_output.until_text(life)}")
    arguments.strict_faults(notices, options).stop_if_any()
    if output is not None and output.suffix == ".tex":
        files.write_atomically(output, run_output.latex(history))
    elif output is not None:
        history.write(output)
    return Answer(document, lambda: "\n".join(parts), notices, status)


def _depths(text: str) -> tuple[float, ...]:
    return tuple(map(arguments.number(0.0, 1e300), text.split(",")))


def _methods() -> Sequence[str]:
    from wear.request import METHODS

    return METHODS


def _check_inside(options: Options, faults: Faults) -> None:
    """Add the faults of a request for states inside the cycles."""
    from wear.load.spans import most_cycles

    misnamed = options.output is not None and options.output.suffix not in _OF_PHASES
    if misnamed or (options.output is None and not any("--output" in fault for fault in faults)):
        faults.append("--phases: name a .nc or .csv file with --output; there are too many states")
    if options.method != "auto":
        faults.append("--phases: the load decides on the method; drop --method")
    for option in ("until-wear", "time-limit"):
        if getattr(options, option.replace("-", "_")) is not None:
            faults.append(f"--phases: does not go with --{option}; leave one of them out")
    if options.scene is None:
        return
    most = most_cycles(options.scene.load)
    if max(options.cycles or (), default=0) >= most:
        faults.append(
            f"--cycles: the last cycle with phases begins after {most - 1}; the load ends"
        )


def _inside(scene: Scene, cycles: Sequence[int], phases: int, rtol: float, output: Path) -> Answer:
    """Write the states inside the cycles, and return their number and accuracy."""
    import numpy as np

    from wear.faults import Interrupted
    from wear.history_files import States, title_attribute, write
    from wear.inside import fields_inside
    from wear.records import METHOD
    from wear.request import obstacle

    worst, done, method = 0.0, 0, "abel" if obstacle(scene) is None else METHOD

    def parts() -> Iterator[States]:
        nonlocal worst, done
        for part in fields_inside(scene, cycles, np.arange(phases) / phases, rtol):
            yield States(part.cycles, part.columns(), part.phases)
            worst, done = max(worst, float(np.max(part.error))), done + len(part.cycles)

    attributes = {
        "title": title_attribute(scene.title or scene.name),
        "scene": scene.to_json(),
        "method": method,
        "rtol": repr(rtol),
    }
    try:
        write(parts(), output, attributes)
    except KeyboardInterrupt:
        message = f"interrupted after {done} of {len(cycles)} cycles; {output} was not written"
        raise Interrupted(message, None) from None
    document = {
        "scene": scene.title or scene.name,
        "file": str(output),
        "cycles": len(cycles),
        "phases": phases,
        "method": method,
        "rtol": rtol,
        "largest_error_estimate": worst,
        "notices": list(scene.notices),
    }
    if worst <= rtol:
        return Answer(document, notices=scene.notices)
    missed = f"the estimated error is {worst:.1e}, {rtol:.1e} was requested"
    return Answer(document, notices=(*scene.notices, missed), status=terminal.INACCURATE)
