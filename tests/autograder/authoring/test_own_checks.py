"""Checks of the course's own, in checks/: written, tried, read, and found by a notebook."""

import os
import shutil
from pathlib import Path

import pytest

from autograder.cli import main
from autograder.problems import CHECKS, check_for, own_checks
from autograder.problems.own_checks import OwnChecksError, read
from autograder.student.cell import NotCorrectError, check
from tests.autograder.authoring.my_cart import (
    CART,
    COUPLED,
    HALF,
    HELD,
    MISTAKES,
    RIGHT,
    with_answers,
    written,
)
from tests.autograder.courses import P3
from tests.autograder.nbgrader_glue.accounts import needs_root

FILE = "checks/cart-pole.py"


@pytest.fixture
def root(tmp_path, monkeypatch):
    (tmp_path / "nbgrader_config.py").touch()
    monkeypatch.chdir(tmp_path)
    return tmp_path


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


def test_checks_take_the_place_of_a_mechanism_only_where_nobody_has_written_one(root, capsys):
    mechanism = root / "solutions" / "my-cart" / "my-cart.py"
    assert main(["new-problem", "my-cart"]) == 0
    text = mechanism.read_text()
    mechanism.write_text(text + "# mine\n")
    assert main(["new-problem", "my-cart", "--checks"]) == 2
    assert "my-cart.py is a mechanism, and gives the checks" in capsys.readouterr().err
    assert not (root / "checks" / "my-cart.py").exists()
    mechanism.write_text(text)
    assert main(["new-problem", "my-cart", "--checks"]) == 0
    assert (root / "checks" / "my-cart.py").is_file()
    assert not mechanism.exists()


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


@needs_root
def test_a_file_of_another_account_is_not_run(root, monkeypatch):
    path = written(root, "my-cart", f"{CART}\nimport pathlib\npathlib.Path('ran').touch()\n")
    os.chown(path, 12345, 12345)
    assert own_checks.files_here() == {}
    monkeypatch.setattr("os.geteuid", lambda: 12345)
    assert list(own_checks.files_here()) == ["checks/my-cart.py"]
    assert not (root / "ran").exists()


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
