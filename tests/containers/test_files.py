"""The container files by what they do: their steps, followed in a folder with stand-ins for programs."""

import os
import re
import tomllib

import pytest

from autograder.bundle.archive import COMMANDS, TOP, _metadata
from autograder.bundle.wheel import write_wheel, zipped
from autograder.sandbox.refusal import REMEDIES
from tests.containers import page
from tests.containers.recipe import FILES, IGNORED, ROOT, followed

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]

pytestmark = pytest.mark.skipif(os.name == "nt", reason="an image is of Linux")


@pytest.fixture(scope="module")
def archive(tmp_path_factory):
    """A folder with a class's archive, whose package is empty."""
    folder = tmp_path_factory.mktemp("archive")
    version = "1.0.0+15cf8a70"
    wheel = write_wheel(folder, "armdyn", version, _metadata(version), COMMANDS, {"armdyn.py": b""})
    held = dict.fromkeys(("constraints.txt", "lessons/a", "problems/a", "start.py"), b"")
    held[wheel.name] = wheel.read_bytes()
    wheel.unlink()
    made = zipped({f"{TOP}/{name}": data for name, data in held.items()})
    (folder / "armdyn-15cf8a70.zip").write_bytes(made)
    return folder


@pytest.fixture
def image(archive, tmp_path):
    """`image("students")`: the stages of that file."""
    contexts = {"students": archive, "graders": ROOT}

    def stages(name):
        return followed(ROOT / "containers" / f"{name}.Containerfile", contexts[name], tmp_path)

    return stages


BOTH = pytest.mark.parametrize("name", ["graders", "students"])


def test_there_is_one_for_students_and_one_for_graders():
    assert [path.stem for path in FILES] == ["graders", "students"]


@BOTH
def test_what_is_installed_is_pinned_and_the_user_is_not_root(image, name):
    *_, last = image(name)
    installed = [line for line in last.ran if line.startswith("python -m pip install")]
    assert len(installed) == 2
    others, course = installed
    assert others.startswith("python -m pip install --no-cache-dir -c constraints.txt ")
    assert course.startswith("python -m pip install --no-cache-dir --no-deps .")
    assert last.user != "root"
    assert any(f"useradd --create-home --uid 1000 {last.user}" == r for r in last.ran)


@BOTH
def test_the_base_is_a_python_that_the_course_runs_on(image, name):
    oldest = PROJECT["requires-python"].removeprefix(">=")
    assert {stage.base for stage in image(name)} == {f"docker.io/library/python:{oldest}-slim"}


@BOTH
def test_nothing_of_the_build_is_left_in_the_image(image, name):
    *_, last = image(name)
    assert last.files == []


def test_a_students_image_has_of_the_course_the_archives_package_alone(image):
    first, last = image("students")
    assert "archive/armdyn/lessons/a" in first.files
    assert last.ran[-2:] == [
        "useradd --create-home --uid 1000 student",
        "install -d -o student -g student /home/student/armdyn",
    ]
    assert any(line.endswith(" ./armdyn-1.0.0+15cf8a70-py3-none-any.whl") for line in last.ran)
    assert (last.work, last.command[:2]) == ("/home/student", ["autograder", "lab"])


def test_what_a_students_package_needs_is_installed_before_it(image):
    first, _ = image("students")
    needs = (first.root / "archive" / "needs.txt").read_text().splitlines()
    lab = PROJECT["optional-dependencies"]["lab"]
    found = [re.sub(r"[\s'\"]", "", line) for line in needs]
    assert found == [re.sub(r"[\s'\"]", "", line) for line in (*PROJECT["dependencies"], *lab)]


def test_the_graders_have_the_sandboxs_program_and_work_where_the_course_is_mounted(image):
    *_, last = image("graders")
    assert any("install" in line and "bubblewrap" in line for line in last.ran)
    assert last.work == "/course"
    for command in page.commands("run", "armdyn-graders"):
        assert '-v "$PWD":/course ' in command


@BOTH
def test_the_file_says_how_it_is_built_as_the_page_does(name):
    (built,) = page.commands("build", f"armdyn-{name}")
    assert f"\n#   {built}\n" in (ROOT / "containers" / f"{name}.Containerfile").read_text()


def test_the_flags_that_the_grader_asks_for_are_those_of_the_page():
    flag = r"--security-opt [\w=]+"
    asked = set(re.findall(flag, " ".join(REMEDIES.values())))
    typed = " ".join(page.commands("run", "armdyn-graders"))
    assert asked == set(re.findall(flag, typed))
    assert len(asked) == 5


def test_peoples_work_stays_out_of_the_build():
    work = (ROOT / ".gitignore").read_text(encoding="utf-8").partition("never commit")[2]
    folders = re.findall(r"^/(\w+)/$", work, re.M)
    assert len(folders) == 4
    assert set(folders) <= set(IGNORED)
