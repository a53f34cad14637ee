"""The warm way: forks of one process that know nothing of each other, and end with it."""

import os
import signal
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from autograder.sandbox import nursery, ways
from autograder.sandbox import room as sandbox
from autograder.sandbox.room import Room
from autograder.sandbox.ways import Way
from tests.autograder.descendants import below
from tests.autograder.eventually import eventually
from tests.autograder.sandbox.rooms import (
    appears,
    failed,
    gone,
    printed,
    sleeper,
)

ROOT = Path(__file__).parents[3]


WALLED = pytest.mark.parametrize("way", [Way.WARM], indirect=True, ids=["WARM"])
EITHER = pytest.mark.parametrize(
    "way", [Way.WARM, Way.UNWALLED], indirect=True, ids=lambda way: way.name
)


@pytest.fixture
def pair(way):
    """Two rooms at once."""
    with Room(way) as one, Room(way) as other:
        yield one, other


@pytest.fixture
def own_nursery(monkeypatch, way):
    """A warm process for this test alone; what gives it."""
    monkeypatch.setattr(nursery, "_nurseries", {})
    yield lambda: nursery._nurseries[way]
    nursery.close()


@WALLED
class TestApart:
    """Nothing of one room is there in another."""

    @pytest.mark.parametrize("folder", ["/tmp", "/dev/shm"])
    def test_files(self, pair, folder, way):
        one, other = pair
        one.run(f"open('{folder}/mine', 'w').write('42')")
        assert "mine" in printed(one, f"import os\nprint(os.listdir('{folder}'))")
        assert "mine" not in printed(other, f"import os\nprint(os.listdir('{folder}'))")
        with Room(way) as later:
            assert "mine" not in printed(later, f"import os\nprint(os.listdir('{folder}'))")

    def test_processes(self, pair):
        listed = "import os\nprint(*sorted(int(p) for p in os.listdir('/proc') if p.isdigit()))"
        for room in pair:
            assert printed(room, listed) == "1 2"

    def test_terminals(self, pair):
        one, other = pair
        assert printed(one, "import os\nends = os.openpty()\nprint(os.ttyname(ends[1]))")
        assert printed(other, "import os\nprint(os.listdir('/dev/pts'))") == "['ptmx']"

    def test_sockets(self, pair):
        one, other = pair
        one.run("import socket\ns = socket.socket(socket.AF_UNIX)\ns.bind('\\0mine'); s.listen()")
        connect = "import socket\nsocket.socket(socket.AF_UNIX).connect('\\0mine')"
        assert one.run(connect) == []
        assert failed(other, connect).startswith("ConnectionRefusedError")

    def test_shared_memory_of_system_v(self, pair):
        ask = "import ctypes\nprint(ctypes.CDLL(None).shmget(77, 4096, {}))"
        one, other = pair
        assert printed(one, ask.format(0o1666)) != "-1"
        assert printed(one, ask.format(0)) != "-1"
        assert printed(other, ask.format(0)) == "-1"


