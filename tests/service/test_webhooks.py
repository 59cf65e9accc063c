"""A webhook comes at least once, signed, however its receiver fails, and never to a private address."""

import json
import socket
import time
from ipaddress import ip_address

import pytest
import redis

from benchmarks.timing.receiver import Receiver
from caesura.service.http.outgoing.address_policy import AddressPolicy, ForbiddenAddress
from caesura.service.webhooks.delivery_queue import LONGEST_PAUSE_SECONDS, MOST_FAILURES, pause_seconds

TAKES = 6


@pytest.fixture
def receiver(service):
    made = Receiver(service.http.get("/v1/callbacks/secret").json()["secret"])
    yield made
    made.die()


def left_over(service, made):
    """What Redis still keeps of webhooks of these segmentations; other tests have receivers that never answer."""
    with redis.Redis.from_url(service.redis_url) as client:
        calls = [client.get(key) or b"{}" for key in client.scan_iter("caesura:delivery:*")]
        waiting = [one for one in made if client.exists(f"caesura:callbacks:{one}")]
    return waiting + [one for call in calls if (one := json.loads(call).get("segmentation")) in made]


def test_each_comes_at_least_once_though_the_receiver_fails_and_dies(service, take, receiver):
    """Of files, forms and JSON; signed, and nothing stays behind."""
    made = []
    for number in range(TAKES):
        given = {"params": {"callback_url": receiver.url, "motions": 3}, "content": take(7100 + number)}
        if number % 3 == 1:
            fields = {"callback_url": receiver.url, "motions": "3"}
            given = {"data": fields, "files": {"file": ("take.npz", take(7100 + number))}}
        if number % 3 == 2:
            animation = service.http.post("/v1/animations", content=take(7100 + number)).json()["id"]
            given = {"json": {"animation": animation, "motions": 3, "callback_url": receiver.url}}
        answer = service.http.post("/v1/segmentations", **given)
        assert answer.status_code in {200, 202}, answer.text
        made.append(answer.json()["id"])
        if number == TAKES // 2:
            receiver.die()
    time.sleep(1)
    receiver.start()
    assert receiver.wait_for(made, 60)
    assert all(call.signed for call in receiver.calls)
    assert receiver.failed
    document = next(call.document for call in receiver.calls if call.document["data"]["id"] == made[0])
    assert document["type"] == "segmentation.done"
    assert service.http.get(document["data"]["links"]["self"]).json()["finished"][:22] == document["timestamp"][:22]
    deadline = time.monotonic() + 10
    while left_over(service, made) and time.monotonic() < deadline:
        time.sleep(0.1)
    assert left_over(service, made) == []


def test_what_is_over_already_is_told_at_once(service, take, receiver):
    """The same file and parameters again are the same segmentation: who asks is told all the same."""
    content = take(7120)
    done = service.http.post("/v1/segmentations?motions=3", content=content, headers={"Prefer": "wait=30"}).json()
    again = service.http.post(f"/v1/segmentations?motions=3&callback_url={receiver.url}", content=content).json()
    assert again["id"] == done["id"]
    assert receiver.wait_for([done["id"]], 20)


def test_a_cancelled_one_is_told_too(service, take, receiver):
    """With its state."""
    made = service.http.post(f"/v1/segmentations?callback_url={receiver.url}", content=take(7121)).json()
    service.http.delete(made["links"]["self"])
    assert receiver.wait_for([made["id"]], 20)


@pytest.mark.parametrize(
    "url",
    ["http://127.0.0.1/", "http://localhost:8000/", "http://[::1]/", "http://[::ffff:127.0.0.1]/", "http://2130706433/",
     "http://0x7f000001/", "http://0177.0.0.1/", "http://127.1/", "http://0/", "http://169.254.169.254/latest",
     "http://10.0.0.1/", "http://[fd00::1]/", "http://[64:ff9b::7f00:1]/", "http://[2002:7f00:1::]/",
     "http://100.64.0.1/", "http://224.0.0.1/", "http://8.8.8.8:25/"],
)  # fmt: skip
def test_an_address_that_is_not_public_is_refused(idle, take, url):
    """Whatever way it is written in, before the file is read; the answer names no address."""
    answer = idle.http.post("/v1/segmentations", params={"callback_url": url}, content=take(7130))
    assert (answer.status_code, answer.json()["code"]) == (422, "forbidden-address")
    assert "127.0.0.1" not in answer.json()["detail"]


@pytest.mark.parametrize(
    "url", ["ftp://example.com/", "//example.com", "http://", "http://a:b@8.8.8.8/", "http://8.8.8.8/#x", "http://8.8.8.8/\n",
            "http://8.8.8.8:99999/", "x" * 3000, "http://8.8.8.8\\@127.0.0.1/", "http://8.8.8.8/" + "a" * 2000],
)  # fmt: skip
def test_what_is_no_address_is_refused(idle, take, url):
    """With the parameter that it came in."""
    answer = idle.http.post("/v1/segmentations", params={"callback_url": url}, content=take(7131))
    assert (answer.status_code, answer.json()["parameter"]) == (422, "callback_url")


def test_the_operator_allows_networks_one_by_one():
    """Those that are listed, and no other private one; a public one needs no leave."""
    policy = AddressPolicy("10.1.0.0/16, ::1")
    for address in ("10.1.2.3", "::1", "8.8.8.8", "2606:4700::1", "::ffff:10.1.2.3"):
        policy.check(address, 443)
    for address in ("10.2.0.1", "127.0.0.1", "::ffff:127.0.0.1", "fe80::1%eth0"):
        with pytest.raises(ForbiddenAddress):
            policy.check(address, 443)
    with pytest.raises(ValueError, match="does not appear"):
        AddressPolicy("everywhere")
    assert ip_address("8.8.8.8").is_global


def test_each_owner_has_a_key_of_its_own():
    """And pauses grow from seconds to an hour."""
    from caesura.worker.records.content_ids import webhook_secret

    assert webhook_secret(b"installation", "ada") != webhook_secret(b"installation", "eve")
    assert len(webhook_secret(b"installation", "")) == 32
    pauses = [pause_seconds(failures) for failures in range(1, MOST_FAILURES)]
    assert pauses == sorted(pauses)
    assert pauses[0] == 2
    assert pauses[-1] == LONGEST_PAUSE_SECONDS
    assert 2 * 3600 < sum(pauses) < 2.5 * 3600


def test_a_redirect_is_not_followed(service, take):
    """It is a failure like any other: nobody is led to where the check did not look."""
    with socket.create_server(("127.0.0.1", 0)) as first, socket.create_server(("127.0.0.1", 0)) as second:
        there = f"http://127.0.0.1:{second.getsockname()[1]}/"
        here = f"http://127.0.0.1:{first.getsockname()[1]}/"
        service.http.post(f"/v1/segmentations?motions=3&callback_url={here}", content=take(7140))
        first.settimeout(20)
        connection, _ = first.accept()
        connection.recv(65536)
        connection.sendall(f"HTTP/1.1 307 Away\r\nLocation: {there}\r\nContent-Length: 0\r\n\r\n".encode())
        connection.close()
        second.settimeout(1.5)
        with pytest.raises(TimeoutError):
            second.accept()
