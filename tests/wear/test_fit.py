"""Identification: what the data say of the parameters, how surely, and what they leave open."""

import copy
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas
import pytest
from scipy import stats
from scipy.optimize import least_squares

import wear
from wear.cli import main
from wear.faults import UsageError
from wear.fitting.laws import alternatives
from wear.fitting.posterior import posterior
from wear.fitting.readings import Specimen, read_readings
from wear.fitting.residuals import Residuals
from wear.numerics.gauss import FloatArray
from wear.scene import load_scene

EXAMPLES = Path(__file__).parents[2] / "docs" / "examples"

# Readings


def test_readings_are_those_of_the_file_in_mm(tmp_path):
    file = tmp_path / "wear.csv"
    file.write_text("specimen,load_g,load.value_mm,cycles,wear_um\n"
                    "b,10,-1e-4,5,2.5\nb,10,-1e-4,5,2\n\na,20,0,7,1\n")  # fmt: skip
    b, a = read_readings(file, ["load_g"])
    assert (b.name, b.cycles.tolist(), b.wear_mm.tolist()) == ("b", [5.0, 5.0], [2.5e-3, 2e-3])
    assert (b.changes, a.changes) == ({"load.value_mm": -1e-4}, {"load.value_mm": 0.0})
    assert b.standard_error_mm is None
    assert b.first(1).wear_mm.tolist() == [2.5e-3]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", ["no column cycles", "wear_mm or wear_um"]),
        ("cycles,wear_mm,wear_um,\x1b\n", ["in one column", r"\x1b: unknown"]),
        ("cycles,wear_in\n1,2\n", ["in one column", "wear_in: unknown", "--ignore wear_in"]),
        ("cycles,wear_mm\n1,2,3\n", ["line 2: 3 entries", "the header has 2"]),
        ("cycles,wear_mm\n\n1,-2\n0.5,nan\n", ["line 3: wear_mm", "line 4: wear_mm",
                                              "line 4: cycles", "line 4: the cycles decrease"]),
        ("cycles,wear_mm,standard_error_mm\n1,2,0\n", ["line 2: standard_error_mm", "one reading"]),
        ("cycles,wear_mm,load.value_mm,specimen\n1,2,0,a\n2,2,1,a\n", ["value_mm of specimen a"]),
        ("Rig 3\n\ncycles;wear_mm\n1;2\n2;3;4\n", ["line 5: 3 entries, but the header has 2"]),
        ("cycles;wear_um\n1.000;0,8\n2.000;1,2\n", ["line 2: cycles must", "without points"]),
    ],
)  # fmt: skip
def test_everything_that_is_wrong_with_a_file_is_said_at_once(tmp_path, text, words):
    file = tmp_path / "wear.csv"
    file.write_text(text)
    with pytest.raises(UsageError) as caught:
        read_readings(file)
    for word in words:
        assert word in str(caught.value)


def test_a_file_that_cannot_be_read_is_named(tmp_path):
    with pytest.raises(UsageError, match="is a folder"):
        read_readings(tmp_path)


@pytest.mark.parametrize("encoding", ["latin-1", "utf-16", "utf-8-sig"])
def test_readings_may_be_written_as_instruments_do(tmp_path, encoding):
    file = tmp_path / "wear.csv"
    head = "Prüfstand 3;22.11.2026\r\n\r\n"
    file.write_text(f'{head}cycles;"wear_um"\r\n1;0,25\r\n1e3;"1,5"\r\n', encoding=encoding)
    (only,) = read_readings(file)
    assert only.cycles.tolist() == [1.0, 1000.0]
    assert only.wear_mm.tolist() == [0.25e-3, 1.5e-3]


def test_names_of_columns_may_have_capitals(tmp_path):
    file = tmp_path / "wear.csv"
    file.write_text("Rig 3\nCycles,Wear_um,Specimen\n1,2,A\n2,3,A\n")
    (only,) = read_readings(file)
    assert (only.name, only.wear_mm.tolist()) == ("A", [2e-3, 3e-3])


