r"""The document as LaTeX: ``report.tex``, which inputs ``equations.tex``, and its figures.

Overview
    `report` writes all files. ``equations.tex`` holds one macro for each equation that has a name,
    so that other reports may ``\input`` the same file. Equations carry their numbers as tags,
    sections, figures and tables are numbered by LaTeX itself; a test compares the outcome with
    `wear.report.numbering`. What the page folds, the derivations, stands in an appendix.
Packages
    amsmath, amssymb, booktabs, longtable, caption, graphicx, hyperref, microtype, cleveref. Without
    cleveref (it is not in the smaller TeX installations) references fall back to those of hyperref.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib.resources import files
from typing import assert_never

from wear.report.display import display
from wear.report.document import (
    Bibliography,
    Block,
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
    Text,
    Work,
)
from wear.report.numbering import mentioned_by, number
from wear.report.tex_prose import Context, bare_link, link, prose
from wear.report.tex_text import escape, heading, verbatim
from wear.report.walk import blocks

_HEADINGS = ("section", "subsection", "subsubsection")
#: Characters of ``\footnotesize\ttfamily`` in a line of text.
_LISTING_WIDTH = 96


@dataclass(frozen=True)
class Sources:
    """The files of the report: name to content."""

    report: str
    equations: str
    figures: Mapping[str, bytes]


def report(document: Document) -> Sources:
    """All files of the report. Raises `ValueError` for references that lead nowhere and characters
    without a LaTeX form."""
    here = Context(number(document), mentioned_by(document))
    body = "\n".join(_section(here, section, depth=0) for section in document.sections)
    derivations = [block for block in blocks(document) if isinstance(block, Steps)]
    preamble = files("wear.report").joinpath("assets/preamble.tex").read_text(encoding="utf-8")
    source = (
        f"{preamble}\\input{{equations}}\n"
        f"\\title{{{heading(document.title)}}}\n"
        f"\\author{{{prose(here, document.subtitle)}}}\n\\date{{}}\n"
        f"\\begin{{document}}\n\\maketitle\n"
        f"\\begin{{abstract}}\\noindent {prose(here, document.abstract)}\\end{{abstract}}\n"
        f"\\contents\n{body}\n"
        f"{_appendix(here, derivations)}"
        f"\\bigskip\\noindent{{\\footnotesize {prose(here, document.colophon)}\\par}}\n"
        f"\\end{{document}}\n"
    )
    return Sources(source, equations(document), dict(_figures(document)))


def equations(document: Document) -> str:
    """One macro for each equation that has a name: the formula alone, to be set in any display."""
    here = number(document)
    lines = ["% Formulas of the report, one macro each. Needs amsmath and amssymb."]
    for block in blocks(document):
        if isinstance(block, Equation) and block.macro:
            _check_macro(block)
            title = prose(Context(here, {}), block.title)
            lines.append(f"% ({here[block.label].number}) {title}".rstrip())
            lines.append(f"\\providecommand{{\\{block.macro}}}{{{display(block.latex)}}}")
    return "\n".join(lines) + "\n"


def _mentions(here: Context, label: str) -> str:
    """Where else a label is spoken of: its derivation with the page, then the rest, claims last."""
    sources = here.mentioned_by.get(label, ())
    claims = [source for source in sources if here.marks[source].kind == "claim"]
    told = [_mention(here, source) for source in sources if source not in claims]
    if claims:
        word = "claims" if len(claims) > 1 else "claim"
        told.append(f"{word}~" + ", ".join(bare_link(here, claim) for claim in claims))
    return ", ".join(told)


def _mention(here: Context, source: str) -> str:
    if here.marks[source].kind == "derivation":
        return f"\\linkto{{{source}}}{{derivation}} on p.~\\pageref{{{source}@page}}"
    return link(here, source)


def _block(here: Context, block: Block, depth: int) -> str:
    match block:
        case Paragraph(content):
            return f"\n{prose(here, content)}\n"
        case Items(entries, ordered):
            name = "enumerate" if ordered else "itemize"
            items = "\n".join(f"\\item {prose(here, entry)}" for entry in entries)
            return f"\\begin{{{name}}}\n{items}\n\\end{{{name}}}\n"
        case Equation():
            return _equation(here, block)
        case Figure():
            return _figure(here, block)
        case Table():
            return _table(here, block)
        case Claims():
            return _claims(here, block)
        case Steps():
            return ""  # see `_appendix`
        case Bibliography(works):
            cited = "\n".join(_work(here, work) for work in works)
            return f"\\begin{{itemize}}\n{cited}\n\\end{{itemize}}\n"
        case Listing(code):
            return (
                "\n{\\footnotesize\n\\begin{verbatim}\n"
                f"{verbatim(code, _LISTING_WIDTH)}\n\\end{{verbatim}}\n}}\n"
            )
        case Section():
            return _section(here, block, depth)
    assert_never(block)


def _section(here: Context, section: Section, depth: int) -> str:
    inside = "".join(_block(here, block, depth + 1) for block in section.blocks)
    return f"\n\\{_HEADINGS[depth]}{{{heading(section.title)}}}\\label{{{section.label}}}\n{inside}"


def _equation(here: Context, equation: Equation) -> str:
    formula = f"\\{equation.macro}" if equation.macro else display(equation.latex)
    tag = here.marks[equation.label].number
    status = f"\\status{{{_spoken(equation.status)}}}" if equation.status else ""
    title = f"{prose(here, equation.title)} {status}".strip()
    printed = f"\\printed{{{display(equation.printed)}}}\n" if equation.printed else ""
    told = _mentions(here, equation.label)
    return (
        "\n\\begingroup"
        + (f"\\formulatitle{{{title}}}{{{told}}}\n" if title or told else "\n")
        + ("\\keepwithnext\n" if printed else "")
        + f"\\begin{{equation}}{formula}\\tag{{{tag}}}\\label{{{equation.label}}}"
        + f"\\end{{equation}}\n{printed}\\endgroup\n"
    )


def _figure(here: Context, figure: Figure) -> str:
    return (
        "\\begin{figure}[htbp]\\centering\n"
        f"\\includegraphics[width=\\naturalwidth]{{{figure.file}.pdf}}\n"
        f"\\caption{{{prose(here, figure.caption)}}}\\label{{{figure.label}}}\n"
        "\\end{figure}\n"
    )


def _figures(document: Document) -> Iterator[tuple[str, bytes]]:
    for block in blocks(document):
        if isinstance(block, Figure):
            yield f"{block.file}.pdf", block.pdf


def _table(here: Context, table: Table) -> str:
    rows = [" & ".join(prose(here, cell) for cell in row) for row in table.rows]
    if table.long:
        return _long_table(here, table.label, table.caption, table.columns, rows)
    head = " & ".join(prose(here, column.heading) for column in table.columns)
    body = "".join(f"{row} \\\\\n" for row in rows)
    return (
        f"\\begin{{table}}[htbp]\\centering\\small\n"
        f"\\caption{{{prose(here, table.caption)}}}\\label{{{table.label}}}\n"
        f"\\begin{{tabular}}{{{_alignment(table.columns)}}}\\toprule\n"
        f"{head} \\\\\\midrule\n{body}\\bottomrule\\end{{tabular}}\n"
        "\\end{table}\n"
    )


def _long_table(
    here: Context,
    label: str,
    caption: Prose,
    columns: tuple[Column, ...],
    rows: list[str],
    *,
    apart: bool = False,
) -> str:
    head = " & ".join(prose(here, column.heading) for column in columns)
    end = "\\\\\\addlinespace\n" if apart else "\\\\\n"
    body = "".join(f"{row} {end}" for row in rows)
    return (
        f"\n{{\\footnotesize\n\\begin{{longtable}}{{{_alignment(columns)}}}\n"
        f"\\caption{{{prose(here, caption)}}}\\label{{{label}}}\\\\\\toprule\n"
        f"{head} \\\\\\midrule\\endfirsthead\n"
        f"\\toprule {head} \\\\\\midrule\\endhead\n"
        f"\\bottomrule\\endfoot\n{body}\\end{{longtable}}}}\n"
    )


def _alignment(columns: tuple[Column, ...]) -> str:
    def one(column: Column) -> str:
        if column.width:
            return f">{{\\raggedright\\arraybackslash}}p{{{column.width:g}\\linewidth}}"
        return "r" if column.numeric else "l"

    return "@{}" + "".join(one(column) for column in columns) + "@{}"


def _spoken(status: str) -> str:
    """A status or verdict as words."""
    return escape(status.replace("-", " "))


def _claims(here: Context, ledger: Claims) -> str:
    """The ledger in three columns: on paper the evidence needs the room."""
    heads = (("Claim", 0.11), ("Statement and verdict", 0.3), ("Evidence", 0.53))
    columns = tuple(Column((Text(title),), width=width) for title, width in heads)
    rows = [
        f"\\hypertarget{{{claim.label}}}{{{escape(claim.id)}}}\\newline "
        f"{prose(here, claim.where)} & "
        f"{prose(here, claim.statement)}\\newline \\verdict{{{_spoken(claim.verdict)}}} & "
        f"{prose(here, claim.evidence)}"
        for claim in ledger.claims
    ]
    return _long_table(here, ledger.label, ledger.caption, columns, rows, apart=True)


def _work(here: Context, work: Work) -> str:
    mark = here.marks[work.label]
    return f"\\item[{{\\hypertarget{{{work.label}}}{{{mark.name}}}}}] {prose(here, work.entry)}"


def _appendix(here: Context, derivations: Sequence[Steps]) -> str:
    told = "".join(_steps(here, steps) for steps in derivations)
    return f"\n\\appendix\n\\section{{Derivations}}\n{told}" if told else ""


def _steps(here: Context, steps: Steps) -> str:
    entries = "\n".join(f"\\item {_step(here, step)}" for step in steps.steps)
    title = f"Derivation of {link(here, steps.of)}, p.~\\pageref{{{steps.of}}}"
    return f"\n\\begin{{derivation}}{{{steps.label}}}{{{title}}}\n{entries}\n\\end{{derivation}}\n"


def _step(here: Context, step: Step) -> str:
    formula = f"\\[{display(step.latex)}\\]" if step.latex else ""
    check = f"{{\\footnotesize\\textit{{Check: {prose(here, step.check)}}}}}" if step.check else ""
    return f"{prose(here, step.text)}{formula}{check}"


def _check_macro(equation: Equation) -> None:
    if not (equation.macro.isascii() and equation.macro.isalpha()):
        raise ValueError(
            f"{equation.label}: a macro's name has letters only, not {equation.macro!r}"
        )
