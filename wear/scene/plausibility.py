"""Magnitudes that are legal and absurd, with the likely slip; one table of ranges with sources.

What lies outside is a notice that begins with "implausible"; `--strict` refuses it.

References
    ISO 1302:2002, annex: roughness classes N1 (Ra 0.025 um) to N12 (Ra 50 um).
    E. Rabinowicz, *Friction and Wear of Materials*, Wiley 1995, ch. 6: K from 1e-8 to 1e-2.
    J. F. Archard, J. Appl. Phys. 24 (1953) 981: K is dimensionless, k = K/H is not.
    K. L. Johnson, *Contact Mechanics*, Cambridge 1985, ch. 6: pressures stay below the hardness.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from wear.scene import Scene

WORD = "implausible"
ROUGHEST = 0.05  # mm, class N12 of ISO 1302
DEEPEST = 0.1  # of the radius: deeper wear is another geometry
LONGEST = 1e9  # cycles: no wear coefficient is known for so many
HARDER = 3.0  # times the hardness: no asperity carries such a pressure


class Range(NamedTuple):
    """What a key's magnitude is in engineering, and the slip that values outside hint at."""

    key: str
    low: float
    high: float
    if_low: str
    if_high: str


RANGES = (
    Range("hardness_MPa", 1.0, 1.5e5, "GPa typed as MPa?", "Pa typed as MPa?"),
    Range(
        "wear_coefficient",
        1e-12,
        0.1,
        "a dimensional coefficient k? K = k H, times the hardness",
        "K is dimensionless and below 0.1",
    ),
    Range("roughness_mm", 1e-7, ROUGHEST, "m typed as mm?", "um typed as mm?"),
    Range("max_pressure_MPa", 1e-2, 1.5e5, "GPa typed as MPa?", "Pa typed as MPa?"),
    Range("closure_mm", 1e-6, 1.0, "m typed as mm?", "um typed as mm?"),
    Range("closure_in_sigma", 0.1, 100.0, "a closure in mm?", "a closure in nm?"),
    Range("stiffness_MPa_per_mm", 1e-3, 1e12, "N/m typed as MPa/mm?", "Pa/m typed as MPa/mm?"),
    Range("friction_coefficient", 1e-4, 2.0, "", "in percent?"),
    Range("radius_mm", 0.1, 1e4, "m typed as mm?", "um typed as mm?"),
    Range("speed_rpm", 1e-3, 1e6, "revolutions per ms?", "degrees per minute?"),
    Range("roughness_growth", 0.0, 10.0, "", "roughness grows by a part of the wear"),
)


def implausible_entries(scene: Scene) -> Iterator[str]:
    """Yield a sentence for each entry of a scene that is legal, but hardly meant."""
    tables = (scene.bearing, scene.pin, scene.contact, scene.support, scene.motion)
    for table in (each for each in tables if each is not None):
        for key, low, high, if_low, if_high in RANGES:
            size = abs(getattr(table, key, None) or 0.0)
            if size and not low <= size <= high:
                slip = if_low if size < low else if_high
                yield (
                    f"{WORD}: [{table.place}] {key} = {getattr(table, key):g} is outside "
                    f"{low:g} to {high:g}: {slip}"
                )
    swing = scene.load.maximum - scene.load.minimum
    if swing > 2.0 and not scene.given_load:
        yield f"{WORD}: [load] U_a moves by {swing:.4g} mm: um typed as mm?"
    hardest = max(each.hardness_MPa for each in (scene.bearing, scene.pin) if each is not None)
    if scene.contact.max_pressure_MPa > HARDER * hardest:
        yield (
            f"{WORD}: [contact] max_pressure_MPa = {scene.contact.max_pressure_MPa:g} is more than "
            f"{HARDER:g} times the hardness of the harder solid"
        )


def implausible_results(
    scene: Scene,
    cycles: NDArray[np.int64],
    u_c: NDArray[np.float64],
    *roughness: NDArray[np.float64],
) -> Iterator[str]:
    """Yield a sentence for each result that lies outside what the model is meant for; `u_c` and
    each `roughness` are in mm, along `cycles`."""
    if not len(cycles):
        return
    deepest = float(np.max(u_c))
    if deepest > DEEPEST * scene.motion.radius_mm:
        share = 100.0 * deepest / scene.motion.radius_mm
        yield (
            f"{WORD}: the wear of {deepest:.4g} mm is {share:.3g} % of the radius; beyond "
            f"{100.0 * DEEPEST:g} % the geometry is another"
        )
    roughest = max(float(np.max(each)) for each in roughness)
    if roughest > max(ROUGHEST, scene.initial_roughness):
        yield (
            f"{WORD}: the roughness of {roughest:.4g} mm is beyond {ROUGHEST:g} mm, "
            "the roughest class of ISO 1302"
        )
    if np.max(cycles) > LONGEST:
        yield (
            f"{WORD}: wear beyond {LONGEST:.0e} cycles is extrapolated; no wear coefficient is "
            "known for so many"
        )
