"""Watches what all processes of a room use together, and ends those that a cell leaves behind.

The kernel limits each process alone. This process limits them together, and ends the room with the
judge. Behind walls, the student's code cannot reach it; without walls, that code may end it like any
other process of its user.

The judge sends a line, "used" or "sweep", and gets one: the same word, the processor time of all
processes so far, and the time in which none of them computed or was ready to, s. After "sweep", only the
runner is left. A last line, which starts with "!", says why the room ends.
"""

import os
import select
import signal
import socket
import time
from collections.abc import Callable, Iterable
from contextlib import suppress

# A room has no more processes and threads than this, with this one. The kernel sees to that if the
# room's user is not root.
MOST_PROCESSES = 64
# A room starts no more than this. A process may end between two looks, without a parent that waits for
# it; only its number then shows that it was there.
MOST_STARTED = 5000
ROOM_BYTES = 4 << 30
LOOK_SECONDS = 0.1
SWEEP_SECONDS = 30.0  # a busy machine may take long to end a process
PAGE = os.sysconf("SC_PAGE_SIZE")
TICKS = os.sysconf("SC_CLK_TCK")
ZOMBIE = ("Z", "X")
BUSY = ("R", "D")  # computes, is ready to, or waits for a disk


class Watch:
    """A room's processes, seen from one that is not the student's.

    judge: a stream socket to the judge; the room ends when it is closed. runner: the process that
    stays. walled: whether all processes and shared memory that are to be seen belong to the room.
    reaper: as in ProcessorTime.
    """

    def __init__(
        self,
        judge: socket.socket,
        runner: int,
        walled: bool,
        reaper: int | None = None,
    ):
        self._judge, self._runner, self._walled = judge, runner, walled
        self._processes = namespace if walled else descendants
        self._time = ProcessorTime(reaper)
        self._requests = b""

    def until_ended(self, ended: Callable[[], bool], wake: int | None = None) -> None:
        """Serve the judge until the runner has ended, the judge is gone, or the room has to end.

        ended: whether the runner has. wake: a descriptor that is readable then, where there is one.
        """
        poll = select.poll()
        poll.register(self._judge, select.POLLIN)
        if wake is not None:
            poll.register(wake, select.POLLIN)
        pause = LOOK_SECONDS
        next_look = time.monotonic() + pause
        while True:
            events = poll.poll(max(0.0, next_look - time.monotonic()) * 1000)
            if ended() or not self._serve(dict(events).get(self._judge.fileno(), 0)):
                return
            if time.monotonic() < next_look:
                continue
            start = time.monotonic()
            reap()
            if reason := self._too_much():
                self._say(f"! {reason}")
                return
            # Looking closely at many processes takes long.
            pause = max(LOOK_SECONDS, 5 * (time.monotonic() - start))
            next_look = time.monotonic() + pause

    def until_child_ended(self) -> None:
        """`until_ended` of a runner that is this process's child."""
        if hasattr(os, "pidfd_open"):
            self.until_pidfd(os.pidfd_open(self._runner))
        else:
            self.until_ended(lambda: _has_ended(self._runner))

    def until_pidfd(self, runner: int) -> None:
        """`until_ended` of the runner that a pidfd stands for."""
        poll = select.poll()
        poll.register(runner, select.POLLIN)
        self.until_ended(lambda: bool(poll.poll(0)), wake=runner)

    def _serve(self, event: int) -> bool:
        """Answer the judge; whether the room goes on."""
        if event & select.POLLIN:
            received = b""
            with suppress(OSError):
                received = self._judge.recv(1 << 10)
            if not received:
                return False
            self._requests += received
        *requests, self._requests = self._requests.split(b"\n")
        for request in requests:
            if request == b"sweep" and not sweep(self._processes, self._runner):
                self._say("! a process that the cell started could not be ended")
                return False
            used = self._time.look(self._processes())
            self._say(f"{request.decode()} {used:.3f} {self._time.idle:.3f}")
        return not event & (select.POLLHUP | select.POLLERR)

    def _say(self, line: str) -> None:
        with suppress(OSError):  # the judge has gone
            self._judge.sendall(line.encode() + b"\n")

    def _too_much(self) -> str:
        """The limit that the room is over, if any.

        The sum of what the processes have mapped is quick to read, and never less than what they use.
        Only if it is too much, pages that several share are counted once.
        """
        processes = list(self._processes())
        self._time.look(processes)
        if sum(map(_threads, processes)) > MOST_PROCESSES:
            return f"it had more than {MOST_PROCESSES} processes and threads"
        if self._walled and _last_number() > MOST_STARTED:
            return f"it started more than {MOST_STARTED} processes and threads"
        segments = _segments() if self._walled else 0
        if (
            sum(map(_mapped, processes)) + segments > ROOM_BYTES
            and sum(map(_share, processes)) + segments > ROOM_BYTES
        ):
            return f"its processes used more than {ROOM_BYTES >> 30} GiB of memory together"
        return ""


