"""The terminal of both commands: exit status, errors without traceback, JSON, `--version`.

Every command imports this module at its start, so it imports the standard library alone.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import shutil
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from derive import completion

DONE = 0
FAILED = 1  # a verification does not hold
USAGE = 2  # bad usage, bad scene, a file that cannot be read or written
INACCURATE = 3  # the requested accuracy was not reached
INTERRUPTED = 130
MOMENT = 0.05  # s, after which a lost Ctrl-C is repeated
SILENT, APART = 2.0, 0.5  # s, before the current activity is shown, and between two updates


def run(
    name: str,
    main: Callable[[], int],
    expected: Mapping[type[Exception], int],
) -> int:
    """Run a command and return its exit status.

    Parameters
    ----------
    name
        The prefix of error messages.
    main
        Does the work, prints the results and returns the exit status.
    expected
        Exceptions that the user can mend, with the exit status of each. Their text is
        printed without a traceback. An `OSError` is always among them.
    """
    _prepare_output()
    status = DONE
    try:
        with _no_interrupt_lost():
            status = main()
        sys.stdout.flush()
    except BrokenPipeError:
        pass  # the reader (`head`, `less`) has seen enough
    except KeyboardInterrupt:
        complain(name, "interrupted")
        status = INTERRUPTED
    except OSError as fault:
        place = "" if fault.filename is None else f"{fault.filename}: "
        complain(name, place + (fault.strerror or str(fault)))
        status = USAGE
    except tuple(expected) as fault:
        complain(name, str(fault))
        status = next(code for kind, code in expected.items() if isinstance(fault, kind))
    finally:
        _discard_output()
    return status


@contextmanager
def _no_interrupt_lost() -> Iterator[None]:
    """Repeat a Ctrl-C that Python drops because it comes within a destructor."""
    before = sys.unraisablehook

    def hook(dropped: sys.UnraisableHookArgs) -> None:
        if issubclass(dropped.exc_type, KeyboardInterrupt):
            # A signal ends what the main thread waits for, too.
            again = threading.main_thread().ident, signal.SIGINT
            threading.Timer(MOMENT, signal.pthread_kill, again).start()
        else:
            before(dropped)

    sys.unraisablehook = hook
    try:
        yield
    finally:
        sys.unraisablehook = before


def complain(name: str, message: str) -> None:
    """Print an error, which may have several lines, to standard error."""
    progress("")
    print(f"{name}: {message}", file=sys.stderr)


def progress(activity: str) -> None:
    """Show an activity on one line of a terminal, nothing elsewhere; '' clears the line."""
    if sys.stderr.isatty() and os.environ.get("TERM") != "dumb":
        width = shutil.get_terminal_size().columns - 1
        print(f"\r\033[K{activity[:width]}", end="", file=sys.stderr, flush=True)


@contextmanager
def busy(activity: str) -> Iterator[Callable[[str], None]]:
    """Show an activity and its duration on a terminal if it takes more than two seconds.

    Yields a function that replaces the text of the activity.
    """
    begun, shown, done = time.monotonic(), [activity], threading.Event()

    def show(text: str) -> None:
        shown[0] = text

    def tick() -> None:
        wait = SILENT
        while not done.wait(wait):
            progress(f"{shown[0]} ({time.monotonic() - begun:.0f} s)")
            wait = APART

    clock = threading.Thread(target=tick, daemon=True)
    clock.start()
    try:
        yield show
    finally:
        done.set()
        clock.join()
        progress("")


def shows_formulas() -> bool:
    """Return whether standard output can encode the characters of drawn formulas."""
    try:
        "\u239b\u2500\u03c3\u221e".encode(sys.stdout.encoding or "ascii")
    except UnicodeEncodeError:
        return False
    return True


def json_text(document: object) -> str:
    """Return one JSON document. Floats keep all their digits.

    Arrays become lists. NaN and infinity, which JSON lacks, become `null`.

    >>> print(json_text({"wear_mm": (1e-07, 0.1 + 0.2), "arrest_cycle": math.nan}), end="")
    {
      "wear_mm": [
        1e-07,
        0.30000000000000004
      ],
      "arrest_cycle": null
    }
    """
    return json.dumps(plain(document), indent=2, allow_nan=False) + "\n"


def plain(value: object) -> Any:
    """Return `value` in the types of JSON.

    >>> plain({"cycles": (1, 2.5), "error": math.inf})
    {'cycles': [1, 2.5], 'error': None}
    """
    if hasattr(value, "tolist"):  # NumPy's arrays and scalars
        value = value.tolist()
    match value:
        case float():
            return value if math.isfinite(value) else None
        case None | bool() | int() | str():
            return value
        case Mapping():
            return {str(key): plain(entry) for key, entry in value.items()}
        case list() | tuple():
            return [plain(entry) for entry in value]
        case os.PathLike():
            return os.fspath(value)
    raise TypeError(f"{type(value).__name__} has no form in JSON")


def table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Return rows of text in right-aligned columns, below headers of one or more lines.

    Columns beyond the width of a terminal follow below, beside the first column again.

    >>> print(table(["cycle", "wear\\n(mm)"], [["1", "1e-05"], ["100", "0.001"]]))
            wear
    cycle   (mm)
        1  1e-05
      100  0.001
    """
    heads = [head.splitlines() for head in header]
    height = max(map(len, heads))
    columns = [
        [""] * (height - len(head)) + head + [row[place] for row in rows]
        for place, head in enumerate(heads)
    ]
    aligned = [[entry.rjust(max(map(len, column))) for entry in column] for column in columns]
    room = shutil.get_terminal_size().columns if sys.stdout.isatty() else math.inf
    blocks = [aligned[:1]]
    for column in aligned[1:]:
        if sum(len(each[0]) + 2 for each in blocks[-1]) + len(column[0]) > room:
            blocks.append(aligned[:1])
        blocks[-1] = [*blocks[-1], column]
    lines = (zip(*block, strict=True) for block in blocks)
    return "\n\n".join("\n".join("  ".join(x).rstrip() for x in block) for block in lines)


