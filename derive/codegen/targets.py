"""The languages that a variant can be written in.

Key results
    TARGETS    their names
    source     the source of a variant in one of them
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from ..variant import Variant
from . import c, fortran, javascript, numpy_module

_WRITERS: Mapping[str, Callable[[Variant], str]] = MappingProxyType(
    {
        "numpy": numpy_module.module_text,
        "c": c.source,
        "fortran": fortran.source,
        "javascript": javascript.source,
    }
)

TARGETS = tuple(_WRITERS)
"""The names of the languages."""


def source(variant: Variant, target: str) -> str:
    """Return the free-standing source of a variant in its stable form.

    Raises
    ------
    ValueError
        if there is no such target.

    >>> from derive.variant import VARIANTS
    >>> source(VARIANTS[0], "c").splitlines()[1]
    ' * Tanh contact law, rigid support, smooth pin that does not wear.'
    """
    if target not in _WRITERS:
        raise ValueError(f"{target!r} is no target; there are {', '.join(TARGETS)}")
    return _WRITERS[target](variant)
