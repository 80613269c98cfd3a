"""Wear of bearings under cyclic contact, for any number of cycles.

>>> import wear
>>> history = wear.solve(wear.load_scene("section4"), [1, 9000])
>>> [f"{depth:.6e}" for depth in history.u_c]
['3.025336e-05', '4.413329e-03']

What is asked for is imported when it is, so that ``import wear`` costs next to nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from wear.history import History
    from wear.regime import Asymptote, asymptote
    from wear.scene import Scene, load_scene
    from wear.solver import solve
    from wear.studies.indices import sobol_indices
    from wear.studies.run import study

__all__ = [
    "Asymptote",
    "History",
    "Scene",
    "asymptote",
    "load_scene",
    "sobol_indices",
    "solve",
    "study",
]

_HOMES = {
    "Asymptote": "wear.regime",
    "History": "wear.history",
    "Scene": "wear.scene",
    "asymptote": "wear.regime",
    "load_scene": "wear.scene",
    "sobol_indices": "wear.studies.indices",
    "solve": "wear.solver",
    "study": "wear.studies.run",
}


def __getattr__(name: str) -> Any:
    if name in _HOMES:
        return getattr(import_module(_HOMES[name]), name)
    raise AttributeError(f"module 'wear' has no attribute {name!r}")
