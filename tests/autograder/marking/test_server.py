"""The page's server answers only this machine, only who has the token, and no other site's page."""

import asyncio
import contextlib
import http.client
import json
import socket
import threading
from contextlib import closing, contextmanager
from urllib.parse import urlsplit

import pytest

from autograder.marking import server
from autograder.marking.desk import Desk
from autograder.marking.kept import Kept
from tests.autograder.marking.books import Book

PROOF = "/api/proof?assignment=p3&cell=p3-proof"


@contextmanager
def served(desk, port=0):
    """The port and the token of a server that runs in another thread."""
    found, there = [], threading.Event()
    loops = []

    def ready(address):
        loops.append((asyncio.get_running_loop(), asyncio.current_task()))
        found.append(address)
        there.set()

    def run():
        with pytest.raises(asyncio.CancelledError):
            server.serve(desk, "p { color: red }", port, ready)

    thread = threading.Thread(target=run)
    thread.start()
    assert there.wait(30)
    address = urlsplit(found[0])
    try:
        yield address.port, address.fragment.removeprefix("token=")
    finally:
        ((loop, task),) = loops
        loop.call_soon_threadsafe(task.cancel)
        thread.join(30)


@pytest.fixture
def desk(tmp_path):
    (tmp_path / "course").mkdir()
    return Desk(Book(), Kept(tmp_path))


@pytest.fixture
def ask(desk):
    with served(desk) as (port, token):

        def ask(path, said=None, **headers):
            connection = http.client.HTTPConnection("127.0.0.1", port, timeout=30)
            given = {"Authorization": f"token {token}"} | headers
            given = {name: value for name, value in given.items() if value is not None}
            body = said if isinstance(said, str | None) else json.dumps(said)
            with closing(connection):
                connection.request("GET" if said is None else "POST", path, body, given)
                answer = connection.getresponse()
                return answer.status, answer.read().decode(), answer.headers

        ask.port = port
        yield ask


def saving(ask) -> dict:
    _, text, _ = ask("/api/answer?assignment=p3&cell=p3-proof&id=id-ada")
    said = {"assignment": "p3", "cell": "p3-proof", "id": "id-ada", "given": [1, 1], "comment": ""}
    return said | {"version": json.loads(text)["version"]}


def test_with_the_token_an_answer_is_shown_and_marked(ask):
    status, text, _ = ask(PROOF)
    assert (status, json.loads(text)["points"]) == (200, 3.0)
    status, text, _ = ask("/api/save", saving(ask))
    assert (status, json.loads(text)["state"]) == (200, "marked")


@pytest.mark.parametrize(
    "headers",
    [
        {"Authorization": None},
        {"Authorization": "token wrong"},
        {"Authorization": None, "Cookie": "token=all"},
        {"Host": "evil.example"},
        {"Host": "127.0.0.1.evil.example:80"},
        {"Origin": "http://evil.example"},
        {"Origin": "null"},
        {"Origin": "http://127.0.0.1:1"},
    ],
    ids=str,
)
def test_other_requests_are_refused_and_change_nothing(ask, headers):
    said = saving(ask)
    for path, body in ((PROOF, None), ("/api/save", said)):
        status, text, _ = ask(path, body, **headers)
        assert status == 403
        assert json.loads(text).keys() == {"error"}
    _, text, _ = ask(PROOF)
    assert "marked" not in {one["state"] for one in json.loads(text)["papers"]}


def test_this_machines_own_names_are_accepted(ask):
    for name in ("127.0.0.1", "localhost"):
        here = f"{name}:{ask.port}"
        assert ask(PROOF, Host=here, Origin=f"http://{here}")[0] == 200


def test_no_other_page_is_let_in(ask):
    for path in ("/", "/marking.js", PROOF):
        status, _, headers = ask(path)
        assert status == 200
        assert "Access-Control-Allow-Origin" not in headers
        assert "Set-Cookie" not in headers
        assert "frame-ancestors 'none'" in headers["Content-Security-Policy"]
        assert "script-src 'self'" in headers["Content-Security-Policy"]
        assert headers["Cache-Control"] == "no-store"


def test_the_empty_page_needs_no_token_and_holds_nothing(ask):
    status, text, _ = ask("/", Authorization=None)
    assert status == 200
    assert "p3" not in text
    assert ask("/page.css", Authorization=None)[1] == "p { color: red }"


@pytest.mark.parametrize("path", ["/../server.py", "/api/", "/api/nothing", "/x/y", "/kept.json"])
def test_what_is_not_there_is_not_found(ask, path):
    assert ask(path)[0] == 404


@pytest.mark.parametrize("said", ["{", "[]", {}, {"assignment": {"p3": 1}}], ids=str)
def test_bad_requests_are_refused_in_a_sentence_and_the_server_goes_on(ask, said):
    status, text, _ = ask("/api/save", said)
    assert status == 400
    assert json.loads(text)["error"]
    assert ask(PROOF)[0] == 200


def test_it_hangs_up_on_who_sends_too_much(ask):
    with contextlib.suppress(ConnectionError, http.client.HTTPException):
        assert ask("/api/save", {"given": "x" * (2 << 20)})[0] == 400
    assert ask(PROOF)[0] == 200


def test_a_change_elsewhere_is_a_conflict(ask):
    said = saving(ask)
    assert ask("/api/save", said)[0] == 200
    status, text, _ = ask("/api/save", said)
    assert status == 409
    assert "nothing was saved" in json.loads(text)["error"]


def test_a_damaged_file_is_told_on_the_page(ask, desk):
    path = desk._kept.folder() / "p3.json"
    path.write_text("{")
    status, text, _ = ask("/api/answer?assignment=p3&cell=p3-proof&id=id-ada")
    assert status == 500
    assert "p3.json is damaged" in json.loads(text)["error"]


def test_it_listens_at_one_address_of_this_machine(ask):
    # Whoever listens at every address is found at this one, too.
    with socket.socket() as other:
        other.settimeout(5)
        with pytest.raises(OSError, match=r"refused|reach|assign|timed out"):
            other.connect(("127.0.0.2", ask.port))


def test_a_port_that_is_in_use_is_an_error(ask, desk):
    with pytest.raises(OSError, match="in use"):
        server.serve(desk, "", ask.port, lambda address: None)
