"""Nobody gets in without a key, and nobody learns of another's things: every call that OpenAPI lists is tried."""

import itertools
import re
from pathlib import Path

import httpx
import pytest
import redis
from click.testing import CliRunner

from caesura.service.api_keys.credentials import new_key
from caesura.service.api_keys.key_file import key_file_line
from caesura.service.api_keys.key_ring import KeyRing
from caesura.service.app import create_app
from caesura.service.commands.cli import main
from caesura.service.settings import ServiceSettings
from caesura.worker.records import Records
from tests.service.conftest import serve, with_its_own_redis

OPEN = {"GET /healthz", "GET /readyz", "POST /v1/session", "DELETE /v1/session"}
"""What needs no key. Whatever else there is, or will be, does."""

BESIDE = {"INFO", "PING", "LLEN", "HELLO", "CLIENT"}
"""What is asked once a second or less, or of a new connection, whoever comes."""

HERE = {
    "motion": "m1",
    "proposal": "p1",
    "search": "s1",
    "animation": "e" * 26,
    "suffix": "json",
    "number": "0",
    "n": "0",
    "revision": "0",
}
ELSEWHERE = "https://elsewhere.example"
PATHS = create_app(ServiceSettings(data_dir=Path("never-made"))).openapi()["paths"]
CALLS = [f"{method.upper()} {path}" for path, operations in PATHS.items() for method in operations]


@pytest.fixture(scope="module")
def guarded(checkout, tmp_path_factory):
    """A service that wants keys, with two owners and what the first has uploaded."""
    folder = tmp_path_factory.mktemp("guarded")
    late, late_record = new_key("mounted")
    (folder / "keys").write_text(f"# keys\n{key_file_line(late_record)}\n")
    with with_its_own_redis(checkout, folder, workers=False, access="keys", keys_file=folder / "keys") as running:
        asking = Guarded(running, late)
        yield asking
        asking.http.close()
        asking.redis.close()


class Guarded:
    """Asks as somebody; knows what the first owner has."""

    def __init__(self, running, mounted):
        self.running, self.url, self.mounted = running, running.url, mounted
        self.http = httpx.Client(timeout=30)  # one: to make a client takes longer than most answers
        self.redis = redis.Redis.from_url(running.redis_url)
        self.ring = KeyRing(self.redis)
        self.mine, self.theirs, self.revoked = (self.key(name) for name in ("mine", "theirs", "revoked"))
        self.ring.revoke("revoked")
        self.animation = self.segmentation = self.collection = ""

    def key(self, name, owner=None):
        key, record = new_key(name, owner)
        self.ring.add(record)
        return key

    def ask(self, call, key=None, unknown=False, **more):
        """The answer to `METHOD /path/{…}` about what the first owner has, or about what nobody has."""
        method, path = call.split(" ", 1)
        animation, segmentation = ("a" * 26, "b" * 26) if unknown else (self.animation, self.segmentation)
        collection = "c" * 24 if unknown else self.collection
        owns = {"animations": animation, "collections": collection}
        own = owns.get(path.split("/")[2] if path.startswith("/v1/") else "", segmentation)
        path = path.replace("{identifier}", own)
        here = HERE | ({"suffix": "svg"} if "/plot." in path else {})
        path = re.sub(r"\{(\w+)\}", lambda match: here[match[1]], path)
        query = {"animation": animation} if call == "GET /v1/segmentations" else {}
        headers = {"Authorization": f"Bearer {key}"} if key else {}
        headers |= more.pop("headers", {})
        if not {"content", "json"} & more.keys() and "requestBody" in PATHS[call.split(" ", 1)[1]][method.lower()]:
            more |= {"content": b"{}"}
            headers |= {"Content-Type": "application/json"}
        return self.sent(method, path, headers=headers, params=query, **more)

    def sent(self, method, path, **request):
        """The answer, as a client hears it that keeps no cookies."""
        answer = self.http.request(method, self.url + path, **request)
        self.http.cookies.clear()
        return answer

    def looked_up(self, call, key, **more):
        """The answer, and what Redis was asked for it: names of commands, those of scripts too."""
        with self.redis.monitor() as monitor:
            answer = self.ask(call, key, **more)
            self.redis.echo("over")
            asked = []
            while (told := monitor.next_command())["command"] != "ECHO over":
                asked.append((told["client_type"], told["command"].partition(" ")[0]))
        return answer, [one for one in asked if one[1] not in BESIDE]

    def plain(self, answer):
        """What an answer says, but for the id that was asked for and the hour."""
        text = answer.text
        known = ((self.animation, "A"), (self.segmentation, "S"), (self.collection, "C"))
        for identifier, stand_in in (*known, ("a" * 26, "A"), ("b" * 26, "S"), ("c" * 24, "C")):
            text = text.replace(identifier, stand_in)
        headers = {name: value for name, value in answer.headers.items() if name not in {"date", "content-length"}}
        return (
            answer.status_code,
            {n: v for n, v in headers.items() if not n.startswith(("ratelimit", "x-request"))},
            text,
        )

    def cookie(self, key):
        answer = self.sent("POST", "/v1/session", json={"key": key}, headers={"Origin": self.url})
        assert answer.status_code == 204
        return {"Cookie": answer.headers["set-cookie"].partition(";")[0]}


