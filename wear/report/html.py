"""The document as one page: no network, no script, formulas as MathML with their own font.

Overview
    `page` writes the whole file. Every block has one function, named after it;
    `wear.report.html_prose` writes what stands inside lines.
On the page
    Landmarks and a link that skips to the content; headings in order without gaps; figures that
    are announced by their description; headed rows and columns; derivations folded in
    ``details`` on screen and open on paper. The look is in ``assets/report.css``.
"""

from __future__ import annotations

import base64
from html import escape
from importlib.resources import files
from typing import assert_never

from wear.report import mathml, svg
from wear.report.document import (
    Bibliography,
    Block,
    Claim,
    Claims,
    Column,
    Document,
    Equation,
    Figure,
    Items,
    Listing,
    Paragraph,
    Prose,
    Section,
    Step,
    Steps,
    Table,
    Work,
)
from wear.report.html_prose import Page, link, prose
from wear.report.numbering import mentioned_by, number

#: Nothing may be fetched, nothing may run.
_POLICY = "default-src 'none'; style-src 'unsafe-inline'; font-src data:; base-uri 'none'"


def page(document: Document) -> str:
    """The document as a self-contained HTML file.

    Raises `ValueError` for references that lead nowhere and formulas outside the subset.
    """
    here = Page(number(document), mentioned_by(document))
    body = "\n".join(_section(here, section, level=2) for section in document.sections)
    return f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="{_POLICY}">
