"""Posterior of the parameters by an ensemble sampler whose walkers are one batch of scenes."""

from __future__ import annotations

from importlib.util import find_spec
from numbers import Integral
from typing import Any

import numpy as np

from wear.faults import UsageError
from wear.fitting.estimate import PARAMETER_RANGE, Estimate
from wear.numerics.gauss import FloatArray

WALKERS = 4  # a parameter, and no fewer than LEAST_WALKERS
LEAST_WALKERS = 32
MOST_STEPS = 10**6
BURN_IN = 0.3  # share of the steps that is dropped
SPREAD = 0.3  # of the walkers' starts, in standard errors and at most in sizes


def posterior(found: Estimate, steps: int, seed: int = 0) -> FloatArray:
    """Return samples (m, p) of the posterior, in the units of the keys.

    Priors are flat in theta (logarithms of positive parameters) within factors of e^7, or seven
    times the size; an unknown scatter has Jeffreys' prior and is integrated out (A. Gelman et al.,
    *Bayesian Data Analysis*, CRC 2013, chapter 3). The sampler is that of D. Foreman-Mackey et al.,
    PASP 125, 306 (2013).

    Parameters
    ----------
    found
        The fit or estimate, around which the walkers start.
    steps
        Steps of every walker; the first 30 % are dropped.
    seed
        Of the random numbers.

    Raises
    ------
    UsageError
        if emcee is not installed, or an argument is of the wrong kind.
    """
    if not isinstance(found, Estimate):
        raise UsageError("a posterior needs a fit; give the result of wear.fit")
    bounds: dict[str, tuple[Any, int, int]] = {
        "steps": (steps, 1, MOST_STEPS),
        "seed": (seed, 0, 2**32 - 1),
    }
    for name, (number, least, most) in bounds.items():
        if not isinstance(number, Integral) or not least <= int(number) <= most:
            raise UsageError(f"{name}: {number!r} is not a whole number from {least} to {most}")
    if not find_spec("emcee"):
        raise UsageError("a posterior needs emcee: pip install 'derive-wear[fit]'")
    import emcee

    interrupts: list[KeyboardInterrupt] = []

    def log_density(points: FloatArray) -> FloatArray:
        try:
            return log_posterior(points)
        except KeyboardInterrupt as interrupt:  # of which emcee would print a traceback
            interrupts.append(interrupt)
            return np.full(len(points), np.finfo(float).min / 4)  # of which emcee makes differences

    def log_posterior(points: FloatArray) -> FloatArray:
        inside = np.all(np.abs(points - found.theta) < PARAMETER_RANGE * found.scale, axis=1)
        density = np.full(len(points), -np.inf)
        if inside.any():
            square = found.model.cost(points[inside])
            n = len(found.residuals)
            known = found.model.residuals.known
            density[inside] = -square / 2.0 if known else -n / 2.0 * np.log(square)
        return density

    walkers = max(WALKERS * len(found.theta), LEAST_WALKERS)
    errors, rows = found.directions  # walkers begin along these
    steps_away = np.random.default_rng(seed).standard_normal((walkers, len(errors)))
    begin = found.theta + np.minimum(SPREAD * errors, SPREAD) * steps_away @ rows * found.scale
    sampler = emcee.EnsembleSampler(walkers, len(found.theta), log_density, vectorize=True)
    sampler.random_state = np.random.RandomState(seed).get_state()
    for _ in sampler.sample(begin, iterations=steps):
        if interrupts:
            raise interrupts[0]
    samples = sampler.get_chain(discard=int(BURN_IN * steps), flat=True)
    columns = zip(found.parameters, samples.T, strict=True)
    return np.column_stack([parameter.value(column) for parameter, column in columns])
