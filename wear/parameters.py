"""The numbers of a scene on which its wear depends, by their keys in the scene file.

Key results
    parameters_of    the numbers that the variant of a scene contains
    links            the dependence of the model's parameters on them
    parametrised     the equation of scenes with its derivatives with respect to such numbers
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from wear.binding import bind, bind_many
from wear.equation import WearEquation
from wear.load import Load
from wear.load.spans import LoadSpan
from wear.model import Real, Summation
from wear.numerics.gauss import FloatArray, IntArray
from wear.scene import Scene
from wear.scene.text import path_of
from wear.scene.variant import KEYS
from wear.words import did_you_mean

Gradient = Callable[[Real, Real, Summation], dict[str, Real]]

AREA = {"b": ("contact", "width_mm"), "L": ("contact", "length_mm")}
MOST_ROWS = 100  # of a table: each is a parameter


def parameters_of(scene: Scene) -> dict[str, float]:
    """Return the numbers of the scene on which its wear depends, by their key in the scene file.

    Numbers that the variant of the model does not contain are left out, and so are the rows of a
    table with more than a hundred of them. Entries of a list are counted from 0.

    >>> from wear.scene import load_scene
    >>> parameters_of(load_scene("section4"))["load.amplitude_mm"]
    0.0005
    """
    numbers = {key: value for _, key, value, _ in links(scene)}
    for name, load in scene.loads.items():
        numbers |= {f"{name}.{key}": _entry(load, key) for key in numbers_of(load)}
        numbers[f"{name}.period_s"] = load.period
    return numbers


def no_such_number(key: str, numbers: Collection[str]) -> str:
    """Return the message for a key that is not among the `numbers` of a scene."""
    meant = next((name for name in numbers if key in name), "") or did_you_mean(key, numbers)
    remedy = f"did you mean {meant}?" if meant else f"it has {', '.join(numbers)}"
    return f"{key}: the wear of this scene does not depend on it; {remedy}"


class Link(NamedTuple):
    """The derivative (`factor`) of the parameter with a `symbol` by the number with a `key`, whose
    `value` it has."""

    symbol: str
    key: str
    value: float
    factor: float


def links(scene: Scene) -> list[Link]:
    """Return the links from the numbers of the scene, without the load's, to the parameters."""
    numbers = scene.parameters()
    found = []
    entries = {**KEYS, **AREA} if scene.given_load else KEYS
    for symbol, entry in entries.items():
        if symbol in numbers and symbol != "h_0":
            found.append(Link(symbol, ".".join(entry), numbers[symbol], 1.0))
    contact, sigma = scene.contact, scene.initial_roughness
    if contact.closure_mm is not None:
        return [*found, Link("h_0", "contact.closure_mm", contact.closure_mm, 1.0)]
    multiple = numbers["h_0"] / sigma
    for link in list(found):
        if link.symbol in ("sigma_c0", "sigma_a0"):
            found.append(link._replace(symbol="h_0", factor=multiple * link.value / sigma))
    return [*found, Link("h_0", "contact.closure_in_sigma", multiple, sigma)]


def numbers_of(load: Load) -> list[str]:
    """Return the keys of the numbers of a load except its period."""
    keys = list(load.gradient(np.zeros(1)))
    return keys if len(keys) <= MOST_ROWS else []


def _entry(load: Load, key: str) -> float:
    """Return a number of a load, which may be an entry of a list.

    >>> from wear.load import Harmonics
    >>> _entry(Harmonics(0.0, (1e-4, 2e-4), (), 1.0), "cosine_mm[1]")
    0.0002
    """
    name, *places = path_of(key)
    value = getattr(load, str(name))
    return float(value[places[0]] if places else value)


