"""Designs: the rows of a study, and the values of the varied keys in every chunk of them.

A chunk is a box of the grid, or a run of samples. Its values follow from the design and its place
alone, so that no list of all rows is ever made: memory is bounded by the chunk.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from wear.faults import Faults
from wear.numerics.gauss import FloatArray
from wear.request import is_number
from wear.studies.vary import Distribution, Levels, Vary

Chunk = tuple[slice, ...]
DESIGNS = ("grid", "sobol", "latin-hypercube", "random")
ROWS = 2048  # of a chunk: seconds of work on one core, milliseconds of transfer
MOST_ROWS = 10**9
_ROUNDS = 4  # of the Feistel network; three already pass for random


@dataclass(frozen=True)
class Design:
    """The combinations of values that are solved: all of a grid, or `samples` of them.

    Attributes
    ----------
    kind
        One of `DESIGNS`.
    vary
        The varied keys: levels for a grid, distributions for samples.
    samples, seed
        Number of samples and seed; a grid has neither (0).
    """

    kind: str
    vary: tuple[Vary, ...]
    samples: int = 0
    seed: int = 0

    def __post_init__(self) -> None:
        Faults(_faults(self)).stop_if_any()

    @property
    def shape(self) -> tuple[int, ...]:
        """Return the number of rows along each dimension."""
        if self.kind == "grid":
            return tuple(len(_levels(vary)) for vary in self.vary)
        return (self.samples,)

    @property
    def dimensions(self) -> tuple[str, ...]:
        """Return the name of each dimension: the keys of a grid, or `sample`."""
        return tuple(vary.key for vary in self.vary) if self.kind == "grid" else ("sample",)

    @property
    def rows(self) -> int:
        """Return the number of rows."""
        return math.prod(self.shape)

    @property
    def chunk_shape(self) -> tuple[int, ...]:
        """Return the shape of a chunk: whole trailing dimensions within `ROWS`."""
        shape, room = [], ROWS
        for length in reversed(self.shape):
            shape.append(max(1, min(length, room)))
            room //= shape[-1]
        return tuple(reversed(shape))

    def chunks(self) -> Iterator[Chunk]:
        """Yield the place of every chunk, in order."""
        edges = [
            [slice(at, min(at + step, length)) for at in range(0, length, step)]
            for length, step in zip(self.shape, self.chunk_shape, strict=True)
        ]
        yield from itertools.product(*edges)

    def columns(self, chunk: Chunk) -> dict[str, FloatArray]:
        """Return the values of every key in the rows of a chunk (rows,), last dimension fastest."""
        if self.kind == "grid":
            axes = [
                np.array(_levels(vary)[part]) for vary, part in zip(self.vary, chunk, strict=True)
            ]
            grid = np.meshgrid(*axes, indexing="ij")
            return {v.key: axis.ravel() for v, axis in zip(self.vary, grid, strict=True)}
        points = self._points(chunk[0].start, chunk[0].stop)
        return {
            vary.key: vary.quantile(each) for vary, each in zip(self.vary, points.T, strict=True)
        }

    def random_rows(self, rows: int) -> dict[str, FloatArray]:
        """Return the values of every key in a few rows drawn at random from the study."""
        random = np.random.default_rng(self.seed)
        return {vary.key: vary.quantile(random.random(rows)) for vary in self.vary}

    def _points(self, start: int, stop: int) -> FloatArray:
        """Return samples start to stop of the unit cube (rows, keys)."""
        from scipy.stats import qmc

        rows, keys = stop - start, len(self.vary)
        if self.kind == "sobol":
            sequence = qmc.Sobol(keys, scramble=True, rng=np.random.default_rng(self.seed))
            if start:  # SciPy refuses to skip no points
                sequence.fast_forward(start)
            power = 1 << (rows - 1).bit_length()  # the sequence is balanced over powers of two
            return np.asarray(sequence.random(power)[:rows], dtype=float)
        random = np.random.default_rng(np.random.SeedSequence(self.seed, spawn_key=(start,)))
        points = random.random((rows, keys))
        if self.kind == "random":
            return points
        strata = [
            permuted(np.arange(start, stop), self.samples, (self.seed, key)) for key in range(keys)
        ]
        return np.asarray((np.column_stack(strata) + points) / self.samples, dtype=float)


def _levels(vary: Vary) -> tuple[float, ...]:
    return vary.values if isinstance(vary, Levels) else ()


def _faults(design: Design) -> Iterator[str]:
    """Yield every fault of a design."""
    if design.kind not in DESIGNS:
        yield f"design: {design.kind!r} is unknown; choose one of {', '.join(DESIGNS)}"
        return
    keys = [vary.key for vary in design.vary]
    if not keys:
        yield "vary: name at least one key"
    if len(set(keys)) < len(keys):
        yield "vary: a key is given twice"
    needed, form = (
        (Levels, "low:high:count or a,b,c")
        if design.kind == "grid"
        else (Distribution, "a distribution, such as uniform(low,high)")
    )
    for vary in design.vary:
        if not isinstance(vary, needed):
            yield f"vary: {vary.key}: a design {design.kind} takes {form}"
            return
    for name in ("samples", "seed"):
        given = getattr(design, name)
        if not is_number(given) or not isinstance(given, int | np.integer) or given < 0:
            yield f"{name}: {given!r} is not a whole number >= 0"
            return
    if design.kind != "grid" and design.samples < 1:
        yield f"samples: a design {design.kind} needs a number of samples"
    if design.kind == "grid" and design.samples:
        yield "samples: a grid has as many rows as its values make; drop samples"
    if design.rows > MOST_ROWS:
        yield f"vary: {design.rows:.3g} scenes are more than {MOST_ROWS:.0e}"


def permuted(index: NDArray[np.int64], size: int, key: tuple[int, ...]) -> NDArray[np.int64]:
    """Return the image of each index under a pseudo-random permutation of 0 ... size - 1.

    A Feistel network permutes the next square of a power of two; an image outside the range goes
    through it again (M. Luby, C. Rackoff, SIAM J. Comput. 17, 1988; J. Black, P. Rogaway, CT-RSA
    2002), so that no permutation is ever stored.

    >>> sorted(permuted(np.arange(10), 10, (1, 2)).tolist())
    [0, 1, 2, 3, 4, 5, 6, 7, 8, 9]
    """
    half = np.uint64(max(1, math.ceil(math.log2(max(size, 2)) / 2)))
    mask = (np.uint64(1) << half) - np.uint64(1)
    multipliers = np.random.SeedSequence(key).generate_state(2 * _ROUNDS, np.uint64) | np.uint64(1)

    def network(value: NDArray[np.uint64]) -> NDArray[np.uint64]:
        left, right = value >> half, value & mask
        for first, second in multipliers.reshape(_ROUNDS, 2):
            mixed = (right + first) * second
            mixed ^= mixed >> np.uint64(29)
            mixed *= np.uint64(0xBF58476D1CE4E5B9)
            left, right = right, left ^ ((mixed >> np.uint64(32)) & mask)
        return (left << half) | right

    result = network(np.asarray(index, dtype=np.uint64))
    while (outside := result >= size).any():
        result[outside] = network(result[outside])
    return result.astype(np.int64)
