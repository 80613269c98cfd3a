"""The wear of all specimens as a function of the free parameters, with its exact derivatives."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from wear.cycles import sweep
from wear.faults import Faults, SceneError, UsageError
from wear.fitting.readings import Specimen, read_readings, readings_of
from wear.fitting.residuals import Residuals
from wear.load.spans import most_cycles
from wear.numerics.gauss import BoolArray, FloatArray, IntArray
from wear.parameters import no_such_number, parameters_of
from wear.scene import Scene, as_scene
from wear.sensitivities import gradients
from wear.words import are_texts

RTOL = 1e-7  # of the wear: far below any scatter


@dataclass(frozen=True)
class Parameter:
    """A free entry of the scene, of one specimen or (empty name) of all; if it must be positive,
    its logarithm is estimated."""

    key: str
    specimen: str
    positive: bool

    def __str__(self) -> str:
        return f"{self.key} ({self.specimen})" if self.specimen else self.key

    def value(self, theta: FloatArray) -> FloatArray:
        """Return the entry in the unit of its key."""
        return np.exp(theta) if self.positive else np.asarray(theta)

    def theta(self, value: float) -> float:
        """Return the value, or its logarithm where that is estimated."""
        return float(np.log(value)) if self.positive else value


class Linearised(NamedTuple):
    """A model at points `theta` (m, p): its residuals (m, n), and their Jacobian `slope`
    (m, n, p)."""

    theta: FloatArray
    residuals: FloatArray
    slope: FloatArray

    @property
    def costs(self) -> FloatArray:
        """Return the sums of the squared residuals (m,)."""
        return np.asarray(np.sum(self.residuals**2, axis=1))

    def with_rows(self, rows: IntArray | BoolArray, others: Linearised) -> Linearised:
        """Return these points with `others` in place of some."""
        arrays = [array.copy() for array in self]
        for array, values in zip(arrays, others, strict=True):
            array[rows] = values
        return Linearised(*arrays)


@dataclass(frozen=True)
class FitModel:
    """Specimens, their common scene, and its free parameters: the residuals as a function of these.

    A point `theta` (p,) holds the parameters, positive ones as logarithms. Errors are `relative` to
    the wear or absolute.
    """

    scene: Scene
    specimens: tuple[Specimen, ...]
    parameters: tuple[Parameter, ...]
    relative: bool

    @classmethod
    def of(
        cls,
        data: str | os.PathLike[str] | Mapping[str, Any] | Sequence[Specimen],
        scene: Scene | str | os.PathLike[str],
        free: str | Sequence[str],
        free_each: str | Sequence[str],
        error: str,
        ignore: Sequence[str],
    ) -> FitModel:
        """Return the model of a request, see `wear.fit`, or raise a `UsageError` with all its
        faults."""
        base, faults = as_scene(scene), Faults()
        specimens: tuple[Specimen, ...] = ()
        shared, single, dropped = _names(free=free, free_each=free_each, ignore=ignore)
        try:
            specimens = _specimens(data, dropped)
        except UsageError as fault:
            faults.append(str(fault))
        faults += _faults(base, specimens, shared, single)
        if error not in ("relative", "absolute"):
            faults.append(f"error: {error!r} is neither relative nor absolute")
        elif error == "relative" and any(np.any(s.wear_mm <= 0.0) for s in specimens):
            faults.append("error: a wear of zero has no logarithm; leave it out, or take absolute")
        faults.stop_if_any()
        names = [(key, "") for key in shared]
        names += [(key, specimen.name) for key in single for specimen in specimens]
        parameters = (Parameter(key, name, is_positive(base, key)) for key, name in names)
        return cls(base, specimens, tuple(parameters), error == "relative")

    def __call__(self, points: FloatArray) -> Linearised:
        """Return residuals and their exact Jacobian at points (m, p)."""
        level, slope = self.log_wear(points, self.cycles)
        slope = self.residuals.slope(level)[..., None] * slope
        values, valid = self._valid(level, np.all(np.isfinite(slope), axis=-1))
        return Linearised(points, values, np.where(valid[..., None], slope, 0.0))

    def cost(self, points: FloatArray) -> FloatArray:
        """Return the sums of the squared residuals (m,)."""
        level, _ = self.log_wear(points, self.cycles, derivatives=False)
        return np.asarray(np.sum(self._valid(level)[0] ** 2, axis=1))

    def _valid(
        self, log_wear: FloatArray, also: BoolArray | bool = True
    ) -> tuple[FloatArray, BoolArray]:
        """Return the residuals, and which of them are those of a scene with wear."""
        values = self.residuals(log_wear)
        valid = np.isfinite(values) & also
        return np.where(valid, values, self.residuals.missing), valid

    @cached_property
    def residuals(self) -> Residuals:
        """Return the residuals as a function of the logarithm of the wear."""
        return Residuals.of(self.specimens, self.relative)

    @property
    def keys(self) -> list[str]:
        """Return the keys that are free, each once."""
        return list(dict.fromkeys(parameter.key for parameter in self.parameters))

    @property
    def cycles(self) -> list[FloatArray]:
        """Return the numbers of cycles at which each specimen was read."""
        return [specimen.cycles for specimen in self.specimens]

    def start(self) -> FloatArray:
        """Return the point (p,) of the scene itself."""
        numbers = parameters_of(self.scene)
        return np.array([p.theta(numbers[p.key]) for p in self.parameters])

    def scale(self, theta: FloatArray) -> FloatArray:
        """Return the size (p,) of every parameter: 1 for a logarithm, otherwise the larger of its
        magnitudes at a point and in the scene."""
        sizes = np.maximum(np.abs(theta), np.abs(self.start()))
        positive = [parameter.positive for parameter in self.parameters]
        return np.where(positive | (sizes == 0.0), 1.0, sizes)

    def values(self, theta: FloatArray) -> list[float]:
        """Return the parameters in the units of their keys."""
        return [float(p.value(x)) for p, x in zip(self.parameters, theta, strict=True)]

    def scenes(self, theta: FloatArray) -> list[Scene]:
        """Return the scene of every specimen; a `SceneError` if the point is outside the domain."""
        entries = list(zip(self.parameters, self.values(theta), strict=True))
        return [
            self.scene.with_(
                dict(specimen.changes)
                | {p.key: value for p, value in entries if p.specimen in ("", specimen.name)}
            )
            for specimen in self.specimens
        ]

    def log_wear(
        self, points: FloatArray, cycles: Sequence[FloatArray], derivatives: bool = True
    ) -> tuple[FloatArray, FloatArray]:
        """Return the logarithm of the wear (m, n) at many points (m, p), and its derivatives with
        respect to theta (m, n, p), if they are wanted: of every specimen after its cycles, one
        after the other.

        Without a scene or without wear they are NaN.
        """
        keys, scenes = self.keys if derivatives else [], list[Scene]()
        valid = np.full(len(points), False)
        alike = self._alike
        firsts = list(dict.fromkeys(alike))
        for place, theta in enumerate(points):
            with suppress(SceneError, OverflowError):
                every = self.scenes(theta)
                scenes += [every[first] for first in firsts]
                valid[place] = True
        counts = np.concatenate(cycles)
        level = np.full((len(points), len(counts)), np.nan)
        slope = np.zeros((*level.shape, len(self.parameters)))
        if not scenes:
            return level, slope
        wanted, column = np.unique(counts, return_inverse=True)
        which = np.repeat(np.arange(len(cycles)), [len(each) for each in cycles])
        scene = np.searchsorted(firsts, alike)[which]
        wear, derivative = (
            np.moveaxis(x.reshape(np.sum(valid), len(firsts), *x.shape[1:]), -1, 2)[
                :, scene, column
            ]
            for x in _gradients(scenes, keys, wanted)
        )
        names = np.array([specimen.name for specimen in self.specimens])
        with np.errstate(all="ignore"):
            level[valid] = np.log(wear)
            for i, p in enumerate(self.parameters if derivatives else ()):
                size = p.value(points[valid, i, None]) if p.positive else 1.0
                acts = names[which] == p.specimen if p.specimen else True
                slope[valid, :, i] = acts * size * derivative[..., keys.index(p.key)] / wear
        return level, slope

    @cached_property
    def _alike(self) -> list[int]:
        """Return the number of the first specimen with the same scene, for each specimen."""
        single = any(p.specimen for p in self.parameters)
        kinds = [(s.name * single, *sorted(s.changes.items())) for s in self.specimens]
        return [kinds.index(kind) for kind in kinds]


def _gradients(
    scenes: Sequence[Scene], keys: Sequence[str], cycles: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return the wear (s, n) of scenes and its derivatives (s, k, n), NaN for a scene that the
    engine cannot solve; the others are solved all the same."""
    none = np.full((len(scenes), len(keys), len(cycles)), np.nan)
    try:
        return gradients(scenes, keys, cycles, RTOL)[:2] if keys else (
            sweep(scenes, cycles, RTOL).u_c, none
        )  # fmt: skip
    except (ArithmeticError, np.linalg.LinAlgError):
        if len(scenes) == 1:
            return np.full((1, len(cycles)), np.nan), none
    parts = [_gradients([scene], keys, cycles) for scene in scenes]
    return np.concatenate([u for u, _ in parts]), np.concatenate([d for _, d in parts])


