"""Uploads of several files: a mesh with its motion, and zips."""

import io
import zipfile

import httpx

from tests.formats.point_caches import MESH, folding_sheet, pc2
from tests.glb import Glb, bending_strip, moving_square


def mesh() -> bytes:
    model = bending_strip()
    for name, node in zip(("body", "lower", "upper"), model.json["nodes"], strict=True):
        node["name"] = name
    del model.json["animations"]
    return model.glb()


def motion() -> bytes:
    model = Glb(scene=0, scenes=[{"nodes": [0]}], nodes=[{"name": "upper"}])
    model.animate(0, "rotation", [0, 1], [[0, 0, 0, 1], [0, 0, 1, 0]])
    return model.glb()


def posted(service, **files):
    return httpx.post(f"{service.url}/v1/animations", files={name: (name, data) for name, data in files.items()})


def test_a_mesh_and_its_motion_are_one_animation(service):
    """Described by the file that moves, whichever comes first; two whole animations are not one."""
    answer = posted(service, mesh=mesh(), motion=motion())
    assert answer.status_code == 201, answer.text
    assert [take["duration_seconds"] for take in answer.json()["takes"]] == [1.0]
    refused = posted(service, one=moving_square().glb(), two=moving_square().glb())
    assert (refused.status_code, refused.json()["code"]) == (400, "one-animation")


def test_a_point_cache_and_its_mesh_are_one_animation(service):
    """Segmented as one; a cache alone is refused at once, with what it needs."""
    cache, mesh_of_it = pc2(folding_sheet(60)), MESH
    files = [("file", ("a.pc2", cache)), ("file", ("a.obj", mesh_of_it))]
    answer = httpx.post(f"{service.url}/v1/segmentations", files=files, headers={"Prefer": "wait=30"}, timeout=60)
    assert (answer.status_code, answer.json()["status"]) == (200, "done"), answer.text
    assert answer.json()["frames"] == 60
    refused = httpx.post(f"{service.url}/v1/animations", content=cache)
    assert (refused.status_code, refused.json()["code"]) == (422, "missing-companion")
    assert ".obj" in refused.json()["detail"]


def test_a_zip_is_an_animation(service):
    """Described by what is in it; one that holds none is of a wrong kind."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as file:
        file.writestr("walk/square.glb", moving_square().glb())
    answer = httpx.post(f"{service.url}/v1/animations", content=out.getvalue())
    assert answer.status_code == 201, answer.text
    assert (answer.json()["format"], answer.json()["vertices"]) == ("zip", 4)
    with zipfile.ZipFile(out := io.BytesIO(), "w") as file:
        file.writestr("notes.txt", "hello")
    refused = httpx.post(f"{service.url}/v1/animations", content=out.getvalue())
    assert (refused.status_code, refused.json()["code"]) == (415, "unsupported-media-type")
