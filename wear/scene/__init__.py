"""Scenes: the problems that users pose, from a TOML file, a built-in name, or Python.

A `Scene` is frozen and holds the numbers of the file, in mm, s, MPa and rpm. It is checked wherever
it is made: by the constructor, `dataclasses.replace`, `Scene.with_`, `Scene.from_dict` and
`load_scene`. Its tables and entries, with their units, domains and meanings, are the classes of
`wear.scene.tables` and `wear.load`, from which the reference page of the documentation is made too.
"""

from __future__ import annotations

import dataclasses
import html
import json
import math
import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import Field, PlainValidator, ValidationError, model_validator

from wear.faults import Fault, SceneError, UsageError
from wear.input_files import MISSING, read_bytes
from wear.load import Blocks, Force, ForceTable, HistoryLoad, Load, Loading
from wear.load.conversion import as_table, load_from_table
from wear.scene.tables import Bearing, Contact, Motion, Pin, Support
from wear.scene.text import MOST_BYTES, PARTS, Source, faults_of, path_of, read_tables, set_entry
from wear.scene.variant import KEYS, PIN_PARAMETERS, VariantKey
from wear.validation import EntryError, Finding, Prose, SceneTable, Text, problems, table, wrong
from wear.words import are_texts, did_you_mean, is_path, shown

SCENES = Path(__file__).parents[1].joinpath("scenes")
NO_ENTRY = Field(exclude=True, repr=False)
IN_A_LINE = 8  # numbers of a list in a scene file


