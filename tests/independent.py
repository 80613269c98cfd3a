"""An independent judge: Taylor series in fixed-point integers, some 48 digits, by hand.

It integrates the condensed problem (8) with a sum of harmonics or straight lines for U_a, one or
two solids, rigid or compliant support, either contact law, no cutoff. It shares no code and no
method with the package: the equations are typed here on purpose, the arithmetic is Python's
integers, and the step is chosen so that the truncated terms are below 1e-18 of the wear. Slow
(milliseconds a cycle), and sure.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise, zip_longest
from operator import mul

import mpmath

BITS = 160
ONE = 1 << BITS
ORDER = 22


@dataclass(frozen=True)
class Problem:
    """Physical data in mm, s, MPa; `pin` and the two-solid numbers are zero for one worn solid.

    `wear_rate` is K_c V p_max/(3 H_c) in mm/s; `kappa` is u_a/u_c; `sign` is -1 for Eq. (1) as
    printed, +1 where pin wear opens the gap; `deflection` is p_max/k in mm, zero when rigid. With
    `rows`, phases from 0 to 1 and U_a in mm, the load consists of the straight lines between.
    """

    wear_rate: float
    roughness: float
    slope: float
    closure: float
    period: float
    mean: float = 0.0
    cosine: tuple[float, ...] = ()
    sine: tuple[float, ...] = ()
    pin_roughness: float = 0.0
    pin_slope: float = 0.0
    kappa: float = 0.0
    sign: int = -1
    deflection: float = 0.0
    exponential: bool = False
    rows: tuple[tuple[float, float], ...] = ()


def fixed(value: mpmath.mpf | float) -> int:
    """A number as a fixed-point integer."""
    return int(mpmath.nint(mpmath.mpf(value) * ONE))


def times(a: list[int], b: list[int], k: int) -> int:
    """Coefficient k of the product of two series known to order k."""
    return sum(map(mul, a[: k + 1], b[k::-1])) >> BITS


class Judge:
    """State of an integration; lengths in units of the equivalent roughness at the start."""

    def __init__(self, problem: Problem) -> None:
        self.data = problem
        with mpmath.workprec(2 * BITS):
            one, two = mpmath.mpf(problem.roughness), mpmath.mpf(problem.pin_roughness)
            unit = mpmath.sqrt(one**2 + two**2)
            self.unit = unit
            self.drive = fixed(mpmath.mpf(problem.wear_rate) * mpmath.mpf(problem.period) / unit)
            self.one = (fixed(one / unit), fixed(problem.slope))
            kappa = mpmath.mpf(problem.kappa)
            self.two = (fixed(two / unit), fixed(mpmath.mpf(problem.pin_slope) * kappa))
            self.gap = fixed(1 + problem.sign * kappa)
            self.closure = fixed(mpmath.mpf(problem.closure) / unit)
            self.deflection = fixed(mpmath.mpf(problem.deflection) / unit)
            rows = problem.rows or ((0.0, 0.0), (1.0, 0.0))
            self.kinks = [(mpmath.mpf(at), mpmath.mpf(value) / unit) for at, value in rows]
        # z = level - steep h/sigma is ln p, and with tanh logit p, in units of p_max.
        self.level, self.steep = (0, 1) if problem.exponential else (8, 4)
        self.wear = 0

    def harmonics(self) -> Iterable[tuple[int, tuple[float, float]]]:
        """The order of each harmonic of the load with its cosine and sine."""
        return enumerate(zip_longest(self.data.cosine, self.data.sine, fillvalue=0.0), 1)

    def displacement(self, phase: mpmath.mpf) -> list[int]:
        """Taylor coefficients of U_a in phase."""
        if self.data.rows:
            return self.line(phase)
        with mpmath.workprec(BITS + 60):
            series = [mpmath.mpf(0)] * (ORDER + 1)
            series[0] = mpmath.mpf(self.data.mean)
            for n, (c, s) in self.harmonics():
                omega = 2 * mpmath.pi * n
                cos, sin = mpmath.cos(omega * phase), mpmath.sin(omega * phase)
                c, s = mpmath.mpf(c), mpmath.mpf(s)
                derivative = (c * cos + s * sin, s * cos - c * sin)
                factor = mpmath.mpf(1)
                for k in range(ORDER + 1):
                    if k:
                        factor *= omega / k
                    sign = -1 if k % 4 in (2, 3) else 1
                    series[k] += sign * factor * derivative[k % 2]
            return [fixed(value / self.unit) for value in series]

    def line(self, phase: mpmath.mpf) -> list[int]:
        """Taylor coefficients of U_a on the straight line that starts at the phase or before."""
        with mpmath.workprec(BITS + 60):
            pairs = pairwise(self.kinks)
            (start, first), (end, last) = next(pair for pair in pairs if phase < pair[1][0])
            speed = (last - first) / (end - start)
            return [fixed(first + speed * (phase - start)), fixed(speed), *[0] * (ORDER - 1)]

    def series(self, phase: mpmath.mpf) -> tuple[list[int], int]:
        """Taylor coefficients of the wear in phase, from the present wear; the slope of z."""
        load, u = self.displacement(phase), [self.wear]
        one, two, s, w, z, q, g = ([] for _ in range(7))
        for k in range(ORDER):
            self.roughen(u, one, two, s)
            closure = (self.closure if k == 0 else 0) + (self.gap * u[k] >> BITS) - load[k]
            if k == 0:
                z0, q0 = self.start(closure, s[0])
                z.append(z0)
                w.append((self.level * ONE - z0) // self.steep)
                q.append(q0)
            else:
                rest = sum(j * z[j] * g[k - j] for j in range(1, k)) // k >> BITS
                known = closure + (self.deflection * rest >> BITS)
                known -= sum(s[j] * w[k - j] for j in range(1, k + 1)) >> BITS
                stiff = s[0] + (self.steep * g[0] * self.deflection >> BITS)
                w.append((known << BITS) // stiff)
                z.append(-self.steep * w[k])
                q.append((g[0] * z[k] >> BITS) + rest)
            g.append(q[k] - (0 if self.data.exponential else times(q, q, k)))
            u.append((self.drive * q[k] >> BITS) // (k + 1))
        return u, abs(z[1])

    def roughen(self, u: list[int], one: list[int], two: list[int], s: list[int]) -> None:
        """Append the next coefficients of both roughnesses and of the equivalent one."""
        k = len(s)
        for part, (start, slope) in ((one, self.one), (two, self.two)):
            part.append((start if k == 0 else 0) + (slope * u[k] >> BITS))
        square = times(one, one, k) + times(two, two, k)
        if k == 0:
            s.append(int(mpmath.floor(mpmath.sqrt(mpmath.mpf(square) * ONE))))
        else:
            cross = sum(s[i] * s[k - i] for i in range(1, k)) >> BITS
            s.append(((square - cross) << (BITS - 1)) // s[0])

    def start(self, closure: int, s: int) -> tuple[int, int]:
        """z and p/p_max: closed when rigid, else one monotone root."""
        with mpmath.workprec(BITS + 60):
            a = self.level - self.steep * mpmath.mpf(closure) / s
            b = self.steep * mpmath.mpf(self.deflection) / s
            if self.data.exponential:
                q = mpmath.lambertw(b * mpmath.exp(a)).real / b if b else mpmath.exp(a)
                return fixed(a - b * q), fixed(q)
            low, high = a - b, a
            z = a if not b else low
            if b:
                for _ in range(60):
                    z = (low + high) / 2
                    if z + b / (1 + mpmath.exp(-z)) > a:
                        high = z
                    else:
                        low = z
                for _ in range(6):
                    y = 1 / (1 + mpmath.exp(-z))
                    z -= (z + b * y - a) / (1 + b * y * (1 - y))
            return fixed(z), fixed(1 / (1 + mpmath.exp(-z)))

    def cycle(self) -> None:
        """One period."""
        with mpmath.workprec(BITS + 60):
            for (begin, _), (end, _) in pairwise(self.kinks):
                self.smooth(begin, end)

    def smooth(self, phase: mpmath.mpf, end: mpmath.mpf) -> None:
        """A part of a cycle without a kink, in steps of 2^-e but for the last."""
        e = 4
        while phase < end:
            u, slope = self.series(phase)
            while True:
                # The radius shows in the last terms; two of them, lest one vanish.
                last = max(abs(u[-1]) >> e * ORDER, abs(u[-2]) >> e * (ORDER - 1))
                scale = self.wear + (abs(u[1]) >> e)
                # Where p is saturated its terms are too small to show the pulse that comes.
                if last <= scale >> 62 and slope >> e < 3 * ONE:
                    break
                e += 1
            step = min(mpmath.mpf(2) ** -e, end - phase)
            total, part = 0, fixed(step)
            for coefficient in reversed(u):
                total = (total * part >> BITS) + coefficient
            self.wear = total
            phase = phase + step if step < end - phase else end
            easy = last <= scale >> 88 and slope >> e < ONE
            if e > 4 and easy and (phase * 2 ** (e - 1)) % 1 == 0:
                e -= 1


def wear_after(judge: Judge, cycles: Iterable[int]) -> dict[int, float]:
    """u_c in mm at the end of each of `cycles`, to double precision."""
    done, found = 0, {}
    for wanted in sorted(cycles):
        while done < wanted:
            before = judge.wear
            judge.cycle()
            done = wanted if judge.wear == before else done + 1
        with mpmath.workprec(BITS):
            found[wanted] = float(mpmath.mpf(judge.wear) / ONE * judge.unit)
    return found
