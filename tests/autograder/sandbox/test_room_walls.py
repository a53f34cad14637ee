"""What bubblewrap keeps from a room: the machine's files, network and processes."""

import os
import socket
import sys
from pathlib import Path

import pytest

from autograder.sandbox import bubblewrap, nursery
from autograder.sandbox.bubblewrap import (
    HERE,
    INSIDE,
    alternatives,
    java_settings,
    loaders_list,
    python_folders,
    python_links,
)
from autograder.sandbox.room import Room
from tests.autograder.sandbox.rooms import WALLED_WAYS, failed, gone, printed, sleeper

ROOT = Path(__file__).parents[3]


@WALLED_WAYS
class TestWalls:
    """What only bubblewrap gives."""

    def test_children_that_leave_the_session_end_with_their_cell(self, way):
        mark = f"mark-{os.urandom(8).hex()}"
        with Room(way) as room:
            source = (
                "import glob, os, sys, time\n"
                "if os.fork() == 0:\n"
                "    os.setsid()\n"
                "    if os.fork() == 0:\n"
                f"        os.execv(sys.executable, {sleeper(mark)})\n"
                "    os._exit(0)\n"
                "def lives():\n"
                "    commands = [open(path).read() for path in glob.glob('/proc/[0-9]*/cmdline')]\n"
                f"    return any({mark!r} in command for command in commands)\n"
                "while not lives(): time.sleep(0.02)\n"
                "print('it lives')"
            )
            assert printed(room, source) == "it lives"
            assert gone(mark)  # with its cell

    def test_no_network(self, room):
        with socket.create_server(("127.0.0.1", 0)) as server:
            port = server.getsockname()[1]
            socket.create_connection(("127.0.0.1", port), timeout=1).close()
            said = failed(
                room,
                f"import socket\nsocket.create_connection(('127.0.0.1', {port}), timeout=1)",
            )
        assert said.startswith(("ConnectionRefusedError", "OSError: [Errno 101]"))
        assert printed(room, "print([name for _, name in socket.if_nameindex()])") == "['lo']"

    def test_unprivileged_user(self, room):
        assert printed(room, "import os\nprint(os.getuid(), os.getgid())") == "65534 65534"
        assert failed(room, "os.setuid(0)").startswith(("PermissionError", "OSError"))

    @pytest.mark.parametrize(
        "path",
        [
            ROOT / "autograder" / "judging" / "check.py",
            ROOT / "solutions",
            ROOT / "course",
            ROOT / "lib" / "armdyn" / "__init__.py",
            HERE / "problems",
            Path(__file__),
            Path("/etc/passwd"),
            Path("/var"),
            Path("/run"),
            Path("/sys"),
        ],
        ids=str,
    )
    def test_nothing_of_the_machine_is_there(self, room, path, tmp_path):
        assert printed(room, f"import os\nprint(os.path.exists({str(path)!r}))") == "False"

    @pytest.mark.parametrize("folder", [Path("/home"), Path.home(), ROOT], ids=str)
    def test_homes_and_checkout_hold_no_more_than_python(self, room, folder):
        """Python itself may be installed in either, and comes in alone."""
        name = str(folder)
        listed = printed(
            room,
            f"import os\nprint(*(os.listdir({name!r}) if os.path.exists({name!r}) else []))",
        )
        links = python_links(sys.executable, python_folders())
        python = [Path(inside) for inside in (*python_folders(), *links)]
        for entry in listed.split():
            assert any(inside.is_relative_to(folder / entry) for inside in python)

    def test_home_is_the_room_itself(self, room):
        assert (
            printed(room, "import os; print(os.path.expanduser('~'), os.getcwd())") == "/tmp /tmp"
        )

    def test_no_file_is_there_but_the_system_python_and_the_runner(self, room):
        python = ["/proc", "/dev", "/usr", *python_folders()]
        found = printed(
            room,
            "import os\n"
            "found = []\n"
            "for at, folders, files in os.walk('/'):\n"
            f"    folders[:] = [f for f in folders if os.path.join(at, f) not in {python!r}\n"
            "                  and not f.startswith('.')]\n"
            "    found += [os.path.join(at, name) for name in files]\n"
            "print(*sorted(found))",
        )
        links = python_links(sys.executable, python_folders()) | alternatives()
        runner = [f"/room/{name}" for name in INSIDE.values()]
        assert found.split() == sorted([*runner, *links, *java_settings(), *loaders_list()])

    def test_the_projects_packages_are_not_importable(self, room):
        found = printed(
            room,
            "import glob, sys\n"
            "print([f for path in sys.path for name in ('armdyn', 'autograder')\n"
            "       for f in glob.glob(f'{path}/{name}/**', recursive=True) if f.endswith('.py')])",
        )
        assert found == "[]"

    def test_packages_installed_beside_python_are_covered(self, way, monkeypatch, tmp_path):
        for name in ("armdyn", "autograder", "other"):
            (tmp_path / name).mkdir()
            (tmp_path / name / "judge.py").touch()
        tmp_path.chmod(0o755)  # a grader who is root becomes another user
        monkeypatch.setattr(nursery, "_nurseries", {})
        monkeypatch.setattr(bubblewrap.sysconfig, "get_path", lambda name: str(tmp_path))
        with Room(way) as room:
            found = printed(
                room,
                f"import glob\nprint(*glob.glob('*/*', root_dir={str(tmp_path)!r}))",
            )
        assert found == "other/judge.py"
        nursery.close()

    def test_system_is_read_only(self, room):
        tried = printed(
            room,
            "import os, sys\n"
            "written = []\n"
            "for folder in ('/', '/usr', '/usr/lib', '/room', '/dev', sys.prefix, np.__path__[0]):\n"
            "    try: open(folder + '/mine', 'w'); written.append(folder)\n"
            "    except OSError: pass\n"
            "try: open('/room/protocol.py', 'a'); written.append('protocol.py')\n"
            "except OSError: pass\n"
            "print(written)".replace("np.__path__[0]", "os.__file__.rpartition('/')[0]"),
        )
        assert tried == "[]"

    def test_environment_of_the_parent_is_not_visible(self, way, monkeypatch):
        monkeypatch.setenv("ROOM_TEST_SECRET", "hush-hush")
        with Room(way) as room:
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

    def test_no_process_outside_is_visible(self, room):
        seen = printed(
            room,
            "import glob\n"
            "print(sum(b'pytest' in open(p, 'rb').read() for p in glob.glob('/proc/[0-9]*/cmdline')))",
        )
        assert seen == "0"

    @pytest.mark.parametrize("folder", ["/tmp", "/dev/shm"])
    def test_memory_files_are_full_at_their_size(self, way, folder):
        fill = (
            "n = 0\n"
            "try:\n"
            "    while n < 200:\n"
            f"        open(f'{folder}/{{n}}', 'wb').write(bytes(1 << 20)); n += 1\n"
            "except OSError as error: print(error.errno, n <= 64)"
        )
        with Room(way) as room:
            assert printed(room, fill) == "28 True"

    def test_no_capabilities(self, room):
        status = printed(room, "print(open('/proc/self/status').read())")
        sets = dict(line.split(":\t") for line in status.splitlines() if ":\t" in line)
        for name in ("CapInh", "CapPrm", "CapEff", "CapBnd", "CapAmb"):
            assert int(sets[name], 16) == 0
        assert sets["NoNewPrivs"] == "1"

    def test_open_descriptors_are_the_rooms_own(self, way):
        listed = (
            "import os\n"
            "for fd in range(256):\n"
            "    try: print(os.readlink(f'/proc/self/fd/{fd}').partition(':')[0])\n"
            "    except OSError: pass"
        )
        with Room(way) as room:
            loop = ["anon_inode", "socket", "socket"]  # of the event loop that cells run in
            assert printed(room, listed).split() == ["/dev/null"] * 3 + ["pipe"] * 2 + loop

    @pytest.mark.parametrize(
        "bomb",
        [
            "if os.fork() == 0: time.sleep(99); os._exit(0)",
            "threading.Thread(target=time.sleep, args=(99,), daemon=True).start()",
            "if os.fork() == 0:\n        os.setsid()\n        if os.fork() == 0: time.sleep(99)\n"
            "        os._exit(0)",
        ],
        ids=["forks", "threads", "daemons"],
    )
    def test_fork_bomb_is_stopped(self, way, bomb):
        source = (
            "import os, threading, time\n"
            "started = 0\n"
            "for _ in range(400):\n"
            "  try:\n"
            f"    {bomb}\n"
            "    started += 1\n"
            "  except (OSError, RuntimeError):\n"
            "    break\n"
            "print(started)"
        )
        with Room(way) as room, Room(way) as other:
            assert 20 < int(printed(room, source)) < 64
            alive = "import os\nprint(sum(name.isdigit() for name in os.listdir('/proc')))"
            assert int(printed(room, alive)) <= 66  # bubblewrap's own two are not counted
            # The limit is the room's alone.
            assert printed(other, "import os\nprint(os.system('true'))") == "0"
            with Room(way) as third:
                assert printed(third, "print('alive')") == "alive"


def test_links_to_python_outside_the_environment_are_laid_in_too(tmp_path):
    """As those of a version manager, or of somebody's own folder of programs."""
    own, python = tmp_path / "own" / "python3", tmp_path / "environment" / "bin" / "python"
    for path, target in ((own, "/usr/bin/env"), (python.parent / "python3", own)):
        path.parent.mkdir(parents=True)
        path.symlink_to(target)
    python.symlink_to("python3")
    environment = str(tmp_path / "environment")
    assert python_links(str(python), [environment]) == {str(own): "/usr/bin/env"}
    assert python_links("/usr/bin/env", [environment]) == {}
