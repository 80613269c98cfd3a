"""Implausible magnitudes in a study: a sentence for each kind, with its count and worst row."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
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


def notices_of_rows(
    study: Study, chunks: Iterable[tuple[Mapping[str, FloatArray], FloatArray]]
) -> list[str]:
    """Return the notices of the varied scene, and a sentence for each kind of excess in the rows.

    Each chunk has the values (rows,) of each key, and the wear (rows, cycles) in mm; rows without
    an answer (NaN) are left out.
    """
    total, found = 0, dict[str, Worst]()  # by the words of the sentence
    for columns, u_c in chunks:
        total += len(u_c)
        answered = np.isfinite(u_c).all(axis=1)
        if not answered.any():
            continue
        values = {key: column[answered] for key, column in columns.items()}
        for check in _checks(study, values, u_c[answered]):
            if (rows := int(np.count_nonzero(check.ratio > 1.0))) == 0:
                continue
            at = int(np.argmax(check.ratio))
            place = ", ".join(f"{key} = {column[at]:.4g}" for key, column in values.items())
            here = Worst(rows, float(check.ratio[at]), check.sentence(at), place)
            before = found.get(check.words, here._replace(rows=0))
            worst = max(before, here, key=lambda each: each.ratio)
            found[check.words] = worst._replace(rows=before.rows + rows)
    return [
        *(text for text in study.scene.notices if not text.startswith(WORD)),
        *(f"{worst.sentence} ({worst.rows} of {total} rows; the worst has {worst.place})"
          for worst in found.values()),
    ]  # fmt: skip


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
