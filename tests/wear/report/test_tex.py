"""LaTeX: compiles without a warning that matters, and carries the same numbers as the page."""

import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import pytest

from derive.files import write_atomically
from tests.wear.report.conftest import document
from wear.report import tex
from wear.report.document import DisplayedEquation, Document
from wear.report.markup import escaped, paragraphs
from wear.report.publish import typeset, warnings
from wear.report.tex import escape, verbatim


def _write(folder: Path, sources: Mapping[str, str | bytes]) -> Path:
    for name, content in sources.items():
        write_atomically(folder / name, content)
    return folder / "report.tex"


@pytest.fixture(scope="module")
def compiled(sample, tmp_path_factory, need_tool):
    need_tool("pdflatex")
    report = _write(tmp_path_factory.mktemp("tex"), tex.report(sample))
    return report, typeset(report)


def test_the_report_compiles_without_a_warning(compiled):
    report, outcome = compiled
    assert outcome.notice == ""
    assert outcome.warnings == ()
    assert outcome.pdf == report.with_suffix(".pdf").read_bytes()
    assert outcome.pdf.startswith(b"%PDF")


def test_the_pdf_is_the_same_in_every_run(sample, compiled, tmp_path):
    again = typeset(_write(tmp_path, tex.report(sample))).pdf
    first = compiled[1].pdf
    assert first is not None
    assert again is not None
    assert again == first


def numbers_labels_as_the_page_does(report: Path, document: Document) -> bool:
    """Whether TeX gave equations, figures, tables and sections the numbers of the page."""
    auxiliary = report.with_suffix(".aux").read_text(encoding="utf-8")
    numbers = dict(re.findall(r"\\newlabel\{([^}@]+)\}\{\{\{?([^}]*)\}", auxiliary))
    named = ("claim", "der", "ref")  # these have names, not numbers
    return numbers == {
        label: mark.number
        for label, mark in document.marks.items()
        if mark.kind not in named and mark.target == label
    }


def test_tex_numbers_every_label_as_the_page_does(sample, compiled):
    assert numbers_labels_as_the_page_does(compiled[0], sample)


def test_equations_can_be_put_into_another_report(sample, tmp_path, need_tool):
    need_tool("pdflatex")
    (tmp_path / "equations.tex").write_text(tex.equations(sample), encoding="utf-8")
    other = tmp_path / "other.tex"
    other.write_text(
        "\\documentclass{article}\\usepackage[margin=25mm]{geometry}\\usepackage{amsmath,amssymb}\\input{equations}\n"
        "\\begin{document}\\begin{equation}\\EqCondensedProblem\\end{equation}\n"
        "\\[\\EqWearPerCycle\\]\\[\\EqStaticSolution\\]\\end{document}\n",
        encoding="utf-8",
    )
    outcome = typeset(other)
    assert (outcome.notice, outcome.warnings) == ("", ())


def test_a_failing_run_is_a_notice(tmp_path, need_tool):
    need_tool("pdflatex")
    source = tmp_path / "broken.tex"
    source.write_text("\\documentclass{article}\\begin{document}\\nonsense\\end{document}")
    outcome = typeset(source)
    assert outcome.pdf is None
    assert "Undefined control sequence" in outcome.notice
    assert "\n" not in outcome.notice


def test_every_special_compiles(tmp_path, need_tool):
    need_tool("pdflatex")
    text = "\\ { } $ & # % _ ^ ~ < > | \" ' ` é ü Ł ő – — “ ” ‘ ’ … − · × ± ° µ → ≤ ≥ ≈ ∞ ² ³"
    code = "a" * 250 + "\n\\%{}_^"
    special = document(
        "# {{ t | plain }}\n\n{{ t | plain }}\n\n```sh\n{{ c }}\n```\n", t=text, c=code
    )
    outcome = typeset(_write(tmp_path, tex.report(special)))
    assert (outcome.notice, outcome.warnings) == ("", ())


def test_a_caption_may_name_anything(sample, tmp_path, need_tool):
    need_tool("pdflatex")
    named = " ".join(f"[{label}] [({label})]" for label in sample.marks)
    table = f"\n\nTable: Seen in {named}. {{#tab:one}}\n\n| a | b |\n| :-- | --- |\n| c | d |\n"
    both = replace(sample, tokens=(*sample.tokens, *document(table).tokens))
    outcome = typeset(_write(tmp_path, tex.report(both)))
    assert (outcome.notice, outcome.warnings) == ("", ())


def test_any_title_and_scene_file_of_a_user_can_be_typeset(tmp_path, need_tool):
    """Greek as Greek, other scripts by their numbers; a listing does not end before its end."""
    need_tool("pdflatex")
    words = "σ Ωβ 中 \U0001f600 Ж {{ 7 }} $x$ [eq:21] \\end{verbatim} R&amp;D ~ ^"
    text = f"# {escaped(words)}\n\n{paragraphs(f'- {words}')}\n\n```\n{words}\n```\n"
    assert escape("σ Ω 中") == r"\ensuremath{\sigma} \ensuremath{\Omega} [U+4E2D]"
    outcome = typeset(_write(tmp_path, tex.report(document(text))))
    assert (outcome.notice, outcome.warnings) == ("", ())


def test_a_listing_loses_no_character():
    code = "short\n" + "x" * 205
    shown = verbatim(code, 96)
    assert max(len(line) for line in shown.split("\n")) <= 96
    assert shown.replace("\n    ", "") == code


def test_a_macro_has_letters_only():
    wrong = {"21": DisplayedEquation("21", "a", macro="Eq21")}
    tokens = document("```equations\n21\n```\n").tokens
    with pytest.raises(ValueError, match="Eq21"):
        tex.equations(Document(tokens, wrong, {}))


@pytest.mark.parametrize(
    ("line", "matters"),
    [
        ("LaTeX Warning: Reference `eq:9' on page 1 undefined on input line 3.", True),
        ("Package hyperref Warning: Token not allowed in a PDF string", True),
        ("LaTeX Font Warning: Font shape undefined", True),
        ("Overfull \\hbox (1.5pt too wide) in paragraph", True),
        ("Overfull \\hbox (0.9pt too wide) in paragraph", False),
        ("Underfull \\hbox (badness 10000) in paragraph", False),
        ("Package: infwarerr 2019/12/03 v1.5 Providing info/warning messages", False),
    ],
)
def test_which_lines_of_a_log_matter(line, matters):
    assert bool(warnings(f"before\n{line}\nafter")) == matters
