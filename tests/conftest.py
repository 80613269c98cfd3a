"""What all tests share: tools beyond Python, and how Hypothesis draws."""

import gc
import os
import re
import shutil
from collections.abc import Callable, Iterator

import pytest
from hypothesis import HealthCheck, settings

from tests.browser import Page, browser

os.environ.setdefault("SYMPY_CACHE_SIZE", "20000")  # as the commands have it
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # of the matrices here none is worth a second
gc.set_threshold(200_000, 50, 100)  # of millions of expressions that stay, hardly any is garbage
# No test depends on the speed of the machine. Under CI the draws are the same every time, so that
# a commit either passes or does not; everywhere else they are new in every run.
settings.register_profile(
    "house",
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow],
    print_blob=True,
    derandomize=bool(os.environ.get("CI")),
)
settings.load_profile("house")


def _need_tool(*names: str) -> str:
    """Return the path of the first of these programs that is installed.

    Without any of them the test is skipped on a user's machine and fails under CI,
    where `.ci/run` has installed them all.
    """
    for name in names:
        path = shutil.which(name)
        if path is not None:
            return path
    reason = f"needs {' or '.join(names)}, which .ci/run installs"
    if os.environ.get("CI"):
        pytest.fail(reason)
    pytest.skip(reason)


#: Tests of the paper, of the ledger that it quotes and of the browser that shows it.
_OF_THE_PAPER = (
    "tests/wear/report/",
    "tests/derive/test_claims.py",
    "tests/test_docs.py",
    "tests/wear/test_cli_re",
    "tests/wear/test_explorer.py",
)
_DEAREST = (*_OF_THE_PAPER, "tests/derive/", "tests/wear/test_study.py", "tests/wear/test_bench")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Put the files that take longest first, so that all processes end at about the same time."""

    def place(item: pytest.Item) -> int:
        starts = map(item.nodeid.startswith, _DEAREST)
        return next((n for n, here in enumerate(starts) if here), len(_DEAREST))

    items.sort(key=place)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: object) -> object:
    """Return how tests are shared among processes, where pytest-xdist is installed: all of a file,
    and of files whose names begin alike, go to one process, which makes once what they share; so
    those of the paper. (Marks of groups do not reach pytest-xdist 3.8 from pytest 9.2.)"""
    from xdist.scheduler import LoadScopeScheduling

    class ByFile(LoadScopeScheduling):
        def _split_scope(self, nodeid: str) -> str:
            of_the_paper = nodeid.startswith(_OF_THE_PAPER)
            return "paper" if of_the_paper else re.match(r"[^:]*/test_[a-z]+|[^:]*", nodeid)[0]

    config.option.loadscopereorder = False
    return ByFile(config, log)


@pytest.fixture(scope="session")
def chromium(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    """A browser for all tests of a process."""
    program = _need_tool("chromium", "chromium-browser", "google-chrome")
    with browser(program, tmp_path_factory.mktemp("profile")) as page:
        yield page


@pytest.fixture
def window(chromium: Page) -> Page:
    """The page of the browser, of the size of a desk's screen, with nothing emulated."""
    chromium.size(1280, 1000)
    chromium.command("Emulation.setEmulatedMedia", media="", features=[])
    chromium.complaints.clear()
    chromium.requests.clear()
    return chromium


@pytest.fixture(scope="session")
def need_tool() -> Callable[..., str]:
    """`need_tool("gfortran")` gives a program's path, or skips the test (fails it under CI)."""
    return _need_tool
