"""The runs that the report needs, each made once.

Overview
    Everything here is a number: histories of the note's scenes in both readings, how
    the wear approaches its asymptote, the closed solution against the solver, bounds, arrest and
    hard scenes. The paper's modules only say what the numbers mean.
Key results
    Runs    all of them
    run     make them
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from wear.bounds import Enclosure, static_bounds, wear_bounds
from wear.equation import equation_of
from wear.history import History
from wear.load import Constant
from wear.model import bind
from wear.orbit.period_map import resolved, settings
from wear.regime import Asymptote, asymptote
from wear.report.reconcile import PRINTED, Reconciliation, reconciliations
from wear.scene import Scene, hard_names, load_scene
from wear.solver import solve
from wear.static import static_solution

FloatArray = NDArray[np.float64]
Some = TypeVar("Some")

#: The scenes of the note; those of Fig. 3b by rising wear coefficient.
SECTION_5 = ("section5-k1e-7", "section5", "section5-k1e-5", "section5-k1e-4")
SCENES = ("section3", "section4", *SECTION_5)
CUTOFF = ".cutoff"

#: Requested relative errors: of the analysis, with loss of contact, and of stress tests.
RTOL = 1e-12
CUTOFF_RTOL = 1e-9
HARD_RTOL = 1e-8

#: Cases in which every cycle is integrated too, and how many cycles.
INTEGRATED = ("section4", "section3" + CUTOFF)
INTEGRATED_CYCLES = 600

_DECADES = tuple(10**n for n in range(1, 12))
_STATIC_CYCLES = (1, 100, 10_000, 10**6, 10**8, 10**10)
_HARD_CYCLES = 100


class Case(NamedTuple):
    """A scene of the note, its states over the cycles of the figures, and its asymptote."""

    scene: Scene
    history: History
    asymptote: Asymptote


class Approach(NamedTuple):
    """How section 4 approaches its asymptote: arrays along ``cycles``.

    ``increment`` mm is the wear of the cycle that follows, ``excess`` and ``pressure_excess`` are
    relative to (21) and (22), ``predicted`` is A/(N u_cum).
    """

    cycles: FloatArray
    wear: FloatArray
    increment: FloatArray
    excess: FloatArray
    pressure_excess: FloatArray
    predicted: FloatArray


class Decay(NamedTuple):
    """Wear (mm) of the cycle that follows each number of cycles, of two worn solids."""

    cycles: FloatArray
    increment: FloatArray


class Static(NamedTuple):
    """The closed solution under a constant load against the solver."""

    cycles: FloatArray
    closed: FloatArray
    solved: FloatArray

    @property
    def distance(self) -> float:
        """Largest relative difference."""
        return float(np.max(np.abs(self.closed / self.solved - 1.0)))


class Phases(NamedTuple):
    """Phases at which the rate is at its limit in every cycle, and how near it is there."""

    phases: FloatArray
    distance: float


class HardCase(NamedTuple):
    """A scene that is hard to solve, and its state after some cycles."""

    name: str
    title: str
    history: History


@dataclass(frozen=True)
class Runs:
    """All runs of the report.

    ``cases`` has the note's scenes by name, those with loss of contact under ``name.cutoff``.
    ``printed_increment`` mm is the wear of the cycle that the note calls stabilised,
    ``threshold_excess`` the relative excess over (21) at the cycle that the drift foretells for
    the note's criterion. ``integrated`` has the largest relative difference of the wear between
    the cycle count and the integration of every cycle, by case.
    """

    cases: Mapping[str, Case]
    approach: Approach
    decay: Decay
    printed_increment: float
    reconciliation: Reconciliation
    threshold_excess: float
    offset: float
    phases: Phases
    static: Static
    integrated: Mapping[str, float]
    static_bounds: Enclosure
    wear_bounds: Enclosure
    hard: tuple[HardCase, ...]

    def history(self, name: str) -> History:
        """The history of one case."""
        return self.cases[name].history

    def asymptote(self, name: str) -> Asymptote:
        """Return the asymptote of one case."""
        return self.cases[name].asymptote


def run(progress: Callable[[str], None] = lambda _: None) -> Runs:
    """Make every run; ``progress`` is told what comes next."""
    cases = {}
    for name in SCENES:
        progress(name)
        cases[name] = _case(name, cutoff=False)
        cases[name + CUTOFF] = _case(name, cutoff=True)
    scene = cases["section4"].scene
    progress("approach to the asymptote")
    foretold = cases["section4"].asymptote.cycles_to_stabilise["mean_rate_within_1e-6"]
    progress("closed solutions and bounds")
    (loose,) = static_bounds(scene, [PRINTED.cycles])
    (tight,) = wear_bounds(scene, [PRINTED.cycles])
    progress("hard scenes")
    return Runs(
        cases=MappingProxyType(cases),
        approach=_approach(scene, _DECADES),
        decay=_decay(cases["section3"].scene),
        printed_increment=_increment(scene, PRINTED.cycles),
        reconciliation=reconciliations()[0],
        threshold_excess=float(_approach(scene, [round(required(foretold))]).excess[0]),
        offset=required(cases["section4"].asymptote.offset_mm),
        phases=_steady_phases(cases["section4"]),
        static=_static(scene),
        integrated={name: _integrated(cases[name]) for name in INTEGRATED},
        static_bounds=loose,
        wear_bounds=tight,
        hard=tuple(_hard()),
    )


def required(value: Some | None) -> Some:
    """A constant that the regime of the scene has.

    Raises
    ------
    ValueError
        if it has not: the report would speak of another regime than it found.
    """
    if value is None:
        raise ValueError("the report speaks of a constant that this regime does not have")
    return value


def figure_cycles() -> tuple[int, ...]:
    """Numbers of cycles up to the note's last, dense where the wear changes quickly."""
    last = PRINTED.cycles
    chosen = np.concatenate([[0], np.geomspace(1, last, 80), np.linspace(0, last, 91)])
    return tuple(sorted({int(cycle) for cycle in np.rint(chosen)}))


