"""The command `derive`, as it is installed."""

import json
import re
from dataclasses import replace

import pytest
import sympy as sp
from sympy.core.function import UndefinedFunction

from derive import catalogue, check, verification
from derive.cli import main
from derive.equations import Status
from derive.symbols import QUANTITIES
from derive.typeset.macros import macro_name, macros
from derive.zero import same
from tests.derive.reading_back import read_back


@pytest.fixture
def shown(capsys):
    """`shown("show", "21")` gives what a command prints that ends well."""

    def run(*arguments: str) -> str:
        assert main(arguments) == 0
        return capsys.readouterr().out

    return run


@pytest.fixture
def refused(capsys):
    """`refused(2, "show", "x")` gives what a command says that ends with that status."""

    def run(status: int, *arguments: str) -> str:
        assert main(arguments) == status
        return "".join(capsys.readouterr())

    return run


def test_list_has_what_the_contract_asks(shown):
    rows = json.loads(shown("list", "--json"))
    assert all(set(row) >= {"id", "section", "title", "status"} for row in rows)
    assert {row["status"] for row in rows} <= {status.value for status in Status}


def test_srepr_is_a_relation_with_the_names_of_the_contract(shown):
    relation = read_back(shown("show", "21", "--as", "srepr"))
    assert " ".join(sorted(s.name for s in relation.free_symbols)) == "H_c K_c T V f_c p_max u_cum"
    assert same(relation, catalogue.equation("21").relation)


@pytest.mark.parametrize("form", ["text", "mathml", "json"])
def test_every_form_of_every_equation_of_the_note(form, shown):
    """JSON has the others."""
    for equation in catalogue.all_equations():
        assert shown("show", equation.id, "--as", form).strip()


def test_names_are_those_of_the_vocabulary():
    """What a reader of srepr meets is in the table, or a bound variable."""
    for equation in catalogue.all_equations():
        if equation.id[0].isdigit():
            names = {s.name for s in equation.relation.free_symbols}
            functions = {f.__name__ for f in equation.relation.atoms(UndefinedFunction)}
            assert names | functions <= set(QUANTITIES), equation.id


def test_steps_tell_rule_parents_assumptions_and_status(shown):
    steps = json.loads(shown("steps", "17b", "--json"))["steps"]
    assert [step["step"] for step in steps] == list(range(1, len(steps) + 1))
    assert len({(*step["hypotheses"], step["claim"], step["rule"]) for step in steps}) == len(steps)
    for step in steps:
        assert step["status"] in ("given", "proved")
        assert all(parent < step["step"] for parent in step["parents"])
        assert {"rule", "assumptions", "claim"} <= set(step)


def test_claims_are_printed_alike_in_every_run():
    """A variable of SymPy's own would be printed with a number that depends on the run."""
    for equation in catalogue.all_equations():
        assert not any(step.relation.atoms(sp.Dummy) for step in equation.steps), equation.id


def test_conditions_are_stated_in_words_and_as_formulas(shown):
    found = json.loads(shown("show", "17b", "--as", "json"))
    assert "wear of the bearing roughens it: f_c > 0" in found["conditions"]


def test_verify_has_the_form_of_the_contract(shown):
    rows = json.loads(shown("verify", "1", "7c", "--json"))
    assert [row["id"] for row in rows] == ["1", "7c"]
    for row in rows:
        assert all(check["passed"] is True and check["detail"] for check in row["checks"])


def test_a_failing_check_is_status_1(monkeypatch, refused):
    planted = (check.Check("proof", False, "planted"),)
    monkeypatch.setattr(verification, "step_checks", lambda _: planted)
    assert "planted" in refused(1, "verify", "1")


def test_unknown_ids_are_told_all_at_once_with_what_is_near(refused):
    assert "did you mean static-solution" in refused(2, "show", "static-solutoin")
    assert re.search("211(.|\n)*nonsense", refused(2, "verify", "211", "nonsense"))


@pytest.mark.parametrize("target", ["numpy", "c", "fortran", "javascript"])
def test_code_of_a_variant(target, shown):
    text = shown("code", "rigid_bearing", "--target", target)
    assert "(13)" in text
    assert "tanh(" not in text


def test_a_variant_that_is_not_there(refused):
    assert "rigid_bearing" in refused(2, "code", "rigid_baering")


def test_generated_code_is_up_to_date(shown):
    assert "up to date" in shown("generate", "--check")


def test_latex_is_written_whole(tmp_path, shown, refused):
    file = tmp_path / "equations.tex"
    shown("latex", "-o", str(file))
    assert file.read_text(encoding="utf-8") == macros(catalogue.all_equations())
    assert "missing" in refused(2, "latex", "-o", str(tmp_path / "missing" / "equations.tex"))


def test_macro_names_are_letters_and_differ():
    names = [macro_name(equation) for equation in catalogue.all_equations()]
    assert all(name.isalpha() for name in names)
    assert len(set(names)) == len(names)


def test_a_wrong_abbreviation_is_caught():
    equation = catalogue.equation("pressure-root")
    gap, law = equation.texts["where"].strip().splitlines()
    for where in (f"{gap} + 2 u_a\n{law}", f"{gap}\n{law}/2", gap):
        texts = {**equation.texts, "where": where}
        assert not replace(equation, texts=texts).typeset_agrees


def test_help_of_every_command_shows_an_example(capsys):
    for command in ("list", "show", "steps", "verify", "latex", "code", "generate", "export"):
        with pytest.raises(SystemExit) as stop:
            main([command, "--help"])
        assert stop.value.code == 0
        assert "examples:" in capsys.readouterr().out


def test_steps_show_formulas_as_on_paper(shown):
    text = shown("steps", "22")
    assert "lim p(t) = " in text
    assert not re.search(r"Eq\(|Limit\(|``", text)


def test_lists_end_with_a_sum(shown):
    listed, verified = (shown(*line).splitlines()[-1] for line in (["list"], ["verify", "1"]))
    assert re.match(rf"{len(catalogue.all_equations())} equations: \d+ derived, ", listed)
    assert re.fullmatch(r"1 equation, \d+ checks: all hold", verified)


def test_a_derivation_names_a_hypothesis_of_two_relations(shown):
    assert "0 < R_a" in shown("latex", "problem-i", "--derivation")
