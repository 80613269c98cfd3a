"""Section 2: the model, equations (1) to (6), as relations.

Overview
    These are not repeated beside each result, which is understood to rest on the model.  No other
    relation may therefore be called an equation of the model, or an initial condition.
Key results
    CLOSURE             (1), as printed (False) and with the sign that wear of the pin has (True)
    REACTION, SUPPORT   (2)
    ROUGHNESS           (3)
    contact             (4) and the text under it, for a contact law
    at_every_closure    (4) without its cutoff
    ARCHARD             (5)
    START               (6)
    SLIP                section 2.4
    WORDS               the names of (1) to (5) and of those of section 2.4
    law_of              the law in (4)
    subject             the quantity that one of them determines
    FIELDS              the functions of time in (1) to (5)
    WEARING             the fields that have rates
"""

from __future__ import annotations

from types import MappingProxyType

import sympy as sp
from sympy.core.function import AppliedUndef

from ..laws import GENERAL, TANH, ContactLaw, r
from ..symbols import initial, rate, symbols

h, h_0, U_a, U_c, u_a, u_c = symbols("h h_0 U_a U_c u_a u_c")
sigma, sigma_a, sigma_c, sigma_a0, sigma_c0 = symbols("sigma sigma_a sigma_c sigma_a0 sigma_c0")
p, p_max, R_a, b, L, k = symbols("p p_max R_a b L k")
V, R, omega, n = symbols("V R omega n")
f_aa, f_ac, f_cc, f_ca = symbols("f_aa f_ac f_cc f_ca")
K_a, K_c, H_a, H_c = symbols("K_a K_c H_a H_c")

CLOSURE = MappingProxyType(
    {
        opening: sp.Eq(h, h_0 + (u_c + u_a if opening else u_c - u_a) + U_c - U_a)
        for opening in (False, True)
    }
)
REACTION = sp.Eq(p * b * L - R_a, 0)
SUPPORT = sp.Eq(k * U_c - p, 0)
ROUGHNESS = sp.Eq(sigma, sp.sqrt(sigma_a**2 + sigma_c**2))
ARCHARD = (
    sp.Eq(rate("u_a"), K_a * p * V / (3 * H_a)),
    sp.Eq(rate("sigma_a"), f_aa * rate("u_a") + f_ac * rate("u_c")),
    sp.Eq(rate("u_c"), K_c * p * V / (3 * H_c)),
    sp.Eq(rate("sigma_c"), f_cc * rate("u_c") + f_ca * rate("u_a")),
)
START = (
    sp.Eq(initial("h"), h_0),
    sp.Eq(initial("u_c"), 0),
    sp.Eq(initial("u_a"), 0),
    sp.Eq(initial("sigma_a"), sigma_a0),
    sp.Eq(initial("sigma_c"), sigma_c0),
)
FIELDS = frozenset(f.func for f in (h, U_a, U_c, u_a, u_c, sigma, sigma_a, sigma_c, p, R_a))
WEARING = frozenset((u_a, u_c, sigma_a, sigma_c))
"""Fields that have rates by Archard's law; another field needs a premise that it has one."""
SLIP = (sp.Eq(V, R * omega), sp.Eq(omega, sp.pi * n / 30))


def contact(law: ContactLaw) -> sp.Equality:
    """Return (4) with the text under it: no contact where h exceeds the cutoff, 3 sigma."""
    pressure = p_max * law.ratio(h / sigma)
    return sp.Eq(p, sp.Piecewise((pressure, h <= law.cutoff * sigma), (0, True)))


def at_every_closure(law: ContactLaw) -> sp.Equality:
    """Return (4) as the note uses it from (7e) on."""
    return sp.Eq(p, p_max * law.ratio(h / sigma))


WORDS = MappingProxyType(
    {
        **dict.fromkeys(CLOSURE.values(), "kinematics, Eq. (1)"),
        REACTION: "equilibrium of the pin, Eq. (2)",
        SUPPORT: "equilibrium of the bearing, Eq. (2)",
        ROUGHNESS: "equivalent roughness, Eq. (3)",
        contact(TANH): "contact law with its cutoff, Eq. (4)",
        **dict.fromkeys(ARCHARD[::2], "Archard's law, Eq. (5)"),
        **dict.fromkeys(ARCHARD[1::2], "roughness changes with wear, Eq. (5)"),
        SLIP[0]: "slip rate of the pin, section 2.4",
        SLIP[1]: "revolutions per minute",
    }
)
"""The names of the equations, without (6)."""


def subject(relation: sp.Equality) -> object:
    """Return the quantity whose value or rate an equation of the model determines.

    >>> subject(SUPPORT), subject(ARCHARD[0])
    (U_c, u_a)
    """
    given = {SUPPORT: U_c, REACTION: R_a}.get(relation, relation.lhs)
    given = given.expr if isinstance(given, sp.Derivative) else given
    return given.func if given.args else given


def law_of(relation: sp.Basic) -> sp.Expr | None:
    """Return phi(r) where a relation is (4) for some law of r = h/sigma alone."""
    for part in relation.atoms(sp.Piecewise):
        share = part.args[0].expr.subs(h, r * sigma) / p_max
        others = (share.free_symbols | share.atoms(AppliedUndef)) - {r, GENERAL.phi}
        if not others and relation == contact(ContactLaw("", share, sp.S.Zero, "")):
            return share
    return None
