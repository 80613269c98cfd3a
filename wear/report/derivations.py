"""Derivations in words: what each step did with which relation, and what came out.

Every step stands once, in the derivation of the first equation that needs it; where others rest on
it they refer to it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import sympy as sp

from derive.typeset.display import latex
from derive.typeset.present import presentable
from wear.report.equations import capital, listed
from wear.report.markup import markup

if TYPE_CHECKING:
    from derive.equations import Equation
    from derive.kernel import Judgement

class Derivations:
    """The derivations of a report, told in the order in which they are asked for."""

    def __init__(self, equations: Sequence[Equation]) -> None:
        self._equations = {equation.id: equation for equation in equations}
        self._labels = frozenset(f"eq:{identifier}" for identifier in self._equations)
        self._named: dict[sp.Basic, str] = {}
        for equation in equations:
            for statement in equation.statements:
                self._named.setdefault(statement.relation, equation.id)
        self._told: dict[sp.Basic, tuple[str, int]] = {}

    def full(self, *identifiers: str) -> str:
        """Return the derivations of these equations in Markdown, each step a sentence."""
        return "\n".join(self._derivation(self._equations[i]) for i in identifiers)

    def origins(self, identifier: str) -> str:
        """Return references to the equations from which this one follows, empty for definitions."""
        found: dict[str, None] = {}
        for statement in self._equations[identifier].statements:
            for parent in statement.parents:
                found |= dict.fromkeys(self._nearest(parent, identifier))
        return listed([f"[(eq:{name})]" for name in found]) if found else ""

    def _nearest(self, statement: Judgement, of: str) -> Iterator[str]:
        name = self._named.get(statement.relation, of)
        if name != of:
            yield name
            return
        for parent in statement.parents:
            yield from self._nearest(parent, of)

    def _derivation(self, equation: Equation) -> str:
        steps: list[str] = []
        for step in equation.steps:
            known = self._named.get(step.relation, equation.id)
            if step.relation in self._told or known != equation.id or _is_hypothesis(step):
                continue
            told = self._step(step, equation.id)
            if told not in steps:
                steps.append(told)
            self._told[step.relation] = (equation.id, steps.index(told) + 1)
        numbered = "\n".join(_item(n, told) for n, told in enumerate(steps, start=1))
        label = f"{{#der:{equation.id}}}"
        return f"### Derivation of [eq:{equation.id}] {label}\n\n{numbered}\n"

    def _step(self, step: Judgement, of: str) -> str:
        parents = [self._name(parent, of) for parent in step.parents]
        said = step.rule.sentence(*parents, write=_written)
        if step.remark:
            said += f" {markup(capital(step.remark), self._labels)}."
        if step.relation in self._named:
            return f"{said} This is [eq:{self._named[step.relation]}]."
        formula = latex(presentable(step.relation))
        return f"{said}\n\n```math\n{formula}\n```\n"

    def _name(self, parent: Judgement, of: str) -> str:
        """How a step refers to another relation."""
        numbered = self._named.get(parent.relation)
        if numbered is not None and numbered != of:
            return f"[eq:{numbered}]"
        equation, place = self._told.get(parent.relation, ("", 0))
        if not equation:
            return f"[eq:{numbered}]" if numbered else "the hypotheses"
        return f"step {place}" if equation == of else f"step {place} of the [der:{equation}]"


def _item(place: int, told: str) -> str:
    """An item of a numbered list, its lines below its first word."""
    number = f"{place}. "
    return number + told.replace("\n", "\n" + " " * len(number))


def _is_hypothesis(step: Judgement) -> bool:
    return not step.parents and type(step.rule).__name__ == "Assume"


def _written(expr: sp.Basic) -> str:
    return f"${latex(expr)}$"
