"""A mechanism of one's own stands beside its problem's notebook: written, released, judged by it."""

import json
import re

import nbformat
import pytest

from autograder.authoring.course import found
from autograder.authoring.rehearsal import STYLES, mistaken, rehearsed
from autograder.authoring.template import template
from autograder.cli import main
from autograder.mechanisms import MECHANISMS
from autograder.mechanisms.file import MechanismFileError, mechanism_of
from autograder.mutation.trial import Line
from autograder.notebook.beside import Beside
from autograder.problems import check_for
from autograder.student.cell import NotCorrectError, check
from tests.autograder.courses import new_course, run

SLED = template("sled").replace("the block", "the sled")
OTHER = SLED.replace("x.velocity**2 / 2", "x.velocity**2")


def line(text):
    return 1 + next(i for i, written in enumerate(SLED.splitlines()) if text in written)


STIFFNESS, SPRING, PLACES = line("N/m"), line('EnergyTerm("the spring'), line("(q[0], 0.0)")


@pytest.fixture
def root(tmp_path, monkeypatch):
    (tmp_path / "nbgrader_config.py").touch()
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_a_new_name_gives_a_file_to_fill_in_and_then_a_problem(root, capsys):
    assert main(["new-problem", "sled"]) == 0
    path = root / "solutions" / "sled" / "sled.py"
    assert "solutions/sled/sled.py: written, for you to fill in" in capsys.readouterr().out
    assert main(["new-problem", "sled"]) == 2
    assert "still as it was written" in capsys.readouterr().err
    path.write_text(SLED, encoding="utf-8")
    assert main(["new-problem", "sled"]) == 0
    assert "it asks for potential_energy, M, g_vec." in capsys.readouterr().out  # as C is 0
    assert path.read_text(encoding="utf-8") == SLED
    assert path.with_suffix(".ipynb").is_file()
    assert main(["new-problem", "sled"]) == 2
    assert "solutions/sled/sled.ipynb is there already" in capsys.readouterr().err


def test_a_file_of_anywhere_is_taken_into_the_course(root, capsys):
    (root / "my.py").write_text(SLED, encoding="utf-8")
    assert main(["new-problem", "my.py", "--asks", "M"]) == 0
    assert (root / "solutions" / "sled" / "sled.py").read_text(encoding="utf-8") == SLED
    (root / "my.py").write_text(OTHER, encoding="utf-8")
    assert main(["new-problem", "my.py"]) == 2
    assert "solutions/sled/sled.py is there already" in capsys.readouterr().err


def test_a_name_with_a_letter_wrong_finds_the_courses_own(root, capsys):
    (root / "my.py").write_text(SLED, encoding="utf-8")
    assert main(["new-problem", "my.py", "--asks", "M, g_vec"]) == 0
    assert "it asks for M, g_vec." in capsys.readouterr().out
    assert main(["try", "sledd"]) == 2
    assert (
        "(did you mean sled?); the course has sled; the kit has pendulum" in capsys.readouterr().err
    )


def test_a_name_that_no_mechanism_can_have(root, capsys):
    assert main(["new-problem", "Two Sleds"]) == 2
    assert "small letters, digits and hyphens" in capsys.readouterr().err
    assert not (root / "solutions").exists()


def test_what_is_0_for_every_motion_cannot_be_asked(root, capsys):
    assert main(["new-problem", "elastic-joint", "--asks", "M,C"]) == 2
    assert "C of elastic-joint is 0 for every motion: ask for something else" in (
        capsys.readouterr().err
    )
    assert not (root / "solutions").exists()


