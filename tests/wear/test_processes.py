"""The second process: what it has not begun is done here, and nothing twice."""

import signal
from concurrent.futures import Future
from contextlib import nullcontext

import pytest

from wear import processes


class Pool:
    """A second process that has done all tasks, or begun none."""

    def __init__(self, *, idle: bool) -> None:
        self.idle = idle

    def submit(self, task, *given):
        future: Future[object] = Future()
        if not self.idle:
            future.set_result(f"there {task(*given)}")
        return future


@pytest.mark.parametrize(("idle", "found"), [(True, 3), (False, "there 3")])
def test_a_task_is_done_once(monkeypatch, idle, found):
    monkeypatch.setattr(processes, "cores", lambda: 2)
    monkeypatch.setattr(processes, "workers", lambda _: nullcontext(Pool(idle=idle)))
    with processes.assistant() as ask:
        assert ask(int, "3")() == found


def test_a_single_core_has_no_second_process(monkeypatch):
    monkeypatch.setattr(processes, "cores", lambda: 1)
    monkeypatch.setattr(processes, "workers", None)
    with processes.assistant() as ask:
        assert ask(int, "3")() == 3


def test_ctrl_c_does_not_reach_a_process_that_starts():
    with processes.workers(1) as pool:
        blocked = pool.submit(signal.pthread_sigmask, signal.SIG_BLOCK, ()).result()
    assert signal.SIGINT in blocked
