"""Plain text is read as words, formulas and numbers; nothing gets lost on the way."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from derive.typeset.reading import read


@pytest.mark.parametrize(
    ("text", "formulas"),
    [
        ("0 <= h_0 <= 3 sigma(0) at the start", [r"0 \le h_0 \le 3 \bar{\sigma}(0)"]),
        ("tends to 4 - 2/f_c", ["4 - 2/f_c"]),
        ("2 [f_c (h_0 - U_a) - sigma_c0], a constant", [r"2 [f_c (h_0 - U_a) - \sigma_c^0]"]),
        ("the mean <U_a> of the load", [r"\langle U_a\rangle"]),
        ("grows like A ln t", [r"A \ln t"]),
        ("e^(4 u/sigma_c0) grows", [r"\mathrm{e}^{4 u/\sigma_c^0}"]),
        ("|1 + e^(a + i b)|^2", [r"\lvert 1 + \mathrm{e}^{a + i b}\rvert^2"]),
        ("k -> oo", [r"k \to \infty"]),
        ("d sigma_c/d u_c", [r"\mathrm{d}\sigma_c/\mathrm{d}u_c"]),
        ("Q(u_c, du_c/dt, t)", [r"Q(u_c, \mathrm{d}u_c/\mathrm{d}t, t)"]),
        ("d > 0 and m^-5", ["d > 0", "m^{-5}"]),
        ("a load, A pin, problem (i), case (b), the note's d", []),
        ("slow-time, well-posed, e.g. this", []),
    ],
)
def test_formulas_are_found(text: str, formulas: list[str]) -> None:
    assert [part.text for part in read(text) if part.kind == "formula"] == formulas


@pytest.mark.parametrize(
    "text", ["electroencephalographically" * 20, "(" + "x(k) y[z] " * 200 + ";"]
)
def test_long_texts_are_read_without_trying_every_way(text: str) -> None:
    assert read(text)


@pytest.mark.parametrize("text", ["f_c = 0.25", "K = 1e-6, 1e-5", "by 0.018 p_max", "h > -1.5 mm"])
def test_a_result_is_no_part_of_a_formula(text: str) -> None:
    assert any(part.kind == "number" for part in read(text))
    for part in read(text):
        assert part.kind == "number" or not any(map(str.isdigit, part.text))


@settings(max_examples=40)
@given(st.text("abh_0123.()[]|<>=+-*/^ ,;", max_size=30) | st.text(max_size=30))
def test_any_text_can_be_read(text: str) -> None:
    kept = "".join(part.text for part in read(text) if part.kind == "words")
    assert set(kept) <= set(text) | {" "}


@given(st.text("xyz .,;", max_size=30))
def test_words_stay_as_they_are(text: str) -> None:
    assert "".join(part.text for part in read(text)) == text
