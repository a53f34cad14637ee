"""Checks of the course's own, in checks/: written, tried, released, judged, handed out in numbers."""

import json
import os
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

import nbformat
import pytest

from autograder.authoring.checks_template import of_a_problem
from autograder.bundle.archive import write_bundle
from autograder.cli import main
from autograder.nbgrader_glue import write_problem
from autograder.pipeline.run import grade_all
from autograder.problems import CHECKS, check_for, own_checks
from autograder.problems.own_checks import OwnChecksError, files_of, read
from autograder.student.cell import NotCorrectError, check
from tests.autograder.courses import P3, new_course, run, submit
from tests.autograder.courses import release as released_p3

FILE = "checks/cart-pole.py"
# The cart-pole by hand: not the kit's, which asks for cart-pole-M and so on.
CART = of_a_problem("my-cart")
HELD = "Your frequency is that of a trolley which stands still."
RIGHT = "return np.sqrt((arm.mt + arm.ml) * arm.g / (arm.mt * arm.l))"
COUPLED = """c = arm.ml * arm.l * np.cos(q[1])
    return np.array([[arm.mt + arm.ml, c], [c, arm.ml * arm.l**2]])"""
WRONG = "return np.sqrt(arm.g / arm.l)"
HALF = "Your inertia is half of the right one. Which of your lines halves it?"
MISTAKES = f"""
from autograder.checks import Mistake

MISTAKES = {{"p3-M": (Mistake("half", lambda q, pend: pend.I / 2, "{HALF}"),)}}
"""


@pytest.fixture
def root(tmp_path, monkeypatch):
    (tmp_path / "nbgrader_config.py").touch()
    monkeypatch.chdir(tmp_path)
    return tmp_path


def written(root, name, text):
    (root / "checks").mkdir(exist_ok=True)
    path = root / "checks" / f"{name}.py"
    path.write_text(text, encoding="utf-8")
    return path


def line(text):
    return 1 + next(i for i, one in enumerate(CART.splitlines()) if text in one)


def test_a_file_to_fill_in_then_a_notebook_of_it_and_what_is_left_to_do(root, capsys):
    assert main(["new-problem", "my-cart", "--checks"]) == 0
    path = root / "checks" / "my-cart.py"
    assert "checks/my-cart.py: written" in capsys.readouterr().out
    if os.name == "posix":
        assert path.stat().st_mode & 0o077 == 0  # it holds answers
    assert main(["new-problem", "my-cart", "--checks"]) == 2
    assert "checks/my-cart.py is there already" in capsys.readouterr().err
    assert main(["new-problem", "my-cart"]) == 0
    assert main(["try", "my-cart"]) == 1
    said = capsys.readouterr().out
    assert "my-cart-M: right answers pass; 1 of 1 mistakes are named" in said
    assert "! my-cart, its model answers handed in and graded: not full points" in said
    notebook = root / "solutions" / "my-cart" / "my-cart.ipynb"
    with_answers(notebook, RIGHT, COUPLED)
    assert main(["try", "my-cart"]) == 0
    assert "handed in and graded: full points" in capsys.readouterr().out
    assert main(["new-problem", "my-cart"]) == 2
    assert "solutions/my-cart/my-cart.ipynb is there already" in capsys.readouterr().err
    assert main(["new-problem", "My Cart", "--checks"]) == 2
    assert "small letters, digits and hyphens" in capsys.readouterr().err


def test_trying_finds_what_is_not_as_it_should_be(root, capsys):
    two = CART.replace("np.diag(np.diag(M(q, arm)))", "M(q, arm)").replace(
        "calls=swing_calls", "calls=M_calls"
    )
    written(root, "my-cart", two + MISTAKES.replace("p3-M", "p3-m"))
    assert main(["try", "my-cart"]) == 1
    said = capsys.readouterr().out
    assert "! my-cart-small_swing: its own reference is not right:" in said
    assert f"checks/my-cart.py, line {line('def small_swing')}" not in said  # it is called wrongly
    assert "  no coupling: correct, and the card says: nothing more" in said
    assert "! checks/my-cart.py: there is no check 'p3-m'" in said


