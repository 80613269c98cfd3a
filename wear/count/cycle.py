"""The one-cycle map u -> P(u): the wear that one cycle adds, for many starts at once.

A cycle is cut into intervals of phase and solved on them by collocation.
"""

from typing import NamedTuple, Protocol

from wear.numerics.collocation import (
    CycleSolution,
    InitialGuess,
)
from wear.numerics.gauss import (
    FloatArray,
    Mesh,
)
from wear.numerics.tolerances import (
    ROUNDOFF,
)

MOST_INTERVALS = 256  # of one cycle
COARSEST = 1e-6  # relative error: coarser meshes of phase would not tell what they miss


class Cost(NamedTuple):
    """What a result took: starts times cycles integrated, right-hand sides evaluated."""

    cycles_integrated: int
    rhs_evaluations: int

    def plus(self, cycles: int, evaluations: int) -> "Cost":
        """The cost after so much more work."""
        return Cost(self.cycles_integrated + cycles, self.rhs_evaluations + evaluations)


class Settings(NamedTuple):
    """Sizes of the discretisation for a requested relative error."""

    phase_nodes: int  # on each interval of phase
    phase_tolerance: float  # of `unresolved`, which mostly tells ten times the error and more
    strict_tolerance: float  # of what nothing else would tell, or mend
    panel_nodes: int  # on each panel of wear
    tail_tolerance: float  # of the frozen density on a panel
    residual_tolerance: float  # of Abel's equation

    @property
    def finer_nodes(self) -> int:
        """Nodes on each interval of phase for the map that judges."""
        return self.phase_nodes + 6


def settings(rtol: float) -> Settings:
    """Few nodes for few digits: what is cheapest for `rtol` on smooth loads."""
    phase_nodes, panel_nodes = (24, 48) if rtol < 1e-8 else (16, 24)
    return Settings(
        phase_nodes=phase_nodes,
        phase_tolerance=max(2 * min(rtol, COARSEST), ROUNDOFF),
        strict_tolerance=max(1e-2 * min(rtol, COARSEST), ROUNDOFF),
        panel_nodes=panel_nodes,
        tail_tolerance=max(rtol / 4, 1e-12),
        residual_tolerance=max(rtol / 4, 30 * ROUNDOFF),
    )


class OneCycle(Protocol):
    """The one-cycle map of a scene, on a mesh that can be changed."""

    @property
    def over(self) -> Mesh: ...

    @property
    def most_intervals(self) -> int:
        """Where refining stops."""

    def on(self, over: Mesh) -> "OneCycle":
        """The same on another mesh."""

    def resolved(self, wear: FloatArray, size: Settings) -> "OneCycle":
        """On a mesh that suits the wear values (k,), mm."""

    def advance(self, starts: FloatArray, near: InitialGuess | None = None) -> CycleSolution:
        """Wear added by one cycle from each start, mm, any shape (...); from a guess with the shape
        (..., q, m)."""

    def frozen(self, wear: FloatArray) -> FloatArray:
        """Wear (mm) added by one cycle if the rate did not feel it, any shape."""

    def several(self, start: float, number: int) -> CycleSolution:
        """Some cycles on end; increments have shape (number,), the rest (number, q, m), the wear
        inside each cycle since its own start."""
