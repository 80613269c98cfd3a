"""The derivations of `derive.typeset.derivation` as Markdown."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from derive.kernel import listed
from derive.typeset import derivation
from derive.typeset.derivation import Step
from wear.report.equations import capital
from wear.report.markup import markup

if TYPE_CHECKING:
    from derive.equations import Equation


class Derivations:
    """The derivations of a report, told in the order in which they are asked for."""

    def __init__(self, equations: Sequence[Equation]) -> None:
        self._derivations = derivation.Derivations(equations)
        self._labels = frozenset(f"eq:{equation.id}" for equation in equations)

    def full(self, *identifiers: str) -> str:
        """Return the derivations of these equations, each step a sentence."""
        return "\n".join(map(self._full, identifiers))

    def origins(self, identifier: str) -> str:
        """Return references to the equations from which this one follows, empty for definitions."""
        found = self._derivations.origins(identifier)
        return listed(f"[(eq:{name})]" for name in found) if found else ""

    def _full(self, identifier: str) -> str:
        steps = self._derivations.steps(identifier)
        items = "\n".join(_item(n, self._said(step)) for n, step in enumerate(steps, start=1))
        return f"### Derivation of [eq:{identifier}] {{#der:{identifier}}}\n\n{items}\n"

    def _said(self, step: Step) -> str:
        remark = f" {markup(capital(step.remark), self._labels)}." if step.remark else ""
        if step.equation:
            return f"{step.sentence}{remark} This is [eq:{step.equation}]."
        return f"{step.sentence}{remark}\n\n```math\n{step.latex}\n```\n"


def _item(place: int, said: str) -> str:
    """An item of a numbered list, its lines below its first word."""
    number = f"{place}. "
    return number + said.replace("\n", "\n" + " " * len(number))
