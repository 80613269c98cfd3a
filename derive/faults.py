"""Faults that the user can mend; their text says how."""

from __future__ import annotations


class UsageError(ValueError):
    """A request names something that does not exist, or makes no sense."""
