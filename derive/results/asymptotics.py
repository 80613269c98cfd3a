"""Asymptotics as code: the long-time formulas in a form for numerical evaluation.

Overview
    One and two worn solids, rough or smooth pins, rigid or compliant supports and every contact
    law share a few formulas: with q the growth of roughness and g that of the closure per wear,
    h/sigma tends to g/q, which determines pressure, wear per cycle and the coefficient of ln N.
    The formulas here are taken from the proved statements; a test asserts that for one solid
    they reduce to those of the note.
Key results
    formulas    the functions to generate
    module      the source of wear/generated/asymptotics.py
"""

from __future__ import annotations

import sympy as sp

from ..codegen import contact_law
from ..codegen.contact_law import equal
from ..codegen.formulas import Formula, formula_module
from ..laws import LAWS, r
from ..note.condensed import bearing_only
from ..rules.algebra import substitute
from ..symbols import symbol, symbols
from .cutoff import arrest_depth, permanent_contact
from .cutoff_two_solids import arrest_depth_two_solids, sigma_stop, u_stop
from .cutoff_two_solids import discriminant as whole
from .regime_map import OUTGROWN, THIRD
from .regimes import logarithmic_wear
from .two_solids import TwoSolids, sigma
from .validity import bound

q, g, p_1, p_inf, T = symbols("q g p_1 p_inf T")
K_a, K_c, H_a, H_c, p_max = symbols("K_a K_c H_a H_c p_max")
h_0, U_mean, U_max, sigma_c0, N = symbols("h_0 U_mean U_max sigma_c0 N")
p, sigma_a0, f_a, f_c, kappa = symbols("p sigma_a0 f_a f_c kappa")

ORIGIN = (
    "two-solids",
    "two-solids-closure-ratio",
    "two-solids-rate",
    "two-solids-log-drift",
    "compliant-pressure",
    "arrest-depth",
    "arrest-depth-two-solids",
    "permanent-contact",
    "logarithmic-wear",
    "threshold",
)

u = sp.Symbol("u", real=True)
"""Wear of the bearing, as a number."""

steepness = sp.Symbol("steepness", real=True)
"""phi'/phi at the limit of h/sigma."""

load_factor = sp.Symbol("load_factor", positive=True)
log_load_factor = sp.Symbol("log_load_factor", real=True)
"""Logarithm of the mean over a cycle of exp(4 U_a/sigma_c0)."""


APART = f_a * kappa * sigma_c0 - f_c * sigma_a0
"""Zero if the roughnesses of the two solids keep their ratio, as when they vanish together."""

OFFSET = (h_0 - U_mean) / q - g * p_1 / q**3
"""The limit of u_c (h/sigma - g/q), averaged over a cycle."""


def formulas() -> tuple[Formula, ...]:
    """Return the long-time formulas."""
    return (*_geometry(), *_laws(), *_steady(), *_cutoff(), *_logarithmic())


def _geometry() -> tuple[Formula, ...]:
    printed, physical = TwoSolids(), TwoSolids(opening=True)
    growth, gap, cross = (judgement.claim.rhs for judgement in printed.definitions)
    opening = physical.definitions[1].claim.rhs
    return (
        Formula("pin_wear", (), K_a * H_c / (K_c * H_a), "wear of the pin per wear of the bearing"),
        Formula("roughness_growth", (), growth, "roughness per wear at large wear, q"),
        Formula("closure_growth", (), gap, "growth of the closure per wear, g, Eq. (1) as printed"),
        Formula("closure_growth_opening", (), opening, "the same with the physical sign"),
        Formula("cross_roughness", (), cross, "half the slope of sigma^2 at no wear, p_1"),
        Formula("apart", (), APART, "zero if the roughnesses of the two solids keep their ratio"),
        Formula("closure_ratio", (), g / q, "limit of h/sigma"),
        Formula("vanishing_wear", (), _vanishing(), "wear at which the roughness vanishes"),
        Formula("gap_at_peak", (u,), h_0 + g * u - U_max, "closure at the peak of the load"),
        Formula("gap_opens", (), (U_max - h_0) / g, "wear at which it vanishes"),
    )


def _vanishing() -> sp.Expr:
    """Return the wear at which sigma vanishes when both roughnesses vanish together."""
    wear = -p_1 / q**2
    squared = sigma**2 - (APART / q) ** 2
    values = {s.claim.lhs: s.claim.rhs for s in TwoSolids().definitions}
    equal(squared.subs(symbol("u_c"), wear).subs(values), sp.S.Zero)
    return wear


def _laws() -> tuple[Formula, ...]:
    argument = Formula("tanh_argument", (r,), 4 - 2 * r, "argument of tanh at h/sigma = r")
    return (argument, *(formula for law in LAWS.values() for formula in contact_law.formulas(law)))


