"""Variants: the choices by which the models of scenes differ.

Key results
    Variant     law, support, pin, loss of contact
    VARIANTS    every variant that source code can be written for
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

from .laws import LAWS, ContactLaw
from .note.condensed import CondensedProblem, condensed
from .note.governing import Pin


@dataclass(frozen=True)
class Variant:
    """A choice of contact law, support, pin, and whether contact can be lost.

    Whether wear of a pin opens or closes the gap is not a variant but a sign, given at run time.

    >>> variant = Variant(LAWS["tanh"], compliant=False, pin=Pin.WORN, ends_at_3_sigma=True)
    >>> variant.module, variant.name
    ('rigid_worn', 'rigid_worn_ends_at_3_sigma')
    """

    law: ContactLaw
    compliant: bool
    pin: Pin
    ends_at_3_sigma: bool = False

    @property
    def module(self) -> str:
        """Return the name of the generated module, within the package of its law."""
        return f"{'compliant' if self.compliant else 'rigid'}_{self.pin.value}"

    @property
    def name(self) -> str:
        """Return the name for users: the module, and whether contact can be lost."""
        return self.module + "_ends_at_3_sigma" * self.ends_at_3_sigma

    @property
    def model(self) -> CondensedProblem:
        """Return the hypotheses that the variant rests on, with the printed sign of pin wear."""
        return condensed(self.law, False, self.pin)

    @property
    def equations(self) -> tuple[str, ...]:
        """Return the ids of the equations that the variant's code comes from."""
        condensed = ("8", "9") if self.compliant else ("10",)
        bearing_only = self.pin is Pin.ABSENT and not self.compliant
        return ("1", "2b", "3", "4", "5", "6", *(("13",) if bearing_only else condensed))


VARIANTS = tuple(
    Variant(law, compliant, pin, ends_at_3_sigma)
    for law, compliant, pin, ends_at_3_sigma in product(
        LAWS.values(), (False, True), Pin, (False, True)
    )
)
"""Every variant that source code can be written for."""
