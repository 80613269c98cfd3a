"""The explorer: a page that works alone, agrees with Python and answers to its controls."""

import json
import re
from itertools import product
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest

import wear
from derive.laws import LAWS
from derive.variant import VARIANTS
from derive.variant_equations import equations_of
from wear.cli import main
from wear.report import explorer, explorer_derived
from wear.report.equations import capital
from wear.scene import builtin_names, load_scene, parse_scene

READY = "document.documentElement?.dataset.ready >= 1"
UPDATES = "Number(document.documentElement.dataset.ready)"


@pytest.fixture(scope="module")
def page_file(tmp_path_factory) -> Path:
    """The page as the command writes it, but for what it checks on loading."""
    path = tmp_path_factory.mktemp("explorer") / "explorer.html"
    with patch("wear.report.explorer.CHECKED", ()):
        assert main(["explore", "-o", str(path)]) == 0
    return path


@pytest.fixture
def page(window, page_file):
    """The page as it comes up, and no complaint of the browser while it is used."""
    window.open(page_file, READY)
    yield window
    assert window.complaints == []
    fetched = [url for url in window.requests if not url.startswith("data:font/woff2;")]
    assert set(fetched) == {page_file.as_uri()}


def put(page, name, value, event="input"):
    """Set a control and wait for the page to have followed."""
    before = page.run(UPDATES)
    enter(page, name, value, event)
    page.wait(f"{UPDATES} > {before}")


def enter(page, name, value, event):
    page.run(
        f"(() => {{ const e = document.getElementById({name!r}); e.value = {value!r};"
        f" e.dispatchEvent(new Event({event!r}, {{ bubbles: true }})); }})()"
    )


def refuse(page, name, value):
    """Type a number that the page does not take."""
    enter(page, name, value, "change")
    return page.run(f"document.getElementById({name!r}).validationMessage")


def click(page, name):
    before = page.run(UPDATES)
    page.run(f"document.getElementById({name!r}).click()")
    page.wait(f"{UPDATES} > {before}")


def text(page, name):
    return page.run(f"document.getElementById({name!r}).textContent")


def curves(page):
    return page.run(
        "Object.fromEntries(['wear','roughness','pressure','inside'].map((n) => [n,"
        " [...document.querySelectorAll(`#plot-${n} path`)].map((p) => p.getAttribute('d'))]))"
    )


def number(shown: str) -> float:
    """A number as the page shows it."""
    powers = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
    if shown.endswith("µm"):
        return 1e-3 * number(shown.removesuffix(" µm"))
    plain = shown.split(" MPa")[0].replace("\u2212", "-")
    if " × 10" in plain:
        digits, power = plain.split(" × 10")
        return float(digits) * 10.0 ** int(power.translate(powers))
    return float(plain)


def says(page, found):
    """Compare what the page says of the long run with the asymptote of the same scene."""
    assert text(page, "value-regime").startswith(found.regime)
    for shown, value in {
        "limit-cycle": found.wear_per_cycle_mm,
        "limit-pressure": found.pressure_MPa,
        "arrest-wear": found.arrest_wear_mm,
    }.items():
        said = text(page, f"value-{shown}")
        if said == "does not apply":
            assert not value or found.regime not in ("steady", "arrest"), (shown, value)
        else:
            assert number(said) == pytest.approx(value, rel=1e-4)


# The file


def test_page_stands_alone(page_file):
    """Nothing is fetched, and nothing but what was written may run."""
    written = page_file.read_text(encoding="utf-8")
    policy = re.search(r'Content-Security-Policy" content="([^"]+)"', written)
    assert policy is not None
    assert policy[1].startswith("default-src 'none'; script-src 'sha256-")
    assert "unsafe-inline" not in policy[1].replace("style-src-attr 'unsafe-inline'", "")
    assert "unsafe-eval" not in policy[1]
    for address in re.findall(r"https?://[^\"'\s<)]+", written):
        assert address.startswith("http://www.w3.org/"), address
    assert not re.search(r"<(?:link|img|iframe)\b|\bsrc=|@import|\bon\w+=", written)
    assert "eval(" not in written
    assert "Math.pow" not in written


