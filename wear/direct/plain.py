"""What a user would write first: `solve_ivp` on the raw equation, in mm and s.

Kept for comparison only (benchmark, tests). With SciPy's default tolerances the answer is wrong by
tens of percent without a warning: the absolute tolerance, 1e-6 mm, is a tenth of the wear of the
first cycles, and steps jump over contact pulses.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from wear.load import Load
    from wear.model import Model


class Plain(NamedTuple):
    """Wear in mm after the last cycle, and the number of right-hand sides it took."""

    u: float
    rhs_evaluations: int


def plain(model: Model, load: Load, cycles: int, method: str, **tolerances: float) -> Plain:
    """Integrate over whole cycles in one call of `solve_ivp`.

    Parameters
    ----------
    tolerances
        `rtol` and `atol` (mm) as `solve_ivp` takes them; without any, its defaults.
    """
    from scipy.integrate import solve_ivp

    def right_hand_side(t: float, u: Any) -> Any:
        return model.rate(u, load(t / load.period))

    end = cycles * load.period
    answer = solve_ivp(right_hand_side, (0.0, end), [0.0], method=method, **tolerances)
    return Plain(float(answer.y[0, -1]), int(answer.nfev))