@table("")
class Scene(SceneTable):
    """A problem to solve. A table that is left out is None and is not modelled.

    `name` (a built-in name or the file's) and `folder` (where CSV files are looked for) take no
    part in comparisons.
    """

    bearing: Bearing = Field(description="the bearing, which wears")
    contact: Contact = Field(description="how closure and roughness make a pressure")
    motion: Motion = Field(description="the rotation of the pin")
    load: Annotated[Loading, PlainValidator(load_from_table)] = Field(
        description="the displacement U_a(t) of the pin, or its reaction R_a(t)"
    )
    pin: Pin | None = Field(default=None, description="the pin")
    support: Support | None = Field(default=None, description="the springs under the bearing")
    title: Text = Field(default="", description="one line that names the scene")
    description: Prose = Field(default="", description="what the scene shows")
    name: Annotated[str, NO_ENTRY] = dataclasses.field(default="scene", compare=False)
    folder: Annotated[Path | None, NO_ENTRY] = dataclasses.field(default=None, compare=False)

    @classmethod
    def relations(cls, given: Mapping[str, Any]) -> Iterator[Finding]:
        """Yield the fault of a roughness that is zero on both solids."""
        solids = [given[name] for name in ("bearing", "pin") if name in given]
        rough = [
            solid.get("roughness_mm") if isinstance(solid, Mapping) else
            getattr(solid, "roughness_mm", None)
            for solid in solids
        ]  # fmt: skip
        if "bearing" in given and all(type(r) in (int, float) and r == 0 for r in rough):
            which = "both solids" if len(rough) > 1 else "the only rough solid"
            remedy = "give at least one solid a roughness_mm > 0"
            yield ("bearing", "roughness_mm"), f"the roughness is zero on {which}", remedy

    @classmethod
    def from_dict(
        cls, tables: Mapping[str, Any], name: str = "scene", folder: str | Path | None = None
    ) -> Scene:
        """Return the scene of tables as `to_tables` gives them and TOML reads them.

        Raises `SceneError` with every fault. `folder` is where CSV files are looked for.
        """
        source = Source(_place(str(name)))
        if folder is not None and not is_path(folder):
            problem = f"folder: {folder!r} is not the name of a folder"
            raise SceneError([Fault(source.file, None, "", "", problem, "give a path")])
        return _checked(tables, source, str(name), None if folder is None else Path(folder))

    def with_(self, changes: Mapping[str, Any]) -> Scene:
        """Return the scene with entries changed, as `--set` changes those of a file; None drops.

        >>> load_scene("section4").with_({"bearing.roughness_growth": 0.3}).bearing.roughness_growth
        0.3

        An entry of a list is named as by `sensitivity`: `load.blocks[0].amplitude_mm`.
        """
        if not hasattr(changes, "items") or not are_texts([*changes]):
            form = "{'bearing.roughness_growth': 0.3}"
            raise UsageError(f"changes: give a mapping such as {form}")
        named = {key.partition(".")[0] for key in changes} & {*PARTS}
        tables = {
            name: self._entries(name) if name in named else getattr(self, name)
            for name in self.entries
        }
        faults: list[Fault] = []
        for key, value in changes.items():
            try:
                set_entry(tables, path_of(key), value, keep=changes)
            except EntryError as error:
                faults += faults_of(error, shown(key))
        source = Source(_place(self.name), faults=tuple(faults))
        return _checked(tables, source, self.name, self.folder)

    def _entries(self, table: str) -> dict[str, Any]:
        """Return the given entries of a table as plain values."""
        part = getattr(self, table)
        if table == "load":
            return as_table(part)
        return {} if part is None else {k: v for k, v in vars(part).items() if v is not None}

    @property
    def initial_roughness(self) -> float:
        """Return the equivalent roughness before any wear, Eq. (3), in mm; a test compares it with
        derive's."""
        pin = 0.0 if self.pin is None else self.pin.roughness_mm
        return math.hypot(self.bearing.roughness_mm, pin)

    @property
    def closure(self) -> float:
        """Return the initial closure h_0 of Eq. (1) in mm; that of the unloaded system for a
        compliant support."""
        if self.contact.closure_mm is not None:
            return self.contact.closure_mm
        if self.contact.closure_in_sigma is None:
            raise UsageError("[contact] needs closure_mm or closure_in_sigma")
        return self.contact.closure_in_sigma * self.initial_roughness

    @property
    def periodic_load(self) -> Load:
        """Return the load if it is periodic; otherwise raise a `UsageError`."""
        if isinstance(self.load, Blocks | HistoryLoad):
            kind = as_table(self.load)["kind"]
            record = 'one period, kind = "table", repeat = true'
            raise UsageError(
                f'{self.name}: a load of kind "{kind}" does not repeat; this needs one that does: '
                f"take {'one of its blocks' if kind == 'blocks' else record}"
            )
        return self.load

    @property
    def loads(self) -> dict[str, Load]:
        """Return the periodic loads by their place in the scene file."""
        if isinstance(self.load, Blocks):
            return {f"load.blocks[{i}]": block.load for i, block in enumerate(self.load.blocks)}
        return {"load": self.periodic_load}

    @property
    def variant(self) -> VariantKey:
        """Return the key of the generated module with the symbols of this scene, and no more."""
        return VariantKey(
            law=self.contact.law,
            support="rigid" if self.support is None and not self.given_load else "compliant",
            pin=self._pin_state,
            ends_at_3_sigma=self.contact.ends_at_3_sigma,
            given_load=self.given_load,
        )

    @property
    def given_load(self) -> bool:
        """Return whether the reaction of the pin is given, problem (i), not its displacement."""
        return isinstance(self.load, Force | ForceTable)

    @model_validator(mode="after")
    def _check_force(self) -> Self:
        """Refuse a given reaction without an area, or beyond the capacity of the contact."""
        if not self.given_load:
            return self
        contact, most = self.contact, self.load.maximum
        if contact.width_mm is None or contact.length_mm is None:
            problem = "the load is a force: its pressure needs width_mm and length_mm"
            raise wrong(problem, "give both", "contact.width_mm")
        if contact.ends_at_3_sigma:
            problem = "has no meaning where the load is a force: the pressure is given"
            raise wrong(problem, "drop it", "contact.ends_at_3_sigma")
        limit = contact.max_pressure_MPa * contact.width_mm * contact.length_mm
        if most >= limit:
            problem = f"the force of {most:.6g} N is beyond p_max b L = {limit:.6g} N"
            raise wrong(problem, "give a smaller force, or a larger area", "load")
        return self

    @property
    def pin_wear_sign(self) -> float:
        """Return +1 if wear of the pin opens the gap, -1 if it closes it, as printed in Eq. (1)."""
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
        """Return the numbers of this scene's variant by their symbols; T only for periodic loads.

        >>> sorted(load_scene("section4").parameters())
        ['H_c', 'K_c', 'R', 'T', 'f_c', 'h_0', 'n', 'p_max', 'sigma_c0']
        """
        pin = PIN_PARAMETERS[self._pin_state]
        numbers: dict[str, float] = {}
        for symbol, (name, key) in KEYS.items():
            part = getattr(self, name)
            if part is not None and (name != "pin" or symbol in pin):
                numbers[symbol] = getattr(part, key)
        numbers["h_0"] = self.closure
        if not isinstance(self.load, Blocks | HistoryLoad):
            numbers["T"] = self.periodic_load.period
        if self.contact.width_mm is not None and self.contact.length_mm is not None:
            numbers |= {"b": self.contact.width_mm, "L": self.contact.length_mm}
        return numbers

    @property
    def notices(self) -> tuple[str, ...]:
        """Return sentences on entries that are legal, but may not be intended."""
        from wear.scene.notices import notices

        return notices(self)

    def to_tables(self) -> dict[str, Any]:
        """Return the tables of the scene file that are present, as plain values, fit for JSON.

        A load from a CSV file is given by the file's name and checksum, not by its rows.
        """
        tables: dict[str, Any] = {"title": self.title, "description": self.description}
        for name in PARTS:
            if entries := self._entries(name):
                tables[name] = entries
        return tables

    def to_json(self) -> str:
        """Return `to_tables` in one line, the same for equal scenes; result files store it."""
        return json.dumps(self.to_tables(), allow_nan=False)

    def __repr__(self) -> str:
        return f"<Scene {self.title or self.name!r}: {self.variant.name}, {self.load!r}>"

    def _repr_html_(self) -> str:
        """Return the scene file for a notebook."""
        return f"<pre>{html.escape(self.to_toml())}</pre>"

    def to_toml(self) -> str:
        """Return a scene file that loads as an equal scene; CSV files are only named."""
        tables = self.to_tables()
        blocks = tables["load"].pop("blocks", [])
        texts = [f"{key} = {_toml(tables.pop(key))}" for key in ("title", "description")]
        parts = [(f"[{name}]", entries) for name, entries in tables.items()]
        for head, entries in (*parts, *(("[[load.blocks]]", block) for block in blocks)):
            texts += ["", head, *(f"{key} = {_toml(value)}" for key, value in entries.items())]
        return "\n".join(texts) + "\n"


