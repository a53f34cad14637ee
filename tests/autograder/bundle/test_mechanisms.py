"""A problem about a mechanism comes in numbers as well: its energies are not handed out."""

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from autograder.authoring.course import own
from autograder.authoring.problem import write_problem
from autograder.bundle.archive import write_bundle
from autograder.nbgrader_glue import write_problem as release
from tests.autograder.bundle import judged
from tests.autograder.verdicts import indented

ROOT = Path(__file__).parents[3]
ASKED = ["potential_energy", "M", "C", "f", "regressor"]
WRONG = {
    "potential_energy(q, arm)": "0 * q[0]",
    "M(q, arm)": "np.eye(2)",
    "C(q, qd, arm)": "np.outer(q, qd)",
    "f(x, u, arm)": "np.concatenate([x[2:], x[:2]])",
    "regressor(q, qd, qdd, arm)": "np.zeros((2, 3))",
}


@pytest.fixture(scope="module")
def handed_out(tmp_path_factory):
    """The folder of a student of a course with this one problem, unpacked as its package is."""
    root = tmp_path_factory.mktemp("course")
    shutil.copy(ROOT / "nbgrader_config.py", root)
    (root / "lessons").mkdir()
    write_problem(root, own(root, "cart-pole"), ASKED)
    made = write_bundle(root, [], root / "build", release)
    assert made.assignments == ("cart-pole",)
    shutil.unpack_archive(made.path, root / "student")
    (wheel,) = (root / "student" / "armdyn").glob("*.whl")
    shutil.unpack_archive(wheel, root / "package", "zip")
    return root


def test_its_energies_stay_at_home(handed_out):
    files = [*handed_out.glob("student/**/*"), *handed_out.glob("package/**/*")]
    text = "\n".join(f.read_text(errors="replace") for f in files if f.suffix in (".py", ".ipynb"))
    assert "cart-pole-M" in text
    assert "EnergyTerm" not in text
    assert not list(handed_out.glob("package/autograder/mechanisms"))


def test_its_verdicts_are_the_same(handed_out, monkeypatch):
    tasks = [
        {"id": f"cart-pole-{head.partition('(')[0]}", "arm": "",
         "code": f"def {head}:\n{indented(body)}\n"}
        for head, body in WRONG.items()
    ]  # fmt: skip
    code = f"import sys; sys.path.insert(0, {str(handed_out / 'package')!r}); import runpy; " + (
        f"runpy.run_path({judged.__file__!r}, run_name='__main__')"
    )
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", code], input=json.dumps(tasks), text=True,
        capture_output=True, check=True, cwd=handed_out,
    )  # fmt: skip
    monkeypatch.setattr("autograder.judging.check.SLOW", judged.SLOW)
    monkeypatch.setattr("autograder.student.cell.SLOW", judged.SLOW)
    theirs = json.loads(done.stdout)
    assert [judged.judged(task) for task in tasks] == theirs
    assert all("incorrect" in card or "partly" in card or "error" in card for _, card, _ in theirs)