def is_positive(scene: Scene, key: str) -> bool:
    """Return whether an entry must be positive: a negative one is tried."""
    return not _may_change(scene, key, -abs(parameters_of(scene)[key] or 1.0))


def _may_change(scene: Scene, key: str, value: float) -> bool:
    try:
        scene.with_({key: value})
    except SceneError:
        return False
    return True


def _specimens(data: Any, ignore: Sequence[str]) -> tuple[Specimen, ...]:
    if isinstance(data, str | os.PathLike):
        return read_readings(data, ignore)
    if hasattr(data, "keys"):  # a dictionary of columns, or a DataFrame
        return readings_of(data, ignore)
    specimens = tuple(data) if isinstance(data, Sequence) else ()
    if not all(isinstance(each, Specimen) for each in specimens) or not specimens:
        raise UsageError("data: give a file, columns such as cycles and wear_mm, or specimens")
    return specimens


def _names(**given: str | Sequence[str]) -> list[list[str]]:
    """Return lists of names, each of which may be given as one name."""
    lists = {key: [names] if isinstance(names, str) else names for key, names in given.items()}
    Faults(
        f"{key}: {names!r} is not a list of names"
        for key, names in lists.items()
        if not are_texts(names)
    ).stop_if_any()
    return [list(names) for names in lists.values()]


