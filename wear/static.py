"""Static load: wear and number of cycles in closed form, for any number of cycles.

Under a constant displacement of the pin the number of cycles to a given wear is an integral that is
known in closed form (`derive show static-solution`). On a rigid support it is evaluated by the
exponential integral, scaled so that nothing overflows; where the two ends lie so close that their
difference would cancel, and on a compliant support, by Gauss-Legendre quadrature of the same
integrand, which is smooth there. A cycle is one period of the scene's load, which only serves to
count.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from wear.faults import UsageError
from wear.generated import static_solution as formula
from wear.load import Constant
from wear.model import Model, bind
from wear.numerics.gauss import FloatArray, gauss, mesh
from wear.scene import Scene
from wear.special import ei_remainder

NODES = 24  # Gauss-Legendre: exact to rounding where the integrand changes by a factor e at most
NEAR = 1.0  # change of the integrand's logarithm over which one panel is exact to rounding
UNREACHED = 700.0  # fall of ln p beyond which no number of cycles is a finite double
MOST_ITERATIONS = 200
MOST_REFINEMENTS = 8


@dataclass(frozen=True)
class StaticSolution:
    """The closed solution of one scene with a constant load.

    `data` are the physical parameters by symbol, `load` is U_a in mm. `model` gives the pressure on
    a compliant support; it is None for a rigid one.
    """

    data: Mapping[str, float]
    load: float
    model: Model | None = None

    @property
    def largest_wear(self) -> float:
        """Return the wear of one cycle under the largest pressure, mm."""
        names = ("T", "K_c", "H_c", "p_max", "R", "n")
        return float(formula.largest_wear(**{name: self.data[name] for name in names}))

    @property
    def limit(self) -> float:
        """Return the wear at which the roughness vanishes, mm; infinite where it grows."""
        slope = self.data["f_c"]
        return -self.data["sigma_c0"] / slope if slope < 0.0 else math.inf

    def cycles(self, u: ArrayLike) -> FloatArray:
        """Return the number of cycles to a wear of u mm; infinite if that is never reached.

        The relative error is at most six roundoffs times the condition of the problem: 8 plus
        the larger of the values at the wears 0 and u of

            4 |h|/sigma (sigma_c0 + |f_c| u)/sigma

        where the last factor is one unless the roughness decreases: near the wear at which it
        vanishes sigma = sigma_c0 + f_c u is a small difference. On a rigid support the argument
        of the exponential integral, 4 (h_0 - U_a - sigma_c0/f_c)/sigma, takes their place where it
        is larger and lies between 0 and 40 (see `wear.special`).
        """
        u = np.asarray(u, dtype=np.float64)
        if np.any(u < 0.0):
            raise UsageError("wear is not negative")
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            model = self.model
            gap = self._gap_rigid(u) if model is None else self._gap_compliant(model, u)
            found = formula.cycles(u, gap, M=self.largest_wear)
        return np.where(u < self.limit, found, np.inf)

    def wear(self, cycles: ArrayLike) -> FloatArray:
        """Return the wear in mm after numbers of cycles."""
        wanted = np.atleast_1d(np.asarray(cycles, dtype=np.float64))
        if np.any(wanted < 0.0):
            raise UsageError("a number of cycles is not negative")
        found = np.array([self._wear(float(n)) for n in wanted.ravel()])
        return found.reshape(np.shape(cycles))

    def _wear(self, cycles: float) -> float:
        """Invert `cycles(u)`, which increases, by Newton's method inside a bracket."""
        low, high = 0.0, min(self.largest_wear * cycles, math.nextafter(self.limit, 0.0))
        if cycles == 0.0 or float(self.cycles(high)) <= cycles:
            return high
        u = high
        for _ in range(MOST_ITERATIONS):
            reached = float(self.cycles(u))
            low, high = (u, high) if reached < cycles else (low, u)
            new = u + self._step(u, reached, cycles)
            if not low < new < high:
                new = 0.5 * (low + high)
            if abs(new - u) <= 4e-16 * u or high <= math.nextafter(low, math.inf):
                return new
            u = new
        return u

    def _step(self, u: float, reached: float, wanted: float) -> float:
        """Newton's step towards the wanted cycles, in their logarithm while far away."""
        if not 0.0 < reached < math.inf:
            return math.nan
        if self.model is None:
            slowness = 1.0 + math.exp(min(float(self._exponent(u)), UNREACHED))
        else:
            slowness = float(self._slowness(self.model, np.asarray(u)))
        near = 0.5 * wanted < reached < 2.0 * wanted
        missing = wanted - reached if near else reached * math.log(wanted / reached)
        return missing * self.largest_wear / slowness

    def _named(self, *names: str) -> dict[str, float]:
        return {name: self.data[name] for name in names}

    def _exponent(self, u: ArrayLike) -> FloatArray:
        """Return the exponent ln(p_max/p - 1) at a wear, on a rigid support."""
        shape = self._named("h_0", "sigma_c0", "f_c")
        return np.asarray(formula.exponent(np.asarray(u), self.load, **shape))

    def _gap_rigid(self, u: FloatArray) -> FloatArray:
        """Return the integral of exp(exponent) from 0 to u."""
        start, end = self._exponent(0.0), self._exponent(u)
        closed = self._primitive(u, end) - self._primitive(np.zeros_like(u), start)
        growth = np.log(self._roughness(u) / self._roughness(0.0))
        near = np.abs(end - start) + np.abs(growth) < NEAR
        rule = gauss(NODES)
        inside = np.exp(self._exponent(u[..., np.newaxis] * rule.nodes))
        return np.asarray(np.where(near, u * (inside @ rule.weights), closed))

    def _roughness(self, u: ArrayLike) -> FloatArray:
        return np.asarray(formula.roughness(np.asarray(u), **self._named("sigma_c0", "f_c")))

    def _primitive(self, u: FloatArray, exponent: FloatArray) -> FloatArray:
        """Return a primitive of exp(exponent), by the form that suits the argument of Ei."""
        slope = self.data["f_c"]
        shape = self._named("h_0", "sigma_c0", "f_c")
        offset = np.asarray(formula.offset(u, self.load, **shape))
        roughness = self._roughness(u)
        if slope == 0.0:
            return np.asarray(formula.primitive_far(exponent, roughness, 1.0, offset))
        z = -offset / slope
        remainder = ei_remainder(z)
        far = np.asarray(formula.primitive_far(exponent, roughness, -z * remainder, offset))
        close = np.asarray(formula.primitive(exponent, roughness, remainder, f_c=slope))
        return np.asarray(np.where(np.abs(z) > 1.0, far, close))

    def _gap_compliant(self, model: Model, u: FloatArray) -> FloatArray:
        """Return the integral of p_max/p - 1 from 0 to u, for each u on panels of its own."""
        over = np.vectorize(lambda end: self._over_panels(model, end), otypes=[float])
        return np.asarray(over(u))

    def _over_panels(self, model: Model, end: float) -> float:
        edges = self._edges(model, end)
        if edges is None:
            return math.inf
        over = mesh(edges, NODES)
        return float(over.lengths @ (self._slowness(model, over.phases) - 1.0) @ over.rule.weights)

    def _edges(self, model: Model, end: float) -> FloatArray | None:
        """Cut [0, end] into panels over which ln p changes by at most 1; None if p vanishes."""
        if end >= self.limit:
            return None
        scale = self.data["sigma_c0"]
        count = 1 + math.ceil(2.0 * math.log1p(end / scale))
        edges = scale * np.expm1(np.linspace(0.0, math.log1p(end / scale), count + 1))
        for _ in range(MOST_REFINEMENTS):
            falls = np.abs(np.diff(np.log(self._slowness(model, edges))))
            if not falls.sum() < UNREACHED:
                return None
            parts = np.maximum(1, np.ceil(falls / NEAR)).astype(int)
            if np.all(parts == 1):
                break
            cut = [
                np.linspace(a, b, n, endpoint=False)
                for a, b, n in zip(edges, edges[1:], parts, strict=False)
            ]
            edges = np.concatenate([*cut, edges[-1:]])
        return edges

    def _slowness(self, model: Model, u: FloatArray) -> FloatArray:
        """Return the ratio p_max/p on a compliant support."""
        return np.asarray(self.data["p_max"] / model.pressure(u, self.load))


def static_solution(scene: Scene) -> StaticSolution:
    """Return the closed solution of a scene with a constant load.

    Raises
    ------
    UsageError
        where there is none: another load, a rough or worn pin, a cutoff, another contact law.

    >>> from wear.scene import load_scene
    >>> import dataclasses
    >>> from wear.load import Constant
    >>> scene = load_scene("section4")
    >>> still = dataclasses.replace(scene, load=Constant(0.0, scene.periodic_load.period))
    >>> round(float(static_solution(still).cycles(3e-4)), 8)
    176.49061826
    """
    faults = [
        text
        for text, present in (
            ("its load varies", not isinstance(scene.load, Constant)),
            ("its pin is rough or wears", scene.pin is not None),
            ("its contact ends at h = 3 sigma", scene.contact.ends_at_3_sigma),
            ("its contact law is not tanh", scene.contact.law != "tanh"),
        )
        if present
    ]
    if faults:
        raise UsageError(f"{scene.name} has no closed static solution: {'; '.join(faults)}")
    model = bind(scene) if scene.support is not None else None
    return StaticSolution(scene.parameters(), scene.periodic_load.mean, model)
