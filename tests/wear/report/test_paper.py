"""The paper: complete, held together by its references, without a number that nobody computed."""

import ast
import copy
import dataclasses
import json
import re
from collections import Counter
from collections.abc import Mapping
from functools import partial
from importlib.resources import files
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import derive.note.claim_checks
from derive.catalogue import all_equations
from derive.check import Check
from derive.files import write_atomically
from derive.verification import Verification, perform, tasks, verification_of
from tests.wear.report import quick
from tests.wear.report.test_html import Outline
from tests.wear.report.test_tex import numbers_labels_as_the_page_does
from wear.report import claims, note
from wear.report.document import Document
from wear.report.html import page
from wear.report.note import CUTOFF, required
from wear.report.number import TextNumber
from wear.report.paper import paper as written
from wear.report.publish import typeset
from wear.report.tex import report
from wear.report.text import inline
from wear.scene import Scene

_TEXT = files("wear.report").joinpath("paper.md").read_text(encoding="utf-8")
#: What the typed text may hold besides words: values, code, references, equations, layout.
_NOT_WORDS = re.compile(
    r"\{\{.*?\}\}|\{%.*?%\}|```.*?```|`[^`]*`|\{#[^}]*\}|\[\(?[a-z]+:[^\]]*\]|"
    r"\]\(fig:[\w-]+|^\d\. ",
    re.DOTALL | re.MULTILINE,
)
_FORMULA = re.compile(r"\$([^$]*)\$")
_RESULT = re.compile(r"\d\s*[.,]\s*\d|10\s*\^|\\%|\d{3}|\d[eE][-+]?\d")
_NUMBER_WORD = re.compile(
    r"\b(?:dozen|(?:thir|four|fif|six|seven|eigh|nine)teen|(?:twen|thir|for|fif|six|seven|eigh|nine)ty"
    r"|hundred|thousand|(?:m|b|tr)illion)(?:s|th|fold)?\b",
    re.IGNORECASE,
)


@pytest.fixture(scope="module")
def runs():
    return quick.runs()


@pytest.fixture(scope="module")
def paper():
    return quick.paper()


def test_no_number_in_the_text_is_typed():
    """Digits stand in formulas (small ones), in quoted equation numbers, and nowhere else."""
    words = _NOT_WORDS.sub(" ", _TEXT)
    assert [found for found in _FORMULA.findall(words) if _RESULT.search(found)] == []
    plain = re.sub(r"\(\d+[a-g]?\)", " ", _FORMULA.sub(" ", words))  # equation (7e) of the note
    assert re.findall(r".{20}\d.{20}", plain) == []
    assert _NUMBER_WORD.findall(plain) == []


def test_every_equation_stands_in_it_once(paper):
    """Those that say the same stand there under the number of the first."""
    shown = Counter(equation.id for equation in paper.shown)
    assert max(shown.values()) == 1
    assert {f"eq:{e.id}" for e in all_equations()} <= set(paper.marks)
    formulas = Counter((e.latex, e.title.partition(",")[2]) for e in paper.shown)
    assert [formula for formula, times in formulas.items() if times > 1] == []