def test_a_course_may_change_a_mechanism_of_the_kit(root):
    folder = root / "solutions" / "pendulum"
    folder.mkdir(parents=True)
    (folder / "pendulum.py").write_text(template("pendulum") + "\n", encoding="utf-8")
    assert found(root, "pendulum").coordinates[0].name == "x"
    assert found(root, "cart-pole") is MECHANISMS["cart-pole"]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            SLED.replace("m.symbol *", "m.symbol */"),
            f"sled.py, line {line('m.symbol *')}: SyntaxError: ",
        ),
        (
            SLED.replace("(x,)", "(y,)"),
            f"sled.py, line {line('(x,)')}: NameError: name 'y' is not defined; put",
        ),
        (
            SLED.replace("x.velocity**2", "x.velocity"),
            f"sled.py, line {line('the motion of')}: ValueError: mechanism 'sled': "
            "'the motion of the sled' of K is not quadratic in the velocities",
        ),
        (SLED.replace('"N/m"', '"N"'), f"line {SPRING}: ValueError: mechanism 'sled'"),
        (SLED.replace('"N/m"', '"N/cm"'), f"line {STIFFNESS}: ValueError: mechanism 'sled': k: "),
        (
            SLED.replace("5.0, 40.0", "40.0, 5.0"),
            f"line {STIFFNESS}: ValueError: mechanism 'sled': k is",
        ),
        (SLED.replace("(q[0], 0.0)", "(q[1], 0.0)"), f"line {PLACES}: ValueError: "),
        (SLED.replace("k.symbol *", "k * m *"), "an energy is made of m.symbol for a parameter m"),
        (SLED.replace("k.symbol * x.symbol", "k.symbol * sp.sin(x)"), "x.symbol and x.velocity"),
        (SLED.replace("m.symbol *", "-m.symbol *"), "K is negative for a motion with xd"),
        (
            SLED.replace("m.symbol * x", "0 * m.symbol * x"),
            "K is 0 for a motion with xd, so M has no inverse",
        ),
        (
            SLED.replace('"sled"', '"sledge"'),
            "its mechanism is called 'sledge'; write name=\"sled\"",
        ),
        (
            SLED.replace("parameters=(m, k)", "parameters=(m, k, r)").replace(
                "k = Param", 'r = Parameter("r", "m", "of nothing", 0.1, 0.2)\nk = Param'
            ),
            f"line {STIFFNESS}: ValueError: mechanism 'sled': the parameter 'r' is in no energy, in no",
        ),
        ("MECHANISM = 1", "needs MECHANISM = Mechanism(…)"),
    ],
)
def test_a_broken_file_names_the_line(text, said):
    with pytest.raises(MechanismFileError) as error:
        mechanism_of(text, "sled.py", "sled")
    assert said in str(error.value)
    assert "sled.py" in str(error.value)


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("[(0.0, 0.0), (q[0], 0.0)]", "[(0.0, 0.0), (q[0] + arm.r, 0.0)]"),
        ("points=points,", "points=points,\n    draws=lambda q, arm: [Mass((arm.r, q[0]))],"),
        ("points=points,", "points=points,\n    friction=(DRAG,),"),
    ],
)
def test_a_parameter_may_stand_in_a_place_or_in_the_friction_alone(before, after):
    text = SLED.replace("parameters=(m, k)", "parameters=(m, k, r)").replace(
        "k = Param",
        "from autograder.mechanisms import FrictionTerm\n"
        "from autograder.mechanisms.friction import coefficient\n"
        "from autograder.mechanisms.shapes import Mass\n"
        'r = Parameter("r", "m", "radius", 0.1, 0.2)\n'
        'DRAG = FrictionTerm("the drag", "x", "drag", "N·s/m²", '
        'coefficient("drag", "x") * r.symbol * x.velocity)\nk = Param',
    )
    assert mechanism_of(text.replace(before, after), "sled.py", "sled").n == 1
    with pytest.raises(MechanismFileError, match="the parameter 'r' is in no energy"):
        mechanism_of(text, "sled.py", "sled")


def test_a_file_is_read_once_and_judges_its_own_problem_only():
    files = {"sled.py": SLED, "p1.py": template("p1")}
    one, again = check_for("sled-M", None, files), check_for("sled-M", None, files)
    assert one is not None
    assert again is not None
    assert one.reference is again.reference
    assert check_for("sled-M") is None
    assert check_for("sled-points", None, files) is None
    assert check_for("p1-M", None, files) is check_for("p1-M")
    assert (
        Beside(mechanisms=files).digest() != Beside(mechanisms=files | {"sled.py": OTHER}).digest()
    )


