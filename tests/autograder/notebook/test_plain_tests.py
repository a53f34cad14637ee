"""Plain tests: what an instructor writes into a grade cell beside its check, or in place of one."""

import copy
import json

import nbformat
import pytest
from nbformat import NotebookNode
from nbgrader.utils import determine_grade

from autograder.judging.verdict import State
from autograder.notebook.beside import Beside
from autograder.notebook.grade import grade
from autograder.notebook.plain_tests import Outcome, by_value, plain_test
from autograder.notebook.released import released
from autograder.notebook.scores import with_verdicts
from autograder.notebook.trial import refusals
from tests.autograder.course_problems import problem, without_plots
from tests.submissions import p3_pendulum, plain
from tests.submissions.answers import cell_of

CHECK = '# Checks g.\ncheck("p3-g_vec")\n### BEGIN HIDDEN TESTS\ncheck("p3-g_vec", fresh=True)\n'
END = "### END HIDDEN TESTS"


@pytest.mark.parametrize(
    ("beside", "runs"),
    [
        ("", ""),
        ('"a text"\n', ""),
        ("assert False\n", "# Checks g.\npass\n### BEGIN HIDDEN TESTS\npass\nassert False\n"),
        (
            'autograder.check(\n    "p3-g_vec"\n); x = "½"\n',
            '# Checks g.\npass\n### BEGIN HIDDEN TESTS\npass\npass; x = "½"\n\n\n',
        ),
        # With a magic it runs as it is: there, `check` does nothing.
        ("%time f()\n", CHECK + "%time f()\n"),
    ],
)
def test_what_stands_beside_a_check_stays_on_its_lines(beside, runs):
    assert plain_test(CHECK + beside + END, "p3-g_vec") == (runs and runs + END)


def source_with(**texts: str) -> NotebookNode:
    """p3 with these lines in the hidden part of its grade cells."""
    source = without_plots(problem("p3-pendulum").source)
    for name, text in texts.items():
        cell = cell_of(source, f"p3-{name}")
        cell.source = cell.source.replace(END, f"{text}\n{END}")
    return source


TESTS = {
    "g_vec": "def at_rest(q):\n    return np.ravel(g_vec(np.array([q]), forearm))[0]\n"
    'print("asked")\nassert at_rest(0.0) == 0.0\nassert at_rest(1.0) > 0.0, "falls up"',
    "M": "assert M(np.zeros(1), forearm).shape == (1, 1)",
    "C": "for q in (0.0, 1.0):\n    C(np.array([q]), np.ones(1), forearm)",
}


def test_a_test_beside_a_check_costs_the_cells_points_and_no_others():
    source = source_with(**TESTS)
    answers = {
        "g_vec": p3_pendulum.function("g_vec", "pend.m * pend.g * pend.lc * np.sin(q[0]) * LIGHT"),
        "C": "calls = 0\ndef C(q, qd, pend):\n    return 0 if q.size else 1",
    }
    answers["g_vec"] = "LIGHT = 1.0\n" + answers["g_vec"]
    submission = p3_pendulum.right_but(problem("p3-pendulum").release, **answers)
    graded = grade(submission, source, "seed")
    credits = {name: verdict.credit for name, verdict in graded.verdicts.items()}
    # p3's own M is a list of lists, which the check takes and this test does not.
    assert credits == dict.fromkeys(p3_pendulum.POINTS, 1.0) | {"p3-M": 0.0}
    verdict = graded.verdicts["p3-M"]
    assert verdict.state is State.INCORRECT
    assert verdict.problem == (
        "Your instructor's own test in this cell failed: line 5, AttributeError: 'list' object has no "
        "attribute 'shape'. Without it, the cell earns nothing."
    )
    assert all(row.met for row in verdict.rows)
    written = with_verdicts(graded)
    nbformat.validate(written)
    for name, points in p3_pendulum.POINTS.items():
        score, _ = determine_grade(cell_of(written, name))
        assert score == points * credits[name]
    assert "asked" in str(cell_of(written, "p3-g_vec").outputs)


def test_what_a_check_takes_off_is_not_taken_off_again():
    source = source_with(g_vec="assert False")
    submission = p3_pendulum.wrong(problem("p3-pendulum").release)
    verdict = grade(submission, source, "seed").verdicts["p3-g_vec"]
    assert verdict.credit == 0
    assert "instructor" not in str(verdict)


@pytest.mark.parametrize(
    ("shows", "credit", "noted"),
    [
        (None, 1.0, False),
        ("1.5", 0.75, False),
        ("np.float64(1.5)", 0.75, False),
        ("np.int64(2)", 1.0, False),
        ("True", 1.0, False),
        ("np.False_", 0.0, False),
        ("'1.5'", 1.0, False),
        ("[0, 0]", 1.0, False),
        ("nan", 0.0, True),
        ("np.float64(nan)", 0.0, True),
        ("inf", 0.0, True),
        ("-0.5", 0.0, True),
        ("2.5", 1.0, True),
    ],
)
def test_points_by_the_last_value(shows, credit, noted):
    """nbgrader gives all points for False, NaN and a negative number, and stops at one too many."""
    verdict, note = by_value("a", 2.0, Outcome(value=shows), is_blank=False)
    assert verdict.credit == credit
    assert bool(note) == noted


def test_a_cell_without_points_is_met():
    assert by_value("a", 0.0, Outcome(value="0"), is_blank=False)[0].state is State.CORRECT