class ProcessorTime:
    """The time that all processes of a room have used, s, with those that ended between two looks.

    When a parent waits for a child, the kernel adds the child's time to the parent's. For a child that
    nobody waited for, the time at the last look before its end counts. reaper: the process that waits
    for orphans, if that is not this one. idle: how long no process computed or was ready to, s: on a
    busy machine, those that are ready wait for a processor.
    """

    def __init__(self, reaper: int | None = None):
        self._reaper = reaper
        self._spent = 0.0
        self._seen: dict[tuple[int, str], tuple[float, float]] = {}
        self._waited = self._of_orphans()
        self.idle, self._looked = 0.0, time.monotonic()

    def look(self, processes: Iterable[int]) -> float:
        stats = {p: stat for p in processes if (stat := _stat(p))}
        seen = {(p, stat[19]): _times(stat) for p, stat in stats.items()}
        waited = self._of_orphans()
        own, of_children = 0.0, waited - self._waited
        for key, (used, used_by_children) in seen.items():
            used_before, by_children_before = self._seen.get(key, (0.0, 0.0))
            own += used - used_before
            of_children += used_by_children - by_children_before
        counted = sum(sum(times) for key, times in self._seen.items() if key not in seen)
        spent = max(0.0, own) + max(0.0, of_children - counted)
        now = time.monotonic()
        if not spent and not any(_is_busy(p, stat) for p, stat in stats.items()):
            self.idle += now - self._looked
        self._looked = now
        self._spent += spent
        self._seen, self._waited = seen, waited
        return self._spent

    def _of_orphans(self) -> float:
        times = os.times()
        reaper = _stat(self._reaper) if self._reaper else None
        elsewhere = _times(reaper)[1] if reaper else 0.0
        return times.children_user + times.children_system + elsewhere


def sweep(processes: Callable[[], Iterable[int]], *spared: int) -> bool:
    """End every process but the spared; return whether no other is left."""
    deadline = time.monotonic() + SWEEP_SECONDS
    while left := [p for p in processes() if p not in spared and _lives(p)]:
        if time.monotonic() > deadline:
            return False
        for process in left:
            with suppress(ProcessLookupError, PermissionError):
                os.kill(process, signal.SIGKILL)
        reap()
        time.sleep(0.001)
    return True


def reap() -> None:
    """Wait for children that have ended, orphans among them, so that their time counts."""
    with suppress(ChildProcessError):
        while os.waitpid(-1, os.WNOHANG)[0]:
            pass


def namespace() -> list[int]:
    """The processes of this namespace, except for its first and this one."""
    own = (1, os.getpid())
    return [int(name) for name in os.listdir("/proc") if name.isdigit() and int(name) not in own]


def descendants(process: int | None = None) -> list[int]:
    """The processes below this one; none escapes if it adopts orphans."""
    found, left = [], [process or os.getpid()]
    while left:
        above = left.pop()
        with suppress(OSError):
            for thread in os.listdir(f"/proc/{above}/task"):
                with suppress(OSError), open(f"/proc/{above}/task/{thread}/children") as file:
                    children = [int(child) for child in file.read().split()]
                found += children
                left += children
    return found


def _stat(process) -> list[str] | None:
    """The fields of /proc/…/stat from the state on: the name before them may hold anything."""
    with suppress(OSError), open(f"/proc/{process}/stat") as file:
        return file.read().rpartition(")")[2].split()
    return None


def _times(stat: list[str]) -> tuple[float, float]:
    user, system, children_user, children_system = map(int, stat[11:15])
    return (user + system) / TICKS, (children_user + children_system) / TICKS


def _is_busy(process: int, stat: list[str]) -> bool:
    """Whether one of its threads computes or could."""
    if stat[0] in BUSY or int(stat[17]) <= 1:
        return stat[0] in BUSY
    with suppress(OSError):
        threads = os.listdir(f"/proc/{process}/task")
        return any((of := _stat(f"{process}/task/{t}")) and of[0] in BUSY for t in threads)
    return False


def _has_ended(child) -> bool:
    try:
        return os.waitpid(child, os.WNOHANG)[0] != 0
    except ChildProcessError:
        return True  # reaped with the orphans


def _lives(process) -> bool:
    """Whether any of its threads lives; the first may have ended before the others."""
    stat = _stat(process)
    return stat is not None and not (stat[0] in ZOMBIE and int(stat[17]) <= 1)


def _last_number() -> int:
    """The number of the process or thread that was started last in this namespace."""
    with suppress(OSError), open("/proc/loadavg") as file:
        return int(file.read().split()[-1])
    return 0


def _threads(process):
    with suppress(OSError):
        return os.stat(f"/proc/{process}/task").st_nlink - 2
    return 0


def _mapped(process):
    with suppress(OSError), open(f"/proc/{process}/statm") as file:
        return int(file.read().split()[1]) * PAGE
    return 0


def _share(process):
    try:
        with open(f"/proc/{process}/smaps_rollup") as file:
            return sum(int(line.split()[1]) << 10 for line in file if line.startswith("Pss:"))
    except OSError:
        return _mapped(process)  # the process hides, or has just ended


def _segments():
    """Shared memory of System V stays when nobody has it mapped."""
    with suppress(OSError), open("/proc/sysvipc/shm") as file:
        column = file.readline().split().index("rss")
        return sum(int(line.split()[column]) for line in file)
    return 0
