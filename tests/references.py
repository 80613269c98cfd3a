"""What was found independently: numbers of up to 40 digits, and the verdict on each claim."""

import json
from pathlib import Path
from typing import Any

from derive.note.claims import Verdict

DATA = Path(__file__).parent / "data"
VALUES: dict[str, Any] = json.loads((DATA / "values.json").read_text())

_CLAIMS = {
    Verdict.CONFIRMED: "2 3 5 6 10 11 12 13 15 20 21 28 30 33",
    Verdict.CONDITIONAL: "8 9 14 16 22 23 25 26 29 31 39",
    Verdict.NOT_REPRODUCIBLE: "17 34 35 36 37",
    Verdict.INCONSISTENT: "1 4 7 18 19 40 41",
    Verdict.REFUTED: "24 27 32 38",
}
VERDICTS = {f"C{n}": verdict for verdict, numbers in _CLAIMS.items() for n in numbers.split()}
