"""Arguments that commands share, and their faults: a scene, numbers of cycles, bounded numbers.

A text is read by the `type` of its argument; the scene and its readings by `read`, when all options
are known. A command reports the faults of all its arguments and of its scene in one message.
"""

from __future__ import annotations

import math
import re
from argparse import ArgumentTypeError
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from derive import files
from derive.command_line import Options, Parser, declare
from wear.faults import Faults
from wear.quantities import MOST_CYCLES
from wear.words import did_you_mean, shown

if TYPE_CHECKING:
    from wear.fitting.readings import Specimen
    from wear.scene import Scene


MOST_IN_RANGE = 1_000_000  # numbers of cycles
PICTURES = (".pdf", ".png", ".svg")
_THOUSANDS = re.compile(r"0\d+|\d{1,3}(\.\d{3})+")
"""The parts of 9,000 at its comma, and 9.000: not to be read as 9 and 0, or as 9."""


def add_scene(parser: Parser, default: str | None = None, *, several: bool = False) -> None:
    """Declare the scene or scenes, optional if there is a default, `--set` and `--strict`."""
    about = "a built-in scene (wear scenes lists them) or a TOML file"
    if default is not None:
        about += f" (default: {default})"
    usage = "SCENE ..." if several else "SCENE" if default is None else "[SCENE]"
    declare(parser, usage, about, built_in_names, default=default)
    about = "override one entry of the scene, as in bearing.hardness_MPa=200; may be repeated"
    kept: dict[str, Any] = {"action": "append", "default": [], "dest": "overrides"}
    declare(parser, "--set TABLE.KEY=VALUE", about, _entries, **kept)
    about = "refuse implausible values with status 2 (otherwise they give notices)"
    declare(parser, "--strict", about)


def built_in_names() -> Sequence[str]:
    """Return the names of the built-in scenes."""
    from wear.scene import builtin_names

    return builtin_names()


def _entries() -> Sequence[str]:
    """Return completions of `--set`, without those of the load, whose keys vary."""
    from wear.scene.tables import Bearing, Contact, Motion, Pin, Support

    tables = (Bearing, Pin, Contact, Support, Motion)
    return [f"{table.place}.{name}=" for table in tables for name in table.entries]


def add_readings(parser: Parser, help: str) -> None:
    """Declare a file of readings of the scene, which `read` puts into `options.readings`."""
    parser.set_defaults(readings=())
    declare(parser, "--data FILE.csv", help)


def one_of(choices: Callable[[], Sequence[str]]) -> Callable[[str], str]:
    """Return a reader of one of these words, in upper or lower case."""

    def chosen(text: str) -> str:
        exact = {choice.lower(): choice for choice in choices()}
        if text.lower() in exact:
            return exact[text.lower()]
        known = f"choose one of {', '.join(choices())}"
        if meant := did_you_mean(text, choices()):
            known = f"did you mean {meant}? ({known})"
        raise ArgumentTypeError(f'"{shown(text)}" is unknown; {known}')

    return chosen


def add_choice(
    parser: Parser,
    usage: str,
    choices: Callable[[], Sequence[str]],
    help: str,
    **about: Any,
) -> None:
    """Declare a choice among words, which shells complete."""
    declare(parser, usage, help, choices, type=one_of(choices), **about)


def add_rtol(parser: Parser, low: float, default: str, of: str = " of the wear") -> None:
    """Declare the requested accuracy, with its lower limit."""
    about = f"requested relative accuracy{of} (default: %(default)s)"
    declare(parser, "--rtol RTOL", about, type=number(low, 0.1), default=default)


def add_cycles(
    parser: Parser,
    help: str,
    usual: str | None = None,
    usage: str = "--cycles N,...",
) -> None:
    """Declare numbers of cycles; the usual ones are those up to the end of the load."""
    if usual is not None:
        help += f" (default: {usual}, to the end of the load)"
        parser.set_defaults(usual_cycles=cycles(usual))
    declare(parser, usage, help, type=cycles)


def add_depth(parser: Parser, help: str) -> None:
    """Declare a wear depth in mm."""
    declare(parser, "--until-wear MM", help, type=number(1e-30, 1e30))


def add_folder(parser: Parser, help: str, default: str | None = None) -> None:
    """Declare the output folder."""
    declare(parser, "-o, --output DIR", help, type=folder, default=default)


