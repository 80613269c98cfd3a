"""Notices: entries and results of a scene that are legal, but may not be intended.

One table, with sources, has the plausible range of each magnitude and the likely slip beyond it. A
magnitude outside gives a notice that begins with "implausible"; `--strict` refuses it. The same
checks serve one scene (numbers) and the rows of a study (arrays along rows).

References
    ISO 1302:2002, annex: roughness classes N1 (Ra 0.025 um) to N12 (Ra 50 um).
    E. Rabinowicz, *Friction and Wear of Materials*, Wiley 1995, ch. 6: K from 1e-8 to 1e-2.
    J. F. Archard, J. Appl. Phys. 24 (1953) 981: K is dimensionless, k = K/H is not.
    K. L. Johnson, *Contact Mechanics*, Cambridge 1985, ch. 6: pressures stay below the hardness.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from wear import own_laws
from wear.load import Blocks, ForceTable, Table
from wear.load.spans import span
from wear.numerics.floating_point import TINY
from wear.numerics.gauss import FloatArray
from wear.scene.text import PARTS

if TYPE_CHECKING:
    from wear.scene import Scene

Cycles = Sequence[int] | NDArray[np.int64]
Real = Any  # a float, or an array along rows
WORD = "implausible"
ROUGHEST = 0.05  # mm, class N12 of ISO 1302
DEEPEST = 0.1  # of the radius: deeper wear is another geometry
LONGEST = 1e9  # cycles: no wear coefficient is known for so many
HARDER = 3.0  # times the hardness: no asperity carries such a pressure
DIGITS_LOST = 1e-12  # relative error of a contact law above which there is a notice
CONTACT_REACH = 3  # contact needs h <= 3 sigma, the text under (4); a test holds it to derive's


def notices(scene: Scene) -> tuple[str, ...]:
    """Return the notices on a scene that is to be solved, one sentence each."""
    return (
        *implausible_entries(scene),
        *_law_notices(scene),
        *_pin_notices(scene),
        *_closure_notices(scene),
        *_load_notices(scene),
    )


def _law_notices(scene: Scene) -> Iterator[str]:
    law = scene.contact.law
    if not own_laws.is_own(law):
        return
    if not own_laws.about(law)["inflection_proved"]:
        yield (
            f"that the contact law {law} turns from concave to convex once at most is not proved, "
            "but seen at quarters of h/sigma between -30 and 30"
        )
    if (error := own_laws.about(law)["rounding_error"]) > DIGITS_LOST:
        yield (
            f"the contact law {law} loses digits: its relative error is up to {error:.1g} between "
            "h/sigma = -5 and 1e4; another way to write it may keep them"
        )


def _pin_notices(scene: Scene) -> Iterator[str]:
    variant = scene.variant
    wears = variant.pin.startswith("worn")
    if scene.pin is not None and variant.pin == "bearing":
        yield "the pin neither wears nor is rough: it is not modelled"
    if wears and not scene.contact.pin_wear_opens_gap:
        yield (
            "wear of the pin closes the gap, the sign of Eq. (1) as printed; "
            "for the physical sign set contact.pin_wear_opens_gap = true"
        )
    if scene.contact.pin_wear_opens_gap and not wears:
        yield "pin_wear_opens_gap has no effect: the pin does not wear"


def _closure_notices(scene: Scene) -> Iterator[str]:
    if scene.given_load:
        yield "the load is a force: wear is its integral, and the displacement of the pin follows"
        return
    first = float(span(scene.load, 0).load(0.0))
    reach = CONTACT_REACH * scene.initial_roughness
    closure = scene.closure - first
    if scene.contact.ends_at_3_sigma and scene.closure - scene.load.maximum > reach:
        yield "contact ends at 3 sigma, and the pin never comes into contact: there is no wear"
    elif scene.contact.ends_at_3_sigma and closure > reach:
        yield (
            f"starts out of contact: the closure {closure:.6g} mm exceeds "
            f"3 sigma(0) = {reach:.6g} mm, where contact ends"
        )
    if scene.closure < scene.load.maximum:
        yield (
            "the pin moves further than the initial closure: the closure turns negative, "
            "outside 0 <= h of the text under (4)"
        )
    if scene.support is not None:
        yield (
            "closure_mm is the gap of the unloaded system, h_0 of Eq. (1); the support deflects "
            "under load"
        )
    elif first != 0.0:
        yield (
            f"U_a(0) = {first:.6g} mm is not zero: the run starts at the closure "
            f"h_0 - U_a(0) = {closure:.6g} mm, not at the h_0 of Eq. (6)"
        )


def _load_notices(scene: Scene) -> Iterator[str]:
    load = scene.load
    if isinstance(load, Table | ForceTable) and load.source is not None and load.source.repeat:
        name, unit = ("R_a", "N") if scene.given_load else ("U_a", "mm")
        seam, length = load.rows[-1] - load.rows[-2], load.times_s[-1] - load.times_s[-2]
        closed = "; the record ends where it began: without repeat = true it is one whole period"
        yield (
            f"one period of {load.period:.6g} s out of {load.source.file}: {len(load.times_s)} "
            f"rows with the seam, mean {load.mean:.6g} {unit}; there {name} changes by "
            f"{seam:.4g} {unit} in {length:.4g} s (mean and drift are not removed)"
            f"{closed if seam == 0.0 else ''}"
        )
    if not isinstance(scene.load, Blocks):
        return
    starts = [float(block.load(0.0)) for block in scene.load.blocks]
    jumps = [place + 1 for place in range(1, len(starts)) if starts[place] != starts[place - 1]]
    if scene.load.repeat > 1 and starts[0] != starts[-1]:
        jumps.insert(0, 1)
    if jumps:
        places = ", ".join(map(str, jumps[:10])) + (", ..." if len(jumps) > 10 else "")
        yield f"the displacement jumps at the start of block {places}"


# Implausible magnitudes


class PlausibilityCheck(NamedTuple):
    """The check of a magnitude: its `ratio` to the largest plausible one, a number or an array
    along rows, and the `words` of a sentence with places for `values` of the same shape."""

    ratio: Real
    words: str
    values: tuple[Real, ...]

    def sentence(self, at: int | tuple[()] = ()) -> str:
        """Return the sentence about a row, or about the single scene."""
        shape = np.shape(self.ratio)
        return self.words.format(*(np.broadcast_to(value, shape)[at] for value in self.values))


class Range(NamedTuple):
    """The range of a key's magnitude in engineering, and the likely slips of values outside."""

    low: float
    high: float
    if_low: str
    if_high: str


