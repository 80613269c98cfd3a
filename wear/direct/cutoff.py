"""One cycle with the cutoff of Eq. (4): no pressure once the closure exceeds three roughnesses.

Overview
    The margin of contact 3 sigma - h rises one to one with the pin's displacement U_a. While the
    contact is open nothing wears, so its next beginning is a crossing of the load alone. The
    cycle is therefore cut where the load turns or has a kink, and each piece walked through.
Modes
    open      margin < 0: no wear
    closed    margin > 0: wear as without cutoff
    sliding   margin = 0, rigid support: the pressure jumps, and wear in Filippov's sense keeps
              the surfaces at the edge of contact, so that u_c is a function of U_a alone
Reference
    A. F. Filippov, Differential Equations with Discontinuous Righthand Sides, Kluwer 1988.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from wear.direct.problem import EPS, Problem, Real, Setting, widest_step
from wear.direct.step import EndOfModelError, Meter, first_zero, leg
from wear.load import Load
from wear.loss_of_contact.switching import turning_points
from wear.model import Model

TINY = float(np.finfo(float).tiny)
SLIDING_LOOKS = 64  # phases of a piece at which the end of sliding is looked for
NEARLY = 1e-12  # of a piece: how near to a peak one looks
MOST_LEGS = 1000  # in one piece: more is chatter between modes, not contact


class Mode(Enum):
    """How the surfaces meet."""

    OPEN = "open"
    CLOSED = "closed"
    SLIDING = "sliding"


class Piece(NamedTuple):
    """An interval of phase in which the load is smooth and does not turn."""

    start: float
    end: float
    rising: bool  # or level


class Moment(NamedTuple):
    """A state inside a cycle: phase, wear in mm, mode."""

    phase: float
    u: float
    mode: Mode


def pieces(load: Load) -> tuple[Piece, ...]:
    """Cut a cycle where the load turns or has a kink."""
    cuts = turning_points(load).tolist()
    ends = [cut for before, cut in pairwise(cuts) if cut - before > 4 * EPS]
    return tuple(Piece(a, b, bool(load(b) >= load(a))) for a, b in pairwise([0.0, *ends]))


def first_mode(of: Problem, u: float) -> Mode:
    """Return the mode at phase 0: a contact that only touches counts as open until it closes."""
    return Mode.CLOSED if of.margin(0.0, u) > 0.0 else Mode.OPEN


def is_arrested(of: Problem, u: float, mode: Mode, maximum: float) -> bool:
    """Return whether no load up to `maximum` (mm) closes the contact again, as far as rounding
    tells."""
    return mode is not Mode.CLOSED and _threshold(of, u) >= maximum - _slack(of, u)


def fades(of: Problem, cut: tuple[Piece, ...], u: float, maximum: float) -> bool:
    """Return whether wear that has come to its end `u` (mm), as far as rounding tells, only tends
    to it.

    A rigid support stops wear at a smooth peak of the load, and at a plateau. At a peak so sharp
    that the load closes the contact up to the very peak each cycle leaves a part of what is left;
    a compliant support does so at any peak, since its pressure vanishes along with the margin.
    """
    if of.model.compliant:
        return True
    top = maximum - _slack(of, u)

    def is_sharp(piece: Piece) -> bool:
        near = NEARLY * (piece.end - piece.start)
        if piece.rising:
            return bool(_pull(of, piece.end - near, u) < 0.0)
        return bool(of.load.slope(piece.start + near) < 0.0)

    highest = [piece for piece in cut if of.load(piece.end if piece.rising else piece.start) >= top]
    return bool(highest) and all(map(is_sharp, highest))


def pressure_share(model: Model, u: Real, U_a: Real, rise: Real) -> Real:
    """Return the share of the closed contact's pressure that acts: 1 closed, 0 open, between when
    sliding.

    At the edge of contact a rigid support leaves the pressure undetermined; it is the share that
    lets wear keep up with the load, which rises by `rise` mm/s. All broadcast.
    """
    margin = model.margin(u, U_a)
    opening = np.maximum(-model.margin_slope(u, U_a) * model.rate(u, U_a), TINY)
    sliding = np.clip(rise, 0.0, opening) / opening
    return np.where(np.abs(margin) > roundoff(model, u, U_a), margin > 0.0, sliding)


def roundoff(model: Model, u: Real, U_a: Real) -> Real:
    """Return the uncertainty of the margin (mm)."""
    now = model.fields(u, U_a)
    return 16 * EPS * (now.sigma + np.abs(now.h) + np.abs(U_a))


def cycle(
    of: Problem, cut: tuple[Piece, ...], u: float, mode: Mode, setting: Setting, meter: Meter
) -> tuple[float, Mode]:
    """Return the wear (mm) and mode at the end of a cycle that starts with wear `u` in `mode`.

    Raises
    ------
    TimeoutError, EndOfModelError
    """
    longest = widest_step(of, u, 1.0)
    for piece in cut:
        now = Moment(piece.start, u, mode)
        for _ in range(MOST_LEGS):
            now = _next(of, piece, now, setting, meter, longest)
            if now.phase >= piece.end:
                break
        else:
            raise EndOfModelError("contact opens and closes too often to be followed")
        _, u, mode = now
    return u, mode


def _next(
    of: Problem, piece: Piece, now: Moment, setting: Setting, meter: Meter, longest: float
) -> Moment:
    """Go on to the next change of mode, or to the end of the piece."""
    if now.mode is Mode.CLOSED:
        return _wear(of, piece, now, setting, meter, longest)
    if not piece.rising:
        return Moment(piece.end, now.u, Mode.OPEN)
    if now.mode is Mode.OPEN:
        return _close(of, piece, now)
    return _slide(of, piece, now)


def _wear(
    of: Problem, piece: Piece, now: Moment, setting: Setting, meter: Meter, longest: float
) -> Moment:
    # A compliant support lets the pressure fall to zero at the edge of contact, so that a rising
    # load never loses it.
    slack = None if of.model.compliant and piece.rising else _slack(of, now.u)
    kink = _following(of) if of.model.compliant else None
    phase, u, opened = leg(of, now.u, now.phase, piece.end, setting, meter, longest, slack, kink)
    if not opened:
        return Moment(phase, u, Mode.CLOSED)
    return Moment(phase, u, Mode.SLIDING if piece.rising else Mode.OPEN)


def _following(of: Problem) -> Callable[[Real, Real], Real]:
    """Return how far the wear rate at the edge of contact is above that of the contact law (mm/s).

    While it is negative, a compliant support keeps the contact at its edge.
    """

    def excess(phase: Real, u: Real) -> Real:
        U_a = of.load(phase)
        edge, _ = of.model.edge_rate_and_slope(u, U_a)
        return edge - of.model.law_rate(u, U_a)

    return excess


def _close(of: Problem, piece: Piece, now: Moment) -> Moment:
    """Wait, open, for the load to close the gap."""
    threshold = _threshold(of, now.u)
    if of.load(piece.end) <= threshold + _slack(of, now.u):
        return Moment(piece.end, now.u, Mode.OPEN)
    phase = now.phase
    if of.load(phase) < threshold:
        phase = first_zero(lambda at: of.load(at) - threshold, phase, piece.end)
    holds = of.model.compliant or _pull(of, phase, now.u) < 0.0
    return Moment(phase, now.u, Mode.CLOSED if holds else Mode.SLIDING)


def _slide(of: Problem, piece: Piece, now: Moment) -> Moment:
    """Follow the edge of contact until the load closes faster than wear can open."""
    phases = np.linspace(now.phase, piece.end, SLIDING_LOOKS + 1)
    wear = _edge(of, phases, np.full(phases.shape, now.u))
    leaves = np.flatnonzero(_pull(of, phases, wear)[:-1] < 0.0)
    if len(leaves) == 0:
        return Moment(piece.end, max(now.u, float(wear[-1])), Mode.SLIDING)
    if leaves[0] == 0:  # a kink of the load
        return Moment(now.phase, now.u, Mode.CLOSED)
    first = int(leaves[0]) - 1

    def pull(phase: float) -> Real:
        return _pull(of, phase, _edge(of, phase, float(wear[first])))

    phase = first_zero(pull, float(phases[first]), float(phases[first + 1]))
    u = max(now.u, float(_edge(of, phase, float(wear[first]))))
    return Moment(phase, u, Mode.CLOSED)


def _pull(of: Problem, phase: Real, u: Real) -> Real:
    """Return how fast closed contact at the edge would open (mm per cycle); negative: it closes."""
    U_a = of.load(phase)
    opening = -of.model.margin_slope(u, U_a) * of.load.period * of.model.rate(u, U_a)
    return opening - of.load.slope(phase)


def _edge(of: Problem, phase: Real, u: Real) -> Real:
    """Return the wear at which the margin is zero, by Newton's method from the nearby wear `u`.

    The margin is convex in u, and linear for one rough surface.
    """
    U_a = of.load(phase)
    for _ in range(50):
        step = of.model.margin(u, U_a) / of.model.margin_slope(u, U_a)
        u = u - step
        if np.all(np.abs(step) <= 4 * EPS * np.abs(u)):
            break
    return u


def _threshold(of: Problem, u: float) -> float:
    """Return the displacement U_a (mm) that just closes the contact: the margin's slope in U_a is
    1."""
    return -float(of.model.margin(u, 0.0))


def _slack(of: Problem, u: float) -> float:
    """Return the uncertainty of the margin over the cycle (mm)."""
    return max(float(roundoff(of.model, u, U_a)) for U_a in (of.load.minimum, of.load.maximum))
