"""Derivations in words: what each step did with which relation, and what came out.

Every step stands once, in the derivation of the first equation that needs it; where others rest on
it they refer to it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import sympy as sp

from derive.rules import describe
from derive.typeset.display import latex
from derive.typeset.present import presentable
from wear.report.equations import capital, listed
from wear.report.markup import markup

if TYPE_CHECKING:
    from derive.equations import Equation
    from derive.rules import Rule
    from derive.statement import Statement

_MOVES = {
    "Substitute": "Insert {others} into {first}.",
    "SolveFor": "Solve {first} for {detail}.",
    "Rearrange": "Move terms of {first} between the sides.",
    "Multiply": "Multiply {first} by {detail}.",
    "Specialise": "Put {detail} in {first}.",
    "Restrict": "Keep of {first} the branch with {detail}.",
    "Integrate": "Integrate {first} over time, from {others}.",
    "TakeLimit": "Let {detail} in {first}.",
    "Identity": "An identity: both sides reduce to the same expression.",
    "Positive": "An inequality: the difference is a sum of terms of one sign.",
    "Monotone": "Apply a monotone function to both sides of {first}.",
    "Consequence": "Insert {others} into {first}.",
    "Inserted": "Insert {all}: an identity remains.",
    "Grows": "Integrate the constant lower bound of {first}, from {others}.",
    "Diverges": "By {first} the wear grows without bound, and with it this expression.",
    "Vanishes": "Bounds that tend to zero, {first}, as the roughness grows, {others}.",
    "Passes": "Let $t\\to\\infty$ in {first}: the limit {others} passes through a function that is "
    "continuous where it ends.",
    "LinearApproach": "Expand the rate {first} to first order in $1/t$.",
    "LogarithmicDrift": "Integrate {first} over many periods: the mean adds up to a logarithm.",
    "Accumulates": "Integrate the limit {first} over one period.",
    "Named": "Name the limit {others} as in {first}.",
    "LogOdds": "Take logarithms of {first} and solve.",
    "MeanValue": "The mean value theorem, with a slope between $-1$ and $0$.",
    "LogarithmicSlope": "The mean value theorem for the logarithm of the contact law, whose slope "
    "is bounded.",
    "Threshold": "The left side increases with $f_c$ and reaches the level exactly at the bound, "
    "by {all}.",
    "Unbounded": "A positive, continuous rate {first} under a bounded load: were $u_c$ bounded, "
    "the rate would be bounded away from zero.",
    "AtInfinity": "Let $u_c\\to\\infty$, which holds by {first}.",
    "FirstOrder": "Expand the contact law about the limit of $h/\\bar\\sigma$, with {all}.",
    "Separated": "Separate the variables of {first}; every cycle adds the same to the exponential "
    "of the wear.",
    "Asymptotic": "L'Hôpital's rule: the quotient of the claimed and the exact number of cycles "
    "tends to one, by {first}.",
    "Rearranged": "Two inequalities whose differences are equal.",
    "WhileInContact": "The limit of the rate, {first}, holds during a fixed part of every period.",
    "FirstZero": "The first zero of a convex function that is positive at the start, {all}.",
    "Solution": "Differentiating the claim gives back the rate {first}; at $t=0$ it gives zero "
    "wear.",
    "Inverted": "Solve {first} for the wear, by Lambert's function.",
    "ParametricSolution": "Wear and rate are known at a pressure, {all}; integrate over it.",
    "Drift": "Average the rate over a cycle, order by order in $1/m$, with {all}.",
    "Oscillation": "What averaging leaves, order by order in $1/m$, with {all}.",
    "SlowTime": "Integrate the averaged drift, {all}, term by term.",
    "LogarithmicCoefficient": "The first coefficient of the drift, with {all}.",
    "Differentiated": "Differentiate {first} with respect to the datum, with {others}.",
    "Solved": "Solve {first} for the datum.",
    "OfOneSign": "Differentiate the rate {first} with respect to the datum: the sign is constant.",
    "Nondimensional": "Scale lengths by the initial roughness and time by the period in {first}.",
}
_PLACE = re.compile(r"(\{(?:first|others|all|detail)\})")


class Derivations:
    """The derivations of a report, told in the order in which they are asked for."""

    def __init__(self, equations: Sequence[Equation]) -> None:
        self._equations = {equation.id: equation for equation in equations}
        self._labels = frozenset(f"eq:{identifier}" for identifier in self._equations)
        self._named: dict[sp.Basic, str] = {}
        for equation in equations:
            for statement in equation.statements:
                self._named.setdefault(statement.claim, equation.id)
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

    def _nearest(self, statement: Statement, of: str) -> Iterator[str]:
        name = self._named.get(statement.claim, of)
        if name != of:
            yield name
            return
        for parent in statement.parents:
            yield from self._nearest(parent, of)

    def _derivation(self, equation: Equation) -> str:
        steps: list[str] = []
        for step in equation.steps:
            known = self._named.get(step.claim, equation.id)
            if step.claim in self._told or known != equation.id or _is_hypothesis(step):
                continue
            told = self._step(step, equation.id)
            if told not in steps:
                steps.append(told)
            self._told[step.claim] = (equation.id, steps.index(told) + 1)
        numbered = "\n".join(_item(n, told) for n, told in enumerate(steps, start=1))
        label = f"{{#der:{equation.id}}}"
        return f"### Derivation of [eq:{equation.id}] {label}\n\n{numbered}\n"

    def _step(self, step: Statement, of: str) -> str:
        parents = list(dict.fromkeys(self._name(parent, of) for parent in step.parents))
        said = sentence(step.rule, parents, self._labels)
        if step.remark:
            said += f" {markup(capital(step.remark), self._labels)}."
        if step.claim in self._named:
            return f"{said} This is [eq:{self._named[step.claim]}]."
        formula = latex(presentable(step.claim))
        return f"{said}\n\n```math\n{formula}\n```\n"

    def _name(self, parent: Statement, of: str) -> str:
        """How a step refers to another relation."""
        numbered = self._named.get(parent.claim)
        if numbered is not None and numbered != of:
            return f"[eq:{numbered}]"
        equation, place = self._told.get(parent.claim, ("", 0))
        if not equation:
            return f"[eq:{numbered}]" if numbered else "the hypotheses"
        return f"step {place}" if equation == of else f"step {place} of the [der:{equation}]"


def _item(place: int, told: str) -> str:
    """An item of a numbered list, its lines below its first word."""
    number = f"{place}. "
    return number + told.replace("\n", "\n" + " " * len(number))


def _is_hypothesis(step: Statement) -> bool:
    return type(step.rule).__name__ == "Given"


def sentence(rule: Rule, parents: Sequence[str], labels: frozenset[str]) -> str:
    """Return what a rule did with the relations that `parents` name, in Markdown."""
    name = type(rule).__name__
    if name not in _MOVES:
        return f"{markup(describe(rule), labels)}."
    parts = {
        "{first}": listed(parents[:1]) if parents else "",
        "{others}": listed(parents[1:]) if parents[1:] else "",
        "{all}": listed(parents) if parents else "",
        "{detail}": _detail(rule),
    }
    return "".join(parts.get(part, part) for part in _PLACE.split(_MOVES[name]))


def _detail(rule: Rule) -> str:
    """What a rule carries besides the relations: an unknown, values, a condition, a limit."""
    fields = vars(rule)
    if "values" in fields:
        return listed([f"${latex(a)} = {latex(b)}$" for a, b in fields["values"]])
    if "point" in fields:
        return rf"${latex(fields['variable'])} \to {latex(fields['point'])}$"
    found = [f"${latex(fields[k])}$" for k in ("unknown", "condition", "factor") if k in fields]
    return listed(found) if found else ""