def test_a_problem_of_the_kit_gets_a_file_for_mistakes(root, capsys):
    shutil.copytree(Path(__file__).parents[3] / "solutions" / P3, root / "solutions" / P3)
    assert main(["new-problem", P3, "--checks"]) == 0
    text = (root / "checks" / f"{P3}.py").read_text(encoding="utf-8")
    assert "#   p3-M: M(q, pend)" in text
    assert read(text, f"checks/{P3}.py").mistakes == {}
    assert "new-problem" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (CART.replace("import sqrt", "import sqrt,"), f"{FILE}, line 3: SyntaxError: "),
        (CART.replace("calls=M_calls", "calls=Mcalls"), f"line {line('calls=M_calls')}: NameError"),
        (
            CART.replace('Criterion("inertia matrix")', 'Criterion("inertia matrix", share=0.5)'),
            "ValueError: check my-cart-M: the shares add up to 0.5, must be 1",
        ),
        (
            CART.replace('id="my-cart-M"', 'id="my-cart-inertia"'),
            f"line {line('my-cart-M')}: the check 'my-cart-inertia' needs an id that ends in its "
            "function's name, such as my-cart-M",
        ),
        (CART.replace('id="my-cart-small_swing"', 'id="my-cart-M"'), "needs an id that ends in"),
        (CART.replace("CHECKS = (", "CHECK = ("), "needs CHECKS = (Check(…), …) or MISTAKES = "),
        (MISTAKES.replace("),)}", "))}"), "MISTAKES['p3-M'] needs a tuple, (Mistake(…),); a comma"),
        (
            MISTAKES.replace("lambda q, pend: pend.I / 2", "3"),
            "'half' of MISTAKES['p3-M'] needs a fu",
        ),
        ("MISTAKES = []", "MISTAKES needs the id of a check before each tuple"),
        ("raise SystemExit", "SystemExit"),
    ],
)
def test_a_broken_file_names_the_line_and_what_to_do(text, said):
    with pytest.raises(OwnChecksError) as error:
        read(text, FILE)
    assert said in str(error.value)
    assert str(error.value).startswith(FILE)
    assert str(error.value).endswith(
        "put the file right, and try it with `autograder try cart-pole`"
    )


def test_a_broken_file_stops_no_other_problem():
    files = {FILE: CART.replace("(rng):", "(rng:")}
    assert check_for("p3-M", None, files) is CHECKS["p3-M"]
    assert check_for("cart-pole-M", None, files) is not None
    with pytest.raises(OwnChecksError, match=r"checks/cart-pole\.py, line \d+: SyntaxError"):
        check_for("my-cart-M", None, files)
    both = files | {"checks/my-cart.py": CART}
    assert check_for("my-cart-M", None, both) is not None
    assert check_for("my-cart-foo") is None


def test_an_id_of_the_kit_is_not_taken():
    with pytest.raises(OwnChecksError, match="'p3-M' is a check of the kit"):
        check_for("p3-M", None, {FILE: CART.replace("my-cart-M", "p3-M")})


def test_an_added_mistake_goes_before_the_kits_and_replaces_one_of_its_name():
    added = check_for("p3-M", None, {"checks/p3-pendulum.py": MISTAKES})
    assert added.mistakes[0].sentence == HALF
    name = CHECKS["p3-C"].mistakes[0].name
    text = MISTAKES.replace('"half"', f'"{name}"').replace("p3-M", "p3-C")
    replaced = check_for("p3-C", None, {"checks/p3-pendulum.py": text})
    assert [own.sentence for own in replaced.mistakes if own.name == name] == [HALF]


def test_a_check_that_fails_while_judging_names_the_line(root, capsys):
    written(root, "my-cart", CART.replace("return sqrt((arm.mt", "return sqrt((arm.mx"))
    with pytest.raises(NotCorrectError):
        exec('check("my-cart-small_swing")', {"check": check, "small_swing": lambda arm: 1.0})
    at = f"(checks/my-cart.py, line {line('return sqrt((arm.mt')})"
    assert at in " ".join(capsys.readouterr().out.split())