@pytest.fixture(scope="module")
def owned(guarded, take):
    """The same, once the first owner has sent a take."""
    answer = guarded.ask("POST /v1/segmentations", guarded.mine, content=take(700), headers={"Content-Type": "model/x"})
    assert answer.status_code == 202
    guarded.segmentation, guarded.animation = answer.json()["id"], answer.json()["animation"]
    wanted = {"name": "all", "animations": [guarded.animation]}
    guarded.collection = guarded.ask("POST /v1/collections", guarded.mine, json=wanted).json()["id"]
    return guarded


@pytest.mark.parametrize("call", [call for call in CALLS if call not in OPEN])
def test_a_call_is_only_for_those_with_a_key(owned, call):
    """401 without, with a wrong or a revoked key, in the same words whether the thing exists; 403 from elsewhere."""
    key_less = owned.ask(call)
    assert (key_less.status_code, key_less.json()["code"]) == (401, "key-needed")
    assert "Bearer" in key_less.headers["WWW-Authenticate"]
    wrong = owned.ask(call, "caesura_" + "x" * 43)
    assert (wrong.status_code, wrong.json()["code"]) == (401, "unknown-key")
    assert owned.plain(owned.ask(call, owned.revoked)) == owned.plain(wrong)
    assert owned.plain(owned.ask(call, unknown=True)) == owned.plain(key_less)
    for headers in ({"Origin": ELSEWHERE}, {"Origin": "null"}, {"Sec-Fetch-Site": "cross-site"}):
        foreign = owned.ask(call, headers=owned.cookie(owned.mine) | headers)
        assert (foreign.status_code, foreign.json()["code"]) == (403, "foreign-origin"), headers


@pytest.mark.parametrize("call", [call for call in CALLS if "{identifier}" in call or call == "GET /v1/segmentations"])
def test_another_owners_things_are_as_if_they_were_not_there(owned, call):
    """Status, headers and every word of the answer are those of an id that nobody has."""
    theirs = owned.ask(call, owned.theirs)
    assert owned.plain(theirs) == owned.plain(owned.ask(call, owned.theirs, unknown=True))
    assert 400 <= theirs.status_code < 500
    assert owned.segmentation in owned.ask("GET /v1/segmentations/{identifier}", owned.mine).text


@pytest.mark.parametrize("call", [call for call in CALLS if "{identifier}" in call or call == "GET /v1/segmentations"])
def test_another_owners_things_are_looked_up_like_those_that_nobody_has(owned, call):
    """Redis does the same for both."""
    owned.ask(call, owned.theirs)
    theirs, for_theirs = owned.looked_up(call, owned.theirs)
    nobodys, for_nobodys = owned.looked_up(call, owned.theirs, unknown=True)
    assert for_theirs == for_nobodys
    assert theirs.status_code == nobodys.status_code


def test_each_owner_has_a_list_and_ids_of_its_own(owned, take):
    """The same bytes from another owner are another animation; neither sees the other's."""
    again = owned.ask("POST /v1/animations", owned.theirs, content=take(700), headers={"Content-Type": "model/x"})
    assert again.status_code == 201
    assert again.json()["id"] != owned.animation
    lists = [owned.ask("GET /v1/animations", key).json()["animations"] for key in (owned.mine, owned.theirs)]
    assert [[entry["id"] for entry in entries] for entries in lists] == [[owned.animation], [again.json()["id"]]]
    named = owned.ask("POST /v1/segmentations", owned.theirs, json={"animation": owned.animation})
    assert (named.status_code, named.json()["code"]) == (404, "not-found")