def test_data_cannot_end_its_script(page_file):
    inside = re.search(
        r'<script type="application/json" id="data">(.*?)</script>',
        page_file.read_text(encoding="utf-8"),
        re.DOTALL,
    )
    assert inside is not None
    assert "<" not in inside[1]
    data = json.loads(inside[1])
    assert [scene["name"] for scene in data["scenes"]] == list(builtin_names())


def test_a_title_cannot_become_markup(tmp_path):
    scene = load_scene("section4")
    file = tmp_path / "own.toml"
    file.write_text(scene.to_toml().replace(scene.title, "</script><script>alert(1)</script>"))
    written = explorer.page(load_scene(str(file)))
    assert "<script>alert" not in written


def test_changed_scene_does_not_hide_the_built_in_one():
    written = explorer.page(load_scene("section4", ["bearing.roughness_growth=0.3"]))
    (encoded,) = re.findall(r'id="data">(.*?)</script>', written, flags=re.DOTALL)
    data = json.loads(encoded)
    names = [scene["name"] for scene in data["scenes"]]
    assert data["first"] == names[0] == "section4 (changed)"
    assert "section4" in names
    assert data["scenes"][0]["title"].endswith("(changed)")
    assert data["scenes"][0]["parameters"]["f_c"] == 0.3


def own_scene(folder: Path, load: str):
    """Section 4 under another load, beside files of rows."""
    (folder / "pin.csv").write_text("t_s,U_a_mm\n0,0\n0.02,4e-4\n0.03,1e-4\n0.06,0\n")
    rows = "Weg (µm);Zeit (ms)\n0;0\n0,4;20\n0,1;30\n0,05;60\n"
    (folder / "log.csv").write_bytes(rows.encode("latin-1"))
    file = folder / "own.toml"
    tables = load_scene("section4").to_toml().split("[load]")[0]
    if "force" in load:
        tables = tables.replace("[contact]", "[contact]\nwidth_mm = 20.0\nlength_mm = 30.0")
    file.write_text(f"{tables}[load]\n{load}")
    return load_scene(str(file))


LOADS = {
    "sine": 'kind = "sine"\namplitude_mm = 5e-4\nperiod_s = 0.06\n',
    "constant": 'kind = "constant"\nvalue_mm = 3e-4\nperiod_s = 0.06\n',
    "harmonics": 'kind = "harmonics"\nmean_mm = 1e-4\ncosine_mm = [1e-4]\n'
    "sine_mm = [2e-4, 5e-5]\nperiod_s = 0.06\n",
    "table": 'kind = "table"\nfile = "pin.csv"\n',
    "instrument": 'kind = "table"\nfile = "log.csv"\ncolumns = ["Zeit (ms)", "Weg (µm)"]\n'
    'time_unit = "ms"\nunit = "um"\ndelimiter = ";"\ndecimal = ","\nencoding = "latin-1"\n'
    "repeat = true\nperiod_s = 0.06\n",
    "rows": 'kind = "table"\ntimes_s = [0.0, 0.02, 0.06]\nvalues_mm = [0.0, 4e-4, 0.0]\n',
    "force": 'kind = "force"\ntimes_s = [0.0, 0.02, 0.06]\nforces_N = [600.0, 6000.0, 600.0]\n',
    "constant force": 'kind = "force"\nforce_N = 600.0\nperiod_s = 0.06\n',
}
#: What the page's own functions make of a load, at some phases.
SOLVED = """((phases) => {
  const { load, history } = solveState({ ...chosen, cycles: 1e6 });
  return { value: phases.map(load.value), slope: phases.map(load.slope),
    extremes: [load.minimum, load.maximum, load.mean], wear: [1, 100, 1e6].map(history.at) };
})"""


def test_a_load_that_does_not_repeat_is_refused(tmp_path, call):
    own_scene(tmp_path, 'kind = "history"\nfile = "pin.csv"\nperiod_s = 0.01\n')
    page = tmp_path / "page.html"
    status, _, messages = call("explore", str(tmp_path / "own.toml"), "-o", str(page))
    assert (status, "does not repeat" in messages, page.exists()) == (2, True, False)


