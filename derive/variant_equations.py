"""The equations of one variant: what its scene needs, and nothing else.

Key results
    equations_of    closure, roughness, contact law, wear, and all of them in one
"""

from __future__ import annotations

from dataclasses import replace

from .equations import Equation
from .hypotheses import RIGID
from .rules.algebra import substitute
from .rules.assumption import assume
from .variant import Variant


def equations_of(variant: Variant, *, opening: bool) -> tuple[Equation, ...]:
    """Return the equations of a variant; `opening`: wear of its pin opens the gap.

    >>> from derive.variant import VARIANTS
    >>> print(equations_of(VARIANTS[0], opening=False)[0].latex)
    h = h_0 + u_c - U_a
    """
    model = replace(variant.model, opening=opening)
    support = () if variant.compliant else (assume(RIGID),)
    pin = () if model.pin.wears else (model.wear_of_pin,)
    law = model.pressure_with_cutoff if variant.ends_at_3_sigma else model.pressure
    found = {
        "closure": ("closure of the mean surfaces", substitute(model.closure, *pin, *support)),
        "roughness": ("equivalent roughness", model.roughness_at_wear),
        "pressure": ("contact pressure", law),
        "wear": ("wear of the bearing", model.wear_laws[2]),
        "slip": ("slip rate", model.slip),
    }
    if model.pin.wears:
        found["pin-wear"] = ("wear of the pin", model.wear_of_pin)
    if variant.compliant:
        found["deflection"] = ("deflection of the support", model.deflection)
    if not variant.ends_at_3_sigma:
        whole = model.implicit if variant.compliant else model.rigid_condensed
        found["whole"] = ("the model in one equation", whole)
    return tuple(
        Equation(f"scene-{name}", "", title, (proved,)) for name, (title, proved) in found.items()
    )
