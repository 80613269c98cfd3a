"""The derived data of the explorer's page, written once into a file beside its scripts.

Deriving all variants and equations takes ten seconds and more, so ``explorer.derived.json`` is
committed.  A test fails when it is out of date; ``python -m wear.report.explorer_derived`` writes
it.

Key results
    derived           the content of the file
    of_own_law        the same for a contact law that a scene gives by a formula
    models            the generated functions of every variant, as JavaScript
    parameter_rows    the parameters of the sliders, from the vocabulary
    rows              the equations as HTML, each with the choices for which it holds
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from html import escape
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from derive.files import write_atomically
from derive.laws import LAWS, TANH, ContactLaw
from derive.typeset import mathml
from wear.own_laws import PREFIX
from wear.report.equations import capital
from wear.report.explorer import GROUPS, IN_MICROMETRES, MICROMETRES

if TYPE_CHECKING:
    from derive.codegen.formulas import Formula
    from derive.variant import Variant

FILE = "explorer.derived.json"

Choices = dict[str, tuple[str | bool, ...]]
"""Values of the controls, and of the regime, for which an equation holds; the others are free."""

_SMOOTH: Choices = {"pin": ("bearing",)}
_TWO_SOLIDS: Choices = {"pin": ("rough", "worn", "worn_rough")}
_RIGID: Choices = {"compliant": (False,)}
_COMPLIANT: Choices = {"compliant": (True,)}
_AS_PRINTED: Choices = {"opening": (False,)}
_OPENING: Choices = {"opening": (True,)}
_TANH: Choices = {"law": (TANH.name,)}
_OTHERS = tuple(name for name in LAWS if name != TANH.name)
_STEADY: Choices = {"regime": ("steady",)}
_WORN: Choices = {"regime": ("steady", "arrest")}
_PARTIAL: Choices = {"regime": ("partial",)}
_ARREST: Choices = {"regime": ("arrest",)}


def _of(regime: str, load: str) -> Choices:
    """Return the choices of a closed form for one regime under one kind of load."""
    return {"regime": (regime,), "load": (load,)} | _TANH | _SMOOTH | _RIGID


class _Row(NamedTuple):
    """An equation of the catalogue, under a title of this page."""

    title: str
    identifier: str
    holds: Choices


_LONG_RUN = (
    _Row("Pressure in the end", "general-law", {"law": _OTHERS} | _STEADY | _SMOOTH | _RIGID),
    _Row("Pressure in the end", "compliant-pressure", _STEADY | _SMOOTH | _COMPLIANT),
    _Row("Wear per cycle in the end", "21", _TANH | _STEADY | _SMOOTH | _RIGID),
    _Row(
        "Wear per cycle in the end",
        "compliant-wear-per-cycle",
        _TANH | _STEADY | _SMOOTH | _COMPLIANT,
    ),
    _Row("Pressure in the end", "22", _TANH | _STEADY | _SMOOTH | _RIGID),
    _Row("Logarithm in the wear", "log-drift", _TANH | _STEADY | _SMOOTH | _RIGID),
    _Row("Coefficient of ln N", "log-drift-compliant", _TANH | _STEADY | _SMOOTH | _COMPLIANT),
    _Row("Growth of gap and roughness", "two-solids", _WORN | _TWO_SOLIDS | _AS_PRINTED),
    _Row("Growth of gap and roughness", "two-solids-opening", _WORN | _TWO_SOLIDS | _OPENING),
    _Row("Closure over roughness in the end", "two-solids-closure-ratio", _STEADY | _TWO_SOLIDS),
    _Row("Wear rate in the end", "two-solids-rate", _TANH | _STEADY | _TWO_SOLIDS),
    _Row("Logarithm in the wear", "two-solids-log-drift", _TANH | _STEADY | _TWO_SOLIDS | _RIGID),
    _Row("Wear per cycle in the end", "one-third", _TANH | _PARTIAL),
    _Row("Wear in the end", "logarithmic-wear", _of("logarithmic", "sine")),
    _Row("Cycles to a roughness", "saturating-wear", _of("saturating", "constant")),
    _Row("Wear at arrest", "arrest-depth", _ARREST | _SMOOTH),
    _Row("Wear at arrest", "arrest-depth-two-solids", _ARREST | _TWO_SOLIDS),
)


def rows(laws: Mapping[str, ContactLaw]) -> str:
    """Return the equations that hold for contact laws, in the order of the argument."""
    from derive.catalogue import equation

    texts = [_html(*row) for row in _model(laws)]
    others = tuple(name for name in laws if name != TANH.name)
    for title, identifier, holds in _LONG_RUN:
        if holds.get("law") == _OTHERS:
            holds = holds | {"law": others}
        elif TANH.name not in laws:
            continue  # it does not hold for these laws, or stands among the equations for all
        number = f"({identifier})" if identifier[0].isdigit() else ""
        texts.append(_html(title, equation(identifier).latex, holds, number))
    return "\n".join(texts)


def holding(chosen: Mapping[str, str | bool]) -> tuple[str, ...]:
    """Return the ids of the long-run equations for these choices and this regime.

    For a contact law given by a formula these are the equations that hold for any law.
    """
    if chosen["law"] not in LAWS:
        chosen = {**chosen, "law": _OTHERS[0]}
    return tuple(
        row.identifier
        for row in _LONG_RUN
        if all(chosen[name] in values for name, values in row.holds.items())
    )


def _model(laws: Mapping[str, ContactLaw]) -> Iterator[tuple[str, str, Choices]]:
    """Yield the equations of all variants: title, LaTeX, and the choices for which each holds."""
    from derive.variant_equations import equations_of

    entries: dict[str, dict[tuple[str, str], list[Mapping[str, str | bool]]]] = {}
    variants = reversed([(law, variant) for law in laws for variant in _variants(laws[law])])
    for (law, variant), opening in product(variants, (False, True)):
        chosen = {
            "law": law, "pin": variant.pin.value, "compliant": variant.compliant,
            "cutoff": variant.ends_at_3_sigma, "opening": opening,
        }  # fmt: skip
        for each in equations_of(variant, opening=opening):
            entries.setdefault(each.id, {}).setdefault((each.title, each.latex), []).append(chosen)
    for (title, latex), choices in (row for forms in entries.values() for row in forms.items()):
        holds = {n: tuple(dict.fromkeys(each[n] for each in choices)) for n in choices[0]}
        yield capital(title), latex, holds


def _variants(law: ContactLaw) -> list[Variant]:
    from derive.variant import VARIANTS

    return [replace(variant, law=law) for variant in VARIANTS if variant.law is TANH]


def _html(title: str, latex: str, holds: Choices, number: str = "") -> str:
    chosen = escape(json.dumps(holds))
    return (
        f'<div data-holds="{chosen}"><p>{title}</p><div class="row">'
        f'<div class="formula">{mathml.block(latex)}</div><span>{number}</span></div></div>'
    )


def derived() -> str:
    """Return the file: models, equations, rows of the sliders, contact laws."""
    content = {
        "models": models(),
        "equations": rows(LAWS),
        "parameters": parameter_rows(),
        "laws": list(LAWS),
        "cutoff": int(TANH.cutoff),
    }
    return json.dumps(content, indent=1, ensure_ascii=False) + "\n"


def of_own_law(name: str) -> tuple[str, str]:
    """Return the script and the equations of a contact law that a scene gives by a formula."""
    from derive.codegen import contact_law
    from derive.own_law import NAME, own_law

    law, _ = own_law(name.removeprefix(PREFIX))
    script = f"Object.assign(MODELS, {{\n{_functions(name, law)}}});\n"
    script += f"Object.assign(FORMULAS, {_scope(contact_law.formulas(law))});\n"
    for kind in ("share", "steepness"):
        script += f"FORMULAS[{json.dumps(f'{kind}_{name}')}] = FORMULAS.{kind}_{NAME};\n"
    return script, rows({name: law})


def models() -> str:
    """Return a script with the generated functions of every variant and the formulas."""
    from derive.codegen import reaction
    from derive.results.asymptotics import formulas

    carried = [formula for formula in reaction.formulas() if formula.name == "pressure"]
    functions = "".join(_functions(name, law) for name, law in LAWS.items())
    return (
        f'"use strict";\nconst MODELS = {{\n{functions}}};\n'
        f"const FORMULAS = {_scope(formulas())};\nconst REACTION = {_scope(carried)};\n"
    )


def _functions(name: str, law: ContactLaw) -> str:
    """Return the functions of the variants of a contact law, as entries of an object."""
    from derive.codegen.sources import definitions
    from derive.program import program

    return "".join(
        f'"{name}/{variant.name}": () => {{\n'
        f"{_without_comments(definitions(program(variant)))}}},\n"
        for variant in _variants(law)
    )


def _scope(formulas: Iterable[Formula]) -> str:
    """Return formulas as an expression whose value has a function for each."""
    from derive.codegen.formulas import formula_script

    return f"(() => {{\n{_without_comments(formula_script(tuple(formulas)))}}})()"


def _without_comments(text: str) -> str:
    """Return code without its comments, which `derive code --target javascript` shows."""
    blocks = re.sub(r"/\*\*.*?\*/\n", "", text, flags=re.DOTALL)
    return re.sub(r"\n{2,}", "\n", re.sub(r" // .*", "", blocks))


def parameter_rows() -> list[dict[str, Any]]:
    """Return name, range, scale and unit of every slider."""
    from derive.symbols import POSITIVE, QUANTITIES, REAL

    rows = []
    for name, (low, high) in (row for group in GROUPS.values() for row in group.items()):
        quantity = QUANTITIES[name]
        unit = "" if quantity.unit == "1" else quantity.unit
        rows.append(
            {
                "name": name,
                "meaning": quantity.meaning.split(", ")[0],
                "latex": quantity.latex,
                "unit": "µm" if name in IN_MICROMETRES else unit,
                "scale": MICROMETRES if name in IN_MICROMETRES else 1.0,
                "low": low,
                "high": high,
                "logarithmic": quantity.domain == POSITIVE,
                "positive": quantity.domain == POSITIVE,
                "negative": quantity.domain == REAL,
            }
        )
    return rows


if __name__ == "__main__":
    write_atomically(Path(__file__).parent / "assets" / FILE, derived())
