"""Each page's commands run as they stand there, with their exit status, in a course with students."""

import re
import shutil
from datetime import UTC, datetime, timedelta

import nbformat

from tests.autograder import courses
from tests.autograder.courses import NOTEBOOK, P3
from tests.autograder.lms.platforms import canvas_sheet, moodle_folder, moodle_sheet, zipped
from tests.guide.document import ROOT, Page
from tests.guide.people import hand_in, lay_in, mark_proofs, notebook
from tests.guide.session import follow
from tests.submissions.answers import cell_of

TWO_DAYS_LATE = datetime(2026, 11, 30, 18, tzinfo=UTC)  # 25 hours after the guide's due date
FILES = {"csv": "course/class.csv", "toml": "course/calendar.toml"}


def class_hands_in(root):
    hand_in(root, "ada", "right")
    hand_in(root, "bob", "partly_right", TWO_DAYS_LATE)
    hand_in(root, "eve", "blank")


def eve_hands_in_again(root):
    """Once the class is collected: "run it again: the latest counts"."""
    if not (root / "course" / "autograded").exists():
        hand_in(root, "eve", "right", TWO_DAYS_LATE + timedelta(days=1))
        courses.run(root, "nbgrader", "collect", P3)


def more_points(root):
    path = root / "solutions" / P3 / NOTEBOOK
    source = nbformat.read(path, as_version=4)
    cell_of(source, "p3-M").metadata["nbgrader"]["points"] = 2
    nbformat.write(source, path)


def pages_are_made_again(root):
    for command in ("generate_feedback", "release_feedback"):
        courses.run(root, "nbgrader", command, P3)


def test_the_term_of_the_guide(tmp_path):
    course = courses.before_the_first_command(tmp_path / "course")
    printed = follow(
        "docs/instructors.md",
        course,
        {
            "nbgrader collect p3-pendulum": class_hands_in,
            "autograder grade p3-pendulum": eve_hands_in_again,
            "nbgrader generate_assignment p3-pendulum --force": more_points,
            "autograder archive": pages_are_made_again,
            "nbgrader generate_feedback p3-pendulum": mark_proofs,
        },
        FILES,
    )
    assert "Still open" not in printed
    marks, sums = ((course / name).read_text("utf-8-sig") for name in ("marks.csv", "sums.csv"))
    assert marks.count("graded") == 3
    assert sums.count("Lovelace") == 1
    archives = sorted(path.name for path in (course / "archive").iterdir())
    assert sorted("without-names" in name for name in archives) == [False, False, True]
    left = {path.name for path in (course / "course").iterdir()}
    assert {"calendar-of-last-year.toml", "release", "gradebook.db"} <= left
    assert not {"class.csv", "calendar.toml", "submitted", "feedback", "seed"} & left


NAMES = {"ada": "Ada Lovelace", "bob": "Bob Doe"}


def moodle_gives(root):
    (root / "course" / "class.csv").write_text(
        "id,last_name,first_name,email,lms_id\n"
        "ada,Lovelace,Ada,ada@x.org,11\nbob,Doe,Bob,bob@x.org,12\n"
    )
    numbers = dict(zip(NAMES, ("301", "302"), strict=True))
    zipped(
        root / "submissions.zip",
        {
            f"{moodle_folder(NAMES[one], numbers[one])}/{NOTEBOOK}": notebook(root, "right")
            for one in NAMES
        },
    )
    time = "Saturday, 28 November 2026, 5:59 PM"
    rows = [{"number": numbers[one], "name": NAMES[one], "email": f"{one}@x.org", "submitted": time}
            for one in NAMES]  # fmt: skip
    moodle_sheet(root / "worksheet.csv", rows, "en", "15.00")


def canvas_gives(root):
    rows = [{"name": name, "number": 11 + at} for at, name in enumerate(NAMES.values())]
    canvas_sheet(root / "gradebook.csv", rows, {f"{P3} (77)": "15"})


def pages_are_made(root):
    mark_proofs(root)
    courses.run(root, "nbgrader", "generate_feedback", P3)
    canvas_gives(root)


def test_the_pages_by_subject(tmp_path):
    """A class of notebooks that came by mail; then one in Moodle."""
    root = courses.new_course(tmp_path / "course")
    lay_in(root, "cem", "right")
    lay_in(root, "dan", "wrong")
    follow("docs/grading-rules.md", root, {}, {})
    assert (root / "course" / "report" / f"{P3}.html").exists()
    follow("docs/handing-out.md", root, {}, {})
    assert (root / "course" / "worked-answers.json").exists()
    in_moodle = f"autograder export --for moodle {P3} --sheet worksheet.csv --to filled.csv"
    others = {
        f"autograder collect-zip {P3} submissions.zip --sheet worksheet.csv": moodle_gives,
        f"{in_moodle} --feedback pages.zip": pages_are_made,
    }
    follow("docs/platforms.md", root, others, {})
    assert (root / "pages.zip").exists()


def the_file_is_filled_in(root):
    path = root / "solutions" / "block" / "block.py"
    if not (root / "solutions" / "block" / "block.ipynb").exists() and path.exists():
        (example,) = (
            text for text in Page("docs/own-problem.md").texts("python") if 'name="block"' in text
        )
        path.write_text(example, encoding="utf-8")


def the_model_answers_are_written(root):
    """Those of the file that the first command wrote, once there is a notebook."""
    path = root / "solutions" / "crane" / "crane.ipynb"
    if path.exists():
        source = nbformat.read(path, as_version=4)
        for name, lines in CRANE.items():
            cell = cell_of(source, f"answer-crane-{name}")
            cell.source = re.sub("raise NotImplementedError.*", lines, cell.source)
        nbformat.write(source, path)


CRANE = {
    "small_swing": "return np.sqrt((arm.mt + arm.ml) * arm.g / (arm.mt * arm.l))",
    "M": """c = arm.ml * arm.l * np.cos(q[1])
    return np.array([[arm.mt + arm.ml, c], [c, arm.ml * arm.l**2]])""",
}


def test_problems_of_ones_own(tmp_path):
    course = courses.new_course(tmp_path / "course")
    (course / "lessons").symlink_to(ROOT / "lessons")
    others = {
        "autograder new-problem block": the_file_is_filled_in,
        "autograder try crane": the_model_answers_are_written,
    }
    follow("docs/own-problem.md", course, others, {})
    for name in ("cart-pole", "block", "crane"):
        assert (course / "course" / "release" / name / f"{name}.ipynb").exists()


def test_what_contributors_type(tmp_path):
    shutil.copytree(ROOT / "lessons", tmp_path / "lessons")
    (tmp_path / "nbgrader_config.py").touch()
    first = next((tmp_path / "lessons").glob("05-*.ipynb"))
    first.rename(first.with_name("NN-title.ipynb"))
    (tmp_path / "tests").symlink_to(ROOT / "tests")
    (tmp_path / ".venv").symlink_to(ROOT / ".venv")
    follow("CONTRIBUTING.md", tmp_path, {}, {})
