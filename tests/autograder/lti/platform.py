"""A learning platform as LTI 1.3 and its services lay it down, on this machine, in a thread.

From the specifications of 1EdTech: Security Framework 1.0 (client assertions), Assignment and Grade
Services 2.0, Names and Role Provisioning Services 2.0. What it gets, it checks as a platform does.
"""

import json
import secrets
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import datetime
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

import jwt

CLIENT = "the course"
AGS = "https://purl.imsglobal.org/spec/lti-ags/scope/"
MEMBERS = "https://purl.imsglobal.org/spec/lti-nrps/scope/contextmembership.readonly"
ALLOWED = {f"{AGS}lineitem", f"{AGS}score", MEMBERS}
ASSERTION = "urn:ietf:params:oauth:client-assertion-type:jwt-bearer"
MEMBERSHIP = "http://purl.imsglobal.org/vocab/lis/v2/membership#"
PAGE = 2
PROGRESS = {"FullyGraded", "PendingManual", "Pending", "NotReady", "Failed"}
ACTIVITY = {"Initialized", "Started", "InProgress", "Submitted", "Completed"}


class RefusalError(Exception):
    def __init__(self, status: int, said: str, headers: dict[str, str] | None = None):
        super().__init__(said)
        self.status, self.said, self.headers = status, said, headers or {}


class Platform:
    """members, items, scores: what it holds. key_set: where the tool's public keys are.

    refuses: by user, the status and words that a score of theirs gets. answers: what the next requests
    to a path's end get instead, one each: (end, status, text, headers).
    """

    def __init__(self, key_set: Path):
        self.key_set = key_set
        self.members: list[dict] = []
        self.items: list[dict] = []
        self.scores: dict[str, dict[str, dict]] = {}
        self.refuses: dict[str, tuple[int, str]] = {}
        self.answers: list[tuple[str, int, str, dict[str, str]]] = []
        self.allowed = set(ALLOWED)
        self.lifetime = 3600
        self.posted = 0
        self.tokens: dict[str, set[str]] = {}
        self.seen: set[str] = set()
        self.address = ""

    def url(self, path: str) -> str:
        return f"{self.address}{path}"

    def answer(self, method: str, path: str, query: dict, headers, body: bytes):
        """What a request gets: its content, and headers. RefusalError."""
        for own in self.answers:
            if path.endswith(own[0]):
                self.answers.remove(own)
                raise RefusalError(*own[1:])
        if path == "/token":
            return self._token(parse_qs(body.decode())), {}
        scopes = self.tokens.get(headers.get("Authorization", "").removeprefix("Bearer "))
        if scopes is None:
            raise RefusalError(401, "no such token")
        if path == "/members" and MEMBERS in scopes:
            return self._page(self.members, "members", query)
        if path == "/items" and f"{AGS}lineitem" in scopes:
            assert query.get("type_id") == ["3"]
            if method == "POST":
                assert headers["Content-Type"] == "application/vnd.ims.lis.v2.lineitem+json"
                return self._new_item(json.loads(body)), {}
            return self._page(self.items, "", query)
        if path.endswith("/scores") and method == "POST" and f"{AGS}score" in scopes:
            assert headers["Content-Type"] == "application/vnd.ims.lis.v1.score+json"
            return self._score(path.removesuffix("/scores"), json.loads(body)), {}
        raise RefusalError(403, f"this token is not for {method} {path}")

    def _token(self, form: dict):
        assert form["grant_type"] == ["client_credentials"]
        assert form["client_assertion_type"] == [ASSERTION]
        (assertion,) = form["client_assertion"]
        keys = jwt.PyJWKSet.from_dict(json.loads(self.key_set.read_text()))
        try:
            held = jwt.decode(
                assertion, keys[jwt.get_unverified_header(assertion)["kid"]], algorithms=["RS256"],
                audience=self.url("/token"), issuer=CLIENT, subject=CLIENT,
                options={"require": ["exp", "iat", "jti", "sub", "iss", "aud"]},
            )  # fmt: skip
        except (jwt.InvalidTokenError, KeyError) as error:
            raise RefusalError(400, f"invalid_client: {error!r}") from None
        assert held["jti"] not in self.seen
        self.seen.add(held["jti"])
        wanted = set(form["scope"][0].split())
        if not wanted <= self.allowed:
            raise RefusalError(400, "invalid_scope")
        token = secrets.token_urlsafe()
        self.tokens[token] = wanted
        return {"access_token": token, "token_type": "Bearer", "expires_in": self.lifetime,
                "scope": " ".join(wanted)}  # fmt: skip

    def _page(self, every: list, name: str, query: dict):
        """A part of a list, and where the next is, at an address in which capitals count."""
        at = int(query.get("bookmark", ["Page0"])[0].removeprefix("Page"))
        part = every[at : at + PAGE]
        path = "/members" if name else "/items?type_id=3"
        sign = "&" if "?" in path else "?"
        link = f'<{self.url(path)}{sign}bookmark=Page{at + PAGE}>; rel="next"'
        more = {"Link": link} if every[at + PAGE :] else {}
        return ({name: part, "id": "x"} if name else part), more

    def _new_item(self, item: dict):
        assert set(item) == {"label", "resourceId", "scoreMaximum"}
        assert item["scoreMaximum"] > 0
        item["id"] = self.url(f"/items/{len(self.items) + 1}/lineitem?type_id=3")
        self.items.append(item)
        return item

    def _score(self, path: str, score: dict):
        user = score["userId"]
        if user in self.refuses:
            raise RefusalError(*self.refuses[user])
        if not any(urlsplit(item["id"]).path == path for item in self.items):
            raise RefusalError(404, "no such line item")
        if user not in {one["user_id"] for one in self.members}:
            raise RefusalError(404, "no such user")
        assert score["gradingProgress"] in PROGRESS
        assert score["activityProgress"] in ACTIVITY
        assert ("scoreGiven" in score) == ("scoreMaximum" in score)
        now = datetime.fromisoformat(score["timestamp"])
        assert now.tzinfo
        assert "." in score["timestamp"]
        if "submission" in score:
            assert datetime.fromisoformat(score["submission"]["submittedAt"]).tzinfo
        of_item = self.scores.setdefault(path, {})
        if user in of_item and datetime.fromisoformat(of_item[user]["timestamp"]) >= now:
            raise RefusalError(409, "there is a later score")
        of_item[user] = score
        self.posted += 1


