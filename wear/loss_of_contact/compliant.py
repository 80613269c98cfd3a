"""A piece of the cycle with the cutoff and a compliant support.

The pressure vanishes along with the margin of contact: up to a margin that is known, the support
holds the contact at its edge and the pressure is proportional to the margin; beyond, it is that of
the contact law. The rate is continuous, with a bend where one gives way to the other. On a piece
(`wear.loss_of_contact.switching`) the margin passes each of the two levels in one direction at
most.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from wear.load import Load
from wear.loss_of_contact.contact import (
    Contact,
    ContactPart,
    ContactResult,
    Interval,
    wear_in_contact,
)
from wear.loss_of_contact.switching import Edge, Piece, displacement_at, phase_of
from wear.model import Model
from wear.numerics.gauss import (
    BoolArray,
    FloatArray,
    Gauss,
)


class Support(NamedTuple):
    """A model with cutoff on a compliant support under a load, with its edge of contact, and how
    finely contact is resolved."""

    model: Model
    load: Load
    edge: Edge
    rule: Gauss
    tolerance: float

    def by_law(self, level: float | None = None) -> Contact:
        """Contact by the law; to the `level` (mm) to which its margin falls, if any."""
        return Contact(self.model, self.load, self.model.law_rate_and_slope, level)

    def held(self, level: float | None = None, falls: bool = True) -> Contact:
        """Contact held at its edge; to the `level` (mm) to which its margin falls or rises."""
        return Contact(
            self.model, self.load, self.model.edge_rate_and_slope, level, falls, proportional=True
        )


@dataclass
class _Progress:
    """How far a piece has been walked from each wear `u` (k,), of which this cycle added `before`:
    to the phases `at`, where `added` mm have come on top."""

    support: Support
    piece: Piece
    u: FloatArray
    before: FloatArray
    at: FloatArray
    added: FloatArray
    sound: bool = True
    evaluations: int = 0
    parts: tuple[ContactPart, ...] = ()

    def go(self, who: BoolArray, contact: Contact, expected: FloatArray) -> BoolArray:
        """Walk on with those of `who` (k,) in contact of one kind, whose end is expected at the
        phases `expected` (k,); return which of them have come to it."""
        came = np.zeros(len(self.u), dtype=bool)
        if who.any():
            run = self._run(who, contact, expected)
            self.parts += run.of(np.flatnonzero(who))
            came[who] = run.length < self.piece.end - self.at[who]
            start = (self.u + self.added)[who]
            U_a = self.support.load(self.at[who] + run.length) - self.support.edge.held
            over = self.support.edge.is_over(start, start + run.added, U_a)
            self.at[who] += run.length
            self.added[who] += run.added
            self.sound &= run.sound and not over.any()
        return came

    def end(self, who: BoolArray, contact: Contact) -> FloatArray:
        """Return the margin (mm) at the end of the piece of those of `who`, all of it in such
        contact."""
        run = self._run(who, contact, self.at)
        U_a = np.full(int(who.sum()), self.piece.heights[-1])
        margin: FloatArray = self.support.model.margin((self.u + self.added)[who] + run.added, U_a)
        return margin

    def _run(self, who: BoolArray, contact: Contact, expected: FloatArray) -> ContactResult:
        at = self.at[who]
        over = Interval(at, self.piece.end - at, expected[who] - at)
        before = (self.before + self.added)[who]
        start = (self.u + self.added)[who]
        run = wear_in_contact(
            contact, self.support.rule, self.support.tolerance, start, over, before
        )
        self.evaluations += run.evaluations
        return run


def on_support(
    support: Support, piece: Piece, wear: FloatArray, before: FloatArray, uncertainty: FloatArray
) -> ContactResult:
    """Return a piece from each wear (k,), `before` (k,) of it added by this cycle already; margins
    that differ by less than `uncertainty` (k,), mm, are the same."""
    edge, load = support.edge, support.load
    touching = displacement_at(support.model, wear)
    if np.all(max(piece.heights[[0, -1]]) - touching <= uncertainty):
        return ContactResult(np.zeros_like(wear), np.zeros_like(wear), True, 0)
    begins = np.full_like(wear, piece.begin)
    opens, bends = (phase_of(load, piece, touching + level) for level in (0.0, edge.held))
    lawful, held = _kinds(support, piece, wear, uncertainty)
    if piece.rising:
        fresh = ~lawful & ~held & (piece.heights[-1] - touching > uncertainty)
        begins[fresh], held = opens[fresh], held | fresh
    walk = _Progress(support, piece, wear, before, begins, np.zeros_like(wear))
    ends = np.full_like(wear, piece.end)
    down = walk.go(lawful, support.by_law(edge.held), ends if piece.rising else bends)
    if piece.rising:
        up = walk.go(held, support.held(edge.held, falls=False), bends)
        walk.go(down, support.held(), ends)
    else:
        up = _release(walk, held, bends, opens)
        walk.go(down, support.held(0.0), opens)
    walk.go(up, support.by_law(), ends)
    length = ends - piece.begin
    return ContactResult(walk.added, length, walk.sound, walk.evaluations, walk.parts)


def _release(walk: _Progress, held: BoolArray, bends: FloatArray, opens: FloatArray) -> BoolArray:
    """Walk on under a falling load with those that are `held` (k,), and return which of them have
    come to contact by the law; past the turning_wear wear may close contact faster than the load
    opens."""
    support, edge = walk.support, walk.support.edge
    up = held & (walk.u >= edge.turning_wear) & walk.piece.closes
    if up.any():
        up[up] = walk.end(up, support.held()) > edge.held
    walk.go(held & ~up, support.held(0.0), opens)
    return walk.go(up, support.held(edge.held, falls=False), bends)


def _kinds(
    support: Support, piece: Piece, wear: FloatArray, uncertainty: FloatArray
) -> tuple[BoolArray, BoolArray]:
    """At which wears (k,) a piece begins with contact by the law, and at which with contact that
    the support holds at its edge; at a level, by where it goes from there."""
    model, load, level = support.model, support.load, support.edge.held
    soon = piece.begin + (piece.end - piece.begin) * 1e-6
    U_a = np.full_like(wear, piece.heights[0])
    margin = model.margin(wear, U_a)
    rate = load.period * model.law_rate(wear, U_a)
    closes = load.slope(soon) + model.margin_slope(wear, U_a) * rate > 0.0
    lawful = margin > level + np.where(closes, -uncertainty, uncertainty)
    held = ~lawful & (margin > (-uncertainty if piece.rising else uncertainty))
    return lawful, held
