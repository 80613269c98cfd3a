"""`fit`: the parameters of a scene from measured wear, their uncertainty, and forecasts.

Residuals are those of the logarithm of the wear, or of the wear; their scatter is given with the
readings, or unknown. Intervals are profile likelihoods (W. Q. Meeker, L. A. Escobar, *Statistical
Methods for Reliability Data*, Wiley 1998, chapter 8; D. M. Bates, D. G. Watts, *Nonlinear
Regression Analysis*, Wiley 1988, chapter 6): an end that the data leave open is infinite. Bands of
forecasts are those of the linearised model: they hold if the data determine the wear, even if they
do not determine the parameters.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from wear.faults import Faults, UsageError
from wear.fitting import identifiability, laws
from wear.fitting.estimate import Estimate
from wear.fitting.least_squares import descend, estimate
from wear.fitting.model import FitModel
from wear.fitting.profiles import Profile, profiles
from wear.fitting.readings import Specimen
from wear.load.spans import most_cycles
from wear.numerics.gauss import FloatArray
from wear.progress import Pace
from wear.quantities import MOST_CYCLES
from wear.request import check_end, is_number, whole_cycles
from wear.states import notices_of_wear

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from wear.scene import Scene

CANDIDATES = 25  # numbers of cycles at which a further reading is tried
FALLEN = 0.5  # of an earlier reading: a last one that is told
AHEAD = 10.0  # times the cycles of the last reading: the default forecast


class Forecast(NamedTuple):
    """Wear (mm) of a specimen and number of cycles to it; the 95 % band is that of the predicted
    one."""

    specimen: str
    cycles: float
    bearing_wear_mm: float
    interval_95: tuple[float, float]


class NextReading(NamedTuple):
    """The further reading that narrows the forecast of all specimens most, and the factor by which
    it narrows the band."""

    specimen: str
    cycles: float
    band_of_forecast_times: float


@dataclass(frozen=True, eq=False, repr=False)
class Fit(Estimate):
    """Parameters estimated from measured wear, with their uncertainty and forecasts.

    `profiles` has one for each parameter; it is empty where intervals were not asked for.
    """

    profiles: tuple[Profile, ...] = ()

    @classmethod
    def of(
        cls,
        model: FitModel,
        intervals: bool = True,
        progress: Callable[[str], None] = lambda _: None,
    ) -> Fit:
        """Return the fit of a model; `progress` is called with messages after two seconds."""
        report = Pace(progress).say
        found = Estimate(model, estimate(model, report))
        if not intervals:
            return cls(model, found.best)
        best, followed = profiles(found, report)
        return cls(model, best.best, followed)

    @property
    def scenes(self) -> list[Scene]:
        """Return the scene of every specimen with the estimates."""
        return self.model.scenes(self.theta)

    def undetermined(self) -> list[identifiability.OpenCombination]:
        """Return every combination of parameters that the data leave open.

        A combination is a direction of the parameters, each relative to its size, with a standard
        error beyond a factor of two; or another parameter whose interval has an open end.
        """
        return list(identifiability.undetermined(self, self.profiles))

    def forecast(self, cycles: float | Iterable[float]) -> list[Forecast]:
        """Return the wear of every specimen after numbers of cycles, with its 95 % band."""
        specimens, wanted = self.model.specimens, self._ahead(cycles)
        level, slope = self.model.log_wear(self.theta[None], [wanted] * len(specimens))
        width = self.quantile * self.spread(slope[0])
        rows = zip(level[0].tolist(), width.tolist(), strict=True)
        return [
            Forecast(each.name, number, float(np.exp(wear)), _band(wear, half))
            for each in specimens
            for number, (wear, half) in zip(wanted.tolist(), rows, strict=False)
        ]

    @property
    def _last_cycle(self) -> int:
        """Return the last cycle of the load of every specimen."""
        return min(MOST_CYCLES, *(most_cycles(scene.load) for scene in self.scenes))

    def _ahead(self, cycles: float | Iterable[float]) -> FloatArray:
        """Return numbers of cycles within the loads as an array, or raise a `UsageError`."""
        faults = Faults()
        wanted = whole_cycles(cycles, faults, least=1)
        check_end(self.scenes, wanted, faults)
        faults.stop_if_any()
        return np.array(wanted, dtype=float)

    def life(self, wear_mm: float) -> list[Forecast]:
        """Return the number of cycles to a wear depth of every specimen, with its 95 % band;
        infinite where the depth is not reached within 1e12 cycles.

        The standard error of ln(cycles) is that of ln(wear) over d ln(wear) / d ln(cycles).
        """
        from wear.cycles import cycles_to_depth

        if not is_number(wear_mm):
            raise UsageError(f"wear: {wear_mm!r} is not one depth in mm")
        specimens = self.model.specimens
        numbers = cycles_to_depth(self.scenes, wear_mm).cycles[:, 0]
        most = min(0.98 * self._last_cycle, self._last_cycle - 1.0)
        near = np.clip(np.where(np.isfinite(numbers), numbers, 1.0), 1.0, max(1.0, most))
        around = np.stack([near, near + np.maximum(1.0, np.rint(near / 50.0))], axis=1)
        level, slope = self.model.log_wear(self.theta[None], [*around])
        rise = np.diff(level.reshape(around.shape)) / np.diff(np.log(around))
        with np.errstate(all="ignore"):
            width = self.quantile * self.spread(slope[0, ::2]) / rise[:, 0]
            rows = zip(specimens, numbers, np.log(numbers), width, strict=True)
            return [Forecast(s.name, float(n), wear_mm, _band(level, half))
                    for s, n, level, half in rows]  # fmt: skip

    def next_reading(self, cycles: float | None = None) -> NextReading:
        """Return the one further reading, of any specimen within the cycles read so far, that
        narrows the forecast of all specimens after `cycles` most (default: ten times as many as
        were read)."""
        specimens = self.model.specimens
        last = max(float(specimen.cycles[-1]) for specimen in specimens)
        farthest = min(AHEAD * last, self._last_cycle) if cycles is None else cycles
        tried = np.unique(np.rint(np.geomspace(1.0, last, CANDIDATES)))
        slots = [np.append(tried, self._ahead(farthest).max())] * len(specimens)
        level, slope = self.model.log_wear(self.theta[None], slots)
        residuals = self.model.residuals
        weight = replace(residuals, weight=np.median(residuals.weight, keepdims=True)).slope(level)
        factors = self.factors(slope[0]).reshape(len(specimens), len(tried) + 1, -1)
        target, read = factors[:, -1], weight.reshape(len(specimens), -1, 1) * factors
        # A reading removes the part of the variances that it shares with the targets.
        shared = np.einsum("tp,snp->snt", target, read[:, :-1])
        gain = np.sum(shared**2, axis=-1) / (1.0 + np.sum(read[:, :-1] ** 2, axis=-1))
        which, best = np.unravel_index(np.argmax(gain), gain.shape)
        spread = float(np.sum(target**2))  # none where the wear has ended
        left = max(0.0, 1.0 - gain[which, best] / spread) if spread > 0.0 else 1.0
        return NextReading(specimens[which].name, float(tried[best]), float(np.sqrt(left)))

    def alternatives(self) -> list[laws.Alternative]:
        """Return the fits of simpler laws to the same readings."""
        return laws.alternatives(self.model.specimens, self.model.relative)

    @property
    def forecast_rms(self) -> float:
        """Return the root mean square error of ln(wear) where the first half of the readings of
        each specimen predicts the last; NaN where they are fewer than the parameters."""
        model = self.model
        early = replace(model, specimens=tuple(laws.first_half(model.specimens)))
        if len(early.residuals.observed) < len(self.theta):
            return float(np.nan)
        (theta, *_) = descend(early, early(self.theta[None]), self.box)
        last = [s.cycles[-1:] for s in model.specimens]
        level, _ = model.log_wear(theta, last, derivatives=False)
        return laws.forecast_rms(model.specimens, level[0])

    def as_json(self, cycles: ArrayLike = (), wear_mm: float | None = None) -> dict[str, Any]:
        """Return the document of `wear fit --json`, with forecasts for numbers of `cycles` and the
        life to a wear depth."""
        others, own_forecast = self.alternatives(), self.forecast_rms
        wanted = np.ravel(cycles).tolist()
        forecast = self.forecast(wanted) if wanted else []
        return {
            "scene": self.model.scene.title or self.model.scene.name,
            "observations": len(self.residuals),
            "specimens": len(self.model.specimens),
            "parameters": self._rows(),
            "correlation": self.correlation,
            "rms": self.rms,
            "chi_square": self.chi_square,
            "degrees_of_freedom": self.degrees_of_freedom,
            "aicc": self.aicc,
            "forecast_rms": own_forecast,
            "undetermined": [each._asdict() for each in self.undetermined()],
            "forecast": [each._asdict() for each in forecast],
            "cycles_to_wear": [
                each._asdict() for each in ([] if wear_mm is None else self.life(wear_mm))
            ],
            "alternatives": [each._asdict() for each in others],
            "next_reading": self.next_reading(
                max((each.cycles for each in forecast), default=None)
            )._asdict(),
            "notices": self._notices(others, own_forecast),
        }

    def _rows(self) -> list[dict[str, Any]]:
        ends: list[list[float] | None] = [list(each.interval) for each in self.profiles]
        names = ("key", "specimen", "estimate", "standard_error", "interval_95")
        rows = zip(self.parameters, self.estimates, self.standard_errors,
                   ends or [None] * len(self.theta), strict=True)  # fmt: skip
        return [dict(zip(names, (p.key, p.specimen or None, *row), strict=True))
                for p, *row in rows]  # fmt: skip

    def _notices(self, others: Sequence[laws.Alternative], own_forecast: float) -> list[str]:
        """Return notices of simpler laws that are better, and of implausible magnitudes."""
        notices = [f"the {law.law} law describes these data better (AICc)"
                   for law in others if law.aicc < self.aicc]  # fmt: skip
        notices += [f"the {law.law} law predicts the last readings better, from the first half"
                    for law in others if law.forecast_rms < own_forecast]  # fmt: skip
        if self.degrees_of_freedom == 0 and not self.model.residuals.known:
            notices.append("there are as many parameters as readings: the scatter is unknown")
        notices += [f"{specimen.name or 'readings'}: the last wear is half of an earlier one or "
                    "less; wear does not fall: see whether columns and cycles are right"
                    for specimen in self.model.specimens
                    if specimen.wear_mm[-1] <= FALLEN * specimen.wear_mm.max()]  # fmt: skip
        for specimen, scene in zip(self.model.specimens, self.scenes, strict=True):
            notices += notices_of_wear(scene, specimen.cycles.tolist(), specimen.wear_mm)
        return list(dict.fromkeys(notices))

    def plot(self) -> Figure:
        """Return a Matplotlib figure of the readings with the fitted wear and its 95 % band, and of
        the residuals."""
        from wear.fitting.figures import data_and_band

        return data_and_band(self)

    def __repr__(self) -> str:
        rows = [f"{p} = {value:.4g} ± {error:.2g}" for p, value, error in zip(
            self.parameters, self.estimates, self.standard_errors, strict=True)]  # fmt: skip
        return f"<Fit to {len(self.residuals)} readings: {', '.join(rows)}; rms {self.rms:.3g}>"


def _band(level: float, width: float) -> tuple[float, float]:
    """Return the ends of a band of this half width around `level`, all three of logarithms."""
    with np.errstate(over="ignore"):
        return float(np.exp(level - width)), float(np.exp(level + width))


def fit(
    data: str | os.PathLike[str] | Mapping[str, Any] | Sequence[Specimen],
    scene: Scene | str | os.PathLike[str],
    free: str | Sequence[str] = (),
    free_each: str | Sequence[str] = (),
    *,
    error: str = "relative",
    ignore: Sequence[str] = (),
    intervals: bool = True,
    progress: Callable[[str], None] = lambda _: None,
) -> Fit:
    """Estimate entries of a scene from measured wear.

    Parameters
    ----------
    data
        A CSV file, see `read_readings`; its columns as a dictionary or a pandas DataFrame; or
        specimens.
    scene
        The scene, its name or path: the fixed entries, and the start of the search.
    free, free_each
        Entries that are one value for all specimens, or one for each.
    error
        "relative": residuals of the logarithm; "absolute": of the wear.
    ignore
        Columns of the data to drop.
    intervals
        Whether to follow the profile likelihoods, which takes most of the time.
    progress
        Called with a message on the progress of a fit that takes more than two seconds.

    Raises
    ------
    UsageError
        with all faults of the request.

    >>> data = {"cycles": [10, 100, 1000], "wear_um": [0.22, 0.93, 2.1]}
    >>> fit(data, "section4", "bearing.wear_coefficient", intervals=False)
    <Fit to 3 readings: ...>
    """
    return Fit.of(FitModel.of(data, scene, free, free_each, error, ignore), intervals, progress)
