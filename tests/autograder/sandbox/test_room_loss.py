"""What ends a room, what does not, and that nothing is left of it."""

import os
import select
import shutil
import sys
from textwrap import indent

import pytest

from autograder.protocol import Call
from autograder.sandbox import bubblewrap
from autograder.sandbox import room as sandbox
from autograder.sandbox.room import Room, RoomLostError, StarvedError, TooLongError
from autograder.sandbox.ways import Way
from tests.autograder.sandbox.rooms import (
    COLD_AT_NIGHT,
    EVERY_WAY,
    failed,
    gone,
    printed,
    processes_with,
    sleeper,
)

# What stops a loop, ignored.
DEAF = (
    "import signal\n"
    "for number in (signal.SIGALRM, signal.SIGPROF): signal.signal(number, signal.SIG_IGN)\n"
)


@EVERY_WAY
class TestLoss:
    @pytest.mark.parametrize(
        "source",
        [
            "import os\nos._exit(0)",
            "import os, signal\nos.kill(os.getpid(), signal.SIGKILL)",
            "import ctypes\nctypes.string_at(0)",
        ],
    )
    def test_a_process_that_ends_itself_is_a_lost_room(self, way, source):
        with Room(way) as room, pytest.raises(RoomLostError, match="it ended"):
            room.run(source)

    def test_a_process_that_ends_later_is_a_lost_room(self, way):
        with Room(way) as room:
            room.run("import os, threading\nthreading.Timer(1.0, os._exit, [0]).start()")
            assert select.select([room._process.replies], [], [], 60)[0]  # its end is read there
            with pytest.raises(RoomLostError):
                room.ask([Call("f", ())])

    def test_silence_is_a_lost_room(self, way, monkeypatch):
        monkeypatch.setattr(sandbox, "GRACE_SECONDS", 0.3)
        with Room(way) as room, pytest.raises(StarvedError, match="no reply within"):
            room.run("import os, signal\nos.kill(os.getpid(), signal.SIGSTOP)", seconds=0.1)

    def test_code_that_ignores_its_limit_is_a_lost_room(self, way, monkeypatch):
        monkeypatch.setattr(sandbox, "GRACE_SECONDS", 0.3)
        # By the clock it would take far longer.
        monkeypatch.setattr(sandbox, "PATIENCE", 1000.0)
        match = r"no reply within 0\.9 s of processor time"
        with Room(way) as room, pytest.raises(TooLongError, match=match):
            room.run(f"{DEAF}while True: pass", seconds=0.2)

    def test_a_call_that_ignores_its_limit_costs_no_more_than_one(self, way, monkeypatch):
        monkeypatch.setattr(sandbox, "GRACE_SECONDS", 0.3)
        monkeypatch.setattr(sandbox, "CALL_SECONDS", 0.2)
        monkeypatch.setattr(sandbox, "PATIENCE", 1000.0)
        with Room(way) as room:
            room.run(
                f"def f(n):\n    if n < 3: return n\n{indent(DEAF, '    ')}    while True: pass"
            )
            with pytest.raises(TooLongError, match=r"no reply within 0\.5 s"):
                room.ask([Call("f", (float(n),)) for n in range(24)])

    def test_calls_end_with_the_time_they_have_together(self, way):
        with Room(way) as room:
            room.run("import time\ndef f():\n    time.sleep(0.1)\n    return 1")
            with pytest.raises(RoomLostError, match="no reply within 0"):
                room.ask([Call("f", ())] * 24, idle=0.35)

    def test_a_process_that_does_not_read_is_a_lost_room(self, way, monkeypatch):
        monkeypatch.setattr(sandbox, "GRACE_SECONDS", 0.3)
        # Answers by itself, then stays in its cell.
        stop = (
            f"import os, time\n{DEAF}"
            "for fd in (3, 4):\n"
            "    try: os.write(fd, b'{\"outputs\": []}\\n')\n"
            "    except OSError: pass\n"
            "time.sleep(60)"
        )
        with Room(way) as room:
            room.run(stop)
            with pytest.raises(RoomLostError, match="stopped listening"):
                room.run("#" * (1 << 20))

    def test_endless_reply_is_cut_off(self, way, monkeypatch):
        monkeypatch.setattr(sandbox, "MOST_BYTES", 1 << 20)
        flood = (
            "import os\nwhile True:\n    for fd in (3, 4):\n"
            "        try: os.write(fd, b'x' * 65536)\n        except OSError: pass"
        )
        with Room(way) as room, pytest.raises(RoomLostError, match="too much"):
            room.run(flood)

    def test_output_bomb_stays_inside(self, room):
        (output,) = room.run("for _ in range(100):\n    print('x' * 10**6)")
        assert len(output["text"]) <= 200_000
        assert printed(room, "print('alive')") == "alive"

    def test_memory_bomb_stays_inside(self, way):
        bomb = "kept = []\nwhile True:\n    kept.append(bytes(1 << 30))"
        with Room(way) as room:
            assert failed(room, bomb).startswith("MemoryError")

    def test_file_bomb_stays_inside(self, room):
        bomb = (
            "import signal, tempfile\nsignal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
            "with tempfile.TemporaryFile() as file:\n"
            "    for _ in range(100): file.write(bytes(1 << 20))"
        )
        assert failed(room, bomb).startswith("OSError: [Errno 2")


