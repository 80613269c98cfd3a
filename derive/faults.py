"""Faults that are the user's to mend; their text says how."""

from __future__ import annotations


class UsageError(ValueError):
    """Something was asked for that does not exist or does not make sense."""
