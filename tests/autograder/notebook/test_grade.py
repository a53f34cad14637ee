"""grade: a pure function of a submission, its source and a seed; its scores as nbgrader reads them."""

import ast
import copy
import json
from types import SimpleNamespace
from typing import ClassVar

import nbformat
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from nbformat import NotebookNode
from nbformat.v4 import new_code_cell
from nbgrader.utils import determine_grade

from autograder.judging.check import HIDDEN_CASES, VISIBLE_CASES
from autograder.judging.verdict import State, Verdict, Witness
from autograder.notebook import grade as grading
from autograder.notebook import outputs
from autograder.notebook.grade import grade, is_judged, of_content, stream
from autograder.notebook.scores import outputs_for
from autograder.notebook.sitting import Sitting
from autograder.problems import CHECKS
from autograder.protocol import Call, Fault, FaultKind, Reply
from autograder.sandbox.inside.left_out import INPUT
from autograder.sandbox.room import RoomLostError, StarvedError, TooLongError
from autograder.student.cell import VISIBLE_SEED
from tests.autograder.course_problems import problem, states, without_plots
from tests.submissions import p3_pendulum
from tests.submissions.answers import cell_of
from tests.submissions.p3_pendulum import BAD_ANSWERS, POINTS, function

P3 = "p3-pendulum"


SOURCE = without_plots(problem(P3).source)


@pytest.fixture(scope="module")
def release():
    return without_plots(problem(P3).release)


@pytest.fixture(scope="module")
def wrong(release):
    return grade(p3_pendulum.wrong(release), SOURCE, "seed")


def test_each_grade_cell_has_a_verdict_and_no_other(wrong):
    assert wrong.verdicts.keys() == POINTS.keys()
    assert set(states(wrong).values()) == {State.INCORRECT}
    assert wrong.notes == ()


@pytest.mark.parametrize(("answer", "sentence"), BAD_ANSWERS.values(), ids=BAD_ANSWERS)
def test_a_faulty_answer_costs_its_own_cell_and_is_told_why(release, answer, sentence):
    graded = grade(p3_pendulum.right_but(release, g_vec=answer), SOURCE, "seed")
    faulty = graded.verdicts["p3-g_vec"]
    assert faulty.credit == 0
    assert sentence in "\n".join(faulty.lines())
    others = {name: state for name, state in states(graded).items() if name != "p3-g_vec"}
    assert set(others.values()) == {State.CORRECT}


def test_same_seed_same_verdicts(release, wrong):
    again = grade(p3_pendulum.wrong(release), SOURCE, "seed")
    assert again.verdicts == wrong.verdicts
    assert again.notebook == wrong.notebook


def test_another_seed_other_cases(release, wrong):
    other = grade(p3_pendulum.wrong(release), SOURCE, "another seed")
    assert states(other) == states(wrong)
    for name, verdict in wrong.verdicts.items():
        assert other.verdicts[name].witness.off != verdict.witness.off


def test_right_answers_are_right_under_any_seed(release):
    with Sitting() as sitting:  # one room is enough: only the cases change
        for cell in p3_pendulum.right(release).cells:
            if cell.cell_type == "code" and not is_judged(cell):
                sitting.run(cell.source)
        for seed in map(str, range(6)):
            for name in POINTS:
                verdict = CHECKS[name].run(sitting.ask, stream(seed, name), HIDDEN_CASES)
                assert verdict.state is State.CORRECT, seed


def test_neither_argument_is_changed(release):
    submission, source = p3_pendulum.mangled(release), copy.deepcopy(SOURCE)
    before = copy.deepcopy(submission)
    graded = grade(submission, source, "seed")
    assert submission == before
    assert source == SOURCE
    assert graded.notebook is not submission


def test_verdicts_carry_no_inputs(wrong):
    for verdict in wrong.verdicts.values():
        assert verdict.witness.call == ""
        assert "m=" not in str(verdict)


