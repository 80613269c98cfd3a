"""Meshes of phase for many scenes: those whose meshes have as many intervals go together."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from wear.count.cycle import Settings
from wear.count.many import Many
from wear.numerics.collocation import (
    CycleSolution,
)
from wear.numerics.gauss import (
    BoolArray,
    FloatArray,
    IntArray,
)

MOST_INTERVALS = 48  # of phase: what needs more is solved by itself
NUMBERS = (1, 2, 3, 6, 12, 24, MOST_INTERVALS)  # of intervals


class Meshed(NamedTuple):
    """Scenes (their numbers) with edges of their meshes (scenes, q + 1) and what their first cycles
    did on them, if any were asked for."""

    which: IntArray
    edges: FloatArray
    first: CycleSolution | None


def plain(many: Many) -> Iterator[tuple[IntArray, FloatArray]]:
    """The scenes, together those with as many intervals, and the edges that their loads ask for."""
    sizes = np.array([len(edges) for edges in many.plain_edges])
    for size in np.unique(sizes):
        which = np.flatnonzero(sizes == size)
        yield which, np.stack([many.plain_edges[i] for i in which.tolist()])


def resolved(
    many: Many, wear: FloatArray, first: int, size: Settings, iterated: float
) -> Iterator[Meshed]:
    """Meshes on which the nodes resolve the rate at the frozen `wear` (scenes, k), mm, and in the
    `first` cycles, whose iteration ends at the relative error `iterated`; none for a scene that
    needs more than MOST_INTERVALS."""
    todo: dict[int, list[tuple[IntArray, FloatArray]]] = {}
    for which, edges in plain(many):
        todo[edges.shape[1] - 1] = [(which, edges)]
    while todo:
        number = min(todo)  # cutting only adds intervals: no scene comes back to this number
        which, edges = (np.concatenate(arrays) for arrays in zip(*todo.pop(number), strict=True))
        cycle = many.take(which).on(edges, size.phase_nodes, iterated)
        rough = cycle.rough_frozen(wear[which], size.phase_tolerance)
        calm, run = np.flatnonzero(~rough.any(axis=1)), None
        if first and len(calm):
            run = cycle.take(calm).several(first)
            rough[calm] = cycle.take(calm).rough(run, size)
            run = run.take(np.flatnonzero(~rough[calm].any(axis=1)))
        cuts = np.sum(rough, axis=1)
        if np.any(cuts == 0):
            yield Meshed(which[cuts == 0], edges[cuts == 0], run)
        for more in np.unique(cuts[cuts > 0]).tolist():
            wanted = [n for n in NUMBERS if n >= number + more]
            if wanted:
                finer = _cut_longest(_cut(edges[cuts == more], rough[cuts == more]), wanted[0])
                todo.setdefault(wanted[0], []).append((which[cuts == more], finer))


def _cut(edges: FloatArray, rough: BoolArray) -> FloatArray:
    """The edges (scenes, q + 1) with the intervals `rough` (scenes, q) cut in two, as many of each
    scene."""
    middles = np.where(rough, (edges[:, 1:] + edges[:, :-1]) / 2, np.inf)
    finer = np.sort(np.concatenate([edges, middles], axis=1), axis=1)
    return finer[:, : edges.shape[1] + int(np.sum(rough[0]))]


def _cut_longest(edges: FloatArray, number: int) -> FloatArray:
    """The edges with the longest intervals cut in two until there are so many: scenes of few
    different numbers of intervals go together."""
    while edges.shape[1] - 1 < number:
        lengths = np.diff(edges, axis=1)
        longest = np.arange(lengths.shape[1]) == np.argmax(lengths, axis=1)[:, None]
        edges = _cut(edges, longest)
    return edges
