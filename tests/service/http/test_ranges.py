"""Range headers (RFC 9110, section 14): one range is honoured, none and several mean the whole."""

import pytest

from caesura.service.problems.problem_response import RequestProblem
from caesura.service.results.byte_ranges import content_disposition, parse_range


@pytest.mark.parametrize(
    ("header", "wanted"),
    [
        ("bytes=0-0", (0, 1)),
        ("bytes=10-", (10, 100)),
        ("bytes=-10", (90, 100)),
        ("bytes=-1000", (0, 100)),
        ("bytes=0-999", (0, 100)),
        ("", None),
        ("bytes=-", None),
        ("bytes=0-1,5-6", None),
        ("lines=0-1", None),
        (f"bytes={'9' * 5000}-", None),
        (f"bytes=-{'9' * 5000}", None),
        (f"bytes=0-{'9' * 5000}", None),
    ],
)
def test_a_range_is_read(header, wanted):
    """Bytes [start, end) of a hundred, or None for all of them."""
    assert parse_range(header, 100) == wanted


@pytest.mark.parametrize("header", ["bytes=100-", "bytes=5-4", "bytes=-0"])
def test_a_range_that_holds_nothing_is_refused(header):
    """It would be an empty answer that looks like success."""
    with pytest.raises(RequestProblem, match="range-not-satisfiable"):
        parse_range(header, 100)


def test_a_download_has_a_name_for_every_client():
    """In letters that end no header, for those that read nothing else; and as it is."""
    assert content_disposition('été".glb') == "attachment; filename=\"_t__.glb\"; filename*=UTF-8''%C3%A9t%C3%A9%22.glb"


@pytest.mark.parametrize(
    ("name", "saved"),
    [
        ("../../.bashrc", "bashrc"),
        ("C:\\x\\..\\take.glb", "take.glb"),
        ("blg.\u202eexe", "blg.exe"),
        ("a/..", "download"),
    ],
)
def test_the_name_of_a_download_leads_into_no_folder_and_is_read_from_left_to_right(name, saved):
    """Whatever an upload was called."""
    assert content_disposition(name) == f"attachment; filename=\"{saved}\"; filename*=UTF-8''{saved}"
