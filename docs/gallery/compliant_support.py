"""A bearing on springs: a page of the gallery, run by `docs/_extensions/notebook.py`."""

# %% [markdown]
# # A bearing on springs
#
# The pressure deflects the bearing, and is then the root of an equation at every instant. Springs
# spread the load: the softer they are, the smaller the first cycles' wear. In the long run they
# do not matter.

# %%
import wear

rigid = wear.load_scene("section4")
scenes = {
    "rigid": rigid,
    "1e5 MPa/mm": rigid.with_({"support": {"stiffness_MPa_per_mm": 1e5}}),
    "1e4 MPa/mm": rigid.with_({"support": {"stiffness_MPa_per_mm": 1e4}}),
}
for name, scene in scenes.items():
    print(f"{name:<11} {wear.asymptote(scene).wear_per_cycle_mm:.9e} mm per cycle in the end")

# %% Wear, roughness and pressure for three stiffnesses over the logarithm of the cycles
cycles = sorted({round(10 ** (k / 4)) for k in range(17)})
wear.plot({name: wear.solve(scene, cycles) for name, scene in scenes.items()})
