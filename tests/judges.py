"""Which judge a scene needs, what it finds, and what it says of an estimate."""

import math
from collections.abc import Sequence
from typing import Any

import mpmath
import numpy as np

from tests.independent import Judge, Problem, wear_after
from tests.independent_loss_of_contact import CutoffJudge
from tests.independent_support import SupportJudge
from wear.load import Harmonics, Sine, Table
from wear.numerics.gauss import FloatArray
from wear.scene import Scene

ROUNDING = 3e-15  # below, an error needs no estimate


def problem(scene: Scene) -> Problem:
    """The same scene, for the independent integrator."""
    p = scene.parameters()
    speed = math.pi * p["R"] * p["n"] / 30
    load = scene.periodic_load
    rows: tuple[tuple[float, float], ...] = ()
    mean, cosine, sine = 0.0, (), ()
    if isinstance(load, Table):
        rows = tuple(
            (t / load.period, U) for t, U in zip(load.times_s, load.values_mm, strict=True)
        )
    elif isinstance(load, Harmonics):
        mean, cosine, sine = load.mean_mm, load.cosine_mm, load.sine_mm
    elif isinstance(load, Sine):
        sine = (load.amplitude_mm,)
    else:
        mean = load.mean
    pin = "K_a" in p
    return Problem(
        wear_rate=p["K_c"] * speed * p["p_max"] / (3 * p["H_c"]),
        roughness=p["sigma_c0"],
        slope=p["f_c"],
        closure=p["h_0"],
        period=load.period,
        mean=mean,
        cosine=cosine,
        sine=sine,
        pin_roughness=p.get("sigma_a0", 0.0),
        pin_slope=p.get("f_a", 0.0),
        kappa=p["K_a"] * p["H_c"] / (p["K_c"] * p["H_a"]) if pin else 0.0,
        sign=1 if scene.contact.pin_wear_opens_gap else -1,
        deflection=p["p_max"] / p["k"] if "k" in p else 0.0,
        exponential=scene.contact.law == "exponential",
        rows=rows,
    )


def judge_of(scene: Scene) -> type[Judge]:
    """The judge that a scene needs."""
    if not scene.contact.ends_at_3_sigma:
        return Judge
    return CutoffJudge if scene.support is None else SupportJudge


def true_wear(scene: Scene, cycles: Sequence[int]) -> FloatArray:
    """The wear (mm) after some cycles, by the judge that the scene needs."""
    found = wear_after(judge_of(scene)(problem(scene)), cycles)
    return np.array([found[cycle] for cycle in cycles])


def honest(wear: FloatArray, error: FloatArray, want: FloatArray, missed: Any = 0.0) -> bool:
    """Whether relative errors are within estimates, what the reference misses, or rounding."""
    true = np.abs(wear / want - 1)
    return bool(np.all((true <= error + missed) | (true < ROUNDING)))


def static_wear(scene: Scene, cycles: FloatArray, near: FloatArray) -> FloatArray:
    """The wear (mm) after numbers of cycles under a constant load, rigid support, bearing wear
    only: the roots near some wears of the closed solution, typed here on purpose."""
    p, load = scene.parameters(), scene.periodic_load.mean
    f = p["f_c"]
    with mpmath.workdps(80 + int(4 / abs(f))):
        sigma, f, h = map(mpmath.mpf, (p["sigma_c0"], f, p["h_0"]))
        most = mpmath.mpf(math.pi) * p["K_c"] * p["R"] * p["T"] * p["n"] * p["p_max"]
        b = 2 * (sigma / f - h + load)

        def primitive(s: Any) -> Any:
            return s * mpmath.exp(-2 * b / s) + 2 * b * mpmath.ei(-2 * b / s)

        def count(u: Any) -> Any:
            gap = mpmath.exp(4 / f - 8) / f * (primitive(sigma + f * u) - primitive(sigma))
            return (u + gap) * 90 * mpmath.mpf(p["H_c"]) / most

        def wear(n: float, start: float) -> float:
            if n == 0:
                return 0.0
            u = mpmath.mpf(start)
            return float(
                mpmath.findroot(lambda u: count(u) / n - 1, (u, u * (1 + 1e-6)), tol=1e-40)
            )

        return np.vectorize(wear, otypes=[float])(cycles, near)
