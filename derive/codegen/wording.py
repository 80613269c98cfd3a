"""Words of the generated sources: titles of variants and meanings of names.

Key results
    title_of      a variant in a sentence
    margin_title  the functions that loss of contact adds, in a sentence
    sentence      words with a capital
    meaning_of    a parameter, constant or field, with its unit
    remark_on     an intermediate of a function, with its equation
"""

from __future__ import annotations

from ..note.governing import Pin
from ..symbols import QUANTITIES
from ..variant import Variant

_PINS = {
    Pin.ABSENT: "smooth pin that does not wear",
    Pin.ROUGH: "rough pin that does not wear",
    Pin.WORN: "smooth pin that wears",
    Pin.WORN_ROUGH: "rough pin that wears",
}

_CONSTANTS = {
    "largest_rate": "wear rate at the largest pressure, mm/s",
    "wear_per_pressure": "wear rate per contact pressure, mm/(s MPa)",
    "gain": "closure per wear of the bearing at a fixed pin",
    "slope_a": "roughness of the pin per wear of the bearing",
    "compliance": "deflection of the support per pressure, mm/MPa",
    "most_of_margin": "fresh_margin less one roughness, mm",
    "fresh_margin": "3 sigma - h without wear and load, mm",
    "most_of_gain": "margin_gain less one roughness growth",
    "margin_gain": "3 sigma - h per wear of the bearing, undeflected",
    "pin_wear_sign": "+1 where wear of the pin opens the gap, -1 where it closes it",
}

_INTERMEDIATES = {
    "sigma_a": "roughness of the pin, (5)",
    "sigma_c": "roughness of the bearing, (5)",
    "sigma": "equivalent roughness, (3)",
    "h": "closure, (1)",
    "ratio": "h/sigma",
    "odds": "p/(p_max - p)",
    "share": "p/p_max",
    "spread": "p (p_max - p)/p_max^2",
    "residual_p": "slope of the residual with p",
    "rise": "p_max times the fall of the law per pressure",
    "level": "logarithm of z, whose Lambert function W(z) is the start",
    "grown": "1 + the smaller of z and 1/z",
    "height": "ln(1 + z)",
}


def title_of(variant: Variant) -> str:
    """Return a sentence on the law, the support and the pin of a variant.

    >>> from derive.variant import VARIANTS
    >>> title_of(VARIANTS[0])
    'Tanh contact law, rigid support, smooth pin that does not wear.'
    """
    support = "compliant support" if variant.compliant else "rigid support"
    ends = ", contact for h <= 3 sigma only" if variant.ends_at_3_sigma else ""
    law = sentence(variant.law.name)
    return f"{law} contact law, {support}, {_PINS[variant.pin]}{ends}."


def margin_title(pin: Pin) -> str:
    """Return the title of the functions that loss of contact adds.

    >>> margin_title(Pin.WORN)
    'Loss of contact at h = 3 sigma: smooth pin that wears.'
    """
    return f"Loss of contact at h = 3 sigma: {_PINS[pin]}."


def sentence(words: str) -> str:
    """Return words that begin with a capital letter.

    >>> sentence("closure, mm")
    'Closure, mm'
    """
    return words[0].upper() + words[1:]


def meaning_of(name: str) -> str:
    """Return the meaning and the unit of a parameter, a constant or a field.

    >>> meaning_of("h_0"), meaning_of("gain")
    ('initial closure, mm', 'closure per wear of the bearing at a fixed pin')
    """
    if name not in QUANTITIES:
        return _CONSTANTS[name]
    unit = QUANTITIES[name].unit
    return f"{QUANTITIES[name].meaning}, {'dimensionless' if unit == '1' else unit}"


def remark_on(name: str) -> str:
    """Return the meaning of an intermediate and its equation.

    >>> remark_on("sigma"), remark_on("ratio_u")
    ('equivalent roughness, (3)', 'd ratio/d u_c')
    """
    if name not in _INTERMEDIATES and name.endswith("_u"):
        return f"d {name.removesuffix('_u')}/d u_c"
    if name.startswith(("rate_", "margin_", "total_")):
        return f"derivative with respect to {name.partition('_')[2]}"
    return _INTERMEDIATES[name] if name in _INTERMEDIATES else meaning_of(name)
