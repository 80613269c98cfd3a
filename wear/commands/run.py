"""`wear run`: the state of a scene after given numbers of cycles."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from derive import completion, files, terminal
from derive.command_line import Command
from wear.commands import run_inside, run_output
from wear.commands.arguments import Faults, add_scene

if TYPE_CHECKING:
    from wear.scene import Scene

EXAMPLE = """\
  wear run section4                                    a table
  wear run section4 --cycles 1,9000,1e8 --rtol 1e-12   the wear after 1e8 cycles, 12 digits
  wear run section4 --set bearing.roughness_growth=0.3  with one entry changed
  wear run section4 --until-wear 1e-3,2e-3             cycles until 1 and 2 micrometres are worn
  wear run scene.toml --method DOP853 -o wear.csv      a scene of your own, into a file
  wear run section4 --cycles 0:8999 --phases 100 -o inside.nc        900,000 states
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_scene(parser)
    parser.add_argument(
        "--cycles",
        metavar="N,...",
        default="1,10,100,1000,10000",
        help="numbers of cycles, 0 for the fresh state; 0:9000 for all from 0 to 9000 "
        "(default: %(default)s)",
    )
    parser.add_argument(
        "--rtol",
        default="1e-10",
        help="requested relative accuracy of the bearing wear (default: %(default)s)",
    )
    method = parser.add_argument(
        "--method",
        default="auto",
        help="auto, abel, collocation (of a measured history), or an integrator of SciPy "
        "that goes through every cycle: DOP853, RK45, RK23, Radau, BDF, LSODA (default: "
        "%(default)s)",
    )
    completion.suggest(method, _methods)
    parser.add_argument(
        "--until-wear", metavar="MM,...", help="also after how many cycles the bearing has worn so"
    )
    parser.add_argument(
        "--time-limit", metavar="SECONDS", help="stop after this time and keep what was computed"
    )
    parser.add_argument(
        "--phases",
        metavar="M",
        help="write the state at M phases of the cycle that begins after each of the numbers of "
        "cycles, to a .nc or .csv file, a part at a time",
    )
    parser.add_argument(
        "-o", "--output", metavar="FILE", help="write the states to a .csv, .nc or .tex file"
    )


def execute(options: argparse.Namespace) -> int:
    from wear.faults import AccuracyError, Interrupted
    from wear.solver import obstacle, solve

    faults = Faults()
    scene = faults.scene(options)
    cycles = faults.cycles("--cycles", options.cycles)
    rtol = faults.number("--rtol", options.rtol, 1e-15, 0.1)
    method = faults.choice("--method", options.method, _methods())
    limit = None
    if options.time_limit is not None:
        limit = faults.number("--time-limit", options.time_limit, 1e-3, 1e9)
    wears = None if options.until_wear is None else _read_wears(options.until_wear, faults)
    if wears is not None and scene is not None and (against := obstacle(scene)) is not None:
        faults.add(f"--until-wear: cycles cannot be counted: {against}")
    output = None if options.output is None else _read_output(options.output, faults)
    phases = None
    if options.phases is not None:
        phases = run_inside.read_phases(options, scene, cycles, faults)
    faults.stop_if_any()
    assert scene is not None
    if phases is not None:
        assert output is not None
        return run_inside.execute(scene, cycles, phases, rtol, output, as_json=options.json)

    status, fault = terminal.DONE, ""
    try:
        with terminal.busy("counting cycles") as tell:
            history = solve(scene, cycles, rtol, method, limit, tell)
    except Interrupted as stop:
        history, status, fault = stop.history, terminal.INTERRUPTED, str(stop)
    except AccuracyError as miss:
        if miss.best is None:
            raise
        history, status, fault = miss.best, terminal.INACCURATE, str(miss)
    if options.strict:
        faults.refuse_implausible(history.notices)
        faults.stop_if_any()
    until = {} if wears is None else _cycles_until(scene, wears, rtol)
    if options.json:
        terminal.print_json(history.as_json() | until)
    elif output is None:
        print(run_output.text(history))
    if until and not options.json:
        print("\n" + run_output.until_text(until))
    if output is not None:
        run_output.write(history, output)
    for notice in (*run_output.worth_telling(history), *([fault] if fault else [])):
        terminal.complain("wear run", notice)
    return status


def _read_wears(text: str, faults: Faults) -> tuple[float, ...]:
    return tuple(
        faults.number("--until-wear", entry.strip(), 0.0, 1e300) for entry in text.split(",")
    )


def _cycles_until(scene: Scene, wears: Sequence[float], rtol: float) -> dict[str, Any]:
    """The part of the JSON with the cycles after which wears are reached, null where unknown."""
    from wear.life import cycles_until

    with terminal.busy("counting cycles to the wear"):
        found = cycles_until(scene, wears, rtol)
    return {
        "cycles_until": {
            "bearing_wear_mm": list(wears),
            "cycles": [None if math.isnan(cycles) else int(cycles) for cycles in found.cycles],
            "error_estimate": found.error,
            "reached": [way.value for way in found.reached],
        }
    }


def _read_output(name: str, faults: Faults) -> Path:
    path = Path(name)
    if path.suffix not in run_output.WRITERS:
        faults.add(f"--output: {name}: end it in {', '.join(run_output.WRITERS)}")
    else:
        problem = files.obstacle(path)
        if problem is not None:
            faults.add(f"--output: {problem}")
    return path


def _methods() -> Sequence[str]:
    from wear.solver import METHODS

    return METHODS


COMMAND = Command(
    "run", "the state of a scene after given numbers of cycles", EXAMPLE, add_arguments, execute
)
