"""worst_case(), and the calls that a card prints: pasted, they give what the card says."""

import ast
import contextlib
import re
from functools import cache

import nbclient
import nbformat
import numpy as np
import pytest

from autograder import worst_case
from autograder.judging.call_text import EXACT, arguments, shown_call
from autograder.judging.verdict import State
from autograder.problems import CHECKS, UnknownCheckError, known_check
from autograder.protocol import Call, answer, read, real
from autograder.student import worst_case as module
from autograder.student.cell import verdict_on
from autograder.student.worst_case import NoWorstCaseError
from tests.autograder.course_problems import ROOT

MECHANISMS = ("cart-pole-M", "cart-pole-f", "pendulum-lagrangian", "pendulum-energy_drift")
# A wrong answer to each question that 1.1 times the right one would not be.
WRITTEN = {
    "p1-is_spd": "def is_spd(A):\n    least, *_, most = np.linalg.eigvalsh(A)\n"
    "    return bool(np.all(A == A.T) and least > 1e-9 * most)",
    "p1-singular_arm": "def singular_arm(): return {n: 1.0 for n in "
    "('l1', 'l2', 'lc1', 'lc2', 'm1', 'm2', 'I1', 'I2', 'g')}, [0.1, 0.2]",
    "p3-C": "def C(q, qd, pend): return pend.m * q * qd",
    "p3-lagrangian": "def lagrangian(q, qd, m, lc, I, g): return I * qd**2 + m * g * sp.cos(q)",
    "p2-christoffel": "def christoffel(M, q, qd): return M * qd[0] + M.diff(q[-1])",
    "c6-rank_of_excitation": "def rank_of_excitation(q, qd, qdd, arm): return len(q) + arm.l1",
    "c7-terms": "def terms(library, q, qd):\n    u = library(q, qd, 0 * q)\n"
    "    return np.diag(u), u, 2 * u, 3 * u",
}


@pytest.fixture(autouse=True)
def nothing_remembered(monkeypatch):
    monkeypatch.setattr(module, "_last", {})


@cache
def imports_of(check_id: str) -> str:
    """What the set-up cell of a check's problem imports; of another mechanism, as `new-problem` does."""
    if check_id not in CHECKS:
        return "import numpy as np\nfrom types import SimpleNamespace"
    if check_id.startswith("start"):
        return ""
    (path,) = (ROOT / "solutions").glob(f"{check_id[:2]}-*/*.ipynb")
    set_up = next(c for c in nbformat.read(path, 4).cells if c.cell_type == "code")
    kinds = (ast.Import, ast.ImportFrom)
    lines = [node for node in ast.parse(set_up.source).body if isinstance(node, kinds)]
    return "\n".join(ast.unparse(line) for line in lines)


def namespace_of(check, source: str = "") -> dict:
    """A notebook with a wrong answer to a check."""
    namespace = {"__name__": "__main__"}
    exec(imports_of(check.id), namespace)
    if source:
        exec(source, namespace)
    else:
        namespace[check.name] = lambda *args: 1.1 * np.asarray(check.reference(*args)) + 0.01
    return namespace


def raw(call: Call, namespace: dict) -> np.ndarray:
    reply = answer(call, namespace)
    assert reply.fault is None
    return reply.value


def numbers_in(value) -> np.ndarray:
    """All of a value, of parts one after the other."""
    return (
        np.concatenate(list(map(np.ravel, value))) if isinstance(value, list) else np.ravel(value)
    )


def assert_same_digits(one, other):
    one, other = numbers_in(one), numbers_in(other)
    assert len(one) == len(other)
    least = 1e-9 * np.max(np.abs(one), initial=0.0)
    for a, b in zip(one, other, strict=True):
        assert f"{a:.4g}" == f"{b:.4g}" or abs(a - b) <= least


@pytest.mark.parametrize("fresh", [False, True])
@pytest.mark.parametrize("check_id", [*CHECKS, *MECHANISMS])
def test_the_printed_call_gives_what_the_check_saw(check_id, fresh):
    check = known_check(check_id)
    namespace = namespace_of(check, WRITTEN.get(check_id, ""))
    verdict = verdict_on(check_id, namespace, fresh)
    assert verdict.witness is not None
    module.remember(verdict)
    call, printed = verdict.worst, verdict.witness.call
    names = arguments(check.signature)
    if names:
        exec(verdict.given_by, namespace)
        given = [namespace[name] for name in names]
        if not call.at:  # by `worst_case`, to the last bit
            again = read(call, namespace[check.name](*given))
            np.testing.assert_array_equal(numbers_in(again), numbers_in(raw(call, namespace)))
    result = eval(printed, namespace)
    if call.at:
        assert_same_digits(np.array(result.tolist() if result.is_Matrix else result, float),
                           raw(call, namespace)[-1])  # fmt: skip
    elif not names:
        assert result == namespace[check.name]()
    else:
        assert_same_digits(read(call, result), raw(call, namespace))


