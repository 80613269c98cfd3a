"""Write paper.md, replication.md and paper.bib from the claims of a finished report.

    make reproduce
    cp report/claims.json docs/papers && python docs/papers/build.py

Numbers and verdicts stand in the templates (`*.md.in`) as values: nothing of them is typed.
"""

from __future__ import annotations

import json
from collections import Counter
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from wear.cite import REFERENCES, bibtex

HERE = Path(__file__).resolve().parent
PAPERS = ("paper.md", "replication.md")


def built(claims: list[dict[str, Any]]) -> dict[str, str]:
    """Return the papers by name of the file."""
    environment = Environment(
        loader=FileSystemLoader(HERE),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    counts = Counter(claim["verdict"] for claim in claims)
    by_id = {claim["id"]: claim["evidence"] for claim in claims}
    values = {"claims": claims, "counts": counts, "evidence": by_id, "total": len(claims)}
    papers = {name: environment.get_template(f"{name}.in").render(values) for name in PAPERS}
    return {**papers, "paper.bib": "\n\n".join(map(bibtex, REFERENCES.values())) + "\n"}


if __name__ == "__main__":
    judged = json.loads((HERE / "claims.json").read_text(encoding="utf-8"))
    for name, text in built(judged).items():
        (HERE / name).write_text(text, encoding="utf-8")
