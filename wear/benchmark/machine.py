"""The machine of a benchmark: versions, processor, load; and the time of imports."""

from __future__ import annotations

import os
import platform
import subprocess
import sys
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from wear.benchmark.methods import Method

DISTRIBUTIONS = ("derive-wear", "numpy", "scipy")
PEER_DISTRIBUTIONS = ("heyoka", "diffrax", "jax", "jitcode", "scikit-sundae", "numba")
CPU = Path("/proc/cpuinfo")


def machine(peers: bool = False) -> dict[str, Any]:
    """Return versions, processor, cores, and the load average before the measurement."""
    names = (*DISTRIBUTIONS, *(PEER_DISTRIBUTIONS if peers else ()))
    text = CPU.read_text(encoding="utf-8", errors="replace") if CPU.exists() else ""
    return {
        "python": platform.python_version(),
        "versions": installed(names),
        "processor": next(
            (
                line.partition(":")[2].strip()
                for line in text.splitlines()
                if line.startswith("model name")
            ),
            platform.processor() or platform.machine(),
        ),
        "cores": os.cpu_count(),
        "load_average": os.getloadavg()[0] if hasattr(os, "getloadavg") else None,
    }


def footer(facts: Mapping[str, Any]) -> str:
    """Return these facts in a line."""
    versions = ", ".join(f"{name} {number}" for name, number in facts["versions"].items())
    text = f"{facts['processor']}, {facts['cores']} cores; Python {facts['python']}, {versions}"
    busy = facts["load_average"]
    if busy is not None and busy > 0.5 * (facts["cores"] or 1):
        text += f"; other programs were running (load average {busy:.1f}): times are too long"
    return text


def installed(packages: Iterable[str]) -> dict[str, str]:
    """Return the versions of those of these packages that are installed."""
    versions = {}
    for package in packages:
        with suppress(PackageNotFoundError):
            versions[package] = version(package)
    return versions


def missing(method: Method) -> tuple[str, ...]:
    """Return the packages that a method needs and that are not installed."""
    packages = dict.fromkeys(module.partition(".")[0] for module in method.imports)
    return tuple(package for package in packages if find_spec(package) is None)


def import_seconds(modules: Sequence[str]) -> float:
    """Return the time to import modules in a new process, without the start of Python."""
    lines = ["from time import perf_counter", "start = perf_counter()"]
    lines += [f"import {module}" for module in modules]
    code = "\n".join([*lines, "print(perf_counter() - start)"])
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return float(done.stdout.split()[-1])