def calls_of(name, rng, count):
    return [repr(call) for call in CHECKS[name].calls(rng, count)]


# A function without arguments has one case only.
@pytest.mark.parametrize("name", [n for n in CHECKS if not CHECKS[n].signature.endswith("()")])
def test_hidden_cases_differ_from_the_visible_ones(name):
    visible = calls_of(name, np.random.default_rng(VISIBLE_SEED), VISIBLE_CASES)
    hidden = calls_of(name, stream("seed", name), HIDDEN_CASES)
    assert not set(visible) & set(hidden)
    if name != "c7-count":  # whole numbers, of which two draws share some
        assert not set(hidden) & set(calls_of(name, stream("seeds", name), HIDDEN_CASES))
    assert hidden == calls_of(name, stream("seed", name), HIDDEN_CASES)


def test_each_check_has_its_own_stream():
    draws = {tuple(stream("seed", name).random(4)) for name in CHECKS}
    assert len(draws) == len(CHECKS)


def test_values_hard_coded_for_the_visible_cases_are_caught(release):
    check = CHECKS["p3-g_vec"]
    table = {
        f"{call.args[0][0]:.9f}": float(check.reference(*call.args))
        for call in check.calls(np.random.default_rng(VISIBLE_SEED), VISIBLE_CASES)
    }
    answer = function("g_vec", f"{table!r}.get(f'{{q[0]:.9f}}', 1.0)")
    namespace = {"__name__": "__main__"}
    exec(answer, namespace)
    visible = check.run(
        lambda calls: answered_in_kernel(calls, namespace),
        np.random.default_rng(VISIBLE_SEED),
        VISIBLE_CASES,
    )
    assert visible.state is State.CORRECT
    submission = p3_pendulum.right_but(release, g_vec=answer)
    assert states(grade(submission, SOURCE, "seed"))["p3-g_vec"] is State.INCORRECT


def test_inputs_that_one_hand_in_shows_are_of_no_use_to_the_next(release):
    """A function that keeps what it was called with, a cell that shows it, and a table made of that."""
    seen = "seen = []\ndef g_vec(q, pend):\n    value = pend.m * pend.g * pend.lc * np.sin(q[0])\n"
    seen += "    seen.append((float(q[0]), float(value)))\n    return value"
    showing = p3_pendulum.right_but(release, g_vec=seen)
    showing.cells.append(new_code_cell("print(seen)"))
    first = grade(showing, SOURCE, "seed")
    assert states(first)["p3-g_vec"] is State.CORRECT
    shown = first.notebook.cells[-1].outputs[0].text
    table = dict(ast.literal_eval(shown))
    assert len(table) == HIDDEN_CASES
    tabled = p3_pendulum.right_but(
        release, g_vec=function("g_vec", f"{table!r}.get(float(q[0]), 1.0)")
    )
    assert states(grade(tabled, SOURCE, "seed"))["p3-g_vec"] is State.INCORRECT
    again = grade(showing, SOURCE, "seed")
    assert again.notebook.cells[-1].outputs[0].text == shown


CODE = st.lists(st.text(), max_size=3)


@given(CODE, CODE, st.text())
def test_cases_depend_on_the_code_alone(one, other, text):
    def notebook(sources, kind="code"):
        return [NotebookNode(cell_type=kind, source=source) for source in sources]

    def seed(cells):
        return of_content("seed", NotebookNode(cells=cells))

    assert (seed(notebook(one)) == seed(notebook(other))) == (one == other)
    noted = NotebookNode(cells=notebook([text], "markdown") + notebook(one))
    assert of_content("seed", noted) == seed(notebook(one))
    assert of_content("another", noted) != seed(notebook(one))


def answered_in_kernel(calls, namespace):
    return [Reply(value=np.asarray(namespace[call.name](*call.args), float)) for call in calls]


