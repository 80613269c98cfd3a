"""The documentation: every code block runs, every link leads somewhere, nothing needs a network."""

import io
import json
import os
import re
import shutil
import sys
import warnings
from collections import Counter
from contextlib import redirect_stderr
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

from derive.note.claims import Verdict
from tests import pages
from tests.programs import ended, module
from tests.references import VERDICTS

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
PAGES = [
    ROOT / "README.md",
    *sorted(p for p in DOCS.rglob("*.md") if not {"_build", "bench", "papers"} & set(p.parts)),
]
SCRIPTS = [DOCS / "tour.py", *sorted((DOCS / "gallery").glob("*.py"))]
LAW_PAGE = DOCS / "how-to" / "own-contact-law.md"
NEEDS = {"finite-elements.md": "gfortran", "latex-report.md": "pdflatex", "fe_coupling.py": "gcc"}
NOT_RUN = {"text", "sh", "{math}", "{toctree}", "{eval-rst}", "{include}"}
NOT_RUN |= {"{code-block}", "{literalinclude}"}


def name_of(page: Path) -> str:
    return str(page.relative_to(ROOT))


def report(failures: str) -> None:
    if failures.strip():
        pytest.fail(failures, pytrace=False)


@pytest.fixture
def workplace(tmp_path, monkeypatch):
    """A folder with the example files, where the reader of a page would be."""
    shutil.copytree(DOCS / "examples", tmp_path, dirs_exist_ok=True)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return tmp_path


@pytest.mark.parametrize("page", [p for p in PAGES if p != LAW_PAGE], ids=name_of)
@pytest.mark.usefixtures("workplace")
def test_what_a_page_says_is_what_happens(page, need_tool):
    if page.name in NEEDS:
        need_tool(NEEDS[page.name])
    text = page.read_text(encoding="utf-8")
    consoles = [block.body for block in pages.blocks(text) if block.language == "console"]
    lines = [command for body in consoles for command in pages.commands(body)]
    failures = [pages.difference(command, pages.in_process) for command in lines]
    report("\n".join([*failures, pages.session(text, page.name)]))


