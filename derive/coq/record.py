"""The record: what Coq closed, by the hash of its statement; for users who have no Coq.

Key results
    record           all of it
    proved_by_coq    whether a judgement is closed
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from ..kernel import Judgement
from .printer import UntranslatableError
from .statements import key

RECORD = Path(__file__).parent / "record.json"

Row = dict[str, Any]
Record = Mapping[str, Row]


@cache
def record() -> Record:
    """Return the committed record: closed, and by which way; or why not."""
    rows: Record = json.loads(RECORD.read_text(encoding="utf-8"))
    return rows


def proved_by_coq(judgement: Judgement) -> bool:
    """Return whether Coq has closed a judgement, as the record has it."""
    try:
        return bool(record().get(key(judgement), {}).get("closed"))
    except UntranslatableError:
        return False
