"""Answers in C++, Java and MATLAB: same checks, same sentences, and each failure in plain words."""

import json
import os
import re
import shutil
import socket
from pathlib import Path
from types import SimpleNamespace

import nbformat
import numpy as np
import pytest

from autograder import from_file
from autograder.judging.check import HIDDEN_CASES
from autograder.judging.verdict import State
from autograder.notebook.grade import grade
from autograder.problems import CHECKS
from autograder.protocol import Call, FaultKind
from autograder.sandbox import bubblewrap
from autograder.sandbox import room as sandbox
from autograder.sandbox.bubblewrap import INSIDE
from autograder.sandbox.room import Room
from autograder.sandbox.ways import Way
from tests.autograder.course_problems import problem
from tests.autograder.courses import run
from tests.autograder.sandbox.rooms import failed, gone, kept, printed, room_of
from tests.autograder.verdicts import judged, judged_in
from tests.submissions import other_languages as answers
from tests.submissions.answers import cell_of
from tests.submissions.other_languages import LANGUAGES

ROOT = Path(__file__).parents[4]
PROBLEMS = {"M": problem("p1-inertia"), "C": problem("p2-energy-skew")}
CHECK = {"M": "p1-M", "C": "p2-C"}
PACKAGES = {
    ".cpp": ("g++", "libeigen3-dev"),
    ".java": ("default-jdk-headless", "libejml-java"),
    ".m": ("octave",),
}
ARM = SimpleNamespace(l1=1.0, l2=0.8, lc1=0.5, lc2=0.4, m1=2.0, m2=1.5, I1=0.2, I2=0.1, g=9.81)
# function, statements before the formulas, statements after them; what compiles slowly, once each
MISTAKES = {
    ("M", "", "M12 -= I2; M21 -= I2;"): (".cpp", ".m"),
    ("M", "lc2 = l2;", ""): (".java", ".m"),
    ("C", "", "C12 = h * a;"): (".java", ".m"),
    ("C", "", "C11 = 0; C12 = h * (2 * a + b);"): (".cpp", ".m"),
}
CASES = [(suffix, *mistake) for mistake, suffixes in MISTAKES.items() for suffix in suffixes]
OTHER_WAYS = pytest.mark.parametrize(
    "way", [Way.COLD, Way.UNWALLED_COLD], indirect=True, ids=lambda way: way.name
)


@pytest.fixture(autouse=True)
def _toolchain(request, needs):
    """What the test's language needs is there."""
    parameters = getattr(request.node, "callspec", SimpleNamespace(params={})).params
    for suffix in [parameters["suffix"]] if "suffix" in parameters else LANGUAGES:
        for package in PACKAGES[suffix]:
            needs(package)


@pytest.fixture
def notebook_folder(tmp_path, monkeypatch):
    """Where a student's notebook runs, on a machine of their own."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("ARMDYN_CACHE", str(tmp_path / "cache"))
    return tmp_path


@pytest.fixture(scope="module")
def rooms():
    """Rooms of this file's own, as what is written and built stays in them."""
    with kept() as rooms:
        yield rooms


@pytest.fixture
def warm(rooms, needs):
    needs("bubblewrap")
    return room_of(rooms, Way.WARM)


def put(room, name, suffix, text) -> list[dict]:
    """What the cells of an answer in another language show."""
    room.run(f"%%writefile {name}{suffix}\n{text}")
    return room.run(f'from autograder import from_file\n{name} = from_file("{name}{suffix}")')


def verdict_on(room, name):
    return CHECKS[CHECK[name]].run(room.ask, np.random.default_rng(0), HIDDEN_CASES)


def graded(name, suffix, text):
    course = PROBLEMS[name]
    submission = answers.in_file(course.submissions.right(course.release), name, suffix, text)
    return grade(submission, course.source, "seed")


@pytest.mark.parametrize("suffix", LANGUAGES)
@pytest.mark.parametrize("name", ["M", "C"])
def test_right_answers_get_full_marks(name, suffix, needs):
    needs("bubblewrap")
    result = graded(name, suffix, answers.right(name, suffix))
    states = {key: verdict.state for key, verdict in result.verdicts.items()}
    assert states == dict.fromkeys(PROBLEMS[name].submissions.POINTS, State.CORRECT)
    assert result.notes == ()