def _case(name: str, *, cutoff: bool) -> Case:
    scene = load_scene(name, ["contact.ends_at_3_sigma=true"] if cutoff else [])
    history = solve(scene, figure_cycles(), rtol=CUTOFF_RTOL if cutoff else RTOL)
    return Case(scene, history, asymptote(scene))


def _approach(scene: Scene, decades: tuple[int, ...] | list[int]) -> Approach:
    fate = asymptote(scene)
    per_cycle, drift = required(fate.wear_per_cycle_mm), required(fate.log_coefficient_mm)
    history = solve(scene, decades, rtol=RTOL)
    cycles = history.cycles.astype(float)
    increment = increments(scene, history.u_c)
    return Approach(
        cycles=cycles,
        wear=history.u_c,
        increment=increment,
        excess=increment / per_cycle - 1.0,
        pressure_excess=history.p / required(fate.pressure_MPa) - 1.0,
        predicted=drift / (cycles * per_cycle),
    )


def _decay(scene: Scene) -> Decay:
    cycles = _DECADES[1::2]
    wear = solve(scene, cycles, rtol=RTOL).u_c
    return Decay(np.array(cycles, dtype=float), increments(scene, wear))


def increments(scene: Scene, wear: FloatArray) -> FloatArray:
    """Wear (mm) that one more cycle adds to each wear (mm): integrated, not subtracted."""
    equation, size = equation_of([scene]), settings(RTOL)
    ((_, maps),) = resolved(equation, equation.breakpoints, wear[None], size)
    return np.asarray(maps.finer(size).advance(wear[None]).increment[0])


def _increment(scene: Scene, cycle: int) -> float:
    return float(increments(scene, solve(scene, [cycle], rtol=RTOL).u_c)[0])


def _steady_phases(case: Case) -> Phases:
    """Where U_a = h_0 - sigma_c0/f_c the rate is at its limit, whatever the wear."""
    scene, load = case.scene, case.scene.periodic_load
    level = scene.closure - scene.bearing.roughness_mm / scene.bearing.roughness_growth
    rising = float(np.arcsin(level / load.maximum) / (2.0 * np.pi))
    phases = np.sort(np.mod([rising, 0.5 - rising], 1.0))
    rate = bind(scene).rate(case.history.u_c[:, None], load(phases)) * load.period
    distance = np.max(np.abs(rate / required(case.asymptote.wear_per_cycle_mm) - 1.0))
    return Phases(phases, float(distance))


def _static(scene: Scene) -> Static:
    still = replace(scene, load=Constant(0.0, scene.periodic_load.period))
    cycles = np.array(_STATIC_CYCLES, dtype=float)
    closed = static_solution(still).wear(cycles)
    return Static(cycles, closed, solve(still, _STATIC_CYCLES, rtol=RTOL).u_c)


def _integrated(case: Case) -> float:
    """Largest relative difference between two solvers over the first cycles."""
    cycles = [int(n) for n in case.history.cycles if 0 < n <= INTEGRATED_CYCLES]
    direct = solve(case.scene, cycles, rtol=CUTOFF_RTOL, method="DOP853")
    counted = solve(case.scene, cycles, rtol=CUTOFF_RTOL, method="abel")
    return float(np.max(np.abs(direct.u_c / counted.u_c - 1.0)))


def _hard() -> list[HardCase]:
    found = []
    for name in hard_names():
        scene = load_scene(name)
        found.append(HardCase(name, scene.title, solve(scene, [_HARD_CYCLES], rtol=HARD_RTOL)))
    return found
