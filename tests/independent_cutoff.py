"""An independent judge of the cutoff: the Taylor series of `tests.independent`, cut at the edge.

One worn solid, rigid support, U_a = U sin(2 pi t/T). The rate jumps where h = 3 sigma, which the
series finds by bisection to some 40 digits; Filippov's solution at the edge is typed out on
purpose: a pin that rises faster than the closed surfaces wear apart closes them, one that rises
more slowly is followed along the edge, up to its peak.
"""

from collections.abc import Iterable

import mpmath

from tests.independent import BITS, ONE, Judge, Problem, fixed

BISECTIONS = 130


class CutoffJudge(Judge):
    """A `Judge` whose pressure vanishes for h > 3 sigma."""

    def __init__(self, problem: Problem) -> None:
        super().__init__(problem)
        others = (problem.pin_roughness, problem.kappa, problem.deflection, *problem.cosine)
        assert not any(others)
        with mpmath.workprec(BITS + 60):
            unit = self.unit
            self.swing = mpmath.mpf(problem.sine[0]) / unit
            self.unloading = 1 - 3 * mpmath.mpf(problem.slope)  # of the margin, per wear
            self.edge = mpmath.mpf(problem.closure) / unit - 3  # U_a at first contact, fresh
            self.slide = mpmath.mpf(self.drive) / ONE / (1 + mpmath.exp(4))  # wear rate at the edge

    def cycle(self) -> None:
        """One period, from phase 0: the rise to the peak at 1/4, the fall, and the rise again."""
        with mpmath.workprec(BITS + 60):
            phase = mpmath.mpf(0)
            for end in (mpmath.mpf(1) / 4, mpmath.mpf(3) / 4, mpmath.mpf(1)):
                self.monotone(phase, end)
                phase = end

    def touch(self) -> mpmath.mpf:
        """The displacement from which on there is contact, at the present wear."""
        return self.edge + self.unloading * self.wear / ONE

    def load(self, phase: mpmath.mpf) -> mpmath.mpf:
        """U_a in units of the roughness."""
        return self.swing * mpmath.sin(2 * mpmath.pi * phase)

    def monotone(self, phase: mpmath.mpf, end: mpmath.mpf) -> None:
        """A stretch on which U_a only rises or only falls."""
        margin = self.load(phase) - self.touch()
        if abs(margin) < mpmath.mpf(2) ** (40 - BITS):
            margin = mpmath.mpf(0)
        rising = self.load(end) > self.load(phase)
        if margin < 0 or (margin == 0 and not rising):
            if not rising or self.load(end) <= self.touch():
                return
            phase = self.crossing(phase, end)
            margin = mpmath.mpf(0)
        if margin > 0 or self.speed(phase) > self.unloading * self.slide:
            phase = self.closed(phase, end)
        if phase < end and rising and self.unloading > 0:  # along the edge, to the peak at the end
            self.wear = fixed((self.load(end) - self.edge) / self.unloading)

    def speed(self, phase: mpmath.mpf) -> mpmath.mpf:
        """dU_a/dphase."""
        return 2 * mpmath.pi * self.swing * mpmath.cos(2 * mpmath.pi * phase)

    def crossing(self, phase: mpmath.mpf, end: mpmath.mpf) -> mpmath.mpf:
        """Where a rising pin first touches."""
        quarter = mpmath.asin(self.touch() / self.swing) / (2 * mpmath.pi)
        crossing = quarter if end <= mpmath.mpf(1) / 4 else 1 + quarter
        assert phase <= crossing <= end
        return crossing

    def closed(self, phase: mpmath.mpf, end: mpmath.mpf) -> mpmath.mpf:
        """Integrate in contact to `end`, or to where contact is lost; return that phase."""
        while phase < end:
            step = min(mpmath.mpf(1) / 32, end - phase)
            u, slope = self.series(phase)
            scale = self.wear + (abs(u[1]) >> 4)
            while not self.fine(u, slope, scale, step):
                step /= 2
            lost = self.lost(u, phase, step)
            self.wear = evaluate(u, step if lost is None else lost)
            if lost is not None:
                return phase + lost
            phase = phase + step if step < end - phase else end
        return end

    @staticmethod
    def fine(u: list[int], slope: int, scale: int, step: mpmath.mpf) -> bool:
        last = max(abs(u[-1]) * step ** (len(u) - 1), abs(u[-2]) * step ** (len(u) - 2))
        return bool(last <= mpmath.mpf(scale) / 2**70 and slope * step < ONE)

    def lost(self, u: list[int], phase: mpmath.mpf, step: mpmath.mpf) -> mpmath.mpf | None:
        """The part of a step after which the surfaces part, None if they do not."""

        def margin(t: mpmath.mpf) -> mpmath.mpf:
            return (
                self.load(phase + t) - self.edge - self.unloading * evaluate(u, t) / mpmath.mpf(ONE)
            )

        looks = [step * k / 8 for k in range(1, 9)]
        after = next((t for t in looks if margin(t) < 0), None)
        if after is None:
            return None
        low, high = after - step / 8, after
        for _ in range(BISECTIONS):
            middle = (low + high) / 2
            low, high = (low, middle) if margin(middle) < 0 else (middle, high)
        return low


def evaluate(series: list[int], step: mpmath.mpf) -> int:
    """The sum of a Taylor series."""
    total = mpmath.mpf(0)
    for coefficient in reversed(series):
        total = total * step + coefficient
    return int(mpmath.nint(total))


def wear_after(problem: Problem, cycles: Iterable[int]) -> dict[int, float]:
    """u_c in mm at the end of each of `cycles`, to double precision."""
    judge, done, found = CutoffJudge(problem), 0, {}
    for wanted in sorted(cycles):
        while done < wanted:
            before = judge.wear
            judge.cycle()
            done = wanted if judge.wear == before else done + 1
        with mpmath.workprec(BITS):
            found[wanted] = float(mpmath.mpf(judge.wear) / ONE * judge.unit)
    return found
