"""The command `derive`, as it is installed."""

import json
import re
from dataclasses import replace

import pytest
from sympy.core.function import UndefinedFunction

from derive import catalogue, check, verification
from derive.cli import main
from derive.equations import Status
from derive.symbols import QUANTITIES
from derive.typeset.macros import macro_name, macros
from derive.zero import same
from tests.derive.reading_back import read_back


def _json(capsys: pytest.CaptureFixture[str], *arguments: str) -> object:
    assert main([*arguments, "--json"]) == 0
    return json.loads(capsys.readouterr().out)


def test_list_has_what_the_contract_asks(capsys):
    rows = _json(capsys, "list")
    assert isinstance(rows, list)
    assert all(set(row) >= {"id", "section", "title", "status"} for row in rows)
    assert {row["status"] for row in rows} <= {status.value for status in Status}


def test_srepr_is_a_relation_with_the_names_of_the_contract(capsys):
    assert main(["show", "21", "--as", "srepr"]) == 0
    relation = read_back(capsys.readouterr().out)
    assert " ".join(sorted(s.name for s in relation.free_symbols)) == "H_c K_c T V f_c p_max u_cum"
    assert same(relation, catalogue.equation("21").relation)


@pytest.mark.parametrize("form", ["text", "mathml", "json"])
def test_every_form_of_every_equation_of_the_note(form, capsys):
    """JSON has the others."""
    for equation in catalogue.all_equations():
        assert main(["show", equation.id, "--as", form]) == 0
        assert capsys.readouterr().out.strip()


def test_names_are_those_of_the_vocabulary():
    """What a reader of srepr meets is in the table, or a bound variable."""
    for equation in catalogue.all_equations():
        if equation.id[0].isdigit():
            names = {s.name for s in equation.relation.free_symbols}
            functions = {f.__name__ for f in equation.relation.atoms(UndefinedFunction)}
            assert names | functions <= set(QUANTITIES), equation.id


def test_steps_tell_rule_parents_assumptions_and_status(capsys):
    document = _json(capsys, "steps", "17b")
    assert isinstance(document, dict)
    steps = document["steps"]
    assert [step["step"] for step in steps] == list(range(1, len(steps) + 1))
    assert len({(*step["hypotheses"], step["claim"], step["rule"]) for step in steps}) == len(steps)
    for step in steps:
        assert step["status"] in ("given", "proved")
        assert all(parent < step["step"] for parent in step["parents"])
        assert {"rule", "assumptions", "claim"} <= set(step)


def test_verify_has_the_form_of_the_contract(capsys):
    rows = _json(capsys, "verify", "1", "7c")
    assert isinstance(rows, list)
    assert [row["id"] for row in rows] == ["1", "7c"]
    for row in rows:
        assert all(check["passed"] is True and check["detail"] for check in row["checks"])


def test_a_failing_check_is_status_1(monkeypatch, capsys):
    planted = (check.Check("proof", False, "planted"),)
    monkeypatch.setattr(verification, "step_checks", lambda _: planted)
    assert main(["verify", "1"]) == 1
    assert "planted" in capsys.readouterr().out


def test_unknown_ids_are_told_all_at_once_with_what_is_near(capsys):
    assert main(["show", "static-solutoin"]) == 2
    assert "did you mean static-solution" in capsys.readouterr().err
    assert main(["verify", "211", "nonsense"]) == 2
    assert re.search("211(.|\n)*nonsense", capsys.readouterr().err)


@pytest.mark.parametrize("target", ["numpy", "c", "fortran", "javascript"])
def test_code_of_a_variant(target, capsys):
    assert main(["code", "rigid_bearing", "--target", target]) == 0
    text = capsys.readouterr().out
    assert "(13)" in text or "13" in text
    assert "tanh(" not in text


def test_a_variant_that_is_not_there(capsys):
    assert main(["code", "rigid_baering"]) == 2
    assert "rigid_bearing" in capsys.readouterr().err


def test_generated_code_is_up_to_date(capsys):
    assert main(["generate", "--check"]) == 0
    assert "up to date" in capsys.readouterr().out


def test_latex_is_written_whole(tmp_path, capsys):
    file = tmp_path / "equations.tex"
    assert main(["latex", "-o", str(file)]) == 0
    assert file.read_text(encoding="utf-8") == macros(catalogue.all_equations())
    assert main(["latex", "-o", str(tmp_path / "missing" / "equations.tex")]) == 2
    assert "missing" in capsys.readouterr().err


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


def test_steps_show_formulas_as_on_paper(capsys):
    assert main(["steps", "22"]) == 0
    shown = capsys.readouterr().out
    assert "lim p(t) = " in shown
    assert not re.search(r"Eq\(|Limit\(|``", shown)


def test_lists_end_with_a_sum(capsys):
    assert main(["list"]) == 0
    *_, last = capsys.readouterr().out.splitlines()
    assert re.match(rf"{len(catalogue.all_equations())} equations: \d+ derived, ", last)
    assert main(["verify", "1"]) == 0
    *_, last = capsys.readouterr().out.splitlines()
    assert re.fullmatch(r"1 equation, \d+ checks: all hold", last)


def test_a_derivation_names_a_hypothesis_of_two_relations(capsys):
    assert main(["latex", "problem-i", "--derivation"]) == 0
    assert "0 < R_a" in capsys.readouterr().out
