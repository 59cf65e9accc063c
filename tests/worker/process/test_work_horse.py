"""The fork that stands ready: it does what it is given, and its end is told."""

import os
import random
import signal
import time
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
        assert horse.start_job(order)
        assert horse.wait() == (horse.pid, os.EX_OK)
        assert horse.status is None
    assert (tmp_path / "prepared").exists()
    assert (tmp_path / "first").read_text() == (tmp_path / "second").read_text() == str(horse.pid)
    assert Path(f"/proc/{horse.pid}/comm").read_text().strip() == READY
    horse.start_job("last")
    horse.wait()


def test_its_last_job_ends_it_in_order(horse):
    """The exit status is that of a job done."""
    horse.start_job("last")
    assert horse.wait() == (horse.pid, os.EX_OK)
    assert horse.status == os.EX_OK
    assert not horse.start_job("more")


def test_a_killed_one_is_told_as_killed(horse):
    """With the signal, as for any fork."""
    horse.start_job("fault")
    _, status = horse.wait()
    assert os.WTERMSIG(status) == signal.SIGKILL


class Struck(Exception):
    """The worker's timer, as RQ has one."""


def strike(*_):
    """The timer's handler."""
    raise Struck


@pytest.fixture
def timer():
    """Sets the timer to some seconds."""
    before = signal.signal(signal.SIGALRM, strike)
    yield lambda seconds: signal.setitimer(signal.ITIMER_REAL, seconds)
    signal.setitimer(signal.ITIMER_REAL, 0)
    signal.signal(signal.SIGALRM, before)


@pytest.mark.parametrize("lasts", [True, False], ids=["that go on", "that end"])
def test_a_timer_that_strikes_as_the_job_ends_costs_nothing(timer, lasts):
    """The end of the job is seen at the next look; it was lost once, and the worker waited for an hour."""
    strikes, horse = 0, None
    draw = random.Random(7)
    for _ in range(150 if lasts else 40):
        horse = horse or WorkHorse(lambda: None, lambda _: time.sleep(0.004) or lasts)
        horse.start_job("short")
        try:
            timer(0.004 + draw.uniform(0, 0.0012))
            horse.wait()
            timer(0)
        except Struck:
            strikes += 1
            timer(5)  # far more than a job takes
            horse.wait()
            timer(0)
        if not lasts:
            assert horse.status == os.EX_OK
            horse = horse.close()
    assert strikes
    if horse:
        horse.close()


def test_let_go_it_ends():
    """Without an order it waits; when nobody can give it one any more, it ends."""
    idle = WorkHorse(lambda: None, lambda _: True)
    idle.close()
    assert idle.status == os.EX_OK
