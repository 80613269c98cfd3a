"""Exit status, messages and JSON, as every command has them."""

import argparse
import io
import json
import math
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from derive import completion, terminal
from tests.programs import ended, python, run


class SceneError(Exception):
    """Stands for what is the user's to mend."""


def stop(fault):
    def main():
        raise fault

    return main


@pytest.mark.parametrize(
    ("fault", "status", "message"),
    [
        (SceneError("two faults:\none\ntwo"), 2, "wear run: two faults:\none\ntwo\n"),
        (FileNotFoundError(2, "No such file", "a.toml"), 2, "wear run: a.toml: No such file\n"),
        (OSError("no space"), 2, "wear run: no space\n"),
        (KeyboardInterrupt(), 130, "wear run: interrupted\n"),
    ],
)
def test_the_users_faults_have_a_message_and_a_status(capsys, fault, status, message):
    assert terminal.run("wear run", stop(fault), {SceneError: 2}) == status
    assert capsys.readouterr() == ("", message)


DESTROYED = """
import signal, threading
from derive import terminal
signal.signal(signal.SIGINT, signal.default_int_handler)

class Destroyed:
    def __del__(self):
        raise KeyboardInterrupt

def main():
    Destroyed()
    threading.Event().wait(60.0)
    return 0

print(terminal.run("wear", main, {}))
"""


def test_an_interrupt_within_a_destructor_is_not_lost():
    """In a process of its own, which may have been started with interrupts ignored."""
    begun = time.monotonic()
    assert python(DESTROYED) == "130\n"
    assert time.monotonic() - begun < 50.0, "it came when the waiting was over"


def test_our_own_faults_are_not_hidden():
    with pytest.raises(ZeroDivisionError):
        terminal.run("wear run", stop(ZeroDivisionError()), {SceneError: 2})


def test_a_reader_that_has_seen_enough_is_no_fault():
    code = """
from derive import terminal
def main():
    for number in range(100_000):
        print(number)
    return 0
raise SystemExit(terminal.run("derive list", main, {}))
"""
    with subprocess.Popen(
        [sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE
    ) as run:
        assert run.stdout.readline() == b"0\n"
        run.stdout.close()
        assert run.stderr.read() == b""
    assert run.returncode == 0


def test_a_title_that_the_terminal_cannot_show_is_no_fault():
    code = r"""
from derive import terminal
terminal.run("wear run", lambda: print("palier \u00e0 \u03c3") or 0, {})
"""
    assert python(code, env={"PYTHONIOENCODING": "ascii"}) == "palier \\xe0 \\u03c3\n"


@pytest.mark.parametrize("closed", [">&-", ">&- 2>&-", "2>&-"])
def test_a_closed_output_is_no_fault(closed):
    code = """
from derive import terminal
raise SystemExit(terminal.run("derive list", lambda: print("one") or 0, {}))
"""
    done = ended("sh", "-c", f'"$0" -c "$1" {closed}', sys.executable, code)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize(("encoding", "drawn"), [("utf-8", True), ("ascii", False)])
def test_formulas_are_drawn_with_what_the_terminal_has(encoding, drawn):
    code = "from derive import terminal; print(terminal.shows_formulas())"
    assert python(code, env={"PYTHONIOENCODING": encoding}) == f"{drawn}\n"


class Terminal(io.StringIO):
    """Stands for a terminal under standard error."""

    def isatty(self):
        return True


@pytest.mark.parametrize(
    ("screen", "kind", "shown"),
    [(Terminal, "xterm", "\r\033[Kverifying"), (Terminal, "dumb", ""), (io.StringIO, "xterm", "")],
)
def test_progress_is_for_a_terminal_that_can_take_it_back(monkeypatch, screen, kind, shown):
    monkeypatch.setenv("TERM", kind)
    monkeypatch.setattr(sys, "stderr", screen())
    terminal.progress("verifying")
    assert sys.stderr.getvalue() == shown


def test_progress_stays_on_one_line(monkeypatch):
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "20")
    monkeypatch.setattr(sys, "stderr", Terminal())
    terminal.progress("x" * 50)
    assert sys.stderr.getvalue().count("x") == 19