def test_a_file_without_a_header_is_refused_in_one_sentence(tmp_path):
    file = tmp_path / "wear.csv"
    file.write_text("Time (h);Wear (um)\n0,5;0,8\n1;1,2;ok\n")
    with pytest.raises(UsageError, match="no column cycles") as caught:
        read_readings(file)
    assert "\n" not in str(caught.value)


# Fits

K, GROWTH, ROUGHNESS = (
    "bearing.wear_coefficient",
    "bearing.roughness_growth",
    "bearing.roughness_mm",
)
SCATTER = 0.05
CYCLES = np.array([1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0, 3000.0, 10_000.0])


def synthetic(seed: int, cycles: FloatArray = CYCLES, scene: str = "section4") -> Specimen:
    """Return readings of a scene with a scatter of 5 %."""
    noise = np.random.default_rng(seed).standard_normal(len(cycles))
    wear_mm = wear.solve(scene, cycles.astype(int), rtol=1e-8).u_c * np.exp(SCATTER * noise)
    return Specimen("", cycles, wear_mm, None, {})


@pytest.fixture(scope="module")
def far_off():
    """The scene of the synthetic readings with other numbers than theirs, to start from."""
    return load_scene("section4").with_({K: 5e-6, GROWTH: 0.15})


@pytest.fixture(scope="module")
def found(far_off):
    return wear.fit([synthetic(1)], far_off, [K, GROWTH])


def test_intervals_of_synthetic_readings_cover_the_truth(found, far_off):
    fits = [found, *(wear.fit([synthetic(seed)], far_off, [K, GROWTH]) for seed in (2, 3))]
    covered = [
        profile.interval[0] < truth < profile.interval[1]
        for each in fits
        for profile, truth in zip(each.profiles, (1e-6, 0.25), strict=True)
    ]
    assert sum(covered) >= 5
    assert not any(each.undetermined() for each in fits)


def test_what_late_readings_leave_open_is_named(far_off):
    late = synthetic(7, np.array([1e6, 1.26e6, 1.587e6, 2e6]))  # they see one rate of wear
    found = wear.fit([late], far_off, [K, GROWTH], intervals=False)
    ((combination, sentence),) = found.undetermined()
    assert set(combination) == {K, GROWTH}
    assert "do not determine" in sentence
    (ahead,) = found.forecast([3e6])
    truth = float(wear.solve("section4", 3_000_000).u_c[0])
    assert ahead.interval_95[0] < truth < ahead.interval_95[1]


def test_the_estimate_is_that_of_scipys_least_squares(found):
    other = least_squares(
        lambda theta: found.model(theta[None]).residuals[0],
        found.theta + 0.05,
        jac=lambda theta: found.model(theta[None]).slope[0],
        x_scale="jac",
    )
    np.testing.assert_allclose(found.theta, other.x, rtol=1e-5)
    variance = 2 * other.cost / found.degrees_of_freedom
    expected = np.linalg.inv(other.jac.T @ other.jac) * variance
    np.testing.assert_allclose(found.covariance, expected, rtol=1e-3)
    np.testing.assert_allclose(found.correlation[0, 1], found.correlation[1, 0])


def test_readings_under_blocks_are_fitted():
    """A start is not counted beyond the readings: blocks go one by one."""
    scene = load_scene(str(EXAMPLES / "blocks.toml"))
    cycles = np.array([1.0, 4.0, 20.0])
    truth = scene.with_({K: 2e-6})
    wear_mm = wear.solve(truth, cycles.astype(int), rtol=1e-8).u_c
    found = wear.fit([Specimen("", cycles, wear_mm, None, {})], scene, [K], intervals=False)
    assert found.estimates == pytest.approx([2e-6], rel=1e-3)


