"""A graded notebook: what is finite keeps its points, errors are read, no input is told, and
`worst_case` breaks nothing.
"""

import numpy as np
import pytest
from nbformat.v4 import new_code_cell

from autograder.judging.card import html_card
from autograder.judging.verdict import State
from autograder.notebook import grade as grading
from autograder.notebook.grade import grade
from tests.autograder.course_problems import problem, without_plots
from tests.submissions import p3_pendulum, p5_state_space
from tests.submissions.p3_pendulum import function

USING = """from autograder import worst_case
q, pend = worst_case("p3-g_vec")
print(type(q).__name__, *vars(pend))
m, lc, *_ = worst_case("p3-lagrangian")[2:]
def g_vec(q, pend):
    return pend.m * pend.g * pend.lc * np.sin(q)
print(g_vec(q, pend).shape, m, pend.I == worst_case("p3-g_vec")[1].I)
"""


@pytest.fixture(scope="module")
def pendulum():
    given = problem("p3-pendulum")
    return without_plots(given.release), without_plots(given.source)


def printed(cell) -> str:
    return "".join(out.text for out in cell.outputs if out.output_type == "stream")


def test_a_notebook_that_calls_worst_case_runs_and_is_judged(pendulum):
    release, source = pendulum
    notebook = p3_pendulum.right_but(release, g_vec=USING)
    notebook.cells.append(new_code_cell("worst_case('p3-gvec')"))
    graded = grade(notebook, source, "seed")
    assert {verdict.state for verdict in graded.verdicts.values()} == {State.CORRECT}
    cell = next(cell for cell in graded.notebook.cells if cell.source == USING.strip())
    assert printed(cell) == "ndarray m lc I g\n(1,) m True\n"
    assert graded.notebook.cells[-1].outputs[0].evalue == "there is no check 'p3-gvec'"


def test_where_no_cell_asks_nothing_is_laid(pendulum, monkeypatch):
    release, _ = pendulum
    assert grading.examples.prelude(release, None, {}) == ""


def test_a_nan_costs_in_grading_what_hangs_on_it(monkeypatch):
    given = problem("p5-state-space")
    release, source = without_plots(given.release), without_plots(given.source)
    f = p5_state_space.RIGHT.function(
        "f",
        "q, qd = x[:2], x[2:]\n"
        "friction = arm.viscous * qd + arm.coulomb * qd / np.abs(qd)\n"
        "rest = u - C(q, qd, arm) @ qd - g_vec(q, arm) - friction\n"
        "return np.concatenate([qd, np.linalg.solve(M(q, arm), rest)])",
    )
    graded = grade(p5_state_space.right_but(release, f=f), source, "seed")
    verdict = graded.verdicts["p5-f"]
    assert (verdict.state, verdict.credit) == (State.PARTLY_CORRECT, 0.25)
    assert "returned nan at [" in verdict.problem
    assert "0/0" in verdict.problem
    assert "arm.coulomb * qd / np.abs(qd))" in verdict.problem  # its line, in brackets
    assert (verdict.failed, verdict.worst) == (None, None)


def test_errors_are_read_on_the_feedback_page_and_no_input_is_told(pendulum):
    release, source = pendulum
    answers = {
        "g_vec": function("g_vec", "pend['m'] * q"),
        "C": function("C", "np.ones(1) * (10^-3)"),
        "M": function("M", "print(pend)"),
    }
    answers["M"] = answers["M"].replace("return ", "")
    graded = grade(p3_pendulum.right_but(release, **answers), source, "seed")
    said = {id: html_card(verdict) for id, verdict in graded.verdicts.items()}
    assert (
        "pend keeps its numbers by name: write pend.m, not pend[&#x27;m&#x27;]." in said["p3-g_vec"]
    )
    assert "Your C uses ^. In Python ^ is no power; the power is **." in said["p3-C"]
    assert "M calls print, which only shows a value" in said["p3-M"]
    for page in said.values():
        assert "np.array" not in page
        assert "SimpleNamespace(" not in page
        assert "worst_case" not in page


def test_the_arguments_are_those_of_the_check(pendulum):
    """The sandbox gets a call as any other would, and nothing that the check expects."""
    release, _ = pendulum
    notebook = p3_pendulum.right_but(release, g_vec=USING)
    laid = grading.examples.prelude(notebook, None, {})
    assert laid.count("lay_example") == len(p3_pendulum.POINTS)
    given = []
    exec(laid.replace("__import__('autograder').lay_example", "lay"),
         {"lay": lambda *one: given.append(one)})  # fmt: skip
    assert {id for id, _ in given} == set(p3_pendulum.POINTS)
    assert all(np.isfinite(len(text)) and '"args"' in text for _, text in given)
