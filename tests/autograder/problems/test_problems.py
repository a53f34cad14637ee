"""What holds for every problem: its notebook, its release, and what its submissions get.

What only one problem can say (its hints, the sentences on its wrong answers) is in its own tests.
"""

import re
from importlib import import_module
from types import SimpleNamespace

import nbformat
import numpy as np
import pytest

from autograder.judging.verdict import State
from autograder.notebook.recognise import grade_id
from autograder.problems import CHECKS, READ
from tests.autograder.course_problems import NAMES, ROOT, problem
from tests.autograder.problems.own import Own, expected
from tests.autograder.verdicts import sentences
from tests.submissions.answers import cell_of

IMAGE = re.compile(r"!\[(.*?)\]\((.*?)\)", re.DOTALL)
RUBRIC = re.compile(r"^\| points \| for \|\n\|[-|]+\|\n((?:\|.*\n?)+)", re.MULTILINE)


OWN = {
    "c6-regressor": Own(
        "c6-discussion",
        5,
        15,
        "c6-setup answer-regressor c6-regressor c6-columns answer-rank_of_excitation "
        "c6-rank_of_excitation c6-motions answer-identify c6-identify c6-scatter c6-second-difference "
        "c6-five-columns c6-discussion",
        ("moved into",),
    ),
    "c7-recursive": Own(
        "c7-discussion",
        4,
        15,
        "c7-setup answer-rnea c7-rnea c7-poses answer-terms c7-terms c7-own-terms answer-gravity_sign "
        "c7-gravity_sign c7-two-programs c7-two-ways answer-count c7-count c7-table c7-discussion",
        ("even in the velocities", "accelerometer"),
    ),
    "c8-control": Own(
        "c8-discussion",
        5,
        15,
        "c8-setup answer-gravity_compensation c8-gravity_compensation c8-settle answer-regressor_r "
        "c8-regressor_r c8-compare answer-slotine_li c8-slotine_li c8-parcel answer-V_dot c8-V_dot "
        "c8-growth c8-discussion",
        ("christoffel.T", "leaves nothing for the spring to fight"),
    ),
    "p1-inertia": Own(
        "p1-proof",
        4,
        15,
        "p1-setup answer-inertia_from_links p1-inertia_from_links answer-M p1-M p1-look p1-cholesky "
        "answer-is_spd p1-is_spd answer-singular_arm p1-singular_arm "
        "answer-p1-symmetry p1-symmetry answer-p1-positive p1-positive p1-proof",
    ),
    "p2-energy-skew": Own(
        "p2-proof",
        5,
        17,
        "p2-setup answer-M_dot p2-M_dot p2-difference answer-C p2-C p2-ones answer-C_other p2-C_other "
        "p2-forms answer-christoffel p2-christoffel p2-symbolic "
        "answer-p2-E p2-E answer-p2-skew p2-skew p2-proof",
        ("np.sin(q[1])", "Exchanging"),
    ),
    "p3-pendulum": Own(
        "p3-derivation",
        5,
        15,
        "p3-setup answer-lagrangian p3-lagrangian p3-euler-lagrange answer-M p3-M answer-C p3-C "
        "answer-g_vec p3-g_vec answer-inertia_about_pivot p3-inertia_about_pivot "
        "answer-small_angle_frequency p3-small_angle_frequency p3-swing-plot "
        "answer-p3-L p3-L p3-derivation",
    ),
    "p4-gravity": Own(
        "p4-check",
        5,
        15,
        "p4-setup answer-potential_energy p4-potential_energy answer-g_vec p4-g_vec p4-slope "
        "answer-gravity_from_jacobians p4-gravity_from_jacobians p4-jacobians answer-equilibria "
        "p4-equilibria p4-energies "
        "answer-p4-P p4-P p4-check",
        ("one up, one down",),
    ),
    "p5-state-space": Own(
        "p5-discussion",
        5,
        20,
        "p5-setup answer-f p5-f answer-rk4_step p5-rk4_step p5-order answer-simulate p5-simulate "
        "answer-energy_drift p5-energy_drift p5-drift-plot p5-friction "
        "answer-p5-E p5-E p5-discussion",
    ),
}
# What submissions get: the credit of each check where it is not all, and the mistakes that are named.
WRONG = {
    "p1-inertia_from_links": (0, "I not used"),
    "p1-M": (0, "wrong parameter / l2 / lc2"),
    "p1-is_spd": (0, "always True"),
    "p1-singular_arm": (0, "link 1 resists"),
    "p2-M_dot": (0, "velocities exchanged"),
    "p2-C": (0, "C times ones"),
    "p2-C_other": (0, "first entry dropped"),
    "p2-christoffel": (0, "rate of M"),
    "p3-lagrangian": (0, "½ of K missing", "sine for cosine / the weight of the body"),
    "p3-M": (0, "parallel axis added / the rotation of the body / m / I"),
    "p3-C": (0, "point-mass centrifugal term"),
    "p3-g_vec": (0, "cosine for sine / the weight of the body"),
    "p3-inertia_about_pivot": (0, "inertia about the centre of mass"),
    "p3-small_angle_frequency": (0, "point mass"),
    "p4-potential_energy": (0, "sign of the whole"),
    "p4-g_vec": (0, "wrong angle / the weight of link 2 beyond the elbow / q2 / q1 + q2"),
    "p4-gravity_from_jacobians": (0, "sign of gravity"),
    "p4-equilibria": (0, "from the vertical"),
    "p5-f": (0, "halves of ẋ swapped"),
    "p5-rk4_step": (0, "division by six missing", "change for state"),
    "p5-simulate": (0, "start repeated"),
    "p5-energy_drift": (0, "sign of the whole"),
    "c6-regressor": (0, "wrong sign / g(q)", "absolute acceleration of link 2", "J1 at joint 2"),
    "c6-rank_of_excitation": (0, "number of columns"),
    "c6-identify": (0,),
    "c7-rnea": (0, "nothing handed down"),
    "c7-terms": (0, "gravity in M", "gravity in C q̇", "gravity in motion", "C q̇ in the friction"),
    "c7-gravity_sign": (0, "always 1"),
    "c7-count": (0, "products only"),
    "c8-gravity_compensation": (0, "sign of gravity"),
    "c8-regressor_r": (0, "sign of gravity", "absolute acceleration of link 2"),
    "c8-slotine_li": (0,),
    "c8-V_dot": (0, "damping left out"),
}
# Of an answer that follows from a wrong one before it: half of its points, and one sentence.
CARRIED_ON = "carried on"
PARTLY_RIGHT = {
    "p1-inertia_from_links": (0.5, "last link only"),
    "p1-M": (0.75, "dropped / the rotation of link 2 / M12"),
    "p1-is_spd": (
        0.5,
        "rounding taken for a positive eigenvalue",
        "one triangle read",
    ),
    "p1-singular_arm": (0.5, "massless link"),
    "p2-M_dot": (0.55, "halved / the coupling of the two links / Ṁ11"),
    "p2-C": (0.7, "products in the later column"),
    "p2-C_other": (0.5, "C itself"),
    "p3-lagrangian": (0.5, "energy for L"),
    "p3-g_vec": (0, "cosine for sine / the weight of the body"),
    "p4-potential_energy": (0.5, "dropped / the weight of link 2 at the elbow"),
    "p4-g_vec": (0.5, "dropped / the weight of link 2 beyond the elbow / g1"),
    "p4-equilibria": (0.5, "stretched only"),
    "p5-f": (0.25, "wrong sign / the viscous friction"),
    "p5-rk4_step": (0.25, "Euler"),
    "p5-simulate": (0.7, CARRIED_ON),
    "p5-energy_drift": (0.35, "P missing"),
    "c6-regressor": (0.75, "coupling without the factor 2"),
    "c6-rank_of_excitation": (0.35, "joint 1 only"),
    "c6-identify": (0.5, CARRIED_ON),
    "c7-rnea": (0.45, "gyroscopic term missing"),
    "c7-terms": (0.7, "friction in C q̇"),
    "c7-gravity_sign": (0.5, "whose torque not asked"),
    "c7-count": (0.5, "n times one link"),
    "c8-gravity_compensation": (0.2, "gravity at the goal"),
    "c8-regressor_r": (0.6, "all of h on the second entry"),
    "c8-slotine_li": (0.675, CARRIED_ON),
    "c8-V_dot": (0.4, "skew-symmetry taken for granted"),
}


