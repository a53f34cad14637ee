"""The exchange between accounts of one machine: who can open, change or hand in what."""

import copy
import logging
import os
import shutil
import sys
import tempfile
from contextlib import suppress
from pathlib import Path

import nbformat
import pytest
from nbgrader.api import Gradebook
from nbgrader.auth import Authenticator
from nbgrader.coursedir import CourseDirectory
from nbgrader.exchange import ExchangeError, ExchangeFactory
from traitlets import import_item
from traitlets.config import Config

from autograder.nbgrader_glue.exchange import graders, students
from autograder.nbgrader_glue.exchange.entered import Entered
from autograder.nbgrader_glue.steps import EXCHANGE
from tests.autograder.course_problems import problem
from tests.autograder.nbgrader_glue.accounts import acting_as, needs_root
from tests.submissions.answers import cell_of

pytestmark = needs_root
# Accounts that every Debian has.
GRADER, ADA, BOB = "mail", "games", "news"
P3 = "p3-pendulum"
SECRET = "0123456789abcdef"


class Course:
    """A course of GRADER, in the exchange of a machine on which ADA and BOB are students."""

    def __init__(self, root: Path, gradebook: Path):
        self.root = root
        self.exchange = root / "exchange"
        self.inbound = self.exchange / "armdyn" / "inbound"
        self.log = logging.getLogger("exchange")
        self.exchange.mkdir()
        shutil.chown(self.exchange, GRADER)
        for name in (GRADER, ADA, BOB):
            home = root / name
            home.mkdir(mode=0o700)
            shutil.chown(home, name)
        with acting_as(GRADER):
            release = self.home(GRADER) / "course" / "release" / P3
            release.mkdir(parents=True)
            (release / f"{P3}.ipynb").write_text("{}")
            (self.home(GRADER) / "course" / "seed").write_text(SECRET)
        shutil.copy(gradebook, self.home(GRADER))
        shutil.chown(self.home(GRADER) / gradebook.name, GRADER)

    def home(self, name: str) -> Path:
        return self.root / name

    def do(self, name: str, step: type, **settings) -> None:
        """Run one step of the exchange as that account."""
        home = self.home(name)
        config = Config()
        config.CourseDirectory.update(
            {"course_id": "armdyn", "root": str(home), "assignment_id": P3}
            | {
                f"{name}_directory": f"course/{name}"
                for name in ("release", "submitted", "feedback")
            }
            | {"db_url": f"sqlite:///{home / 'gradebook.db'}"}
        )
        config.Exchange.update(
            {"root": str(self.exchange), "cache": str(home / "cache"), "assignment_dir": str(home)}
        )
        config[step.__bases__[-1].__name__].update(settings)
        with acting_as(name):
            course = CourseDirectory(config=config)
            step(course, Authenticator(config=config), config=config, log=self.log).start()

    def hand_in(self, name: str, text: str = "{}") -> Path:
        """What that student hands in, as it then lies in the exchange."""
        before = set(self.inbound.iterdir())
        with acting_as(name):
            folder = self.home(name) / P3
            (folder / "data").mkdir(parents=True, exist_ok=True)
            (folder / f"{P3}.ipynb").write_text(text)
            (folder / "data" / "mine.csv").write_text("1, 2")
        self.do(name, students.Submit)
        (made,) = set(self.inbound.iterdir()) - before
        return made

    def collected(self, name: str) -> Path:
        return self.home(GRADER) / "course" / "submitted" / name / P3


@pytest.fixture(scope="module")
def gradebook(tmp_path_factory):
    """An empty one. To make it, nbgrader starts a program, which may be closed to other accounts."""
    path = tmp_path_factory.mktemp("gradebook") / "gradebook.db"
    with pytest.MonkeyPatch.context() as patched:
        patched.setenv("PATH", str(Path(sys.executable).parent), prepend=os.pathsep)
        Gradebook(f"sqlite:///{path}", "armdyn").close()
    return path


@pytest.fixture
def course(gradebook):
    # Not in pytest's own folder, which is closed to other accounts.
    with tempfile.TemporaryDirectory(prefix="exchange-") as folder:
        os.chmod(folder, 0o755)
        course = Course(Path(folder), gradebook)
        course.do(GRADER, graders.ReleaseAssignment)
        yield course


def test_every_step_of_the_exchange_is_ours():
    steps = set(ExchangeFactory.class_trait_names(config=True)) - {"exchange"}
    assert set(EXCHANGE) == steps
    for ours in EXCHANGE.values():
        assert issubclass(import_item(ours), Entered)