RANGES: Mapping[str, Range] = {
    "hardness_MPa": Range(1.0, 1.5e5, "GPa typed as MPa?", "Pa typed as MPa?"),
    "wear_coefficient": Range(
        1e-12,
        0.1,
        "a dimensional coefficient k? K = k H, times the hardness",
        "K is dimensionless and below 0.1",
    ),
    "roughness_mm": Range(1e-7, ROUGHEST, "m typed as mm?", "um typed as mm?"),
    "max_pressure_MPa": Range(1e-2, 1.5e5, "GPa typed as MPa?", "Pa typed as MPa?"),
    "closure_mm": Range(1e-6, 1.0, "m typed as mm?", "um typed as mm?"),
    "closure_in_sigma": Range(0.1, 100.0, "a closure in mm?", "a closure in nm?"),
    "stiffness_MPa_per_mm": Range(1e-3, 1e12, "N/m typed as MPa/mm?", "Pa/m typed as MPa/mm?"),
    "friction_coefficient": Range(1e-4, 2.0, "", "in percent?"),
    "radius_mm": Range(0.1, 1e4, "m typed as mm?", "um typed as mm?"),
    "speed_rpm": Range(1e-3, 1e6, "revolutions per ms?", "degrees per minute?"),
    "roughness_growth": Range(0.0, 10.0, "", "roughness grows by a part of the wear"),
    "amplitude_mm": Range(0.0, 1.0, "", "um typed as mm?"),
    "period_s": Range(1e-6, 1e6, "hours typed as s?", "us or ms typed as s?"),
}


