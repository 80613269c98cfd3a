"""The explorer: one page on which the parameters of a scene can be moved.

Overview
    The page needs no network and no server.  The model on it is generated from the derivation;
    how it is integrated stands in ``assets/explorer.solve.js``.  When it loads it computes the
    wear of some scenes itself and compares it with the values that Python found.
Key results
    page    the whole file
"""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from html import escape
from importlib.resources import files
from typing import Any

from wear.fitting.readings import Specimen
from wear.report import explorer_data, mathml
from wear.report.html import style
from wear.scene import KEYS, Scene, builtin_names, load_scene

CHECKED = ("section3", "section4", "section5", "section4-cutoff", "soft-support", "large-swing")
AGREEMENT = {"wear": 1e-7, "rate": 1e-12}
"""Largest relative distances from Python: the page's own tolerance, and roundoff."""

SCRIPTS = ("explorer.solve.js", "explorer.plot.js", "explorer.scene.js", "explorer.page.js")

_PLOTS = {
    "wear": ("Wear", "Wear"),
    "roughness": ("Roughness", "Roughness"),
    "pressure": ("Pressure", "Contact pressure over the cycles"),
    "inside": ("In a cycle", "Contact pressure inside a cycle"),
}
_PINS = {
    "bearing": "smooth, does not wear",
    "rough": "rough, does not wear",
    "worn": "smooth, wears",
    "worn_rough": "rough, wears",
}
_VALUES = {
    "regime": "Regime",
    "wear-now": "Wear after <span data-cycles></span> cycles",
    "cycle-now": "Wear of the cycle after",
    "peak-now": "Peak pressure of the last cycle",
    "mean-now": "Mean pressure of the last cycle",
    "contact-now": "Fraction of the last cycle in contact",
    "limit-cycle": "Asymptotic wear per cycle",
    "limit-pressure": "Asymptotic pressure",
    "limit-ratio": "Limit of closure over roughness",
    "limit-drift": "Coefficient of ln N",
    "arrest-wear": "Wear at arrest",
    "variant": "Generated variant",
    "time": "Time of this page",
}
_SCENE_FILE = """<section aria-labelledby="setting">
<h2 id="setting">This setting as a scene file</h2>
<p class="lead"><a id="save" download="scene.toml">Save it</a> as <code>scene.toml</code>:
<code>wear run scene.toml</code> computes it to ten digits, with an estimate of the error.</p>
<pre id="scene-file" tabindex="0" aria-labelledby="setting"></pre>
</section>"""


def page(scene: Scene, specimens: Sequence[Specimen] = ()) -> str:
    """Return the page, opened at a scene, which must have a load that repeats, with what was
    measured on `specimens` of it.

    Raises
    ------
    UsageError
        if the load does not repeat.
    """
    derived = json.loads(_asset("explorer.derived.json"))
    data = _data(scene, derived, specimens)
    scripts = [derived["models"], *(_asset(name) for name in SCRIPTS)]
    styles = f"{style()}\n{_asset('explorer.css')}"
    tags = "\n".join(f"<script>{text}</script>" for text in scripts)
    encoded = json.dumps(data, ensure_ascii=False, allow_nan=False).replace("<", "\\u003c")
    return f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="{_policy(scripts, styles)}">
