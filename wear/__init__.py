"""Wear of bearings under cyclic contact, for any number of cycles.

>>> import wear
>>> history = wear.solve("section4", [1, 9000])
>>> [f"{depth:.6e}" for depth in history.u_c]
['3.025336e-05', '4.413329e-03']

Names are imported at their first use, so that ``import wear`` costs next to nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from wear.binding import bind, bind_many
    from wear.cycles import cycles_to_depth, sweep
    from wear.faults import (
        AccuracyError,
        Interrupted,
        SceneError,
        UsageError,
        WearError,
        WorkersLost,
    )
    from wear.figures import plot, plot_pressure
    from wear.fitting.fit import Fit, fit
    from wear.fitting.posterior import posterior
    from wear.fitting.readings import Specimen, read_readings
    from wear.history import History
    from wear.inside import fields_inside
    from wear.life import Life, Reached, cycles_until
    from wear.load import (
        Block,
        Blocks,
        Constant,
        Force,
        ForceTable,
        Harmonics,
        HistoryLoad,
        Sine,
        Table,
    )
    from wear.orbit.general import count_cycles
    from wear.regime import Asymptote, asymptote
    from wear.scene import Scene, load_scene
    from wear.scene.tables import Bearing, Contact, Motion, Pin, Support
    from wear.sensitivities import Sensitivities, gradients, sensitivity
    from wear.solver import solve
    from wear.studies.figures import picture, ten_percent_life
    from wear.studies.indices import sobol_indices
    from wear.studies.run import study

_HOMES = {
    "wear.faults": "AccuracyError Interrupted SceneError UsageError WearError WorkersLost",
    "wear.cycles": "cycles_to_depth sweep",
    "wear.figures": "plot plot_pressure",
    "wear.fitting.fit": "Fit fit",
    "wear.fitting.posterior": "posterior",
    "wear.fitting.readings": "Specimen read_readings",
    "wear.history": "History",
    "wear.inside": "fields_inside",
    "wear.life": "Life Reached cycles_until",
    "wear.load": "Block Blocks Constant Force ForceTable Harmonics HistoryLoad Sine Table",
    "wear.binding": "bind bind_many",
    "wear.orbit.general": "count_cycles",
    "wear.regime": "Asymptote asymptote",
    "wear.scene": "Scene load_scene",
    "wear.scene.tables": "Bearing Contact Motion Pin Support",
    "wear.sensitivities": "Sensitivities gradients sensitivity",
    "wear.solver": "solve",
    "wear.studies.figures": "picture ten_percent_life",
    "wear.studies.indices": "sobol_indices",
    "wear.studies.run": "study",
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names.split()}

__all__ = [
    "AccuracyError", "Asymptote", "Bearing", "Block", "Blocks", "Constant", "Contact", "Fit",
    "Force", "ForceTable", "Harmonics", "History", "HistoryLoad", "Interrupted", "Life",
    "Motion", "Pin", "Reached", "Scene", "SceneError", "Sensitivities", "Sine", "Specimen",
    "Support", "Table", "UsageError", "WearError", "WorkersLost", "asymptote", "bind",
    "bind_many", "count_cycles", "cycles_to_depth", "cycles_until", "fields_inside", "fit",
    "gradients", "load_scene", "picture", "plot", "plot_pressure", "posterior", "read_readings",
    "sensitivity", "sobol_indices", "solve", "study", "sweep", "ten_percent_life",
]  # fmt: skip


CLASH = """\
the package `derive` found here is another distribution's of the same name.
Uninstall that, or make an environment for derive-wear alone, and then
pip install --force-reinstall derive-wear"""


def is_clash(fault: ImportError) -> bool:
    """Return whether an import failed because `derive` is not ours."""
    return fault.name is not None and fault.name.partition(".")[0] == "derive"


def __getattr__(name: str) -> Any:
    if name in _HOME_OF:
        try:
            return getattr(import_module(_HOME_OF[name]), name)
        except ImportError as fault:
            if is_clash(fault):
                raise ImportError(CLASH, name=fault.name) from fault
            raise
    raise AttributeError(f"module 'wear' has no attribute {name!r}")


def __dir__() -> list[str]:
    return __all__
