r"""The subset of LaTeX in which formulas are written, for the authors of display forms.

Both writers take it: amsmath as it stands, and the MathML converter of the page.

Use
    Greek letters, ``\dot \bar \tilde \hat``, ``\frac \tfrac \dfrac \sqrt \binom``, sub- and
    superscripts (``\sigma_{a0}^{2}``), ``\left( \right)`` (also ``\left. \right\}``), ``\bigl`` to
    ``\Biggr``, ``\sum \int \lim \max \min \sup \ln \exp \tanh``, ``\operatorname{Ei}``,
    ``\mathrm`` (upright d, e, units), ``\mathcal \mathbb``, ``\text{...}``, ``\underbrace``,
    ``\overset``, ``\xrightarrow``, ``\langle \rangle``, ``\lvert \rvert``, relations and arrows,
    spaces ``\, \: \; \quad \qquad``.
    ``\begin{cases}``, ``\begin{pmatrix}``, ``\begin{array}``, ``\begin{gathered}``.
Long formulas
    Break them yourself, after about 60 characters of output: ``\\`` and ``&`` at the top level are
    taken as rows of ``aligned`` (``\begin{aligned}`` may be written out, ``split`` becomes it).
    A ``\left ... \right`` pair cannot span a break: use ``\bigl[ ... \bigr]``.
    What is still too wide is broken by `derive.typeset.breaking`, correctly but without taste.
Avoid
    ``\label \tag \nonumber`` and the numbered environments (``align``, ``equation``, ``multline``):
    numbers are the document's. ``\intertext \mleft``: unknown to the page.
    ``\overline``: use ``\bar``. Commands of packages other than amsmath.
"""

from __future__ import annotations

import re

from derive.typeset.breaking import broken

_OWNED = re.compile(
    r"\\(?:label|tag|nonumber|notag|eqref)\b|\\begin\{(?:align|equation|gather|multline)\*?\}"
)
_ENVIRONMENT = re.compile(r"\\begin\{|\\end\{")
_ROW_SPACE = re.compile(r"\\\\\[[^\]]*\]")
_ALIGNMENT = re.compile(r"\\\\|(?<!\\)&")


def display(latex: str) -> str:
    r"""The formula with its rows inside ``aligned``, ready for both writers.

    >>> display(r"a &= b \\ &\quad + c")
    '\\begin{aligned}a &= b \\\\ &\\quad + c\\end{aligned}'
    >>> display("a = b")
    'a = b'

    Raises `ValueError` for what would number or label the formula a second time.
    """
    if owned := _OWNED.search(latex):
        raise ValueError(f"{owned[0]!r} in a display form: labels and numbers are the document's")
    plain = _ROW_SPACE.sub(r"\\\\", latex.strip())
    plain = plain.replace(r"\begin{split}", r"\begin{aligned}").replace(
        r"\end{split}", r"\end{aligned}"
    )
    if _ALIGNMENT.search(_top_level(plain)):
        plain = rf"\begin{{aligned}}{plain}\end{{aligned}}"
    return broken(plain)


def _top_level(latex: str) -> str:
    """The formula without its environments."""
    kept, depth, end = [], 0, 0
    for edge in _ENVIRONMENT.finditer(latex):
        if depth == 0:
            kept.append(latex[end : edge.start()])
        depth += 1 if edge[0].startswith(r"\begin") else -1
        end = edge.end()
    return "".join([*kept, latex[end:] if depth == 0 else ""])
