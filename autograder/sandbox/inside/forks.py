"""The warm process: it has loaded everything that notebooks import, and each room is a fork of it.

It runs inside bubblewrap, and never holds anything of the course or any student code: a request brings
the descriptors of a room, and only that room's processes touch them. Each room has its own namespaces,
which separate it from other rooms as bubblewrap would. A fork copies the tables of all the memory that
its parent has. So a small process, the starter, forks all processes but the student's own:

    the starter, small → process 1 of new namespaces, which prepares them and reaps (first.py)
    the starter, small → the warm process, loaded → the runner in those namespaces, which runs the
    student's code.
"""

import os
import select
import signal
import socket
import sys
from contextlib import suppress

REQUEST = 3  # descriptors: requests, replies, and a socket for the handle on process 1


def main():
    channel = socket.socket(fileno=os.dup(0))
    nothing = os.open(os.devnull, os.O_RDWR)
    os.dup2(nothing, 0)
    os.dup2(nothing, 1)
    os.close(nothing)
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    import first
    import namespaces

    if os.getuid() == 0:
        namespaces.step_down()
    # The warm process forks into a room's namespaces and comes back, so it needs rights in both.
    namespaces.unshare(namespaces.CLONE_NEWUSER | namespaces.CLONE_NEWPID)
    if os.fork():
        channel.close()
        os.wait()
        return
    to_warm, to_starter = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)
    warm = os.fork()
    if warm == 0:
        channel.close()
        to_warm.close()
        _serve(to_starter)
        os._exit(0)
    to_starter.close()
    warm_lives = os.pidfd_open(warm)
    if to_warm.recv(16) != b"ready":
        return
    channel.send(b"ready")
    while True:
        ready, _, _ = select.select([channel.fileno(), warm_lives], [], [])
        if warm_lives in ready:
            return
        message, descriptors, *_ = socket.recv_fds(channel, 16, REQUEST)
        if not message:
            return
        if message == b"alive?":
            channel.send(b"alive")
        if len(descriptors) == REQUEST:
            requests, replies, handles = descriptors
            _start_room(requests, replies, handles, to_warm, first, namespaces)
        for descriptor in descriptors:
            os.close(descriptor)


def _start_room(requests, replies, handles, to_warm, first, namespaces):
    user, group = os.getuid(), os.getgid()
    try:
        process = namespaces.clone(namespaces.EVERY_KIND)
    except OSError as error:
        first.refuse(replies, error)
        return
    if process == 0:
        first.furnish_and_wait(requests, replies, handles, to_warm.fileno(), (user, group))
    with suppress(OSError), socket.socket(fileno=os.dup(handles)) as line:  # it may have ended
        handle = os.pidfd_open(process)
        try:
            socket.send_fds(line, [b"started"], [handle])
        finally:
            os.close(handle)


def _serve(channel):
    """Load everything, then fork a runner for each room whose process 1 asks for one."""
    import first
    import loaded
    import namespaces
    from shell import new_shell

    shell = new_shell()
    loaded.load(shell)
    own = os.pidfd_open(os.getpid())
    channel.send(b"ready")
    while True:
        message, descriptors, *_ = socket.recv_fds(channel, 16, first.DESCRIPTORS)
        if not message:
            return
        requests, replies, room, line = descriptors
        try:
            namespaces.enter(room, namespaces.CLONE_NEWPID)
            if os.fork() == 0:
                _run(requests, replies, room, line, shell)
        except OSError as error:
            first.refuse(replies, error)
        finally:
            namespaces.enter(own, namespaces.CLONE_NEWPID)
        for descriptor in descriptors:
            os.close(descriptor)


def _run(requests, replies, room, line, shell):
    """Run the room's cells; never returns. Errors go to the judge."""
    import first
    import namespaces
    import runner

    try:
        os.dup2(requests, 0)
        os.dup2(replies, 1)
        namespaces.enter(room, namespaces.EVERY_KIND & ~namespaces.CLONE_NEWPID)
        os.setsid()
        os.chdir("/tmp")
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        namespaces.drop_privileges()
        namespaces.new_keys()
        first.join(line)
        os.closerange(2, os.sysconf("SC_OPEN_MAX"))
        os.open(os.devnull, os.O_RDWR)
        runner.serve(shell, walled=True)
    except BaseException as error:
        first.refuse(1, error)
    finally:
        os._exit(0)


if __name__ == "__main__":
    main()
