"""Other people's integrators on the same equation, for `wear bench --peers` in a checkout.

No formula is typed here: a generated right-hand side is *traced*. Its NumPy functions are called
with an object that stands for the unknown and turns every operation into one of the peer's own
(`Traced`), so that heyoka, JiTCODE and JAX compile what `wear` itself runs. numba compiles the
generated function as it is.

All are set up as their authors advise: a variable of order one (wear over that of the first cycle),
time in cycles, absolute and relative tolerance alike, compiled once a scene, no step so long that
it could miss a contact pulse (a Taylor method sees the pulses in its series).
"""

from __future__ import annotations

import contextlib
import logging
import tempfile
from collections.abc import Callable, Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wear.benchmark.methods import Answer, Method, Run, UnsuitableError

if TYPE_CHECKING:
    from wear.scene import Scene

TOLERANCES = (1e-4, 1e-6, 1e-9, 1e-12)
MOST_STEPS = 10**9
WIDEST = 6.0  # longest step over `widest_step`: found to be fastest at equal true error
STAGES_OF_DOPRI8 = 13  # evaluations a step, the first being the last of the step before

Functions = Mapping[Any, Callable[..., Any]]


class Traced(np.lib.mixins.NDArrayOperatorsMixin):
    """A peer's expression that NumPy's functions accept, and answer with another one."""

    def __init__(self, expression: Any, functions: Functions) -> None:
        self.expression = expression
        self.functions = functions

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Traced:
        if method != "__call__" or options or ufunc not in self.functions:
            raise UnsuitableError(f"the right-hand side needs numpy.{ufunc.__name__}")
        plain = (x.expression if isinstance(x, Traced) else float(x) for x in inputs)
        return Traced(self.functions[ufunc](*plain), self.functions)


def functions(library: Any, minimum: Callable[[Any, Any], Any] | None = None) -> Functions:
    """What NumPy's functions are in a library that overloads arithmetic.

    Without `minimum`, the bound that keeps an exponential finite is left out: the scenes that are
    compared stay far below it.
    """
    return {
        np.add: lambda a, b: a + b,
        np.subtract: lambda a, b: a - b,
        np.multiply: lambda a, b: a * b,
        np.divide: lambda a, b: a / b,
        np.negative: lambda a: -a,
        np.sqrt: library.sqrt,
        np.exp: library.exp,
        np.minimum: minimum or (lambda a, _: a),
    }


class Equation(NamedTuple):
    """dy/dphase for y = u_c/unit, with all that a peer needs to write it down."""

    module: Any
    constants: Any
    amplitude: float  # mm
    period: float  # s
    unit: float  # mm
    longest: float  # step, in cycles

    def traced(self, y: Any, phase: Any, library: Any, **options: Any) -> Any:
        """The right-hand side in a peer's expressions."""
        known = functions(library, **options)
        load = self.amplitude * library.sin(2.0 * np.pi * phase)
        u = Traced(y * self.unit, known)
        return self.module.rate(u, Traced(load, known), self.constants).expression * self.scale

    @property
    def scale(self) -> float:
        """dy/dphase over du/dt."""
        return self.period / self.unit


def equation(scene: Scene) -> Equation:
    """Bind a scene.

    Raises
    ------
    UnsuitableError
        unless it is one smooth differential equation under a sine load.
    """
    from wear.binding import bind
    from wear.direct.problem import scaled_ode, widest_step
    from wear.load import Sine

    if (
        scene.support is not None
        or scene.contact.ends_at_3_sigma
        or not isinstance(scene.load, Sine)
    ):
        raise UnsuitableError("not set up for a support, a cutoff or a load that is no sine")
    model = bind(scene)
    of = scaled_ode(model, scene.load)
    constants = model.constants._replace(
        **{name: float(value) for name, value in model.constants._asdict().items()}
    )
    return Equation(
        model.module,
        constants,
        scene.load.amplitude_mm,
        scene.load.period,
        of.unit,
        min(1.0, WIDEST * widest_step(of, 0.0, 1.0)),
    )


def heyoka(scene: Scene) -> Run:
    """Taylor's method of an order that suits the tolerance, compiled by LLVM for each."""
    library = import_module("heyoka")
    given = equation(scene)
    y = library.make_vars("y")
    system = [(y, given.traced(y, library.time, library))]
    compiled = {tol: library.taylor_adaptive(system, [0.0], tol=tol) for tol in TOLERANCES}

    def run(cycles: int, tolerance: float) -> Answer:
        solver = compiled[tolerance]
        solver.time, solver.state[:] = 0.0, 0.0
        outcome = solver.propagate_until(float(cycles))[0]
        complaint = "" if outcome == library.taylor_outcome.time_limit else str(outcome)
        return Answer(float(solver.state[0]) * given.unit, complaint=complaint)

    return run