@dataclass(frozen=True)
class ParametrisedEquation(WearEquation):
    """The wear of scenes with its derivatives with respect to numbers of the scene: `chain`
    (scenes, symbols, parameters) has the derivatives of the model's parameters, by their `symbols`,
    with respect to these numbers; `of_load` has the columns of numbers of the load."""

    symbols: Sequence[str]
    chain: FloatArray
    of_load: Mapping[str, int]

    @property
    def parameters(self) -> int:
        """Return the number of parameters."""
        return int(self.chain.shape[2])

    def take(self, rows: slice | IntArray) -> ParametrisedEquation:
        """Return some of the scenes."""
        if self.scenes == 1:
            return self
        part = super().take(rows)
        return dataclasses.replace(self, model=part.model, loads=part.loads, chain=self.chain[rows])

    def by_parameters(
        self, u: FloatArray, phases: FloatArray, forcing: FloatArray, weights: FloatArray
    ) -> FloatArray:
        """Return the sum over all nodes of weights times the derivative of the wear per cycle."""
        return self.along(self._model.rate_gradient, u, phases, forcing, weights * self._period)

    def along(
        self,
        gradient: Gradient,
        u: FloatArray,
        phases: FloatArray,
        forcing: FloatArray,
        weights: FloatArray,
    ) -> FloatArray:
        """Return the sum (scenes, starts, parameters) over all nodes of `weights` times the
        derivatives of a quantity with this `gradient` by symbol of the model; for one scene each
        row may have its own phases."""

        def summed(values: Real) -> Real:
            at_all = np.broadcast_to(values, weights.shape)
            return np.asarray(np.einsum("abqm,abqm->ab", weights, at_all)[..., None, None])

        by_symbol = gradient(u, forcing, summed)
        by_load = by_symbol.pop("U_a")
        rows = [self.symbols.index(symbol) for symbol in by_symbol]
        sums = np.stack([*by_symbol.values()], axis=-1)[:, :, 0, 0]
        by_number = sums @ self.chain[:, rows]
        if self.of_load:
            flat = (weights * by_load).reshape(*u.shape[:2], phases[0].size)
            by_number[..., list(self.of_load.values())] = flat @ self._load_gradient(phases)
        return np.asarray(by_number)

    def _load_gradient(self, phases: FloatArray) -> FloatArray:
        """Return the derivatives (scenes, nodes, parameters of the load) of the displacement."""
        shape = (-1, phases[0].size, len(self.of_load))
        if len(phases) == 1 or self.scenes == 1:
            parts = [self.loads[0].gradient(phases)]
        else:
            parts = [load.gradient(at) for load, at in zip(self.loads, phases, strict=True)]
        waves = [np.stack([part[key] for key in self.of_load], axis=-1) for part in parts]
        return np.concatenate([wave.reshape(shape) for wave in waves])


def parametrised(
    scenes: Sequence[Scene], acting: Sequence[LoadSpan], keys: Sequence[str]
) -> ParametrisedEquation:
    """Return the equation of scenes of one variant, each under its acting load, with derivatives
    with respect to the numbers of these `keys`."""
    place, loads = acting[0].place, tuple(each.load for each in acting)
    model = bind(scenes[0]) if len(scenes) == 1 else bind_many(scenes)
    symbols = [*model.module.Parameters._fields, *(AREA if scenes[0].given_load else ())]
    column = {key: i for i, key in enumerate(keys)}
    chain = np.zeros((len(scenes), len(symbols), len(keys)))
    for matrix, scene, load in zip(chain, scenes, loads, strict=True):
        for link in links(scene):
            if link.key in column:
                matrix[symbols.index(link.symbol), column[link.key]] += link.factor
        if (period := f"{place}.period_s") in column:
            # The wear per cycle is proportional to the period as it is to the speed.
            matrix[symbols.index("n"), column[period]] = scene.motion.speed_rpm / load.period
    of_load = {
        key: column[f"{place}.{key}"] for key in numbers_of(loads[0]) if f"{place}.{key}" in column
    }
    return ParametrisedEquation(model, loads, symbols, chain, of_load)
