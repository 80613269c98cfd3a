"""Shell completion, read off an argparse parser.

`eval "$(wear --print-completion)"` in `~/.bashrc`; zsh takes the same text after
`autoload -U compinit bashcompinit && compinit && bashcompinit`.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator, Sequence

_FILES = ("FILE", "DIR", "SCENE")
"""Metavars of arguments that may be paths."""

_TEMPLATE = """\
_{name}_complete() {{
    local current="${{COMP_WORDS[COMP_CWORD]}}" before="${{COMP_WORDS[COMP_CWORD-1]}}"
    local words="" files="" IFS=$'\\n'
    case "$COMP_CWORD ${{COMP_WORDS[1]}} $before" in
        1\\ *) words="{commands}" ;;
        *" =") ;;
{cases}
    esac
    COMPREPLY=($(compgen -W "${{words// /$IFS}}" -- "$current"))
    [ -z "$files" ] || COMPREPLY+=($(compgen -f -- "$current"))
    if type compopt >/dev/null 2>&1; then
        [ -z "$files" ] || compopt -o filenames 2>/dev/null
        case "${{COMPREPLY[0]}}" in *=) compopt -o nospace 2>/dev/null ;; esac
    fi
}}
complete -F _{name}_complete {name}"""

_CASE = """\
        *" {command} {before}") words="{words}" files="{files}" ;;"""
_REST = """\
        *" {command} "*)
            case "$current" in
                -*) words="{options}" ;;
                *) words="{words}" files="{files}" ;;
            esac ;;"""


def bash(parser: argparse.ArgumentParser) -> str:
    """Return a bash script that completes commands, options, their values, and files."""
    known = commands(parser)
    cases = [case for name, command in known.items() for case in _cases(name, command)]
    first = " ".join([*known, *_options(parser)])
    return _TEMPLATE.format(name=parser.prog, cases="\n".join(cases), commands=first)


def _cases(name: str, parser: argparse.ArgumentParser) -> Iterator[str]:
    """Yield the completions after each option with a value, then those of all other places."""
    for action in parser._actions:
        if action.nargs != 0:
            for option in action.option_strings:
                yield _CASE.format(command=name, before=option, **_values([action]))
    places = [action for action in parser._actions if not action.option_strings]
    yield _REST.format(command=name, options=" ".join(_options(parser)), **_values(places))


def _values(actions: Sequence[argparse.Action]) -> dict[str, str]:
    words: list[str] = []
    for action in actions:
        words += [*map(str, action.choices or ()), *getattr(action, "suggestions", tuple)()]
    files = any(action.metavar in _FILES for action in actions)
    return {"words": " ".join(words), "files": "yes" if files else ""}


def suggest(action: argparse.Action, words: Callable[[], Sequence[str]]) -> None:
    """Offer words for an argument that takes others too; `words` is called when a script is
    printed."""
    action.suggestions = words  # type: ignore[attr-defined]


def commands(parser: argparse.ArgumentParser) -> dict[str, argparse.ArgumentParser]:
    """Return the parsers of a program's commands by name."""
    branches = (a for a in parser._actions if isinstance(a, argparse._SubParsersAction))
    return {name: command for branch in branches for name, command in branch.choices.items()}


def _options(parser: argparse.ArgumentParser) -> list[str]:
    every = (option for action in parser._actions for option in action.option_strings)
    return [option for option in every if option.startswith("--")]