@EITHER
class TestAlike:
    """Each room begins as the first did."""

    def test_modules_changed_by_one_are_whole_in_the_other(self, pair, way):
        one, other = pair
        one.run(
            "import builtins, numpy as np, sympy\n"
            "np.sin = sympy.sin = builtins.abs = None\n"
            "np.pi = 3"
        )
        seen = "import numpy as np, sympy\nprint(np.sin(0.0), sympy.sin(0), abs(-1), np.pi > 3)"
        with Room(way) as later:
            for room in (other, later):
                assert printed(room, seen) == "0.0 0 1 True"

    def test_what_ipython_stores_is_the_rooms_own(self, pair):
        one, other = pair
        one.run("x = 3")
        one.run("%store x")
        other.run("%store -r x")
        assert printed(one, "del x\n%store -r x\nprint(x)") == "3"
        assert printed(other, "print('x' in globals())") == "False"

    def test_random_numbers_are_the_same_in_each(self, pair):
        draw = (
            "import random, numpy as np, sympy\n"
            "print(random.random(), np.random.rand(), sympy.Dummy('x').dummy_index, hash('x'))"
        )
        one, other = pair
        seen = printed(one, draw)
        assert printed(one, draw) != seen
        assert printed(other, draw) == seen

    def test_a_new_warm_process_draws_the_same_numbers(self, pair, own_nursery, way):
        draw = "import numpy as np, sympy\nprint(np.random.rand(), sympy.Dummy().dummy_index)"
        with Room(way) as room:
            assert printed(room, draw) == printed(pair[0], draw)

    def test_a_figure_a_simplified_sum_and_an_error_load_nothing(self, way):
        with Room(way) as room:
            room.run("import inspect, sys, sympy, matplotlib.pyplot as plt\nq = sympy.Symbol('q')")
            room.run("before = set(sys.modules), len(inspect.modulesbyfile)")
            room.run("plt.plot([0, 1])")
            room.run("sympy.simplify(q + sympy.sin(q) ** 2 + sympy.cos(q) ** 2)")
            assert failed(room, "1 / 0").startswith("ZeroDivisionError")
            assert printed(room, "print(set(sys.modules) - before[0])") == "set()"
            # Before an error is shown, Python looks up the files of all modules.
            assert printed(room, "print(len(inspect.modulesbyfile) < 1.1 * before[1])") == "True"


@WALLED
class TestRights:
    def test_no_namespaces_within(self, pair):
        new_user = "import ctypes\nprint(ctypes.CDLL(None).unshare(0x10000000))"
        assert printed(pair[0], new_user) == "-1"

    def test_the_first_process_is_out_of_reach(self, pair):
        room, _ = pair
        room.run("import os, signal\nfor s in range(1, 32): os.kill(1, s)")
        assert printed(room, "print('alive')") == "alive"
        assert failed(room, "open('/proc/1/mem', 'rb')").startswith("PermissionError")
        assert failed(room, "import os\nos.listdir('/proc/1/fd')").startswith("PermissionError")

    def test_what_covers_the_parents_files_cannot_be_taken_off(self, pair):
        umount = (
            "import ctypes\nprint(*(ctypes.CDLL(None).umount2(f, 2) for f in (b'/tmp', b'/proc')))"
        )
        assert printed(pair[0], umount) == "-1 -1"

    def test_memory_is_given_up_first(self, pair):
        assert printed(pair[0], "print(open('/proc/self/oom_score_adj').read())") == "1000"


