"""A gradebook that another program has locked is waited for; where it stays so, a sentence says it."""

import subprocess
import sys
from contextlib import contextmanager, suppress

import pytest

from autograder.cli import main
from autograder.nbgrader_glue import by_hand, locked
from autograder.pipeline import run as pipeline
from tests.autograder import courses
from tests.autograder.courses import P3, submit
from tests.submissions import p3_pendulum

HOLD = (
    "import sqlite3, sys; held = sqlite3.connect(sys.argv[1], isolation_level=None, timeout=30); "
    "held.execute('BEGIN EXCLUSIVE'); print('held', flush=True); sys.stdin.read()"
)
STAYS = f"autograder: {locked.STAYS}\n"


class Holder:
    """Another program, which can lock the gradebook."""

    def __init__(self, path):
        self._path, self._process = path, None

    def lock(self, *_):
        command = [sys.executable, "-c", HOLD, self._path]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        assert self._process.stdout.readline() == b"held\n"

    def let_go(self, *_):
        if self._process is not None:
            with suppress(BrokenPipeError):
                self._process.communicate(timeout=60)
            self._process = None


@contextmanager
def holding(root):
    holder = Holder(root / "course" / "gradebook.db")
    try:
        yield holder
    finally:
        holder.let_go()


@pytest.fixture
def course(tmp_path, monkeypatch):
    """Two right submissions; SQLite itself gives up at once, and not after its five seconds."""
    root = courses.new_course(tmp_path / "course")
    for student in ("ada", "bob"):
        submit(root, student, p3_pendulum.right(courses.release(root)))
    with (root / "nbgrader_config.py").open("a") as config:
        config.write("c.CourseDirectory.db_url += '?timeout=0.05'\n")
    monkeypatch.chdir(root)
    monkeypatch.setattr(locked, "PAUSE_SECONDS", 0.02)
    monkeypatch.setattr(by_hand, "PATIENCE", 0.1)
    return root


def scores(root) -> dict[str, float]:
    """The sum of the points of each student whose notebook is recorded."""
    found = {}
    for row in map(dict, courses.rows(courses.database(root))["grade"]):
        student = row["notebook_id"].partition("/")[0]
        found[student] = found.get(student, 0.0) + (row["auto_score"] or 0.0)
    return found


def before_recording(monkeypatch, student, does):
    """Do it when the student's result is there, and not yet recorded."""
    settle = pipeline._Run._settle

    def settled(run, name, *given, **more):
        if name == student:
            does()
        return settle(run, name, *given, **more)

    monkeypatch.setattr(pipeline._Run, "_settle", settled)


def test_a_run_waits_until_the_lock_goes(course, monkeypatch, capsys):
    said = []
    with holding(course) as other:
        monkeypatch.setattr(
            locked, "say", lambda text, to: (said.append((text, to)), other.let_go())
        )
        before_recording(monkeypatch, "bob", other.lock)
        assert main(["grade", P3, "--jobs", "1"]) == 0
    assert said == [(locked.WAITING, sys.stderr)]
    out, err = capsys.readouterr()
    assert "2 graded, 0 unchanged" in out
    assert err == ""
    assert scores(course) == {"ada": 10.0, "bob": 10.0}


def test_a_lock_that_stays_ends_the_run_and_the_next_goes_on(course, monkeypatch, capsys):
    monkeypatch.setattr(locked, "WAIT_SECONDS", 0.2)
    with holding(course) as other:
        with monkeypatch.context() as patched:
            before_recording(patched, "bob", other.lock)
            assert main(["grade", P3, "--jobs", "1"]) == 2
        assert capsys.readouterr().err == f"{locked.WAITING}\n{STAYS}"
        # Also before anything is judged; there may be no time left to wait.
        assert main(["grade", P3, "--jobs", "1"]) == 2
        assert capsys.readouterr().err in (STAYS, f"{locked.WAITING}\n{STAYS}")
    assert scores(course) == {"ada": 10.0}
    tasks = []
    task = pipeline._Run._task
    monkeypatch.setattr(
        pipeline._Run, "_task", lambda *given: tasks.append(task(*given)) or tasks[-1]
    )
    assert main(["grade", P3, "--jobs", "1"]) == 0
    assert tasks == [None, None]  # what was judged for bob was kept
    assert "1 graded, 1 unchanged" in capsys.readouterr().out
    assert scores(course) == {"ada": 10.0, "bob": 10.0}


@pytest.fixture(scope="module")
def graded(tmp_path_factory):
    root = courses.new_course(tmp_path_factory.mktemp("graded") / "course")
    submit(root, "ada", p3_pendulum.right(courses.release(root)))
    courses.run(root, "autograder", "grade", P3, "--jobs", "1")
    with (root / "nbgrader_config.py").open("a") as config:
        config.write("c.CourseDirectory.db_url += '?timeout=0.05'\n")
    return root


COMMANDS = [
    ("grade", P3, "--jobs", "1"),
    ("mark", P3, "--no-browser"),
    ("report",),
    ("report", P3),
    ("export",),
    ("archive", "--anyway"),
    ("forget", "ada", "--yes"),
]


OF_NBGRADER = [
    ("generate_assignment", P3, "--force"),
    ("autograde", P3, "--force"),
    ("generate_feedback", P3),
    ("export",),
    ("db", "student", "list"),
]


@pytest.fixture
def kept(graded, monkeypatch):
    monkeypatch.chdir(graded)
    monkeypatch.setattr(locked, "WAIT_SECONDS", 0.05)
    monkeypatch.setattr(locked, "PAUSE_SECONDS", 0.02)
    monkeypatch.setattr(by_hand, "PATIENCE", 0.1)
    # The page would be served until Ctrl-C.
    monkeypatch.setattr("autograder.marking.server.serve", lambda *given: None)
    return graded


@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_a_locked_gradebook_is_a_sentence(kept, capsys, command):
    before = courses.files(kept / "course")
    with holding(kept) as other:
        other.lock()
        assert main([*command]) == 2
    said = locked.STAYS if command[0] == "grade" else locked.LOCKED
    assert capsys.readouterr().err.splitlines()[-1] == f"autograder: {said}"
    assert courses.files(kept / "course") == before


@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_a_damaged_gradebook_is_a_sentence(kept, capsys, command):
    path = kept / "course" / "gradebook.db"
    whole = path.read_bytes()
    path.write_bytes(b"no database" * 999)
    before = courses.files(kept / "course")
    try:
        assert main([*command]) == 2
        assert courses.files(kept / "course") == before
    finally:
        path.write_bytes(whole)
    (said,) = capsys.readouterr().err.splitlines()
    assert "the gradebook cannot be read or written: file is not a database. Look at db_url" in said


@pytest.mark.parametrize("command", OF_NBGRADER, ids=" ".join)
def test_nbgraders_own_commands_say_it_too(kept, command):
    path = kept / "course" / "gradebook.db"
    before = courses.files(kept / "course")
    with holding(kept) as other:
        other.lock()
        locked_said = courses.run(kept, "nbgrader", *command, status=1)
    whole = path.read_bytes()
    path.write_bytes(b"no database" * 999)
    try:
        damaged_said = courses.run(kept, "nbgrader", *command, status=1)
    finally:
        path.write_bytes(whole)
    assert locked.LOCKED in locked_said
    assert "the gradebook cannot be read or written: file is not a database." in damaged_said
    assert "Traceback" not in locked_said + damaged_said
    assert courses.files(kept / "course") == before
