"""The long-time behaviour of wear: the regime of a scene and its constants.

Overview
    Without loss of contact, wear becomes steady where roughness grows and logarithmic where it is
    constant; where roughness would vanish, wear saturates or reaches that depth in finite time.
    With loss of contact, in the text under Eq. (4), wear arrests unless roughness outgrows the gap.
    The formulas are generated from the derivation, and evaluated in decimal arithmetic with more
    digits than a double has, so that the results are accurate to the last place.
Key results
    asymptote    the regime and constants of a scene
    Asymptote    the result
"""

from __future__ import annotations

import decimal
import inspect
import math
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from decimal import Decimal
from typing import Any

import numpy as np

from wear import own_laws
from wear.binding import bind
from wear.cycle_means import cycle_mean
from wear.cycles import orbit_of_scene
from wear.faults import AccuracyError
from wear.generated import asymptotics as formula
from wear.generated import reaction
from wear.load import Load
from wear.offset import offset
from wear.outcome import FADES
from wear.quantities import MOST_CYCLES
from wear.scene import Scene, as_scene
from wear.solver import solve
from wear.stabilisation import TOLERANCE, settled
from wear.states import fields_at, negative_roughness

_DIGITS = decimal.Context(prec=60, Emin=-(10**15), Emax=10**15)
_DIGITS.traps[decimal.Overflow] = False  # infinity: the pressure of a gap beyond all bounds is zero
_PHASES = (np.arange(4096) + 0.5) / 4096  # of a cycle
_FAR = 1e12  # a wear in mm at which every roughness that falls is negative

VANISHES = "the roughness vanishes in finite time; the model ends there"
CLOSES = "with the sign of Eq. (1) as printed, wear of the pin closes the gap without end"
TAIL = (
    "this regime rests on a pressure that falls exponentially with h/sigma, which is not checked "
    "for a law of one's own"
)


@dataclass(frozen=True)
class Asymptote:
    """The long-time behaviour of a scene; values that do not apply are None.

    Where wear goes on, ``u_c(N T) = wear_per_cycle_mm N + log_coefficient_mm ln N + offset_mm +
    o(1)``.  ``arrest_cycle`` is the cycle, counted from 1, in which wear stops for good.
    ``cycles_to_stabilise`` are the cycles after which the wear rate is within 1e-6 of its limit:
    on average over a cycle, and at every instant.
    """

    scene: str
    regime: str
    tanh_argument: float | None = None
    wear_per_cycle_mm: float | None = None
    pressure_MPa: float | None = None
    log_coefficient_mm: float | None = None
    offset_mm: float | None = None
    saturation_wear_mm: float | None = None
    arrest_wear_mm: float | None = None
    arrest_cycle: int | None = None
    cycles_to_stabilise: dict[str, float | None] = field(default_factory=dict)
    notices: tuple[str, ...] = ()

    def __repr__(self) -> str:
        ends = ("wear_per_cycle_mm", "saturation_wear_mm", "arrest_wear_mm", "arrest_cycle")
        values = {name: getattr(self, name) for name in ends}
        known = [f"{name} = {value:.6g}" for name, value in values.items() if value is not None]
        return f"<Asymptote of {self.scene!r}: {', '.join([self.regime, *known])}>"


class _Case:
    """The numbers of a scene as arguments of the formulas: exactly the doubles of the scene."""

    def __init__(self, scene: Scene) -> None:
        load = scene.periodic_load
        self.scene, self.load = scene, load
        plain = {"f_a": 0.0, "sigma_a0": 0.0, "K_a": 0.0, "H_a": 1.0} | scene.parameters()
        plain |= {"U_min": load.minimum, "U_max": load.maximum, "U_mean": load.mean}
        self.numbers = plain
        self.data = {name: Decimal(value) for name, value in plain.items()}
        # rounded as in the solver's model, so that equal wear of both solids is exactly equal
        self.data["kappa"] = Decimal(float(self.value(formula.pin_wear)))
        opening = scene.contact.pin_wear_opens_gap
        gap = formula.closure_growth_opening if opening else formula.closure_growth
        self.data |= {
            "q": self.value(formula.roughness_growth),
            "g": self.value(gap),
            "p_1": self.value(formula.cross_roughness),
        }

    def value(self, function: Callable[..., Any], *arguments: Decimal, **more: Decimal) -> Decimal:
        """Evaluate a generated formula with the data that are its arguments."""
        return Decimal(function(*arguments, **_named(function, {**self.data, **more})))

    def holds(self, guard: Callable[..., Any], **more: float) -> bool:
        """Evaluate a generated condition in the double precision of the solver."""
        return bool(guard(**_named(guard, {**self.numbers, **more})))

    def law(self, kind: str) -> Callable[..., Any]:
        """Return the formula of this scene's contact law."""
        law = self.scene.contact.law
        if own_laws.is_own(law):
            own = getattr(own_laws.module(law, "law"), f"{kind}_own")
            return lambda ratio: Decimal(float(own(float(ratio))))
        found: Callable[..., Any] = getattr(formula, f"{kind}_{law}")
        return found

    @property
    def doubts(self) -> tuple[str, ...]:
        """Return the notice on a regime without steady contact under a law of the scene's own."""
        return (TAIL,) if own_laws.is_own(self.scene.contact.law) else ()

    def wear_at(self, pressure: float) -> float:
        """Return the wear of one cycle under a constant pressure, mm."""
        known = {**self.numbers, "p_inf": pressure}
        return float(formula.wear_per_cycle(**_named(formula.wear_per_cycle, known)))

    @property
    def vanishing(self) -> Decimal | None:
        """Return the wear at which the equivalent roughness vanishes, if it does."""
        if self.data["q"] == 0 or self.value(formula.apart) != 0:
            return None
        wear = self.value(formula.vanishing_wear)
        return wear if wear > 0 else None


