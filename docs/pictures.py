"""Retake the pictures of README.md and of these pages from a finished report.

    make reproduce
    python docs/pictures.py report

`tests/test_docs.py` holds that no picture is left out.
"""

from __future__ import annotations

import contextlib
import shutil
import sys
import tempfile
from pathlib import Path

from wear.cli import main as wear

HERE = Path(__file__).resolve().parent
OF_THE_REPORT = ("wear-curve.svg", "system.svg")
OF_COMMANDS = {
    "section4.svg": ("figure", "section4"),
    "tornado.svg": ("sensitivity", "section4"),
}
METAL = "metal-wear.csv metal.toml --ignore load_g --free-each bearing.roughness_mm"
METAL += " --free bearing.wear_coefficient bearing.roughness_growth"
OF_THE_FIT = {"metal-fit.svg": "data.svg", "metal-profiles.svg": "profiles.svg"}
SCENE, SHOWN = "section4", 12


def method() -> bytes:
    """Draw the wear of a cycle and the number of cycles over the wear, with the first cycles."""
    import numpy as np

    import wear as package
    from wear.equation import equation_of
    from wear.figure_style import PAGE, canvas, encoded, stroke, styled
    from wear.orbit.segments import orbit

    scene = package.load_scene(SCENE)
    cycles = np.arange(SHOWN + 1)
    u = np.append(0.0, package.solve(scene, cycles[1:].tolist()).u_c)
    count = np.linspace(0.0, SHOWN, 97)  # cycles, and what is between them
    found = orbit(equation_of([scene]), np.array([1e3]), 1e-8, np.zeros(1), np.zeros(1))
    (between,), (after,) = (found.after((count + more)[None])[0] for more in (0, 1))
    line, dots = stroke(0), stroke(1)
    with styled():
        figure, whole = canvas(PAGE, 0.4 * PAGE)
        whole.remove()
        left, right = figure.subplots(1, 2)
        left.plot(1e3 * between, 1e3 * (after - between), color=line["color"])
        left.plot(1e3 * u[:-1], 1e3 * np.diff(u), "o", color=dots["color"])
        left.set(ylabel=r"Wear of a cycle  $D(u)$  ($\mathrm{\mu m}$)", ylim=(0.0, None))
        right.plot(1e3 * between, count, color=line["color"])
        right.plot(1e3 * u, cycles, "o", color=dots["color"])
        right.set(ylabel="Cycles  $n(u)$", yticks=cycles[::2])
        for axes in (left, right):
            axes.set_xlabel(r"Wear  $u$  ($\mathrm{\mu m}$)")
    return encoded(figure, ".svg")


DRAWN = {"method.svg": method}


def retake(report: Path, folder: Path) -> None:
    """Write every picture of the pages to a folder."""
    for name in OF_THE_REPORT:
        shutil.copyfile(report / name, folder / name)
    for name, command in OF_COMMANDS.items():
        wear([*command, "-o", str(folder / name)])
    with tempfile.TemporaryDirectory() as fitted, contextlib.chdir(HERE / "examples"):
        wear(["fit", *METAL.split(), "-o", fitted])
        for name, drawn in OF_THE_FIT.items():
            shutil.copyfile(Path(fitted) / drawn, folder / name)
    for name, draw in DRAWN.items():
        (folder / name).write_bytes(draw())


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: python docs/pictures.py REPORT_FOLDER")
    retake(Path(sys.argv[1]), HERE / "_static")
