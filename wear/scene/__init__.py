"""Scenes: what a user asks to be solved, from a TOML file or a built-in name.

A `Scene` is frozen and holds the numbers of the file, in mm, s, MPa and rpm. `load_scene` reads and
validates one; `Scene.to_toml` writes it back. The tables and keys stand in `wear.scene.schema`.
"""

from __future__ import annotations

import json
import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, Literal, NamedTuple

from wear.faults import Fault, SceneError, UsageError
from wear.load import AperiodicLoad, Blocks, HistoryLoad, Load
from wear.scene.build import build_load, load_table
from wear.scene.check import Problem, check_scene
from wear.scene.text import MOST_BYTES, Source, read_bytes, read_tables
from wear.scene.value import did_you_mean, shown

SCENES = Path(__file__).parents[1].joinpath("scenes")


@dataclass(frozen=True)
class Solid:
    """A wearing or rough surface: H in MPa, K, sigma_0 in mm, f = d sigma/d u."""

    hardness_MPa: float
    wear_coefficient: float
    roughness_mm: float
    roughness_growth: float


class Bearing(Solid):
    """The bearing (index c)."""


class Pin(Solid):
    """The pin (index a)."""


@dataclass(frozen=True)
class Contact:
    """Contact law and closure; exactly one of the two closures is given."""

    max_pressure_MPa: float
    closure_mm: float | None = None
    closure_in_sigma: float | None = None
    law: str = "tanh"
    ends_at_3_sigma: bool = False
    pin_wear_opens_gap: bool = False
    width_mm: float | None = None
    length_mm: float | None = None


@dataclass(frozen=True)
class Support:
    """Springs of stiffness k per area under the bearing."""

    stiffness_MPa_per_mm: float


@dataclass(frozen=True)
class Motion:
    """Radius R and rotation speed n of the pin."""

    radius_mm: float
    speed_rpm: float


class VariantKey(NamedTuple):
    """Which generated module a scene needs: `wear.generated.<law>.<module>`; `name` is the
    variant's for users.

    >>> key = VariantKey("tanh", "compliant", "worn_rough", ends_at_3_sigma=True)
    >>> key.module, key.name
    ('compliant_worn_rough', 'compliant_worn_rough_ends_at_3_sigma')
    """

    law: str
    support: Literal["rigid", "compliant"]
    pin: Literal["bearing", "rough", "worn", "worn_rough"]
    ends_at_3_sigma: bool

    @property
    def module(self) -> str:
        return f"{self.support}_{self.pin}"

    @property
    def name(self) -> str:
        return self.module + "_ends_at_3_sigma" * self.ends_at_3_sigma


