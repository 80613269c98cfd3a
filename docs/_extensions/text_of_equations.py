"""Equations as Markdown, from the catalogue of `derive`."""

from __future__ import annotations

from itertools import groupby

from mathml_renderer import anchor

from derive import reasons
from derive.catalogue import all_equations, equation
from derive.equations import Equation, Status
from derive.hypotheses import Hypothesis
from derive.symbols import QUANTITIES
from derive.typeset.macros import macro_name
from derive.typeset.reading import in_latex

MEANING = {
    Status.DEFINITION: "taken as the model, or a name given to something",
    Status.DERIVED: "every step from the governing equations is proved",
    Status.CORRECTED: "the form shown replaces a printed one that is not equivalent to it",
}


def displayed(*identifiers: str) -> str:
    """Equations with their numbers, one below the other."""
    return "\n\n".join(_formula(equation(identifier)) for identifier in identifiers)


def catalogue() -> str:
    """Every equation: what is said of it, its conditions, its form."""
    found = all_equations()
    states = [s for s in MEANING if any(e.status is s for e in found)]
    counts = [
        f"- *{status.value}* ({sum(e.status is status for e in found)}): {MEANING[status]}"
        for status in states
    ]
    parts = [f"{len(found)} equations, each with its status:", "\n".join(counts)]
    for is_own, group in groupby(found, key=lambda e: not e.id[0].isdigit()):
        parts.append("## Beyond the note" if is_own else "## The note's equations")
        parts += [_entry(member) for member in group]
    return "\n\n".join(parts)


def conditions() -> str:
    """Every condition of every equation, with a model that breaks the equation without it."""
    parts = []
    for identifier, rows in groupby(reasons.table(), key=lambda row: row.equation):
        parts.append(f"## {_heading(equation(identifier))}\n\n{_block(equation(identifier).latex)}")
        for line, group in groupby(rows, key=reasons.line_of):
            head = _line(identifier, line) if line else ""
            parts.append(head + "\n".join(map(_without, group)))
    return "\n\n".join(parts)


def _line(identifier: str, line: int) -> str:
    """The number of one of several formulas, and its conditions, which may differ."""
    needed = map(_condition, equation(identifier).statements[line - 1].conditions)
    return f"Formula {line}, if {', '.join(dict.fromkeys(needed))}:\n\n"


def _without(row: reasons.Reason) -> str:
    condition = row.condition if row.latex.startswith(r"\text") else f"${row.latex}$"
    if not row.model:
        return f"- Without the condition *{condition}*: no counterexample was found."
    model = ", ".join(f"${part}$" for part in row.model)
    verdict = "has no meaning" if "no value" in row.where else "fails"
    if row.left:
        verdict = f"has no meaning, as ${row.left}$ fails,"
    return f"- Without the condition *{condition}* it {verdict} for {model}: {row.where}."


def symbols() -> str:
    """Every quantity: its symbol, its name in SymPy, meaning and unit."""
    rows = ["| symbol | name | meaning | unit |", "| --- | --- | --- | --- |"]
    rows += [
        f"| ${q.latex}$ | `{q.name}` | {in_latex(q.meaning)} | {'' if q.unit == '1' else q.unit} |"
        for q in QUANTITIES.values()
    ]
    return "\n".join(rows)


def _entry(found: Equation) -> str:
    section = f"section {found.section}" if found.section[0].isdigit() else found.section
    parts = [
        f"({anchor(found.id)})=\n### {_heading(found)}",
        f"*{found.status.value}*, {section}, {_rests_on(found)}; in LaTeX `\\{macro_name(found)}`",
        _block(found.latex),
    ]
    if found.conditions:
        needed = dict.fromkeys(map(_condition, found.conditions))
        parts.append(f"If {', '.join(needed)}.")
    if found.printed and not found.agrees:
        parts += ["As printed, which is not equivalent:", _block(found.printed_latex)]
    if found.remark:
        parts.append(f"{in_latex(_capitalised(found.remark))}.")
    return "\n\n".join(parts)


def _condition(condition: Hypothesis) -> str:
    """A setting by its name, any other condition as a formula, after its words if it has some."""
    if condition.is_setting:
        return condition.words
    formula = f"${condition.latex}$"
    return f"{condition.words} ({formula})" if condition.words else formula


def _heading(found: Equation) -> str:
    """The number in the note and the title; a result beyond it has its id behind its title."""
    if found.id[0].isdigit():
        return f"({found.id}) {_capitalised(found.title)}"
    return f"{_capitalised(found.title)} (`{found.id}`)"


def _rests_on(found: Equation) -> str:
    others = len(found.steps) - len(found.statements)
    if others == 0:
        return "as it stands"
    return "from one statement" if others == 1 else f"from {others} statements"


def _capitalised(text: str) -> str:
    """The text with a capital, unless it begins with a symbol."""
    return text[0].upper() + text[1:] if text[1:2].isalpha() else text


def _formula(found: Equation) -> str:
    return _block(rf"{found.latex}\tag{{{found.id}}}")


def _block(latex: str) -> str:
    return f"```{{math}}\n{latex}\n```"
