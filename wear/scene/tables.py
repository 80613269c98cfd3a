"""The tables of a scene file except the load: solids, contact, support and motion."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import Annotated, Any

from pydantic import Field, PlainValidator, ValidationInfo

from wear import own_laws
from wear.faults import UsageError
from wear.input_files import read_bytes
from wear.scene.text import MOST_BYTES
from wear.validation import (
    Finding,
    Flag,
    NonNegative,
    Positive,
    Real,
    SceneTable,
    choice,
    table,
    wrong,
)  # fmt: skip
from wear.words import shown

CLOSURES = ("closure_mm", "closure_in_sigma")


def contact_laws() -> tuple[str, ...]:
    """Return the available contact laws: the packages of generated code, one for each law."""
    found = Path(__file__).parents[1].joinpath("generated").glob("[a-z]*/__init__.py")
    return tuple(sorted(module.parent.name for module in found))


def _law(raw: object, info: ValidationInfo, known: Collection[str]) -> str:
    """Return the name of a contact law of the package, or of one that is given by its formula."""
    if isinstance(raw, str) and own_laws.is_own(raw):
        raw = {"phi": raw.removeprefix(own_laws.PREFIX)}
    if not isinstance(raw, Mapping):
        return choice(raw, known)
    text = raw.get("phi")
    if raw.keys() == {"file"} and isinstance(raw["file"], str):
        text = _formula(raw["file"], (info.context or {}).get("folder"))
    elif raw.keys() != {"phi"} or not isinstance(text, str):
        raise wrong("is not a contact law", 'write law = { phi = "..." } or law = { file = "..." }')
    try:
        return own_laws.named(text)
    except UsageError as fault:
        raise wrong(str(fault), "see the page on contact laws") from None


def _formula(name: str, folder: Path | None) -> str:
    """Return the text of a file beside the scene, without its comments (from # on)."""
    if folder is None:
        raise wrong(f"{shown(name)}: there is no folder to look in", "load the scene by its path")
    data = read_bytes(folder / name, MOST_BYTES)
    if isinstance(data, tuple):
        raise wrong(f"{shown(name)}: {data[0]}", data[1])
    lines = data.decode("utf-8", "replace").splitlines()
    text = " ".join(line.partition("#")[0].strip() for line in lines).strip()
    return text.removeprefix("phi").strip().removeprefix("=")


@table("bearing")
class Bearing(SceneTable):
    """The bearing (index c), which wears."""

    hardness_MPa: Positive = Field(description="hardness H_c")
    wear_coefficient: Positive = Field(description="Archard's wear coefficient K_c")
    roughness_mm: NonNegative = Field(
        description="surface roughness sigma_c0 before any wear (must not be zero on both solids)"
    )
    roughness_growth: Real = Field(
        description="f_c = d sigma_c / d u_c, change of roughness per unit of its own wear"
    )


@table("pin")
class Pin(SceneTable):
    """The pin (index a); without this table it is smooth and does not wear."""

    hardness_MPa: Positive = Field(description="hardness H_a")
    wear_coefficient: NonNegative = Field(description="Archard's wear coefficient K_a")
    roughness_mm: NonNegative = Field(
        description="surface roughness sigma_a0 before any wear (must not be zero on both solids)"
    )
    roughness_growth: Real = Field(
        description="f_a = d sigma_a / d u_a, change of roughness per unit of its own wear"
    )


@table("contact")
class Contact(SceneTable):
    """How closure and roughness make a pressure; exactly one of the two closures is given."""

    max_pressure_MPa: Positive = Field(description="largest contact pressure p_max")
    closure_mm: NonNegative | None = Field(
        default=None, description="initial closure h_0 (unloaded, if the support is compliant)"
    )
    closure_in_sigma: NonNegative | None = Field(
        default=None,
        description="h_0 as a multiple of the initial equivalent roughness, instead of closure_mm",
    )
    law: Annotated[str, PlainValidator(partial(_law, known=contact_laws()))] = Field(
        default="tanh",
        description='contact law p/p_max = phi(h/sigma): a name, { phi = "..." } in r = h/sigma, '
        'or { file = "..." } with the formula in a file beside the scene',
    )
    ends_at_3_sigma: Flag = Field(
        default=False,
        description="true: no pressure for h > 3 sigma, the text under (4); false: as in (8)",
    )
    pin_wear_opens_gap: Flag = Field(
        default=False,
        description="true: the physical sign of u_a; false: Eq. (1) as printed",
    )
    width_mm: Positive | None = Field(
        default=None, description="contact width b; with length_mm, R_a = p b L is reported"
    )
    length_mm: Positive | None = Field(default=None, description="contact length L")
    friction_coefficient: NonNegative | None = Field(
        default=None,
        description="coefficient of friction mu; sliding distance and friction work are reported",
    )

    @classmethod
    def relations(cls, given: Mapping[str, Any]) -> Iterator[Finding]:
        """Yield the faults of closures and of the contact's two lengths."""
        known = [key for key in CLOSURES if key in given]
        if not known:
            yield (), f"{' or '.join(CLOSURES)} is missing", "give one of the two"
        if len(known) > 1:
            yield CLOSURES[1:], f"{' and '.join(known)} are both given", "keep one of the two"
        for one, other in (("width_mm", "length_mm"), ("length_mm", "width_mm")):
            if one in given and other not in given:
                yield (), f"{other} is missing", f"give it too, or drop {one}"


@table("support")
class Support(SceneTable):
    """The springs under the bearing; without this table the support is rigid."""

    stiffness_MPa_per_mm: Positive = Field(description="stiffness k per area")


@table("motion")
class Motion(SceneTable):
    """The rotation of the pin."""

    radius_mm: Positive = Field(description="pin radius R")
    speed_rpm: Positive = Field(description="rotation speed n")
