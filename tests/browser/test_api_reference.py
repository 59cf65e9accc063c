"""The page of the API works in a browser, under its strict policy and without another site."""

from pathlib import Path

from playwright.sync_api import Browser, expect

from tests.conftest import unavailable


def test_it_lists_the_calls(browser: Browser, address: str, checkout: Path) -> None:
    """One opens with its parameters; nothing is asked of another site, and the policy refuses nothing."""
    if not (checkout / "service" / "static" / "vendor" / "swagger-ui").is_dir():
        unavailable("Swagger UI is not fetched: python tools/fetch_assets.py")
    page = browser.new_page()
    asked: list[str] = []
    said: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    page.on("console", lambda message: said.append(message.text) if message.type == "error" else None)
    page.goto(f"{address}/docs")
    call = page.locator("#operations-segmentations-createSegmentation")
    expect(call).to_be_visible()
    call.locator(".opblock-summary").click()
    expect(call.get_by_text("number of motion types").first).to_be_visible()
    assert all(url.startswith((address, "data:")) for url in asked)
    assert said == []
    page.close()
