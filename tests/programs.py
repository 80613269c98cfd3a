"""Programs that tests run in processes of their own, and scripts that they read as modules."""

import importlib.util
import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any


def ended(*command: Any, **options: Any) -> subprocess.CompletedProcess[str]:
    """Run a program to its end, be it good or bad."""
    return subprocess.run(command, capture_output=True, text=True, check=False, **options)


def run(*command: Any, **options: Any) -> str:
    """Run a program and return what it prints; its complaints are the test's."""
    done = ended(*command, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def python(code: str, **options: Any) -> str:
    """Run Python code in a fresh interpreter and return what it prints."""
    return run(sys.executable, "-c", code, **options)


def status_of(main: Callable[[Sequence[str]], int], arguments: Sequence[str]) -> int:
    """Run a command in this process and return its status."""
    try:
        return main(arguments)
    except SystemExit as stop:  # argparse's way of ending
        return int(stop.code or 0)


def module(path: Path) -> ModuleType:
    """Return a script of the project, which belongs to no package, as a module."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    made = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(made)
    return made
