"""Contrast of everything that is read or told apart, in both schemes and on paper (WCAG 2.2)."""

import re
from importlib.resources import files

import pytest

from wear.figure_style import GREY, INK, stroke

TEXT, GRAPHICS = 4.5, 3.0  # success criteria 1.4.3 and 1.4.11
_CSS = files("wear.report").joinpath("assets/report.css").read_text(encoding="utf-8")
_FAMILIES = 7


def _schemes() -> dict[str, dict[str, str]]:
    """The colours by name: light first, what dark mode and paper change on top of it."""
    found = [
        dict(re.findall(r"--(\w+): (#\w+|\w+);", block))
        for block in re.findall(r":root \{(.*?)\}", _CSS, flags=re.DOTALL)
    ]
    light, dark, paper = found
    return {"light": light, "dark": {**light, **dark}, "paper": {**light, **paper}}


def _luminance(colour: str) -> float:
    digits = colour.lstrip("#")
    digits = "".join(2 * d for d in digits) if len(digits) == 3 else digits
    channels = (int(digits[i : i + 2], 16) / 255 for i in (0, 2, 4))
    linear = (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels)
    return sum(w * c for w, c in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


def contrast(one: str, other: str) -> float:
    """The contrast ratio of two colours.

    >>> round(contrast("#000", "#ffffff"), 1), round(contrast("#777", "#fff"), 2)
    (21.0, 4.48)
    """
    dark, light = sorted((_luminance(one), _luminance(other)))
    return (light + 0.05) / (dark + 0.05)


@pytest.mark.parametrize("scheme", ["light", "dark", "paper"])
def test_words_can_be_read(scheme: str) -> None:
    colours = _schemes()[scheme]
    grounds = [colours[name] for name in ("paper", "plate") if colours[name] != "transparent"]
    for name in ("ink", "quiet", "link", "good", "fair", "bad"):
        for ground in grounds:
            assert contrast(colours[name], ground) >= TEXT, (name, ground)


@pytest.mark.parametrize("scheme", ["light", "dark", "paper"])
def test_lines_of_figures_stand_out(scheme: str) -> None:
    """Ink becomes that of the page; all other colours stay."""
    colours = _schemes()[scheme]
    for family in range(_FAMILIES):
        shown = stroke(family)["color"]
        assert isinstance(shown, str)
        seen = colours["ink"] if shown == INK else shown
        assert contrast(seen, colours["paper"]) >= GRAPHICS, shown
    assert contrast(GREY, colours["paper"]) >= GRAPHICS


def test_no_colour_escapes_the_schemes() -> None:
    """Outside of the three lists of colours there are only their names."""
    rest = re.sub(r":root \{.*?\}", "", _CSS, flags=re.DOTALL)
    assert re.findall(r"#[0-9a-fA-F]{3,6}\b|\brgba?\(|\bhsla?\(", rest) == []
