"""The ledger: the verdicts that need the note's scenes, their figures, and that they can change."""

import pytest

from derive.note.claim_checks import SYMBOLIC
from derive.note.claims import CLAIMS, Verdict
from tests.references import VERDICTS
from wear.report import claims, note
from wear.report.claims import SIMULATED, as_json, decided

FIGURES = {
    "C16": ("0.00109746298",),
    "C17": ("cycle 491", "6.2218e-04"),
    "C34": ("1.24e+11", "2.97e+11"),
    "C35": ("1.886718e-07", "f_c = 0.41750586"),
    "C36": ("4.63554742752e-08", "506.952", "f_c = 0.4172934"),
    "C37": ("4.0701",),
    "C38": ("194, 205, 217, 243",),
    "C40": ("4.38e-23",),
    "C41": ("1.5 H_c", "243.3 MPa in cycle 1,"),
}


@pytest.mark.parametrize("identifier", SIMULATED)
def test_verdict_and_figures(identifier: str) -> None:
    finding = SIMULATED[identifier]()
    assert finding.verdict is VERDICTS[identifier], finding.evidence
    for figure in FIGURES.get(identifier, ()):
        assert figure in finding.evidence


def test_every_claim_has_one_check() -> None:
    assert set(SYMBOLIC) | set(SIMULATED) == set(CLAIMS)
    assert not set(SYMBOLIC) & set(SIMULATED)


def test_the_ledger_as_json() -> None:
    rows = as_json([decided("C5"), decided("C33")])
    assert [row["id"] for row in rows] == ["C5", "C33"]
    assert all(list(row) == ["id", "where", "statement", "verdict", "evidence"] for row in rows)


def test_true_numbers_would_be_confirmed(monkeypatch: pytest.MonkeyPatch) -> None:
    true = note.PrintedValues(simulated_mm=1.89e-7, formula_mm=4.64e-8, criterion=4.0)
    monkeypatch.setattr(claims, "PRINTED", true)
    assert claims.simulated_wear().verdict is Verdict.CONFIRMED
    assert claims.formula_wear().verdict is Verdict.CONFIRMED
    assert claims.stabilised_after().verdict is Verdict.CONFIRMED


def test_another_f_c_reconciles_the_printed_numbers() -> None:
    found = note.reconciliation()
    assert found.value == pytest.approx(0.41729339833096945516, rel=1e-14)
    assert found.misfit == pytest.approx(-0.0040, abs=2e-4)
    assert note.growth_for_simulation() == pytest.approx(found.value, rel=1e-3)
