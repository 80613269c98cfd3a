r"""Short marks for prose, so that a report's text can be read where it is written.

    $u_c$        a formula            *stress*     emphasis
    `wear run`   code                 [eq:21]      reference to a label
    [(eq:21)]    the same by its number alone: Eqs. [(eq:18)] and [(eq:21)]
    [ref:note]   the number of a work that is cited
    {rate}       a value by name: a `Number`, or any other inline node

There is no escape: a text that needs one of these marks as itself passes it as a named `Text`.
"""

from __future__ import annotations

import re

from wear.report.document import (
    Code,
    Emphasis,
    Inline,
    Math,
    Paragraph,
    Prose,
    Reference,
    Text,
)

_MARK = re.compile(
    r"\$(?P<math>[^$]+)\$|`(?P<code>[^`]+)`|\*(?P<stress>[^*]+)\*"
    r"|\[(?P<bare>\()?(?P<label>[A-Za-z][A-Za-z0-9:.\-]*)(?(bare)\))\]|\{(?P<name>\w+)\}"
)


def words(template: str, **values: Inline) -> Prose:
    """Prose from a marked text.

    >>> from wear.report.document import Number
    >>> words("see [eq:21]: {u}", u=Number(1.5, 2, "mm", source="run"))
    (Text(text='see '), Reference(label='eq:21', bare=False), Text(text=': '), \
Number(value=1.5, digits=2, unit='mm', source='run'))

    Raises `ValueError` for names without a value and values without a name.
    """
    nodes: list[Inline] = []
    used: set[str] = set()
    end = 0
    for mark in _MARK.finditer(template):
        if mark.start() > end:
            nodes.append(Text(template[end : mark.start()]))
        end = mark.end()
        used |= {mark["name"]} - {None}
        nodes.append(_node(mark, values))
    if end < len(template):
        nodes.append(Text(template[end:]))
    if unused := sorted(values.keys() - used):
        raise ValueError(f"the text does not use {unused}: {template!r}")
    return tuple(nodes)


def paragraph(template: str, **values: Inline) -> Paragraph:
    """A paragraph from a marked text; see `words`."""
    return Paragraph(words(template, **values))


def _node(mark: re.Match[str], values: dict[str, Inline]) -> Inline:
    if mark["math"]:
        return Math(mark["math"])
    if mark["code"]:
        return Code(mark["code"])
    if mark["stress"]:
        return Emphasis(mark["stress"])
    if mark["label"]:
        return Reference(mark["label"], bare=mark["bare"] is not None)
    if mark["name"] not in values:
        raise ValueError(f"the text asks for {{{mark['name']}}}, which was not passed")
    return values[mark["name"]]
