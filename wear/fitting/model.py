"""The wear of all specimens as a function of the free parameters, with its exact derivatives."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from wear.faults import UsageError
from wear.fitting.readings import FloatArray, Specimen

if TYPE_CHECKING:
    from wear.scene import Scene

REAL = (
    "roughness_growth",
    "value_mm",
    "mean_mm",
)  # these may have either sign; others are positive
RTOL = 1e-8  # of the wear: far below any scatter


@dataclass(frozen=True)
class Parameter:
    """A free entry of the scene, of one specimen or (empty name) of all."""

    key: str
    specimen: str = ""

    @property
    def positive(self) -> bool:
        """Return whether it is estimated in its logarithm."""
        return self.key.split(".")[-1] not in REAL

    def __str__(self) -> str:
        return f"{self.key} ({self.specimen})" if self.specimen else self.key


@dataclass(frozen=True)
class Model:
    """Specimens, the scene they share, and what is free in it.

    A point `theta` (p,) holds each parameter, in its logarithm where it is positive.
    """

    scene: Scene
    specimens: tuple[Specimen, ...]
    free: tuple[str, ...]
    free_each: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        faults = []
        keys = [*self.free, *self.free_each]
        for key in dict.fromkeys(keys):
            if keys.count(key) > 1:
                faults.append(f"free: {key} is named twice")
            if any(key in specimen.changes for specimen in self.specimens):
                faults.append(f"free: {key} is given by the data")
            if not isinstance(self.given(key), float):
                faults.append(f"free: {key}: this scene has no such number")
        if not keys:
            faults.append("free: name at least one key")
        readings = sum(len(specimen.cycles) for specimen in self.specimens)
        if readings < len(self.parameters):
            faults.append(f"{readings} readings are fewer than {len(self.parameters)} parameters")
        if faults:
            raise UsageError("\n".join(faults))

    @cached_property
    def parameters(self) -> tuple[Parameter, ...]:
        """Return the free parameters, the shared ones first."""
        each = [Parameter(key, s.name) for key in self.free_each for s in self.specimens]
        return (*(Parameter(key) for key in self.free), *each)

    def given(self, key: str) -> object:
        """Return the value that the scene has for a key, None if it has none."""
        table, _, entry = key.partition(".")
        return dict(self.scene.to_tables().get(table, {})).get(entry)

    def scenes(self, theta: FloatArray) -> list[Scene]:
        """Return the scene of every specimen."""
        values = dict(zip(self.parameters, self.values(theta), strict=True))
        return [
            self.scene.with_(
                dict(specimen.changes)
                | {p.key: v for p, v in values.items() if p.specimen in ("", specimen.name)}
            )
            for specimen in self.specimens
        ]

    def values(self, theta: FloatArray) -> list[float]:
        """Return the parameters themselves, in the units of their keys."""
        return [
            float(np.exp(x)) if p.positive else float(x)
            for p, x in zip(self.parameters, theta, strict=True)
        ]

    def point(self, values: Sequence[float]) -> FloatArray:
        """Return the point at which the parameters have these values."""
        pairs = zip(self.parameters, values, strict=True)
        return np.array([np.log(v) if p.positive else v for p, v in pairs])

    def wear(
        self, theta: FloatArray, cycles: Sequence[FloatArray]
    ) -> tuple[FloatArray, FloatArray]:
        """Return the logarithm of the wear of every specimen after its cycles, one after the other
        (n,), and its derivatives with respect to theta (n, p)."""
        from wear.sensitivity import gradients

        keys = [*self.free, *self.free_each]
        wanted = np.unique(np.concatenate(cycles))
        found = gradients(self.scenes(theta), keys, wanted, RTOL)
        level, slopes = [], []
        values = np.array(self.values(theta))
        for place, (specimen, own) in enumerate(zip(self.specimens, cycles, strict=True)):
            at = np.searchsorted(wanted, own)
            u = found.u_c[place, at]
            slope = np.zeros((len(own), len(self.parameters)))
            for column, parameter in enumerate(self.parameters):
                if parameter.specimen in ("", specimen.name):
                    scale = values[column] if parameter.positive else 1.0
                    key = keys.index(parameter.key)
                    slope[:, column] = scale * found.derivative[place, key, at] / u
            level.append(np.log(u))
            slopes.append(slope)
        return np.concatenate(level), np.concatenate(slopes)