def _faults(
    scene: Scene, specimens: Sequence[Specimen], free: Sequence[str], free_each: Sequence[str]
) -> Iterator[str]:
    """Yield every fault of the choice of free parameters."""
    keys, numbers = [*free, *free_each], parameters_of(scene)
    if not keys:
        yield f"free: name at least one of {', '.join(numbers)}"
    for key in dict.fromkeys(keys):
        value = numbers.get(key)
        if keys.count(key) > 1:
            yield f"free: {key} is named twice"
        if any(key in specimen.changes for specimen in specimens):
            yield f"free: {key} is given by the data"
        if value is None:
            yield f"free: {no_such_number(key, numbers)}"
        elif not _may_change(scene, key, value):
            yield f"free: {key}: no entry of the scene file, and cannot be free"
        elif value == 0.0 and is_positive(scene, key):
            yield f"free: {key} is 0 in the scene, and is sought as a factor: give it a start"
    for specimen in specimens:
        named = f"specimen {specimen.name}: " * bool(specimen.name)
        try:
            last = most_cycles(scene.with_(dict(specimen.changes)).load)
        except SceneError as fault:
            yield f"{named}{fault}"
        else:
            if specimen.cycles[-1] > last:
                yield f"{named}a reading after the end of the load, cycle {last}: drop it"
    parameters = len(free) + len(free_each) * len(specimens)
    readings = sum(len(specimen.cycles) for specimen in specimens)
    if specimens and readings < parameters:
        yield f"{readings} readings are fewer than {parameters} parameters"
