"""The fields of a scene at the ends of cycles, from the wear that a solver found."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from wear.binding import bind
from wear.direct.loss_of_contact import pressure_share, roundoff
from wear.generated import reaction
from wear.given_load import GivenLoad
from wear.load.spans import span
from wear.model import Fields, Model
from wear.numerics.gauss import FloatArray
from wear.scene import Scene
from wear.scene.notices import implausible_results


def fields_at(model: Model, scene: Scene, cycles: Sequence[int], u: FloatArray) -> Fields:
    """Return the fields at the ends of cycles; at the edge of contact with the acting pressure."""
    acting = [span(scene.load, cycle).load for cycle in cycles]
    U_a = np.array([load(0.0) for load in acting], dtype=float)
    rise = np.array([load.slope(0.0) / load.period for load in acting], dtype=float)
    return fields_under_load(model, u, U_a, rise)


def fields_under_load(model: Model, u: FloatArray, U_a: FloatArray, rise: FloatArray) -> Fields:
    """Return the fields under displacements (mm) that rise by `rise` (mm/s), all of which
    broadcast; at the edge of contact with the acting pressure."""
    fields = model.fields(u, U_a)
    if isinstance(model, GivenLoad) and not model.compliant:
        return fields._replace(U_c=None)  # of the module for springs, here rigid ones
    if not model.ends_at_3_sigma or model.compliant:
        return fields
    closed = model.fields(u, U_a + roundoff(model, u, U_a)).p
    return fields._replace(p=closed * pressure_share(model, u, U_a, rise))


def displacement_of(scene: Scene, u: FloatArray) -> FloatArray | None:
    """Return the displacement of the pin in mm at the ends of cycles, if the load is a force."""
    model = bind(scene)
    if not isinstance(model, GivenLoad):
        return None
    return np.asarray(model.displacement(u, np.full(u.shape, float(scene.periodic_load(0.0)))))


def notices_of_wear(scene: Scene, cycles: Sequence[int], u: FloatArray) -> tuple[str, ...]:
    """Return the notices on a scene and its wear `u` (mm) after `cycles`."""
    model = bind(scene)
    fields = fields_at(model, scene, [0] * len(u), u)  # only their roughness is used
    return (*scene.notices, *result_notices(model, scene, fields, cycles, u))


def result_notices(
    model: Model, scene: Scene, fields: Fields, cycles: Sequence[int], u: FloatArray
) -> tuple[str, ...]:
    """Return the notices on results: the end of the model, and implausible magnitudes."""
    rough = [getattr(fields, name) for name in ("sigma_c", "sigma_a") if name in fields._fields]
    results = implausible_results(scene, cycles, u, *rough)
    return (*negative_roughness(model, fields, u), *results)


def negative_roughness(model: Model, fields: Fields, u: FloatArray) -> tuple[str, ...]:
    """Return a notice for each negative roughness, which the note excludes: the equation squares
    it."""
    initial = model.fields(0.0, 0.0)
    notices = []
    for solid, name in (("bearing", "sigma_c"), ("pin", "sigma_a")):
        if name not in fields._fields:
            continue
        worn, new = getattr(fields, name), float(getattr(initial, name))
        if len(u) and np.min(worn) < 0.0:
            at = int(np.argmin(worn))
            beyond = u[at] * new / (new - worn[at])  # linear in the wear
            notices.append(
                f"the roughness of the {solid} is negative beyond u_c = {beyond:.6g} mm: "
                "the equation takes its square, but the model no longer applies"
            )
    return tuple(notices)


def reaction_of(scene: Scene, pressure: FloatArray) -> FloatArray | None:
    """Return the reaction force of the pin in N, if the scene has the size of the contact."""
    numbers = scene.parameters()
    if "b" not in numbers:
        return None
    return np.asarray(reaction.reaction(pressure, b=numbers["b"], L=numbers["L"]))


def sliding_distance(scene: Scene, cycles: Sequence[int]) -> FloatArray:
    """Return the sliding distance in mm in the cycle that ends after each of the `cycles`."""
    loads = [span(scene.load, max(cycle - 1, 0)).load for cycle in cycles]
    periods = np.array([load.period for load in loads])
    numbers = scene.parameters()
    distance = reaction.sliding_distance(R=numbers["R"], T=periods, n=numbers["n"])
    return np.where(np.asarray(cycles) > 0, distance, np.nan)


def friction_work(scene: Scene, cycles: Sequence[int], mean: FloatArray) -> FloatArray | None:
    """Return the work of friction per area in mJ/mm^2 in the cycle that ends after each of the
    `cycles`, under `mean` pressures in MPa, if the scene has a coefficient of friction."""
    mu = scene.contact.friction_coefficient
    if mu is None:
        return None
    return np.asarray(reaction.friction_work(mean, sliding_distance(scene, cycles), mu))
