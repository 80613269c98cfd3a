"""What is wrong with what a user gave, in words: the problem, and the remedy."""

from __future__ import annotations

import difflib
import math
import os
from collections.abc import Iterable, Mapping

from wear.quantities import LARGEST, SMALLEST


def shown(text: str, most: int = 60) -> str:
    """Return `text` fit for a terminal: one line, no control characters, at most so long.

    >>> shown("a\\x1b[31mb")
    'a\\\\x1b[31mb'
    """
    cut = text if len(text) <= most else text[: most - 3] + "..."
    return "".join(c if c.isprintable() else f"\\x{ord(c):02x}" for c in cut)


def is_path(given: object) -> bool:
    """Return whether something can be the name of a file."""
    return isinstance(given, str | os.PathLike)


def did_you_mean(word: str, candidates: Iterable[str]) -> str:
    """Return the candidate that `word` seems to stand for, or ''.

    >>> did_you_mean("stifness", ["stiffness", "hardness"])
    'stiffness'
    """
    by_lower = {candidate.lower(): candidate for candidate in candidates}
    close = difflib.get_close_matches(word[:80].lower(), by_lower, n=1)
    return by_lower[close[0]] if close else ""


def of_number(raw: object, domain: str, unit: str) -> tuple[str, str]:
    """Return what is wrong with a number, or with what is none, and the remedy."""
    ending = f", in {unit}" if unit else ""
    if isinstance(raw, str):
        if _reads_as_number(raw):
            return f'"{shown(raw)}" is text, not a number', "drop the quotes"
        return f'"{shown(raw)}" is text', f"give a number{ending}, such as 0.5 or 1e-6"
    wanted = f"give a number {domain}{ending}" if domain else f"give any finite number{ending}"
    if isinstance(raw, bool) or not isinstance(raw, int | float):
        return f"is {kind_of(raw)}", f"give a number{ending}"
    try:
        number = float(raw)
    except OverflowError:
        return "is a whole number too large for a float", wanted
    if not math.isfinite(number):
        return f"{number} is not a finite number", wanted
    if number < 0.0 and domain:
        return f"{number!r} is negative", wanted
    if number == 0.0:
        return "is zero", wanted
    bounds = f"magnitudes lie from {SMALLEST:g} to {LARGEST:g}"
    return f"{number!r} is out of range", f"{wanted}; {bounds}"


def kind_of(raw: object) -> str:
    """Return what a value is, in words for the user."""
    kinds: dict[type | tuple[type, ...], str] = {
        bool: "true or false", (int, float): "a number", str: "text",
        (list, tuple): "a list", Mapping: "a table", type(None): "nothing",
    }  # fmt: skip
    return next((words for kind, words in kinds.items() if isinstance(raw, kind)), "a date or time")


def _reads_as_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