@pytest.mark.parametrize("check_id", [*CHECKS, *MECHANISMS])
def test_the_lines_on_a_card_run_by_themselves(check_id):
    """In a cell of their own, where nothing but the function itself is defined."""
    check = known_check(check_id)
    namespace = namespace_of(check, WRITTEN.get(check_id, ""))
    verdict = verdict_on(check_id, namespace)
    module.remember(verdict)
    if not arguments(check.signature):
        assert verdict.again == ""
        return
    alone = {"__name__": "__main__", check.name: namespace[check.name]}
    *lines, last = verdict.again.splitlines()
    exec("\n".join(lines), alone)
    result = eval(last, alone)
    if verdict.worst.at:
        given = np.array(result.tolist() if result.is_Matrix else result, float)
        assert_same_digits(given, raw(verdict.worst, namespace)[-1])
    else:
        assert_same_digits(read(verdict.worst, result), raw(verdict.worst, namespace))


def test_the_lines_on_a_card_leave_functions_alone():
    """f in rk4_step(f, x, u, dt) is the name of the function that p5-f asks for."""
    check = CHECKS["p5-rk4_step"]
    namespace = namespace_of(check) | {"f": lambda x, u, arm: "mine"}
    for body in ("", "def rk4_step(f, x, u, dt):\n    return 1 / 0"):
        exec(body, namespace)
        verdict = verdict_on(check.id, namespace)
        module.remember(verdict)
        assert "f_given, x, u, dt = worst_case(" in verdict.again
        with contextlib.suppress(ZeroDivisionError):
            exec(verdict.again, namespace)
        assert namespace["f"](0, 0, 0) == "mine"


@pytest.mark.parametrize(
    "check_id", ["p1-M", "p2-C", "p3-g_vec", "p4-g_vec", "p5-f", "c6-regressor"]
)
def test_few_digits_are_shown_and_are_those_that_worst_case_gives(check_id):
    check = CHECKS[check_id]
    verdict = verdict_on(check_id, namespace_of(check))
    numbers = re.findall(r"\d+\.\d+", verdict.witness.call)
    assert numbers
    assert all(len(n.replace(".", "").strip("0")) <= 4 for n in numbers)
    assert verdict.witness.call == shown_call(verdict.worst, check.signature, EXACT)


def test_more_digits_are_shown_where_few_would_not_fail():
    """Wrong only where the inertia has more than four digits."""
    body = "def M(q, pend):\n    return pend.I + (round(pend.I, 4) != pend.I)"
    verdict = verdict_on("p3-M", namespace_of(CHECKS["p3-M"], body))
    q, pend = real(verdict.worst.args[0]), real(verdict.worst.args[1])
    assert round(pend.I, 4) != pend.I
    given = eval(verdict.witness.call, namespace_of(CHECKS["p3-M"], body))
    assert f"gave {given:.4g}" in " ".join(verdict.lines())
    assert q.shape == (1,)


def test_a_call_in_few_digits_is_of_the_criterion_that_the_card_names():
    """M11 is wrong only where l1 has more than four digits; M22 always."""
    check = CHECKS["p1-M"]
    namespace = namespace_of(check)
    namespace["M"] = lambda q, arm: (
        check.reference(q, arm) + np.diag([float(round(arm.l1, 4) != arm.l1), 1.0])
    )
    verdict = verdict_on(check.id, namespace)
    assert [row.met for row in verdict.rows] == [False, True, False]
    assert verdict.witness.where == "M[0, 0]"
    wrong = eval(verdict.witness.call, namespace) - check.reference(*map(real, verdict.worst.args))
    assert wrong[0, 0] == pytest.approx(1.0)


def test_some_calls_need_all_digits_and_most_do_not():
    """is_spd(A) of a matrix that is symmetric up to rounding: with few digits it would be symmetric."""
    check = CHECKS["p1-is_spd"]
    verdict = verdict_on(check.id, namespace_of(check, WRITTEN[check.id]))
    strict = next(row for row in verdict.rows if "rounding" in row.text)
    assert not strict.met
    entries = eval(verdict.witness.call, {"np": np, "is_spd": lambda A: A})
    assert not np.array_equal(entries, entries.T)
    verdict = verdict_on("p3-g_vec", namespace_of(CHECKS["p3-g_vec"]))
    assert max(map(len, re.findall(r"\d+\.\d+", verdict.witness.call))) < 6


