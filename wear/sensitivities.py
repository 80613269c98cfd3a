"""Sensitivities: how the wear after N cycles depends on every number of the scene.

Overview
    The engine gives du/dp along the orbit (`wear.orbit.tangent`); `derive` has generated the
    derivatives of the wear rate. This module knows where a number stands in the scene file.
Key results
    parameters_of    the numbers that the variant of a scene contains, by key
    gradients        wear and its derivatives, of many scenes at once
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from wear.checked import did_you_mean
from wear.cycles import groups
from wear.equation import WearEquation
from wear.faults import UsageError
from wear.load import Blocks, Load
from wear.model import bind, bind_many
from wear.orbit.segments import orbit
from wear.orbit.tangent import tangents
from wear.scene import KEYS, Scene

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]

AREA = {"b": ("contact", "width_mm"), "L": ("contact", "length_mm")}
MOST_ROWS = 100  # of a table: each is a parameter


class Gradients(NamedTuple):
    """Of scenes (s,) after cycles (n,): `wear` (s, n) in mm, its `derivative` (s, k, n) with
    respect to k numbers of the scene, in mm per unit of the key, and the estimated absolute `error`
    (s, k, n) of that; infinite where the count does not reach."""

    wear: FloatArray
    derivative: FloatArray
    error: FloatArray


def parameters_of(scene: Scene) -> dict[str, float]:
    """Return the numbers of the scene on which its wear depends, by their key in the scene file.

    What the variant of the model does not contain is left out, and so are the rows of a table that
    has more than a hundred of them. Entries of a list are counted from 0.

    >>> from wear.scene import load_scene
    >>> parameters_of(load_scene("section4"))["load.amplitude_mm"]
    0.0005
    """
    found = {key: value for _, key, value, _ in _links(scene)}
    for name, load in _loads(scene).items():
        found |= {f"{name}.{key}": _entry(load, key) for key in _numbers(load)}
        found[f"{name}.period_s"] = load.period
    return found


def gradients(
    scenes: Sequence[Scene], keys: Sequence[str], cycles: FloatArray, rtol: float = 1e-10
) -> Gradients:
    """Return the wear of scenes of one variant after whole numbers of cycles (n,), and its
    derivatives with respect to the numbers of the scene with these `keys`.

    Raises
    ------
    UsageError
        for keys that a scene does not have or that its wear does not depend on.

    >>> from wear.scene import load_scene
    >>> keys = ["bearing.wear_coefficient"]
    >>> found = gradients([load_scene("section4")], keys, np.array([9000.0]))
    >>> f"{found.derivative[0, 0, 0]:.4f}"
    '1698.1082'
    """
    cycles = np.asarray(cycles, dtype=float)
    _check(scenes, keys)
    shape = (len(scenes), len(keys), len(cycles))
    found = Gradients(np.empty((shape[0], shape[2])), np.empty(shape), np.empty(shape))
    for which in groups(scenes):
        some = [scenes[i] for i in which.tolist()]
        lost = [scene.name for scene in some if scene.contact.ends_at_3_sigma]
        if lost:
            raise UsageError(f"{lost[0]}: no derivatives with loss of contact")
        for whole, part in zip(found, _of_one_variant(some, keys, cycles, rtol), strict=True):
            whole[which] = part
    return found


def _check(scenes: Sequence[Scene], keys: Sequence[str]) -> None:
    """Raise a `UsageError` that names every key that some scene does not have."""
    known = [parameters_of(scene) for scene in scenes]
    faults = []
    for key in keys:
        owner = next((own for own in known if key not in own), None)
        if owner is not None:
            meant = did_you_mean(key, owner)
            remedy = f"did you mean {meant}?" if meant else f"it has {', '.join(owner)}"
            faults.append(f"{key}: the wear of this scene does not depend on it; {remedy}")
    if faults:
        raise UsageError("\n".join(faults))


@np.errstate(all="ignore")  # trial states far off the solution; what is no number has no digit
def _of_one_variant(
    scenes: Sequence[Scene], keys: Sequence[str], cycles: FloatArray, rtol: float
) -> Gradients:
    """Return the gradients of scenes of one variant; of one alone if its load consists of
    blocks."""
    shape, last = (len(scenes), len(keys)), float(np.max(cycles, initial=0.0))
    start, missed, slope, slope_error = (np.zeros(n) for n in (shape[0], shape[0], shape, shape))
    u = np.full((shape[0], len(cycles)), np.nan)
    derivative, error = np.full((2, *shape, len(cycles)), np.nan)
    for acting in _spans(scenes):
        end = min(acting.until, last)
        here = (cycles >= acting.begins) & (cycles <= end)
        wanted = np.tile(np.append(cycles[here], end) - acting.begins, (shape[0], 1))
        equation = _equation(scenes, acting, keys)
        found = orbit(equation, wanted[:, -1], rtol, start, missed)
        answer = tangents(equation, found, wanted, rtol, slope, slope_error)
        u[:, here] = answer.u[:, :-1]
        derivative[..., here] = answer.derivative[..., :-1]
        error[..., here] = answer.derivative_error[..., :-1]
        start, missed = answer.u[:, -1], answer.error[:, -1] * answer.u[:, -1]
        slope, slope_error = answer.derivative[..., -1], answer.derivative_error[..., -1]
        if end >= last or not np.isfinite(missed).all():
            break
    return Gradients(u, derivative, np.where(np.isnan(error), np.inf, error))


class _Span(NamedTuple):
    """The `loads` of scenes from cycle `begins` to cycle `until`, which stand at a `place` of the
    scene file."""

    place: str
    loads: tuple[Load, ...]
    begins: float
    until: float


def _spans(scenes: Sequence[Scene]) -> Iterator[_Span]:
    """Return the loads of scenes one after the other: of many, one that repeats for ever."""
    load = scenes[0].load
    if not isinstance(load, Blocks):
        yield _Span("load", tuple(scene.periodic_load for scene in scenes), 0.0, np.inf)
        return
    begins = 0.0
    for number, block in enumerate(load.stretches()):
        place = f"load.blocks[{number % len(load.blocks)}]"
        yield _Span(place, (block.load,), begins, begins + block.cycles)
        begins += block.cycles


def _loads(scene: Scene) -> dict[str, Load]:
    """Return the loads of a scene that repeat, by their place in the scene file."""
    if isinstance(scene.load, Blocks):
        return {f"load.blocks[{i}]": block.load for i, block in enumerate(scene.load.blocks)}
    return {"load": scene.periodic_load}


def _numbers(load: Load) -> list[str]:
    """Return the keys of the numbers of a load, but its period."""
    found = list(load.gradient(np.zeros(1)))
    return found if len(found) <= MOST_ROWS else []


def _entry(load: Load, key: str) -> float:
    """Return a number of a load, which may stand in a list.

    >>> from wear.load import Harmonics
    >>> _entry(Harmonics(0.0, (1e-4, 2e-4), (), 1.0), "cosine_mm[1]")
    0.0002
    """
    name, _, place = key.rstrip("]").partition("[")
    value = getattr(load, name)
    return float(value[int(place)] if place else value)


class _Link(NamedTuple):
    """By how much (`factor`) the parameter with a `symbol` changes with the number with a `key`."""

    symbol: str
    key: str
    value: float
    factor: float


def _links(scene: Scene) -> list[_Link]:
    """Return how the parameters of the model depend on the numbers of the scene but the load's."""
    numbers = scene.parameters()
    found = []
    entries = {**KEYS, **AREA} if scene.given_load else KEYS
    for symbol, entry in entries.items():
        if symbol in numbers and symbol != "h_0":
            found.append(_Link(symbol, ".".join(entry), numbers[symbol], 1.0))
    contact, sigma = scene.contact, scene.initial_roughness
    if contact.closure_mm is not None:
        return [*found, _Link("h_0", "contact.closure_mm", contact.closure_mm, 1.0)]
    multiple = numbers["h_0"] / sigma
    for link in list(found):
        if link.symbol in ("sigma_c0", "sigma_a0"):
            found.append(link._replace(symbol="h_0", factor=multiple * link.value / sigma))
    return [*found, _Link("h_0", "contact.closure_in_sigma", multiple, sigma)]


