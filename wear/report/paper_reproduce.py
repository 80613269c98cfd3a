"""The paper's section on how to make it again."""

from __future__ import annotations

from wear.cite import REFERENCES, Reference
from wear.report.document import Column, Given, Items, Listing, Prose, Section, Table, Text
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
                "Every number in the text, the tables and the figures was computed by the run that "
                "wrote this file, but for those that are quoted from the note; on the page, the "
                "tooltip of a number names its computation. True errors are distances from stored "
                "references of far higher precision. [tab:versions] has the versions of the "
                "packages; the file `manifest.json` beside the report adds the scenes and the "
                "checksum of every file. `equations.tex` has every equation as a macro for a "
                "report of one's own, `claims.json` the ledger as data."
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


def references() -> Section:
    """What the report rests on."""
    return Section(
        "sec:references",
        "References",
        (Items(tuple(_entry(reference) for reference in REFERENCES.values())),),
    )


def _entry(reference: Reference) -> Prose:
    """Author, title, where and when; what it stands for here."""
    fields = {name: _readable(text) for name, text in reference.fields.items()}
    where = [fields[name] for name in ("journal", "publisher", "volume", "year") if name in fields]
    told = ", ".join((fields["title"], *where))
    author = f"{fields['author'].replace(' and ', ', ')}: " if "author" in fields else ""
    return (Given(f"{author}{told} ({reference.purpose}).", "reference"),)


def _readable(text: str) -> str:
    """BibTeX as plain text."""
    for mark, letter in (("{\\o}", "ø"), ("{\\'e}", "é"), ("{\\`e}", "è")):
        text = text.replace(mark, letter)
    return text.replace("{", "").replace("}", "").replace("--", "–")
