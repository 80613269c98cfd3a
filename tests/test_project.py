"""House rules: what holds for every file, and what starting a command may import."""

import ast
import contextlib
import importlib
import re
import sys
import tomllib
from itertools import chain
from pathlib import Path
from types import ModuleType

import pytest

import derive
import wear
from tests.programs import ended, python

ROOT = Path(__file__).resolve().parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
HEAVY = {"sympy", "mpmath", "flint", "matplotlib", "scipy.integrate", "pandas"}


def imported_by(code: str) -> set[str]:
    """Return the modules that a fresh interpreter has loaded after running `code`."""
    shown = python(f"{code}\nimport sys\nprint('\\n', *sys.modules)")
    return set(shown.splitlines()[-1].split())


def tracked(pattern: str) -> list[Path]:
    """Return the project's own files, without what was built or installed."""
    listing = ended("git", "ls-files", "-z", "--", pattern, cwd=ROOT)
    if listing.returncode:
        pytest.skip("an unpacked archive does not know which files are the project's own")
    names = filter(None, listing.stdout.split("\0"))
    return [path for path in (ROOT / name for name in names) if path.is_file()]


@pytest.fixture(scope="module")
def sources(need_tool) -> dict[Path, str]:
    need_tool("git")
    return {path: path.read_text(encoding="utf-8") for path in tracked("*.py")}


def test_importing_is_light():
    assert not imported_by("import wear, wear.cli, derive, derive.cli") & HEAVY


@pytest.mark.parametrize("script", PROJECT["scripts"].values())
def test_an_interrupt_while_a_command_is_imported_is_silent(script, tmp_path):
    """The first module that a command imports stands for all during which Ctrl-C may come."""
    (tmp_path / "argparse.py").write_text("raise KeyboardInterrupt")
    module, function = script.split(":")
    code = f"import sys; sys.path.insert(0, {str(tmp_path)!r}); import {module} as start"
    done = ended(sys.executable, "-c", f"{code}; sys.exit(start.{function}())")
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "")


def test_another_distribution_of_the_same_name_is_named(tmp_path):
    (tmp_path / "derive").mkdir()
    (tmp_path / "derive" / "__init__.py").write_text("")
    code = f"""
import sys
sys.meta_path = [finder for finder in sys.meta_path if "editable" not in str(finder)]
sys.path.append({str(ROOT)!r})
import wear
import wear.__main__ as start
try:
    wear.solve
except ImportError as fault:
    print(fault)
sys.exit(start.main())
"""
    done = ended(sys.executable, "-c", code, cwd=tmp_path)
    assert done.returncode == 2
    assert "another distribution's" in done.stdout
    assert "another distribution's" in done.stderr
    assert "Traceback" not in done.stderr


def test_without_the_report_s_packages_the_core_runs_and_the_rest_names_them(tmp_path):
    code = """
import sys
sys.modules.update(dict.fromkeys(("matplotlib", "math_core", "markdown_it")))
from wear.cli import main
assert main(["run", "section4", "--cycles", "1"]) == 0
commands = ["reproduce"], ["report", "section4"], ["figure", "section4", "-o", "wear.svg"]
for arguments in commands:
    try:
        main(arguments)
    except SystemExit as stop:
        assert stop.code == 2
    assert "derive.results" not in sys.modules  # nothing is derived first
"""
    done = ended(sys.executable, "-c", code, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    needed = re.findall(
        r"needs the package (\w+): pip install 'derive-wear\[report\]'", done.stderr
    )
    assert needed == ["matplotlib", "markdown_it", "matplotlib"]
    assert "Traceback" not in done.stderr


def test_commands_without_mathematics_import_none():
    code = """
import contextlib
from wear.cli import main
for arguments in (["--help"], ["run", "--help"], ["scenes"], ["cite"]):
    with contextlib.suppress(SystemExit):
        main(arguments)
"""
    assert not imported_by(code) & HEAVY


def test_what_a_package_offers_is_not_hidden_by_a_module_of_the_same_name():
    """Importing a module `wear.solve` turns a function `wear.solve` into it, if given lazily."""
    for package in (derive, wear):
        for name in package.__all__:
            with contextlib.suppress(ModuleNotFoundError):
                importlib.import_module(f"{package.__name__}.{name}")
            assert not isinstance(getattr(package, name), ModuleType), name


def test_no_file_names_a_place_of_one_machine(need_tool):
    need_tool("git")
    place = re.compile(r"(?<![\w./~$}{-])/(?:work|root|home|tmp|Users)/\w")
    found = [
        f"{path.relative_to(ROOT)}: {match.group()}"
        for path in tracked("*")
        if b"\0" not in (content := path.read_bytes())
        for match in [place.search(content.decode(errors="replace"))]
        if match
    ]
    assert not found


def test_no_text_is_run_as_code(sources):
    """Neither `eval` nor `exec`, nor what runs code on reading: pickle, parse_expr, sympify of text
    or of anything else."""
    banned = {"eval", "exec", "parse_expr", "sympify"}
    suspects = re.compile("|".join([*banned, "pickle"]))
    found = [
        f"{path.relative_to(ROOT)}:{node.lineno}"
        for path, text in sources.items()
        if suspects.search(text)
        for node in ast.walk(ast.parse(text))
        if (
            isinstance(node, ast.Call)
            and getattr(node.func, "id", getattr(node.func, "attr", "")) in banned
        )
        or (isinstance(node, ast.Import) and any("pickle" in name.name for name in node.names))
        or (isinstance(node, ast.ImportFrom) and "pickle" in (node.module or ""))
    ]
    assert not found


def test_figures_are_drawn_without_pyplot(sources):
    """Which opens windows and keeps what is drawn for all of a process."""
    drawing = [text for path, text in sources.items() if "wear" in path.relative_to(ROOT).parts[:1]]
    assert not [text for text in drawing if re.search(r"^ *(from|import) .*pyplot", text, re.M)]


def test_every_module_says_what_it_holds(sources):
    opening = re.compile(r'(#.*\n)*r?"""\S')
    assert not [path for path, text in sources.items() if text and not opening.match(text)]


def test_pins_cover_every_requirement():
    name = re.compile(r"[A-Za-z0-9_.-]+")
    pins = (ROOT / "constraints.txt").read_text().splitlines()
    pinned = {line.split("==")[0].lower().replace("_", "-") for line in pins if "==" in line}
    requirements = [*PROJECT["dependencies"], *chain(*PROJECT["optional-dependencies"].values())]
    required = {name.match(text).group().lower().replace("_", "-") for text in requirements}
    assert required - {"derive-wear"} <= pinned


def test_the_citation_has_the_version_of_the_package():
    citation = (ROOT / "CITATION.cff").read_text()
    assert f"\nversion: {PROJECT['version']}\n" in citation
