"""`derive steps`: the steps from the governing equations to one.

examples:
  derive steps 10           every step from the hypotheses to (10)
  derive steps 21 --json    with rule, parents, assumptions and status of each
"""

from __future__ import annotations

import textwrap
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from derive import terminal
from derive.command_line import Answer, Options, Parser, declare
from derive.commands import arguments

if TYPE_CHECKING:
    from derive.kernel import Judgement, StepKey

_INDENT = " " * 5


def add_arguments(parser: Parser) -> None:
    """Declare the id."""
    declare(parser, "ID", "an equation, as `derive list` names it")


def execute(options: Options) -> Answer:
    """Check the chain of steps."""
    from derive.kernel import step_key

    (equation,) = arguments.equations([options.id])
    numbers = {step_key(step): number for number, step in enumerate(equation.steps, start=1)}
    rows = [_row(step, numbers) for step in equation.steps]
    fails = any(row["status"] == "fails" for row in rows)
    return Answer(
        {"id": equation.id, "status": equation.status.value, "steps": rows},
        lambda: "\n\n".join(map(_text, rows, equation.steps)),
        status=terminal.FAILED if fails else terminal.DONE,
    )


def _row(step: Judgement, numbers: Mapping[StepKey, int]) -> dict[str, Any]:
    import sympy as sp

    from derive.check import step_checks
    from derive.coq.steps import proved_by_coq
    from derive.kernel import step_key
    from derive.rules.assumption import is_hypothesis
    from derive.typeset.display import latex

    parents = [numbers[step_key(parent)] for parent in step.parents]
    outcomes = step_checks(step)
    kind = "given" if is_hypothesis(step) else "proved"
    return {
        "step": numbers[step_key(step)],
        "name": step.name or None,
        "claim": sp.sstr(step.relation),
        "latex": latex(step.relation),
        "rule": step.rule.sentence(*(f"({n})" for n in parents)),
        "theorem": step.rule.source,
        "parents": parents,
        "assumptions": list(dict.fromkeys(c.stated for c in (*step.conditions, *step.signs))),
        "hypotheses": [h.text for h in step.hypotheses],
        "status": kind if all(check.passed for check in outcomes) else "fails",
        "coq": proved_by_coq(step),
        "remark": step.remark or None,
        "checks": [{"kind": c.kind, "passed": c.passed, "detail": c.detail} for c in outcomes],
    }


def _text(row: Mapping[str, Any], step: Judgement) -> str:
    """Return the sentence of a step above its claim in two dimensions."""
    import sympy as sp

    from derive.hypotheses import sentences

    by_coq = ", checked by Coq" if row["coq"] else ""
    status = "" if row["status"] == "given" else f" [{row['status']}{by_coq}]"
    claim = sp.pretty(step.relation, use_unicode=terminal.shows_formulas(), wrap_line=False)
    lines = ["", *claim.splitlines(), ""]
    lines += sentences((*step.hypotheses, *step.signs))
    if row["remark"]:
        lines.append(row["remark"])
    shown = textwrap.indent("\n".join(lines).rstrip(), _INDENT)
    return f"{row['step']:3}. {row['rule']}{status}\n{shown}"