def test_lost_rooms_cost_their_own_cells_alone(release):
    graded = grade(p3_pendulum.crashing(release), SOURCE, "seed")
    assert states(graded) == dict.fromkeys(POINTS, State.CORRECT) | {
        "p3-M": State.ERROR,
        "p3-C": State.ERROR,
        "p3-g_vec": State.ERROR,
    }
    assert "Python itself stopped while M(q, pend) was running" in graded.verdicts["p3-M"].problem
    (lost,) = cell_of(graded.notebook, "answer-g_vec").outputs
    assert lost.ename == "RoomLostError"
    assert lost.evalue.startswith("this cell ended Python itself")


SIX_WAYS_TO_STOP = {
    "lagrangian": (
        "kappa = kapa\ndef lagrangian(q, qd, m, lc, I, g):\n    return 0",
        "the cell that should define it stopped with NameError: name 'kapa' is not defined "
        "(line 1: kappa = kapa). Fix that line, so that the lines below it run as well.",
    ),
    "M": (
        "%matplotlib inline\nI = float(input('I = '))\nM = lambda q, pend: I",
        f"the cell that should define it stopped with RuntimeError: {INPUT} "
        "(line 2: I = float(input('I = '))).",
    ),
    "C": (
        "from pendulum import C",
        "the cell that should define it stopped with ModuleNotFoundError: No module named 'pendulum' "
        "(no pendulum.py was handed in, and no package of this name is installed here) "
        "(line 1: from pendulum import C).",
    ),
    "g_vec": (
        "%run pendulum.py",
        "by exactly this name. Did you run its cell? Before that, %run pendulum.py was left out: "
        "Exception: File `'pendulum.py'` not found.",
    ),
    "inertia_about_pivot": (
        "import os\nos._exit(0)\ndef inertia_about_pivot(I_com, m, lc): return 0",
        "the cell that should define it stopped because Python itself ended. Fix that cell, ",
    ),
    "small_angle_frequency": (
        "def small_angle_frequency(pend):\n    raise NotImplementedError",
        "The check judged an earlier small_angle_frequency: the cell that defines it again "
        "stopped with SyntaxError: expected ':', line 1: def small_angle_frequency(pend).",
    ),
}


def test_a_card_names_the_error_that_stopped_the_cell(release):
    answers = {name: answer for name, (answer, _) in SIX_WAYS_TO_STOP.items()}
    submission = p3_pendulum.right_but(release, **answers)
    again = nbformat.v4.new_code_cell("def small_angle_frequency(pend)\n    return 1")
    at = submission.cells.index(cell_of(submission, "answer-small_angle_frequency"))
    submission.cells.insert(at + 1, again)
    graded = grade(submission, SOURCE, "seed")
    for name, (_, sentence) in SIX_WAYS_TO_STOP.items():
        assert sentence in graded.verdicts[f"p3-{name}"].problem


def test_a_verdict_on_an_earlier_function_says_so(release):
    wrong = p3_pendulum.right_but(release, M=function("M", "2 * pend.I"))
    at = wrong.cells.index(cell_of(wrong, "answer-M"))
    wrong.cells.insert(at + 1, nbformat.v4.new_code_cell("x = pend\n" + function("M", "pend.I")))
    verdict = grade(wrong, SOURCE, "seed").verdicts["p3-M"]
    assert verdict.state is State.INCORRECT
    assert verdict.next_step.startswith(
        "The check judged an earlier M: the cell that defines it again stopped with NameError: "
        "name 'pend' is not defined (line 1: x = pend). Fix that line."
    )


def test_what_a_student_writes_can_always_be_saved(release):
    submission = p3_pendulum.right_but(
        release,
        M="print('\\ud800')\n" + function("M", "'\\ud800'"),
        C="def C(q, qd, pend):\n    raise ValueError('\\ud800')",
        g_vec="raise ValueError('\\ud800')\ndef g_vec(q, pend): pass",
    )
    graded = grade(submission, SOURCE, "seed")
    nbformat.validate(graded.notebook)
    nbformat.writes(graded.notebook).encode()
    for verdict in graded.verdicts.values():
        str(verdict).encode()


