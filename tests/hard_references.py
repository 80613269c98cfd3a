"""Writes `wear/data/reference.json`, the true wear that `wear bench` measures errors against.

    python -m tests.hard_references

The note's scenes: from `tests/data/cycles.json`. The hard cases: by
`tests.judges`, Taylor series in fixed-point arithmetic, to double precision, as far as
they go in minutes; beyond, by exact relations: a scene in other units, wear that has stopped, a
contact so weak that wear is linear in it (an integral of the exponential, a Bessel function), and
for 1e9 cycles the long-time expansion of the wear, started from the reference value at 1e8.
"""

import json
import math
from pathlib import Path

import mpmath

from tests.judges import problem, true_wear
from tests.wear.reference_scenes import REFERENCE
from wear.scene import hard_names, load_scene

TARGET = Path(__file__).parents[1] / "wear" / "data" / "reference.json"
INTEGRATED = (1, 10, 100)
ARRESTED = (10**6, 10**9)
FAR = (9000, 10**6, 10**8)

NOTE_SCENES = {
    "section3": ("S1", "section3", []),
    "section4": ("S2", "section4", []),
    "fast-wear": ("S4", "fast-wear", []),
    "f-one-eighth": ("S5", "f-one-eighth", []),
    "f-negative": ("S6", "section4", ["bearing.roughness_growth=-0.05"]),
    "section3-support": ("S8_1", "section3", ["support.stiffness_MPa_per_mm=1e5"]),
    "section4-support": ("S8_2", "section4", ["support.stiffness_MPa_per_mm=1e5"]),
}


def note_cases() -> dict[str, object]:
    """The speed comparison: scene, overrides and wear, by name."""
    return {
        name: {"scene": scene, "set": overrides, "u_c_mm": wear_table(REFERENCE[label])}
        for name, (label, scene, overrides) in NOTE_SCENES.items()
    }


def wear_table(wear: dict[int, float]) -> dict[str, float]:
    return {str(cycles): wear[cycles] for cycles in sorted(wear)}


def hard_case(name: str) -> dict[int, float]:
    """The wear of a scene of the hard catalogue."""
    scene = load_scene(name)
    if name == "deep-tail":
        return {cycles: linear(name, cycles) for cycles in (*INTEGRATED, *FAR)}
    found = dict(zip(INTEGRATED, true_wear(scene, INTEGRATED).tolist(), strict=True))
    if scene.contact.ends_at_3_sigma:
        if found[10] == found[100]:
            found |= dict.fromkeys(ARRESTED, found[100])
        return found
    same = {"fast-wear": ("S4", 1), "f-one-eighth": ("S5", 1)}
    same |= {"scaled-up": ("S2", 1e6), "scaled-down": ("S2", 1e-6)}
    if name in same:
        label, factor = same[name]
        known = {n: REFERENCE[label][n] * factor for n in REFERENCE[label]}
        for cycles in INTEGRATED:
            assert math.isclose(known[cycles], found[cycles], rel_tol=4e-15), (name, cycles)
        found |= {n: known[n] for n in FAR if n in known}
    return found


def linear(name: str, cycles: int) -> float:
    """Wear where p/p_max = exp(8 - 4 h/sigma) to hundreds of digits and nothing changes."""
    data = problem(load_scene(name))
    s = mpmath.mpf(data.roughness)
    pressure = mpmath.exp(8 - 4 * mpmath.mpf(data.closure) / s)
    mean = mpmath.besseli(0, 4 * mpmath.mpf(data.sine[0]) / s)
    return float(cycles * data.wear_rate * data.period * pressure * mean)


def onward(wear: float, cycles: int, to: int) -> float:
    """Wear of section4 after `to` cycles from that after `cycles`, by the long-time expansion.

    s = m + w1/m + w2/m^2 at whole cycles; rho tau + const = m - c1 ln m + ... to m^-2.
    """
    data = problem(load_scene("section4"))
    with mpmath.workdps(40):
        s0, f, U = map(mpmath.mpf, (data.roughness, data.slope, data.sine[0]))
        theta = mpmath.tanh(4 - 2 / f)
        b = s0 / f - mpmath.mpf(data.closure)
        rho = f * mpmath.mpf(data.wear_rate) * data.period * (1 + theta) / 2
        a = 1 - theta
        c1 = 2 * a * b
        c2 = -2 * theta * a * (U**2 + 2 * b**2)
        c3 = mpmath.mpf(4) / 3 * b * a * (3 * theta**2 - 1) * (3 * U**2 + 2 * b**2)
        w1 = -a * U * rho / mpmath.pi
        w2 = a * U * rho * 8 * mpmath.pi * b * theta / (2 * mpmath.pi**2)

        def time(m: mpmath.mpf) -> mpmath.mpf:
            rest = (c1**3 - 2 * c1 * c2 + c3) / (2 * m**2)
            return m - c1 * mpmath.log(m) + (c2 - c1**2) / m + rest

        def roughness(m: mpmath.mpf) -> mpmath.mpf:
            return m + w1 / m + w2 / m**2

        s = s0 + f * mpmath.mpf(wear)
        m = mpmath.findroot(lambda m: roughness(m) - s, s)
        later = time(m) + rho * (to - cycles)
        m = mpmath.findroot(lambda m: time(m) - later, s + rho * (to - cycles))
        return float((roughness(m) - s0) / f)


def main() -> None:
    hard = {}
    for name in hard_names():
        hard[name] = {"scene": name, "set": [], "u_c_mm": wear_table(hard_case(name))}
        print(name, hard[name]["u_c_mm"], flush=True)
    S2 = REFERENCE["S2"]
    assert math.isclose(onward(S2[10**6], 10**6, 10**8), S2[10**8], rel_tol=2e-8)
    billion = {10**9: onward(S2[10**8], 10**8, 10**9)}
    hard["a-billion-cycles"] = {"scene": "section4", "set": [], "u_c_mm": wear_table(billion)}
    document = {
        "quantity": "bearing wear u_c(N T) in mm after N cycles",
        "source": "tests/hard_references.py",
        "speed": note_cases(),
        "hard": hard,
    }
    TARGET.parent.mkdir(exist_ok=True)
    TARGET.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