@COLD_AT_NIGHT
class TestRubbish:
    """What a student's code writes where the room's replies go."""

    @pytest.mark.parametrize(
        "rubbish",
        [
            "b'\\xff\\xfe\\n'",
            "b'null\\n[]\\n1\\n'",
            "b'[' * 10**5 + b'\\n'",
            "b'{\"outputs\": [1, null]}\\n' * 9",
            'b\'{"outputs": {"a": 1}, "replies": 3}\\n\' * 9',
            'b\'{"outputs": [], "replies": []}\\n\' * 9',
            'b\'{"outputs": [], "replies": [null, 1, {"value": "x"}]}\\n\' * 9',
        ],
    )
    def test_rubbish_on_any_descriptor_is_at_worst_a_lost_room(self, way, rubbish):
        source = (
            "import os, glob\n"
            "for name in glob.glob('/proc/[0-9]*/fd/*') if WALLED else []:\n"
            "    try: os.write(os.open(name, os.O_WRONLY | os.O_NONBLOCK), RUBBISH)\n"
            "    except OSError: pass\n"
            "for fd in range(64):\n"
            "    try: os.write(fd, RUBBISH)\n"
            "    except OSError: pass\n"
        ).replace("RUBBISH", rubbish)
        # Without walls these would be every process of this user.
        source = source.replace("WALLED", str(way.walled))
        with Room(way) as room:
            try:
                for output in room.run(source):
                    assert isinstance(output, dict)
                for reply in room.ask([Call("f", ())] * 3):
                    assert (reply.value is None) != (reply.fault is None)
            except RoomLostError:
                pass

    @pytest.mark.parametrize(
        "forged",
        [
            'b\'{"reply": {"value": [\' + b"[]," * 250_000 + b"[]]}}\\n"',
            'b\'{"reply": {"value": \' + b" " * 2_000_000 + b"1}}\\n"',
        ],
        ids=["values", "bytes"],
    )
    def test_a_forged_reply_is_no_larger_than_the_numbers_asked_for(self, way, forged):
        source = (
            "import os\n"
            "def f():\n"
            "    for fd in (3, 4):\n"
            f"        try: left = {forged}\n"
            "        except OSError: continue\n"
            "        try:\n"
            "            while left: left = left[os.write(fd, left):]\n"
            "        except OSError: pass"
        )
        with Room(way) as room:
            room.run(source)
            with pytest.raises(RoomLostError, match="too much"):
                room.ask([Call("f", ())])

    def test_forged_outputs_hold_no_more_values_than_real_ones(self, way):
        source = (
            "import os\n"
            "left = b'{\"outputs\": [' + b'[],' * 1_100_000 + b'[]]}\\n'\n"
            "for fd in (3, 4):\n"
            "    try:\n"
            "        while left: left = left[os.write(fd, left):]\n"
            "    except OSError: pass"
        )
        with Room(way) as room, pytest.raises(RoomLostError, match="too much"):
            room.run(source)

    def test_forged_outputs_are_bounded(self, way):
        forge = "import os\nfor fd in (3, 4):\n    try: os.write(fd, b'{\"outputs\": [' + "
        forge += "b'{},' * 9999 + b'{}]}\\n')\n    except OSError: pass"
        with Room(way) as room:
            assert len(room.run(forge)) <= sandbox.MOST_OUTPUTS


