"""The room: what a notebook would show comes back, and nothing in it harms what is outside."""

import base64
import os
import shutil
import socket
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from autograder import sandbox
from autograder.sandbox import Room, RoomLostError
from autograder.wall import Call, Fault, FaultKind, Symbol

ROOT = Path(__file__).parents[2]
WALLS = pytest.mark.parametrize("walls", ["bubblewrap", "none"], indirect=True)


@pytest.fixture(scope="module")
def rooms():
    """One room of each kind, which most tests share: a room must outlive a student's faults."""
    rooms = {}
    yield rooms
    for room in rooms.values():
        room.close()


@pytest.fixture
def walls(request, needs) -> bool:
    """Whether the rooms of this test are walled by bubblewrap."""
    if request.param == "bubblewrap":
        needs("bubblewrap")
    return request.param == "bubblewrap"


@pytest.fixture
def room(rooms, walls):
    return living(rooms, walls)


@pytest.fixture
def walled(rooms, needs):
    needs("bubblewrap")
    return living(rooms, True)


def living(rooms, walls):
    # A test that loses the room fails by itself, and takes no other along.
    if walls not in rooms or rooms[walls]._process.returncode is not None:
        rooms[walls] = Room(bubblewrap=walls)
    return rooms[walls]


def printed(room, source: str) -> str:
    """What the cell printed; it must do nothing else."""
    (output,) = room.run(source)
    assert (output["output_type"], output["name"]) == ("stream", "stdout")
    return output["text"].strip()


def failed(room, source: str, seconds: float = 10.0) -> str:
    """The error of a cell, after which the room still lives."""
    error = room.run(source, seconds)[-1]
    assert error["output_type"] == "error"
    assert printed(room, "print('alive')") == "alive"
    return f"{error['ename']}: {error['evalue']}"


def sleeper(mark: str) -> str:
    """The arguments, in a student's source, of a process that carries `mark` and outlives the test."""
    return f"[sys.executable, '-c', 'import time; time.sleep(99)', {mark!r}]"


