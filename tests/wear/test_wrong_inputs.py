"""Whatever is wrong with a request is one of the documented errors, by command line and Python."""

from dataclasses import replace
from itertools import count, cycle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import wear
from wear import cli

NAN, INF = float("nan"), float("inf")
K, HARDNESS = "bearing.wear_coefficient", "bearing.hardness_MPa=150,200"
SECTION4 = wear.load_scene("section4")
READ = {"cycles": [10, 100], "wear_mm": [3e-4, 8e-4]}
TABLES, RECORD = SECTION4.to_tables(), {"kind": "table", "file": "pin.csv"}
OPEN: Any = wear  # whose calls below are wrong on purpose


@pytest.mark.parametrize(
    "call",
    [
        lambda: OPEN.solve("section4", "abc"),
        lambda: OPEN.solve("section4", "9000"),
        lambda: OPEN.solve("section4", None),
        lambda: OPEN.solve("section4", []),
        lambda: OPEN.solve("section4", [[1, 2]]),
        lambda: OPEN.solve("section4", [True]),
        lambda: OPEN.solve("section4", {1: 2, "a": 3}),
        lambda: OPEN.solve("section4", np.array([1.0, NAN])),
        lambda: OPEN.solve("section4", INF),
        lambda: OPEN.solve("section4", 10**400),
        lambda: OPEN.solve("section4", 1j),
        lambda: OPEN.solve("section4", 1, rtol="1e-8"),
        lambda: OPEN.solve("section4", 1, rtol=NAN),
        lambda: OPEN.solve("section4", 1, rtol=0.0),
        lambda: OPEN.solve("section4", 1, rtol=None),
        lambda: OPEN.solve("section4", 1, method=None),
        lambda: OPEN.solve("section4", 1, method=["abel"]),
        lambda: OPEN.solve("section4", 1, time_limit="1"),
        lambda: OPEN.solve("section4", 1, time_limit=-1.0),
        lambda: OPEN.solve(Path("nowhere.toml"), 1),
        lambda: OPEN.solve(None, 1),
        lambda: OPEN.solve(4, 1),
        lambda: OPEN.solve({"bearing": {}}, 1),
        lambda: OPEN.asymptote("nowhere"),
        lambda: OPEN.asymptote(None),
        lambda: OPEN.cycles_until("section4", None),
        lambda: OPEN.cycles_until("section4", 1e-3, rtol=NAN),
        lambda: OPEN.load_scene("section4", ["bearing.hardness_MPa"]),
        lambda: OPEN.load_scene("a\0b"),
        lambda: OPEN.Scene.from_dict({}),
        lambda: OPEN.Scene.from_dict({"bearing": None, 3: 4}),
        lambda: OPEN.Scene.from_dict("section4"),
        lambda: OPEN.Scene.from_dict(None),
        lambda: SECTION4.with_({"": 1}),
        lambda: SECTION4.with_({"bearing.": 1}),
        lambda: SECTION4.with_({"bearing.hardness_MPa": np.array([1.0, 2.0])}),
        lambda: SECTION4.with_({"load.kind": None}),
        lambda: SECTION4.with_({"load.kind": 3}),
        lambda: replace(SECTION4, pin={}),  # type: ignore[arg-type]
        lambda: OPEN.Table("ab", "cd"),
        lambda: OPEN.Table(None, None),
        lambda: OPEN.Sine(object(), 1.0),
        lambda: OPEN.Blocks([{"kind": "sine"}]),
        lambda: OPEN.Blocks(3),
        lambda: OPEN.Block(OPEN.HistoryLoad((0, 1), (0, 0), 1), 1),
        lambda: OPEN.Block(OPEN.Force(1, 1), 1),
        lambda: OPEN.HistoryLoad((0, 1), (0, 0), 2),
        lambda: OPEN.Bearing({}, [], None, "x"),
        lambda: OPEN.solve("section4", 1).write("wear.xlsx"),
        lambda: OPEN.fit(None, "section4", K),
        lambda: OPEN.fit([1, 2], "section4", K),
        lambda: OPEN.fit(READ, "section4", None),
        lambda: OPEN.fit(READ, "section4", [3]),
        lambda: OPEN.fit(READ, "section4", K, ignore=3),
        lambda: OPEN.fit(READ, "section4", K, intervals=False).forecast(0),
        lambda: OPEN.fit(READ, "section4", K, intervals=False).forecast("x"),
        lambda: OPEN.fit({"cycles": [1, 2], "wear_mm": [1]}, "section4", K),
        lambda: OPEN.fit({"cycles": [1, 2], "wear_mm": [[1], None]}, "section4", K),
        lambda: OPEN.fit(READ, "section4", K, error=print),
        lambda: OPEN.study("section4", "bearing.hardness", 1, "out.zarr"),
        lambda: OPEN.study("section4", [3], 1, "out.zarr"),
        lambda: OPEN.study("section4", HARDNESS, NAN, "out.zarr"),
        lambda: OPEN.study("section4", HARDNESS, "9000", "out.zarr"),
        lambda: OPEN.study("section4", HARDNESS, 1, None),
        lambda: OPEN.study("section4", HARDNESS, 1, "out.zarr", rtol="1e-7"),
        lambda: OPEN.study("section4", HARDNESS, 1, "out.zarr", until_wear="1"),
        lambda: OPEN.study("section4", HARDNESS, 1, "out.zarr", design=None),
        lambda: OPEN.study("section4", HARDNESS, 1, "out.zarr", seed=None),
        lambda: OPEN.study("section4", HARDNESS, 1, "out.zarr", samples="8"),
        lambda: OPEN.study("section4", HARDNESS, 1, "out.zarr", executor=4),
        lambda: OPEN.sobol_indices("section4", HARDNESS, 1, samples=2.5),
        lambda: OPEN.sweep(["nowhere"], [1]),
        lambda: OPEN.sweep("section4", [1]),
        lambda: OPEN.sweep(["section4"], [-1]),
        lambda: OPEN.sweep(["section4"], None),
        lambda: OPEN.sweep(["section4"], [1], rtol="1e-7"),
        lambda: OPEN.sensitivity("section4", "9000"),
        lambda: OPEN.solve("section4", b"9000"),
        lambda: OPEN.load_scene(3),
        lambda: OPEN.load_scene("section4", None),
        lambda: OPEN.load_scene("section4", "bearing.hardness_MPa=3"),
        lambda: OPEN.load_scene("section4", [3]),
        lambda: OPEN.load_scene("section4", {"bearing.hardness_MPa": 3}),
        lambda: OPEN.bind(None),
        lambda: SECTION4.with_(None),  # type: ignore[arg-type]
        lambda: SECTION4.with_([("bearing.hardness_MPa", 1)]),  # type: ignore[arg-type]
        lambda: OPEN.cycles_to_depth("section4", 1e-3),
        lambda: OPEN.cycles_to_depth(["section4"], "a"),
        lambda: OPEN.cycles_to_depth(["section4"], [NAN]),
        lambda: OPEN.cycles_to_depth(["section4"], [-1e-3]),
        lambda: OPEN.cycles_to_depth(["section4"], [1e-3], rtol=-1),
        lambda: OPEN.cycles_to_depth([3], [1e-3]),
        lambda: OPEN.gradients("section4", [K], [1]),
        lambda: OPEN.gradients(["section4"], [K], ["1"]),
        lambda: OPEN.read_readings(3),
        lambda: OPEN.solve("section4", 1).write(3),
        lambda: OPEN.picture(3),
        lambda: OPEN.plot_pressure("section4", [1.5]),
        lambda: OPEN.bind_many([3]),
        lambda: OPEN.ten_percent_life({}),
        lambda: OPEN.bind_many(3),
        lambda: OPEN.gradients(["section4"], 3, [1]),
        lambda: OPEN.gradients(["section4"], [K], None),
        lambda: OPEN.plot(3),
        lambda: OPEN.plot({"mine": 3}),
        lambda: OPEN.posterior(3, 3),
        lambda: OPEN.study("section4", 3, 1, "out.zarr"),
        lambda: OPEN.solve("section4", 1).write("/no such folder/wear.csv"),
        lambda: replace(SECTION4, name=3),  # type: ignore[arg-type]
        lambda: OPEN.solve("section4", count(1)),
        lambda: OPEN.cycles_to_depth(["section4"], cycle([1e-3])),
        lambda: OPEN.Scene.from_dict({**TABLES, "load": RECORD}, folder=3),
        lambda: OPEN.sensitivity("section4", []),
        lambda: OPEN.sensitivity("section4", [1, -1]),
        lambda: OPEN.sensitivity(OPEN, 1),
        lambda: OPEN.sensitivity("section4", 1, rtol=1),
        lambda: OPEN.gradients(["section4"], [K, K], 1),
        lambda: OPEN.gradients(["section4"], [None], 1),
        lambda: OPEN.gradients([SECTION4], {K: 1}, count(1)),
        lambda: OPEN.fit({}, "section4", K),
        lambda: OPEN.fit({"cycles": [], "wear_mm": []}, "section4", K),
        lambda: OPEN.fit(READ | {"specimen": [1]}, "section4", K),
        lambda: OPEN.fit(READ | {"cycles": [100, 10]}, "section4", K),
        lambda: OPEN.fit(READ | {"cycles": "ab"}, "section4", K),
        lambda: OPEN.fit(READ | {"wear_um": [1, 2]}, "section4", K),
        lambda: OPEN.fit(READ | {"wear_mm": [NAN, 1]}, "section4", K),
        lambda: OPEN.fit(READ | {"standard_error_mm": [0, 1]}, "section4", K),
        lambda: OPEN.fit(READ, None, K),
        lambda: OPEN.fit(READ, "section4", K, K),
        lambda: OPEN.fit(READ, "section4", K, error=None),
        lambda: OPEN.fit(READ, "section4", K, ignore=["a"]),
        lambda: OPEN.fit(READ, "section4", K, intervals=False).life(NAN),
        lambda: OPEN.fit(READ, "section4", K, intervals=False).life("a"),
        lambda: OPEN.fit(READ, "section4", K, intervals=False).life([1e-3, 2e-3]),
        lambda: OPEN.fit(READ, "section4", K, intervals=False).forecast(count(1)),
        lambda: OPEN.fit(READ, "section4", K, intervals=False).next_reading(NAN),
        lambda: OPEN.fit(READ, "section4", K, intervals=False).as_json([0]),
        lambda: OPEN.posterior(OPEN.fit(READ, "section4", K, intervals=False), 0),
        lambda: OPEN.study("section4", [HARDNESS] * 2, 1, "out.zarr"),
        lambda: OPEN.study("section4", HARDNESS, count(1), "out.zarr"),
        lambda: OPEN.study("section4", "bearing.hardness_MPa=150:200:0", 1, "out.zarr"),
        lambda: OPEN.study("section4", "bearing.hardness_MPa=", 1, "out.zarr"),
        lambda: OPEN.study("section4", "bearing.hardness_MPa=uniform(2,1)", 1, "out.zarr"),
        lambda: OPEN.sobol_indices("section4", HARDNESS, 1),
        lambda: OPEN.sobol_indices("section4", "bearing.hardness_MPa=uniform(1,2)", [], samples=8),
    ],
)
def test_no_call_ends_otherwise_than_by_an_error_of_the_family(call):
    with pytest.raises(wear.WearError) as caught:
        call()
    assert str(caught.value).strip()


