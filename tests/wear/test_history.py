"""Histories: the fields at the ends of cycles, what is told with them, and their files."""

import csv
import dataclasses
import itertools
import json
import signal

import numpy as np
import pytest
from scipy.io import netcdf_file

from wear import direct
from wear.faults import AccuracyError, Interrupted, UsageError
from wear.history_files import States, write
from wear.inside import fields_inside
from wear.load import Block, Blocks, Constant, Sine, Table
from wear.quantities import unit_of
from wear.scene import Scene, load_scene
from wear.solver import solve

from .reference_scenes import REFERENCE, made, reference_scene

CONTRACT = {
    *("scene", "model", "method", "rtol", "cycles", "bearing_wear_mm", "pin_wear_mm"),
    *("bearing_roughness_mm", "pin_roughness_mm", "closure_mm", "pressure_at_start_MPa"),
    *("peak_pressure_MPa", "mean_pressure_MPa", "contact_fraction"),
    *("error_estimate", "cost", "seconds", "notices"),
}


@pytest.fixture(scope="module")
def section3():
    return solve(reference_scene("S1"), [10, 0, 1, 10], rtol=1e-8, method="DOP853")


@pytest.fixture(scope="module")
def compliant():
    return solve(reference_scene("S8_2"), [0, 1], rtol=1e-6, method="DOP853")


def test_requests_are_answered_in_their_order(section3):
    assert section3.cycles.tolist() == [10, 0, 1, 10]
    expected = [REFERENCE["S1"][10], 0.0, REFERENCE["S1"][1], REFERENCE["S1"][10]]
    np.testing.assert_allclose(section3.u_c, expected, rtol=1e-8)


@pytest.mark.parametrize("springs", [None, {"stiffness_MPa_per_mm": 1e5}])
def test_the_constant_roughness_of_a_pin_that_does_not_wear_is_a_column(tmp_path, springs):
    pin = {"hardness_MPa": 600.0, "wear_coefficient": 0.0, "roughness_mm": 6.5e-5}
    pin["roughness_growth"] = 0.0
    scene = load_scene("section4").with_({"pin": pin, "support": springs})
    history = solve(scene, [1, 10], rtol=1e-6)
    assert history.as_json()["pin_roughness_mm"] == [6.5e-5] * 2
    for name in ("a.nc", "a.csv"):
        history.write(tmp_path / name)
    with netcdf_file(tmp_path / "a.nc", mmap=False) as file:
        assert file.variables["pin_roughness_mm"][:].tolist() == [6.5e-5] * 2
    assert history.to_dataframe()["pin_roughness_mm"].tolist() == [6.5e-5] * 2
    (part,) = fields_inside(scene, range(2), np.arange(3) / 3)
    assert part.fields.sigma_a.shape == (2, 3)


def test_the_fields_are_those_of_the_equations(section3):
    """Eqs. (1), (3), (4), (5) by hand, at U_a(N T) = 0."""
    u_c, u_a = section3.u_c, section3.u_c / 3.0
    np.testing.assert_allclose(section3.u_a, u_a, rtol=1e-14)
    np.testing.assert_allclose(section3.sigma_c, 3.6e-4 - 0.05 * u_c, rtol=1e-14)
    np.testing.assert_allclose(section3.sigma_a, 6.5e-5 + 0.05 * u_a, rtol=1e-14)
    h = 3.0 * np.hypot(3.6e-4, 6.5e-5) + u_c - u_a
    np.testing.assert_allclose(section3.h, h, rtol=1e-14)
    sigma = np.hypot(section3.sigma_c, section3.sigma_a)
    np.testing.assert_allclose(section3.p, 150 * (1 + np.tanh(4 - 2 * h / sigma)), rtol=1e-10)


def test_a_compliant_support_gives_way(compliant, section3):
    np.testing.assert_allclose(compliant.U_c, compliant.p / 1e5, rtol=1e-14)
    np.testing.assert_allclose(compliant.h, 1.08e-3 + compliant.u_c + compliant.U_c, rtol=1e-14)
    assert section3.U_c is None


def test_what_a_variant_does_not_have_is_absent(compliant, tmp_path):
    """A smooth pin that does not wear: no zeros; JSON has its keys always, without a value."""
    assert compliant.u_a is compliant.sigma_a is None
    absent = {"pin_wear_mm", "pin_roughness_mm"}
    assert not absent & set(compliant.to_dataframe().columns)
    assert [compliant.as_json()[key] for key in sorted(absent)] == [[None, None]] * 2
    compliant.write(tmp_path / "wear.nc")
    with netcdf_file(tmp_path / "wear.nc", mmap=False) as file:
        assert not absent & set(file.variables)


def test_json_has_the_keys_of_the_contract(section3, compliant):
    document = section3.as_json()
    assert set(document) == CONTRACT
    assert set(document["model"]) == {"variant", "operations"}
    assert set(document["cost"]) == {"cycles_integrated", "rhs_evaluations"}
    assert json.loads(json.dumps(document, allow_nan=False)) == document
    assert document["bearing_wear_mm"] == section3.u_c.tolist()
    assert set(compliant.as_json()) == CONTRACT | {"bearing_displacement_mm"}


