"""A map over two parameters: a page of the gallery, run by `docs/_extensions/notebook.py`."""

# %% [markdown]
# # A map over $K$ and $f_c$
#
# A study solves one scene for many values of its numbers. Here 400 scenes, after a million cycles
# each; more of it: [many scenes, many machines](../how-to/studies.md).

# %%
import tempfile
from pathlib import Path

import wear

with tempfile.TemporaryDirectory() as folder:
    results = wear.study(
        "section4",
        ["bearing.roughness_growth=0.1:0.4:20", "bearing.wear_coefficient=1e-8:1e-5:20:log"],
        [1_000_000],
        Path(folder) / "map.zarr",
    ).load()
print(dict(results.sizes))

# %% Bearing wear after a million cycles over roughness growth and wear coefficient, as colours
wear.picture(results)