def test_a_students_check_finds_the_file_beside_the_notebook(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    given = {"check": check, "M": lambda q, arm: arm.m}
    with pytest.raises(ValueError, match=r"and no sled\.py beside the notebook that could give it"):
        exec('check("sled-M")', given)
    (tmp_path / "sled.py").write_text(SLED, encoding="utf-8")
    exec('check("sled-M")', given)
    assert "sled-M: correct" in capsys.readouterr().out
    given["M"] = lambda q, arm: 2 * arm.m
    with pytest.raises(NotCorrectError):
        exec('check("sled-M")', given)
    (tmp_path / "sled.py").write_text("MECHANISM = None", encoding="utf-8")
    with pytest.raises(MechanismFileError, match=r"sled\.py: needs MECHANISM"):
        exec('check("sled-M")', given)


def test_right_answers_in_every_style_pass_the_real_grader():
    lines = list(rehearsed(mechanism_of(SLED, "sled.py", "sled"), {"sled.py": SLED}))
    assert lines[1:] == [Line(f"  {style}: full points") for style in STYLES]
    # The grader judges by the file that it is given, so there the same answers are wrong.
    lines = list(rehearsed(mechanism_of(SLED, "sled.py", "sled"), {"sled.py": OTHER}))
    assert not any(line.good for line in lines[1:])
    assert "sled-M: incorrect" in lines[1].text


def test_mistakes_in_an_energy_get_from_the_real_grader_what_a_check_says_here():
    own = mechanism_of(SLED, "sled.py", "sled")
    head, *lines = mistaken(own, {"sled.py": SLED}, ["M", "g_vec", "f"])
    assert re.fullmatch(r"sled, 3 of \d+ mistakes in its energies handed in and graded:", head.text)
    assert all(line.good for line in lines)
    assert "  dropped / the motion of the sled: 2 of 3 answers wrong" in lines[0].text
    assert "    Your M lacks the motion of the sled." in [one.text for one in lines]
    # A grader that judges by another file says something else.
    other = mistaken(own, {"sled.py": OTHER}, ["M"])
    assert not all(line.good for line in other)


def test_the_grader_takes_the_courses_file(tmp_path):
    """Ada hands in right answers, Bob a wrong M with a file that would make it right."""
    root = new_course(tmp_path / "course")
    folder = root / "solutions" / "sled"
    folder.mkdir()
    (folder / "sled.py").write_text(SLED, encoding="utf-8")
    run(root, "autograder", "new-problem", "sled", "--asks", "M,g_vec")
    run(root, "nbgrader", "generate_assignment", "sled")
    released = root / "course" / "release" / "sled" / "sled.ipynb"
    assert (released.parent / "sled.py").read_text(encoding="utf-8") == SLED

    model = nbformat.read(folder / "sled.ipynb", 4)
    for student in ("ada", "bob"):
        handed_in = nbformat.read(released, 4)
        for cell, answer in zip(handed_in.cells, model.cells, strict=True):
            if answer.metadata.get("nbgrader", {}).get("grade_id", "").startswith("answer-"):
                cell.source = answer.source
                if student == "bob":
                    cell.source = cell.source.replace("M11 = arm.m", "M11 = 2*arm.m")
        to = root / "course" / "submitted" / student / "sled"
        to.mkdir(parents=True)
        nbformat.write(handed_in, to / "sled.ipynb")
        (to / "sled.py").write_text(OTHER if student == "bob" else SLED, encoding="utf-8")
    shown = run(root, "autograder", "grade", "sled", "--jobs", "1")
    assert "could not be" not in shown
    assert "2 graded, 0 unchanged" in shown
    assert _said(root, "ada") == ["sled-M: correct", "sled-g_vec: correct"]
    assert _said(root, "bob") == ["sled-M: incorrect", "sled-g_vec: correct"]
    run(root, "nbgrader", "autograde", "sled", "--force")
    assert _said(root, "ada") == ["sled-M: correct", "sled-g_vec: correct"]
    assert _said(root, "bob") == ["sled-M: incorrect", "sled-g_vec: correct"]

    (folder / "sled.py").write_text(SLED.replace("(x,)", "(y,)"), encoding="utf-8")
    shown = run(root, "autograder", "grade", "sled", "--jobs", "1", status=1)
    assert f"sled-M could not be judged: sled.py, line {line('(x,)')}: NameError" in shown


def _said(root, student):
    """The first line of each card."""
    graded = root / "course" / "autograded" / student / "sled" / "sled.ipynb"
    cells = json.loads(graded.read_text(encoding="utf-8"))["cells"]
    return [
        _plain(cell["outputs"]).splitlines()[0]
        for cell in cells
        if cell["metadata"].get("nbgrader", {}).get("grade") and cell["cell_type"] == "code"
    ]


def _plain(outputs):
    return next(
        "".join(o["data"]["text/plain"]) for o in outputs if "text/plain" in o.get("data", {})
    )
