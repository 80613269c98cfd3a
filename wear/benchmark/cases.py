"""Scenes with the wear that is known of them, far beyond double precision's need.

`wear/data/reference.json` says how the values were computed; no code of the package took part.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

if TYPE_CHECKING:
    from wear.scene import Scene

REFERENCE = Path(__file__).parents[1] / "data" / "reference.json"
CYCLES = (1, 100, 9000, 10**6, 10**8)
ONE = ("section4",)
FEW = ("section3", "section4", "fast-wear")


class Case(NamedTuple):
    """A scene, a number of cycles and the true wear in mm after them."""

    name: str
    scene: Scene
    cycles: int
    wear: float


@cache
def _reference() -> Any:
    return json.loads(REFERENCE.read_text(encoding="utf-8"))


def names(kind: Literal["speed", "hard"]) -> tuple[str, ...]:
    """The scenes of the speed comparison or of the hard catalogue."""
    return tuple(_reference()[kind])


def cases(
    kind: Literal["speed", "hard"], scenes: Sequence[str], cycles: Sequence[int] | None = None
) -> tuple[Case, ...]:
    """The cases of some scenes, at those numbers of cycles whose wear is known.

    >>> [case.cycles for case in cases("speed", ["section4"], CYCLES)]
    [1, 100, 9000, 1000000, 100000000]
    """
    from wear.scene import load_scene

    made = []
    for name in scenes:
        entry = _reference()[kind][name]
        scene = load_scene(entry["scene"], entry["set"])
        for text, wear in entry["u_c_mm"].items():
            if cycles is None or int(text) in cycles:
                made.append(Case(name, scene, int(text), wear))
    return tuple(made)
