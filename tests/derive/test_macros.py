"""Macros in documents of other people: they compile there, and stay in the column of an article."""

import os
import re
from pathlib import Path

import pytest
import sympy as sp

from derive import catalogue
from derive.claims import Drift
from derive.cli import main
from derive.symbols import symbols
from derive.typeset.breaking import broken
from derive.typeset.derivation import Derivations, prose
from derive.typeset.display import latex
from derive.typeset.macros import macro_name, macros, room
from tests.programs import run

_HEAD = {
    "article": r"\documentclass{article}",
    "two columns": r"\documentclass[twocolumn]{article}\usepackage[margin=18mm]{geometry}",
}
_WIDE = re.compile(r"Overfull \\hbox \((\d+\.?\d*)pt")
_CHOSEN = ("7c", "8", "21", "22")


def _log(folder: Path, engine: str, head: str, body: str) -> str:
    source = f"{head}\\usepackage{{amsmath,booktabs}}\\input{{equations}}\\begin{{document}}{body}"
    (folder / "other.tex").write_text(source + "\\end{document}\n", encoding="utf-8")
    command = (engine, "-interaction=nonstopmode", "-halt-on-error", "other.tex")
    return run(*command, cwd=folder, env={**os.environ, "max_print_line": "1000"})


def _too_wide(log: str) -> list[float]:
    return [width for width in map(float, _WIDE.findall(log)) if width > 5.0]


@pytest.mark.parametrize("head", _HEAD.values(), ids=_HEAD.keys())
def test_all_macros_compile_elsewhere(head, tmp_path, need_tool):
    engine = need_tool("pdflatex")
    equations = catalogue.all_equations()
    (tmp_path / "equations.tex").write_text(macros(equations), encoding="utf-8")
    shown = (rf"\begin{{equation}}\{macro_name(e)}\end{{equation}}" for e in equations)
    log = _log(tmp_path, engine, head, "\n".join(shown))
    if "twocolumn" not in head:
        assert _too_wide(log) == []


@pytest.mark.parametrize("head", _HEAD.values(), ids=_HEAD.keys())
def test_what_is_quoted_most_fits_with_its_symbols(head, tmp_path, need_tool):
    engine = need_tool("pdflatex")
    chosen = [catalogue.equation(identifier) for identifier in _CHOSEN]
    (tmp_path / "equations.tex").write_text(macros(chosen), encoding="utf-8")
    shown = "".join(rf"\begin{{equation}}\{macro_name(e)}\end{{equation}}" for e in chosen)
    log = _log(tmp_path, engine, head, shown + r"\begin{table*}\WearNomenclature\end{table*}")
    assert _too_wide(log) == []


def test_the_equations_of_an_own_law_fit_a_column(tmp_path, need_tool):
    engine = need_tool("pdflatex")
    place = str(tmp_path / "equations.tex")
    assert main(["latex", "--law", "1/(1 + exp(r - 1))^2", "--width", "246pt", "-o", place]) == 0
    text = Path(place).read_text(encoding="utf-8")
    names = re.findall(r"\\def(\\EqScene\w+)", text)
    assert {r"\EqScenePressure", r"\EqSceneWhole"} <= set(names)
    shown = "".join(rf"\begin{{equation}}{name}\end{{equation}}" for name in names)
    assert _too_wide(_log(tmp_path, engine, _HEAD["two columns"], shown)) == []


@pytest.mark.parametrize("arguments", [["21", "--law", "exp(-r)"], ["--law", "sin(r)"]])
def test_a_law_has_no_ids_and_is_read_by_its_grammar(arguments, capsys):
    assert main(["latex", *arguments]) == 2
    assert "Traceback" not in capsys.readouterr().err


@pytest.mark.parametrize("width", ["246pt", "345pt"])
def test_every_equation_fits_a_column(width, tmp_path, need_tool):
    """Beside its number, by its name and by its id; so does every step of its derivation."""
    engine = need_tool("pdflatex")
    equations = catalogue.all_equations()
    (tmp_path / "equations.tex").write_text(macros(equations, room(width)), encoding="utf-8")
    shown = (
        rf"\begin{{equation}}\{macro_name(e)}\tag{{D.10}}\end{{equation}}\[\EqNote{{{e.id}}}\]"
        for e in equations
    )
    derivations = Derivations(equations)
    steps = (s for e in equations for s in (*derivations.start(e.id), *derivations.steps(e.id)))
    displays = dict.fromkeys(broken(step.latex, room(width)) for step in steps if step.latex)
    head = rf"\documentclass{{article}}\setlength{{\textwidth}}{{{width}}}"
    log = _log(tmp_path, engine, head, "\n".join((*shown, *(rf"\[{d}\]" for d in displays))))
    assert [float(too_wide) for too_wide in _WIDE.findall(log)] == []


