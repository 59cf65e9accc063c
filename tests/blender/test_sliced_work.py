"""Work in slices, and threads that it waits for."""

import threading
import time

import pytest

from blender.caesura_addon.sliced_work import WAIT, SlicedWork, SliceEnd, in_thread

BUDGET = 0.01


def finish(steps, end=None, budget=BUDGET):
    work, slices = SlicedWork(steps, budget, end), 1
    while work.resume():
        slices += 1
    return work, slices


def test_a_slice_ends_after_its_budget_and_says_how_long_it_took():
    def steps():
        for _ in range(30):
            time.sleep(0.003)
            yield

    work, slices = finish(steps())
    assert slices > 3
    assert BUDGET <= work.longest < 0.1


def test_a_slice_ends_where_the_work_has_to_wait():
    def steps():
        yield WAIT
        yield WAIT

    assert finish(steps(), budget=60)[1] == 3


def test_what_belongs_to_the_end_of_a_slice_is_called_at_every_one_also_after_a_fault():
    seen, end = [], SliceEnd()
    end.call = lambda: seen.append(1)

    def steps():
        yield WAIT
        raise ValueError("reason")

    with pytest.raises(ValueError, match="reason"):
        finish(steps(), end)
    assert len(seen) == 2


def test_a_thread_answers_where_it_is_waited_for():
    found = []

    def steps():
        found.append((yield from in_thread(lambda stop: stop.is_set())))

    finish(steps())
    assert found == [False]


def test_what_a_thread_raises_is_raised_where_it_is_waited_for():
    def fail(stop):
        raise KeyError("reason")

    with pytest.raises(KeyError, match="reason"):
        finish(in_thread(fail))


def test_a_thread_is_told_when_nobody_waits_any_more():
    told = threading.Event()

    def wait(stop):
        stop.wait(10)
        told.set()

    work = SlicedWork(in_thread(wait), BUDGET)
    assert work.resume()
    work.close()
    assert told.wait(5)
