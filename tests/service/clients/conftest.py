"""The OpenAPI document of the running service, and a take that clips can be made of."""

import json

import pytest

from tests.service.test_documented_examples import strip


@pytest.fixture(scope="session")
def description(service, tmp_path_factory):
    """/openapi.json as a file, for generators."""
    path = tmp_path_factory.mktemp("openapi") / "openapi.json"
    path.write_text(json.dumps(service.http.get("/openapi.json").json()))
    return path


@pytest.fixture(scope="session")
def nodding(tmp_path_factory):
    """A GLB of eight seconds."""

    def make(name):
        path = tmp_path_factory.mktemp("takes") / f"{name}.glb"
        path.write_bytes(strip(name=name).glb())
        return path

    return make