def member(user: str, name: str = "", role: str = "Learner", **more) -> dict:
    named = {"name": name} if name else {}
    return {"user_id": user, "roles": [f"{MEMBERSHIP}{role}"], "status": "Active", **named, **more}


@contextmanager
def playing(platform: Platform) -> Iterator[None]:
    """The platform answers, at an address of this machine."""

    class Answers(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"

        def do_GET(self):
            parts = urlsplit(self.path)
            body = self.rfile.read(int(self.headers.get("Content-Length", 0)))
            try:
                found, headers = platform.answer(
                    self.command, parts.path, parse_qs(parts.query), self.headers, body
                )
                status, data = 200, b"" if found is None else json.dumps(found).encode()
            except RefusalError as refusal:
                status, data, headers = refusal.status, refusal.said.encode(), refusal.headers
            except AssertionError as error:
                status, data, headers = 422, f"not as it should be: {error!r}".encode(), {}
            self.send_response(status)
            for name, value in {**headers, "Content-Length": str(len(data))}.items():
                self.send_header(name, value)
            self.end_headers()
            self.wfile.write(data)

        do_POST = do_GET

        def log_message(self, *_):
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Answers)
    server.daemon_threads = True
    platform.address = f"http://127.0.0.1:{server.server_address[1]}"
    thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.05})
    thread.start()
    try:
        yield
    finally:
        server.shutdown()
        server.server_close()
        thread.join(timeout=10)


def registration(platform: Platform, **more: str) -> str:
    """The course's lti.toml, as one writes it who reads the platform's page."""
    held = {
        "issuer": platform.address, "client-id": CLIENT, "deployment-id": "1",
        "token-url": platform.url("/token"), "line-items-url": platform.url("/items?type_id=3"),
        "members-url": platform.url("/members"),
    } | more  # fmt: skip
    return "".join(f"{name} = {json.dumps(value)}\n" for name, value in held.items() if value)
