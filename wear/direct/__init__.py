"""Direct integration of the wear equation by SciPy's solvers, with an estimate of the true error.

A solver's tolerance bounds the error of a step, not that of the result. Here every result is
computed at least twice, the second time with a hundredfold smaller tolerance and a shorter longest
step; the difference estimates the error of the first and bounds that of the second. Both are
refined until the estimate meets the request.

Other errors are excluded by construction: steps cannot jump over a contact pulse
(`wear.direct.problem.widest_step`), kinks of the load and of the loss of contact are ends of steps
(`wear.direct.loss_of_contact`), and nothing is integrated after the arrest of wear.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from wear.direct import loss_of_contact
from wear.direct.loss_of_contact import Mode
from wear.direct.problem import Setting, WearODE, scaled_ode, widest_step
from wear.direct.step import (
    FINEST_TOLERANCE,
    METHODS,
    EndOfModelError,
    Meter,
    leg,
)
from wear.load import Loading
from wear.load.spans import span
from wear.model import Model
from wear.numerics.floating_point import ROUNDOFF
from wear.numerics.gauss import FloatArray
from wear.orbit.problem import Cost
from wear.outcome import FADES, STOPS, Outcome
from wear.progress import Pace

__all__ = ["METHODS", "integrate"]

FIRST_TOLERANCE = 0.1  # of the first run, over the requested one
REFINEMENT = 0.01  # of the tolerance, from run to run
SHORTENING = 0.8  # of the longest step, from run to run
SAFETY = 4.0  # factor on the error estimated from the difference of two runs
CORRELATED = {"BDF": 3.0, "LSODA": 3.0}  # the errors of multistep methods' steps cancel less well
FEWEST_STEPS = 100  # added to the number of steps when their errors are summed
INPUT_ROUNDOFF = 16 * ROUNDOFF  # of the rate, by that of the scene's numbers in the exponent


class Integration(NamedTuple):
    """One integration, complete or not: the states at the marked cycles."""

    setting: Setting
    states: list[State]

    def wear(self) -> FloatArray:
        """Return the wear in mm at the marks that were reached."""
        return np.array([state.u for state in self.states], dtype=float)


class State(NamedTuple):
    """The wear in mm at the end of a cycle, and the number of steps up to there.

    `arrested_in` is the cycle in which wear stopped for good; if it `fades`, the cycle from which
    on it is within rounding of its limit.
    """

    cycle: int
    u: float
    mode: Mode
    arrested_in: int | None
    steps: int
    fades: bool = False


@np.errstate(over="ignore")  # trial states far off, under a law without a largest pressure
def integrate(
    model: Model,
    load: Loading,
    cycles: Sequence[int],
    rtol: float,
    method: str = "DOP853",
    deadline: float = np.inf,
    progress: Callable[[str], None] = lambda _: None,
) -> Outcome:
    """Integrate the wear from the initial state to the ends of `cycles`.

    Parameters
    ----------
    cycles
        Numbers of cycles, in any order, 0 for the initial state.
    rtol
        Requested relative error of the wear. The result may miss it: see its `error`.
    method
        One of `METHODS`, SciPy's names.
    deadline
        A `time.monotonic()` at which to stop with the results so far.
    progress
        Called with a message on the progress of an integration of more than two seconds.
    """
    marks = _marks(cycles)
    meter = Meter(deadline, Pace(progress))
    uncertainty = (
        loss_of_contact.roundoff(model, 0.0, load.maximum) if model.ends_at_3_sigma else 0.0
    )
    runs: list[Integration] = []
    stopped, interrupted = None, False
    try:
        for setting in _settings(method, rtol):
            runs.append(Integration(setting, []))
            meter.begin(f"{method}, run {len(runs)}", max(marks, default=0))
            for state in _march(model, load, marks, setting, meter):
                runs[-1].states.append(state)
            if len(runs) > 1 and np.max(_errors(runs, uncertainty), initial=0.0) <= rtol:
                break
    except TimeoutError:
        stopped, interrupted = "the time limit has passed", True
    except KeyboardInterrupt:
        stopped, interrupted = "interrupted", True
    except EndOfModelError as end:
        stopped = str(end)
    states, error = _best(runs, uncertainty)
    chosen = [index for index, state in enumerate(states) if state.cycle in set(cycles)]
    return Outcome(
        method,
        tuple(states[index].cycle for index in chosen),
        np.array([states[index].u for index in chosen], dtype=float),
        error[chosen],
        Cost(meter.cycles, meter.evaluations),
        tuple(_notices(states)),
        stopped,
        interrupted,
    )


def _settings(method: str, rtol: float) -> Iterator[Setting]:
    """Yield ever finer settings, until roundoff makes a smaller tolerance useless."""
    tolerance, share = FIRST_TOLERANCE * rtol, 1.0
    while tolerance > FINEST_TOLERANCE:
        yield Setting(method, tolerance, share)
        tolerance, share = REFINEMENT * tolerance, SHORTENING * share
    yield Setting(method, FINEST_TOLERANCE, share)
    yield Setting(method, FINEST_TOLERANCE, SHORTENING * share)


def _marks(cycles: Sequence[int]) -> tuple[int, ...]:
    """Return the requested cycles and powers of two, at which wear is compared and steps adapt."""
    last = max(cycles, default=0)
    powers = {1 << k for k in range(last.bit_length())}
    return tuple(sorted({mark for mark in powers if mark <= last} | set(cycles)))


def _march(
    model: Model,
    load: Loading,
    marks: Sequence[int],
    setting: Setting,
    meter: Meter,
) -> Iterator[State]:
    """Yield the states at the marked cycles, one after another."""
    acting = span(load, 0)
    ode = scaled_ode(model, acting.load)
    state, steps_before = State(0, 0.0, _mode(ode, 0.0), None, 0), meter.steps
    if model.ends_at_3_sigma and loss_of_contact.is_arrested(ode, 0.0, state.mode, load.maximum):
        state = state._replace(arrested_in=0)
    for mark in marks:
        while state.cycle < mark and state.arrested_in is None:
            if state.cycle >= acting.until:
                acting = span(load, state.cycle)
                ode = replace(ode, load=acting.load)
                state = state._replace(mode=_mode(ode, state.u))
            to = min(mark, acting.until)
            if model.ends_at_3_sigma:
                state = _cycles_with_loss_of_contact(ode, state, to, setting, meter, load.maximum)
            else:
                state = _smooth_cycles(ode, state, to, setting, meter)
        state = state._replace(cycle=mark, steps=meter.steps - steps_before)
        yield state


def _mode(ode: WearODE, u: float) -> Mode:
    return loss_of_contact.first_mode(ode, u) if ode.model.ends_at_3_sigma else Mode.CLOSED


def _smooth_cycles(ode: WearODE, state: State, to: int, setting: Setting, meter: Meter) -> State:
    """Integrate up to cycle `to`, stopping at kinks of the load only."""
    length = to - state.cycle
    u, phase = state.u, 0.0
    longest = widest_step(ode, u, float(length))
    for end in _stops(ode.load.kinks, length):
        phase, u, _ = leg(ode, u, phase, end, setting, meter, longest)
    meter.cycles += length
    return state._replace(cycle=to, u=u)


def _stops(kinks: tuple[float, ...], length: int) -> Iterator[float]:
    """Yield the phases after 0 at which a step has to end, up to `length` cycles."""
    inner = (cycle + kink for cycle in range(length if kinks else 0) for kink in kinks)
    yield from (phase for phase in inner if phase > 0.0)
    yield float(length)


def _cycles_with_loss_of_contact(
    ode: WearODE, state: State, to: int, setting: Setting, meter: Meter, maximum: float
) -> State:
    """Integrate up to cycle `to`, or to the end of the cycle in which wear stops."""
    pieces = loss_of_contact.pieces(ode.load)
    while state.cycle < to and state.arrested_in is None:
        u, mode = loss_of_contact.cycle(ode, pieces, state.u, state.mode, setting, meter)
        meter.cycles += 1
        cycle = state.cycle + 1
        state = state._replace(cycle=cycle, u=u, mode=mode)
        if loss_of_contact.is_arrested(ode, u, mode, maximum):
            fades = loss_of_contact.fades(ode, pieces, u, maximum)
            state = state._replace(arrested_in=cycle, fades=fades)
    return state


def _errors(runs: Sequence[Integration], uncertainty: float) -> FloatArray:
    """Return the relative error of the last run at each mark that it reached, from its distance to
    the others.

    Errors fall with the tolerance, though not in proportion: the square root of the ratio is
    assumed, except with loss of contact, where steps begin anew and the finer run may have one that
    is too long. The distance is the largest so far, since two runs may cross. Runs may also agree
    by accident: the estimate is at least the random sum of the errors that the last run's tolerance
    permits at each step, the roundoff of the scene's numbers, and `uncertainty` (mm), that of the
    edge of contact by roundoff.
    """
    *others, last = runs
    wear = last.wear()
    size = len(wear)
    distance = np.full(size, uncertainty)
    for other in others:
        ratio = np.sqrt(last.setting.tolerance / other.setting.tolerance)
        if uncertainty > 0.0:
            ratio = max(ratio, 1.0 / SAFETY)
        difference = np.maximum.accumulate(np.abs(other.wear()[:size] - wear))
        distance = np.maximum(distance, SAFETY * ratio * difference)
    steps = np.array([state.steps for state in last.states], dtype=float)
    per_step = last.setting.tolerance * CORRELATED.get(last.setting.method, 1.0)
    floor = INPUT_ROUNDOFF + per_step * np.sqrt(FEWEST_STEPS + steps)
    relative = np.divide(distance, wear, out=np.zeros(size), where=wear > 0.0)
    return np.where(wear > 0.0, relative + floor, 0.0)


def _notices(states: Sequence[State]) -> Iterator[str]:
    """Yield a notice with the cycle in which wear stopped, if it did."""
    ended = next((state for state in states if state.arrested_in is not None), None)
    if ended is not None:
        yield (FADES if ended.fades else STOPS).format(ended.arrested_in)


def _best(runs: list[Integration], uncertainty: float) -> tuple[list[State], FloatArray]:
    """Return states and errors of runs, the last of which may be incomplete."""
    if not runs:
        return [], np.zeros(0)
    furthest = len(runs[0].states)
    complete = [run for run in runs if len(run.states) == furthest]
    if len(complete) >= 2:
        return complete[-1].states, _errors(complete, uncertainty)
    finer = runs[-1].states if len(runs) > 1 else []
    error = np.full(furthest, np.nan)
    error[: len(finer)] = _errors(runs, uncertainty)[: len(finer)]
    return [*finer, *runs[0].states[len(finer) :]], error
