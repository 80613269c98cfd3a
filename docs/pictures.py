"""Retake the pictures of README.md and of these pages from a finished report.

    make reproduce
    python docs/pictures.py report

It needs Chromium. `tests/test_docs.py` holds that no picture is left out.
"""

from __future__ import annotations

import base64
import io
import shutil
import sys
import tempfile
from pathlib import Path

from PIL import Image

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from tests.wear.browser import browser  # noqa: E402  # the driver of the tests
from wear.cli import main as wear  # noqa: E402

WIDTH = 632  # CSS pixels: the report on a narrow page, as the README shows it
MARGIN = 12
OF_THE_REPORT = ("figure-3a.svg", "system.svg")
OF_COMMANDS = {"section4.svg": ("figure", "section4")}
OF_A_BROWSER = "report.png"

_FROM_HEADING_TO_FIGURE = """(() => {
  const heading = [...document.querySelectorAll('h2')]
    .find((one) => one.textContent.endsWith('The model'));
  const figure = [...document.querySelectorAll('figure')]
    .find((one) => heading.compareDocumentPosition(one) & Node.DOCUMENT_POSITION_FOLLOWING);
  const [top, bottom] = [heading, figure].map((one) => one.getBoundingClientRect());
  return [top.top + scrollY, bottom.bottom + scrollY];
})()"""


def retake(report: Path, folder: Path, chromium: str) -> None:
    """Write every picture of the pages to a folder."""
    for name in OF_THE_REPORT:
        shutil.copyfile(report / name, folder / name)
    for name, command in OF_COMMANDS.items():
        wear([*command, "-o", str(folder / name)])
    (folder / OF_A_BROWSER).write_bytes(model_page(report / "report.html", chromium))


def model_page(page_file: Path, chromium: str) -> bytes:
    """Return the report's section on the model, from its heading to its drawing, as a PNG file."""
    with tempfile.TemporaryDirectory() as profile, browser(chromium, Path(profile)) as page:
        page.size(WIDTH, 900)
        page.media(prefers_color_scheme="light")
        page.open(page_file, "document.readyState === 'complete'")
        page.wait("document.fonts.status === 'loaded'")
        top, bottom = page.run(_FROM_HEADING_TO_FIGURE)
        clip = {"x": 0, "y": top - MARGIN, "width": WIDTH, "height": bottom - top + 2 * MARGIN}
        shot = page.command(
            "Page.captureScreenshot", clip={**clip, "scale": 1}, captureBeyondViewport=True
        )
    taken = Image.open(io.BytesIO(base64.b64decode(shot["data"]))).convert("RGB")
    written = io.BytesIO()
    taken.quantize(256).save(written, "PNG", optimize=True)
    return written.getvalue()


if __name__ == "__main__":
    program = shutil.which("chromium") or shutil.which("google-chrome")
    if len(sys.argv) != 2 or program is None:
        sys.exit("usage: python docs/pictures.py REPORT_FOLDER (needs chromium)")
    retake(Path(sys.argv[1]), HERE / "_static", program)
