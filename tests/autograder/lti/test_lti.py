"""Marks go to a platform by LTI 1.3: each score once, to the right student, by https alone."""

import json
import os
import re
import stat
import threading
from contextlib import chdir
from datetime import datetime
from http.server import BaseHTTPRequestHandler, HTTPServer

import pytest

from autograder.cli import main
from autograder.lms.marks import GRADED, NOTHING, UNGRADED, UNREAD, Column, Mark, Marks
from autograder.lti import LtiError, key, registration, sending
from autograder.lti.registration import not_safe
from autograder.lti.sending import How
from autograder.lti.sent import FILE as SENT
from autograder.roster import Person
from tests.autograder.lti.platform import AGS, Platform, member, playing
from tests.autograder.lti.platform import registration as registered

P1, P3 = "p1-inertia", "p3-pendulum"
PEOPLE = [
    Person("ada", "Lovelace", "Ada", "ada@x.org"),
    Person("bob", "Doe, Jr.", "Bob"),
    Person("cem", lms_id="u-cem"),
    Person("dan", "Day", "Dan", "dan@x.org"),
]
HANDED_IN = datetime(2026, 11, 28, 17, 59)
OF_P3 = {
    "ada": Mark(GRADED, 12.504, handed_in=HANDED_IN),
    "bob": Mark(GRADED, 0.0, 1.5, late=True),
    "cem": Mark(UNREAD, 7.0),
    "dan": Mark(NOTHING),
}
MEMBERS = [
    member("t-1", "Ines Instructor", "Instructor"),
    member("u-ada", "A. Lovelace", email="ADA@x.org"),
    member("u-bob", given_name="Bob", family_name="Doe, Jr."),
    member("u-cem"),
    member("u-dan", "Dan Day"),
]


def marks(of_p3=None, *columns: Column) -> Marks:
    return Marks(PEOPLE, [Column(P3, 15.0, None, of_p3 or OF_P3), *columns])


@pytest.fixture(scope="module")
def keys(tmp_path_factory):
    """A folder with a key pair; one takes a second."""
    root = tmp_path_factory.mktemp("keys")
    key.make(root)
    return root


@pytest.fixture
def root(tmp_path, keys):
    course = tmp_path / "course"
    course.mkdir()
    for path in (keys / "course").iterdir():
        (course / path.name).write_bytes(path.read_bytes())
        (course / path.name).chmod(stat.S_IMODE(path.stat().st_mode))
    return tmp_path


@pytest.fixture
def platform(root):
    """A platform with a course that has four students, and that knows our key."""
    platform = Platform(root / key.KEY_SET)
    platform.members = list(MEMBERS)
    with playing(platform):
        (root / registration.FILE).write_text(registered(platform))
        yield platform


def scores(platform: Platform, number: int = 1) -> dict:
    """The scores that a line item has, without their times."""
    found = platform.scores.get(f"/items/{number}/lineitem", {})
    return {user: {k: v for k, v in one.items() if k != "timestamp"} for user, one in found.items()}


def refusal(root) -> str:
    """What is said where nothing can be sent."""
    try:
        return "\n".join(sending.send(root, marks(), How()).faults)
    except LtiError as error:
        return str(error)


def test_each_student_gets_the_score_that_the_mark_says(root, platform):
    done = sending.send(root, marks(), How())
    assert done.faults == []
    assert done.lines == [
        f"{P3}: 3 scores sent, in a new line item",
        "  not sent: 1, nothing handed in",
    ]
    (item,) = platform.items
    assert (item["label"], item["resourceId"], item["scoreMaximum"]) == (P3, P3, 15.0)
    full = {"activityProgress": "Completed", "gradingProgress": "FullyGraded", "scoreMaximum": 15.0}
    assert scores(platform) == {
        "u-ada": {"userId": "u-ada", "scoreGiven": 12.5, "comment": "graded", **full,
                  "submission": {"submittedAt": "2026-11-28T17:59:00.000+00:00"}},
        "u-bob": {"userId": "u-bob", "scoreGiven": 0.0, "comment": "graded, late, −1.5", **full},
        "u-cem": {"userId": "u-cem", "activityProgress": "Submitted",
                  "gradingProgress": "PendingManual", "comment": "proof not yet marked"},
    }  # fmt: skip


def test_what_is_suggested_is_sent_only_when_asked(root, platform):
    sending.send(root, marks(), How(unread=True))
    assert scores(platform)["u-cem"]["scoreGiven"] == 7.0
    assert scores(platform)["u-cem"]["gradingProgress"] == "PendingManual"


