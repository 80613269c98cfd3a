"""The explorer: one page on which the parameters of a scene can be moved.

Overview
    The page needs no network and no server.  The model on it is generated from the derivation;
    how it is integrated stands in ``assets/explorer.solve.js``.  When it loads it computes the
    wear of some scenes itself and compares it with the values that Python found.
Key results
    page    the whole file
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from wear.fitting.readings import Specimen
from wear.report import explorer_data
from wear.report.explorer_data import GROUPS
from wear.report.html import TEMPLATES, asset, style
from wear.scene import KEYS, Scene, builtin_names, load_scene

CHECKED = ("section3", "section4", "section5", "section4-cutoff", "soft-support", "large-swing")
AGREEMENT = {"wear": 1e-7, "rate": 1e-12}
"""Largest relative distances from Python: the page's own tolerance, and roundoff."""

SCRIPTS = ("explorer.solve.js", "explorer.plot.js", "explorer.scene.js", "explorer.page.js")


def page(scene: Scene, specimens: Sequence[Specimen] = ()) -> str:
    """Return the page, opened at a scene, which must have a load that repeats, with what was
    measured on `specimens` of it.

    Raises
    ------
    UsageError
        if the load does not repeat.
    """
    derived = json.loads(asset("explorer.derived.json"))
    data = _data(scene, derived, specimens)
    by_name = {row["name"]: row for row in data["parameters"]}
    return TEMPLATES.get_template("explorer.html").render(
        style=f"{style()}\n{asset('explorer.css')}",
        scripts=[derived["models"], *map(asset, SCRIPTS)],
        groups={g: [by_name[name] for name in names] for g, names in GROUPS.items()},
        laws=derived["laws"],
        equations=derived["equations"],
        data=json.dumps(data, ensure_ascii=False, allow_nan=False).replace("<", "\\u003c"),
    )


def _data(
    first: Scene, derived: Mapping[str, Any], specimens: Sequence[Specimen]
) -> dict[str, Any]:
    scenes = {name: load_scene(name) for name in builtin_names()}
    first = explorer_data.opened(first)
    if first.name not in scenes or scenes[first.name] != first:
        name = f"{first.name} (changed)" if first.name in scenes else first.name
        first = replace(first, name=name)
        scenes = {first.name: first} | scenes
    shown = [explorer_data.scene_data(scene) for scene in scenes.values()]
    next(each for each in shown if each["name"] == first.name)["readings"] = [
        [float(n), float(wear) * explorer_data.MICROMETRES]
        for each in specimens
        for n, wear in zip(each.cycles, each.wear_mm, strict=True)
    ]
    own = [first] if first.name not in CHECKED else []
    return {
        "first": first.name,
        "scenes": shown,
        "parameters": derived["parameters"],
        "keys": KEYS,
        "checks": explorer_data.checked([*(scenes[name] for name in CHECKED), *own]),
        "agreement": AGREEMENT,
        "cutoff": derived["cutoff"],
    }
