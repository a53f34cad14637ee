"""Calls in a closed loop: how a controller is asked, and what becomes of one that fails on the way."""

from dataclasses import dataclass

import numpy as np
import pytest

from autograder.judging import loops
from autograder.judging.loops import Loop, asked, loop
from autograder.judging.models import evaluated
from autograder.protocol import Call, Fault, FaultKind, Reply, answer_all


class Falling:
    """x grows by what the controller says; its last value is the figure."""

    def __init__(self, x, steps):
        self.x, self.left = x, steps

    def args(self):
        return (self.x,) if self.left else None

    def tell(self, value):
        self.x, self.left = self.x + float(value), self.left - 1

    def figures(self):
        return np.array([self.x])


@dataclass(frozen=True)
class Tower:
    x: float
    steps: int

    def begin(self):
        return Falling(self.x, self.steps)


def half(x):
    return -x / 2


TWO = [loop("u", Tower(8.0, 3), half), Call("u", (4.0,)), loop("u", Tower(2.0, 1), half)]


def by(function, batches=None):
    def ask(calls):
        if batches is not None:
            batches.append([call.args for call in calls])
        return answer_all(calls, {"u": function})

    return ask


def test_loops_are_asked_together_step_by_step_and_keep_their_places():
    batches = []
    calls, replies = asked(TWO, by(half, batches))
    assert calls == TWO
    assert [reply.value.tolist() for reply in replies] == [[1.0], -2.0, [1.0]]
    assert batches == [[(4.0,)], [(8.0,), (2.0,)], [(4.0,)], [(2.0,)]]


def test_a_model_is_not_run_and_has_the_right_figures():
    values = evaluated(lambda x: 0.0, TWO)
    assert [np.asarray(value).tolist() for value in values] == [[1.0], 0.0, [1.0]]


def test_a_wrong_controller_has_its_own_figures():
    _, replies = asked(TWO, by(lambda x: -x / 4))
    assert replies[0].value == pytest.approx(8 * 0.75**3)


def test_no_loop_begins_where_another_call_fails():
    batches = []

    def wrong(x):
        raise ValueError

    calls, replies = asked(TWO, by(wrong, batches))
    assert [type(call) for call in calls] == [Call]
    assert replies[0].fault.kind is FaultKind.RAISED
    assert len(batches) == 1


def test_the_step_that_fails_is_the_call_that_is_shown():
    def late(x):
        if x < 3:
            raise ValueError("late")
        return half(x)

    calls, replies = asked(TWO[:2], by(late))
    assert calls[len(replies) - 1] == Call("u", (2.0,))
    assert not isinstance(calls[len(replies) - 1], Loop)
    assert "late" in replies[-1].fault.message
    assert len(replies) < len(calls)  # so that nothing is said of how many calls failed


@pytest.mark.parametrize("value", [{"a": np.zeros(1)}, [np.zeros(1)], None])
def test_what_no_controller_can_return_is_garbled(value):
    """As the sandbox, or code that has broken out of it, might send it."""
    _, replies = asked(TWO[:1], lambda calls: [Reply(value=value) for _ in calls])
    assert replies[-1].fault.kind is FaultKind.GARBLED


def test_a_reply_too_few_ends_the_loop():
    _, replies = asked(TWO[:1], lambda calls: [])
    assert replies[-1].fault is not None


def test_a_slow_controller_is_stopped(monkeypatch):
    monkeypatch.setattr(loops, "LONGEST", -1.0)
    _, replies = asked(TWO, by(half))
    assert replies[-1].fault == Fault(FaultKind.SLOW_LOOP, "-1 s")


def test_without_loops_nothing_changes():
    calls = [Call("u", (1.0,)), Call("u", (2.0,))]
    batches = []
    assert asked(calls, by(half, batches))[0] is calls
    assert batches == [[(1.0,), (2.0,)]]
