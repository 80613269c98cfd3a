"""The scene file as a table of tables: every key with its kind, unit, domain, default and meaning.

The validation (`wear.scene.check`), the form that is written back (`wear.scene`) and the reference
page of the documentation are all read from here.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from pathlib import Path

# Magnitudes are bounded so that no product of a scene's numbers can overflow or underflow.
SMALLEST = 1e-30
LARGEST = 1e30
MOST_HARMONICS = 100
MOST_BLOCKS = 1000
MOST_CYCLES = 10**12

# Keys of versions before the first release, each with its name of today.
RENAMED = {"roughness_slope": "roughness_growth", "cutoff": "ends_at_3_sigma"}

Value = float | bool | str | tuple[float, ...]


class Kind(Enum):
    """What a value is, in words for the user."""

    NUMBER = "a number"
    NUMBERS = "a list of numbers"
    COUNT = "a whole number"
    FLAG = "true or false"
    TEXT = "text"
    CHOICE = "one of the names"
    BLOCKS = "a list of tables"


class Domain(Enum):
    """Which numbers are allowed; magnitudes other than 0 lie from `SMALLEST` to `LARGEST`."""

    POSITIVE = "> 0"
    NON_NEGATIVE = ">= 0"
    REAL = "any real number"


@dataclass(frozen=True)
class Key:
    """One entry of a table: `required`, or else absent means `default` (None: not modelled)."""

    name: str
    kind: Kind
    meaning: str
    unit: str = ""
    domain: Domain = Domain.REAL
    required: bool = True
    default: Value | None = None
    choices: tuple[str, ...] = ()


@dataclass(frozen=True)
class Table:
    """One table of the file; `one_of`: exactly one of these keys; `together`: both or neither."""

    name: str
    meaning: str
    keys: tuple[Key, ...]
    required: bool = True
    one_of: tuple[str, ...] = ()
    together: tuple[str, ...] = ()

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(key.name for key in self.keys)


def contact_laws() -> tuple[str, ...]:
    """The contact laws that can run: the packages of generated code, one a law."""
    found = Path(__file__).parents[1].joinpath("generated").glob("[a-z]*/__init__.py")
    return tuple(sorted(module.parent.name for module in found))


def _number(
    name: str,
    meaning: str,
    unit: str = "",
    domain: Domain = Domain.POSITIVE,
    *,
    required: bool = True,
) -> Key:
    return Key(name, Kind.NUMBER, meaning, unit, domain, required)


def _flag(name: str, meaning: str) -> Key:
    return Key(name, Kind.FLAG, meaning, required=False, default=False)


def _solid(symbol: str, wear_domain: Domain) -> tuple[Key, ...]:
    return (
        _number("hardness_MPa", f"hardness H_{symbol}", "MPa"),
        _number("wear_coefficient", f"Archard's wear coefficient K_{symbol}", domain=wear_domain),
        _number(
            "roughness_mm",
            f"surface roughness sigma_{symbol}0 before any wear (not zero on both solids)",
            "mm",
            Domain.NON_NEGATIVE,
        ),
        _number(
            "roughness_growth",
            f"f_{symbol} = d sigma_{symbol} / d u_{symbol}, change of roughness with own wear",
            domain=Domain.REAL,
        ),
    )


TITLE = Key("title", Kind.TEXT, "one line that names the scene", required=False)
DESCRIPTION = Key("description", Kind.TEXT, "what the scene shows", required=False)

BEARING = Table("bearing", "the bearing, which wears", _solid("c", Domain.POSITIVE))
PIN = Table(
    "pin",
    "the pin; without this table it is smooth and does not wear",
    _solid("a", Domain.NON_NEGATIVE),
    required=False,
)
CONTACT = Table(
    "contact",
    "how closure and roughness make a pressure",
    (
        _number("max_pressure_MPa", "largest contact pressure p_max", "MPa"),
        _number(
            "closure_mm",
            "initial closure h_0 (unloaded, if the support is compliant)",
            "mm",
            Domain.NON_NEGATIVE,
            required=False,
        ),
        _number(
            "closure_in_sigma",
            "h_0 as a multiple of the initial equivalent roughness, instead of closure_mm",
            domain=Domain.NON_NEGATIVE,
            required=False,
        ),
        Key(
            "law",
            Kind.CHOICE,
            "contact law p/p_max = phi(h/sigma)",
            required=False,
            default="tanh",
            choices=contact_laws(),
        ),
        _flag(
            "ends_at_3_sigma",
            "true: no pressure for h > 3 sigma, the text under (4); false: as in (8)",
        ),
        _flag("pin_wear_opens_gap", "true: the physical sign of u_a; false: Eq. (1) as printed"),
        _number("width_mm", "contact width b; with length_mm, R_a = p b L is reported", "mm",
                required=False),
        _number("length_mm", "contact length L", "mm", required=False),
    ),
    one_of=("closure_mm", "closure_in_sigma"),
    together=("width_mm", "length_mm"),
)  # fmt: skip
SUPPORT = Table(
    "support",
    "the springs under the bearing; without this table the support is rigid",
    (_number("stiffness_MPa_per_mm", "stiffness k per area", "MPa/mm"),),
    required=False,
)
MOTION = Table(
    "motion",
    "the rotation of the pin",
    (
        _number("radius_mm", "pin radius R", "mm"),
        _number("speed_rpm", "rotation speed n", "rpm"),
    ),
)
TABLES = (BEARING, PIN, CONTACT, SUPPORT, MOTION)

_PERIOD = _number("period_s", "period T of a cycle", "s")
_SHA256 = Key("sha256", Kind.TEXT, "checksum that the file must have", required=False)
_REAL_MM = ("mm", Domain.REAL)

PERIODIC_LOADS = (
    Table(
        "sine",
        "U_a = amplitude sin(2 pi t/T)",
        (_number("amplitude_mm", "amplitude U", *_REAL_MM), _PERIOD),
    ),
    Table(
        "constant",
        "U_a constant",
        (
            _number("value_mm", "displacement U_a", *_REAL_MM),
            _number("period_s", "period T, only to count cycles", "s"),
        ),
    ),
    Table(
        "harmonics",
        "U_a = mean + sum over j = 1, 2, ... of cosine_j cos(2 pi j t/T) + sine_j sin(2 pi j t/T)",
        (
            Key("mean_mm", Kind.NUMBER, "mean of U_a", "mm", required=False, default=0.0),
            Key("cosine_mm", Kind.NUMBERS, "cosine_1, cosine_2, ...", "mm", required=False,
                default=()),
            Key("sine_mm", Kind.NUMBERS, "sine_1, sine_2, ...", "mm", required=False, default=()),
            _PERIOD,
        ),
    ),
    Table(
        "table",
        "U_a by straight lines between the rows of a CSV file over one period",
        (
            Key("file", Kind.TEXT, "CSV file with columns t_s,U_a_mm, beside the scene file"
                " (if given by --set: in the current folder);"
                " t_s starts at 0, the last row repeats the first U_a"),
            _number("period_s", "period T; left out, the last t_s. If later, a straight line back"
                    " to the first row closes the period", "s", required=False),
            _SHA256,
        ),
    ),
)  # fmt: skip
HISTORY_LOAD = Table(
    "history",
    "U_a by straight lines between the rows of a CSV file, not periodic",
    (
        Key("file", Kind.TEXT, "CSV file with columns t_s,U_a_mm, beside the scene file"
                " (if given by --set: in the current folder);"
            " t_s starts at 0"),
        _number("period_s", "time of a cycle, only to count cycles; left out, the last t_s", "s",
                required=False),
        _SHA256,
    ),
)  # fmt: skip
BLOCKS_LOAD = Table(
    "blocks",
    "periodic loads one after the other",
    (
        Key("blocks", Kind.BLOCKS, "[[load.blocks]] tables: a periodic load each, and its cycles"),
        Key("repeat", Kind.COUNT, "how often the list is run", required=False, default=1),
    ),
)
LOADS = (*PERIODIC_LOADS, HISTORY_LOAD, BLOCKS_LOAD)
CYCLES = Key("cycles", Kind.COUNT, "number of cycles of this block")


def kind_key(loads: tuple[Table, ...]) -> Key:
    """The key that chooses among these loads."""
    return Key("kind", Kind.CHOICE, "kind of load", choices=tuple(load.name for load in loads))