def test_what_takes_long_is_shown_until_it_is_done(monkeypatch):
    shown = []
    told = {"counting": threading.Event(), "sampling": threading.Event(), "": threading.Event()}

    def progress(what):
        shown.append(what)
        told[what.partition(" (")[0]].set()

    monkeypatch.setattr(terminal, "SILENT", 0.0)
    monkeypatch.setattr(terminal, "progress", progress)
    with terminal.busy("counting") as tell:
        assert told["counting"].wait(60)
        tell("sampling")
        assert told["sampling"].wait(60)
        assert not told[""].is_set()
    assert shown[0] == "counting (0 s)"
    assert shown[-1] == ""


DOCUMENTS = st.recursive(
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats(allow_nan=False, allow_infinity=False)
    | st.text(),
    lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner),
)


@given(DOCUMENTS)
def test_what_json_can_hold_reads_back_the_same(document):
    assert json.loads(json.dumps(terminal.plain(document), allow_nan=False)) == document


def test_arrays_become_lists_and_what_is_no_number_null():
    wear = np.array([1e-7, np.nan, np.inf, 0.1 + 0.2])
    given = {"wear": wear, "best": wear[0], "count": np.int64(3), "limit": -math.inf}
    document = json.loads(terminal.json_text(given), parse_constant=pytest.fail)
    assert document == {
        "wear": [1e-7, None, None, 0.1 + 0.2],
        "best": 1e-7,
        "count": 3,
        "limit": None,
    }


def test_what_has_no_form_in_json_is_refused():
    with pytest.raises(TypeError, match="object"):
        terminal.plain({"odd": object()})


@pytest.fixture
def parser():
    whole = argparse.ArgumentParser(prog="toy")
    terminal.add_common_options(whole)
    run = whole.add_subparsers().add_parser("run")
    run.add_argument("--method", choices=["auto", "Radau"])
    run.add_argument("--cycles", metavar="N,...")
    run.add_argument("-o", "--output", metavar="FILE")
    completion.suggest(run.add_argument("--set"), lambda: ["contact.law=", "load.kind="])
    scene = run.add_argument("scene", metavar="SCENE")
    completion.suggest(scene, lambda: ["section3", "section4"])
    return whole


def complete(script: str, *words: str) -> list[str]:
    """Return what bash offers for the last of these words."""
    quoted = " ".join(f"'{word}'" for word in words)
    ask = f"COMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}; _toy_complete; "
    shown = run("bash", "-c", script + "\n" + ask + 'printf "%s\\n" "${COMPREPLY[@]}"')
    return shown.split("\n")[:-1] if shown != "\n" else []


@pytest.mark.parametrize(
    ("words", "offered"),
    [
        (["toy", "r"], ["run"]),
        (["toy", "--v"], ["--version"]),
        (["toy", "run", "sec"], ["section3", "section4"]),
        (["toy", "run", ""], ["section3", "section4", "mine of today.toml"]),
        (["toy", "run", "--m"], ["--method"]),
        (["toy", "run", "section3", "--method", ""], ["auto", "Radau"]),
        (["toy", "run", "--method", "Radau", "s"], ["section3", "section4"]),
        (["toy", "run", "--cycles", ""], []),
        (["toy", "run", "-o", ""], ["mine of today.toml"]),
        (["toy", "run", "--set", "con"], ["contact.law="]),
        (["toy", "run", "--set", "contact.law", "=", ""], []),
        (["toy", ""], ["run", "--help", "--version", "--print-completion"]),
    ],
)
def test_bash_completes(parser, need_tool, words, offered, tmp_path, monkeypatch):
    need_tool("bash")
    (tmp_path / "mine of today.toml").touch()
    monkeypatch.chdir(tmp_path)
    assert complete(completion.bash(parser), *words) == offered


def test_a_table_wider_than_the_terminal_goes_on_below(monkeypatch):
    monkeypatch.setattr(terminal.sys.stdout, "isatty", lambda: True, raising=False)
    monkeypatch.setenv("COLUMNS", "13")
    shown = terminal.table(["cycle", "wear", "closure"], [["1", "2.5", "3"]])
    assert shown == "cycle  wear\n    1   2.5\n\ncycle  closure\n    1        3"
