"""Student code ends at its time limit, also where no signal comes."""

import itertools
import signal
import sys
import time

import pytest

from autograder.protocol import Call, FaultKind, answer, limits


def forever():
    while True:
        pass


def counting():
    for _ in itertools.count():
        pass


def by_calls():
    return all(k >= 0 for k in itertools.count())


def asleep():
    while True:
        time.sleep(0.02)


@pytest.fixture
def without_signals(monkeypatch):
    for name in ("setitimer", "SIGALRM", "SIGPROF"):
        monkeypatch.delattr(signal, name)


looking = pytest.mark.skipif(not hasattr(sys, "monitoring"), reason="needs Python 3.12 or newer")


@looking
@pytest.mark.parametrize("code", [forever, counting, by_calls, asleep])
def test_without_signals_it_ends_too(without_signals, code):
    started = time.process_time()
    with pytest.raises(limits.TimeLimitError), limits.time_limit(0.1):
        code()
    assert time.process_time() - started < 1
    assert sys.monitoring.get_tool(limits.TOOL) is None


def nested():
    with pytest.raises(limits.TimeLimitError), limits.time_limit(0.05):
        forever()
    forever()


@looking
def test_a_limit_within_a_limit_leaves_the_outer_one(without_signals):
    with pytest.raises(limits.TimeLimitError) as stopped, limits.time_limit(0.3):
        nested()
    assert stopped.value.seconds in (0.3, 1.5)


@looking
def test_a_call_says_so(without_signals, monkeypatch):
    monkeypatch.setattr("autograder.protocol.calls.CALL_SECONDS", 0.1)
    reply = answer(Call("forever", ()), {"forever": forever})
    assert reply.fault.kind in (FaultKind.TIMED_OUT, FaultKind.STARVED)


@looking
def test_what_is_quick_is_not_disturbed(without_signals):
    with limits.time_limit(5.0):
        assert sum(range(1000)) == 499500
    assert limits.no_limit() == ""


def test_where_nothing_can_stop_it_a_sentence_says_so(without_signals, monkeypatch):
    monkeypatch.delattr(sys, "monitoring", raising=False)
    assert "interrupt the kernel" in limits.no_limit()
    with limits.time_limit(0.01):
        sum(range(10))
