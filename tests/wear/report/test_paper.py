"""The paper: complete, held together by its references, without a number that nobody computed."""

from __future__ import annotations

import dataclasses
import json
import re
from collections import Counter
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from derive.catalogue import equations
from tests.wear.browser import browser
from tests.wear.report import quick
from tests.wear.report.test_html import Outline
from wear.report import paper_introduction
from wear.report.audit import audit
from wear.report.document import (
    Claims,
    Document,
    Equation,
    Figure,
    Given,
    Number,
    Prose,
    Reference,
    Section,
    Steps,
    Text,
)
from wear.report.html import page
from wear.report.material import Material
from wear.report.numbering import number
from wear.report.runs import CUTOFF, Runs, known
from wear.report.tex import report
from wear.report.typeset import typeset
from wear.report.verification import verified
from wear.report.walk import all_prose, blocks


@pytest.fixture(scope="module")
def runs() -> Runs:
    return quick.runs()


@pytest.fixture(scope="module")
def paper() -> Document:
    return quick.paper()


def test_no_number_in_the_text_is_typed(paper: Document) -> None:
    assert audit(paper) == ()


def test_the_paper_holds_together(paper: Document) -> None:
    marks = number(paper)
    assert len(marks) > len(equations())


def test_every_equation_stands_in_it_once(paper: Document) -> None:
    """Nor does one repeat another: the logarithmic drift is what Eq. (19) should have been."""
    shown = Counter(b.label for b in blocks(paper) if isinstance(b, Equation))
    assert shown == Counter(f"eq:{e.id}" for e in equations() if e.id != "log-drift")


def test_works_are_numbered_in_the_order_in_which_the_text_cites_them(paper: Document) -> None:
    marks = number(paper)
    told = [
        piece.label for text in all_prose(paper) for piece in text if isinstance(piece, Reference)
    ]
    cited = list(dict.fromkeys(label for label in told if marks[label].kind == "work"))
    assert [marks[label].name for label in cited] == [f"[{n + 1}]" for n in range(len(cited))]
    assert cited == [label for label, mark in marks.items() if mark.kind == "work"]
    assert {"ref:note", "ref:archard1953", "ref:kuczma1990", "ref:filippov1988"} <= set(cited)


def test_equations_of_the_note_have_its_numbers(paper: Document) -> None:
    marks = number(paper)
    for equation in equations():
        if re.fullmatch(r"\d+[a-g]?", equation.id):
            assert marks[f"eq:{equation.id}"].number == equation.id


def test_corrected_equations_show_the_printed_form_beside(paper: Document) -> None:
    agrees = {f"eq:{equation.id}": equation.agrees for equation in equations()}
    for block in blocks(paper):
        if isinstance(block, Equation):
            assert bool(block.printed) == (not agrees[block.label])


def test_every_step_stands_once(paper: Document) -> None:
    """A step with a formula is not told twice, and none refers to one that comes later."""
    steps = [block for block in blocks(paper) if isinstance(block, Steps)]
    told = Counter(step for block in steps for step in block.steps if step.latex)
    assert max(told.values()) == 1
    for block in steps:
        for place, step in enumerate(block.steps, start=1):
            here = [
                piece.text
                for piece, after in zip(step.text, (*step.text[1:], Text("")), strict=True)
                if isinstance(piece, Given) and after != Text(" of the ")
            ]
            numbers = [int(n) for text in here for n in re.findall(r"^step (\d+)$", text)]
            assert all(n < place for n in numbers), (block.label, place)


def test_the_four_figures_of_the_note_are_files(paper: Document) -> None:
    files = {block.file for block in blocks(paper) if isinstance(block, Figure)}
    assert {"figure-2a", "figure-2b", "figure-3a", "figure-3b"} <= files


def test_every_claim_decided_is_in_the_ledger(paper: Document) -> None:
    (ledger,) = (block for block in blocks(paper) if isinstance(block, Claims))
    assert [(c.id, c.verdict) for c in ledger.claims] == [
        (entry.claim.id, str(entry.finding.verdict)) for entry in quick.few_claims()
    ]


def test_both_writers_take_it(paper: Document) -> None:
    assert "<h1>" in page(paper)
    sources = report(paper)
    assert all(f"Eq{name}}}" in sources.equations for name in ("WearPerCycle", "ContactLaw"))


def test_the_abstract_has_the_numbers_of_the_run(paper: Document, runs: Runs) -> None:
    values = [piece.value for piece in paper.abstract if isinstance(piece, Number)]
    assert known(runs.fate("section4").wear_per_cycle_mm) in values
    assert known(runs.fate("section4" + CUTOFF).arrest_cycle) in values


def test_a_number_of_another_run_is_another_number(runs: Runs) -> None:
    """The text follows the runs: a changed wear per cycle is changed wherever it is told."""
    case = runs.cases["section4"]
    fate = dataclasses.replace(case.fate, wear_per_cycle_mm=1.25e-9)
    changed = dataclasses.replace(runs, cases={**runs.cases, "section4": case._replace(fate=fate)})
    other = Material((), quick.trusted(()), changed, (), (), {})
    findings = paper_introduction.section(other)
    told = [p.value for text in _prose(findings) for p in text if isinstance(p, Number)]
    assert 1.25e-9 in told
    assert known(case.fate.wear_per_cycle_mm) not in told


def _prose(section: Section) -> list[Prose]:
    return list(all_prose(Document("", (), (), (section,))))


def test_a_constant_that_the_regime_lacks_is_an_error() -> None:
    with pytest.raises(ValueError, match="does not have"):
        known(None)


