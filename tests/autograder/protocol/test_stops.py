"""A stop reaches the code wherever it is, leaves its error, and nothing of it comes afterwards."""

import ctypes
import signal
import subprocess
import sys
import time
import warnings
from contextlib import contextmanager

import pytest

from autograder.protocol import limits
from autograder.protocol import waiting as waiting_module
from autograder.protocol.waiting import Stopwatch, Waiting

OFTEN = 40
unix = pytest.mark.skipif(not hasattr(signal, "SIGPROF"), reason="needs signals")
pytestmark = [
    unix,
    pytest.mark.filterwarnings("error::pytest.PytestUnraisableExceptionWarning"),
]


class Dying:
    def __del__(self):
        sum(range(20_000))


def loop():
    while True:
        pass


def caught():
    while True:
        try:  # noqa: SIM105  (as students write it)
            sum(range(1000))
        except Exception:
            pass


def at_last():
    try:
        loop()
    finally:
        sum(range(100_000))


def destructors():
    while True:
        Dying()


def endless_destructor():
    class Endless:
        def __del__(self):
            while True:
                pass

    Endless()
    while True:
        pass


def destructors_below_c():
    """Hardly any time passes but in a destructor, and no Python stands above it but the caller of C."""
    all(Dying() for _ in iter(int, 1))


def generators():
    def given():
        while True:
            try:
                yield 1
            finally:
                sum(range(10))

    while True:
        for _ in given():
            break


def warnings_caught():
    while True:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")


def nested():
    with pytest.raises(limits.TimeLimitError), limits.time_limit(0.01):
        loop()
    loop()


def both_signals_at_once():
    """As after a wait for the processor: the limit's own signal is there, and the clock's."""
    for timer in (signal.ITIMER_PROF, signal.ITIMER_REAL):
        signal.setitimer(timer, 0)
    _compute(0.01)
    # Without Python in between.
    list(map(ctypes.CDLL(None)["raise"], (signal.SIGALRM, signal.SIGPROF)))
    loop()


@pytest.fixture
def by_processor(monkeypatch):
    """On a busy machine, such short limits would be met by the clock first."""
    monkeypatch.setattr(limits, "PATIENCE", 1e5)
    monkeypatch.setattr(limits, "FAR", 1e5)


CODE = [loop, caught, at_last, destructors, destructors_below_c, endless_destructor,
        generators, warnings_caught]  # fmt: skip


@pytest.mark.parametrize("code", CODE)
def test_a_stop_comes_through_and_nothing_afterwards(by_processor, code):
    hook, trace, handlers = sys.unraisablehook, sys.gettrace(), _handlers()
    for n in range(OFTEN if code is not endless_destructor else 1):
        limit = limits.time_limit(0.001 + 0.0003 * (n % 7))
        with pytest.raises(limits.TimeLimitError) as stopped, limit:
            code()
        assert isinstance(limit.error, limits.TimeLimitError)
        assert stopped.value.seconds == limit.seconds
        assert signal.getitimer(signal.ITIMER_PROF) == (0.0, 0.0)
        assert signal.getitimer(signal.ITIMER_REAL) == (0.0, 0.0)
        assert (sys.unraisablehook, sys.gettrace(), _handlers()) == (hook, trace, handlers)
    _compute(0.01)  # what came late would come now


@contextmanager
def within(seconds):
    """A limit that is part of another block, as those of pictures are."""
    with limits.time_limit(seconds) as limit:
        yield limit


@pytest.mark.parametrize("code", [loop, both_signals_at_once, destructors, generators])
def test_a_limit_in_another_block_ends_with_that(by_processor, code):
    handlers = _handlers()
    for n in range(OFTEN):
        with pytest.raises(limits.TimeLimitError) as stopped, within(0.001 + 0.0003 * (n % 7)):
            code()
        assert stopped.value.seconds < 0.01
        assert signal.getitimer(signal.ITIMER_PROF) == (0.0, 0.0)
        assert _handlers() == handlers


def test_code_that_ends_about_its_limit_is_stopped_or_not_and_nothing_in_between(by_processor):
    for n in range(10 * OFTEN):
        limit = limits.time_limit(0.0005)
        stopped = False
        try:
            with limit:
                _compute(0.0003 + 0.000001 * n)
        except limits.TimeLimitError:
            stopped = True
        assert stopped == (limit.error is not None)
        assert signal.getitimer(signal.ITIMER_PROF) == (0.0, 0.0)


def test_code_that_swallows_the_stop_leaves_its_error_all_the_same(by_processor):
    with limits.time_limit(0.01) as limit:
        try:  # noqa: SIM105
            loop()
        except BaseException:
            pass
    assert isinstance(limit.error, limits.TimeLimitError)