def test_a_notebooks_check_finds_the_file_in_the_course(root, monkeypatch, capsys):
    path = written(root, "my-cart", CART)
    written(root, "other", "1 +")
    folder = root / "problems" / "my-cart"
    folder.mkdir(parents=True)
    monkeypatch.chdir(folder)
    given = {"check": check, "small_swing": lambda arm: (arm.g / arm.l) ** 0.5}
    with pytest.raises(NotCorrectError):
        exec('check("my-cart-small_swing")', given)
    said = capsys.readouterr().out
    assert HELD in " ".join(said.split())
    assert "other.py" not in said  # another problem's
    path.write_text(CART.replace("frequency is that", "swing is that"), encoding="utf-8")
    with pytest.raises(NotCorrectError):
        exec('check("my-cart-small_swing")', given)
    assert "swing is that" in " ".join(capsys.readouterr().out.split())
    path.write_text("1 +", encoding="utf-8")
    with pytest.raises(OwnChecksError, match=r"checks/my-cart\.py, line 1"):
        exec('check("my-cart-small_swing")', given)


def with_answers(path, *bodies):
    notebook = nbformat.read(path, 4)
    cells = [c for c in notebook.cells if c.cell_type == "code" and "def " in c.source]
    for cell, body in zip(cells, bodies, strict=True):
        cell.source = cell.source.replace("raise NotImplementedError  # your model answer", body)
    nbformat.write(notebook, path)
    return notebook


@pytest.fixture(scope="module")
def course(tmp_path_factory):
    """A course with a problem of its own and a mistake added to p3. Ada is right, Bob is not."""
    root = new_course(tmp_path_factory.mktemp("own") / "course")
    (root / "lessons").mkdir()
    written(root, "my-cart", CART)
    written(root, P3, MISTAKES)
    run(root, "autograder", "new-problem", "my-cart")
    model = with_answers(root / "solutions" / "my-cart" / "my-cart.ipynb", RIGHT, COUPLED)
    run(root, "nbgrader", "generate_assignment", "my-cart")
    for student in ("ada", "bob"):
        handed_in = nbformat.read(root / "course" / "release" / "my-cart" / "my-cart.ipynb", 4)
        for cell, answer in zip(handed_in.cells, model.cells, strict=True):
            if answer.metadata.get("nbgrader", {}).get("grade_id", "").startswith("answer-"):
                cell.source = answer.source
                if student == "bob":
                    cell.source = cell.source.replace(RIGHT, WRONG)
        to = root / "course" / "submitted" / student / "my-cart"
        to.mkdir(parents=True)
        nbformat.write(handed_in, to / "my-cart.ipynb")
    notebook = released_p3(root)
    for cell in notebook.cells:
        if cell.metadata.get("nbgrader", {}).get("grade_id") == "answer-M":
            cell.source = "def M(q, pend):\n    return np.array([[pend.I / 2]])"
    submit(root, "bob", notebook)
    return root


def cards(root, student, assignment):
    path = root / "course" / "autograded" / student / assignment / f"{assignment}.ipynb"
    return [
        "".join(output["data"]["text/plain"])
        for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]
        for output in cell.get("outputs", [])
        if "text/plain" in output.get("data", {})
    ]


def test_nothing_of_the_file_is_handed_out(course):
    files = [path for path in (course / "course" / "release").rglob("*") if path.is_file()]
    assert sorted(path.name for path in files if path.parent.name == "my-cart") == ["my-cart.ipynb"]
    assert not any(b"arm.mt + arm.ml" in path.read_bytes() for path in files)


def test_both_ways_to_grade_judge_by_it_and_name_its_mistakes(course):
    for command in (
        ("autograder", "grade", "my-cart", "--jobs", "1"),
        ("nbgrader", "autograde", "my-cart", "--force"),
    ):
        run(course, *command)
        ada, bob = (" ".join(cards(course, name, "my-cart")) for name in ("ada", "bob"))
        assert "my-cart-small_swing: correct" in ada
        assert "my-cart-small_swing: incorrect" in bob
        assert HELD in " ".join(bob.split())
    run(course, "autograder", "grade", P3, "--jobs", "1")
    assert HALF in " ".join("\n".join(cards(course, "bob", P3)).split())
    run(course, "nbgrader", "generate_feedback", "my-cart")
    page = course / "course" / "feedback" / "bob" / "my-cart" / "my-cart.html"
    assert "trolley which stands still" in " ".join(page.read_text(encoding="utf-8").split())
    run(course, "autograder", "report", "my-cart")
    report = course / "course" / "report" / "my-cart.html"
    assert "trolley held" in report.read_text(encoding="utf-8")


