"""Contact laws of a scene's own: read, never executed, derived, and kept for this user."""

import json
import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import sympy as sp
from scipy.integrate import solve_ivp

import wear
from derive.faults import UsageError as NotUnderstood
from derive.law_grammar import normal
from derive.laws import r
from tests.derive.reading_back import CLASSES, read_back
from tests.programs import python
from wear import own_laws
from wear.binding import bind
from wear.equation import roundoff
from wear.regime import TAIL

ALGEBRAIC = "(1 - (r - 2)/sqrt(2 + (r - 2)^2))/2"  # no other test uses it: derived here
ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module", autouse=True)
def home(tmp_path_factory):
    """A cache of this module's own."""
    folder = tmp_path_factory.mktemp("cache")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(folder))
        yield folder


def with_law(text: str, name: str = "section4") -> wear.Scene:
    return wear.load_scene(name).with_({"contact.law": {"phi": text}})


@pytest.mark.parametrize("name", ["f-zero", "roughness-vanishing"])
def test_a_regime_that_rests_on_an_exponential_law_says_so(name):
    """Under a pressure that falls like a power, wear at constant roughness grows like one."""
    slow = wear.asymptote(with_law("(1 - (r - 2)/sqrt(1 + (r - 2)^2))/2", name))
    assert TAIL in slow.notices
    assert TAIL not in wear.asymptote(name).notices


@pytest.mark.parametrize("name", ["section4", "section3", "soft-support"])
def test_the_note_s_law_by_its_formula_gives_the_note_s_wear(name):
    """The cancelling form, too: of equal forms the one that keeps its digits is written."""
    scene = with_law("(1 - tanh(2*r - 4))/2", name)
    cycles = [1, 9000, 10**8]
    np.testing.assert_allclose(
        wear.solve(scene, cycles).u_c, wear.solve(name, cycles).u_c, rtol=1e-12
    )
    ours, package = wear.asymptote(scene), wear.asymptote(name)
    assert ours.wear_per_cycle_mm == pytest.approx(package.wear_per_cycle_mm, rel=1e-13)
    assert ours.log_coefficient_mm == pytest.approx(package.log_coefficient_mm, rel=1e-13)


@pytest.mark.parametrize("name", ["section4", "soft-support"])
def test_a_law_with_an_algebraic_tail_is_integrated(name):
    scene = with_law(ALGEBRAIC, name)
    load, n = scene.periodic_load, 3
    of = scene.bearing
    slip = 2 * np.pi * scene.motion.speed_rpm / 60 * scene.motion.radius_mm
    per_pressure = of.wear_coefficient * slip / (3 * of.hardness_MPa)

    def pressure(gap: float, sigma: float) -> float:
        """The root of p = p_max phi by bisection; on a rigid support phi itself."""

        def law(p: float) -> float:
            give = 0.0 if scene.support is None else p / scene.support.stiffness_MPa_per_mm
            x = (gap + give) / sigma - 2
            return scene.contact.max_pressure_MPa * (1 - x / np.sqrt(2 + x * x)) / 2

        low, high = 0.0, scene.contact.max_pressure_MPa
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if law(middle) > middle else (low, middle)
        return (low + high) / 2

    def grows(phase: float, u: np.ndarray) -> list[float]:
        sigma = of.roughness_mm + of.roughness_growth * u[0]
        gap = scene.closure + u[0] - float(load(phase))
        return [load.period * per_pressure * pressure(gap, sigma)]

    found = solve_ivp(grows, (0, n), [0.0], "DOP853", rtol=1e-9, atol=1e-14, max_step=0.1)
    assert wear.solve(scene, [n]).u_c[0] == pytest.approx(found.y[0, -1], rel=1e-8)


@pytest.mark.parametrize(
    "text",
    [
        "(1 - (r - 3.1)/sqrt(3.8 + (r - 3.1)^2))/2",  # no root was rationalised within minutes
        "((1 - tanh(2*(r - 0.45)))/2)^(5/2)",  # the curvature is no rational function
        "(1 - tanh(3.2*(r - 1.8)))/2",  # 1 - tanh^2 is 0 in doubles
        "exp(-(sqrt(1.9 + r^2) + r)^2/4)",  # the inflection has a root of 16 digits
    ],
)
def test_sensible_laws_of_any_numbers_are_derived(text):
    scene, U_a = with_law(text, "soft-support"), np.linspace(-5e-4, 5e-4, 5)
    found = bind(scene).pressure(0.0, U_a)
    gap = scene.closure - U_a + found / scene.support.stiffness_MPa_per_mm
    law = read_back(text.replace("^", "**"), CLASSES | {"r": r, "sqrt": sp.sqrt})
    ratios = gap / scene.initial_roughness
    share = [float(law.evalf(30, subs={r: ratio})) for ratio in ratios.tolist()]
    assert found == pytest.approx(300.0 * np.array(share), rel=1e-12)


