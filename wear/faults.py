"""Exceptions for users: faults of a scene, bad usage, an accuracy out of reach."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

MOST_FAULTS_SHOWN = 50


@dataclass(frozen=True)
class Fault:
    """A fault of a scene, with its place and its remedy.

    `file` names the scene file, the CSV file of a load, or the `--set` option at fault; `line`
    counts from 1; `table` and `key` are empty where the fault is not in one.

    >>> print(Fault("a.toml", 3, "bearing", "hardness_MPa", "-1.0 is not > 0", "give MPa"))
    a.toml:3: [bearing] hardness_MPa: -1.0 is not > 0; give MPa
    """

    file: str
    line: int | None
    table: str
    key: str
    problem: str
    remedy: str

    def __str__(self) -> str:
        place = self.file if self.line is None else f"{self.file}:{self.line}"
        table = f"[{self.table}]" if self.table else ""
        subject = " ".join(part for part in (table, self.key) if part)
        return ": ".join(
            part for part in (place, subject, f"{self.problem}; {self.remedy}") if part
        )


class WearError(Exception):
    """Base of the exceptions for a faulty request, or an accuracy out of reach.

    `SceneError` and `UsageError` are also of type `ValueError`, `AccuracyError` is also an
    `ArithmeticError`.
    """


class SceneError(WearError, ValueError):
    """Every fault of a scene at once (exit status 2); `str` is the text for the user."""

    def __init__(self, faults: Sequence[Fault]) -> None:
        super().__init__(faults)
        self.faults = tuple(faults)

    def __str__(self) -> str:
        shown = [str(fault) for fault in self.faults[:MOST_FAULTS_SHOWN]]
        rest = len(self.faults) - len(shown)
        return "\n".join([*shown, f"... and {rest} more faults"] if rest else shown)


class UsageError(WearError, ValueError):
    """An invalid request, in words for the user (exit status 2)."""


class Faults(list[str]):
    """The faults of a request, collected until `stop_if_any`."""

    def stop_if_any(self) -> None:
        """Raise a `UsageError` with all of them, a line each."""
        if self:
            raise UsageError("\n".join(self))


class AccuracyError(WearError, ArithmeticError):
    """A solver could not reach the requested accuracy (exit status 3).

    `best` is the best result: a `History` where `solve` raises it, otherwise None.
    """

    def __init__(self, message: str, best: Any = None) -> None:
        super().__init__(message)
        self.best = best


class Interrupted(WearError):  # noqa: N818  # no error: the results so far are valid
    """Ctrl-C or a time limit ended a run early (exit status 130).

    `history` is the `History` up to there.
    """

    def __init__(self, message: str, history: Any) -> None:
        super().__init__(message)
        self.history = history


class WorkersLost(WearError):  # noqa: N818  # no error of ours: the results so far are kept
    """The workers of a study were lost (exit status 130); the same command resumes it."""