def sentences_on(checks: Iterable[PlausibilityCheck]) -> Iterator[str]:
    """Yield the sentences about one scene."""
    yield from (check.sentence() for check in checks if check.ratio > 1.0)


def implausible_entries(scene: Scene) -> Iterator[str]:
    """Yield a sentence for each implausible entry of a scene."""
    yield from sentences_on(checks_of_entries(entries_of(scene)))
    swing = scene.load.maximum - scene.load.minimum
    if swing > 2.0 and not (scene.given_load or hasattr(scene.load, "amplitude_mm")):
        yield f"{WORD}: [load] U_a moves by {swing:.4g} mm: um typed as mm?"


def entries_of(scene: Scene) -> dict[str, float]:
    """Return the numbers of a scene that have a range, by their keys in the scene file."""
    return {
        f"{name}.{key}": value
        for name in PARTS
        for key in RANGES
        if (value := getattr(getattr(scene, name), key, None)) is not None
    }


def checks_of_entries(entries: Mapping[str, Real]) -> Iterator[PlausibilityCheck]:
    """Yield the checks of the entries of a scene, or of the rows of a study."""
    for entry, value in entries.items():
        table, _, key = entry.rpartition(".")
        if key in RANGES:
            low, high, if_low, if_high = RANGES[key]
            size = abs(value)
            outside = f"{WORD}: [{table}] {key} = {{:g}} is outside {low:g} to {high:g}: "
            yield PlausibilityCheck(size / high, outside + if_high, (value,))
            not_zero = size > 0.0  # zero is another model, not a small number
            yield PlausibilityCheck(low * not_zero / (size + TINY), outside + if_low, (value,))
    pressure = entries["contact.max_pressure_MPa"]
    hardest = np.maximum(entries["bearing.hardness_MPa"], entries.get("pin.hardness_MPa", 0.0))
    words = (
        f"{WORD}: [contact] max_pressure_MPa = {{:g}} is more than {HARDER:g} times the hardness "
        "of the harder solid"
    )
    yield PlausibilityCheck(pressure / (HARDER * hardest), words, (pressure,))


def implausible_results(
    scene: Scene, cycles: Cycles, u_c: FloatArray, *roughness: FloatArray
) -> Iterator[str]:
    """Yield a sentence for each result of a scene outside the scope of the model; `u_c` and each
    `roughness` are in mm, along `cycles`."""
    if len(cycles):
        limits = scene.motion.radius_mm, scene.initial_roughness
        yield from sentences_on(checks_of_results(*limits, cycles, u_c, *roughness))


def checks_of_results(
    radius: Real, initial: Real, cycles: Cycles, u_c: FloatArray, *roughness: FloatArray
) -> Iterator[PlausibilityCheck]:
    """Yield the checks of wear and roughnesses (..., cycles) for a radius and an initial roughness,
    all in mm."""
    deepest = np.max(u_c, axis=-1)
    yield PlausibilityCheck(
        deepest / (DEEPEST * radius),
        f"{WORD}: the wear of {{:.4g}} mm is {{:.3g}} % of the radius; beyond "
        f"{100.0 * DEEPEST:g} % the geometry is another",
        (deepest, 100.0 * deepest / radius),
    )
    roughest = np.max(np.broadcast_arrays(u_c, *roughness)[1:], axis=(0, -1))
    yield PlausibilityCheck(
        roughest / np.maximum(ROUGHEST, initial),
        f"{WORD}: the roughness of {{:.4g}} mm is beyond {ROUGHEST:g} mm, "
        "the roughest class of ISO 1302",
        (roughest,),
    )
    yield PlausibilityCheck(
        np.max(cycles) / LONGEST,
        f"{WORD}: wear beyond {LONGEST:.0e} cycles is extrapolated; no wear coefficient is "
        "known for so many",
        (),
    )
