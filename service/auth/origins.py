"""Checks which web page makes a request: only the own page of the service may.

A page elsewhere can make a browser send requests here. Two things tell them: `Origin` (and `Sec-Fetch-Site`) names
the page that asks, and `Host` the name the browser went by. The second matters where no key is needed: a page may have
its own name lead to 127.0.0.1 (DNS rebinding) and is of the same origin then, but by a name that is not ours.
An address made of numbers can be nobody else's name.
"""

from collections.abc import Collection
from functools import lru_cache
from ipaddress import ip_address
from urllib.parse import urlsplit

from starlette.datastructures import Headers

from caesura.service.problems.problem_response import RequestProblem

DEFAULT_PORTS = {"http": 80, "https": 443}


class OriginPolicy:
    """The names of the service: `localhost`, every address, and those that `public` lists with commas between.

    `pages` are origins of other sites that the operator lets in; never with the cookie of ours.
    """

    def __init__(self, public: str, pages: Collection[str] = ()) -> None:
        self._pages = frozenset(pages)
        self._names = {_host_name(host) for host in public.split(",") if host.strip()} | {"localhost"}

    def check_host(self, headers: Headers) -> None:
        """Raises `RequestProblem` ("foreign-host") where the browser was led here by a name that is not ours."""
        name = _host_name(headers.get("host", ""))
        if name not in self._names and not _is_address(name):
            detail = f"This service is not called {name!r}. Its operator can add the name to CAESURA_PUBLIC_HOSTS."
            raise RequestProblem("foreign-host", detail, setting="CAESURA_PUBLIC_HOSTS")

    def check_origin(self, headers: Headers, *, following: bool) -> None:
        """Raises `RequestProblem` ("foreign-origin") where a page elsewhere asks.

        `following`: a link may lead here from anywhere, for what it shows is seen by nobody else.
        """
        origin = headers.get("origin")
        if origin is not None:
            if origin not in self._pages and not self._is_own_name(origin, headers.get("host", "")):
                raise _foreign_origin(f"A page of {origin}")
            return
        followed = following and headers.get("sec-fetch-mode") == "navigate"
        if headers.get("sec-fetch-site") in {"cross-site", "same-site"} and not followed:
            raise _foreign_origin("A page of another site")

    def check_cookie(self, headers: Headers, *, reading: bool) -> None:
        """Raises `RequestProblem` ("foreign-origin") where a cookie comes from a page that is not ours.

        A change says which page asks, for a browser always does. A page of another site has a key of its own.
        """
        origin = headers.get("origin")
        if origin is None and not reading:
            raise _foreign_origin("A page that does not say its origin")
        if origin is not None and not self._is_own_name(origin, headers.get("host", "")):
            raise _foreign_origin(f"A page of {origin}")

    def _is_own_name(self, origin: str, host: str) -> bool:
        try:
            page, here = urlsplit(origin), urlsplit(f"//{host}")
            page_port = page.port or DEFAULT_PORTS.get(page.scheme)
            here_port = here.port or DEFAULT_PORTS.get(page.scheme)
        except ValueError:
            return False
        if page.scheme not in DEFAULT_PORTS or not page.hostname:
            return False
        same = page.hostname == here.hostname and page_port == here_port
        return same or page.hostname in self._names - {"localhost"}


def _foreign_origin(page: str) -> RequestProblem:
    return RequestProblem("foreign-origin", f"{page} may not use this service from a browser; only its own page may.")


@lru_cache(maxsize=64)
def _host_name(host: str) -> str:
    """A host without its port."""
    try:
        return (urlsplit(f"//{host.strip()}").hostname or "").rstrip(".")
    except ValueError:
        return ""


@lru_cache(maxsize=64)
def _is_address(name: str) -> bool:
    try:
        ip_address(name)
    except ValueError:
        return False
    return True