def _named(function: Callable[..., Any], known: Mapping[str, Any]) -> dict[str, Any]:
    """Return the data that are arguments of a generated function."""
    return {name: known[name] for name in inspect.getfullargspec(function).kwonlyargs}


def asymptote(scene: Scene | str | os.PathLike[str]) -> Asymptote:
    """Return the long-time behaviour of a scene, given as an object, a built-in name or a path.

    Raises
    ------
    UsageError
        if the load does not repeat.
    AccuracyError
        if the constants of an extreme scene cannot be computed.

    >>> found = asymptote("section4")
    >>> found.regime, f"{found.wear_per_cycle_mm:.10e}"
    ('steady', '4.6355474275e-08')
    """
    scene = as_scene(scene)
    with decimal.localcontext(_DIGITS):
        try:
            case = _Case(scene)
            if scene.given_load:
                return _given_load(case)
            return _with_cutoff(case) if scene.contact.ends_at_3_sigma else _without_cutoff(case)
        except decimal.DecimalException as fault:
            raise AccuracyError("asymptote: its constants are beyond all numbers") from fault


def _result(case: _Case, regime: str, **found: Any) -> Asymptote:
    notices = (*case.scene.notices, *found.pop("notices", ()))
    return Asymptote(case.scene.title or case.scene.name, regime, notices=notices, **found)


def _given_load(case: _Case) -> Asymptote:
    """Return the asymptote of problem (i): the wear of every cycle is that of the mean pressure."""
    pressure = float(reaction.pressure(case.load.mean, b=case.numbers["b"], L=case.numbers["L"]))
    end = None if case.data["q"] >= 0 else case.vanishing
    return _result(
        case,
        "finite-time" if end else "steady",
        wear_per_cycle_mm=case.wear_at(pressure),
        pressure_MPa=pressure,
        log_coefficient_mm=0.0,
        offset_mm=0.0,
        saturation_wear_mm=float(end) if end else None,
        notices=(VANISHES,) if end else (),
    )


def _without_cutoff(case: _Case) -> Asymptote:
    data = case.data
    if data["q"] == 0:
        return _constant_roughness(case)
    end = case.vanishing
    if end is None:
        return _steady(case)
    gap, yields = case.value(formula.gap_at_peak, end), case.scene.support is not None
    if gap > 0 or (gap == 0 and (yields or _has_sharp_peaks(case.load))):
        just = "like a power of the cycles" if yields else "exponentially"
        how = "logarithmically slowly" if gap > 0 else just
        said = f"wear approaches this depth, {how}, as the roughness vanishes"
        notices = (said, *case.doubts)
        return _result(case, "saturating", saturation_wear_mm=float(end), notices=notices)
    return _result(case, "finite-time", saturation_wear_mm=float(end), notices=(VANISHES,))


def _has_sharp_peaks(load: Load) -> bool:
    """Return whether the load rises to each of its highest peaks and falls from there with slopes
    other than zero, so that it spends little time near them."""
    tops = [peak for peak in load.peaks if load(peak) == load.maximum]
    return all(top in load.kinks and load.slope(top) < 0.0 for top in tops)


def steady_wear_per_cycle(scene: Scene) -> float:
    """Return the wear of a cycle (mm) in the steady state, Eq. (21), of a scene whose roughness
    grows."""
    with decimal.localcontext(_DIGITS):
        case = _Case(scene)
        return case.wear_at(float(_steady_pressure(case)))


def fresh_wear_per_cycle(scene: Scene) -> float:
    """Return the wear of the first cycle (mm) with the rate frozen at no wear."""
    load = scene.periodic_load
    return float(np.mean(bind(scene).rate(0.0, load(_PHASES)))) * load.period


