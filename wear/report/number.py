"""Numbers of the text, each with its digits, its unit and the computation that it comes from."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from numbers import Integral


@dataclass(frozen=True)
class TextNumber:
    """A computed number.

    `digits` counts significant digits, `unit` is plain text such as ``mm`` or ``MPa/mm``, and
    `source` names the computation. Integers below a million are shown in full.

    >>> TextNumber(4.63554742752e-8, "equation 21", 4, "mm").decimal
    ('4.636', -8)
    >>> TextNumber(9000, "scene").decimal
    ('9000', None)
    """

    value: float
    source: str
    digits: int = 12
    unit: str = ""

    def __post_init__(self) -> None:
        if not math.isfinite(self.value):
            raise ValueError(
                f"a number in the text must be finite, got {self.value} ({self.source})"
            )
        if not self.source:
            raise ValueError(f"the number {self.value} has no source")

    def to(self, digits: int) -> TextNumber:
        """Return the same number with another count of significant digits."""
        return replace(self, digits=digits)

    @property
    def plain(self) -> int | float:
        """Return the value as a number of Python, with all its digits."""
        return int(self.value) if isinstance(self.value, Integral | int) else float(self.value)

    @property
    def decimal(self) -> tuple[str, int | None]:
        """Return the digits, with a sign if negative, and the power of ten if there is one."""
        if isinstance(self.plain, int) and abs(self.plain) < 10**6:
            return str(self.plain), None
        if self.value == 0.0:
            return "0", None
        mantissa, _, power = f"{self.value:.{self.digits - 1}e}".partition("e")
        exponent = int(power)
        if -4 < exponent < 6:
            return f"{self.value:.{max(self.digits - 1 - exponent, 0)}f}", None
        return mantissa, exponent

    @property
    def latex(self) -> str:
        r"""Return the number in math mode.

        >>> print(TextNumber(4.63554742752e-8, "equation 21", 4).latex)
        4.636\times10^{-8}
        >>> print(TextNumber(123456, "scene").latex)
        123\,456
        """
        digits, exponent = self.decimal
        power = "" if exponent is None else rf"\times10^{{{exponent}}}"
        return grouped(digits, r"\,") + power


def significant(value: float, most: int) -> int:
    """Return the number of digits of a datum, at most `most`.

    >>> significant(-0.05, 12), significant(1.08e-3, 12), significant(2000.0, 6)
    (1, 3, 1)
    """
    mantissa = f"{abs(value):.{most - 1}e}".partition("e")[0]
    return len(mantissa.replace(".", "").rstrip("0")) or 1


def grouped(digits: str, separator: str) -> str:
    """Return integers of more than four digits in groups of three.

    >>> grouped("123456", " "), grouped("9000", " "), grouped("1.23456", " ")
    ('123 456', '9000', '1.23456')
    """
    is_long = "." not in digits and len(digits.lstrip("-")) > 4
    return f"{int(digits):,}".replace(",", separator) if is_long else digits
