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
    Emphasis,
    Equation,
    Figure,
    Given,
    Inline,
    Link,
    Listing,
    Math,
    Number,
    Paragraph,
    Reference,
    Section,
    Step,
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
        "ref:a": "[1]",
        "ref:b": "[2]",
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
    [
        Text("after 9000 cycles"),
        Text("half of it, ½ mm"),
        Text("after ٩ cycles"),
        Text("a hundredfold wear"),
        Text("after sixty cycles"),
        Emphasis("2 mm"),
        Link("4.6e-8 mm", "https://example.org"),
        Code("4.6e-8"),
        Code("~ 9000 cycles"),
        Given("4.6e-8 mm", "as is well known"),
        Given("9000 cycles", "source"),
        Given("50 %", "source"),
        Number(1, 1, "mm, that is 4.6 nm", source="run"),
        Math(r"u = 2.35"),
        Math(r"u = 2,35"),
        Math(r"u = 2{,}35"),
        Math(r"10^{-8}"),
        Math("N = 9000"),
        Math(r"N = 9\,0"),
        Math("u = 2e-5"),
        Math(r"50\%"),
    ],
)
def test_audit_finds_typed_numbers(sample: Document, piece: Inline) -> None:
    assert audit(sample) == ()
    section = sample.sections[0]
    dirty = replace(section, blocks=(*section.blocks, Paragraph((piece,))))
    assert len(audit(replace(sample, sections=(dirty, *sample.sections[1:])))) == 1


def test_audit_looks_everywhere() -> None:
    cell = (Text("cell 1"),)
    blocks = (
        Table("tab:a", (Text("caption 2"),), (Column((Text("head 3"),)),), ((cell,),)),
        Figure("fig:a", (), "description 4", "", b"", "a"),
        Equation("eq:a", "a = 5.5", printed="a = 6.6", title=(Text("name 7"),)),
        Steps("der:a", "eq:a", (Step((Text("move 8"),), "b = 9.9", (Text("check 10"),)),)),
        Listing("wear run --cycles 1e8", "what 11"),
        Section("sec:b", "section 12", ()),
    )
    document = replace(_document(*blocks), abstract=(Text("abstract 13"),), title="title 14")
    document = replace(document, subtitle=(Text("by 15"),), colophon=(Text("at 16"),))
    assert set(audit(document)) == {
        "cell 1", "caption 2", "head 3", "description 4", "a = 5.5", "a = 6.6", "name 7", "move 8",
        "b = 9.9", "check 10", "what 11", "section 12", "abstract 13", "title 14", "by 15", "at 16",
    }  # fmt: skip


@pytest.mark.parametrize(
    "piece",
    [
        Number(9000, 4, source="run"),
        Number(9, 1, "mm^2", source="run"),
        Math("f_c > 1/8"),
        Math(r"\phi(r), 1"),
        Text("often, of the same weight, eight-sided"),
        Given("Python 3.11", "version of a package"),
        Given("step 12", "number of a step"),
        Code("wear run --cycles 1e8"),
        Code("section4"),
        Link("here", "https://example.org/1"),
        Link("10.1063/1.1721448", "https://doi.org/10.1063/1.1721448"),
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
