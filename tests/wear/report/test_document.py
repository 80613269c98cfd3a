"""The tree, its numbers and the search for numbers that nobody computed."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from wear.report.audit import audit
from wear.report.document import (
    Code,
    Column,
    Document,
    Equation,
    Figure,
    Given,
    Inline,
    Link,
    Math,
    Number,
    Paragraph,
    Reference,
    Section,
    Steps,
    Table,
    Text,
)
from wear.report.numbering import mentioned_by, number
from wear.report.words import words


def _document(*blocks: object) -> Document:
    return Document("Title", (), (), (Section("sec:a", "A", tuple(blocks)),))  # type: ignore[arg-type]


def test_every_label_has_the_number_of_its_place(sample: Document) -> None:
    shown = {label: mark.name.replace("\u00a0", " ") for label, mark in number(sample).items()}
    assert shown == {
        "sec:model": "Section 1",
        "sec:names": "Section 1.1",
        "sec:limit": "Section 2",
        "sec:ledger": "Section 3",
        "eq:8": "Eq. (8)",
        "eq:21": "Eq. (21)",
        "eq:cases": "Eq. (D.1)",
        "eq:static": "Eq. (D.2)",
        "fig:system": "Figure 1",
        "fig:wear": "Figure 2",
        "tab:names": "Table 1",
        "tab:ledger": "Table 2",
        "claim:C24": "claim C24",
        "claim:C29": "claim C29",
        "der:8": "derivation of (8)",
    }


def test_links_back_come_from_derivations_and_claims(sample: Document) -> None:
    back = mentioned_by(sample)
    assert back["eq:8"] == ("der:8",)
    # the derivation of (8) uses it too, but only its own would be told
    assert back["eq:cases"] == ("claim:C24",)
    assert back["eq:21"] == ("claim:C29",)
    assert back["der:8"] == ("claim:C24",)


def test_numbering_lists_all_faults_at_once() -> None:
    broken = _document(
        Equation("eq:1", "a", number="1"),
        Equation("eq:1", "b", number="2"),
        Equation("eq:3", "c", number="2"),
        Equation("eq 4", "d"),
        Steps("der:9", "eq:9", ()),
        Paragraph((Reference("fig:none"),)),
        Figure("fig:1", (), "", "", b"", "same"),
        Figure("fig:2", (), "", "", b"", "same"),
        Section("b", "", (Section("c", "", (Section("sec:d", "", ()),)),)),
    )
    with pytest.raises(ValueError, match="does not hold together") as caught:
        number(broken)
    message = str(caught.value)
    for fault in (
        "'eq:1' is used 2 times",
        "numbered (2)",
        "label 'eq 4'",
        "derivation 'der:9'",
        "'fig:none'",
        "'same'",
        "'sec:d' is nested",
    ):
        assert fault in message


@pytest.mark.parametrize(
    "piece",
    [Text("after 9000 cycles"), Math(r"u = 2.35"), Math(r"10^{-8}"), Math("N = 9000")],
)
def test_audit_finds_typed_numbers(sample: Document, piece: Inline) -> None:
    assert audit(sample) == ()
    section = sample.sections[0]
    dirty = replace(section, blocks=(*section.blocks, Paragraph((piece,))))
    assert len(audit(replace(sample, sections=(dirty, *sample.sections[1:])))) == 1


def test_audit_looks_into_titles_captions_cells_and_steps() -> None:
    cell = (Text("cell 1"),)
    table = Table("tab:a", (Text("caption 2"),), (Column((Text("head 3"),)),), ((cell,),))
    document = replace(_document(table), abstract=(Text("abstract 4"),), title="title 5")
    assert set(audit(document)) == {"cell 1", "caption 2", "head 3", "abstract 4", "title 5"}


@pytest.mark.parametrize(
    "piece",
    [
        Number(9000, 4, source="run"),
        Math("f_c > 1/8"),
        Given("Python 3.11", "version"),
        Code("wear run --cycles 1e8"),
        Link("here", "https://example.org/1"),
    ],
)
def test_audit_lets_computed_and_declared_numbers_pass(piece: Inline) -> None:
    assert audit(_document(Paragraph((piece,)))) == ()


@given(
    value=st.floats(min_value=-1e300, max_value=1e300),
    digits=st.integers(min_value=1, max_value=17),
)
def test_a_number_is_shown_to_its_digits(value: float, digits: int) -> None:
    mantissa, exponent = Number(value, digits, source="test").decimal
    shown = float(f"{mantissa}e{exponent or 0}")
    assert abs(shown - value) <= 0.5000001 * abs(value) * 10.0 ** (1 - digits)


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
    assert Number(value, digits, source="test").decimal == decimal


@pytest.mark.parametrize("value", [float("nan"), float("inf")])
def test_a_number_that_is_none_is_refused(value: float) -> None:
    with pytest.raises(ValueError, match="finite"):
        Number(value, 3, source="test")


def test_words_names_what_is_missing_and_what_is_left_over() -> None:
    with pytest.raises(ValueError, match=r"\{rate\}"):
        words("grows by {rate}")
    with pytest.raises(ValueError, match="does not use"):
        words("grows", rate=Text("x"))


def test_a_ragged_table_is_refused() -> None:
    with pytest.raises(ValueError, match=r"rows \[0\]"):
        Table("tab:a", (), (Column(()), Column(())), (((Text("one"),),),))