def test_a_changed_file_is_judged_anew_and_a_broken_one_grades_nobody(course):
    path = course / "checks" / "my-cart.py"
    run(course, "autograder", "grade", "my-cart", "--jobs", "1")  # others than nbgrader's stay
    assert "0 graded, 2 unchanged" in run(course, "autograder", "grade", "my-cart", "--jobs", "1")
    path.write_text(CART.replace("frequency is that", "swing is that"), encoding="utf-8")
    assert "2 graded" in run(course, "autograder", "grade", "my-cart", "--jobs", "1")
    assert "swing is that" in " ".join("\n".join(cards(course, "bob", "my-cart")).split())
    path.write_text(f"{CART}\nx = y\n", encoding="utf-8")
    said = run(course, "autograder", "grade", "my-cart", "--jobs", "1", status=2)
    assert f"checks/my-cart.py, line {len(CART.splitlines()) + 2}: NameError" in said
    said = run(course, "nbgrader", "autograde", "my-cart", "--force", "--student", "bob")
    assert "my-cart-M could not be judged: checks/my-cart.py, line" in said
    path.write_text(CART, encoding="utf-8")


def test_the_sandbox_does_not_see_it(course):
    notebook = released_p3(course)
    for cell in notebook.cells:
        if cell.metadata.get("nbgrader", {}).get("grade_id") == "answer-M":
            cell.source = (
                "import os, sys\nfound = [p for top in ('/', '..', sys.prefix) for p, _, names in "
                "os.walk(top) if 'my-cart.py' in names]\nprint('found', found, 'course_checks' in "
                "str(sys.modules))"
            )
    submit(course, "eve", notebook)
    grade_all(course, P3, _recorder, 1)
    path = course / "course" / "autograded" / "eve" / P3 / f"{P3}.ipynb"
    assert "found [] False" in path.read_text(encoding="utf-8")


def _recorder(root, assignment):
    from autograder.nbgrader_glue.recorder import Recorder

    return Recorder(root, assignment)


def test_a_class_gets_it_in_numbers(course, tmp_path):
    """The student's package, installed, names the course's mistakes without its formulas."""
    made = write_bundle(course, ["my-cart", P3], tmp_path / "archive", write_problem)
    shutil.unpack_archive(made.path, tmp_path)
    (wheel,) = (tmp_path / "armdyn").glob("*.whl")
    package = tmp_path / "package"
    shutil.unpack_archive(wheel, package, "zip")
    text = "\n".join(
        path.read_text(encoding="utf-8", errors="replace") for path in package.rglob("*.py")
    )
    assert "course_checks" in "\n".join(map(str, package.rglob("*.py")))
    assert "arm.ml" not in text
    assert "trolley held" not in text
    code = f"""
from autograder import check
import autograder, numpy as np
print(autograder.__file__)
def small_swing(arm):
    {WRONG}
def M(q, arm):
    {COUPLED}
def tried(id):
    try:
        check(id)
    except Exception as error:
        print(type(error).__name__)
tried("my-cart-small_swing")
tried("my-cart-M")
def M(q, pend):
    return np.array([[pend.I / 2]])
tried("p3-M")
"""
    done = subprocess.run(
        [sys.executable, "-I", "-S", "-c",
         f"import sys; sys.path[:0] = [{str(package)!r}, {sysconfig.get_paths()['purelib']!r}]\n{code}"],
        cwd=tmp_path, capture_output=True, text=True, check=True, timeout=120,
    )  # fmt: skip
    said = " ".join(done.stdout.split())
    assert str(package) in said
    assert HELD in said
    assert "my-cart-M: correct" in said
    assert HALF in said


def test_the_right_file_belongs_to_each_problem(course):
    assert list(files_of(course / "solutions" / "my-cart")) == ["checks/my-cart.py"]
    assert files_of(course / "solutions" / "p1-inertia") == {}
    assert own_checks.course_of(course / "solutions" / "my-cart") == course
