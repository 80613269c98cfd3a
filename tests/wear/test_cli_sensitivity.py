"""`wear sensitivity`."""

import json

import numpy as np
import pytest

import wear


def test_the_document_has_the_keys_of_the_contract(call):
    status, shown, _ = call("sensitivity", "section4", "--cycles", "0,1,9000", "--json")
    found = json.loads(shown)
    assert status == 0
    assert found["cycles"] == [0, 1, 9000]
    assert found["bearing_wear_mm"][2] == wear.solve("section4", 9000).u_c[0]
    by_key = {row["key"]: row for row in found["parameters"]}
    growth = by_key["bearing.roughness_growth"]
    assert set(growth) >= {"key", "value", "derivative", "elasticity", "error_estimate"}
    assert growth["elasticity"][0] is None
    assert growth["elasticity"][2] == pytest.approx(
        growth["derivative"][2] * 0.25 / found["bearing_wear_mm"][2]
    )
    assert 0.0 < growth["error_estimate"][2] < 1e-10


def test_the_table_shows_elasticities_of_wear_and_life(call):
    status, shown, _ = call("sensitivity", "section4", "--cycles", "1", "--until-wear", "1e-3")
    assert status == 0
    rows = [line.split() for line in shown.splitlines() if line.startswith("bearing.wear_coef")]
    of_wear, of_life = rows
    assert len(of_wear) == 4  # key, value, one cycle, and the 140 to the depth
    longer = wear.cycles_until("section4", 1e-3).cycles[0]
    scene = wear.load_scene("section4").with_({"bearing.wear_coefficient": 1.1e-6})
    shorter = wear.cycles_until(scene, 1e-3).cycles[0]
    change = np.log(shorter / longer) / np.log(1.1)
    assert float(of_life[2]) == pytest.approx(change, abs=0.08)  # whole cycles of 140


@pytest.mark.parametrize("suffix", ["csv", "svg"])
def test_a_file_holds_every_number(call, tmp_path, suffix):
    file = tmp_path / f"found.{suffix}"
    status, shown, _ = call("sensitivity", "section4", "--cycles", "1,9000", "-o", str(file))
    assert (status, shown) == (0, "")
    text = file.read_text()
    if suffix == "csv":
        header, *rows = (line.split(",") for line in text.splitlines())
        assert len(rows) == 20
        row = dict(zip(header, next(r for r in rows if r[2] == "9000"), strict=True))
        assert row["key"] == "bearing.wear_coefficient"
        assert float(row["elasticity"]) == pytest.approx(0.384768, abs=1e-6)
    else:
        assert "roughness growth" in text


def test_all_faults_are_told_at_once(call):
    status, _, messages = call(
        "sensitivity", "section4", "--cycles", "x", "--rtol", "2", "-o", "found.txt"
    )
    assert status == 2
    assert all(name in messages for name in ("--cycles", "--rtol", "--output"))


def test_a_depth_that_is_not_reached_has_no_derivative(call):
    status, _, messages = call("sensitivity", "section4", "--until-wear", "1e20")
    assert status == 2
    assert "--until-wear: 1e+20 mm" in messages


def test_a_measured_history_is_refused(call, tmp_path):
    (tmp_path / "rows.csv").write_text("t_s,U_a_mm\n0,0\n1,1e-4\n2,0\n")
    change = f"load.file={tmp_path / 'rows.csv'}"
    status, _, messages = call(
        "sensitivity", "section4", "--set", "load.kind=history", "--set", change
    )
    assert status == 2
    assert "does not repeat" in messages
