"""A life distribution: a page of the gallery, run by `docs/_extensions/notebook.py`."""

# %% [markdown]
# # A life distribution
#
# Hardness and wear coefficient scatter. After how many cycles has a bearing lost a micrometre, and
# when have ten in a hundred?

# %%
import tempfile
from pathlib import Path

import wear

with tempfile.TemporaryDirectory() as folder:
    results = wear.study(
        "section4",
        ["bearing.hardness_MPa=normal(200,15)", "bearing.wear_coefficient=lognormal(1e-6,2)"],
        [10, 100, 1000, 10_000],
        Path(folder) / "life.zarr",
        design="sobol",
        samples=128,
        seed=1,
        until_wear=1e-3,
    ).load()
print(f"10 % life: {wear.ten_percent_life(results):.0f} cycles")

# %% Median wear with its bands over cycles; below, the share of worn bearings over cycles
wear.picture(results)
