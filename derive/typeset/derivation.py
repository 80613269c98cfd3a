r"""Derivations in words: what each step did with which relation, and what came out.

Overview
    A sentence may hold formulas, ``$...$``, and names equations as ``[eq:21]``.  Every step stands
    once, in the derivation of the first equation that needs it; others refer to it.
Key results
    Derivations    the derivations of some equations, in the order in which they are asked for
    prose          the whole chain to one equation as LaTeX, to \input into a text of one's own
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import sympy as sp
from sympy.core.function import AppliedUndef

from ..claims import Predicate
from ..hypotheses import Kind
from ..kernel import Judgement
from . import formula
from .display import inline, latex
from .macros import macro_name, macros, written
from .present import presentable
from .reading import typed

if TYPE_CHECKING:
    from ..equations import Equation


class Step(NamedTuple):
    """A step: a sentence, the author's remark on it, and the formula that came out.

    If the formula has a number, `latex` is empty, `equation` is its id, and `part` says whether it
    is one of several under that number.
    """

    sentence: str
    remark: str
    latex: str
    equation: str = ""
    part: bool = False


class Derivations:
    """The derivations of some equations; a step that was told once is referred to."""

    def __init__(self, equations: Iterable[Equation]) -> None:
        self._equations = {equation.id: equation for equation in equations}
        self._named: dict[sp.Basic, str] = {}
        for equation in self._equations.values():
            if equation.id not in _COLLECTIONS:
                for relation in _results(equation):
                    self._named.setdefault(relation, equation.id)
        self._told: dict[sp.Basic, tuple[str, int]] = {}

    def steps(self, identifier: str) -> tuple[Step, ...]:
        """Return the steps to an equation that have not been told yet."""
        own = (
            statement
            for statement in self._equations[identifier].steps
            if statement.relation not in self._told
            and self._named.get(statement.relation, identifier) == identifier
            and not is_hypothesis(statement)
        )
        return self._tell(identifier, own)

    def chain(self, identifier: str) -> tuple[Step, ...]:
        """Return all steps to an equation, those to other equations on the way included."""
        chain = self._equations[identifier].steps
        return self._tell(identifier, (each for each in chain if not is_hypothesis(each)))

    def start(self, identifier: str) -> tuple[Step, ...]:
        """Return the hypotheses on which an equation rests, as steps without a sentence."""
        chain = self._equations[identifier].steps
        given = (each for each in chain if is_hypothesis(each))
        return tuple(dict.fromkeys(self._shown(each, identifier) for each in given))

    def _tell(self, identifier: str, statements: Iterable[Judgement]) -> tuple[Step, ...]:
        steps: list[Step] = []
        for statement in statements:
            step = self._step(statement, identifier)
            if step not in steps:
                steps.append(step)
            self._told.setdefault(statement.relation, (identifier, steps.index(step) + 1))
        return tuple(steps)

    def origins(self, identifier: str) -> tuple[str, ...]:
        """Return the equations from which this one follows, none for definitions."""
        found: dict[str, None] = {}
        for statement in self._equations[identifier].statements:
            for parent in statement.parents:
                found |= dict.fromkeys(self._nearest(parent, identifier))
        return tuple(found)

    def _nearest(self, statement: Judgement, of: str) -> Iterator[str]:
        name = self._named.get(statement.relation, of)
        if name != of:
            yield name
            return
        for parent in statement.parents:
            yield from self._nearest(parent, of)

    def _step(self, statement: Judgement, of: str) -> Step:
        parents = [self._name(parent, of) for parent in statement.parents]
        parts = _FIXED.split(statement.rule.sentence(*parents, write=_written))
        said = "".join(part if part[:1] in ("$", "[") else typed(part) for part in parts)
        return self._shown(statement, of)._replace(sentence=said, remark=statement.remark)

    def _shown(self, statement: Judgement, of: str) -> Step:
        """Return what a step gave: an equation or a formula."""
        relation = statement.relation
        own = of if relation in _results(self._equations[of]) else ""
        if name := self._named.get(relation, own):
            return Step("", "", "", name, len(_results(self._equations[name])) > 1)
        return Step("", "", latex(presentable(relation)))

    def _name(self, parent: Judgement, of: str) -> str:
        """How a step refers to another relation."""
        numbered = self._named.get(parent.relation)
        if numbered is not None and numbered != of:
            return f"[eq:{numbered}]"
        equation, place = self._told.get(parent.relation, ("", 0))
        if not equation:
            return _assumed(parent)
        return f"step {place}" if equation == of else f"step {place} of the [der:{equation}]"


def _results(equation: Equation) -> tuple[sp.Basic, ...]:
    """Return what is derived in an equation, or all of it where nothing is."""
    derived = tuple(each.relation for each in equation.statements if not is_hypothesis(each))
    return derived or tuple(each.relation for each in equation.statements)


def _assumed(hypothesis: Judgement) -> str:
    """Return how a step refers to a hypothesis that no equation shows: by a short formula."""
    relation = hypothesis.relation
    said = next(h for h in hypothesis.hypotheses if h.relation == relation)
    defined = said.kind is Kind.DEFINITION
    if defined and isinstance(relation.args[0], (sp.Symbol, AppliedUndef)):
        return "the definitions"
    long = isinstance(relation, Predicate) or len(str(relation)) > _SHORT
    return said.words if said.words and long else f"${inline(presentable(relation))}$"


def is_hypothesis(statement: Judgement) -> bool:
    """Return whether a statement is taken from the note, or assumed."""
    return type(statement.rule).__name__ == "Assume"


#: Characters up to which a formula stands in a sentence.
_SHORT = 60
_LONG = 18.0
"""Width in em from which a formula does not fit into the line of a phone."""
_FIXED = re.compile(r"(\$[^$]*\$|\[[^\]]*\])")
"""What a sentence has in LaTeX already, and references."""
_COLLECTIONS = ("problem-i", "problem-ii")
"""Systems that collect what is derived elsewhere: no step refers to a line of theirs."""
_REFERENCE = re.compile(r"\[eq:([^\]]+)\]")


def prose(equations: Sequence[Equation], width: float) -> str:
    r"""Return the chain of steps to the last of some equations as LaTeX, its formulas as macros.

    ``width`` is that of a line in em; formulas are broken to fit beside their numbers.
    """
    *_, target = equations
    by_id = {equation.id: equation for equation in equations}
    derivations = Derivations(equations)
    start, steps = derivations.start(target.id), derivations.chain(target.id)
    shown = dict.fromkeys(step.equation for step in (*start, *steps) if step.equation)
    return written(
        "derivation",
        target=target,
        macros=macros([by_id[name] for name in shown], width).rstrip(),
        start=start,
        steps=steps,
        equations=by_id,
        width=width,
        macro_name=macro_name,
        plain=partial(_REFERENCE.sub, r"(\1)"),
    )


def _written(expr: sp.Basic) -> str:
    """Return a formula for a sentence, its fractions on the line unless that makes it long."""
    flat = inline(presentable(expr))
    return f"${flat if formula.width(flat) < _LONG else latex(expr)}$"
