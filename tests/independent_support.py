"""An independent judge of the cutoff on a compliant support.

The margin m = 3 sigma - h is taken with an undeflected support. The support gives way by p/k, and
so the contact ends at m = 0, where p = 0; it lies at its edge, p = k m, up to the m at which this
is the pressure of the law at h = 3 sigma; beyond, p is the root of the law with the deflection.
The mode is carried along and changes where m passes a level, whose phase is bisected. Contact by
the law, and at its edge with two rough solids, is a Taylor series. At its edge with one rough solid
it is a linear equation, u' = a (U_a + b - c u): its solution is written down, whatever the
stiffness.
"""

from itertools import pairwise

import mpmath
from mpmath import mpf

from tests.independent import BITS, ONE, ORDER, Problem
from tests.independent_loss_of_contact import BLUR, CutoffJudge, Real, evaluate, zero

LOOKS = 8  # at each step of a series
SAMPLES = 128  # of the closed form, evenly spread
LAYERS = 4  # looks at every halving of a stretch, down to less than its boundary layer


class SupportJudge(CutoffJudge):
    """A `CutoffJudge` whose rigid support is replaced by springs."""

    def __init__(self, problem: Problem) -> None:
        assert problem.deflection
        super().__init__(problem)
        with mpmath.workprec(BITS + 60):
            deflection = mpf(self.deflection) / ONE
            self.level_of_law = deflection * self.share
            self.stiff = mpf(self.drive) / ONE / deflection
        self.mode = "law"

    def margin(self, phase: mpf, wear: mpf) -> mpf:
        """3 sigma - h with an undeflected support."""
        return self.load(phase) + self.reach(wear)

    def cycle(self) -> None:
        """One period."""
        with mpmath.workprec(BITS + 60):
            margin = self.margin(mpf(0), mpf(self.wear) / ONE)
            if self.wear == 0:
                self.mode = "open" if margin <= 0 else "held"
                self.mode = "law" if margin > self.level_of_law else self.mode
            for begin, end in pairwise(self.cuts):
                phase = begin
                while phase < end:
                    phase = self.on(phase, end)

    def on(self, phase: mpf, end: mpf) -> mpf:
        """Go on in the present mode, on a stretch on which U_a only rises or only falls; return the
        phase at which the mode changes, or the end."""
        if self.mode == "open":
            reach = self.reach(mpf(self.wear) / ONE)
            if self.load(end) + reach <= BLUR:
                return end
            self.mode = "held"
            return zero(lambda at: self.load(at) + reach, phase, end)
        if self.mode == "law":
            return self.stepped(self.series, self.passed, phase, end)
        if self.data.pin_roughness or self.two[1]:
            return self.stepped(self.held_series, self.passed, phase, end)
        return self.linear(phase, end)

    def change(self, margin: Real, looks: list[mpf]) -> mpf | None:
        """Where on the way over `looks` the margin leaves the range of the mode; the mode is then
        the next one."""
        edge = self.level_of_law
        for before, after in pairwise(looks):
            if self.mode == "law" and margin(after) < edge:
                self.mode = "held"
                return zero(lambda t: margin(t) - edge, before, after)
            if self.mode == "held" and margin(after) > edge:
                self.mode = "law"
                return zero(lambda t: margin(t) - edge, before, after)
            if self.mode == "held" and margin(after) < 0:
                self.mode = "open"
                return zero(margin, before, after)
        return None

    def passed(self, u: list[int], phase: mpf, step: mpf) -> mpf | None:
        """The part of a step after which the mode changes, None if it does not."""

        def margin(t: mpf) -> mpf:
            return self.margin(phase + t, evaluate(u, t) / ONE)

        begin, worn = margin(mpf(0)), (evaluate(u, step) - u[0]) / ONE
        left = min(abs(begin - self.level_of_law), abs(begin) if self.mode == "held" else 1)
        if left > self.steepest * step + self.widening * worn:
            return None
        return self.change(margin, [step * k / LOOKS for k in range(LOOKS + 1)])

    def held_series(self, phase: mpf) -> tuple[list[int], int]:
        """Taylor coefficients of the wear while contact lies at its edge; the rate of its decay."""
        load, rate = self.displacement(phase), int(mpmath.nint(self.stiff * ONE))
        u, one, two, s = [self.wear], [], [], []
        for k in range(ORDER):
            self.roughen(u, one, two, s)
            margin = load[k] + 3 * s[k] - (self.gap * u[k] >> BITS)
            margin -= self.closure if k == 0 else 0
            u.append((rate * margin >> BITS) // (k + 1))
        decay = abs(self.stiff * self.reach_slope(mpf(self.wear) / ONE))
        return u, int(mpmath.nint(decay * ONE))

    def linear(self, phase: mpf, end: mpf) -> mpf:
        """Contact at its edge with one rough solid, in closed form: m' = U_a' - decay m."""
        slope = self.reach_slope(mpf(self.wear) / ONE)
        decay = -self.stiff * slope
        begin = self.margin(phase, mpf(self.wear) / ONE)
        forced = self.forced(decay, phase)
        rest = begin - forced(mpf(0))

        def margin(t: mpf) -> mpf:
            return forced(t) + rest * mpmath.exp(-decay * t)

        halvings = LAYERS * (8 + int(mpmath.ceil(mpmath.log(1 + abs(decay), 2))))
        length = end - phase
        looks = [length * mpf(2) ** (-mpf(k) / LAYERS) for k in range(halvings, 0, -1)]
        looks += [length * k / SAMPLES for k in range(SAMPLES + 1)]
        found = self.change(margin, sorted(looks))
        t = length if found is None else found
        # Of the margin, what the load does not do the wear does.
        if slope:
            gained = (margin(t) - begin - self.load(phase + t) + self.load(phase)) / slope
            self.wear += int(mpmath.nint(gained * ONE))
        else:
            self.wear += int(mpmath.nint(self.stiff * mpmath.quad(margin, [0, t]) * ONE))
        return end if found is None else phase + found

    def forced(self, decay: mpf, phase: mpf) -> Real:
        """A solution of m' = U_a' - decay m, of the time since a phase."""
        if self.data.rows:
            speed = self.speed(phase)
            return lambda t: speed / decay if decay else speed * t
        harmonics = []
        for n, (c, s) in self.harmonics():
            turn = 2 * mpmath.pi * n
            harmonics.append((turn, mpmath.mpc(c, -s) / self.unit))

        def solution(t: mpf) -> mpf:
            total = mpf(0)
            for turn, amplitude in harmonics:
                spin = mpmath.mpc(0, turn)
                total += (amplitude * mpmath.exp(spin * (phase + t)) * spin / (spin + decay)).real
            return total

        return solution