def test_command_reports_in_json(page_file, call, monkeypatch):
    monkeypatch.setattr(explorer, "page", lambda scene, _: f"page of {scene.name}")
    target = page_file.with_name("other.html")
    shown = call("explore", "section3", "-o", str(target), "--json")[1]
    assert json.loads(shown) == {"page": str(target), "bytes": 16}
    assert target.read_text() == "page of section3"


# The page in a browser


def test_page_agrees_with_python_when_it_loads(window, tmp_path):
    assert main(["explore", "-o", str(tmp_path / "page.html")]) == 0
    window.open(tmp_path / "page.html", READY)
    assert "good" in window.run("document.getElementById('check').className")
    assert 0 < float(window.run("document.getElementById('check').dataset.wear")) <= 1e-7
    assert 0 < float(window.run("document.getElementById('check').dataset.rate")) <= 1e-12
    assert text(window, "check").startswith("Checked: ")


WORN = ["section3", "section4", "section5", "soft-support", "section4-cutoff", "fast-wear"]


def test_wear_is_that_of_the_solver(page):
    for name, power in [*((name, 2) for name in WORN), ("section4", 8)]:
        put(page, "scene", name)
        put(page, "cycles", str(power))
        expected = wear.solve(load_scene(name), [10**power], rtol=1e-8).u_c[0]
        assert number(text(page, "value-wear-now")) == pytest.approx(expected, rel=1e-4), name
        assert text(page, "notices") == "", name


def test_asymptotic_values_are_those_of_python(page):
    others = ("section3-physical", "equal-wear", "f-zero", "section3-cutoff", "roughness-vanishing")
    for name in ("section3", "section4", "section5", "soft-support", "section4-cutoff", *others):
        put(page, "scene", name)
        found = wear.asymptote(load_scene(name))
        says(page, found)
        if found.regime == "steady":
            drift = number(text(page, "value-limit-drift"))
            assert drift == pytest.approx(found.log_coefficient_mm, rel=1e-4, abs=1e-12), name


def test_arrest_is_found_in_its_cycle(page):
    """With the cutoff the note's section 4 stops in its 2045th cycle, at 0.002 mm."""
    click(page, "cutoff")
    assert text(page, "value-variant") == "tanh/rigid_bearing_ends_at_3_sigma"
    assert text(page, "value-regime").startswith("arrest")
    assert "stops in cycle 2045." in text(page, "notices")
    assert number(text(page, "value-arrest-wear")) == pytest.approx(0.002, rel=1e-4)
    assert number(text(page, "value-wear-now")) == pytest.approx(0.002, rel=1e-4)


def test_page_says_when_nothing_wears(page):
    click(page, "cutoff")
    put(page, "number-h_0", "100", event="change")
    assert text(page, "notices") == "Nothing wears."
    assert number(text(page, "value-wear-now")) == 0.0


def test_every_slider_that_acts_moves_a_curve(page):
    put(page, "scene", "section3")
    click(page, "compliant")
    for row in explorer_derived.parameter_rows():
        before = curves(page)
        slider = f"slider-{row['name']}"
        read = "(({ min, max, value }) => [min, max, value].map(Number))"
        low, high, at = page.run(f"{read}(document.getElementById({slider!r}))")
        put(page, slider, str(at + 0.1 * (high - low) * (1 if at < 0.5 * (low + high) else -1)))
        assert curves(page) != before, row["name"]


def test_choices_choose_the_generated_variant(page):
    click(page, "compliant")
    assert text(page, "value-variant") == "tanh/compliant_bearing"
    put(page, "pin", "worn_rough")
    click(page, "opening")
    assert text(page, "value-variant") == "tanh/compliant_worn_rough"
    put(page, "law", "exponential")
    assert text(page, "value-variant") == "exponential/compliant_worn_rough"
    assert len(curves(page)["roughness"]) == 3
    click(page, "reset")
    assert text(page, "value-variant") == "tanh/rigid_bearing"
    assert page.run("document.getElementById('slider-K_a').disabled")