@dataclass(frozen=True)
class Scene:
    """What to solve. A table that the file leaves out is None and is not modelled.

    `name` (a built-in name or the file's) takes no part in comparisons.
    """

    bearing: Bearing
    contact: Contact
    motion: Motion
    load: Load | AperiodicLoad
    pin: Pin | None = None
    support: Support | None = None
    title: str = ""
    description: str = ""
    name: str = field(default="scene", compare=False)

    @property
    def initial_roughness(self) -> float:
        """Equivalent roughness before any wear, Eq. (3), in mm; held to derive's by a test."""
        pin = 0.0 if self.pin is None else self.pin.roughness_mm
        return math.hypot(self.bearing.roughness_mm, pin)

    @property
    def closure(self) -> float:
        """Initial closure h_0 of Eq. (1) in mm; of the unloaded system if the support gives way."""
        if self.contact.closure_mm is not None:
            return self.contact.closure_mm
        if self.contact.closure_in_sigma is None:
            raise UsageError("[contact] needs closure_mm or closure_in_sigma")
        return self.contact.closure_in_sigma * self.initial_roughness

    @property
    def periodic_load(self) -> Load:
        """The load, for a method that needs one that repeats; otherwise a `UsageError`."""
        if isinstance(self.load, Blocks | HistoryLoad):
            kind = load_table(self.load)["kind"]
            raise UsageError(
                f'{self.name}: a load of kind "{kind}" does not repeat; this needs one that does'
            )
        return self.load  # type: ignore[return-value]  # what is left of the union

    @property
    def variant(self) -> VariantKey:
        """The generated module with what this scene needs, and no more."""
        return VariantKey(
            law=self.contact.law,
            support="rigid" if self.support is None else "compliant",
            pin=self._pin_state,
            ends_at_3_sigma=self.contact.ends_at_3_sigma,
        )

    @property
    def pin_wear_sign(self) -> float:
        """+1 where wear of the pin opens the gap, -1 where it closes it, as printed in Eq. (1)."""
        return 1.0 if self.contact.pin_wear_opens_gap else -1.0

    @property
    def _pin_state(self) -> Literal["bearing", "rough", "worn", "worn_rough"]:
        if self.pin is None:
            return "bearing"
        if self.pin.wear_coefficient == 0.0:
            return "rough" if self.pin.roughness_mm > 0.0 else "bearing"
        rough = self.pin.roughness_mm > 0.0 or self.pin.roughness_growth != 0.0
        return "worn_rough" if rough else "worn"

    def parameters(self) -> dict[str, float]:
        """The numbers that this scene's variant has, under their symbols; T only if there is one.

        >>> sorted(load_scene("section4").parameters())
        ['H_c', 'K_c', 'R', 'T', 'f_c', 'h_0', 'n', 'p_max', 'sigma_c0']
        """
        numbers = {
            "K_c": self.bearing.wear_coefficient,
            "H_c": self.bearing.hardness_MPa,
            "f_c": self.bearing.roughness_growth,
            "sigma_c0": self.bearing.roughness_mm,
            "p_max": self.contact.max_pressure_MPa,
            "h_0": self.closure,
            "R": self.motion.radius_mm,
            "n": self.motion.speed_rpm,
        }
        pin = self._pin_state
        if self.pin is not None and pin in ("worn", "worn_rough"):
            numbers |= {"K_a": self.pin.wear_coefficient, "H_a": self.pin.hardness_MPa}
        if self.pin is not None and pin in ("rough", "worn_rough"):
            numbers["sigma_a0"] = self.pin.roughness_mm
        if self.pin is not None and pin == "worn_rough":
            numbers["f_a"] = self.pin.roughness_growth
        if self.support is not None:
            numbers["k"] = self.support.stiffness_MPa_per_mm
        if not isinstance(self.load, Blocks | HistoryLoad):
            numbers["T"] = self.periodic_load.period
        if self.contact.width_mm is not None and self.contact.length_mm is not None:
            numbers |= {"b": self.contact.width_mm, "L": self.contact.length_mm}
        return numbers

    @property
    def notices(self) -> tuple[str, ...]:
        """What is legal, but may not be what is meant."""
        from wear.scene.notices import notices

        return notices(self)

    def to_tables(self) -> dict[str, Any]:
        """The tables of the scene file as plain values, fit for JSON; what is absent is left out.

        A load from a CSV file is given by the file's name and checksum, not by its rows.
        """
        tables: dict[str, Any] = {"title": self.title, "description": self.description}
        for name in ("bearing", "pin", "contact", "support", "motion"):
            table = getattr(self, name)
            if table is not None:
                tables[name] = {k: v for k, v in asdict(table).items() if v is not None}
        return tables | {"load": dict(load_table(self.load))}

    def to_json(self) -> str:
        """`to_tables` in one line, the same for equal scenes: an attribute of result files."""
        return json.dumps(self.to_tables(), allow_nan=False)

    def to_toml(self) -> str:
        """A scene file that reads back to an equal scene (CSV files are named, not copied)."""
        tables = self.to_tables()
        blocks = tables["load"].pop("blocks", [])
        texts = [f"{key} = {_toml(tables.pop(key))}" for key in ("title", "description")]
        for name, table in tables.items():
            texts += ["", f"[{name}]", *(f"{key} = {_toml(value)}" for key, value in table.items())]
        for block in blocks:
            texts += ["", "[[load.blocks]]"]
            texts += [f"{key} = {_toml(value)}" for key, value in block.items()]
        return "\n".join(texts) + "\n"


def _toml(value: object) -> str:
    """A plain value in TOML; JSON's form is TOML's for flags, finite numbers, text and lists."""
    return json.dumps(value, ensure_ascii=False, allow_nan=False)


