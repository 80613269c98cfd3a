r"""Line breaks in formulas without a layout by an author.

Display forms are broken by their authors. The steps of a derivation are printed by a machine and
can be of any length: if they are too wide, they are broken before relations and signs, outside of
brackets where possible. A ``\left ... \right`` pair that is itself too wide gets delimiters of
a fixed size, a fraction that is too wide becomes a product, and a root a power, so that breaks
become possible inside.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import replace

from .formula import Piece, fence, parse, rows, source, total, width

#: Room for a formula beside its number, in em of the text: 160 mm of 11 pt type are 41 em.
LIMIT = 34.0

_INDENT = 2.5  # of a continuation line, which begins with a sign
#: Width, as a share of a line, above which pieces are opened; tried in turn until all lines fit.
_SHARES = (1.0, 0.75, 0.5, 0.25)
#: The widest left side of a system, as a share of a line, that other rows are aligned with.
_LEFT = 0.3
#: Number of rows up to which a system has a line for each; in a longer one short rows share lines.
_ROWS = 6
_SHORT = 0.5  # greatest width of a row that shares a line, as a share of the line
_SPACED = re.compile(r"\s*&")
_SIZES = ((r"\bigl", r"\bigr"), (r"\biggl", r"\biggr"), (r"\Biggl", r"\Biggr"))
_END = re.compile(r"[&,.;)\]|]|\\(?:[Bb]igg?r|q?quad)")  # what ends a product
_SYSTEM = re.compile(
    r"(?P<open>(?:\\left\\\{\s*)?\\begin\{aligned\})(?P<rows>.*)"
    r"(?P<close>\\end\{aligned\}(?:\s*\\right\.)?[.,;]?)",
    re.DOTALL,
)


def broken(latex: str, limit: float = LIMIT) -> str:
    r"""Return the formula unchanged, or in rows of ``aligned`` if it is wider than `limit` em.

    >>> broken("a = b + c", limit=4.0)
    '\\begin{aligned}a &= b \\\\ &\\qquad + c\\end{aligned}'
    >>> broken("a = b + c")
    'a = b + c'
    """
    system = _SYSTEM.fullmatch(latex.strip())
    if system is not None and r"\begin{aligned}" not in system["rows"]:
        lines = _system(_sharing(rows(system["rows"]), limit), limit)
        return system["open"] + r"\\".join(lines) + system["close"]
    lines = _lines(latex, limit)
    if lines == [latex]:
        return latex
    return r"\begin{aligned}" + r" \\ ".join(lines) + r"\end{aligned}"


def _sharing(system: list[str], limit: float) -> list[str]:
    """Return the lines of a long system, with pairs of short rows on one line."""
    if len(system) <= _ROWS:
        return system
    lines: list[str] = []
    last = math.inf
    for row in system:
        current = width(row)
        if max(last, current) <= _SHORT * limit and not row.lstrip().startswith(r"\text"):
            lines[-1] = rf"{lines[-1].rstrip()}, \quad {_SPACED.sub(' ', row).strip()}"
            last = math.inf
        else:
            lines.append(row)
            last = current
    return lines


def _system(system: list[str], limit: float) -> list[str]:
    """Return the lines of rows with a common point of alignment, right of the widest left side.

    If the remaining width is too small, rows with a wide left side start at that point.
    """
    sides = [tuple(width(side) for side in _sides(row)) for row in system]
    left = max(side[0] for side in sides)
    if left + max(side[1] for side in sides) <= limit:
        return system
    left = max((side[0] for side in sides if side[0] <= _LEFT * limit), default=0.0)
    lines: list[str] = []
    for row, (before, _) in zip(system, sides, strict=True):
        if before > left:
            lines += _lines("&" + _SPACED.sub("", row), limit - left)
        else:
            lines += _lines(row, limit - left + before, before + _INDENT)
    return lines


def _sides(row: str) -> tuple[str, str]:
    """Return the left and right sides of a row's point of alignment."""
    left, mark, right = row.partition("&")
    return (left, right) if mark else ("", left)


def _lines(row: str, limit: float, indent: float = _INDENT) -> list[str]:
    """Return the lines of a row, for a table with one alignment point; continuations are
    indented."""
    pieces = parse(row)
    if total(pieces) <= limit:
        return [row]
    for share in _SHARES:
        first, *others = _fill(_open_up(pieces, share * (limit - indent)), limit, indent)
        if total(first) <= limit and max(map(total, others), default=0.0) <= limit - indent:
            break
    start = source(first) if any(piece.tex == "&" for piece in first) else _aligned(first)
    # a continuation line is aligned by its indent, not at a point of its own
    rest = (source(piece for piece in line if piece.tex != "&") for line in others)
    return [start.strip(), *(rf"&\qquad {line.strip()}" for line in rest)]


def _aligned(line: tuple[Piece, ...]) -> str:
    """Return the line with its first relation as the point of alignment."""
    for index, piece in enumerate(line):
        if piece.kind == "relation" and piece.depth == 0:
            return source(line[:index]) + "&" + source(line[index:])
    return "&" + source(line)


