"""Scenes: what is read, what a solver is given, and the way back to a file."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest
import sympy as sp

from derive.laws import LAWS
from derive.note.governing import NoteModel, sigma_a, sigma_c
from tests.wear.test_scene_faults import GOOD
from wear.binding import bind
from wear.faults import SceneError, UsageError
from wear.load import Block, Blocks, Constant, Harmonics, HistoryLoad, Sine, Table
from wear.scene import Scene, builtin_names, hard_names, load_scene, parse_scene
from wear.scene.notices import CONTACT_REACH
from wear.scene.tables import Bearing, Contact, Motion, Pin, Support, contact_laws

MINIMAL = GOOD.partition("\n")[2].partition("kind")[0]  # neither title nor load
SINE = 'kind = "sine"\namplitude_mm = 5e-4\nperiod_s = 0.06\n'
PIN = Pin(600.0, 1e-6, 6.5e-5, 0.05)


def section4() -> Scene:
    return load_scene("section4")


def test_the_scene_of_section_4():
    scene = section4()
    assert scene.bearing == Bearing(200.0, 1e-6, 3.6e-4, 0.25)
    assert scene.contact == Contact(300.0, closure_mm=1.08e-3)
    assert scene.motion == Motion(22.0, 2000.0)
    assert scene.load == Sine(5e-4, 0.06)
    assert (scene.pin, scene.support, scene.name) == (None, None, "section4")
    assert scene == parse_scene(MINIMAL + SINE, overrides=_texts(scene))


def _texts(scene: Scene) -> list[str]:
    return [f"title={scene.title}", f"description={json.dumps(scene.description)}"]


# What the solvers ask for


def test_parameters_of_a_full_scene():
    scene = replace(
        load_scene("section3"),
        support=Support(1e5),
        contact=Contact(300.0, closure_in_sigma=3.0, width_mm=20.0, length_mm=69.0),
    )
    assert scene.parameters() == {
        "K_c": 1e-6, "H_c": 200.0, "f_c": -0.05, "sigma_c0": 3.6e-4,
        "K_a": 1e-6, "H_a": 600.0, "f_a": 0.05, "sigma_a0": 6.5e-5,
        "p_max": 300.0, "h_0": scene.closure, "k": 1e5, "R": 22.0, "n": 2000.0, "T": 0.06,
        "b": 20.0, "L": 69.0,
    }  # fmt: skip


@pytest.mark.parametrize(
    ("pin", "state", "symbols"),
    [
        (None, "bearing", set()),
        (replace(PIN, wear_coefficient=0.0), "rough", {"sigma_a0"}),
        (replace(PIN, wear_coefficient=0.0, roughness_mm=0.0), "bearing", set()),
        (replace(PIN, roughness_mm=0.0, roughness_growth=0.0), "worn", {"K_a", "H_a"}),
        (replace(PIN, roughness_mm=0.0), "worn_rough", {"K_a", "H_a", "sigma_a0", "f_a"}),
        (PIN, "worn_rough", {"K_a", "H_a", "sigma_a0", "f_a"}),
    ],
)
@pytest.mark.parametrize("opening", [False, True])
def test_a_pin_has_only_what_it_needs(pin, state, symbols, opening):
    scene = section4()
    contact = replace(scene.contact, pin_wear_opens_gap=opening)
    with_pin = replace(scene, pin=pin, contact=contact)
    assert with_pin.variant.pin == state
    assert with_pin.pin_wear_sign == (1.0 if opening else -1.0)
    assert set(with_pin.parameters()) - set(scene.parameters()) == symbols


def test_only_a_load_that_repeats_has_a_period(tmp_path):
    (tmp_path / "run.csv").write_text("t_s,U_a_mm\n0,0\n1,1e-4\n")
    scene = parse_scene(MINIMAL + 'kind = "history"\nfile = "run.csv"\n', folder=tmp_path)
    assert "T" not in scene.parameters()
    with pytest.raises(UsageError, match="does not repeat"):
        _ = scene.periodic_load
    assert section4().periodic_load is not None


# The few relations of the model that a scene needs are derive's


def test_equivalent_roughness_is_equation_3():
    scene = load_scene("section3")
    exact = NoteModel().roughness.claim.rhs.subs(
        {sigma_a: sp.Rational("6.5e-5"), sigma_c: sp.Rational("3.6e-4")}
    )
    assert scene.initial_roughness == pytest.approx(float(exact), rel=4e-16)
    assert scene.closure == pytest.approx(0.00109746298, rel=1e-8)


@pytest.mark.parametrize("support", [None, Support(1e5)])
@pytest.mark.parametrize("pin_kind", ["bearing", "rough", "worn", "worn_rough"])
@pytest.mark.parametrize("opening", [False, True])
@pytest.mark.parametrize("cutoff", [False, True])
def test_every_variant_is_generated_and_gets_its_parameters(support, pin_kind, opening, cutoff):
    pins = {
        "bearing": None,
        "rough": replace(PIN, wear_coefficient=0.0),
        "worn": replace(PIN, roughness_mm=0.0, roughness_growth=0.0),
        "worn_rough": PIN,
    }
    contact = Contact(300.0, None, 2.5, ends_at_3_sigma=cutoff, pin_wear_opens_gap=opening)
    scene = replace(section4(), pin=pins[pin_kind], support=support, contact=contact)
    model = bind(scene)
    start = model.fields_under(0.0, 0.0, 0.0) if support else model.fields(0.0, 0.0)
    assert float(start.sigma) == pytest.approx(scene.initial_roughness, rel=4e-16)
    assert float(start.h) == pytest.approx(scene.closure, rel=4e-16)
    if cutoff:
        margin = CONTACT_REACH * scene.initial_roughness - scene.closure
        assert float(model.margin(0.0, 0.0)) == pytest.approx(margin, rel=1e-14)


def test_reach_of_contact_is_that_of_the_laws():
    assert {law.cutoff for law in LAWS.values()} == {CONTACT_REACH}


def test_laws_are_those_of_derive():
    assert set(contact_laws()) == set(LAWS)


# Loads


def test_all_kinds_of_load(tmp_path):
    (tmp_path / "pin.csv").write_text("t_s,U_a_mm\n0,1e-4\n0.5,5e-4\n2.0,1e-4\n")

    def load(text: str) -> object:
        return parse_scene(MINIMAL + text, folder=tmp_path).load

    assert load('kind = "constant"\nvalue_mm = -2e-4\nperiod_s = 1') == Constant(-2e-4, 1.0)
    text = 'kind = "harmonics"\nmean_mm = 1e-4\ncosine_mm = [1e-4]\nsine_mm = [0, 2]\nperiod_s = 1'
    assert load(text) == Harmonics(1e-4, (1e-4,), (0.0, 2.0), 1.0)
    table = load('kind = "table"\nfile = "pin.csv"')
    assert isinstance(table, Table)
    assert (table.times_s, table.values_mm) == ((0.0, 0.5, 2.0), (1e-4, 5e-4, 1e-4))
    closed = load('kind = "table"\nfile = "pin.csv"\nperiod_s = 3.0')
    assert isinstance(closed, Table)
    assert (closed.period, float(closed(2.9 / 3.0))) == (3.0, pytest.approx(1e-4))
    history = load('kind = "history"\nfile = "pin.csv"')
    assert isinstance(history, HistoryLoad)
    assert (history.duration, history.cycles) == (2.0, 1.0)
    blocks = load(
        'kind = "blocks"\nrepeat = 5\n'
        '[[load.blocks]]\nkind = "sine"\namplitude_mm = 1e-4\nperiod_s = 1\ncycles = 1e6\n'
        '[[load.blocks]]\nkind = "table"\nfile = "pin.csv"\ncycles = 3\n'
    )
    assert blocks == Blocks((Block(Sine(1e-4, 1.0), 1_000_000), Block(table, 3)), 5)


def test_a_seam_open_by_roundoff_is_closed(tmp_path):
    rows = [(t, math.sin(2.0 * math.pi * t)) for t in np.linspace(0.0, 1.0, 101).tolist()]
    lines = "\n".join(f"{t!r},{u!r}" for t, u in rows)
    (tmp_path / "sine.csv").write_text("t_s,U_a_mm\n" + lines)
    load = parse_scene(MINIMAL + 'kind = "table"\nfile = "sine.csv"', folder=tmp_path).load
    assert isinstance(load, Table)
    assert load.values_mm[0] == load.values_mm[-1]


@pytest.mark.parametrize("last", ["0.06", "0.060000000000000005", "0.05999999999999999"])
def test_a_period_off_by_roundoff_is_the_period(last, tmp_path):
    (tmp_path / "pin.csv").write_text(f"t_s,U_a_mm\n0,0\n0.03,1e-4\n{last},0\n")
    text = MINIMAL + 'kind = "table"\nfile = "pin.csv"\nperiod_s = 0.06'
    load = parse_scene(text, folder=tmp_path).load
    assert isinstance(load, Table)
    assert load.times_s == (0.0, 0.03, 0.06)


def test_a_checksum_pins_the_file(tmp_path):
    file = tmp_path / "pin.csv"
    file.write_text("t_s,U_a_mm\n0,1e-4\n1,1e-4\n")
    scene = parse_scene(MINIMAL + 'kind = "table"\nfile = "pin.csv"', folder=tmp_path)
    assert parse_scene(scene.to_toml(), folder=tmp_path) == scene
    file.write_text("t_s,U_a_mm\n0,2e-4\n1,2e-4\n")
    with pytest.raises(SceneError, match=r"pin\.csv has changed"):
        parse_scene(scene.to_toml(), folder=tmp_path)


def test_a_table_of_many_rows_is_a_scene_file():
    """Lines of a scene file have a greatest length; lists go over several."""
    times = np.linspace(0.0, 0.06, 1001)
    rows = 5e-4 * np.sin(2.0 * np.pi * times / 0.06).round(12)
    load = Table(tuple(times.tolist()), (*rows[:-1].tolist(), rows[0].item()))
    scene = replace(load_scene("section4"), load=load)
    assert parse_scene(scene.to_toml()) == scene


# The way back


@pytest.mark.parametrize("name", builtin_names())
def test_to_toml_and_to_tables_read_back(name):
    scene = load_scene(name)
    assert parse_scene(scene.to_toml()) == scene
    assert Scene.from_dict(scene.to_tables()) == scene
    assert Scene.from_dict(json.loads(scene.to_json())) == scene
    assert parse_scene(scene.to_toml()).to_json() == scene.to_json()


def test_every_part_of_a_scene_reads_back():
    text = (
        'title = "a \\"quoted\\" title, \\\\ and é 𝜎"\ndescription = """two\nlines"""\n'
        + MINIMAL.replace(
            "closure_mm", "width_mm = 3\nlength_mm = 4\nends_at_3_sigma = true\nclosure_mm"
        )
        + 'kind = "blocks"\n[[load.blocks]]\nkind = "harmonics"\nsine_mm = [1e-4, 1e-30]\n'
        "period_s = 0.1\ncycles = 7\n[support]\nstiffness_MPa_per_mm = 1e16\n"
    )
    scene = parse_scene(text)
    assert parse_scene(scene.to_toml()) == scene
    assert scene.support == Support(1e16)


# Built-in scenes


def test_the_scenes_of_the_contract_are_there():
    names = builtin_names()
    assert {"section3", "section4", "section5"} <= set(names)
    assert names.index("section5") < names.index("fast-wear")
    assert load_scene("section5").bearing.wear_coefficient == 1e-6
    for name in ("section3", "section5"):
        assert load_scene(name).contact.closure_in_sigma == 3.0


def test_every_builtin_scene_says_what_it_is():
    scenes = [load_scene(name) for name in builtin_names()]
    assert all(scene.title and scene.description.strip().endswith(".") for scene in scenes)
    assert len({scene.title for scene in scenes}) == len(scenes)
    assert len(hard_names()) >= 15


# Notices


def test_notices_tell_what_may_not_be_meant():
    def told(*overrides: str, name: str = "section4") -> str:
        return " / ".join(load_scene(name, overrides).notices)

    assert told() == ""
    assert "Eq. (1) as printed" in told(name="section3")
    assert told(name="section3-physical") == ""
    assert "no effect" in told("contact.pin_wear_opens_gap=true")
    assert "unloaded" in told("support.stiffness_MPa_per_mm=1e5")
    assert "not modelled" in told("pin={hardness_MPa = 1, wear_coefficient = 0, roughness_mm = 0,"
                                  " roughness_growth = 0}")  # fmt: skip
    assert "U_a(0)" in told("load.kind=constant", "load.value_mm=5e-4")
    assert "closure turns negative" in told("load.amplitude_mm=2e-3")
    assert "starts out of contact" in told(
        "contact.ends_at_3_sigma=true", "contact.closure_mm=1.081e-3"
    )
    assert "never comes into contact" in told(
        "contact.ends_at_3_sigma=true", "contact.closure_mm=1.6e-3"
    )
    assert "starts out" not in told("contact.ends_at_3_sigma=true", "contact.closure_in_sigma=3")
    # the printed 0.0011 is a rounding of 3 sigma(0): taken literally it starts out of contact
    printed = ("contact.closure_mm=0.0011", "contact.ends_at_3_sigma=true")
    assert "starts out of contact" in told(*printed, name="section3")
    blocks = parse_scene(
        MINIMAL + 'kind = "blocks"\nrepeat = 2\n'
        '[[load.blocks]]\nkind = "constant"\nvalue_mm = 0\nperiod_s = 1\ncycles = 1\n'
        '[[load.blocks]]\nkind = "constant"\nvalue_mm = 1e-4\nperiod_s = 1\ncycles = 1\n'
    )
    assert "jumps at the start of block 1, 2" in " / ".join(blocks.notices)


# Overrides


def test_text_needs_no_quotes_in_an_override():
    assert load_scene("section4", ["title=Another title"]).title == "Another title"


def test_a_file_that_an_option_names_is_in_the_current_folder(tmp_path, monkeypatch):
    rows = "t_s,U_a_mm\n0,0\n1,{}\n2,0\n"
    beside, here = tmp_path / "scenes", tmp_path / "here"
    for folder, peak in ((beside, 1e-4), (here, 2e-4)):
        folder.mkdir()
        (folder / "pin.csv").write_text(rows.format(peak))
    scene = beside / "own.toml"
    scene.write_text(MINIMAL + 'kind = "table"\nfile = "pin.csv"\n')
    monkeypatch.chdir(here)
    assert load_scene(scene).load.maximum == 1e-4
    assert load_scene(scene, ["bearing.hardness_MPa=100"]).load.maximum == 1e-4
    assert load_scene(scene, ["load.file=pin.csv"]).load.maximum == 2e-4
    built_in = load_scene("section4", ["load.kind=table", "load.file=pin.csv"])
    assert built_in.load.maximum == 2e-4
    block = '{kind="table", file="pin.csv", cycles=3}'
    many = load_scene(scene, ["load.kind=blocks", f"load.blocks=[{block}]"])
    assert many.load.maximum == 2e-4