def test_the_asymptote_is_that_of_the_law():
    scene = with_law(ALGEBRAIC)
    found, x = wear.asymptote(scene), 1 / 0.25 - 2
    assert found.pressure_MPa == pytest.approx(150 * (1 - x / np.sqrt(2 + x * x)), rel=1e-13)
    late = wear.solve(scene, [10**9, 10**10]).u_c
    assert found.offset_mm is not None
    expected = [
        found.wear_per_cycle_mm * n + found.log_coefficient_mm * np.log(n) + found.offset_mm
        for n in (1e9, 1e10)
    ]
    np.testing.assert_allclose(late, expected, rtol=1e-9)


def test_a_law_is_derived_once_and_the_package_stays_as_it_is(home):
    wear.solve(with_law(ALGEBRAIC), [1])
    text = with_law(ALGEBRAIC.replace(" ", "")).contact.law
    assert text == with_law(ALGEBRAIC).contact.law
    (home / "scene.toml").write_text(with_law(ALGEBRAIC).to_toml())
    code = "import sys, wear; wear.solve('scene.toml', [1]); sys.exit('sympy' in sys.modules)"
    python(code, cwd=home, env={**os.environ, "PYTHONPATH": str(ROOT)})
    kept = ROOT / "wear" / "generated"
    assert {path.name for path in kept.iterdir() if path.is_dir()} >= {"tanh", "exponential"}
    assert not list(kept.rglob("*own*"))


def test_a_scene_with_a_law_of_its_own_reads_back():
    scene = with_law("1/(1 + exp(r - 1))^2")
    assert scene.contact.law == "phi = 1 / (1 + exp(r - 1)) ** 2"
    assert wear.Scene.from_dict(json.loads(scene.to_json())) == scene
    assert wear.scene.parse_scene(scene.to_toml()) == scene


def test_the_formula_may_stand_in_a_file_beside_the_scene(tmp_path):
    (tmp_path / "soft.law").write_text("# measured in 2026\nphi = 1/(1 +\n  exp(r - 1))^2  # fit\n")
    text = (
        wear.load_scene("section4").to_toml().replace('law = "tanh"', 'law = {file = "soft.law"}')
    )
    (tmp_path / "scene.toml").write_text(text)
    assert wear.load_scene(tmp_path / "scene.toml") == with_law("1/(1 + exp(r - 1))^2")


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("__import__('os').system('x')", "is not understood"),
        ("r.real", "is not understood"),
        ("[r for r in r]", "is not understood"),
        ("lambda: 1", "is not understood"),
        ("sin(r)", "is not understood"),
        ("exp(r, r)", "is not understood"),
        ("exp(r=r)", "is not understood"),
        ("True", "is not understood"),
        ("1j*r", "is not understood"),
        ("x", "is not understood"),
        ("1/(r", "is no formula"),
        ("", "is no formula"),
        ("r**r", "is no power"),
        ("r**(1/3)", "is no power"),
        ("r**999999999", "is beyond 20"),
        ("9**9**9**9", "is no power"),
        ("r**True", "is no power"),
        ("r**(True/2)", "is no power"),
        ("r**1e999", "is no power"),
        ("r**" + "9" * 400, "is beyond 20"),
        ("r\0", "is no formula"),
        ("r\ud800", "is no formula"),
        ("1e999*r", "is too large"),
        ("(" * 400 + "r" + ")" * 400, "characters"),
        ("-" * 499 + "r", "is no formula"),
    ],
)
def test_nothing_but_the_grammar_is_read(text, problem):
    with pytest.raises(wear.SceneError, match=problem):
        with_law(text)


