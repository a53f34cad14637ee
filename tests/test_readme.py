"""What the README and the guides show works: the example, and every command by its name."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
from nbgrader.apps.nbgraderapp import NbGraderApp

from autograder.cli import main
from autograder.mechanisms import MECHANISMS
from autograder.mechanisms.file import mechanism_of
from autograder.mutation.checks import check_of
from autograder.problems import check_for
from tests.autograder.verdicts import judged_by

ROOT = Path(__file__).parents[1]
README = ROOT / "README.md"
GUIDES = [README, ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]


# Its model is in C, or in NumPy with a word on what to install.
@pytest.mark.filterwarnings("ignore:No working C compiler:RuntimeWarning")
def test_example_runs(capsys, monkeypatch, tmp_path):
    monkeypatch.setenv("ARMDYN_CACHE", str(tmp_path))
    (example,) = re.findall(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), re.S)
    names = {}
    exec(example, names)
    assert "holds" in capsys.readouterr().out
    assert abs(names["energy_drift"](names["arm"], names["x"])).max() < 1e-5
    assert names["fast"].n == 3


def subcommands(program: str) -> set[str]:
    if program == "nbgrader":
        return set(NbGraderApp.subcommands)
    ran = subprocess.run(
        [Path(sys.executable).with_name(program), "--help"],
        capture_output=True,
        text=True,
        check=True,
    )
    return set(re.search(r"\{([\w,-]+)\}", ran.stdout)[1].split(","))


@pytest.mark.parametrize("program", ["nbgrader", "autograder"])
def test_every_command_that_a_guide_shows_is_one(program):
    shown = {
        (path.name, name)
        for path in GUIDES
        for code in re.findall(r"```.*?```|`[^`]+`", path.read_text(encoding="utf-8"), re.S)
        for name in re.findall(rf"^[`\s]*{program} ([a-z_-]+)", code, re.M)
    }
    assert len(shown) > 3
    # `formgrade` only says that the Formgrader is in Jupyter.
    known = subcommands(program) - {"formgrade"}
    assert {(path, name) for path, name in shown if name not in known} == set()


def test_feedback_reaches_students_by_the_commands_of_the_readme():
    commands = re.findall(
        r"^(?:nbgrader|autograder) (\w+)", README.read_text(encoding="utf-8"), re.M
    )
    shown = ["problems", "lab"]
    assert [one for one in commands if one not in shown] == [
        *("generate_assignment", "release_assignment", "collect", "grade", "mark"),
        *("generate_feedback", "release_feedback", "export", "archive"),
    ]


def test_the_mechanism_of_the_guide_is_tried(tmp_path, monkeypatch, capsys):
    guide = (ROOT / "docs" / "own-problem.md").read_text(encoding="utf-8")
    example, sentences, ways_on, changed, mistakes = re.findall(r"```python\n(.*?)```", guide, re.S)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "lessons").symlink_to(ROOT / "lessons")
    given = re.findall(r"`(?:Mechanism` also `)?((?:\w+=[A-Z]+(?:, )?)+)`", guide)
    assert given == ["sentences=SENTENCES", "further=FURTHER, sections=SECTIONS"]
    with_them = example.rstrip().removesuffix(")") + f"    {', '.join(given)},\n)\n"
    (tmp_path / "block.py").write_text(sentences + ways_on + with_them, encoding="utf-8")
    assert main(["try", "block.py", "--all"]) == 0
    shown = capsys.readouterr().out
    assert "block-M: the right answer is correct" in shown
    for sentence in re.findall(r': "(.+)",', sentences):
        assert f"  {sentence}\n" in shown
    for name in MECHANISMS:
        assert name in guide, f"docs/own-problem.md does not list the mechanism {name}"
    cart = mechanism_of(changed, "cart-pole.py", "cart-pole")
    assert check_of(cart, "M").further in changed
    files = {"checks/p3-pendulum.py": mistakes}
    in_pounds = "0.4536 * pend.m * pend.g * pend.lc * np.sin(q)"
    said = judged_by(check_for("p3-g_vec", None, files), in_pounds)
    assert said.diagnosis[0] in mistakes