def test_a_forecast_ends_with_the_load():
    blocks = wear.Blocks(tuple(wear.Block(wear.Sine(swing, 0.06), 30) for swing in (2e-4, 5e-4)))
    scene = replace(load_scene("section4"), load=blocks)
    found = wear.fit({"cycles": [20, 60], "wear_mm": [2e-5, 2e-4]}, scene, K, intervals=False)
    assert found.next_reading().cycles <= 60
    assert np.isfinite(found.life(1e-4)[0].interval_95).all()
    with pytest.raises(wear.UsageError, match="load is 60; name cycles"):
        found.forecast(61)
    with pytest.raises(wear.UsageError, match="load is 60; name cycles"):
        found.next_reading(61)


def test_an_entry_of_a_list_may_be_free():
    """The swing of the second block, from exact readings and another start."""
    blocks = wear.Blocks(tuple(wear.Block(wear.Sine(swing, 0.06), 30) for swing in (2e-4, 5e-4)))
    scene, key = replace(load_scene("section4"), load=blocks), "load.blocks[1].amplitude_mm"
    cycles = [20, 40, 50, 60]
    data = {"cycles": cycles, "wear_mm": wear.solve(scene, cycles, rtol=1e-12).u_c}
    found = wear.fit(data, scene.with_({key: 4e-4}), key, intervals=False)
    assert found.scenes[0].load.blocks[1].load.amplitude_mm == pytest.approx(5e-4, rel=1e-6)


def test_the_jacobian_is_that_of_differences(found):
    slope = found.model(found.theta[None]).slope[0]
    for place, step in enumerate(1e-3 * np.eye(2)):
        off = found.model(found.theta + np.array([step, -step])).residuals
        np.testing.assert_allclose(slope[:, place], (off[0] - off[1]) / 2e-3, rtol=1e-3, atol=1e-5)


def test_an_interval_ends_where_the_deviance_reaches_its_quantile(far_off):
    found = wear.fit([synthetic(6)], far_off.with_({GROWTH: 0.25}), [K])
    ends = np.log(np.array(found.profiles[0].interval))[:, None]
    deviance = (found.model.cost(ends) - found.chi_square) / found.scatter**2
    np.testing.assert_allclose(np.sqrt(deviance), found.quantile, rtol=1e-3)
    assert found.quantile == pytest.approx(stats.t.ppf(0.975, len(CYCLES) - 1))


def test_an_interval_ends_where_the_others_have_followed():
    """And not at the point beyond that was tried first. The two specimens are of the tutorial."""
    readings = read_readings(EXAMPLES / "metal-wear.csv", ["load_g"])
    some = [readings[0], readings[4]]
    scene = load_scene(str(EXAMPLES / "metal.toml")).with_({K: 3.0})
    found = wear.fit(some, scene, [GROWTH], ["bearing.roughness_mm"])
    for end in found.profiles[0].interval:

        def others(x, end=end):
            _, off, slope = found.model(np.array([[end, *x]]))
            return off[0], slope[0][:, 1:]

        near = least_squares(lambda x: others(x)[0], found.theta[1:], jac=lambda x: others(x)[1])
        root = np.sqrt(2 * near.cost - found.chi_square) / found.scatter
        assert root == pytest.approx(found.quantile, rel=1e-3)


def test_an_end_that_only_the_bounds_of_another_parameter_make_is_open():
    """The less wear coefficient, the more growth, which can be a thousandfold at the most."""
    late = synthetic(9, np.array([1e6, 1.26e6, 1.587e6, 2e6]))
    found = wear.fit([late], "section4", [K, GROWTH])
    assert np.isinf(found.profiles[0].interval).all()
    assert np.isinf(found.profiles[1].interval[1])
    for profile in found.profiles:  # what is drawn comes to no end there either
        for root, end in zip(profile.roots[[0, -1]], profile.interval, strict=True):
            assert np.isfinite(end) or root < found.quantile


def test_two_keys_that_enter_only_as_a_quotient_are_said_to():
    found = wear.fit([synthetic(1)], "section4", [K, "bearing.hardness_MPa"])
    ((combination, sentence),) = found.undetermined()
    assert combination == pytest.approx({K: 1.0, "bearing.hardness_MPa": 1.0}, rel=1e-3)
    assert "enter only as" in sentence
    assert all(np.isinf(profile.interval).all() for profile in found.profiles)
    assert np.isinf(found.standard_errors).all()
    (ahead,) = found.forecast([1e5])  # determined all the same
    assert ahead.interval_95[1] / ahead.interval_95[0] < 1.5