@EVERY_WAY
class TestProcesses:
    """Of a cell's or a call's own, in whatever session."""

    START = (
        "import os, subprocess, sys\n"
        "def start(mark):\n"
        "    code = 'import time; time.sleep(99)'\n"
        "    subprocess.Popen([sys.executable, '-c', code, mark], start_new_session=True)\n"
        "    if os.fork() == 0:\n"
        "        os.setsid()\n"
        "        if os.fork() == 0: os.execv(sys.executable, ['python', '-c', code, mark])\n"
        "        os._exit(0)\n"
        "    os.wait()\n"
        "    while len(open(f'/proc/self/task/{os.getpid()}/children').read().split()) > 1: pass\n"
        "    return 1\n"
    )

    def test_none_is_left_after_its_cell(self, room):
        mark = f"mark-{os.urandom(8).hex()}"
        room.run(f"{self.START}start({mark!r})")
        assert not processes_with(mark)
        assert printed(room, "print('alive')") == "alive"

    def test_none_is_left_after_its_call(self, room):
        mark = f"mark-{os.urandom(8).hex()}"
        room.run(f"{self.START}def f(): return start({mark!r})")
        assert room.ask([Call("f", ())])[0].value == 1.0
        assert not processes_with(mark)

    def test_their_time_is_the_rooms_also_when_they_have_ended(self, room):
        before = room.used
        # Waited for by their parent, by nobody, and left as orphans.
        room.run(
            "import os, time\n"
            "running, end = os.pipe()\n"
            "def spin(seconds):\n"
            "    while time.process_time() < seconds: pass\n"
            "    os._exit(0)\n"
            "if os.fork() == 0: spin(0.4)\n"
            "os.wait()\n"
            "if os.fork() == 0: spin(0.4)\n"
            "if os.fork() == 0:\n"
            "    if os.fork() == 0: spin(0.4)\n"
            "    os._exit(0)\n"
            "os.close(end)\n"
            "os.read(running, 1)"
        )
        assert 1.0 < room.used - before < 2.0

    def test_those_that_spin_end_their_cell_together(self, way, monkeypatch):
        monkeypatch.setattr(sandbox, "GRACE_SECONDS", 0.5)
        monkeypatch.setattr(sandbox, "PATIENCE", 1000.0)
        forks = (
            f"{DEAF}import os, time\nfor _ in range(9):\n    if os.fork() == 0: break\nwhile True: "
        )
        with Room(way) as room:
            with pytest.raises(TooLongError, match=r"no reply within 1\.1 s of processor time"):
                room.run(f"{forks}time.sleep(1) if _ == 8 else None", seconds=0.2)
            assert room.used < 4


@EVERY_WAY
def test_children_end_with_a_room_that_ends_itself(way):
    mark = f"mark-{os.urandom(8).hex()}"
    with Room(way) as room, pytest.raises(RoomLostError):
        room.run(
            "import os, subprocess, sys, time\n"
            f"subprocess.Popen({sleeper(mark)})\ntime.sleep(0.2)\nos._exit(0)"
        )
    assert gone(mark)


@EVERY_WAY
def test_closing_twice_does_nothing(way):
    room = Room(way)
    room.close()
    assert room.closed
    room.close()


@pytest.mark.parametrize(
    "way", [Way.COLD, Way.UNWALLED, Way.UNWALLED_COLD], indirect=True, ids=lambda way: way.name
)
def test_folder_goes_with_the_room(way):
    with Room(way) as room:
        folder = room._process.folder
        room.run("open('mine', 'w').write('x')")
        assert folder.exists()
    assert not folder.exists()


def test_a_sandbox_that_does_not_start_is_not_blamed_on_the_student(monkeypatch):
    monkeypatch.setattr(sys, "executable", shutil.which("false"))
    with pytest.raises(OSError, match="the sandbox did not start: it ended"):
        Room(Way.UNWALLED_COLD)


def test_missing_bubblewrap_is_warned_of_once(monkeypatch, caplog):
    monkeypatch.setenv("PATH", "")
    bubblewrap.has_bubblewrap.cache_clear()
    try:
        assert not bubblewrap.has_bubblewrap()
        assert not bubblewrap.has_bubblewrap()
    finally:
        bubblewrap.has_bubblewrap.cache_clear()
    (record,) = caplog.records
    assert "NOT shut off from your files, the network" in record.getMessage()
