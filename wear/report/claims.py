"""The ledger: every claim of the note with a verdict and the evidence of this run.

Overview
    Claims that mathematics decides are checked in ``derive.note.claim_checks``; here are those
    that need the note's scenes and their solution.  A check solves the note's problem and compares
    the result with the printed one.
Key results
    decided          the decision of a claim
    as_json          the ledger as the command prints it
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from derive.note.claim_checks import SYMBOLIC
from derive.note.claims import CLAIMS, Finding, NoteClaim, Verdict
from wear.report import note
from wear.report.note import PRINTED
from wear.solver import solve

LEAST_GROWTH = 1.0 / 8.0
"""The note's condition on f_c, printed after (22)."""


class Entry(NamedTuple):
    """One line of the ledger."""

    claim: NoteClaim
    finding: Finding


def _limit(name: str) -> float:
    """Return the wear per cycle in the limit: (21), or its form for two worn solids."""
    return note.required(note.limit(name).wear_per_cycle_mm)


def _initial_closure(name: str, printed: float, digits: int) -> Finding:
    """Compare a printed h_0 with three times the initial roughness."""
    exact = 3.0 * note.scene(name).initial_roughness
    evidence = f"3 sigma(0) = {exact:.9g} mm; printed {printed} mm"
    if abs(exact - printed) <= 1e-12 * exact:
        return Finding(Verdict.CONFIRMED, evidence)
    if round(exact, digits) != printed:
        return Finding(Verdict.NOT_REPRODUCIBLE, evidence)
    side = "out of contact" if printed > exact else "inside contact"
    return Finding(Verdict.CONDITIONAL, f"{evidence}, its rounding; taken literally, {side}")


def two_stages() -> Finding:
    """Decide C17: whether the rate of Fig. 2 levels off."""
    cycles = (100, 1000, 4500, 9000)
    steps = note.increments_after(note.scene("section3"), *cycles)
    still = steps[3] / steps[2]
    stop = note.limit("section3" + note.CUTOFF)
    shown = ", ".join(f"{step:.3e}" for step in steps)
    evidence = (
        f"wear of one cycle after {', '.join(map(str, cycles))} cycles: {shown} mm; a doubling "
        f"from {cycles[2]} changes it by a factor {still:.3f}, and no level is near: "
        f"(two-solids-rate), which needs f_c >= 0, would be {_limit('section3'):.2e} mm. With loss "
        f"of contact "
        f"wear stops at {stop.arrest_wear_mm:.4e} mm, in cycle {stop.arrest_cycle}: there is no "
        "stabilised stage either way"
    )
    levelled = still > 0.99
    return Finding(Verdict.CONFIRMED if levelled else Verdict.NOT_REPRODUCIBLE, evidence)


def stabilised_after() -> Finding:
    """Decide C34: the note's criterion at its number of cycles."""
    (step,) = note.increments_after(note.scene("section4"), PRINTED.cycles)
    distance = step / _limit("section4") - 1.0
    needed = note.limit("section4").cycles_to_stabilise
    mean, everywhere = (
        needed[key] or float("nan") for key in ("mean_rate_within_1e-6", "rate_within_1e-6")
    )
    met = abs(distance) < PRINTED.criterion
    return Finding(
        Verdict.CONFIRMED if met else Verdict.NOT_REPRODUCIBLE,
        f"after {PRINTED.cycles} cycles the mean rate exceeds its limit by {distance:.4g} times "
        f"the limit; an excess of {PRINTED.criterion:g} takes {mean:.3g} cycles on average over a "
        f"cycle, {everywhere:.3g} all through one",
    )


def _as_printed(computed: float, printed: float) -> bool:
    """Return whether a number rounds to one printed with three digits."""
    return f"{computed:.2e}" == f"{printed:.2e}"


def simulated_wear() -> Finding:
    """Decide C35: the simulated wear per cycle."""
    (wear,) = note.increments_after(note.scene("section4"), PRINTED.cycles)
    met = _as_printed(wear, PRINTED.simulated_mm)
    evidence = f"the solution gives {wear:.6e} mm, printed {PRINTED.simulated_mm:.2e} mm"
    if met:
        return Finding(Verdict.CONFIRMED, evidence)
    growth = f"which it would give with f_c = {note.growth_for_simulation():.8g} (see C36)"
    return Finding(Verdict.NOT_REPRODUCIBLE, f"{evidence}, {growth}")


def formula_wear() -> Finding:
    """Decide C36: the wear per cycle by (21)."""
    wear = _limit("section4")
    met = _as_printed(wear, PRINTED.formula_mm)
    evidence = (
        f"(21) gives {wear:.11e} mm, printed {PRINTED.formula_mm:.2e} mm, "
        f"{PRINTED.formula_mm / wear:.3f} times as much"
    )
    if met:
        return Finding(Verdict.CONFIRMED, evidence)
    return Finding(
        Verdict.NOT_REPRODUCIBLE,
        f"{evidence}; {note.reconciliation().sentence}; any other datum would have to change by "
        f"the whole factor: no plausible single change explains both printed values",
    )


