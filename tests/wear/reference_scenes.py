"""The twelve scenes of `tests/data/cycles.json` and their wear, known to 14 digits or more.

The note's own sections 3 to 5 and variations: faster wear, other roughness slopes, a constant
load, a compliant support.
"""

import json
from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from wear.load import Constant, Load, Sine, Table
from wear.numerics.gauss import FloatArray
from wear.scene import Scene
from wear.scene.tables import Bearing, Contact, Motion, Pin, Support

REFERENCE: dict[str, dict[int, float]] = {
    name: {int(cycles): float(wear) for cycles, wear in row.items()}
    for name, row in json.loads((Path(__file__).parents[1] / "data" / "cycles.json").read_text())[
        "u_c_mm"
    ].items()
}


def sine(amplitude_mm: float) -> Sine:
    """Return a load of the note's period."""
    return Sine(amplitude_mm, 0.06)


def constant(value_mm: float) -> Constant:
    """Return a load of the note's period."""
    return Constant(value_mm, 0.06)


SINE, CONSTANT = sine(5e-4), constant(5e-4)
SHARP = Table((0.0, 0.2, 0.5, 1.0), (0.0, 3e-4, -1e-4, 0.0))
"""A load with a kink at its peak."""


def made(
    K: float = 1e-6,
    f_c: float = 0.25,
    load: Load = SINE,
    *,
    roughness: float = 3.6e-4,
    closure: float | None = None,
    law: str = "tanh",
    pin: bool | Mapping[str, float] = False,
    k: float | None = None,
    cutoff: bool = False,
) -> Scene:
    """The note's section 4, or what is changed of it; lengths in mm.

    A pin is that of section 3, of which some entries may be given; with it the closure is three
    times the roughness of both, if none is given.
    """
    if closure is None and not pin:
        closure = 1.08e-3
    of_section_3 = Pin(600.0, K, 6.5e-5, 0.05)
    return Scene(
        bearing=Bearing(200.0, K, roughness, f_c),
        pin=replace(of_section_3, **(pin if isinstance(pin, Mapping) else {})) if pin else None,
        contact=Contact(
            300.0, closure, 3.0 if closure is None else None, law=law, ends_at_3_sigma=cutoff
        ),
        support=None if k is None else Support(k),
        motion=Motion(22.0, 2000.0),
        load=load,
        name="made",
    )


_CHANGES: dict[str, dict[str, Any]] = {
    "S1": {"f_c": -0.05, "pin": True},
    "S2": {},
    "S3a": {"K": 1e-7, "f_c": 0.05, "pin": True},
    "S3b": {"f_c": 0.05, "pin": True},
    "S3c": {"K": 1e-5, "f_c": 0.05, "pin": True},
    "S3d": {"K": 1e-4, "f_c": 0.05, "pin": True},
    "S4": {"K": 1e-3},
    "S5": {"f_c": 0.125},
    "S6": {"f_c": -0.05},
    "S7": {"load": CONSTANT},
    "S8_1": {"f_c": -0.05, "pin": True, "k": 1e5},
    "S8_2": {"k": 1e5},
}


def reference_wear(name: str) -> tuple[FloatArray, FloatArray]:
    """Return the numbers of cycles for which the wear (mm) of a scene is known, and that wear."""
    cycles, wear = zip(*sorted(REFERENCE[name].items()), strict=True)
    return np.array(cycles, dtype=float), np.array(wear)


@cache
def reference_scene(name: str) -> Scene:
    """Return the scene of that name."""
    return replace(made(**_CHANGES[name]), name=name)
