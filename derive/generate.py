"""The generated modules of wear: writing them, and finding those that are out of date.

Key results
    sources     every generated file, as text
    write       bring the files up to date
    outdated    the files that are not
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from types import MappingProxyType

from .codegen import reaction
from .codegen.contact_law import faults_of
from .codegen.sources import source
from .faults import UsageError
from .files import write_atomically
from .laws import LAWS
from .note.governing import Pin
from .program import margin_program, program
from .results import asymptotics
from .variant import VARIANTS

_PACKAGE = '"""Generated code{of}, one module a variant; not to be edited."""\n'


@cache
def sources() -> Mapping[str, str]:
    """Return the text of every generated file by its path within ``wear/generated``.

    Raises
    ------
    UsageError
        with all faults of the contact laws.
    """
    if faults := [fault for law in LAWS.values() for fault in faults_of(law)]:
        raise UsageError("\n".join(faults))
    files = {"__init__.py": _PACKAGE.format(of="")}
    for law in LAWS:
        files[f"{law}/__init__.py"] = _PACKAGE.format(of=f" of the {law} contact law")
    for variant in VARIANTS:
        if not variant.ends_at_3_sigma:
            files[f"{variant.law.name}/{variant.module}.py"] = source(program(variant), "numpy")
    for pin in Pin:
        files[f"margin_{pin}.py"] = source(margin_program(pin), "numpy")
    files["asymptotics.py"] = asymptotics.module()
    files["reaction.py"] = reaction.module()
    return MappingProxyType(files)


def outdated(folder: Path) -> tuple[str, ...]:
    """Return the files under ``folder`` that are missing, different or superfluous."""
    wanted = sources()
    differing = [
        name
        for name, text in wanted.items()
        if not (folder / name).is_file() or (folder / name).read_text(encoding="utf-8") != text
    ]
    present = (p.relative_to(folder).as_posix() for p in folder.rglob("*.py"))
    return (*differing, *sorted(name for name in present if name not in wanted))


def write(folder: Path) -> tuple[str, ...]:
    """Bring ``folder`` up to date; return the files that were written or removed."""
    changed = outdated(folder)
    wanted = sources()
    for name in changed:
        path = folder / name
        if name in wanted:
            path.parent.mkdir(parents=True, exist_ok=True)
            write_atomically(path, wanted[name])
        else:
            path.unlink()
    return changed
