"""A room of its own for a student's code: a process that can reach nothing but its own memory.

With bubblewrap the process has no network, no home directory, no course folder, none of this
project's files but the runner, and a read-only system. Without it (macOS, some containers) there
are limits on time, memory and file size only, and `Room` says so once.
"""

import json
import logging
import os
import select
import shutil
import signal
import subprocess
import sys
import sysconfig
import tempfile
import time
from contextlib import suppress
from functools import cache
from pathlib import Path

from autograder.wall import CALL_SECONDS, Call, Fault, FaultKind, Reply, decode_reply, encode_call

log = logging.getLogger(__name__)

HERE = Path(__file__).parent
INSIDE = {
    HERE / "room" / "runner.py": "runner.py",
    HERE / "room" / "stubs" / "autograder.py": "autograder.py",
    HERE / "room" / "stubs" / "armdyn.py": "armdyn.py",
    HERE / "wall.py": "wall.py",
}
START_SECONDS = 60.0
CELL_SECONDS = 10.0
# Over the limit inside by this much, the process is taken to be out of its own control.
GRACE_SECONDS = 3.0
MOST_BYTES = 32 << 20
MOST_OUTPUTS = 100  # the runner sends fewer; a forged reply may not
TMPFS_BYTES = 64 << 20
NOBODY = "65534"
ENVIRONMENT = {
    "HOME": "/tmp",
    "IPYTHONDIR": "/tmp/.ipython",
    "LANG": "C.UTF-8",
    "MPLCONFIGDIR": "/tmp/.matplotlib",
    "OPENBLAS_NUM_THREADS": "1",
    "PATH": "/usr/bin:/bin",
    "PYTHONDONTWRITEBYTECODE": "1",
    "PYTHONHASHSEED": "0",
}


class RoomLostError(Exception):
    """The process ended, fell silent, or wrote what is no reply; it is gone now."""


