r"""The document as LaTeX: ``report.tex``, which inputs ``equations.tex``, and its figures.

Overview
    `report` writes all files. ``equations.tex`` holds one macro for each equation that the text
    shows, so that other reports may ``\input`` the same file. Equations carry their numbers as
    tags; sections, figures and tables are numbered by LaTeX itself, and a test compares the outcome
    with `wear.report.document`. The frame is ``templates/report.tex``.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import jinja2
from markdown_it.token import Token

from derive.typeset.breaking import broken
from wear.cite import REFERENCES, listed
from wear.report.document import Document
from wear.report.tex_text import escape, verbatim
from wear.report.text import Writer

#: Characters of ``\footnotesize\ttfamily`` in a line of text.
_LISTING_WIDTH = 96
_HEADINGS = {"h2": "section", "h3": "subsection"}
_NUMBERED = ("section", "appendix", "equation", "figure", "table")
_COLUMNS = {"narrow": "l", "numeric": "r", "text": "T"}
_PLAIN = {
    "paragraph_open": "\n", "paragraph_close": "\n", "em_open": r"\emph{", "em_close": "}",
    "strong_open": r"\textbf{", "strong_close": "}", "softbreak": "\n", "hardbreak": r"\\",
    "bullet_list_open": "\\begin{itemize}\n", "bullet_list_close": "\\end{itemize}\n",
    "ordered_list_open": "\\begin{enumerate}\n", "ordered_list_close": "\\end{enumerate}\n",
    "list_item_open": r"\item ", "list_item_close": "\n", "thead_open": "",
    "thead_close": "\\midrule\n", "tbody_open": "", "tbody_close": "", "tr_open": "",
    "tr_close": " \\\\\n", "th_close": "", "td_close": "", "link_close": "}",
    "caption_open": "\n\\begin{table}[htbp]\\centering\\footnotesize\n\\caption{",
    "figures_open": "\n\\begin{figure}[htbp]\\centering\n", "figures_close": "\\end{figure}\n",
}  # fmt: skip
_TEMPLATES = jinja2.Environment(
    loader=jinja2.PackageLoader("wear.report"), undefined=jinja2.StrictUndefined,
    autoescape=False, variable_start_string="<<", variable_end_string=">>",
    block_start_string="<%", block_end_string="%>", comment_start_string="<#",
    comment_end_string="#>",
)  # fmt: skip


@dataclass(frozen=True)
class Sources:
    """The files of the report: name to content."""

    report: str
    equations: str
    figures: Mapping[str, bytes]


def report(document: Document) -> Sources:
    """Return all files of the report.

    Raises
    ------
    ValueError
        for references that lead nowhere and characters without a LaTeX form.
    """
    body = _Writer(document).written(document.text.tokens)
    title = re.sub(
        r"[^A-Za-z0-9À-ÖØ-öø-ÿ ,.:()\-]", "", document.title
    )  # an entry of the PDF, not typeset
    source = _TEMPLATES.get_template("report.tex").render(title=title, body=body)
    figures = {f"{label[4:]}.pdf": figure.pdf for label, figure in document.figures.items()}
    return Sources(source, equations(document), figures)


def equations(document: Document) -> str:
    """Return one macro for each equation: the formula alone, to be set in any display."""
    lines = ["% Formulas of the report, one macro each. Needs amsmath and amssymb."]
    for found in document.shown:
        if not (found.macro.isascii() and found.macro.isalpha()):
            raise ValueError(f"{found.id}: a macro's name has letters only, not {found.macro!r}")
        title = _Writer(document).of_line(found.title)
        lines.append(f"% ({document.marks[f'eq:{found.id}'].number}) {title}")
        lines.append(f"\\providecommand{{\\{found.macro}}}{{{broken(found.latex)}}}")
    return "\n".join(lines) + "\n"


class _Writer(Writer):
    """Writes tokens as LaTeX."""

    plain = _PLAIN

    def __init__(self, document: Document) -> None:
        super().__init__()
        self._document = document
        self._in_appendix = False

    # blocks

    def heading_open(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """The title of the paper, a section, or a derivation."""
        token = tokens[i]
        if token.tag == "h1":
            return "\\papertitle{"
        if "label" not in token.meta:
            return f"\n\\{_HEADINGS[token.tag]}*{{"
        mark = self._document.marks[token.meta["label"]]
        start = ""
        if mark.kind == "appendix" and not self._in_appendix:
            self._in_appendix = True
            start = "\n\\appendix"
        name = "subsubsection*" if mark.kind == "derivation" else _HEADINGS[token.tag]
        return f"{start}\n\\{name}{{"

    def heading_close(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """The end of a heading, with its label."""
        label = tokens[i].meta.get("label", "")
        if not label:
            return "}\n"
        is_derivation = self._document.marks[label].kind == "derivation"
        return f"}}\\hypertarget{{{label}}}{{}}\n" if is_derivation else f"}}\\label{{{label}}}\n"

    def fence(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """Equations, a formula, the works cited, or code."""
        token = tokens[i]
        if token.info == "equations":
            return "".join(map(self._equation, token.content.split()))
        if token.info == "math":
            return f"\\[{broken(token.content.strip())}\\]\n"
        if token.info == "works":
            cited = "\n".join(map(self._work, self._document.works))
            return f"\\begin{{itemize}}\\small\n{cited}\n\\end{{itemize}}\n"
        code = verbatim(token.content, _LISTING_WIDTH)
        return f"\n{{\\footnotesize\n\\begin{{verbatim}}\n{code}\n\\end{{verbatim}}\n}}\n"

    def _equation(self, identifier: str) -> str:
        found = self._document.equations[identifier]
        mark = self._document.marks[f"eq:{identifier}"]
        mentions = self._document.mentions.get(mark.target, ())
        where = ", ".join(self._link(label) for label in mentions)
        title = self.of_line(found.title)
        status = f" {{\\footnotesize\\sffamily\\upshape[{found.status}]}}" if found.status else ""
        printed = f"\\printed{{{broken(found.printed)}}}\n" if found.printed else ""
        return (
            f"\n\\begingroup\\formulatitle{{{title}{status}}}{{{where}}}\n"
            + ("\\keepwithnext\n" if printed else "")
            + f"\\begin{{equation}}\\{found.macro}\\tag{{{mark.number}}}\\label{{{mark.target}}}"
            + f"\\end{{equation}}\n{printed}\\endgroup\n"
        )

    def _work(self, key: str) -> str:
        mark, reference = self._document.marks[f"ref:{key}"], REFERENCES[key]
        doi = reference.fields.get("doi", "")
        link = f" doi:\\href{{https://doi.org/{doi}}}{{{escape(doi)}}}" if doi else ""
        name = f"\\hypertarget{{{mark.target}}}{{{mark.name}}}"
        return f"\\item[{{{name}}}] {escape(listed(reference))}{link}"

    def image(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """A figure with its caption; several in a paragraph stand side by side."""
        label = str(tokens[i].attrs["src"])
        several = sum(token.type == "image" for token in tokens)
        width = 1.0 if several == 1 else 0.96 / several
        caption = self.inside(tokens[i].children)
        return (
            f"\\begin{{minipage}}[t]{{{width:.3g}\\linewidth}}\\centering\n"
            f"\\includegraphics[width=\\naturalwidth]{{{label[4:]}.pdf}}\n"
            f"\\caption{{{caption}}}\\label{{{label}}}\n\\end{{minipage}}\\hfill"
        )

    def caption_close(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """The end of a caption."""
        return f"}}\\label{{{tokens[i].meta['label']}}}\n"

    def table_open(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """Columns: those with sentences share the width."""
        kinds = tokens[i].meta["columns"]
        columns = "@{}" + "".join(_COLUMNS[kind] for kind in kinds) + "@{}"
        return (
            f"\\begin{{tabularx}}{{\\linewidth}}{{{columns}}}\\toprule\n"
            if "text" in kinds
            else (f"\\begin{{tabular}}{{{columns}}}\\toprule\n")
        )

    def table_close(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """The end of a table."""
        start = max(j for j in range(i) if tokens[j].type == "table_open")
        name = "tabularx" if "text" in tokens[start].meta["columns"] else "tabular"
        return f"\\bottomrule\\end{{{name}}}\n\\end{{table}}\n"

    def th_open(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """A cell begins where the one before it ends."""
        return "" if tokens[i].meta["first"] else " & "

    td_open = th_open

    # inside lines

    def text(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """Words."""
        return escape(tokens[i].content)

    def code_inline(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """Code, which may be broken after the signs that join its parts."""
        shown = (escape(c) + (r"\allowbreak{}" if c in "/._-=" else "") for c in tokens[i].content)
        return f"\\texttt{{{''.join(shown)}}}"

    def math(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """A formula."""
        return f"${tokens[i].content}$"

    def link_open(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """A link to somewhere outside the document."""
        url = str(tokens[i].attrs["href"])
        for special in "%#&":
            url = url.replace(special, f"\\{special}")
        return f"\\href{{{url}}}{{"

    def reference(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """A link by kind and number, or by the number alone."""
        return self._link(tokens[i].content, bare=tokens[i].meta["bare"])

    def _link(self, label: str, *, bare: bool = False) -> str:
        mark = self._document.marks[label]
        name = escape(mark.bare if bare else mark.name)
        if mark.kind in _NUMBERED:
            return f"\\hyperref[{mark.target}]{{{name}}}"
        return f"\\linkto{{{mark.target}}}{{{name}}}"

    def target(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """The place that links to a claim lead to."""
        mark = self._document.marks[tokens[i].content]
        return f"\\hypertarget{{{mark.target}}}{{{escape(mark.number)}}}"

    def verdict(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """A verdict."""
        return f"\\verdict{{{escape(tokens[i].content.replace('-', ' '))}}}"

    def number(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """A number that was computed."""
        node = self._document.text.numbers[int(tokens[i].content)]
        unit = f"~{escape(node.unit)}" if node.unit else ""
        return f"${node.latex}${unit}"
