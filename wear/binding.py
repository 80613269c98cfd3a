"""From a scene to its model: the generated variant that it needs, with its numbers bound.

Features that a scene leaves out have no symbol, no state and no operation in the code that runs.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from importlib import import_module
from types import ModuleType

import numpy as np

from wear import own_laws
from wear.faults import UsageError
from wear.given_load import Area, GivenLoad
from wear.model import BoundModule, Model, Real
from wear.scene import Scene, as_scene, as_scenes
from wear.scene.variant import VariantKey


def generated(key: VariantKey) -> ModuleType:
    """Return the generated module of a variant."""
    if own_laws.is_own(key.law):
        return own_laws.module(key.law, key.module)
    return import_module(f"wear.generated.{key.law}.{key.module}")


def bound(module: ModuleType, numbers: Mapping[str, Real], pin_wear_sign: Real) -> BoundModule:
    """Return a generated module with its numbers; the sign is that of the wear of the pin."""
    data = module.Parameters._make(numbers[name] for name in module.Parameters._fields)
    signs = (pin_wear_sign,) if "K_a" in module.Parameters._fields else ()
    return BoundModule(module, module.bind(data, *signs), data, signs)


def _bind(key: VariantKey, numbers: Mapping[str, Real], pin_wear_sign: Real) -> Model:
    loss = None
    if key.given_load:
        numbers = {"k": np.full_like(numbers["R"], np.inf), **numbers}  # rigid without springs
        area = Area(numbers["b"], numbers["L"])
        return GivenLoad(bound(generated(key), numbers, pin_wear_sign), area=area)
    if key.ends_at_3_sigma:
        margin = import_module(f"wear.generated.margin_{key.pin}")
        loss = bound(margin, numbers, pin_wear_sign)
    return Model(bound(generated(key), numbers, pin_wear_sign), loss)


def bind(scene: Scene | str | os.PathLike[str]) -> Model:
    """Return the model of one scene, or of its name or path."""
    scene = as_scene(scene)
    return _bind(scene.variant, scene.parameters(), scene.pin_wear_sign)


def bind_many(scenes: Sequence[Scene]) -> Model:
    """Return one model of many scenes; its constants have shape (scenes, 1).

    Raises
    ------
    UsageError
        if there are no scenes, or they need different variants.
    """
    scenes = as_scenes(scenes)
    if not scenes:
        raise UsageError("scenes: there are none; give at least one")
    if len({scene.variant for scene in scenes}) != 1:
        raise UsageError("scenes that are solved together must model the same things")
    rows = [scene.parameters() for scene in scenes]
    names = set.intersection(*map(set, rows))
    columns = {name: _column(row[name] for row in rows) for name in names}
    signs = _column(scene.pin_wear_sign for scene in scenes)
    return _bind(scenes[0].variant, columns, signs)


def _column(values: Iterable[float]) -> Real:
    return np.array([[value] for value in values], dtype=float)
