"""A new problem and a new lesson, each written by its command, pass the tests of all the others."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.new import lesson, problem
from tests.new.lesson import NewLessonError
from tests.new.problem import NewProblemError

ROOT = Path(__file__).parents[2]
SECTION = "lessons/10-state-space-and-simulation.ipynb#10-state"
# Of the problem and the lesson: the files and the tests that look at all files of their kind.
FILES = (
    *("problems/test_problems.py", "problems/test_mistakes.py", "problems/test_further.py"),
    *("problems/test_right_answers.py", "problems/test_unknown_errors.py"),
    *("lesson_checks/test_answers.py", "lesson_checks/test_in_the_lesson.py"),
)
OF_NOTEBOOKS = (
    *("test_links.py", "test_looks.py", "test_course_map.py", "test_reading_time.py"),
    *("test_lessons.py", "test_self_tests.py", "test_references.py"),
)
CHOSEN = (
    "(p9 or 14-the-crane or 14- or every_problem or reads_one or each_problem_has or the_page_is or "
    "ten_styles or each_graded_check or are_different or told_once or there_are_lessons or "
    "tells_the_minutes or has_its_answers or letters_are_not) and not mutant and not thousand and not "
    "any_form and not dressed"
)


@pytest.fixture(scope="module")
def kit(tmp_path_factory):
    """A copy of what is tracked or new, as somebody who joins has it."""
    root = tmp_path_factory.mktemp("kit") / "armdyn"
    listed = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    done = subprocess.run(listed, cwd=ROOT, capture_output=True, check=True, timeout=60)
    for name in filter(None, done.stdout.decode().split("\0")):
        if (ROOT / name).is_file():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, root / name)
    return root


def python(root: Path, *arguments: str) -> str:
    """What Python prints there, with the copy's own packages; it must end well."""
    paths = os.pathsep.join(map(str, (root, root / "lib")))
    done = subprocess.run(
        [sys.executable, *arguments], cwd=root, env=os.environ | {"PYTHONPATH": paths},
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=600,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout[-6000:]
    return done.stdout


def test_what_the_commands_write_passes_the_tests_of_all_problems_and_lessons(kit):
    said = python(kit, "-m", "tests.new.problem", "p9-crane", "The crane", SECTION)
    assert "autograder/problems/p9_crane/checks.py" in said
    said = python(kit, "-m", "tests.new.lesson", "the-crane", "The crane")
    assert "lessons/14-the-crane.ipynb" in said
    files = [f"tests/autograder/{name}" for name in FILES]
    files += [f"tests/notebooks/{name}" for name in OF_NOTEBOOKS]
    said = python(kit, "-m", "pytest", "-q", "-p", "no:cacheprovider", *files, "-k", CHOSEN)
    assert " passed" in said
    python(kit, "-m", "ruff", "check", "autograder", "tests", "solutions", "lessons")
    python(kit, "-m", "ruff", "format", "--check", "autograder", "tests", "solutions", "lessons")


def test_nothing_is_overwritten_and_each_refusal_says_why(tmp_path):
    with pytest.raises(NewProblemError, match="p3-pendulum has the number p3 already"):
        problem.write(ROOT, "p3-crane", "The crane", SECTION)
    with pytest.raises(NewProblemError, match="called like p6-crane"):
        problem.write(ROOT, "crane", "The crane", SECTION)
    with pytest.raises(NewProblemError, match=r"10-stat is no cell that begins .* 10-state, "):
        problem.write(ROOT, "p9-crane", "The crane", SECTION.removesuffix("e"))
    with pytest.raises(NewProblemError, match="there is no such lesson"):
        problem.write(ROOT, "p9-crane", "The crane", "lessons/none.ipynb#a")
    with pytest.raises(NewLessonError, match="called like the-crane"):
        lesson.write(ROOT, "14 The crane", "The crane")
