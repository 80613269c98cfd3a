"""Straight lines of the displacement, a thousand and more of them integrated at once.

On each line the rate is smooth, so that few Gauss-Legendre nodes do, and where the lines change the
pressure moderately the iteration of a cycle (`wear.count.iteration`) takes all of them in its
stride. A rule with more nodes judges every line, and says which to cut in two.
"""

from typing import NamedTuple

import numpy as np

from wear.count.cycle import pace
from wear.count.panels import SAFETY
from wear.count.rounding import roundoff_of
from wear.faults import AccuracyError
from wear.model import Model
from wear.numerics.collocation import (
    NOISE,
    CycleSolution,
    endpoint_defect,
    iterate,
)
from wear.numerics.gauss import (
    BoolArray,
    FloatArray,
    Mesh,
    gauss,
)

NODES, FINER_NODES = 8, 12  # on each line: for the result, and for its judge
MOST_LINES = 1024  # at once: the arrays of more fall out of the processor's cache
MOST_CUT = 4 * MOST_LINES  # lines and parts of lines at once
MOST_ROUNDS = 12  # of cutting
FEW_ITERATIONS = 6  # so many, and twice as many lines would be no harder


class Lines(NamedTuple):
    """Straight lines, one after the other: their `lengths` (q,) in s, the displacement `levels`
    (q + 1,) at their ends in mm, and at which of these the wear is asked for, `marked` (q + 1,)."""

    lengths: FloatArray
    levels: FloatArray
    marked: BoolArray

    def parted(self, count: int) -> "tuple[Lines, Lines]":
        """The first of them, and the rest."""
        return (
            Lines(self.lengths[:count], self.levels[: count + 1], self.marked[: count + 1]),
            Lines(self.lengths[count:], self.levels[count:], self.marked[count:]),
        )

    def cut(self, rough: BoolArray) -> "Lines":
        """The same, with those that are `rough` (q,) cut in two."""
        middles = (self.levels[:-1] + self.levels[1:])[rough] / 2
        after = np.flatnonzero(rough) + 1
        return Lines(
            np.repeat(np.where(rough, self.lengths / 2, self.lengths), 1 + rough),
            np.insert(self.levels, after, middles),
            np.insert(self.marked, after, False),
        )


class Stretch(NamedTuple):
    """A model along lines, as `wear.count.iteration` takes it."""

    model: Model
    over: Mesh  # in s
    displacement: FloatArray  # (q, m), mm
    tolerance: float

    def rate_per_interval(self, u: FloatArray, near: FloatArray | None = None) -> FloatArray:
        """Wear rate in mm per line at wear `u` (..., q, m), sought from a pace `near` by."""
        return pace(self.model, u, self.displacement, 1.0, self.over, near)


class Along(NamedTuple):
    """Lines that were integrated, with what there is at the end of each (q,): the `wear` (mm)
    added, its estimated `error` (mm), the factor `growth` by which a small difference in wear has
    changed, whether it is `marked`; and whether twice as many lines would be no harder."""

    wear: FloatArray
    error: FloatArray
    growth: FloatArray
    marked: BoolArray
    easy: bool


class Attempt(NamedTuple):
    """The right-hand sides evaluated, and what came of it: None if the iteration failed."""

    evaluations: int
    along: Along | None


def integrated(model: Model, lines: Lines, start: float, tolerance: float, limit: float) -> Attempt:
    """Integrate all the lines at once from the wear `start` (mm), cutting those that are not
    resolved."""
    blur = float(roundoff_of(model, np.max(lines.levels, keepdims=True), np.array([start]))[0])
    evaluations = 0
    for _ in range(MOST_ROUNDS):
        try:
            twice = _solved(model, lines, start, max(NOISE, blur))
        except AccuracyError:  # a trial state so far off that it has no pressure
            break
        evaluations += twice.evaluations
        if not (twice.converged and start + twice.wear[-1] < limit):
            break
        rough = _rough(twice, tolerance, 4 * blur)
        if not rough.any():
            return Attempt(evaluations + twice.run.rate.size, _judged(twice, blur))
        lines = lines.cut(rough)
        if len(lines.lengths) > MOST_CUT:
            break
    return Attempt(evaluations, None)


