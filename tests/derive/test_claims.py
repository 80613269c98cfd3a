"""The verdicts that mathematics alone reaches, and that they would change with their grounds."""

import dataclasses

import pytest
import sympy as sp

from derive import verification
from derive.note import claim_checks
from derive.note.claim_checks import SYMBOLIC
from derive.note.claims import CLAIMS, Verdict
from derive.note.governing import NoteModel
from derive.symbols import symbol
from tests.references import VERDICTS


@pytest.fixture(scope="module", autouse=True)
def proofs_alone():
    """Models try the equations in `test_derivation`, and each step in `derive verify`."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(verification, "model_checks", lambda _: ())
        claim_checks._holds.cache_clear()
        yield
    claim_checks._holds.cache_clear()


@pytest.mark.parametrize("identifier", SYMBOLIC)
def test_verdict(identifier: str) -> None:
    finding = SYMBOLIC[identifier]()
    assert finding.verdict is VERDICTS[identifier], finding.evidence
    assert finding.evidence


def test_the_claims_stand_in_the_order_of_the_note() -> None:
    assert list(CLAIMS) == [f"C{number}" for number in range(1, 42)]
    assert set(SYMBOLIC) <= set(CLAIMS)


def test_the_physical_sign_would_be_consistent(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(claim_checks, "NoteModel", lambda: NoteModel(opening=True))
    assert claim_checks.closure_sign().verdict is Verdict.CONFIRMED


def test_a_law_that_exceeds_its_maximum_would_be_refuted(monkeypatch: pytest.MonkeyPatch) -> None:
    doubled = dataclasses.replace(claim_checks.TANH, phi=2 * claim_checks.TANH.phi)
    monkeypatch.setattr(claim_checks, "TANH", doubled)
    assert claim_checks.below_maximum().verdict is Verdict.REFUTED


def test_an_equation_whose_step_fails_refutes_its_claim(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(claim_checks, "_holds", lambda *_: (False, "some fail", False))
    assert SYMBOLIC["C10"]().verdict is Verdict.REFUTED
    assert claim_checks.given_force().verdict is Verdict.REFUTED
    assert claim_checks.vacuous().verdict is Verdict.CONFIRMED


def test_hypotheses_are_told_in_symbols() -> None:
    for identifier in ("C22", "C26", "C29", "C31"):
        assert SYMBOLIC[identifier]().evidence.endswith("needs f_c > 0, |U_a| <= U")
    assert "needs p > 0, p < p_max" in claim_checks.stiff_limit().evidence
    assert "epsilon" not in claim_checks.one_eighth().evidence


def test_thresholds_are_in_the_evidence_of_c32() -> None:
    evidence = claim_checks.one_eighth().evidence
    for figure in ("3.7751e-11", "0.123411", "0.086724", "0.153717"):
        assert figure in evidence


def test_the_bracket_would_vanish_for_one_load() -> None:
    """f_c (h_0 - U_a) = sigma_c0 is the one load for which (16) would hold."""
    bracket = claim_checks.constant_bracket.claim.rhs
    load = symbol("h_0") - symbol("sigma_c0") / symbol("f_c")
    assert sp.expand(bracket.subs(symbol("U_a"), load)) == 0
