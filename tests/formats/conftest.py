"""The independent readers of formats that ours are held to, in Node."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def oracle(shared: Path, node: Path, request: pytest.FixtureRequest) -> Path:
    """A copy of the oracle with its modules, kept between runs; `CAESURA_ORACLE` names one that is ready."""
    if ready := os.environ.get("CAESURA_ORACLE"):
        return Path(ready) / "oracle.mjs"
    folder = Path(request.config.cache.mkdir("gltf-oracle"))  # type: ignore[union-attr]
    if not (folder / "node_modules").is_dir():
        for file in ("oracle.mjs", "package.json", "package-lock.json"):
            shutil.copyfile(shared / "tools" / "gltf-oracle" / file, folder / file)
        done = subprocess.run(
            [*_npm(node), "ci", "--no-audit", "--no-fund"], cwd=folder, check=False, capture_output=True, timeout=200
        )
        if done.returncode:
            shutil.rmtree(folder / "node_modules", ignore_errors=True)
            message = f"npm ci of the oracle failed: {done.stderr.decode(errors='replace')[-300:]}"
            pytest.fail(message) if os.environ.get("CI") == "true" else pytest.skip(message)
    return folder / "oracle.mjs"


def _npm(node: Path) -> list[str]:
    script = node.parent.parent / "lib" / "node_modules" / "npm" / "bin" / "npm-cli.js"
    return [str(node), str(script)] if script.is_file() else ["npm"]
