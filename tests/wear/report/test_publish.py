"""All files of a report, and nothing else."""

from __future__ import annotations

from importlib.resources import files

from wear.report import explorer_derived
from wear.report.publish import publish

FILES = {
    "report.html", "report.tex", "equations.tex",
    *(f"{name}.{kind}" for name in ("system", "wear", "again") for kind in ("svg", "pdf")),
}  # fmt: skip


def test_a_report_is_these_files(sample, tmp_path, need_tool):
    need_tool("pdflatex")
    published = publish(sample, tmp_path)
    assert {file.name for file in tmp_path.iterdir()} == FILES | {"report.pdf"}
    assert (published.warnings, published.notice) == ((), "")


def test_without_tex_only_the_pdf_is_missing(sample, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    published = publish(sample, tmp_path)
    assert {file.name for file in tmp_path.iterdir()} == FILES
    assert "install" in published.notice


def test_what_the_explorer_has_of_the_derivation_is_up_to_date():
    """Else: python -m wear.report.explorer_derived. It is tried here, where all is derived."""
    written = files("wear.report").joinpath("assets", explorer_derived.FILE)
    assert written.read_text(encoding="utf-8") == explorer_derived.derived()
