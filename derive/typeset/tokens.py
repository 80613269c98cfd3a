"""Plain text cut into tokens: names, numbers, relations, marks, and words that are no formula.

The vocabulary of the model says which names are symbols; their tokens have its LaTeX.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from ..symbols import QUANTITIES

_NAME = r"[A-Za-z]+(?:_[A-Za-z0-9]+)?"
_TOKEN = re.compile(
    r"(?P<space>\s+)"
    rf"|(?P<slope>\bd ?(?P<above>{_NAME})/d ?(?P<below>{_NAME})\b)"
    r"|(?P<words>[A-Za-z]+'[A-Za-z]*|[A-Za-z]{2,}(?:-[A-Za-z]{2,})+|(?:[A-Za-z]\.){2,})"
    r"|(?P<number>(?<![\w.])\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w]|\.\d))"
    r"|(?P<factor>(?<![\w.])\d(?=[A-Za-z]))"
    rf"|(?P<name>(?<!\w){_NAME}(?!\w))"
    r"|(?P<relation><=|>=|!=|->|(?<=\s)[<>](?=\s)|=)"
    r"|(?P<mark>.)",
    re.DOTALL,
)
_IDENTIFIER = re.compile(r"[A-Za-z]+(?:[_-][A-Za-z]+)*[_-]?\d[\w\-]*")
_RELATIONS = {"<=": r"\le", ">=": r"\ge", "!=": r"\ne", "->": r"\to", "=": "=", "<": "<", ">": ">"}
_FUNCTIONS = {name: rf"\{name}" for name in ("tanh", "ln", "sin", "cos", "max", "min")}
_NAMES = {
    "phi": r"\phi", "pi": r"\pi", "oo": r"\infty", "K": "K", "Q": "Q", "F": "F",
    "f_ij": "f_{ij}", "f_i": "f_i", "a_n": "a_n", "c_n": "c_n", "w_n": "w_n",
}  # fmt: skip


@dataclass(frozen=True)
class Token:
    """A piece of a text from ``start`` to ``end``; ``latex`` is empty for what is only a word.

    ``known`` says that a name is one of the model's, and no letter that happens to stand alone.
    """

    kind: str
    text: str
    start: int
    end: int
    latex: str = ""
    known: bool = False


def tokens_of(text: str) -> Iterator[Token]:
    """Return the tokens of a text, in order and without gaps."""
    place = 0
    while place < len(text):
        identifier = _IDENTIFIER.match(text, place)
        boundary = place == 0 or not text[place - 1].isalnum()
        if identifier and boundary and identifier[0] not in QUANTITIES:
            yield Token("identifier", identifier[0], place, identifier.end(), identifier[0])
            place = identifier.end()
            continue
        found = _TOKEN.match(text, place)
        assert found is not None, text
        yield _token(found)
        place = found.end()


def _token(found: re.Match[str]) -> Token:
    kind, text = str(found.lastgroup), found[0]
    latex, known = "", False
    if found["slope"]:
        above, below = _symbol(found["above"]), _symbol(found["below"])
        latex = rf"\mathrm{{d}}{above}/\mathrm{{d}}{below}" if above and below else ""
        kind = "slope" if latex else "words"
    elif text in _FUNCTIONS:
        kind, latex = "function", _FUNCTIONS[text]
    elif kind == "relation":
        latex = _RELATIONS[text]
    elif kind == "name":
        latex, known = _symbol(text), text in QUANTITIES or text in _NAMES
    return Token(kind, text, found.start(), found.end(), latex, known)


def _symbol(name: str) -> str:
    """The LaTeX of a name, empty for a word."""
    if name in QUANTITIES:
        return QUANTITIES[name].latex
    return _NAMES.get(name, name if len(name) == 1 else "")