def attempts(made: Path) -> dict[str, object]:
    """What one account can try with another's hand-in, knowing its name."""
    inside = made / f"{made.name.split('+')[1]}.ipynb"
    return {
        "list the exchange": lambda: os.listdir(made.parent),
        "list it": lambda: os.listdir(made),
        "read it": lambda: os.open(inside, os.O_RDONLY),
        "read its secret": lambda: os.open(made / "submission_secret.txt", os.O_RDONLY),
        "read its data": lambda: os.open(made / "data" / "mine.csv", os.O_RDONLY),
        "write it": lambda: os.open(inside, os.O_WRONLY),
        "add to it": lambda: os.open(made / "new.py", os.O_WRONLY | os.O_CREAT),
        "remove a file": lambda: os.unlink(inside),
        "rename it": lambda: os.rename(made, made.parent / "x"),
        "open it to all": lambda: os.chmod(made, 0o777),
    }


def test_no_student_can_open_or_change_what_another_handed_in(course):
    made = course.hand_in(ADA)
    succeeded = []
    for what, attempt in attempts(made).items():
        with acting_as(BOB), suppress(PermissionError):
            attempt()
            succeeded.append(what)
    assert succeeded == []


def test_nobody_but_the_graders_can_read_it_at_any_time(course, monkeypatch):
    """Not while it is written, either: the exchange is looked at before each change of permissions."""
    seen = []

    def look(step, dest, **modes):
        with acting_as(BOB):
            for path in map(Path, (dest, Path(dest).parent)):
                seen.append(os.access(path, os.R_OK | os.X_OK))
        return set_perms(step, dest, **modes)

    set_perms = students.default.Exchange.set_perms
    monkeypatch.setattr(students.default.Exchange, "set_perms", look)
    with acting_as(ADA):
        (course.home(ADA) / P3).mkdir()
        (course.home(ADA) / P3 / f"{P3}.ipynb").write_text("{}")
    course.do(ADA, students.Submit)
    assert len(seen) >= 4
    assert not any(seen)


def test_graders_collect_it_and_can_remove_it(course):
    made = course.hand_in(ADA, '{"mine": 1}')
    course.do(GRADER, graders.Collect)
    got = course.collected(ADA)
    assert (got / f"{P3}.ipynb").read_text() == '{"mine": 1}'
    assert (got / "data" / "mine.csv").read_text() == "1, 2"
    assert {"timestamp.txt", "submission_secret.txt"} <= {path.name for path in got.iterdir()}
    with acting_as(GRADER):
        shutil.rmtree(made)
    assert not made.exists()


# nbgrader leaves a file open.
@pytest.mark.filterwarnings("ignore:.*unclosed file:ResourceWarning")
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
def test_feedback_reaches_the_student_where_the_graders_files_are_closed(course, caplog):
    """Also where others of the class handed in by Moodle or by mail: without a secret, or a time."""
    secret = (course.hand_in(ADA) / "submission_secret.txt").read_text()
    time = {"timestamp.txt": "2026-01-01 00:00:00 UTC"}
    for student, beside in {
        ADA: {**time, "submission_secret.txt": secret},
        "by,moodle": time,
        "mail": {},
        "zoe": {},
    }.items():
        with acting_as(GRADER):
            page = course.home(GRADER) / "course" / "feedback" / student / P3 / f"{P3}.html"
            page.parent.mkdir(parents=True)
            page.write_text("well done")
            page.chmod(0o600)
            for name, text in beside.items():
                (page.parent / name).write_text(text)
    course.do(GRADER, graders.ReleaseFeedback)
    assert "No page was released to by,moodle, mail, zoe, who" in caplog.text
    assert len(list((course.exchange / "armdyn" / "feedback").iterdir())) == 1
    course.do(ADA, students.FetchFeedback)
    (got,) = (course.home(ADA) / P3 / "feedback").rglob("*.html")
    assert got.read_text() == "well done"
    with acting_as(BOB), pytest.raises(PermissionError):
        os.listdir(course.exchange / "armdyn" / "feedback")


def test_a_release_that_is_older_than_the_source_is_said(course, caplog):
    source, home = copy.deepcopy(problem(P3).source), course.home(GRADER)
    (home / "source" / P3).mkdir(parents=True)
    (home / "course" / "release" / P3 / f"{P3}.ipynb").write_text(
        nbformat.writes(problem(P3).release)
    )
    (home / "source" / P3 / f"{P3}.ipynb").write_text(nbformat.writes(source))
    course.do(GRADER, graders.ReleaseAssignment, force=True)
    assert "since" not in caplog.text
    cell_of(source, "p3-M").metadata.nbgrader["points"] = 3
    (home / "source" / P3 / f"{P3}.ipynb").write_text(nbformat.writes(source))
    course.do(GRADER, graders.ReleaseAssignment, force=True)
    assert f"solutions/{P3} has changed since: p3-M has 3 points, but 1 point there" in caplog.text


