"""The page: whole, linked, readable by machines, and the same numbers as everywhere."""

import json
import re
from collections import Counter
from html.parser import HTMLParser
from itertools import pairwise

import numpy as np
import pytest

from derive.typeset import mathml
from tests.wear.report.conftest import document
from wear.report import html
from wear.report.number import TextNumber

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

    def can_be_followed(self) -> bool:
        """Whether one heading comes first, none skips a level, and cells of heads have a scope."""
        levels = [int(tag[1]) for tag, _ in self.tags if re.fullmatch(r"h[1-6]", tag)]
        steady = all(b <= a + 1 for a, b in pairwise(levels))
        scoped = all(a.get("scope") in {"row", "col"} for a in self.of("th"))
        return levels[0] == levels.count(1) == 1 and steady and scoped

    def of(self, *names: str) -> list[dict[str, str | None]]:
        return [attributes for tag, attributes in self.tags if tag in names]


@pytest.fixture(scope="module")
def page(sample):
    return html.page(sample)


@pytest.fixture(scope="module")
def outline(page):
    return Outline(page)


def test_the_page_needs_nothing_but_itself(page, outline):
    assert not outline.of("link", "img", "iframe", "object")
    assert outline.of("script") == [{}]  # one, in the file itself, allowed by its hash
    assert not re.search(r"url\((?!data:|#)|@import|javascript:|\son\w+=", page)
    assert "default-src 'none'" in page


def test_ids_are_unique_and_every_link_arrives(outline):
    ids = Counter(a["id"] for _, a in outline.tags if "id" in a)
    assert [i for i, times in ids.items() if times > 1] == []
    inner = {a[k][1:] for _, a in outline.tags for k in ("href", "xlink:href")
             if (a.get(k) or "").startswith("#")}  # fmt: skip
    assert inner - set(ids) == set()


def test_every_label_is_on_the_page_under_its_number(sample, page):
    for mark in sample.marks.values():
        after = page.split(f'id="{mark.target}"', 1)[1]
        shown = {
            "sec": f'<span class="numeral">{mark.number}</span>',
            "app": f'<span class="numeral">{mark.number}</span>',
            "eq": f">({sample.marks[mark.target].number})</a>",
            "fig": f"<b>{mark.name}.</b>",
            "tab": f"<b>{mark.name}.</b>",
            "claim": f">{mark.number}</b>",
            "der": f"({mark.number})",
            "ref": f"<b>{mark.number and mark.name}</b>",
        }[mark.kind]
        assert shown in after, mark


def test_equations_link_to_their_derivations_and_claims(sample, page):
    for label, sources in sample.mentions.items():
        own = page.split(f'id="{label}"', 1)[1]
        for source in sources:
            assert f'href="#{source}"' in own


def test_what_names_mean_stands_between_the_formula_and_its_printed_form(page):
    beside = [page.index(words) for words in ("Where:", "As printed:")]
    assert beside == sorted(beside)
    assert page.count("Where:") == 1


def test_figures_follow_the_colours_of_the_page(page):
    for figure in re.findall(r"<svg.*?</svg>", page, flags=re.DOTALL):
        assert "currentColor" in figure
        assert not re.search("#000000|#ffffff|<style|<metadata", figure)


def test_formulas_have_no_errors_and_text_is_escaped(page):
    assert page.count("<math") == page.count("</math>") == 14
    assert "merror" not in page
    assert "bearing &amp; its limit" in page
    assert "&lt; its verdict &gt;" in page


def test_latex_outside_the_subset_is_named():
    with pytest.raises(ValueError, match=r"\\unheard"):
        mathml.inline(r"\unheard{x}")


def test_punctuation_stays_with_its_formula():
    shown = html.page(document("# T\n\n$u$; next $v$ more"))
    assert re.search(r'class="kept"><math>.*?</math>;</span> next', shown)
    assert shown.count('class="kept"') == 1


def test_numbers_of_numpy_are_numbers():
    values = {"a": TextNumber(np.float64(0.5), "a", 2), "b": TextNumber(np.int64(7), "b")}
    shown = html.page(document("# T\n\n{{ a }} {{ b }}", **values))
    assert re.findall(r'value="(.*?)".*?>(.*?)<', shown) == [("0.5", "0.50"), ("7", "7")]


def test_two_figures_with_the_same_ids_do_not_meet():
    picture = '<svg viewBox="0 0 1 1"><defs><g id="a"/></defs><use xlink:href="#a"/></svg>'
    first, second = html.drawing(picture, "fig:1", "one"), html.drawing(picture, "fig:2", "two")
    assert 'id="fig-1-a"' in first
    assert '"#fig-1-a"' in first
    assert not set(re.findall(r'id="(.*?)"', first)) & set(re.findall(r'id="(.*?)"', second))


_MEASURE = """
document.fonts.load('16px "STIX Two Math"', 'σ').then(fonts => {
  const wide = [...document.querySelectorAll('main *')].filter(e =>
    e.getBoundingClientRect().right > innerWidth + 1 && !e.closest('.formula, .scroll table') &&
    !e.matches('svg *'));
  document.title = JSON.stringify({
    fonts: fonts.length, page: document.documentElement.scrollWidth - innerWidth,
    wide: wide.map(e => e.outerHTML.slice(0, 80))});
});
"""


@pytest.mark.parametrize("width", [1280, 768, 500])
def test_nothing_runs_out_of_the_page(page, width, tmp_path, window):
    file = tmp_path / "page.html"
    file.write_text(page, encoding="utf-8")
    window.size(width, 900)
    window.open(file, "document.readyState === 'complete'")
    window.run(_MEASURE)
    window.wait("document.title.startsWith('{')")
    assert json.loads(window.run("document.title")) == {"fonts": 1, "page": 0, "wide": []}


def test_the_section_that_is_read_is_marked(page, tmp_path, window):
    """And the list of contents is folded where it would stand in the way."""
    file = tmp_path / "page.html"
    file.write_text(page, encoding="utf-8")
    window.size(1280, 400)
    window.open(file, "document.readyState === 'complete'")
    window.run("document.getElementById('app:claims').scrollIntoView()")
    marked = "document.querySelector('nav [aria-current]')?.hash"
    window.wait(f"{marked} === '#app:claims'")
    assert window.run("document.querySelector('nav details').open")
    window.size(600, 400)
    window.wait("!document.querySelector('nav details').open")