def test_the_verification_finds_a_wrong_step() -> None:
    """A statement whose claim was changed fails, and is named."""
    (good,) = (e for e in equations() if e.id == "7c")
    (statement,) = good.statements
    wrong = dataclasses.replace(statement, claim=statement.claim.func(
        statement.claim.lhs, 2 * statement.claim.rhs
    ))  # fmt: skip
    bad = dataclasses.replace(good, statements=(wrong,))
    assert verified([good]).passed
    outcome = verified([good, bad])
    assert not outcome.passed
    assert {identifier for identifier, _ in outcome.failures} == {"7c"}


def test_steps_that_are_the_same_are_checked_once() -> None:
    (closure, again) = (e for e in equations() if e.id in ("1", "7a"))
    assert verified([closure, again]).steps == 1


# Analysis and numerics: what the tables of the paper say


def test_the_approach_follows_the_predicted_law(runs: Runs) -> None:
    """Excess of wear per cycle and pressure over their limits: A/(N u_cum), ever more closely."""
    for excess in (runs.approach.excess, runs.approach.pressure_excess):
        off = np.abs(excess / runs.approach.predicted - 1.0)[5:]
        assert np.all(np.diff(off) < 0.0)
        assert off[-1] < 1e-4
    assert runs.threshold_excess == pytest.approx(1e-6, rel=1e-4)


def test_the_closed_solution_is_the_solver_s(runs: Runs) -> None:
    assert runs.static.distance < 1e-12


def test_two_solvers_agree(runs: Runs) -> None:
    assert set(runs.integrated) == {"section4", "section3" + CUTOFF}
    assert max(runs.integrated.values()) < 2e-9


def test_bounds_contain_the_wear_and_each_other(runs: Runs) -> None:
    wear = float(runs.history("section4").u_c[-1])
    tight, loose = runs.wear_bounds, runs.static_bounds
    assert loose.low < tight.low < wear < tight.high < loose.high


def test_arrest_is_where_the_formula_says(runs: Runs) -> None:
    stopped = [case for name, case in runs.cases.items() if name.endswith(CUTOFF)]
    assert len(stopped) == 6
    for case in stopped:
        assert case.history.u_c[-1] == pytest.approx(known(case.fate.arrest_wear_mm), rel=1e-9)


def test_the_rate_is_at_its_limit_at_two_phases_of_every_cycle(runs: Runs) -> None:
    assert runs.phases.distance < 1e-13
    assert np.all((runs.phases.phases > 0.5) & (runs.phases.phases < 1.0))


def test_runs_have_a_place_in_json(runs: Runs) -> None:
    assert json.dumps({name: case.scene.to_tables() for name, case in runs.cases.items()})


def test_the_paper_compiles_and_numbers_as_the_page_does(
    paper: Document, tmp_path: Path, need_tool: Callable[..., str]
) -> None:
    """No warning: references undefined, boxes too wide. Equations, figures, tables, sections."""
    need_tool("pdflatex")
    sources = report(paper)
    for name, content in sources.figures.items():
        (tmp_path / name).write_bytes(content)
    (tmp_path / "equations.tex").write_text(sources.equations, encoding="utf-8")
    (tmp_path / "report.tex").write_text(sources.report, encoding="utf-8")
    outcome = typeset(tmp_path / "report.tex")
    assert (outcome.notice, outcome.warnings) == ("", ())
    auxiliary = (tmp_path / "report.aux").read_text(encoding="utf-8")
    numbers = dict(re.findall(r"\\newlabel\{([^}@]+)\}\{\{\{?([^}]*)\}", auxiliary))
    marks = {
        k: m for k, m in number(paper).items() if m.kind not in ("claim", "derivation", "work")
    }
    assert numbers == {label: mark.number for label, mark in marks.items()}
    assert {mark.kind for mark in marks.values()} == {"section", "equation", "figure", "table"}


def test_screen_readers_find_their_way_in_it(paper: Document) -> None:
    outline = Outline(page(paper))
    levels = [int(tag[1]) for tag, _ in outline.tags if re.fullmatch(r"h[1-6]", tag)]
    assert levels[0] == 1
    assert all(b <= a + 1 for a, b in pairwise(levels))
    assert all(a.get("scope") in {"row", "col"} for a in outline.of("th"))
    described = [a["aria-label"] or "" for a in outline.of("svg")]
    assert all(len(text.split()) >= 8 for text in described)
    assert len(set(described)) == len(described)


def test_links_have_names(paper: Document) -> None:
    links = re.findall(r"<a\b[^>]*>(.*?)</a>", page(paper), flags=re.DOTALL)
    assert all(re.sub(r"<[^>]*>", "", name).strip() for name in links)


def test_on_a_phone_captions_are_read_without_scrolling(
    paper: Document, tmp_path: Path, need_tool: Callable[..., str]
) -> None:
    """Tables and figures may be wider, in boxes of their own; letters are not made too small."""
    file = tmp_path / "report.html"
    file.write_text(page(paper), encoding="utf-8")
    with browser(need_tool("chromium", "google-chrome"), tmp_path / "profile") as phone:
        phone.size(390, 800)
        phone.open(file, "document.readyState === 'complete'")
        assert phone.run("document.documentElement.scrollWidth") == 390
        right = "[...document.querySelectorAll('caption div, figcaption')].map(e => "
        assert max(phone.run(right + "e.getBoundingClientRect().right)")) <= 390
        scale = "[...document.querySelectorAll('figure svg')].map(e => "
        drawn = phone.run(scale + "e.getBoundingClientRect().width / e.viewBox.baseVal.width)")
        assert min(drawn) >= 1.1  # pixels a point: eight points are nine pixels
