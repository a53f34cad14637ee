"""`autograder bundle`: what it says, and that the same course makes the same archive."""

import subprocess
import sys
from pathlib import Path

import pytest

from autograder.bundle.describing import Describing, DescribingError
from autograder.bundle.makers import Makers
from autograder.bundle.shaking import Shaking, ShakingError
from autograder.bundle.storing import in_numbers
from autograder.cli import main
from autograder.judging.models import Beside
from autograder.problems import CHECKS
from autograder.problems.material import planar_2r
from autograder.stored.reading import restored

ROOT = Path(__file__).parents[3]
DIGEST = """
from autograder.bundle.package import package
from autograder.digest import digest
print(digest(*(part for pair in package(["p3_pendulum"]).items() for part in pair)))
"""


def test_an_assignment_that_is_not_there(monkeypatch, capsys, tmp_path):
    monkeypatch.chdir(ROOT)
    assert main(["bundle", "p3-pendulm", "--to", str(tmp_path / "to")]) == 2
    assert "Did you mean p3-pendulum?" in capsys.readouterr().err
    assert not (tmp_path / "to").exists()


def test_outside_a_course(monkeypatch, capsys, tmp_path):
    monkeypatch.chdir(tmp_path)
    assert main(["bundle"]) == 2
    assert "is not the course's folder" in capsys.readouterr().err


def test_the_same_files_make_the_same_package():
    made = {
        subprocess.run(
            [sys.executable, "-c", DIGEST], cwd=ROOT, text=True, check=True, capture_output=True,
            env={"PYTHONHASHSEED": seed, "PATH": "/usr/bin:/bin"},
        ).stdout
        for seed in ("1", "2")
    }  # fmt: skip
    assert len(made) == 1


def test_what_has_a_name_comes_back_as_it_was():
    describing = Describing(Makers())
    for value in (
        1.5,
        "a",
        (1, [2.0, {"b": None}]),
        CHECKS["p3-M"].criteria,
        CHECKS["p3-M"].section,
    ):
        assert restored(describing.of(value)) == value


def test_a_right_model_is_kept_as_numbers_alone():
    describing = Describing(Makers())
    in_numbers(CHECKS["p2-C"], "p2-C", describing)
    assert [type(own) for own in describing.beside] == [Beside]
    assert not {name for name in describing.names if "planar_2r" in name}


def test_a_check_that_cannot_be_stored_is_named():
    class Odd:
        pass

    with pytest.raises(DescribingError, match="nor made of them by its fields"):
        Describing(Makers()).of(Odd())


def test_a_module_with_answers_is_not_taken():
    shaking = Shaking(lambda module: False, lambda module: False)
    with pytest.raises(ShakingError, match="holds answers"):
        shaking.need(planar_2r.__name__, "M")
