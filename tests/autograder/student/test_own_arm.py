"""`own_arm` in a student's kernel: the name, the arm drawn from it, and what the checks judge."""

import os
import subprocess
import sys
from types import SimpleNamespace

import pytest

from autograder.problems.material.conventions import BOOK, FAMILY, drawn
from autograder.student import hint_counts, own_arm
from autograder.student.cell import check, verdict_on
from autograder.student.hints import hint
from autograder.student.own_arm import drawn_for

ARM = SimpleNamespace(l1=0.45, l2=0.4, g=9.81)


@pytest.fixture(autouse=True)
def kernel(monkeypatch, tmp_path):
    """A kernel of its own, in a folder that nobody fetched."""
    monkeypatch.setattr(own_arm, "_typed", [])
    monkeypatch.setattr(own_arm, "_drawn", {})
    monkeypatch.setattr(own_arm, "_nameless", set())
    monkeypatch.setattr(hint_counts, "_here", {})
    monkeypatch.delenv("JUPYTERHUB_USER", raising=False)
    folder = tmp_path / "problems" / "p1-inertia"
    folder.mkdir(parents=True)
    monkeypatch.chdir(folder)
    return folder


def set_up(problem="p1", **more):
    return own_arm.own_arm(problem, arm=ARM, year=2026, **more)


def test_without_a_name_it_says_to_type_it_and_takes_the_arm_of_the_book(capsys):
    own = set_up()
    printed = capsys.readouterr().out
    assert printed.startswith("No name is known here. Until you give yours,")
    # JupyterLab would break a longer line, within a word.
    assert max(map(len, printed.partition("This is the arm")[0].splitlines())) <= 78
    assert '\n    from autograder import own_arm\n    own_arm("p1", "your name")\n' in printed
    assert (own.turns == BOOK.turns).all()
    assert drawn_for("p1-M") is None


def test_each_check_says_that_a_name_is_missing_until_it_is_typed(capsys):
    set_up()
    namespace = {"__name__": "__main__", "M": BOOK.M, "check": check}
    exec('check("p1-M")', namespace)
    said = " ".join(capsys.readouterr().out.split())
    assert "no name is known. The grader takes your own arm" in said
    own_arm.own_arm("p1", "ada")
    set_up()
    namespace["M"] = drawn("ada", 2026).M
    capsys.readouterr()
    exec('check("p1-M")', namespace)
    assert "no name is known" not in capsys.readouterr().out


def test_a_typed_name_is_kept_for_the_set_up_cell(capsys):
    assert own_arm.own_arm("p1", " S1234 ") is None
    assert capsys.readouterr().out == (
        "Your name is S1234. Now run the set-up cell, and all cells below it.\n"
    )
    set_up()
    assert drawn_for("p1-M") == drawn("s1234", 2026)
    assert "This is the arm of S1234" in capsys.readouterr().out


def test_the_hub_knows_the_name(monkeypatch):
    monkeypatch.setenv("JUPYTERHUB_USER", "ada")
    set_up("p4")
    assert drawn_for("p4-g_vec") == drawn("ada", 2026)
    assert drawn_for("p1-M") is None


def test_a_fetched_folder_knows_the_name(kernel, monkeypatch):
    monkeypatch.setattr("getpass.getuser", lambda: "grace")
    set_up()
    assert drawn_for("p1-M") is None
    (kernel.parent.parent / "course" / "exchange" / "armdyn" / "outbound" / "p1-inertia").mkdir(
        parents=True
    )
    set_up()
    assert drawn_for("p1-M") == drawn("grace", 2026)


def test_one_arm_for_all(monkeypatch, capsys):
    monkeypatch.setenv("JUPYTERHUB_USER", "ada")
    own = set_up(same_for_all=True)
    assert own.directions([0, 0]).tolist() == [0, 0]
    assert drawn_for("p1-M") is None
    assert "No name" not in capsys.readouterr().out


def test_the_instructors_notebooks_have_the_arm_of_the_book(monkeypatch, tmp_path, capsys):
    monkeypatch.setenv("JUPYTERHUB_USER", "ada")
    (tmp_path / "solutions" / "p1-inertia").mkdir(parents=True)
    monkeypatch.chdir(tmp_path / "solutions" / "p1-inertia")
    set_up()
    assert drawn_for("p1-M") is None
    assert "No name" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "said"),
    [(("p3",), "own_arm knows p1, p2, p4, p5; you gave 'p3'"), (("p1", " "), "type your name"),
     (("p1", 1234), "type your name in quotes")],
)  # fmt: skip
def test_what_it_cannot_use_it_says(arguments, said):
    with pytest.raises(ValueError, match=said):
        own_arm.own_arm(*arguments)


def test_the_same_name_has_the_same_arm_in_every_process():
    script = (
        "from autograder.problems.material.conventions import FAMILY, drawn\n"
        "print([FAMILY.index(drawn(f's{k}', 2026)) for k in range(20)])"
    )
    for seed in ("1", "2"):
        printed = subprocess.run(
            [sys.executable, "-c", script], env=os.environ | {"PYTHONHASHSEED": seed},
            capture_output=True, text=True, check=True,
        ).stdout  # fmt: skip
        assert printed.strip() == str([FAMILY.index(drawn(f"s{k}", 2026)) for k in range(20)])


def test_a_check_and_its_hints_are_of_the_drawn_arm(monkeypatch, capsys):
    own = next(own for own in FAMILY if own.angles == "absolute")
    monkeypatch.setattr(own_arm, "drawn", lambda name, year: own)
    monkeypatch.setenv("JUPYTERHUB_USER", "ada")
    assert verdict_on("p1-M", {"M": BOOK.M}).credit == 1
    set_up()
    verdict = verdict_on("p1-M", {"M": BOOK.M})
    assert verdict.credit < 1
    assert verdict.diagnosis[0].startswith(
        "Your answer is right for an arm whose q2 is measured from the"
    )
    assert verdict_on("p1-M", {"M": own.M}, fresh=True).credit == 1
    capsys.readouterr()
    for _ in range(2):
        hint("p1-M")
    assert "as your table says" in capsys.readouterr().out


@pytest.mark.parametrize("problem", ["p2", "p5"])
def test_what_a_problem_gives_is_shown(problem, capsys, monkeypatch):
    monkeypatch.setenv("JUPYTERHUB_USER", "ada")
    own = set_up(problem)
    assert callable(own.M)
    assert "def M(q, arm):" in capsys.readouterr().out
