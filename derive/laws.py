"""Contact laws: the pressure as a function of closure over roughness.

Overview
    A law is one relation, p = p_max phi(h/sigma).  To add a law, add one entry to LAWS: the
    condensed problem, its right-hand side, the asymptotic pressure, the LaTeX and the
    generated modules follow.
Key results
    TANH         Eq. (4) of the note
    EXPONENTIAL  p_max exp(-h/sigma), the tail of a Greenwood-Williamson contact
    GENERAL      an unspecified positive, decreasing phi, for the general theorems
"""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType

import sympy as sp

r = sp.Symbol("r", real=True)
"""Closure over equivalent roughness, h/sigma."""


@dataclass(frozen=True)
class ContactLaw:
    """A contact law ``p = p_max phi(r)`` with ``r = h/sigma``.

    phi must be positive, smooth and decreasing (phi' < 0), convex for ``r > inflection`` and
    concave below it (``-oo``: convex everywhere); the pressure of a compliant support rests on
    that.
    ``cutoff`` is the ratio h/sigma beyond which the note's text has no contact.
    """

    name: str
    phi: sp.Expr
    inflection: sp.Expr
    source: str
    cutoff: int = 3

    def ratio(self, closure_ratio: sp.Expr) -> sp.Expr:
        """Return p/p_max at the given h/sigma."""
        return self.phi.subs(r, closure_ratio)


TANH = ContactLaw(
    name="tanh",
    phi=(1 + sp.tanh(4 - 2 * r)) / 2,
    inflection=sp.Integer(2),
    source="Eq. (4)",
)

EXPONENTIAL = ContactLaw(
    name="exponential",
    phi=sp.exp(-r),
    inflection=sp.S.NegativeInfinity,
    source="Greenwood and Williamson (1966), exponential distribution of heights",
)

GENERAL = ContactLaw(
    name="general",
    phi=sp.Function("phi", positive=True)(r),
    inflection=sp.S.NegativeInfinity,
    source="any positive, smooth, decreasing phi",
)

LAWS = MappingProxyType({law.name: law for law in (TANH, EXPONENTIAL)})
"""The laws that code is generated for."""