@pytest.mark.parametrize(("suffix", "name", "first", "changes"), CASES)
def test_a_mistake_gets_the_sentence_that_it_gets_in_python(warm, suffix, name, first, changes):
    in_python = judged(CHECK[name], answers.body(name, ".py", first, changes))
    assert len(in_python.diagnosis) == 1
    assert put(warm, name, suffix, answers.source(
        name, suffix, answers.body(name, suffix, first, changes))) == []  # fmt: skip
    verdict = verdict_on(warm, name)
    assert verdict.diagnosis == in_python.diagnosis
    assert verdict.credit == in_python.credit
    assert verdict.rows == in_python.rows


@OTHER_WAYS
@pytest.mark.parametrize("suffix", LANGUAGES)
def test_every_kind_of_room_runs_each_language(room, suffix):
    assert put(room, "M", suffix, answers.ENDS[suffix]) == []
    given = np.array([0.3, -1.2])
    (reply,) = room.ask([Call("M", (given, ARM))])
    np.testing.assert_array_equal(reply.value, np.diag(given))


@pytest.mark.parametrize("suffix", LANGUAGES)
def test_how_a_program_ends_is_said(warm, suffix):
    assert put(warm, "M", suffix, answers.ENDS[suffix]) == []

    def said(number):
        arm = SimpleNamespace(**vars(ARM) | {"g": float(number)})
        (reply,) = warm.ask([Call("M", (np.array([1.0, 2.0]), arm))])
        return reply.fault or reply.value

    raised = [said(number) for number in (1, 2, 3)]
    assert [fault.kind for fault in raised] == [FaultKind.RAISED] * 3
    assert "my words" in raised[0].message
    if suffix == ".cpp":
        assert raised[1].message == "ProgramError: the program ended with SIGSEGV"
    elif suffix == ".java":
        assert "ArrayIndexOutOfBounds" in raised[1].message
        assert raised[1].message.endswith("(M.java:6)")
    else:
        assert "out of bound" in raised[1].message
        assert "M at line 4" in raised[1].message
    assert raised[2].message == "ProgramError: the program ended with exit status 0"
    assert said(4).kind is FaultKind.TIMED_OUT
    assert said(4).message == "2 s"
    assert said(5).shape == (2, 3)
    assert np.isnan(said(6)).any()
    # After each failure it is started again, and what it prints is not taken for its answer.
    np.testing.assert_array_equal(said(7), np.diag([1.0, 2.0]))
    np.testing.assert_array_equal(said(8), np.diag([1.0, 2.0]))


@pytest.mark.parametrize(
    ("suffix", "text", "message"),
    [(suffix, *case) for table in (answers.NOT_BUILT, answers.MISNAMED)
     for suffix, case in table.items()],
)  # fmt: skip
def test_what_does_not_compile_says_where(warm, suffix, text, message):
    (shown,) = put(warm, "M", suffix, text)
    assert shown["name"] == "stderr"
    assert f"M{suffix}" in shown["text"]
    assert "/tmp" not in shown["text"]
    verdict = verdict_on(warm, "M")
    assert verdict.state is State.ERROR
    assert message in verdict.problem


