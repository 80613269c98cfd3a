"""What is legal in a scene, but may not be what its author means."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from wear import own_laws
from wear.load import Blocks, ForceTable, Table
from wear.load.spans import span
from wear.scene.plausibility import implausible_entries

if TYPE_CHECKING:
    from wear.scene import Scene

DIGITS_LOST = 1e-12  # relative error of a contact law: more is worth a notice
CONTACT_REACH = 3  # contact needs h <= 3 sigma, the text under (4); a test holds it to derive's


def notices(scene: Scene) -> tuple[str, ...]:
    """One sentence for each thing worth knowing before the scene is solved."""
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
    if (lost := own_laws.about(law)["rounding_error"]) > DIGITS_LOST:
        yield (
            f"the contact law {law} loses digits: its relative error is up to {lost:.1g} between "
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
        yield "with the cutoff the pin never comes into contact: there is no wear"
    elif scene.contact.ends_at_3_sigma and closure > reach:
        yield (
            f"starts out of contact: the closure {closure:.6g} mm exceeds "
            f"3 sigma(0) = {reach:.6g} mm and the cutoff is on"
        )
    if scene.closure < scene.load.maximum:
        yield (
            "the pin moves further than the initial closure: the closure turns negative, "
            "outside 0 <= h of the text under (4)"
        )
    if scene.support is not None:
        yield "the support gives way: the closure is that of the unloaded system, h_0 of Eq. (1)"
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
        yield (
            f"one period of {load.period:.6g} s out of {load.source.file}: {len(load.times_s)} "
            f"rows with the seam, mean {load.mean:.6g} {unit}; there {name} changes by "
            f"{seam:.4g} {unit} in {length:.4g} s (mean and drift are not removed)"
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
