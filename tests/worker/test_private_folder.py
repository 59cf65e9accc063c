"""The data folder is its owner's alone, also where it was there before and open to all."""

import stat

import pytest

from caesura.worker.embedded_redis.server import EmbeddedRedis
from caesura.worker.private_folder import make_private
from tests.service.conftest import serve


@pytest.fixture
def wide(tmp_path):
    """A folder that everybody may enter."""
    wide = tmp_path / "wide"
    wide.mkdir(mode=0o755)
    wide.chmod(0o755)
    return wide


def permissions(folder):
    """As `chmod` takes them."""
    return oct(stat.S_IMODE(folder.stat().st_mode))


def test_a_folder_that_was_open_is_closed(wide, tmp_path):
    """What its owner may not do stays so; a new one is made closed."""
    make_private(wide)
    assert permissions(wide) == "0o700"
    wide.chmod(0o555)
    make_private(wide)
    assert permissions(wide) == "0o500"
    make_private(tmp_path / "new" / "folder")
    assert permissions(tmp_path / "new" / "folder") == "0o700"


def test_the_embedded_redis_closes_its_folder(wide):
    """Whoever enters it could speak to the server."""
    server = EmbeddedRedis(wide)
    server.start()
    server.stop()
    assert permissions(wide) == "0o700"


def test_the_web_process_closes_the_data_folder(checkout, wide, idle):
    """Uploads lie there."""
    with serve(checkout, wide, idle.settings.redis_location, workers=False):
        assert permissions(wide) == "0o700"