def _steady_pressure(case: _Case) -> Decimal:
    share = case.law("share")(case.value(formula.closure_ratio))
    return case.value(formula.pressure, share)


def _steady(case: _Case, notices: tuple[str, ...] = ()) -> Asymptote:
    ratio, pressure = case.value(formula.closure_ratio), _steady_pressure(case)
    per_cycle = case.wear_at(float(pressure))
    case.data["p_inf"] = pressure
    steepness = Decimal(case.law("steepness")(ratio))
    compliant = case.scene.support is not None
    drift = formula.log_coefficient_compliant if compliant else formula.log_coefficient
    mean = case.value(drift, steepness)
    extremes = [case.value(drift, steepness, U_mean=case.data[end]) for end in ("U_min", "U_max")]
    if case.data["g"] < 0:
        notices = (*notices, CLOSES)
    notices = (*notices, *_negative_roughness(case, _FAR))
    tanh = case.scene.contact.law == "tanh"
    found = offset(case.scene, per_cycle, float(mean))
    if found is None:
        notices = (*notices, "offset unknown: 1e12 cycles do not reach steady wear")
    if per_cycle == 0.0:
        said = f"wear goes on, if under a pressure of {pressure:.3g} MPa: shown as 0"
        notices = (*notices, said)
    on_average = settled(case.scene, float(pressure), _cycles(abs(mean), per_cycle))
    everywhere = _cycles(max(map(abs, extremes)), per_cycle)
    until = [on_average, everywhere and max(everywhere, on_average or 0.0)]
    if any(each and not _lasts(case.scene, each * per_cycle) for each in until):
        until = [None, None]
        said = "contact is not yet permanent when the rate would be within 1e-6 of its limit"
        notices = (*notices, f"{said}: the cycles to that are unknown")
    return _result(
        case,
        "steady",
        offset_mm=None if found is None else found.value,
        tanh_argument=float(formula.tanh_argument(ratio)) if tanh else None,
        wear_per_cycle_mm=per_cycle,
        pressure_MPa=float(pressure),
        log_coefficient_mm=float(mean),
        cycles_to_stabilise={"mean_rate_within_1e-6": until[0], "rate_within_1e-6": until[1]},
        notices=notices,
    )


def _cycles(drift: Decimal, per_cycle: float) -> float | None:
    """Return the cycles, at least one, after which ``drift/(N per_cycle)`` is within the
    criterion."""
    if per_cycle == 0.0:
        return None
    return max(float(drift / (Decimal(per_cycle) * Decimal(TOLERANCE))), 1.0)


def _lasts(scene: Scene, wear: float) -> bool:
    """Return whether contact lasts throughout a cycle at a wear (mm)."""
    model, least = bind(scene), scene.periodic_load.minimum
    return not model.ends_at_3_sigma or bool(model.margin(wear, least) > model.held_margin)


def _constant_roughness(case: _Case) -> Asymptote:
    """Return the asymptote at constant roughness: the logarithmic regime, if wear opens the gap."""
    gap = case.data["g"]
    if gap > 0:
        sigma, growth = case.scene.initial_roughness, float(gap)
        level = _log_load_factor(case.load, sigma)
        largest = case.wear_at(case.numbers["p_max"]) * growth
        coefficient = formula.tail_coefficient(sigma_c0=sigma) / growth
        start = case.numbers["h_0"]
        offset = formula.tail_offset(level, h_0=start, sigma_c0=sigma, M=largest) / growth
        applies = case.scene.contact.law == "tanh" and case.scene.support is None
        return _result(
            case,
            "logarithmic",
            wear_per_cycle_mm=0.0,
            pressure_MPa=0.0,
            log_coefficient_mm=float(coefficient) if applies else None,
            offset_mm=float(offset) if applies else None,
            notices=case.doubts,
        )
    if gap < 0:
        pressure = case.numbers["p_max"]
        steady = {"wear_per_cycle_mm": case.wear_at(pressure), "pressure_MPa": pressure}
        return _result(case, "steady", **steady, notices=(CLOSES,))
    said = "wear changes neither closure nor roughness: every cycle is like the first"
    first = float(solve(case.scene, [1], rtol=1e-12).u_c[0])
    return _result(case, "steady", wear_per_cycle_mm=first, notices=(said,))


def _log_load_factor(load: Load, sigma: float) -> float:
    """Return the logarithm of the mean of exp(4 U_a/sigma) over a period, without overflow."""
    scale = sigma / 4.0
    mean = cycle_mean(load, lambda U_a: np.exp((U_a - load.maximum) / scale), scale=scale)
    return load.maximum / scale + math.log(mean)


