"""docs/api.md is true: its query names are those of the OpenAPI document, and its examples run as they stand."""

import json
import re
import shutil
import subprocess
import threading
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer

import numpy as np
import pytest

from caesura.service.app import create_app
from caesura.service.settings import ServiceSettings
from tests.conftest import unavailable
from tests.formats.point_caches import MESH, folding_sheet, pc2
from tests.glb import Glb, bending_strip


@pytest.fixture(scope="module")
def page(checkout):
    return (checkout / "docs/api.md").read_text(encoding="utf-8")


def test_every_query_name_is_documented(page):
    """And every header that a call wants."""
    for path, calls in create_app(ServiceSettings()).openapi()["paths"].items():
        for method, call in calls.items():
            for parameter in call.get("parameters", []):
                if parameter["in"] != "path":
                    named = rf"`{parameter['name']}[`:=]|[?&]{parameter['name']}="
                    assert re.search(named, page, re.IGNORECASE), f"{method} {path}: {parameter['name']}"


def test_every_query_name_of_the_page_is_known(page):
    """What an example asks for, the call that it is of takes."""
    calls = create_app(ServiceSettings()).openapi()["paths"]
    shapes = {re.compile(re.sub(r"\{\w+\}", "[^/?]+", path).replace(".", r"\.")): path for path in calls}
    for address, query in re.findall(r"localhost:8000(/[^\s?']*)\?([^\s']+)", page):
        call = next(calls[path] for shape, path in shapes.items() if shape.fullmatch(address))
        known = {p["name"] for one in call.values() for p in one.get("parameters", [])}
        assert {pair.partition("=")[0] for pair in query.split("&")} <= known, address


def strip(**animation):
    """A named strip that, where it is animated, nods, widens and does both for eight seconds."""
    model = bending_strip()
    for name, node in zip(("body", "lower", "upper"), model.json["nodes"], strict=True):
        node["name"] = name
    del model.json["animations"]
    if animation:
        model.json["animations"] = [{**animation, "samplers": [], "channels": []}]
        times = np.arange(240) / 30
        nod = 0.6 * np.sin(6 * times) * ((times < 3) | (times > 5.5))
        model.animate(2, "rotation", times, np.stack([0 * times, 0 * times, np.sin(nod), np.cos(nod)], 1))
        model.animate(0, "weights", times, 0.5 * (1 - np.cos(9 * (times - 3))) * (times >= 3))
    return model


BVH = """HIERARCHY
ROOT lower
{ OFFSET 0 0 0 CHANNELS 3 Zrotation Xrotation Yrotation
  JOINT upper { OFFSET 0 1 0 CHANNELS 3 Zrotation Xrotation Yrotation End Site { OFFSET 0 1 0 } } }
MOTION
Frames: 60
Frame Time: 0.0333333
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The files that the examples speak of."""
    place = tmp_path_factory.mktemp("examples")
    (place / "take.glb").write_bytes(strip(name="Walk").glb())
    split = Glb(**json.loads(json.dumps(strip(name="Walk").complete())))
    root = split.json
    data = strip(name="Walk").glb()
    binary = data[20 + int.from_bytes(data[12:16], "little") + 8 :]
    root["buffers"] = [{"uri": "take.bin", "byteLength": len(binary)}]
    (place / "take.gltf").write_text(json.dumps(root))
    (place / "take.bin").write_bytes(binary)
    (place / "mesh.glb").write_bytes(strip().glb())
    (place / "take.pc2").write_bytes(pc2(folding_sheet()))
    (place / "take.obj").write_bytes(MESH)
    rows = (f"0 0 0 {40 * np.sin(frame / 5):.3f} 0 0" for frame in range(60))
    (place / "motion.bvh").write_text(BVH + "\n".join(rows) + "\n")
    return place


def examples(page):
    """Every curl of the page, one after the other, without remarks."""
    text = "\n".join(re.findall(r"```sh\n(.*?)```", page, re.DOTALL))
    return [
        re.sub(r"\s+# .*$", "", one).strip() for one in re.split(r"^(?=curl )", text, flags=re.MULTILINE) if one.strip()
    ]


@pytest.fixture(scope="module")
def website(folder):
    """The site that examples fetch files from and have called."""

    class Quiet(SimpleHTTPRequestHandler):
        def log_message(self, *_):
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=folder))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_address[1]}"
    server.shutdown()
    server.server_close()


def test_every_example_runs(service, page, folder, website):
    """In the order of the page, by curl, against the running service; none is answered with a refusal."""
    if shutil.which("curl") is None or shutil.which("bash") is None:
        unavailable("curl and bash are needed to run the examples")
    answer = service.http.post(
        "/v1/segmentations?motions=3", content=(folder / "take.glb").read_bytes(), headers={"Prefer": "wait=30"}
    )
    made = answer.json()
    assert (answer.status_code, made["frames"], made["motions"]) == (200, 240, 3), answer.text
    length = (folder / "take.glb").stat().st_size
    begun = service.http.post("/v1/uploads", headers={"Upload-Length": str(length)}).json()
    ids = {
        "uploads": begun["id"],
        "segmentations": made["id"],
        "animations": made["animation"],
        "animation": made["animation"],
        "collections": service.http.post("/v1/collections", json={"name": "examples"}).json()["id"],
    }
    shown = examples(page)
    assert len(shown) > 20
    for example in shown:
        command = example.replace("localhost:8000", service.url.partition("//")[2])
        command = command.replace("https://example.com", website)
        command = re.sub(
            r'(uploads|segmentations|collections|animations|animation)(/|": "|": \[")ID\b',
            lambda m: m[1] + m[2] + ids[m[1]],
            command,
        )
        command = re.sub(r"^curl (--fail )?", "curl --silent --show-error --fail-with-body ", command)
        run = subprocess.run(["bash", "-c", command], cwd=folder, check=False, capture_output=True, timeout=60)
        assert run.returncode == 0, (example, run.stdout[:500], run.stderr)
    assert (folder / "clips.glb").read_bytes().startswith(b"glTF")
    assert (folder / "take-clips.glb").is_file(), "curl -O -J does not call the clips by their name"
    assert (folder / "plot.png").read_bytes().startswith(b"\x89PNG")
