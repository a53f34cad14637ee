"""What a notebook's code may use: own cells take no time from answers, nor one answer from another."""

import nbformat
import pytest

from autograder.notebook import sitting as sitting_module
from autograder.notebook.budget import Budget
from autograder.notebook.grade import UNCERTAIN, grade
from autograder.notebook.sitting import Sitting
from autograder.protocol import Call, Fault, FaultKind, Reply
from autograder.sandbox.room import Room
from tests.autograder.course_problems import problem, without_plots
from tests.autograder.notebook.test_grade import Script
from tests.submissions import p3_pendulum
from tests.submissions.answers import cell_of
from tests.submissions.p3_pendulum import POINTS

P3 = "p3-pendulum"
SOURCE = without_plots(problem(P3).source)
WAIT = "while True: pass"


@pytest.fixture(scope="module")
def release():
    return without_plots(problem(P3).release)


def points(graded) -> dict[str, float]:
    return {name: verdict.credit * POINTS[name] for name, verdict in graded.verdicts.items()}


class Slow(Script):
    """A room in which each cell and each call takes as long as its text says: "7 s", "7 s asleep"."""

    def _take(self, text):
        seconds = float(text.split()[0])
        if "asleep" in text:
            self.idle += seconds
        else:
            self.used += seconds

    def run(self, source):
        self._take(source)
        return super().run(source)

    def ask(self, calls, seconds, idle):
        self._take(calls[0].name)
        return [Reply(value=1.0)]


def test_own_cells_use_up_only_their_own_time():
    with Sitting(Slow) as sitting:
        for n in range(7):
            shown = sitting.run(f"9 s # {n}", own=True)
        assert shown == []
        (error,) = sitting.run("1 s # too much", own=True)
        assert error["ename"] == "TimeoutError"
        assert error["evalue"] == (
            "not run: the student's own cells had used up the 60 s that they have together (the cell "
            "that begins with “9 s # 0” took 9 s and the cell that begins with “9 s # 1” took 9 s)"
        )
        assert sitting.run("9 s") == []
        assert [sitting.ask([Call("9 s", ())])[0].fault for _ in range(6)] == [None] * 6
        assert sitting.uncertain == []


def test_the_calls_of_one_function_use_up_only_their_own_time():
    with Sitting(Slow) as sitting:
        for _ in range(2):
            assert sitting.ask([Call("31 s", ())])[0].fault is None
        (reply,) = sitting.ask([Call("31 s", ())])
        text = "the 60 s that all its calls have together"
        assert reply.fault == Fault(FaultKind.TIMED_OUT, text)
        assert sitting.ask([Call("1 s", ())])[0].fault is None


def test_a_budget_that_was_waited_through_is_not_certain():
    with Sitting(Slow) as sitting:
        for _ in range(2):
            sitting.run("150 s asleep")
            sitting.ask([Call("150 s asleep", ())])
        (shown,) = sitting.run("1 s")
        assert "had waited the 300 s that they have together" in shown["evalue"]
        (reply,) = sitting.ask([Call("150 s asleep", ())])
        assert reply.fault.kind is FaultKind.STARVED
        assert sitting.uncertain == ["the cell that begins with “1 s”", "150 s asleep"]


def test_a_budget_that_was_computed_and_waited_through_is_certain():
    """The processor's time alone would have ended it too."""
    budget = Budget("the cells", 10.0)
    budget.take("one", 11.0, 51.0)
    assert budget.is_over
    assert not budget.is_over_by_waiting
    assert "had used up the 10 s that they have together (one took 11 s)" in budget.spent()


def test_a_cell_that_a_clock_ended_is_not_certain(monkeypatch):
    """In the room, where it goes on, and by the judge, who closes it."""
    monkeypatch.setattr("autograder.sandbox.room.GRACE_SECONDS", 1.0)
    monkeypatch.setattr(Room.run, "__defaults__", (0.2,))
    sleep = "import time\ntime.sleep(30)"
    stop = "import os, signal\nos.kill(os.getpid(), signal.SIGSTOP)"
    with Sitting(Room) as sitting:
        (shown,) = sitting.run(sleep)
        assert shown["evalue"] == "this cell had not ended after 1 s on the clock"
        assert sitting.uncertain == ["the cell that begins with “import time”"]
        (shown,) = sitting.run(stop)
        assert shown["ename"] == "RoomLostError"
        assert sitting.uncertain[1:] == ["the cell that begins with “import os, signal”"]


def test_a_cell_may_hold_any_text():
    budget = Budget("the cells", 1.0)
    budget.take(sitting_module.cell("\n  \x1b[31m" + "x" * 99), 1.0, 0.0)
    assert budget.is_over
    assert "\x1b" not in budget.spent()
    assert len(budget.spent()) < 200


def test_own_cells_that_never_end_cost_no_answer(release, monkeypatch):
    monkeypatch.setattr(sitting_module, "OWN_SECONDS", 1.0)
    monkeypatch.setattr(Room.run, "__defaults__", (0.5,))
    notebook = p3_pendulum.right(release)
    after = notebook.cells.index(cell_of(notebook, "p3-lagrangian"))
    own = [nbformat.v4.new_code_cell(WAIT) for _ in range(5)]
    notebook.cells[after + 1 : after + 1] = own
    graded = grade(notebook, SOURCE, "seed")
    assert points(graded) == POINTS
    said = [cell.outputs[0].evalue for cell in graded.notebook.cells if cell.source == WAIT]
    assert said[0] == "this cell ran longer than 0.5 s"
    assert said[-1].startswith(
        "not run: the student's own cells had used up the 1 s that they have"
    )
    assert not graded.uncertain


def test_an_answer_that_needs_a_cell_that_was_not_run_says_why(release, monkeypatch):
    monkeypatch.setattr(sitting_module, "OWN_SECONDS", 0.3)
    monkeypatch.setattr(Room.run, "__defaults__", (0.5,))
    notebook = p3_pendulum.right(release)
    at = notebook.cells.index(cell_of(notebook, "p3-lagrangian"))
    own = [WAIT, "def weight(pend):\n    return pend.m * pend.g"]
    notebook.cells[at:at] = map(nbformat.v4.new_code_cell, own)
    answer = cell_of(notebook, "p3-g_vec")
    index = notebook.cells.index(answer)
    answer = next(c for c in reversed(notebook.cells[:index]) if "def g_vec" in c.source)
    answer.source = "def g_vec(q, pend):\n    return weight(pend) * pend.lc * np.sin(q)"
    graded = grade(notebook, SOURCE, "seed")
    problem = graded.verdicts["p3-g_vec"].problem
    assert (
        "NameError: name 'weight' is not defined; the cell that defines it was not run" in problem
    )
    assert f"the cell that begins with “{WAIT}” took" in problem
    assert points(graded) == POINTS | {"p3-g_vec": 0.0}


def test_a_function_that_sleeps_is_not_certain(release, monkeypatch):
    notebook = p3_pendulum.right_but(
        release, M="import time\ndef M(q, pend):\n    time.sleep(60)\n    return [[pend.I]]"
    )
    # Far less than M sleeps, and enough for the functions that compute.
    monkeypatch.setattr("autograder.sandbox.room.CALL_SECONDS", 0.05)
    monkeypatch.setattr("autograder.sandbox.room.GRACE_SECONDS", 0.6)
    graded = grade(notebook, SOURCE, "seed")
    assert graded.uncertain
    assert f"{UNCERTAIN} M" in graded.notes
    assert points(graded) == POINTS | {"p3-M": 0.0}
    assert "hardly computed" in graded.verdicts["p3-M"].problem
