"""The claims of the note and the possible verdicts on them.

Overview
    One row is one claim, in the order of the note.  Each is decided by a check, which runs every
    time: the symbolic ones in ``claim_checks``, those that need a simulation on the report
    side.  A verdict is computed by its check, never written down beforehand.
Key results
    CLAIMS    the claims by id
    Verdict   the possible outcomes for a claim
    Finding   a verdict with its evidence
"""

from __future__ import annotations

from enum import StrEnum
from types import MappingProxyType
from typing import NamedTuple


class Verdict(StrEnum):
    """The possible outcomes for a claim."""

    CONFIRMED = "confirmed"
    CONDITIONAL = "confirmed-with-conditions"
    NOT_REPRODUCIBLE = "not-reproducible"
    INCONSISTENT = "inconsistent"
    REFUTED = "refuted"


class NoteClaim(NamedTuple):
    """A claim and its place in the note."""

    id: str
    where: str
    statement: str


class Finding(NamedTuple):
    """The result of a check, which computed every figure in the evidence."""

    verdict: Verdict
    evidence: str


_TABLE = (
    ("C1", "(1)", "the closure is h_0 + [u_c + U_c] - [u_a + U_a]"),
    ("C2", "(2)", "equilibrium of pin and bearing"),
    ("C3", "(3)", "the equivalent roughness is the root of the sum of squares"),
    (
        "C4",
        "(4)",
        "the pressure is positive just for 0 <= h <= 3 sigma, and saturates regularly",
    ),
    ("C5", "(4)", "the pressure stays below p_max"),
    ("C6", "2.4", "u_a and u_c are positive and increase"),
    ("C7", "2.4", "sigma_a and sigma_c are positive"),
    ("C8", "2.5, (6)", "the initial state is in contact, h(0) = h_0 with 0 <= h_0 <= 3 sigma(0)"),
    ("C9", "3", "problem (i): a given load prescribes the pressure, and wear follows directly"),
    ("C10", "(8)", "the condensed problem"),
    ("C11", "(8)", "u_a = (K_a/K_c)(H_c/H_a) u_c"),
    ("C12", "3", "all fields follow once u_a and u_c are known"),
    ("C13", "(9)", "the problem has the form du_c/dt = Q(u_c, du_c/dt, t)"),
    ("C14", "(10)", "the explicit form is the limit of Q for k to infinity"),
    ("C15", "3", "U_c vanishes for k infinite"),
    ("C16", "3", "h_0 = 3 sigma(0) = 0.0011 mm"),
    ("C17", "3, Fig. 2", "a lapping transient, then a stabilised evolution"),
    ("C18", "(11)", "definition of an asymptotic response"),
    ("C19", "(12)", "definition of a stabilised response"),
    ("C20", "(13)", "the condensed problem when only the bearing wears"),
    ("C21", "(14)", "the wear rate becomes periodic"),
    ("C22", "(15)", "passage to the limit, both lines"),
    ("C23", "(16)", "passage to the limit, first line"),
    ("C24", "(16)", "u_cum times the limit of the bracket is zero"),
    ("C25", "(17)", "the argument of tanh tends to 4 - 2/f_c"),
    ("C26", "(18)", "limit of the wear rate"),
    ("C27", "(19)", "u_c has an affine asymptote"),
    ("C28", "(20)", "definition of the wear per cycle"),
    ("C29", "(21)", "wear per cycle in the stabilised state"),
    ("C30", "after (21)", "it is affine in K_c and not linear in f_c"),
    ("C31", "(22)", "pressure in the stabilised state"),
    ("C32", "after (22)", "valid only if tanh(4 - 2/f_c) > -1, that is f_c > 1/8"),
    ("C33", "4, data", "h_0 = 3 sigma(0) = 0.00108 mm"),
    ("C34", "4", "stabilised after 9000 cycles, criterion 1e-6"),
    ("C35", "4", "u_cum is about 2.34e-5 mm from the solution"),
    ("C36", "4", "u_cum is 2.35e-5 mm from (21)"),
    ("C37", "4", "the agreement of the two shows the efficiency of (21)"),
    ("C38", "5", "the lower K, the fewer cycles to stabilisation"),
    ("C39", "5, data", "h_0 = 3 sigma(0) = 0.0011 mm"),
    ("C40", "3, 5", "the data respect the condition f_c > 1/8 of a stabilised response"),
    ("C41", "3, 4, 5, data", "p_max = 300 MPa on a bearing whose hardness is H_c = 200 MPa"),
)

CLAIMS = MappingProxyType({row[0]: NoteClaim(*row) for row in _TABLE})
"""The claims by id, in the order of the note."""
