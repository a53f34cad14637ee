"""What a platform refuses or answers wrongly is said, and stops no more than it must."""

import json
import re

import pytest

from autograder.lti import LtiError, registration, sending
from autograder.lti.sending import How
from tests.autograder.lti.a_class import P3, marks, refusal, scores
from tests.autograder.lti.platform import AGS
from tests.autograder.lti.platform import registration as registered


def test_what_the_platform_refuses_of_one_stops_nobody(root, platform):
    platform.refuses["u-bob"] = (400, "this user\nis not to be graded \x1b[31m")
    done = sending.send(root, marks(), How())
    (fault,) = done.faults
    assert fault.startswith(f"{P3}, bob: not sent: ")
    assert "answers 400: this user is not to be graded" in fault
    assert "\x1b" not in fault
    assert set(scores(platform)) == {"u-ada", "u-cem"}
    platform.refuses.clear()
    assert sending.send(root, marks(), How()).lines[0] == f"{P3}: 1 score sent"


def test_a_token_that_is_refused_is_said_once(root, platform):
    platform.allowed.remove(f"{AGS}score")
    (fault,) = sending.send(root, marks(), How()).faults
    assert (
        "/token answers 400: invalid_scope: the platform does not allow the course to send" in fault
    )
    assert fault.endswith("when that is mended, run the command again: it sends the rest")


@pytest.mark.parametrize(
    ("end", "status", "text", "headers", "said"),
    [
        ("/token", 401, "invalid_client", {}, "/token answers 401: invalid_client: look at client-id"),
        ("/token", 200, "<html>", {}, r"/token answers 200: a web page \(OK\), as where"),
        ("/token", 400, '{"error": "invalid_scope"}', {}, "the course to read its members"),
        ("/token", 200, "{}", {}, "is not as LTI lays down"),
        ("/items", 200, "{}", {}, "is not as LTI lays down"),
        ("/items", 200, "[3]", {}, "is not as LTI lays down"),
        ("/items", 200, "<html>", {}, "is not JSON"),
        ("/members", 200, '{"members": [{"roles": 3}]}', {}, "is not as LTI lays down"),
        ("/members", 302, "", {"Location": "https://other.org/x"}, "leads on to https://other.org"),
        ("/items", 200, '[{"id": "http://other.org/1", "resourceId": "p3-pendulum"}]', {},
         "names an address that does not begin with https://.*http://other.org/1/scores"),
    ],
)  # fmt: skip
def test_what_is_wrong_with_the_platform_is_said(root, platform, end, status, text, headers, said):
    platform.answers.append((end, status, text, headers))
    assert re.search(said, refusal(root))
    assert platform.posted == 0


def test_nobody_is_there(root, platform):
    (root / registration.FILE).write_text(
        registered(platform, **{"token-url": "http://127.0.0.1:9/token"})
    )
    with pytest.raises(LtiError, match=r"127\.0\.0\.1:9 cannot be reached: look at the addresses"):
        sending.send(root, marks(), How())


@pytest.mark.parametrize(
    ("status", "body", "said"),
    [
        (400, json.dumps({"status": 400, "reason": "Incorrect score received", "request": {"x": 1}}),
         "answers 400: Incorrect score received"),
        (409, '{"status": 409, "reason": "Refusing score with an earlier timestamp"}',
         "answers 409: Refusing score with an earlier timestamp: the platform has a later score: is "
         "this machine's clock right?"),
        (422, json.dumps({"errors": {"type": "unprocessable_entity", "message": "not a student"}}),
         "answers 422: not a student"),
        (404, "<!doctype html><title>Not Found</title>",
         "answers 404: a web page (Not Found), as where an address is wrong"),
        (500, "", "answers 500: Internal Server Error"),
    ],
)  # fmt: skip
def test_what_platforms_wrap_their_words_in_is_left_out(root, platform, status, body, said):
    """Moodle's, Canvas's and Django's ways to say no; said once, though all students have it."""
    for user in ("u-ada", "u-bob", "u-cem"):
        platform.refuses[user] = (status, body)
    (fault,) = sending.send(root, marks(), How()).faults
    assert (
        fault == f"{P3}, ada, bob, cem: not sent: {platform.url('/items/1/lineitem/scores')} {said}"
    )
