"""Variants: what a scene needs, and nothing else.

Key results
    Variant     law, support, pin, sign of pin wear, cutoff
    VARIANTS    every variant that code is generated for
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

from .laws import LAWS, ContactLaw
from .note.governing import Model, Pin


@dataclass(frozen=True)
class Variant:
    """A choice of what is modelled.

    >>> Variant(LAWS["tanh"], compliant=False, pin=Pin.WORN, opening=True, cutoff=True).module
    'rigid_worn_opening_cutoff'
    """

    law: ContactLaw
    compliant: bool
    pin: Pin
    opening: bool
    cutoff: bool

    @property
    def module(self) -> str:
        """Return the name of the generated module, within the package of its law."""
        parts = ["compliant" if self.compliant else "rigid", self.pin.value]
        return "_".join(parts + ["opening"] * self.opening + ["cutoff"] * self.cutoff)

    @property
    def model(self) -> Model:
        """Return the hypotheses that the variant rests on."""
        return Model(self.law, self.opening, self.pin)

    @property
    def equations(self) -> tuple[str, ...]:
        """Return the ids of the equations that the variant's code comes from."""
        condensed = ("8", "9") if self.compliant else ("10",)
        bearing_only = self.pin is Pin.ABSENT and not self.compliant
        return ("1", "2b", "3", "4", "5", "6", *(("13",) if bearing_only else condensed))


def _signs(pin: Pin) -> tuple[bool, ...]:
    """The sign of pin wear matters only where the pin wears."""
    return (False, True) if pin.wears else (False,)


VARIANTS = tuple(
    Variant(law, compliant, pin, opening, cutoff)
    for law, compliant, pin, cutoff in product(LAWS.values(), (False, True), Pin, (False, True))
    for opening in _signs(pin)
)
"""Every variant that code is generated for."""
