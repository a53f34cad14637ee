"""The progress bar: for someone who is there to see it, of a run that lasts."""

import io
import itertools
import re
import sys

import numpy as np
import pytest
from tqdm import tqdm

from armdyn.simulate import simulate


class Terminal(io.StringIO):
    def isatty(self):
        return True


# A notebook's stderr is no terminal, and is known by where its class comes from.
Notebook = type("OutStream", (io.StringIO,), {"__module__": "ipykernel.iostream"})


@pytest.fixture
def shown(monkeypatch):
    """What a run of 40 steps writes to a stream in place of stderr, at so many seconds a step."""

    def run(stream, per_step, **options):
        clock = itertools.count(0, per_step)
        monkeypatch.setattr("tqdm.std.time", lambda: next(clock))
        monkeypatch.setattr(sys, "stderr", stream)
        t = np.linspace(0, 2, 41)
        x = simulate(lambda x, u: -x, [1.0], 0.0, t, **options)
        monkeypatch.undo()
        np.testing.assert_allclose(x[:, 0], np.exp(-t), atol=1e-6)
        return stream.getvalue()

    return run


@pytest.mark.parametrize("stream", [Terminal, Notebook])
@pytest.mark.parametrize("method", ["rk4", "RK45"])
def test_a_long_run_shows_how_far_it_is_and_cleans_up(shown, stream, method):
    text = shown(stream(), 0.3, method=method)
    seen = [float(n) for n in re.findall(r"simulated (\S+) of 2 s", text)]
    assert len(seen) > 5
    assert seen == sorted(seen)
    assert seen[0] > 0.0
    assert seen[-1] == pytest.approx(2, abs=0.3)
    assert text.split("\r")[-2].strip() == ""


@pytest.mark.parametrize("stream", [Terminal, Notebook])
def test_a_run_of_less_than_a_second_is_silent(shown, stream):
    assert shown(stream(), 0.02) == ""


def test_it_can_be_switched_off(shown):
    assert shown(Terminal(), 0.3, progress=False) == ""


def test_a_file_or_a_pipe_gets_none(shown):
    assert shown(io.StringIO(), 0.3) == ""


def test_without_a_stderr_there_is_none(monkeypatch):
    monkeypatch.setattr(sys, "stderr", None)
    assert simulate(lambda x, u: -x, [1.0], 0.0, [0, 1.0]).shape == (2, 1)


def test_a_bar_leaves_nothing_behind_when_the_run_fails(shown, monkeypatch):
    stream = Terminal()
    monkeypatch.setattr(sys, "stderr", stream)
    clock = itertools.count(0, 0.3)
    monkeypatch.setattr("tqdm.std.time", lambda: next(clock))
    with pytest.raises(FloatingPointError):
        simulate(lambda x, u: x**3, [1.0], 0.0, np.linspace(0, 1, 51))
    assert stream.getvalue().split("\r")[-2].strip() == ""
    assert not tqdm._instances


def test_no_thread_is_started(shown):
    """A thread would make every later fork of the process a risk."""
    assert shown(Terminal(), 0.3)
    assert tqdm.monitor is None