def processes_with(mark: str) -> list[int]:
    """The processes on this machine that have `mark` in their command line."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            command = (entry / "cmdline").read_bytes()
        except OSError:
            continue
        if mark.encode() in command and entry.name != str(os.getpid()):
            found.append(int(entry.name))
    return found


def appears(mark: str) -> bool:
    """Whether a process carries `mark`: a child that was just started has no command line yet."""
    return eventually(lambda: processes_with(mark))


def gone(mark: str) -> bool:
    """Whether no process carries `mark`, at the latest when the system has cleaned up."""
    return eventually(lambda: not processes_with(mark))


def eventually(met) -> bool:
    for _ in range(200):
        if met():
            return True
        time.sleep(0.05)
    return False


@WALLS
class TestOutputs:
    def test_prints_go_to_their_streams(self, room):
        outputs = room.run("import sys\nprint('out')\nprint('err', file=sys.stderr)")
        assert outputs == [
            {"output_type": "stream", "name": "stdout", "text": "out\n"},
            {"output_type": "stream", "name": "stderr", "text": "err\n"},
        ]

    def test_quiet_cell_shows_nothing(self, room):
        assert room.run("x = 1") == []
        assert room.run("") == []

    def test_last_expression_is_shown(self, room):
        assert "42" in str(room.run("6 * 7"))

    def test_error_has_its_traceback(self, room):
        *_, error = room.run("print('before')\ndef f():\n    return 1 / 0\nf()")
        assert (error["ename"], error["evalue"]) == ("ZeroDivisionError", "division by zero")
        assert "return 1 / 0" in "\n".join(error["traceback"])
        assert "\x1b" not in "\n".join(error["traceback"])

    def test_syntax_error_names_its_line(self, room):
        said = failed(room, "x = 1\ndef f(q)\n    return q")
        assert said == "SyntaxError: expected ':', line 2: def f(q)"
        assert failed(room, "  x = 1\n y = 2").startswith("IndentationError: ")

    def test_display_gives_text_and_latex_but_no_html(self, room):
        (output,) = room.run(
            "class A:\n"
            "    def __repr__(self): return 'plain'\n"
            "    def _repr_latex_(self): return '$q$'\n"
            "    def _repr_html_(self): return '<script>alert(1)</script>'\n"
            "    def _repr_javascript_(self): return 'alert(1)'\n"
            "display(A())"
        )
        assert output["data"] == {"text/plain": "plain", "text/latex": "$q$"}

    def test_figures_are_png(self, room):
        outputs = room.run("import matplotlib.pyplot as plt\nplt.plot([0, 1])\nplt.show()")
        pictures = [
            out["data"]["image/png"] for out in outputs if "image/png" in out.get("data", {})
        ]
        assert len(pictures) == 1
        assert base64.b64decode(pictures[0]).startswith(b"\x89PNG")
        assert not any("image/png" in str(out) for out in room.run("1"))

    def test_raw_bytes_of_a_picture_are_encoded(self, room):
        (output,) = room.run(
            "class A:\n    def _repr_png_(self): return b'\\x89PNG raw'\ndisplay(A())"
        )
        assert base64.b64decode(output["data"]["image/png"]) == b"\x89PNG raw"

    def test_input_says_that_nobody_answers(self, room):
        said = failed(room, "x = input('m = ')")
        assert said == ("RuntimeError: input() asks for something while nobody is there to answer")

    def test_long_output_is_cut(self, room):
        (output,) = room.run("print('x' * 10**6)")
        assert 10**5 < len(output["text"]) <= 200_000

    def test_half_a_surrogate_pair_is_replaced(self, room):
        assert printed(room, "print('a\\ud800b')") == "a?b"
        assert failed(room, "raise ValueError('\\udfff')") == "ValueError: ?"
        assert printed(room, "print('\\U0001f600')") == "\U0001f600"


@WALLS
class TestCells:
    def test_cells_share_their_names(self, room):
        room.run("m = 3")
        assert printed(room, "print(m, __name__)") == "3 __main__"

    def test_top_level_loop_costs_its_limit_and_the_room_lives_on(self, room):
        room.run("kept = 5")
        start = time.monotonic()
        said = failed(room, "while True:\n    pass", seconds=0.5)
        assert said == "TimeoutError: this cell ran longer than 0.5 s"
        assert time.monotonic() - start < 3  # under the grace that ends a room
        assert printed(room, "print(kept)") == "5"

    @pytest.mark.parametrize(
        ("source", "error"),
        [
            ("raise SystemExit(0)", "SystemExit: 0"),
            ("raise KeyboardInterrupt", "KeyboardInterrupt: "),
            ("class E(BaseException): pass\nraise E('own')", "E: own"),
            ("class E(Exception):\n    def __str__(self): 1 / 0\nraise E", "E: (a message"),
            ("class E(Exception):\n    def __repr__(self): 1 / 0\nE()", "ZeroDivisionError: "),
            ("%no_such_magic", "UsageError: "),
        ],
    )
    def test_no_error_ends_the_room(self, room, source, error):
        outputs = room.run(source)
        assert printed(room, "print('alive')") == "alive"
        said = [f"{out['ename']}: {out['evalue']}" for out in outputs if "ename" in out]
        assert said == [] or said[0].startswith(error)
        assert outputs

    def test_armdyn_and_autograder_are_stubs(self, room):
        said = failed(room, "from armdyn.models import Pendulum")
        assert said.startswith("ImportError: armdyn holds the formulas that this problem asks for")
        assert room.run("from autograder import check\ncheck('p3-M')\ncheck('x', fresh=True)") == []
        assert failed(room, "import autograder.judge").startswith("ModuleNotFoundError")
        assert failed(room, "from autograder.problems import CHECKS").startswith("ModuleNotFound")


@WALLS
class TestCalls:
    def test_numbers_come_back(self, room):
        room.run("import numpy as np\ndef f(q, pend): return pend.m * np.sin(q)")
        calls = [Call("f", (np.array([a]), SimpleNamespace(m=2.0))) for a in (0.1, 0.2)]
        for call, reply in zip(calls, room.ask(calls), strict=True):
            np.testing.assert_array_equal(reply.value, 2 * np.sin(call.args[0]))

    def test_expressions_are_evaluated_inside(self, room):
        room.run("import sympy as sp\ndef L(q): return sp.sin(q) + 1")
        (reply,) = room.ask([Call("L", (Symbol("q"),), ({"q": 0.0}, {"q": np.pi / 2}))])
        np.testing.assert_allclose(reply.value, [1.0, 2.0])

    def test_prints_and_warnings_of_a_call_do_not_mix_with_its_numbers(self, room):
        room.run(
            "import os, sys, warnings, numpy as np\n"
            "def f():\n"
            "    print('{\"replies\": []}'); sys.__stdout__.write('x\\n'); os.write(1, b'x\\n')\n"
            "    warnings.warn('w'); os.system('echo x')\n"
            "    return 1 + 0 * np.log(np.zeros(1) + 1)"
        )
        assert room.ask([Call("f", ())])[0].value == 1.0

    def test_faults_name_the_students_line(self, room):
        room.run("def f(q):\n    r = 1\n    return q / 0")
        assert room.ask([Call("f", (1.0,))] * 3)[0].fault == Fault(
            FaultKind.RAISED, "ZeroDivisionError: float division by zero", "line 3: return q / 0"
        )

    def test_slow_calls_that_keep_their_own_limit_are_answered(self, room, monkeypatch):
        monkeypatch.setattr(sandbox, "GRACE_SECONDS", 0.0)
        monkeypatch.setattr(sandbox, "CELL_SECONDS", 0.1)
        room.run("import time\ndef f():\n    time.sleep(0.2)\n    return 1", seconds=10.0)
        assert [reply.fault for reply in room.ask([Call("f", ())] * 3)] == [None] * 3


@WALLS
class TestLoss:
    @pytest.mark.parametrize(
        "source",
        [
            "import os\nos._exit(0)",
            "import os, signal\nos.kill(os.getpid(), signal.SIGKILL)",
            "import ctypes\nctypes.string_at(0)",
        ],
    )
    def test_a_process_that_ends_itself_is_a_lost_room(self, walls, source):
        with Room(bubblewrap=walls) as room, pytest.raises(RoomLostError, match="it ended"):
            room.run(source)

    def test_a_process_that_ends_later_is_a_lost_room(self, walls):
        with Room(bubblewrap=walls) as room:
            room.run("import os, threading\nthreading.Timer(0.2, os._exit, [0]).start()")
            time.sleep(0.6)
            with pytest.raises(RoomLostError):
                room.ask([Call("f", ())])

    def test_silence_is_a_lost_room(self, walls, monkeypatch):
        monkeypatch.setattr(sandbox, "GRACE_SECONDS", 0.3)
        deaf = "import signal\nsignal.signal(signal.SIGALRM, signal.SIG_IGN)\nwhile True: pass"
        with Room(bubblewrap=walls) as room, pytest.raises(RoomLostError, match="no reply within"):
            room.run(deaf, seconds=0.2)

    def test_a_process_that_does_not_read_is_a_lost_room(self, walls, monkeypatch):
        monkeypatch.setattr(sandbox, "GRACE_SECONDS", 0.3)
        # Answers by itself, then stays in its cell.
        stop = (
            "import os, signal, time\n"
            "signal.signal(signal.SIGALRM, signal.SIG_IGN)\n"
            "for fd in (3, 4):\n"
            "    try: os.write(fd, b'{\"outputs\": []}\\n')\n"
            "    except OSError: pass\n"
            "time.sleep(60)"
        )
        with Room(bubblewrap=walls) as room:
            room.run(stop)
            with pytest.raises(RoomLostError, match="stopped listening"):
                room.run("#" * (1 << 20))

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
    def test_rubbish_on_any_descriptor_is_at_worst_a_lost_room(self, walls, rubbish):
        source = (
            "import os, glob\n"
            "for name in glob.glob('/proc/[0-9]*/fd/*') if os.getuid() else []:\n"
            "    try: os.write(os.open(name, os.O_WRONLY | os.O_NONBLOCK), RUBBISH)\n"
            "    except OSError: pass\n"
            "for fd in range(64):\n"
            "    try: os.write(fd, RUBBISH)\n"
            "    except OSError: pass\n"
        ).replace("RUBBISH", rubbish)
        with Room(bubblewrap=walls) as room:
            try:
                for output in room.run(source):
                    assert isinstance(output, dict)
                for reply in room.ask([Call("f", ())] * 3):
                    assert (reply.value is None) != (reply.fault is None)
            except RoomLostError:
                pass

    def test_endless_reply_is_cut_off(self, walls, monkeypatch):
        monkeypatch.setattr(sandbox, "MOST_BYTES", 1 << 20)
        flood = (
            "import os\nwhile True:\n    for fd in (3, 4):\n"
            "        try: os.write(fd, b'x' * 65536)\n        except OSError: pass"
        )
        with Room(bubblewrap=walls) as room, pytest.raises(RoomLostError, match="too much"):
            room.run(flood)

    def test_forged_outputs_are_bounded(self, walls):
        forge = "import os\nfor fd in (3, 4):\n    try: os.write(fd, b'{\"outputs\": [' + "
        forge += "b'{},' * 9999 + b'{}]}\\n')\n    except OSError: pass"
        with Room(bubblewrap=walls) as room:
            assert len(room.run(forge)) <= sandbox.MOST_OUTPUTS

    def test_output_bomb_stays_inside(self, room):
        (output,) = room.run("for _ in range(100):\n    print('x' * 10**6)")
        assert len(output["text"]) <= 200_000
        assert printed(room, "print('alive')") == "alive"

    def test_memory_bomb_stays_inside(self, walls):
        bomb = "kept = []\nwhile True:\n    kept.append(bytes(1 << 30))"
        with Room(bubblewrap=walls) as room:
            assert failed(room, bomb).startswith("MemoryError")

    def test_file_bomb_stays_inside(self, room):
        bomb = (
            "import signal, tempfile\nsignal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
            "with tempfile.TemporaryFile() as file:\n"
            "    for _ in range(100): file.write(bytes(1 << 20))"
        )
        assert failed(room, bomb).startswith("OSError: [Errno 2")


@WALLS
def test_children_end_with_the_room(walls):
    mark = f"mark-{os.urandom(8).hex()}"
    with Room(bubblewrap=walls) as room:
        room.run(f"import subprocess, sys\nsubprocess.Popen({sleeper(mark)})")
        assert appears(mark)
    assert gone(mark)


@WALLS
def test_children_end_with_a_room_that_ends_itself(walls):
    mark = f"mark-{os.urandom(8).hex()}"
    with Room(bubblewrap=walls) as room, pytest.raises(RoomLostError):
        room.run(
            "import os, subprocess, sys, time\n"
            f"subprocess.Popen({sleeper(mark)})\ntime.sleep(0.2)\nos._exit(0)"
        )
    assert gone(mark)


@WALLS
def test_folder_goes_with_the_room(walls):
    with Room(bubblewrap=walls) as room:
        folder = Path(room._folder.name)
        room.run("open('mine', 'w').write('x')")
        assert folder.exists()
    assert not folder.exists()
    room.close()  # a second time does nothing


class TestWalls:
    """What only bubblewrap gives."""

    def test_children_that_leave_the_session_end_too(self, needs):
        needs("bubblewrap")
        mark = f"mark-{os.urandom(8).hex()}"
        with Room(bubblewrap=True) as room:
            room.run(
                "import os, sys\n"
                "if os.fork() == 0:\n"
                "    os.setsid()\n"
                "    if os.fork() == 0:\n"
                f"        os.execv(sys.executable, {sleeper(mark)})\n"
                "    os._exit(0)\n"
                "import time; time.sleep(0.3)"
            )
            assert appears(mark)
        assert gone(mark)

    def test_no_network(self, walled):
        with socket.create_server(("127.0.0.1", 0)) as server:
            port = server.getsockname()[1]
            socket.create_connection(("127.0.0.1", port), timeout=1).close()
            said = failed(
                walled,
                f"import socket\nsocket.create_connection(('127.0.0.1', {port}), timeout=1)",
            )
        assert said.startswith(("ConnectionRefusedError", "OSError: [Errno 101]"))
        assert printed(walled, "print([name for _, name in socket.if_nameindex()])") == "['lo']"

    def test_unprivileged_user(self, walled):
        assert printed(walled, "import os\nprint(os.getuid(), os.getgid())") == "65534 65534"
        assert failed(walled, "os.setuid(0)").startswith(("PermissionError", "OSError"))

    @pytest.mark.parametrize(
        "path",
        [
            ROOT / "autograder" / "judge.py",
            ROOT / "solutions",
            ROOT / "course",
            ROOT / "lib" / "armdyn" / "__init__.py",
            sandbox.HERE / "problems",
            Path(__file__),
            Path("/etc/passwd"),
            Path("/home"),
            Path("/var"),
            Path("/run"),
            Path("/sys"),
        ],
        ids=str,
    )
    def test_nothing_of_the_machine_is_there(self, walled, path, tmp_path):
        assert printed(walled, f"import os\nprint(os.path.exists({str(path)!r}))") == "False"

    @pytest.mark.parametrize("folder", [Path.home(), ROOT], ids=str)
    def test_home_and_checkout_hold_no_more_than_python(self, walled, folder):
        """Python itself may be installed in either, and comes in alone."""
        name = str(folder)
        listed = printed(
            walled,
            f"import os\nprint(*(os.listdir({name!r}) if os.path.exists({name!r}) else []))",
        )
        python = [Path(inside) for inside in sandbox._python_folders()]
        for entry in listed.split():
            assert any(inside.is_relative_to(folder / entry) for inside in python)

    def test_home_is_the_room_itself(self, walled):
        assert (
            printed(walled, "import os; print(os.path.expanduser('~'), os.getcwd())") == "/tmp /tmp"
        )

    def test_no_file_is_there_but_the_system_python_and_the_runner(self, walled):
        python = ["/proc", "/dev", "/usr", *sandbox._python_folders()]
        found = printed(
            walled,
            "import os\n"
            "found = []\n"
            "for at, folders, files in os.walk('/'):\n"
            f"    folders[:] = [f for f in folders if os.path.join(at, f) not in {python!r}\n"
            "                  and not f.startswith('.')]\n"
            "    found += [os.path.join(at, name) for name in files]\n"
            "print(*sorted(found))",
        )
        assert found.split() == sorted(f"/room/{name}" for name in sandbox.INSIDE.values())

    def test_the_projects_packages_are_not_importable(self, walled):
        found = printed(
            walled,
            "import glob, sys\n"
            "print([f for path in sys.path for name in ('armdyn', 'autograder')\n"
            "       for f in glob.glob(f'{path}/{name}/**', recursive=True) if f.endswith('.py')])",
        )
        assert found == "[]"

    def test_packages_installed_beside_python_are_covered(self, needs, monkeypatch, tmp_path):
        needs("bubblewrap")
        for name in ("armdyn", "autograder", "other"):
            (tmp_path / name).mkdir()
            (tmp_path / name / "judge.py").touch()
        monkeypatch.setattr(sandbox.sysconfig, "get_path", lambda name: str(tmp_path))
        with Room(bubblewrap=True) as room:
            found = printed(
                room,
                f"import glob\nprint(*glob.glob('*/*', root_dir={str(tmp_path)!r}))",
            )
        assert found == "other/judge.py"

    def test_system_is_read_only(self, walled):
        tried = printed(
            walled,
            "import os, sys\n"
            "written = []\n"
            "for folder in ('/', '/usr', '/usr/lib', '/room', '/dev', sys.prefix, np.__path__[0]):\n"
            "    try: open(folder + '/mine', 'w'); written.append(folder)\n"
            "    except OSError: pass\n"
            "try: open('/room/wall.py', 'a'); written.append('wall.py')\n"
            "except OSError: pass\n"
            "print(written)".replace("np.__path__[0]", "os.__file__.rpartition('/')[0]"),
        )
        assert tried == "[]"

    def test_environment_of_the_parent_is_not_visible(self, needs, monkeypatch):
        needs("bubblewrap")
        monkeypatch.setenv("ROOM_TEST_SECRET", "hush-hush")
        with Room(bubblewrap=True) as room:
            seen = printed(
                room,
                "import glob, os\n"
                "read = 0\n"
                "for name in glob.glob('/proc/[0-9]*/environ'):\n"
                "    try: text = open(name, 'rb').read(); read += 1\n"
                "    except OSError: continue\n"
                "    assert b'hush' not in text, name\n"
                "print(read > 0, 'ROOM_TEST_SECRET' in os.environ)",
            )
        assert seen == "True False"

    def test_no_process_outside_is_visible(self, walled):
        seen = printed(
            walled,
            "import glob\n"
            "print(sum(b'pytest' in open(p, 'rb').read() for p in glob.glob('/proc/[0-9]*/cmdline')))",
        )
        assert seen == "0"

    @pytest.mark.parametrize("folder", ["/tmp", "/dev/shm"])
    def test_memory_files_are_full_at_their_size(self, needs, folder):
        needs("bubblewrap")
        fill = (
            "n = 0\n"
            "try:\n"
            "    while n < 200:\n"
            f"        open(f'{folder}/{{n}}', 'wb').write(bytes(1 << 20)); n += 1\n"
            "except OSError as error: print(error.errno, n <= 64)"
        )
        with Room(bubblewrap=True) as room:
            assert printed(room, fill) == "28 True"


def test_a_sandbox_that_does_not_start_is_not_blamed_on_the_student(monkeypatch):
    monkeypatch.setattr(sys, "executable", shutil.which("false"))
    with pytest.raises(OSError, match="the sandbox did not start: it ended"):
        Room(bubblewrap=False)


def test_missing_bubblewrap_is_warned_of_once(monkeypatch, caplog):
    monkeypatch.setenv("PATH", "")
    sandbox.has_bubblewrap.cache_clear()
    try:
        assert not sandbox.has_bubblewrap()
        assert not sandbox.has_bubblewrap()
    finally:
        sandbox.has_bubblewrap.cache_clear()
    (record,) = caplog.records
    assert "NOT shut off from files and network" in record.getMessage()