@pytest.mark.parametrize("suffix", [".m"])
class TestFile:
    def test_missing_and_misspelt_names(self, notebook_folder, suffix):
        (notebook_folder / "M.m").write_text(answers.right("M", ".m"))
        with pytest.raises(FileNotFoundError, match=r"no file C\.m\. Did you mean M\.m\?"):
            from_file("C.m")
        with pytest.raises(
            FileNotFoundError, match=r"M\.cpp.* Run the cell with %%writefile M\.cpp before"
        ):
            from_file("M.cpp")
        with pytest.raises(
            ValueError, match=r"an answer's file cannot be 'm\.m'; .*M\.cpp, M\.java, M\.m"
        ):
            from_file("m.m")
        with pytest.raises(ValueError, match=r"an answer's file cannot be 'M\.f90'"):
            from_file("M.f90")

    def test_the_grader_blames_the_cell(self, warm, suffix):
        notebook = answers.in_file(PROBLEMS["M"].release, "M", ".m", answers.right("M", ".m"))
        for cell in notebook.cells:
            cell.source = cell.source.replace("%%writefile M.m", "%%writefile N.m")
        verdict = grade(notebook, PROBLEMS["M"].source, "seed").verdicts["p1-M"]
        assert verdict.state is State.ERROR
        assert "the cell that should define it stopped with FileNotFoundError: there is no file M.m"\
            in verdict.problem  # fmt: skip

    def test_arguments_are_a_students_own(self, notebook_folder, suffix):
        (notebook_folder / "C.m").write_text(answers.right("C", ".m"))
        C = from_file("C.m")
        expected = CHECKS["p2-C"].reference(np.array([0.3, 0.7]), np.array([1.0, -2.0]), ARM)
        np.testing.assert_allclose(C([0.3, 0.7], (1, -2), ARM), expected, rtol=1e-14)
        with pytest.raises(ValueError, match=r"qd has shape \(3,\); it must be two numbers"):
            C([0.3, 0.7], [1, 2, 3], ARM)
        with pytest.raises(TypeError, match=r"C\(q, qd, arm\) takes 3 arguments"):
            C([0.3, 0.7], ARM)
        with pytest.raises(AttributeError, match="'l1'"):
            C([0.3, 0.7], [1, 2], SimpleNamespace())

    def test_a_changed_file_counts_when_it_is_read_again(self, notebook_folder, suffix):
        file = notebook_folder / "M.m"
        file.write_text(
            answers.source("M", ".m", "if arm.g == 1, q(9); end\n" + answers.body("M", ".m"))
        )
        M = from_file("M.m")
        file.write_text(answers.source("M", ".m", "value = [1 2; 3 4];"))
        with pytest.raises(RuntimeError, match="out of bound"):
            M([0, 0], SimpleNamespace(**vars(ARM) | {"g": 1}))  # its program is started again
        assert judged_in({"M": M}, "p1-M").state is State.CORRECT
        assert from_file("M.m")([0, 0], ARM).tolist() == [[1, 2], [3, 4]]

    def test_the_program_ends_with_its_function(self, notebook_folder, suffix):
        (notebook_folder / "M.m").write_text(answers.right("M", ".m"))
        M = from_file("M.m")
        process = M._program._process
        del M
        assert process.returncode is not None


@pytest.mark.parametrize("suffix", [".cpp"])
class TestMissing:
    """Without a compiler, on either side."""

    def test_on_a_students_machine(self, notebook_folder, monkeypatch, capsys, suffix):
        monkeypatch.setenv("CXX", "no-such-compiler")
        (notebook_folder / "M.cpp").write_text(answers.right("M", ".cpp"))
        verdict = judged_in({"M": from_file("M.cpp")}, "p1-M")
        assert verdict.state is State.ERROR
        assert "M is written in a language that cannot run here." in verdict.problem
        assert "apt install g++" in verdict.problem
        assert "You can always answer in Python." in verdict.problem
        assert "apt install g++" in capsys.readouterr().err

    def test_on_the_graders(self, monkeypatch, needs, suffix):
        needs("bubblewrap")
        monkeypatch.setitem(bubblewrap.ENVIRONMENT, "CXX", "no-such-compiler")
        monkeypatch.setattr(sandbox, "_best_way", lambda: Way.COLD)
        result = graded("M", ".cpp", answers.right("M", ".cpp"))
        verdict = result.verdicts["p1-M"]
        assert verdict.state is State.CHECK_FAILED
        assert "A C++ compiler was not found (no-such-compiler)" in verdict.problem
        assert "apt install g++" in verdict.problem
        assert "not your fault" in verdict.next_step
        (note,) = result.notes
        assert "apt install g++" in note
        others = {key: v.state for key, v in result.verdicts.items() if key != "p1-M"}
        assert set(others.values()) == {State.CORRECT}

    def test_a_student_who_says_so_is_not_believed(self, warm, suffix):
        course = PROBLEMS["M"]
        forged = (
            "from protocol.languages.from_file import MissingToolError\n"
            "def M(q, arm): raise MissingToolError('A C++ compiler was not found.')"
        )
        verdict = grade(
            course.submissions.right_but(course.release, M=forged), course.source, "seed"
        ).verdicts["p1-M"]
        assert verdict.state is State.ERROR


@pytest.mark.parametrize("suffix", [".cpp"])
def test_what_a_compiler_takes_is_not_the_cells_own_time(warm, suffix):
    def built(text: str, seconds: float) -> float:
        """The processor time that a build takes in a cell that may take so many seconds itself."""
        warm.run(f"%%writefile M{suffix}\n{text}")
        before = warm.used
        assert (
            warm.run(f'from autograder import from_file\nM = from_file("M{suffix}")', seconds) == []
        )
        return warm.used - before

    right = answers.right("M", suffix)
    takes = built(f"{right}\n// built here, and nowhere else", 10)
    # A processor that others use as well takes longer for the same: the second build may need less.
    limit = 0.5 * takes
    assert built(f"{right}\n// and here again", limit) > limit


