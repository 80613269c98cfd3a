"""A scene's model runs the generated code that the scene needs, and nothing else."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from wear.binding import bind, bind_many
from wear.faults import UsageError
from wear.scene import Scene, load_scene
from wear.solver import solve

SCENES = {
    "section4": (),
    "section3": (),
    "section3-physical": (),
    "section4-cutoff": (),
    "section3-cutoff": (),
    "soft-support": (),
    "stiff-support": (),
}
COMPLIANT_CUTOFF = ("support.stiffness_MPa_per_mm=1e5",)


def _scenes() -> list[Scene]:
    made = [load_scene(name, overrides) for name, overrides in SCENES.items()]
    made.append(load_scene("section4-cutoff", COMPLIANT_CUTOFF))
    made.append(load_scene("section3", ("pin.wear_coefficient=0.0",)))
    made.append(load_scene("section4", ("contact.law=exponential",)))
    return made


@pytest.mark.parametrize("scene", _scenes(), ids=lambda s: f"{s.variant.law} {s.variant.name}")
@given(wear=st.floats(0.0, 2e-3), load=st.floats(-5e-4, 5e-4))
def test_the_slope_is_the_derivative_of_the_rate(scene: Scene, wear: float, load: float) -> None:
    model = bind(scene)
    step = 1e-8
    above, below = model.rate(wear + step, load), model.rate(wear - step, load)
    if model.ends_at_3_sigma and model.compliant:
        edges = [model.margin(wear + d, load) for d in (-step, step)]
        fields = [model.fields(wear + d, load) for d in (-step, step)]
        kinks = [np.sign(m) for m in edges] + [f.h >= 3 * f.sigma * (1 - 1e-12) for f in fields]
        assume(kinks[0] == kinks[1] and kinks[2] == kinks[3])
    quotient = (above - below) / (2 * step)
    scale = abs(float(model.rate(wear, load))) / 1e-4 + 1e-290
    assert float(model.slope(wear, load)) == pytest.approx(quotient, rel=1e-4, abs=1e-5 * scale)


@pytest.mark.parametrize("scene", _scenes(), ids=lambda s: f"{s.variant.law} {s.variant.name}")
def test_the_fields_satisfy_the_governing_equations(scene: Scene) -> None:
    """(1), (2), (3), (5) hold among the fields, whatever code made them."""
    numbers = scene.parameters()
    model = bind(scene)
    u, load = np.linspace(0.0, 1e-3, 7)[:, None], np.linspace(-5e-4, 5e-4, 9)
    found = model.fields(u, load)
    sign = 1.0 if scene.contact.pin_wear_opens_gap else -1.0
    U_c, u_a, sigma_a = (getattr(found, name, 0.0) for name in ("U_c", "u_a", "sigma_a"))
    closure = numbers["h_0"] + u + U_c + sign * u_a - load
    np.testing.assert_allclose(found.h, closure, rtol=1e-13, atol=1e-18)
    if model.compliant:
        np.testing.assert_allclose(found.U_c * numbers["k"], found.p, rtol=1e-12)
    combined = np.hypot(sigma_a, found.sigma_c)
    np.testing.assert_allclose(found.sigma + 0.0 * combined, combined, rtol=1e-14)
    rate = np.asarray(model.rate(u, load))
    wear_rate = numbers["K_c"] * found.p * np.pi * numbers["R"] * numbers["n"] / 90 / numbers["H_c"]
    inside = found.p > 0.0
    np.testing.assert_allclose(rate[inside], wear_rate[inside], rtol=1e-13)


def test_a_scene_has_only_the_operations_that_it_needs() -> None:
    section4, section3 = bind(load_scene("section4")), bind(load_scene("section3"))
    assert section4.operations["rate"] < section3.operations["rate"]
    assert not {"residual", "margin"} & set(section4.operations)
    assert "residual" in bind(load_scene("soft-support")).operations
    assert "margin" in bind(load_scene("section4-cutoff")).operations


def test_many_scenes_at_once_are_each_of_them() -> None:
    scenes = [load_scene("section3", [f"bearing.wear_coefficient={K}"]) for K in (1e-7, 1e-6, 1e-5)]
    many, loads = bind_many(scenes), np.linspace(-5e-4, 5e-4, 5)
    each = np.stack([bind(scene).rate(1e-4, loads) for scene in scenes])
    np.testing.assert_array_equal(many.rate(np.full((3, 1), 1e-4), loads), each)


def test_scenes_of_different_variants_are_not_solved_together() -> None:
    with pytest.raises(UsageError, match="same"):
        bind_many([load_scene("section3"), load_scene("section4")])


def test_the_reaction_of_the_pin_is_given_where_the_contact_has_a_size() -> None:
    scene = load_scene("section4", ["contact.width_mm=20.0", "contact.length_mm=30.0"])
    history = solve(scene, [1, 10], rtol=1e-8)
    assert history.R_a is not None
    np.testing.assert_allclose(history.R_a, history.p * 600.0, rtol=1e-15)
    assert solve(load_scene("section4"), [1], rtol=1e-8).R_a is None
