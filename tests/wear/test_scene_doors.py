"""The same checks run on every way to a scene and to a load."""

import itertools
import json
import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import sympy

from wear.faults import SceneError
from wear.load import Block, Blocks, Harmonics, HistoryLoad, Sine, Table
from wear.scene import Scene, load_scene, parse_scene
from wear.scene.tables import Bearing, Contact, Motion, Pin, Support
from wear.sensitivities import sensitivity
from wear.solver import solve

SECTION4 = load_scene("section4")


def changed(table: str, key: str, value: object) -> tuple[Callable[[], object], ...]:
    """The ways to a scene whose entry has this value."""
    tables = SECTION4.to_tables()
    tables.setdefault(table, {})[key] = value

    def rebuilt() -> object:
        entries = tables[table]
        kinds = {"bearing": Bearing, "contact": Contact, "motion": Motion, "support": Support}
        if table == "load":
            return Sine(**{name: each for name, each in entries.items() if name != "kind"})
        return kinds[table](**entries)

    part = getattr(SECTION4, table)
    return (
        lambda: Scene.from_dict(tables),
        lambda: SECTION4.with_({f"{table}.{key}": value}),
        rebuilt,
        *([lambda: replace(SECTION4, **{table: replace(part, **{key: value})})] if part else []),
    )


@pytest.mark.parametrize(
    ("table", "key", "value", "problem"),
    [
        ("bearing", "wear_coefficient", -1e-6, "-1e-06 is negative"),
        ("bearing", "hardness_MPa", math.nan, "nan is not a finite number"),
        ("bearing", "hardness_MPa", "200", "is text, not a number"),
        ("bearing", "hardness_MPa", True, "is true or false"),
        ("bearing", "hardness", 200.0, "did you mean hardness_MPa?"),
        ("bearing", "radius_mm", 1.0, "it belongs to [motion]"),
        ("contact", "law", "tan", "did you mean tanh?"),
        ("contact", "width_mm", 1.0, "length_mm is missing"),
        ("motion", "speed_rpm", math.inf, "inf is not a finite number"),
        ("support", "stiffness_MPa_per_mm", 0.0, "is zero"),
        ("load", "period_s", -0.06, "-0.06 is negative"),
        ("load", "amplitude_mm", [5e-4], "is a list"),
        ("load", "value_mm", 1.0, 'it belongs to kind = "constant"'),
    ],
)
def test_a_wrong_entry_is_refused_at_every_door(table, key, value, problem):
    for way in changed(table, key, value):
        with pytest.raises(SceneError) as caught:
            way()
        assert problem in str(caught.value)
        assert all(fault.remedy for fault in caught.value.faults)


def test_all_faults_of_a_table_come_at_once():
    with pytest.raises(SceneError) as caught:
        Bearing(-200.0, "1e-6", math.nan, 1e99)  # type: ignore[arg-type]
    assert [(fault.table, fault.key) for fault in caught.value.faults] == [
        ("bearing", "hardness_MPa"),
        ("bearing", "wear_coefficient"),
        ("bearing", "roughness_mm"),
        ("bearing", "roughness_growth"),
    ]


