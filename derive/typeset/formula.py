r"""The pieces of LaTeX formulas and their widths on the page.

Overview
    `parse` splits a formula into pieces: atoms, which stay whole, and fences
    (``\left ... \right``) and fractions, which can be opened. Relations and signs are marked,
    since a line may start with them. The texts of all pieces together are the formula again,
    except for redundant braces.
    Widths are estimates in em with an error of about a fifth, enough to find lines that do not fit.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

_SCRIPT = 0.72
_TOKEN = re.compile(r"\\[A-Za-z]+\*?|\\.|\s+|.", re.DOTALL)
_NAME = re.compile(r"\\(?:tanh|sinh|cosh|sin|cos|tan|ln|log|exp|lim|max|min|sup|inf)")
_OVER_SCRIPTS = {r"\lim", r"\max", r"\min", r"\sup", r"\inf", r"\sum"}
_RELATIONS = {
    "=", "<", ">", r"\le", r"\leq", r"\ge", r"\geq", r"\ne", r"\neq", r"\approx", r"\sim",
    r"\equiv", r"\to", r"\in", r"\implies", r"\iff",
}  # fmt: skip
_SIGNS = {"+", "-", r"\pm", r"\mp", r"\wedge", r"\land", r"\vee", r"\lor"}
_FRACTIONS = {r"\frac", r"\tfrac", r"\dfrac", r"\binom"}
_WORDS = {r"\mathrm", r"\text", r"\operatorname", r"\operatorname*", r"\mathbf"}
_WIDTHS = {
    r"\,": 0.17, r"\:": 0.22, r"\;": 0.28, r"\!": -0.17, r"\quad": 1.0, r"\qquad": 2.0, "&": 0.0,
    r"\cdot": 0.7, r"\times": 1.2, "(": 0.4, ")": 0.4, "[": 0.3, "]": 0.3, r"\{": 0.5, r"\}": 0.5,
    "|": 0.3, ",": 0.45, r"\int": 0.9, r"\sum": 1.4, r"\partial": 0.55, "'": 0.3,
    r"\bigl": 0.2, r"\bigr": 0.2, r"\biggl": 0.2, r"\biggr": 0.2, r"\Biggl": 0.2, r"\Biggr": 0.2,
    r"\dot": 0.0, r"\bar": 0.0, r"\tilde": 0.0, r"\hat": 0.0, r"\infty": 1.0,
}  # fmt: skip


@dataclass(frozen=True)
class Piece:
    """A part of a formula: its LaTeX and its width in em.

    `height` is the number of fractions stacked inside it, `depth` the number of opened fences
    around it. `parts` are the inside of a fence or root, or numerator and denominator;
    `delimiters` those of the fence.
    """

    tex: str
    width: float
    kind: Literal["atom", "relation", "sign", "fence", "fraction", "root", "cases"] = "atom"
    height: int = 0
    depth: int = 0
    parts: tuple[tuple[Piece, ...], ...] = ()
    delimiters: tuple[str, str] = ("", "")


def parse(latex: str) -> tuple[Piece, ...]:
    """Return the pieces of a formula, in order."""
    return _Parser(latex).pieces()


def total(pieces: Iterable[Piece]) -> float:
    """Return the width of pieces side by side, in em."""
    return sum(piece.width for piece in pieces)


def source(pieces: Iterable[Piece]) -> str:
    """Return the LaTeX of pieces side by side."""
    return "".join(piece.tex for piece in pieces)


def width(latex: str) -> float:
    r"""Return the estimated width of a formula in em.

    >>> width("x") < width(r"\frac{x + y}{2}") < width("x + y + 2")
    True
    """
    return total(parse(latex))


def _total_inside(part: Iterable[Piece]) -> float:
    """Return the width of pieces inside a fraction, where other fractions are set small."""
    return sum(piece.width * (_SCRIPT if piece.kind == "fraction" else 1.0) for piece in part)


def fence(opening: str, inner: tuple[Piece, ...], closing: str) -> Piece:
    """Return pieces between delimiters that grow with them; an atom if one delimiter is missing."""
    return Piece(
        rf"\left{opening}{source(inner)}\right{closing}",
        total(inner) + 1.0,
        "atom" if "." in (opening, closing) else "fence",
        _tallest(inner),
        parts=(inner,),
        delimiters=(opening, closing),
    )


def rows(body: str) -> list[str]:
    r"""Return the rows of a table, separated by ``\\``; tables inside it stay whole."""
    result, depth = [""], 0
    for token in _TOKEN.findall(body):
        depth += {r"\begin": 1, r"\end": -1}.get(token, 0)
        if token == r"\\" and depth == 0:
            result.append("")
        else:
            result[-1] += token
    return result


def _tallest(pieces: Iterable[Piece]) -> int:
    return max((piece.height for piece in pieces), default=0)


class _Parser:
    """A cursor over the tokens of a formula; each method reads one construct."""

    def __init__(self, latex: str) -> None:
        self._tokens: list[str] = _TOKEN.findall(latex)
        self._next = 0

    def pieces(self, end: str = "") -> tuple[Piece, ...]:
        """Return the pieces up to the token `end`, which is read too."""
        result: list[Piece] = []
        script = 0.0
        while (token := self._take()) not in ("", end):
            if token in "^_":
                piece = self._script(token, script)
                script = max(script, piece.width)
            else:
                piece = self._piece(token, result)
                script = piece.width if token in _OVER_SCRIPTS else 0.0
            result.append(piece)
        return tuple(result)

    def _take(self) -> str:
        self._next += 1
        return self._tokens[self._next - 1] if self._next <= len(self._tokens) else ""

    def _argument(self) -> tuple[Piece, ...]:
        while (token := self._take()).isspace():
            pass
        return self.pieces("}") if token == "{" else (self._piece(token, []),)

    def _piece(self, token: str, before: list[Piece]) -> Piece:
        if token in _FRACTIONS:
            return self._fraction(token)
        if token == r"\left":
            return self._fence()
        if token == r"\begin":
            return self._table()
        if token == r"\sqrt":
            return self._root()
        if token in _WORDS:
            text = source(self._argument())
            return Piece(f"{token}{{{text}}}", 0.5 * len(text))
        if token == "{":
            return self._group()
        if token in _RELATIONS:
            return Piece(token, 1.3, "relation")
        if token in _SIGNS:
            return Piece(token, 1.25, "sign") if _is_operand(before) else Piece(token, 0.8)
        return Piece(token, _plain(token))

    def _script(self, token: str, beside: float) -> Piece:
        """Return a sub- or superscript; the second one of a letter adds only its excess width."""
        inner = self._argument()
        body = source(inner)
        tex = token + (body if len(body) == 1 else f"{{{body}}}")
        return Piece(tex, max(_SCRIPT * total(inner) - beside, 0.0))

    def _group(self) -> Piece:
        """Return a group in braces, which are redundant around a single fence."""
        inner = self.pieces("}")
        solid = [piece for piece in inner if not piece.tex.isspace()]
        if len(solid) == 1 and solid[0].kind == "fence":
            return solid[0]
        return Piece(f"{{{source(inner)}}}", total(inner), height=_tallest(inner))

    def _fraction(self, token: str) -> Piece:
        parts = self._argument(), self._argument()
        tex = token + "".join(f"{{{source(part)}}}" for part in parts)
        small = _SCRIPT if token == r"\tfrac" else 1.0
        wide = small * max(_total_inside(part) for part in parts) + 0.25
        height = 1 + max(_tallest(part) for part in parts)
        return Piece(tex, wide, "fraction", height, parts=parts)

    def _root(self) -> Piece:
        inner = self._argument()
        if source(inner) == "[":  # the order of the root
            order = source(self.pieces("]"))
            inner = self._argument()
            return Piece(rf"\sqrt[{order}]{{{source(inner)}}}", total(inner) + 0.9)
        tex = rf"\sqrt{{{source(inner)}}}"
        return Piece(tex, total(inner) + 0.9, "root", _tallest(inner), parts=(inner,))

    def _fence(self) -> Piece:
        opening, start, level = self._take(), self._next, 1
        while level and (token := self._take()):
            level += {r"\left": 1, r"\right": -1}.get(token, 0)
        inner = parse("".join(self._tokens[start : self._next - 1]))
        return fence(opening, inner, self._take())

    def _table(self) -> Piece:
        start, level = self._next - 1, 1
        while level and (token := self._take()):
            level += {r"\begin": 1, r"\end": -1}.get(token, 0)
        self._argument()
        tex = "".join(self._tokens[start : self._next])
        body = re.sub(r"\\(?:begin|end)\{[^}]*\}(?:\{[lcr]*\})?", "", tex)
        wide = max(width(row) for row in rows(body)) + 1.0
        return Piece(tex, wide, "cases" if tex.startswith(r"\begin{cases}") else "atom", height=2)


def _is_operand(before: list[Piece]) -> bool:
    """Return whether a sign after these pieces joins two terms."""
    solid = [piece for piece in before if not piece.tex.isspace()]
    return bool(solid) and solid[-1].kind not in ("relation", "sign") and solid[-1].tex != "&"


def _plain(token: str) -> float:
    if token.isspace():
        return 0.0
    if _NAME.fullmatch(token):
        return 0.5 * (len(token) - 1) + 0.2
    return _WIDTHS.get(token, 0.5 if token.isdigit() else 0.58)
