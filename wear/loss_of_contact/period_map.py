"""The one-cycle map where contact is lost at h = 3 sigma, from any wears of any scenes at once.

Overview
    A cycle consists of pieces (`wear.loss_of_contact.switching`), one after the other. On a rigid
    support contact begins, where the load rises, at a root of U_a = B(u) that is known beforehand;
    if it is lost, the solids slide along the edge (Filippov) to the end of the piece, where the
    wear is B^-1(U_a). Where the load falls, contact that is lost stays so; its end is found along
    with the wear.

    On a compliant support the pressure vanishes along with the margin of contact: up to a margin
    that is known the support holds the contact at its edge, and the pressure is proportional to the
    margin; beyond, it is that of the contact law. On a piece the margin passes each of the two
    levels in one direction at most.
Key results
    SwitchedPeriodMap    the increment of a cycle, piece by piece; also with the rate frozen at its
                         initial wear
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from wear.load import Load
from wear.loss_of_contact.contact import (
    ContactMode,
    ContactPart,
    ContactResult,
    PhaseInterval,
    wear_in_contact,
)
from wear.loss_of_contact.lasting import lasting_contact
from wear.loss_of_contact.roots import displacement_at, wear_at
from wear.loss_of_contact.switching import STRAIGHT, Cycles, Edge, Piece, cycles_of, phase_of
from wear.model import Model
from wear.numerics.floating_point import ROUNDOFF
from wear.numerics.gauss import BoolArray, FloatArray, Gauss, IntArray, gauss, radau
from wear.orbit.period_map import MANY_BREAKPOINTS

TOUCH = 16.0  # roundoffs of the margin from which contact is resolved
SOON = 1e-6  # of a piece: after that the load goes where it goes
FROZEN_NODES = 10  # on a piece, where the rate does not feel the wear
FROZEN_NODES_OF_MANY = 4  # where a cycle has more pieces than MANY_BREAKPOINTS
FROZEN_PHASE = 1e-5  # of a cycle: where contact begins and ends there
TOGETHER = 64, 16  # pieces of a long record on which contact lasts
AT_ONCE = 20_000  # numbers of an array that stays in the processor's cache, with some others


class CycleResult(NamedTuple):
    """The `increment` (k,) of a cycle from each wear, mm, and its estimated `error`, mm; whether
    the iteration `converged` (k,); and the number of right-hand sides evaluated."""

    increment: FloatArray
    error: FloatArray
    converged: BoolArray
    evaluations: int


class SwitchedPeriodMap(NamedTuple):
    """The map of a cycle of some scenes, of each of which `cycles` has one. Their `pieces` come one
    after the other, from the numbers `first` (scenes + 1,) on; `tops` and `bottoms` (scenes,
    pieces) are the highest and lowest displacements on each, mm. On a step of contact there are the
    nodes of the `rule`, which resolve the rate to `tolerance`. After the `deadline`
    (`time.monotonic()`) cycles end with a `TimeoutError`."""

    cycles: Cycles
    pieces: Piece
    first: IntArray
    tops: FloatArray
    bottoms: FloatArray
    rule: Gauss
    tolerance: float
    deadline: float = np.inf

    def advance(self, wear: FloatArray, scene: IntArray) -> CycleResult:
        """Return the increment of a cycle from each wear (k,), mm, of the scenes (k,)."""
        increment, error = np.zeros((2, len(wear)))
        sound = np.full(len(wear), True)
        evaluations = 0
        few = AT_ONCE // len(self.rule.nodes)
        straight = isinstance(self.cycles.load, STRAIGHT)
        sizes = TOGETHER if straight and self.tops.shape[1] > MANY_BREAKPOINTS else ()
        for at in range(0, len(wear), few):
            some = slice(at, at + few)
            for _, run in self.pieces_from(wear[some], scene[some], sizes):
                increment[some] += run.added
                error[some] += run.error
                sound[some] &= run.sound
                evaluations += run.evaluations
        return CycleResult(increment, error, sound, evaluations)

    def pieces_from(
        self, wear: FloatArray, scene: IntArray, sizes: Sequence[int] = ()
    ) -> Iterator[tuple[Piece, ContactResult]]:
        """Yield the pieces of a cycle with possible contact, in order, and the contact on them: one
        piece for each wear (k,) at a time, until none has another. Where contact by the law lasts
        over as many pieces as one of the `sizes`, which fall, these are taken at once."""
        added, cycles = np.zeros(len(wear)), self.cycles.take(scene)
        tops, bottoms, first = self.tops[scene], self.bottoms[scene], self.first[scene]
        after, alone_until = np.full(len(wear), -1), np.zeros(len(wear), dtype=np.intp)
        while True:
            if time.monotonic() > self.deadline:
                raise TimeoutError
            needed = displacement_at(cycles.model, wear + added)
            following = _next(tops > needed[:, None], after + 1)
            todo = following < tops.shape[1]
            if not todo.any():
                return
            after = following.copy()
            if sizes:
                lasting = _next(bottoms <= (needed + cycles.held)[:, None], after) - after
                lasting[after < alone_until] = 1
            for size in (*sizes, 1):
                which = todo & (lasting >= size) if size > 1 else todo
                rows = np.flatnonzero(which)
                if len(rows) == 0:
                    continue
                own, before = cycles.take(which), added[rows]
                start = wear[rows] + before
                if size > 1:
                    at = (first + following)[rows, None] + np.arange(size)
                    piece, m = self.pieces.take(at), len(self.rule.nodes)
                    run = lasting_contact(own, piece, m, self.tolerance, start, before)
                    alone_until[rows[~run.sound]] = following[rows[~run.sound]] + size
                    rows, run = rows[run.sound], run.where_sound()
                    todo[rows], after[rows] = False, following[rows] + size - 1
                else:
                    piece = self.pieces.take(np.minimum(first + following, self.first[-1] - 1))
                    run = self.through(own, piece.take(rows), start, before)
                run = run.among(rows, len(wear))
                added = added + run.added
                yield piece, run

    def through(
        self, cycles: Cycles, piece: Piece, wear: FloatArray, before: FloatArray
    ) -> ContactResult:
        """Return the contact on a piece from each wear (k,), mm, of which this cycle has added
        `before` (k,)."""
        needed = displacement_at(cycles.model, wear)
        uncertainty = margin_roundoff(cycles.model, cycles.peak, wear)
        which = piece.top - needed > uncertainty
        if not which.any():
            none = np.zeros(len(wear))
            return ContactResult(none, none, none, np.full(len(wear), True), 0)
        piece, rows = piece.take(which), np.flatnonzero(which)
        some = _PieceSolver(
            cycles.take(which).on(piece), piece, wear[rows], before[rows], self.rule, self.tolerance
        )
        if cycles.model.compliant:
            run = some.on_springs(needed[rows], uncertainty[rows])
        else:
            run = some.rigid(needed[rows])
        return run.among(rows, len(wear))

    def each_without_feedback(self, wear: FloatArray, scene: IntArray) -> FloatArray:
        """Return the increments (mm) of all pieces, one cycle after the other, with the rate frozen
        at the initial wear (k,) of each cycle, mm."""
        number = np.diff(self.first)[scene]
        row = np.repeat(np.arange(len(wear)), number)
        begins = np.cumsum(number) - number
        which = self.first[scene[row]] + np.arange(len(row)) - begins[row]
        added = np.zeros(len(row))
        short = self.tops.shape[1] > MANY_BREAKPOINTS
        x, few = gauss(FROZEN_NODES_OF_MANY if short else FROZEN_NODES), AT_ONCE // FROZEN_NODES
        for at in range(0, len(row), few):
            part = slice(at, at + few)
            added[part] = self._frozen(wear[row[part]], scene[row[part]], which[part], x)
        return added

    def _frozen(
        self, wear: FloatArray, scene: IntArray, which: IntArray, rule: Gauss
    ) -> FloatArray:
        """Return the increments of pieces (k,) at constant wear (k,), mm."""
        added, piece = np.zeros(len(wear)), self.pieces.take(which)
        needed = displacement_at(self.cycles.take(scene).model, wear)
        rows = np.flatnonzero(piece.top > needed)
        cycles, piece, u, needed = (
            self.cycles.take(scene[rows]), piece.take(rows), wear[rows], needed[rows],
        )  # fmt: skip
        cycles = cycles.on(piece)
        levels = [needed, needed + cycles.held] if cycles.model.compliant else [needed]
        edges = [phase_of(cycles.load, piece, level, FROZEN_PHASE) for level in levels]
        edges.append(np.where(piece.rising, piece.end, piece.begin))
        for edge, other in pairwise(edges):
            begin, length = np.minimum(edge, other), np.abs(other - edge)
            U_a = cycles.load(begin + length * rule.nodes[:, None])
            added[rows] += length * (rule.weights @ cycles.rate(u, U_a))
        return added


def switched_period_map(
    models: Sequence[Model],
    loads: Sequence[Load],
    edges: Sequence[Edge],
    nodes: int,
    tolerance: float = ROUNDOFF,
) -> SwitchedPeriodMap:
    """Return the period map of scenes of one variant, with so many Radau nodes on each step of
    contact: on a stiff support wear follows the load, and Radau's rule damps the transient."""
    pieces = Piece(
        *(
            np.concatenate(part, axis=-1)
            for part in zip(*(edge.pieces for edge in edges), strict=True)
        )
    )
    number = np.array([len(edge.pieces.closes) for edge in edges])
    tops, bottoms = np.full((2, len(edges), np.max(number)), -np.inf)
    own = np.arange(tops.shape[1]) < number[:, None]
    tops[own], bottoms[own] = pieces.top, np.minimum(pieces.heights[0], pieces.heights[-1])
    first, cycles = (
        np.cumsum([0, *number.tolist()]),
        cycles_of(models, loads, [edge.levels for edge in edges]),
    )
    return SwitchedPeriodMap(cycles, pieces, first, tops, bottoms, radau(nodes), tolerance)