SOURCE = plain.source()
# What `double` does to the test that calls it, and what is said of it.
ANSWERS = {
    "return 2 * x": "",
    "return abs(2 * x)": "line 5, AssertionError: the sign.",
    "return 1 / 0": "line 2, ZeroDivisionError: division by zero "
    "(the cell of double, line 2: return 1 / 0).",
    "raise SystemExit": "line 2, SystemExit (the cell of double, line 2: raise SystemExit).",
    "import os; os._exit(0)": "this cell ended Python itself.",
    # So many outputs, and what is left out among them, hide no error.
    "[display(x) for _ in range(99)]; [get_ipython().run_line_magic('pip', '') for _ in range(99)]":
    "line 2, AssertionError: double(2) is 4.",
}  # fmt: skip


@pytest.mark.parametrize("body", ANSWERS)
def test_an_error_in_a_cell_without_a_check_costs_its_points(body):
    submission = copy.deepcopy(SOURCE)
    cell_of(submission, "answer-double").source = f"def double(x):\n    {body}"
    graded = grade(submission, SOURCE, "seed")
    verdict, other = graded.verdicts["test-double"], graded.verdicts["test-mean"]
    said = ANSWERS[body]
    assert verdict.credit == (not said)
    assert verdict.problem == (said and f"Your instructor's test of this answer failed: {said}")
    assert other.credit == 1
    assert graded.notes == ()


def test_an_answer_that_is_as_it_was_is_not_attempted():
    submission = copy.deepcopy(SOURCE)
    cell = cell_of(submission, "answer-double")
    cell.source = released(cell)
    cell_of(submission, "answer-mean").source = "# I tried"
    graded = grade(submission, SOURCE, "seed")
    states = [graded.verdicts[name].state for name in plain.POINTS]
    assert states == [State.NOT_ATTEMPTED, State.ERROR]


def test_outputs_of_a_test_do_not_change_its_score():
    """A student's function may print to stderr, for which nbgrader gives nothing, or show a number."""
    submission = copy.deepcopy(SOURCE)
    shown = "import sys\ndef double(x):\n    print(9, file=sys.stderr); display(9); return 2 * x"
    cell_of(submission, "answer-double").source = shown
    cell = cell_of(with_verdicts(grade(submission, SOURCE, "seed")), "test-double")
    assert determine_grade(cell) == (2.0, 2.0)
    assert "all of them" in json.dumps(cell.outputs)


def test_so_many_outputs_hide_no_value():
    submission = copy.deepcopy(SOURCE)
    shown = "def mean(values):\n    [display(n) for n in range(99)]\n    return -1"
    cell_of(submission, "answer-mean").source = shown
    assert grade(submission, SOURCE, "seed").verdicts["test-mean"].credit == 0


def test_no_hidden_test_is_quoted():
    """Neither in the sentence about it, nor in one about a function that is missing."""
    source = source_with(M='SECRET = 1\nassert M.SECRET, exec("C")')
    submission = p3_pendulum.right_but(problem("p3-pendulum").release, C="del C")
    graded = grade(submission, source, "seed")
    assert graded.verdicts["p3-M"].credit == 0
    assert "assert" not in "".join(map(str, graded.verdicts.values()))


def refused(change, *, files=None) -> list[str]:
    source = plain.source()
    change(source)
    return refusals(source, Beside(files or {}))


def writes(text, name="test-double"):
    def change(source):
        cell_of(source, name).source = text

    return change


def test_sources_that_can_be_graded_are_not_refused():
    assert refusals(SOURCE, Beside()) == []
    assert refusals(problem("p3-pendulum").source, Beside()) == []
    assert refused(writes("assert open('x.txt').read() == 'x'"), files={"x.txt": b"x"}) == []
    # A function of the lecturer's own.
    assert refused(writes("def check(f):\n    assert f(1) == 2\ncheck(double)")) == []


IMPORTS = "from autograder import check\n"


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (
            writes("assert False"),
            "test-double fails with the model answer of the source: line 1, Ass",
        ),
        (
            writes("open('/x.txt')"),
            "FileNotFoundError: [Errno 2] No such file or directory: '/x.txt'",
        ),
        (writes("double(1) / 4"), "gives the model answer of the source 0.5 of 2 points"),
        (writes("float('nan')"), "gives the model answer of the source nan of 2 points"),
        (writes("raise NotImplementedError", "answer-double"), "NameError: name 'double'"),
        (writes("# nothing"), "test-double tests nothing, so that everybody would get its points"),
        (
            writes("### AUTOTEST double(2)"),
            "test-double has an AUTOTEST, which the grader does not",
        ),
        (writes("import armdyn.models", "set-up"), "set-up imports armdyn, which has the answers"),
        (
            writes(f"{IMPORTS}check('p3-M')"),
            'test-double calls check("p3-M"), but a check judges the',
        ),
        (writes(f"{IMPORTS}check(id)"), "test-double calls a check that it does not name, but"),
        (writes(f"{IMPORTS}check('test-double')"), "and there is no such check"),
    ],
)
def test_a_source_that_cannot_be_graded_is_refused_by_name(change, said):
    (sentence,) = refused(change)
    assert said in sentence


def test_a_check_that_its_cell_does_not_call_is_told():
    def renamed(source):
        cell_of(source, "test-double").metadata.nbgrader.grade_id = "p3-M"

    (sentence,) = refused(renamed)
    assert sentence.startswith(
        'p3-M is the id of a check, and its cell does not call check("p3-M")'
    )