def _open_up(pieces: tuple[Piece, ...], limit: float) -> tuple[Piece, ...]:
    """Return the pieces, with those opened that fill most of a line or more."""
    opened: list[Piece] = []
    for place, piece in enumerate(pieces):
        if piece.kind == "cases" and piece.width > limit:
            opened.append(_stacked(piece, limit))
        elif piece.kind == "fence" and {part.kind for part in piece.parts[0]} == {"cases"}:
            left, right = piece.delimiters
            opened.append(fence(left, _open_up(piece.parts[0], limit), right))
        elif piece.kind == "fence" and piece.width > 0.6 * limit:
            opened += _open_up(_unfenced(piece), limit)
        elif piece.kind == "root" and piece.width > 0.9 * limit:
            opened += _open_up(_as_power(piece), limit)
        elif piece.kind == "fraction" and piece.width > 0.9 * limit and not _is_rate(piece):
            followed = _is_factor(pieces[place + 1 :])
            opened += _open_up(_as_product(piece, limit, followed), limit)
        else:
            opened.append(piece)
    return tuple(opened)


def _stacked(cases: Piece, limit: float) -> Piece:
    """Return cases with their conditions below the values, which are broken if too wide."""
    body = cases.tex.removeprefix(r"\begin{cases}").removesuffix(r"\end{cases}")
    lines: list[str] = []
    for row in rows(body):
        value, _, condition = row.partition("&")
        shown = broken(value.replace(r"\displaystyle", "").strip(), limit - 1.0)
        lines += [rf"\displaystyle {shown}", rf"\quad {condition.strip()}"]
    tex = r"\begin{cases}" + r" \\ ".join(lines) + r"\end{cases}"
    return replace(cases, tex=tex, width=limit)


def _unfenced(piece: Piece) -> tuple[Piece, ...]:
    """Return a fence with delimiters of a fixed size, which may be on different lines."""
    left, right = _SIZES[min(piece.height, 2)]
    opening, closing = piece.delimiters
    inside = (replace(inner, depth=inner.depth + piece.depth + 1) for inner in piece.parts[0])
    return (
        Piece(left + opening, 0.6, depth=piece.depth),
        *inside,
        Piece(right + closing, 0.6, depth=piece.depth),
    )


def _as_power(root: Piece) -> tuple[Piece, ...]:
    """Return a root as a power of one half."""
    return _bracketed(root.parts[0], root.depth), Piece("^{1/2}", 1.0, depth=root.depth)


def _is_rate(fraction: Piece) -> bool:
    """Return whether a fraction is a derivative, which is no quotient."""
    return source(fraction.parts[1]).startswith((r"\mathrm{d}", r"\partial"))


def _as_product(fraction: Piece, limit: float, followed: bool) -> tuple[Piece, ...]:
    """Return a fraction as a quotient on the line, or a product with 1/denominator if narrow.

    A quotient that a factor follows is bracketed: [a]/[b] c may be read as [a]/([b] c).
    """
    numerator, denominator = fraction.parts
    above = _bracketed(numerator, fraction.depth)
    if total(denominator) > 0.6 * limit:
        slash = Piece(r"\Big/", 0.8, depth=fraction.depth)
        quotient = above, slash, _bracketed(denominator, fraction.depth)
        return (_bracketed(quotient, fraction.depth),) if followed else quotient
    below = Piece(
        rf"\frac{{1}}{{{source(denominator)}}}",
        total(denominator) + 0.25,
        height=fraction.height,
        depth=fraction.depth,
    )
    return below, above


def _is_factor(pieces: tuple[Piece, ...]) -> bool:
    """Return whether pieces begin with a factor of what is to their left."""
    first = next((piece for piece in pieces if not piece.tex.isspace()), None)
    return (
        first is not None and first.kind not in ("relation", "sign") and not _END.match(first.tex)
    )


def _bracketed(pieces: tuple[Piece, ...], depth: int) -> Piece:
    return replace(fence("[", pieces, "]"), depth=depth)


def _fill(pieces: tuple[Piece, ...], limit: float, indent: float) -> list[tuple[Piece, ...]]:
    """Return lines that fit, filled well and with few breaks inside brackets."""
    lines, rest, room = [], pieces, limit
    while total(rest) > room:
        possible = dict(_breaks(rest))
        fitting = [i for i in possible if total(rest[:i]) <= room] or list(possible)[:1]
        if not fitting:
            break
        cost = {i: _cost(possible[i], total(rest[:i]) / room) for i in fitting}
        best = min(fitting, key=lambda i: (cost[i], -i))
        lines.append(rest[:best])
        rest, room = rest[best:], limit - indent
    return [*lines, rest]


def _cost(start: Piece, filled: float) -> float:
    """Return the cost of a line that is filled to this share, if the next one starts there."""
    levels_of_brackets = 0 if filled > 0.5 else 2 if filled > 0.25 else 4
    return start.depth + levels_of_brackets - (0.5 if start.kind == "relation" else 0.0)


def _breaks(pieces: tuple[Piece, ...]) -> Iterator[tuple[int, Piece]]:
    """Yield the places where a line may start, with the relation or sign that it starts with.

    A point of alignment stays with its relation.
    """
    for index, piece in enumerate(pieces):
        start = index - (index > 0 and pieces[index - 1].tex == "&")
        if start > 0 and piece.kind in ("relation", "sign"):
            yield start, piece