def test_a_forecast_covers_the_truth_and_a_life_is_its_inverse(found):
    (ahead,) = found.forecast([100_000])
    truth = float(wear.solve("section4", 100_000).u_c[0])
    assert ahead.interval_95[0] < truth < ahead.interval_95[1]
    (reached,) = found.life(ahead.bearing_wear_mm)
    assert reached.cycles == pytest.approx(1e5, rel=1e-4)
    wide = np.log(reached.interval_95[1] / reached.interval_95[0])
    (before, after) = found.forecast([90_000, 110_000])
    steepness = np.log(after.bearing_wear_mm / before.bearing_wear_mm) / np.log(11 / 9)
    band = np.log(ahead.interval_95[1] / ahead.interval_95[0])
    assert wide == pytest.approx(band / steepness, rel=0.01)


def test_the_start_may_be_off_where_another_solid_wears_too():
    """No valley is taken in which the residuals are forty standard errors; nor is there a warning
    of a division where no scene is left."""
    cycles = np.array([1.0, 8.0, 72.0, 611.0, 5189.0, 44038.0])
    wear_mm = np.array([2.178e-5, 1.648e-4, 9.661e-4, 2.912e-3, 8.847e-3, 3.669e-2])
    start = load_scene("section5").with_({K: 1.62e-7, GROWTH: 0.1332})
    found = wear.fit([Specimen("", cycles, wear_mm, 0.047 * wear_mm, {})], start, [K, GROWTH])
    assert found.chi_square < 10.0
    for profile, truth in zip(found.profiles, (6.92e-7, 0.1554), strict=True):
        assert profile.interval[0] < truth < profile.interval[1]


def test_precise_readings_far_from_the_start_are_fitted():
    """Residuals of thousands of standard errors are residuals all the same."""
    wear_mm = wear.solve("section4", CYCLES.astype(int), rtol=1e-8).u_c
    readings = Specimen("", CYCLES, wear_mm, 1e-4 * wear_mm, {})
    scene = load_scene("section4").with_({K: 5e-6})
    assert wear.fit([readings], scene, K).estimates == pytest.approx([1e-6], rel=1e-6)


def test_numbers_of_cycles_may_be_an_array_and_a_depth_zero(found):
    document = found.as_json(np.array([10, 100]), 0.0)
    assert [row["cycles"] for row in document["forecast"]] == [10, 100]
    assert document["next_reading"] == found.next_reading(100)._asdict()
    assert [row["cycles"] for row in document["cycles_to_wear"]] == [0]
    for call in (lambda: found.next_reading(0), lambda: posterior(found, 5, seed=2**32)):
        with pytest.raises(UsageError, match="is not a whole number"):
            call()


def test_the_next_reading_narrows_the_band_as_if_it_had_been_read(found):
    advice = found.next_reading(1e6)
    slope = found.model(found.theta[None]).slope[0]
    _, ahead = found.model.log_wear(found.theta[None], [np.array([advice.cycles, 1e6])])
    reading, target = ahead[0]
    more = np.vstack([slope, reading])
    bands = [np.sqrt(target @ np.linalg.inv(J.T @ J) @ target) for J in (slope, more)]
    assert advice.band_of_forecast_times == pytest.approx(bands[1] / bands[0], rel=1e-3)
    assert 1 <= advice.cycles <= CYCLES[-1]


