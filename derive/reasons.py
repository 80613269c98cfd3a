"""The reason of each condition: a counterexample to the equation without it.

Overview
    The falsifier drops the conditions of each equation of the note in turn and looks for a model
    of all the others in which the equation is false.  That takes minutes, so the table of the
    outcomes is committed: ``reasons.json``, under a hash of hypotheses and claim.  Each model is
    drawn again from its seed, so that the table can be checked at once.
    ``python -m derive.reasons`` renews it.
Key results
    table        the rows, equation after equation
    line_of      the line of its equation that a row is about
    outdated     the equations whose rows are missing, or no longer true
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path

from . import catalogue
from .claims import Predicate
from .equations import Equation
from .falsifier.verdict import SEEDS, counterexample_without, is_open_without
from .files import write_atomically
from .hypotheses import Hypothesis
from .kernel import Judgement
from .typeset.display import inline

TABLE = Path(__file__).with_name("reasons.json")


@dataclass(frozen=True)
class Reason:
    """A condition of an equation, and a model that breaks it without this condition.

    ``model`` is in LaTeX, an equation each; ``where`` describes how the claim fails there; both
    are empty where no model was found.  ``left`` is, in LaTeX, the domain that a quantity leaves
    there, if the condition gives the claim a meaning instead.  ``key`` is a hash of hypotheses and
    claim, ``seed`` the one from which the model was drawn, -1 if none.
    """

    equation: str
    condition: str
    latex: str
    model: tuple[str, ...]
    where: str
    key: str
    left: str = ""
    seed: int = -1


def table() -> tuple[Reason, ...]:
    """Return the committed rows, in the order of the catalogue."""
    rows = json.loads(TABLE.read_text(encoding="utf-8"))
    return tuple(Reason(**{**row, "model": tuple(row["model"])}) for row in rows)


def line_of(row: Reason) -> int:
    """Return the place of a row's formula, from 1, in an equation of several; 0 if it is one."""
    keys = [key(statement) for statement in catalogue.equation(row.equation).statements]
    return keys.index(row.key) + 1 if len(keys) > 1 else 0


def outdated(equations: Sequence[Equation], rows: Sequence[Reason]) -> list[str]:
    """Return the ids of the equations whose rows are missing, or have models that are no longer
    drawn from their seeds or in which the equation holds."""
    kept = _by_place(rows)
    stale = (
        equation.id
        for equation in equations
        for place, about in _places(equation).items()
        if place not in kept or not _is_current(kept[place], *about)
    )
    return [*dict.fromkeys(stale)]


def _by_place(rows: Sequence[Reason]) -> dict[tuple[str, str, str], Reason]:
    return {(row.equation, row.condition, row.key): row for row in rows}


def _is_current(row: Reason, statement: Judgement, condition: Hypothesis) -> bool:
    """Return whether the model of a row is drawn again and breaks the equation, or leaves it open.

    Last values depend on rounding, and so do trends that are barely clear.
    """
    seeds = [row.seed] if row.model else []
    new = reason(row.equation, statement, condition, seeds)
    same = replace(new, where=row.where) == row
    return same or (bool(seeds) and is_open_without(statement, condition, row.seed))


def _places(equation: Equation) -> dict[tuple[str, str, str], tuple[Judgement, Hypothesis]]:
    """Return the conditions of an equation that the falsifier can drop, by id, text and hash."""
    return {
        (equation.id, condition.brief, key(statement)): (statement, condition)
        for statement in equation.statements
        for condition in statement.conditions
        if not isinstance(condition.relation, Predicate)
        if condition.relation != statement.relation
    }


def key(statement: Judgement) -> str:
    """Return the hash of the hypotheses and the claim of a statement, as rows have it."""
    relations = (statement.relation, *(h.relation for h in statement.hypotheses))
    return hashlib.sha256("\n".join(map(str, relations)).encode()).hexdigest()[:12]


def renewed(equations: Sequence[Equation], rows: Sequence[Reason]) -> Iterator[Reason]:
    """Yield a row for every condition; look for those that are missing or outdated."""
    known = _by_place(rows)
    for equation in equations:
        for place, about in _places(equation).items():
            row = known.get(place)
            yield row if row and _is_current(row, *about) else reason(equation.id, *about)


def reason(
    identifier: str, statement: Judgement, condition: Hypothesis, seeds: Sequence[int] = SEEDS
) -> Reason:
    """Return the row of a condition, with a model drawn from one of the seeds."""
    broken = counterexample_without(statement, condition, seeds)
    model = tuple(map(inline, broken.model)) if broken else ()
    where = broken.where if broken else ""
    left = inline(broken.left) if broken and broken.left is not None else ""
    seed = broken.seed if broken else -1
    about = identifier, condition.brief, condition.latex
    return Reason(*about, model, where, key(statement), left, seed)


def main() -> None:
    """Write the table of the note's equations."""
    of_the_note = [entry for entry in catalogue.all_equations() if entry.id[0].isdigit()]
    rows = [asdict(row) for row in renewed(of_the_note, table() if TABLE.exists() else ())]
    write_atomically(TABLE, json.dumps(rows, indent=1, ensure_ascii=False) + "\n")


if __name__ == "__main__":
    main()