def test_cells_show_this_run_and_nothing_older(release):
    submission = p3_pendulum.right_but(release, M="print('now')\n" + p3_pendulum.RIGHT["M"])
    for cell in submission.cells:
        if cell.cell_type == "code":
            cell.outputs = [nbformat.v4.new_output("stream", text="stale")]
    graded = grade(submission, SOURCE, "seed")
    assert "stale" not in str(graded.notebook)
    assert cell_of(graded.notebook, "answer-M").outputs[0].text == "now\n"


def elsewhere(notebook):
    """A check is gone, with M in a cell of one's own; below everything stands a second stub of g_vec."""
    stub = copy.deepcopy(cell_of(problem(P3).release, "answer-g_vec"))
    own = new_code_cell(p3_pendulum.RIGHT["M"], id="own")
    notebook.cells.insert(notebook.cells.index(cell_of(notebook, "answer-M")) + 1, own)
    cell_of(notebook, "answer-M").source = ""
    at = notebook.cells.index(cell_of(notebook, "p3-M"))
    notebook.cells[at : at + 1] = []
    notebook.cells.insert(notebook.cells.index(cell_of(notebook, "answer-g_vec")) + 1, stub)


def unknown(notebook):
    """Neither nbgrader's settings nor ids are left."""
    for number, cell in enumerate(notebook.cells):
        cell.metadata.pop("nbgrader", None)
        cell.id = f"n{number}"


@pytest.mark.parametrize("edit", [elsewhere, unknown])
def test_what_an_editor_or_a_slip_takes_away_costs_no_points(release, edit):
    edit(submission := p3_pendulum.right(release))
    assert set(states(grade(submission, SOURCE, "seed")).values()) == {State.CORRECT}


def test_a_grade_cell_that_calls_another_check_fails_closed(release):
    source = copy.deepcopy(SOURCE)
    for notebook in (source, submission := p3_pendulum.right(release)):
        cell_of(notebook, "p3-M").metadata.nbgrader.grade_id = "p3-unheard-of"
    graded = grade(submission, source, "seed")
    verdict = graded.verdicts["p3-unheard-of"]
    assert (verdict.state, verdict.credit) == (State.CHECK_FAILED, 0.0)
    (note,) = graded.notes
    assert note.startswith("p3-unheard-of could not be judged: No check belongs to")
    assert set(states(graded).values()) == {State.CORRECT, State.CHECK_FAILED}


def test_only_code_that_is_graded_and_not_an_answer_is_judged():
    judged = [cell.metadata.nbgrader.grade_id for cell in SOURCE.cells if is_judged(cell)]
    assert judged == list(POINTS)


class Script:
    """A room that follows a script: sources in `deadly` end it, and every start is counted."""

    deadly: tuple[str, ...] = ()
    used = idle = 0.0
    ran: ClassVar[list[str]] = []

    def __init__(self):
        type(self).ran.append("start")

    def run(self, source):
        type(self).ran.append(source)
        if source in self.deadly:
            raise RoomLostError("it ended")
        return []

    def ask(self, calls, seconds, idle):
        if calls[0].name in self.deadly:
            raise RoomLostError("it ended")
        return [Reply(fault=Fault(FaultKind.MISSING, "near"))]

    def close(self):
        type(self).ran.append("close")


def failing(times: int):
    """A sitting whose sandbox ends by itself, so many times."""

    class Failing(Sitting):
        left = times

        def ask(self, calls):
            if type(self).left:
                type(self).left -= 1
                raise OSError("the process that starts the sandboxes ended")
            return super().ask(calls)

    return Failing


def test_a_sandbox_that_ends_by_itself_costs_nobody_a_point(release, wrong, monkeypatch, caplog):
    monkeypatch.setattr(grading, "Sitting", failing(1))
    again = grade(p3_pendulum.wrong(release), SOURCE, "seed")
    assert again.verdicts == wrong.verdicts
    assert (
        "the process that starts the sandboxes ended; grading the notebook once more" in caplog.text
    )


