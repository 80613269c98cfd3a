r"""Derivations in words: a sentence and a formula for each step.

Overview
    A sentence may have formulas, ``$...$``, and names equations as ``[eq:21]``.  Every step
    appears once, in the derivation of the first equation that needs it; others refer to it.
Key results
    Derivations    the derivations of some equations, in the order of the calls
    prose          the whole chain to one equation as LaTeX, to \input into another text
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import sympy as sp
from sympy.core.function import AppliedUndef

from ..claims import Predicate, Term
from ..hypotheses import Hypothesis, Kind
from ..kernel import Judgement
from ..laws import GENERAL
from ..rules.assumption import is_hypothesis
from . import formula
from .display import inline, latex
from .macros import macro_name, macros, rendered
from .present import presentable
from .reading import in_latex

if TYPE_CHECKING:
    from ..equations import Equation

_SHORT = 60
"""Greatest number of characters of a formula in a sentence."""
_LONG = 18.0
"""Width in em above which a formula does not fit into a line on a phone."""
_FIXED = re.compile(r"(\$[^$]*\$|\[[^\]]*\])")
"""LaTeX and references in a sentence, which are not read again."""
_COLLECTIONS = ("problem-i", "problem-ii")
"""Systems of relations that are derived elsewhere: no step refers to a line of theirs."""
_Key = tuple[sp.Basic, frozenset[Hypothesis]]
_REFERENCE = re.compile(r"\[eq:([^\]]+)\]")


class StepText(NamedTuple):
    """A step: a sentence, the author's remark on it, and the resulting formula.

    If the formula has a number, `equation` is its id, and `part` whether it is one of several
    formulas of that number.
    """

    sentence: str
    remark: str
    latex: str
    equation: str = ""
    part: bool = False


class Derivations:
    """The derivations of some equations; a step that was shown before is referred to.

    Two steps are one if they conclude the same relation under the same hypotheses.
    """

    def __init__(self, equations: Iterable[Equation]) -> None:
        self._equations = {equation.id: equation for equation in equations}
        self._named: dict[_Key, str] = {}
        for equation in self._equations.values():
            if equation.id not in _COLLECTIONS:
                for key in _results(equation):
                    self._named.setdefault(key, equation.id)
        self._places: dict[_Key, tuple[str, int]] = {}

    def steps(self, identifier: str) -> tuple[StepText, ...]:
        """Return the steps to an equation that have not been shown yet."""
        new = (
            statement
            for statement in self._equations[identifier].steps
            if _key(statement) not in self._places
            and self._named.get(_key(statement), identifier) == identifier
            and not is_hypothesis(statement)
        )
        return self._show(identifier, new)

    def chain(self, identifier: str) -> tuple[StepText, ...]:
        """Return all steps to an equation, those to other equations on the way included."""
        chain = self._equations[identifier].steps
        return self._show(identifier, (each for each in chain if not is_hypothesis(each)))

    def start(self, identifier: str) -> tuple[StepText, ...]:
        """Return the hypotheses on which an equation rests, in words where the formula does not
        say it all."""
        equation = self._equations[identifier]
        return tuple(dict.fromkeys(map(self._hypothesis, (*equation.hypotheses, *equation.signs))))

    def dropped(self, identifier: str) -> tuple[StepText, ...]:
        """Return the hypotheses that steps use and that a later step drops, as ``start`` does."""
        equation = self._equations[identifier]
        used = (h for step in equation.steps for h in step.hypotheses)
        return tuple(
            dict.fromkeys(self._hypothesis(h) for h in used if h not in equation.hypotheses)
        )

    def _hypothesis(self, hypothesis: Hypothesis) -> StepText:
        key = hypothesis.relation, frozenset((hypothesis,))
        shown = self._formula(key, self._named.get(key, ""))
        explained = hypothesis.relation.has(Term, GENERAL.phi.func)
        return shown._replace(sentence=in_latex(f"{hypothesis.words}:")) if explained else shown

    def _formula(self, key: _Key, name: str) -> StepText:
        """Return a formula, which may be of an equation, as a step without a sentence."""
        part = bool(name) and len(_results(self._equations[name])) > 1
        return StepText("", "", latex(presentable(key[0])), name, part)

    def _show(self, identifier: str, statements: Iterable[Judgement]) -> tuple[StepText, ...]:
        """Return the steps of statements, and keep the place of each for later references."""
        steps: list[StepText] = []
        for statement in statements:
            key = _key(statement)
            if key not in self._places:
                steps.append(self._step(statement, identifier))
                self._places[key] = identifier, len(steps)
        return tuple(steps)

    def origins(self, identifier: str) -> tuple[str, ...]:
        """Return the equations from which this one follows, none for definitions."""
        origins: dict[str, None] = {}
        for statement in self._equations[identifier].statements:
            for parent in statement.parents:
                origins |= dict.fromkeys(self._nearest(parent, identifier))
        return tuple(origins)

    def _nearest(self, statement: Judgement, of: str) -> Iterator[str]:
        name = self._named.get(_key(statement), of)
        if name != of:
            yield name
            return
        for parent in statement.parents:
            yield from self._nearest(parent, of)

    def _step(self, statement: Judgement, of: str) -> StepText:
        parents = [self._name(parent, of) for parent in statement.parents]
        parts = _FIXED.split(statement.rule.sentence(*parents, write=_written))
        sentence = "".join(part if part[:1] in ("$", "[") else in_latex(part) for part in parts)
        return self._result(statement, of)._replace(sentence=sentence, remark=statement.remark)

    def _result(self, statement: Judgement, of: str) -> StepText:
        """Return the result of a step, an equation or a formula, without its sentence."""
        key = _key(statement)
        current = of if key in _results(self._equations[of]) else ""
        return self._formula(key, self._named.get(key, current))

    def _name(self, parent: Judgement, of: str) -> str:
        """Return the reference of a step to another one."""
        numbered = self._named.get(_key(parent))
        if numbered is not None and numbered != of:
            return f"[eq:{numbered}]"
        equation, place = self._places.get(_key(parent), ("", 0))
        if not equation:
            return _assumed(parent)
        return f"step {place}" if equation == of else f"step {place} of the [der:{equation}]"


def _key(statement: Judgement) -> _Key:
    """Return what a step concludes, and its hypotheses in any order."""
    return statement.relation, frozenset(statement.hypotheses)


def _results(equation: Equation) -> tuple[_Key, ...]:
    """Return the derived results of an equation, or all of them if none is derived."""
    derived = tuple(_key(each) for each in equation.statements if not is_hypothesis(each))
    return derived or tuple(map(_key, equation.statements))


def _assumed(hypothesis: Judgement) -> str:
    """Return the reference to a hypothesis that no equation shows: a short formula or words."""
    relation = hypothesis.relation
    supposed = next(h for h in hypothesis.hypotheses if h.relation == relation)
    defined = supposed.kind is Kind.DEFINITION
    if defined and isinstance(relation.args[0], (sp.Symbol, AppliedUndef)):
        return "the definitions"
    long = isinstance(relation, Predicate) or len(str(relation)) > _SHORT
    by_words = supposed.words and long
    return supposed.words if by_words else f"${inline(presentable(relation))}$"


def prose(equations: Sequence[Equation], width: float) -> str:
    r"""Return the chain of steps to the last of some equations as LaTeX, its formulas as macros.

    ``width`` is that of a line in em; formulas are broken to fit beside their numbers.
    """
    *_, target = equations
    by_id = {equation.id: equation for equation in equations}
    derivations = Derivations(equations)
    start, dropped = derivations.start(target.id), derivations.dropped(target.id)
    steps = derivations.chain(target.id)
    whole = (step for step in (*start, *dropped, *steps) if step.equation and not step.part)
    shown = dict.fromkeys(step.equation for step in whole)
    return rendered(
        "derivation",
        target=target,
        macros=macros([by_id[name] for name in shown], width).rstrip(),
        start=start,
        dropped=dropped,
        steps=steps,
        equations=by_id,
        width=width,
        macro_name=macro_name,
        plain=partial(_REFERENCE.sub, r"(\1)"),
    )


def _written(expr: sp.Basic) -> str:
    """Return a formula for a sentence, with fractions on the line unless it becomes too long."""
    flat = inline(presentable(expr))
    return f"${flat if formula.width(flat) < _LONG else latex(expr)}$"
