"""The export to Coq: what is stated, what is proved, and that wrong statements are not."""

import os
import re
import shutil

import pytest
import sympy as sp

from derive import catalogue
from derive.claims import Continuous
from derive.coq import export, printer, prove, refutations
from derive.coq.statements import statement, world
from derive.coq.steps import proved_by_coq, record
from derive.laws import GENERAL, r
from derive.rules.inequalities import Arithmetic
from derive.rules.solutions import ByParts
from derive.symbols import symbols, t
from tests.derive.judgements import SLOPE, eq, sloped
from tests.programs import ended

h, sigma, p, p_max, U_a, f_c, N, G, T = symbols("h sigma p p_max U_a f_c N G T")

REQUIRED = ("8", "9", "10", "13", "14", "15", "17a", "17b", "18", "21", "22")

needs_coq = pytest.mark.skipif(
    shutil.which("coqc") is None and not os.environ.get("CI"), reason="coqc is not installed"
)


@pytest.fixture(scope="module")
def deviation(tmp_path_factory):
    """Return a folder with the compiled library, and the exported steps of one equation."""
    folder = tmp_path_factory.mktemp("coq")
    made = export.Export((catalogue.equation("7c"), catalogue.equation("deviation")))
    made.write(folder)
    assert export.compile_faults(folder, jobs=1) == ""
    return folder, made


@pytest.mark.parametrize(
    ("expr", "written"),
    [
        (sp.tanh(4 - 2 * h / sigma), "-(tanh (2*h t/sigma t - 4))"),
        (1 / (sp.Symbol("x") * (1 + sp.Symbol("y"))), "1/(x*(y + 1))"),
        (sp.Pow(h**2 + 1, sp.Rational(-3, 2)), "(/ ((sqrt ((h t)^2 + 1))^3))"),
        (-sp.exp(-p_max) - sp.Rational(1, 2), "-1/2 - (exp (-(p_max)))"),
        (sp.Derivative(h.subs(t, t + 1), t), "Derive (fun t => h (t + 1)) t"),
        (sp.Integral(U_a, (t, 0, 1)), "RInt (fun t => U_a t) 0 1"),
    ],
)
def test_terms_keep_their_structure(expr, written):
    assert printer.term(expr) == written


def test_what_the_library_lacks_is_named():
    with pytest.raises(printer.UntranslatableError, match="besseli"):
        printer.term(sp.besseli(0, p_max))


def test_a_statement_keeps_every_premise():
    """A hypothesis on a clock, the domains of fields at other times, and the slope of a law."""
    with pytest.raises(printer.UntranslatableError, match="N, which varies"):
        statement(Arithmetic(sp.Ge(G, 0, evaluate=False))(eq(N, G)))
    later = Arithmetic(sp.Ge(p.subs(t, t + T), 0, evaluate=False))()
    assert "forall t, 0 <= t -> 0 <= p t" in statement(later).text
    law = sp.Subs(sp.diff(GENERAL.phi, r), r, symbols("q")[0])
    assert "Derive phi r < 0" in statement(Arithmetic(sp.Lt(law, 0))()).text
    assert "Derive phi q < 0" in statement(Arithmetic(sp.Lt(law, 0))()).conclusion


@pytest.mark.parametrize(
    "relation",
    [sp.Eq(p ** sp.Rational(1, 3), 0), Continuous(U_a.subs(t, t + T))],
)
def test_what_coq_would_take_for_something_else_is_not_stated(relation):
    """Its power is 1 at 0, and continuity is that of a function."""
    with pytest.raises(printer.UntranslatableError):
        printer.proposition(relation)


def test_a_sum_with_a_limit_is_no_product():
    end = sp.Limit(h / sigma, t, sp.oo)
    product, whole = (sp.Eq(side, 0, evaluate=False) for side in (f_c * end, f_c + end))
    assert printer.proposition(product).endswith("f_c * l = 0")
    with pytest.raises(printer.UntranslatableError, match="Limit"):
        printer.proposition(whole)


def test_the_slope_of_a_name_without_a_function_has_no_statement():
    with pytest.raises(printer.UntranslatableError, match="no function"):
        statement(eq(symbols("q")[0], sp.Derivative(p_max, symbols("k")[0])))
    assert statement(sloped()).conclusion
    with pytest.raises(printer.UntranslatableError, match="no function"):
        statement(Arithmetic(sp.Ge(SLOPE + 1, SLOPE, evaluate=False))(sloped()))


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (sp.Symbol("x_of"), sp.Function("x")(t)),
        (symbols("C")[0], sp.Symbol("C_")),
        (sp.Symbol("a"), sp.Dummy("a")),
        (sp.Symbol("p"), p),
    ],
)
def test_two_quantities_of_one_name_are_refused(one, other):
    with pytest.raises(printer.UntranslatableError, match=f"both be {printer.name(str(one))}"):
        world([sp.Eq(one, other)])


def test_no_quantity_has_a_name_of_the_library():
    assert printer.name("tanh") == "tanh_"
    assert printer.name("tends") == "tends_"


def test_what_coq_refuses_is_open_and_what_does_not_cite_it_is_closed(monkeypatch):
    equations = (catalogue.equation("arrest-depth"),)
    made = export.Export(equations)
    (refused,) = (step for step in made.steps if step.rule == "Insert")
    tried = []

    def session(_, texts, proved):
        assert not proved.isdisjoint(texts.values())
        tried.append(set(texts))
        return {name for name, text in texts.items() if refused.name in text}

    monkeypatch.setattr(prove, "_unproved", session)
    rows = prove.renewed(equations, record())
    assert tried[1] == tried[0] - {refused.name}
    assert {key for key, row in rows.items() if not row["closed"]} == {refused.key}
    assert (
        f"Definition open_{refused.name}" in export.Export(equations, rows).files["Section_cutoff"]
    )