def test_numbers_are_taken_and_a_refused_one_is_not_used_by_what_comes_next(page):
    put(page, "number-f_c", "0.41729340", event="change")
    assert number(text(page, "value-limit-cycle")) == pytest.approx(2.35e-5, rel=1e-3)
    assert refuse(page, "number-sigma_c0", "0") == "Give a number above zero."
    assert refuse(page, "number-h_0", "-1") == "Give zero or a number above it."
    assert refuse(page, "number-f_c", "") == "Give a number."
    before = text(page, "value-wear-now")
    click(page, "linear")
    assert text(page, "value-wear-now") == before
    click(page, "reset")
    assert page.run("document.querySelectorAll('input:invalid').length") == 0


def test_contact_that_ends_on_a_compliant_support(page):
    """The rate bends where contact ends: it is found in many cycles all the same."""
    click(page, "cutoff")
    click(page, "compliant")
    assert text(page, "value-variant") == "tanh/compliant_bearing_ends_at_3_sigma"
    assert text(page, "value-regime").startswith("arrest")
    assert number(text(page, "value-arrest-wear")) == pytest.approx(0.002, rel=1e-4)
    assert 0.0019 < number(text(page, "value-wear-now")) < 0.002
    put(page, "cycles", "1")
    scene = load_scene(
        "section4", ["contact.ends_at_3_sigma=true", "support.stiffness_MPa_per_mm=1e5"]
    )
    expected = wear.solve(scene, [10], rtol=1e-6).u_c[0]
    assert number(text(page, "value-wear-now")) == pytest.approx(expected, rel=1e-4)


def test_equations_are_those_of_the_choices(page):
    def numbers():
        """The numbers of the note that the rows in sight name, and whether they speak of u_a."""
        shown = page.run(
            "[...document.querySelectorAll('[data-holds]')].filter((row) => !row.hidden)"
            ".map((row) => ["
            "row.querySelector('p').textContent + row.lastChild.lastChild.textContent,"
            " row.querySelector('math').textContent.includes('ua')])"
        )
        found = [number for words, _ in shown for number in re.findall(r"\((\w+)\)", words)]
        return found, any(has for _, has in shown)

    assert numbers() == (["1", "3", "4", "5", "13", "21", "22"], False)
    click(page, "cutoff")
    assert numbers() == (["1", "3", "4", "5"], False)
    click(page, "cutoff")
    click(page, "compliant")
    assert numbers() == (["1", "3", "4", "5", "2", "9"], False)
    put(page, "pin", "worn_rough")
    assert numbers() == (["1", "3", "4", "5", "5", "2", "9"], True)
    click(page, "opening")
    assert numbers() == (["3", "4", "5", "5", "2"], True)
    put(page, "law", "exponential")
    assert numbers() == (["3", "5", "5", "2"], True)


REGIMES = {
    "alike": {"pin": "worn", "number-H_a": "200", "number-f_c": "0"},
    "closing": {"pin": "worn", "number-H_a": "200", "number-f_c": "0", "number-K_a": "1e-4"},
    "arrest": {"cutoff": "", "number-f_c": "-0.05"},
    "partial": {"cutoff": "", "number-f_c": repr(1 / 3)},
    "never": {"cutoff": "", "number-h_0": "100"},
    "finite-time": {"number-f_c": "-0.05", "number-U": "9"},
}


@pytest.mark.parametrize("name", REGIMES)
def test_regimes_at_the_edges_are_those_of_python(page, name):
    put(page, "cycles", "1")
    for control, value in REGIMES[name].items():
        if control == "cutoff":
            click(page, control)
        else:
            put(page, control, value, event="input" if control == "pin" else "change")
    found = wear.asymptote(parse_scene(text(page, "scene-file")))
    if name == "alike":  # of solids that wear alike the page has no formulas
        assert text(page, "value-regime").startswith(found.regime)
    else:
        says(page, found)


