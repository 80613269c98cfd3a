"""The paper's section with the ledger of the note's claims."""

from __future__ import annotations

import re

from wear.report.document import Claim, Claims, Number, Section, Text
from wear.report.material import Material, count
from wear.report.plain import plain
from wear.report.words import paragraph, words

_SEVERAL = re.compile(r"\d+(?:, \d+)+")

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
                words(
                    "The claims of the note, where it makes them, with verdict and evidence. "
                    "Checks are those of [sec:derivation]."
                ),
                _claims(material),
            ),
        ),
    )


def _place(where: str) -> str:
    """Where a claim stands in the note; a section is called one.

    >>> _place("2.5, (6)"), _place("3, 5"), _place("after (21)")
    ('section 2.5, (6)', 'sections 3, 5', 'after (21)')
    """
    if not where[0].isdigit():
        return where
    several = _SEVERAL.fullmatch(where) is not None
    return f"{'sections' if several else 'section'} {where}"


def _claims(material: Material) -> tuple[Claim, ...]:
    ledger = material.ledger
    labels = {f"eq:{equation.id}" for equation in material.equations}
    labels |= {f"claim:{entry.claim.id}" for entry in ledger}
    return tuple(
        Claim(
            entry.claim.id,
            plain(_place(entry.claim.where), "place in the note", labels),
            plain(entry.claim.statement, "claim of the note", labels),
            str(entry.finding.verdict),
            plain(entry.finding.evidence, f"check of claim {entry.claim.id}", labels),
        )
        for entry in ledger
    )
