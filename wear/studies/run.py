"""`study`: the chunks of a study through any executor, results on disk as they come."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    CancelledError,
    Executor,
    Future,
    wait,
)
from itertools import islice
from pathlib import Path
from traceback import walk_tb
from typing import TYPE_CHECKING

from wear.faults import Faults, UsageError, WorkersLost
from wear.progress import Pace
from wear.studies.design import Chunk, Design
from wear.studies.rows import Answers, Study, solve_chunk
from wear.studies.vary import Distribution, Levels, Vary, parse
from wear.words import is_path

if TYPE_CHECKING:
    import xarray

    from wear.scene import Scene
    from wear.studies.store import Store

# Exceptions of executors whose workers, or the connection to them, are lost; a closed client of
# Dask raises a RuntimeError, and Dask has exceptions of its own.
WORKER_FAULTS = (BrokenExecutor, CancelledError, asyncio.CancelledError, OSError, RuntimeError)
DASK = "distributed"
IN_FLIGHT = 64  # chunks submitted at once: enough for a cluster, few enough for memory


def study(
    scene: Scene | str | os.PathLike[str],
    vary: str | Sequence[str | Vary],
    cycles: float | Iterable[float],
    output: str | os.PathLike[str],
    *,
    design: str = "grid",
    samples: int = 0,
    seed: int = 0,
    until_wear: float | None = None,
    rtol: float = 1e-7,
    executor: Executor | None = None,
    progress: Callable[[str], None] = lambda _: None,
) -> xarray.Dataset:
    """Solve a scene for many combinations of its numbers; go on where an earlier call stopped.

    Parameters
    ----------
    scene
        The scene that is varied, or its name or path.
    vary
        Varied keys: for a grid `KEY=low:high:count[:log]` or `KEY=a,b,c`; for samples
        `KEY=uniform(low,high)`, `loguniform(low,high)`, `normal(mean,sd)` or
        `lognormal(median,factor)`. Or `Levels` and `Distribution`.
    cycles
        Whole numbers of cycles after which the wear is wanted, or one.
    output
        Zarr folder of the results.
    design, samples, seed
        "grid", or "sobol", "latin-hypercube", "random" with their number of samples and seed.
    until_wear
        Wear depth (mm) to which the cycles are counted as well.
    rtol
        Requested relative error of the wear.
    executor
        Anything with the interface of `concurrent.futures.Executor`: a process pool, Dask's
        `client.get_executor()`, mpi4py's. None solves the chunks here, one after the other.
    progress
        Called with a message on the progress of a study that takes more than two seconds.

    Returns
    -------
    xarray.Dataset
        `bearing_wear_mm`, `error_estimate`, `cycles_to_wear` and `cycles_to_wear_error` (if a
        depth is given), `status` and `reason`, with a dimension for each key of a grid or one of
        samples, and one of cycles. The attribute `notices` lists implausible magnitudes, with the
        number of rows and the worst of them.

    Raises
    ------
    UsageError
        with all faults of the request at once.
    WorkersLost
        if the executor lost its workers; the same call resumes the study.
    """
    request = prepare(scene, vary, cycles, design, samples, seed, until_wear, rtol)
    return run(request, output, executor, progress).dataset()


def run(
    request: Study,
    output: str | os.PathLike[str],
    executor: Executor | None,
    progress: Callable[[str], None],
) -> Store:
    """Solve the chunks that are missing at `output` and return the store of all, see `study`."""
    from wear.studies.store import Store

    if not is_path(output):
        raise UsageError(f"output: {output!r} is not the name of a folder")
    check_executor(executor)
    store = Store(Path(output), request)
    pace, done = Pace(progress), 0
    pace.begin("scene", store.counts()["pending"])
    for chunk, answers in _answers(request, store.missing(), executor):
        store.write(chunk, answers)
        done += len(answers.status)
        pace.at(done)
    store.write_notices()
    return store


def prepare(
    scene: Scene | str | os.PathLike[str],
    vary: str | Sequence[str | Vary],
    cycles: float | Iterable[float],
    design: str,
    samples: int,
    seed: int,
    until_wear: float | None,
    rtol: float,
) -> Study:
    """Return the checked request, or raise a `UsageError` with all its faults."""
    from wear.load import HistoryLoad
    from wear.parameters import no_such_number, parameters_of
    from wear.request import ONE_PERIOD, check_end, check_rtol, is_number, whole_cycles
    from wear.scene import as_scene

    base = as_scene(scene)
    faults = Faults()
    parsed: list[Vary] = []
    for entry in [vary] if isinstance(vary, str) or not isinstance(vary, Sequence) else vary:
        try:
            parsed.append(entry if isinstance(entry, Levels | Distribution) else parse(entry))
            if "." not in str(parsed[-1].key):
                raise UsageError(no_such_number(parsed[-1].key, parameters_of(base)))
            _require_entry(base, parsed[-1])
        except ValueError as fault:
            faults.append(str(fault))
    if isinstance(base.load, HistoryLoad):
        faults.append(f"{base.name}: a study takes no load of kind history: {ONE_PERIOD}")
    plan = None
    try:
        plan = Design(design, tuple(parsed), samples, seed)
    except UsageError as fault:
        faults += [] if faults and not parsed else [str(fault)]
    wanted = whole_cycles(cycles, faults, least=1)
    if not any(str(each.key).startswith("load.") for each in parsed):
        check_end([base], wanted, faults)
    if len(set(wanted)) < len(wanted):
        faults.append("cycles: a number is given twice")
    if until_wear is not None and not (is_number(until_wear) and 0.0 < until_wear < 1e30):
        faults.append(f"until_wear: {until_wear!r} is not a positive number of mm")
    check_rtol(rtol, faults, least=1e-13)
    faults.stop_if_any()
    assert plan is not None
    return Study(base, plan, wanted, until_wear, rtol)


def _require_entry(base: Scene, vary: Vary) -> None:
    """Raise the first fault if the scene can take none of the values; else rows are invalid."""
    faults: list[ValueError] = []
    for value in vary.examples:
        try:
            base.with_({vary.key: value})
        except ValueError as fault:
            faults.append(fault)
        else:
            return
    raise faults[0]


def check_executor(executor: object) -> None:
    """Raise a `UsageError` unless this is an executor; a client of Dask has one."""
    if hasattr(executor, "get_executor"):
        raise UsageError("executor: this is a client; give client.get_executor()")
    if executor is not None and not hasattr(executor, "submit"):
        raise UsageError(f"executor: {executor!r} has no method submit; give an Executor")


def _answers(
    request: Study, chunks: Iterator[Chunk], executor: Executor | None
) -> Iterator[tuple[Chunk, Answers]]:
    """Yield every chunk with its answers, as they come."""
    if executor is None:
        for chunk in chunks:
            yield chunk, solve_chunk(request, chunk)
        return
    running: dict[Future[Answers], Chunk] = {}
    try:
        while True:
            for chunk in islice(chunks, IN_FLIGHT - len(running)):
                running[executor.submit(solve_chunk, request, chunk)] = chunk
            if not running:
                return
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                answers = future.result()
                if answers is None:  # from Dask, if a worker was lost together with its result
                    raise CancelledError
                yield running.pop(future), answers
    except (Exception, asyncio.CancelledError) as fault:
        if not (isinstance(fault, WORKER_FAULTS) or _of_dask(fault)):
            raise
        raise WorkersLost(
            f"the workers were lost ({type(fault).__name__} {fault}); finished chunks are kept: "
            "the same command goes on where this one stopped"
        ) from fault
    finally:
        for future in running:
            future.cancel()


def _of_dask(fault: BaseException) -> bool:
    """Return whether a fault is Dask's own, by its class or by the function that raised it: if the
    scheduler is lost at the wrong moment, Dask unpacks an answer as if it were a fault."""
    frames = [frame for frame, _ in walk_tb(fault.__traceback__)]
    raised_in = frames[-1].f_globals.get("__name__", "") if frames else ""
    return any(name.startswith(DASK) for name in (type(fault).__module__, raised_in))
