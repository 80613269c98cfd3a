"""Shell completion, read off an argparse parser.

`eval "$(wear --print-completion)"` in `~/.bashrc`; zsh takes the same text after
`autoload bashcompinit && bashcompinit`.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator, Sequence

TEMPLATE = """\
_{name}_complete() {{
    local current="${{COMP_WORDS[COMP_CWORD]}}" words=""
    case "${{COMP_WORDS[1]}}" in
{cases}
    esac
    [ "$COMP_CWORD" -eq 1 ] && words="{commands}"
    COMPREPLY=($(compgen -W "$words" -- "$current") $(compgen -f -- "$current"))
}}
complete -o filenames -F _{name}_complete {name}"""


def bash(parser: argparse.ArgumentParser) -> str:
    """Return a bash script that completes commands, options, choices, suggestions and files."""
    commands = dict(_commands(parser))
    cases = "\n".join(
        f'        {name}) words="{" ".join(_words(command))}" ;;'
        for name, command in commands.items()
    )
    first = " ".join([*commands, *_words(parser)])
    return TEMPLATE.format(name=parser.prog, cases=cases, commands=first)


def suggest(action: argparse.Action, words: Callable[[], Sequence[str]]) -> None:
    """Have words offered for an argument that takes others too; asked for only when printed."""
    action.suggestions = words  # type: ignore[attr-defined]


def _commands(parser: argparse.ArgumentParser) -> Iterator[tuple[str, argparse.ArgumentParser]]:
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            yield from action.choices.items()


def _words(parser: argparse.ArgumentParser) -> Iterator[str]:
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            continue
        yield from (option for option in action.option_strings if option.startswith("--"))
        yield from map(str, action.choices or ())
        yield from getattr(action, "suggestions", tuple)()
