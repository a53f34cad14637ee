"""No answer is in what a class gets: neither its lines, nor a function that computes it."""

import inspect
import json
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from autograder.bundle.package import package
from autograder.judging.check import Check
from autograder.lesson_checks import numbers, of_lesson
from autograder.problems import CHECKS
from tests.autograder.bundle import references
from tests.notebooks.answer_lines import LONG, answer_lines, flat

TEXTS = (".py", ".ipynb", ".json", ".txt", ".svg", ".md")


@pytest.fixture(scope="module")
def files(installed):
    """Every file of the archive and of the package in it, by its path."""
    found = {}
    with zipfile.ZipFile(installed.archive) as archive:
        found |= {name: archive.read(name) for name in archive.namelist()}
        (wheel,) = (name for name in found if name.endswith(".whl"))
        with archive.open(wheel) as packed, zipfile.ZipFile(packed) as package:
            found |= {f"{wheel}/{name}": package.read(name) for name in package.namelist()}
    return found


@pytest.fixture(scope="module")
def texts(files):
    """The text of each file in one line; of a notebook that of its cells."""
    found = {}
    for name, data in files.items():
        if name.endswith(".ipynb"):
            cells = json.loads(data)["cells"]
            found[name] = flat("\n".join("".join(cell["source"]) for cell in cells))
        elif name.endswith(TEXTS):
            found[name] = flat(data.decode())
    return found


def test_nothing_of_the_graders_is_there(files):
    parts = {part for name in files for part in Path(name).parts}
    assert not parts & {
        *("solutions", "course", "tests", "docs", "mutation", "mechanisms", "sandbox", "pipeline"),
        *("notebook", "report", "authoring", "bundle", "pipeline", "lti", "lms"),
        *("graders.py", "foreign_folder.py"),
    }
    assert not {part for part in parts if part.endswith("mistakes.pyc")}
    # Of what knows nbgrader, that alone which fetches, validates and hands in.
    glue = {name.partition("/nbgrader_glue/")[2] for name in files if "/nbgrader_glue/" in name}
    inside = ("__init__", "entered", "students")
    around = ("__init__.py", "environment.py", "patience.py", "validating.py")
    assert glue == {*around, *(f"exchange/{name}.py" for name in inside)}
    assert len(files) > 300


def test_no_line_of_an_answer_is_there(texts):
    hidden = answer_lines()
    assert len(hidden) > 100
    given = {
        name: found
        for name, text in texts.items()
        if (found := {line for line in hidden if line in text})
    }
    # Lessons and the library are public, and `answer_lines` leaves out what they say. p2 and p5 give
    # their students M, and C and g_vec too.
    (of_problems,) = given
    assert of_problems.endswith("stored/data/given.json")


def test_a_problem_that_gives_functions_is_not_there_before_it_is_handed_out():
    given = json.loads(package(["p1_inertia", "p3_pendulum"])["autograder/stored/data/given.json"])
    assert given == {}


def lines_of(models) -> set[str]:
    """The longer lines of their source, where that is ours."""
    found = set()
    for model in models:
        source = getattr(model, "func", model)
        source = source if inspect.isfunction(source) else type(source)  # with its __call__
        if source.__module__.startswith("autograder.problems"):
            found |= {flat(line) for line in inspect.getsource(source).splitlines()[1:]}
    return {
        line for line in found if (len(line) >= LONG and "=" in line) or line.startswith("return")
    } - {line for line in found if len(line) < LONG}


def test_no_line_of_a_reference_or_a_mistake_is_in_the_package(texts):
    every = [*CHECKS.values()]
    every += [own for n in numbers() for own in of_lesson(n).CHECKS if isinstance(own, Check)]
    models = [own.reference for own in every]
    models += [mistake.wrong for own in every for mistake in own.mistakes]
    models += [term.model for own in every if isinstance(own.terms, tuple) for term in own.terms]
    lines = lines_of(models)
    assert len(lines) > 60
    package = {name: text for name, text in texts.items() if "/autograder/" in name}
    assert len(package) > 150
    allowed = ("arm, q =", "q, arm =")
    given = {
        (name, line)
        for name, text in package.items()
        if name.endswith(".py")
        for line in lines
        if line in text and not line.startswith(allowed)
    }
    assert not given


def test_no_function_of_the_package_gives_a_right_answer(installed):
    """Every function that takes as many arguments is called with those of a visible call."""
    done = installed.run(str(Path(references.__file__)))
    found = json.loads(done.stdout)
    assert found["tried"] > 500
    assert found["modules"] > 90
    assert not found["right"]


def test_a_package_of_one_problem_is_whole(tmp_path):
    """What one problem's checks need is there, whichever others are."""
    for path, data in package(["p3_pendulum"]).items():
        file = tmp_path / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(data)
    command = f"import sys; sys.path.insert(0, {str(tmp_path)!r}); import runpy; "
    command += f"runpy.run_path({references.__file__!r}, run_name='__main__')"
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", command], cwd=tmp_path, text=True, check=True,
        capture_output=True,
    )  # fmt: skip
    assert json.loads(done.stdout)["tried"] > 100
    assert not json.loads(done.stdout)["right"]


def test_the_search_for_such_functions_finds_them():
    """In the course's own package, where they are."""
    found = references.search({"p1-M", "p2-C", "p4-g_vec"})
    names = {name for _, name in found["right"]}
    assert {
        "autograder.problems.material.planar_2r.M",
        "autograder.problems.material.planar_2r.C",
    } <= names
