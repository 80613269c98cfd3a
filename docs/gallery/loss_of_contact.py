"""Loss of contact: a page of the gallery, run by `docs/_extensions/notebook.py`."""

# %% [markdown]
# # Loss of contact
#
# The note's text ends contact at $h > 3\bar\sigma$, its equations do not. That decides whether
# wear goes on for ever.

# %%
import wear

law = wear.load_scene("section4")
cut = law.with_({"contact.ends_at_3_sigma": True})
for name, scene in (("by the equations", law), ("by the text", cut)):
    print(f"{name:<17} {wear.asymptote(scene).regime}")

# %% Bearing wear with and without loss of contact over the logarithm of the cycles
from wear.figure_data import WEAR, Line, Panel
from wear.figures import history as drawn

cycles = [round(10 ** (k / 4)) for k in range(2, 17)]
lines = [
    Line(name, history.cycles.astype(float), history.u_c, family)
    for family, (name, scene) in enumerate((("without end", law), ("with loss", cut)))
    for history in [wear.solve(scene, cycles)]
]
drawn([Panel(WEAR, tuple(lines))], logarithmic=True)