# A newer problem has its own in a file `expected.py` of its folder.
OWN |= expected("OWN")
WRONG |= expected("WRONG")
PARTLY_RIGHT |= expected("PARTLY_RIGHT")


@pytest.fixture(scope="module", params=NAMES)
def given(request):
    return problem(request.param)


def test_a_person_reads_one_answer_of_each_problem():
    assert sorted(READ) == sorted(own.read for own in OWN.values()), (
        "READ in autograder/problems/FOLDER/checks.py is the grade_id of the answer that a person reads"
    )


def claims(cell) -> dict:
    return cell.metadata.get("nbgrader", {})


def code(notebook):
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def text(notebook) -> str:
    return "\n".join(cell.source for cell in notebook.cells)


def test_every_problem_is_here():
    modules = (ROOT / "tests" / "submissions").glob("[pc][0-9]_*.py")
    assert sorted(path.stem.replace("_", "-") for path in modules) == NAMES, (
        "each notebook of solutions/ needs a module in tests/submissions/, and each module a notebook"
    )
    assert sorted(OWN) == NAMES, "give tests/autograder/problems/FOLDER/expected.py an OWN"


def test_format_and_kernel(given):
    nbformat.validate(given.source)
    assert given.source.metadata.kernelspec.name == "python3"


@pytest.mark.parametrize("version", ["source", "release"])
def test_no_outputs_are_stored(given, version):
    for cell in code(getattr(given, version)):
        assert cell.outputs == []
        assert cell.execution_count is None