def load_scene(path_or_name: str | os.PathLike[str], overrides: Sequence[str] = ()) -> Scene:
    """The scene of a built-in name or of a TOML file.

    `overrides` are texts TABLE.KEY=VALUE, each of which takes the place of one entry. Raises
    `SceneError` with every fault.

    >>> load_scene("section4", ["bearing.wear_coefficient=1e-3"]).bearing.wear_coefficient
    0.001
    """
    name = os.fspath(path_or_name)
    if isinstance(path_or_name, str) and name in builtin_names():
        file = SCENES / f"{name}.toml"
        return parse_scene(file.read_bytes(), name, SCENES, overrides)
    file = Path(name)
    data = read_bytes(file, MOST_BYTES)
    if isinstance(data, tuple):
        problem, remedy = data
        if meant := did_you_mean(name, builtin_names()):
            remedy = f"did you mean the built-in scene {meant}?"
        elif not file.suffix:
            remedy = "give a file or a built-in scene; `wear scenes` lists these"
        raise SceneError([Fault(_place(name), None, "", "", problem, remedy)])
    return parse_scene(data, name, file.parent, overrides)


def parse_scene(
    data: bytes | str,
    name: str = "scene",
    folder: Path | None = None,
    overrides: Sequence[str] = (),
) -> Scene:
    """The scene of a TOML text; `folder` is where the CSV files of its load are looked for.

    Files that an override names are looked for in the current folder.
    """
    tables, source = read_tables(data, _place(name), overrides)
    return _make(tables, source, name, folder)


def scene_from_tables(
    tables: Mapping[str, Any], name: str = "scene", folder: Path | None = None
) -> Scene:
    """The scene of tables as `Scene.to_tables` gives them, validated like a file."""
    return _make(tables, Source(_place(name)), name, folder)


def _make(tables: Mapping[str, Any], source: Source, name: str, folder: Path | None) -> Scene:
    values, problems = check_scene(tables)
    load: Load | AperiodicLoad | None = None
    if "load" in values and not _touches(problems, "load"):
        load, found = build_load(values["load"], _folder_of_rows(source, folder))
        problems += found
    faults = [*source.faults, *(source.fault(problem) for problem in problems)]
    if faults or load is None:
        raise SceneError(faults)
    return Scene(
        bearing=Bearing(**values["bearing"]),
        contact=Contact(**values["contact"]),
        motion=Motion(**values["motion"]),
        load=load,
        pin=Pin(**values["pin"]) if "pin" in values else None,
        support=Support(**values["support"]) if "support" in values else None,
        name=name,
        title=values[""]["title"],
        description=values[""]["description"],
    )


def _folder_of_rows(source: Source, folder: Path | None) -> Path | None:
    """Where the load's CSV files are: beside the scene that names them, or, where an option names
    them, in the current folder."""
    named = (("load",), ("load", "file"), ("load", "blocks"))
    return Path() if any(path in source.overrides for path in named) else folder


def _place(name: str) -> str:
    """A file's name in messages."""
    return shown(name, most=1000) or '""'


def _touches(problems: Sequence[Problem], table: str) -> bool:
    return any(problem.path[:1] == (table,) for problem in problems)


# Built-in scenes


class BuiltinScene(NamedTuple):
    """A scene that comes with the package."""

    name: str
    title: str
    description: str

    @property
    def hard(self) -> bool:
        """Whether it belongs to the catalogue of hard cases, not to the note's own sections."""
        return not self.name.startswith("section")


def builtin_names() -> tuple[str, ...]:
    """The names of the built-in scenes: the note's sections, then the hard cases."""
    names = [file.stem for file in SCENES.glob("*.toml")]
    return tuple(sorted(names, key=lambda name: (not name.startswith("section"), name)))


def builtin_scenes() -> tuple[BuiltinScene, ...]:
    """Name, title and description of every built-in scene."""
    scenes = (load_scene(name) for name in builtin_names())
    return tuple(
        BuiltinScene(scene.name, scene.title, " ".join(scene.description.split()))
        for scene in scenes
    )
