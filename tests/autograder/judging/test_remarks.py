"""What a card says of a function that is hardly meant as it is: ^, arguments in another order."""

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder import protocol
from autograder.judging.verdict import State
from autograder.protocol import Call, Reply
from tests.autograder.verdicts import judged, judged_in

C8 = "c8-gravity_compensation"
NAMES = ("q", "qd", "q_star", "arm")


def defined(
    arguments, body: str = "return np.zeros(2)", name: str = "gravity_compensation"
) -> dict:
    namespace = {"__name__": "__main__", "np": np}
    exec(f"def {name}({', '.join(arguments)}):\n    {body}", namespace)
    return namespace


def test_a_caret_is_told_of_a_wrong_answer_and_not_of_a_right_one():
    said = "Your g_vec uses ^. In Python ^ is no power; the power is **."
    body = "k = {}\nreturn pend.m * pend.g * pend.lc * np.sin(q) * (k ^ 3)"
    assert judged("p3-g_vec", body.format(1)).remark == said
    right = judged("p3-g_vec", body.format(2))
    assert (right.state, right.remark) == (State.CORRECT, "")


@given(st.permutations(NAMES))
def test_another_order_of_the_arguments_is_told(order):
    verdict = judged_in(defined(order), C8, count=2)
    said = (
        "The check calls gravity_compensation(q, qd, q_star, arm); the first line of yours, "
        f"gravity_compensation({', '.join(order)}), has its arguments in another order."
    )
    assert verdict.remark == ("" if tuple(order) == NAMES else said)


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("pos", "vel", "goal", "robot"), False),
        (("q", "vel", "goal", "robot"), False),
        (("q", "q_star", "velocity", "arm"), True),
        (("q", "qd", "q_star", "arm", "k=1"), False),
    ],
)
def test_names_of_a_students_own_say_nothing_of_the_order(arguments, told):
    assert ("another order" in judged_in(defined(arguments), C8, count=2).remark) == told


@pytest.mark.parametrize("arguments", [("pend", "q"), ("x", "y"), ("q", "pend")])
def test_it_is_told_of_an_error_too_and_never_of_a_right_answer(arguments):
    arm = "pend" if "pend" in arguments else "y"
    wrong = judged_in(defined(arguments, f"return {arm}.m * {arm}.lc + {arm}.I", "M"), "p3-M")
    assert ("another order" in wrong.remark) == (arguments == ("pend", "q"))
    assert (wrong.state is State.ERROR) == (arguments == ("pend", "q"))
    right = judged_in(defined(("pend", "q"), "return q.I", "M"), "p3-M")
    assert (right.state, right.remark) == (State.CORRECT, "")


@pytest.mark.parametrize(
    ("arguments", "fits"),
    [((), False), (("q",), False), (("q", "pend", "k"), False), (("q", "pend", "k=1"), True)],
)
def test_a_first_line_that_does_not_fit_is_told(arguments, fits):
    verdict = judged_in(defined(arguments, "return 0.0", "M"), "p3-M", count=2)
    own = f"M({', '.join(arguments)})"
    said = f"The check calls M(q, pend); the first line of yours, {own}, does not fit."
    assert verdict.remark == ("" if fits else said)
    assert (verdict.state is State.ERROR) == (not fits)


def test_a_call_within_the_function_is_the_functions_own_error():
    wrong = judged_in(defined(("q", "pend"), "return M(q)", "M"), "p3-M", count=2)
    assert (wrong.state, wrong.remark) == (State.ERROR, "")


@given(
    st.one_of(
        st.none(), st.text(), st.lists(st.one_of(st.text(), st.integers(), st.lists(st.none())))
    )
)
def test_forged_names_are_no_names(names):
    reply = protocol.decode_reply({"value": 1.0, "takes": names})
    assert reply.value == 1.0
    assert all(name.isidentifier() and len(name) <= 30 for name in reply.takes)


@pytest.mark.parametrize("function", [len, np.sin, lambda *args: 1.0, "no function"])
def test_what_names_no_arguments_of_its_own_has_none(function):
    assert protocol.answer(Call("f", (1.0,)), {"f": function}).takes == ()


@pytest.mark.parametrize("body", ["return q", "return 1 / 0"])
def test_the_names_come_out_of_a_room(body):
    reply = protocol.answer(Call("f", (1.0, 2.0)), defined(("q", "qd"), body, "f"))
    assert reply.takes == ("q", "qd")
    sent = json.loads(json.dumps(protocol.encode_reply(reply)))
    assert protocol.decode_reply(sent).takes == ("q", "qd")
    assert protocol.decode_reply({"value": 1.0}) == Reply(value=np.array(1.0))