<meta name="color-scheme" content="light dark">
<title>{escape(document.title)}</title>
<style>
{style()}
</style>
</head>
<body>
<a class="skip" href="#content">Skip to the content</a>
<header>
<h1>{escape(document.title)}</h1>
<p class="subtitle">{prose(here, document.subtitle)}</p>
</header>
<nav aria-label="Contents">
{_contents(here, document.sections)}
</nav>
<main id="content" tabindex="-1">
<p class="abstract">{prose(here, document.abstract)}</p>
{body}
</main>
<footer>
<p>{prose(here, document.colophon)}</p>
</footer>
</body>
</html>
"""


def _block(here: Page, block: Block, level: int) -> str:
    match block:
        case Paragraph(content):
            return f"<p>{prose(here, content)}</p>"
        case Items():
            return _items(here, block)
        case Equation():
            return _equation(here, block)
        case Figure():
            return _figure(here, block)
        case Table():
            return _table(here, block)
        case Claims():
            return _claims(here, block)
        case Steps():
            return _steps(here, block)
        case Bibliography(works):
            return f'<ol class="works">{"".join(_work(here, work) for work in works)}</ol>'
        case Listing(code, description):
            name = escape(description)
            return f'<pre role="region" aria-label="{name}" tabindex="0">{escape(code)}</pre>'
        case Section():
            return _section(here, block, level)
    assert_never(block)


def _section(here: Page, section: Section, level: int) -> str:
    numeral = here.marks[section.label].number
    inside = "\n".join(_block(here, block, level + 1) for block in section.blocks)
    return (
        f'<section id="{section.label}">\n'
        f'<h{level}><span class="numeral">{numeral}</span> {escape(section.title)}</h{level}>\n'
        f"{inside}\n</section>"
    )


def _contents(here: Page, sections: tuple[Section, ...]) -> str:
    entries = []
    for section in sections:
        inner = tuple(block for block in section.blocks if isinstance(block, Section))
        entries.append(
            f'<li><a href="#{section.label}">{here.marks[section.label].number} '
            f"{escape(section.title)}</a>{_contents(here, inner) if inner else ''}</li>"
        )
    return "<ol>" + "".join(entries) + "</ol>"


def _items(here: Page, items: Items) -> str:
    tag = "ol" if items.ordered else "ul"
    entries = "".join(f"<li>{prose(here, entry)}</li>" for entry in items.entries)
    return f"<{tag}>{entries}</{tag}>"


def _equation(here: Page, equation: Equation) -> str:
    name = here.marks[equation.label].number
    named = f"{prose(here, equation.title)} {_badge(equation.status)}".strip()
    title = f'<p class="title">{named}</p>' if named else ""
    head = f'<div class="head">{title}{_mentions(here, equation.label)}</div>'
    printed = (
        f'<div class="printed"><p>As printed:</p><div class="formula">'
        f"{mathml.block(equation.printed)}</div></div>"
        if equation.printed
        else ""
    )
    return (
        f'<div class="equation" id="{equation.label}" role="group" aria-label="Equation {name}">'
        f"{head}"
        f'<div class="row"><div class="formula">{mathml.block(equation.latex)}</div>'
        f'<a class="number" href="#{equation.label}">({name})</a></div>'
        f"{printed}</div>"
    )


def _badge(status: str) -> str:
    if not status:
        return ""
    return f'<span class="badge {escape(status)}">{escape(status.replace("-", " "))}</span>'


def _mentions(here: Page, label: str) -> str:
    """Links back to the derivation, figures, tables and claims that refer to a label."""
    sources = here.mentioned_by.get(label, ())
    claims = [source for source in sources if here.marks[source].kind == "claim"]
    links = [link(here, source) for source in sources if source not in claims]
    if claims:
        word = "claims" if len(claims) > 1 else "claim"
        told = (link(here, claim, bare=True) for claim in claims)
        links.append(f"{word}\u00a0{', '.join(told)}")
    return f'<p class="mentions">{" · ".join(links)}</p>' if links else ""


def _figure(here: Page, figure: Figure) -> str:
    name = here.marks[figure.label].name
    return (
        f'<figure id="{figure.label}">'
        f'<div class="scroll">{svg.inline(figure.svg, figure.label, figure.description)}</div>'
        f"<figcaption><b>{name}.</b> {prose(here, figure.caption)}</figcaption></figure>"
    )


def _table(here: Page, table: Table) -> str:
    rows = "".join(_row(here, table.columns, row) for row in table.rows)
    return _table_frame(here, table, rows)


def _row(here: Page, columns: tuple[Column, ...], row: tuple[Prose, ...]) -> str:
    first, *rest = (prose(here, cell) for cell in row)
    cells = "".join(
        f"<td{_kind(column)}>{cell}</td>" for column, cell in zip(columns[1:], rest, strict=True)
    )
    return f'<tr><th scope="row"{_kind(columns[0])}>{first}</th>{cells}</tr>'


def _kind(column: Column) -> str:
    if column.numeric:
        return ' class="numeric"'
    return ' class="text"' if column.width else ""


def _table_frame(here: Page, table: Table, rows: str) -> str:
    heads = "".join(
        f'<th scope="col"{_kind(column)}>{prose(here, column.heading)}</th>'
        for column in table.columns
    )
    name = here.marks[table.label].name
    kind = ' class="long"' if table.long else ""
    return (
        f'<div class="scroll" id="{table.label}" role="region" aria-label="{name}" tabindex="0">'
        f"<table{kind}><caption><div><b>{name}.</b> {prose(here, table.caption)}</div></caption>"
        f"<thead><tr>{heads}</tr></thead><tbody>{rows}</tbody></table></div>"
    )


def _claims(here: Page, ledger: Claims) -> str:
    """The ledger is a table, stacked on a phone; its roles are written out since browsers forget
    those of a table that is not displayed as one."""
    titles = ("Claim", "Where", "Statement", "Verdict", "Evidence")
    heads = "".join(f'<th role="columnheader" scope="col">{title}</th>' for title in titles)
    rows = "".join(_claim(here, claim) for claim in ledger.claims)
    name = here.marks[ledger.label].name
    return (
        f'<div class="scroll" id="{ledger.label}"><table class="ledger" role="table">'
        f"<caption><div><b>{name}.</b> {prose(here, ledger.caption)}</div></caption>"
        f'<thead role="rowgroup"><tr role="row">{heads}</tr></thead>'
        f'<tbody role="rowgroup">{rows}</tbody></table></div>'
    )


def _claim(here: Page, claim: Claim) -> str:
    cells = (
        prose(here, claim.where),
        prose(here, claim.statement),
        _badge(claim.verdict),
        prose(here, claim.evidence) + _mentions(here, claim.label),
    )
    rest = "".join(f'<td role="cell">{cell}</td>' for cell in cells)
    return (
        f'<tr id="{claim.label}" role="row"><th role="rowheader" scope="row">{claim.id}</th>'
        f"{rest}</tr>"
    )


def _steps(here: Page, steps: Steps) -> str:
    count = f"{len(steps.steps)} step{'s' if len(steps.steps) > 1 else ''}"
    entries = "".join(_step(here, step) for step in steps.steps)
    # the label is inside: a link to it then opens what is folded
    return (
        f'<details class="steps"><summary>Derivation of '
        f"Eq.\u00a0({here.marks[steps.of].number}), {count}</summary>"
        f'<ol id="{steps.label}">{entries}</ol>'
        f'<p class="mentions">Back to {link(here, steps.of)}</p></details>'
    )


def _step(here: Page, step: Step) -> str:
    formula = f'<div class="formula">{mathml.block(step.latex)}</div>' if step.latex else ""
    check = f'<p class="check">{prose(here, step.check)}</p>' if step.check else ""
    return f"<li><p>{prose(here, step.text)}</p>{formula}{check}</li>"


def _work(here: Page, work: Work) -> str:
    number = here.marks[work.label].name
    return f'<li id="{work.label}"><b>{number}</b> <span>{prose(here, work.entry)}</span></li>'


def style() -> str:
    """The look of a page, with the font of its formulas."""
    assets = files("wear.report").joinpath("assets")
    font = base64.b64encode(assets.joinpath("stix-two-math.woff2").read_bytes()).decode()
    css = assets.joinpath("report.css").read_text(encoding="utf-8")
    return css.replace("url(stix-two-math.woff2)", f"url(data:font/woff2;base64,{font})")
