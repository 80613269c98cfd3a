"""`wear figure`: wear, roughness and pressure of a scene against cycles."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from derive import files, terminal
from derive.command_line import Command
from wear.commands import run_output
from wear.commands.arguments import Faults, add_scene

if TYPE_CHECKING:
    from wear.history import History

SUFFIXES = (".pdf", ".png", ".svg")
POINTS = 160

EXAMPLE = """\
  wear figure section4 -o wear.pdf                          9000 cycles
  wear figure section4 -o wear.svg --cycles 1e8 --log       on a logarithmic axis
  wear figure scene.toml -o wear.png --set contact.cutoff=true
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the scene, the file and the range of cycles."""
    add_scene(parser)
    parser.add_argument(
        "-o", "--output", metavar="FILE", required=True, help="a .pdf, .png or .svg file"
    )
    parser.add_argument(
        "--cycles", metavar="N", default="9000", help="last cycle shown (default: %(default)s)"
    )
    parser.add_argument(
        "--log",
        action="store_true",
        help="logarithmic axes: of cycles, and of wear or roughness that span decades",
    )


def execute(options: argparse.Namespace) -> int:
    """Solve the scene and draw it."""
    from wear.figures import history
    from wear.report.figures_of_note import lines_of
    from wear.solver import solve

    faults = Faults()
    scene = faults.scene(options)
    last = faults.cycles("--cycles", options.cycles)
    output = Path(options.output)
    if output.suffix.lower() not in SUFFIXES:
        faults.add(f"--output: {options.output}: end it in {', '.join(SUFFIXES)}")
    elif problem := files.obstacle(output):
        faults.add(f"--output: {problem}")
    if len(last) > 1 or last == (0,):
        faults.add(f"--cycles: {options.cycles}: give one number of cycles, from 1 on")
    faults.stop_if_any()
    assert scene is not None
    found = solve(scene, shown_cycles(last[0], logarithmic=options.log), rtol=1e-6)
    drawn = history(*lines_of(found), logarithmic=options.log)
    _write(drawn, output)
    if options.json:
        terminal.print_json(_summary(found, output))
    for notice in run_output.worth_telling(found):
        terminal.complain("wear figure", notice)
    return terminal.DONE


def shown_cycles(last: int, *, logarithmic: bool) -> tuple[int, ...]:
    """Numbers of cycles up to the last one, dense where the wear changes quickly."""
    import numpy as np

    chosen = {int(cycle) for cycle in np.rint(np.geomspace(1, last, POINTS))}
    if not logarithmic:
        chosen |= {int(cycle) for cycle in np.rint(np.linspace(0, last, POINTS))}
    return tuple(sorted(chosen))


def _write(drawn: object, output: Path) -> None:
    from wear.figure_style import encoded

    files.write_atomically(output, encoded(drawn, output.suffix))  # type: ignore[arg-type]


def _summary(found: History, output: Path) -> dict[str, object]:
    return {"scene": found.scene, "file": str(output), "cycles": _ends(found.cycles.tolist())}


def _ends(cycles: Sequence[int]) -> list[int]:
    return [cycles[0], cycles[-1]]


COMMAND = Command(
    "figure", "wear, roughness and pressure against cycles", EXAMPLE, add_arguments, execute
)
