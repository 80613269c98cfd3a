"""The states inside cycles: the wear and the fields at any phases of any cycles."""

import os
from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from wear.binding import bind
from wear.cycles import Stage, stages
from wear.equation import WearEquation, breakpoints
from wear.faults import AccuracyError, Faults
from wear.load import HistoryLoad, Loading
from wear.load.spans import most_cycles, span
from wear.loss_of_contact.dense_output import SwitchedDenseOutput, switched_dense_output
from wear.model import Model
from wear.numerics.floating_point import TINY
from wear.numerics.gauss import FloatArray
from wear.numerics.initial_value import SAFETY
from wear.orbit.dense_output import DenseOutput, dense_output
from wear.orbit.iterates import Iterates
from wear.orbit.segments import single_cycle
from wear.quantities import columns_of
from wear.records import follow
from wear.request import check_rtol, is_number, whole_cycles
from wear.scene import Scene, as_scene
from wear.scene_orbit import SceneOrbit
from wear.states import fields_under_load, in_shape

CHUNK = 32_000  # states computed at once: their arrays stay in the processor's cache


class Chunk(NamedTuple):
    """A chunk of a history: whole `cycles` (n,), `phases` (m,) in [0, 1], bearing wear `u` (n, m)
    in mm at (cycles + phases) T, all `fields` (n, m), in mm and MPa, and the estimated `error`
    (n,) of u, relative to the wear at the end of the cycle."""

    cycles: FloatArray
    phases: FloatArray
    u: FloatArray
    fields: Any
    error: FloatArray

    def columns(self) -> dict[str, FloatArray]:
        """Return the quantities by their names in files, (n, m), the error (n,)."""
        columns = {"bearing_wear_mm": self.u} | columns_of(self.fields)
        columns["pressure_MPa"] = columns.pop("pressure_at_start_MPa")
        return columns | {"error_estimate": self.error}


def fields_inside(
    scene: Scene | str | os.PathLike[str],
    cycles: float | Iterable[float],
    phases: ArrayLike,
    rtol: float = 1e-12,
    chunk: int = CHUNK,
) -> Iterator[Chunk]:
    """Yield the state at every phase of every cycle, about `chunk` states at a time.

    Parameters
    ----------
    scene
        The scene, or the name of a built-in one or of a file; with any load.
    cycles
        Completed whole numbers of cycles (n,), each less than the load has.
    phases
        Phases in [0, 1], (m,), of the cycle that begins then.

    Yields
    ------
    Chunk
        rows of the history, in ascending numbers of cycles; memory is bounded by the chunk.

    Raises
    ------
    UsageError
        with all faults of the request, before the first chunk.
    AccuracyError
        if the wear at the start of a block, or of a cycle of a history, could not be computed.
    """
    scene, faults = as_scene(scene), Faults()
    wanted = np.array(sorted(whole_cycles(cycles, faults)), dtype=float)
    if (most := most_cycles(scene.load)) <= max(wanted, default=0.0):
        faults.append(f"cycles: the load has {most}; the last one begins after {most - 1}")
    try:
        at = np.atleast_1d(np.asarray(phases, dtype=float))
    except (TypeError, ValueError):
        at = np.empty(0)
    if at.ndim != 1 or not at.size or not np.all((at >= 0.0) & (at <= 1.0)):
        faults.append("phases: give numbers from 0 to 1")
    check_rtol(rtol, faults)
    if not (is_number(chunk) and 1 <= chunk < np.inf and chunk == int(chunk)):
        faults.append(f"chunk: {chunk!r} is not a whole number of states, at least 1")
    faults.stop_if_any()
    return _chunks(bind(scene), scene.load, wanted, at, rtol, int(chunk))


def _chunks(
    model: Model, load: Loading, cycles: FloatArray, phases: FloatArray, rtol: float, chunk: int
) -> Iterator[Chunk]:
    """Yield the state at every phase of the `cycles`, which ascend."""
    ends = 0.0
    for stage in stages_with(model, load, cycles, rtol):
        yield from fields_of_stage(model, stage, cycles, phases, rtol, chunk)
        ends = stage.ends
    if ends <= cycles[-1]:
        raise AccuracyError(f"the wear after {ends:.0f} cycles could not be found")


