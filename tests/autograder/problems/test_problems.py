"""What holds for every problem: its notebook, its release, and what its submissions get.

What only one problem can say (its hints, the sentences on its wrong answers) is in its own tests.
"""

import re
from dataclasses import dataclass

import nbformat
import pytest

from autograder.judging.verdict import State
from autograder.notebook.recognise import grade_id
from autograder.problems import CHECKS, READ
from tests.autograder.course_problems import NAMES, ROOT, problem
from tests.submissions.answers import cell_of

IMAGE = re.compile(r"!\[(.*?)\]\((.*?)\)", re.DOTALL)
RUBRIC = re.compile(r"^\| points \| for \|\n\|[-|]+\|\n((?:\|.*\n?)+)", re.MULTILINE)


@dataclass(frozen=True)
class Own:
    """What the notebook must agree with: its grade_id and points of the answer that a person reads,
    the points of all cells, and phrases of the answers that no student may be given.
    """

    read: str
    points: int
    total: int
    phrases: tuple[str, ...] = ()


OWN = {
    "c6-regressor": Own("c6-discussion", 5, 15, ("moved into",)),
    "p1-inertia": Own("p1-proof", 4, 15),
    "p2-energy-skew": Own("p2-proof", 5, 17, ("np.sin(q[1])", "Exchanging")),
    "p3-pendulum": Own("p3-derivation", 5, 15),
    "p4-gravity": Own("p4-check", 5, 15, ("one up, one down",)),
    "p5-state-space": Own("p5-discussion", 5, 20),
}


@pytest.fixture(scope="module", params=NAMES)
def given(request):
    return problem(request.param)


def test_a_person_reads_one_answer_of_each_problem():
    assert sorted(READ) == sorted(own.read for own in OWN.values())


def claims(cell) -> dict:
    return cell.metadata.get("nbgrader", {})


def code(notebook):
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def text(notebook) -> str:
    return "\n".join(cell.source for cell in notebook.cells)


def test_every_problem_is_here():
    modules = (ROOT / "tests" / "submissions").glob("[pc][0-9]_*.py")
    assert sorted(path.stem.replace("_", "-") for path in modules) == NAMES
    assert sorted(OWN) == NAMES


def test_format_and_kernel(given):
    nbformat.validate(given.source)
    assert given.source.metadata.kernelspec.name == "python3"


@pytest.mark.parametrize("version", ["source", "release"])
def test_no_outputs_are_stored(given, version):
    for cell in code(getattr(given, version)):
        assert cell.outputs == []
        assert cell.execution_count is None


def test_grade_ids_are_unique(given):
    ids = [name for name in map(grade_id, given.source.cells) if name]
    assert len(ids) == len(set(ids))


def test_points_are_those_of_the_grade_cells(given):
    own = OWN[given.name]
    points = {
        grade_id(c): claims(c)["points"] for c in given.source.cells if claims(c).get("grade")
    }
    assert points == given.submissions.POINTS | {own.read: own.points}
    assert sum(points.values()) == own.total


def test_one_answer_is_read_by_a_person_with_a_rubric(given):
    own = OWN[given.name]
    (read,) = [c for c in given.source.cells if claims(c).get("grade") and claims(c)["solution"]]
    assert (grade_id(read), read.cell_type) == (own.read, "markdown")
    assert own.read in READ  # so that `check` can say so
    (rubric,) = RUBRIC.findall(text(given.source))
    rows = [row.split("|") for row in rubric.strip().splitlines()]
    assert sum(float(points) for _, points, *_ in rows) == own.points
    assert all(what.strip() for _, _, what, *_ in rows)
    assert RUBRIC.findall(text(given.release)) == [rubric]


def test_each_check_has_the_cell_of_its_function(given):
    names = [CHECKS[id].name for id in given.submissions.POINTS]
    assert names == list(given.submissions.RIGHT)
    for name in names:
        cell = cell_of(given.source, f"answer-{name}")
        assert claims(cell)["solution"]
        assert not claims(cell)["grade"]
        assert f"def {name}(" in cell.source


def test_shares_of_a_check_add_up(given):
    for id in given.submissions.POINTS:
        assert sum(c.share for c in CHECKS[id].criteria) == pytest.approx(1), id


def test_figures_are_beside_the_notebook_and_described(given):
    images = IMAGE.findall(text(given.source))
    assert images
    for alt, file in images:
        assert len(alt) > 40
        assert (given.folder / file).is_file()
        assert (given.release_folder / file).is_file()


def test_the_solution_is_right(given):
    graded = given.graded("source")
    assert graded.verdicts.keys() == given.submissions.POINTS.keys()
    assert given.states("source") == {State.CORRECT}
    assert graded.notes == ()
    shown = [output for cell in code(graded.notebook) for output in cell.outputs]
    assert not [output for output in shown if output.output_type == "error"]


def test_the_release_is_not_attempted(given):
    graded = given.graded("blank")
    assert graded.verdicts.keys() == given.submissions.POINTS.keys()
    assert given.states("blank") == {State.NOT_ATTEMPTED}
    assert graded.notes == ()


def test_the_release_holds_no_answer(given):
    written = nbformat.writes(given.release)
    for mark in ("SOLUTION", "HIDDEN", "BEGIN"):
        assert mark not in written
    for phrase in OWN[given.name].phrases:
        assert phrase.lower() in nbformat.writes(given.source).lower()
        assert phrase.lower() not in written.lower()
    shown = text(given.release)
    model = cell_of(given.source, OWN[given.name].read).source.splitlines()
    assert not [line for line in model if len(line) > 20 and line in shown]


def test_a_right_submission_is_right_however_its_cells_are_dressed(given):
    graded = given.graded("dressed")
    assert graded.verdicts.keys() == given.submissions.POINTS.keys()
    assert given.states("dressed") == {State.CORRECT}, graded.verdicts
    assert {verdict.credit for verdict in graded.verdicts.values()} == {1}
    assert graded.notes == ()


def test_a_wrong_submission_is_wrong_everywhere(given):
    graded = given.graded("wrong")
    assert graded.verdicts.keys() == given.submissions.POINTS.keys()
    assert given.states("wrong") == {State.INCORRECT}
    assert {verdict.credit for verdict in graded.verdicts.values()} == {0}
    assert graded.notes == ()


def test_a_partly_right_submission_gets_a_part(given):
    graded = given.graded("partly_right")
    assert graded.verdicts.keys() == given.submissions.POINTS.keys()
    credits = [verdict.credit for verdict in graded.verdicts.values()]
    assert 0 < sum(credits) < len(credits)
    assert graded.notes == ()
