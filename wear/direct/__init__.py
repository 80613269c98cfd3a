"""Direct integration of the wear equation by SciPy's solvers, with an estimate of the true error.

A solver's tolerance bounds the error of a step, not that of the answer. Here every answer is
computed at least twice, the second time with a tenfold smaller tolerance and shorter longest step;
the difference estimates the error of the first and bounds that of the second. Both are refined
until the estimate meets the request.

What else may go wrong is excluded by construction: steps cannot jump over a contact pulse
(`wear.direct.problem.widest_step`), kinks of the load and of the cutoff are ends of steps
(`wear.direct.cutoff`), and once wear has come to its end nothing is integrated.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from wear.direct import cutoff
from wear.direct.cutoff import Mode
from wear.direct.problem import EPS, Problem, Setting, problem, widest_step
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
from wear.numerics.gauss import FloatArray
from wear.orbit.problem import Cost
from wear.outcome import Outcome
from wear.progress import Pace

__all__ = ["METHODS", "integrate"]

FIRST_TOLERANCE = 0.1  # of the first run, over the requested one
REFINEMENT = 0.01  # of the tolerance, from run to run
SHORTENING = 0.8  # of the longest step, from run to run
SAFETY = 4.0  # on what the distance of two runs tells
ALIKE = {"BDF": 3.0, "LSODA": 3.0}  # errors of a multistep method's steps do not cancel as well
FEWEST_STEPS = 100  # counted as if made when the errors of steps are added up
INPUT_ROUNDOFF = 16 * EPS  # of the rate, from that of the scene's numbers in the law's exponent


class Run(NamedTuple):
    """One integration, as far as it got: the states at the marked cycles."""

    setting: Setting
    states: list[State]

    def wear(self) -> FloatArray:
        """Return the wear in mm at the marks that were reached."""
        return np.array([state.u for state in self.states], dtype=float)


class State(NamedTuple):
    """The wear in mm at the end of a cycle, after so many steps.

    `arrested_in` is the cycle in which wear stopped for good, or from which on, if it `fades`, it
    is within rounding of its limit.
    """

    cycle: int
    u: float
    mode: Mode
    arrested_in: int | None
    steps: int
    fades: bool = False


def integrate(
    model: Model,
    load: Loading,
    cycles: Sequence[int],
    rtol: float,
    method: str = "DOP853",
    deadline: float = np.inf,
    progress: Callable[[str], None] = lambda _: None,
) -> Outcome:
    """Integrate the wear from the fresh state to the ends of `cycles`.

    Parameters
    ----------
    cycles
        Numbers of cycles, in any order, 0 for the fresh state.
    rtol
        Requested relative error of the wear. The result may miss it: look at `error`.
    method
        One of `METHODS`, SciPy's names.
    deadline
        A `time.monotonic()` at which to stop with what there is.
    progress
        Is told in words how far the integration is, once it takes more than two seconds.
    """
    marks = _marks(cycles)
    meter = Meter(deadline, Pace(progress))
    blur = cutoff.roundoff(model, 0.0, load.maximum) if model.ends_at_3_sigma else 0.0
    runs: list[Run] = []
    stopped, interrupted = None, False
    try:
        for setting in _settings(method, rtol):
            runs.append(Run(setting, []))
            meter.begin(f"{method}, run {len(runs)}", max(marks, default=0))
            for state in _march(model, load, marks, setting, meter):
                runs[-1].states.append(state)
            if len(runs) > 1 and np.max(_errors(runs, blur), initial=0.0) <= rtol:
                break
    except TimeoutError:
        stopped, interrupted = "the time limit has passed", True
    except KeyboardInterrupt:
        stopped, interrupted = "interrupted", True
    except EndOfModelError as end:
        stopped = str(end)
    states, error = _best(runs, blur)
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
    """Ever finer settings, until roundoff ends what a smaller tolerance brings."""
    tolerance, share = FIRST_TOLERANCE * rtol, 1.0
    while tolerance > FINEST_TOLERANCE:
        yield Setting(method, tolerance, share)
        tolerance, share = REFINEMENT * tolerance, SHORTENING * share
    yield Setting(method, FINEST_TOLERANCE, share)
    yield Setting(method, FINEST_TOLERANCE, SHORTENING * share)


def _marks(cycles: Sequence[int]) -> tuple[int, ...]:
    """Return the requested cycles with powers of two between: there wear is compared and steps
    adapt."""
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
    of = problem(model, acting.load)
    state, steps_before = State(0, 0.0, _mode(of, 0.0), None, 0), meter.steps
    if model.ends_at_3_sigma and cutoff.is_arrested(of, 0.0, state.mode, load.maximum):
        state = state._replace(arrested_in=0)
    for mark in marks:
        while state.cycle < mark and state.arrested_in is None:
            if state.cycle >= acting.until:
                acting = span(load, state.cycle)
                of = replace(of, load=acting.load)
                state = state._replace(mode=_mode(of, state.u))
            to = min(mark, acting.until)
            if model.ends_at_3_sigma:
                state = _cycles_with_cutoff(of, state, to, setting, meter, load.maximum)
            else:
                state = _smooth_cycles(of, state, to, setting, meter)
        state = state._replace(cycle=mark, steps=meter.steps - steps_before)
        yield state


def _mode(of: Problem, u: float) -> Mode:
    return cutoff.first_mode(of, u) if of.model.ends_at_3_sigma else Mode.CLOSED


def _smooth_cycles(of: Problem, state: State, to: int, setting: Setting, meter: Meter) -> State:
    """Integrate up to cycle `to`, stopping at kinks of the load only."""
    length = to - state.cycle
    u, phase = state.u, 0.0
    longest = widest_step(of, u, float(length))
    for end in _stops(of.load.kinks, length):
        phase, u, _ = leg(of, u, phase, end, setting, meter, longest)
    meter.cycles += length
    return state._replace(cycle=to, u=u)


def _stops(kinks: tuple[float, ...], length: int) -> Iterator[float]:
    """Yield the phases after 0 at which a step has to end, up to `length` cycles."""
    inner = (cycle + kink for cycle in range(length if kinks else 0) for kink in kinks)
    yield from (phase for phase in inner if phase > 0.0)
    yield float(length)


def _cycles_with_cutoff(
    of: Problem, state: State, to: int, setting: Setting, meter: Meter, maximum: float
) -> State:
    """Integrate up to cycle `to`, or to the end of the one in which wear comes to its end."""
    cut = cutoff.pieces(of.load)
    while state.cycle < to and state.arrested_in is None:
        u, mode = cutoff.cycle(of, cut, state.u, state.mode, setting, meter)
        meter.cycles += 1
        cycle = state.cycle + 1
        state = state._replace(cycle=cycle, u=u, mode=mode)
        if cutoff.is_arrested(of, u, mode, maximum):
            fades = cutoff.fades(of, cut, u, maximum)
            state = state._replace(arrested_in=cycle, fades=fades)
    return state


def _errors(runs: Sequence[Run], blur: float) -> FloatArray:
    """Return the relative error of the last run at each mark that it reached, from its distance to
    the others.

    Errors fall with the tolerance, if not in proportion: the square root of the ratio is counted
    on, but where contact is lost: steps begin anew there, and one that is too long may stand in the
    finer run. The distance is the largest so far, since two runs may cross. They may also agree by
    accident: nothing is claimed below the sum, at random, of the errors that the last run's
    tolerance permits at each step, nor below the roundoff of the scene's numbers, nor below
    `blur` (mm), the width that roundoff gives the edge of contact.
    """
    *others, last = runs
    wear = last.wear()
    size = len(wear)
    distance = np.full(size, blur)
    for other in others:
        gain = np.sqrt(last.setting.tolerance / other.setting.tolerance)
        if blur > 0.0:
            gain = max(gain, 1.0 / SAFETY)
        apart = np.maximum.accumulate(np.abs(other.wear()[:size] - wear))
        distance = np.maximum(distance, SAFETY * gain * apart)
    steps = np.array([state.steps for state in last.states], dtype=float)
    per_step = last.setting.tolerance * ALIKE.get(last.setting.method, 1.0)
    floor = INPUT_ROUNDOFF + per_step * np.sqrt(FEWEST_STEPS + steps)
    relative = np.divide(distance, wear, out=np.zeros(size), where=wear > 0.0)
    return np.where(wear > 0.0, relative + floor, 0.0)


def _notices(states: Sequence[State]) -> Iterator[str]:
    """Yield in which cycle wear came to its end, if it did."""
    ended = next((state for state in states if state.arrested_in is not None), None)
    if ended is not None and ended.fades:
        yield f"wear approaches its limit; within rounding from cycle {ended.arrested_in} on"
    elif ended is not None:
        yield f"wear stops for good in cycle {ended.arrested_in}"


def _best(runs: list[Run], blur: float) -> tuple[list[State], FloatArray]:
    """States and errors from runs of which the last one may have been stopped."""
    if not runs:
        return [], np.zeros(0)
    furthest = len(runs[0].states)
    complete = [run for run in runs if len(run.states) == furthest]
    if len(complete) >= 2:
        return complete[-1].states, _errors(complete, blur)
    finer = runs[-1].states if len(runs) > 1 else []
    error = np.full(furthest, np.nan)
    error[: len(finer)] = _errors(runs, blur)[: len(finer)]
    return [*finer, *runs[0].states[len(finer) :]], error
