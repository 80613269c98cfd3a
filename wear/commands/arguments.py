"""Arguments that commands share, and their faults: a scene, numbers of cycles, bounded numbers.

Texts are read after parsing, by methods that remember what is wrong, so that a command can report
the faults of all its arguments and of its scene in one message.
"""

from __future__ import annotations

import argparse
import math
import re
from collections.abc import Sequence
from typing import TYPE_CHECKING

from derive import completion

if TYPE_CHECKING:
    from wear.fitting.readings import Specimen
    from wear.scene import Scene


MOST_IN_RANGE = 1_000_000  # numbers of cycles
_THOUSANDS = re.compile(r"0\d+")  # what a comma leaves of 9,000: not to be read as 9 and 0


def add_scene(
    parser: argparse.ArgumentParser, default: str | None = None, *, several: bool = False
) -> None:
    """Declare the scene or scenes, which may be left out if there is a default, and `--set`."""
    about = "a built-in scene (wear scenes lists them) or a TOML file"
    scene = parser.add_argument(
        "scene",
        metavar="SCENE",
        nargs="+" if several else None if default is None else "?",
        default=default,
        help=about if default is None else f"{about} (default: {default})",
    )
    completion.suggest(scene, built_in_names)
    overrides = parser.add_argument(
        "--set",
        metavar="TABLE.KEY=VALUE",
        action="append",
        default=[],
        dest="overrides",
        help="override one entry of the scene, as in bearing.hardness_MPa=200; may be repeated",
    )
    completion.suggest(overrides, _entries)
    parser.add_argument(
        "--strict",
        action="store_true",
        help="refuse what is legal but implausible (a notice otherwise), with status 2",
    )


def built_in_names() -> Sequence[str]:
    """Return the names of the built-in scenes."""
    from wear.scene import builtin_names

    return builtin_names()


def _entries() -> Sequence[str]:
    """Return the beginnings of what `--set` takes, but for the load, whose keys vary."""
    from wear.scene import Bearing, Contact, Motion, Pin, Support

    tables = (Bearing, Pin, Contact, Support, Motion)
    return [f"{table.place}.{name}=" for table in tables for name in table.entries]


class Faults:
    """The faults of a command line, gathered until `stop_if_any`."""

    def __init__(self) -> None:
        self._messages: list[str] = []

    def add(self, message: str) -> None:
        """Remember one more fault."""
        self._messages.append(message)

    def stop_if_any(self) -> None:
        """Raise a `UsageError` that tells them all, a line each."""
        from wear.faults import UsageError

        if self._messages:
            raise UsageError("\n".join(self._messages))

    def scene(self, options: argparse.Namespace) -> Scene | None:
        """Return the scene that the options name, None if it has faults."""
        return self._loaded(options.scene, options)

    def scenes(self, options: argparse.Namespace) -> list[Scene]:
        """Return the scenes that the options name, without those that have faults."""
        found = (self._loaded(name, options) for name in options.scene)
        return [scene for scene in found if scene is not None]

    def _loaded(self, name: str, options: argparse.Namespace) -> Scene | None:
        from wear.faults import SceneError
        from wear.scene import load_scene

        try:
            scene = load_scene(name, options.overrides)
        except SceneError as fault:
            self.add(str(fault))
            return None
        if options.strict:
            self.refuse_implausible(scene.notices)
        return scene

    def readings(self, file: str, scenes: Sequence[Scene]) -> tuple[Specimen, ...]:
        """Return the readings of a CSV file, none if it has faults; entries of the scene that the
        file names are tried in the first."""
        from wear.faults import WearError
        from wear.fitting.readings import read_readings

        try:
            found = read_readings(file)
            for scene in scenes[:1]:
                for each in found:
                    scene.with_(each.changes)
        except WearError as fault:
            self.add(f"--data: {fault}")
            return ()
        return found

    def refuse_implausible(self, notices: Sequence[str]) -> None:
        """Make faults of the notices about magnitudes that are hardly meant."""
        from wear.scene.plausibility import WORD

        self._messages += [notice for notice in notices if notice.startswith(WORD)]

    def cycles(self, name: str, text: str) -> tuple[int, ...]:
        """Return numbers of cycles, 0 being the fresh state, from a list of numbers and ranges.

        >>> Faults().cycles("--cycles", "1, 10:13,1e8")
        (1, 10, 11, 12, 13, 100000000)
        """
        from wear.solver import MOST_CYCLES

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
            entries = ", ".join(map(_quoted, wrong[:10])) + (", ..." if len(wrong) > 10 else "")
            self.add(
                f"{name}: {entries}: no number of cycles; "
                f"give whole numbers from 0 to {MOST_CYCLES:.0e} and ranges of up to "
                f"{MOST_IN_RANGE:.0e}, such as 1,9000,1e8 or 0:9000"
            )
            return ()
        return tuple(n for pair in ends for n in range(int(pair[0]), int(pair[-1]) + 1))

    def number(self, name: str, text: str, low: float, high: float) -> float:
        """Return a number within bounds.

        >>> Faults().number("--rtol", "1e-10", 1e-15, 0.1)
        1e-10
        """
        number = _number(text)
        if not low <= number <= high:
            self.add(f"{name}: {_quoted(text)} is no number from {low:g} to {high:g}")
        return number

    def choice(self, name: str, text: str, choices: Sequence[str]) -> str:
        """Return one of these words, whatever the case of its letters."""
        from wear.checked import did_you_mean

        exact = {choice.lower(): choice for choice in choices}
        if text.lower() not in exact:
            meant = did_you_mean(text, choices)
            hint = f"; did you mean {meant}?" if meant else ""
            known = f"choose one of {', '.join(choices)}"
            end = f"{hint} ({known})" if hint else f"; {known}"
            self.add(f"{name}: {_quoted(text)} is unknown{end}")
        return exact.get(text.lower(), text)


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan


def _quoted(text: str) -> str:
    from wear.checked import shown

    return f'"{shown(text)}"'
