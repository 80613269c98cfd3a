"""The paper's section on how to make it again."""

from __future__ import annotations

from collections.abc import Iterable

from wear.cite import REFERENCES, Reference
from wear.report.document import (
    Bibliography,
    Column,
    Given,
    Link,
    Listing,
    Prose,
    Section,
    Table,
    Text,
    Work,
)
from wear.report.manifest import versions
from wear.report.words import paragraph, words

COMMANDS = """\
# this report, from a fresh clone
make reproduce
# every check of the software
make test
# how an equation follows, step by step
derive steps 21
# the cycle that the note calls stabilised
wear run section4 --cycles 9000,9001
# regime and constants of a scene
wear asymptote section4
# the ledger of the claims
wear claims
"""


def section() -> Section:
    """Commands, versions, checksums."""
    rows = tuple(
        ((Text(name),), (Given(number, "version of a package"),))
        for name, number in versions().items()
    )
    return Section(
        "sec:reproduce",
        "How to reproduce this report",
        (
            paragraph(
                "This report was written by the software `derive-wear` [ref:derive-wear]. Every "
                "number in the text, the tables and the figures was computed by the run that "
                "wrote this file, but for those that are quoted from the note; on the page, the "
                "tooltip of a number names its computation. True errors are distances from stored "
                "references of far higher precision. The numerics rest on NumPy [ref:harris2020]; "
                "[tab:versions] has the versions of the packages; the file `manifest.json` beside "
                "the report adds the scenes and the checksum of every file. `equations.tex` has "
                "every equation as a macro for a report of one's own, `claims.json` the ledger as "
                "data."
            ),
            Listing(COMMANDS, "Commands that reproduce the results"),
            Table(
                "tab:versions",
                words("Versions in this run."),
                (Column(words("Package")), Column(words("Version"))),
                rows,
            ),
        ),
    )


def references(keys: Iterable[str]) -> Section:
    """The works of these keys, in this order."""
    works = tuple(Work(f"ref:{key}", _entry(REFERENCES[key])) for key in keys)
    return Section("sec:references", "References", (Bibliography(works),))


def _entry(reference: Reference) -> Prose:
    """Author, title, where and when; what it stands for here."""
    fields = {name: _readable(text) for name, text in reference.fields.items()}
    parts = ("title", "journal", "publisher", "volume", "pages", "year")
    told = ", ".join(fields[name] for name in parts if name in fields)
    authors = fields.get("author", "").replace(" and others", " et al.").replace(" and ", ", ")
    author = f"{authors}: " if authors else ""
    entry = Given(f"{author}{told} ({reference.purpose}).", "reference")
    if "doi" not in fields:
        return (entry,)
    return (entry, Text(" doi:"), Link(fields["doi"], f"https://doi.org/{fields['doi']}"))


def _readable(text: str) -> str:
    """BibTeX as plain text."""
    for mark, letter in (("{\\o}", "ø"), ("{\\'e}", "é"), ("{\\`e}", "è")):
        text = text.replace(mark, letter)
    return text.replace("{", "").replace("}", "").replace("--", "–")