@pytest.mark.parametrize(
    "line",
    [
        "run section4 --rtol 1",
        "run section4 --rtol nan",
        "run section4 --until-wear -1",
        "run section4 --until-wear x",
        "run section4 --phases 0 -o a.nc",
        "run section4 --phases 2.5 -o a.nc",
        "run section4 --set bearing=3",
        "run section4 --set bearing.hardness_MPa=",
        "run section4 --set load.kind=table",
        "run section4 --set load.kind=table --set load.file=/dev/zero",
        "run section4 --set name=x",
        "run /dev/zero",
        "run .",
        "asymptote nowhere.toml",
        "asymptote section4 --set contact.law=3",
        "figure section4 -o a.svg --cycles 0",
        "figure section4 -o a.svg --inside x",
        "explore nowhere",
        "explore section4 -o page.txt",
        "run section4 --cycles 9.000",
        "run section4 --cycles 5 --cycles 6",
        "run section4 --rtol 1e-3 --rtol=1e-4",
        "figure section4 section4 -o a.svg",
        "figure section4 -o a.svg --inside 1 --log",
        "figure section4 -o a.svg --cycles 1e10 --strict",
        "sensitivity section4 --cycles 1e10 --strict",
        "study section4 --vary load.period_s=1,2 -o a.zarr --workers 1.5",
        "study section4 --vary load.period_s=1,2 -o a.zarr --samples 2.5",
        "study section4 --vary load.period_s=1,2 -o a.zarr --scheduler somewhere",
        "report section4 --set bearing.hardness_MPa=0 -o out",
    ],
)
def test_no_command_ends_otherwise_than_by_status_2(line, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    try:
        status = cli.main(line.split())
    except SystemExit as stop:
        status = int(str(stop.code))
    shown = capsys.readouterr()
    assert (status, shown.out) == (2, "")
    assert shown.err.startswith(("wear", "usage"))
    assert not list(tmp_path.iterdir())
