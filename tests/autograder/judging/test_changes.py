"""An answer that changes its arguments: it is seen and said, and costs what a second call loses."""

import json
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from autograder import protocol
from autograder.judging.changes import changed
from autograder.judging.verdict import State
from autograder.problems import CHECKS
from autograder.protocol import Call, Expressions, Fault, FaultKind, Function, Reply, Symbol
from autograder.sandbox.room import Room
from autograder.sandbox.ways import Way
from tests.autograder.verdicts import judged

ARGS = (
    np.array([1.0, np.nan, -0.0]),
    SimpleNamespace(I2=0.5, axis=np.array([0.0, 1.0]), rest=np.nan),
    (np.eye(2), 3.0, (Symbol("a"),)),
    Expressions((("a", "b"), ("c", "d"))),
    Function("x", "[x[0]]"),
    2.0,
    Symbol("q"),
)
NAMES = "q, arm, parts, matrix, f, m, s"
SIGNATURE = f"g({NAMES})"


def reply_to(body: str) -> Reply:
    """The reply of a function with this body, as it comes from the sandbox."""
    namespace = {"__name__": "__main__", "np": np}
    exec(f"def g({NAMES}):\n    {body}\n    return 1.0", namespace)
    reply = protocol.answer(Call("g", ARGS), namespace)
    return protocol.decode_reply(json.loads(json.dumps(protocol.encode_reply(reply))))


@pytest.mark.parametrize(
    ("body", "names"),
    [
        ("q += 1", ["q"]),
        ("q[2] = 0.0", ["q"]),  # from −0.0
        ("q.shape = (3, 1)", ["q"]),
        ("q.sort()", ["q"]),
        ("arm.I2 += 1", ["arm.I2"]),
        ("arm.axis[0] = 2", ["arm.axis"]),
        ("arm.axis = list(arm.axis)", ["arm.axis"]),
        ("del arm.I2", ["arm.I2"]),
        ("arm.more = 1", ["arm"]),
        ("parts[0][0, 0] = 7", ["parts"]),
        ("parts.append(1)", ["parts"]),
        ("parts[2][0] = 1", ["parts"]),
        ("matrix[0, 0] = 0", ["matrix"]),
        ("matrix.row_del(0)", ["matrix"]),
        ("q *= 2; arm.I2 = np; parts.clear()", ["q", "arm.I2", "parts"]),
        ("arm.I2 = np.zeros(3)", ["arm.I2"]),  # compares to more than one truth
    ],
)
def test_a_change_is_seen_by_name(body, names):
    assert changed(SIGNATURE, [Call("g", ARGS)], [reply_to(body)]) == tuple(names)


@pytest.mark.parametrize(
    "body",
    [
        "pass",
        "q = q + 1; arm = None; m += 1",
        "q *= 1.0",
        "arm.I2 = np.float64(arm.I2); arm.axis = np.array(arm.axis)",
        "matrix[0, 0] = matrix[0, 0]; parts.append(1); parts.pop()",
        "parts.reverse(); parts.reverse(); f([1.0, 2.0]); f.note = 1",
        "arm.rest = float('nan')",
        "copy = matrix.copy(); copy[0, 0] = 1",
    ],
)
def test_what_leaves_them_as_they_were_is_no_change(body):
    reply = reply_to(body)
    assert (reply.changed, reply.again) == ((), None)
    assert reply.value == 1.0


def test_the_second_call_gets_what_the_first_left():
    namespace = {"__name__": "__main__"}
    exec("def g(q):\n    q += 1\n    return q", namespace)
    reply = protocol.answer(Call("g", (np.zeros(2),)), namespace)
    np.testing.assert_array_equal(reply.value, [1.0, 1.0])
    np.testing.assert_array_equal(reply.again.value, [2.0, 2.0])


def test_arguments_that_cannot_be_made_are_a_fault_of_the_call(monkeypatch):
    monkeypatch.setattr("sympy.Symbol", None)  # as a student's cell may do
    reply = protocol.answer(Call("g", (Symbol("q"),)), {"g": lambda q: 1.0})
    assert reply.fault.kind is FaultKind.RAISED


def test_a_long_second_answer_is_left_out():
    namespace = {"__name__": "__main__", "np": np}
    exec("def g(q):\n    q += 1\n    return np.zeros(40_000)", namespace)
    reply = protocol.answer(Call("g", (np.zeros(2),)), namespace)
    assert (reply.changed, reply.again) == (((0, ""),), None)


FORGED = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
    lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner),
    max_leaves=8,
)
KINDS = st.sampled_from([*FaultKind, "none"])
AGAIN = FORGED | st.builds(
    lambda kind: {"fault": {"kind": kind, "message": "said", "line": ""}}, KINDS
)