def test_on_a_phone_the_plot_stays_in_sight(page):
    """One plot at a time, chosen by name, above whatever is scrolled to."""
    page.size(390, 844)
    for name in ("wear", "roughness", "pressure", "inside"):
        page.run(f"document.getElementById('show-{name}').click()")
        page.run("document.getElementById('slider-n').scrollIntoView()")
        place = (
            "(({ top, bottom, width }) => [top, bottom, width])"
            f"(document.getElementById('plot-{name}').getBoundingClientRect())"
        )
        top, bottom, width = page.run(place)
        assert 0 <= top < bottom < 422
        assert width > 300
        shown = "[...document.querySelectorAll('.plots figure')].filter((f) => f.offsetWidth)"
        assert page.run(f"{shown}.length") == 1
        slider = "document.getElementById('slider-n').getBoundingClientRect().top"
        assert page.run(slider) > bottom


def test_page_says_when_it_does_not_carry_so_far(page):
    """The bearing is pressed smooth: its roughness vanishes after a finite number of cycles."""
    put(page, "number-f_c", "-0.05", event="change")
    put(page, "number-U", "9", event="change")
    put(page, "cycles", "9")
    reached = page.run("document.querySelector('[data-cycles]').textContent")
    assert 1 < number(reached) < 1e9
    said = text(page, "notices")
    assert f"Carried to {reached} cycles only. There the roughness vanishes" in said


def test_the_scene_file_is_the_scene(page):
    for name in ("section3", "section3-cutoff", "section4", "soft-support", "section3-physical"):
        put(page, "scene", name)
        scene = load_scene(name)
        shown = parse_scene(text(page, "scene-file"))
        assert (shown.variant, shown.load) == (scene.variant, scene.load)
        assert shown.parameters() == pytest.approx(scene.parameters(), rel=1e-15)


@pytest.mark.parametrize("pin", ["bearing", "rough", "worn", "worn_rough"])
def test_the_scene_file_gives_what_is_shown(page, pin):
    """Every choice but the usual one, and a slider moved; read and solved by Python."""
    put(page, "pin", pin)
    for choice in ("compliant", "opening", "cutoff"):
        if not page.run(f"document.getElementById({choice!r}).disabled"):
            click(page, choice)
    put(page, "law", "exponential")
    put(page, "slider-f_c", "0.31")
    put(page, "cycles", "1")
    scene = parse_scene(text(page, "scene-file"))
    assert text(page, "value-variant") == f"{scene.variant.law}/{scene.variant.name}"
    assert scene.bearing.roughness_growth == 0.31
    expected = wear.solve(scene, [10], rtol=1e-6).u_c[0]
    assert number(text(page, "value-wear-now")) == pytest.approx(expected, rel=1e-4)
    saved = page.run("decodeURIComponent(document.getElementById('save').href.split(',')[1])")
    assert parse_scene(saved) == scene


@pytest.mark.parametrize("kind", LOADS)
def test_the_scene_file_has_any_load(kind, window, tmp_path):
    scene = own_scene(tmp_path, LOADS[kind])
    file = tmp_path / "page.html"
    file.write_text(explorer.page(scene), encoding="utf-8")
    window.open(file, READY)
    assert "good" in window.run("document.getElementById('check').className")
    assert parse_scene(text(window, "scene-file"), folder=tmp_path).load(0.3) == scene.load(0.3)
    if "force" not in kind:
        load, phases = scene.periodic_load, np.linspace(0.0, 1.0, 40, endpoint=False) + 0.003
        found = window.run(f"{SOLVED}({phases.tolist()})")
        expected = wear.solve(scene, [1, 100, 10**6], rtol=1e-10).u_c
        extremes = [load.minimum, load.maximum, load.mean]
        assert found["value"] == pytest.approx(load(phases).tolist(), rel=1e-13, abs=1e-18)
        assert found["slope"] == pytest.approx(load.slope(phases).tolist(), rel=1e-11, abs=1e-16)
        assert found["extremes"] == pytest.approx(extremes, rel=2e-3, abs=1e-7)
        assert found["wear"] == pytest.approx(expected.tolist(), rel=1e-8)
        assert text(window, "notices") == ""
    put(window, "number-U", "0.2" if kind == "sine" else "2", event="change")
    doubled = text(window, "scene-file")
    if "file" in LOADS[kind]:
        assert "# to be multiplied in that file: its displacements by 2, its times by 1" in doubled
    else:
        size = 0.4 if kind == "sine" else 2.0
        shown = parse_scene(doubled).load(0.3)
        assert shown == pytest.approx(size * scene.load(0.3), rel=1e-14)


