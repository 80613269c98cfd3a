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

# %% Bearing wear for three stiffnesses over the logarithm of the cycles
from wear.figure_data import WEAR, Line, Panel
from wear.figures import history as drawn

cycles = [round(10 ** (k / 4)) for k in range(17)]
lines = [
    Line(name, history.cycles.astype(float), history.u_c, family)
    for family, (name, scene) in enumerate(scenes.items())
    for history in [wear.solve(scene, sorted(set(cycles)))]
]
drawn([Panel(WEAR, tuple(lines))], logarithmic=True)
