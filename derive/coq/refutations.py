"""What the note claims and Coq refutes, from the printed forms and the steps that contradict them.

Overview
    A refutation has the premises of the step that it rests on, further ones that say where the
    printed claim is tried, and the denial of the printed relation.
Key results
    text     the lemmas, from the steps of some equations by id
    NAMES    their names, by the claim of the note that they decide
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import sympy as sp

from ..equations import TEXTS, written
from ..results.steady_state import closure, roughness
from ..symbols import symbols, t
from .printer import always, proposition, term
from .steps import Step

U_a, u_c, u_inf, u_cum = symbols("U_a u_c u_inf u_cum")
f_c, h_0, sigma_c0, M, H_c = symbols("f_c h_0 sigma_c0 M H_c")

NAMES = MappingProxyType(
    {
        "C24": "bracket_is_not_zero",
        "C27": "no_affine_asymptote",
        "C32": "not_a_limit_of_validity",
        "C36": "another_wear_per_cycle",
        "contact": "contact_in_the_long_run",
    }
)
NEEDS = ("19", "18", "closure-ratio", "21")

(_EQ_16B,), (_EQ_19,), (_EQ_21,) = (written("printed", TEXTS[each]) for each in ("16b", "19", "21"))

RELATIONS = (_EQ_16B, _EQ_19, _EQ_21, sp.Gt(M, 0, evaluate=False), sp.Eq(h_0, sigma_c0))
"""What speaks of all quantities that the refutations do."""

_SECTION_4 = (sp.Eq(f_c, sp.Rational(1, 4)), sp.Eq(h_0, sp.Rational(27, 25000)))


def text(steps: Mapping[str, Step]) -> str:
    """Return the lemmas; ``steps`` are those of the equations in NEEDS."""
    made = (
        _bracket(),
        _asymptote(steps["19"], steps["18"]),
        _validity(),
        _wear(),
        _contact(steps["closure-ratio"]),
    )
    return "\n".join(made)


def _lemma(claim: str, premises: list[str], conclusion: str, proof: str) -> str:
    said = " ->\n  ".join((*(f"({p})" for p in premises), conclusion))
    return (
        f"(* {claim} *)\nLemma {NAMES[claim]} {{w : world}} :\n  {said}.\nProof.\n{proof}\nQed.\n"
    )


def _bracket() -> str:
    """(16), second line: the bracket of section 4, with the load at rest, is a constant."""
    data = (
        sp.Eq(U_a, 0, evaluate=False),
        *_SECTION_4,
        sp.Eq(sigma_c0, sp.Rational(9, 25000)),
        sp.Gt(u_cum, 0, evaluate=False),
    )
    bracket = term(_EQ_16B.atoms(sp.Limit).pop().args[0])
    proof = f"""intros rest f h s c [l [L E]].
assert (K : tends (fun t => {bracket}) (- (9 / 50000))).
{{ apply (tends_ext (fun _ => - (9 / 50000))); [| apply tends_const].
  intros t Ht; rewrite rest, f, h, s by assumption; field. }}
pose proof (tends_unique _ _ _ L K); subst l; nra."""
    return _lemma("C24", [always(d) for d in data], f"~ ({proposition(_EQ_16B)})", proof)


def _asymptote(drift: Step, rate: Step) -> str:
    """(19): the asymptotic response is no straight line, but for one load."""
    coefficient = drift.relation.rhs
    response = f"tends (fun t => {term(u_c)} - {term(u_inf)}) 0"
    line = _EQ_19
    premises = [p.said for p in drift.statement.premises]
    labels = " ".join(p.label for p in drift.statement.premises)
    speed, slope = term(rate.relation.rhs), term(sp.diff(line.rhs, t))
    proof = f"""intros {labels} other response line.
assert (D : tends (fun t => (u_c t - ({speed}) * t) / ln (t / T)) ({term(coefficient)})).
{{ generalize ({drift.cited(drift)}); apply tends_ext; intros t Ht.
  unfold Rdiv; f_equal; field; positive. }}
apply (no_asymptote u_c ({speed}) _ T ({term(line.rhs.subs(t, 0))}) ({slope}) domain_T other D).
- apply cesaro; [assumption | exact ({drift.cited(rate)})].
- revert response; apply tends_ext; intros t Ht; rewrite line by assumption; field; positive."""
    conclusion = f"{term(coefficient)} <> 0 ->\n  {response} ->\n  ~ ({always(line)})"
    return _lemma("C27", premises, conclusion, proof)


def _validity() -> str:
    """After (22): tanh(4 - 2/f_c) > -1 holds for f_c = 1/10 too."""
    criterion = sp.Gt(sp.tanh(4 - 2 / f_c), -1)
    said = f"forall f_c, 0 < f_c -> ({proposition(criterion)}) -> {proposition(sp.Gt(f_c, sp.Rational(1, 8)))}"
    proof = """intros claimed; specialize (claimed (1 / 10)).
assert (1 / 8 < 1 / 10); [apply claimed; [lra | apply tanh_above] | lra]."""
    return _lemma("C32", [], f"~ ({said})", proof)


def _wear() -> str:
    """(21) with the data of section 4: not 2.35e-5 mm."""
    formula = _EQ_21
    hard = sp.Gt(H_c, 0, evaluate=False)
    total = sp.Eq(M, sp.simplify(2 * formula.rhs / (1 + sp.tanh(4 - 2 / f_c))), evaluate=False)
    data = (formula, total, sp.Eq(M, 44 * sp.pi / 10**6, evaluate=False), _SECTION_4[0], hard)
    proof = """intros wear total size f hard.
assert (E : u_cum = M * ((1 + tanh (4 - 2 / f_c)) / 2)) by (rewrite total, wear; unfold Rdiv; rewrite ?Rinv_mult; field; lra).
rewrite share_exp, size, f in E; replace (- (2 * (4 - 2 / (1 / 4)))) with 8 in E by field.
rewrite E; split; interval with (i_prec 60)."""
    return _lemma(
        "C36", [proposition(d) for d in data], "4.6355474e-8 <= u_cum <= 4.6355475e-8", proof
    )


def _contact(ratio: Step) -> str:
    """Under the condition h <= 3 sigma of (4), steady wear exists for f_c >= 1/3 only."""
    quotient = term(closure / roughness)
    labels = " ".join(p.label for p in ratio.statement.premises)
    proof = f"""intros {labels}; pose proof ({ratio.cited(ratio)}) as L.
assert (P : 0 < f_c) by assumption; split.
- intros [l [H Hl]]; rewrite (tends_unique _ _ _ H L) in Hl.
  apply Rmult_le_reg_l with (3 * / f_c); [positive |]; field_simplify; [| lra | lra]; lra.
- intros Hf; exists (/ f_c); split; [exact L |].
  replace 3 with (/ (1 / 3)) by field; apply Rinv_le_contravar; lra."""
    conclusion = f"((exists l, tends (fun t => {quotient}) l /\\ l <= 3) <-> 1 / 3 <= f_c)"
    return _lemma("contact", [p.said for p in ratio.statement.premises], conclusion, proof)
