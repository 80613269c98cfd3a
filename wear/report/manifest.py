"""``manifest.json``: what is needed to make the report again, and to see that it is the same."""

from __future__ import annotations

import hashlib
import platform
from collections.abc import Mapping
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


def manifest(contents: Mapping[str, str | bytes], runs: Runs, command: str) -> dict[str, Any]:
    """Return versions, platform in general terms, command, scenes, and the SHA-256 of every
    file."""
    bare = {n: each.encode() if isinstance(each, str) else each for n, each in contents.items()}
    return {
        "command": command,
        "versions": versions(),
        "platform": {"system": platform.system(), "machine": platform.machine()},
        "scenes": {name: case.scene.to_tables() for name, case in sorted(runs.cases.items())},
        "sha256": {name: hashlib.sha256(bare[name]).hexdigest() for name in sorted(bare)},
    }


def versions() -> dict[str, str]:
    """Versions of Python and of the packages in use; those not installed are left out."""
    return {"python": platform.python_version(), **installed(PACKAGES)}
