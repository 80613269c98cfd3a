"""An independent judge of the cutoff: the Taylor series of `tests.independent`, cut at the edge.

Rigid support; the rate jumps where h = 3 sigma. Filippov's solution is followed by brute force: the
cycle is cut where the load turns or has a kink; in contact every step of the series is looked at
closely for the margin 3 sigma - h; at the edge a pin that rises faster than the closed surfaces
wear apart closes them, one that rises more slowly is followed along the edge. Zeros are bisected to
some 40 digits.
"""

from collections.abc import Callable
from itertools import pairwise

import mpmath
from mpmath import mpf

from tests.independent import BITS, ONE, Judge, Problem, fixed

BISECTIONS = 130
LOOKS = 32  # at each step, or along the edge of contact, before bisection
SAMPLES = 128  # of a sum of harmonics, for its turning points
LONGEST = mpf(1) / 32  # step
BLUR = mpf(2) ** (40 - BITS)

Real = Callable[[mpf], mpf]
Series = Callable[[mpf], tuple[list[int], int]]
Change = Callable[[list[int], mpf, mpf], mpf | None]


class CutoffJudge(Judge):
    """A `Judge` whose pressure vanishes for h > 3 sigma; lengths in units of the roughness."""

    def __init__(self, problem: Problem) -> None:
        super().__init__(problem)
        with mpmath.workprec(BITS + 60):
            self.share = mpmath.exp(-3) if problem.exponential else 1 / (1 + mpmath.exp(4))
            self.edge_rate = mpf(self.drive) / ONE * self.share
            looks = [mpf(k) / SAMPLES for k in range(SAMPLES)]
            # A line of a table may be shorter than what lies between two samples.
            looks += [(before + after) / 2 for (before, _), (after, _) in pairwise(self.kinks)]
            self.steepest = 2 * max(abs(self.speed(phase)) for phase in looks)
            self.widening = mpf(abs(self.gap) + 3 * (abs(self.one[1]) + abs(self.two[1]))) / ONE
            self.cuts = [phase for phase, _ in self.kinks]
            if not problem.rows:
                self.cuts = self.turning_points()

    def turning_points(self) -> list[mpf]:
        """Where a sum of harmonics turns, with both ends of the cycle."""
        grid = [mpf(k) / SAMPLES for k in range(SAMPLES + 1)]
        signs = [self.speed(phase) < 0 for phase in grid]
        turns = [k for k in range(SAMPLES) if signs[k] != signs[k + 1]]
        return [mpf(0), *(zero(self.speed, grid[k], grid[k + 1]) for k in turns), mpf(1)]

    def load(self, phase: mpf) -> mpf:
        """U_a."""
        if self.data.rows:
            (start, value), _ = self.ends(phase)
            return value + self.speed(phase) * (phase - start)
        total = mpf(self.data.mean)
        for n, (c, s) in self.harmonics():
            turn = 2 * mpmath.pi * n * phase
            total += c * mpmath.cos(turn) + s * mpmath.sin(turn)
        return total / self.unit

    def speed(self, phase: mpf) -> mpf:
        """dU_a/dphase, to the right of a kink."""
        if self.data.rows:
            (start, first), (end, last) = self.ends(phase)
            return (last - first) / (end - start)
        total = mpf(0)
        for n, (c, s) in self.harmonics():
            turn = 2 * mpmath.pi * n
            total += turn * (s * mpmath.cos(turn * phase) - c * mpmath.sin(turn * phase))
        return total / self.unit

    def ends(self, phase: mpf) -> tuple[tuple[mpf, mpf], tuple[mpf, mpf]]:
        """The two rows that hold a phase."""
        pairs = list(pairwise(self.kinks))
        return next((pair for pair in pairs if pair[0][0] <= phase < pair[1][0]), pairs[-1])

    def reach(self, wear: mpf) -> mpf:
        """3 sigma - h at zero displacement."""
        one, two = self.roughnesses(wear)
        closure = (mpf(self.closure) + mpf(self.gap) * wear) / ONE
        return 3 * mpmath.sqrt(one**2 + two**2) - closure

    def reach_slope(self, wear: mpf) -> mpf:
        """Its derivative with respect to the wear."""
        one, two = self.roughnesses(wear)
        turn = (one * self.one[1] + two * self.two[1]) / mpmath.sqrt(one**2 + two**2)
        return (3 * turn - self.gap) / ONE

    def roughnesses(self, wear: mpf) -> tuple[mpf, mpf]:
        """Of the bearing and of the pin."""
        one, two = ((mpf(start) + mpf(slope) * wear) / ONE for start, slope in (self.one, self.two))
        return one, two

    def pull(self, phase: mpf, wear: mpf) -> mpf:
        """The rate of the margin in contact, at its edge."""
        return self.speed(phase) + self.reach_slope(wear) * self.edge_rate

    def cycle(self) -> None:
        """One period."""
        with mpmath.workprec(BITS + 60):
            for begin, end in pairwise(self.cuts):
                self.monotone(begin, end)

    def monotone(self, phase: mpf, end: mpf) -> None:
        """A stretch on which U_a only rises or only falls."""
        top, rising = self.load(end - (end - phase) * BLUR), self.load(end) > self.load(phase)
        while phase < end:
            wear = mpf(self.wear) / ONE
            margin = self.load(phase) + self.reach(wear)
            if margin > BLUR:
                phase = self.closed(phase, end)
                if phase < end and not rising:
                    return
            elif not rising or top + self.reach(wear) <= BLUR:
                return
            elif margin < -BLUR:
                phase = self.touching(wear, phase, end)
            elif self.pull(phase, wear) > 0:
                phase = self.closed(phase, end)
            else:
                phase = self.slide(phase, end)

    def touching(self, wear: mpf, phase: mpf, end: mpf) -> mpf:
        """Where a load that rises closes the gap."""
        reach = self.reach(wear)
        return zero(lambda at: self.load(at) + reach, phase, end)

    def closed(self, phase: mpf, end: mpf) -> mpf:
        """Integrate in contact to `end`, or to where contact is lost; return that phase."""
        return self.stepped(self.series, self.lost, phase, end)

    def stepped(self, series: Series, change: Change, phase: mpf, end: mpf) -> mpf:
        """Integrate a Taylor series to `end`, or to the first change of mode; return that phase."""
        while phase < end:
            step = min(LONGEST, end - phase)
            u, slope = series(phase)
            scale = self.wear + (abs(u[1]) >> 4)
            while not self.fine(u, slope, scale, step):
                step /= 2
            found = change(u, phase, step)
            self.wear = int(mpmath.nint(evaluate(u, step if found is None else found)))
            if found is not None:
                return phase + found
            phase = phase + step if step < end - phase else end
        return end

    @staticmethod
    def fine(u: list[int], slope: int, scale: int, step: mpf) -> bool:
        last = max(abs(u[-1]) * step ** (len(u) - 1), abs(u[-2]) * step ** (len(u) - 2))
        return bool(last <= mpf(scale) / 2**70 and slope * step < ONE)

    def lost(self, u: list[int], phase: mpf, step: mpf) -> mpf | None:
        """The part of a step after which the surfaces part, None if they do not."""

        def margin(t: mpf) -> mpf:
            return self.load(phase + t) + self.reach(evaluate(u, t) / ONE)

        worn = (evaluate(u, step) - u[0]) / ONE
        if margin(mpf(0)) > self.steepest * step + self.widening * worn:
            return None
        looks = [step * k / LOOKS for k in range(LOOKS + 1)]
        for before, after in pairwise(looks):
            if margin(after) < -BLUR:
                return zero(margin, before, after)
        return None

    def slide(self, phase: mpf, end: mpf) -> mpf:
        """Follow the edge of contact until the load closes it, or to `end`; return that phase."""

        def pull(at: mpf) -> mpf:
            wear = self.edge(at)
            return self.pull(at, wear) if wear is not None else ONE

        looks = [phase + (end - phase) * k / (8 * LOOKS) for k in range(8 * LOOKS)]
        looks.append(end - (end - phase) * BLUR)
        held = next((pair for pair in pairwise(looks) if pull(pair[1]) > 0), None)
        leaves = end if held is None else min(zero(pull, *held) + BLUR, end)
        wear = self.edge(min(leaves, looks[-1]))
        assert wear is not None
        self.wear = fixed(wear)
        return leaves

    def edge(self, phase: mpf) -> mpf | None:
        """The wear at the edge of contact, from the present one, None where there is no edge.

        The margin is convex in the wear, so that Newton's method does not go beyond its root.
        """
        wear, load = mpf(self.wear) / ONE, self.load(phase)
        for _ in range(60):
            slope = self.reach_slope(wear)
            if slope >= 0:
                return None
            step = (load + self.reach(wear)) / slope
            wear -= step
            if abs(step) < BLUR:
                return wear
        return None


def zero(function: Real, low: mpf, high: mpf) -> mpf:
    """Where a function changes its sign, by bisection; `low` if it does not."""
    side = function(low) < 0
    if (function(high) < 0) == side:
        return low
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        low, high = (middle, high) if (function(middle) < 0) == side else (low, middle)
    return low


def evaluate(series: list[int], step: mpf) -> mpf:
    """The sum of a Taylor series."""
    total = mpf(0)
    for coefficient in reversed(series):
        total = total * step + coefficient
    return total