@pytest.mark.parametrize("raw", [3.0, {"phi": 3.0}, {}, {"phi": "exp(-r)", "x": 1}, ["exp(-r)"]])
def test_what_is_no_law_is_a_fault(raw):
    with pytest.raises(wear.SceneError, match="law"):
        wear.load_scene("section4").with_({"contact.law": raw})


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("exp(r)", "not proved to be negative"),
        ("2", "no function of r"),
        ("sqrt(-1)*r", "no function of r"),
        ("-exp(-r)", "must be positive"),
        ("1/(1 + r^2)", "must decrease"),
        ("1/(1 + exp(r)) + 5/(1 + exp(4*r - 40))", "concave below one value"),
        ("1/(1 + exp(r)/3) + 1/(1 + 148*exp(20*r))/100", "3 times"),  # two within a quarter
        ("1/r", "kink"),
        ("(1 - tanh(1000000*r))/2", "too steep"),  # it turns between two points of the grid
        ("exp(-exp(exp(r)))", "too large to be computed"),
        ("exp(-exp(r^20))", "must decrease"),
        ("exp(-r - sqrt(r^2)/2)", "kink"),
        ("exp(-r - sqrt(r^4 + r^2)/(2 + 2*r^2))", "kink"),
        ("(3 - (r-2)/sqrt((r-2)^2))*exp(-r)", "kink"),
    ],
)
def test_what_the_theorems_ask_for_must_be_proved(text, problem):
    with pytest.raises(wear.UsageError, match=problem):
        wear.solve(with_law(text), [1])


@pytest.mark.parametrize("seed", ["0", "6"])
def test_what_is_proved_does_not_depend_on_the_order_of_a_set(seed):
    """Of the exponentials of 2 r - 8 and of 4 r - 16 the slower one is the unit."""
    law = "own_law('1/(1 + exp(2*r - 8))')[0]"
    code = f"from derive.own_law import own_law, turns_once; print(turns_once({law}))"
    assert python(code, env={**os.environ, "PYTHONHASHSEED": seed}) == "True\n"


def test_a_cache_that_cannot_be_made_is_told_with_the_remedy(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    with pytest.raises(wear.UsageError, match="XDG_CACHE_HOME"):
        wear.solve(with_law("exp(-2*r)/3"), [1])


def test_lost_digits_and_what_is_not_proved_are_said():
    scene = with_law("(1 - r/sqrt(1 + r^2))/2 + exp(-r)")
    assert any("is not proved" in notice for notice in scene.notices)
    assert not any("is not proved" in notice for notice in with_law(ALGEBRAIC).notices)
    assert any("loses digits" in notice for notice in scene.notices)
    assert not any("loses digits" in notice for notice in with_law(ALGEBRAIC).notices)


def test_lost_digits_are_part_of_the_error():
    law, none = "(sqrt(1.3 + r^2) - r)^(3/2)", np.zeros(1)
    scene, u = with_law(law).with_({"bearing.roughness_growth": 0.0}), np.array([0.2])
    r, model = (scene.closure + u) / scene.initial_roughness, bind(scene)
    pressure = scene.contact.max_pressure_MPa * (1.3 / (np.sqrt(1.3 + r**2) + r)) ** 1.5
    assert np.abs(model.fields(u, none).p / pressure - 1) <= roundoff(model, none, u)
    assert roundoff(model, none, none) < 1e-12


def test_code_is_not_run_from_a_cache_that_others_may_write(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    folder = tmp_path / "derive-wear" / "contact-laws"
    folder.mkdir(parents=True)
    folder.chmod(0o777)
    with pytest.raises(wear.UsageError, match="others may write there"):
        own_laws.about("phi = exp(-3 * r)")


def test_the_spelling_does_not_matter():
    assert normal("exp( -r )^2") == normal("exp(-r)**2")
    with pytest.raises(NotUnderstood, match="is not understood"):
        normal("r if r else r")


def test_what_a_law_loses_by_rounding_is_not_resolved_with_loss_of_contact():
    """Steps became ever shorter in its noise: a count to 1e-12 took minutes."""
    numbers = {
        "bearing": {"hardness_MPa": 51.5, "wear_coefficient": 6e-9, "roughness_mm": 0.0073,
                    "roughness_growth": 0.23},
        "pin": {"hardness_MPa": 600.0, "wear_coefficient": 1.2e-6, "roughness_mm": 3.9e-4,
                "roughness_growth": -0.01},
    }  # fmt: skip
    changes = {f"{part}.{key}": x for part, rows in numbers.items() for key, x in rows.items()}
    changes |= {"contact.max_pressure_MPa": 12.9, "contact.closure_mm": 0.01765}
    scene = with_law(ALGEBRAIC, "section3-cutoff").with_(changes)
    load = wear.Harmonics(-4.4e-3, (3.7e-3, -0.0103, 3e-4), (-2.9e-3, -1.6e-3, 5e-3), 0.378)
    found = wear.solve(replace(scene, load=load), [10, 10**6, 10**11], rtol=1e-12)
    assert found.cost["rhs_evaluations"] < 3e6
