"""Where keys are needed, the page asks for one, and only once."""

import redis
from playwright.sync_api import Browser, expect

from caesura.service.api_keys.credentials import new_key
from caesura.service.api_keys.key_ring import KeyRing
from tests.service.conftest import with_its_own_redis


def test_a_person_signs_in_with_a_key_and_out_again(browser: Browser, checkout, tmp_path) -> None:
    """A wrong key is told so; the right one opens the page, also when loaded anew; signed out, it is asked for."""
    key, record = new_key("ada")
    with with_its_own_redis(checkout, tmp_path, workers=False, access="keys") as guarded:
        KeyRing(redis.Redis.from_url(guarded.redis_url)).add(record)
        context = browser.new_context(base_url=guarded.url)
        page = context.new_page()
        page.goto("/")
        asked = page.get_by_role("dialog", name="This service needs a key")
        asked.get_by_label("Key").fill("caesura_wrong")
        asked.get_by_role("button", name="Sign in").click()
        expect(asked.get_by_role("alert")).to_contain_text("opens nothing")
        asked.get_by_label("Key").fill(key)
        page.keyboard.press("Enter")
        expect(asked).to_have_count(0)
        with page.expect_response("**/v1/animations?*") as answer:
            page.reload()
        assert answer.value.status == 200
        expect(page.get_by_role("dialog")).to_have_count(0)
        assert page.evaluate("document.cookie") == ""
        page.get_by_role("button", name="Sign out").click()
        expect(asked).to_be_visible()
        context.close()
