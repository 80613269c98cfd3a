"""Sensitivities: derivatives of the wear after N cycles with respect to every number of the scene.

Overview
    The engine gives du/dp along the orbit (`wear.orbit.tangent`), with the derivatives of the wear
    rate that `derive` has generated. All derivatives of a scene cost about as much as its count.
Key results
    sensitivity    derivatives and elasticities of a scene
    gradients      wear and its derivatives, of many scenes at once
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from wear.binding import bind
from wear.cycles import groups
from wear.equation import WearEquation
from wear.faults import Faults, UsageError
from wear.load import Constant
from wear.load.spans import span
from wear.loss_of_contact.count import CountRequest, count_scenes
from wear.loss_of_contact.edge import edges_of_contact
from wear.loss_of_contact.period_map import margin_roundoff
from wear.loss_of_contact.switching import Edge
from wear.loss_of_contact.tangent import stage_tangents
from wear.numerics.gauss import BoolArray, FloatArray
from wear.numerics.rows import stacked, take
from wear.orbit.segments import orbit
from wear.orbit.tangent import Known, Tangents, tangents
from wear.parameters import (
    no_such_number,
    parameters_of,
    parametrised,
)
from wear.progress import Pace
from wear.request import (
    ONE_PERIOD,
    checked_request,
    checked_scenes,
    obstacle,
    whole_cycles,
)
from wear.scene import Scene, as_scene
from wear.states import notices_of_wear
from wear.words import are_texts

PERIOD = "load.period_s"
ONE_SIDED = (
    "before any wear contact just grazes: the derivatives are those from one side, "
    "on which the wear goes on"
)
SMALL = 0.01  # of the roughness: wear of a cycle that need not be divided


class Gradients(NamedTuple):
    """Sensitivities of scenes (s,) after cycles (n,): `wear` (s, n) in mm, its `derivative`
    (s, k, n) with respect to k numbers of the scene, in mm per unit of the key, and the estimated
    absolute `error` (s, k, n) of that; infinite where the wear could not be computed."""

    wear: FloatArray
    derivative: FloatArray
    error: FloatArray


def gradients(
    scenes: Sequence[Scene],
    keys: Sequence[str],
    cycles: FloatArray | Iterable[float] | float,
    rtol: float = 1e-10,
    progress: Callable[[str], None] = lambda _: None,
) -> Gradients:
    """Return the wear of scenes of one variant after whole numbers of cycles (n,), and its
    derivatives with respect to the numbers of the scene with these `keys`.

    After two seconds `progress` is called at intervals with a message.

    Raises
    ------
    UsageError
        for keys that a scene does not have or that its wear does not depend on.

    >>> from wear.scene import load_scene
    >>> keys = ["bearing.wear_coefficient"]
    >>> found = gradients([load_scene("section4")], keys, np.array([9000.0]))
    >>> f"{found.derivative[0, 0, 0]:.4f}"
    '1698.1082'
    """
    faults = Faults()
    cycles = np.array(whole_cycles(cycles, faults), dtype=float)
    if not are_texts(keys) or not keys:
        faults.append("keys: give a list of keys, such as ['bearing.hardness_MPa']")
    scenes = checked_scenes(scenes, rtol, faults, cycles.tolist())
    _check(scenes, keys)
    shape = (len(scenes), len(keys), len(cycles))
    result = Gradients(np.empty((shape[0], shape[2])), np.empty(shape), np.empty(shape))
    pace, done = Pace(progress), 0
    pace.begin("scene", len(scenes))
    for rows in groups(scenes):
        group, parts = _divided([scenes[i] for i in rows.tolist()])
        of_group, _ = _of_one_variant(group, keys, cycles * parts, rtol, pace.say)
        done += len(rows)
        pace.at(done)
        per_key = np.array([1.0 / parts if key == PERIOD else 1.0 for key in keys])[:, None]
        result.wear[rows] = of_group.u
        result.derivative[rows] = of_group.derivative * per_key
        result.error[rows] = of_group.derivative_error * per_key
    return result


def _divided(scenes: Sequence[Scene]) -> tuple[Sequence[Scene], float]:
    """Return the scenes, and the number of parts into which their period is divided: under constant
    loads, where a period only counts cycles, so that the wear of the first part is small."""
    if not all(isinstance(scene.load, Constant) for scene in scenes):
        return scenes, 1.0
    parts = 1.0
    for scene in scenes:
        load = scene.periodic_load
        first = float(bind(scene).rate(0.0, load.maximum)) * load.period
        parts = max(parts, 2.0 ** np.ceil(np.log2(first / (SMALL * scene.initial_roughness))))
    if parts == 1.0:
        return scenes, parts
    return [scene.with_({PERIOD: scene.periodic_load.period / parts}) for scene in scenes], parts


def _check(scenes: Sequence[Scene], keys: Sequence[str]) -> None:
    """Raise a `UsageError` that names every key that some scene does not have, or that is named
    twice."""
    known, faults = [parameters_of(scene) for scene in scenes], Faults()
    for key in dict.fromkeys(keys):
        if list(keys).count(key) > 1:
            faults.append(f"keys: {key} is named twice")
        without = next((numbers for numbers in known if key not in numbers), None)
        if without is not None:
            faults.append(no_such_number(key, without))
    faults.stop_if_any()


@np.errstate(all="ignore")  # trial states far off the solution; NaN is handled below
def _of_one_variant(
    scenes: Sequence[Scene],
    keys: Sequence[str],
    cycles: FloatArray,
    rtol: float,
    say: Callable[[str], None],
) -> tuple[Tangents, BoolArray]:
    """Return the derivatives of the wear of scenes of one variant, and whether contact grazes in
    each before any wear. A scene with blocks of loads comes alone, and reports each block to
    `say`."""
    number, last = len(scenes), float(np.max(cycles, initial=0.0))
    size, of_all = (number, len(cycles)), (number, len(keys), len(cycles))
    result = Tangents(*(np.full(shape, np.nan) for shape in (size, size, of_all, of_all, size)))
    (wear, wear_error), begin = np.zeros((2, number)), Known(*np.zeros((2, number, len(keys))))
    grazes, done = np.full(number, False), 0
    while True:
        acting = [span(scene.load, done) for scene in scenes]
        end = min(float(acting[0].until), last)
        say(f"cycle {done} of {last:.10g}")
        within = (cycles >= done) & (cycles <= end)
        requested = np.append(cycles[within], end) - done
        if scenes[0].contact.ends_at_3_sigma:
            single = [parametrised([s], [load], keys)
                      for s, load in zip(scenes, acting, strict=True)]  # fmt: skip
            edges = edges_of_contact([e.model for e in single], [e.loads[0] for e in single])
            if done == 0:
                grazes[:] = [_grazes(e, edge) for e, edge in zip(single, edges, strict=True)]
            starts = zip(single, edges, wear.tolist(), wear_error.tolist(), strict=True)
            orbits = count_scenes(
                [CountRequest(e.model, e.loads[0], edge, requested[-1], u, error)
                 for e, edge, u, error in starts], rtol
            )  # fmt: skip
            stage = stacked(
                [stage_tangents(*each, requested[None], rtol, take(begin, slice(i, i + 1)))
                 for i, each in enumerate(zip(orbits, single, edges, strict=True))]
            )  # fmt: skip
        else:
            equation, ends = parametrised(scenes, acting, keys), np.full(number, requested[-1])
            states = orbit(equation, ends, rtol, wear, wear_error, keep=True)
            stage = tangents(equation, states, np.tile(requested, (number, 1)), rtol, begin)
        for array, values in zip(result, stage, strict=True):
            array[..., within] = values[..., :-1]
        wear, relative, *derivatives, _ = (values[..., -1] for values in stage)
        wear_error, begin = relative * wear, Known(*derivatives)
        if end >= last or not np.isfinite(wear_error).all():
            break
        done = acting[0].until
    unknown = np.isnan(result.derivative_error)
    error = np.where(unknown, np.inf, result.derivative_error)
    return result._replace(derivative_error=error), grazes


def _grazes(equation: WearEquation, edge: Edge) -> bool:
    """Return whether contact grazes before any wear, as where the closure is 3 sigma."""
    model, none = equation.model, np.zeros_like(edge.grazing)
    uncertainty = margin_roundoff(model, equation.loads[0].maximum, none)
    return bool(np.any(np.abs(model.margin(none, edge.grazing)) <= uncertainty))


@dataclass(frozen=True, eq=False, repr=False)
class Sensitivities:
    """The sensitivities of the wear of a scene after `cycles` (n,) to its numbers.

    The `wear_mm` (n,) and its rate with the number of cycles there, `wear_per_cycle_mm` (n,); the
    `keys` (k,) of the numbers with their `values` (k,); the `derivative` (k, n) of the wear with
    respect to them, in mm per unit of the key, and its estimated absolute `error` (k, n), infinite
    where the wear could not be computed. `notices` list implausible magnitudes, and one-sided
    derivatives.
    """

    scene: Scene
    cycles: tuple[int, ...]
    wear_mm: FloatArray
    wear_per_cycle_mm: FloatArray
    keys: tuple[str, ...]
    values: FloatArray
    derivative: FloatArray
    error: FloatArray
    notices: tuple[str, ...] = ()

    @property
    def elasticity(self) -> FloatArray:
        """Return the relative change of the wear per relative change of each number, (k, n); NaN
        where the number or the wear is zero."""
        return self._relative(self.derivative)

    @property
    def elasticity_error(self) -> FloatArray:
        """Return the estimated absolute error (k, n) of the elasticity."""
        return np.abs(self._relative(self.error))

    @property
    def cycles_derivative(self) -> FloatArray:
        """Return the derivative (k, n) of the number of cycles to the wear reached after `cycles`:
        minus that of the wear, over the wear per cycle."""
        with np.errstate(all="ignore"):
            return -self.derivative / self.wear_per_cycle_mm

    def __repr__(self) -> str:
        width = max(len(key) for key in self.keys)
        lines = [
            "change of the wear in % for 1 % more of each number (elasticity)",
            f"{'cycles':{width}} {'':>12}" + "".join(f"{n:>14.6g}" for n in self.cycles),
            f"{'bearing wear, mm':{width}} {'':>12}" + "".join(f"{u:>14.6e}" for u in self.wear_mm),
        ]
        for key, value, row in zip(self.keys, self.values, self.elasticity, strict=True):
            shown = "".join(f"{'-':>14}" if np.isnan(e) else f"{e:>14.6f}" for e in row)
            lines.append(f"{key:{width}} {value:>12.6g}{shown}")
        worst = np.nanmax(self.elasticity_error, initial=0.0)
        return "\n".join([*lines, f"largest estimated error: {worst:.0e}"])

    def as_json(self) -> dict[str, Any]:
        """Return the document of `wear sensitivity --json`; `pandas.DataFrame` makes a table of its
        "parameters"."""
        rows = zip(
            self.keys, self.values.tolist(), self.derivative, self.elasticity,
            self.elasticity_error, self.cycles_derivative, strict=True,
        )  # fmt: skip
        names = ("key", "value", "derivative", "elasticity", "error_estimate", "cycles_derivative")
        return {
            "scene": self.scene.name,
            "cycles": list(self.cycles),
            "bearing_wear_mm": self.wear_mm,
            "wear_per_cycle_mm": self.wear_per_cycle_mm,
            "notices": list(self.notices),
            "parameters": [dict(zip(names, row, strict=True)) for row in rows],
        }

    def _relative(self, values: FloatArray) -> FloatArray:
        factor = np.where(self.values == 0.0, np.nan, self.values)[:, None]
        with np.errstate(all="ignore"):
            return np.asarray(values * factor / np.where(self.wear_mm > 0.0, self.wear_mm, np.nan))


def sensitivity(
    scene: Scene | str | os.PathLike[str],
    cycles: float | Iterable[float],
    rtol: float = 1e-10,
    progress: Callable[[str], None] = lambda _: None,
) -> Sensitivities:
    """Return the sensitivities of the wear after numbers of cycles to every number of the scene.

    Parameters
    ----------
    scene
        A scene, the name of a built-in one, or the path of a scene file.
    cycles
        Whole numbers from 0 to 1e12, in any order; or one such number.
    rtol
        Requested relative accuracy of the wear; the derivatives have an estimate of their own.
    progress
        Called with a message on the progress of a count that takes more than two seconds.

    Raises
    ------
    UsageError
        if the request is invalid, or the load is not periodic.

    >>> found = sensitivity("section4", [9000, 1e12])
    >>> growth = found.keys.index("bearing.roughness_growth")
    >>> [f"{value:.4f}" for value in found.elasticity[growth]]
    ['3.5276', '15.9946']
    """
    scene = as_scene(scene)
    if (against := obstacle(scene)) is not None:
        raise UsageError(f"cycles cannot be counted: {against}; {ONE_PERIOD}")
    wanted = checked_request(scene, cycles, rtol)
    numbers = parameters_of(scene)
    counted = np.array(wanted, dtype=float)
    found, grazes = _of_one_variant([scene], list(numbers), counted, rtol, Pace(progress).say)
    u, _, derivative, error, added = (part[0] for part in found)
    values = np.array(list(numbers.values()))
    known = np.flatnonzero(np.isfinite(u)).tolist()
    worn = notices_of_wear(scene, [wanted[i] for i in known], u[known])
    notices = (*worn, *([ONE_SIDED] if grazes[0] else []))
    return Sensitivities(
        scene, wanted, u, added, tuple(numbers), values, derivative, error, notices
    )
