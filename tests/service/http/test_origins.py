"""Whether a page is our own, from what its browser says of it."""

import pytest
import redis
from starlette.datastructures import Headers

from caesura.service.api_keys.credentials import new_key
from caesura.service.api_keys.key_ring import KeyRing
from caesura.service.auth.origins import OriginPolicy
from caesura.service.problems.problem_response import RequestProblem
from caesura.service.settings import ServiceSettings
from tests.service.conftest import with_its_own_redis


def code(check):
    """What a check refuses with; empty where it passes."""
    try:
        check()
    except RequestProblem as refused:
        return refused.code
    return ""


@pytest.mark.parametrize(
    ("origin", "host", "ours"),
    [
        ("http://localhost:8000", "localhost:8000", True),
        ("https://caesura.example", "caesura.example", True),
        ("https://caesura.example", "caesura.example:443", True),
        ("https://public.example", "inside:8000", True),
        ("https://public.example:8443", "inside:8000", True),
        ("http://[::1]:8000", "[::1]:8000", True),
        ("http://caesura.example", "caesura.example:443", False),
        ("http://localhost:8001", "localhost:8000", False),
        ("http://localhost", "inside:8000", False),
        ("https://public.example.evil.example", "inside:8000", False),
        ("https://evil.example", "caesura.example", False),
        ("null", "caesura.example", False),
        ("file://", "caesura.example", False),
        ("http://caesura.example:x", "caesura.example", False),
        ("", "caesura.example", False),
    ],
)
def test_a_page_is_ours_by_its_host_and_port_or_by_a_public_name(origin, host, ours):
    """Whatever stands in the header, it is one or the other."""
    origins = OriginPolicy("public.example")
    headers = Headers({"Origin": origin, "Host": host})
    assert code(lambda: origins.check_origin(headers, following=True)) == ("" if ours else "foreign-origin")


@pytest.mark.parametrize(
    ("host", "ours"),
    [
        ("localhost", True),
        ("LOCALHOST:80", True),
        ("127.0.0.1:8000", True),
        ("[::1]:8000", True),
        ("public.example.", True),
        ("127.0.0.1.evil.example", False),
        ("localhost.evil.example", False),
        ("[::1", False),
        ("", False),
    ],
)
def test_a_name_that_is_not_ours_may_lead_anywhere(host, ours):
    """Numbers cannot be made to lead here by somebody else; names can."""
    headers = Headers({"Host": host})
    assert code(lambda: OriginPolicy("public.example").check_host(headers)) == ("" if ours else "foreign-host")


SITE = "https://studio.example"


@pytest.fixture(scope="module")
def lenient(checkout, tmp_path_factory):
    """A service that lets the pages of one other site in."""
    folder = tmp_path_factory.mktemp("cors")
    with with_its_own_redis(checkout, folder, workers=False, cors_origins=SITE, access="keys") as running:
        yield running


def test_no_site_may_ask_unless_it_is_listed(idle, lenient):
    """A preflight gets no permission; with the setting the one origin gets it, and no other."""
    asked = {"Access-Control-Request-Method": "POST", "Access-Control-Request-Headers": "authorization"}
    closed = idle.http.options("/v1/animations", headers=asked | {"Origin": SITE})
    assert not [name for name in closed.headers if name.lower().startswith("access-control")]
    other = lenient.http.options("/v1/animations", headers=asked | {"Origin": "https://elsewhere.example"})
    assert "Access-Control-Allow-Origin" not in other.headers
    answer = lenient.http.options("/v1/animations", headers=asked | {"Origin": SITE})
    assert answer.status_code == 200
    assert answer.headers["Access-Control-Allow-Origin"] == SITE
    assert "authorization" in answer.headers["Access-Control-Allow-Headers"]
    assert "Access-Control-Allow-Credentials" not in answer.headers


def test_a_listed_site_needs_a_key_and_may_not_use_the_cookie(lenient):
    """Its page reads what it asks with a key; the cookie of ours is refused from there, for reading too."""
    key, record = new_key("studio")
    KeyRing(redis.Redis.from_url(lenient.redis_url)).add(record)
    page = {"Origin": SITE}
    answer = lenient.http.get("/v1/animations", headers=page | {"Authorization": f"Bearer {key}"})
    assert answer.status_code == 200
    assert answer.headers["Access-Control-Allow-Origin"] == SITE
    assert "X-Request-Id" in answer.headers["Access-Control-Expose-Headers"]
    signed = lenient.http.post("/v1/session", json={"key": key}, headers={"Origin": lenient.url})
    cookie = {"Cookie": signed.headers["Set-Cookie"].partition(";")[0]}
    lenient.http.cookies.clear()
    for method in ("GET", "POST"):
        answer = lenient.http.request(method, "/v1/animations", headers=page | cookie)
        assert (answer.status_code, answer.json()["code"]) == (403, "foreign-origin")
    assert lenient.http.get("/v1/animations", headers=cookie).status_code == 200


@pytest.mark.parametrize("origin", ["*", "studio.example", "https://studio.example/", "ftp://studio.example"])
def test_an_origin_that_is_none_is_no_setting(origin):
    """A star would let every page in."""
    with pytest.raises(ValueError, match="is no origin"):
        ServiceSettings(cors_origins=origin)