def _with_cutoff(case: _Case) -> Asymptote:
    depth, end = _arrest_depth(case), case.vanishing
    if end is not None and (depth is None or depth >= end):
        return _without_cutoff(case)  # the roughness vanishes while there is contact
    if depth is not None:
        return _arrest(case, depth)
    if case.data["q"] == 0:
        return _constant_roughness(case)  # the gap never opens
    one_solid = case.data["kappa"] == 0 and case.data["sigma_a0"] == 0
    if one_solid and case.holds(formula.gap_and_cutoff_grow_alike):
        return _at_one_third(case)
    if not one_solid:
        return _steady(case, ("no wear ends contact at the peak of the load",))
    permanent = float(case.value(formula.permanent_depth))
    said = f"contact is permanent beyond a wear of {max(permanent, 0.0):.6g} mm"
    return _steady(case, (said,))


def _arrest_depth(case: _Case) -> float | None:
    """Return the wear at which the peak of the load no longer makes contact, if there is one."""
    data = case.data
    if bind(case.scene).margin(0.0, case.load.maximum) <= 0.0:
        return 0.0
    if data["kappa"] == 0 and data["sigma_a0"] == 0:
        falls = case.holds(formula.gap_outgrows_roughness)
        return float(case.value(formula.arrest_depth)) if falls else None
    begin = Decimal(0)
    if case.value(formula.gap_at_peak, begin) < 0:
        if data["g"] <= 0:
            return None
        begin = case.value(formula.gap_opens)
    if not formula.margin_is_lost(begin, **_named(formula.margin_is_lost, data)):
        return None
    depth = case.value(formula.arrest_depth_two_solids, begin)
    # A gap that closes has a second root, where it is less than -3 sigma.
    return float(depth) if case.value(formula.gap_at_peak, depth) > 0 else None


def _arrest(case: _Case, depth: float) -> Asymptote:
    if depth == 0.0:
        reached = bind(case.scene).margin(0.0, case.load.maximum) == 0.0
        just = "the peak of the load just reaches h = 3 sigma, which is taken as no contact"
        said = just if reached else "the peak of the load never makes contact"
        return _result(case, "arrest", arrest_wear_mm=0.0, arrest_cycle=0, notices=(said,))
    cycle, notices = _arrest_cycle(case)
    return _result(
        case,
        "arrest",
        wear_per_cycle_mm=0.0,
        pressure_MPa=0.0,
        arrest_wear_mm=depth,
        arrest_cycle=cycle,
        notices=(*_negative_roughness(case, depth), *notices),
    )


def _negative_roughness(case: _Case, wear: float) -> tuple[str, ...]:
    """Return a notice for each solid whose roughness is negative at a wear."""
    model, reached = bind(case.scene), np.array([wear])
    return negative_roughness(model, fields_at(model, case.scene, [0], reached), reached)


def _arrest_cycle(case: _Case) -> tuple[int | None, tuple[str, ...]]:
    """Return the cycle in which wear stops, None if it is unknown, and the notices."""
    if case.scene.support is not None:
        return None, ("on a compliant support wear nears the depth of arrest without reaching it",)
    orbit = orbit_of_scene(bind(case.scene), case.load, MOST_CYCLES, 1e-12)
    end = orbit.end
    if end is not None and end.way == FADES:
        return None, (str(end),)
    if end is not None:
        return end.cycle, (str(end),) if end.uncertain else ()
    _, error = orbit.after(np.array([float(MOST_CYCLES)]))
    if np.isfinite(error).all():
        return None, (f"wear goes on for more than {MOST_CYCLES:.0e} cycles",)
    return None, ("the cycle in which wear stops cannot be counted",)


def _at_one_third(case: _Case) -> Asymptote:
    """Return the asymptote at f_c = 1/3: contact in a fixed part of every cycle.

    On springs the pressure is proportional to the margin up to the one at which the gap is held.
    """
    model, load = bind(case.scene), case.load
    begins, held = -float(model.margin(0.0, 0.0)), float(model.held_margin)
    pressure = float(_steady_pressure(case))
    share = part = cycle_mean(load, lambda U_a: np.where(U_a >= begins, 1.0, 0.0), [begins])
    peak = 1.0
    if held > 0.0:
        ends = [begins, begins + held]
        share = cycle_mean(load, lambda U_a: np.clip(model.margin(0.0, U_a) / held, 0.0, 1.0), ends)
        peak = min(1.0, float(model.margin(0.0, load.maximum)) / held)
    return _result(
        case,
        "steady",
        wear_per_cycle_mm=case.wear_at(share * pressure),
        pressure_MPa=peak * pressure,
        notices=(
            f"contact lasts {part:.4g} of every cycle",
            "the contact pressure is its limit at the peak of the load",
        ),
    )
