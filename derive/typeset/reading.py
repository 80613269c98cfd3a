r"""Formulas in plain text: what one types into a terminal, read as LaTeX.

Overview
    Titles, remarks and evidence are written as ``h/sigma -> 1/f_c`` or ``4.6e-8 mm``.  ``read``
    splits such a text into words, formulas and numbers.  A formula is the longest run that parses
    as one: names of quantities, numbers, ``+ - * / ^``, brackets, relations, and factors side by
    side.  A letter that may be a word (a, A, d, m) is one unless an operator says otherwise.
Key results
    read    the parts of a text
    Part    words, a formula, a number, or a name that is none of the model's
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal

from .tokens import Token, tokens_of

_NUMBER = re.compile(r"[-+]?\d+(\.\d+)?(e[-+]?\d+)?")
#: What makes a number a result, and no part of a formula.
_RESULT = re.compile(r"[.e]|\d{3}")
#: Letters that are words more often than not.
_AMBIGUOUS = frozenset("aAIidmgb")
_BRACKETS = {"(": ")", "[": "]", "|": "|"}


@dataclass(frozen=True)
class Part:
    """A piece of a text: words as they stand, a formula in LaTeX, a number or another name."""

    kind: Literal["words", "formula", "number", "identifier"]
    text: str


class _NoFormulaError(Exception):
    """What stands here is no formula."""


def read(text: str) -> tuple[Part, ...]:
    """Return the parts of a text, in order; a number is never inside words or a formula's side.

    >>> [part.text for part in read("at h = 3 sigma, for f_c = 0.25 and a load")]
    ['at ', 'h = 3 \\\\bar{\\\\sigma}', ', for ', 'f_c =', ' ', '0.25', ' and a load']
    """
    tokens = tuple(tokens_of(text))
    parts: list[Part] = []
    place = start = 0
    while place < len(tokens):
        found = _Formula(tokens, place).read()
        if found is None:
            place += 1
            continue
        pieces, end = found
        parts += [Part("words", text[start : tokens[place].start]), *pieces]
        place, start = end, tokens[end - 1].end
    parts.append(Part("words", text[start:]))
    return tuple(part for part in parts if part.text)


class _Formula:
    """Reads one formula by recursive descent; ``_place`` is the token that comes next."""

    def __init__(self, tokens: tuple[Token, ...], place: int) -> None:
        self._tokens, self._place = tokens, place
        self._depth = 0
        self._certain = False

    def read(self) -> tuple[list[Part], int] | None:
        """Return the parts of the formula that starts here and the token after it."""
        start = self._tokens[self._place]
        if start.kind == "identifier":
            return [Part("identifier", start.text)], self._place + 1
        try:
            parts = self._relation()
        except _NoFormulaError:
            return None
        return (parts, self._place) if parts else None

    def _relation(self) -> list[Part]:
        """Sides with relations between them; a side that is but a result is a number of its own."""
        first = self._place
        parts, latex = [], ""
        while True:
            side, number = self._sum(), self._number_since(first)
            alone = not latex and not self._relation_follows()
            if number and (alone or _RESULT.search(number)):
                if latex:
                    parts += [Part("formula", latex.strip()), Part("words", " ")]
                parts.append(Part("number", number))
                latex = ""
            else:
                latex += side
            if not self._relation_follows():
                break
            self._skip()
            self._certain = True
            latex += f" {self._next().latex} "
            self._skip()
            first = self._place
        if latex:
            parts.append(Part("formula", latex.strip()))
        only_number = all(part.kind == "number" for part in parts)
        return parts if self._certain or only_number else []

    def _relation_follows(self) -> bool:
        """Whether a relation and another side follow."""
        state = self._place, self._certain
        try:
            self._skip()
            if self._peek("relation") is None:
                return False
            self._next()
            self._skip()
            self._certain = True
            self._sum()
        except _NoFormulaError:
            return False
        finally:
            self._place, self._certain = state
        return True

    def _number_since(self, first: int) -> str:
        """The text of one number, with its sign, if no more than that has been read."""
        text = "".join(token.text for token in self._tokens[first : self._place]).strip()
        return text if _NUMBER.fullmatch(text) else ""

    def _sum(self) -> str:
        latex = ""
        if (sign := self._mark("+-")) is not None:
            latex = sign
        latex += self._product()
        while (sign := self._sign_between()) is not None:
            latex += f" {sign} {self._product()}"
        return latex

    def _sign_between(self) -> str | None:
        """A plus or minus between two terms: with spaces on both sides or on none."""
        before = self._place
        spaced = self._skip()
        sign = self._mark("+-")
        if sign is not None and self._skip() == spaced and self._starts_operand():
            return sign
        self._place = before
        return None

    def _product(self) -> str:
        latex = self._power()
        while not (_NUMBER.fullmatch(latex) and _RESULT.search(latex)):  # a result stays alone
            before = self._place
            if (sign := self._mark("*/")) is not None and self._starts_operand():
                self._certain = self._certain or latex.isdigit()
                latex += ("/" if sign == "/" else r"\,") + self._power()
            elif self._place == before and self._factor_follows():
                self._skip()
                factor = self._power()
                latex += (r"\," if factor.startswith(r"\mathrm{d}") else " ") + factor
            else:
                self._place = before
                break
        return latex

    def _factor_follows(self) -> bool:
        """Whether the next thing, at most a space away, is one more factor."""
        before = self._place
        self._skip()
        token = self._peek()
        self._place = before
        if token is None:
            return False
        if token.kind == "mark":
            return token.text in "([" and self._starts_operand(certain=True)
        if token.kind == "function":
            return True
        lone = token.text in _AMBIGUOUS and self._depth == 0
        return token.kind in ("name", "slope") and bool(token.latex) and not lone

    def _power(self) -> str:
        latex = self._atom()
        before = self._place
        if self._mark("^") is None:
            return latex
        try:
            sign = self._mark("-") or ""
            exponent = ", ".join(self._inside(")")) if self._mark("(") else self._atom()
        except _NoFormulaError:
            self._place = before
            return latex
        self._certain = True
        power = sign + exponent
        return f"{latex}^{power}" if len(power) == 1 else f"{latex}^{{{power}}}"

    def _atom(self) -> str:
        token = self._next()
        if token.kind in ("number", "factor"):
            return token.text
        if token.kind == "slope":
            self._certain = True
            return token.latex
        if token.kind == "function":
            self._certain = True
            self._skip()
            return f"{token.latex} {self._power()}"
        if token.kind == "name" and token.latex:
            return self._named(token)
        if token.kind == "mark" and token.text in _BRACKETS:
            return self._bracketed(token.text)
        if token.kind == "mark" and token.text == "<":
            return self._mean()
        raise _NoFormulaError

    def _named(self, token: Token) -> str:
        """A symbol, or a function at its arguments."""
        follows = self._peek("mark")
        applied = follows is not None and follows.text == "("
        ambiguous = token.text in _AMBIGUOUS or not token.known
        if ambiguous and not (self._certain or self._depth or applied or self._operator_follows()):
            raise _NoFormulaError
        self._certain = self._certain or not ambiguous
        if not applied:
            return token.latex if token.latex != "e" else r"\mathrm{e}"
        before = self._place
        try:
            arguments = self._bracketed(self._next().text)
        except _NoFormulaError:
            self._place = before
            return token.latex
        self._certain = True
        return token.latex + arguments

    def _operator_follows(self) -> bool:
        before = self._place
        self._skip()
        token = self._peek()
        self._place = before
        if token is None:
            return False
        power = token.kind == "mark" and token.text in "/^*"
        return power or token.kind in ("relation", "function")

    def _bracketed(self, opening: str) -> str:
        """What stands in brackets, with commas."""
        closing = _BRACKETS[opening]
        left, right = (r"\lvert ", r"\rvert") if opening == "|" else (opening, closing)
        return left + ", ".join(self._inside(closing)) + right

    def _inside(self, closing: str) -> list[str]:
        """The sums between commas up to a closing bracket."""
        self._depth += 1
        try:
            inside = [self._sum()]
            while self._mark(",") is not None:
                self._skip()
                inside.append(self._sum())
            if self._mark(closing) is None:
                raise _NoFormulaError
        finally:
            self._depth -= 1
        return inside

    def _mean(self) -> str:
        """``<U_a>``, a mean."""
        token = self._next()
        if token.kind != "name" or not token.latex or self._mark(">") is None:
            raise _NoFormulaError
        self._certain = True
        return rf"\langle {token.latex}\rangle"

    def _starts_operand(self, *, certain: bool = False) -> bool:
        """Whether an operand, one that can be no words, follows; nothing is consumed."""
        state = self._place, self._certain
        self._skip()
        try:
            self._power()
            return self._certain or not certain
        except _NoFormulaError:
            return False
        finally:
            self._place, self._certain = state

    def _skip(self) -> bool:
        """Pass a space; return whether there was one."""
        there = self._peek("space") is not None
        self._place += there
        return there

    def _peek(self, kind: str = "") -> Token | None:
        if self._place >= len(self._tokens):
            return None
        token = self._tokens[self._place]
        return token if not kind or token.kind == kind else None

    def _mark(self, marks: str) -> str | None:
        """Pass a mark if it is one of these."""
        token = self._peek("mark")
        if token is None or token.text not in marks:
            return None
        self._place += 1
        return token.text

    def _next(self) -> Token:
        if self._place >= len(self._tokens):
            raise _NoFormulaError
        self._place += 1
        return self._tokens[self._place - 1]
