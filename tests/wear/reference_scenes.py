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

from wear.load import Load
from wear.scene import Scene

REFERENCE: dict[str, dict[int, float]] = {
    name: {int(cycles): float(wear) for cycles, wear in row.items()}
    for name, row in json.loads((Path(__file__).parents[1] / "data" / "cycles.json").read_text())[
        "u_c_mm"
    ].items()
}

SINE = {"kind": "sine", "amplitude_mm": 5e-4, "period_s": 0.06}
CONSTANT = {"kind": "constant", "value_mm": 5e-4, "period_s": 0.06}


def tables(
    K: float = 1e-6,
    f_c: float = 0.25,
    pin: bool = False,
    k: float | None = None,
    load: dict[str, Any] = SINE,
    cutoff: bool = False,
) -> dict[str, Any]:
    """The tables of a scene file; without arguments those of the note's section 4."""
    bearing = {"hardness_MPa": 200.0, "roughness_mm": 3.6e-4, "roughness_growth": f_c}
    made: dict[str, Any] = {"bearing": bearing | {"wear_coefficient": K}}
    contact: dict[str, Any] = {"max_pressure_MPa": 300.0, "ends_at_3_sigma": cutoff}
    if pin:
        made["pin"] = {
            "hardness_MPa": 600.0,
            "wear_coefficient": K,
            "roughness_mm": 6.5e-5,
            "roughness_growth": 0.05,
        }
    made["contact"] = contact | ({"closure_in_sigma": 3.0} if pin else {"closure_mm": 1.08e-3})
    if k is not None:
        made["support"] = {"stiffness_MPa_per_mm": k}
    return made | {"motion": {"radius_mm": 22.0, "speed_rpm": 2000.0}, "load": dict(load)}


def made(
    K: float = 1e-6,
    f_c: float = 0.25,
    load: Load | None = None,
    *,
    roughness: float | None = None,
    closure: float | None = None,
    law: str = "tanh",
    pin: bool | Mapping[str, float] = False,
    k: float | None = None,
    cutoff: bool = False,
) -> Scene:
    """The scene of `tables` under another load, with roughness and closure (mm) of its own, and a
    pin of which some entries may be given."""
    entries = tables(K, f_c, bool(pin), k, cutoff=cutoff)
    entries["contact"]["law"] = law
    if roughness is not None:
        entries["bearing"]["roughness_mm"] = roughness
    if closure is not None:
        entries["contact"].pop("closure_in_sigma", None)
        entries["contact"]["closure_mm"] = closure
    if isinstance(pin, Mapping):
        entries["pin"] |= pin
    scene = Scene.from_dict(entries, "made")
    return scene if load is None else replace(scene, load=load)


TABLES = {
    "S1": tables(f_c=-0.05, pin=True),
    "S2": tables(),
    "S3a": tables(K=1e-7, f_c=0.05, pin=True),
    "S3b": tables(f_c=0.05, pin=True),
    "S3c": tables(K=1e-5, f_c=0.05, pin=True),
    "S3d": tables(K=1e-4, f_c=0.05, pin=True),
    "S4": tables(K=1e-3),
    "S5": tables(f_c=0.125),
    "S6": tables(f_c=-0.05),
    "S7": tables(load=CONSTANT),
    "S8_1": tables(f_c=-0.05, pin=True, k=1e5),
    "S8_2": tables(k=1e5),
}


@cache
def reference_scene(name: str) -> Scene:
    """The scene of that name."""
    return Scene.from_dict(TABLES[name], name)
