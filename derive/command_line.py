"""Programs with several commands: the form of a command, and the parser of the whole program.

Overview
    A command is a module of the same name.  Its docstring is its help: a summary in one line,
    and examples; ``add_arguments(parser)`` declares its arguments, except `--json`, which all
    have; ``execute(options)`` does the work and returns an ``Answer``.
Key results
    Answer     the result of a command
    Parser     collects the faults of arguments
    declare    an argument, as its usage shows it
    parser     the parser of a program with commands
    main       parse and execute
"""

from __future__ import annotations

import argparse
import difflib
import gc
import os
import re
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import Any

from derive import completion, terminal

Options = argparse.Namespace
"""The values of the arguments of a command, by their names."""

OF_THE_REPORT = ("matplotlib", "math_core", "markdown_it")
"""Packages that only figures and reports import: the extra `report`."""


@dataclass(frozen=True)
class Answer:
    """The result of a command.

    Attributes
    ----------
    document
        The document that `--json` prints.
    text
        Returns the same for a reader, empty if there is nothing to print.
    notices
        Remarks and warnings, printed to standard error.
    status
        The exit status.
    """

    document: object
    text: Callable[[], str] = str
    notices: Sequence[str] = ()
    status: int = terminal.DONE


class Parser(argparse.ArgumentParser):
    """A parser that collects arguments of a wrong type in `options.faults`.

    The command reports them with all other faults.
    """

    def __init__(self, **about: Any) -> None:
        super().__init__(**about)
        self.faults: list[str] = []
        self.set_defaults(faults=self.faults)

    def _get_value(self, action: argparse.Action, text: str) -> Any:
        try:
            return super()._get_value(action, text)
        except argparse.ArgumentError as fault:
            name = action.option_strings[-1] if action.option_strings else action.metavar
            self.faults.append(f"{name}: {fault.message}")
            return None


def declare(
    to: argparse._ActionsContainer,
    usage: str,
    help: str,
    words: Callable[[], Sequence[str]] | None = None,
    **about: Any,
) -> None:
    """Declare an argument as its usage shows it: `--strict`, `-o, --output FILE`, `[ID ...]`.

    An option without a value is a flag. Brackets and dots give the number of values, braces the
    choices; `words` are offered for completion. Other keywords go to `argparse`.
    """
    flags = re.findall(r"(?:^|, )(-[\w-]+)", usage)
    value = usage[len(", ".join(flags)) :].strip()
    shown = value.strip("[]").removesuffix(" ...")
    if shown.startswith("{"):
        about["choices"] = shown.strip("{}").split(",")
    elif shown:
        about["metavar"] = shown
    else:
        about["action"] = "store_true"
    if value.strip("[]").endswith(" ..."):
        about["nargs"] = "*" if value.startswith("[") else "+"
    elif value.startswith("["):
        about["nargs"] = "?"
    action = to.add_argument(*(flags or [about.pop("dest", shown.lower())]), help=help, **about)
    if words is not None:
        completion.suggest(action, words)


def parser(program: str, description: str, examples: str, names: str) -> Parser:
    """Return the parser of a program; `names` are the modules of its commands, in
    `program.commands`."""
    whole = Parser(
        prog=program,
        description=description,
        epilog=examples,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    terminal.add_common_options(whole)
    branches = whole.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for name in names.split():
        command: Any = import_module(f"{program}.commands.{name}")
        about, _, examples = (command.__doc__ or "").partition(".\n\n")  # none with -OO
        summary = about.partition(": ")[2]
        branch = branches.add_parser(
            name.rstrip("_"),
            help=summary,
            description=f"{summary[:1].upper()}{summary[1:]}.",
            epilog=examples,
            formatter_class=argparse.RawDescriptionHelpFormatter,
            allow_abbrev=False,
        )
        command.add_arguments(branch)
        declare(branch, "--json", "print one JSON document")
        branch.set_defaults(command=command, branch=branch)
    return whole


def main(
    whole: argparse.ArgumentParser,
    arguments: Sequence[str] | None,
    expected: Mapping[type[Exception], int],
) -> int:
    """Execute the command that the arguments name; return the exit status.

    SymPy's cache gets 20000 entries: a derivation exceeds the default of 1000.  Of millions of
    expressions hardly any is garbage, so that the collector runs rarely.
    """
    gc.set_threshold(200_000, 50, 100)
    os.environ.setdefault("SYMPY_CACHE_SIZE", "20000")
    words = sys.argv[1:] if arguments is None else list(arguments)

    def execute() -> int:
        options = _parsed(whole, words)
        try:
            answer = options.command.execute(options)
        except ModuleNotFoundError as missing:
            package = (missing.name or "").partition(".")[0]
            if package not in OF_THE_REPORT:
                raise
            extra = "pip install 'derive-wear[report]'"
            whole.error(f"{words[0]}: needs the package {package}: {extra}")
        if options.json:
            print(terminal.json_text(answer.document), end="")
        elif text := answer.text():
            print(text, end="" if text.endswith("\n") else "\n")
        for notice in answer.notices:
            terminal.complain(options.branch.prog, notice)
        return answer.status

    return terminal.run(" ".join([whole.prog, *words[:1]]), execute, expected)


def _parsed(whole: argparse.ArgumentParser, words: Sequence[str]) -> argparse.Namespace:
    """Parse the words; suggest a correction for a mistyped one, in the usage of its command."""
    if not words:
        whole.print_help(sys.stderr)
        whole.exit(terminal.USAGE)
    known = [*completion.commands(whole), *_options(whole)]
    if words[0] not in known:
        hint = _suggestion(words[0], known) or f"; `{whole.prog} --help` lists the commands"
        whole.error(f"{words[0]}: there is no such command{hint}")
    options, unknown = whole.parse_known_args(words)
    branch = options.branch
    if unknown:
        wrong = [word for word in unknown if word.startswith("-")]
        hints = (f"{word}: not understood{_suggestion(word, _options(branch))}" for word in wrong)
        branch.error("\n".join(hints) or f"{' '.join(unknown)}: more than this command takes")
    if twice := [name for action in branch._actions if (name := _repeated(action, words))]:
        branch.error("\n".join(f"{name}: given more than once; keep one" for name in twice))
    return options


def _repeated(action: argparse.Action, words: Sequence[str]) -> str:
    """Return the name of an option of one value if the words contain it several times."""
    given = [word for word in words if word.partition("=")[0] in action.option_strings]
    return given[-1] if type(action) is argparse._StoreAction and len(given) > 1 else ""


def _options(parser: argparse.ArgumentParser) -> list[str]:
    return [option for action in parser._actions for option in action.option_strings]


def _suggestion(word: str, known: Iterable[str]) -> str:
    """
    >>> _suggestion("--cylces", ["--cycles", "--json"])
    '; did you mean --cycles?'
    """
    near = difflib.get_close_matches(word, known, n=1)
    return f"; did you mean {near[0]}?" if near else ""