def test_a_student_cannot_hand_in_for_another(course, caplog):
    real = course.hand_in(ADA, '{"mine": 1}')
    later = real.parent / f"{ADA}+{P3}+2999-01-01 00:00:00.000000 UTC+x"
    with acting_as(BOB):
        later.mkdir()
        (later / f"{P3}.ipynb").write_text('{"forged": 1}')
        later.chmod(0o777)
    course.do(GRADER, graders.Collect)
    assert (course.collected(ADA) / f"{P3}.ipynb").read_text() == '{"mine": 1}'
    assert f"it belongs to the account {BOB}" in caplog.text


@pytest.mark.parametrize("name", [f"{BOB}+{P3}+soon+x", f"{BOB}+{P3}+2999-99-99+x", f"+{P3}+"])
def test_a_strange_name_keeps_nobody_from_being_collected(course, name, caplog):
    with acting_as(BOB):
        (course.inbound / name).mkdir()
    course.hand_in(ADA)
    course.do(GRADER, graders.Collect)
    assert course.collected(ADA).is_dir()
    assert "is left out" in caplog.text


def link_to_the_seed(course, made):
    (made / "notes.txt").symlink_to(course.home(GRADER) / "course" / "seed")


def folder_that_is_a_link(course, made):
    (made / "notes").symlink_to(course.home(GRADER) / "course")


def pipe(course, made):
    os.mkfifo(made / "notes.txt")


def endless_depth(course, made):
    deep = made.joinpath(*["d"] * 40)
    deep.mkdir(parents=True)


TRICKS = [link_to_the_seed, folder_that_is_a_link, pipe, endless_depth]


@pytest.mark.parametrize("trick", TRICKS)
def test_no_link_or_device_is_collected_and_the_others_are(course, trick):
    made = course.hand_in(ADA)
    with acting_as(ADA):
        trick(course, made)
    course.hand_in(BOB)
    with pytest.raises(ExchangeError, match=f"Not collected: .*{ADA}"):
        course.do(GRADER, graders.Collect)
    assert not course.collected(ADA).exists()
    assert (course.collected(BOB) / f"{P3}.ipynb").is_file()


def test_anothers_file_under_a_second_name_is_not_collected(course):
    made = course.hand_in(ADA)
    os.link(course.home(GRADER) / "course" / "seed", made / "notes.txt")
    with pytest.raises(ExchangeError, match="belongs to somebody else"):
        course.do(GRADER, graders.Collect)
    assert not course.collected(ADA).exists()


def test_a_later_hand_in_takes_the_place_of_an_earlier_one(course):
    course.hand_in(ADA, '{"first": 1}')
    course.do(GRADER, graders.Collect)
    course.hand_in(ADA, '{"second": 1}')
    course.do(GRADER, graders.Collect)
    assert (course.collected(ADA) / f"{P3}.ipynb").read_text() == '{"second": 1}'


def test_the_earlier_one_stays_if_the_later_cannot_be_taken(course):
    course.hand_in(ADA, '{"first": 1}')
    course.do(GRADER, graders.Collect)
    later = course.hand_in(ADA, '{"second": 1}')
    with acting_as(ADA):
        pipe(course, later)
    with pytest.raises(ExchangeError, match="Not collected"):
        course.do(GRADER, graders.Collect)
    assert (course.collected(ADA) / f"{P3}.ipynb").read_text() == '{"first": 1}'


def test_what_an_instructor_put_there_stays(course, caplog):
    """It has no time, which nbgrader takes for an earlier one."""
    course.hand_in(ADA, '{"by exchange": 1}')
    with acting_as(GRADER):
        course.collected(ADA).mkdir(parents=True)
        (course.collected(ADA) / f"{P3}.ipynb").write_text('{"by mail": 1}')
    course.do(GRADER, graders.Collect)
    assert (course.collected(ADA) / f"{P3}.ipynb").read_text() == '{"by mail": 1}'
    assert "has no timestamp.txt" in caplog.text


def test_a_change_after_the_stated_time_is_said(course, caplog):
    made = course.hand_in(ADA)
    early = made.parent / f"{ADA}+{P3}+2001-01-01 00:00:00.000000 UTC+x"
    with acting_as(ADA):
        made.rename(early)
    course.do(GRADER, graders.Collect)
    assert "says that it was handed in at 2001-01-01 00:00 UTC, but was changed at" in caplog.text


def test_a_hand_in_of_now_is_no_change(course, caplog):
    course.hand_in(ADA)
    course.do(GRADER, graders.Collect)
    assert "but was changed" not in caplog.text


def test_an_exchange_of_an_older_version_is_refused_whole(course):
    course.inbound.chmod(0o733)
    with pytest.raises(ExchangeError, match="Ask your instructor to set the exchange up again"):
        course.hand_in(ADA)
    assert not list(course.inbound.iterdir())
    with acting_as(ADA):
        assert not list((course.home(ADA) / "cache").rglob("*.ipynb"))