def test_another_contact_law_is_one_entry(workplace):
    """The page on contact laws: behind its first command, which needs no more than a scene, in a
    copy of the packages by a process of its own."""
    for package in ("derive", "wear"):
        shutil.copytree(ROOT / package, workplace / package)
    with (workplace / "derive" / "laws.py").open("a", encoding="utf-8") as laws:
        laws.write((workplace / "gentle_law.txt").read_text(encoding="utf-8"))
    text = LAW_PAGE.read_text(encoding="utf-8")
    consoles = [block.body for block in pages.blocks(text) if block.language == "console"]
    own, *entry = [command for body in consoles for command in pages.commands(body)]
    code = f"""
from tests.pages import Command, difference, in_process
for command in {[tuple(command) for command in entry]!r}:
    print(difference(Command(*command), in_process))
"""
    path = os.pathsep.join(map(str, (workplace, ROOT)))
    run = ended(sys.executable, "-c", code, env={**os.environ, "PYTHONPATH": path})
    first = pages.difference(own, pages.in_process)
    report("\n".join([first, run.stdout.strip(), run.stderr, pages.session(text, LAW_PAGE.name)]))


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_every_block_is_of_a_kind_that_is_checked(page):
    found = pages.blocks(page.read_text(encoding="utf-8"))
    targets = set(re.findall(r"^(\w+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.M))
    unknown = {b.language for b in found} - {"", "console", "pycon"} - NOT_RUN
    assert not unknown
    for block in found:
        if block.language == "sh":
            lines = filter(None, block.body.splitlines())
            assert all(pages.understood(line, targets) for line in lines), block.body
        if block.language == "{code-block}":  # part of an example
            example = DOCS / "examples" / block.options["caption"].split(",")[0]
            part = block.body.split("\n\n", 1)[1]
            assert part in example.read_text(encoding="utf-8")


def test_the_readme_counts_the_verdicts_that_other_tests_hold():
    counts = Counter(VERDICTS.values())
    said = (
        f"of its {counts.total()} claims {counts[Verdict.CONFIRMED]} are confirmed, "
        f"{counts[Verdict.CONDITIONAL]} under conditions that it does not state, "
        f"{counts[Verdict.NOT_REPRODUCIBLE]} do not reproduce, "
        f"{counts[Verdict.INCONSISTENT]} are inconsistent, {counts[Verdict.REFUTED]} are refuted"
    )
    assert said in PAGES[0].read_text(encoding="utf-8")


def test_the_papers_are_what_their_templates_give():
    """With the verdicts that other tests hold, and the evidence of the last report."""
    build = module(DOCS / "papers" / "build.py")
    claims = json.loads((DOCS / "papers" / "claims.json").read_text(encoding="utf-8"))
    assert {claim["id"]: claim["verdict"] for claim in claims} == {
        name: verdict.value for name, verdict in VERDICTS.items()
    }
    for name, text in build.built(claims).items():
        assert (DOCS / "papers" / name).read_text(encoding="utf-8") == text, name


def test_the_readme_has_the_times_that_were_measured():
    speed = (DOCS / "bench" / "speed.md").read_text(encoding="utf-8")
    measured = _table(speed.partition("**section4, 10 digits**")[2])
    said = _table(PAGES[0].read_text(encoding="utf-8").partition("Ten correct digits")[2])
    assert len(said) > 3
    for row in said:
        (same,) = (found for found in measured if found["method"] == row["method"])
        ratio = re.compile(r" \([\d.]+x\)$")
        assert row == {column: ratio.sub("", same[column]) for column in row}


def _table(text: str) -> list[dict[str, str]]:
    """The first Markdown table of a text, a dictionary a row."""
    lines = re.search(r"(?:^\|.*\n)+", text, re.MULTILINE)[0].splitlines()
    head, _, *rows = ([cell.strip() for cell in line.strip("|").split("|")] for line in lines)
    return [dict(zip(head, row, strict=True)) for row in rows]


def test_the_links_of_the_readme_lead_somewhere():
    links = re.findall(r"\]\(([^)#]+)\)", PAGES[0].read_text(encoding="utf-8"))
    assert len(links) > 20
    assert not [link for link in links if not (ROOT / link).is_file()]


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_every_file_that_is_named_exists(page):
    places = re.findall(
        r"`((?:derive|wear|docs|tests)/[\w/.-]+)`", page.read_text(encoding="utf-8")
    )
    assert not [place for place in places if not (ROOT / place).exists()]


def test_every_picture_is_retaken_and_used():
    pictures = module(DOCS / "pictures.py")
    taken = {*pictures.OF_THE_REPORT, *pictures.OF_COMMANDS, *pictures.OF_THE_FIT, *pictures.DRAWN}
    kept = {path.name for path in (DOCS / "_static").iterdir() if path.suffix in (".png", ".svg")}
    assert taken == kept
    texts = "\n".join(page.read_text(encoding="utf-8") for page in PAGES)
    assert not [name for name in taken if f"_static/{name})" not in texts]


def test_no_paragraph_on_the_method_is_long():
    text = (DOCS / "method.md").read_text(encoding="utf-8")
    parts = re.split(r"\n\n|\n(?=- |\d\. )", re.sub(r"(?s)```.*?```", "", text))
    assert max(len(part.split()) for part in parts) <= 120


def test_every_example_is_used():
    texts = "\n".join(page.read_text(encoding="utf-8") for page in (*PAGES, *SCRIPTS))
    unused = [path.name for path in (DOCS / "examples").iterdir() if path.name not in texts]
    assert not unused


def test_examples_need_no_more_than_the_two_packages():
    found = [
        f"{name_of(page)}: {line}"
        for page in (*PAGES, *SCRIPTS)
        for line in page.read_text(encoding="utf-8").splitlines()
        if re.search(r"^\W*(?:from|import) (?:wear|derive)\.", line)
    ]
    report("\n".join(found))


@pytest.mark.usefixtures("workplace")
@pytest.mark.parametrize("script", SCRIPTS, ids=name_of)
def test_a_notebook_is_what_its_script_gives(script, need_tool):
    """Cells and outputs are those of a run now; figures agree to a hundredth of a point."""
    if script.name in NEEDS:
        need_tool(NEEDS[script.name])
    stored = json.loads(script.with_suffix(".ipynb").read_text(encoding="utf-8"))
    current = module(DOCS / "_extensions" / "notebook.py").notebook(
        script.read_text(encoding="utf-8")
    )
    figures = [[_figures(cell) for cell in made["cells"]] for made in (stored, current)]
    assert stored == current  # figures are taken out
    for old, new in zip(*figures, strict=True):
        assert old.keys() == new.keys()
        for place in old:
            assert np.allclose(_numbers(old[place]), _numbers(new[place]), rtol=0, atol=0.01)


def _figures(cell: dict) -> dict[int, str]:
    outputs = enumerate(cell.get("outputs", []))
    drawn = {
        i: output["data"].pop("image/svg+xml", None) for i, output in outputs if "data" in output
    }
    return {i: "".join(lines) for i, lines in drawn.items() if lines is not None}


def _numbers(svg: str) -> list[float]:
    """Without markers: which point has one is a matter of rounding where two are equally near."""
    drawn = re.sub(r"<use [^>]* y=[^>]*>", "", svg)
    return [float(number) for number in re.findall(r"(?<![\w#])-?\d+(?:\.\d+)?", drawn)]


class _Page(HTMLParser):
    """What a page links to, loads and names."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: list[str] = []
        self.loaded: list[str] = []
        self.names: set[str] = set()
        self.formulas = 0
        self.unnamed_images = 0
        self.feed(text)

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        values = {key: value or "" for key, value in attributes}
        self.names |= {values[key] for key in ("id", "name") if key in values}
        self.formulas += tag == "math"
        self.unnamed_images += tag == "img" and not values.get("alt")
        if tag == "a" and "href" in values:
            self.links.append(values["href"])
        elif tag == "link" and values.get("rel") not in ("search", "index", "next", "prev"):
            self.loaded.append(values["href"])
        self.loaded += [values["src"]] if "src" in values else []


@pytest.fixture(scope="session")
def site(tmp_path_factory):
    """The pages as `make docs` builds them; a warning is an error."""
    from sphinx.cmd.build import main as sphinx  # only where it is needed: both processes collect

    folder = tmp_path_factory.mktemp("site")
    options = ("-W", "--keep-going", "-q", "-b", "html", "-d", str(folder / "cache"))
    told = io.StringIO()
    with warnings.catch_warnings(action="ignore"), redirect_stderr(told):
        status = sphinx([*options, str(DOCS), str(folder / "html")])
    assert status == 0, told.getvalue()
    found = {
        path.relative_to(folder / "html").as_posix(): _Page(path.read_text(encoding="utf-8"))
        for path in (folder / "html").rglob("*.html")
    }
    return folder / "html", found


def test_every_link_leads_somewhere(site):
    folder, found = site
    broken = []
    for name, page in found.items():
        for link in page.links:
            if re.match(r"[a-z]+:", link):
                continue
            target, _, fragment = link.partition("#")
            path = (folder / name).parent.joinpath(target).resolve() if target else folder / name
            place = path.relative_to(folder.resolve()).as_posix() if target else name
            known = found[place].names if place in found else None
            if not path.exists() or (fragment and known is not None and fragment not in known):
                broken.append(f"{name}: {link}")
    assert not broken


def test_nothing_comes_from_the_network(site):
    folder, found = site
    loaded = [source for page in found.values() for source in page.loaded]
    assert not [source for source in loaded if re.match(r"(https?:)?//", source)]
    styles = [path.read_text(encoding="utf-8") for path in folder.rglob("*.css")]
    assert not [s for s in styles if re.search(r"(url\(|@import )['\"]?(https?:)?//", s)]


def test_pages_fit_a_phone_and_a_screen(site, window):
    folder, found = site
    for name in found:
        window.size(390, 900)
        window.open(folder / name, "document.readyState === 'complete'")
        for width in (390, 1280):
            window.size(width, 900)
            assert window.run("document.documentElement.scrollWidth") <= width, name


def test_what_is_for_the_keyboard_alone_is_not_printed(site, window):
    """All pages have it from one template."""
    folder, _ = site
    window.open(folder / "index.html", "document.readyState === 'complete'")
    link = "getComputedStyle(document.querySelector('.skip-to-content')).display"
    for media, shown in (("print", False), ("", True)):
        window.command("Emulation.setEmulatedMedia", media=media)
        assert (window.run(link) != "none") == shown


def test_formulas_and_pictures_can_be_read(site):
    folder, found = site
    assert found["reference/equations.html"].formulas > 100
    assert all(page.unnamed_images == 0 for page in found.values())
    assert (folder / "_static" / "stix-two-math.woff2").is_file()
    for name in found:  # outside blocks of code no formula is left as it was typed
        text = (folder / name).read_text(encoding="utf-8")
        assert "\\frac" not in re.sub(r"(?s)<pre>.*?</pre>", "", text), name