def test_only_what_has_changed_is_sent_again(root, platform):
    sending.send(root, marks(), How())
    again = sending.send(root, marks(), How())
    assert again.lines[:2] == [f"{P3}: 0 scores sent", "  as they were sent before: 3"]
    assert platform.posted == 3
    read = OF_P3 | {"cem": Mark(GRADED, 11.0)}
    assert sending.send(root, marks(read), How()).lines[0] == f"{P3}: 1 score sent"
    assert scores(platform)["u-cem"]["scoreGiven"] == 11.0
    assert sending.send(root, marks(read), How(again=True)).lines[0] == f"{P3}: 3 scores sent"
    assert (platform.posted, len(platform.items)) == (7, 1)
    if os.name == "posix":
        assert stat.S_IMODE((root / SENT).stat().st_mode) == 0o600


def test_a_dry_run_sends_and_makes_nothing(root, platform):
    done = sending.send(root, marks(), How(dry=True))
    assert done.lines[0] == f"{P3}: 3 scores would be sent, in a new line item to be made"
    assert (platform.items, platform.posted, (root / SENT).exists()) == ([], 0, False)


def test_a_line_item_is_found_on_any_page_and_not_made_twice(root, platform):
    for at in range(5):
        name = P3 if at == 4 else f"other-{at}"
        of = {"label": name, "resourceId": name, "scoreMaximum": 100.0}
        platform.items.append(of | {"id": platform.url(f"/items/{at + 1}/lineitem?type_id=3")})
    sending.send(root, marks(), How())
    assert len(platform.items) == 5
    assert len(scores(platform, 5)) == 3


def test_a_line_item_of_the_platforms_own_needs_no_right_to_make_some(root, platform):
    own = platform.url("/items/9/lineitem?type_id=3")
    platform.items.append({"id": own, "label": "Homework 3", "scoreMaximum": 15.0})
    platform.allowed.remove(f"{AGS}lineitem")
    text = registered(platform) + f"[line-items]\n{P3} = {json.dumps(own)}\n"
    (root / registration.FILE).write_text(text)
    assert sending.send(root, marks(), How()).faults == []
    assert len(scores(platform, 9)) == 3


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
    assert "/token answers 400: invalid_scope; when that is mended, run the command again" in fault


def test_who_is_not_certain_gets_nothing(root, platform):
    platform.members += [
        member("u-x", "Nobody Here"),
        member("u-dan-2", "Day, Dan"),
        member("u-gone", "Ada Lovelace", status="Inactive"),
    ]
    del platform.members[2]  # bob
    of = OF_P3 | {"dan": Mark(GRADED, 3.0)}
    done = sending.send(root, marks(of), How())
    assert set(scores(platform)) == {"u-ada", "u-cem"}
    said = "\n".join(done.faults)
    assert "in the platform's course: Nobody Here is not in course/class.csv" in said
    assert "dan may be any of the platform's users u-dan, u-dan-2" in said
    assert f"{P3}, bob: the platform's course has nobody who is this student" in said
    assert "Instructor" not in said


def test_without_members_the_class_lists_numbers_serve(root, platform):
    (root / registration.FILE).write_text(registered(platform, **{"members-url": ""}))
    done = sending.send(root, marks(), How())
    assert set(scores(platform)) == {"u-cem"}
    assert len(done.faults) == 2
    assert "course/class.csv has no lms_id, and course/lti.toml no members-url" in done.faults[0]


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


