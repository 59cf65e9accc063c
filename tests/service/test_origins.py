"""Whether a page is our own, from what its browser says of it."""

import pytest
from starlette.datastructures import Headers

from caesura.service.auth.origins import OriginPolicy
from caesura.service.problems.status_table import Refusal


def code(check):
    """What a check refuses with; empty where it passes."""
    try:
        check()
    except Refusal as refused:
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
