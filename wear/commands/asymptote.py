"""`wear asymptote`: the long-term behaviour of the wear.

examples:
  wear asymptote section4           regime, wear per cycle, pressure, logarithm
  wear asymptote section4-cutoff    where and in which cycle the wear stops
  wear asymptote section4 --set bearing.roughness_growth=0.3 --json
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import asdict
from typing import TYPE_CHECKING

from derive import terminal
from derive.command_line import Answer, Options, Parser
from wear.commands import arguments

if TYPE_CHECKING:
    from wear.regime import Asymptote


_LABELS: Mapping[str, tuple[str, str]] = {
    "regime": ("regime", ""),
    "tanh_argument": ("limit of the argument of tanh", ""),
    "wear_per_cycle_mm": ("wear per cycle", "mm"),
    "pressure_MPa": ("contact pressure", "MPa"),
    "log_coefficient_mm": ("coefficient of ln N", "mm"),
    "offset_mm": ("offset", "mm"),
    "saturation_wear_mm": ("wear saturates at", "mm"),
    "arrest_wear_mm": ("wear stops at", "mm"),
    "arrest_cycle": ("wear stops in cycle", ""),
}
_AFTER = {
    "mean_rate_within_1e-6": "wear per cycle within 1e-6 after",
    "rate_within_1e-6": "rate at every phase within 1e-6 after",
}


def add_arguments(parser: Parser) -> None:
    """Declare the scene."""
    arguments.add_scene(parser)


def execute(options: Options) -> Answer:
    """Print the regime of a scene and its constants."""
    from wear.regime import asymptote

    arguments.read(options).stop_if_any()
    with terminal.busy("seeking the asymptote"):
        result = asymptote(options.scene)
    arguments.strict_faults(result.notices, options).stop_if_any()
    notices = () if options.json else result.notices  # the document has them
    return Answer(asdict(result), lambda: "\n".join(_lines(result)), notices)


def _lines(result: Asymptote) -> Iterator[str]:
    """Yield the constants that apply, a line each."""
    rows = [
        (label, value, unit)
        for name, (label, unit) in _LABELS.items()
        if (value := getattr(result, name)) is not None
    ]
    rows += [
        (_AFTER[name], cycles, "cycles")
        for name, cycles in result.cycles_to_stabilise.items()
        if cycles is not None
    ]
    width = max(len(label) for label, _, _ in rows)
    for label, value, unit in rows:
        shown = f"{value:.10g}" if isinstance(value, float) else str(value)
        yield f"{label:{width}}  {shown} {unit}".rstrip()
