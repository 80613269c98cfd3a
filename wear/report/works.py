"""The works that a report cites, as readers of a list of references expect them."""

from __future__ import annotations

from wear.cite import Reference

_PARTS = ("title", "journal", "publisher", "volume", "pages", "year")


def entry(reference: Reference) -> str:
    """Return author, title, where and when, and what the work stands for here.

    >>> from wear.cite import REFERENCES
    >>> entry(REFERENCES["greenwood1966"])[:44]
    'Greenwood, J. A., Williamson, J. B. P.: Cont'
    """
    authors = reference.readable("author").replace(" and others", " et al.").replace(" and ", ", ")
    parts = ", ".join(text for name in _PARTS if (text := reference.readable(name)))
    return f"{authors}{': ' if authors else ''}{parts} ({reference.purpose})."
