"""Steady wear: the results of ``steady_state``, for any contact law where possible.

``growth`` and ``approach`` are for the note's law, in terms of which their bounds are.
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