def _next(marked: BoolArray, start: IntArray) -> IntArray:
    """Return the first `marked` column (k, n) from `start` (k,) on, n where there is none."""
    marked = marked & (np.arange(marked.shape[1]) >= start[:, None])
    first: IntArray = np.where(marked.any(axis=1), np.argmax(marked, axis=1), marked.shape[1])
    return first


def margin_roundoff(model: Model, peak: FloatArray | float, wear: FloatArray) -> FloatArray:
    """Return the largest margin (mm) that rounding may make of none, at each wear (mm) under loads
    with such a `peak` (mm)."""
    uncertainty: FloatArray = TOUCH * ROUNDOFF * model.margin_terms(wear, peak + 0.0 * wear)
    return uncertainty


@dataclass
class _PieceSolver:
    """The solution on pieces from each wear `u` (k,), of which this cycle has added `before`: up to
    the phases `at`, with an increment `added` (mm) and its `error`. Contact is `over` where it
    would close anew beyond the turning wear."""

    cycles: Cycles
    piece: Piece
    u: FloatArray
    before: FloatArray
    rule: Gauss
    tolerance: float
    at: FloatArray = field(init=False)
    added: FloatArray = field(init=False)
    error: FloatArray = field(init=False)
    sound: BoolArray = field(init=False)
    over: BoolArray = field(init=False)
    evaluations: int = 0
    parts: tuple[ContactPart, ...] = ()

    def __post_init__(self) -> None:
        self.at = self.piece.begin.copy()
        self.added, self.error = np.zeros((2, len(self.u)))
        self.sound, self.over = np.full(len(self.u), True), np.full(len(self.u), False)

    def rigid(self, needed: FloatArray) -> ContactResult:
        """Return the piece on a rigid support; contact is made under displacements (mm) that are
        `needed` (k,)."""
        piece, cycles = self.piece, self.cycles
        rising, every = piece.rising, np.full(len(self.u), True)
        edge = phase_of(cycles.load, piece, needed)
        self.at = np.where(rising, edge, piece.begin)
        expected, falls = np.where(rising, piece.end, edge), np.where(rising, 0.0, 1.0)
        self.go(every, True, 0.0 * falls, falls, expected)
        top, last = piece.heights[-1], self.u + self.added
        slides = rising & ((cycles.model.margin(last, top) < 0.0) | self.over)
        slid = np.flatnonzero(slides)
        if len(slid):
            own, u = cycles.take(slid), self.u[slid]
            self.added[slid] = wear_at(own.model, top[slid], u, 0.0, own.turning_wear) - u
            self.error[slid] = 0.0
        self.sound &= rising | ~self.over
        return self.result()._replace(slid=slid)

    def on_springs(self, needed: FloatArray, uncertainty: FloatArray) -> ContactResult:
        """Return the piece on a compliant support; contact is made under displacements (mm) that
        are `needed` (k,), and margins that differ by less than `uncertainty` (k,), mm, are the
        same."""
        piece, cycles = self.piece, self.cycles
        rising, held = piece.rising, cycles.held + np.zeros_like(self.u)
        opens, bends = (phase_of(cycles.load, piece, needed + level) for level in (0.0, held))
        lawful, at_edge = self._kinds(held, uncertainty)
        opening = rising & ~lawful & ~at_edge & (piece.heights[-1] - needed > uncertainty)
        self.at[opening], at_edge = opens[opening], at_edge | opening
        expected = np.where(rising, piece.end, bends)
        down = self.go(lawful, True, held, np.ones_like(held), expected)
        up = at_edge & (rising | self._closes_at_last(at_edge & ~rising, held))
        level, falls = np.where(up, held, 0.0), np.where(up, -1.0, np.where(rising, 0.0, 1.0))
        expected = np.where(up, bends, np.where(rising, piece.end, opens))
        up &= self.go(at_edge | down, False, level, falls, expected)
        self.go(up, True, 0.0 * held, 0.0 * held, piece.end)
        self.sound &= ~self.over
        return self.result()

    def result(self) -> ContactResult:
        """Return the contact on the whole pieces."""
        length = self.piece.end - self.piece.begin
        sound, parts = self.sound, self.parts
        return ContactResult(self.added, self.error, length, sound, self.evaluations, parts)

    def go(
        self,
        who: BoolArray,
        by_law: bool,
        level: FloatArray,
        direction: FloatArray,
        expected: FloatArray,
    ) -> BoolArray:
        """Continue the rows `who` (k,) in contact of one kind, whose end is expected at the phases
        `expected` (k,); return the rows in which contact has ended before the piece."""
        came, rows = np.full(len(who), False), np.flatnonzero(who)
        if len(rows):
            run = self._run(who, by_law, level, direction, expected).among(rows, len(who))
            self.evaluations += run.evaluations
            self.parts += run.parts
            came = who & (run.length < self.piece.end - self.at)
            start = self.u + self.added
            self.at = self.at + run.length
            self.added = self.added + run.added
            self.error = self.error + run.error
            self.sound &= run.sound
            U_a = self.cycles.load(self.at) - self.cycles.held
            self.over |= who & self.cycles.is_over(start, start + run.added, U_a)
        return came

    def _run(
        self,
        who: BoolArray,
        by_law: bool,
        level: FloatArray,
        direction: FloatArray,
        expected: FloatArray,
    ) -> ContactResult:
        contact = ContactMode(self.cycles, by_law, level, direction).take(who)
        at = self.at[who]
        over = PhaseInterval(at, self.piece.end[who] - at, expected[who] - at)
        start, before = ((x + self.added)[who] for x in (self.u, self.before))
        return wear_in_contact(contact, self.rule, self.tolerance, start, over, before)

    def _closes_at_last(self, held: BoolArray, level: FloatArray) -> BoolArray:
        """Return the rows `held` at the edge under a falling load that come to contact by the law:
        past the turning wear, wear may close contact faster than the load opens it."""
        up = held & (self.u >= self.cycles.turning_wear) & self.piece.closes
        if up.any():
            lasts, end = np.zeros_like(level), self.piece.heights[-1]
            run = self._run(up, False, lasts, lasts, self.piece.end)
            self.evaluations += run.evaluations
            last = (self.u + self.added)[up] + run.added
            up[up] = self.cycles.take(up).model.margin(last, end[up]) > level[up]
        return np.asarray(up)

    def _kinds(self, level: FloatArray, uncertainty: FloatArray) -> tuple[BoolArray, BoolArray]:
        """Return the rows (k,) in which a piece begins with contact by the law, and those in which
        the support holds the contact at its edge; where the margin is at the `level` (k,), mm,
        between them, its rate decides."""
        piece, cycles = self.piece, self.cycles
        soon = piece.begin + (piece.end - piece.begin) * SOON
        U_a = piece.heights[0]
        margin = cycles.model.margin(self.u, U_a)
        rate = cycles.period * cycles.model.law_rate(self.u, U_a)
        closes = cycles.load.slope(soon) + cycles.model.margin_slope(self.u, U_a) * rate > 0.0
        lawful = margin > level + np.where(closes, -uncertainty, uncertainty)
        held = ~lawful & (margin > np.where(piece.rising, -uncertainty, uncertainty))
        return lawful, held
