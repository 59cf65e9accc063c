"""Jobs of collections whose worker is lost: what they were for says so, and does not wait for ever."""

import pytest

from caesura.worker.queue.collection_jobs import fail_collection_job, fail_if_lost, submit_proposal, submit_search
from caesura.worker.queue.job_problems import KILLED
from caesura.worker.records.collection_types import CollectionRecord, ProposalRecord, SearchRecord, TakeRecord
from caesura.worker.records.collections import CollectionChange

IDENTIFIER = "c" * 24


@pytest.fixture
def collection(idle, take):
    """One with a take that is analysed next, and one whose segmentation is gone."""
    record = CollectionRecord(id=IDENTIFIER, owner="", name="all", created=1.0, updated=1.0)
    idle.records.collections.create(record)
    animation = idle.upload(take)
    live = idle.submit(animation)
    takes = tuple(
        TakeRecord(animation=name, segmentation=segmentation, name=name, added=float(place))
        for place, (name, segmentation) in enumerate([(animation.id, live.id), ("gone", "gone")])
    )
    idle.records.collections.change(IDENTIFIER, lambda kept: CollectionChange(kept, takes))
    return live


def test_takes_that_were_to_be_labelled_have_failed(idle, collection):
    """Those that are still analysed go on."""
    fail_collection_job(idle.jobs, "collect", [IDENTIFIER], KILLED)
    takes = idle.records.collections.takes(IDENTIFIER, [collection.animation, "gone"])
    assert [(take.status, take.problem) for take in takes] == [("waiting", None), ("failed", KILLED)]
    record = idle.records.collections.one(IDENTIFIER)
    assert (record.takes, record.waiting, record.failed) == (2, 1, 1)


def test_a_proposal_whose_job_is_lost_has_failed(idle, collection):
    """Not while its job waits."""
    proposal = submit_proposal(idle.jobs, IDENTIFIER, ProposalRecord(id="p", kind="recut", created=1.0))
    fail_if_lost(idle.jobs, IDENTIFIER, proposal)
    assert idle.records.collections.proposal(IDENTIFIER, "p").status == "working"
    idle.redis.flushdb()
    idle.records.collections.create(CollectionRecord(id=IDENTIFIER, owner="", name="", created=1.0, updated=1.0))
    idle.records.collections.put_proposal(IDENTIFIER, proposal)
    fail_if_lost(idle.jobs, IDENTIFIER, proposal)
    assert idle.records.collections.proposal(IDENTIFIER, "p").problem["code"] == "worker-lost"


def test_a_search_waits_for_its_animation(idle, collection):
    """No job before that is over, which is no loss; then there is one."""
    wanted = SearchRecord(
        id="s", created=1.0, animation=collection.animation, segmentation=collection.id, start=0, end=9, limit=3
    )
    search = submit_search(idle.jobs, IDENTIFIER, wanted)
    assert not idle.jobs.queues.is_waiting("cut", search.token)
    fail_if_lost(idle.jobs, IDENTIFIER, search)
    assert idle.records.collections.search(IDENTIFIER, "s").status == "working"
    idle.jobs.cancel(collection.id)
    assert idle.jobs.queues.is_waiting("cut", search.token)