def stages_with(model: Model, load: Loading, cycles: FloatArray, rtol: float) -> Iterator[Stage]:
    """Yield the stages of a load up to the last of the `cycles` (n,), which ascend; of a measured
    history, each of its cycles is one, and only these are yielded."""
    if not isinstance(load, HistoryLoad):
        yield from stages(model, load, cycles[-1] + 1.0, rtol)
        return
    reached = follow(model, load, np.union1d(cycles, cycles + 1).astype(int).tolist(), rtol)
    place = {cycle: at for at, cycle in enumerate(reached.cycles)}
    for cycle in cycles.astype(int).tolist():
        if cycle + 1 not in place:
            return
        acting, ends = span(load, cycle).load, [place[cycle], place[cycle + 1]]
        wear, error = reached.u[ends], reached.u[ends] * reached.error[ends]
        alone = single_cycle(wear, error, breakpoints(acting))
        yield Stage(acting, cycle, cycle + 1.0, SceneOrbit(alone, None), 0.0)


def fields_of_stage(
    model: Model,
    stage: Stage,
    cycles: FloatArray,
    phases: FloatArray,
    rtol: float,
    chunk: int = CHUNK,
) -> Iterator[Chunk]:
    """Yield the state at every phase (m,) of those of the `cycles` (n,) that are in a stage, about
    `chunk` states at a time."""
    rows = max(1, chunk // max(1, len(phases)))
    for begin, end, output in _dense(model, stage, phases, rtol, cycles):
        covered = cycles[(cycles >= begin) & (cycles < end)]
        for at in range(0, len(covered), rows):
            yield _chunk(model, stage, begin, output, covered[at : at + rows], phases, rtol)


def _dense(
    model: Model, stage: Stage, phases: FloatArray, rtol: float, cycles: FloatArray
) -> Iterator[tuple[float, float, DenseOutput | SwitchedDenseOutput]]:
    """Yield the parts of a stage that contain some of the `cycles`: the first cycle, the one after
    the last, and the dense output at the phases of each part."""
    if model.ends_at_3_sigma:
        if np.any((cycles >= stage.begins) & (cycles < stage.ends)):
            output = switched_dense_output(model, stage.load, phases, rtol)
            yield stage.begins, stage.ends, output
        return
    equation, segments = WearEquation(model, (stage.load,)), stage.solution.orbit.segments
    begins = [stage.begins + float(segment.begins[0]) for segment in segments]
    observable = model.pressure if model.compliant else None
    for begin, end, segment in zip(begins, [*begins[1:], stage.ends], segments, strict=True):
        if np.any((cycles >= begin) & (cycles < end)):
            assert isinstance(segment.iterates, Iterates)
            yield begin, end, dense_output(equation, segment.iterates, phases, rtol, observable)


def _chunk(
    model: Model,
    stage: Stage,
    begin: float,
    output: DenseOutput | SwitchedDenseOutput,
    cycles: FloatArray,
    phases: FloatArray,
    rtol: float,
) -> Chunk:
    """Return the states in some cycles of a stage, from the dense output at the `phases` of the
    part that begins after `begin` cycles."""
    ends, place = np.unique([cycles, cycles + 1.0], return_inverse=True)
    wear, wear_error = (each[place.reshape(2, -1)] for each in stage.after(ends))
    added = output.added(cycles - begin, wear[0])
    u = wear[0][:, None] + added.increment
    # Where the wear rate rises or contact grazes, an error grows within the cycle.
    absolute = np.max(wear_error, axis=0) + SAFETY * added.error
    error = np.nan_to_num(absolute / (wear[1] + TINY), nan=np.inf)
    load = stage.load
    if added.observable is not None and np.max(added.observable_error) <= rtol:
        fields = in_shape(model.fields_under(added.observable, u, load(phases)), u.shape)
    else:
        fields = fields_under_load(model, u, load(phases), load.slope(phases) / load.period)
    return Chunk(cycles, phases, u, fields, error)
