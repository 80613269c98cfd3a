"""The paper's section with the ledger of the note's claims."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from wear.report.document import Claim, Claims, Number, Section, Text
from wear.report.material import Material, count
from wear.report.plain import plain
from wear.report.words import paragraph, words

if TYPE_CHECKING:
    from wear.report.claims import Entry

VERDICTS = (
    "confirmed",
    "confirmed-with-conditions",
    "not-reproducible",
    "inconsistent",
    "refuted",
)


def section(material: Material) -> Section:
    """The ledger."""
    counts: dict[str, Text | Number] = {
        verdict.replace("-", "_"): count(material.verdicts(verdict), "ledger")
        for verdict in VERDICTS
    }
    return Section(
        "sec:claims",
        "Every claim of the note, judged",
        (
            paragraph(
                "Each claim was decided by a computation of this run: {all} claims, of which "
                "{confirmed} are confirmed, {confirmed_with_conditions} confirmed under conditions "
                "that the note does not state, {not_reproducible} not reproducible with the data "
                "given, {inconsistent} inconsistent with other parts of the note, and {refuted} "
                "refuted.",
                all=count(len(material.ledger), "ledger"),
                **counts,
            ),
            Claims(
                "tab:ledger",
                words("The claims of the note, with verdict and evidence."),
                _claims(material.ledger, frozenset(f"eq:{e.id}" for e in material.equations)),
            ),
        ),
    )


def _claims(ledger: Sequence[Entry], labels: frozenset[str]) -> tuple[Claim, ...]:
    return tuple(
        Claim(
            entry.claim.id,
            plain(entry.claim.where, "place in the note", labels),
            plain(entry.claim.statement, "claim of the note", labels),
            str(entry.finding.verdict),
            plain(entry.finding.evidence, f"check of claim {entry.claim.id}", labels),
        )
        for entry in ledger
    )