@pytest.mark.parametrize(
    "identifier", ["7c", "8", "first-integral", "static-solution-compliant-smooth"]
)
def test_a_derivation_fits_a_column(identifier, tmp_path, need_tool):
    """Prose with equations: starting points, every step, the equation with its number."""
    engine = need_tool("pdflatex")
    text = prose(catalogue.equations_up_to(identifier), room("246pt"))
    assert re.search(rf"\\tag\{{(in )?{identifier}\}}", text)
    assert not re.search(r"\[(?:eq|der):", text)
    steps = [int(number) for number in re.findall(r"Step (\d+)\.", text)]
    assert steps == sorted(set(steps))
    (tmp_path / "equations.tex").touch()
    log = _log(tmp_path, engine, r"\documentclass{article}\setlength{\textwidth}{246pt}", text)
    assert _WIDE.findall(log) == []


def test_a_derivation_starts_from_its_hypotheses_alone():
    """Not from whole systems of which it needs a line: u_a = 0 contradicts a line of (5)."""
    text = prose(catalogue.equations_up_to("21"), room("246pt"))
    assert r"\tag{in 5}" in text
    assert r"\EqWearLaws" not in text
    assert "u_a(0)" not in text


def test_a_derivation_says_what_a_formula_does_not():
    law, terms = (prose(catalogue.equations_up_to(i), 29.0) for i in ("general-law", "expansion"))
    assert "any positive, smooth, decreasing contact law" in law
    assert "of period 1 and mean 0" in terms


def test_a_bare_logarithm_ends_a_product():
    """ln k u_c may be read as ln(k u_c)."""
    k, h, u_c = symbols("k h u_c")
    assert latex(sp.log(k) * u_c) == r"\left(\ln k\right) u_c"
    assert latex(2 * sp.log(k)) == r"2 \ln k"
    assert latex(sp.log(k) ** 2) == r"\ln^{2}{\left(k \right)}"
    pieces = sp.Piecewise((h, h > 0), (0, True))
    assert r"\end{cases}\right) + u_c" in latex(pieces + u_c)


def test_the_variable_of_a_law_of_an_expansion_is_named():
    (x, y), (tau, rho) = sp.symbols("x y", positive=True), symbols("tau rho")
    terms = [Drift(1, 1 + sp.tanh(x / y), each, tau, rho) for each in (x, y)]
    assert latex(terms[0]) != latex(terms[1])
    assert sp.pretty(terms[0]) != sp.pretty(terms[1])


def test_a_rate_is_opened_to_no_quotient():
    assert not re.search(r"mathrm\{d\}t\\bigr", macros(catalogue.all_equations(), 8.0))


def test_a_factor_after_a_broken_fraction_is_not_in_its_denominator():
    """[a]/[b] c may be read as [a]/([b] c)."""
    fraction = r"\frac{K_c V T + x}{6 H_c + y + z + w}"
    assert r"\Big/" in broken(f"a = {fraction}", 7.0)
    assert r"\bigr]\bigr] p" in broken(f"a = {fraction} p", 7.0)


@pytest.mark.parametrize("length", ["246", "3 cm", "wide", "-246pt", "1e9pt"])
def test_what_is_no_width_is_refused(length):
    with pytest.raises(ValueError, match="such as 246pt"):
        room(length)


def test_names_can_be_guessed():
    """Words of the id, the number spelled out, or the word for an equation that is quoted most."""
    assert macro_name(catalogue.equation("7c")) == "EqSevenC"
    assert macro_name(catalogue.equation("static-solution")) == "EqStaticSolution"
    for equation in catalogue.all_equations():
        words = [word for word in equation.id.split("-") if word.isalpha()]
        if not equation.id[0].isdigit():
            assert macro_name(equation).lower() == "eq" + "".join(words)
