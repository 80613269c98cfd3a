"""Steady wear: the results of ``steady_state``, for any contact law where they hold for any.

``growth`` and ``approach`` are those of the note's law: their bounds are in terms of it.
"""

from __future__ import annotations

from ..laws import GENERAL
from ..note.condensed import bearing_only
from .steady_state import steady_state

deviation = steady_state(GENERAL).deviation
growth = steady_state().growth
general_rate = bearing_only(GENERAL).rigid
closure_ratio = steady_state(GENERAL).ratio
general_law = steady_state(GENERAL).pressure
approach = steady_state().approach
