"""Retake the pictures of README.md and of these pages from a finished report.

    make reproduce
    python docs/pictures.py report

`tests/test_docs.py` holds that no picture is left out.
"""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

from wear.cli import main as wear

HERE = Path(__file__).resolve().parent
OF_THE_REPORT = ("wear-curve.svg", "system.svg")
OF_COMMANDS = {
    "section4.svg": ("figure", "section4"),
    "tornado.svg": ("sensitivity", "section4"),
}


def retake(report: Path, folder: Path) -> None:
    """Write every picture of the pages to a folder."""
    for name in OF_THE_REPORT:
        shutil.copyfile(report / name, folder / name)
    for name, command in OF_COMMANDS.items():
        wear([*command, "-o", str(folder / name)])


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: python docs/pictures.py REPORT_FOLDER")
    retake(Path(sys.argv[1]), HERE / "_static")
