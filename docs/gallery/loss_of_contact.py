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

# %% Wear, roughness and pressure with and without loss of contact, and the share of contact
cycles = [round(10 ** (k / 4)) for k in range(2, 17)]
wear.plot({"without end": wear.solve(law, cycles), "with loss": wear.solve(cut, cycles)})