@pytest.mark.parametrize("call", sorted(OPEN))
def test_what_needs_no_key_is_guarded_from_other_pages_unless_it_is_a_probe(owned, call):
    """Signing in or out from another page is refused; probes tell nothing worth a secret."""
    answer = owned.ask(call, headers={"Origin": ELSEWHERE}, json={"key": owned.mine} if "POST" in call else None)
    expected = 403 if "session" in call else 503 if "readyz" in call else 200  # no worker runs here
    assert answer.status_code == expected
    assert "set-cookie" not in answer.headers


def test_a_browser_signs_in_for_a_cookie_and_out_again(owned):
    """No script reads it, no other site sends it; it writes only for our own page; signed out it is worth nothing."""
    call = "POST /v1/segmentations"
    body = {"json": {"animation": owned.animation, "motions": 2}}
    answer = owned.sent("POST", "/v1/session", json={"key": owned.mine}, headers={"Origin": owned.url})
    flags = answer.headers["set-cookie"].lower()
    assert all(flag in flags for flag in ("httponly", "samesite=strict", "path=/", "max-age="))
    assert owned.mine not in flags
    cookie = {"Cookie": answer.headers["set-cookie"].partition(";")[0]}
    ours = cookie | {"Origin": owned.url}
    assert owned.ask("GET /v1/animations", headers=cookie).status_code == 200
    assert owned.ask(call, headers=ours, **body).status_code == 202
    assert owned.ask(call, headers=cookie, **body).json()["code"] == "foreign-origin"
    gone = owned.ask("DELETE /v1/session", headers=ours)
    assert gone.status_code == 204
    assert owned.ask("GET /v1/animations", headers=cookie).json()["code"] == "key-needed"


def test_a_revoked_key_ends_its_sessions(owned):
    """At once, and what it had uploaded is still its owner's by another key."""
    key = owned.key("passing", owner=owned.ring.named("mine").owner)
    cookie = owned.cookie(key)
    status = "GET /v1/segmentations/{identifier}"
    assert owned.ask(status, headers=cookie).status_code == owned.ask(status, key).status_code == 200
    owned.ring.revoke("passing")
    assert owned.ask(status, headers=cookie).status_code == owned.ask(status, key).status_code == 401
    assert owned.ask(status, owned.mine).status_code == 200


@pytest.mark.parametrize("by", ["key", "signed out"])
def test_an_open_event_stream_ends_with_its_key(owned, by):
    """The job goes on and says nothing; the stream ends within seconds of the revocation, and another's stays open."""
    key = owned.key("listening", owner=owned.ring.named("mine").owner)
    headers = {"Authorization": f"Bearer {key}"} if by == "key" else owned.cookie(key)
    address = f"{owned.url}/v1/segmentations/{owned.segmentation}/events"
    staying = {"Authorization": f"Bearer {owned.mine}"}
    with httpx.Client(timeout=20) as client, client.stream("GET", address, headers=staying) as other:
        words = other.iter_text()
        assert "caesura" in next(words)
        with client.stream("GET", address, headers=headers) as stream:
            heard = stream.iter_text()
            assert "caesura" in next(heard)
            if by == "signed out":
                assert owned.ask("DELETE /v1/session", headers=headers | {"Origin": owned.url}).status_code == 204
            else:
                owned.ring.revoke("listening")
            assert "deleted" not in "".join(heard)  # and it ends: this returns
        assert owned.ask("GET /v1/limits", headers=headers).status_code == 401
        Records(owned.redis).segmentations.change(owned.segmentation, lambda record: record)
        assert '"queued"' in "".join(itertools.islice(words, 2))
    if by == "signed out":
        owned.ring.revoke("listening")


def test_sums_of_everybody_are_for_a_key_of_their_own(owned):
    """An owner's key does not open /metrics; one made for it opens that and nothing else, from Redis or a file."""
    key, record = new_key("prometheus", metrics=True)
    owned.ring.add(record)
    mounted, mounted_record = new_key("prometheus-2", metrics=True)
    file = owned.running.data / "keys"
    kept = file.read_text()
    file.write_text(kept + key_file_line(mounted_record) + "\n")
    for opening in (key, mounted):
        assert "caesura_requests_total" in owned.ask("GET /metrics", opening).text
        for call in CALLS:
            if call not in OPEN | {"GET /metrics"}:
                refused = owned.ask(call, opening)
                assert (refused.status_code, refused.json()["code"]) == (403, "not-allowed"), call
    refused = owned.ask("GET /metrics", owned.mine)
    assert (refused.status_code, refused.json()["code"]) == (403, "not-allowed")
    assert "caesura_" not in refused.text
    signed_in = owned.sent("POST", "/v1/session", json={"key": key})
    assert (signed_in.status_code, signed_in.json()["code"]) == (403, "not-allowed")
    assert "set-cookie" not in signed_in.headers
    file.write_text(kept)
    owned.ring.revoke("prometheus")