def test_a_limit_within_a_limit_leaves_the_outer_one(by_processor):
    with pytest.raises(limits.TimeLimitError) as stopped, limits.time_limit(0.2):
        nested()
    assert stopped.value.seconds == 0.2


def test_code_with_timers_of_its_own_is_not_stopped_by_them():
    heard = []
    with limits.time_limit(5.0) as limit:
        signal.setitimer(signal.ITIMER_PROF, 0.005, 0.005)
        signal.setitimer(signal.ITIMER_REAL, 0.005, 0.005)
        _compute(0.05)
        signal.signal(signal.SIGALRM, lambda *_: heard.append(1))
        signal.setitimer(signal.ITIMER_REAL, 0.001)
        _compute(0.05)
    assert limit.error is None
    assert heard


def test_who_sleeps_is_starved_and_who_waits_for_a_processor_is_not(monkeypatch):
    monkeypatch.setattr(limits, "PATIENCE", 2.0)
    with pytest.raises(limits.TimeLimitError) as stopped, limits.time_limit(0.1):
        time.sleep(30)
    assert stopped.value.starved
    # As on a machine so busy that the code gets no processor: it was ready all the time.
    monkeypatch.setattr(Waiting, "look", lambda self: 0.0)
    with limits.time_limit(0.1) as limit:
        time.sleep(0.5)
    assert limit.error is None
    monkeypatch.setattr(limits, "FAR", 3.0)
    with pytest.raises(limits.TimeLimitError) as stopped, limits.time_limit(0.1):
        time.sleep(30)
    assert (stopped.value.starved, stopped.value.seconds) == (True, pytest.approx(0.3))


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux says who waits for a processor")
def test_time_in_which_something_computes_or_could_is_no_waiting():
    waiting = Waiting()
    waiting.look()
    clock = time.monotonic()
    _compute(0.3)
    passed, computing = time.monotonic() - clock, waiting.look()
    assert computing < 0.5 * passed + 0.1
    time.sleep(0.3)
    assert waiting.look() - computing > 0.2


def test_a_wait_for_the_processor_between_two_readings_counts_for_neither(monkeypatch):
    waits = [0.2]

    def here():
        busy = read()
        if waits:
            time.sleep(waits.pop())
        return busy

    read = waiting_module._busy_here
    waiting = Waiting()
    waiting.look()
    monkeypatch.setattr(waiting_module, "_busy_here", here)
    time.sleep(0.2)
    assert waiting.look() > 0.3
    assert waits == []


COMPUTE = "import time\nwhile time.process_time() < 0.8: pass"


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux says what other processes compute")
def test_what_a_program_computes_that_was_started_is_no_waiting():
    """While it runs, as a student's compiler does, and when it has ended since the last look."""
    waiting = Waiting()
    waiting.look()
    clock = time.monotonic()
    with subprocess.Popen([sys.executable, "-c", COMPUTE]) as program:
        while program.poll() is None:
            assert time.monotonic() - clock < 60
            time.sleep(0.02)
            waiting.look()
    assert waiting.look() < 0.5 * (time.monotonic() - clock)
    # Nobody looked while this one ran.
    waiting = Waiting()
    waiting.look()
    clock = time.monotonic()
    subprocess.run([sys.executable, "-c", COMPUTE], check=True, timeout=60)
    assert waiting.look() < time.monotonic() - clock - 0.7


def test_where_the_system_tells_nothing_what_does_not_compute_waits(monkeypatch):
    """As on macOS and Windows, which have no /proc."""

    def nothing(*_):
        raise FileNotFoundError

    monkeypatch.setattr("builtins.open", nothing)
    monkeypatch.setattr("os.listdir", nothing)
    monkeypatch.delattr("os.sysconf")
    waiting, watch = Waiting(), Stopwatch()
    assert waiting.look() == 0.0
    time.sleep(0.2)
    assert waiting.look() >= 0.19
    assert watch.seconds(2.0) >= 0.09


def test_a_stopwatch_counts_what_is_computed_and_a_part_of_what_is_slept(monkeypatch):
    watch = Stopwatch()
    _compute(0.1)
    assert watch.seconds(5.0) >= 0.1
    watch = Stopwatch()
    clock = time.monotonic()
    time.sleep(0.3)
    slept = watch.seconds(3.0)
    assert 0.09 <= slept <= (time.monotonic() - clock) / 3
    # Ready, and without a processor for all of it.
    watch = Stopwatch()
    delay = waiting_module._delay
    monkeypatch.setattr(waiting_module, "_delay", lambda path: delay(path) + 0.3)
    time.sleep(0.3)
    assert watch.seconds(1.0) < slept


def _compute(seconds: float) -> None:
    ends = time.process_time() + seconds
    while time.process_time() < ends:
        pass


def _handlers() -> list:
    return [signal.getsignal(number) for number in (signal.SIGPROF, signal.SIGALRM)]
