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
from typing import TYPE_CHECKING, NamedTuple

import sympy as sp

from ..rules import describe
from .breaking import broken
from .display import latex
from .macros import macro_name, macros
from .present import presentable

if TYPE_CHECKING:
    from ..equations import Equation
    from ..rules import Rule
    from ..statement import Statement


class Step(NamedTuple):
    """A step: a sentence, the author's remark on it, and the formula that came out; `equation` is
    the id if the formula is an equation with a number, `latex` is empty then."""

    sentence: str
    remark: str
    latex: str
    equation: str


class Derivations:
    """The derivations of some equations; a step that was told once is referred to."""

    def __init__(self, equations: Iterable[Equation]) -> None:
        self._equations = {equation.id: equation for equation in equations}
        self._named: dict[sp.Basic, str] = {}
        for equation in self._equations.values():
            for statement in equation.statements:
                self._named.setdefault(statement.claim, equation.id)
        self._told: dict[sp.Basic, tuple[str, int]] = {}

    def steps(self, identifier: str) -> tuple[Step, ...]:
        """Return the steps to an equation that have not been told yet."""
        steps: list[Step] = []
        for statement in self._equations[identifier].steps:
            name = self._named.get(statement.claim, identifier)
            if statement.claim in self._told or name != identifier or is_hypothesis(statement):
                continue
            step = self._step(statement, identifier)
            if step not in steps:
                steps.append(step)
            self._told[statement.claim] = (identifier, steps.index(step) + 1)
        return tuple(steps)

    def chain(self, identifier: str) -> tuple[Step, ...]:
        """Return all steps to an equation, hypotheses and other equations on the way included."""
        steps: list[Step] = []
        for statement in self._equations[identifier].steps:
            name = self._named.get(statement.claim, "")
            if is_hypothesis(statement):
                formula = "" if name else latex(presentable(statement.claim))
                step = Step("", "", formula, name)
            else:
                step = self._step(statement, identifier)
            if step not in steps:
                steps.append(step)
            self._told.setdefault(statement.claim, (identifier, steps.index(step) + 1))
        return tuple(steps)

    def origins(self, identifier: str) -> tuple[str, ...]:
        """Return the equations from which this one follows, none for definitions."""
        found: dict[str, None] = {}
        for statement in self._equations[identifier].statements:
            for parent in statement.parents:
                found |= dict.fromkeys(self._nearest(parent, identifier))
        return tuple(found)

    def _nearest(self, statement: Statement, of: str) -> Iterator[str]:
        name = self._named.get(statement.claim, of)
        if name != of:
            yield name
            return
        for parent in statement.parents:
            yield from self._nearest(parent, of)

    def _step(self, statement: Statement, of: str) -> Step:
        parents = tuple(dict.fromkeys(self._name(parent, of) for parent in statement.parents))
        name = self._named.get(statement.claim, "")
        formula = "" if name else latex(presentable(statement.claim))
        return Step(sentence(statement.rule, parents), statement.remark, formula, name)

    def _name(self, parent: Statement, of: str) -> str:
        """How a step refers to another relation."""
        numbered = self._named.get(parent.claim)
        if numbered is not None and numbered != of:
            return f"[eq:{numbered}]"
        equation, place = self._told.get(parent.claim, ("", 0))
        if not equation:
            return f"[eq:{numbered}]" if numbered else "the hypotheses"
        return f"step {place}" if equation == of else f"step {place} of the [der:{equation}]"


def is_hypothesis(statement: Statement) -> bool:
    """Return whether a statement is taken from the note, or assumed."""
    return type(statement.rule).__name__ == "Given"


_REFERENCE = re.compile(r"\[eq:([^\]]+)\]")


def prose(equations: Sequence[Equation], width: float) -> str:
    r"""Return the chain of steps to the last of some equations as LaTeX, its formulas as macros.

    ``width`` is that of a line in em; formulas are broken to fit beside their numbers.
    """
    *_, target = equations
    by_id = {equation.id: equation for equation in equations}
    steps = Derivations(equations).chain(target.id)
    shown = dict.fromkeys(step.equation for step in steps if step.equation)
    lines = [
        f"% How ({target.id}) follows: {target.title}.",
        macros([by_id[name] for name in shown], width).rstrip(),
        rf"\paragraph{{Derivation of ({target.id}).}}",
    ]
    told: set[str] = set()
    start = [step for step in steps if not step.sentence]
    lines.append("The starting points are")
    lines += [line for step in start for line in _formula(step, by_id, told, width)]
    for place, step in enumerate(steps, start=1):
        if step.sentence:
            said = _REFERENCE.sub(r"(\1)", step.sentence)
            lines.append(rf"\par\noindent\textit{{Step {place}.}} {said}")
            lines += _formula(step, by_id, told, width)
    return "\n".join(lines) + "\n"


def _formula(
    step: Step, equations: dict[str, Equation], told: set[str], width: float
) -> Iterator[str]:
    """Yield the display of what a step gave, an equation with its number and only once."""
    if not step.equation:
        yield rf"\[{broken(step.latex, width)}\]"
    elif step.equation in told:
        yield f"This belongs to ({step.equation})."
    else:
        told.add(step.equation)
        macro = macro_name(equations[step.equation])
        yield rf"\begin{{equation*}}\{macro}\tag{{{step.equation}}}\end{{equation*}}"


def listed(entries: Iterable[str]) -> str:
    """Return entries with commas, and a word before the last one.

    >>> listed(["a", "b", "c"])
    'a, b and c'
    """
    *most, last = entries
    return f"{', '.join(most)} and {last}" if most else last


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


def sentence(rule: Rule, parents: Sequence[str]) -> str:
    """Return what a rule did with the relations that ``parents`` name."""
    name = type(rule).__name__
    if name not in _MOVES:
        return f"{describe(rule)}."
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
