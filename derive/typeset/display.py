"""Display forms: relations in the order in which an author writes them.

Overview
    Display forms are read from text that keeps the order of terms (``derive.written``).  The
    printer keeps the order of the arguments, omits the "(t)" of fields, and writes derivatives
    with an upright d, those with respect to a datum as partial derivatives.
Key results
    latex         LaTeX of a relation or of a system of them
    inline        LaTeX of a relation with its fractions on the line
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import permutations
from typing import Any

import sympy as sp
from sympy.printing.latex import LatexPrinter

from ..claims import landau_o
from ..symbols import EXTREMES, QUANTITIES, symbol, t

_RELATION = re.compile(r" (=|<|>|\\leq|\\geq|\\neq) ")


_WORD = re.compile(r"[A-Za-z]{2,}")
_TAU = symbol("tau")
_LATER = frozenset((t, symbol("T")))
_OPEN = (sp.Limit, sp.Integral)
"""Heads whose scope has no end of its own in print."""
_SETTINGS = {
    "order": "none",
    "fold_short_frac": False,
    "fold_frac_powers": True,
    "mul_symbol": None,
    "ln_notation": True,
    "diff_operator": "rd",
}


class _NotePrinter(LatexPrinter):
    """SymPy's LaTeX printer with the names and conventions of the field.

    The d of a differential and the base e are upright, by ISO 80000-2.  Fractions inside
    fractions and exponents, where they would be tiny, are written on the line.
    """

    def __init__(self, *, small: bool = False) -> None:
        super().__init__(_SETTINGS)
        self._small = small

    def _print(self, expr: Any, **options: Any) -> str:
        return r"\mathrm{e}" if expr is sp.E else str(super()._print(expr, **options))

    def _print_Symbol(self, expr: sp.Symbol, style: str = "plain") -> str:
        quantity = QUANTITIES.get(expr.name)
        if quantity is not None:
            return quantity.latex
        return self._own_name(expr.name)

    def _own_name(self, name: str) -> str:
        """Print a name of one's own, upright if it has several letters, unlike a product."""
        shown = str(super()._print_Symbol(sp.Symbol(name)))
        return _WORD.sub(r"\\mathrm{\g<0>}", shown, count=1) if _WORD.match(shown) else shown

    def _print_Function(self, expr: sp.Function, exp: str | None = None) -> str:
        name = expr.func.__name__
        if expr.func == landau_o:
            order, variable, point = map(self._print, expr.args)
            return rf"o_{{{variable} \to {point}}}\left({order}\right)"
        if name in QUANTITIES:
            body = QUANTITIES[name].latex
            if expr.args != (t,):
                body += f"({self._print(expr.args[0])})"
        else:
            return str(super()._print_Function(expr, exp))
        return body if exp is None else rf"{body}^{{{exp}}}"

    def _print_Add(self, expr: sp.Add, order: str | None = None) -> str:
        """Print nested sums that were built from the left without brackets."""
        terms = list(expr.args)
        while isinstance(terms[0], sp.Add):
            terms[:1] = terms[0].args
        if tuple(terms) != expr.args:
            expr = sp.Add(*terms, evaluate=False)
        return str(super()._print_Add(expr, order))

    def _print_Mul(self, expr: sp.Expr) -> str:
        """Print a product; SymPy calls this with powers too.

        Powers of t + T come before all but numbers: ``u_c (t + T)`` is the wear at that time.
        """
        if expr.is_Mul and any(map(_is_later, expr.args)):
            ordered = sorted(expr.args, key=lambda e: (not e.is_number, not _is_later(e)))
            expr = sp.Mul(*ordered, evaluate=False)
        whole = sp.Mul(*_factors(expr), evaluate=False) if self._small else expr
        above, below = sp.fraction(whole, exact=True)
        if below == 1:
            return str(super()._print_Mul(expr))
        first, *others = _factors(above)
        sign = "- " if first.is_Number and first.is_negative else ""
        if sign:
            above = sp.Mul(*([] if first == -1 else [-first]), *others, evaluate=False)
        return sign + self._fraction(above, below)

    def _fraction(self, above: sp.Expr, below: sp.Expr) -> str:
        """Print a fraction, on the line where it would be tiny."""
        over, under = inline(above), inline(below)
        if not self._small:
            return rf"\frac{{{over}}}{{{under}}}"
        divides = (below.is_Rational and not below.is_Integer) or isinstance(below, sp.Derivative)
        open_ = above.is_Add or above.has(*_OPEN) or any(map(_is_extreme, above.free_symbols))
        over = rf"\left({over}\right)" if open_ else over
        closed = not (below.is_Add or below.is_Mul or divides or below.has(*_OPEN))
        return f"{over} / {under}" if closed else rf"{over} / \left({under}\right)"

    def _needs_mul_brackets(self, expr: sp.Expr, first: bool = False, last: bool = False) -> bool:
        """Return whether a factor is in brackets: what reaches further than itself, unless last."""
        reaches = expr.has(sp.Limit) or (self._small and isinstance(expr, sp.Derivative))
        reaches = reaches or _is_extreme(expr) or (_is_bare(expr) and not self._small)
        return (reaches and not last) or bool(super()._needs_mul_brackets(expr, first, last))

    def _needs_add_brackets(self, expr: sp.Expr) -> bool:
        open_ = expr.has(sp.Limit) or isinstance(expr, sp.Piecewise)
        return open_ or bool(super()._needs_add_brackets(expr))

    def parenthesize(self, item: sp.Expr, *levels: Any, **options: Any) -> str:
        """Return the base of a power, or the like, in brackets where it needs some."""
        if _is_extreme(item):
            return rf"\left({self._print(item)}\right)"
        return str(super().parenthesize(item, *levels, **options))

    def _print_log(self, expr: sp.Expr, exp: str | None = None) -> str:
        inside = self._print(expr.args[0])
        if exp is not None:
            return rf"\ln^{{{exp}}}{{\left({inside} \right)}}"
        bare = _is_bare(expr) and not self._small
        return rf"\ln {inside}" if bare else str(super()._print_log(expr))

    def _print_Rational(self, expr: sp.Rational) -> str:
        on_the_line = self._small and expr.q != 1
        return f"{expr.p} / {expr.q}" if on_the_line else str(super()._print_Rational(expr))

    def _print_ExpBase(self, expr: sp.Expr, exp: str | None = None) -> str:
        return str(self._do_exponent(rf"\mathrm{{e}}^{{{inline(expr.args[0])}}}", exp))

    def _print_Piecewise(self, expr: sp.Piecewise) -> str:
        """Print branches with fractions of full size; small ones resemble exponents."""
        rows = []
        for value, condition in expr.args:
            if condition == sp.true:
                where = r"\text{otherwise}"
            else:
                where = rf"\text{{if}}\; {self._print(condition)}"
            rows.append(rf"\displaystyle {self._print(value)} & {where}")
        return r"\begin{cases} " + r" \\ ".join(rows) + r" \end{cases}"

    def _print_And(self, expr: sp.And) -> str:
        """Print several relations side by side, ``a < x`` and ``x < b`` as one chain."""
        bounds = all(isinstance(part, (sp.Ge, sp.Gt, sp.Le, sp.Lt)) for part in expr.args)
        for first, second in permutations(expr.args) if bounds and len(expr.args) == 2 else ():
            if first.gts == second.lts:
                below, above = (
                    "<" if isinstance(part, (sp.Gt, sp.Lt)) else r"\leq" for part in (first, second)
                )
                low, middle, high = map(self._print, (first.lts, first.gts, second.gts))
                return f"{low} {below} {middle} {above} {high}"
        return r", \quad ".join(self._print(part) for part in expr.args)

    def _print_Subs(self, expr: sp.Subs) -> str:
        """Print the slope of a contact law at a point as phi'(point)."""
        inner, (variable,), (point,) = expr.args
        if isinstance(inner, sp.Derivative) and inner.expr.args == (variable,):
            name = self._print(sp.Symbol(inner.expr.func.__name__))
            return rf"{name}'{{\left({self._print(point)} \right)}}"
        return str(super()._print_Subs(expr))

    def _print_Derivative(self, expr: sp.Derivative) -> str:
        (variable, order), *_ = expr.variable_count
        power = "" if order == 1 else f"^{{{order}}}"
        sign = r"\mathrm{d}" if variable in (t, _TAU) else r"\partial "
        above = rf"{sign}{power}{self._print(expr.expr)}"
        below = rf"{sign}{self._print(variable)}{power}"
        return f"{above} / {below}" if self._small else rf"\frac{{{above}}}{{{below}}}"