def _toml(value: object) -> str:
    """Return a plain value in TOML, whose flags, finite numbers, texts and lists are JSON's.

    A long list stands on several lines, as lines have a greatest length.
    """
    if isinstance(value, list) and len(value) > IN_A_LINE:
        lines = (map(_toml, value[i : i + IN_A_LINE]) for i in range(0, len(value), IN_A_LINE))
        return "".join(("[\n", *(f"  {', '.join(line)},\n" for line in lines), "]"))
    return json.dumps(value, ensure_ascii=False, allow_nan=False)


def load_scene(path_or_name: str | os.PathLike[str], overrides: Sequence[str] = ()) -> Scene:
    """Return the scene of a built-in name or of a TOML file.

    `overrides` are texts TABLE.KEY=VALUE, each of which replaces one entry. Raises `SceneError`
    with every fault.

    >>> load_scene("section4", ["bearing.wear_coefficient=1e-3"]).bearing.wear_coefficient
    0.001
    """
    if not is_path(path_or_name):
        kind = type(path_or_name).__name__
        raise UsageError(f"scene: is of type {kind}; give a Scene, a built-in name or a path")
    if not are_texts(overrides):
        raise UsageError("overrides: give a list of texts TABLE.KEY=VALUE; see also Scene.with_")
    name = os.fspath(path_or_name)
    if isinstance(path_or_name, str) and name in builtin_names():
        file = SCENES / f"{name}.toml"
        return parse_scene(file.read_bytes(), name, SCENES, overrides)
    file = Path(name)
    data = read_bytes(file, MOST_BYTES)
    if isinstance(data, tuple):
        problem, remedy = data
        if problem == MISSING:
            remedy = _meant(file) or remedy
        raise SceneError([Fault(_place(name), None, "", "", problem, remedy)])
    return parse_scene(data, name, file.parent, overrides)


def _meant(missing: Path) -> str:
    """Return the likely meaning of the name of a missing file, '' if there is none."""
    if meant := did_you_mean(missing.name, (file.name for file in missing.parent.glob("*.toml"))):
        return f"did you mean {meant}?"
    if meant := did_you_mean(str(missing), builtin_names()):
        return f"did you mean the built-in scene {meant}?"
    return "" if missing.suffix else "give a file or a built-in scene; `wear scenes` lists these"


def as_scene(scene: Scene | str | os.PathLike[str]) -> Scene:
    """Return a scene unchanged, or load that of a built-in name or a file."""
    return scene if isinstance(scene, Scene) else load_scene(scene)


def as_scenes(scenes: Sequence[Scene | str | os.PathLike[str]]) -> list[Scene]:
    """Return scenes, or those of built-in names or files."""
    if isinstance(scenes, str) or not isinstance(scenes, Sequence):
        raise UsageError("scenes: give a list of them")
    return [as_scene(scene) for scene in scenes]


def parse_scene(
    data: bytes | str,
    name: str = "scene",
    folder: Path | None = None,
    overrides: Sequence[str] = (),
) -> Scene:
    """Return the scene of a TOML text; `folder` is where the CSV files of its load are looked for.

    Files that an override names are looked for in the current folder.
    """
    tables, source = read_tables(data, _place(name), overrides)
    return _checked(tables, source, name, folder)


def _checked(tables: Mapping[str, Any], source: Source, name: str, folder: Path | None) -> Scene:
    named = (("load",), ("load", "file"), ("load", "blocks"), ("contact", "law"))
    if any(path in named or path[-1] == "file" for path in source.overrides):
        folder = Path()  # an option that names a file means the current folder
    faults = list(source.faults)
    try:
        validator = Scene.__pydantic_validator__  # type: ignore[attr-defined]
        scene: Scene = validator.validate_python(tables, context={"folder": folder})
    except ValidationError as error:
        faults += [source.fault(*problem) for problem in problems(error)]
    if faults:
        raise SceneError(faults)
    vars(scene).update(name=name, folder=folder)
    return scene


def _place(name: str) -> str:
    """Return a file's name as messages show it."""
    return shown(name, most=1000) or '""'


# Built-in scenes


def builtin_names() -> tuple[str, ...]:
    """Return the names of the built-in scenes: the note's sections, then the hard cases."""
    names = [file.stem for file in SCENES.glob("*.toml")]
    return tuple(sorted(names, key=lambda name: (not name.startswith("section"), name)))


def hard_names() -> tuple[str, ...]:
    """Return the names of the built-in scenes in the catalogue of hard cases."""
    return tuple(name for name in builtin_names() if not name.startswith("section"))
