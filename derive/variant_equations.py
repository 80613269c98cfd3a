"""The equations of one variant, as reports and explorer show them.

Key results
    equations_of    closure, roughness, contact law, wear, and all of them in one
    opened          an equation of the catalogue for a pin whose wear opens the gap
"""

from __future__ import annotations

from dataclasses import replace

from .equations import Equation
from .hypotheses import RIGID
from .kernel import Judgement
from .laws import TANH
from .rules.algebra import substitute
from .rules.assumption import assume
from .symbols import symbol
from .variant import Variant

u_a = symbol("u_a")


def equations_of(variant: Variant, *, opening: bool) -> tuple[Equation, ...]:
    """Return the equations of a variant; `opening`: wear of its pin opens the gap.

    >>> from derive.variant import VARIANTS
    >>> print(equations_of(VARIANTS[0], opening=False)[0].latex)
    h = h_0 + u_c - U_a
    """
    model = replace(variant.model, opening=opening)
    absent = [model.wear_of_pin] * (not model.pin.wears)
    absent += [assume(RIGID)] * (not variant.compliant)
    closure = substitute(model.closure, *absent) if absent else model.closure
    law = model.pressure_with_cutoff if variant.ends_at_3_sigma else model.pressure
    of_note, printed = variant.law is TANH, not (opening and model.pin.wears)
    proofs = {
        "closure": ("closure of the mean surfaces", "1" * printed, closure),
        "roughness": ("equivalent roughness", "3", model.roughness_at_wear),
        "pressure": ("contact pressure", "4" * of_note, law),
        "wear": ("wear of the bearing", "5", model.wear_laws[2]),
        "slip": ("slip rate", "", model.slip),
    }
    if model.pin.wears:
        proofs["pin-wear"] = ("wear of the pin", "5", model.wear_of_pin)
    if variant.compliant:
        proofs["deflection"] = ("deflection of the support", "2", model.deflection)
    if not variant.ends_at_3_sigma:
        whole = model.implicit if variant.compliant else model.rigid_condensed
        if whole.relation.has(u_a):
            whole = substitute(whole, model.wear_of_pin)
        number = variant.equations[-1] if of_note and printed else ""
        proofs["whole"] = ("the model in one equation", number, whole)
    return tuple(
        Equation(f"scene-{name}", "", title + f", by ({number})" * bool(number), (proved,))
        for name, (title, number, proved) in proofs.items()
    )


_BY_SIGN = {
    "two-solids-closure-ratio": "ratio",
    "two-solids-rate": "rate",
    "two-solids-log-drift": "drift",
}


def opened(printed: Equation) -> Equation:
    """Return an equation of the catalogue for a pin whose wear opens the gap: with the definition
    g = 1 + kappa instead of 1 - kappa, if it has one.

    >>> from derive.catalogue import equation
    >>> opened(equation("two-solids-rate")).definitions_latex[1]
    'g = 1 + \\\\kappa'
    """
    from .results.two_solids import TwoSolids

    if printed.id not in _BY_SIGN:
        return printed
    proved: Judgement = getattr(TwoSolids(opening=True), _BY_SIGN[printed.id])
    return replace(printed, statements=(proved,))