def test_a_printed_page_says_what_it_shows(page):
    page.command("Emulation.setEmulatedMedia", media="print")
    shown = "document.getElementById({!r}).offsetHeight > 0"
    assert page.run(shown.format("scene-file"))
    assert not page.run(shown.format("slider-f_c"))


def test_on_a_tablet_four_plots_stay_in_sight(page):
    page.size(768, 1024)
    page.run("document.getElementById('slider-n').focus()")
    place = "document.getElementById({!r}).getBoundingClientRect()"
    lowest = page.run(place.format("legend-inside") + ".bottom")
    slider = page.run(place.format("slider-n") + ".top")
    assert 0 < lowest < slider < 1024
    assert page.run("document.documentElement.scrollWidth") <= 768


def test_indices_are_lowered_and_names_are_not(page):
    shown = "symbols('K_a = 1e-6, bearing, σ_c and closure_mm').innerHTML.replace(/<.?i>/g, '')"
    assert page.run(shown) == "K<sub>a</sub> = 1e-6, bearing, σ<sub>c</sub> and closure_mm"


def test_the_plot_shows_whether_wear_has_settled(page):
    """Beside the wear, what the asymptotic wear per cycle would make from the first cycle on."""
    assert len(curves(page)["wear"]) == 2
    click(page, "cutoff")  # wear stops: there is nothing to settle to
    assert len(curves(page)["wear"]) == 1


def test_axis_is_logarithmic_or_linear(page):
    logarithmic = curves(page)["wear"]
    click(page, "linear")
    linear = curves(page)["wear"]
    assert linear != logarithmic
    labels = "[...document.querySelectorAll('#plot-wear text')].map((t) => t.textContent)"
    assert {"0", "10000"} <= set(page.run(labels))
    click(page, "logarithmic")
    assert {"1", "10", "100", "1000", "10⁴"} <= set(page.run(labels))


def test_plots_are_told_to_those_who_do_not_see_them(page):
    said = page.run("document.getElementById('plot-wear').getAttribute('aria-label')")
    assert said.startswith("wear in µm against number of cycles: bearing, u_c goes from ")
    assert "to 4.597 at 10000; as if steady from the start goes from 4.6355 × 10⁻⁵" in said
    labelled = page.run(
        "[...document.querySelectorAll('input, select')].every((e) => e.labels.length"
        " || e.getAttribute('aria-label'))"
    )
    assert labelled


def test_keyboard_moves_a_slider(page):
    page.run("document.getElementById('slider-f_c').focus()")
    before, count = text(page, "value-limit-cycle"), page.run(UPDATES)
    page.press("ArrowRight")
    page.wait(f"{UPDATES} > {count}")
    assert text(page, "value-limit-cycle") != before


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_runs_out_of_the_page(page, scheme):
    page.media(prefers_color_scheme=scheme, prefers_reduced_motion="reduce")
    dark = page.run("getComputedStyle(document.body).backgroundColor") != "rgb(255, 255, 255)"
    assert dark == (scheme == "dark")
    assert not page.run("matchMedia('(prefers-reduced-motion: no-preference)').matches")
    for width in (390, 768, 1280):
        page.size(width, 900)
        assert page.run("document.documentElement.scrollWidth") <= width


def test_script_outside_the_policy_does_not_run(window, page_file):
    """The policy is in force: a script that is put in does nothing."""
    window.open(page_file, READY)
    window.run(
        "(() => { const s = document.createElement('script'); s.textContent = 'window.broken = 1';"
        " document.body.append(s); })()"
    )
    assert window.run("window.broken === undefined")


