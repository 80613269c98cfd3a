"""Numbers follow the run: a changed run changes them, and none is written into the code."""

from __future__ import annotations

import ast
import dataclasses
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import derive.note.claim_checks
import wear.report
from derive.catalogue import equations
from derive.check import Check
from tests.wear.report import quick
from wear.report.document import Document, Number
from wear.report.paper import paper
from wear.report.verification import Verification
from wear.report.walk import all_prose
from wear.scene import Scene

REPORT = Path(wear.report.__file__).parent
#: Numbers that another run has too: what is asked for, what is quoted, what the mathematics gives.
CONSTANT = re.compile(
    r"scene |the note|printed in the note|request|benchmark|number of cycles|place in the note"
    r"|claim of the note|nomenclature|title|hypothesis|remark|derivation|threshold|check of "
    r"|resolution of the arithmetic|1/\(1 \+ e\^24\)|Eq\. \(4\) at h = 3 sigma|ledger|hard scenes"
    r"|approach, section 4|section [35]$|scenes of section 5|bracket of Eq\. \(16\)"
    r"|catalogue of equations"
)
_RESULT = re.compile(r"\d\.\d|\d[eE]-?\d|\d{3}")


def _changed(value: Any, random: np.random.Generator) -> Any:
    """The value with every floating-point number in it larger; scenes are kept."""
    match value:
        case Scene():
            return value
        case float():
            return value * (1.0 + random.uniform(0.6, 0.9))
        case np.ndarray() if value.dtype.kind == "f":
            return value * (1.0 + random.uniform(0.6, 0.9, value.shape))
        case int() if value > 0:
            return value + 7
        case Mapping():
            return {key: _changed(inner, random) for key, inner in value.items()}
        case tuple() if hasattr(value, "_replace"):
            return type(value)(*(_changed(inner, random) for inner in value))
        case tuple():
            return tuple(_changed(inner, random) for inner in value)
        case _ if dataclasses.is_dataclass(value) and not isinstance(value, type):
            fields = {f.name: getattr(value, f.name) for f in dataclasses.fields(value)}
            kept = {"cycles"}  # those asked for
            return dataclasses.replace(
                value, **{k: _changed(v, random) for k, v in fields.items() if k not in kept}
            )
        case _:
            return value


def _numbers(document: Document) -> Iterator[Number]:
    for text in all_prose(document):
        yield from (piece for piece in text if isinstance(piece, Number))


@pytest.fixture(scope="module")
def other() -> Document:
    """The paper of a run in which everything came out different."""
    found, random = equations(), np.random.default_rng(1)
    trusted = quick.trusted(found)
    checks = tuple(Check(kind, False, "") for kind in ("proof", "sample", "dimensions"))
    outcomes = {**trusted.outcomes, "one more": checks}
    verification = Verification(outcomes, (("1", checks[0]),), trusted.equations + 1)
    runs = _changed(quick.runs(), random)
    measured = tuple(_changed(run, random) for run in quick.measurements())
    return paper(found, verification, runs, quick.few_claims(), measured)


def test_a_changed_run_changes_every_number(other: Document) -> None:
    pairs = zip(_numbers(quick.paper()), _numbers(other), strict=True)
    same = {(a.source, a.value) for a, b in pairs if a.value == b.value}
    assert {number for number in same if not CONSTANT.match(number[0])} == set()


def _modules() -> Iterator[tuple[str, ast.Module]]:
    for path in (*sorted(REPORT.glob("*.py")), Path(derive.note.claim_checks.__file__)):
        yield path.name, ast.parse(path.read_text(encoding="utf-8"))


def test_no_number_is_made_from_a_literal() -> None:
    for name, module in _modules():
        for node in ast.walk(module):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") in ("Number", "mm"):
                value = next(iter(node.args), node)
                names = [n for n in ast.walk(value) if isinstance(n, ast.Name | ast.Attribute)]
                assert names, f"{name}, line {node.lineno}: {ast.unparse(node)}"


def test_the_evidence_for_a_claim_has_no_typed_result() -> None:
    for name, module in _modules():
        if name not in ("claims.py", "claim_checks.py", "reconcile.py"):
            continue
        for node in ast.walk(module):
            if isinstance(node, ast.JoinedStr):
                words = "".join(p.value for p in node.values if isinstance(p, ast.Constant))
                assert not _RESULT.search(words), f"{name}, line {node.lineno}: {words}"