def diffrax(scene: Scene) -> Run:
    """Dormand and Prince's method of order 8, compiled by XLA."""
    jax, solver = import_module("jax"), import_module("diffrax")
    jax.config.update("jax_enable_x64", True)
    given = equation(scene)

    def rate(phase: Any, y: Any, _: Any) -> Any:
        return given.traced(y, phase, jax.numpy, minimum=jax.numpy.minimum)

    @jax.jit  # type: ignore[untyped-decorator]
    def solve(cycles: Any, tolerance: Any) -> Any:
        return solver.diffeqsolve(
            solver.ODETerm(rate),
            solver.Dopri8(),
            0.0,
            cycles,
            0.1 * given.longest,
            0.0,
            stepsize_controller=solver.PIDController(tolerance, tolerance, dtmax=given.longest),
            max_steps=None,
            adjoint=solver.ForwardMode(),
            saveat=solver.SaveAt(t1=True),
        )

    def run(cycles: int, tolerance: float) -> Answer:
        found = solve(float(cycles), tolerance)
        evaluations = STAGES_OF_DOPRI8 * int(found.stats["num_steps"])
        return Answer(float(found.ys[0]) * given.unit, evaluations=evaluations)

    run(1, TOLERANCES[0])  # compiles
    return run


def jitcode(scene: Scene) -> Run:
    """DOP853 in Fortran on a right-hand side in C."""
    library, symbols = import_module("jitcode"), import_module("symengine")
    given = equation(scene)
    system = library.jitcode([given.traced(library.y(0), library.t, symbols)], verbose=False)
    level = logging.getLogger().level  # setuptools, which compiles, sets it
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        system.compile_C()  # not where a pyproject.toml lies
    logging.getLogger().setLevel(level)

    def run(cycles: int, tolerance: float) -> Answer:
        system.set_integrator(
            "dop853", rtol=tolerance, atol=tolerance, nsteps=MOST_STEPS, max_step=given.longest
        )
        system.set_initial_value([0.0], 0.0)
        return Answer(float(system.integrate(float(cycles))[0]) * given.unit)

    return run


def _numba_rate(given: Equation) -> Callable[[float, float], float]:
    """dy/dphase at phase and y, compiled."""
    numba = import_module("numba")
    rate, constants = numba.njit(given.module.rate), given.constants
    amplitude, unit, scale = given.amplitude, given.unit, given.scale

    def right_hand_side(phase: float, y: float) -> float:
        load = amplitude * np.sin(2.0 * np.pi * phase)
        return scale * rate(y * unit, load, constants)  # type: ignore[no-any-return]

    compiled: Callable[[float, float], float] = numba.njit(right_hand_side)
    compiled(0.0, 0.0)
    return compiled


def numba(scene: Scene) -> Run:
    """SciPy's DOP853 on a right-hand side that numba has compiled."""
    integrate = import_module("scipy.integrate")
    given = equation(scene)
    rate = _numba_rate(given)

    def right_hand_side(phase: float, y: Any) -> tuple[float]:
        return (rate(phase, y[0]),)

    def run(cycles: int, tolerance: float) -> Answer:
        found = integrate.solve_ivp(
            right_hand_side,
            (0.0, cycles),
            [0.0],
            method="DOP853",
            t_eval=[cycles],
            rtol=tolerance,
            atol=tolerance,
            max_step=given.longest,
        )
        complaint = "" if found.success else str(found.message)
        wear = float(found.y[0, -1]) * given.unit
        return Answer(wear, evaluations=int(found.nfev), complaint=complaint)

    return run


def sundials(scene: Scene) -> Run:
    """SUNDIALS' CVODE, Adams' methods for equations that are not stiff, compiled by numba."""
    cvode = import_module("sksundae.cvode")
    given = equation(scene)
    rate = _numba_rate(given)

    def right_hand_side(phase: float, y: Any, slope: Any) -> None:
        slope[0] = rate(phase, y[0])

    def run(cycles: int, tolerance: float) -> Answer:
        solver = cvode.CVODE(
            right_hand_side,
            method="Adams",
            rtol=tolerance,
            atol=np.array([tolerance]),
            max_step=given.longest,
            max_num_steps=MOST_STEPS,
        )
        found = solver.solve(np.array([0.0, float(cycles)]), np.array([0.0]))
        complaint = "" if found.success else str(found.message)
        wear = float(found.y[-1, 0]) * given.unit
        return Answer(wear, evaluations=int(found.nfev), complaint=complaint)

    return run


PEERS = (
    Method("heyoka (Taylor)", ("heyoka",), heyoka, TOLERANCES),
    Method("diffrax (Dopri8)", ("diffrax", "jax"), diffrax, TOLERANCES),
    Method("JiTCODE (dop853)", ("jitcode", "symengine"), jitcode, TOLERANCES),
    Method("SUNDIALS (CVODE Adams)", ("sksundae.cvode", "numba"), sundials, TOLERANCES),
    Method("SciPy DOP853 + numba", ("numba", "scipy.integrate"), numba, TOLERANCES),
)
