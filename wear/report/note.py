"""The examples of the note: scenes and asymptotes, each made once, and what the note prints."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from wear.equation import equation_of
from wear.orbit.period_map import resolved, settings
from wear.regime import Asymptote, asymptote
from wear.scene import Scene, load_scene
from wear.solver import solve

FloatArray = NDArray[np.float64]
Some = TypeVar("Some")

EXAMPLES = ("section3", "section4", "section5")
SECTION_5 = ("section5-k1e-7", "section5", "section5-k1e-5", "section5-k1e-4")
"""The scenes of Fig. 3b, by rising wear coefficient."""
CUTOFF = ".cutoff"
"""What the name of an example ends in with loss of contact."""
RTOL = 1e-12
"""Requested relative error of the analysis."""


class Printed(NamedTuple):
    """Numbers that the note prints for section 4."""

    simulated_mm: float = 2.34e-5
    formula_mm: float = 2.35e-5
    cycles: int = 9000
    criterion: float = 1e-6


PRINTED = Printed()


@cache
def scene(name: str) -> Scene:
    """Return an example."""
    ends = name.endswith(CUTOFF)
    return load_scene(name.removesuffix(CUTOFF), ["contact.ends_at_3_sigma=true"] * ends)


@cache
def limit(name: str) -> Asymptote:
    """Return the asymptote of an example."""
    return asymptote(scene(name))


def required(value: Some | None) -> Some:
    """Return a constant that the regime of the scene has, else the report speaks of another."""
    if value is None:
        raise ValueError("the report speaks of a constant that this regime does not have")
    return value


def increments(scene: Scene, wear: FloatArray) -> FloatArray:
    """Return the wear (mm) that one more cycle adds to each wear (mm): integrated, not
    subtracted."""
    equation, size = equation_of([scene]), settings(RTOL)
    ((_, maps),) = resolved(equation, equation.breakpoints, wear[None], size)
    return np.asarray(maps.finer(size).advance(wear[None]).increment[0])


def increments_after(scene: Scene, *cycles: int) -> FloatArray:
    """Return the wear (mm) of the cycle that follows each number of cycles."""
    return increments(scene, solve(scene, cycles, rtol=RTOL).u_c)