def cycles(text: str) -> tuple[int, ...]:
    """Return numbers of cycles, 0 for the initial state, from a list of numbers and ranges.

    >>> cycles("1, 10:13,1e8")
    (1, 10, 11, 12, 13, 100000000)
    """
    parts = text.split(",")
    ends = [tuple(map(_number, entry.split(":"))) for entry in parts]
    wrong = [
        entry.strip()
        for entry, pair in zip(parts, ends, strict=True)
        if len(pair) > 2
        or _THOUSANDS.fullmatch(entry.strip())
        or not all(0 <= number <= MOST_CYCLES and number.is_integer() for number in pair)
        or not 0 <= pair[-1] - pair[0] < MOST_IN_RANGE
    ]
    if wrong:
        entries = ", ".join(f'"{shown(entry)}"' for entry in wrong[:10])
        entries += ", ..." * (len(wrong) > 10)
        raise ArgumentTypeError(
            f"{entries}: not a number of cycles, or not a rising range; "
            f"give whole numbers from 0 to {MOST_CYCLES:.0e} and ranges of up to "
            f"{MOST_IN_RANGE:.0e}, such as 1,9000,1e8 or 0:9000"
        )
    return tuple(n for pair in ends for n in range(int(pair[0]), int(pair[-1]) + 1))


def number(low: float, high: float) -> Callable[[str], float]:
    """Return a reader of a number within bounds.

    >>> number(1e-15, 0.1)("1e-10")
    1e-10
    """

    def bounded(text: str) -> float:
        value = _number(text)
        if not low <= value <= high:
            raise ArgumentTypeError(f'"{shown(text)}" is not a number from {low:g} to {high:g}')
        return value

    return bounded


def whole(low: int, high: int) -> Callable[[str], int]:
    """Return a reader of a whole number within bounds.

    >>> whole(1, 1024)("1e3"), whole(0, 2**63)("9007199254740993")
    (1000, 9007199254740993)
    """

    def bounded(text: str) -> int:
        found = int(text) if text.strip().isdecimal() else _number(text)
        if not low <= found <= high or found != int(found):
            of = f"a whole number from {low:g} to {high:g}"
            raise ArgumentTypeError(f'"{shown(text)}" is not {of}')
        return int(found)

    return bounded


def file(*suffixes: str) -> Callable[[str], Path]:
    """Return a reader of the name of an output file, with one of these suffixes; those of pictures
    may be in capitals."""

    def place(text: str) -> Path:
        suffix = Path(text).suffix
        if suffix not in suffixes and suffix.lower() not in {*suffixes} & {*PICTURES}:
            raise ArgumentTypeError(f"{text}: end it in {', '.join(suffixes)}")
        if problem := files.obstacle(text):
            raise ArgumentTypeError(problem)
        return Path(text)

    return place


def folder(text: str) -> Path:
    """Return an output folder, which is made if it is missing."""
    if problem := files.obstacle_to_folder(text):
        raise ArgumentTypeError(problem)
    return Path(text)


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan


def strict_faults(notices: Sequence[str], options: Options) -> Faults:
    """Return the notices of implausible magnitudes as faults, none without `--strict`."""
    from wear.scene.notices import WORD

    return Faults(text for text in notices if options.strict and text.startswith(WORD))


def read(options: Options) -> Faults:
    """Replace the names of the scenes and readings by these; return the faults of all arguments.

    An argument with faults is None; a command stops at faults before it uses values.
    """
    from wear.faults import SceneError
    from wear.load.spans import most_cycles
    from wear.scene import load_scene

    faults = Faults(options.faults)
    scenes: list[Scene] = []
    names = getattr(options, "scene", [])
    for name in names if isinstance(names, list) else [names]:
        try:
            scenes.append(load_scene(name, options.overrides))
            faults += strict_faults(scenes[-1].notices, options)
        except SceneError as fault:
            faults.append(str(fault))
    options.scene = scenes if isinstance(names, list) else next(iter(scenes), None)
    if "usual_cycles" in options and options.cycles is None:
        most = min((most_cycles(scene.load) for scene in scenes), default=0)
        if getattr(options, "phases", None) is not None:
            most -= 1  # of the cycle that begins then
        options.cycles = tuple(dict.fromkeys(min(n, most) for n in options.usual_cycles))
    if "readings" in options and options.data is not None:
        options.readings = _readings(options.data, scenes, faults)
    return faults


def _readings(file: str, scenes: Sequence[Scene], faults: Faults) -> tuple[Specimen, ...]:
    """Return the readings of a CSV file; its entries of the scene are tried in the first scene."""
    from wear.faults import WearError
    from wear.fitting.readings import read_readings

    try:
        specimens = read_readings(file)
        for scene in scenes[:1]:
            for each in specimens:
                scene.with_(each.changes)
    except WearError as fault:
        faults.append(f"--data: {fault}")
        return ()
    return specimens