@pytest.mark.parametrize(
    ("end", "status", "text", "headers", "said"),
    [
        ("/token", 401, "invalid_client", {}, "/token answers 401: invalid_client"),
        ("/token", 200, "<html>", {}, "/token answers 200: <html>"),
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


def test_after_the_platform_has_gone_the_rest_is_sent_the_next_time(root, platform):
    """Its line items are there, and then it answers with what is no answer."""
    sending.send(root, marks({"ada": OF_P3["ada"]}), How())
    platform.answers.append(("/items", 200, "[", {}))
    of_p1 = Column(P1, 20.0, None, {"ada": Mark(GRADED, 1.0)})
    done = sending.send(root, Marks(PEOPLE, [of_p1, *marks().columns]), How())
    assert "run the command again: it sends the rest" in done.faults[-1]
    assert platform.posted == 1
    done = sending.send(root, Marks(PEOPLE, [of_p1, *marks().columns]), How())
    assert done.faults == []
    assert platform.posted == 4


def test_nobody_is_there(root, platform):
    (root / registration.FILE).write_text(
        registered(platform, **{"token-url": "http://127.0.0.1:9/token"})
    )
    with pytest.raises(LtiError, match="the platform cannot be reached"):
        sending.send(root, marks(), How())


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


def test_nothing_graded_is_no_score(root, platform):
    done = sending.send(root, marks({"ada": Mark(UNGRADED)}), How())
    assert platform.posted == 0
    assert done.lines[1:] == ["  not sent: 1, not graded yet", "  not sent: 3, nothing handed in"]


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


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"client-id": ""}, "client-id is missing"),
        ({"token-url": "http://x.org/t"}, "token-url = .* does not begin with https://"),
        ({"members-url": "x.org"}, "members-url = .* is no address"),
        ({"client_id": "1"}, "client_id is no setting; there are issuer, client-id"),
    ],
)
def test_what_is_wrong_with_the_registration_is_said(root, platform, change, said):
    (root / registration.FILE).write_text(registered(platform, **change))
    with pytest.raises(LtiError, match=rf"lti\.toml: {said}"):
        registration.read(root)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("issuer =", "Invalid value"),
        ("issuer = 3", "issuer = 3 is no text in quotes"),
        ('line-items = "x"', r"below \[line-items\]"),
        ('[line-items]\np3 = "http://x.org"', "p3 = .* does not begin with https://"),
    ],
)
def test_a_registration_that_is_no_registration(root, platform, text, said):
    held = "" if text.startswith("issuer") else registered(platform)
    (root / registration.FILE).write_text(f"{held}{text}\n")
    with pytest.raises(LtiError, match=said):
        registration.read(root)


def test_without_a_registration_the_error_says_what_to_write(tmp_path):
    with pytest.raises(LtiError, match=r"there is no course.lti\.toml: write into it .* token-url"):
        registration.read(tmp_path)


def test_the_key_is_made_once_and_is_nobody_elses(tmp_path, capsys):
    (tmp_path / "nbgrader_config.py").touch()
    with chdir(tmp_path):
        assert main(["lti", "key"]) == 0
        first = capsys.readouterr().out
        assert main(["lti", "key"]) == 0
        again = capsys.readouterr().out
    assert "lti-key.pem: made. Keep it to yourself." in first
    assert "lti-key.pem: there already." in again
    assert first.partition("\n")[2] == again.partition("\n")[2]
    assert "BEGIN PUBLIC KEY" in first
    assert "PRIVATE" not in first
    (held,) = json.loads((tmp_path / key.KEY_SET).read_text())["keys"]
    assert (held["kty"], held["alg"], held["use"]) == ("RSA", "RS256", "sig")
    assert "d" not in held
    if os.name == "posix":
        assert stat.S_IMODE((tmp_path / key.PRIVATE).stat().st_mode) == 0o600


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such permissions")
def test_a_key_that_others_can_read_is_refused(root):
    (root / key.PRIVATE).chmod(0o640)
    with pytest.raises(LtiError, match=r"other accounts can read .*: chmod 600"):
        key.read(root)


@pytest.mark.parametrize("text", [b"", b"x", b"-----BEGIN PRIVATE KEY-----\nxx\n-----END"])
def test_a_damaged_key_is_said_to_be_one(root, text):
    (root / key.PRIVATE).write_bytes(text)
    with pytest.raises(LtiError, match=r"holds no private RSA key .* the new public key"):
        key.read(root)


def test_a_public_key_is_no_private_one(root):
    (root / key.PRIVATE).write_bytes((root / key.PUBLIC).read_bytes())
    with pytest.raises(LtiError, match="holds no private RSA key"):
        key.read(root)


@pytest.mark.parametrize("text", ["[", "[1]", '{"x": 1}'])
def test_a_damaged_record_of_what_was_sent_is_named(root, platform, text):
    (root / SENT).write_text(text)
    with pytest.raises(LtiError, match=r"lti-sent\.json is damaged: .* all scores are sent again"):
        sending.send(root, marks(), How())
    assert platform.posted == 0


def test_without_a_key_the_error_says_how_to_make_one(root, platform):
    (root / key.PRIVATE).unlink()
    with pytest.raises(LtiError, match="run `autograder lti key` first"):
        sending.send(root, marks(), How())
