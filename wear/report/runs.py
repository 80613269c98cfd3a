"""The runs that the report needs, each made once.

Overview
    Everything here is a number: histories of the note's scenes in both readings, the approach of
    the wear to its asymptote, the closed solution against the solver, bounds, arrest and hard
    scenes. The paper's modules interpret the numbers.
Key results
    Runs    the results of all runs
    run     computes them
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import mpmath
import numpy as np
import sympy as sp

from derive.equations import stated
from derive.symbols import symbols
from wear.binding import bind
from wear.bounds import Enclosure, static_bounds, wear_bounds
from wear.generated import reaction
from wear.history import History
from wear.load import Constant
from wear.regime import Asymptote
from wear.report import note
from wear.request import cycles_along
from wear.scene import Scene, hard_names
from wear.solver import solve

SCENES = ("section3", "section4", *note.SECTION_5)

#: Requested relative errors with loss of contact, and of stress tests.
CUTOFF_RTOL = 1e-9
HARD_RTOL = 1e-8

#: Cases in which every cycle is integrated too, and how many cycles.
INTEGRATED = ("section4", "section3" + note.CUTOFF)
INTEGRATED_CYCLES = 600

_DECADES = tuple(10**n for n in range(1, 12))
STATIC_CYCLES = (1, 100, 10_000, 10**6, 10**8, 10**10)
_STATIC_DIGITS = 80  # the factors of the closed solution cancel
_HARD_CYCLES = 100


class Approach(NamedTuple):
    """The approach of section 4 to its asymptote: arrays along ``cycles``.

    ``increment`` mm is the wear of the cycle that follows, ``excess`` and ``pressure_excess`` are
    relative to (21) and (22), ``predicted`` is A/(N u_cum).
    """

    cycles: note.FloatArray
    wear: note.FloatArray
    increment: note.FloatArray
    excess: note.FloatArray
    pressure_excess: note.FloatArray
    predicted: note.FloatArray


@dataclass(frozen=True)
class Runs:
    """All runs of the report.

    ``histories`` has the states of the note's scenes over the cycles of the figures by name, those
    with loss of contact under ``name.cutoff``; ``asymptotes`` likewise. ``decay`` is the wear (mm)
    of the cycle that follows each number of cycles, of two worn solids. ``printed_increment`` mm is
    the wear of the cycle that the note calls stabilised, ``threshold_excess`` the relative excess
    over (21) at the cycle that the drift predicts for the note's criterion. ``phase_distance`` is
    the largest relative distance of the rate from its limit at the phases where it has it in every
    cycle, ``static_distance`` the largest relative difference between closed solution and solver
    under a constant load, and ``integrated`` that between the cycle count and the integration of
    every cycle, by name. ``hard`` has the stress tests.
    """

    histories: Mapping[str, History]
    asymptotes: Mapping[str, Asymptote]
    approach: Approach
    decay: Mapping[int, float]
    printed_increment: float
    reconciliation: note.Reconciliation
    threshold_excess: float
    phase_distance: float
    static_distance: float
    integrated: Mapping[str, float]
    static_bounds: Enclosure
    wear_bounds: Enclosure
    hard: tuple[History, ...]


def run(progress: Callable[[str], None] = lambda _: None) -> Runs:
    """Make every run; ``progress`` is called with the name of the next one."""
    histories, last = {}, note.PRINTED.cycles
    shown = cycles_along(1, last, 80, np.linspace(0, last, 91))
    for name in SCENES:
        progress(name)
        for case, rtol in ((name, note.RTOL), (name + note.CUTOFF, CUTOFF_RTOL)):
            histories[case] = solve(note.scene(case), shown, rtol=rtol)
    application, later = note.scene("section4"), _DECADES[1::2]
    decay = note.increments_after(note.scene("section3"), *later)
    progress("approach to the asymptote")
    predicted = note.limit("section4").cycles_to_stabilise["mean_rate_within_1e-6"]
    progress("closed solutions and bounds")
    (loose,) = static_bounds(application, [note.PRINTED.cycles])
    (tight,) = wear_bounds(application, [note.PRINTED.cycles])
    progress("hard scenes")
    return Runs(
        histories=histories,
        asymptotes={name: note.limit(name) for name in histories},
        approach=_approach(_DECADES),
        decay=dict(zip(later, decay.tolist(), strict=True)),
        printed_increment=float(note.increments_after(application, note.PRINTED.cycles)[0]),
        reconciliation=note.reconciliation(),
        threshold_excess=float(_approach([round(note.required(predicted))]).excess[0]),
        phase_distance=_phase_distance(histories["section4"]),
        static_distance=_static_distance(application),
        integrated={name: _integrated(histories[name]) for name in INTEGRATED},
        static_bounds=loose,
        wear_bounds=tight,
        hard=tuple(solve(name, [_HARD_CYCLES], rtol=HARD_RTOL) for name in hard_names()),
    )


def _approach(numbers: Sequence[int]) -> Approach:
    """Return the approach of section 4 at these numbers of cycles."""
    scene, end = note.scene("section4"), note.limit("section4")
    per_cycle, drift = note.required(end.wear_per_cycle_mm), note.required(end.log_coefficient_mm)
    history = solve(scene, numbers, rtol=note.RTOL)
    cycles = history.cycles.astype(float)
    increment = note.increments(scene, history.u_c)
    return Approach(
        cycles=cycles,
        wear=history.u_c,
        increment=increment,
        excess=increment / per_cycle - 1.0,
        pressure_excess=history.p / note.required(end.pressure_MPa) - 1.0,
        predicted=drift / (cycles * per_cycle),
    )


def _phase_distance(history: History) -> float:
    """Return the largest relative distance of the rate from its limit at the phases where
    U_a = h_0 - sigma_c0/f_c: there the rate has its limit for every wear."""
    scene, load = history.definition, history.definition.periodic_load
    level = scene.closure - scene.bearing.roughness_mm / scene.bearing.roughness_growth
    rising = float(np.arcsin(level / load.maximum) / (2.0 * np.pi))
    phases = np.sort(np.mod([rising, 0.5 - rising], 1.0))
    rate = bind(scene).rate(history.u_c[:, None], load(phases)) * load.period
    steady = note.required(note.limit("section4").wear_per_cycle_mm)
    return float(np.max(np.abs(rate / steady - 1.0)))


def static_wear(scene: Scene, cycles: Sequence[float], near: Sequence[float]) -> note.FloatArray:
    """Return the wear (mm) after numbers of cycles under a constant load, by the derived closed
    solution, whose roots are sought from wears `near` them in the digits that its factors need."""
    time, *names = stated("static-solution")
    numbers = scene.parameters() | {"U_a": scene.periodic_load.mean}
    numbers["V"] = reaction.sliding_distance(R=numbers["R"], T=1.0, n=numbers["n"])
    known = {symbols(name)[0]: sp.Rational(value) for name, value in numbers.items()}
    closed = time.rhs.subs([(name.lhs, name.rhs) for name in names]).subs(known)
    (u_c,) = symbols("u_c")
    passed = sp.lambdify(u_c, closed / sp.Rational(numbers["T"]), "mpmath")
    with mpmath.workdps(_STATIC_DIGITS):
        roots = [
            mpmath.findroot(lambda u, n=n: passed(u) / n - 1, (u, u * (1 + 1e-6)), tol=1e-40)
            for n, u in zip(cycles, map(mpmath.mpf, near), strict=True)
        ]
    return np.array(roots, dtype=float)


def _static_distance(scene: Scene) -> float:
    """Return the largest relative difference of closed solution and solver at a constant load."""
    still = replace(scene, load=Constant(0.0, scene.periodic_load.period))
    solved = solve(still, STATIC_CYCLES, rtol=note.RTOL).u_c
    closed = static_wear(still, STATIC_CYCLES, solved.tolist())
    return float(np.max(np.abs(closed / solved - 1.0)))


def _integrated(history: History) -> float:
    """Return the largest relative difference between two solvers over the first cycles."""
    scene, cycles = history.definition, [n for n in history.cycles if 0 < n <= INTEGRATED_CYCLES]
    direct = solve(scene, cycles, rtol=CUTOFF_RTOL, method="DOP853")
    counted = solve(scene, cycles, rtol=CUTOFF_RTOL, method="abel")
    return float(np.max(np.abs(direct.u_c / counted.u_c - 1.0)))