def count(number: int, noun: str) -> str:
    """Return a number and a noun, in the plural unless the number is one.

    >>> count(1, "equation"), count(2, "equation")
    ('1 equation', '2 equations')
    """
    return f"{number} {noun}{'' if number == 1 else 's'}"


class PrintAndStop(argparse.Action):
    """An option like `--version`: prints the text that its constant makes of the parser."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        print(self.const(parser))
        parser.exit()


def add_common_options(parser: argparse.ArgumentParser) -> None:
    """Give the parser of a whole command `--version` and `--print-completion`."""
    about = "print the version and stop"
    parser.add_argument("--version", action=PrintAndStop, nargs=0, const=_version, help=about)
    about = "print a completion script for bash and zsh and stop"
    script = completion.bash
    parser.add_argument(
        "--print-completion", action=PrintAndStop, nargs=0, const=script, help=about
    )


def _version(parser: argparse.ArgumentParser) -> str:
    from importlib.metadata import version  # slower to import than the rest of this module

    return f"{parser.prog} {version('derive-wear')}"


def _prepare_output() -> None:
    """Make printing safe where the terminal's encoding lacks a character, and where the command
    was started with its output closed."""
    sys.stdout = sys.stdout or Path(os.devnull).open("w", encoding="utf-8")  # noqa: SIM115
    sys.stderr = sys.stderr or Path(os.devnull).open("w", encoding="utf-8")  # noqa: SIM115
    for stream in (sys.stdout, sys.stderr):
        reconfigure = getattr(stream, "reconfigure", None)
        if reconfigure is not None:
            reconfigure(errors="backslashreplace")


def _discard_output() -> None:
    """Discard output that cannot be written; else the interpreter would complain at its exit."""
    try:
        sys.stdout.flush()
    except OSError:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)
