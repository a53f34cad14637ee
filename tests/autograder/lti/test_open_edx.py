"""Marks go to a platform that others wrote: Open edX's, whose own code says what it takes.

Our `platform.py` and our tool have the same authors, who may have misread the standard in both.
"""

import json
import sqlite3
import subprocess
import sys
import threading
from contextlib import closing
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from importlib.util import find_spec

import pytest

from autograder.lms.marks import GRADED, Column, Mark, Marks
from autograder.lti import LtiError, key, registration, sending
from autograder.lti.connection import Connector
from autograder.lti.platform import AGS, Platform, RefusedError
from autograder.lti.scores import outgoing, score_of
from autograder.lti.sending import How
from tests.autograder.lti.a_class import OF_P3, P1, P3, PEOPLE, marks

if not all(map(find_spec, ("lti_consumer", "rest_framework"))):
    why = "needs lti_consumer: pip install -c constraints.txt -e .[peers]"
    pytest.skip(why, allow_module_level=True)

MEMBERS = [
    {"number": "u-t", "roles": ["instructor"], "name": "Ines Instructor"},
    {"number": "u-ada", "roles": ["student"], "name": "A. L.", "email": "ada@x.org"},
    {"number": "u-bob", "roles": ["student"], "name": "Bob Doe, Jr."},
    {"number": "u-cem", "roles": ["student"], "name": "C. C."},
    {"number": "u-dan", "roles": ["student", "staff"], "name": "Dan Day"},
]


class Files(SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


@pytest.fixture(scope="module")
def served(keys):
    """The address of the course's key set, as a platform asks for it that takes no key."""
    handler = partial(Files, directory=keys / "course")
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}/{key.KEY_SET.name}"
        server.shutdown()


@pytest.fixture(scope="module")
def running(keys, served, tmp_path_factory):
    """The platform: what it says of the registration, by the way in which it got our key."""
    folder = tmp_path_factory.mktemp("platform")
    (folder / "members.json").write_text(json.dumps(MEMBERS))
    command = [sys.executable, "-m", "tests.autograder.lti.open_edx", str(folder)]
    command += [str(keys / key.PUBLIC), served, str(folder / "members.json")]
    with (folder / "log").open("w") as log:
        server = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=log, text=True)
        late = threading.Timer(400, server.kill)
        late.start()
        try:
            line = server.stdout.readline()
            late.cancel()  # from here on, each request has a limit of its own
            assert line, (folder / "log").read_text()[-3000:]
            yield folder, json.loads(line)
        finally:
            late.cancel()
            server.kill()
            server.communicate(timeout=120)


@pytest.fixture
def edx(request, running, root):
    """A course that is registered there, by its key unless a test says otherwise; the database."""
    folder, held = running
    settings = held[getattr(request, "param", "key")]
    text = "".join(f"{name} = {json.dumps(value)}\n" for name, value in settings.items())
    (root / registration.FILE).write_text(text)
    with closing(sqlite3.connect(folder / "platform.sqlite3")) as database:
        database.row_factory = sqlite3.Row
        for table in ("score", "lineitem"):
            database.execute(f"delete from lti_consumer_ltiags{table}")
        database.commit()
        yield database


def kept(database, table: str, *columns: str) -> list[tuple]:
    rows = database.execute(f"select * from lti_consumer_ltiags{table} order by id")
    return [tuple(row[name] for name in columns) for row in rows]


@pytest.mark.parametrize("edx", ["key", "key set"], indirect=True)
def test_marks_arrive(root, edx):
    done = sending.send(root, marks(), How())
    assert done.faults == []
    assert done.lines == [
        f"{P3}: 3 scores sent, in a new line item", "  not sent: 1, nothing handed in",
    ]  # fmt: skip
    assert kept(edx, "lineitem", "label", "resource_id", "score_maximum") == [(P3, P3, 15)]
    columns = ("user_id", "score_given", "score_maximum", "grading_progress", "comment")
    assert kept(edx, "score", *columns) == [
        ("u-ada", 12.504, 15.0, "FullyGraded", None),
        ("u-bob", 0.0, 15.0, "FullyGraded", "graded, late, −1.5"),
        ("u-cem", None, None, "PendingManual", "proof not yet marked"),
    ]


def test_a_mark_replaces_the_one_before_it_in_the_same_line_item(root, edx):
    for mark, how, count in (
        (OF_P3["cem"], How(), 1),
        (Mark(GRADED, 11.0), How(), 1),
        (Mark(GRADED, 11.0), How(), 0),
        (Mark(GRADED, 11.0), How(again=True), 1),
    ):
        done = sending.send(root, marks({"cem": mark}), how)
        assert done.faults == []
        assert done.lines[0].startswith(f"{P3}: {count} score")
    assert len(kept(edx, "lineitem", "id")) == 1
    assert kept(edx, "score", "user_id", "score_given") == [("u-cem", 11.0)]


def test_a_score_with_an_earlier_time_is_refused(root, edx):
    registered = registration.read(root)
    platform = Platform(registered, key.read(root))
    item = platform.line_item(P3, 15.0, make=True)
    score = outgoing(score_of(OF_P3["ada"], 15.0, "u-ada"), None)
    platform.send(item.address, score)
    with pytest.raises(RefusedError, match="can only be updated to a later point in time"):
        platform.send(item.address, score | {"timestamp": "2020-01-01T00:00:00.000+00:00"})
    with pytest.raises(RefusedError, match="already exists for the provided timestamp"):
        platform.send(item.address, score)


def test_what_it_does_not_take_stops_no_other_assignment(root, edx):
    """It has whole numbers for what a line item gives."""
    half = Column(P1, 7.5, None, {"ada": Mark(GRADED, 1.0)})
    of_p3 = marks({"ada": OF_P3["ada"]}).columns
    (fault,) = sending.send(root, Marks(PEOPLE, [half, *of_p3]), How()).faults
    assert "A valid integer is required" in fault
    assert kept(edx, "score", "score_given") == [(12.504,)]


def test_a_token_is_good_for_what_it_was_asked_for_alone(root, edx):
    registered = registration.read(root)
    connector = Connector(registered, key.read(root))
    connector.get_access_token([f"{AGS}score"])
    token = connector.get_access_token([f"{AGS}score"])
    answer = connector._requests_session.get(
        registered.line_items_url, headers={"Authorization": f"Bearer {token}"}
    )
    assert answer.status_code == 403


def test_another_key_gets_no_token(root, edx):
    for path in (key.PRIVATE, key.PUBLIC, key.KEY_SET):
        (root / path).unlink()
    key.make(root)
    with pytest.raises(
        LtiError, match="answers 400: invalid_client: look at client-id, the public key"
    ):
        sending.send(root, marks(), How())