@dataclass(frozen=True)
class _Parametrised(WearEquation):
    """The wear of scenes with its derivatives with respect to numbers of the scene: `chain`
    (scenes, symbols, parameters) leads from the parameters of the model to these, and `of_load`
    has the place among these of numbers of the load."""

    chain: FloatArray
    of_load: Mapping[str, int]

    @property
    def parameters(self) -> int:
        """Return how many numbers there are."""
        return int(self.chain.shape[2])

    def take(self, rows: slice | IntArray) -> _Parametrised:
        """Return some of the scenes."""
        if self.scenes == 1:
            return self
        some = super().take(rows)
        return dataclasses.replace(self, model=some.model, loads=some.loads, chain=self.chain[rows])

    def by_parameters(
        self, u: FloatArray, phases: FloatArray, forcing: FloatArray, weights: FloatArray
    ) -> FloatArray:
        """Return the sum over all nodes of weights times the derivative of the wear per cycle."""
        weights = weights * self._period
        by_load, *by_symbol = self._model.rate_gradient(
            u, forcing, lambda values: np.sum(weights * values, axis=(2, 3), keepdims=True)
        ).values()
        found = np.stack(by_symbol, axis=-1)[:, :, 0, 0] @ self.chain
        if self.of_load:
            flat = (weights * by_load).reshape(*u.shape[:2], -1)
            found[..., list(self.of_load.values())] = flat @ self._load_gradient(phases)
        return np.asarray(found)

    def _load_gradient(self, phases: FloatArray) -> FloatArray:
        """Return the derivatives (scenes, nodes, parameters of the load) of the displacement."""
        shape = (-1, phases[0].size, len(self.of_load))
        if len(phases) == 1 or self.scenes == 1:
            parts = [self.loads[0].gradient(phases)]
        else:
            parts = [load.gradient(at) for load, at in zip(self.loads, phases, strict=True)]
        waves = [np.stack([part[key] for key in self.of_load], axis=-1) for part in parts]
        return np.concatenate([wave.reshape(shape) for wave in waves])


def _equation(scenes: Sequence[Scene], acting: _Span, keys: Sequence[str]) -> _Parametrised:
    """Return the equation of scenes of one variant under the loads that act, with the numbers that
    have these `keys`."""
    place, loads = acting.place, acting.loads
    model = bind(scenes[0]) if len(scenes) == 1 else bind_many(scenes)
    symbols = [*model.module.Parameters._fields, *(AREA if scenes[0].given_load else ())]
    column = {key: i for i, key in enumerate(keys)}
    chain = np.zeros((len(scenes), len(symbols), len(keys)))
    for own, scene, load in zip(chain, scenes, loads, strict=True):
        for link in _links(scene):
            if link.key in column:
                own[symbols.index(link.symbol), column[link.key]] += link.factor
        if (period := f"{place}.period_s") in column:
            # The wear per cycle is proportional to the period as it is to the speed.
            own[symbols.index("n"), column[period]] = scene.motion.speed_rpm / load.period
    of_load = {
        key: column[f"{place}.{key}"] for key in _numbers(loads[0]) if f"{place}.{key}" in column
    }
    return _Parametrised(model, loads, chain, of_load)
