"""The mathematics of wear under cyclic contact, derived and checked by machine.

>>> import derive
>>> derive.equation("21").status.value
'derived'

SymPy is imported at the first use of one of these names, not with the package.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .catalogue import all_equations, equation
    from .verification import verify

__all__ = ["all_equations", "equation", "verify"]

_MODULES = {"all_equations": "catalogue", "equation": "catalogue", "verify": "verification"}


def __getattr__(name: str) -> Any:
    if name in _MODULES:
        return getattr(import_module(f"{__name__}.{_MODULES[name]}"), name)
    raise AttributeError(f"module 'derive' has no attribute {name!r}")
