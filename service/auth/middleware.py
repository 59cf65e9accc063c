"""Authentication of every request before a route sees it, so that a new route is protected by default.

In order: may this page ask at all (`origins`), who is it (`visitors`), is it too often (`rate`). What needs no key is
listed here; everything else does, where keys are needed.
"""

from redis.exceptions import RedisError
from starlette.datastructures import MutableHeaders
from starlette.requests import Request
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from caesura.service.auth import rate_limit
from caesura.service.auth.authentication import Caller, authenticate
from caesura.service.auth.origins import OriginPolicy
from caesura.service.auth.request_owner import LOCAL_OWNER
from caesura.service.backend import Backend
from caesura.service.problems.exception_handlers import unavailable
from caesura.service.problems.problem_response import RequestProblem, request_problem_response
from caesura.service.settings import ServiceSettings
from caesura.worker.records.connection import tolerate_full_disk

PROBES = frozenset({"/healthz", "/readyz"})
SESSION = "/v1/session"
METRICS = "/metrics"
SAFE = frozenset({"GET", "HEAD", "OPTIONS"})


class UnknownCaller(RequestProblem):
    """Nobody that is known here. The same for a key that never was and for one that is revoked."""

    headers = {"WWW-Authenticate": 'Bearer realm="caesura"'}  # noqa: RUF012  as every refusal has them, never changed


class AuthenticationMiddleware:
    """Lets a request in as somebody's, or answers it."""

    def __init__(self, app: ASGIApp, settings: ServiceSettings) -> None:
        self._app = app
        self._keys_needed = settings.keys_needed
        self._limit = settings.rate_limit
        self._origins = OriginPolicy(settings.public_hosts, settings.page_origins)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Admit or refuse."""
        if scope["type"] != "http" or scope["path"] in PROBES:
            await self._app(scope, receive, send)
            return
        request = Request(scope)
        try:
            rate_headers = await self._admit(request)
        except RequestProblem as refused:
            await request_problem_response(refused)(scope, receive, send)
            return
        except RedisError as fault:
            await unavailable(fault)(scope, receive, send)
            return

        async def send_with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                MutableHeaders(scope=message).update(rate_headers)
            await send(message)

        await self._app(scope, receive, send_with_headers if rate_headers else send)

    async def _admit(self, request: Request) -> dict[str, str]:
        """Note whose request it is; the headers that tell how many are left. Raises the refusal."""
        reading = request.method in SAFE
        if not self._keys_needed:
            self._origins.check_host(request.headers)
        self._origins.check_origin(request.headers, following=reading)
        if reading and _is_page(request.scope["path"]):
            return {}
        backend: Backend = request.app.state.backend
        known = await authenticate(backend, request) if self._keys_needed else Caller(LOCAL_OWNER)
        rate_headers = await self._count(backend, request, known)
        if known is None and request.scope["path"] != SESSION:
            raise _unknown_caller(request)
        if known is not None:
            self._check_reach(known, request.scope["path"])
        if known is not None and known.by_cookie:
            self._origins.check_cookie(request.headers, reading=reading)
        request.state.visitor = known
        return rate_headers

    def _check_reach(self, known: Caller, path: str) -> None:
        """Raises the refusal where it is not for this key: /metrics has everybody's sums, and keys of its own."""
        if not self._keys_needed or known.metrics == (path == METRICS) or path == SESSION:
            return
        wanted = "This key opens /metrics and nothing else." if known.metrics else "This key does not open /metrics."
        detail = f"{wanted} The operator of this service can make one: caesura keys add NAME"
        raise RequestProblem("not-allowed", detail + ("." if known.metrics else " --metrics."))

    async def _count(self, backend: Backend, request: Request, known: Caller | None) -> dict[str, str]:
        if not self._limit:
            return {}
        address = request.client.host if request.client else ""
        who = "" if known is None else known.key
        allowed: rate_limit.RateAllowance | None = None
        with tolerate_full_disk():  # who reads or deletes then is not counted
            allowed = await rate_limit.take_token(backend.records.redis, who, address, self._limit)
        return {} if allowed is None else allowed.headers()


def _is_page(path: str) -> bool:
    """The page itself and what describes the API are the same for everybody, and say nothing of anybody."""
    return path in {"/", "/docs", "/openapi.json"} or path.startswith(("/static/", "/view/"))


def _unknown_caller(request: Request) -> RequestProblem:
    if "authorization" in request.headers:
        return UnknownCaller("unknown-key", "This key opens nothing here: it is wrong, or it was revoked.")
    detail = "Send an API key: `Authorization: Bearer KEY`. The operator makes one: caesura keys add NAME."
    return UnknownCaller("key-needed", detail)
