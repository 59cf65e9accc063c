"""What is stored says its version, and a service that is too old for it says so."""

import os
import subprocess
import sys

import pytest

from caesura.worker.records import redis_keys
from caesura.worker.records.storage_version import LAYOUT, LayoutTooNew, check_layout


def test_a_new_redis_gets_our_layout(idle):
    """And it is read again without a word."""
    check_layout(idle.redis)
    check_layout(idle.redis)
    assert int(idle.redis.get(redis_keys.LAYOUT_KEY)) == LAYOUT


def test_an_older_layout_becomes_ours(idle):
    """Records of before are read with the defaults of their new fields."""
    idle.redis.set(redis_keys.LAYOUT_KEY, LAYOUT - 1)
    check_layout(idle.redis)
    assert int(idle.redis.get(redis_keys.LAYOUT_KEY)) == LAYOUT


def test_a_later_layout_is_refused_in_a_sentence(idle):
    """By every worker too, before it touches anything."""
    idle.redis.set(redis_keys.LAYOUT_KEY, LAYOUT + 1)
    with pytest.raises(LayoutTooNew, match="Use the version that wrote it"):
        check_layout(idle.redis)
    environment = {**os.environ, **idle.settings.environment()}
    command = [sys.executable, "-m", "caesura.worker"]
    worker = subprocess.run(command, check=False, env=environment, capture_output=True, text=True, timeout=60)
    assert worker.returncode == 1
    assert worker.stderr.strip().startswith(f"What is stored here has layout {LAYOUT + 1}")
    assert int(idle.redis.get(redis_keys.LAYOUT_KEY)) == LAYOUT + 1
