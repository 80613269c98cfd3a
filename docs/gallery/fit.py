"""A fit to measurements: a page of the gallery, run by `docs/_extensions/notebook.py`."""

# %% [markdown]
# # A fit to measurements
#
# Eight readings of the wear depth (`docs/examples/readings.csv`, made with $K = 10^{-6}$,
# $f_c = 0.25$ and a scatter of 4 %). Which wear coefficient and which roughness growth does the
# contact have, and how deep is it worn after a million cycles? More of it:
# [parameters from measured wear](../how-to/fit.md).

# %%
import wear

free = ["bearing.wear_coefficient", "bearing.roughness_growth"]
found = wear.fit("readings.csv", "section4", free)
for parameter, estimate, profile in zip(
    found.parameters, found.estimates, found.profiles, strict=True
):
    low, high = profile.interval
    print(f"{parameter.key:24}  {estimate:.3g}, 95 % from {low:.3g} to {high:.3g}")
(far,) = found.forecast([10**6])
print(f"after 1e6 cycles: {1e3 * far.bearing_wear_mm:.1f} µm, 95 % from", end=" ")
print(" to ".join(f"{1e3 * end:.1f} µm" for end in far.interval_95))

# %% Readings with the fitted wear and its 95 % band over cycles; below, the residuals
found.plot()
