"""The hostile files of the readers' own tests, as uploads to the running service: refused by name, and nothing falls.

The tables are those of tests/formats; here only what HTTP and the queue add is asked: the status of each code, a
problem document without a word of ours in it, an end within seconds, and a service that answers a good file after all.
"""

import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from caesura.core.limits import Limits
from tests.formats.gltf.test_draco import HOSTILE as DRACO
from tests.formats.gltf.test_hostile_gltf import (
    ACCESSORS,
    ANIMATIONS,
    CONTAINERS,
    GEOMETRY,
    GRAPH,
    ODD,
    RESOURCES,
    SKINS,
    STRUCTURE,
    UNFOLDING,
)
from tests.formats.test_hostile_npz import FAULTS
from tests.formats.test_zip import HOSTILE as ZIPS
from tests.formats.test_zip import zipped
from tests.glb import Glb, bending_strip, moving_square

LONGEST_SECONDS = 10
CLIENTS = 4
STATUS = dict.fromkeys(("malformed-glb", "malformed-json", "malformed-npz", "malformed-zip", "malformed-bvh"), 400)
STATUS |= {"unsupported-media-type": 415}
"""All others are 422."""


def _mutated(base, mutate):
    model: Glb = base()
    mutate(model)
    return model.glb()


def _hostile():
    """(name, bytes, code, pointer) of every hostile file."""
    for base, rows in (
        (moving_square, STRUCTURE + ACCESSORS + GEOMETRY + GRAPH + ANIMATIONS + RESOURCES),
        (bending_strip, SKINS),
    ):
        for name, mutate, code, pointer in rows:
            yield name, _mutated(base, mutate), code, pointer
    for name, data, code in [*CONTAINERS, *FAULTS]:
        yield name, data, code, None
    for name, base, mutate, code in DRACO:
        yield name, _mutated(base, mutate), code, None
    for name, (files, code) in ZIPS.items():
        if code is not None:
            yield name, zipped(files), code, None
    for row in UNFOLDING:
        mutate, limits, _ = row.values
        if limits == Limits():
            yield row.id, _mutated(moving_square, mutate), "limit-exceeded", None


@pytest.fixture(scope="module")
def outcomes(service):
    """(name, code, pointer, answer, seconds) of the files, sent by several clients at once."""

    def sent(row):
        name, data, code, pointer = row
        began = time.monotonic()
        answer = service.http.post("/v1/segmentations", content=data, headers={"Prefer": "wait=30"})
        return name, code, pointer, answer, time.monotonic() - began

    service.http.post("/v1/segmentations", content=moving_square().glb(), headers={"Prefer": "wait=30"})
    with ThreadPoolExecutor(CLIENTS) as clients:
        return list(clients.map(sent, _hostile()))


@pytest.mark.filterwarnings("ignore:Duplicate name")
def test_hostile_uploads_are_refused_by_name(outcomes):
    """The status and code of the table, where it is in the file, and in no answer anything of the program itself."""
    wrong = []
    for name, code, pointer, answer, _ in outcomes:
        problem = answer.json()
        expected = (STATUS.get(code, 422), code, "application/problem+json")
        told = (answer.status_code, problem.get("code"), answer.headers["Content-Type"])
        leak = any(word in answer.text for word in ("Traceback", "File \\", "pickle", ".py"))
        if told != expected or leak or (pointer and problem.get("pointer") != pointer):
            wrong.append((name, told, problem.get("pointer"), problem.get("detail")))
    assert not wrong


def test_no_hostile_upload_takes_long(outcomes):
    """Ten seconds each, with the queue before it."""
    assert [(name, seconds) for name, *_, seconds in outcomes if seconds > LONGEST_SECONDS] == []


def test_odd_uploads_are_taken_and_the_service_goes_on(service, outcomes):
    """Rare but legal files are segmented, after all the others; the spool is empty and Redis at hand."""
    refused = []
    for name, mutate, _ in ODD:
        answer = service.http.post(
            "/v1/segmentations", content=_mutated(moving_square, mutate), headers={"Prefer": "wait=30"}
        )
        code = answer.json().get("code")
        if answer.status_code != 200 and code != "degenerate-mesh":  # what zero scale leaves has no area
            refused.append((name, answer.status_code, code))
    assert not refused
    assert not service.spooled()
    assert service.http.get("/readyz").status_code == 200