@pytest.mark.parametrize(
    ("make", "problem"),
    [
        (lambda: Contact(300.0, 1e-3, 3.0), "are both given"),
        (lambda: replace(SECTION4, load=None), "is not a table"),
        (lambda: replace(SECTION4, load="sine"), "is not a table"),
        (lambda: replace(SECTION4, bearing=None), "[bearing]: is not a table"),
        (lambda: replace(SECTION4, motion=Pin(1.0, 0.0, 0.0, 0.0)), "[motion]: is not a table"),
        (lambda: replace(SECTION4, title="a\x07b"), "control characters"),
        (lambda: SECTION4.with_({"bearing": None}), "[bearing]: missing"),
        (lambda: SECTION4.with_({"bering.hardness_MPa": 1.0}), "did you mean bearing?"),
        (lambda: SECTION4.with_({"bearing.hardness_MPa.x": 1.0}), "unknown key"),
        (lambda: SECTION4.with_({"name": "x"}), "unknown key"),
        (lambda: Bearing(1.0, 1e-6, 1e-4), "missing"),  # type: ignore[call-arg]
        (lambda: Bearing(1.0, 1e-6, 1e-4, 0.0, 5.0), "no entry of its own"),  # type: ignore[call-arg]
        (lambda: Sine(1.0, 1.0, amplitude_mm=2.0), "no entry of its own"),  # type: ignore[misc]
        (lambda: Harmonics(0.0, (1e-4,) * 101, (), 1.0), "101 entries"),
        (lambda: Table((0.0, 2.0, 1.0), (0.0, 1e-4, 0.0)), "does not come after 2.0"),
        (lambda: Table((0.1, 0.2, 1.0), (0.0, 1e-4, 0.0)), "starts at 0.1"),
        (lambda: Table((0.0, 1.0), (0.0, 1e-4)), "jumps at the seam"),
        (lambda: Table((0.0, 1.0), (0.0, math.nan)), "not a finite number"),
        (lambda: Table((0.0, True), ("0", 0.0)), "entry 2: is true or false"),
        (lambda: Table((0.0, 1.0), (0.0, 1e300)), "entry 2: 1e+300 is out of range"),
        (lambda: Table((0.0, 1.0), (0.0,)), "2 times and 1 values"),
        (lambda: Harmonics(0.0, itertools.count(), (), 1.0), "too many entries"),  # type: ignore[arg-type]
        (lambda: Table(range(10**9), (0.0,)), "1000000000 entries"),  # type: ignore[arg-type]
        (lambda: Harmonics(0.0, {1e-4, 2e-4}, (), 1.0), "is of type set"),  # type: ignore[arg-type]
        (lambda: Motion(sympy.Symbol("R"), 1.0), "is of type Symbol"),
        (lambda: SECTION4.with_({"title.x": 3}), "title: is a table"),
        (lambda: HistoryLoad((0.0, 1.0), (0.0, 1.0), -1.0), "negative"),
        (lambda: HistoryLoad((0.0, 0.0), (0.0, 1.0), 1.0), "does not come after"),
        (lambda: Blocks(()), "has 0 blocks"),
        (
            lambda: Scene.from_dict({"load": {"kind": "table", "times_s": [], "source": 1}}),
            "source: unknown key",
        ),
        (lambda: Blocks((Block(Sine(1e-4, 1.0), -3),)), "out of range"),
        (lambda: Blocks((Block(None, 3),)), "is not a table"),  # type: ignore[arg-type]
        (lambda: Blocks((Block(Sine(1e-4, 1.0), 10**9),), 10**9), "1e+18 cycles in all"),
    ],
)
def test_what_no_constructor_takes(make, problem):
    with pytest.raises(SceneError) as caught:
        make()
    assert problem in str(caught.value)


def overridden(changes: dict[str, object]) -> Scene:
    """Section 4 with `--set KEY = VALUE` for each change."""
    return load_scene("section4", [f"{key} = {json.dumps(to)}" for key, to in changes.items()])


@pytest.mark.parametrize("change", [SECTION4.with_, overridden])
def test_changes_take_the_place_of_entries(change):
    other = change(
        {
            "bearing.roughness_growth": 0.3,
            "contact.closure_in_sigma": 2.5,
            "contact.ends_at_3_sigma": True,
            "support.stiffness_MPa_per_mm": 1e5,
            "load.kind": "harmonics",
            "load.sine_mm": [1e-4, 2e-4],
        }
    )
    assert other.bearing == replace(SECTION4.bearing, roughness_growth=0.3)
    assert other.contact == Contact(300.0, None, 2.5, ends_at_3_sigma=True)
    assert other.support == Support(1e5)
    assert other.load == Harmonics(0.0, (), (1e-4, 2e-4), 0.06)
    assert other.name == "section4"
    assert other.with_({"support": None}).support is None
    assert SECTION4.bearing.roughness_growth == 0.25