def test_grade_ids_stay(given):
    ids = [name for name in map(grade_id, given.source.cells) if name]
    assert ids == OWN[given.name].ids.split(), (
        "OWN.ids lists all grade_ids in order; of a problem that has been given to students, none may "
        "change"
    )
    assert len(ids) == len(set(ids))


def test_the_example_is_the_one_that_the_mistakes_know(given):
    """p2 and p3 know of none."""
    folder = given.name.replace("-", "_")
    known = getattr(import_module(f"autograder.problems.{folder}.mistakes"), "EXAMPLE", None)
    assert bool(known) == (given.name[:2] not in ("p2", "p3")), (
        f"give autograder/problems/{folder}/mistakes.py an EXAMPLE, which the set-up cell has, too"
    )
    if known:
        namespace = {}
        exec(cell_of(given.source, f"{given.name[:2]}-setup").source, namespace)
        shown = [vars(x) for x in namespace.values() if isinstance(x, SimpleNamespace)]
        assert any(
            one.keys() == vars(known).keys()
            and all(np.array_equal(one[name], value) for name, value in vars(known).items())
            for one in shown
        )


def test_points_are_those_of_the_grade_cells(given):
    own = OWN[given.name]
    points = {
        grade_id(c): claims(c)["points"] for c in given.source.cells if claims(c).get("grade")
    }
    assert points == given.submissions.POINTS | {own.read: own.points}, (
        f"POINTS of {given.submissions.__name__}, and OWN, are those of solutions/{given.name}"
    )
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


def test_each_lost_point_of_a_submission_traces_to_a_sentence(given):
    for kind in ("blank", "wrong", "partly_right", "crashing", "mangled"):
        if kind != "blank" and not hasattr(given.submissions, kind):
            continue
        for id, verdict in given.graded(kind).verdicts.items():
            if verdict.credit < 1 and not verdict.rows:
                assert verdict.problem or verdict.next_step, (kind, id)
            for row, said in verdict.said_of_rows():
                assert bool(said) != row.met, (kind, id, row.text, said)


def assert_said(given, kind, expected):
    """Beside what is said where a criterion knows no mistake, or on what its numbers depend."""
    for check_id, verdict in given.graded(kind).verdicts.items():
        credit, *names = expected.get(check_id, (1,))
        assert verdict.credit == pytest.approx(credit), check_id
        otherwise = [own.text for one in CHECKS[check_id].criteria for own in one.said]
        said = tuple(
            one
            for one in verdict.diagnosis
            if one not in otherwise and "the values depend" not in one
        )
        if carried := [one for one in said if "error carried on" in one]:
            (follows,) = CHECKS[check_id].follows
            assert all(one.startswith(follows.sentence) for one in carried)
            said, names = tuple(one for one in said if one not in carried), names[1:]
        # On what its numbers depend is said of a criterion that no mistake explains, and nothing else.
        depends = [
            row.said for row in verdict.rows if any("the values depend" in one for one in row.said)
        ]
        assert all(len(own) == 1 for own in depends)
        assert said == sentences(check_id, *names)
        assert verdict.diagnosis or credit == 1


def test_a_wrong_submission_is_wrong_everywhere_and_told_why(given):
    graded = given.graded("wrong")
    assert graded.verdicts.keys() == given.submissions.POINTS.keys()
    assert given.states("wrong") == {State.INCORRECT}
    assert_said(given, "wrong", WRONG)
    assert graded.notes == ()


def test_a_partly_right_submission_gets_a_part_and_is_told_why(given):
    graded = given.graded("partly_right")
    assert graded.verdicts.keys() == given.submissions.POINTS.keys()
    credits = [verdict.credit for verdict in graded.verdicts.values()]
    assert 0 < sum(credits) < len(credits)
    assert_said(given, "partly_right", PARTLY_RIGHT)
    assert graded.notes == ()


# Of powers, products and angles; in words there are none.
FORMULA = re.compile(r"cos\(|sin\(|\*|\bpi\b|q̈1 \+")


@pytest.mark.parametrize("check_id", CHECKS)
def test_no_hint_gives_the_formula(check_id):
    assert [hint for hint in CHECKS[check_id].hints if FORMULA.search(hint)] == []