def test_attempts_end_where_coq_closes_nothing(monkeypatch):
    monkeypatch.setattr(prove, "_unproved", lambda _, texts, __: set(texts))
    rows = prove.renewed((catalogue.equation("one-eighth"),), {})
    assert not any(row["closed"] for row in rows.values())


def test_a_statement_has_the_hypotheses_as_premises():
    (ratio,) = catalogue.equation("closure-ratio").statements
    said = statement(ratio)
    relations = [premise.relation for premise in said.premises]
    assert all(h.relation in relations for h in ratio.hypotheses)
    assert said.conclusion.startswith("tends (fun t => ")


def test_a_clock_is_no_constant():
    """`N = t/T` at every t would be a contradiction, from which any claim follows."""
    steps = catalogue.equation("saturating-wear").steps
    (counted,) = (s for s in steps if isinstance(s.rule, ByParts) and N in s.relation.free_symbols)
    said = statement(counted)
    assert "N_" not in said.text
    assert "M*f_c*t/T = " in said.conclusion
    with pytest.raises(printer.UntranslatableError, match="N, which varies in time"):
        printer.always(sp.Eq(N, 1))


@pytest.mark.parametrize("identifier", REQUIRED)
def test_every_step_of_the_note_is_closed(identifier):
    for step in catalogue.equation(identifier).steps:
        assert step.rule.__class__.__name__ == "Assume" or proved_by_coq(step), step.relation


def test_what_the_note_claims_is_refuted_from_closed_steps():
    made = export.Export(tuple(map(catalogue.equation, refutations.NEEDS)))
    text = made.files["Refutations"]
    refuted = dict(re.findall(r"^\(\* (\w+) \*\)\nLemma (\w+) ", text, re.MULTILINE))
    assert set(refuted) == {"C24", "C27", "C32", "C36", "contact"}
    assert all(f"@{name}" in made.files["Assumptions"] for name in refuted.values())


def test_what_is_not_closed_has_a_reason():
    assert all(row["closed"] or row["reason"] for row in record().values())


@pytest.fixture(scope="module")
def everything():
    return export.Export(catalogue.all_equations())


def test_the_record_is_of_these_statements(everything):
    assert everything.unrecorded == ""
    assert len(record()) == len(everything.steps)


def test_every_inference_is_closed_or_listed_with_its_reason(everything):
    proved = [step for step in everything.inferences if proved_by_coq(step)]
    listed = re.findall(r"^\(\* .*:\n   (.+) \*\)$", everything.files["Unstated"], re.MULTILINE)
    assert everything.counts["closed"] == len(proved)
    assert everything.counts["unstated"] == len(listed)
    assert len(proved) + len(listed) == everything.counts["steps"] == len(everything.inferences)


def test_nothing_is_admitted():
    for path in (*export.LIBRARY.glob("*.v"), *export.LIBRARY.glob("*.jinja")):
        text = path.read_text(encoding="utf-8")
        code = re.sub(r"\(\*.*?\*\)|\{#.*?#\}", "", text, flags=re.DOTALL)
        assert not re.search(r"\b(Admitted|admit|Axiom|Parameter|Conjecture|Abort)\b", code), path


def test_another_file_of_the_same_name_is_replaced(tmp_path):
    (tmp_path / "World.v").write_bytes(b"\xe9")
    made = export.Export((catalogue.equation("7c"),))
    made.write(tmp_path)
    assert (tmp_path / "World.v").read_text(encoding="utf-8") == made.files["World"]


@needs_coq
def test_an_export_without_steps_is_compiled(deviation):
    folder, _ = deviation
    made = export.Export((catalogue.equation("1"),))
    assert not made.steps
    (folder / "Empty.v").write_text(made.files["Assumptions"], encoding="utf-8")
    said = ended("coqc", "-q", "-Q", ".", "Wear", "Empty.v", cwd=folder).stdout
    assert "Closed under the global context" in said


@needs_coq
def test_the_sample_is_compiled(deviation):
    folder, made = deviation
    assert made.counts["closed"] == made.counts["steps"]
    assert "Admitted" not in "".join(p.read_text(encoding="utf-8") for p in folder.glob("*.v"))


@needs_coq
def test_mutated_exports_do_not_compile(deviation):
    folder, made = deviation
    lemmas = ((step.name, made.lemma(step)) for step in made.steps)
    (lemma,) = (pair for pair in lemmas if "U_c t = p t/k" in pair[1])
    mutations = {
        "sign": ("U_c t = p t/k", "U_c t = - p t/k"),
        "factor": ("U_c t = p t/k", "U_c t = 2*p t/k"),
        "equilibrium": ("k*U_c t", "k + U_c t"),
        "stiffness": ("(0 < k) ->\n  ", ""),
    }
    texts = {"right": lemma[1]} | {n: lemma[1].replace(*m) for n, m in mutations.items()}
    texts["stiffness"] = texts["stiffness"].replace(" domain_k", "")
    assert len(set(texts.values())) == len(texts)
    session = made.files[next(iter(made.groups))].split("(*", 1)[0] + "".join(
        f"{text.replace(lemma[0], n)}Abort All.\nLocate {n}.\n" for n, text in texts.items()
    )
    command = ["coqtop", "-q", "-w", "none", "-Q", ".", "Wear"]
    said = ended(*command, cwd=folder, input=session).stdout
    assert re.findall(r"Constant Top\.(\w+)", said) == ["right"]