@pytest.mark.parametrize(
    "body",
    ["pend.m / int(q[0] > 0)", "None if q[0] > 0 else 1.0", "np.nan if q[0] > 0 else 1.0", "np.ones(3)",
     "'g'"],
)  # fmt: skip
def test_the_failed_call_fails_when_it_is_pasted(body):
    check = CHECKS["p3-g_vec"]
    namespace = namespace_of(check, f"def g_vec(q, pend):\n    return {body}")
    verdict = verdict_on(check.id, namespace)
    assert verdict.state is State.ERROR
    module.remember(verdict)
    q, pend = worst_case(check.id)
    assert isinstance(q, np.ndarray)
    assert vars(pend).keys() == {"m", "lc", "I", "g"}

    def outcome(call):
        try:
            return repr(call())
        except ZeroDivisionError as error:
            return type(error)

    assert outcome(lambda: namespace["g_vec"](q, pend)) == outcome(
        lambda: eval(verdict.failed.call, namespace)
    )


def test_the_arguments_are_new_each_time_and_as_the_check_passes_them():
    check = CHECKS["p5-rk4_step"]
    module.remember(verdict_on(check.id, namespace_of(check)))
    f, x, u, dt = worst_case(check.id)
    assert f(x, u).shape == x.shape
    assert isinstance(dt, float)
    x *= 0
    assert np.any(worst_case(check.id)[1])


def test_one_argument_comes_alone():
    check = CHECKS["p4-equilibria"]
    module.remember(
        verdict_on(check.id, namespace_of(check, "def equilibria(arm): return [[0, 0]]"))
    )
    assert worst_case(check.id).l1 > 0


@pytest.mark.parametrize(
    ("source", "said"),
    [
        (None, 'check("p3-M") has not run yet: run its cell first'),
        ("return pend.I", "p3-M has no worst case: its last verdict is correct"),
        ("raise NotImplementedError", "p3-M has no worst case: its function is not written yet"),
        ("", "p3-M has no worst case: its last verdict shows no call"),
    ],
)
def test_where_there_is_none_it_says_why(source, said):
    if source is not None:
        text = f"def M(q, pend): {source}" if source else ""
        module.remember(verdict_on("p3-M", namespace_of(CHECKS["p3-M"], text or "pass")))
    with pytest.raises(NoWorstCaseError) as error:
        worst_case("p3-M")
    assert str(error.value) == said
    assert error.value._render_traceback_() == [said]


def test_a_function_without_arguments_has_none():
    check = CHECKS["p1-singular_arm"]
    verdict = verdict_on(check.id, namespace_of(check, WRITTEN[check.id]))
    assert verdict.given_by == ""
    module.remember(verdict)
    with pytest.raises(NoWorstCaseError, match="takes no arguments"):
        worst_case(check.id)


def test_an_unknown_check():
    with pytest.raises(UnknownCheckError, match="p3-M"):
        worst_case("p3-m_")


def test_in_a_notebook():
    cells = [
        "import numpy as np\nfrom autograder import check",
        "def M(q, pend):\n    return pend.I / 2",
        "check('p3-M')",
        "from autograder import worst_case; q, pend = worst_case('p3-M')\nprint(M(q, pend) / pend.I)",
        "def M(q, pend):\n    return pend.I\ncheck('p3-M')",
        "worst_case('p3-M')",
        "def M(q, pend):\n    # its own cell's text is read\n    return q[1] * pend['I']\ncheck('p3-M')",
    ]
    notebook = nbformat.v4.new_notebook(cells=list(map(nbformat.v4.new_code_cell, cells)))
    nbclient.NotebookClient(notebook, kernel_name="python3", allow_errors=True).execute()
    card, used, none, read = (notebook.cells[k].outputs for k in (2, 3, 5, 6))
    assert 'q, pend = worst_case("p3-M")' in card[0].data["text/plain"].replace("\n  ", " ")
    assert used[0].text == "0.5\n"
    assert none[0].ename == "NoWorstCaseError"
    assert none[0].traceback == ["p3-M has no worst case: its last verdict is correct"]
    said = " ".join(read[0].data["text/plain"].split())
    assert "q has 1 entry, and Python counts from 0: q[0] is q1." in said
    assert "All 6 calls failed, the first of them: M(np.array([" in said
