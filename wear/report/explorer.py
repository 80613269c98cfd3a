"""The explorer: one page with sliders for the parameters of a scene.

Overview
    The page needs no network and no server.  Its model is generated from the derivation and
    integrated by ``assets/explorer.solve.js``.  When it loads it computes the wear of some scenes
    and compares it with the values from Python.
Key results
    page            the file of the page
    for_plots       a scene with no more rows of its load than plots need
    scene_data      a scene in the numbers of the sliders
    checked         wear and wear rates of scenes, computed in Python
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from wear import own_laws
from wear.binding import bind
from wear.faults import AccuracyError
from wear.fitting.readings import Specimen
from wear.load import Constant, Harmonics, Load, Sine, Table
from wear.load.conversion import as_table
from wear.parameters import AREA
from wear.report.html import TEMPLATES, asset, style
from wear.resampling import resampled
from wear.scene import Scene, builtin_names, load_scene
from wear.scene.variant import KEYS
from wear.solver import solve

CHECKED = ("section3", "section4", "section5", "section4-cutoff", "soft-support", "large-swing")
AGREEMENT = {"wear": 1e-7, "rate": 1e-12}
"""Largest relative distances from Python: the page's own tolerance, and roundoff."""

SCRIPTS = ("explorer.solve.js", "explorer.plot.js", "explorer.scene.js", "explorer.page.js")
CYCLES = (1, 10, 100, 1000, 10000)
MICROMETRES = 1e3  # in a mm
IN_MICROMETRES = ("sigma_c0", "sigma_a0", "h_0", "U")
"""Lengths that the page shows in micrometres."""
PLOT_RTOL = 4e-3
"""Relative accuracy of the wear to which the rows of a measured load are merged: a quarter of it
moves no pixel."""
GROUPS: Mapping[str, Mapping[str, tuple[float, float]]] = {
    "Bearing": {
        "K_c": (1e-08, 0.0001),
        "H_c": (50, 5000.0),
        "sigma_c0": (0.0001, 0.001),
        "f_c": (-0.05, 0.6),
    },
    "Pin": {
        "K_a": (1e-08, 0.0001),
        "H_a": (50, 5000.0),
        "sigma_a0": (1e-05, 0.0005),
        "f_a": (-0.05, 0.6),
    },
    "Contact": {"p_max": (10, 3000.0), "h_0": (0.0002, 0.002)},
    "Support": {"k": (10000.0, 10000000.0)},
    "Load and motion": {"U": (1e-05, 0.002), "T": (0.001, 1), "R": (1, 100), "n": (10, 10000.0)},
}
"""The parameters of the sliders, with their ranges."""


def page(scene: Scene, specimens: Sequence[Specimen] = ()) -> str:
    """Return the page, opened at a scene with a periodic load, with the readings of `specimens`.

    Raises
    ------
    UsageError
        if the load does not repeat.
    """
    derived = json.loads(asset("explorer.derived.json"))
    data = _data(scene, derived, specimens)
    by_name = {row["name"]: row for row in data["parameters"]}
    scripts, laws, equations = [derived["models"]], derived["laws"], derived["equations"]
    if own_laws.is_own(law := scene.contact.law):
        from wear.report.explorer_derived import of_own_law

        script, own = of_own_law(law)
        scripts, laws, equations = [*scripts, script], [*laws, law], f"{equations}\n{own}"
    return TEMPLATES.get_template("explorer.html").render(
        style=f"{style()}\n{asset('explorer.css')}",
        scripts=[*scripts, *map(asset, SCRIPTS)],
        groups={g: [by_name[name] for name in names] for g, names in GROUPS.items()},
        laws=laws,
        equations=equations,
        data=json.dumps(data, ensure_ascii=False, allow_nan=False).replace("<", "\\u003c"),
    )


