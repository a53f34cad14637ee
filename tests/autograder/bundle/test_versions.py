"""A student's package, and a notebook of another version of the problem than the package's."""

import json
import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import nbformat
import pytest

from autograder.bundle import BundleError
from autograder.bundle.archive import write_bundle
from autograder.bundle.earlier import FILE, earlier
from autograder.nbgrader_glue import write_problem

ROOT = Path(__file__).parents[3]
P3 = "p3-pendulum"


@dataclass(frozen=True)
class HandedOut:
    """What a student has after one bundle: the package, unpacked, and the problem's notebook."""

    package: Path
    notebook: Path


def handed_out(root: Path, to: Path) -> HandedOut:
    """Make the student's package of a course with p3 alone, and release p3."""
    made = write_bundle(root, [], to, write_problem, only_package=True)
    assert [path.name for path in to.iterdir()] == [made.path.name]
    shutil.unpack_archive(made.path, to / "package", "zip")
    write_problem(root, P3, to / P3)
    return HandedOut(to / "package", to / P3 / f"{P3}.ipynb")


@pytest.fixture(scope="module")
def both(tmp_path_factory):
    """What was handed out before the problem asked less, and after."""
    root = tmp_path_factory.mktemp("course")
    shutil.copy(ROOT / "nbgrader_config.py", root)
    shutil.copytree(ROOT / "solutions" / P3, root / "solutions" / P3)
    before = handed_out(root, root / "before")
    source = root / "solutions" / P3 / f"{P3}.ipynb"
    notebook = nbformat.read(source, as_version=4)
    graded = [c for c in notebook.cells if (c.metadata.get("nbgrader") or {}).get("grade")]
    notebook.cells.remove(next(c for c in graded if c.cell_type == "markdown"))
    nbformat.write(notebook, source)
    return before, handed_out(root, root / "after")


def said(package: Path, notebook: Path, code: str = "", **environment: str) -> str:
    """What the checks print, in one line, in a kernel whose working folder has this notebook."""
    code = code or "import autograder\nautograder.check('p3-M')"
    namespace = "def M(q, pend):\n    return 1.0\n"
    begin = f"import sys\nsys.path.insert(0, {str(package)!r})\n"
    guarded = f"try:\n    exec({code!r})\nexcept Exception as error:\n    print(error)"
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", f"{begin}{namespace}{guarded}"],
        cwd=notebook.parent, capture_output=True, text=True, check=True, timeout=300,
        env={name: os.environ[name] for name in ("PATH", "LANG") if name in os.environ} | environment,
    )  # fmt: skip
    return " ".join(done.stdout.split())


def test_the_package_alone_has_no_problem_and_no_lesson(both):
    for one in both:
        (only,) = (one.package / "autograder" / "handed_out").iterdir()
        assert set(json.loads(only.read_text())["versions"]) == {P3}


def test_a_notebook_of_the_packages_version_says_nothing_of_it(both):
    for one in both:
        assert "version" not in said(one.package, one.notebook)


def test_an_older_notebook_says_so_once(both):
    before, after = both
    twice = "import autograder\nfor _ in 'ab':\n    try:\n        autograder.check('p3-M')\n"
    twice += "    except Exception as error:\n        print(error)"
    shown = said(after.package, before.notebook, twice)
    assert shown.count("is of an older version of p3-pendulum than your course package") == 1
    assert "Put your answers into the present notebook" in shown
    assert shown.count("of 15 points checked") == 2


def test_a_newer_notebook_says_so(both):
    before, after = both
    shown = said(before.package, after.notebook)
    assert "is of a version of p3-pendulum that your course package does not have" in shown
    assert "p3-M: incorrect" in shown


def test_a_notebook_of_a_problem_that_the_package_lacks_says_so(both, tmp_path):
    notebook = nbformat.read(both[1].notebook, as_version=4)
    notebook.metadata.armdyn = {"problem": "p4-gravity", "version": "0123"}
    path = tmp_path / "p4-gravity.ipynb"
    nbformat.write(notebook, path)
    code = "import autograder\nautograder.check('p4-g_vec')"
    shown = said(both[1].package, path, code, JPY_SESSION_NAME=str(path))
    assert "is of a version of p4-gravity that your course package does not have" in shown
    assert "there is no check 'p4-g_vec'" in shown


def test_of_two_notebooks_in_a_folder_the_open_one_counts(both, tmp_path):
    before, after = both
    shutil.copy(before.notebook, tmp_path / "a.ipynb")
    shutil.copy(after.notebook, tmp_path / "b.ipynb")
    for name, is_older in (("a", True), ("b", False)):
        open_one = tmp_path / f"{name}.ipynb"
        shown = said(after.package, open_one, JPY_SESSION_NAME=str(open_one))
        assert ("older version" in shown) == is_older


@pytest.mark.parametrize("stamped", [None, "x", {"problem": P3}])
def test_a_notebook_without_a_version_is_checked(both, tmp_path, stamped):
    notebook = json.loads(both[1].notebook.read_text())
    notebook["metadata"]["armdyn"] = stamped
    path = tmp_path / f"{P3}.ipynb"
    path.write_text(json.dumps(notebook))
    shown = said(both[1].package, path)
    assert "p3-M: incorrect" in shown
    assert "version" not in shown


def test_fresh_cases_are_left_to_the_grader(both):
    one = both[1]
    code = "import autograder\nautograder.check('p3-M', fresh=True)"
    shown = said(one.package, one.notebook, code)
    assert "fresh=True needs the right answers to new cases, and they are not in this" in shown
    assert "The grader draws fresh ones when you hand in." in shown
    assert "p3-M: incorrect" in shown
    assert "fresh" not in said(one.package, one.notebook)


def test_the_versions_of_a_course_are_kept(tmp_path):
    assert earlier(tmp_path, {"p3": "a", "p4": "x"}) == {"p3": [], "p4": []}
    assert earlier(tmp_path, {"p3": "a"}) == {"p3": []}
    assert earlier(tmp_path, {"p3": "b"}) == {"p3": ["a"]}
    assert earlier(tmp_path, {"p3": "a", "p4": "x"}) == {"p3": ["b"], "p4": []}


@pytest.mark.parametrize("text", ["{", "[1]", '{"p3": 1}', "\x00"])
def test_a_damaged_record_is_named_and_kept(tmp_path, text):
    (tmp_path / FILE).parent.mkdir()
    (tmp_path / FILE).write_text(text)
    with pytest.raises(BundleError, match=r"versions\.json is damaged: .* or delete it"):
        earlier(tmp_path, {"p3": "a"})
    assert (tmp_path / FILE).read_text() == text
