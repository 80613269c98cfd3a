"""A report in seconds: parts of the main job that stand in for those that take long.

The true functions are bound when this module is read: tests put the stand-ins in their place.
"""

from collections.abc import Sequence
from functools import cache
from unittest.mock import patch

from derive.catalogue import all_equations
from derive.check import Check
from derive.equations import Equation
from derive.kernel import step_key
from derive.verification import Verification
from wear.bounds import static_bounds, wear_bounds
from wear.report.claims import Entry, decided
from wear.report.document import Document
from wear.report.paper import drawings
from wear.report.paper import paper as written
from wear.report.runs import Runs, run

#: Cycles that are bounded, of 9000.
BOUNDED = (100,)
#: Those that the text speaks of, and some others.
CLAIMS = ("C1", "C4", "C7", "C14", "C15", "C16", "C17", "C24", *(f"C{n}" for n in range(32, 42)))


def trusted(equations: Sequence[Equation]) -> Verification:
    """The outcome of a verification that did not take place."""
    usual = (Check("proof", True, "the move, made again, gives the claim"),)
    steps = {step_key(step): usual for equation in equations for step in equation.steps}
    return Verification(steps, (), len(equations))


@cache
def few_claims() -> tuple[Entry, ...]:
    """Some entries of the ledger, decided in earnest."""
    return tuple(map(decided, CLAIMS))


@cache
def runs() -> Runs:
    """The runs of the report, made once for all tests."""
    with (
        patch("wear.report.runs.INTEGRATED_CYCLES", 50),  # of 600
        patch("wear.report.runs.static_bounds", lambda scene, _: static_bounds(scene, BOUNDED)),
        patch("wear.report.runs.wear_bounds", lambda scene, _: wear_bounds(scene, BOUNDED)),
    ):
        return run()


@cache
def paper() -> Document:
    """The paper on these."""
    found = all_equations()
    return written(found, trusted(found), runs(), few_claims(), drawings(runs()))
