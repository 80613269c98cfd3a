"""`wear figure`: wear, roughness and pressure of a scene against cycles, or inside them."""

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
    from wear.scene import Scene

SUFFIXES = (".pdf", ".png", ".svg")
POINTS = 160
MOST_INSIDE = 7  # cycles in one figure: as many as there are colours

EXAMPLE = """\
  wear figure section4 -o wear.pdf                          9000 cycles
  wear figure section4 -o wear.svg --cycles 1e8 --log       on a logarithmic axis
  wear figure scene.toml -o wear.png --set contact.ends_at_3_sigma=true
  wear figure section4 -o pulses.svg --inside 0,10,100      the pressure within three cycles
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
    parser.add_argument(
        "--inside",
        metavar="N,...",
        help="instead: the contact pressure within the cycles that begin after these numbers of "
        "cycles, 0 for the first",
    )


def execute(options: argparse.Namespace) -> int:
    """Solve the scene and draw it."""
    faults = Faults()
    scene = faults.scene(options)
    last = faults.cycles("--cycles", options.cycles)
    inside = None if options.inside is None else faults.cycles("--inside", options.inside)
    output = Path(options.output)
    if output.suffix.lower() not in SUFFIXES:
        faults.add(f"--output: {options.output}: end it in {', '.join(SUFFIXES)}")
    elif problem := files.obstacle(output):
        faults.add(f"--output: {problem}")
    if len(last) > 1 or last == (0,):
        faults.add(f"--cycles: {options.cycles}: give one number of cycles, from 1 on")
    if inside is not None:
        _check_inside(inside, scene, faults)
    faults.stop_if_any()
    assert scene is not None
    if inside is not None:
        return _pressure_inside(scene, inside, output, as_json=options.json)
    return _against_cycles(scene, last[0], output, options)


def _against_cycles(scene: Scene, last: int, output: Path, options: argparse.Namespace) -> int:
    from wear.figures import history
    from wear.report.figures_of_note import lines_of
    from wear.solver import solve

    found = solve(scene, shown_cycles(last, logarithmic=options.log), rtol=1e-6)
    drawn = history(*lines_of(found), logarithmic=options.log)
    _write(drawn, output)
    if options.json:
        terminal.print_json(_summary(found.scene, found.cycles.tolist(), output))
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


def _check_inside(inside: Sequence[int], scene: Scene | None, faults: Faults) -> None:
    from wear.load import Blocks
    from wear.solver import obstacle

    if len(inside) > MOST_INSIDE:
        faults.add(f"--inside: {len(inside)} cycles in one figure; name up to {MOST_INSIDE}")
    if scene is None:
        return
    against = "the load does not repeat" if isinstance(scene.load, Blocks) else obstacle(scene)
    if against is not None:
        faults.add(f"--inside: {against}; leave --inside out")


def _pressure_inside(scene: Scene, inside: Sequence[int], output: Path, *, as_json: bool) -> int:
    from wear.figure_data import pressure_inside
    from wear.figures import pressure_in_cycles

    _write(pressure_in_cycles(pressure_inside(scene, inside)), output)
    if as_json:
        terminal.print_json(_summary(scene.title or scene.name, sorted(inside), output))
    for notice in scene.notices:
        terminal.complain("wear figure", notice)
    return terminal.DONE


def _summary(scene: str, cycles: Sequence[int], output: Path) -> dict[str, object]:
    return {"scene": scene, "file": str(output), "cycles": [cycles[0], cycles[-1]]}


COMMAND = Command(
    "figure", "wear, roughness and pressure against cycles", EXAMPLE, add_arguments, execute
)