def _steady() -> tuple[Formula, ...]:
    problem = bearing_only()
    for law in LAWS.values():
        slope = sp.diff(law.phi, r).subs(r, g / q) / law.ratio(g / q)
        equal(slope * OFFSET, TwoSolids(law).drift.claim.value)
    archard = substitute(problem.wear_laws[2], problem.slip).claim.rhs
    deflection = problem.deflection.claim.rhs
    compliant = OFFSET.subs(h_0, h_0 + deflection.subs(p, p_inf))
    per_cycle = sp.expand(archard.subs(p, p_inf) * T)
    share = sp.Symbol("share", positive=True)
    return (
        Formula("pressure", (share,), p_max * share, "contact pressure at a share of the largest"),
        Formula("wear_per_cycle", (), per_cycle, "asymptotic wear of one cycle"),
        Formula(
            "log_coefficient",
            (steepness,),
            steepness * OFFSET,
            "coefficient of ln N, rigid support; with U_a for its mean, that of the local rate",
        ),
        Formula(
            "log_coefficient_compliant",
            (steepness,),
            steepness * compliant,
            "the same on a compliant support",
        ),
    )


def _cutoff() -> tuple[Formula, ...]:
    """Return the formulas of the cutoff.

    Those of two solids start from a wear ``u`` with a gap at the peak of the load: they are the
    derived formulas with the gap and the roughness at that wear.
    """
    gap, cross, squared = sp.symbols("gap cross squared", real=True)
    half, product, root = sp.symbols("half product root", real=True)
    worn = (
        (gap, h_0 + g * u - U_max),
        (cross, p_1 + q**2 * u),
        (squared, sigma_a0**2 + sigma_c0**2 + (p_1 + cross) * u),
    )
    parts = (*worn, (half, 9 * cross - g * gap), (product, 9 * squared - gap**2))
    inside = half**2 + (g**2 - 9 * q**2) * product
    depth = u + product / (sp.sqrt(inside) - half)
    equal(2 * worn[1][1], sp.diff(sigma_stop**2, u_stop).subs(u_stop, u))
    equal(worn[2][1].subs(*worn[1]), (sigma_stop**2).subs(u_stop, u))
    fresh = {h_0: U_max + gap, p_1: cross, sigma_a0: 0, sigma_c0: sp.sqrt(squared)}
    derived_depth = u + arrest_depth_two_solids.claim.rhs
    for form, derived in ((inside, whole), (depth, derived_depth)):
        equal(form.subs(parts[:2:-1]), derived.subs(fresh))
    discriminant = sp.Symbol("discriminant", real=True)
    relation = sp.And(discriminant >= 0, discriminant > half * sp.Abs(half))
    return (
        Formula("arrest_depth", (), arrest_depth.claim.rhs, "wear at arrest, one worn solid"),
        Formula("gap_outgrows_roughness", (), OUTGROWN.relation, "the gap outgrows the roughness"),
        Formula("gap_and_cutoff_grow_alike", (), THIRD.relation, "gap and cutoff grow alike"),
        Formula(
            "margin_is_lost",
            (u,),
            relation,
            "the margin has a zero",
            (*parts, (discriminant, inside)),
        ),
        Formula(
            "arrest_depth_two_solids",
            (u,),
            u + product / (root - half),
            "wear at arrest, two solids",
            (*parts, (root, sp.sqrt(inside))),
        ),
        Formula(
            "permanent_depth",
            (),
            permanent_contact.claim.rhs,
            "wear beyond which contact is permanent, f_c > 1/3",
        ),
    )


def _logarithmic() -> tuple[Formula, ...]:
    claim = logarithmic_wear.claim
    factor = sp.besseli(0, 4 * symbols("U")[0] / sigma_c0)
    inside = claim.rhs.atoms(sp.log).pop().args[0]
    per_cycle = sp.expand((inside - 1) / N).subs(factor, load_factor)
    level = sp.Symbol("level", real=True)
    coefficient, mean = sp.cancel(claim.rhs / sp.log(inside)), sp.log(load_factor)
    return (
        Formula("tail_coefficient", (), coefficient, "coefficient of ln N for f_c = 0"),
        Formula(
            "tail_offset",
            (log_load_factor,),
            coefficient * level,
            "offset of the wear for f_c = 0",
            ((level, sp.expand_log(sp.log(per_cycle)).subs(mean, log_load_factor)),),
        ),
        Formula("slope_threshold", (), bound, "least f_c of a resolution epsilon"),
    )


def module() -> str:
    """Return the source of the generated module."""
    return formula_module("Long-time behaviour: the formulas of the regimes.", ORIGIN, formulas())
