"""All files of a report, and nothing else."""

from importlib.resources import files

from wear.report import explorer_derived
from wear.report.publish import published

FILES = {
    "report.html", "report.tex", "equations.tex",
    *(f"{name}.{kind}" for name in ("system", "wear", "again") for kind in ("svg", "pdf")),
}  # fmt: skip


def test_a_report_is_these_files(sample, need_tool):
    need_tool("pdflatex")
    contents, outcome = published(sample)
    assert set(contents) == FILES | {"report.pdf"}
    assert (outcome.warnings, outcome.notice) == ((), "")


def test_without_tex_only_the_pdf_is_missing(sample, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    contents, outcome = published(sample)
    assert set(contents) == FILES
    assert "install" in outcome.notice


def test_what_the_explorer_has_of_the_derivation_is_up_to_date():
    """Else: python -m wear.report.explorer_derived. It is tried here, where all is derived."""
    written = files("wear.report").joinpath("assets", explorer_derived.FILE)
    assert written.read_text(encoding="utf-8") == explorer_derived.derived()
