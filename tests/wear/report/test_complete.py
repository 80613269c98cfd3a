"""What a reader needs: everything is mentioned, every symbol is explained, nothing is left over."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest

from tests.wear.report import quick
from wear.report.document import (
    Block,
    Claims,
    Document,
    Equation,
    Figure,
    Items,
    Math,
    Paragraph,
    Prose,
    Reference,
    Section,
    Steps,
    Table,
)
from wear.report.walk import all_prose, blocks, prose

_GREEK = "alpha|beta|theta|kappa|lambda|mu|nu|eta|zeta|rho|sigma|tau|omega|varepsilon|ell|phi"
_UPRIGHT = re.compile(
    r"\\(?:text|operatorname)\{[^{}]*\}|(?<!_\{)\\mathrm\{[^{}]*\}"
    r"|\\(?:begin|end)\{\w+\}|\\(?:left|right|[bB]igg?[lr]?)\b"
)
_SYMBOL = re.compile(
    r"\\(?:max|min) U_a|\\langle U_a ?\\rangle"
    rf"|(?:\\bar ?\{{?\\sigma\}}?|\\(?:{_GREEK})(?![a-z])|(?<![\\a-zA-Z])[A-Za-z](?![a-z]))"
    r"(?:_(?:\{(?:[^{}]|\{[^{}]*\})*\}|\\infty|[A-Za-z0-9]))?(?:\^(?:0|\*|\{0\}))?'?"
)
_TABLES = ("tab:nomenclature", "tab:symbols")
#: No quantities: the imaginary unit and indices, the orders of Landau.
_NONE = {"i", "j", "f_ij", "o", "O"}


@pytest.fixture(scope="module")
def paper() -> Document:
    return quick.paper()


def _references(text: Prose) -> set[str]:
    return {piece.label for piece in text if isinstance(piece, Reference)}


def _text(document: Document) -> Iterator[Prose]:
    """Sentences, not captions."""
    for block in blocks(document):
        if isinstance(block, Paragraph | Items):
            yield from prose(block)


def test_every_figure_and_table_is_mentioned_in_the_text(paper: Document) -> None:
    told = set().union(*map(_references, _text(paper)))
    floats = {b.label for b in blocks(paper) if isinstance(b, Figure | Table | Claims)}
    assert floats - told == set()


def test_every_claim_is_linked_to_an_equation_or_told_in_the_text(paper: Document) -> None:
    told = set().union(*map(_references, all_prose(paper)))
    (ledger,) = (block for block in blocks(paper) if isinstance(block, Claims))
    for claim in ledger.claims:
        own = set().union(*map(_references, prose(claim)))
        assert claim.label in told or any(label.startswith("eq:") for label in own), claim.id


def _symbols(latex: str) -> set[str]:
    r"""The symbols of a formula, braces and spaces taken out.

    >>> sorted(_symbols(r"\frac{\mathrm{d}u_c}{\mathrm{d}t} = V \tanh{\left(x_{\infty}\right)}"))
    ['V', 't', 'u_c', 'x_\\infty']
    """
    shown = _SYMBOL.findall(_UPRIGHT.sub(" ", latex))
    return {_plain(symbol).rstrip("'") if symbol != "p'" else symbol for symbol in shown}


def _plain(symbol: str) -> str:
    return re.sub(r"[{} ]", "", symbol)


def _formulas(block: Block) -> Iterator[str]:
    if isinstance(block, Equation):
        yield from (block.latex, block.printed)
    if isinstance(block, Steps):
        yield from (step.latex for step in block.steps)
    for text in prose(block):
        yield from (piece.latex for piece in text if isinstance(piece, Math))


def _listed(paper: Document) -> set[str]:
    """The symbols of the two tables of symbols."""
    tables = [b for b in blocks(paper) if isinstance(b, Table) and b.label in _TABLES]
    symbols = (row[0][0] for table in tables for row in table.rows)
    return {_plain(symbol.latex) for symbol in symbols if isinstance(symbol, Math)}


#: A symbol, or a function with its argument, behind a word or none.
_ALONE = re.compile(
    rf"(?:\\text\{{with\}}\\quad )?(?:{_SYMBOL.pattern})(?:\{{?(?:\\left)?\([^()]*\)\}}?)?"
)


def _defined(latex: str) -> set[str]:
    """The symbols on the left of an equals sign: one, or a function with its argument."""
    rows = re.split(r"\\\\|\\begin\{aligned\}|,\s*\\quad", latex)
    left = (row.partition("=")[0] for row in rows)
    return {s for part in left if _ALONE.fullmatch(part.strip(" &")) for s in _symbols(part)}


def _sections(section: Section) -> Iterator[Section]:
    yield section
    for block in section.blocks:
        if isinstance(block, Section):
            yield from _sections(block)


def test_every_symbol_is_in_a_table_or_defined_where_it_stands(paper: Document) -> None:
    listed = _listed(paper) | _NONE
    unknown: dict[str, set[str]] = {}
    for section in (inner for outer in paper.sections for inner in _sections(outer)):
        here = [block for block in section.blocks if not isinstance(block, Section)]
        sentences = [block for block in here if isinstance(block, Paragraph | Items)]
        told = {s for block in sentences for formula in _formulas(block) for s in _symbols(formula)}
        own: set[str] = set()
        for block in here:
            formulas = tuple(_formulas(block))
            defined = {symbol for formula in formulas for symbol in _defined(formula)}
            own = defined if isinstance(block, Equation) else own | defined  # its steps follow it
            found = {symbol for formula in formulas for symbol in _symbols(formula)}
            if missing := found - listed - told - own:
                unknown[getattr(block, "label", section.label)] = missing
    assert unknown == {}


def test_the_tables_of_symbols_have_none_that_does_not_occur(paper: Document) -> None:
    used = {
        symbol
        for block in blocks(paper)
        if getattr(block, "label", "") not in _TABLES
        for formula in _formulas(block)
        for symbol in _symbols(formula)
    }
    assert _listed(paper) - used == set()


def test_nothing_of_the_machine_is_left_in_a_formula(paper: Document) -> None:
    """No truth value, no name of a class, no space between hypotheses."""
    left = re.compile(r"\\?text\{(?:True|False)\}|True|False|None|Symbol|Dummy|nan")
    for block in blocks(paper):
        for formula in _formulas(block):
            assert not left.search(formula), formula
        if isinstance(block, Equation):
            for piece in block.title:
                assert not (isinstance(piece, Math) and r"\quad" in piece.latex), piece