def test_specimens_share_some_parameters_and_have_others_of_their_own():
    changes = [{"load.amplitude_mm": 5e-4}, {"load.amplitude_mm": 8e-4}]
    scene = load_scene("section4")
    specimens = []
    for name, own, roughness in zip("ab", changes, (3.6e-4, 5e-4), strict=True):
        truth = scene.with_({**own, ROUGHNESS: roughness, K: 2e-6, "contact.closure_mm": 1.5e-3})
        u = wear.solve(truth, CYCLES.astype(int), rtol=1e-8).u_c
        specimens.append(Specimen(name, CYCLES, u, 0.01 * u, own))
    base = scene.with_({"contact.closure_mm": 1.5e-3})
    found = wear.fit(specimens, base, [K], [ROUGHNESS], intervals=False)
    names = [(p.key, p.specimen) for p in found.parameters]
    assert names == [(K, ""), (ROUGHNESS, "a"), (ROUGHNESS, "b")]
    np.testing.assert_allclose(found.estimates, [2e-6, 3.6e-4, 5e-4], rtol=1e-5)
    assert found.scatter == 1.0
    assert found.chi_square < 1e-6


def test_as_many_parameters_as_readings_leave_every_interval_open():
    found = wear.fit([synthetic(1, np.array([10.0, 1000.0]))], "section4", [K, GROWTH])
    assert found.rms < 1e-4
    assert all(np.isinf(profile.interval).all() for profile in found.profiles)


@pytest.mark.parametrize("relative", [True, False])
def test_every_law_describes_its_own_data(relative):
    shapes = {"archard": CYCLES, "power": CYCLES**0.3, "logarithm": np.log1p(0.2 * CYCLES)}
    for law, shape in shapes.items():
        pair = [Specimen(n, CYCLES, s * shape, None, {}) for n, s in (("a", 1e-3), ("b", 3e-3))]
        found = {each.law: each for each in alternatives(pair, relative)}
        assert found[law].rms < 1e-6
        assert found[law].forecast_rms < 1e-4
        assert found[law].aicc < min(each.aicc for each in found.values() if each.law != law) or (
            law == "archard"  # a power of one does as well
        )


def test_an_information_criterion_is_that_of_the_likelihood():
    readings = Specimen("", CYCLES, CYCLES, None, {})
    off = 0.1 * np.random.default_rng(1).standard_normal(len(CYCLES))
    scale = np.sqrt(np.mean(off**2))
    n, k = len(off), 3
    expected = -2 * np.sum(stats.norm.logpdf(off, scale=scale)) + 2 * k * n / (n - k - 1)
    constant = n * (1 + np.log(2 * np.pi))
    assert Residuals.of([readings], True).aicc(off, 2) == pytest.approx(expected - constant)


def test_the_posterior_of_a_determined_parameter_is_that_of_the_fit():
    found = wear.fit([synthetic(1, CYCLES[:4])], "section4", [K], intervals=False)
    error = found.standard_errors[0] / found.estimates[0]
    samples = np.log(posterior(found, 20, seed=1)[:, 0])
    assert np.mean(samples) == pytest.approx(found.theta[0], abs=0.5 * error)
    assert np.std(samples) == pytest.approx(error, rel=0.5)


def test_an_interrupted_posterior_says_nothing_of_the_sampler(found, monkeypatch, capsys):
    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(type(found.model), "cost", interrupted)
    with pytest.raises(KeyboardInterrupt):
        wear.posterior(found, 10)
    assert capsys.readouterr() == ("", "")


def test_columns_of_a_notebook_are_readings(found, far_off):
    readings = synthetic(1)
    columns = {"cycles": readings.cycles.astype(int), "wear_um": 1e3 * readings.wear_mm}
    frame = pandas.DataFrame(columns)
    fits = [wear.fit(data, far_off, K, intervals=False) for data in (columns, frame, [readings])]
    assert fits[0].estimates == fits[1].estimates
    assert fits[0].estimates == pytest.approx(fits[2].estimates, rel=1e-9)
    again = copy.deepcopy(found)
    assert again.as_json()["parameters"] == found.as_json()["parameters"]
    assert repr(found).startswith(f"<Fit to 9 readings: {K} = 1.0")
    assert len(found.plot().axes) == 2


