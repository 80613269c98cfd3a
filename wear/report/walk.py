"""Ways through the document tree, all in reading order."""

from __future__ import annotations

from collections.abc import Iterator

from wear.report.document import (
    Bibliography,
    Block,
    Claim,
    Claims,
    Document,
    Equation,
    Figure,
    Items,
    Labelled,
    Listing,
    Paragraph,
    Prose,
    Section,
    Steps,
    Table,
    Work,
)


def blocks(document: Document) -> Iterator[Block]:
    """Every block in reading order, a section before its contents."""

    def inside(block: Block) -> Iterator[Block]:
        yield block
        if isinstance(block, Section):
            for child in block.blocks:
                yield from inside(child)

    for section in document.sections:
        yield from inside(section)


def labelled(document: Document) -> Iterator[Labelled]:
    """Everything that has a label, in reading order."""
    for block in blocks(document):
        if not isinstance(block, Paragraph | Items | Bibliography | Listing):
            yield block
        if isinstance(block, Claims):
            yield from block.claims
        if isinstance(block, Bibliography):
            yield from block.works


def prose(block: Block | Claim | Work) -> Iterator[Prose]:
    """All prose of a block, without that of the blocks inside it."""
    match block:
        case Paragraph(content):
            yield content
        case Items(entries):
            yield from entries
        case Figure(caption=caption):
            yield caption
        case Table(caption=caption, columns=columns, rows=rows):
            yield caption
            yield from (column.heading for column in columns)
            yield from (cell for row in rows for cell in row)
        case Claims(caption=caption, claims=claims):
            yield caption
            for claim in claims:
                yield from prose(claim)
        case Claim(where=where, statement=statement, evidence=evidence):
            yield from (where, statement, evidence)
        case Steps(steps=steps):
            for step in steps:
                yield from (step.text, step.check)
        case Equation(title=title):
            yield title
        case Bibliography(works):
            for work in works:
                yield from prose(work)
        case Work(entry=entry):
            yield entry
        case Listing() | Section():
            pass


def all_prose(document: Document) -> Iterator[Prose]:
    """Every stretch of prose in the document, in reading order."""
    yield document.subtitle
    yield document.abstract
    for block in blocks(document):
        yield from prose(block)
    yield document.colophon
