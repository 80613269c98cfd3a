"""Sobol' indices: the share of every uncertain number of a scene in the variance of the wear."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager
from typing import TYPE_CHECKING

import numpy as np

from wear.faults import UsageError
from wear.numerics.gauss import FloatArray
from wear.studies.design import ROWS
from wear.studies.notices import notices_of_rows
from wear.studies.rows import RowStatus, Study, solve_rows
from wear.studies.run import check_executor, prepare
from wear.studies.vary import Distribution, Vary

if TYPE_CHECKING:
    import xarray

    from wear.scene import Scene

CONFIDENCE = 0.95
RESAMPLES = 200


def sobol_indices(
    scene: Scene | str | os.PathLike[str],
    vary: str | Sequence[str | Vary],
    cycles: float | Iterable[float],
    *,
    samples: int = 1024,
    seed: int = 0,
    rtol: float = 1e-7,
    executor: Executor | None = None,
) -> xarray.Dataset:
    """Return the Sobol' indices of the wear with 95 % confidence intervals.

    The first-order index of a key is the share of the variance of the wear that vanishes when the
    key is known; the total index is the share that remains when all others are known. The cost is
    `samples` times (number of keys + 2) scenes (A. Saltelli et al., Comput. Phys. Commun. 181,
    2010; `scipy.stats.sobol_indices`).

    Parameters
    ----------
    scene, cycles, seed, rtol, executor
        As for `study`.
    vary
        As for `study`, with a distribution for every key.
    samples
        Number of points of the design, a power of two.

    Returns
    -------
    xarray.Dataset
        `first_order` and `total_order` (key, cycle), each with `_low` and `_high`; the attribute
        `notices` lists implausible magnitudes in the scenes drawn.

    Raises
    ------
    UsageError
        for a wrong request, or where a scene drawn has no answer.
    """
    import xarray
    from scipy import stats

    check_executor(executor)
    request = prepare(scene, vary, cycles, "sobol", samples, seed, None, rtol)
    if samples < 2 or samples & (samples - 1):
        raise UsageError(f"samples: {samples} is not a power of two")
    keys = [each.key for each in request.design.vary]
    if len(keys) < 2:
        raise UsageError(f"vary: {keys[0]} alone has the whole variance; name two keys or more")
    drawn: list[tuple[dict[str, FloatArray], FloatArray]] = []

    def wear(points: FloatArray) -> FloatArray:
        columns = dict(zip(keys, points, strict=True))
        drawn.append((columns, _wear(request, columns, executor)))
        return drawn[-1][1].T

    laws = [each.frozen for each in request.design.vary if isinstance(each, Distribution)]
    indices = stats.sobol_indices(func=wear, n=samples, dists=laws, rng=np.random.default_rng(seed))
    with _global_random_numbers(seed):
        spread = indices.bootstrap(confidence_level=CONFIDENCE, n_resamples=RESAMPLES)
    arrays = {}
    for name in ("first_order", "total_order"):
        interval = getattr(spread, name).confidence_interval
        for end, values in (("", getattr(indices, name)), ("_low", interval.low),
                            ("_high", interval.high)):  # fmt: skip
            arrays[name + end] = (("key", "cycle"), np.atleast_2d(values).T)
    coordinates = {"key": keys, "cycle": list(request.cycles)}
    return xarray.Dataset(arrays, coordinates, {"notices": notices_of_rows(request, drawn)})


@contextmanager
def _global_random_numbers(seed: int) -> Iterator[None]:
    """Seed the random numbers that NumPy shares, and restore them: SciPy's bootstrap of Sobol'
    indices takes no others."""
    before = np.random.get_state()
    generator = np.random.MT19937(np.random.SeedSequence(seed))
    np.random.set_state(np.random.RandomState(generator).get_state())
    try:
        yield
    finally:
        np.random.set_state(before)


def _wear(request: Study, columns: dict[str, FloatArray], executor: Executor | None) -> FloatArray:
    """Return the wear (rows, cycles) of the rows of these columns, in chunks."""
    rows = len(next(iter(columns.values())))
    parts = [
        {key: column[at : at + ROWS] for key, column in columns.items()}
        for at in range(0, rows, ROWS)
    ]
    solved = (map if executor is None else executor.map)(solve_rows, [request] * len(parts), parts)
    wear = []
    for answers in solved:
        if np.any(answers.status != RowStatus.DONE):
            reason = next(filter(None, answers.reason))
            raise UsageError(f"a scene drawn has no answer: {reason}; narrow the distributions")
        wear.append(answers.bearing_wear_mm)
    return np.concatenate(wear)