def test_a_sandbox_that_always_ends_is_tried_twice(release, monkeypatch):
    monkeypatch.setattr(grading, "Sitting", sitting := failing(9))
    with pytest.raises(OSError, match="starts the sandboxes"):
        grade(p3_pendulum.wrong(release), SOURCE, "seed")
    assert sitting.left == 7


def test_a_new_room_runs_the_earlier_cells_but_not_the_one_that_ended_the_last():
    class Room(Script):
        ran: ClassVar[list[str]] = []
        deadly = ("b", "f")

    with Sitting(Room) as sitting:
        for source in "abc":
            sitting.run(source)
        assert sitting.ask([Call("f", ())]) == [Reply(fault=Fault(FaultKind.DIED))]
        sitting.run("d")
    assert Room.ran == [
        "start",
        "a",
        "b",
        "close",
        "start",
        "a",
        "c",
        "close",
        "start",
        "a",
        "c",
        "d",
        "close",
    ]


STARVED = [Reply(fault=Fault(FaultKind.STARVED, "10 s"))]
ONE = [Reply(value=np.array(1.0))]


@pytest.mark.parametrize(
    ("first", "second", "last"),
    [
        (ONE + STARVED, ONE, ONE + ONE),
        (STARVED, ONE + ONE, ONE + ONE),
        (StarvedError(), ONE + ONE, ONE + ONE),
        (ONE + STARVED, STARVED, ONE + STARVED),
        (StarvedError(), StarvedError(), STARVED),
    ],
)
def test_a_call_that_starved_is_tried_once_more(first, second, last):
    class Room(Script):
        answers: ClassVar[list] = [first, second]

        def ask(self, calls, seconds, idle):
            answer = self.answers.pop(0)
            if isinstance(answer, Exception):
                raise answer
            assert len(calls) >= len(answer)
            return list(answer)

    with Sitting(Room) as sitting:
        assert sitting.ask([Call("f", (n,)) for n in (1.0, 2.0)]) == last
        assert sitting.uncertain == (["f"] if last[-1].fault else [])
    assert Room.answers == []


def test_a_call_that_is_out_of_its_own_control_did_not_return_in_time():
    class Room(Script):
        def ask(self, calls, seconds, idle):
            raise TooLongError

    with Sitting(Room) as sitting:
        assert sitting.ask([Call("f", ())]) == [Reply(fault=Fault(FaultKind.TIMED_OUT, "2 s"))]


def test_a_missing_name_is_blamed_on_the_cell_that_failed_to_define_it():
    class Room(Script):
        def run(self, source):
            bad = {"output_type": "error", "ename": "NameError", "evalue": "x"}
            return [bad] if "bad" in source else []

    with Sitting(Room) as sitting:
        sitting.run("def f(q): bad")
        sitting.run("def g(q): pass")
        kinds = [sitting.ask([Call(name, ())])[0].fault for name in ("f", "g")]
    assert kinds == [
        Fault(FaultKind.CELL_FAILED, "NameError: x"),
        Fault(FaultKind.MISSING, "near"),
    ]


@pytest.mark.parametrize(
    "output",
    [
        {},
        {"output_type": "stream", "name": "stdlog", "text": "x"},
        {"output_type": "stream", "name": "stdout", "text": 1},
        {"output_type": "display_data", "data": {"text/html": "<script>", "image/png": 3}},
        {"output_type": "error", "ename": "E", "evalue": "e", "traceback": None},
        {"output_type": "error", "ename": "E", "evalue": "e", "traceback": [None, {"a": 1}]},
        {"output_type": "execute_result", "data": {"text/plain": "100"}},
    ],
)
def test_no_forged_output_reaches_the_notebook(output):
    written = outputs.of_student(output)
    shown = [written] if written else []
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(outputs=shown)])
    nbformat.validate(notebook)
    assert "script" not in str(notebook)
    assert "execute_result" not in str(notebook)


