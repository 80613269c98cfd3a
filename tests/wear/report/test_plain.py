"""Plain text as prose: nothing lost, no digit without a source, every move in words."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from derive.catalogue import equations
from derive.typeset.display import latex
from wear.report import mathml
from wear.report.document import Code, Emphasis, Given, Inline, Math, Number, Reference, Text
from wear.report.moves import sentence
from wear.report.plain import plain

PIECES = st.sampled_from(
    ["u_c", "sigma(0)", "h/sigma", "->", "(16)", "(7a)", "2.5e-8", "-3", "1e-6", "mm", " ", "; ",
     "section4", "rate_within_1e-6", "d u_c/d t", "is", "a", "``x = y``", "1/8", "f_c*h_0",
     "1e(20)"]
)  # fmt: skip


def shown(node: Inline) -> str:
    """What a reader sees of a node, roughly."""
    match node:
        case Text(text) | Code(text) | Given(text) | Emphasis(text):
            return text
        case Math(formula):
            return formula
        case Reference(label):
            return f"({label.removeprefix('eq:')})"
        case Number():
            return repr(node.value)
    raise TypeError(node)


@given(st.lists(PIECES).map("".join) | st.text(max_size=40))
def test_no_digit_is_without_a_source(text: str) -> None:
    nodes = plain(text, "a test", {"eq:16b", "eq:7a"})
    for node in nodes:
        if isinstance(node, Text):
            assert not any(map(str.isdigit, node.text))
        elif isinstance(node, Math):
            mathml.inline(node.latex)


@given(st.text("abcxyz .,;", max_size=30))
def test_words_are_kept(text: str) -> None:
    """Text without any name, number or sign comes out as it is."""
    assert "".join(map(shown, plain(text.replace("b", "z"), "a test"))) == text.replace("b", "z")


@pytest.mark.parametrize(
    ("text", "nodes"),
    [
        ("h/sigma", [Math(r"h/\bar{\sigma}")]),
        ("see (16)", [Text("see "), Reference("eq:16b")]),
        ("Eq. (7a) holds", [Reference("eq:7a"), Text(" holds")]),
        ("dh/du_a", [Math(r"\mathrm{d}h/\mathrm{d}u_a")]),
        ("in section4", [Text("in "), Code("section4")]),
        ("K = 1e-6", [Math("K ="), Text(" "), Number(1e-6, 1, source="a test")]),
        ("1 + O(1)", [Math("1 + O(1)")]),
        ("(99)", [Given("(99)", "a test")]),
    ],
)
def test_names_and_numbers_are_typeset(text: str, nodes: list[Inline]) -> None:
    assert list(plain(text, "a test", {"eq:16b", "eq:7a"})) == nodes


def test_every_move_of_the_catalogue_is_told_in_words() -> None:
    """No rule falls back on the description meant for those who write derivations."""
    steps = {type(s.rule): s for equation in equations() for s in equation.steps}
    for rule, step in steps.items():
        parents = [(Math(latex(parent.claim)),) for parent in step.parents]
        text = sentence(step.rule, parents, ())
        assert text, rule
        assert not any(isinstance(node, Code) for node in text), rule
        assert not any("author" in node.text for node in text if isinstance(node, Text)), rule