def test_the_text_has_at_most_fifty_equations():
    text = _TEXT.partition("{#app:")[0]
    named = re.findall(r"^```equations\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    assert sum(len(names.split()) for names in named) <= 50


def test_works_are_numbered_in_the_order_in_which_the_text_cites_them(paper):
    assert [paper.marks[f"ref:{key}"].number for key in paper.works] == [
        str(n + 1) for n in range(len(paper.works))
    ]
    assert {"note", "archard1953", "kuczma1990", "filippov1988"} <= set(paper.works)


def test_equations_of_the_note_have_its_numbers(paper):
    for equation in all_equations():
        if re.fullmatch(r"\d+[a-g]?", equation.id):
            assert paper.marks[f"eq:{equation.id}"].number == equation.id


def test_corrected_equations_show_the_printed_form_beside(paper):
    agrees = {equation.id: equation.agrees for equation in all_equations()}
    for equation in paper.shown:
        assert bool(equation.printed) == (not agrees[equation.id])


def test_what_names_mean_stands_beside_an_equation(paper):
    definitions = {equation.id: equation.definitions_latex for equation in all_equations()}
    for equation in paper.shown:
        formulas = [formula for line in equation.where for formula in line.split(r", \quad ")]
        assert tuple(formulas) == definitions[equation.id]
    assert paper.equations["saturating-wear"].where[0].startswith("M = ")


def _conclusion(step):
    return step.relation, frozenset(step.hypotheses)


def test_every_step_stands_once(paper):
    """A formula stands again only under other conditions, and no step refers to a later one."""
    tokens, place = paper.tokens, 0
    formulas = Counter(t.content for t in tokens if t.type == "fence" and t.info == "math")
    under = {_conclusion(step) for equation in all_equations() for step in equation.steps}
    allowed = Counter(relation for relation, _ in under)
    assert max(formulas.values()) <= max(allowed.values())
    assert sum(n > 1 for n in formulas.values()) <= sum(n > 1 for n in allowed.values())
    for before, token in pairwise(tokens):
        place = int(before.info or 0) if before.type == "list_item_open" else place
        own = re.findall(r"\bstep (\d+)\b(?! of the)", token.content)
        assert all(int(n) < place for n in own), token.content


def test_the_four_figures_of_the_note_are_files(paper):
    assert {f"fig:figure-{name}" for name in ("2a", "2b", "3a", "3b")} <= set(paper.figures)


def test_every_claim_decided_is_in_the_ledger(paper):
    claims = [t.content for t in inline(paper.tokens) if t.type == "target"]
    verdicts = [t.content for t in inline(paper.tokens) if t.type == "verdict"]
    decided = quick.few_claims()
    assert claims == [f"claim:{entry.claim.id}" for entry in decided]
    assert verdicts == [str(entry.finding.verdict) for entry in decided]


def test_both_writers_take_it(paper):
    assert "<h1>" in page(paper)
    sources = report(paper)
    assert "[U+" not in sources["report.tex"]  # every character has a form
    assert all(f"Eq{name}}}" in sources["equations.tex"] for name in ("WearPerCycle", "ContactLaw"))


def numbers(paper: Document) -> list[TextNumber]:
    """Return the numbers of the text, in reading order."""
    return [t.meta["number"] for t in inline(paper.tokens) if t.type == "number"]


def test_the_findings_have_the_numbers_of_the_run(paper, runs):
    values = {number.value for number in numbers(paper)}
    assert required(runs.asymptotes["section4"].wear_per_cycle_mm) in values
    assert required(runs.asymptotes["section4" + CUTOFF].arrest_cycle) in values


#: Sources of numbers that another run has too: what is asked for, quoted, or mathematics.
_CONSTANT = re.compile(
    r"scene |the note|printed in the note|request|benchmark|derivation|threshold|resolution of the "
    r"arithmetic|1/\(1 \+ e\^24\)|Eq\. \(4\) at h = 3 sigma|ledger|hard scenes|approach, section "
    r"|section [35]$|scenes of section 5|bracket of Eq\. \(16\)|catalogue of equations"
)


def test_a_changed_run_changes_every_number(paper):
    found = all_equations()
    trusted = quick.trusted(found)
    checks = tuple(Check(kind, False, "") for kind in ("proof", "falsifier", "coq", "dimensions"))
    changed = Verification(
        {**trusted.outcomes, "one more": checks}, (("1", checks[0]),), trusted.equations + 1
    )
    random = np.random.default_rng(1)
    runs = _changed(quick.runs(), random)
    other = written(found, changed, runs, quick.few_claims(), paper.figures)
    pairs = zip(numbers(paper), numbers(other), strict=True)
    same = {(a.source, a.value) for a, b in pairs if a.value == b.value}
    assert {number for number in same if not _CONSTANT.match(number[0])} == set()


def _changed(value: Any, random: np.random.Generator) -> Any:
    """The value with every floating-point number in it larger; scenes are kept."""
    match value:
        case Scene():
            return value
        case float():
            return value * (1.0 + random.uniform(0.6, 0.9))
        case np.ndarray() if value.dtype.kind == "f":
            return value * (1.0 + random.uniform(0.6, 0.9, value.shape))
        case int() if value > 0:
            return value + 7
        case Mapping():
            return {key: _changed(inner, random) for key, inner in value.items()}
        case tuple() if hasattr(value, "_replace"):
            return type(value)(*(_changed(inner, random) for inner in value))
        case tuple():
            return tuple(_changed(inner, random) for inner in value)
        case _ if dataclasses.is_dataclass(value) and not isinstance(value, type):
            fields = {f.name: getattr(value, f.name) for f in dataclasses.fields(value)}
            kept = {"cycles"}  # those asked for
            return dataclasses.replace(
                value, **{k: _changed(v, random) for k, v in fields.items() if k not in kept}
            )
        case _:
            return value


def test_the_evidence_for_a_claim_has_no_typed_result():
    typed = re.compile(r"\d\.\d|\d[eE]-?\d|\d{3}")
    for module in (claims, note, derive.note.claim_checks):
        for node in ast.walk(ast.parse(Path(module.__file__).read_text(encoding="utf-8"))):
            if isinstance(node, ast.JoinedStr):
                words = "".join(p.value for p in node.values if isinstance(p, ast.Constant))
                assert not typed.search(words), f"{module.__name__}, line {node.lineno}: {words}"


def test_a_constant_that_the_regime_lacks_is_an_error():
    with pytest.raises(ValueError, match="does not have"):
        required(None)


def test_the_verification_finds_a_wrong_step():
    """A judgement whose claim was changed fails, and is named."""
    (good,) = (e for e in all_equations() if e.id == "7c")
    (judgement,) = good.statements
    wrong, claim = copy.copy(judgement), judgement.claim
    object.__setattr__(wrong, "claim", dataclasses.replace(claim, rhs=2 * claim.rhs))
    bad = dataclasses.replace(good, statements=(wrong,))
    assert verification_of([good]).passed
    outcome = verification_of([good, bad])
    assert not outcome.passed
    assert {identifier for identifier, _ in outcome.failures} == {"7c"}


def test_steps_that_are_the_same_are_checked_once():
    (closure, again) = (e for e in all_equations() if e.id in ("1", "7a"))
    assert verification_of([closure, again]).steps == 1


def test_outcomes_of_other_processes_are_put_together():
    chosen = [e for e in all_equations() if e.id in ("1", "7a", "7c")]
    outcomes = [partial(perform, task) for task in tasks(chosen)]
    assert verification_of(chosen, outcomes) == verification_of(chosen)


# Analysis and numerics: what the tables of the paper say


def test_the_approach_follows_the_predicted_law(runs):
    """Excess of wear per cycle and pressure over their limits: A/(N u_cum), ever more closely."""
    for excess in (runs.approach.excess, runs.approach.pressure_excess):
        off = np.abs(excess / runs.approach.predicted - 1.0)[5:]
        assert np.all(np.diff(off) < 0.0)
        assert off[-1] < 1e-4
    assert runs.threshold_excess == pytest.approx(1e-6, rel=1e-4)


def test_the_closed_solution_is_the_solver_s(runs):
    assert runs.static_distance < 1e-12


def test_two_solvers_agree(runs):
    assert set(runs.integrated) == {"section4", "section3" + CUTOFF}
    assert max(runs.integrated.values()) < 2e-9


def test_bounds_contain_the_wear_and_each_other(runs):
    history = runs.histories["section4"]
    (wear,) = history.u_c[np.isin(history.cycles, quick.BOUNDED)]
    tight, loose = runs.wear_bounds, runs.static_bounds
    assert loose.low < tight.low < wear < tight.high < loose.high


def test_arrest_is_where_the_formula_says(runs):
    stopped = [name for name in runs.histories if name.endswith(CUTOFF)]
    assert len(stopped) == 6
    for name in stopped:
        depth = required(runs.asymptotes[name].arrest_wear_mm)
        assert runs.histories[name].u_c[-1] == pytest.approx(depth, rel=1e-9)


def test_the_rate_is_at_its_limit_at_two_phases_of_every_cycle(runs):
    assert runs.phase_distance < 1e-13


def test_runs_have_a_place_in_json(runs):
    histories = runs.histories.items()
    assert json.dumps({name: each.definition.to_tables() for name, each in histories})


def test_the_paper_compiles_and_numbers_as_the_page_does(paper, tmp_path, need_tool):
    """No warning: references undefined, boxes too wide. Equations, figures, tables, sections."""
    need_tool("pdflatex")
    for name, content in report(paper).items():
        write_atomically(tmp_path / name, content)
    outcome = typeset(tmp_path / "report.tex")
    assert (outcome.notice, outcome.warnings) == ("", ())
    assert numbers_labels_as_the_page_does(tmp_path / "report.tex", paper)


def test_screen_readers_find_their_way_in_it(paper):
    outline = Outline(page(paper))
    assert outline.can_be_followed()
    assert outline.of("html")[0]["lang"] == "en"
    assert all(len(outline.of(landmark)) == 1 for landmark in ("nav", "main"))
    assert outline.of("a")[0]["href"] == "#content"
    assert {a["role"] for a in outline.of("svg")} == {"img"}
    described = [a["aria-label"] or "" for a in outline.of("svg")]
    assert all(len(text.split()) >= 8 for text in described)
    assert len(set(described)) == len(described)


def test_links_have_names(paper):
    links = re.findall(r"<a\b[^>]*>(.*?)</a>", page(paper), flags=re.DOTALL)
    assert all(re.sub(r"<[^>]*>", "", name).strip() for name in links)


def test_on_a_phone_captions_are_read_without_scrolling(paper, tmp_path, window):
    """Tables and figures may be wider, in boxes of their own; letters are not made too small."""
    file = tmp_path / "report.html"
    file.write_text(page(paper), encoding="utf-8")
    window.size(390, 800)
    window.open(file, "document.readyState === 'complete'")
    assert window.run("document.documentElement.scrollWidth") == 390
    right = "[...document.querySelectorAll('caption div, figcaption')].map(e => "
    assert max(window.run(right + "e.getBoundingClientRect().right)")) <= 390
    scale = "[...document.querySelectorAll('figure svg')].map(e => "
    drawn = window.run(scale + "e.getBoundingClientRect().width / e.viewBox.baseVal.width)")
    assert min(drawn) >= 1.1  # pixels a point: eight points are nine pixels
