"""What each move of a derivation does, in words.

`derive` names its rules for those who write derivations; a reader of the paper is told what was
done with which relation. ``{first}`` is the first relation that a step follows from, ``{others}``
are the rest, ``{all}`` all of them, ``{detail}`` is what the rule itself says (the unknown, say).
"""

from __future__ import annotations

import re
from collections.abc import Container, Sequence
from typing import TYPE_CHECKING

from derive.rules import describe
from derive.typeset.display import latex
from wear.report.document import Inline, Math, Prose, Text
from wear.report.plain import plain
from wear.report.words import words

if TYPE_CHECKING:
    from derive.rules import Rule

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


def sentence(rule: Rule, parents: Sequence[Prose], labels: Container[str]) -> Prose:
    """What a rule did with the relations that `parents` name; `labels` can be referred to."""
    name = type(rule).__name__
    if name == "Given":
        source = str(getattr(rule, "source", ""))
        return (Text("Hypothesis: "), *plain(source, "the note", labels), Text("."))
    if name not in _MOVES:
        return (*plain(describe(rule), "derivation"), Text("."))
    parts = {
        "{first}": listed(parents[:1]),
        "{others}": listed(parents[1:]),
        "{all}": listed(parents),
        "{detail}": _detail(rule),
    }
    prose: list[Inline] = []
    for part in _PLACE.split(_MOVES[name]):
        prose += parts[part] if part in parts else words(part)
    return tuple(prose)


def listed(entries: Sequence[Prose]) -> list[Inline]:
    """Entries with commas, and a word before the last one."""
    listed: list[Inline] = []
    for place, entry in enumerate(entries):
        if place:
            listed.append(Text(" and " if place == len(entries) - 1 else ", "))
        listed += entry
    return listed


def _detail(rule: Rule) -> list[Inline]:
    """What a rule carries besides the relations: an unknown, values, a condition, a limit."""
    fields = vars(rule)
    if "values" in fields:
        return listed([(Math(f"{latex(a)} = {latex(b)}"),) for a, b in fields["values"]])
    if "point" in fields:
        return [Math(rf"{latex(fields['variable'])} \to {latex(fields['point'])}")]
    return [Math(latex(fields[key])) for key in ("unknown", "condition", "factor") if key in fields]
