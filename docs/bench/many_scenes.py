"""How many scenes a second of one core a study solves, by kind of scene.

    python docs/bench/many_scenes.py

Times are of the processor. A chunk of a study is a pure function of its rows, so a cluster of n
cores solves n times as many, less what it takes to hand the chunks over.
"""

from __future__ import annotations

import time

from wear.studies.rows import solve_rows
from wear.studies.run import prepare

CYCLES = (9_000, 1_000_000)
KINDS = {  # scene, number of rows
    "smooth": ("section4", 1024),
    "compliant support": ("soft-support", 512),
    "loss of contact": ("section4-cutoff", 32),
}


def main() -> None:
    """Print a table."""
    print("| scenes | rows | scenes a second of one core |\n| --- | ---: | ---: |")
    for kind, (name, rows) in KINDS.items():
        vary = [f"bearing.roughness_growth=0.2:0.3:{rows}"]
        asked = prepare(name, vary, CYCLES, "grid", 0, 0, None, 1e-7)
        solve_rows(asked, asked.design.some(2))  # imports, caches
        start = time.process_time()
        answers = solve_rows(asked, asked.design.columns((slice(0, rows),)))
        seconds = time.process_time() - start
        assert not answers.status.any()
        print(f"| {kind} | {rows} | {rows / seconds:.0f} |")


if __name__ == "__main__":
    main()
