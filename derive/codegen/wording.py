"""Words of the generated sources: titles of variants and meanings of names.

Key results
    title_of      a program in a sentence
    sentence      words with a capital
    meaning_of    a function, parameter, constant or field, with its unit
    remark_on     an intermediate of a function, with its equation
"""

from __future__ import annotations

from ..note.governing import Pin
from ..program import Program
from ..symbols import QUANTITIES

_PINS = {
    Pin.ABSENT: "smooth pin that does not wear",
    Pin.ROUGH: "rough pin that does not wear",
    Pin.WORN: "smooth pin that wears",
    Pin.WORN_ROUGH: "rough pin that wears",
}

_FUNCTIONS = {
    "rate": "wear rate of the bearing, du_c/dt, in mm/s",
    "slope": "derivative of the wear rate with respect to u_c, in 1/s",
    "rate_and_slope": "wear rate in mm/s and its derivative with respect to u_c in 1/s",
    "residual": "residual of the equation for the contact pressure p, in MPa",
    "undeflected": "closure over roughness with an undeflected support",
    "softness": "deflection of the support per pressure, over the roughness, in 1/MPa",
    "start": "estimate of the pressure with the support, in MPa",
    "lower": "a pressure below that with the support, in MPa",
    "upper": "a pressure above that with the support, in MPa",
    "newton": "the pressure after a step of Newton's iteration from p, in MPa",
    "fields": "every field at given wear and load, in mm and MPa",
    "margin": "3 sigma - h with an undeflected support, in mm: contact where it is not negative",
    "margin_slope": "derivative of the margin with respect to u_c; with respect to U_a it is 1",
    "margin_terms": "sum of the absolute terms of the margin, in mm, the scale of its rounding",
    "limited_pressure": "contact pressure in MPa: root of the residual, or that with h at 3 sigma",
    "limited_slope": "derivative of the wear rate with respect to u_c with h at 3 sigma, in 1/s",
    "rate_gradient": "derivatives of the wear rate with respect to U_a and to the constants",
    "margin_gradient": "derivatives of the margin with respect to the constants; to U_a it is 1",
    "parameter_gradient": "derivatives with respect to the parameters, from those by the constants",
    "contact_pressure": "contact pressure in MPa at closure and roughness in mm, and its slope",
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


def title_of(program: Program) -> str:
    """Return a sentence on the law, the support and the pin of a program's variant.

    >>> from derive.program import margin_program, program
    >>> from derive.variant import VARIANTS
    >>> title_of(program(VARIANTS[0]))
    'Tanh contact law, rigid support, smooth pin that does not wear.'
    >>> title_of(margin_program(Pin.WORN))
    'Loss of contact at h = 3 sigma: smooth pin that wears.'
    """
    variant = program.variant
    if not program.fields:
        return f"Loss of contact at h = 3 sigma: {_PINS[variant.pin]}."
    support = "compliant support" if variant.compliant else "rigid support"
    ends = ", contact for h <= 3 sigma only" if variant.ends_at_3_sigma else ""
    law = sentence(variant.law.name)
    return f"{law} contact law, {support}, {_PINS[variant.pin]}{ends}."


def sentence(words: str) -> str:
    """Return words that begin with a capital letter.

    >>> sentence("closure, mm")
    'Closure, mm'
    """
    return words[0].upper() + words[1:]


def meaning_of(name: str) -> str:
    """Return the meaning and the unit of a function, a parameter, a constant or a field.

    >>> meaning_of("h_0"), meaning_of("gain")
    ('initial closure, mm', 'closure per wear of the bearing at a fixed pin')
    """
    if name not in QUANTITIES:
        return _FUNCTIONS.get(name) or _CONSTANTS[name]
    unit = QUANTITIES[name].unit
    return f"{QUANTITIES[name].meaning}, {'dimensionless' if unit == '1' else unit}"


def remark_on(name: str) -> str:
    """Return the meaning of an intermediate and its equation.

    >>> remark_on("sigma"), remark_on("ratio_u")
    ('equivalent roughness, (3)', 'd ratio/d u_c')
    """
    if name.endswith("_u"):
        return f"d {name.removesuffix('_u')}/d u_c"
    return _INTERMEDIATES.get(name) or meaning_of(name)
