"""The page: whole, linked, readable by machines, and the same numbers as everywhere."""

from __future__ import annotations

import json
import re
import subprocess
from collections import Counter
from collections.abc import Callable
from html import unescape
from html.parser import HTMLParser
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from wear.report import html, html_prose, mathml, svg
from wear.report.display import display
from wear.report.document import Document, Math, Number, Text
from wear.report.numbering import mentioned_by, number

_VOID = {"meta", "link", "br", "img", "hr", "mspace", "path", "use", "rect", "stop", "circle"}


class Outline(HTMLParser):
    """Tags in order with their attributes; fails on tags that do not nest."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self._open: list[str] = []
        self.feed(page)
        assert not self._open, f"never closed: {self._open}"

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        if tag not in _VOID:
            self._open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        if tag not in _VOID:
            assert self._open.pop() == tag

    def of(self, *names: str) -> list[dict[str, str | None]]:
        return [attributes for tag, attributes in self.tags if tag in names]


@pytest.fixture(scope="module")
def page(sample: Document) -> str:
    return html.page(sample)


@pytest.fixture(scope="module")
def outline(page: str) -> Outline:
    return Outline(page)


def test_the_page_needs_nothing_but_itself(page: str, outline: Outline) -> None:
    assert not outline.of("script", "link", "img", "iframe", "object")
    assert not re.search(r"url\((?!data:|#)|@import|javascript:|\son\w+=", page)
    assert "default-src 'none'" in page


def test_ids_are_unique_and_every_link_arrives(outline: Outline) -> None:
    ids = Counter(a["id"] for _, a in outline.tags if "id" in a)
    assert [i for i, times in ids.items() if times > 1] == []
    inner = {a[k][1:] for _, a in outline.tags for k in ("href", "xlink:href")
             if (a.get(k) or "").startswith("#")}  # fmt: skip
    assert inner - set(ids) == set()


def test_every_label_is_on_the_page_under_its_number(sample: Document, page: str) -> None:
    for label, mark in number(sample).items():
        after = page.split(f'id="{label}"', 1)[1]
        shown = {
            "section": f'<span class="numeral">{mark.number}</span>',
            "equation": f">({mark.number})</a>",
            "figure": f"<b>{mark.name}.</b>",
            "table": f"<b>{mark.name}.</b>",
            "claim": f">{mark.number}</th>",
            "derivation": f"({mark.number})",
            "work": f"<b>[{mark.number}]</b>",
        }[mark.kind]
        assert shown in after, label


def test_links_lead_both_ways(sample: Document, page: str) -> None:
    for label, sources in mentioned_by(sample).items():
        own = page.split(f'id="{label}"', 1)[1]
        for source in sources:
            assert f'href="#{source}"' in own
            assert f'href="#{label}"' in page.split(f'id="{source}"', 1)[1]


def test_screen_readers_find_their_way(outline: Outline) -> None:
    assert outline.of("html")[0]["lang"] == "en"
    assert all(len(outline.of(landmark)) == 1 for landmark in ("header", "nav", "main", "footer"))
    assert next(a for a in outline.of("a"))["href"] == "#content"
    levels = [int(tag[1]) for tag, _ in outline.tags if re.fullmatch(r"h[1-6]", tag)]
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert all(b <= a + 1 for a, b in pairwise(levels))
    assert all(a.get("scope") in {"row", "col"} for a in outline.of("th"))
    assert all(a["role"] == "img" and a["aria-label"] for a in outline.of("svg"))


def test_figures_follow_the_colours_of_the_page(page: str) -> None:
    for figure in re.findall(r"<svg.*?</svg>", page, flags=re.DOTALL):
        assert "currentColor" in figure
        assert not re.search("#000000|#ffffff|<style|<metadata", figure)


def test_formulas_have_no_errors_and_text_is_escaped(page: str) -> None:
    assert page.count("<math") == page.count("</math>") == 15
    assert "merror" not in page
    assert "bearing &amp; its limit" in page
    assert "&lt; its verdict &gt;" in page


@pytest.mark.parametrize(
    ("latex", "rows"),
    [
        (r"a &= b \\ &\quad + c", 2),
        (r"\begin{split} a &= b \\ &= c \end{split}", 2),
        (r"\begin{aligned} a &= b \\[4pt] &= c \\ &= d \end{aligned}", 3),
        (r"f = \begin{cases} a & x > 0 \\ b & \text{else} \end{cases}", 2),
        (r"f &= \begin{cases} a & x > 0 \\ b & y \end{cases} \\ &= c", 4),
    ],
)
def test_broken_formulas_keep_their_rows(latex: str, rows: int) -> None:
    assert mathml.block(latex).count("<mtr>") == rows


@pytest.mark.parametrize("latex", [r"a \tag{8}", r"\label{x} a", r"\begin{align*}a&=b\end{align*}"])
def test_a_display_form_does_not_number_itself(latex: str) -> None:
    with pytest.raises(ValueError, match="the document's"):
        display(latex)


def test_latex_outside_the_subset_is_named() -> None:
    with pytest.raises(ValueError, match=r"\\unheard"):
        mathml.inline(r"\unheard{x}")


def test_punctuation_stays_with_its_formula(sample: Document) -> None:
    here = html_prose.Page(number(sample), {})
    shown = html_prose.prose(here, (Math("u"), Text("; next"), Math("v"), Text(" more")))
    assert re.search(r'class="kept"><math>.*?</math>;</span> next', shown)
    assert shown.count("kept") == 1


def test_numbers_of_numpy_are_numbers(sample: Document) -> None:
    here = html_prose.Page(number(sample), {})
    values = (Number(np.float64(0.5), 2, source="a"), Number(np.int64(7), 1, source="b"))
    shown = html_prose.prose(here, values)
    assert re.findall(r'value="(.*?)".*?>(.*?)<', shown) == [("0.5", "0.50"), ("7", "7")]


def test_two_figures_with_the_same_ids_do_not_meet() -> None:
    drawing = '<svg viewBox="0 0 1 1"><defs><g id="a"/></defs><use xlink:href="#a"/></svg>'
    first, second = svg.inline(drawing, "fig:1", "one"), svg.inline(drawing, "fig:2", "two")
    assert 'id="fig-1-a"' in first
    assert '"#fig-1-a"' in first
    assert not set(re.findall(r'id="(.*?)"', first)) & set(re.findall(r'id="(.*?)"', second))


_MEASURE = """<script>
document.fonts.load('16px "STIX Two Math"', 'σ').then(fonts => {
  const wide = [...document.querySelectorAll('main *')].filter(e =>
    e.getBoundingClientRect().right > innerWidth + 1 && !e.closest('.formula, .scroll table') &&
    !e.matches('svg *'));
  document.title = JSON.stringify({
    fonts: fonts.length, page: document.documentElement.scrollWidth - innerWidth,
    wide: wide.map(e => e.outerHTML.slice(0, 80))});
});
</script>"""


def _browse(folder: Path, page: str, browser: str, *options: str) -> str:
    """What a browser without network prints for a page."""
    file = folder / "page.html"
    file.write_text(page, encoding="utf-8")
    command = [
        browser, "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run",
        "--disable-background-networking", "--disable-component-update", "--disable-sync",
        f"--user-data-dir={folder / 'profile'}", *options, file.as_uri(),
    ]  # fmt: skip
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True)
    return done.stdout


@pytest.mark.parametrize("width", [1280, 768, 500])
def test_nothing_runs_out_of_the_page(
    page: str, width: int, tmp_path: Path, need_tool: Callable[..., str]
) -> None:
    browser = need_tool("chromium", "google-chrome")
    measured = re.sub(r"<meta http-equiv[^>]*>", "", page) + _MEASURE
    options = ("--hide-scrollbars", "--virtual-time-budget=5000", "--dump-dom")
    shown = _browse(tmp_path, measured, browser, f"--window-size={width},900", *options)
    title = re.search(r"<title>(\{.*?\})</title>", shown)
    assert title is not None
    outcome = json.loads(unescape(title[1]))
    assert outcome == {"fonts": 1, "page": 0, "wide": []}


def test_derivations_are_open_on_paper(
    page: str, tmp_path: Path, need_tool: Callable[..., str]
) -> None:
    browser, reader = need_tool("chromium", "google-chrome"), need_tool("pdftotext")
    paper = tmp_path / "page.pdf"
    _browse(tmp_path, page, browser, "--no-pdf-header-footer", f"--print-to-pdf={paper}")
    text = subprocess.run(
        [reader, paper, "-"], capture_output=True, text=True, timeout=60, check=True
    ).stdout
    assert "Put the closure into the contact law." in text
    assert "Skip to the content" not in text
