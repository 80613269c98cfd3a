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
            "note": "Version 0.1.0",
        },
    ),
    Reference(
        "archard1953",
        "article",
        "the law of wear",
        {
            "author": "Archard, J. F.",
            "title": "Contact and rubbing of flat surfaces",
            "journal": "Journal of Applied Physics",
            "volume": "24",
            "pages": "981--988",
            "year": "1953",
            "doi": "10.1063/1.1721448",
        },
    ),
    Reference(
        "kuczma1990",
        "book",
        "method abel: Abel's functional equation",
        {
            "author": "Kuczma, M. and Choczewski, B. and Ger, R.",
            "title": "Iterative Functional Equations",
            "publisher": "Cambridge University Press",
            "year": "1990",
        },
    ),
    Reference(
        "hairer1993",
        "book",
        "methods DOP853 and collocation",
        {
            "author": "Hairer, E. and N{\\o}rsett, S. P. and Wanner, G.",
            "title": "Solving Ordinary Differential Equations {I}: Nonstiff Problems",
            "publisher": "Springer",
            "edition": "2",
            "year": "1993",
        },
    ),
    Reference(
        "dormand1980",
        "article",
        "method RK45",
        {
            "author": "Dormand, J. R. and Prince, P. J.",
            "title": "A family of embedded {R}unge-{K}utta formulae",
            "journal": "Journal of Computational and Applied Mathematics",
            "volume": "6",
            "number": "1",
            "pages": "19--26",
            "year": "1980",
            "doi": "10.1016/0771-050X(80)90013-3",
        },
    ),
    Reference(
        "bogacki1989",
        "article",
        "method RK23",
        {
            "author": "Bogacki, P. and Shampine, L. F.",
            "title": "A 3(2) pair of {R}unge-{K}utta formulas",
            "journal": "Applied Mathematics Letters",
            "volume": "2",
            "number": "4",
            "pages": "321--325",
            "year": "1989",
            "doi": "10.1016/0893-9659(89)90079-7",
        },
    ),
    Reference(
        "hairer1996",
        "book",
        "method Radau",
        {
            "author": "Hairer, E. and Wanner, G.",
            "title": "Solving Ordinary Differential Equations {II}: Stiff and "
            "Differential-Algebraic Problems",
            "publisher": "Springer",
            "edition": "2",
            "year": "1996",
        },
    ),
    Reference(
        "shampine1997",
        "article",
        "method BDF",
        {
            "author": "Shampine, L. F. and Reichelt, M. W.",
            "title": "The {MATLAB} {ODE} suite",
            "journal": "SIAM Journal on Scientific Computing",
            "volume": "18",
            "number": "1",
            "pages": "1--22",
            "year": "1997",
            "doi": "10.1137/S1064827594276424",
        },
    ),
    Reference(
        "petzold1983",
        "article",
        "method LSODA",
        {
            "author": "Petzold, L.",
            "title": "Automatic selection of methods for solving stiff and nonstiff systems of "
            "ordinary differential equations",
            "journal": "SIAM Journal on Scientific and Statistical Computing",
            "volume": "4",
            "number": "1",
            "pages": "136--148",
            "year": "1983",
            "doi": "10.1137/0904010",
        },
    ),
    Reference(
        "greenwood1966",
        "article",
        "contact law exponential",
        {
            "author": "Greenwood, J. A. and Williamson, J. B. P.",
            "title": "Contact of nominally flat surfaces",
            "journal": "Proceedings of the Royal Society of London A",
            "volume": "295",
            "pages": "300--319",
            "year": "1966",
            "doi": "10.1098/rspa.1966.0242",
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
        "walter1998",
        "book",
        "comparison theorem and Gronwall's lemma: bounds of the wear",
        {
            "author": "Walter, W.",
            "title": "Ordinary Differential Equations",
            "publisher": "Springer",
            "year": "1998",
        },
    ),
    Reference(
        "trefethen2014",
        "article",
        "means at equidistant phases: bounds of the wear",
        {
            "author": "Trefethen, L. N. and Weideman, J. A. C.",
            "title": "The exponentially convergent trapezoidal rule",
            "journal": "SIAM Review",
            "volume": "56",
            "pages": "385--458",
            "year": "2014",
            "doi": "10.1137/130932132",
        },
    ),
    Reference(
        "corless1996",
        "article",
        "Lambert's function: wear under a constant load",
        {
            "author": "Corless, R. M. and others",
            "title": "On the {L}ambert {W} function",
            "journal": "Advances in Computational Mathematics",
            "volume": "5",
            "pages": "329--359",
            "year": "1996",
            "doi": "10.1007/BF02124750",
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
