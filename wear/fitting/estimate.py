"""`fit`: the parameters of a scene from measured wear, and how certain they are.

Residuals are those of the logarithm of the wear, of one unknown scatter, or those of the wear over
its standard error. Intervals are profile likelihoods (W. Q. Meeker, L. A. Escobar, *Statistical
Methods for Reliability Data*, Wiley 1998, chapter 8): an end that the data leave open is infinite.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from wear.faults import UsageError
from wear.fitting.model import Model, Parameter
from wear.fitting.readings import FloatArray, Specimen, read_readings

if TYPE_CHECKING:
    from pathlib import Path

    from wear.scene import Scene

CONFIDENCE = 0.95
UNKNOWN = 1.0  # standard error of a logarithm, or share of a value, from which it is undetermined
ALIKE = 0.1  # relative spread of powers that are told as one
NEGLIGIBLE = 0.01  # power
FARTHEST = 20.0  # e-folds, or standard errors, beyond which an interval is open
FLAT = 0.02  # of the slope that the deviance has at the estimate: then it rises no more
NEAR = 0.01  # of the quantile: how closely the end of an interval is sought
MOST_CUTS = 6
STARTS = (0.03, 1.0, 30.0)  # times the wear coefficients of the scene
GROWTHS = (0.08, 0.125, 0.25, 0.4)  # roughness growths that starts are tried at
BEST = 2  # of the starts that are followed


class Profile(NamedTuple):
    """Profile likelihood of one parameter: values (n,) ascending, the root of the deviance at each
    in standard deviations (n,), and the interval in which it is below its 95 % quantile."""

    values: FloatArray
    roots: FloatArray
    interval: tuple[float, float]


@dataclass(frozen=True)
class Fit:
    """Parameters estimated from measured wear.

    `theta` (p,) holds the estimates, in logarithms where positive; `covariance` (p, p) theirs;
    `residuals` (n,) over the scatter where that is known, else of the logarithm of the wear.
    """

    model: Model
    relative: bool
    theta: FloatArray
    residuals: FloatArray
    jacobian: FloatArray
    profiles: tuple[Profile, ...] = ()

    @property
    def intervals(self) -> list[tuple[float, float]]:
        """Return the 95 % intervals of the estimates, infinite or zero where an end is open."""
        return [profile.interval for profile in self.profiles]

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """Return the parameters that were free."""
        return self.model.parameters

    @property
    def estimates(self) -> list[float]:
        """Return the estimates in the units of their keys."""
        return self.model.values(self.theta)

    @property
    def degrees_of_freedom(self) -> int:
        """Return the number of readings less that of parameters."""
        return len(self.residuals) - len(self.theta)

    @property
    def chi_square(self) -> float:
        """Return the sum of the squared residuals."""
        return float(self.residuals @ self.residuals)

    @property
    def scatter(self) -> float:
        """Return the standard deviation of a residual: estimated, or 1 where it was given."""
        return (
            float(np.sqrt(self.chi_square / max(self.degrees_of_freedom, 1))) if self.free else 1.0
        )

    @property
    def free(self) -> bool:
        """Return whether the scatter was unknown."""
        return any(s.standard_error_mm is None for s in self.model.specimens)

    @property
    def rms(self) -> float:
        """Return the root mean square of the residuals."""
        return float(np.sqrt(np.mean(self.residuals**2)))

    @cached_property
    def covariance(self) -> FloatArray:
        """Return the covariance of theta; what the data do not determine at all is huge."""
        _, values, vectors = np.linalg.svd(self.jacobian, full_matrices=False)
        least = np.maximum(values, 1e-12 * values[0])
        return np.asarray((vectors.T / least**2) @ vectors * self.scatter**2)

    @property
    def standard_errors(self) -> list[float]:
        """Return the standard errors of the estimates, in the units of their keys."""
        errors = np.sqrt(np.diag(self.covariance))
        pairs = zip(self.parameters, self.estimates, errors, strict=True)
        return [float(e * v if p.positive else e) for p, v, e in pairs]

    @property
    def correlation(self) -> FloatArray:
        """Return the correlation of the estimates (p, p)."""
        errors = np.sqrt(np.diag(self.covariance))
        return np.asarray(self.covariance / np.outer(errors, errors))

    def undetermined(self) -> Iterator[tuple[dict[str, float], str]]:
        """Yield every combination of parameters that the data leave open, and a sentence on it.

        A direction of theta is left open where its standard error is a factor e or more.
        """
        _, values, vectors = np.linalg.svd(self.jacobian, full_matrices=False)
        for value, vector in zip(values, vectors, strict=True):
            if value * UNKNOWN > self.scatter:
                continue
            scaled = vector / vector[np.argmax(np.abs(vector))]
            powers = _by_key(self.parameters, scaled)
            yield powers, _sentence(powers, self.scatter / max(value, 1e-300))

    def forecast(self, cycles: Sequence[float]) -> Iterator[Forecast]:
        """Yield the wear of every specimen after numbers of cycles, with its 95 % band."""
        wanted = np.array(cycles, dtype=float)
        level, slope = self.model.wear(self.theta, [wanted] * len(self.model.specimens))
        spread = self.quantile * np.sqrt(np.einsum("ij,jk,ik->i", slope, self.covariance, slope))
        rows = zip(level, spread, strict=True)
        for specimen in self.model.specimens:
            for number in wanted:
                middle, width = next(rows)
                ends = np.exp([middle, middle - width, middle + width]).tolist()
                yield Forecast(specimen.name, float(number), ends[0], (ends[1], ends[2]))

    def life(self, wear_mm: float) -> Iterator[Life]:
        """Yield the number of cycles to a wear depth of every specimen, with its 95 % band.

        The logarithm of the number has the standard error of that of the wear, over the slope of
        the one against the other.
        """
        from wear.cycles import cycles_until

        for place, scene in enumerate(self.model.scenes(self.theta)):
            number = float(cycles_until(scene, wear_mm))
            name = self.model.specimens[place].name
            if not np.isfinite(number):
                yield Life(name, wear_mm, np.inf, (np.nan, np.inf))
                continue
            around = np.unique(np.round(number * np.array([0.98, 1.0, 1.02])))
            level, slope = self.model.wear(self.theta, [around] * len(self.model.specimens))
            own = slice(place * len(around), (place + 1) * len(around))
            steepness = np.polyfit(np.log(around), level[own], 1)[0]
            gradient = slope[own][len(around) // 2] / steepness
            width = self.quantile * np.sqrt(gradient @ self.covariance @ gradient)
            ends = (number * np.exp(-width), number * np.exp(width))
            yield Life(name, wear_mm, number, (float(ends[0]), float(ends[1])))

    def next_reading(self, cycles: float) -> tuple[float, float]:
        """Return after how many cycles one more reading of every specimen would narrow the forecast
        after `cycles` most, and by which factor."""
        candidates = np.unique(np.round(np.geomspace(1.0, cycles, 25)))
        slots = [np.append(candidates, cycles)] * len(self.model.specimens)
        _, slope = self.model.wear(self.theta, slots)
        slope = slope.reshape(len(slots), len(candidates) + 1, -1)
        target = slope[:, -1]
        before = np.einsum("ij,jk,ik->", target, self.covariance, target)
        information = np.linalg.pinv(self.covariance)
        after = [
            np.einsum(
                "ij,jk,ik->",
                target,
                np.linalg.pinv(information + g.T @ g / self.scatter**2),
                target,
            )
            for g in np.moveaxis(slope[:, :-1], 1, 0)
        ]
        best = int(np.argmin(after))
        return float(candidates[best]), float(np.sqrt(after[best] / before))

    @property
    def quantile(self) -> float:
        """Return how many standard deviations a 95 % interval extends."""
        from scipy import stats

        tail = (1.0 + CONFIDENCE) / 2.0
        if self.free:
            return float(stats.t.ppf(tail, max(self.degrees_of_freedom, 1)))
        return float(stats.norm.ppf(tail))


class Forecast(NamedTuple):
    """Wear (mm) of a specimen after a number of cycles, with its 95 % band."""

    specimen: str
    cycles: float
    bearing_wear_mm: float
    interval_95: tuple[float, float]


class Life(NamedTuple):
    """Number of cycles to a wear depth (mm) of a specimen, with its 95 % band."""

    specimen: str
    bearing_wear_mm: float
    cycles: float
    interval_95: tuple[float, float]


def _by_key(parameters: Sequence[Parameter], powers: FloatArray) -> dict[str, float]:
    """Return the power of every parameter that counts; specimens that are alike under their key."""
    found: dict[str, float] = {}
    for key in dict.fromkeys(parameter.key for parameter in parameters):
        own = [(p, x) for p, x in zip(parameters, powers.tolist(), strict=True) if p.key == key]
        values = [x for _, x in own]
        if max(values) - min(values) < ALIKE * max(map(abs, values)):
            found[key] = sum(values) / len(values)
        else:
            found |= {str(p): x for p, x in own}
    return {name: power for name, power in found.items() if abs(power) > NEGLIGIBLE}


def _sentence(powers: dict[str, float], error: float) -> str:
    """Return what it means that the data leave a combination open."""
    factors = [f"{name}^{power:.2g}" if power != 1 else name for name, power in powers.items()]
    if len(factors) == 1:
        return (
            f"The data do not determine {factors[0]}: its standard error is a factor e^{error:.2g}."
        )
    names = list(powers)
    return (
        f"The data do not determine {', '.join(names[:-1])} and {names[-1]} each by itself: the "
        f"wear hardly changes along {' * '.join(factors)}, whose standard error is a factor "
        f"e^{error:.2g}."
    )


def fit(
    data: str | Path | Sequence[Specimen],
    scene: Scene | str,
    free: Sequence[str],
    free_each: Sequence[str] = (),
    *,
    error: str = "relative",
    ignore: Sequence[str] = (),
    intervals: bool = True,
) -> Fit:
    """Estimate entries of a scene from measured wear.

    Parameters
    ----------
    data
        A CSV file, see `read_readings`, or specimens.
    scene
        The scene, its name or path: all that is not free, and where the search starts.
    free, free_each
        Entries that are one value for all specimens, or one for each.
    error
        "relative": residuals of the logarithm; "absolute": of the wear.
    ignore
        Columns of the file to drop.
    intervals
        Whether to follow the profile likelihoods, which takes most of the time.

    Raises
    ------
    UsageError
        with everything that is wrong with the request.
    """
    from wear.scene import load_scene

    if error not in ("relative", "absolute"):
        raise UsageError(f"error: {error!r} is neither relative nor absolute")
    base = load_scene(scene) if isinstance(scene, str) else scene
    read = tuple(data) if not isinstance(data, str) and hasattr(data, "__iter__") else None
    model = Model(base, read or read_readings(data, ignore), tuple(free), tuple(free_each))
    if error == "relative" and any(np.any(s.wear_mm <= 0.0) for s in model.specimens):
        raise UsageError("error: a wear of zero has no logarithm; leave it out, or take absolute")
    problem = _Problem(model, error == "relative")
    theta = min((problem.solve(start) for start in problem.starts()), key=problem.cost)
    residuals, jacobian = problem(theta)
    if not np.all(np.isfinite(residuals)) or np.max(np.abs(residuals)) >= _LOST:
        raise UsageError("no start leads to a scene whose wear has any likeness to the data")
    found = Fit(model, problem.relative, theta, residuals, jacobian)
    if not intervals:
        return found
    return replace(found, profiles=tuple(problem.profile(found, i) for i in range(len(theta))))


_LOST = 1e3  # residual of a scene that has no wear


@dataclass(frozen=True)
class _Problem:
    """The least squares problem: residuals and their exact Jacobian at a point theta."""

    model: Model
    relative: bool

    def __call__(self, theta: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return residuals (n,) and Jacobian (n, p)."""
        specimens = self.model.specimens
        observed = np.concatenate([s.wear_mm for s in specimens])
        try:
            level, slope = self.model.wear(theta, [s.cycles for s in specimens])
        except (ValueError, ArithmeticError):  # beyond the domain of the model
            lost = np.full(len(observed), _LOST)
            return lost, np.zeros((len(lost), len(theta)))
        errors = [s.standard_error_mm for s in specimens]
        scatter = 1.0 if any(e is None for e in errors) else np.concatenate(errors)  # type: ignore[arg-type]
        wear = np.exp(level)
        if self.relative:
            weight = np.ones(len(wear)) if np.ndim(scatter) == 0 else observed / scatter
            difference, jacobian = weight * (level - np.log(observed)), weight[:, None] * slope
        else:
            weight = np.ones(len(wear)) / scatter
            difference = weight * (wear - observed)
            jacobian = (weight * wear)[:, None] * slope
        fine = np.isfinite(difference) & np.all(np.isfinite(jacobian), axis=1)
        return np.where(fine, difference, _LOST), np.where(fine[:, None], jacobian, 0.0)

    def cost(self, theta: FloatArray) -> float:
        """Return the sum of the squared residuals."""
        residuals, _ = self(theta)
        return float(residuals @ residuals)

    def starts(self) -> list[FloatArray]:
        """Return points to start from: the best of a few wear coefficients and growths, with
        lengths of each specimen in proportion to its wear."""
        deepest = np.array([s.wear_mm[-1] for s in self.model.specimens])
        relative = dict(zip((s.name for s in self.model.specimens),
                            deepest / np.exp(np.mean(np.log(deepest))), strict=True))  # fmt: skip
        points = []
        for factor in STARTS:
            for growth in GROWTHS:
                values = []
                for parameter in self.model.parameters:
                    value = float(str(self.model.given(parameter.key)))
                    if parameter.key.endswith("wear_coefficient"):
                        value *= factor
                    elif parameter.key.endswith("roughness_growth"):
                        value = growth
                    elif parameter.specimen and parameter.key.endswith("_mm"):
                        value *= float(relative[parameter.specimen])
                    values.append(value)
                points.append(self.model.point(values))
        return sorted(points, key=self.cost)[:BEST]

    def solve(self, start: FloatArray, held: int | None = None) -> FloatArray:
        """Return the point of least squares from a start, with one parameter held if need be."""
        from scipy.optimize import least_squares

        moving = np.array([i for i in range(len(start)) if i != held])
        memory: dict[bytes, tuple[FloatArray, FloatArray]] = {}

        def at(part: FloatArray) -> tuple[FloatArray, FloatArray]:
            theta = start.copy()
            theta[moving] = part
            key = theta.tobytes()
            if key not in memory:
                memory.clear()
                memory[key] = self(theta)
            return memory[key]

        found = least_squares(
            lambda part: at(part)[0], start[moving], jac=lambda part: at(part)[1][:, moving],
            x_scale="jac", xtol=1e-9, ftol=1e-10, gtol=1e-12, max_nfev=60,
        )  # fmt: skip
        theta = start.copy()
        theta[moving] = found.x
        return theta

    def profile(self, found: Fit, index: int) -> Profile:
        """Return the profile likelihood of a parameter, in its own unit."""
        seen = {0.0: 0.0}
        ends = [self._end(found, index, side, seen) for side in (-1.0, 1.0)]
        steps = np.array(sorted(seen))
        theta = found.theta[index] + np.concatenate([ends, steps])
        values = np.exp(theta) if found.parameters[index].positive else theta
        roots = np.array([seen[step] for step in steps.tolist()])
        return Profile(values[2:], roots, (float(values[0]), float(values[1])))

    def _end(self, found: Fit, index: int, side: float, seen: dict[float, float]) -> float:
        """Return the step at which the root of the deviance passes its 95 % quantile on one side,
        infinite where it does not; what is evaluated on the way goes into `seen`."""
        error = float(np.sqrt(found.covariance[index, index]))
        limit, path = found.quantile, found.covariance[:, index] / error**2
        farthest = FARTHEST * (1.0 if found.parameters[index].positive else error)

        def root(step: float) -> float:
            start = found.theta + side * step * path
            theta = self.solve(start, held=index) if len(path) > 1 else start
            deviance = max(self.cost(theta) - found.chi_square, 0.0)
            seen[side * step] = float(np.sqrt(deviance)) / found.scatter
            return seen[side * step]

        inner, below, outer = 0.0, 0.0, min(limit * error, farthest)
        while (above := root(outer)) < limit:
            if outer >= farthest or above < FLAT * limit * outer / (limit * error):
                return side * np.inf
            inner, below = outer, above
            outer = min(outer * min(2.0, 1.1 * limit / above), farthest)
        for _ in range(MOST_CUTS):
            if above < (1.0 + NEAR) * limit:
                break
            middle = inner + (outer - inner) * (limit - below) / (above - below)
            at = root(middle)
            if at < limit * (1.0 - NEAR):
                inner, below = middle, at
            else:
                outer, above = middle, at
        return side * outer
