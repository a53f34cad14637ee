"""Tokens, pauses, redirects: how a platform is spoken to."""

import threading
from http.server import BaseHTTPRequestHandler, HTTPServer

import pytest

from autograder.lti import sending
from autograder.lti.registration import not_safe
from autograder.lti.sending import How
from tests.autograder.lti.a_class import marks, refusal, scores


def test_a_busy_platform_is_asked_again(root, platform):
    platform.answers += [("/scores", 503, "busy", {"Retry-After": "0"})] * 2
    platform.answers += [("/token", 429, "slowly", {"Retry-After": "0"})]
    assert sending.send(root, marks(), How()).faults == []
    assert len(scores(platform)) == 3


def test_a_token_is_asked_for_again_when_it_ends(root, platform):
    platform.lifetime = 1
    assert sending.send(root, marks(), How()).faults == []
    assert len(platform.tokens) > 3
    before = len(platform.tokens)
    platform.lifetime = 3600
    sending.send(root, marks(), How(again=True))
    assert len(platform.tokens) == before + 3  # for members, line items and scores


def test_a_token_that_the_platform_ends_early_is_asked_for_again(root, platform):
    platform.answers += [("/scores", 401, "the token has expired", {}), ("/members", 401, "", {})]
    assert sending.send(root, marks(), How()).faults == []
    assert len(scores(platform)) == 3
    platform.answers += [("/scores", 401, "who are you?", {})] * 2
    (fault,) = sending.send(root, marks(), How(again=True)).faults
    assert "ada: not sent" in fault
    assert "answers 401: who are you?" in fault


def test_a_redirect_gets_neither_key_nor_token(root, platform):
    """From an address of this machine to another, on which nobody may hear of it."""
    heard = []

    class Listens(BaseHTTPRequestHandler):
        def do_POST(self):
            heard.append(self.path)
            self.send_error(400)

        do_GET = do_POST

        def log_message(self, *_):
            pass

    with HTTPServer(("127.0.0.1", 0), Listens) as other:
        threading.Thread(target=other.serve_forever, daemon=True).start()
        to = {"Location": f"http://127.0.0.1:{other.server_address[1]}/"}
        for end in ("/token", "/items"):
            platform.answers.append((end, 307, "", to))
            assert "leads on to" in refusal(root)
        other.shutdown()
    assert heard == []


def test_a_password_for_the_host_does_not_take_the_tokens_place(root, platform, monkeypatch):
    (root / "netrc").write_text("machine 127.0.0.1 login me password secret\n")
    (root / "netrc").chmod(0o600)
    monkeypatch.setenv("NETRC", str(root / "netrc"))
    assert sending.send(root, marks(), How()).faults == []


@pytest.mark.parametrize(
    ("url", "safe"),
    [
        ("https://moodle.example.edu/x", True),
        ("http://localhost:80/x", True),
        ("http://127.4.5.6/x", True),
        ("http://[::1]/x", True),
        ("http://moodle.example.edu/x", False),
        ("http://127.0.0.1.example.edu/x", False),
        ("http://localhost.example.edu/x", False),
        ("http://localhost@example.edu/x", False),
        ("ftp://localhost/x", False),
        ("https://", False),
        ("https://[x/", False),
        ("moodle.example.edu", False),
    ],
)
def test_what_leaves_this_machine_leaves_by_https(url, safe):
    assert (not_safe(url) == "") == safe
