"""The generated module that a scene needs, and the numbers of the scene that the module has."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal, NamedTuple

KEYS: Mapping[str, tuple[str, str]] = {
    "K_c": ("bearing", "wear_coefficient"),
    "H_c": ("bearing", "hardness_MPa"),
    "sigma_c0": ("bearing", "roughness_mm"),
    "f_c": ("bearing", "roughness_growth"),
    "K_a": ("pin", "wear_coefficient"),
    "H_a": ("pin", "hardness_MPa"),
    "sigma_a0": ("pin", "roughness_mm"),
    "f_a": ("pin", "roughness_growth"),
    "p_max": ("contact", "max_pressure_MPa"),
    "h_0": ("contact", "closure_mm"),
    "k": ("support", "stiffness_MPa_per_mm"),
    "R": ("motion", "radius_mm"),
    "n": ("motion", "speed_rpm"),
}
"""Table and key of each parameter in a scene file, by symbol; without those of the load."""
PIN_PARAMETERS = {
    "bearing": (),
    "rough": ("sigma_a0",),
    "worn": ("K_a", "H_a"),
    "worn_rough": ("K_a", "H_a", "sigma_a0", "f_a"),
}
"""The parameters of the pin that the generated module has, by the pin's state."""


class VariantKey(NamedTuple):
    """The key of the generated module of a scene, `wear.generated.<law>.<module>`; users see the
    `name` of the variant.

    >>> key = VariantKey("tanh", "compliant", "worn_rough", ends_at_3_sigma=True)
    >>> key.module, key.name
    ('compliant_worn_rough', 'compliant_worn_rough_ends_at_3_sigma')
    """

    law: str
    support: Literal["rigid", "compliant"]
    pin: Literal["bearing", "rough", "worn", "worn_rough"]
    ends_at_3_sigma: bool
    given_load: bool = False

    @property
    def module(self) -> str:
        return f"{self.support}_{self.pin}"

    @property
    def name(self) -> str:
        if self.given_load:
            return f"given_load_{self.pin}"
        return self.module + "_ends_at_3_sigma" * self.ends_at_3_sigma
