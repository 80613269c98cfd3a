"""The report of a user's scene: the text ``scene.md`` with its values and figures."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from derive import equations as derived
from derive.catalogue import equation
from derive.laws import LAWS
from derive.note.governing import Pin
from derive.own_law import own_law
from derive.symbols import QUANTITIES
from derive.variant import Variant
from derive.variant_equations import equations_of, opened
from wear import figures
from wear.faults import AccuracyError, UsageError
from wear.figure_data import (
    WEAR,
    Abscissa,
    Line,
    Panel,
    as_typed,
    panels_of,
    points_of,
    pressure_inside,
)
from wear.fitting.readings import Specimen
from wear.history import History
from wear.life import cycles_until
from wear.load import Blocks, HistoryLoad
from wear.load.spans import most_cycles
from wear.own_laws import PREFIX, is_own
from wear.regime import Asymptote, asymptote
from wear.report import schematic
from wear.report.document import Document, drawn
from wear.report.equations import shown
from wear.report.explorer_derived import holding
from wear.report.markup import markup, number
from wear.report.publish import versions
from wear.report.text import parsed, template
from wear.request import cycles_along, obstacle
from wear.scene import Scene
from wear.scene.notices import implausible_results
from wear.sensitivities import Sensitivities, sensitivity
from wear.solver import solve

_DEPTHS = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0)  # whose life is reported, in initial roughnesses
_INSIDE = (0, 10, 100, 1000)  # cycles whose pressure is drawn
_LAST = 10**8  # cycle of the curves
_POINTS = 120  # of a curve
_EARLY = 1000  # cycles after which sensitivities are shown beside those at the last cycle
_BARS = 15  # of the tornado diagram


def report(scene: Scene, command: str, specimens: Sequence[Specimen] = ()) -> Document:
    """Return the report of a scene, with the readings of `specimens` of it."""
    limit = None if isinstance(scene.load, Blocks | HistoryLoad) else asymptote(scene)
    curve = _solved(scene)
    inside = [n for n in _INSIDE if n < curve.cycles[-1]] or [0]
    pressures = None if limit is None else pressure_inside(scene, inside)
    equations = shown(_equations(scene, limit))
    sensitivities = _sensitivities(
        scene, [n for n in (_EARLY, int(curve.cycles[-1])) if n <= curve.cycles[-1]]
    )
    values: dict[str, Any] = {
        "scene": scene,
        "limit": limit,
        "curve": curve,
        "quantities": QUANTITIES,
        "mm": WEAR.scale,
        "kind": _kind(scene),
        "written": number,
        "notices": [
            markup(text)
            for text in dict.fromkeys(
                (*scene.notices, *(limit.notices if limit else ()), *curve.notices)
            )
            if not text.startswith("auto: ")
        ],
        "identifiers": list(equations),
        "states": [n for n, cycle in enumerate(curve.cycles[:-1]) if _power_of_ten(cycle)] + [-1],
        "columns": curve.columns(),
        "life": list(_life(scene)) if obstacle(scene) is None else [],
        "loses_contact": bool(np.any(curve.pressures.contact_fraction < 1.0)),
        "command": command,
        "versions": versions(),
    }
    drawings = {
        "scene": schematic.of_scene(scene),
        "history": figures.history(panels_of([curve]), logarithmic=True),
    }
    if pressures is not None:
        drawings["inside"] = figures.pressure_in_cycles(pressures)
    if sensitivities is not None:
        drawings["sensitivities"] = _tornado(sensitivities)
    if specimens:
        comparison, drawings["readings"] = _readings(scene, specimens)
        values |= comparison
    values["drawings"] = drawings
    return Document(parsed(template("scene.md"), values), equations, drawn(drawings))


def _solved(scene: Scene) -> History:
    """Return the state along cycles, powers of ten among them, up to the end of the load and within
    the scope of the model."""
    curve = _best(scene, min(_LAST, most_cycles(scene.load)))
    ends = [n for n in range(1, len(curve.cycles) + 1) if _power_of_ten(curve.cycles[n - 1])]
    plausible = [
        int(curve.cycles[n - 1])
        for n in ends
        if not any(
            implausible_results(scene, curve.cycles[:n].tolist(), curve.u_c[:n], curve.sigma_c[:n])
        )
    ]
    if not plausible or len(plausible) == len(ends):
        return curve
    return _best(scene, plausible[-1])


def _best(scene: Scene, last: int) -> History:
    """Return the state along cycles up to the last, as accurate as the scene allows."""
    cycles = cycles_along(1, last, _POINTS, [10**n for n in range(9) if 10**n < last])
    try:
        return solve(scene, cycles, rtol=1e-10)
    except AccuracyError as missed:
        best: History | None = missed.best
        if best is None:
            raise
        return best


def _power_of_ten(cycle: int) -> bool:
    return str(cycle).strip("0") == "1"


def _equations(scene: Scene, limit: Asymptote | None) -> list[derived.Equation]:
    """Return the equations of the variant, and those of its long-term behaviour."""
    key, opening = scene.variant, scene.contact.pin_wear_opens_gap
    if key.given_load:
        return [equation("problem-i")]
    law = own_law(key.law.removeprefix(PREFIX))[0] if is_own(key.law) else LAWS[key.law]
    variant = Variant(law, key.support == "compliant", Pin(key.pin), key.ends_at_3_sigma)
    chosen: dict[str, str | bool] = {
        "law": key.law, "pin": key.pin, "compliant": variant.compliant, "opening": opening,
        "cutoff": key.ends_at_3_sigma, "regime": _regime(scene, limit), "load": _kind(scene),
    }  # fmt: skip
    model = equations_of(variant, opening=opening)
    long_run = [equation(identifier) for identifier in holding(chosen)]
    return [*model, *(map(opened, long_run) if opening else long_run)]


def _regime(scene: Scene, limit: Asymptote | None) -> str:
    """Return the regime by which the equations are chosen: of steady wear without a logarithm
    there is one where gap and cutoff grow alike, and else none."""
    if limit is None:
        return ""
    if limit.regime != "steady" or limit.log_coefficient_mm is not None:
        return limit.regime
    alike = scene.bearing.roughness_growth == 1 / 3
    return "partial" if scene.contact.ends_at_3_sigma and alike else ""


def _kind(scene: Scene) -> str:
    return str(scene.to_tables()["load"]["kind"])


def _life(scene: Scene) -> Iterator[tuple[float, float, str, float]]:
    """Return depths (mm), each with its number of cycles, the way in which that is found, and its
    hours; unknown numbers are NaN."""
    depths = [depth * scene.initial_roughness for depth in _DEPTHS]
    life = cycles_until(scene, depths, rtol=1e-8)
    loaded = np.where(life.cycles <= most_cycles(scene.load), life.cycles, np.nan)
    hours = Abscissa.HOURS.of(scene, loaded).tolist()
    ways = [way.value for way in life.reached]
    return zip(depths, life.cycles.tolist(), ways, hours, strict=True)


def _sensitivities(scene: Scene, cycles: list[int]) -> Sensitivities | None:
    """Return the sensitivities of the wear to the numbers of the scene, None if unknown."""
    try:
        sensitivities = sensitivity(scene, sorted(set(cycles)), rtol=1e-8)
    except UsageError:
        return None
    return sensitivities if np.isfinite(sensitivities.error).all() else None


def _tornado(sensitivities: Sensitivities) -> Figure:
    """Draw the largest elasticities, without those of the rows of a load."""
    keys, elasticity = sensitivities.keys, sensitivities.elasticity
    order = np.argsort(-np.max(np.abs(np.nan_to_num(elasticity)), axis=1))
    largest = [i for i in order if not re.search(r"(values_mm|forces_N)\[", keys[i])][:_BARS]
    return figures.tornado([keys[i] for i in largest], elasticity[largest], sensitivities.cycles)


def _readings(scene: Scene, specimens: Sequence[Specimen]) -> tuple[dict[str, Any], Figure]:
    """Return the readings beside the prediction (mm), their scatter about it, and a figure."""
    runs = {each.name or "predicted": scene.with_(each.changes) for each in specimens}
    rows, lines = [], []
    for place, (each, name) in enumerate(zip(specimens, runs, strict=True)):
        cycles = cycles_along(*each.cycles[[0, -1]].tolist(), _POINTS, each.cycles)
        curve = solve(runs[name], cycles, rtol=1e-8)
        predicted = curve.u_c[np.searchsorted(curve.cycles, each.cycles)]
        pairs = zip(each.cycles.astype(int), each.wear_mm, predicted, strict=True)
        rows += [(each.name, *numbers) for numbers in pairs]
        lines.append(Line(as_typed(name), curve.cycles.astype(float), curve.u_c, place))
    ratios = np.array([wear / mean for _, _, wear, mean in rows if wear > 0.0] or [1.0])
    ratio, scatter = np.exp([np.mean(np.log(ratios)), np.std(np.log(ratios))])
    read = np.concatenate([each.cycles for each in specimens])
    logarithmic = bool(read.max() > 100.0 * read.min())
    panel = Panel(WEAR, tuple(lines), points_of(specimens, runs, Abscissa.CYCLES))
    comparison = {"readings": rows, "ratio": ratio, "scatter": scatter}
    return comparison, figures.history([panel], logarithmic=logarithmic)