class Twice(NamedTuple):
    """Lines from a wear `start` (mm), integrated with the coarse rule, and with the fine one that
    judges it; the wear (mm) added by each line (q,) according to both, and what neither may see of
    it."""

    model: Model
    lines: Lines
    start: float
    coarse: Stretch
    run: CycleSolution
    fine: Stretch
    judge: CycleSolution
    own: FloatArray
    judged: FloatArray
    concealed: FloatArray

    @property
    def wear(self) -> FloatArray:
        """Wear (q,) in mm added up to the end of each line."""
        return np.cumsum(self.own)

    @property
    def converged(self) -> bool:
        return bool(self.run.converged.all() and self.judge.converged.all())

    @property
    def evaluations(self) -> int:
        return self.run.evaluations + self.judge.evaluations + len(self.lines.levels)


def _solved(model: Model, lines: Lines, start: float, tolerance: float) -> Twice:
    at = np.array([start])
    coarse, fine = (_stretch(model, lines, m, tolerance) for m in (NODES, FINER_NODES))
    run = iterate(coarse, at)
    judge = iterate(fine, at, run.guess(FINER_NODES))
    own, judged = _on_each(run.rate[0], coarse.over), _on_each(judge.rate[0], fine.over)
    ends = model.rate(start + np.append(0.0, np.cumsum(judged)), lines.levels)[None]
    missed = endpoint_defect(judge.rate, ends[:, :-1], ends[:, 1:], fine.over)[0]
    return Twice(model, lines, start, coarse, run, fine, judge, own, judged, missed)


def _rough(twice: Twice, tolerance: float, blur: float) -> BoolArray:
    """Which lines (q,) are not resolved: where the rules differ by more than a share of the
    `tolerance` and than `blur`, relative to what the line adds, or both may miss as much."""
    permitted = tolerance * np.sum(twice.own) / len(twice.own)
    apart = np.abs(twice.judged - twice.own)
    rough: BoolArray = apart > np.maximum(permitted, blur * twice.own)
    return rough | (twice.concealed > permitted)


def _judged(twice: Twice, blur: float) -> Along:
    """What lines that are resolved did, with its error: by the rules, by what the iterations have
    left, and by rounding, which changes the rate by `blur`, relatively."""
    run, wear = twice.run, twice.wear
    slope = twice.model.slope(twice.start + run.inside[0], twice.coarse.displacement)
    growth = np.cumsum(_on_each(slope, twice.coarse.over))  # its logarithm
    most = growth - np.minimum(np.minimum.accumulate(growth), 0.0)  # since any line
    missed = SAFETY * np.abs(np.cumsum(twice.judged) - wear) + np.cumsum(twice.concealed)
    left = float(run.iteration_error[0] + twice.judge.iteration_error[0]) * wear[-1]
    error = missed + (left + blur * wear) * np.exp(most)
    quick = run.evaluations <= FEW_ITERATIONS * run.rate.size
    easy = quick and 3 * len(wear) <= MOST_CUT  # some of them may be cut once more
    return Along(wear, error, np.exp(growth), twice.lines.marked[1:], easy)


def _stretch(model: Model, lines: Lines, m: int, tolerance: float) -> Stretch:
    """The model along lines, with m nodes on each."""
    rule, begins = gauss(m), np.append(0.0, np.cumsum(lines.lengths))
    within = lines.lengths[:, None] * rule.nodes
    over = Mesh(begins, lines.lengths, begins[:-1, None] + within, rule)
    rise = np.diff(lines.levels)[:, None] * rule.nodes
    return Stretch(model, over, lines.levels[:-1, None] + rise, tolerance)


def _on_each(values: FloatArray, over: Mesh) -> FloatArray:
    """Integral of `values` (q, m) over each interval of a mesh, (q,)."""
    whole: FloatArray = (values @ over.rule.weights) * over.lengths
    return whole
