"""The fields of a scene at the ends of cycles, from the wear that a solver found."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from wear.binding import bind
from wear.direct.loss_of_contact import pressure_share, roundoff
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


@np.errstate(invalid="ignore", over="ignore")  # no roughness; a closure far below zero
def fields_under_load(model: Model, u: FloatArray, U_a: FloatArray, rise: FloatArray) -> Fields:
    """Return the fields under displacements (mm) that rise by `rise` (mm/s), all of which
    broadcast; at the edge of contact with the acting pressure."""
    fields = model.fields(u, U_a)
    if isinstance(model, GivenLoad) and not model.compliant:
        fields = fields._replace(U_c=None)  # of the module for springs, here rigid ones
    elif model.ends_at_3_sigma and not model.compliant:
        closed = model.fields(u, U_a + roundoff(model, u, U_a)).p
        fields = fields._replace(p=closed * pressure_share(model, u, U_a, rise))
    return in_shape(fields, np.broadcast_shapes(u.shape, U_a.shape))


def in_shape(fields: Fields, shape: tuple[int, ...]) -> Fields:
    """Return fields with values for all states, also of one that does not change."""
    return fields._make(
        value if value is None or np.shape(value) == shape else np.full(shape, value)
        for value in fields
    )


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
