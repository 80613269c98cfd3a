"""The report of a scene of one's own: the machinery of the paper with the text ``scene.md``."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.resources import files
from typing import Any

from wear import figures
from wear.figure_data import panels_of, pressure_inside
from wear.figure_style import pdf, svg
from wear.history import History
from wear.life import Reached, cycles_until
from wear.regime import Asymptote, asymptote
from wear.report.document import Document, Figure
from wear.report.explorer_data import scene_data
from wear.report.manifest import versions
from wear.report.number import Number
from wear.report.text import parsed
from wear.scene import Scene
from wear.solver import solve

#: Depths whose life is told, in initial roughnesses, and cycles whose pressure is drawn.
_DEPTHS = (1.0, 10.0, 100.0)
_INSIDE = (0, 10, 100, 1000)
_SOLVED = "solution of this scene"
_CONSTANTS = {
    "tanh_argument": ("Limit of the argument of $\\tanh$", ""),
    "wear_per_cycle_mm": ("Wear per cycle", "mm"),
    "pressure_MPa": ("Contact pressure", "MPa"),
    "log_coefficient_mm": ("Coefficient $A$ of $\\ln N$", "mm"),
    "offset_mm": ("Offset $B$", "mm"),
    "saturation_wear_mm": ("Depth at which wear saturates", "mm"),
    "arrest_wear_mm": ("Depth at which wear stops", "mm"),
    "arrest_cycle": ("Cycle in which wear stops", ""),
}


def report(scene: Scene, command: str) -> Document:
    """Return the report of a scene, which must have a load that repeats."""
    from derive.catalogue import equation
    from wear.report.equations import shown
    from wear.report.explorer_derived import holding

    limit = asymptote(scene)
    chosen = scene_data(scene) | {"regime": limit.regime}
    identifiers = holding(chosen)
    curve = solve(scene, [int(n) for n in _cycles(20)], rtol=1e-8)
    values = {
        "title": scene.title or scene.name,
        "description": scene.description,
        "regime": limit.regime,
        "assumptions": list(_assumptions(scene)),
        "notices": list(dict.fromkeys((*scene.notices, *limit.notices, *curve.notices))),
        "data": list(_data(scene)),
        "identifiers": identifiers,
        "constants": list(_constants(limit)),
        "states": list(_states(solve(scene, [int(n) for n in _cycles(1)], rtol=1e-10))),
        "life": list(_life(scene)),
        "last": {
            "cycle": Number(float(curve.cycles[-1]), "request", 1),
            "wear": Number(float(curve.u_c[-1]), _SOLVED, 6, "mm"),
            "error": Number(float(curve.error[-1]), _SOLVED, 1),
        },
        "inside": True,
        "command": command,
        "scene_file": scene.to_toml().strip(),
        "versions": list(versions().items()),
    }
    text = files("wear.report").joinpath("scene.md").read_text(encoding="utf-8")
    equations = shown([equation(identifier) for identifier in identifiers])
    return Document(parsed(text, values), equations, _figures(scene, curve))


def _cycles(per_decade: int) -> Iterator[float]:
    """Yield numbers of cycles from one to a hundred million."""
    for place in range(8 * per_decade + 1):
        yield 10.0 ** (place / per_decade)


def _figures(scene: Scene, curve: History) -> dict[str, Figure]:
    history = figures.history(panels_of([curve]), logarithmic=True)
    inside = figures.pressure_in_cycles(pressure_inside(scene, _INSIDE))
    said = "Wear, roughness and contact pressure against cycles on logarithmic axes."
    pulses = (
        "Contact pressure over the phase of a few cycles: the pulses get lower from line to line."
    )
    return {
        "fig:history": Figure(said, svg(history), pdf(history), "history"),
        "fig:inside": Figure(pulses, svg(inside), pdf(inside), "inside"),
    }


def _assumptions(scene: Scene) -> Iterator[str]:
    """Yield what is assumed, a sentence each."""
    contact = scene.contact
    yield f"The contact law is `{contact.law}`."
    yield (
        "Contact ends where the closure exceeds three times the roughness."
        if contact.ends_at_3_sigma
        else "Contact does not end, however wide the gap."
    )
    yield "The support is rigid." if scene.support is None else "The bearing stands on springs."
    if scene.pin is None:
        yield "The pin is smooth and does not wear."
    else:
        opens = "opens" if contact.pin_wear_opens_gap else "closes"
        yield f"The pin is modelled; its wear {opens} the gap."
    yield f"The load is of kind `{scene.to_tables()['load']['kind']}`."


def _data(scene: Scene) -> Iterator[tuple[str, str, Number]]:
    from derive.symbols import QUANTITIES
    from wear.report.markup import markup

    for name, value in scene.parameters().items():
        if name in QUANTITIES:
            quantity = QUANTITIES[name]
            unit = "" if quantity.unit == "1" else quantity.unit
            number = Number(value, f"scene {scene.name}", 6, unit)
            yield f"${quantity.latex}$", markup(quantity.meaning), number


def _constants(limit: Asymptote) -> Iterator[tuple[str, Number]]:
    for name, (said, unit) in _CONSTANTS.items():
        value = getattr(limit, name)
        if value is not None:
            yield said, Number(value, f"asymptote, {name}", 6, unit)


def _states(history: History) -> Iterator[list[Number]]:
    for place, cycle in enumerate(history.cycles):
        shown: list[tuple[Any, int]] = [
            (float(cycle), 1),
            (history.u_c[place], 6),
            (history.error[place], 1),
            (history.sigma_c[place], 6),
            (history.h[place], 6),
            (history.p[place], 4),
        ]
        yield [Number(float(value), _SOLVED, digits) for value, digits in shown]


def _life(scene: Scene) -> Iterator[tuple[Number, Number | str]]:
    depths = [depth * scene.initial_roughness for depth in _DEPTHS]
    found = cycles_until(scene, depths, rtol=1e-8)
    for depth, cycles, way in zip(depths, found.cycles, found.reached, strict=True):
        known = way in (Reached.COUNTED, Reached.EXTRAPOLATED)
        number = Number(float(cycles), "life of this scene", 5) if known else way.value
        yield Number(depth, "initial roughness", 4), number
