"""A measured load: a page of the gallery, run by `docs/_extensions/notebook.py`."""

# %% [markdown]
# # A measured load
#
# The load of `docs/examples/table.toml` is a file beside it, with the columns `t_s,U_a_mm`: one
# period of a motion that was measured. It repeats, so any number of cycles is as cheap as one.

# %%
import wear

scene = wear.load_scene("table.toml")
for cycle, depth in zip([1, 10**6], wear.solve(scene, [1, 10**6]).u_c, strict=True):
    print(f"{cycle:>8}  {1e3 * depth:.5f} µm")

# %% Contact pressure over the phase of the first, the hundredth and the ten thousandth cycle
wear.plot_pressure(scene, [0, 100, 10_000])
