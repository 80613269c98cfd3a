"""How many scenes a second of one core a study solves, by kind of scene.

    python docs/bench/many_scenes.py

Times are of the processor. A chunk of a study is a pure function of its rows, so a cluster of n
cores solves n times as many, less what it takes to hand the chunks over.
"""

from __future__ import annotations

import time

import numpy as np

from wear.scene import load_scene
from wear.studies.rows import Question, solve_rows

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
        question = Question(load_scene(name), CYCLES, None, 1e-7)
        growths = np.linspace(0.2, 0.3, rows)
        solve_rows(question, {"bearing.roughness_growth": growths[:2]})  # imports, caches
        start = time.process_time()
        answers = solve_rows(question, {"bearing.roughness_growth": growths})
        seconds = time.process_time() - start
        assert not answers.status.any()
        print(f"| {kind} | {rows} | {rows / seconds:.0f} |")


if __name__ == "__main__":
    main()
