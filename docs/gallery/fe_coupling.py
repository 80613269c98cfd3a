"""In a finite element code: a page of the gallery, run by `docs/_extensions/notebook.py`."""

# %% [markdown]
# # In a finite element code
#
# A finite element code knows the structure; of the model it needs two subroutines, generated in C
# and Fortran: the contact pressure with its stiffness, and what a time increment adds to the wear
# of a node. Here they are compiled with `gcc`, and the structure is a row of 21 nodes, a bearing
# that bends under a tilted pin. As UINTER and UMESHMOTION of Abaqus:
# [in a finite element code](../how-to/finite-elements.md).

# %%
import ctypes
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import wear

with tempfile.TemporaryDirectory() as folder:
    source, library = Path(folder) / "wear_model.c", Path(folder) / "wear_model.so"
    command = ["code", "rigid_bearing", "--target", "c", "-o", source]
    subprocess.run([sys.executable, "-m", "derive", *command], check=True)
    subprocess.run(["gcc", "-O2", "-shared", "-fPIC", "-o", library, source, "-lm"], check=True)
    model = ctypes.CDLL(str(library))
number, pointer = ctypes.c_double, ctypes.POINTER(ctypes.c_double)
model.wear_contact_pressure.argtypes = [number] * 3 + [pointer] * 2
model.wear_increment.argtypes = [number] * 6 + [pointer] * 2

scene = wear.load_scene("section4")
data = scene.parameters()
slip_rate = 2 * np.pi * data["R"] * data["n"] / 60


def contact(h, sigma):
    """Return pressures (MPa) and stiffnesses (MPa/mm) of all nodes."""
    found = np.empty((2, len(h)))
    p, slope = ctypes.c_double(), ctypes.c_double()
    for node in range(len(h)):
        model.wear_contact_pressure(h[node], sigma[node], data["p_max"], p, slope)
        found[:, node] = p.value, slope.value
    return found


def worn(pressure, seconds, u, sigma):
    """Return wear and roughness (mm) of all nodes after a time increment."""
    state = [(ctypes.c_double(a), ctypes.c_double(b)) for a, b in zip(u, sigma, strict=True)]
    for p, (depth, rough) in zip(pressure, state, strict=True):
        model.wear_increment(p, slip_rate, seconds, data["K_c"], data["H_c"], data["f_c"],
                             depth, rough)  # fmt: skip
    return np.array([[depth.value, rough.value] for depth, rough in state]).T


# %% [markdown]
# The structure: springs under every node and between neighbours. Each increment is solved by
# Newton's method, in which the stiffness of the contact enters.


# %%
def cycles(number_of_cycles, tilt, stiffness, increments=200):
    """Yield the wear (mm) of all nodes after each cycle."""
    nodes = len(tilt)
    K = stiffness * (3.0 * np.eye(nodes) - np.eye(nodes, k=1) - np.eye(nodes, k=-1))
    u, sigma, bent = np.zeros(nodes), np.full(nodes, data["sigma_c0"]), np.zeros(nodes)
    phases = (np.arange(increments) + 0.5) / increments
    for _ in range(number_of_cycles):
        for U_a in scene.load(phases):
            for _ in range(3):
                p, slope = contact(data["h_0"] + u + bent - U_a + tilt, sigma)
                bent += np.linalg.solve(K - np.diag(slope), p - K @ bent)
            u, sigma = worn(p, data["T"] / increments, u, sigma)
        yield u


(flat,) = cycles(1, np.zeros(1), stiffness=1e9, increments=2000)
print(f"one node, one cycle: {1e6 * flat[0]:.2f} nm")
print(f"wear.solve:          {1e6 * wear.solve(scene, 1).u_c[0]:.2f} nm")

# %% Wear over the width of the bearing after 1, 5 and 20 cycles, deeper where the pin is lower
from matplotlib.figure import Figure

across = np.linspace(0.0, 20.0, 21)
depths = dict(enumerate(cycles(20, tilt=2e-5 * across, stiffness=3e5, increments=40), start=1))
drawn = Figure((5.0, 3.0), layout="constrained")
axes = drawn.subplots()
for n in (1, 5, 20):
    axes.plot(across, 1e3 * depths[n], label=f"after cycle {n}")
axes.set(xlabel="Across the bearing (mm)", ylabel="Bearing wear (µm)")
axes.legend()
drawn
