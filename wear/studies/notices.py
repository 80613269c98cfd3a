"""Implausible magnitudes in a study: a sentence for each kind, with its count and worst row."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from wear.binding import bound, generated
from wear.numerics.gauss import FloatArray
from wear.scene.notices import (
    WORD,
    PlausibilityCheck,
    Real,
    checks_of_entries,
    checks_of_results,
    entries_of,
)
from wear.scene.variant import KEYS, VariantKey

if TYPE_CHECKING:
    from wear.studies.rows import Study


class Worst(NamedTuple):
    """The number of rows that exceed a limit, and of the worst row its ratio to the limit, the
    sentence about it, and the values of its keys."""

    rows: int
    ratio: float
    sentence: str
    place: str


class Tally:
    """The implausible rows of a study, counted chunk by chunk."""

    def __init__(self, study: Study) -> None:
        self._study, self._rows = study, 0
        self._found: dict[str, Worst] = {}  # by the words of the sentence

    def add(self, columns: Mapping[str, FloatArray], u_c: FloatArray) -> None:
        """Count rows in which each key takes the values (rows,) of its column, with their wear
        (rows, cycles) in mm; rows without an answer (NaN) are left out."""
        self._rows += len(u_c)
        answered = np.isfinite(u_c).all(axis=1)
        if not answered.any():
            return
        columns = {key: column[answered] for key, column in columns.items()}
        for check in _checks(self._study, columns, u_c[answered]):
            if (rows := int(np.count_nonzero(check.ratio > 1.0))) == 0:
                continue
            at = int(np.argmax(check.ratio))
            place = ", ".join(f"{key} = {column[at]:.4g}" for key, column in columns.items())
            worst = Worst(rows, float(check.ratio[at]), check.sentence(at), place)
            if before := self._found.get(check.words):
                worse = max(before, worst, key=lambda each: each.ratio)
                worst = worse._replace(rows=before.rows + rows)
            self._found[check.words] = worst

    @property
    def notices(self) -> tuple[str, ...]:
        """Return the notices of the varied scene, and a sentence for each kind of excess."""
        of_scene = (text for text in self._study.scene.notices if not text.startswith(WORD))
        of_rows = (
            f"{worst.sentence} ({worst.rows} of {self._rows} rows; the worst has {worst.place})"
            for worst in self._found.values()
        )
        return (*of_scene, *of_rows)


def _checks(
    study: Study, columns: Mapping[str, FloatArray], u_c: FloatArray
) -> Iterator[PlausibilityCheck]:
    """Yield the checks of the rows, each with a ratio (rows,)."""
    entries = {**entries_of(study.scene), **columns}
    initial, *worn = _roughness(entries, u_c)
    radius = entries["motion.radius_mm"]
    for check in (
        *checks_of_entries(entries),
        *checks_of_results(radius, initial, study.cycles, u_c, *worn),
    ):
        yield check._replace(ratio=np.broadcast_to(check.ratio, len(u_c)))


def _roughness(entries: Mapping[str, Real], u_c: FloatArray) -> Iterator[FloatArray]:
    """Yield the equivalent roughness (rows,) before any wear, and that of each solid (rows, cycles)
    after the wear; they are the same for all contact laws and supports."""
    pin: Literal["worn_rough", "bearing"] = (
        "worn_rough" if "pin.hardness_MPa" in entries else "bearing"
    )
    module = generated(VariantKey("tanh", "rigid", pin, ends_at_3_sigma=False))
    numbers = {
        symbol: np.reshape(entries.get(".".join(entry), 0.0), (-1, 1))
        for symbol, entry in KEYS.items()
    }
    constants = bound(module, numbers, 1.0).constants
    yield module.fields(0.0, 0.0, constants).sigma[:, 0]
    worn = module.fields(u_c, 0.0, constants)
    for name in ("sigma_c", "sigma_a"):
        if name in worn._fields:
            yield getattr(worn, name)
