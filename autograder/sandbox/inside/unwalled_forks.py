"""The warm process where there is no bubblewrap: each room is a group of its forks, without walls.

    this process, loaded → the room's watch, which leads the group → the runner, which runs the
    student's code.

A request names the room's folder and brings its descriptors, as in forks.py.
"""

import os
import select
import shutil
import signal
import socket
import sys
import tempfile
from contextlib import suppress

# Requests, replies, and a socket: a handle on the watch goes out, and the judge talks to the watch.
DESCRIPTORS = 3
MOST_BYTES = 1 << 13  # the longest path there is, and a word
END_SECONDS = 10.0


def main():
    channel = socket.socket(fileno=os.dup(0))
    nothing = os.open(os.devnull, os.O_RDWR)
    for descriptor in (0, 1):
        os.dup2(nothing, descriptor)
    os.close(nothing)
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    import loaded
    from shell import new_shell

    shell = new_shell()
    loaded.load(shell)
    ended, wake = os.pipe()
    os.set_blocking(ended, False)
    os.set_blocking(wake, False)
    signal.signal(signal.SIGCHLD, lambda *_: None)
    signal.set_wakeup_fd(wake, warn_on_full_buffer=False)
    channel.send(b"ready")
    rooms: dict[int, str] = {}  # by the watch that leads it, a room's folder
    while True:
        ready, _, _ = select.select([channel.fileno(), ended], [], [])
        if ended in ready:
            _end_groups(ended, rooms)
        if channel.fileno() not in ready:
            continue
        message, descriptors, *_ = socket.recv_fds(channel, MOST_BYTES, DESCRIPTORS)
        if not message:
            break
        if message == b"alive?":
            channel.send(b"alive")
        if len(descriptors) == DESCRIPTORS:
            requests, replies, line = descriptors
            folder = os.fsdecode(message.removeprefix(b"room"))
            _start_room(folder, requests, replies, line, rooms, shell)
        for descriptor in descriptors:
            os.close(descriptor)
    while rooms and select.select([ended], [], [], END_SECONDS)[0]:  # they end with the judge, too
        _end_groups(ended, rooms)


def _end_groups(ended, rooms):
    """End what is left of rooms whose watch has ended, before that is reaped and its number is free."""
    with suppress(BlockingIOError):
        os.read(ended, 1 << 12)
    with suppress(ChildProcessError):
        while child := os.waitid(os.P_ALL, 0, os.WEXITED | os.WNOHANG | os.WNOWAIT):
            with suppress(ProcessLookupError, PermissionError):
                os.killpg(child.si_pid, signal.SIGKILL)
            os.waitpid(child.si_pid, 0)
            shutil.rmtree(rooms.pop(child.si_pid), ignore_errors=True)


def _start_room(folder, requests, replies, line, rooms, shell):
    import first

    try:
        process = os.fork()
    except OSError as error:
        first.refuse(replies, error)
        return
    if process == 0:
        _run(folder, requests, replies, line, shell)
    rooms[process] = folder
    with suppress(OSError), socket.socket(fileno=os.dup(line)) as judge:  # it may have ended
        handle = os.pidfd_open(process)
        try:
            socket.send_fds(judge, [b"started"], [handle])
        finally:
            os.close(handle)


def _run(folder, requests, replies, line, shell):
    """Run the room's cells; never returns. Errors go to the judge."""
    import first
    import runner

    try:
        os.setsid()
        signal.set_wakeup_fd(-1)
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        for place, descriptor in enumerate((requests, replies, line)):
            os.dup2(descriptor, place)
        os.closerange(3, os.sysconf("SC_OPEN_MAX"))
        os.chdir(folder)
        for name in ("HOME", "IPYTHONDIR", "MPLCONFIGDIR", "TMPDIR"):
            os.environ[name] = folder
        tempfile.tempdir = None
        shell.move_in()
        runner.leave_to_watch(socket.socket(fileno=os.dup(2)), walled=False)
        runner.serve(shell)
    except BaseException as error:
        first.refuse(1, error)
    finally:
        os._exit(0)


if __name__ == "__main__":
    try:
        main()
    finally:
        shutil.rmtree(os.environ["HOME"], ignore_errors=True)
