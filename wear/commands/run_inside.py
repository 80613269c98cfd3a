"""`wear run --phases`: the states inside the cycles, into a file, a part at a time."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from derive import terminal
from derive.command_line import Answer, Options
from wear.faults import Faults

if TYPE_CHECKING:
    from wear.scene import Scene

SUFFIXES = (".csv", ".nc")


def check(options: Options, faults: Faults) -> None:
    """Add what stands against states inside the cycles."""
    from wear.load.spans import most_cycles
    from wear.request import obstacle

    if not options.phases.is_integer():
        faults.append(f"--phases: {options.phases:g} is no whole number")
    if options.output is None or options.output.suffix not in SUFFIXES:
        faults.append("--phases: name a .nc or .csv file with --output; there are too many states")
    if options.method not in ("auto", "abel"):
        faults.append("--phases: only the cycle count knows the states inside; leave --method out")
    for option in ("until-wear", "time-limit"):
        if getattr(options, option.replace("-", "_")) is not None:
            faults.append(f"--phases: does not go with --{option}; leave one of them out")
    if options.scene is None:
        return
    against, most = obstacle(options.scene), most_cycles(options.scene.load)
    if against is not None:
        faults.append(f"--phases: cycles cannot be counted: {against}; leave --phases out")
    elif max(options.cycles, default=0) >= most:
        faults.append(
            f"--cycles: the last cycle with phases begins after {most - 1}; the load ends"
        )


def execute(scene: Scene, cycles: Sequence[int], phases: int, rtol: float, output: Path) -> Answer:
    """Write the states inside the cycles, and tell how many they are and how accurate."""
    import numpy as np

    from wear.binding import bind
    from wear.faults import Interrupted
    from wear.history_files import States, write
    from wear.inside import fields_inside

    worst, done = 0.0, 0

    def parts() -> Iterator[States]:
        nonlocal worst, done
        at, wanted = np.arange(phases) / phases, np.array(cycles, dtype=float)
        for part in fields_inside(bind(scene), scene.load, wanted, at, rtol):
            yield States(part.cycles, part.columns(), part.phases)
            worst, done = max(worst, float(np.max(part.error))), done + len(part.cycles)

    attributes = {
        "title": " ".join((scene.title or scene.name).split()) or "untitled",
        "scene": scene.to_json(),
        "method": "abel",
        "rtol": repr(rtol),
    }
    try:
        write(parts(), output, attributes)
    except KeyboardInterrupt:
        told = f"interrupted after {done} of {len(cycles)} cycles; {output} was not written"
        raise Interrupted(told, None) from None
    document = {
        "scene": scene.title or scene.name,
        "file": str(output),
        "cycles": len(cycles),
        "phases": phases,
        "method": "abel",
        "rtol": rtol,
        "largest_error_estimate": worst,
        "notices": list(scene.notices),
    }
    if worst <= rtol:
        return Answer(document, notices=scene.notices)
    missed = f"the estimated error is {worst:.1e}, {rtol:.1e} was requested"
    return Answer(document, notices=(*scene.notices, missed), status=terminal.INACCURATE)
