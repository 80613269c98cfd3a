"""The equations of the catalogue as a report shows them."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence

from derive import equations as derived
from derive.equations import abbreviated
from derive.hypotheses import Hypothesis
from derive.kernel import listed
from derive.typeset.formula import width
from derive.typeset.macros import macro_name
from wear.report.document import DisplayedEquation
from wear.report.markup import markup

#: Width in em up to which a hypothesis is shown as a formula.
_SHORT = 12.0

#: Width in em of a line of formulas.
_LINE = 30.0

#: The settings that both reports call "bearing wear alone".
_BEARING_ALONE = ("no loss of contact", "smooth pin", "unworn pin", "rigid support")
_ALONE = "bearing wear alone"


def shown(equations: Sequence[derived.Equation]) -> Mapping[str, DisplayedEquation]:
    """Return the equations by id, each with the ids of identical ones."""
    same: dict[Hashable, list[str]] = {}
    for equation in equations:
        same.setdefault(_content(equation), []).append(equation.id)
    return {e.id: _shown(e, same[_content(e)]) for e in equations}


def _content(equation: derived.Equation) -> Hashable:
    """Return the content of an equation: its formula and its conditions."""
    return equation.latex, frozenset(equation.conditions)


def _shown(equation: derived.Equation, same: Sequence[str]) -> DisplayedEquation:
    return DisplayedEquation(
        id=equation.id,
        latex=equation.latex,
        title=_title(equation),
        status=str(equation.status),
        printed="" if equation.agrees else equation.printed_latex,
        macro=macro_name(equation),
        also=tuple(identifier for identifier in same if identifier != equation.id),
        where=tuple(_lines(equation.definitions_latex)),
    )


def _lines(formulas: Iterable[str]) -> Iterator[str]:
    """Yield lines of joined formulas, each as full as its width allows."""
    line = ""
    for formula in formulas:
        longer = rf"{line}, \quad {formula}" if line else formula
        if line and width(longer) > _LINE:
            yield line
            longer = formula
        line = longer
    if line:
        yield line


def capital(text: str) -> str:
    """Return the text with a capital, unless it begins with the name of a quantity.

    >>> capital("wear per cycle"), capital("f_c = 0")
    ('Wear per cycle', 'f_c = 0')
    """
    return text[0].upper() + text[1:] if text[1:2].isalpha() or text[1:2] == " " else text


def _title(equation: derived.Equation) -> str:
    """Return the title of an equation with its hypotheses, except those of the whole paper.

    A part of the title that repeats one of the hypotheses is left out.
    """
    words = [c for c in equation.conditions if c.is_setting]
    conditions = [
        c if c.is_setting else Hypothesis(abbreviated(c.relation, equation.where))
        for c in equation.conditions
    ]
    short = [c.latex for c in conditions if _short(c)]
    formulas = [f"${part}$" for latex in short for part in latex.split(r", \quad ")]
    texts = [markup(c.text) for c in conditions if c not in words and not _short(c)]
    settings = dict.fromkeys(c.text for c in words)
    repeated = {_ALONE, *settings, *(formula.replace(" ", "") for formula in formulas)}
    name, *parts = equation.title.split(", ")
    title = [markup(capital(name))]
    title += [m for p in parts if not {p, (m := markup(p)).replace(" ", "")} & repeated]
    for word, hypotheses in (("for", formulas), ("if", texts)):
        if hypotheses:
            title.append(f"{word} {listed(hypotheses)}")
    if settings.keys() >= set(_BEARING_ALONE):
        settings = dict.fromkeys((_ALONE, *(s for s in settings if s not in _BEARING_ALONE)))
    brackets = f" ({', '.join(map(markup, settings))})" if settings else ""
    return ", ".join(title) + brackets


def _short(hypothesis: Hypothesis) -> bool:
    """Return whether a hypothesis is shown as a formula: it is short, or has no words."""
    formula = not hypothesis.words or width(hypothesis.latex) < _SHORT
    return formula and not hypothesis.is_setting
