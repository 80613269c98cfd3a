"""Words of messages to users: names, kinds of values, and corrections of misspelt words."""

from __future__ import annotations

import difflib
import os
from collections.abc import Iterable, Mapping, Sequence
from datetime import date, time


def shown(text: str, most: int = 60) -> str:
    """Return `text` for a terminal: one line, no control characters, at most `most` characters.

    >>> shown("a\\x1b[31mb")
    'a\\\\x1b[31mb'
    """
    cut = text if len(text) <= most else text[: most - 3] + "..."
    return "".join(c if c.isprintable() else f"\\x{ord(c):02x}" for c in cut)


def is_path(given: object) -> bool:
    """Return whether an object can be the name of a file."""
    return isinstance(given, str | os.PathLike)


def are_texts(given: object) -> bool:
    """Return whether something is a list of texts."""
    return (
        isinstance(given, Sequence)
        and not isinstance(given, str)
        and all(isinstance(each, str) for each in given)
    )


def did_you_mean(word: str, candidates: Iterable[str]) -> str:
    """Return the candidate that is similar to `word`, or ''.

    >>> did_you_mean("stifness", ["stiffness", "hardness"])
    'stiffness'
    """
    by_lower = {candidate.lower(): candidate for candidate in candidates}
    close = difflib.get_close_matches(word[:80].lower(), by_lower, n=1)
    return by_lower[close[0]] if close else ""


def kind_of(raw: object) -> str:
    """Return the kind of a value in words for the user."""
    kinds: dict[type | tuple[type, ...], str] = {
        bool: "true or false", (int, float): "a number", str: "text",
        (list, tuple): "a list", Mapping: "a table", type(None): "nothing",
        (date, time): "a date or time",
    }  # fmt: skip
    by_type = (words for kind, words in kinds.items() if isinstance(raw, kind))
    return next(by_type, f"of type {type(raw).__name__}")