def test_a_wrong_key_does_not_sign_in(owned):
    """401, no cookie, and the key is in no answer."""
    answer = owned.sent("POST", "/v1/session", json={"key": "caesura_secret"})
    assert (answer.status_code, answer.json()["code"]) == (401, "unknown-key")
    assert "set-cookie" not in answer.headers
    assert "caesura_secret" not in answer.text


def test_a_mounted_file_of_keys_is_read_again_when_it_changes(owned):
    """A line more lets in; the line gone, nobody; a line that is none is skipped."""
    file = owned.running.data / "keys"
    assert owned.ask("GET /v1/limits", owned.mounted).status_code == 200
    key, record = new_key("second")
    file.write_text(f"no line of ours\n{key_file_line(record)}  # for the farm\n")
    assert owned.ask("GET /v1/limits", key).status_code == 200
    assert owned.ask("GET /v1/limits", owned.mounted).status_code == 401
    file.unlink()
    assert owned.ask("GET /v1/limits", key).status_code == 401


def test_redis_holds_no_key(owned):
    """Only digests: whoever reads all of it can sign in as nobody."""
    owned.cookie(owned.mine)
    held = b"".join(owned.redis.dump(key) or b"" for key in owned.redis.scan_iter()) + b"".join(owned.redis.scan_iter())
    for key in (owned.mine, owned.theirs):
        assert key.encode() not in held
        assert key.removeprefix("caesura_").encode() not in held


def test_the_command_makes_lists_and_revokes_keys(owned):
    """The key is shown once; afterwards there is its name; `--like` sees what the other sees."""

    def caesura(*arguments, status=0):
        env = {"REDIS_URL": owned.running.redis_url, "CAESURA_DATA_DIR": str(owned.running.data)}
        done = CliRunner().invoke(main, ["keys", *arguments], env=env)
        assert done.exit_code == status, done.output
        return done.output

    key = caesura("add", "farm", "--like", "mine").strip()
    assert owned.ask("GET /v1/segmentations/{identifier}", key).status_code == 200
    assert key not in caesura("list")
    assert re.search(r"^farm +\d{4}-\d\d-\d\d$", caesura("list"), re.MULTILINE)
    caesura("add", "farm", status=2)
    sums = caesura("add", "board", "--metrics").strip()
    assert owned.ask("GET /metrics", sums).status_code == 200
    assert re.search(r"^board .*metrics$", caesura("list"), re.MULTILINE)
    caesura("add", "other", "--metrics", "--local", status=2)
    caesura("revoke", "board")
    caesura("revoke", "farm")
    assert owned.ask("GET /v1/limits", key).status_code == 401
    assert "farm" not in caesura("list")


@pytest.mark.parametrize("call", ["GET /v1/animations", "POST /v1/animations", "GET /openapi.json", "GET /"])
def test_without_keys_only_pages_of_our_own_may_ask(idle, call):
    """A name that leads here but is not ours (DNS rebinding), a form of another site, another port of this machine."""
    method, path = call.split()
    port = httpx.URL(idle.url).port
    for headers in (
        {"Host": "evil.example"},
        {"Host": f"evil.example:{port}", "Origin": f"http://evil.example:{port}"},
        {"Origin": ELSEWHERE},
        {"Origin": f"http://localhost:{port + 1}", "Host": f"localhost:{port}"},
        {"Origin": "null"},
    ):
        answer = idle.http.request(method, path, headers=headers)
        assert answer.status_code == 403, headers
        assert answer.json()["code"] in {"foreign-host", "foreign-origin"}
        assert "access-control-allow-origin" not in answer.headers
    for headers in (
        {"Host": f"localhost:{port}"},
        {"Origin": idle.url},
        {"Host": f"[::1]:{port}"},
        {"Host": "10.0.0.7"},
    ):
        assert idle.http.request(method, path, headers=headers).status_code != 403, headers