<meta name="color-scheme" content="light dark">
<title>Explorer: wear under cyclic contact</title>
<style>{styles}</style>
</head>
<body>
<a class="skip" href="#results">Skip to the results</a>
<header>
<h1>Wear under cyclic contact</h1>
<p class="lead">Move a parameter: wear, roughness and pressure are computed anew, for any number of
cycles, by this page alone. The model on it is generated from the derivation.</p>
<p class="check" id="check" role="status">Not checked: this page needs a script to run.</p>
</header>
<main class="columns" id="results" tabindex="-1">
<div class="workbench">
{_plots()}
<form class="controls" autocomplete="off" aria-label="Parameters">
{_controls(data["parameters"], derived["laws"])}
</form>
</div>
<div class="details">
{_values()}
{_SCENE_FILE}
<section class="equations" aria-labelledby="equations">
<h2 id="equations">Equations</h2>
{derived["equations"]}
</section>
</div>
</main>
<script type="application/json" id="data">{encoded}</script>
{tags}
</body>
</html>
"""


def _data(
    first: Scene, derived: Mapping[str, Any], specimens: Sequence[Specimen]
) -> dict[str, Any]:
    scenes = {name: load_scene(name) for name in builtin_names()}
    first = explorer_data.opened(first)
    if first.name not in scenes or scenes[first.name] != first:
        first = replace(first, name=_free_name(first.name, scenes))
        scenes = {first.name: first} | scenes
    shown = [explorer_data.scene_data(scene) for scene in scenes.values()]
    next(each for each in shown if each["name"] == first.name)["readings"] = [
        [float(n), float(wear) * explorer_data.MICROMETRES]
        for each in specimens
        for n, wear in zip(each.cycles, each.wear_mm, strict=True)
    ]
    own = [first] if first.name not in CHECKED else []
    return {
        "first": first.name,
        "scenes": shown,
        "parameters": derived["parameters"],
        "keys": KEYS,
        "checks": explorer_data.checked([*(scenes[name] for name in CHECKED), *own]),
        "agreement": AGREEMENT,
        "cutoff": derived["cutoff"],
    }


def _free_name(name: str, taken: Mapping[str, Scene]) -> str:
    return f"{name} (changed)" if name in taken else name


def _policy(scripts: Sequence[str], styles: str) -> str:
    """Nothing may be fetched, and only what was written here may run."""
    hashes = " ".join(f"'{_hash(text)}'" for text in scripts)
    return (
        f"default-src 'none'; script-src {hashes}; style-src '{_hash(styles)}'; "
        "style-src-attr 'unsafe-inline'; font-src data:; base-uri 'none'; form-action 'none'"
    )


def _hash(text: str) -> str:
    return "sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()


def _asset(name: str) -> str:
    return files("wear.report").joinpath("assets", name).read_text(encoding="utf-8")


def _plots() -> str:
    """The plots; where there is room for one, its name chooses it (`explorer.css`)."""
    choices = "\n".join(
        f'<input type="radio" name="plot" id="show-{name}"{" checked" if name == "wear" else ""}>'
        f'<label for="show-{name}">{short}</label>'
        for name, (short, _) in _PLOTS.items()
    )
    plots = "\n".join(
        f'<figure id="figure-{name}"><figcaption>{title}</figcaption>'
        f'<svg id="plot-{name}" role="img" viewBox="0 0 460 270"></svg>'
        f'<div class="legend" id="legend-{name}" aria-hidden="true"></div></figure>'
        for name, (_, title) in _PLOTS.items()
    )
    return (
        '<section class="results" aria-label="Plots">\n'
        f'<div class="choice" role="radiogroup" aria-label="Plot shown">\n{choices}\n</div>\n'
        '<p id="summary" role="status"></p>\n<ul id="notices" role="status"></ul>\n'
        f'<div class="plots" id="plots">\n{plots}\n</div>\n</section>'
    )


def _values() -> str:
    values = "\n".join(
        f"<div{' class=wide' if name == 'regime' else ''}><dt>{title}</dt>"
        f'<dd id="value-{name}"></dd></div>'
        for name, title in _VALUES.items()
    )
    return (
        '<section aria-labelledby="numbers"><h2 id="numbers">In numbers</h2>\n'
        f'<dl class="figures">\n{values}\n</dl></section>'
    )


def _controls(rows: Sequence[Mapping[str, Any]], laws: Sequence[str]) -> str:
    by_name = {row["name"]: row for row in rows}
    parts = [
        '<fieldset><legend>Scene</legend><div class="control"><label for="scene">Start from</label>'
        '<select id="scene"></select></div><p class="lead" id="description"></p>'
        '<button type="button" id="reset">Back to the scene</button></fieldset>',
        '<fieldset><legend>Cycles</legend><div class="control">'
        '<label for="cycles">Number of cycles <output id="cycles-shown" for="cycles"></output>'
        '</label><input type="range" id="cycles" min="0" max="9" step="0.05" value="4"></div>'
        '<div class="tick"><input type="radio" name="axis" id="logarithmic" checked>'
        '<label for="logarithmic">logarithmic axis</label><input type="radio" name="axis" '
        'id="linear"><label for="linear">linear axis</label></div></fieldset>',
    ]
    extra = {"Pin": _pin(), "Contact": _contact(laws), "Support": _support()}
    for group, names in explorer_data.GROUPS.items():
        sliders = "\n".join(_slider(by_name[name]) for name in names)
        inner = extra.get(group, "")
        parts.append(f"<fieldset><legend>{group}</legend>{inner}\n{sliders}</fieldset>")
    return "\n".join(parts)


def _pin() -> str:
    options = "".join(f'<option value="{value}">{text}</option>' for value, text in _PINS.items())
    return (
        '<div class="control"><label for="pin">Surface</label>'
        f'<select id="pin">{options}</select></div>'
        + _tick("opening", "wear of the pin opens the gap (the physical sign)")
    )


def _contact(laws: Sequence[str]) -> str:
    options = "".join(f"<option>{escape(name)}</option>" for name in laws)
    return (
        '<div class="control"><label for="law">Contact law</label>'
        f'<select id="law">{options}</select></div>'
        + _tick("cutoff", "no contact beyond three times the roughness")
    )


def _support() -> str:
    return _tick("compliant", "the bearing stands on springs")


def _tick(name: str, text: str) -> str:
    return (
        f'<div class="tick"><input type="checkbox" id="{name}">'
        f'<label for="{name}">{text}</label></div>'
    )


def _slider(row: Mapping[str, Any]) -> str:
    name = row["name"]
    symbol = mathml.inline(row["latex"])
    meaning = f'<span id="meaning-{name}">{escape(row["meaning"])}</span>'
    spoken = escape(f"{row['meaning']}, {row['unit'] or 'dimensionless'}")
    return (
        f'<div class="control"><label for="slider-{name}">{symbol} {meaning}</label>'
        '<div class="pair">'
        f'<input type="range" id="slider-{name}" step="any">'
        f'<input type="number" id="number-{name}" step="any" aria-label="{spoken}">'
        f'<span class="unit" id="unit-{name}">{escape(row["unit"])}</span></div></div>'
    )
