"""A contact law of one's own: a page of the gallery, run by `docs/_extensions/notebook.py`."""

# %% [markdown]
# # A contact law of one's own
#
# A law is one formula, $\phi(r)$ with $r = h/\bar\sigma$. That it is positive and decreasing is
# proved, the equations are derived from it and code is generated, once for this user. More of it:
# [a contact law of your own](../how-to/own-contact-law.md).

# %%
import wear

scenes = {
    "tanh, as in the note": wear.load_scene("section4"),
    "fades slowly": wear.load_scene("section4").with_(
        {"contact.law": {"phi": "1/(1 + exp(r - 1))^2"}}
    ),
}
for name, scene in scenes.items():
    limit = wear.asymptote(scene)
    print(f"{name:21}  {limit.pressure_MPa:.4g} MPa in the end")

# %% Wear, roughness and pressure over the logarithm of the cycles under two contact laws
import numpy as np

cycles = np.unique(np.rint(np.geomspace(1, 10**5, 60)))
wear.plot({name: wear.solve(scene, cycles, rtol=1e-6) for name, scene in scenes.items()})
