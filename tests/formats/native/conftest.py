"""The readers that are extras: their tests need their libraries."""

import importlib.util

import pytest

from tests.conftest import unavailable


@pytest.fixture(scope="module")
def alembic() -> None:
    """The library that reads and writes Alembic."""
    if importlib.util.find_spec("alembic3d") is None:
        unavailable("alembic3d is not installed: make extras")


@pytest.fixture(scope="module")
def usd() -> None:
    """The library that reads and writes USD."""
    if importlib.util.find_spec("pxr") is None:
        unavailable("usd-core is not installed: make extras")
