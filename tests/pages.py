"""The code blocks of a Markdown page, and how each kind is run.

Conventions of the pages
    ``console``   lines that begin with ``$ `` are commands, what follows is what they print; a
                  command that fails prints its messages too and then ``[status N]``
    ``pycon``     a Python session, run as a doctest; the sessions of a page share their names
    ``sh``        not run: sets up the machine, or takes minutes; but each line must be one that
                  `understood` knows
    ``...``       stands for any text, in both
"""

import doctest
import io
import os
import re
import shlex
import sys
from collections.abc import Callable, Iterator
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from typing import NamedTuple

import derive.cli
import wear.cli
from tests.programs import ended, status_of

FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
_SET_UP = re.compile(
    r"git clone \S+ derive-wear|cd derive-wear|make (?P<target>\w+)|\. \.venv/bin/activate"
    r"|apt install [\w .-]+"
)
_FENCE = re.compile(r"^```(?P<language>[^\s`]*) *(?P<argument>.*)\n(?P<body>(?:.*\n)*?)```$", re.M)
_OPTION = re.compile(r"^:(\w+): *(.*)\n", re.M)
_SHELL = re.compile(r"[|<>;&*?`$]")


class Block(NamedTuple):
    """A fenced block: where it begins, its language and argument, its options, what it holds."""

    line: int
    language: str
    argument: str
    options: dict[str, str]
    body: str


class Command(NamedTuple):
    """A line of a console, what it should print and with which status it should end."""

    line: str
    printed: str
    status: int


def blocks(page: str) -> list[Block]:
    """Every fenced block of a page."""
    found = []
    for fence in _FENCE.finditer(page):
        options = dict(_OPTION.findall(fence["body"])) if fence["language"][:1] == "{" else {}
        line = page.count("\n", 0, fence.start()) + 1
        found.append(Block(line, fence["language"], fence["argument"], options, fence["body"]))
    return found


def commands(body: str) -> Iterator[Command]:
    """The commands of a console."""
    for piece in re.split(r"^\$ ", body, flags=re.M)[1:]:
        line, _, printed = piece.partition("\n")
        status = re.search(r"^\[status (\d+)\]\n", printed, re.M)
        expected = printed if status is None else printed[: status.start()]
        yield Command(line, expected, 0 if status is None else int(status[1]))


def understood(line: str, targets: set[str]) -> bool:
    """Whether a line of ``sh`` sets up the machine, by targets that make has, or is a command
    with arguments that its program takes."""
    program, *arguments = shlex.split(line, comments=True)
    parsers = {"derive": derive.cli.parser, "wear": wear.cli.parser}
    if program in parsers:
        parsers[program]().parse_args(arguments)  # exits if it does not take them
        return True
    known = _SET_UP.fullmatch(line)
    return known is not None and (known["target"] or "reproduce") in targets


def in_process(line: str) -> tuple[str, int]:
    """Run a command line; `wear` and `derive` in this process, anything else by the shell."""
    line, _, output = line.partition(" > ")
    program, *arguments = shlex.split(line)
    mains = {"derive": derive.cli.main, "wear": wear.cli.main}
    if program not in mains or _SHELL.search(line):
        return by_shell(f"{line} > {output}" if output else line)
    printed, told = io.StringIO(), io.StringIO()
    with redirect_stdout(printed), redirect_stderr(told):
        status = status_of(mains[program], arguments)
    if output:
        Path(output).write_text(printed.getvalue(), encoding="utf-8")
        return "", status
    return printed.getvalue() + (told.getvalue() if status else ""), status


def by_shell(line: str) -> tuple[str, int]:
    """Run a command line by the shell, with the programs of this environment first."""
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    run = ended("sh", "-c", line, env={**os.environ, "PATH": path})
    return run.stdout + (run.stderr if run.returncode else ""), run.returncode


def difference(command: Command, run: Callable[[str], tuple[str, int]]) -> str:
    """What a command printed, if that is not what it should have; else nothing."""
    printed, status = run(command.line)
    agrees = doctest.OutputChecker().check_output(command.printed or "", printed, FLAGS)
    if status == command.status and (agrees or not command.printed):
        return ""
    return f"$ {command.line}\n{printed}[status {status}]"


def session(page: str, name: str) -> str:
    """Run the Python sessions of a page in one namespace; return what failed."""
    text = "\n".join(block.body for block in blocks(page) if block.language == "pycon")
    test = doctest.DocTestParser().get_doctest(text, {}, name, name, 0)
    report: list[str] = []
    doctest.DocTestRunner(optionflags=FLAGS).run(test, out=report.append)
    return "".join(report)