@pytest.mark.parametrize("suffix", [".cpp"])
def test_no_word_in_a_cell_buys_it_time(warm, suffix):
    said = failed(warm, "# from_file(\nwhile True: pass", 0.2)
    assert said == "TimeoutError: this cell ran longer than 0.2 s"


@pytest.mark.parametrize("suffix", LANGUAGES)
def test_a_program_that_its_cell_left_is_started_again(warm, suffix):
    """A room ends all that a cell started, and a program serves the cells below."""
    assert put(warm, "M", suffix, answers.ENDS[suffix]) == []
    for _ in range(2):
        assert printed(warm, "print(M._program.ended)") == "True"
        assert printed(warm, "print(M([1.0, 2.0], ARM).tolist())".replace(
            "ARM", f"__import__('types').SimpleNamespace(**{vars(ARM)!r})"
        )) == "[[1.0, 0.0], [0.0, 2.0]]"  # fmt: skip


def test_no_answer_is_in_the_room(warm):
    ports = ROOT / "lib" / "armdyn" / "ports"
    kept_out = [path for path in ports.rglob("*") if path.parent.name != "toolchain"]
    assert len(kept_out) > 10
    assert not set(kept_out) & set(INSIDE)
    names = [str(path) for path in kept_out]
    found = printed(warm, f"import os\nprint([p for p in {names!r} if os.path.exists(p)])")
    assert found == "[]"
    for path, name in INSIDE.items():
        if name.startswith(("toolchain", "protocol/languages")):
            assert not re.search(r"\b(cos|sin)\b", path.read_text(encoding="utf-8")), path


@pytest.mark.parametrize("suffix", [".cpp"])
def test_a_hostile_program_is_held_by_the_same_walls(needs, suffix):
    needs("bubblewrap")
    mark = f"mark-{os.urandom(8).hex()}"
    files = [
        ROOT / "solutions" / "p1-inertia" / "p1-inertia.ipynb",
        ROOT / "autograder" / "problems" / "material" / "planar_2r.py",
        ROOT / "lib" / "armdyn" / "ports" / "cpp" / "planar_2r.hpp",
        ROOT / "course" / "seed",
        Path("/etc/passwd"),
    ]
    with Room() as room, socket.create_server(("127.0.0.1", 0)) as server:
        text = answers.hostile(mark, server.getsockname()[1], list(map(str, files)))
        assert put(room, "M", ".cpp", text) == []
        (reply,) = room.ask([Call("M", (np.zeros(2), ARM))])
        (files_read, connected), (started, _) = reply.value
        assert (files_read, connected) == (0, 0)
        assert 10 < started < 64
    assert gone(mark)


@pytest.mark.parametrize("suffix", [".m"])
def test_nbgrader_autogrades_a_file_that_lies_beside_the_notebook(tmp_path, suffix):
    name = "p1-inertia"
    shutil.copy(ROOT / "nbgrader_config.py", tmp_path)
    shutil.copytree(PROBLEMS["M"].folder, tmp_path / "solutions" / name)
    source = tmp_path / "solutions" / name / f"{name}.ipynb"
    text = source.read_text(encoding="utf-8")  # M.m is right for the arm of the book
    source.write_text(text.replace("year=2026)", "same_for_all=True)"), encoding="utf-8")
    run(tmp_path, "nbgrader", "generate_assignment", name)
    course = tmp_path / "course"
    (course / "seed").write_text("0123456789abcdef")
    release = nbformat.read(course / "release" / name / f"{name}.ipynb", as_version=4)
    submission = PROBLEMS["M"].submissions.right(release)
    cell_of(submission, "answer-M").source = 'M = from_file("M.m")'
    folder = course / "submitted" / "student" / name
    folder.mkdir(parents=True)
    (folder / f"{name}.ipynb").write_text(json.dumps(submission))
    (folder / "M.m").write_text(answers.right("M", ".m"))
    run(tmp_path, "nbgrader", "autograde", name)
    notebook = nbformat.read(course / "autograded" / "student" / name / f"{name}.ipynb", 4)
    shown = {
        cell.metadata.nbgrader.grade_id: cell.outputs[-1].data["text/plain"]
        for cell in notebook.cells
        if cell.cell_type == "code" and cell.metadata.get("nbgrader", {}).get("grade")
    }
    assert {key: float(score) for key, score in shown.items()} == PROBLEMS["M"].submissions.POINTS