@EITHER
class TestLife:
    def test_rooms_leave_nothing_behind(self, pair, way):
        before = below(_own(way)._process.pid)
        for _ in range(5):
            with Room(way) as room:
                room.run("import os\nif os.fork() == 0:\n    import time; time.sleep(99)")
        assert eventually(lambda: below(_own(way)._process.pid) == before)

    def test_no_descriptor_is_left_open_here(self, pair, way):
        before = os.listdir("/proc/self/fd")
        for _ in range(3):
            Room(way).close()
        assert os.listdir("/proc/self/fd") == before

    def test_a_warm_process_that_died_is_started_again(self, own_nursery, way):
        with Room(way) as room:
            first = own_nursery()
            assert printed(room, "print('alive')") == "alive"
            _kill(first, way)
            assert eventually(lambda: not first.alive)
            _assert_orphaned(room)
        with Room(way) as room:
            assert printed(room, "print('alive')") == "alive"
        assert own_nursery() is not first

    def test_a_shared_one_is_used_while_it_lives(self, own_nursery, monkeypatch, way):
        Room(way).close()
        owner = own_nursery()
        monkeypatch.setattr(nursery, "_nurseries", {})
        nursery.use_shared(way, owner.share())
        shared = own_nursery()
        with Room(way) as room:
            assert printed(room, "print('alive')") == "alive"
            assert own_nursery() is shared
            _kill(owner, way)
            assert eventually(lambda: not shared.alive)
            _assert_orphaned(room)
        with Room(way) as room:
            assert printed(room, "print('alive')") == "alive"
        assert own_nursery() is not shared
        owner.close()

    def test_it_outlives_the_thread_that_started_it(self, own_nursery, way):
        thread = threading.Thread(target=lambda: Room(way).close())
        thread.start()
        thread.join()
        first = own_nursery()
        with Room(way) as room:
            assert printed(room, "print('alive')") == "alive"
        assert own_nursery() is first

    def test_threads_share_it(self, way):
        def answer(number):
            with Room(way) as room:
                room.run(f"n = {number}")
                return int(printed(room, "print(n)"))

        with ThreadPoolExecutor(4) as pool:
            assert list(pool.map(answer, range(8))) == list(range(8))

    @pytest.mark.parametrize("end", [signal.SIGKILL, signal.SIGTERM, None])
    def test_everything_ends_with_the_grader(self, end, way):
        mark = f"mark-{os.urandom(8).hex()}"
        code = (
            "import sys\n"
            "from autograder.sandbox.room import Room\n"
            "from autograder.sandbox.ways import Way\n"
            "room = Room(Way[sys.argv[2]])\n"
            "room.run(sys.argv[1])\n"
            "print('ready', flush=True)\n"
            "sys.stdin.read()\n"
        )
        student = f"import subprocess, sys\nsubprocess.Popen({sleeper(mark)})"
        with subprocess.Popen(
            [sys.executable, "-c", code, student, way.name],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            cwd=ROOT,
        ) as grader:
            assert grader.stdout.readline() == b"ready\n"
            assert appears(mark)
            if end:
                grader.send_signal(end)
        assert gone(mark)

    def test_a_fork_of_the_grader_has_its_own(self, way):
        code = (
            "import os, sys\n"
            "from autograder.sandbox import nursery\n"
            "from autograder.sandbox.room import Room\n"
            "from autograder.sandbox.ways import Way\n"
            "way = Way[sys.argv[1]]\n"
            "with Room(way) as room:\n"
            "    pid = os.fork()\n"
            "    if pid == 0:\n"
            "        assert not nursery._nurseries\n"
            "        with Room(way) as own: own.run('1')\n"
            "        nursery.close()\n"
            "        os._exit(7)\n"
            "    assert os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]) == 7\n"
            "    assert room.run('print(1)')[0]['text'] == '1\\n'\n"
        )
        subprocess.run([sys.executable, "-c", code, way.name], check=True, timeout=300, cwd=ROOT)


@EITHER
class TestFallback:
    @pytest.fixture(autouse=True)
    def _walls(self, way, monkeypatch):
        monkeypatch.setattr(ways, "has_bubblewrap", lambda: way.walled)

    def test_rooms_are_warm_by_default(self, way):
        with Room() as room:
            assert room.way is way

    def test_a_cold_room_takes_over_and_the_log_says_why_once(self, monkeypatch, caplog, way):
        def refuse(*args):
            raise OSError("no namespaces today")

        monkeypatch.setattr(nursery, "running", refuse)
        sandbox._works.cache_clear()
        try:
            for _ in range(2):
                with Room() as room:
                    assert room.way is (Way.COLD if way.walled else Way.UNWALLED_COLD)
        finally:
            sandbox._works.cache_clear()
        (record,) = caplog.records
        assert "no namespaces today" in record.getMessage()

    def test_a_warm_process_that_cannot_start_says_why(self):
        command = [sys.executable, "-c", "raise SystemExit('no numpy here')"]
        with pytest.raises(OSError, match="the warm process did not start: no numpy here"):
            nursery.Nursery(command, {})


def _own(way: Way) -> nursery.Nursery:
    return nursery._nurseries[way]


def _kill(nursery, way: Way) -> None:
    """End the process that rooms are forks of."""
    process = max(_warm_processes(nursery)) if way.walled else nursery._process.pid
    os.kill(process, signal.SIGKILL)


def _assert_orphaned(room) -> None:
    """A room whose warm process ended: with walls it went along."""
    if room.way.walled:
        # Not the student's doing, so not RoomLostError.
        with pytest.raises(OSError, match="process that starts the sandboxes"):
            room.run("1")
    else:
        assert printed(room, "print('alive')") == "alive"


def _warm_processes(nursery) -> list[int]:
    """The processes that `nursery` started, the warm one among them, without its rooms."""
    monitor = nursery._process.pid
    with open(f"/proc/{monitor}/task/{monitor}/children") as file:
        return [int(pid) for pid in file.read().split()]
