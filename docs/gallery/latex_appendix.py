"""An appendix of equations: a page of the gallery, run by `docs/_extensions/notebook.py`."""

# %% [markdown]
# # An appendix of equations in LaTeX
#
# Every equation is a macro to `\input` into a report of one's own, and how it follows is prose that
# fits a column, here of 246 pt. Tables, figures and the whole document:
# [in a LaTeX report](../how-to/latex-report.md).

# %%
import subprocess
import sys
import tempfile
from pathlib import Path

with tempfile.TemporaryDirectory() as folder:
    file = Path(folder) / "appendix.tex"
    command = ["latex", "8", "--derivation", "--width", "246pt", "-o", file]
    subprocess.run([sys.executable, "-m", "derive", *command], check=True)
    lines = file.read_text(encoding="utf-8").splitlines()
start = next(n for n, line in enumerate(lines) if "Step" in line)
print(f"{len(lines)} lines, of which")
print("\n".join(lines[start : start + 8]))

# %% [markdown]
# In a notebook an equation shows itself; `.latex` is what the macro holds, `.relation` is a
# relation of SymPy.

# %%
import derive

derive.equation("8")

# %% Wear per cycle and contact pressure in the end, typeset
from matplotlib.figure import Figure

shown = Figure((6.0, 1.8))
for place, name in enumerate(("21", "22")):
    shown.text(0.02, 0.65 - 0.4 * place, f"${derive.equation(name).latex}$", fontsize=13)
shown
