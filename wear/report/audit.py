"""Numbers that nobody computed.

A report may state only numbers that come from the run that wrote it. The writers cannot know
whether a digit in a sentence was typed or computed; the tree can: a computed one is a `Number`.
Whether a `Number` follows the run is a matter of a test, which changes the run.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from wear.report.document import (
    Code,
    Document,
    Emphasis,
    Equation,
    Figure,
    Given,
    Inline,
    Link,
    Listing,
    Math,
    Number,
    Section,
    Steps,
    Text,
)
from wear.report.walk import all_prose, blocks

#: Numbers as words; small ones count things on the page.
_WORD = re.compile(
    r"\b(?:dozen|(?:thir|four|fif|six|seven|eigh|nine)teen|(?:twen|thir|for|fif|six|seven|eigh|nine)ty"
    r"|hundred|thousand|(?:m|b|tr)illion)(?:s|th|fold)?\b",
    re.IGNORECASE,
)
#: Small integers belong to formulas; a decimal, a power of ten, a percentage, digits in groups or a
#: long integer is a result.
_RESULT = re.compile(r"\d\s*[.,]\s*\d|\d\{[.,]\}\d|10\s*\^|\d\\,\d|\d[eE][-+]?\d|\\%|\d{3}|\\num\b")
#: Code that is a number, or a number with a unit.
_NUMERIC_CODE = re.compile(r"\s*[-+~\u2248<>]?\s*\.?\d.*")
_RESULT_IN_WORDS = re.compile(r"\d\.\d|\d[eE][-+]?\d|\d{3}|%")
#: What words with a decimal, a power of ten or three digits may be, if they are no `Number`.
_REASONS = frozenset({"measured in this run", "version of a package", "reference"})


def audit(document: Document) -> tuple[str, ...]:
    """The texts with numbers that are not a `Number`, a `Reference` or a `Given`.

    Digits of any script, fractions and large numbers as words are found in sentences, titles,
    captions, cells, names of links and descriptions of figures. Formulas may have small integers;
    decimals, powers of ten, percentages and integers of three digits or more in a formula are found
    too, displayed or in a line. A `Given` may have such only for a few reasons, code must be more
    than a number, and a unit has no digits but exponents. Empty if all is well.
    """
    inline = (_words(piece) for text in all_prose(document) for piece in text if _is_typed(piece))
    return (*inline, *_outside_of_prose(document))


def _outside_of_prose(document: Document) -> Iterator[str]:
    """Titles, descriptions and displayed formulas."""
    told, formulas = [document.title], []
    for block in blocks(document):
        match block:
            case Section(title=title):
                told.append(title)
            case Figure(description=description) | Listing(description=description):
                told.append(description)
            case Equation(latex=latex, printed=printed):
                formulas += [latex, printed]
            case Steps(steps=steps):
                formulas += [step.latex for step in steps]
            case _:
                pass
    yield from filter(_has_number, told)
    yield from filter(_RESULT.search, formulas)


def _has_number(text: str) -> bool:
    return any(map(str.isnumeric, text)) or _WORD.search(text) is not None


def _is_typed(piece: Inline) -> bool:
    match piece:
        case Text(text) | Emphasis(text):
            return _has_number(text)
        case Link(text, url):
            return _has_number(text) and not url.endswith(text)  # an address is no result
        case Math(latex):
            return _RESULT.search(latex) is not None
        case Code(text):
            return _NUMERIC_CODE.fullmatch(text) is not None
        case Given(text, reason):
            return reason not in _REASONS and _RESULT_IN_WORDS.search(text) is not None
        case Number(unit=unit):
            return re.search(r"(?<!\^)\d|\d{2}", unit) is not None
        case _:
            return False


def _words(piece: Inline) -> str:
    match piece:
        case Text(text) | Emphasis(text) | Code(text) | Given(text) | Link(text):
            return text
        case Math(latex):
            return latex
        case Number(unit=unit):
            return unit
        case _:
            raise TypeError(f"{type(piece).__name__} holds no typed words")
