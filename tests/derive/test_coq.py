"""The export to Coq: what is stated, what is proved, and that wrong statements are not."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import sympy as sp

from derive import catalogue
from derive.coq import export, printer
from derive.coq.record import proved_by_coq, record
from derive.coq.statements import statement
from derive.symbols import symbols, t

h, sigma, p_max, U_a, f_c = symbols("h sigma p_max U_a f_c")

REQUIRED = ("8", "9", "10", "13", "14", "15", "17a", "17b", "18", "21", "22")

needs_coq = pytest.mark.skipif(
    shutil.which("coqc") is None and not os.environ.get("CI"), reason="coqc is not installed"
)


def coq(folder: Path, text: str) -> str:
    """Compile a text beside the library; return what is said against it."""
    (folder / "Trial.v").write_text(text, encoding="utf-8")
    command = ["coqc", "-q", "-w", "none", "-Q", ".", "Wear", "Trial.v"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    return done.stdout + done.stderr if done.returncode else ""


@pytest.fixture(scope="module")
def deviation(tmp_path_factory):
    """Return a folder with the compiled library, and the exported steps of one equation."""
    folder = tmp_path_factory.mktemp("coq")
    made = export.Export((catalogue.equation("7c"), catalogue.equation("deviation")))
    made.write(folder)
    assert export.compiled(folder, jobs=1) == ""
    return folder, made


@pytest.mark.parametrize(
    ("expr", "written"),
    [
        (sp.tanh(4 - 2 * h / sigma), "- (tanh (2 * h t / sigma t - 4))"),
        (1 / (sp.Symbol("x") * (1 + sp.Symbol("y"))), "1 / (x * (y + 1))"),
        (sp.Pow(h**2 + 1, sp.Rational(-3, 2)), "/ ((sqrt ((h t) ^ 2 + 1)) ^ 3)"),
        (-sp.exp(-p_max) - sp.Rational(1, 2), "- 1 / 2 - exp (- (p_max))"),
        (sp.Derivative(h.subs(t, t + 1), t), "Derive (fun t => h (t + 1)) t"),
        (sp.Integral(U_a, (t, 0, 1)), "RInt (fun t => U_a t) 0 1"),
    ],
)
def test_terms_keep_their_structure(expr, written):
    assert printer.term(expr) == written


def test_what_the_library_lacks_is_named():
    with pytest.raises(printer.UntranslatableError, match="besseli"):
        printer.term(sp.besseli(0, p_max))


def test_a_statement_has_the_hypotheses_as_premises():
    (ratio,) = catalogue.equation("closure-ratio").statements
    said = statement(ratio)
    relations = [premise.relation for premise in said.premises]
    assert all(h.relation in relations for h in ratio.hypotheses if h.relation != sp.true)
    assert said.conclusion.startswith("tends (fun t => ")


@pytest.mark.parametrize("identifier", REQUIRED)
def test_every_step_of_the_note_is_closed(identifier):
    for step in catalogue.equation(identifier).steps:
        assert step.rule.__class__.__name__ == "Assume" or proved_by_coq(step), step.relation


def test_what_is_not_closed_has_a_reason():
    assert all(row["closed"] or row["reason"] for row in record().values())


def test_the_record_is_of_these_statements():
    made = export.Export(catalogue.equations())
    assert made.unrecorded == ""
    assert len(record()) == len(made.steps)


@pytest.mark.parametrize("seed", ["0", "2"])
def test_the_export_is_the_same_under_every_hash_seed(seed, tmp_path):
    identifiers = ["general-law", "closure-ratio"]
    made = export.Export(tuple(map(catalogue.equation, identifiers)))
    made.write(tmp_path / "here")
    command = [sys.executable, "-m", "derive", "export", *identifiers, "-o", tmp_path / "there"]
    subprocess.run(command, env=os.environ | {"PYTHONHASHSEED": seed}, check=True)
    for path in (tmp_path / "here").iterdir():
        assert (tmp_path / "there" / path.name).read_text("utf-8") == path.read_text("utf-8")


def test_nothing_is_admitted():
    for path in export.LIBRARY.glob("*.v"):
        code = re.sub(r"\(\*.*?\*\)", "", path.read_text(encoding="utf-8"), flags=re.DOTALL)
        assert not re.search(r"\b(Admitted|admit|Axiom|Parameter|Conjecture|Abort)\b", code), path


@needs_coq
def test_the_sample_is_compiled(deviation):
    folder, made = deviation
    assert made.counts["closed"] == made.counts["steps"]
    assert "Admitted" not in "".join(p.read_text(encoding="utf-8") for p in folder.glob("*.v"))


@needs_coq
@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        ("U_c t = p t / k", "U_c t = - p t / k"),
        ("U_c t = p t / k", "U_c t = 2 * p t / k"),
        ("(0 < k) ->\n  ", ""),
        ("k * U_c t", "k + U_c t"),
    ],
)
def test_a_mutated_export_does_not_compile(deviation, right, wrong):
    folder, made = deviation
    (text,) = (lemma for lemma in made.lemmas.values() if "U_c t = p t / k" in lemma)
    head = made.files[next(iter(made.groups))][0].split("(*", 1)[0]
    assert coq(folder, head + text) == ""
    mutant = text.replace(right, wrong)
    if wrong == "":
        mutant = mutant.replace(" domain_k", "")
    assert mutant != text
    assert coq(folder, head + mutant) != ""
