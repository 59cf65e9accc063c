"""The fork that stands ready: it does what it is given, and its end is told."""

import os
import signal
from pathlib import Path

import pytest

from caesura.worker.process.work_horse import READY, WorkHorse


@pytest.fixture
def horse(tmp_path):
    """A horse that writes its orders into files; "last" is its last, and "fault" kills it."""

    def work(order):
        if order == "fault":
            os.kill(os.getpid(), signal.SIGKILL)
        (tmp_path / order).write_text(str(os.getpid()))
        return order != "last"

    horse = WorkHorse((tmp_path / "prepared").touch, work)
    yield horse
    horse.close()


def test_it_is_prepared_and_does_one_job_after_the_other(horse, tmp_path):
    """In a process of its own, which is the same for both."""
    for order in ("first", "second"):
        assert horse.give(order)
        assert horse.wait() == (horse.pid, os.EX_OK, None)
    assert (tmp_path / "prepared").exists()
    assert (tmp_path / "first").read_text() == (tmp_path / "second").read_text() == str(horse.pid)
    assert Path(f"/proc/{horse.pid}/comm").read_text().strip() == READY
    horse.give("last")
    horse.wait()


def test_its_last_job_ends_it_in_order(horse):
    """The exit status is that of a job done."""
    horse.give("last")
    pid, status, used = horse.wait()
    assert (pid, status) == (horse.pid, os.EX_OK)
    assert used is not None
    assert not horse.give("more")


def test_a_killed_one_is_told_as_killed(horse):
    """With the signal, as for any fork."""
    horse.give("fault")
    _, status, _ = horse.wait()
    assert os.WTERMSIG(status) == signal.SIGKILL


def test_let_go_it_ends(tmp_path):
    """Without an order it waits; when nobody can give it one any more, it ends."""
    idle = WorkHorse(lambda: None, lambda _: True)
    idle.close()
    assert os.waitpid(idle.pid, 0)[1] == os.EX_OK
