"""Numbers that nobody computed.

A report may state only numbers that come from the run that wrote it. The writers cannot know
whether a digit in a sentence was typed or computed; the tree can: a computed one is a `Number`.
"""

from __future__ import annotations

import re

from wear.report.document import Document, Emphasis, Inline, Math, Section, Text
from wear.report.walk import all_prose, blocks

_DIGIT = re.compile(r"\d")
#: Small integers belong to formulas; a decimal, a power of ten or a long integer is a result.
_RESULT = re.compile(r"\d\.\d|10\s*\^|\d{3}|\\num\b")


def audit(document: Document) -> tuple[str, ...]:
    """The texts with digits that are not a `Number`, a `Reference` or a `Given`.

    Formulas may have small integers; decimals, powers of ten and integers of three digits or more
    in a formula inside a line are found too. Titles are checked like text. Empty if all is well.
    """
    found = [piece for text in all_prose(document) for piece in text if _is_typed(piece)]
    titles = [b.title for b in blocks(document) if isinstance(b, Section)] + [document.title]
    return tuple(_words(piece) for piece in found) + tuple(t for t in titles if _DIGIT.search(t))


def _is_typed(piece: Inline) -> bool:
    match piece:
        case Text(text) | Emphasis(text):
            return _DIGIT.search(text) is not None
        case Math(latex):
            return _RESULT.search(latex) is not None
        case _:
            return False


def _words(piece: Inline) -> str:
    match piece:
        case Text(text) | Emphasis(text):
            return text
        case Math(latex):
            return latex
        case _:
            raise TypeError(f"{type(piece).__name__} holds no typed words")
