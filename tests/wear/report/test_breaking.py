"""Breaking: nothing is lost, nothing is left too wide, nothing is broken without need."""

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from derive.typeset import mathml
from derive.typeset.breaking import LIMIT, broken
from derive.typeset.formula import parse, rows, source, width
from wear.report.publish import typeset

S = r"\left(\sigma_c^0 + f_c u_c\right)"
LATER = r"\left(\sigma_c^0 + f_c u_c(t + T)\right)"
ROOT = r"\sqrt{\left(\sigma_a^0 + f_a u_a\right)^{2} + \left(\sigma_c^0 + f_c u_c\right)^{2}}"
CLOSURE = (
    r"\left(h_0 + u_c + \frac{3 H_c}{k K_c V} \frac{\mathrm{d}u_c}{\mathrm{d}t} - u_a - U_a\right)"
)
ARGUMENT = rf"\frac{{4 {S} - 2 \left(h_0 + u_c - U_a\right)}}{{\sigma_c^0 + f_c u_c}}"
LONG = {
    "system": r"\left\{\begin{aligned} \frac{\mathrm{d}u_c}{\mathrm{d}t} &= \frac{p_{\max}}{2} "
    rf"\left(1 + \tanh{{\left(\frac{{4 {ROOT} - 2 {CLOSURE}}}{{{ROOT}}}\right)}}\right) \\ "
    r"u_a &= \frac{K_a}{K_c} u_c \end{aligned}\right.",
    "late relation": rf"{ARGUMENT} - {ARGUMENT} - {ARGUMENT} = \frac{{u_c {S} {LATER}}}{{{S}}}",
    "aligned late": r"\begin{aligned} x &= 0 \\ "
    rf"\lim_{{t \to \infty}}\left({ARGUMENT} - {ARGUMENT} - {ARGUMENT}\right) &= 0 \end{{aligned}}",
    "wide numerator": rf"x = \frac{{u_c {S} \left({S} {LATER} - f_c {S} {LATER}\right)}}{{{S}}}",
    "wide denominator": rf"u = \frac{{3 f_c + q}}{{\sqrt{{{S}^{{2}} + {S} {LATER} + {LATER} {S} }}"
    rf" - {S} + {S} - {S}}}",
    "wide root": rf"u = \sqrt{{{S} + {LATER} + {S} + {LATER} + {S}}}",
}


def _names(latex: str) -> list[str]:
    """The letters and digits of a formula in any order, without its layout and operators."""
    plain = re.sub(r"\\(?:begin|end)\{\w+\}|\\[A-Za-z]+|\^\{1/2\}|\\frac\{1\}", " ", latex)
    return sorted(re.findall(r"[A-Za-z0-9]", plain))


@pytest.mark.parametrize("latex", LONG.values(), ids=LONG.keys())
def test_nothing_is_lost(latex):
    before, after = _names(latex), _names(broken(latex))
    assert [name for name in after if name != "1"] == [name for name in before if name != "1"]


@pytest.mark.parametrize("latex", LONG.values(), ids=LONG.keys())
def test_every_line_fits(latex):
    assert width(latex) > LIMIT
    body = re.sub(
        r"^(\\left\\\{)?\\begin\{aligned\}|\\end\{aligned\}(\\right\.)?$", "", broken(latex)
    )
    lines = rows(body)
    assert len(lines) > 1
    assert all(width(line) <= LIMIT for line in lines)
    assert all(line.count("&") == 1 for line in lines)


@pytest.mark.parametrize("align", ["", "&"])
def test_a_line_starts_at_the_relation_rather_than_inside_brackets(align):
    right = rf"\frac{{u_c \left(4 f_c {S} - f_c \left({LATER} - 2 U_a\right)\right)}}{{{S}}}"
    shown = broken(rf"\begin{{aligned}}{ARGUMENT} - u_c {align}= {right}\end{{aligned}}")
    assert len(re.findall(r"\\\\", shown)) == 1
    assert rf"\\&\qquad = {right}" in shown


@pytest.mark.parametrize("latex", LONG.values(), ids=LONG.keys())
def test_the_page_shows_it(latex):
    assert mathml.block(latex).count("<mtr>") >= 2


def test_tex_agrees_that_every_line_fits(tmp_path, need_tool):
    need_tool("pdflatex")
    shown = "".join(
        f"\\begin{{equation}}{broken(latex)}\\tag{{D.10}}\\end{{equation}}\n"
        for latex in LONG.values()
    )
    file = tmp_path / "long.tex"
    file.write_text(
        "\\documentclass[11pt,a4paper]{article}\\usepackage[margin=25mm]{geometry}\n"
        f"\\usepackage{{amsmath}}\\begin{{document}}\n{shown}\\end{{document}}\n",
        encoding="utf-8",
    )
    outcome = typeset(file)
    assert (outcome.notice, outcome.warnings) == ("", ())


@pytest.mark.parametrize(
    "latex",
    [
        r"u = \frac{K_c V T}{6 H_c} \left[1 + \tanh{\left(4 - \frac{2}{f_c}\right)}\right]",
        r"a &= b \\ &\quad + c",
        r"f = \begin{cases} a & x > 0 \\ b & \text{else} \end{cases}",
        r"\begin{aligned} a &= b \\ c &= d \end{aligned}",
    ],
)
def test_what_fits_is_left_alone(latex):
    assert re.sub(r"\s", "", broken(latex)) == re.sub(r"\s", "", latex)


_atoms = st.sampled_from(
    ["x", r"\sigma_c^0", "12", r"\mathrm{d}u", r"\tanh x", r"\langle U\rangle"]
)


@st.composite
def _formulas(draw: st.DrawFn, depth: int = 3) -> str:
    if depth == 0:
        return draw(_atoms)
    inside = _formulas(depth=depth - 1)
    terms = draw(st.lists(inside, min_size=1, max_size=4))
    joined = " + ".join(terms)
    shape = draw(st.sampled_from(["{}", r"\left({}\right)", r"\sqrt{{{}}}", r"\frac{{{}}}{{2}}"]))
    return shape.format(joined)


@given(_formulas())
def test_pieces_are_the_formula_again(latex):
    assert source(parse(latex)) == latex


@given(_formulas(), st.floats(5.0, 40.0))
def test_any_formula_keeps_its_names(latex, limit):
    after = broken(f"y = {latex}", limit)
    kept = [name for name in _names(after) if name != "1"]
    assert kept == [name for name in _names(f"y = {latex}") if name != "1"]
    assert after.count("{") == after.count("}")
    assert len(re.findall(r"\\left\b", after)) == len(re.findall(r"\\right\b", after))
    assert len(re.findall(r"[gG]l\b", after)) == len(re.findall(r"[gG]r\b", after))
