"""What is written does not depend on the order of sets: another process writes the same."""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys

from derive import catalogue
from derive.codegen.emit import TARGETS
from derive.codegen.sources import source
from derive.coq import export
from derive.program import program
from derive.variant import VARIANTS

EXPORTED = ("general-law", "closure-ratio")
"""Equations whose proofs once were written otherwise under the seeds 0 and 2."""


def written() -> list[str]:
    """Return a hash of every source of some variants, and of every file of an export."""
    texts = [source(program(v), target) for v in VARIANTS[::11] for target in TARGETS]
    texts += [
        text for text, _ in export.Export(tuple(map(catalogue.equation, EXPORTED))).files.values()
    ]
    return [hashlib.sha256(text.encode()).hexdigest() for text in texts]


def test_what_is_written_does_not_depend_on_the_hash_seed():
    code = f"from {__name__} import written; print(*written())"
    env = os.environ | {"PYTHONHASHSEED": str(2 * (hash("seed") % 2))}
    done = subprocess.run([sys.executable, "-c", code], env=env, capture_output=True, text=True)
    assert done.stdout.split() == written(), done.stderr
