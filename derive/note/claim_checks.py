"""The checks of the claims that mathematics alone decides; each can confirm or refute its claim.

Overview
    A check re-derives the subject of its claim and takes the verdict from the result: an equation
    whose steps all hold, its conditions, a derivative of one sign, a counterexample.
Key results
    SYMBOLIC    the checks by claim id
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from types import MappingProxyType

import sympy as sp

from .. import catalogue
from ..equations import Status
from ..kernel import domain
from ..laws import TANH, r
from ..reals import sign
from ..results import validity
from ..rules.algebra import Solve
from ..symbols import symbols
from ..typeset.present import presentable
from ..verification import verify
from ..zero import is_zero
from .claims import Finding, Verdict
from .governing import NoteModel
from .problems import problem_ii, undetermined
from .stabilised import asymptote, constant_bracket, wear_per_cycle

h_0, U_a, U_c, u_a, u_c, p = symbols("h_0 U_a U_c u_a u_c p")
f_c, sigma_c0, K_c, k, u_cum = symbols("f_c sigma_c0 K_c k u_cum")
_PRESSED = frozenset({sp.Gt(p, 0)})


@cache
def _holds(*ids: str) -> tuple[bool, str, bool]:
    """Return whether equations hold, the evidence, and whether they need conditions."""
    verdicts = verify(ids)
    good = all(v.passed and v.status in (Status.DERIVED, Status.DEFINITION) for v in verdicts)
    count = sum(len(v.checks) for v in verdicts)
    every = [c for i in ids for c in catalogue.equation(i).conditions]
    stated = [c for c in every if c.relation != domain(u_cum)]
    settings = dict.fromkeys(c.text for c in stated if c.is_setting)
    conditions = dict.fromkeys(c.brief for c in stated if not c.is_setting)
    shown = ", ".join(f"({i}) {v.status}" for i, v in zip(ids, verdicts, strict=True))
    setting = f"; setting: {', '.join(settings)}" if settings else ""
    needed = f"; needs {', '.join(conditions)}" if conditions else ""
    outcome = f"{count} checks{' hold' if good else ', some fail'}"
    return good, f"{shown}; {outcome}{setting}{needed}", bool(needed)


def _finding(holds: bool, evidence: str, otherwise: Verdict = Verdict.REFUTED) -> Finding:
    """Return a finding: the claim is confirmed if it holds, else the other verdict."""
    return Finding(Verdict.CONFIRMED if holds else otherwise, evidence)


def _equations(*ids: str) -> Callable[[], Finding]:
    """Return the check of a claim that equations of the catalogue state."""

    def check() -> Finding:
        good, evidence, conditional = _holds(*ids)
        otherwise = Verdict.CONDITIONAL if good else Verdict.REFUTED
        return _finding(good and not conditional, evidence, otherwise)

    return check


def closure_sign() -> Finding:
    """C1: the effect of pin wear on the gap."""
    model = NoteModel()
    slope = sp.diff(model.closure.claim.rhs, u_a)
    grows = sign(model.wear_laws[0].claim.rhs, _PRESSED)
    evidence = f"dh/du_a = {slope} while (5) gives du_a/dt > 0: wear closes the gap"
    return _finding(slope * grows >= 0, evidence, Verdict.INCONSISTENT)


def regularity() -> Finding:
    """C4: the pressure at the edge of contact."""
    jump = float(TANH.ratio(TANH.cutoff))
    drops = NoteModel().pressure.claim != NoteModel().pressure_with_cutoff.claim
    evidence = f"at h = 3 sigma the pressure jumps by {jump:.7f} p_max; (7e) has no cutoff"
    return _finding(jump <= 0 or not drops, evidence, Verdict.INCONSISTENT)


def below_maximum() -> Finding:
    """C5: 0 < p < p_max."""
    within = sign(TANH.phi) == 1 and sign(1 - TANH.phi) == 1
    edges = [sp.limit(TANH.phi, r, end) for end in (-sp.oo, sp.oo)]
    smooth = f"0 < p/p_max < 1 for every h, with limits {edges[0]} and {edges[1]}"
    return _finding(within, f"without its cutoff (4) gives {smooth}; with it p = 0 beyond 3 sigma")


def increasing() -> Finding:
    """C6: both wear rates are positive while there is pressure."""
    rates = [NoteModel().wear_laws[i].claim.rhs for i in (0, 2)]
    starts = [NoteModel().start[i].claim.rhs for i in (1, 2)]
    good = all(sign(value, _PRESSED) == 1 for value in rates) and starts == [0, 0]
    evidence = "both rates of (5) are positive for p > 0, and both depths start at 0"
    return _finding(good, evidence)


def positive_roughness() -> Finding:
    """C7: where the roughness of the bearing vanishes."""
    decline = sp.Symbol("|f_c|", positive=True)
    value = NoteModel().roughness_of_bearing.claim.rhs.subs(f_c, -decline)
    (zero,) = sp.solve(value, u_c)
    evidence = f"for f_c < 0 the roughness of (5), (6) vanishes at u_c = {zero}"
    return _finding(not zero.is_positive, evidence, Verdict.INCONSISTENT)


def initial_state() -> Finding:
    """C8: h(0) = h_0 against (1) and (2)."""
    model = NoteModel()
    start = dict.fromkeys((u_a, u_c), 0)
    gap = model.closure.claim.rhs.subs(start) - h_0
    gap = gap.subs(U_c, Solve(U_c)(model.support).claim.rhs)
    rigid = sp.limit(gap, k, sp.oo).subs(U_a, 0)
    evidence = f"(1), (2), (6) give h(0) - h_0 = {sp.expand(gap)} at t = 0"
    if rigid == 0 and not is_zero(gap):
        needs = "zero for a rigid support and U_a(0) = 0, in general not"
        return Finding(Verdict.CONDITIONAL, f"{evidence}; {needs}")
    return _finding(is_zero(gap), evidence)


def given_force() -> Finding:
    """C9: the loads for which (4) has a closure."""
    good, evidence, _ = _holds("problem-i")
    least, most = (sp.limit(TANH.phi, r, end) for end in (sp.oo, -sp.oo))
    if not good:
        return Finding(Verdict.REFUTED, evidence)
    needs = f"without its cutoff the range of (4) is {least} < p/p_max < {most}"
    return Finding(Verdict.CONDITIONAL, f"{evidence}: {needs}")


def recovered() -> Finding:
    """C12: every unknown of problem (ii) follows."""
    missing = undetermined(U_a, problem_ii)
    good, evidence, _ = _holds("problem-ii")
    unknowns = ", ".join(map(str, missing)) or "none"
    return _finding(good and not missing, f"unknowns left undetermined: {unknowns}; {evidence}")


def stiff_limit() -> Finding:
    """C14: the limit at equal wear, and the effect of the stiffness in the long run."""
    good, evidence, _ = _holds("10", "rigid-limit-error")
    drift = catalogue.equation("log-drift-compliant").relation
    if good and drift.has(k):
        needs = "u_c on bounded times only: the coefficient of its ln t depends on k"
        return Finding(Verdict.CONDITIONAL, f"{evidence}; {needs}")
    return _finding(good, evidence)


def deflection() -> Finding:
    """C15: p/k for k to infinity at bounded p."""
    value = sp.limit(Solve(U_c)(NoteModel().support).claim.rhs.subs(p, sp.Symbol("p")), k, sp.oo)
    return _finding(value == 0, f"U_c = p/k with 0 < p < p_max tends to {value}")


def vacuous() -> Finding:
    """C18: (11) is satisfied by every field."""
    good, evidence, _ = _holds("every-field")
    vacuity = f"G_inf = G satisfies (11) for every G, so it defines nothing; {evidence}"
    return _finding(not good, vacuity, Verdict.INCONSISTENT)


def without_dots() -> Finding:
    """C19: whether accumulation, case (b), satisfies (12) as printed."""
    cycles, bound = sp.symbols("cycles bound", positive=True)
    distance = sp.limit(cycles * u_cum - bound, cycles, sp.oo)
    evidence = (
        f"after N cycles of u_cum each, the distance to a periodic G_inf tends to {distance}: "
        "as printed (12) excludes its own case (b); for rates it holds"
    )
    return _finding(distance != sp.oo, evidence, Verdict.INCONSISTENT)


def periodic_rate() -> Finding:
    """C21: proved rather than assumed."""
    good, evidence, _ = _holds("14")
    return _finding(good, f"provable; {evidence}")


def bracket() -> Finding:
    """C24: the bracket of (16) in numbers."""
    constant = constant_bracket.claim.rhs
    data = {f_c: sp.Rational(1, 4), h_0: sp.Rational(27, 25000), sigma_c0: sp.Rational(9, 25000)}
    value = constant.subs(data).subs(U_a, 0)
    good, evidence, _ = _holds("bracket")
    refuted = good and not constant.has(u_c) and value != 0
    return _finding(
        not refuted,
        f"the bracket is 2 [f_c (h_0 - U_a) - sigma_c0], whatever u_c; for section 4 and U_a = 0 "
        f"it is {float(value):.2e} mm; {evidence}",
    )


def affine_asymptote() -> Finding:
    """C27: the coefficient of ln t."""
    drift = asymptote.claim.value
    (free,) = sp.solve(sp.numer(sp.together(drift)), sigma_c0)
    status = catalogue.equation("19").status
    only = sp.sstr(presentable(free), order="none")
    return _finding(
        is_zero(drift),
        f"(19) {status}: u_c - u_cum t/T grows like A ln t; A = 0 only for sigma_c0 = {only}",
    )


def linear_in_wear_coefficient() -> Finding:
    """C30: (21) as a function of K_c and of f_c."""
    wear = wear_per_cycle.claim.rhs
    affine = sp.diff(wear, K_c, 2) == 0
    linear = affine and wear.subs(K_c, 0) == 0
    bent = not is_zero(sp.diff(wear, f_c, 2))
    kind = "linear" if linear else "affine"
    evidence = f"(21) is {kind} in K_c; its second derivative in f_c is not zero"
    return _finding(affine and bent, evidence)


def one_eighth() -> Finding:
    """C32: the printed criterion, and the meaning of f_c > 1/8."""
    good, evidence, _ = _holds("criterion", "one-eighth")
    slope = sp.Rational(1, 10)
    margin = 1 + sp.tanh(4 - 2 / slope)
    counter = bool(margin > 0)
    share = validity.share.claim.rhs
    level = float(share.subs(f_c, sp.Rational(1, 8)))
    limits = ", ".join(
        f"{float(validity.threshold_at(value)):.6f} for {name}"
        for name, value in validity.RESOLUTIONS.items()
    )
    return _finding(
        not (good and counter),
        f"tanh(4 - 2/f_c) > -1 always, by {float(margin):.3e} at f_c = {float(slope)}; f_c > 1/8 "
        f"is p_inf/p_max > {level:.4e}, a resolution; thresholds: {limits}; {evidence}",
    )


SYMBOLIC = MappingProxyType(
    {
        "C1": closure_sign,
        "C2": _equations("2a", "2b", "7b", "7c"),
        "C3": _equations("3", "7d"),
        "C4": regularity,
        "C5": below_maximum,
        "C6": increasing,
        "C7": positive_roughness,
        "C8": initial_state,
        "C9": given_force,
        "C10": _equations("8"),
        "C11": _equations("8"),
        "C12": recovered,
        "C13": _equations("9", "pressure-root"),
        "C14": stiff_limit,
        "C15": deflection,
        "C18": vacuous,
        "C19": without_dots,
        "C20": _equations("13"),
        "C21": periodic_rate,
        "C22": _equations("15"),
        "C23": _equations("16a"),
        "C24": bracket,
        "C25": _equations("17a", "17b"),
        "C26": _equations("18"),
        "C27": affine_asymptote,
        "C28": _equations("20"),
        "C29": _equations("21"),
        "C30": linear_in_wear_coefficient,
        "C31": _equations("22"),
        "C32": one_eighth,
    }
)
"""The checks that need no simulation, by claim."""