def test_csv_reads_back_exactly(section3, tmp_path):
    section3.write(tmp_path / "wear.csv")
    lines = (tmp_path / "wear.csv").read_text(encoding="utf-8").splitlines()
    notes = dict(line[2:].split(": ", 1) for line in lines if line.startswith("# "))
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    assert [int(row["cycle"]) for row in rows] == section3.cycles.tolist()
    for name, values in section3.columns().items():
        np.testing.assert_array_equal([float(row[name]) for row in rows], values)
    assert notes["method"] == "DOP853"
    assert notes["complete"] == "true"
    scene = Scene.from_dict(json.loads(notes["scene"]))
    assert scene == reference_scene("S1")


def test_netcdf_reads_back_exactly_with_units_and_scene(compliant, tmp_path):
    compliant.write(tmp_path / "wear.nc")
    with netcdf_file(tmp_path / "wear.nc", mmap=False) as file:
        for name, values in compliant.columns().items():
            variable = file.variables[name]
            assert variable.dimensions == ("cycle",)
            assert variable.units.decode() == (unit_of(name) or "1")
            np.testing.assert_array_equal(variable[:], values)
        assert file.variables["cycle"][:].tolist() == [0.0, 1.0]
        assert Scene.from_dict(json.loads(file.scene)) == reference_scene("S8_2")
        assert json.loads(file.cost) == compliant.cost


def test_everything_wrong_with_a_request_is_told_at_once():
    with pytest.raises(UsageError) as refusal:
        solve(
            reference_scene("S2"),
            [1, -1, 1.5, float("nan"), 1e13],
            rtol=2.0,
            method="Euler",
            time_limit=0.0,
        )
    told = str(refusal.value)
    assert len(told.splitlines()) == 7
    for phrase in ("-1", "1.5", "nan", "10000000000000.0", "rtol: 2.0", "'Euler'", "time_limit"):
        assert phrase in told


def test_an_accuracy_out_of_reach_is_told_with_the_best_result():
    with pytest.raises(AccuracyError, match="requested") as miss:
        solve(reference_scene("S2"), [1, 10], rtol=1e-15, method="DOP853")
    best = miss.value.best
    true = np.abs(best.u_c / [REFERENCE["S2"][1], REFERENCE["S2"][10]] - 1.0)
    assert np.all(true <= best.error)
    assert np.all(best.error < 1e-11)


def test_a_time_limit_keeps_what_was_computed(tmp_path):
    solve(reference_scene("S2"), [1], 1e-6, "RK23")  # what is imported by need takes its time
    with pytest.raises(Interrupted, match="time limit") as stop:
        solve(reference_scene("S2"), [1, 2, 10**11], 1e-6, "RK23", time_limit=1.0)
    history = stop.value.history
    assert history.cycles.tolist() == [1, 2]
    np.testing.assert_allclose(history.u_c[0], REFERENCE["S2"][1], rtol=1e-5)
    assert history.as_json()["cycles"] == [1, 2]
    history.write(tmp_path / "wear.csv")
    assert "# complete: false" in (tmp_path / "wear.csv").read_text(encoding="utf-8")


def test_a_count_out_of_time_keeps_its_first_cycles():
    """No time at all: the first cycles are integrated, and no panel is refined."""
    scene = made(load=Sine(5e-3, 0.06))
    with pytest.raises(Interrupted, match="time limit has passed; cycle 3 was") as stop:
        solve(scene, [1, 3, 10**9], 1e-12, time_limit=1e-9)
    history = stop.value.history
    assert history.method == "abel"
    assert history.cycles.tolist() == [1, 3]
    in_time = solve(scene, [1], 1e-12)
    assert np.abs(history.u_c[0] / in_time.u_c[0] - 1) <= history.error[0] <= 1e-12


@pytest.mark.parametrize("cutoff", [False, True])
def test_blocks_out_of_time_keep_the_first_one(cutoff):
    blocks = Blocks((Block(Sine(2e-4, 0.06), 3), Block(Sine(5e-4, 0.03), 5)), 100)
    scene = dataclasses.replace(made(1e-5, cutoff=cutoff), load=blocks)
    with pytest.raises(Interrupted, match="time limit") as stop:
        solve(scene, [1, 3, 4, 700], 1e-15, "abel", time_limit=1e-9)
    assert stop.value.history.cycles.tolist() == [1, 3]


@pytest.mark.parametrize("cutoff", [False, True])
def test_out_of_time_within_the_first_cycle(monkeypatch, cutoff):
    monkeypatch.setattr("wear.cycles.GRACE", 0.0)
    with pytest.raises(Interrupted, match="time limit has passed; no requested cycle") as stop:
        solve(made(cutoff=cutoff), [1], 1e-10, "abel", time_limit=1e-9)
    assert len(stop.value.history.cycles) == 0


