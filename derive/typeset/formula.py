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
from collections.abc import Iterable, Iterator
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
    return _pieces(iter(_TOKEN.findall(latex)))


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


def _pieces(tokens: Iterator[str], end: str = "") -> tuple[Piece, ...]:
    """Return the pieces up to the token `end`, which is read too."""
    result: list[Piece] = []
    script = 0.0
    while (token := next(tokens, "")) not in ("", end):
        if token in "^_":
            piece = _script(token, tokens, script)
            script = max(script, piece.width)
        else:
            piece = _piece(token, tokens, result)
            script = piece.width if token in _OVER_SCRIPTS else 0.0
        result.append(piece)
    return tuple(result)


def _argument(tokens: Iterator[str]) -> tuple[Piece, ...]:
    while (token := next(tokens, "")).isspace():
        pass
    return _pieces(tokens, "}") if token == "{" else (_piece(token, tokens, []),)


def _piece(token: str, tokens: Iterator[str], before: list[Piece]) -> Piece:
    """Return the piece that starts with a token; `before` are those to its left."""
    if token in _FRACTIONS:
        return _fraction(token, _argument(tokens), _argument(tokens))
    if token == r"\left":
        opening = next(tokens, "")
        return fence(opening, _pieces(tokens, r"\right"), next(tokens, ""))
    if token == r"\begin":
        return _table(tokens)
    if token == r"\sqrt":
        return _root(tokens)
    if token in _WORDS:
        text = source(_argument(tokens))
        return Piece(f"{token}{{{text}}}", 0.5 * len(text))
    if token == "{":
        return _group(_pieces(tokens, "}"))
    if token in _RELATIONS:
        return Piece(token, 1.3, "relation")
    if token in _SIGNS:
        return Piece(token, 1.25, "sign") if _is_operand(before) else Piece(token, 0.8)
    return Piece(token, _plain(token))


def _script(token: str, tokens: Iterator[str], beside: float) -> Piece:
    """Return a sub- or superscript; the second one of a letter adds only its excess width."""
    inner = _argument(tokens)
    body = source(inner)
    tex = token + (body if len(body) == 1 else f"{{{body}}}")
    return Piece(tex, max(_SCRIPT * total(inner) - beside, 0.0))


def _group(inner: tuple[Piece, ...]) -> Piece:
    """Return a group in braces, which are redundant around a single fence."""
    solid = [piece for piece in inner if not piece.tex.isspace()]
    if len(solid) == 1 and solid[0].kind == "fence":
        return solid[0]
    return Piece(f"{{{source(inner)}}}", total(inner), height=_tallest(inner))


def _fraction(token: str, *parts: tuple[Piece, ...]) -> Piece:
    tex = token + "".join(f"{{{source(part)}}}" for part in parts)
    small = _SCRIPT if token == r"\tfrac" else 1.0
    # fractions inside it are set small
    widths = (
        sum(p.width * (_SCRIPT if p.kind == "fraction" else 1) for p in part) for part in parts
    )
    height = 1 + max(map(_tallest, parts))
    return Piece(tex, small * max(widths) + 0.25, "fraction", height, parts=parts)


def _root(tokens: Iterator[str]) -> Piece:
    inner = _argument(tokens)
    if source(inner) == "[":  # the order of the root
        order = source(_pieces(tokens, "]"))
        inner = _argument(tokens)
        return Piece(rf"\sqrt[{order}]{{{source(inner)}}}", total(inner) + 0.9)
    tex = rf"\sqrt{{{source(inner)}}}"
    return Piece(tex, total(inner) + 0.9, "root", _tallest(inner), parts=(inner,))


def _table(tokens: Iterator[str]) -> Piece:
    """Return an environment with rows, which stays whole."""
    tex, level = r"\begin", 1
    while level and (token := next(tokens, "")):
        tex += token
        level += {r"\begin": 1, r"\end": -1}.get(token, 0)
    tex += f"{{{source(_argument(tokens))}}}"
    body = re.sub(r"\\(?:begin|end)\{[^}]*\}(?:\{[lcr]*\})?", "", tex)
    wide = max(map(width, rows(body))) + 1.0
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
