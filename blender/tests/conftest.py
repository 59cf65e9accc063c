"""Blender as the module bpy, in a Python of its own, and a running service."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.service.conftest import with_its_own_redis
from tools.build_addon import ROOT, build_addon

HERE = Path(__file__).parent
SECONDS = 240


@pytest.fixture(scope="session")
def blender_python():
    """The Python that has bpy: `make addon-test` says where."""
    python = os.environ.get("CAESURA_BLENDER_PYTHON")
    if not python:
        pytest.skip("these run in Blender: make addon-test")
    return Path(python).absolute()


@pytest.fixture(scope="session")
def extension(tmp_path_factory):
    """The zip."""
    return build_addon(tmp_path_factory.mktemp("extension"))


@pytest.fixture(scope="session")
def service(tmp_path_factory):
    """A service of the checkout, with workers, that takes what a service takes by default."""
    folder = tmp_path_factory.mktemp("service")
    with with_its_own_redis(ROOT, folder, workers=True, max_upload_bytes=2**31) as running:
        yield running


@pytest.fixture
def blender(blender_python, tmp_path):
    """Runs a script of this folder in a Blender without settings; answers its lines."""

    def run(script, *arguments, seconds=SECONDS, **variables):
        env = {**os.environ, "BLENDER_USER_RESOURCES": str(tmp_path / "blender"), **variables}
        command = [blender_python, HERE / script, *map(str, arguments)]
        done = subprocess.run(command, env=env, capture_output=True, text=True, timeout=seconds, check=False)
        assert done.returncode == 0, f"{done.stdout}\n{done.stderr}"
        return done.stdout.splitlines()

    return run


@pytest.fixture
def journey(blender, extension, service):
    """What a journey saw."""

    def go(name, place="", **variables):
        return json.loads(blender("journey.py", name, extension, place or service.url, **variables)[-1])

    return go


@pytest.fixture
def command(tmp_path):
    """The command of the checkout, as a person has it installed: without a word in the environment."""
    path = tmp_path / "caesura"
    path.write_text(f'#!/bin/sh\nPYTHONPATH={ROOT} exec {sys.executable} -m caesura.service.commands.cli "$@"\n')
    path.chmod(0o755)
    return str(path)