def test_readings_and_estimates_that_are_hardly_meant_are_said():
    """Micrometres typed as mm make a surface rougher than any."""
    columns = {"cycles": [1000, 2000], "wear_mm": [0.8, 1.2]}
    found = wear.fit(columns, load_scene("section4").with_({K: 1e-2}), K, intervals=False)
    assert "implausible: the roughness of 0.3" in " ".join(found.as_json()["notices"])


def test_wear_that_falls_and_a_forecast_without_a_band_are_told():
    """Contact will have ended: no further reading narrows what is certain."""
    columns = {"cycles": [100, 300, 1000], "wear_mm": [0.001, 0.0006, 0.0004]}
    found = wear.fit(columns, "section4-cutoff", K, intervals=False)
    assert found.next_reading(1e7).band_of_forecast_times == 1.0
    assert "wear does not fall" in " ".join(found.as_json()["notices"])


def test_readings_after_the_end_of_wear_bound_nothing():
    columns = {"cycles": [1000, 2000], "wear_mm": [0.002, 0.001]}
    found = wear.fit(columns, "section4-cutoff", K)
    assert [profile.interval for profile in found.profiles] == [(-np.inf, np.inf)]
    assert found.as_json([1e6])["next_reading"]["band_of_forecast_times"] == 1.0


# Bad requests and the command


@pytest.mark.parametrize(
    ("free", "each", "words"),
    [
        ([], [], ["name at least one of"]),
        ([K, K], ["pin.hardness_MPa"], ["named twice", "pin.hardness_MPa"]),
        (["contact.width_mm"], ["bearing.wear_coefficent"], ["width_mm", "wear_coefficent"]),
        (["load.amplitude_mm"], [], ["given by the data"]),
        ([K, GROWTH], [ROUGHNESS], ["2 readings are fewer than 3 parameters"]),
    ],
)
def test_everything_that_is_wrong_with_a_request_is_said_at_once(free, each, words):
    readings = Specimen("", CYCLES[:2], np.array([1e-3, 0.0]), None, {"load.amplitude_mm": 5e-4})
    with pytest.raises(UsageError) as caught:
        wear.fit([readings], "section4", free, each, error="relative")
    for word in [*words, "a wear of zero has no logarithm"]:
        assert word in str(caught.value)


def test_a_bad_command_line_has_status_2_and_writes_nothing(tmp_path, capsys):
    file = tmp_path / "wear.csv"
    file.write_text("cycles,wear_mm\n3,-1\n")
    out = tmp_path / "out"
    words = ["fit", str(file), "section4", "--free", "bearing.hardnes,motion.sped", "--error",
             "both",
             "--forecast", "0", "-o", str(out)]  # fmt: skip
    assert main(words) == 2
    said = capsys.readouterr().err
    for word in (
        "line 2: wear_mm",
        "one reading",
        "bearing.hardnes: ",
        "motion.sped: ",
        '"both"',
        "fresh state",
    ):
        assert word in said
    assert not out.exists()


def test_the_command_says_and_writes_what_was_found(tmp_path, capsys):
    file, out = tmp_path / "wear.csv", tmp_path / "out"
    readings = synthetic(1, CYCLES[:7])
    rows = zip(readings.cycles.tolist(), readings.wear_mm.tolist(), strict=True)
    file.write_text("cycles,wear_mm\n" + "".join(f"{n:.0f},{u!r}\n" for n, u in rows))
    words = ["fit", str(file), "section4", "--free", K, "--forecast", "1e5", "--until-wear", "0.01"]
    assert main([*words, "-o", str(out), "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document == json.loads((out / "fit.json").read_text())
    (parameter,) = document["parameters"]
    low, high = parameter["interval_95"]
    assert low < 1e-6 < high
    assert load_scene(out / "fitted.toml").bearing.wear_coefficient == parameter["estimate"]
    assert [law["law"] for law in document["alternatives"]] == ["archard", "power", "logarithm"]
    assert document["observations"] == 7
    for name in ("data.svg", "profiles.svg"):
        assert "<svg" in (out / name).read_text()
