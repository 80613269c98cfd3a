"""Equations with their derivations as blocks of the paper.

Every step stands once, below the first equation that needs it; where others rest on it they refer
to it. Steps say what was done with which relation, and how that was checked where it is not in the
usual way: by making the move again, and at random points.
"""

from __future__ import annotations

import re
from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import sympy as sp

from derive.note.governing import ROUGH_BEARING
from derive.typeset.display import latex
from derive.typeset.formula import width
from derive.typeset.macros import macro_name
from derive.typeset.present import presentable
from wear.report import document as tree
from wear.report.document import Block, Given, Math, Prose, Reference, Text
from wear.report.moves import listed, sentence
from wear.report.plain import plain
from wear.report.verification import Verification, identity

if TYPE_CHECKING:
    from derive.equations import Equation
    from derive.statement import Statement

_NOTE = re.compile(r"\d+[a-g]?")
#: Width in em up to which a hypothesis is told as a formula.
_SHORT = 12.0
_USUAL = (
    "again",
    "points",
    "left minus right",
    "a sum of terms",
    "inserted",
    "quantities whose limits are known",
)


@dataclass
class _Shown:
    """Where what has been shown can be found: equations by claim, steps by identity."""

    labels: frozenset[str]
    verification: Verification
    equations: dict[sp.Basic, str] = field(default_factory=dict)
    steps: dict[Hashable, tuple[str, int]] = field(default_factory=dict)


def label(identifier: str) -> str:
    """The label of an equation.

    >>> label("16b")
    'eq:16b'
    """
    return f"eq:{identifier}"


def blocks_of(
    equations: Sequence[Equation], order: Sequence[str], verification: Verification
) -> Mapping[str, tuple[Block, ...]]:
    """The blocks of every equation, by id; `order` is that in which derivations build up."""
    by_id = {equation.id: equation for equation in equations}
    shown = _Shown(frozenset(map(label, by_id)), verification)
    return {identifier: tuple(_blocks(by_id[identifier], shown)) for identifier in order}


def _blocks(equation: Equation, shown: _Shown) -> Iterator[Block]:
    """The formula, what is to be said of it, and the steps that nobody has shown yet."""
    for statement in equation.statements:
        shown.equations.setdefault(statement.claim, equation.id)
    yield _formula(equation, shown)
    if remark := _remark(equation, shown):
        yield tree.Paragraph(remark)
    fresh = [step for step in equation.steps if _is_fresh(step, shown)]
    if all(_is_hypothesis(step) for step in fresh):
        return
    steps: list[tree.Step] = []
    for step in fresh:
        made = _step(step, equation.id, shown)
        if made not in steps:
            steps.append(made)
        shown.steps[identity(step)] = (equation.id, steps.index(made) + 1)
    yield tree.Steps(f"der:{equation.id}", label(equation.id), tuple(steps))


def _is_hypothesis(step: Statement) -> bool:
    return type(step.rule).__name__ == "Given"


def _is_fresh(step: Statement, shown: _Shown) -> bool:
    """Whether a step is to be shown: neither seen before nor itself a hypothesis with a number."""
    if identity(step) in shown.steps:
        return False
    return not (_is_hypothesis(step) and step.claim in shown.equations)


def _formula(equation: Equation, shown: _Shown) -> tree.Equation:
    corrected = not equation.agrees or equation.refutation is not None
    return tree.Equation(
        label=label(equation.id),
        latex=equation.latex,
        number=equation.id if _NOTE.fullmatch(equation.id) else "",
        title=_title(equation, shown),
        status=str(equation.status),
        printed=equation.printed_latex if corrected else "",
        macro=macro_name(equation),
    )


def _capital(text: str) -> str:
    """The text with a capital, unless it begins with the name of a quantity.

    >>> _capital("wear per cycle"), _capital("f_c = 0")
    ('Wear per cycle', 'f_c = 0')
    """
    return text[0].upper() + text[1:] if text[1:2].isalpha() or text[1:2] == " " else text


def _title(equation: Equation, shown: _Shown) -> Prose:
    """What an equation is called, and its hypotheses but for that of the whole paper."""
    prose = list(plain(_capital(equation.title), "title", shown.labels))
    needed = [c for c in equation.conditions if c != ROUGH_BEARING]
    short = [c for c in needed if c.relation is not sp.true and width(c.latex) < _SHORT]
    formulas = [(Math(part),) for c in short for part in c.latex.split(r", \quad ")]
    said = [plain(c.text, "hypothesis", shown.labels) for c in needed if c not in short]
    for word, hypotheses in ((", for ", formulas), (", if ", said)):
        if hypotheses:
            prose += [Text(word), *listed(tuple(dict.fromkeys(hypotheses)))]
    return tuple(prose)


def _remark(equation: Equation, shown: _Shown) -> Prose:
    """What is to be said of an equation."""
    said = f"{_capital(equation.remark)}." if equation.remark else ""
    return plain(said, "remark on the equation", shown.labels)


def _step(step: Statement, of: str, shown: _Shown) -> tree.Step:
    parents = tuple(dict.fromkeys(_name(parent, of, shown) for parent in step.parents))
    text = list(sentence(step.rule, parents, shown.labels))
    if step.remark:
        text += [Text(" "), *plain(_capital(step.remark), "remark", shown.labels), Text(".")]
    target = shown.equations.get(step.claim)
    if target is not None:
        text += [Text(" This is "), Reference(label(target)), Text(". ")]
    formula = "" if target is not None else latex(presentable(step.claim))
    return tree.Step(tuple(text), formula, _check(step, shown))


def _name(parent: Statement, of: str, shown: _Shown) -> Prose:
    """How a step refers to another relation."""
    numbered = shown.equations.get(parent.claim)
    if numbered is not None and numbered != of:
        return (Reference(label(numbered)),)
    equation, place = shown.steps.get(identity(parent), ("", 0))
    if not equation and numbered is not None:
        return (Reference(label(numbered)),)
    step = Given(f"step {place}", "number of a step")
    return (step,) if equation == of else (step, Text(" of the "), Reference(f"der:{equation}"))


def _check(step: Statement, shown: _Shown) -> Prose:
    """How a step was checked, where it was not in the usual way."""
    details = dict.fromkeys(
        outcome.detail
        for outcome in shown.verification.of(step)
        if outcome.kind != "dimensions" and not any(usual in outcome.detail for usual in _USUAL)
    )
    return plain("; ".join(details), "check of this step", shown.labels)
