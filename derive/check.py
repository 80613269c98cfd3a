"""The outcome of one check.

A statement is checked in up to three ways: ``dimensions`` of its claim, a ``proof`` by its rule,
and a ``sample``, values at many digits that know nothing of the proof.
"""

from __future__ import annotations

from typing import NamedTuple


class Check(NamedTuple):
    """What was checked (``kind``), whether it holds, and how that was found out."""

    kind: str
    passed: bool
    detail: str
