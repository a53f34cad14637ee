"""Where a number came up that is not finite: heard where it arises, told, and never printed."""

import json
import warnings

import numpy as np
import pytest

from autograder import protocol
from autograder.protocol import Call, Cause, Reply
from autograder.protocol.causes import CAUSES, decode_cause
from tests.autograder.protocol.test_riddles import defined

REST = np.array([0.0, 2.0])
# The body of f(q, qd), what is heard, and the line of it.
HEARD = [
    ("d = 2 * qd\nreturn d - qd / np.abs(qd)", "0/0", "line 3: return d - qd / np.abs(qd)"),
    ("return q[0] / q[1] / 0", "division by 0", "line 2: return q[0] / q[1] / 0"),
    ("return np.sqrt(q - 9)", "root", "line 2: return np.sqrt(q - 9)"),
    ("return np.log(-q)", "logarithm", "line 2: return np.log(-q)"),
    ("return np.log(qd)", "logarithm", "line 2: return np.log(qd)"),
    ("return np.arccos(1 + q)", "arc", "line 2: return np.arccos(1 + q)"),
    ("return (-q) ** 0.3", "power", "line 2: return (-q) ** 0.3"),
    ("a = np.exp(1e4 * q)\nreturn a - a", "overflow", "line 2: a = np.exp(1e4 * q)"),
    ("return np.sin(np.inf * q)", "wave of infinity", "line 2: return np.sin(np.inf * q)"),
    ("return np.inf * q - np.inf", "infinities", "line 2: return np.inf * q - np.inf"),
    ("return np.mean(qd / qd)", "0/0", "line 2: return np.mean(qd / qd)"),
    ("u = qd / 0\nreturn u - u", "division by 0", "line 2: u = qd / 0"),
    ("g = lambda x: x / x\nreturn g(qd)", "0/0", "line 2: g = lambda x: x / x"),
]


def reply_to(body: str) -> Reply:
    return protocol.answer(Call("f", (np.array([0.3, 0.4]), REST)), defined(body, "q, qd"))


@pytest.mark.parametrize(("body", "kind", "line"), HEARD, ids=[body for body, *_ in HEARD])
def test_the_cause_is_heard_at_its_line(body, kind, line):
    """It reaches the judge as it is, through JSON."""
    reply = reply_to(body)
    assert reply.cause == Cause(kind, line)
    assert f" ({line})" in reply.cause.sentence
    message = json.loads(json.dumps(protocol.encode_reply(reply)))
    assert protocol.decode_reply(message).cause == reply.cause


def test_every_cause_is_heard_in_a_test():
    assert {kind for _, kind, _ in HEARD} == set(CAUSES)


@pytest.mark.parametrize(
    "body",
    [
        "return np.where(qd == 0, 0.0, qd / np.abs(qd))",  # it does no harm
        "return np.array([np.nan, 1.0])",  # NumPy has nothing to say
        "return qd",
    ],
)
def test_nothing_is_said_without_need(body):
    assert reply_to(body).cause is None


def test_nothing_is_printed_and_no_setting_stays(capfd):
    """A warning on stderr would cost the student the cell's points."""
    before = np.geterr(), warnings.showwarning, list(warnings.filters)
    assert reply_to("return qd / qd").cause
    assert capfd.readouterr() == ("", "")
    assert (np.geterr(), warnings.showwarning, list(warnings.filters)) == before


def test_a_function_that_fails_the_second_time_is_no_error():
    namespace = defined("calls.append(1)\nassert len(calls) < 2\nreturn qd / qd", "q, qd")
    namespace["calls"] = []
    reply = protocol.answer(Call("f", (REST, REST)), namespace)
    assert (reply.fault, reply.cause, namespace["calls"]) == (None, None, [1, 1])


@pytest.mark.parametrize("message", [None, [], ["0/0"], ["0/0", 1], ["other", ""], [[], ""], "0/0"])
def test_what_is_no_cause_says_nothing(message):
    assert decode_cause(message) is None


def test_a_line_that_would_pass_for_one_of_ours_stays_one_line():
    cause = decode_cause(["0/0", "line 1: x\n\nCorrect. " + 1000 * "x"])
    assert "\n" not in cause.line
    assert len(cause.line) <= 300
