"""What to cite: the note, this software, and the methods and libraries that a result rests on."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple


class Reference(NamedTuple):
    """A bibliographic entry: BibTeX kind, key and fields; `purpose` says when to cite it."""

    key: str
    kind: str
    purpose: str
    fields: Mapping[str, str]


def bibtex(reference: Reference) -> str:
    """Return an entry as BibTeX, with a comment that says when to cite it.

    >>> print(bibtex(REFERENCES["filippov1988"]))
    % sliding along the contact cutoff
    @book{filippov1988,
      author = {Filippov, A. F.},
      title = {Differential Equations with Discontinuous Righthand Sides},
      publisher = {Kluwer Academic Publishers},
      year = {1988},
    }
    """
    fields = "\n".join(f"  {name} = {{{text}}}," for name, text in reference.fields.items())
    return f"% {reference.purpose}\n@{reference.kind}{{{reference.key},\n{fields}\n}}"


_ENTRIES = (
    Reference(
        "note",
        "misc",
        "the model and its analysis",
        {
            "title": "On the stabilized asymptotic response of a system of solids "
            "in contact with wear",
            "note": "Short note; title in French: Sur la r{\\'e}ponse asymptotique stabilis{\\'e}e "
            "d'un syst{\\`e}me de solides en contact avec usure",
        },
    ),
    Reference(
        "derive-wear",
        "misc",
        "this software",
        {
            "author": "{The derive-wear contributors}",
            "title": "{derive-wear}: wear of bearings under cyclic contact, derived by machine, "
            "solved for any number of cycles",
        },
    ),
    Reference(
        "hairer1993",
        "book",
        "method DOP853",
        {
            "author": "Hairer, E. and N{\\o}rsett, S. P. and Wanner, G.",
            "title": "Solving Ordinary Differential Equations {I}: Nonstiff Problems",
            "publisher": "Springer",
            "edition": "2",
            "year": "1993",
        },
    ),
    Reference(
        "filippov1988",
        "book",
        "sliding along the contact cutoff",
        {
            "author": "Filippov, A. F.",
            "title": "Differential Equations with Discontinuous Righthand Sides",
            "publisher": "Kluwer Academic Publishers",
            "year": "1988",
        },
    ),
    Reference(
        "virtanen2020",
        "article",
        "SciPy: integrators and special functions",
        {
            "author": "Virtanen, P. and others",
            "title": "{SciPy} 1.0: fundamental algorithms for scientific computing in {Python}",
            "journal": "Nature Methods",
            "volume": "17",
            "pages": "261--272",
            "year": "2020",
            "doi": "10.1038/s41592-019-0686-2",
        },
    ),
    Reference(
        "harris2020",
        "article",
        "NumPy: everything numeric",
        {
            "author": "Harris, C. R. and others",
            "title": "Array programming with {NumPy}",
            "journal": "Nature",
            "volume": "585",
            "pages": "357--362",
            "year": "2020",
            "doi": "10.1038/s41586-020-2649-2",
        },
    ),
    Reference(
        "meurer2017",
        "article",
        "SymPy: the derivation",
        {
            "author": "Meurer, A. and others",
            "title": "{SymPy}: symbolic computing in {Python}",
            "journal": "PeerJ Computer Science",
            "volume": "3",
            "pages": "e103",
            "year": "2017",
            "doi": "10.7717/peerj-cs.103",
        },
    ),
    Reference(
        "johansson2017",
        "article",
        "Arb: enclosures that are proofs",
        {
            "author": "Johansson, F.",
            "title": "Arb: efficient arbitrary-precision midpoint-radius interval arithmetic",
            "journal": "IEEE Transactions on Computers",
            "volume": "66",
            "number": "8",
            "pages": "1281--1292",
            "year": "2017",
            "doi": "10.1109/TC.2017.2690633",
        },
    ),
)

REFERENCES: Mapping[str, Reference] = {entry.key: entry for entry in _ENTRIES}
