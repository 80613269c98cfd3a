"""A scene of one's own: a page of the gallery, run by `docs/_extensions/notebook.py`."""

# %% [markdown]
# # A scene of one's own
#
# A hard bearing on a small shaft, its surface run in to 0.2 µm. Omitted tables (pin, support)
# are not modelled; units are in the names.

# %%
import wear

scene = wear.Scene(
    title="A hard bearing",
    bearing=wear.Bearing(
        hardness_MPa=1200.0, wear_coefficient=3e-7, roughness_mm=2e-4, roughness_growth=0.1
    ),
    contact=wear.Contact(max_pressure_MPa=400.0, closure_in_sigma=3.0),
    motion=wear.Motion(radius_mm=10.0, speed_rpm=600.0),
    load=wear.Sine(amplitude_mm=3e-4, period_s=0.1),
)
cycles = [10**k for k in range(9)]
history = wear.solve(scene, cycles)
for cycle, depth in zip(cycles[::4], history.u_c[::4], strict=True):
    print(f"{cycle:>9}  {1e3 * depth:8.4f} µm")

# %% Wear, roughness and pressure over the logarithm of the cycles
history.plot()
