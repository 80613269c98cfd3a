"""`wear sensitivity`: derivatives of the wear with respect to every number of the scene.

examples:
  wear sensitivity section4                             elasticities, a table
  wear sensitivity section4 --cycles 1,9000,1e8 --json  with derivatives and error estimates
  wear sensitivity section4 --until-wear 1e-3           of the cycles to a wear depth, too
  wear sensitivity scene.toml -o tornado.png            a tornado diagram
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from derive import files, terminal
from derive.command_line import Answer, Options, Parser, declare
from wear.commands import arguments

if TYPE_CHECKING:
    from wear.sensitivities import Sensitivities


def add_arguments(parser: Parser) -> None:
    """Declare the scene, the numbers of cycles and the file."""
    arguments.add_scene(parser)
    arguments.add_cycles(parser, "numbers of cycles", "1,9000,1e8")
    arguments.add_depth(parser, "also for the number of cycles to this depth of wear")
    arguments.add_rtol(parser, 1e-13, "1e-10")
    about = "write a .csv file, or draw a tornado diagram: .png, .svg, .pdf"
    written = arguments.file(".csv", *arguments.PICTURES)
    declare(parser, "-o, --output FILE", about, type=written)


def execute(options: Options) -> Answer:
    """Compute the derivatives of the wear with respect to the numbers of a scene."""
    from wear.sensitivities import sensitivity

    faults = arguments.read(options)
    faults.stop_if_any()
    scene, cycles, rtol = options.scene, options.cycles, options.rtol
    depth, output = options.until_wear, options.output
    if depth is not None:
        from wear.life import cycles_until

        life = cycles_until(scene, depth, rtol)
        if (way := life.reached[0].value) != "counted":
            faults.append(
                f"--until-wear: {depth:g} mm: no number of cycles, so no derivative ({way})"
            )
            faults.stop_if_any()
        cycles = (*cycles, int(life.cycles[0]))
    with terminal.busy("counting cycles") as tell:
        result = sensitivity(scene, cycles, rtol, tell)
    arguments.strict_faults(result.notices, options).stop_if_any()
    if output is not None:
        files.write_atomically(output, _written(result, output.suffix))
    known = [bool(np.isfinite(column).all()) for column in result.error.T]
    late = ", ".join(str(n) for n, yes in zip(result.cycles, known, strict=True) if not yes)
    notices = (*result.notices, f"not known after {late} cycles") if late else result.notices
    status = terminal.INACCURATE if late else terminal.DONE
    return Answer(result.as_json(), lambda: "" if output else _text(result, depth), notices, status)


def _text(result: Sensitivities, depth: float | None) -> str:
    life = () if depth is None else _lines_of_life(result, depth)
    return "\n".join([repr(result), *life])


def _lines_of_life(result: Sensitivities, depth: float) -> Iterator[str]:
    """Yield the elasticities of the cycles to a wear depth, the last of all cycles."""
    width = max(len(key) for key in result.keys)
    cycles = result.cycles[-1]
    yield f"\nthe same of the {cycles} cycles to {depth:g} mm"
    for key, value, row in zip(result.keys, result.values, result.cycles_derivative, strict=True):
        shown = f"{row[-1] * value / cycles:>14.6f}" if value else f"{'-':>14}"
        yield f"{key:{width}} {value:>12.6g}{shown}"


def _written(result: Sensitivities, suffix: str) -> bytes:
    """Return the file with this suffix."""
    if suffix.lower() in arguments.PICTURES:
        from wear.figure_style import encoded
        from wear.figures import tornado

        return encoded(tornado(result.keys, result.elasticity, result.cycles), suffix)
    rows = ["key,value,cycles,bearing_wear_mm,derivative,elasticity,error_estimate"]
    for key, value, *each in zip(
        result.keys, result.values, result.derivative, result.elasticity, result.elasticity_error,
        strict=True,
    ):  # fmt: skip
        for n, wear, *numbers in zip(result.cycles, result.wear_mm, *each, strict=True):
            row = (float(value), n, float(wear), *(float(number) for number in numbers))
            rows.append(",".join([key, *map(repr, row)]))
    return ("\n".join(rows) + "\n").encode()
