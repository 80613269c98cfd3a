"""A script as a user writes it: nothing but the two packages, every type known to mypy."""

import numpy as np

import derive
import wear

scene: wear.Scene = wear.load_scene("section4").with_({"bearing.roughness_growth": 0.3})
load = wear.Force(force_N=3000.0, period_s=0.06)
history: wear.History = wear.solve(scene, [1, 9000], rtol=1e-8)
deepest: float = float(np.max(history.u_c))
life: tuple[float, ...] = tuple(wear.cycles_until(scene, [1e-3]).cycles.tolist())
many = wear.sweep([scene, scene], np.array([1.0]))
regime: str = wear.asymptote("section4").regime
latex: str = derive.equation("21").latex
history.plot(logarithmic=False).savefig("wear.svg")