@given(st.lists(FORGED | st.tuples(st.integers(-3, 9), st.text(max_size=2)).map(list)), AGAIN)
@settings(max_examples=60)
def test_a_forged_reply_says_nothing_of_its_own_and_gains_nothing(changes, again):
    message = {"value": 1.0, "changed": changes, "again": again}
    reply = protocol.decode_reply(message)
    assert set(changed(SIGNATURE, [Call("g", ARGS)], [reply])) <= {
        *NAMES.split(", "), "arm.I2", "arm.axis", "arm.rest"
    }  # fmt: skip
    right = CHECKS["start-kinetic-energy"].run(
        lambda calls: [
            protocol.decode_reply(message | {"value": c.args[0] * c.args[1] ** 2 / 2})
            for c in calls
        ],
        np.random.default_rng(0),
    )
    assert right.state in (State.CORRECT, State.INCORRECT, State.ERROR)
    wrong = CHECKS["start-kinetic-energy"].run(
        lambda calls: [protocol.decode_reply(message)] * len(calls), np.random.default_rng(0)
    )
    assert wrong.credit == 0


COPY = "Work on a copy."
HARMLESS = f"which the caller may still need. {COPY}"


def test_a_right_answer_that_changes_no_result_keeps_its_points_with_the_remark():
    verdict = judged("p3-g_vec", "q %= 2 * np.pi\nreturn pend.m * pend.g * pend.lc * np.sin(q)")
    assert (verdict.state, verdict.credit, verdict.diagnosis) == (State.CORRECT, 1.0, ())
    assert verdict.remark == f"Your g_vec changes its argument q, {HARMLESS}"
    assert verdict.remark in verdict.lines()


def test_what_a_second_call_loses_is_lost():
    verdict = judged("p3-M", "pend.I += 0.1\nreturn pend.I - 0.1")
    assert (verdict.state, verdict.credit, verdict.diagnosis) == (State.INCORRECT, 0.0, ())
    assert verdict.remark == (
        f"Your M changes its argument pend.I, so a second call with it goes wrong. {COPY}"
    )
    assert "on a second call, with its arguments as the first call left them" in (
        verdict.witness.returned
    )
    assert verdict.witness.off.startswith("0.1 kg·m²")


def test_a_criterion_that_the_second_call_meets_keeps_its_share():
    entries = (
        "M22 = arm.I2 + arm.m2 * arm.lc2**2\nc = arm.m2 * arm.l1 * arm.lc2 * np.cos(q[1])\n"
        "M11 = arm.I1 + arm.m1 * arm.lc1**2 + arm.m2 * arm.l1**2 + M22 + 2 * c\n"
        "arm.I1 += 0.2\nreturn [[M11, M22 + c], [M22 + c, M22]]"
    )
    verdict = judged("p1-M", entries)
    assert verdict.state is State.PARTLY_CORRECT
    lost = [row.share for row in verdict.rows if not row.met]
    assert len(lost) == 1  # M11 alone holds I1
    assert verdict.credit == 1 - lost[0]
    assert verdict.remark.startswith("Your M changes its argument arm.I1, so a second call")


def test_a_wrong_answer_is_told_what_is_wrong_with_it_and_the_remark():
    verdict = judged("p3-g_vec", "q %= 2 * np.pi\nreturn pend.m * pend.g * pend.lc * np.cos(q)")
    assert verdict.state is State.INCORRECT
    assert "cosine" in verdict.diagnosis[0]
    assert verdict.remark == f"Your g_vec changes its argument q, {HARMLESS}"
    assert "second call" not in verdict.witness.returned


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("I = pend.I\ndel pend.I\nreturn I", "M(q, pend) raised AttributeError: "),
        ("I, pend.I = pend.I, None\nreturn I", "M(q, pend) returned None. "),
        ("I, pend.I = pend.I, np.ones(2)\nreturn I", "M(q, pend) returned 2 numbers of shape"),
        ("I, pend.I = pend.I, np.inf\nreturn I", "M(q, pend) returned inf, which is not"),
    ],
)
def test_a_second_call_without_numbers_is_an_error(body, said):
    verdict = judged("p3-M", body)
    assert (verdict.state, verdict.credit) == (State.ERROR, 0.0)
    assert verdict.problem.startswith("Your M changes its argument pend.I, so a second call")
    assert f" Work on a copy. On the second call, {said}" in verdict.problem


def test_a_slow_second_call_is_not_counted(monkeypatch):
    monkeypatch.setattr(protocol.calls, "CALL_SECONDS", 0.3)
    namespace = {"__name__": "__main__"}
    exec("import time\ndef g(q):\n    time.sleep(q[0])\n    q += 9\n    return 1", namespace)
    reply = protocol.answer(Call("g", (np.zeros(1),)), namespace)
    assert (reply.value, reply.changed, reply.again) == (1.0, ((0, ""),), None)


def test_a_room_sees_changes_too():
    with Room(Way.UNWALLED) as room:
        room.run("def g(q, arm):\n    arm.I2 += 1\n    return arm.I2")
        (reply,) = room.ask([Call("g", (1.0, SimpleNamespace(I2=1.0)))])
    again = Reply(np.array(3.0))
    assert reply == Reply(np.array(2.0), None, ((1, "I2"),), again, takes=("q", "arm"))
    room_fault = Fault(FaultKind.RAISED, "m", "l")
    assert protocol.decode_reply(protocol.encode_reply(Reply(fault=room_fault))).fault == room_fault
