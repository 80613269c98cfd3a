"""What all tests share: tools beyond Python, and how Hypothesis draws."""

import os
import shutil
from collections.abc import Callable

import pytest
from hypothesis import HealthCheck, settings

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


@pytest.fixture(scope="session")
def need_tool() -> Callable[..., str]:
    """`need_tool("gfortran")` gives a program's path, or skips the test (fails it under CI)."""
    return _need_tool