def _data(
    first: Scene, derived: Mapping[str, Any], specimens: Sequence[Specimen]
) -> dict[str, Any]:
    scenes = {name: load_scene(name) for name in builtin_names()}
    first = for_plots(first)
    if first.name not in scenes or scenes[first.name] != first:
        if first.name in scenes:
            title = f"{first.title or first.name} (changed)"
            first = replace(first, name=f"{first.name} (changed)", title=title)
        scenes = {first.name: first} | scenes
    shown = [scene_data(scene) for scene in scenes.values()]
    next(each for each in shown if each["name"] == first.name)["readings"] = [
        [float(n), float(wear) * MICROMETRES]
        for each in specimens
        for n, wear in zip(each.cycles, each.wear_mm, strict=True)
    ]
    own = [first] if first.name not in CHECKED else []
    return {
        "first": first.name,
        "scenes": shown,
        "parameters": derived["parameters"],
        "keys": KEYS,
        "checks": checked([*(scenes[name] for name in CHECKED), *own]),
        "agreement": AGREEMENT,
        "cutoff": derived["cutoff"],
    }


def for_plots(scene: Scene) -> Scene:
    """Return a scene whose load has as few rows as a plot needs, with a note in its description."""
    fewer = resampled(scene, PLOT_RTOL)
    peaks = "The peak of the pressure is that of the merged rows." if fewer.error else ""
    described = " ".join([scene.description, *(f"{text}." for text in fewer.notices), peaks])
    return replace(fewer.scene, description=described.strip())


def scene_data(scene: Scene) -> dict[str, Any]:
    """Return a scene for the page; parameters that it does not model are those of section 3."""
    other = load_scene("section3").parameters() | {"k": 1e5}
    key, load = scene.variant, scene.periodic_load
    size = load.amplitude_mm if isinstance(load, Sine) else 1.0  # the slider multiplies any other
    numbers = other | scene.parameters() | {"U": size}
    return {
        "name": scene.name,
        "title": scene.title or scene.name,
        "description": " ".join(scene.description.split()),
        "law": key.law,
        "pin": key.pin,
        "compliant": scene.support is not None,
        "opening": scene.contact.pin_wear_opens_gap,
        "cutoff": key.ends_at_3_sigma,
        "parameters": {name: numbers[name] for group in GROUPS.values() for name in group},
        "load": _load_data(load)
        | ({"area": {name: numbers[name] for name in AREA}} if scene.given_load else {}),
    }


def _load_data(load: Load) -> dict[str, Any]:
    """Return the load, its rows over one period if it has any, and the phases where steps end."""
    if isinstance(load, Sine | Constant | Harmonics):
        stops = (0.25, 0.75) if isinstance(load, Sine) else load.peaks
        return as_table(load) | {"stops": [] if isinstance(load, Constant) else list(stops)}
    phases = sorted({0.0, 1.0, *load.kinks})
    return {
        "kind": "table" if isinstance(load, Table) else "force",
        "rows": as_table(load) if getattr(load, "source", None) else None,
        "period_s": load.period,
        "phase": phases,
        "value": [float(load(phase)) for phase in phases],
        "stops": list(load.kinks),
    }


def checked(scenes: Iterable[Scene]) -> list[dict[str, Any]]:
    """Return for each scene its wear after cycles, and wear rates along the way, as Python computes
    them; scenes of which it cannot reach the requested accuracy are left out."""
    checks, phases = [], np.linspace(0.0, 1.0, 7)
    for scene in scenes:
        model, loads = bind(scene), scene.periodic_load(phases)
        jumps = model.ends_at_3_sigma and not model.compliant
        cycles = CYCLES[:3] if jumps else CYCLES
        try:
            history = solve(scene, cycles, rtol=1e-10)
        except AccuracyError:
            continue
        rates = []
        for depth in (0.0, *history.u_c.tolist()):
            rate = model.rate(np.full_like(loads, depth), loads)
            if jumps:
                rate = np.where(model.margin(depth, loads) >= 0.0, rate, 0.0)
            rates += [[depth, float(a), float(b)] for a, b in zip(loads, rate, strict=True)]
        checks.append(
            {
                "scene": scene.name,
                "cycles": list(cycles),
                "wear_mm": history.u_c.tolist(),
                "rates": rates,
            }
        )
    return checks