class Room:
    """A running sandbox. Use as a context manager; `close` leaves no process behind.

    run(source) gives a cell's outputs, ask(calls) the replies to calls. Both raise RoomLostError
    when the process does not survive them. OSError where the sandbox does not start.
    """

    def __init__(self, bubblewrap: bool | None = None):
        self._folder = tempfile.TemporaryDirectory(prefix="room-")
        isolated = has_bubblewrap() if bubblewrap is None else bubblewrap
        command, environment = self._walled() if isolated else self._unwalled()
        self._process = subprocess.Popen(
            command,
            env=environment,
            cwd=self._folder.name,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            start_new_session=True,
        )
        os.set_blocking(self._process.stdin.fileno(), False)
        self._buffer = b""
        try:
            self._receive(START_SECONDS)
        except RoomLostError as error:
            # Nothing of the student's has run yet.
            raise OSError(f"the sandbox did not start: {error}") from None

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        self.close()

    def run(self, source: str, seconds: float = CELL_SECONDS) -> list[dict]:
        message = self._exchange({"run": source, "seconds": seconds}, seconds)
        outputs = message.get("outputs")
        if not isinstance(outputs, list) or not all(isinstance(out, dict) for out in outputs):
            self._lost("it sent no outputs")
        return outputs[:MOST_OUTPUTS]

    def ask(self, calls: list[Call]) -> list[Reply]:
        # Each call has its own limit inside; slow calls that keep it are no lost room.
        seconds = CALL_SECONDS * len(calls)
        message = self._exchange({"ask": [encode_call(call) for call in calls]}, seconds)
        replies = message.get("replies")
        if not isinstance(replies, list):
            self._lost("it sent no replies")
        decoded = [decode_reply(reply) for reply in replies[: len(calls)]]
        if len(decoded) < len(calls) and not (decoded and decoded[-1].fault):
            decoded.append(Reply(fault=Fault(FaultKind.GARBLED)))
        return decoded

    def close(self) -> None:
        """End the process, and all that it started."""
        if self._process.returncode is None:
            # Without bubblewrap there is no process namespace to take the children along, and they
            # may be there when their parent has ended. The group's number is free only after wait.
            with suppress(ProcessLookupError):
                os.killpg(self._process.pid, signal.SIGKILL)
        self._process.wait()
        for pipe in (self._process.stdin, self._process.stdout, self._process.stderr):
            pipe.close()
        self._folder.cleanup()

    def _exchange(self, request: dict, seconds: float) -> dict:
        left = memoryview(json.dumps(request).encode() + b"\n")
        stdin = self._process.stdin.fileno()
        try:
            while left:
                # A process that does not read must not make the judge wait for ever.
                if not select.select([], [stdin], [], GRACE_SECONDS)[1]:
                    self._lost("it stopped listening")
                left = left[os.write(stdin, left) :]
        except OSError:
            self._lost("it has ended")
        return self._receive(seconds + GRACE_SECONDS)

    def _receive(self, seconds: float) -> dict:
        deadline = time.monotonic() + seconds
        stdout = self._process.stdout.fileno()
        while b"\n" not in self._buffer:
            left = deadline - time.monotonic()
            if left <= 0 or not select.select([stdout], [], [], left)[0]:
                self._lost(f"no reply within {seconds:g} s")
            chunk = os.read(stdout, 1 << 16)
            if not chunk:
                self._lost("it ended")
            self._buffer += chunk
            if len(self._buffer) > MOST_BYTES:
                self._lost("it wrote too much")
        line, _, self._buffer = self._buffer.partition(b"\n")
        try:
            message = json.loads(line)
            if b"\\ud" in line.lower():
                # Half a surrogate pair is legal in JSON, but no notebook holding one can be saved.
                text = json.dumps(message, ensure_ascii=False).encode(errors="replace")
                message = json.loads(text)
        except (ValueError, RecursionError):
            message = None
        if not isinstance(message, dict):
            self._lost("it wrote what is no reply")
        return message

    def _lost(self, why: str):
        ready, _, _ = select.select([self._process.stderr], [], [], 0)
        said = (
            os.read(self._process.stderr.fileno(), 4096).decode(errors="replace") if ready else ""
        )
        self.close()
        raise RoomLostError(f"{why} {said}".strip())

    def _unwalled(self):
        folder = Path(self._folder.name)
        for path, name in INSIDE.items():
            shutil.copy(path, folder / name)
        environment = ENVIRONMENT | {
            name: str(folder) for name in ("HOME", "IPYTHONDIR", "MPLCONFIGDIR", "TMPDIR")
        }
        return [sys.executable, "-I", "-u", str(folder / "runner.py")], environment

    def _walled(self):
        command = ["bwrap", "--unshare-all", "--die-with-parent", "--new-session"]
        command += ["--uid", NOBODY, "--gid", NOBODY, "--proc", "/proc", "--dev", "/dev"]
        for folder in ("/tmp", "/dev/shm"):
            command += ["--size", str(TMPFS_BYTES), "--tmpfs", folder]
        for folder in ("/usr", "/bin", "/lib", "/lib64"):
            if Path(folder).is_symlink():
                command += ["--symlink", os.readlink(folder), folder]
            elif Path(folder).exists():
                command += ["--ro-bind", folder, folder]
        for folder in _python_folders():
            command += ["--ro-bind", folder, folder]
        for folder in _installed_packages():
            command += ["--tmpfs", folder]
        for path, name in INSIDE.items():
            command += ["--ro-bind", str(path), f"/room/{name}"]
        command += ["--remount-ro", "/dev", "--remount-ro", "/", "--chdir", "/tmp"]
        # The environment goes in through bwrap's own: what it is started with stays readable inside.
        return [*command, "--", sys.executable, "-I", "-u", "/room/runner.py"], ENVIRONMENT


@cache
def has_bubblewrap() -> bool:
    """Whether bubblewrap is here and works; a warning once where not."""
    try:
        subprocess.run(
            ["bwrap", "--unshare-all", "--ro-bind", "/", "/", "true"],
            check=True,
            capture_output=True,
            timeout=10,
        )
    except (OSError, subprocess.SubprocessError):
        log.warning(
            "bubblewrap does not work here: student code runs with limits on time and memory, but "
            "is NOT shut off from files and network. On Debian: apt-get install bubblewrap"
        )
        return False
    return True


def _python_folders() -> list[str]:
    """Where this Python and its packages are, outermost first; folders under /usr come with it."""
    folders = {sys.prefix, sys.base_prefix, str(Path(sys.executable).resolve().parent.parent)}
    folders |= {sysconfig.get_path("purelib"), sysconfig.get_path("platlib")}
    kept = []
    for folder in sorted(folders, key=len):
        if not any(Path(folder).is_relative_to(outer) for outer in ["/usr", *kept]):
            kept.append(folder)
    return kept


def _installed_packages() -> list[str]:
    """This project's packages where they are copied into the environment: to be covered."""
    site = Path(sysconfig.get_path("purelib"))
    return [str(site / name) for name in ("armdyn", "autograder") if (site / name).exists()]
