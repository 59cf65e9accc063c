"""An address on the web as a client gives it: http or https, a name, a path, and nothing that hides where it leads."""

from dataclasses import dataclass
from urllib.parse import SplitResult, urljoin, urlsplit

from caesura.core.errors import ParameterError

LONGEST_URL = 2000
PORTS = {"http": 80, "https": 443}


@dataclass(frozen=True)
class TargetUrl:
    """Its text as it is sent, and the name and the port that it leads to."""

    text: str
    scheme: str
    host: str
    port: int

    def joined(self, location: str) -> "TargetUrl":
        """Where a redirect from here leads; raises `ParameterError`."""
        return parse_target_url(urljoin(self.text, location), "url")


def parse_target_url(text: str, parameter: str) -> TargetUrl:
    """The address; raises `ParameterError` naming the parameter that it came in."""
    try:
        parts = urlsplit(text)
        port = parts.port or PORTS.get(parts.scheme, 0)
        host = parts.hostname or ""
    except ValueError:
        parts, port, host = SplitResult("", "", "", "", ""), 0, ""
    plain = text.isascii() and text.isprintable() and " " not in text and "\\" not in text
    fits = len(text) <= LONGEST_URL and plain and parts.scheme in PORTS and host and port
    if not fits or parts.username is not None or parts.password is not None or parts.fragment:
        detail = (
            f"{parameter} must be an address such as https://example.com/path, of at most {LONGEST_URL} plain letters, "
            "without a user name and without a #fragment."
        )
        raise ParameterError("invalid-parameter", detail, parameter=parameter)
    return TargetUrl(text, parts.scheme, host, port)