def test_a_noisy_record_and_readings_are_shown(tmp_path, window):
    """2001 rows: as good as Python, with the mean of the last cycle, the peak as the page says of
    the merged rows, and what was measured."""
    times = np.arange(2001) * 3e-5
    noise = 1e-5 * np.random.default_rng(3).standard_normal(2001)
    path = 5e-4 * np.sin(2.0 * np.pi * times / 0.06003) + noise
    rows = "\n".join(f"{t!r},{u!r}" for t, u in zip(times.tolist(), path.tolist(), strict=True))
    (tmp_path / "record.csv").write_text(f"t_s,U_a_mm\n{rows}\n")
    scene = own_scene(tmp_path, 'kind = "table"\nfile = "record.csv"\nrepeat = true\n')
    (tmp_path / "read.csv").write_text("cycles,wear_um\n10,0.3\n5000,3.5\n")
    file = tmp_path / "page.html"
    data = ["--data", str(tmp_path / "read.csv")]
    assert main(["explore", str(tmp_path / "own.toml"), *data, "-o", str(file)]) == 0
    window.open(file, READY)
    assert window.run("document.getElementById('check').className").endswith("good")
    assert window.run("document.querySelectorAll('#plot-wear .dot').length") == 2
    found, merged = (
        wear.solve(each, [10_000], rtol=1e-4).pressures
        for each in (scene, explorer.for_plots(scene))
    )
    assert number(text(window, "value-mean-now")) == pytest.approx(found.mean[0], rel=1e-3)
    assert number(text(window, "value-peak-now")) == pytest.approx(merged.peak[0], rel=1e-3)
    assert text(window, "description").endswith("is that of the merged rows.")
    assert window.run("chosen.load.phase.length") < 300
    assert text(window, "value-contact-now") == "1"
    for choice in ("cutoff", "compliant"):
        click(window, choice)
    assert "only" in text(window, "notices")  # the count has spent its budget
    assert number(text(window, "value-peak-now")) > 0.0


def test_every_variant_is_shown_its_own_equations_and_no_others():
    rows = list(explorer_derived._model(LAWS))
    for variant, opening in product(VARIANTS, (False, True)):
        chosen = {
            "law": variant.law.name, "pin": variant.pin.value, "compliant": variant.compliant,
            "cutoff": variant.ends_at_3_sigma, "opening": opening,
        }  # fmt: skip
        shown = {
            (title, latex)
            for title, latex, holds in rows
            if all(chosen[name] in values for name, values in holds.items())
        }
        own = equations_of(variant, opening=opening)
        assert shown == {(capital(each.title), each.latex) for each in own}


def test_a_law_of_the_scenes_own_acts_and_has_its_equations(window, tmp_path, monkeypatch):
    """Its page agrees with Python, in the end and for another variant too."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr(explorer, "CHECKED", ())
    scene = load_scene("section4", ['contact.law={phi = "1/(1 + exp(r - 1))"}'])
    file = tmp_path / "page.html"
    file.write_text(explorer.page(scene), encoding="utf-8")
    window.open(file, READY)
    assert window.run("document.getElementById('check').className").endswith("good")
    says(window, wear.asymptote(scene))
    shown = "[...document.querySelectorAll('[data-holds]')].filter((row) => !row.hidden)"
    titles = window.run(f"{shown}.map((row) => row.querySelector('p').textContent)")
    assert "Pressure in the end" in titles
    assert "tanh" not in window.run(f"{shown}.map((row) => row.textContent).join()")
    put(window, "pin", "worn_rough")
    put(window, "cycles", "1")
    found = parse_scene(text(window, "scene-file"))
    assert (found.contact.law, found.variant.pin) == (scene.contact.law, "worn_rough")
    expected = wear.solve(found, [10], rtol=1e-6).u_c[0]
    assert number(text(window, "value-wear-now")) == pytest.approx(expected, rel=1e-4)
    put(window, "law", "tanh")
    assert text(window, "value-variant") == "tanh/rigid_worn_rough"


def test_a_scene_without_any_wear_agrees_with_python(window, tmp_path, monkeypatch):
    """So far from contact that both have a wear of zero."""
    monkeypatch.setattr(explorer, "CHECKED", ())
    file = tmp_path / "page.html"
    scene = load_scene("section4", ["contact.closure_mm=1"])
    file.write_text(explorer.page(scene), encoding="utf-8")
    window.open(file, READY)
    assert window.run("document.getElementById('check').className").endswith("good")
