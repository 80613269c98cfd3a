"""The tables of a scene file but the load: the solids, their contact, support and motion."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from wear import own_laws
from wear.checked import (
    NON_NEGATIVE,
    POSITIVE,
    REAL,
    Finding,
    OneOf,
    SceneTable,
    Where,
    entry,
    flag,
    table,
    wrong,
)
from wear.faults import UsageError
from wear.load.rows import read_bytes
from wear.scene.text import MOST_BYTES
from wear.words import shown

CLOSURES = ("closure_mm", "closure_in_sigma")


def contact_laws() -> tuple[str, ...]:
    """Return the contact laws that can run: the packages of generated code, one a law."""
    found = Path(__file__).parents[1].joinpath("generated").glob("[a-z]*/__init__.py")
    return tuple(sorted(module.parent.name for module in found))


class Law(OneOf):
    """The name of a contact law of the package, or of one that is given by its formula."""

    def __call__(self, raw: Any, where: Where) -> str:
        if isinstance(raw, str) and own_laws.is_own(raw):
            raw = {"phi": raw.removeprefix(own_laws.PREFIX)}
        if not isinstance(raw, Mapping):
            return super().__call__(raw, where)
        text = raw.get("phi")
        if raw.keys() == {"file"} and isinstance(raw["file"], str):
            text = _formula(raw["file"], where.folder)
        elif raw.keys() != {"phi"} or not isinstance(text, str):
            remedy = 'write law = { phi = "..." } or law = { file = "..." }'
            raise wrong("is no contact law", remedy)
        try:
            return own_laws.named(text)
        except UsageError as fault:
            raise wrong(str(fault), "see the page on contact laws") from None


def _formula(name: str, folder: Path | None) -> str:
    """Return the text of a file beside the scene, less what follows # in a line."""
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

    hardness_MPa: float = entry(POSITIVE, "hardness H_c")
    wear_coefficient: float = entry(POSITIVE, "Archard's wear coefficient K_c")
    roughness_mm: float = entry(
        NON_NEGATIVE, "surface roughness sigma_c0 before any wear (not zero on both solids)"
    )
    roughness_growth: float = entry(
        REAL, "f_c = d sigma_c / d u_c, change of roughness with own wear"
    )


@table("pin")
class Pin(SceneTable):
    """The pin (index a); without this table it is smooth and does not wear."""

    hardness_MPa: float = entry(POSITIVE, "hardness H_a")
    wear_coefficient: float = entry(NON_NEGATIVE, "Archard's wear coefficient K_a")
    roughness_mm: float = entry(
        NON_NEGATIVE, "surface roughness sigma_a0 before any wear (not zero on both solids)"
    )
    roughness_growth: float = entry(
        REAL, "f_a = d sigma_a / d u_a, change of roughness with own wear"
    )


@table("contact")
class Contact(SceneTable):
    """How closure and roughness make a pressure; exactly one of the two closures is given."""

    max_pressure_MPa: float = entry(POSITIVE, "largest contact pressure p_max")
    closure_mm: float | None = entry(
        NON_NEGATIVE, "initial closure h_0 (unloaded, if the support is compliant)", default=None
    )
    closure_in_sigma: float | None = entry(
        NON_NEGATIVE,
        "h_0 as a multiple of the initial equivalent roughness, instead of closure_mm",
        default=None,
    )
    law: str = entry(
        Law(contact_laws()),
        'contact law p/p_max = phi(h/sigma): a name, { phi = "..." } in r = h/sigma, '
        'or { file = "..." } with the formula in a file beside the scene',
        default="tanh",
    )
    ends_at_3_sigma: bool = entry(
        flag,
        "true: no pressure for h > 3 sigma, the text under (4); false: as in (8)",
        default=False,
    )
    pin_wear_opens_gap: bool = entry(
        flag, "true: the physical sign of u_a; false: Eq. (1) as printed", default=False
    )
    width_mm: float | None = entry(
        POSITIVE, "contact width b; with length_mm, R_a = p b L is reported", default=None
    )
    length_mm: float | None = entry(POSITIVE, "contact length L", default=None)
    friction_coefficient: float | None = entry(
        NON_NEGATIVE,
        "coefficient of friction mu; sliding distance and friction work are reported",
        default=None,
    )

    @classmethod
    def relations(cls, given: Mapping[str, Any]) -> Iterator[Finding]:
        """Yield the faults of closures and of the contact's two lengths."""
        match [key in given for key in CLOSURES]:
            case [False, False]:
                yield (), f"{' or '.join(CLOSURES)} is missing", "give one of the two"
            case [True, True]:
                yield (
                    CLOSURES[1:],
                    f"{' and '.join(CLOSURES)} are both given",
                    "keep one of the two",
                )
        for one, other in (("width_mm", "length_mm"), ("length_mm", "width_mm")):
            if one in given and other not in given:
                yield (), f"{other} is missing", f"give it too, or drop {one}"


@table("support")
class Support(SceneTable):
    """The springs under the bearing; without this table the support is rigid."""

    stiffness_MPa_per_mm: float = entry(POSITIVE, "stiffness k per area")


@table("motion")
class Motion(SceneTable):
    """The rotation of the pin."""

    radius_mm: float = entry(POSITIVE, "pin radius R")
    speed_rpm: float = entry(POSITIVE, "rotation speed n")