DRAWING = '<svg xmlns="http://www.w3.org/2000/svg"><rect width="9" height="9"/></svg>'


@pytest.mark.parametrize(
    ("kind", "data", "is_shown"),
    [
        ("image/jpeg", "/9j/4AAQ", True),
        ("image/jpeg", "<script>", False),
        ("image/svg+xml", DRAWING, True),
        ("image/svg+xml", DRAWING[:-6], False),
        ("image/svg+xml", "<b>no drawing</b>", False),
        ("image/svg+xml", '<!DOCTYPE b [<!ENTITY a "a">]><svg>&a;</svg>', False),
    ],
)
def test_pictures_are_kept_if_they_are_some(kind, data, is_shown):
    written = outputs.of_student(
        {"output_type": "display_data", "data": {kind: data, "text/plain": "p"}}
    )
    assert written is not None
    assert (kind in written["data"]) == is_shown
    assert written["data"]["text/plain"] == "p"


def text_of(size):
    return {"output_type": "stream", "name": "stdout", "text": "x" * size}


def picture_of(size):
    return {"output_type": "display_data", "data": {"image/png": "A" * size, "text/plain": "p"}}


@pytest.mark.parametrize(
    ("output", "most"),
    [(text_of(150_000), outputs.NOTEBOOK_TEXT), (picture_of(4 << 20), outputs.NOTEBOOK_PICTURES)],
)
def test_all_cells_share_what_a_notebook_may_show(output, most):
    """Whatever a room replies, forged or not."""
    allowance = outputs.Allowance()
    shown = [allowance.shown([output] * 5) for _ in range(20)]
    assert 0.8 * most < len(str(shown)) < 1.1 * most
    assert (
        "(the grader left out 5 of this cell's outputs: a notebook's outputs may take 2 MB"
        in str(shown[-1])
    )
    assert "left out" not in str(shown[0][:-1])


def test_what_grows_as_it_is_saved_counts_as_it_is_saved():
    allowance = outputs.Allowance()
    bells = text_of(1) | {"text": "\a" * 199_000}
    shown = [output for _ in range(5) for output in allowance.shown([bells])]
    assert len(json.dumps(shown)) < outputs.NOTEBOOK_TEXT + 2000


def test_an_output_of_which_nothing_can_be_shown_leaves_none():
    shown = {"text/html": "<b>", "application/javascript": "1"}
    assert outputs.of_student({"output_type": "display_data", "data": shown}) is None


VERDICTS = st.builds(
    Verdict,
    check=st.text(),
    state=st.sampled_from(State),
    credit=st.floats(0, 1),
    witness=st.none() | st.builds(Witness, st.text(), st.text(), st.text()),
    problem=st.text(),
    diagnosis=st.tuples(st.text()),
)


@given(VERDICTS, st.integers(0, 100) | st.floats(0, 100))
def test_nbgrader_reads_credit_times_points(verdict, points):
    cell = nbformat.v4.new_code_cell(
        "check('p3-M')",
        outputs=outputs_for(verdict, points),
        metadata={"nbgrader": {"grade": True, "grade_id": "a", "points": points, "locked": True}},
    )
    score, most = determine_grade(cell)
    assert most == points
    failed = verdict.state is State.CHECK_FAILED
    assert score == (0.0 if failed else verdict.credit * points)


@pytest.mark.parametrize("credit", [float("nan"), float("inf"), -1.0, 1.5, np.float64(0.5)])
def test_no_credit_scores_outside_the_points(credit):
    cell = SimpleNamespace(outputs=outputs_for(Verdict("a", State.PARTLY_CORRECT, credit), 2))
    score = float(cell.outputs[-1].data["text/plain"])
    assert score == min(max(0.0, credit), 1.0) * 2
