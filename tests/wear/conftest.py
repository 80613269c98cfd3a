"""What tests of commands share: `wear` run in the process of the test."""

from collections.abc import Callable

import pytest

from tests.programs import status_of
from wear import cli

collect_ignore = ["typed_script.py"]  # a user's script, run in a folder of its own

Call = Callable[..., tuple[int, str, str]]


@pytest.fixture
def call(capsys: pytest.CaptureFixture[str]) -> Call:
    """`call("run", "section4")` runs a command; returns its status, output and messages."""

    def run(*arguments: str) -> tuple[int, str, str]:
        return status_of(cli.main, arguments), *capsys.readouterr()

    return run
