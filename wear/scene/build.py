"""Checked values of the `[load]` table to a load, and back."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path as FilePath
from typing import Any

from wear.load import (
    AperiodicLoad,
    Block,
    Blocks,
    Constant,
    Harmonics,
    HistoryLoad,
    Load,
    Sine,
    Table,
)
from wear.scene.check import Path, Problem, Values
from wear.scene.rows import Rows, read_rows
from wear.scene.value import shown

SEAM_TOLERANCE = 1e-9  # of the swing: a period of computed values closes but for their roundoff


def build_load(
    values: Values, folder: FilePath | None
) -> tuple[Load | AperiodicLoad | None, list[Problem]]:
    """The load of a checked `[load]` table, or None and the problems of its CSV files."""
    path: Path = ("load",)
    if values["kind"] != "blocks":
        return _build(values, folder, path)
    blocks, problems = [], []
    for place, block in enumerate(values["blocks"]):
        load, found = _build(block, folder, (*path, "blocks", place))
        problems += found
        if load is not None and not isinstance(load, HistoryLoad):
            blocks.append(Block(load, block["cycles"]))
    if problems:
        return None, problems
    return Blocks(tuple(blocks), values["repeat"]), []


def _build(
    values: Values, folder: FilePath | None, path: Path
) -> tuple[Load | HistoryLoad | None, list[Problem]]:
    match values["kind"]:
        case "sine":
            return Sine(values["amplitude_mm"], values["period_s"]), []
        case "constant":
            return Constant(values["value_mm"], values["period_s"]), []
        case "harmonics":
            terms = values["cosine_mm"], values["sine_mm"]
            return Harmonics(values["mean_mm"], *terms, values["period_s"]), []
    rows, problems = _rows_of(values, folder, path)
    if rows is None:
        return None, problems
    file, digest = values["file"], rows.sha256
    if values["kind"] == "history":
        period = values["period_s"] or rows.times[-1]
        return HistoryLoad(tuple(rows.times), tuple(rows.displacements), period, file, digest), []
    problems = _close_period(rows, values["period_s"], path)
    if problems:
        return None, problems
    return Table(tuple(rows.times), tuple(rows.displacements), file, digest), []


def _rows_of(
    values: Values, folder: FilePath | None, path: Path
) -> tuple[Rows | None, list[Problem]]:
    rows = read_rows(values["file"], folder)
    if not isinstance(rows, Rows):
        return None, [Problem((*path, "file"), wrong.problem, wrong.remedy) for wrong in rows]
    if values["sha256"] not in (None, rows.sha256):
        problem = f"{shown(values['file'])} has changed: its sha256 is {rows.sha256}"
        return None, [Problem((*path, "sha256"), problem, "restore the file, or drop this key")]
    return rows, []


def _close_period(rows: Rows, period: float | None, path: Path) -> list[Problem]:
    """Makes the last row the seam, the first displacement again at the period, where it can."""
    times, displacements, _ = rows
    period = times[-1] if period is None else period
    if abs(period - times[-1]) <= SEAM_TOLERANCE * period:
        times[-1] = period
    elif period < times[-1]:
        problem = f"the rows run to t_s = {times[-1]!r}, past the period"
        return [Problem((*path, "period_s"), problem, "drop period_s or correct it")]
    else:
        times.append(period)
        displacements.append(displacements[0])
    first, last = displacements[0], displacements[-1]
    if abs(last - first) > SEAM_TOLERANCE * (max(displacements) - min(displacements)):
        problem = f"U_a_mm jumps at the seam from {last!r} to {first!r}"
        remedy = "repeat the first U_a_mm in the last row, or give a later period_s"
        return [Problem((*path, "file"), problem, remedy)]
    displacements[-1] = first
    return []


def load_table(load: Load | AperiodicLoad) -> Mapping[str, Any]:
    """The `[load]` table that `build_load` reads back to an equal load."""
    match load:
        case Sine():
            return {"kind": "sine", "amplitude_mm": load.amplitude_mm, "period_s": load.period_s}
        case Constant():
            return {"kind": "constant", "value_mm": load.value_mm, "period_s": load.period_s}
        case Harmonics():
            return {
                "kind": "harmonics",
                "mean_mm": load.mean_mm,
                "cosine_mm": list(load.cosine_mm),
                "sine_mm": list(load.sine_mm),
                "period_s": load.period_s,
            }
        case Table():
            return {
                "kind": "table",
                "file": load.file,
                "period_s": load.period,
                "sha256": load.sha256,
            }
        case HistoryLoad():
            return {
                "kind": "history",
                "file": load.file,
                "period_s": load.period_s,
                "sha256": load.sha256,
            }
        case Blocks():
            blocks = [{**load_table(block.load), "cycles": block.cycles} for block in load.blocks]
            return {"kind": "blocks", "repeat": load.repeat, "blocks": blocks}
    raise TypeError(f"{type(load).__name__} has no form in a scene file")
