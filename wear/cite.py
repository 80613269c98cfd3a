"""References to cite: the note, this software, and the methods and libraries behind a result.

The entries are in ``data/references.bib``, each below a comment on its purpose.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from importlib.resources import files
from typing import NamedTuple

_ENTRY = re.compile(
    r"^% (?P<purpose>[^\n]+)\n@(?P<kind>\w+)\{(?P<key>[^,]+),\n(?P<fields>.*?)^\}", re.M | re.S
)
_FIELD = re.compile(r"^  (\w+) = \{(.*)\},$", re.MULTILINE)
_PARTS = ("title", "journal", "publisher", "volume", "pages", "year")
_LETTERS = {r"{\o}": "ø", r"{\'e}": "é", r"{\`e}": "è", r"\"o": "ö", "--": "–"}


class Reference(NamedTuple):
    """A bibliographic entry: BibTeX kind, key and fields, and the `purpose` of citing it."""

    key: str
    kind: str
    purpose: str
    fields: Mapping[str, str]

    def readable(self, name: str) -> str:
        """Return a field as plain text, empty if the entry does not have it."""
        text = self.fields.get(name, "")
        for mark, letter in _LETTERS.items():
            text = text.replace(mark, letter)
        return text.replace("{", "").replace("}", "")


def listed(reference: Reference) -> str:
    """Return author, title, publication and year of a work, and its purpose here.

    >>> listed(REFERENCES["greenwood1966"])[:44]
    'Greenwood, J. A., Williamson, J. B. P.: Cont'
    """
    authors = reference.readable("author").replace(" and others", " et al.").replace(" and ", ", ")
    parts = ", ".join(text for name in _PARTS if (text := reference.readable(name)))
    return f"{authors}{': ' if authors else ''}{parts} ({reference.purpose})."


def bibtex(reference: Reference) -> str:
    """Return an entry as BibTeX, with a comment on its purpose.

    >>> print(bibtex(REFERENCES["filippov1988"]))
    % sliding along the end of contact
    @book{filippov1988,
      author = {Filippov, A. F.},
      title = {Differential Equations with Discontinuous Righthand Sides},
      publisher = {Kluwer Academic Publishers},
      year = {1988},
    }
    """
    fields = "\n".join(f"  {name} = {{{text}}}," for name, text in reference.fields.items())
    return f"% {reference.purpose}\n@{reference.kind}{{{reference.key},\n{fields}\n}}"


_BIB = files("wear").joinpath("data", "references.bib").read_text(encoding="utf-8")
REFERENCES: Mapping[str, Reference] = {
    key: Reference(key, kind, purpose, dict(_FIELD.findall(fields)))
    for purpose, kind, key, fields in _ENTRY.findall(_BIB)
}
