"""Section 2: the model, equations (1) to (7).

Overview
    Two rigid solids, a rotating pin and a bearing on springs, are in contact and wear.  The
    hypotheses (1) to (6) are stated here as the note states them; (7) follows from them.
Key results
    NoteModel           the hypotheses, for a contact law, a sign of pin wear and a kind of pin
    pressure_in_contact (7e) where the cutoff in the text under (4) allows contact
    wear_of_pin, roughness_of_pin, roughness_of_bearing   (5) integrated from (6)
Remarks
    The note stops using the cutoff h <= 3 sigma after (4); from (7e) on its law holds at every
    closure.  Both readings are followed: ``NoteModel.pressure`` is the law at every closure, which
    (8) to (22) rest on, ``NoteModel.pressure_with_cutoff`` the text under (4).
    With (5), Eq. (1) as printed lets wear of the pin *close* the gap; ``opening=True`` is the
    physical sign.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property

import sympy as sp

from ..equations import Proved
from ..hypotheses import SMOOTH_PIN, UNCOUPLED, UNWORN_PIN, Hypothesis, Kind
from ..kernel import Judgement
from ..laws import TANH, ContactLaw
from ..rules.algebra import Insert, Solve, substitute
from ..rules.assumption import assume, defined
from ..rules.calculus import SPRINGS, differentiate, integrate
from ..rules.inequalities import Arithmetic
from ..symbols import symbols
from . import model

h, U_c, u_a = symbols("h U_c u_a")
sigma, sigma_a, sigma_c, p, p_max, R_a, b, L = symbols("sigma sigma_a sigma_c p p_max R_a b L")
f_a, f_c, f_aa, f_cc = symbols("f_a f_c f_aa f_cc")

OWN = (defined(f_aa, f_a), defined(f_cc, f_c))
"""f_a and f_c: how the roughness of a solid changes with its own wear."""


def equation(relation: sp.Basic, name: str = "", remark: str = "") -> Judgement:
    """Return one of the hypotheses of section 2."""
    return assume(Hypothesis(relation, Kind.MODEL), name, remark)


class Pin(StrEnum):
    """The kind of pin; a smooth one has no field of roughness, an unworn one no wear depth."""

    ABSENT = "bearing"  # smooth, does not wear
    ROUGH = "rough"  # rough, does not wear
    WORN = "worn"  # smooth, wears
    WORN_ROUGH = "worn_rough"

    @property
    def wears(self) -> bool:
        """Return whether the pin has a wear depth."""
        return self in (Pin.WORN, Pin.WORN_ROUGH)

    @property
    def rough(self) -> bool:
        """Return whether the pin has a roughness."""
        return self in (Pin.ROUGH, Pin.WORN_ROUGH)


@dataclass(frozen=True)
class NoteModel:
    """The hypotheses of section 2 for one contact law, one sign of pin wear, one kind of pin."""

    law: ContactLaw = TANH
    opening: bool = False
    pin: Pin = Pin.WORN_ROUGH

    @cached_property
    def closure(self) -> Judgement:
        """Eq. (1), or its physical sign, with which wear of either solid opens the gap."""
        remark = "wear of either solid opens the gap" if self.opening else "sign of u_a as printed"
        return equation(model.CLOSURE[self.opening], "closure", remark)

    @cached_property
    def reaction(self) -> Judgement:
        """Eq. (2), equilibrium of the pin."""
        return equation(model.REACTION)

    @cached_property
    def reaction_force(self) -> Judgement:
        """Eq. (7b), the form in which the reaction follows from the pressure."""
        return Insert(sp.Eq(p * b * L, R_a))(Solve(R_a)(self.reaction))

    @cached_property
    def support(self) -> Judgement:
        """Eq. (2), equilibrium of the bearing on its springs."""
        return assume(SPRINGS)

    @cached_property
    def roughness(self) -> Judgement:
        """Eq. (3), equivalent roughness."""
        return equation(model.ROUGHNESS)

    @cached_property
    def pressure(self) -> Judgement:
        """Eq. (4) at every closure, as the note uses it from (7e) on."""
        remark = "the cutoff in the text under (4) is not applied from here on"
        source = f"the law at every closure: {self.law.source}"
        return assume(Hypothesis(model.at_every_closure(self.law)), source, remark)

    @cached_property
    def pressure_with_cutoff(self) -> Judgement:
        """Eq. (4) with the text below it: no contact for h > 3 sigma."""
        return equation(model.contact(self.law))

    @property
    def in_contact(self) -> Hypothesis:
        """Contact is active in the sense of the text below (4)."""
        return Hypothesis(sp.Le(h, self.law.cutoff * sigma))

    @cached_property
    def pressure_in_contact(self) -> Judgement:
        """Eq. (7e) where contact is active."""
        contact = assume(self.in_contact)
        return Arithmetic(model.at_every_closure(self.law))(self.pressure_with_cutoff, contact)

    @cached_property
    def archard(self) -> tuple[Judgement, Judgement, Judgement, Judgement]:
        """Eq. (5): wear of both solids by Archard's law, and the resulting change of roughness."""
        u_a_rate, sigma_a_rate, u_c_rate, sigma_c_rate = map(equation, model.ARCHARD)
        return u_a_rate, sigma_a_rate, u_c_rate, sigma_c_rate

    @cached_property
    def wear_laws(self) -> tuple[Judgement, Judgement, Judgement, Judgement]:
        """Eq. (7f): (5) if wear of a solid changes only its own roughness.

        A pin that does not wear changes none.
        """
        u_a_rate, sigma_a_rate, u_c_rate, sigma_c_rate = self.archard
        (no_ac, no_ca), (own_a, own_c) = map(assume, UNCOUPLED), OWN
        no_effect_of_pin = no_ca if self.pin.wears else differentiate(assume(UNWORN_PIN))
        return (
            u_a_rate,
            substitute(sigma_a_rate, no_ac, own_a),
            u_c_rate,
            substitute(sigma_c_rate, no_effect_of_pin, own_c),
        )

    @cached_property
    def start(self) -> tuple[Judgement, ...]:
        """Eq. (6): initial values of h, u_c, u_a, sigma_a, sigma_c."""
        return tuple(assume(Hypothesis(relation, Kind.INITIAL)) for relation in model.START)

    @cached_property
    def wear_of_pin(self) -> Judgement:
        """The pin wears in proportion to the bearing: second line of (8)."""
        if not self.pin.wears:
            return assume(UNWORN_PIN)
        _, start_c, start_a, *_ = self.start
        u_a_rate, _, u_c_rate, _ = self.wear_laws
        proportional = substitute(u_a_rate, Solve(p)(u_c_rate))
        return integrate(proportional, start_a, start_c).named("wear of the pin")

    @cached_property
    def roughness_of_pin(self) -> Judgement:
        """sigma_a as a function of the wear of the pin."""
        if not self.pin.rough:
            return assume(SMOOTH_PIN)
        rough = integrate(self.wear_laws[1], self.start[3], self.start[2])
        return rough if self.pin.wears else substitute(rough, self.wear_of_pin)

    @cached_property
    def roughness_of_bearing(self) -> Judgement:
        """sigma_c as a function of the wear of the bearing."""
        return integrate(self.wear_laws[3], self.start[4], self.start[1])

    @cached_property
    def rough(self) -> Judgement:
        """The bearing is rough, as the equivalent roughness is positive and the pin smooth."""
        facts = self.roughness, self.roughness_of_pin
        return Arithmetic(sp.Gt(sigma_c, 0))(*facts, name="the bearing is rough")

    @cached_property
    def roughness_at_wear(self) -> Judgement:
        """The equivalent roughness in terms of the wear of both solids."""
        combined = substitute(self.roughness, self.roughness_of_pin)
        if not self.pin.rough:
            remark = "a smooth pin leaves no square root"
            combined = Arithmetic(sp.Eq(sigma, sigma_c))(combined, self.rough, remark=remark)
        return substitute(combined, self.roughness_of_bearing)

    @cached_property
    def slip(self) -> Judgement:
        """The slip rate, from the radius of the pin and its speed in revolutions per minute."""
        return substitute(*map(equation, model.SLIP))


def results(model: NoteModel) -> dict[str, Proved]:
    """Return equations (1) to (7g) of a model."""
    return {
        "1": model.closure,
        "2a": model.reaction,
        "2b": model.support,
        "3": model.roughness,
        "4": model.pressure_with_cutoff,
        "5": model.archard,
        "6": model.start,
        "7a": model.closure,
        "7b": model.reaction_force,
        "7c": Solve(U_c)(model.support),
        "7d": model.roughness,
        "7e": model.pressure_in_contact,
        "7f": model.wear_laws,
        "7g": model.start,
    }
