"""What a reader needs: everything is mentioned, every symbol is explained, nothing is left over."""

import re
from collections.abc import Iterator
from itertools import pairwise

import pytest
from markdown_it.token import Token

from derive.symbols import QUANTITIES
from tests.wear.report import quick
from wear.report.document import Document
from wear.report.text import inline, line

_GREEK = "alpha|beta|theta|kappa|lambda|mu|nu|eta|zeta|rho|sigma|tau|omega|varepsilon|ell|phi"
_UPRIGHT = re.compile(
    r"\\(?:text|operatorname)\{[^{}]*\}|(?<!_\{)\\mathrm\{[^{}]*\}"
    r"|\\(?:begin|end)\{\w+\}|\\(?:left|right|[bB]igg?[lr]?)\b|\bo_\{[^{}]*\\to[^{}]*\}"
)
_SYMBOL = re.compile(
    r"\\(?:max|min) U_a|\\langle U_a ?\\rangle"
    rf"|(?:\\bar ?\{{?\\sigma\}}?|\\(?:{_GREEK})(?![a-z])|(?<![\\a-zA-Z])[A-Za-z](?![a-z]))"
    r"(?:_(?:\{(?:[^{}]|\{[^{}]*\})*\}|\\infty|[A-Za-z0-9]))?(?:\^(?:0|\*|\{0\}))?'?"
)
#: Quantities with a prime of their own; on any other symbol it means a derivative.
_PRIMED = {"p'"} | {q.latex for q in QUANTITIES.values() if q.latex.endswith("'")}

#: No quantities: the imaginary unit and indices, the orders of Landau, what definitions bind (the
#: roughness in the law of an expansion, the wear in a first zero).
_NONE = {"i", "j", "f_ij", "o", "O", "s", "u"}


@pytest.fixture(scope="module")
def paper() -> Document:
    return quick.paper()


def _sentences(paper: Document) -> Iterator[Token]:
    """What stands inside sentences, not captions or cells."""
    kinds = {"paragraph_open", "heading_open"}
    tokens = paper.tokens
    for before, token in pairwise(tokens):
        if token.type == "inline" and before.type in kinds:
            yield from token.children or ()


def test_every_figure_and_table_is_mentioned_in_the_text(paper: Document) -> None:
    mentioned = {_series(p.content) for p in _sentences(paper) if p.type == "reference"}
    floats = {_series(label) for label, m in paper.marks.items() if m.kind in ("fig", "tab")}
    assert floats - mentioned == set()


def _series(label: str) -> str:
    """The label without the number of a table in a series."""
    return re.sub(r"-\d+$", "", label)


def test_no_formula_is_cut_into_words(paper: Document) -> None:
    words = "".join(piece.content for piece in inline(paper.tokens) if piece.type == "text")
    assert not re.search(r"[\\$].{0,40}", words)


def test_every_claim_is_linked_to_an_equation_or_mentioned_in_the_text(paper: Document) -> None:
    mentioned = {piece.content for piece in inline(paper.tokens) if piece.type == "reference"}
    linked = {claim for sources in paper.mentions.values() for claim in sources}
    claims = {label for label, mark in paper.marks.items() if mark.kind == "claim"}
    assert claims - mentioned - linked == set()


def _symbols(latex: str) -> set[str]:
    r"""The symbols of a formula, braces and spaces taken out.

    >>> sorted(_symbols(r"\frac{\mathrm{d}u_c}{\mathrm{d}t} = V \tanh{\left(x_{\infty}\right)}"))
    ['V', 't', 'u_c', 'x_\\infty']
    """
    shown = _SYMBOL.findall(_UPRIGHT.sub(" ", latex))
    return {symbol if symbol in _PRIMED else symbol.rstrip("'") for symbol in map(_plain, shown)}


def _plain(symbol: str) -> str:
    return re.sub(r"[{} ]", "", symbol)


def _listed(paper: Document) -> set[str]:
    """The symbols of the two tables of symbols: formulas in the first cell of a row."""
    found, inside, first = set(), False, False
    for token in paper.tokens:
        if token.type == "caption_open":
            inside = token.meta["label"] in ("tab:nomenclature", "tab:symbols")
        first = token.meta.get("first", False) if token.type == "td_open" else first
        if inside and first and token.type == "inline":
            found |= {_plain(piece.content) for piece in token.children or ()}
            first = False
    return found


#: A symbol, or a function with its argument, behind a word or none.
_ALONE = re.compile(
    rf"(?:\\text\{{with\}}\\quad )?(?:{_SYMBOL.pattern})(?:\{{?(?:\\left)?\([^()]*\)\}}?)?"
)


def _defined(latex: str) -> set[str]:
    """The symbols on the left of an equals sign: one, or a function with its argument."""
    rows = re.split(r"\\\\|\\begin\{aligned\}|,\s*\\quad", latex)
    left = (row.partition("=")[0] for row in rows)
    return {s for part in left if _ALONE.fullmatch(part.strip(" &")) for s in _symbols(part)}


def _sections(paper: Document) -> Iterator[list[Token]]:
    """The tokens under each heading."""
    tokens: list[Token] = []
    for token in paper.tokens:
        if token.type == "heading_open":
            yield tokens
            tokens = []
        tokens.append(token)
    yield tokens


def _formulas(paper: Document, token: Token) -> Iterator[tuple[str, bool]]:
    """The formulas of a token, and whether they stand in sentences."""
    if token.type == "fence" and token.info == "equations":
        for equation in (paper.equations[name] for name in token.content.split()):
            yield from (
                (latex, False) for latex in (equation.latex, equation.printed, *equation.where)
            )
            yield from ((p.content, False) for p in line(equation.title) if p.type == "math")
    elif token.type == "fence" and token.info == "math":
        yield token.content, False
    for piece in token.children or ():
        if piece.type == "math":
            yield piece.content, True


def test_every_symbol_is_in_a_table_or_defined_where_it_stands(paper: Document) -> None:
    listed = _listed(paper) | _NONE
    unknown: dict[str, set[str]] = {}
    outer: set[str] = set()  # what the section says before its parts
    for section in _sections(paper):
        formulas = [found for token in section for found in _formulas(paper, token)]
        own = {symbol for latex, said in formulas if said for symbol in _symbols(latex)}
        if section and section[0].tag == "h2":
            outer = own
        own |= outer
        own |= {symbol for latex, _ in formulas for symbol in _defined(latex)}
        used = {symbol for latex, _ in formulas for symbol in _symbols(latex)}
        if missing := used - listed - own:
            unknown[section[1].content if len(section) > 1 else ""] = missing
    assert unknown == {}


def test_the_tables_of_symbols_have_none_that_does_not_occur(paper: Document) -> None:
    used: set[str] = set()
    inside = False
    for token in paper.tokens:
        if token.type == "caption_open":
            inside = token.meta["label"] in ("tab:nomenclature", "tab:symbols")
        inside = inside and token.type != "table_close"
        if not inside:
            used |= {s for latex, _ in _formulas(paper, token) for s in _symbols(latex)}
    assert _listed(paper) - used == set()


def test_nothing_of_the_machine_is_left_in_a_formula(paper: Document) -> None:
    """No truth value, no name of a class, no space between hypotheses."""
    left = re.compile(r"\\?text\{(?:True|False)\}|True|False|None|Symbol|Dummy|nan")
    for token in paper.tokens:
        for latex, _ in _formulas(paper, token):
            assert not left.search(latex), latex
    for equation in paper.equations.values():
        for piece in line(equation.title):
            assert not (piece.type == "math" and r"\quad" in piece.content), piece
