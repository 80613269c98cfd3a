"""Equations as an author writes them, read from text."""

import pytest
import sympy as sp

from derive.equations import TEXTS, Equation
from derive.laws import GENERAL
from derive.rules.algebra import substitute
from derive.symbols import rate, symbols, t
from derive.typeset.display import inline, latex
from derive.typeset.present import presentable
from derive.written import evaluated, read
from tests.derive.judgements import equal, given

h_0, u_c, U_a, f_c, T, h, L, tau, U_max = symbols("h_0 u_c U_a f_c T h L tau U_max")
PHI = GENERAL.phi.func


@pytest.mark.parametrize(
    ("text", "meaning"),
    [
        ("2 (h_0 - U_a)/f_c", 2 * (h_0 - U_a) / f_c),
        ("h_0^-3 - f_c u_c", h_0**-3 - f_c * u_c),
        ("du_c/dt = f_c", sp.Eq(rate("u_c"), f_c)),
        ("u_c(t + T) - u_c", u_c.subs(t, t + T) - u_c),
        ("lim(u_c/t)", sp.Limit(u_c / t, t, sp.oo)),
        ("0 < f_c <= 1/3", sp.And(sp.Lt(0, f_c), sp.Le(f_c, sp.Rational(1, 3)))),
        ("sqrt(f_c) tanh(ln(f_c))", sp.sqrt(f_c) * sp.tanh(sp.log(f_c))),
    ],
)
def test_text_means_what_it_says(text: str, meaning: sp.Basic):
    assert evaluated(read(text)) == meaning


def test_a_power_of_a_function_of_scaled_time_is_written():
    assert latex(sp.Function("v", real=True)(tau) ** 2) == r"v^{2}{\left(\tau \right)}"
    assert latex(sp.Function("v_12", real=True)(tau)) == r"v_{12}{\left(\tau \right)}"
    assert latex(PHI(tau)) == r"\phi{\left(\tau \right)}"
    assert latex(sp.sin(tau) ** 2) == r"\sin^{2}{\left(\tau \right)}"


def test_a_product_with_the_next_time_is_not_a_value_at_that_time() -> None:
    for factor in (u_c, rate("u_c"), f_c):
        assert latex(factor * (t + T)) == rf"\left(t + T\right) {latex(factor)}"
        assert inline(2 * factor * (t + T)).startswith(r"2 \left(t + T\right) ")
        assert latex(presentable(factor * (t + T) ** 2)).startswith(r"\left(t + T\right)^{2} ")


def test_a_name_of_several_letters_is_no_product() -> None:
    b, L = symbols("b L")
    assert latex(sp.Symbol("bL", real=True)) == r"\mathrm{bL}" != latex(b * L)
    assert latex(sp.Symbol("ab_1", real=True)) == r"\mathrm{ab}_{1}"
    assert latex(sp.Symbol("alpha_1", real=True)) == r"\alpha_{1}"


def test_the_base_e_is_upright() -> None:
    assert latex(sp.E * f_c) == r"\mathrm{e} f_c"
    assert latex(sp.exp(f_c)) == r"\mathrm{e}^{f_c}"


def test_nothing_is_moved():
    assert latex(read("u_c - h_0 + 4 - 2 U_a/f_c")) == r"u_c - h_0 + 4 - \frac{2 U_a}{f_c}"


@pytest.mark.parametrize(
    ("expr", "on_the_line"),
    [
        (U_max**2 * f_c, r"f_c \left(\max U_a\right)^{2}"),
        (sp.Mul(U_max, f_c, evaluate=False), r"\left(\max U_a\right) f_c"),
        (U_max / f_c, r"\left(\max U_a\right) / f_c"),
        (sp.log(f_c) / f_c, r"\ln{\left(f_c \right)} / f_c"),
        (f_c / rate("u_c"), r"f_c / \left(\mathrm{d}u_c / \mathrm{d}t\right)"),
        (sp.Mul(rate("u_c"), f_c, evaluate=False), r"\left(\mathrm{d}u_c / \mathrm{d}t\right) f_c"),
        (sp.Limit(u_c, t, sp.oo) / f_c, r"\left(\lim_{t \to \infty} u_c\right) / f_c"),
        (
            sp.Add(sp.Limit(u_c, t, sp.oo), -u_c, evaluate=False),
            r"\left(\lim_{t \to \infty} u_c\right) - u_c",
        ),
    ],
)
def test_what_has_no_end_in_print_is_in_brackets(expr: sp.Expr, on_the_line: str) -> None:
    assert inline(expr) == on_the_line


@pytest.mark.parametrize("text", ["[h_0]", "h_0.args", "lambda x: x", "h_0 if f_c else T", "'h_0'"])
def test_what_is_no_formula_is_refused(text: str):
    with pytest.raises((ValueError, SyntaxError)):
        read(text)


def test_texts_of_equations_have_no_keys_that_nobody_reads():
    known = {"section", "title", "remark", "macro", "printed", "shown", "where"}
    assert set().union(*TEXTS.values()) == known


@pytest.mark.parametrize(("short", "agrees"), [("S", True), ("kappa", True), ("f_c", False)])
def test_an_abbreviation_is_no_datum(short: str, agrees: bool) -> None:
    made = substitute(given(equal(h, h_0)), given(equal(h_0, 2 * L)))
    texts = {"shown": f"h = {short}", "where": f"{short} = 2 L"}
    assert Equation("x", "1", "short", (made,), texts=texts).typeset_agrees is agrees