def _is_later(factor: sp.Expr) -> bool:
    """Return whether a factor is a power of t + T."""
    base = factor.base if factor.is_Pow else factor
    return bool(base.is_Add) and set(base.args) == _LATER


def _is_bare(expr: sp.Expr) -> bool:
    """Return whether an expression is a logarithm of a name, which needs no brackets alone."""
    return isinstance(expr, sp.log) and bool(expr.args[0].is_Symbol)


def _is_extreme(expr: sp.Expr) -> bool:
    r"""Return whether an expression is printed as an operator with an operand, ``\max U_a``."""
    return isinstance(expr, sp.Symbol) and expr.name in EXTREMES


def _factors(expr: sp.Expr) -> Iterator[sp.Expr]:
    """Yield the factors of a product, and of the products inside it."""
    if not expr.is_Mul:
        yield expr
        return
    for factor in expr.args:
        yield from _factors(factor)


def latex(expr: sp.Basic | Sequence[sp.Basic], where: Sequence[sp.Basic] = ()) -> str:
    r"""Return LaTeX of an expression, a relation, or a system of relations.

    ``where`` are the abbreviations in a system, which follow it.

    >>> from derive.symbols import symbol, rate
    >>> latex(sp.Eq(rate("u_c"), 2 * symbol("p_max")))
    '\\frac{\\mathrm{d}u_c}{\\mathrm{d}t} = 2 p_{\\max}'
    """
    if isinstance(expr, sp.Basic):
        return str(_NotePrinter().doprint(expr))
    if len(expr) == 1 and not where:
        return latex(expr[0])
    lines = [_RELATION.sub(r" &\1 ", latex(part), count=1) for part in (*expr, *where)]
    if where:
        lines[len(expr)] = r"\text{with}\quad " + lines[len(expr)]
    return r"\left\{\begin{aligned} " + r" \\ ".join(lines) + r" \end{aligned}\right."


def inline(expr: sp.Basic) -> str:
    r"""Return LaTeX of an expression or a relation, with its fractions on the line.

    >>> from derive.symbols import symbol
    >>> inline(symbol("f_c") < sp.Rational(1, 3))
    'f_c < 1 / 3'
    """
    return str(_NotePrinter(small=True).doprint(expr))