@pytest.mark.parametrize("fault", [np.linalg.LinAlgError("singular"), FloatingPointError("lost")])
def test_a_count_that_breaks_down_is_told_and_auto_goes_on(monkeypatch, fault):
    def broken(*_, **__):
        raise fault

    monkeypatch.setattr("wear.solver.wear_after", broken)
    with pytest.raises(AccuracyError, match="could not be counted"):
        solve(reference_scene("S2"), [1], 1e-8, "abel")
    history = solve(reference_scene("S2"), [1], 1e-8)
    assert history.method == "DOP853"
    assert np.abs(history.u_c[0] / REFERENCE["S2"][1] - 1) <= history.error[0] <= 1e-8


def test_an_interrupt_keeps_what_was_computed(monkeypatch):
    def interrupted(*arguments):
        yield from itertools.islice(march(*arguments), 1)
        signal.raise_signal(signal.SIGINT)

    march = direct._march
    monkeypatch.setattr(direct, "_march", interrupted)
    # A process that was started in the background ignores the signal.
    handler = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(Interrupted, match="interrupted") as stop:
            solve(reference_scene("S2"), [1, 10**9], 1e-6, "DOP853")
    finally:
        signal.signal(signal.SIGINT, handler)
    history = stop.value.history
    assert history.cycles.tolist() == [1]
    assert np.isnan(history.error).all()  # there was no second run to compare with
    np.testing.assert_allclose(history.u_c, REFERENCE["S2"][1], rtol=1e-5)


def test_a_negative_roughness_is_told_with_the_wear_at_which_it_begins():
    """Section 3 with fast wear: sigma_c changes sign at u_c = 3.6e-4/0.05 = 0.0072 mm."""
    scene = made(1e-3, -0.05, Constant(1e-2, 0.06), pin=True)
    history = solve(scene, [1], 1e-6, "DOP853")
    assert history.sigma_c[0] < 0.0
    assert any("bearing is negative beyond u_c = 0.0072 mm" in text for text in history.notices)


def test_the_pressure_out_of_contact_is_zero_and_arrest_is_told():
    history = solve(made(1e-4, cutoff=True), [0, 100], 1e-8, "DOP853")
    assert history.p.tolist() == [pytest.approx(300 / (1 + np.exp(4))), 0.0]
    assert history.h[1] == pytest.approx(1.08e-3 + 0.002)
    assert "wear stops for good in cycle 21" in history.notices


@pytest.mark.parametrize("name", ["S2", "S8_2"])
def test_a_history_inside_the_cycles_is_written_chunk_by_chunk(name, tmp_path):
    scene, phases = reference_scene(name), np.linspace(0.0, 1.0, 7)
    cycles = np.arange(0.0, 40.0, 3.0)

    def parts(chunk):
        return fields_inside(scene, cycles, phases, chunk=chunk)

    (whole,) = parts(10**6)
    states = (States(part.cycles, part.columns(), part.phases) for part in parts(21))
    write(states, tmp_path / "inside.nc", {"scene": scene.to_json()})
    with netcdf_file(tmp_path / "inside.nc", mmap=False) as file:
        assert file.dimensions == {"cycle": None, "phase": 7}
        assert file.variables["cycle"][:].tolist() == cycles.tolist()
        assert file.variables["phase"][:].tolist() == phases.tolist()
        written = {key: value[:] for key, value in file.variables.items()}
        assert ("bearing_displacement_mm" in written) == (scene.support is not None)
        assert "pin_wear_mm" not in written
        assert Scene.from_dict(json.loads(file.scene)) == scene
        assert file.variables["bearing_wear_mm"].units == b"mm"
    np.testing.assert_allclose(written["bearing_wear_mm"], whole.u, rtol=1e-14)
    np.testing.assert_allclose(written["pressure_MPa"], whole.fields.p, rtol=1e-11)
    np.testing.assert_allclose(written["closure_mm"], whole.fields.h, rtol=1e-13)
    np.testing.assert_allclose(written["error_estimate"], whole.error, rtol=1e-6)


def test_a_history_inside_the_cycles_that_stops_leaves_nothing(tmp_path):
    def interrupted():
        yield States(np.arange(3), {"bearing_wear_mm": np.zeros((3, 1))}, np.zeros(1))
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write(interrupted(), tmp_path / "inside.nc", {})
    assert list(tmp_path.iterdir()) == []


def test_labelled_tables_hold_the_columns(compliant):
    pytest.importorskip("pandas")
    pytest.importorskip("xarray")
    frame, labelled = compliant.to_dataframe(), compliant.to_xarray()
    assert frame.index.tolist() == labelled["cycle"].values.tolist() == [0, 1]
    for name, values in compliant.columns().items():
        np.testing.assert_array_equal(frame[name], values)
        np.testing.assert_array_equal(labelled[name], values)
        assert labelled[name].attrs["units"] == (unit_of(name) or "1")
    assert Scene.from_dict(json.loads(labelled.attrs["scene"])) == reference_scene("S8_2")


def test_a_history_is_shown_in_short(section3):
    assert "u_c = 0.000200172 mm after cycle 10" in repr(section3)
    assert len(repr(section3)) < 200
    assert section3._repr_html_().count("<tr>") == 5
    assert "rows" in repr(Table((0.0, 1.0), (0.0, 0.0)))