def efficiency() -> Finding:
    """Decide C37: simulation and formula at the same cycle, and their convergence."""
    cycles = (PRINTED.cycles, 10**6, 10**8)
    limit, drift = _limit("section4"), note.limit("section4").log_coefficient_mm or 0.0
    steps = note.increments_after(note.scene("section4"), *cycles)
    law = [(step - limit) * n / drift for step, n in zip(steps, cycles, strict=True)]
    ratio = steps[0] / limit
    met = abs(ratio - 1.0) < 0.01
    shown = ", ".join(f"{value:.3f} at {n:.0e}" for value, n in zip(law, cycles, strict=True))
    return Finding(
        Verdict.CONFIRMED if met else Verdict.NOT_REPRODUCIBLE,
        f"at cycle {cycles[0]} the simulated wear of a cycle is {ratio:.4f} times that of (21); "
        f"the two do converge, as A/N: distance times N/A is {shown}",
    )


def quicker_for_lower_wear() -> Finding:
    """Decide C38: the order of the scenes of Fig. 3b, by the note's and an absolute criterion."""
    cycles = np.arange(1, 401)
    relative, absolute = [], []
    for name in note.SECTION_5:
        (step,) = note.increments_after(note.scene(name), PRINTED.cycles)
        relative.append(step / _limit(name) - 1.0)
        wear = solve(note.scene(name), [int(n) for n in cycles], rtol=1e-10).u_c
        absolute.append(int(cycles[1:][np.diff(wear) < PRINTED.criterion][0]) - 1)
    growing = all(np.diff(relative) > 0)
    coefficients = ", ".join(
        f"{note.scene(name).bearing.wear_coefficient:g}" for name in note.SECTION_5
    )
    distances = ", ".join(f"{value:.3g}" for value in relative)
    counts = ", ".join(map(str, absolute))
    return Finding(
        Verdict.CONFIRMED if growing else Verdict.REFUTED,
        f"for K = {coefficients} the relative distance from the limit after {PRINTED.cycles} "
        f"cycles is {distances}: the higher K, the nearer; less than {PRINTED.criterion:g} mm a "
        f"cycle is reached after {counts} cycles, in which sense it holds weakly",
    )


def data_and_condition() -> Finding:
    """Decide C40: whether the data satisfy the note's condition on f_c."""
    growths = {name: note.scene(name).bearing.roughness_growth for name in ("section3", "section5")}
    met = all(growth > LEAST_GROWTH for growth in growths.values())
    shown = ", ".join(f"f_c = {growth} in {name}" for name, growth in growths.items())
    return Finding(
        Verdict.CONFIRMED if met else Verdict.INCONSISTENT,
        f"{shown}; the note asks for f_c > {LEAST_GROWTH}; (two-solids-rate), which needs "
        f"f_c >= 0, is {_limit('section3'):.2e} and {_limit('section5'):.2e} mm a cycle",
    )


def pressure_and_hardness() -> Finding:
    """Decide C41: the real area of contact, load over hardness, is at most the nominal one."""
    scene, cycles = note.scene("section4"), (1, 100, PRINTED.cycles)
    most, hardness = scene.contact.max_pressure_MPa, scene.bearing.hardness_MPa
    peaks = solve(scene, cycles, rtol=1e-10).pressures.peak.tolist()
    shown = ", ".join(f"{peak:.4g} MPa in cycle {n}" for n, peak in zip(cycles, peaks, strict=True))
    return Finding(
        Verdict.CONFIRMED if most <= hardness else Verdict.INCONSISTENT,
        f"p_max is {most / hardness:.3g} H_c: under it the asperities would bear on {most:g}/"
        f"{hardness:g} of the nominal area, more than there is; the peak of section 4 is {shown}",
    )


SIMULATED: Mapping[str, Callable[[], Finding]] = MappingProxyType(
    {
        "C16": partial(_initial_closure, "section3", 0.0011, 4),
        "C17": two_stages,
        "C33": partial(_initial_closure, "section4", 0.00108, 5),
        "C34": stabilised_after,
        "C35": simulated_wear,
        "C36": formula_wear,
        "C37": efficiency,
        "C38": quicker_for_lower_wear,
        "C39": partial(_initial_closure, "section5", 0.0011, 4),
        "C40": data_and_condition,
        "C41": pressure_and_hardness,
    }
)
"""The checks that need the note's scenes, by claim."""


def decided(identifier: str) -> Entry:
    """Decide one claim."""
    return Entry(CLAIMS[identifier], {**SYMBOLIC, **SIMULATED}[identifier]())


def as_json(entries: Sequence[Entry]) -> list[dict[str, str]]:
    """Return the ledger as `wear claims --json` prints it."""
    return [
        {**claim._asdict(), "verdict": str(finding.verdict), "evidence": finding.evidence}
        for claim, finding in entries
    ]
