"""The tour; `python docs/_extensions/notebook.py docs/tour.py` runs it into tour.ipynb."""

# %% [markdown]
# # A tour
#
# From an equation of the note to the wear after a billion cycles. Each cell below was run; the
# notebook is `docs/tour.ipynb`, written from `docs/tour.py`.
#
# ## An equation, and its derivation
#
# The note's equation (21) gives the wear per cycle once everything has settled.

# %%
import derive

wear_per_cycle = derive.equation("21")
wear_per_cycle.relation

# %% [markdown]
# It is a SymPy relation, with a status and the hypotheses that it needs:

# %%
print(wear_per_cycle.status.value)
print(*(condition.text for condition in wear_per_cycle.conditions), sep="\n")

# %% [markdown]
# It was not typed in. It follows, statement by statement, from the governing equations, and every
# statement is checked by applying its rule again.

# %%

for statement in wear_per_cycle.steps[-3:]:
    labels = [parent.name or "a hypothesis" for parent in statement.parents]
    print(f"- {statement.rule.sentence(*labels)}")

(verdict,) = derive.verify(["21"])
print("every check passed:", verdict.passed)

# %% [markdown]
# Not every equation of the note survives that. Those that do not hold as printed:

# %%
for found in derive.all_equations():
    if found.status.value == "corrected":
        print(f"({found.id})  {found.remark}")

# %% [markdown]
# ## A scene
#
# `section4` has the data of the note's section 4: a smooth pin, a bearing that wears and becomes
# rougher by a quarter of what it loses.

# %%
import wear

scene = wear.load_scene("section4")
scene.bearing

# %% [markdown]
# ## Any number of cycles
#
# One number is the state and the load repeats, so a billion cycles cost as much as a thousand.
# `error` is the estimated relative error of the bearing's wear.

# %%
history = wear.solve(scene, [1, 9000, 1e6, 1e9])
for cycle, depth, error in zip(history.cycles, history.u_c, history.error, strict=True):
    print(f"{cycle:>10}  {depth:.10e} mm  within 1e-10: {error < 1e-10}")

assert history.cost["cycles_integrated"] < 200  # all that was integrated for a billion

# %% [markdown]
# ## Is the note's asymptote one?
#
# The note's (19) says that wear tends to a straight line. The derivation says: a straight line and
# a logarithm,
# $u_c(NT) = u_{\mathrm{cum}} N + A \ln N + B + o(1)$.

# %%
long_time = wear.asymptote(scene)
print(f"per cycle       {long_time.wear_per_cycle_mm:.12e} mm")
print(f"log coefficient {long_time.log_coefficient_mm:.12e} mm")

# %% [markdown]
# The difference from the straight line keeps growing, by the same amount
# for each factor of ten in the number of cycles, as soon as that number is large:

# %%
import numpy as np

cycles = np.array([10**exponent for exponent in range(4, 13)])
depth = wear.solve(scene, cycles.tolist()).u_c
left = depth - long_time.wear_per_cycle_mm * cycles
steps = np.diff(left) / (long_time.log_coefficient_mm * np.log(10.0))
print("growth per decade, as a multiple of A ln 10:")
print(*(f"{step:.4f}" for step in steps))

# %% The wear without the straight line, over the logarithm of the cycles
from matplotlib.figure import Figure

drawn = Figure((5.0, 3.0), layout="constrained")
axes = drawn.subplots()
axes.semilogx(cycles, 1e3 * left, "o-")
axes.set(xlabel="Cycles $N$", ylabel="$u_c$ without the line (µm)")
drawn

# %% [markdown]
# ## Many scenes at once
#
# The note's Fig. 3b compares four wear coefficients. That is one call, and so are four hundred:

# %%
names = ["section5-k1e-7", "section5", "section5-k1e-5", "section5-k1e-4"]
found = wear.sweep([wear.load_scene(name) for name in names], np.array([100.0, 9000.0]))
for name, row in zip(names, found.u_c, strict=True):
    print(f"{name:<15} {row[0]:.6e}  {row[1]:.6e}  mm")
