"""Records of arrays that share their first axis: panels, scenes, starts.

A record is a named tuple of such arrays, of further records, and of values common to all rows.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, TypeVar, cast

import numpy as np

from wear.numerics.gauss import BoolArray, IntArray

Record = TypeVar("Record", bound=tuple[Any, ...])


def take(record: Record, which: slice | IntArray | BoolArray) -> Record:
    """Return some rows of a record.

    >>> take((np.arange(3), "common"), np.array([2, 0]))
    (array([2, 0]), 'common')
    """
    if isinstance(which, np.ndarray) and which.dtype == bool and which.all():
        return record

    def rows_of(field: Any) -> Any:
        if isinstance(field, tuple):
            return take(field, which)
        return field[which] if isinstance(field, np.ndarray) else field

    return _like(record, map(rows_of, record))


def stacked(records: Sequence[Record]) -> Record:
    """Return the rows of several records, one after the other, with the common values of the first.

    >>> stacked([(np.arange(2), "common"), (np.arange(1), "other")])
    (array([0, 1, 0]), 'common')
    """

    if len(records) == 1:
        return records[0]

    def joined(fields: Sequence[Any]) -> Any:
        if isinstance(fields[0], tuple):
            return stacked(fields)
        return np.concatenate(fields) if isinstance(fields[0], np.ndarray) else fields[0]

    return _like(records[0], map(joined, zip(*records, strict=True)))


def _like(record: Record, fields: Iterable[Any]) -> Record:
    """Return a record of the same kind with other fields."""
    return cast(Record, getattr(record, "_make", tuple)(fields))
