"""One cycle with loss of contact: no pressure once the closure exceeds three roughnesses, Eq. (4).

Overview
    The margin of contact 3 sigma - h rises one to one with the pin's displacement U_a. While the
    contact is open nothing wears, so that it closes at a crossing of the load alone. The cycle is
    therefore cut where the load turns or has a kink, and integrated piece by piece.
Modes
    open      margin < 0: no wear
    closed    margin > 0: wear as if contact never ended
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

from wear.direct.problem import Real, Setting, WearODE, widest_step
from wear.direct.step import EndOfModelError, Meter, first_zero, leg
from wear.load import Load
from wear.loss_of_contact.edge import turning_points
from wear.model import Model
from wear.numerics.floating_point import ROUNDOFF, TINY

SLIDING_SAMPLES = 64  # phases of a piece at which the end of sliding is sought
PEAK_OFFSET = 1e-12  # of a piece: distance from a peak at which its sharpness is examined
MOST_LEGS = 1000  # in one piece: more is chatter between modes, not contact
MOST_NEWTON = 50  # steps to the wear at the edge
CONDITION = 16  # roundoffs in the terms of the margin


class Mode(Enum):
    """The state of contact."""

    OPEN = "open"
    CLOSED = "closed"
    SLIDING = "sliding"


class Section(NamedTuple):
    """An interval of phase in which the load is smooth and does not turn."""

    start: float
    end: float
    rising: bool  # or level


class Moment(NamedTuple):
    """A state inside a cycle: phase, wear in mm, mode."""

    phase: float
    u: float
    mode: Mode


def pieces(load: Load) -> tuple[Section, ...]:
    """Cut a cycle where the load turns or has a kink."""
    cuts = turning_points(load).tolist()
    ends = [cut for before, cut in pairwise(cuts) if cut - before > 4 * ROUNDOFF]
    return tuple(Section(a, b, bool(load(b) >= load(a))) for a, b in pairwise([0.0, *ends]))


def first_mode(ode: WearODE, u: float) -> Mode:
    """Return the mode at phase 0: a contact that only touches counts as open until it closes."""
    return Mode.CLOSED if ode.margin(0.0, u) > 0.0 else Mode.OPEN


def is_arrested(ode: WearODE, u: float, mode: Mode, maximum: float) -> bool:
    """Return whether no load up to `maximum` (mm) closes the contact again, within rounding."""
    return mode is not Mode.CLOSED and _threshold(ode, u) >= maximum - _slack(ode, u)


def fades(ode: WearODE, pieces: tuple[Section, ...], u: float, maximum: float) -> bool:
    """Return whether wear only approaches its end `u` (mm), which it has reached within rounding.

    With a rigid support wear stops at a smooth peak of the load, and at a plateau. At a peak so
    sharp that the load closes the contact up to the peak itself, each cycle leaves a fraction of
    the remaining wear; a compliant support does so at any peak: its pressure vanishes with the
    margin.
    """
    if ode.model.compliant:
        return True
    top = maximum - _slack(ode, u)

    def is_sharp(piece: Section) -> bool:
        near = PEAK_OFFSET * (piece.end - piece.start)
        if piece.rising:
            return bool(_opening_speed(ode, piece.end - near, u) < 0.0)
        return bool(ode.load.slope(piece.start + near) < 0.0)

    highest = [
        piece for piece in pieces if ode.load(piece.end if piece.rising else piece.start) >= top
    ]
    return bool(highest) and all(map(is_sharp, highest))


def pressure_share(model: Model, u: Real, U_a: Real, rise: Real) -> Real:
    """Return the acting share of the pressure of the closed contact: 1 closed, 0 open, and between
    them when sliding.

    At the edge of contact a rigid support leaves the pressure undetermined; the share is that at
    which wear follows the load, which rises by `rise` mm/s. All broadcast.
    """
    margin = model.margin(u, U_a)
    opening = np.maximum(-model.margin_slope(u, U_a) * model.rate(u, U_a), TINY)
    sliding = np.clip(rise, 0.0, opening) / opening
    return np.where(np.abs(margin) > roundoff(model, u, U_a), margin > 0.0, sliding)


def roundoff(model: Model, u: Real, U_a: Real) -> Real:
    """Return the uncertainty of the margin (mm)."""
    now = model.fields(u, U_a)
    return CONDITION * ROUNDOFF * (now.sigma + np.abs(now.h) + np.abs(U_a))


def cycle(
    ode: WearODE, pieces: tuple[Section, ...], u: float, mode: Mode, setting: Setting, meter: Meter
) -> tuple[float, Mode]:
    """Return the wear (mm) and mode at the end of a cycle that starts with wear `u` in `mode`.

    Raises
    ------
    TimeoutError, EndOfModelError
    """
    longest = widest_step(ode, u, 1.0)
    for piece in pieces:
        now = Moment(piece.start, u, mode)
        for _ in range(MOST_LEGS):
            now = _next(ode, piece, now, setting, meter, longest)
            if now.phase >= piece.end:
                break
        else:
            raise EndOfModelError("contact opens and closes too often to be followed")
        _, u, mode = now
    return u, mode


def _next(
    ode: WearODE, piece: Section, now: Moment, setting: Setting, meter: Meter, longest: float
) -> Moment:
    """Return the state at the next change of mode, or at the end of the piece."""
    if now.mode is Mode.CLOSED:
        return _wear(ode, piece, now, setting, meter, longest)
    if not piece.rising:
        return Moment(piece.end, now.u, Mode.OPEN)
    if now.mode is Mode.OPEN:
        return _close(ode, piece, now)
    return _slide(ode, piece, now)


def _wear(
    ode: WearODE, piece: Section, now: Moment, setting: Setting, meter: Meter, longest: float
) -> Moment:
    # A compliant support lets the pressure fall to zero at the edge of contact, so that a rising
    # load never loses it.
    slack = None if ode.model.compliant and piece.rising else _slack(ode, now.u)
    kink = _following(ode) if ode.model.compliant else None
    phase, u, opened = leg(ode, now.u, now.phase, piece.end, setting, meter, longest, slack, kink)
    if not opened:
        return Moment(phase, u, Mode.CLOSED)
    return Moment(phase, u, Mode.SLIDING if piece.rising else Mode.OPEN)


def _following(ode: WearODE) -> Callable[[Real, Real], Real]:
    """Return the excess of the wear rate at the edge of contact over the contact law's (mm/s).

    While it is negative, a compliant support keeps the contact at its edge.
    """

    def excess(phase: Real, u: Real) -> Real:
        U_a = ode.load(phase)
        edge, _ = ode.model.edge_rate_and_slope(u, U_a)
        return edge - ode.model.law_rate(u, U_a)

    return excess


def _close(ode: WearODE, piece: Section, now: Moment) -> Moment:
    """Return the state at which the load closes the open contact, or the end of the piece."""
    threshold = _threshold(ode, now.u)
    if ode.load(piece.end) <= threshold + _slack(ode, now.u):
        return Moment(piece.end, now.u, Mode.OPEN)
    phase = now.phase
    if ode.load(phase) < threshold:
        phase = first_zero(lambda at: ode.load(at) - threshold, phase, piece.end)
    holds = ode.model.compliant or _opening_speed(ode, phase, now.u) < 0.0
    return Moment(phase, now.u, Mode.CLOSED if holds else Mode.SLIDING)


def _slide(ode: WearODE, piece: Section, now: Moment) -> Moment:
    """Follow the edge of contact until the load closes faster than wear can open it."""
    phases = np.linspace(now.phase, piece.end, SLIDING_SAMPLES + 1)
    wear = _edge_wear(ode, phases, np.full(phases.shape, now.u))
    leaves = np.flatnonzero(_opening_speed(ode, phases, wear)[:-1] < 0.0)
    if len(leaves) == 0:
        return Moment(piece.end, max(now.u, float(wear[-1])), Mode.SLIDING)
    if leaves[0] == 0:  # a kink of the load
        return Moment(now.phase, now.u, Mode.CLOSED)
    first = int(leaves[0]) - 1

    def pull(phase: float) -> Real:
        return _opening_speed(ode, phase, _edge_wear(ode, phase, float(wear[first])))

    phase = first_zero(pull, float(phases[first]), float(phases[first + 1]))
    u = max(now.u, float(_edge_wear(ode, phase, float(wear[first]))))
    return Moment(phase, u, Mode.CLOSED)


def _opening_speed(ode: WearODE, phase: Real, u: Real) -> Real:
    """Return the speed (mm per cycle) at which closed contact at the edge opens; if negative, it
    closes."""
    U_a = ode.load(phase)
    opening = -ode.model.margin_slope(u, U_a) * ode.load.period * ode.model.rate(u, U_a)
    return opening - ode.load.slope(phase)


def _edge_wear(ode: WearODE, phase: Real, u: Real) -> Real:
    """Return the wear at which the margin is zero, by Newton's method from the nearby wear `u`.

    The margin is convex in u, and linear for one rough surface.
    """
    U_a = ode.load(phase)
    for _ in range(MOST_NEWTON):
        step = ode.model.margin(u, U_a) / ode.model.margin_slope(u, U_a)
        u = u - step
        if np.all(np.abs(step) <= 4 * ROUNDOFF * np.abs(u)):
            break
    return u


def _threshold(ode: WearODE, u: float) -> float:
    """Return the displacement U_a (mm) that just closes the contact; the margin has slope 1."""
    return -float(ode.model.margin(u, 0.0))


def _slack(ode: WearODE, u: float) -> float:
    """Return the uncertainty of the margin over the cycle (mm)."""
    return max(float(roundoff(ode.model, u, U_a)) for U_a in (ode.load.minimum, ode.load.maximum))
