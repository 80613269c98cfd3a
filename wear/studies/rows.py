"""The rows of one chunk, solved together: a pure function, fit for any worker anywhere."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import IntEnum
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from wear.numerics.gauss import FloatArray

if TYPE_CHECKING:
    from wear.scene import Scene
    from wear.studies.design import Chunk, Design

LONGEST_REASON = 200  # characters


class RowStatus(IntEnum):
    """The outcome of a row; `PENDING` before its chunk is solved."""

    DONE = 0
    INVALID_SCENE = 1
    ACCURACY_MISSED = 2
    FAILED = 3
    PENDING = 255


@dataclass(frozen=True)
class Study:
    """A scene, the design by which it varies, and the request for every row: numbers of cycles,
    the wear depth to which cycles are counted, the relative accuracy."""

    scene: Scene
    design: Design
    cycles: tuple[int, ...]
    until_wear: float | None  # mm
    rtol: float


class Answers(NamedTuple):
    """Results of some rows: wear in mm and its relative error (rows, cycles), cycles to the wear
    depth and their relative error (rows,), status and reason (rows,)."""

    bearing_wear_mm: FloatArray
    error_estimate: FloatArray
    cycles_to_wear: FloatArray
    cycles_to_wear_error: FloatArray
    status: NDArray[np.uint8]
    reason: list[str]


def solve_rows(study: Study, columns: Mapping[str, FloatArray]) -> Answers:
    """Return the answers for scenes in which each key takes the values (rows,) of its column.

    A scene that is invalid, misses the accuracy or fails is a row with its status and reason.
    """
    rows = len(next(iter(columns.values())))
    wear, error = np.full((2, rows, len(study.cycles)), np.nan)
    life, life_error = np.full((2, rows), np.nan)
    status = np.zeros(rows, dtype=np.uint8)
    answers = Answers(wear, error, life, life_error, status, [""] * rows)
    scenes: dict[int, Scene] = {}
    for row in range(rows):
        try:
            scenes[row] = study.scene.with_(
                {key: float(column[row]) for key, column in columns.items()}
            )
        except ValueError as fault:  # SceneError is one
            _fail(answers, row, RowStatus.INVALID_SCENE, str(fault))
    if scenes:
        _solve(study, scenes, answers)
    return answers


def solve_chunk(study: Study, chunk: Chunk) -> Answers:
    """Return the answers of one chunk (the function that workers run)."""
    return solve_rows(study, study.design.columns(chunk))


def _fail(answers: Answers, row: int, status: RowStatus, reason: str) -> None:
    answers.status[row] = status
    answers.reason[row] = " ".join(reason.split())[:LONGEST_REASON]


def _solve(study: Study, scenes: Mapping[int, Scene], answers: Answers) -> None:
    """Fill in the answers of rows with valid scenes; one that fails is found by bisection."""
    try:
        _fill_in(study, scenes, answers)
    except Exception as fault:  # of any kind: the other rows have answers
        rows, half = list(scenes), len(scenes) // 2
        if not half:
            _fail(answers, rows[0], RowStatus.FAILED, f"{type(fault).__name__}: {fault}")
            return
        for part in (rows[:half], rows[half:]):
            _solve(study, {row: scenes[row] for row in part}, answers)


def _fill_in(study: Study, scenes: Mapping[int, Scene], answers: Answers) -> None:
    """Solve the rows together, and fill in their answers."""
    from wear.cycles import cycles_to_depth, sweep

    places, valid = np.array(list(scenes)), list(scenes.values())
    wear = sweep(valid, study.cycles, study.rtol)
    if study.until_wear is not None:
        life = cycles_to_depth(valid, study.until_wear, study.rtol)
        answers.cycles_to_wear[places] = life.cycles[:, 0]
        answers.cycles_to_wear_error[places] = life.error[:, 0]
    answers.bearing_wear_mm[places] = wear.u_c
    answers.error_estimate[places] = wear.error
    for row, error in zip(places.tolist(), wear.error.max(axis=1).tolist(), strict=True):
        if not error <= study.rtol:
            reason = f"the estimated error is {error:.1e}, {study.rtol:.1e} was requested"
            _fail(answers, row, RowStatus.ACCURACY_MISSED, reason)