LISTS: list[tuple[object, str, float]] = [
    (Harmonics(0.0, (1e-4, 3e-4), (2e-4,), 0.06), "load.cosine_mm[1]", 3e-4),
    (Table((0.0, 0.02, 0.06), (0.0, 4e-4, 0.0)), "load.values_mm[1]", 4e-4),
    (Blocks((Block(Sine(2e-4, 0.06), 5), Block(Sine(5e-4, 0.03), 3)), repeat=2),
     "load.blocks[1].amplitude_mm", 5e-4),
]  # fmt: skip


@pytest.mark.parametrize(("load", "key", "value"), LISTS)
def test_an_entry_of_a_list_is_changed_by_the_name_that_sensitivities_give_it(load, key, value):
    scene = replace(SECTION4, load=load)
    assert scene.with_({key: value}) == scene
    changed = parse_scene(scene.to_toml(), overrides=[f"{key}={2 * value!r}"])
    assert changed == scene.with_({key: 2 * value}) != scene
    step = 1e-4 * value
    more, less = (solve(scene.with_({key: value + by}), 8, 1e-13).u_c[0] for by in (step, -step))
    found = sensitivity(scene, [8])
    slope = found.derivative[list(found.keys).index(key), 0]
    assert (more - less) / (2.0 * step) == pytest.approx(slope, rel=1e-6)


def test_what_is_no_entry_of_a_list_is_refused_with_all_other_faults():
    keys = ("load.amplitude_mm[0]", "bearing[1]", "title[0]", "load.blocks[0].period_s")
    for change in (SECTION4.with_, overridden):
        with pytest.raises(SceneError) as refused:
            change(dict.fromkeys(keys, 1.0) | {"motion.radius_mm": -1.0})
        lines = str(refused.value).splitlines()
        assert sum("is no entry of a list" in line for line in lines) == len(keys)
        assert sum("is negative" in line for line in lines) == 1


def test_rows_are_kept_unless_the_load_changes(tmp_path):
    (tmp_path / "pin.csv").write_text("t_s,U_a_mm\n0,0\n0.01,1e-4\n0.06,0\n")
    (tmp_path / "own.toml").write_text(
        SECTION4.to_toml().partition("[load]")[0] + '[load]\nkind = "table"\nfile = "pin.csv"\n'
    )
    scene = load_scene(tmp_path / "own.toml")
    other = scene.with_({"motion.speed_rpm": 1000.0})
    assert other.load is scene.load
    longer: Any = scene.with_({"load.period_s": 0.1}).load
    assert longer.times_s == (0.0, 0.01, 0.06, 0.1)


def test_changed_blocks_find_their_files(tmp_path):
    (tmp_path / "pin.csv").write_text("t_s,U_a_mm\n0,0\n0.01,1e-4\n0.06,0\n")
    (tmp_path / "own.toml").write_text(
        SECTION4.to_toml().partition("[load]")[0]
        + '[load]\nkind = "blocks"\n[[load.blocks]]\nkind = "table"\nfile = "pin.csv"\ncycles = 3\n'
    )
    scene = load_scene(tmp_path / "own.toml")
    blocks: Any = scene.load
    again: Any = scene.with_({"load.repeat": 5}).load
    assert again == replace(blocks, repeat=5)


def test_numbers_of_other_kinds_are_numbers():
    bearing = Bearing(np.float32(200), 1, np.array(3.6e-4), np.int64(0))  # type: ignore[arg-type]
    assert bearing == Bearing(200.0, 1.0, 3.6e-4, 0.0)
    assert all(type(value) is float for value in vars(bearing).values())
    with pytest.raises(SceneError, match="is true or false"):
        Bearing(np.True_, 1.0, 3.6e-4, 0.0)  # type: ignore[arg-type]
    assert Table(range(2), (0, 0)) == Table((0.0, 1.0), (0.0, 0.0))  # type: ignore[arg-type]
    assert Table(np.array([0.0, 1.0]), np.zeros(2)) == Table((0.0, 1.0), (0.0, 0.0))  # type: ignore[arg-type]


def test_pieces_may_be_given_as_tables():
    motion: Any = {"radius_mm": 22, "speed_rpm": 2000}
    assert replace(SECTION4, motion=motion).motion == Motion(22.0, 2000.0)