def test_a_link_from_elsewhere_leads_to_the_page_but_a_script_does_not_get_through(idle):
    """The browser says which it is."""
    followed = {"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "navigate"}
    assert idle.http.get("/", headers=followed).status_code == 200
    assert idle.http.post("/v1/animations", headers=followed).status_code == 403
    assert idle.http.get("/v1/animations", headers=followed | {"Sec-Fetch-Mode": "no-cors"}).status_code == 403


def test_a_preflight_is_told_nothing(idle):
    """CORS is closed."""
    answer = idle.http.options("/v1/animations", headers={"Origin": idle.url, "Access-Control-Request-Method": "POST"})
    assert not [name for name in answer.headers if name.startswith("access-control")]


def test_names_can_be_added_and_floods_wait(checkout, idle, tmp_path):
    """CAESURA_PUBLIC_HOSTS admits a name; past the limit 429 says when to come back, and probes are still answered."""
    settings = {"public_hosts": "caesura.example, other.example", "requests_a_minute": 5}
    with serve(checkout, tmp_path, idle.redis_url, workers=False, **settings) as other:
        named = {"Host": "caesura.example", "Origin": "https://caesura.example"}
        answers = [other.http.get("/v1/limits", headers=named) for _ in range(6)]
        assert [answer.status_code for answer in answers] == [200] * 5 + [429]
        assert answers[0].headers["RateLimit-Policy"] == '"requests";q=5;w=60'
        assert [re.search(r"r=(\d+)", answer.headers["RateLimit"])[1] for answer in answers] == list("432100")
        assert answers[-1].json()["code"] == "too-many-requests"
        assert 1 <= int(answers[-1].headers["Retry-After"]) <= 12
        assert [other.http.get(probe).status_code for probe in ("/healthz", "/readyz")] == [200, 503]  # no worker


def test_each_key_is_counted_for_itself_and_all_wrong_ones_together(checkout, guarded, tmp_path):
    """A flood of one key leaves the others alone; who tries key after key is stopped, by a cookie too."""
    settings = {"access": "keys", "requests_a_minute": 5}
    with serve(checkout, tmp_path, guarded.running.redis_url, workers=False, **settings) as other:

        def asked(headers):
            other.http.cookies.clear()
            return other.http.get("/v1/limits", headers=headers).status_code

        mine, theirs = ({"Authorization": f"Bearer {guarded.key(name)}"} for name in ("flooding", "calm"))
        assert [asked(mine) for _ in range(6)] == [200] * 5 + [429]
        assert asked(theirs) == 200
        guesses = [{"Authorization": f"Bearer caesura_{number}"} for number in range(4)]
        assert [asked(guess) for guess in [*guesses, {}, *guesses]] == [401] * 5 + [429] * 4
        assert asked({"Cookie": "caesura-session=guessed"}) == 429
        assert other.http.post("/v1/session", json={"key": "caesura_guessed"}).status_code == 429
        assert asked(theirs) == 200


@pytest.mark.parametrize(("proxies", "limited"), [("", True), ("127.0.0.0/8", False)], ids=["nobody", "named"])
def test_who_asks_is_believed_of_a_named_proxy_alone(checkout, tmp_path, proxies, limited):
    """Else a client that says another address with each request would never meet a limit."""
    settings = {"requests_a_minute": 2, "proxies": proxies}
    with with_its_own_redis(checkout, tmp_path, workers=False, **settings) as other:
        asked = [other.http.get("/v1/limits", headers={"X-Forwarded-For": f"10.0.0.{n}"}).status_code for n in range(4)]
    assert asked == ([200, 200, 429, 429] if limited else [200] * 4)


def test_nobody_is_sent_to_a_host_that_the_client_names(owned):
    """A path with a slash too many is not found: a redirect would go to that host."""
    headers = {"Authorization": f"Bearer {owned.mine}", "Host": "elsewhere.example"}
    answer = owned.sent("GET", "/v1/animations/", headers=headers)
    assert (answer.status_code, answer.json()["code"]) == (404, "not-found")
    assert "elsewhere" not in str(answer.headers)


@pytest.mark.parametrize(
    ("host", "access", "needed"),
    [
        ("127.0.0.1", "auto", False),
        ("::1", "auto", False),
        ("localhost", "auto", False),
        ("0.0.0.0", "auto", True),
        ("192.168.1.2", "auto", True),
        ("caesura.example", "auto", True),
        ("0.0.0.0", "open", False),
        ("127.0.0.1", "keys", True),
    ],
)
def test_keys_are_needed_beyond_this_machine_unless_said_otherwise(host, access, needed):
    """And where they are, requests are counted."""
    settings = ServiceSettings(host=host, access=access)
    assert settings.keys_needed == needed
    assert (settings.rate_limit > 0) == needed
