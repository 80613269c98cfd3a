"""What the text becomes: marks, numbers, labels, and what refers to what."""

from fractions import Fraction

import jinja2
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.wear.report.conftest import document
from wear.report.document import Document
from wear.report.markup import escaped
from wear.report.number import TextNumber
from wear.report.text import line, parsed


def test_every_label_has_the_number_of_its_place(sample: Document) -> None:
    shown = {label: mark.name.replace("\u00a0", " ") for label, mark in sample.marks.items()}
    assert (
        shown.items()
        >= {
            "sec:names": "Section 1.1",
            "sec:limit": "Section 2",
            "app:claims": "Appendix A.1",
            "eq:7": "Eq. (7)",
            "eq:static": "Eq. (D.2)",
            "fig:again": "Figure 3",
            "tab:ledger": "Table 2",
            "claim:C29": "claim C29",
            "der:cases": "derivation of (D.1)",
            "ref:filippov1988": "[2]",
        }.items()
    )


def test_an_equation_that_says_the_same_leads_to_the_one_that_is_shown(sample: Document) -> None:
    assert sample.marks["eq:7"].target == "eq:8"


def test_links_back_come_from_derivations_and_claims(sample: Document) -> None:
    assert sample.mentions == {
        "eq:8": ("der:8",),  # not from the table, nor from the derivation of others
        "eq:cases": ("der:cases", "claim:C24"),
        "eq:21": ("claim:C29",),
    }


def test_all_faults_are_listed_at_once() -> None:
    broken = document(
        "## A {#sec:a}\n\n## B {#sec:a}\n\n[fig:none] and [ref:nobody1900]\n\n"
        "```equations\n8 21 8\n```\n"
    )
    with pytest.raises(ValueError, match="references of the document fail") as caught:
        _ = broken.marks
    message = str(caught.value)
    assert all(f"'{f}'" in message for f in ("sec:a", "fig:none", "ref:nobody1900", "eq:8"))


def test_a_value_that_is_missing_is_an_error() -> None:
    with pytest.raises(jinja2.UndefinedError, match="rate"):
        parsed("grows by {{ rate }}", {})


def test_marks_are_read_and_other_brackets_are_left_alone() -> None:
    pieces = [(t.type, t.content) for t in line(r"$\sigma_c$ by [(eq:8)] [x] {y} [no:label] \$5")]
    assert pieces[0] == ("math", r"\sigma_c")
    assert ("reference", "eq:8") in pieces
    words = "".join(content for kind, content in pieces if kind.startswith("text"))
    assert "[x] {y} [no:label] $5" in words


SIGNS = st.text("ab_*`$[]{}<>|#\\ &;-+=~1.):", max_size=20).filter(
    lambda text: text == text.strip()
)


@given(SIGNS)
def test_escaped_words_stay_as_they_are(text: str) -> None:
    shown = "".join(token.content for token in line(f"a{escaped(text)}b"))
    assert shown == f"a{text}b"


@given(SIGNS.filter(bool))
def test_a_paragraph_is_one_whatever_it_begins_with(text: str) -> None:
    for words in (text, f"Table: {text}"):
        types = [token.type for token in parsed("{{ it | paragraphs }}", {"it": words})]
        assert types == ["paragraph_open", "inline", "paragraph_close", "document_close"]


@given(
    value=st.floats(min_value=-1e300, max_value=1e300),
    digits=st.integers(min_value=1, max_value=17),
)
def test_a_number_is_shown_to_its_digits(value: float, digits: int) -> None:
    mantissa, exponent = TextNumber(value, "test", digits).decimal
    shown, exact = Fraction(f"{mantissa}e{exponent or 0}"), Fraction(value)
    assert 2 * abs(shown - exact) * 10 ** (digits - 1) <= abs(exact)


@pytest.mark.parametrize(
    ("value", "digits", "decimal"),
    [
        (123456, 2, ("123456", None)),
        (100000000, 2, ("1.0", 8)),
        (0.00999999, 3, ("0.0100", None)),
        (9.9996e-5, 4, ("1.000", -4)),
        (0.0, 3, ("0", None)),
        (-2.5, 2, ("-2.5", None)),
    ],
)
def test_the_form_of_a_number(value: float, digits: int, decimal: tuple[str, int | None]) -> None:
    assert TextNumber(value, "test", digits).decimal == decimal


@pytest.mark.parametrize("value", [float("nan"), float("inf")])
def test_a_number_that_is_none_is_refused(value: float) -> None:
    with pytest.raises(ValueError, match="finite"):
        TextNumber(value, "test", 3)
