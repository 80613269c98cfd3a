"""``manifest.json``: what is needed to make the report again, and to see that it is the same."""

from __future__ import annotations

import hashlib
import platform
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from wear.benchmark.machine import installed
from wear.report.runs import Runs

#: Packages whose version can change a digit or a page.
PACKAGES = (
    "derive-wear",
    "numpy",
    "scipy",
    "sympy",
    "mpmath",
    "python-flint",
    "matplotlib",
    "math-core",
)
NAME = "manifest.json"


def manifest(folder: Path, runs: Runs, command: str) -> dict[str, Any]:
    """Versions, platform in general terms, command, scenes, and the checksum of every file.

    `folder` holds the files of the report and nothing else.
    """
    return {
        "command": command,
        "versions": versions(),
        "platform": {"system": platform.system(), "machine": platform.machine()},
        "scenes": {name: case.scene.to_tables() for name, case in sorted(runs.cases.items())},
        "sha256": checksums(folder),
    }


def versions() -> dict[str, str]:
    """Versions of Python and of the packages in use; those not installed are left out."""
    return {"python": platform.python_version(), **installed(PACKAGES)}


def checksums(folder: Path) -> Mapping[str, str]:
    """SHA-256 of every file below a folder, by relative name."""
    files = sorted(path for path in folder.rglob("*") if path.is_file() and path.name != NAME)
    return {
        path.relative_to(folder).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in files
    }
