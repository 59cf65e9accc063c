"""Hosts that the operator lets the service fetch uploads from."""

from fnmatch import fnmatchcase

from caesura.service.problems.problem_response import RequestProblem


class AllowedHosts:
    """Names with commas between; `*.example.com` stands for all below it, `*` for every name."""

    def __init__(self, listed: str) -> None:
        self._patterns = tuple(one.strip().lower() for one in listed.split(",") if one.strip())

    def check(self, host: str) -> None:
        """Raises `RequestProblem` ("host-not-allowed") for any other host."""
        if any(fnmatchcase(host.lower(), pattern) for pattern in self._patterns):
            return
        what = f"It takes none from {host[:100]!r}." if self._patterns else "It takes none by URL."
        detail = f"This service takes uploads by URL from the hosts that its operator lists. {what}"
        raise RequestProblem("host-not-allowed", detail, setting="CAESURA_UPLOAD_HOSTS")
