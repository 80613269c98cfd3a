"""What can go wrong on the user's side: faults of a scene, bad usage, an accuracy out of reach."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

MOST_FAULTS_SHOWN = 50


@dataclass(frozen=True)
class Fault:
    """One thing that is wrong with a scene, where it stands and how to mend it.

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
    """What this package raises where the request is at fault, or the accuracy out of reach.

    `SceneError` and `UsageError` are also `ValueError`s, `AccuracyError` an `ArithmeticError`.
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
    """A request that makes no sense, in words for the user (exit status 2)."""


class Faults(list[str]):
    """What is wrong with a request, gathered until `stop_if_any`."""

    def stop_if_any(self) -> None:
        """Raise a `UsageError` with all of it, a line each."""
        if self:
            raise UsageError("\n".join(self))


class AccuracyError(WearError, ArithmeticError):
    """A solver could not reach the requested accuracy (exit status 3).

    `best` is what it has: a `History` where `solve` raises it, else None.
    """

    def __init__(self, message: str, best: Any = None) -> None:
        super().__init__(message)
        self.best = best


class Interrupted(WearError):  # noqa: N818  # no error: what was computed is good
    """Ctrl-C or a time limit ended a run early (exit status 130).

    `history` is the `History` that it has.
    """

    def __init__(self, message: str, history: Any) -> None:
        super().__init__(message)
        self.history = history


class WorkersLost(WearError):  # noqa: N818  # no error of ours: what was computed is kept
    """The workers of a study went away (exit status 130); the same command goes on."""
