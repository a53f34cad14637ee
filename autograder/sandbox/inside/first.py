"""Process 1 of a room: it prepares the namespaces, reaps, and watches what the room uses.

When it ends, the kernel ends every process in the room. It does so when the runner has ended, when
the judge has gone, and when the room uses too much.
"""

import json
import os
import signal
import socket
from contextlib import suppress

import namespaces
import watch

DESCRIPTORS = 4  # requests, replies, a handle on this process, and a line to it


def furnish_and_wait(requests, replies, handles, to_warm, user):
    """Prepare the room and watch it; never returns. Errors before the runner starts go to the judge."""
    try:
        namespaces.map_user(*user)
        namespaces.furnish()
        os.setsid()
        os.chdir("/tmp")
        namespaces.drop_privileges()
        here, there = socket.socketpair()
        line = [requests, replies, os.pidfd_open(os.getpid()), there.fileno()]
        with socket.socket(fileno=to_warm) as channel:
            socket.send_fds(channel, [b"room"], line)
        os.dup2(here.detach(), 0)
        os.dup2(handles, 1)
        there.detach()
        os.closerange(2, os.sysconf("SC_OPEN_MAX"))
        here, judge = socket.socket(fileno=0), socket.socket(fileno=1)
        # From inside its namespace, process 1 gets only the signals that it handles.
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        # The warm process ignores its children, and this process inherits that.
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        number, runner, *_ = socket.recv_fds(here, 16, 1)
        if runner:
            namespaces.close_to_tracing()
            here.send(b"go")
            watch.Watch(judge, int(number), walled=True).until_pidfd(runner[0])
    except BaseException as error:
        refuse(replies, error)
    finally:
        os._exit(0)


def join(line):
    """In the runner: tell process 1 to end with this process, and wait until it is out of reach."""
    with socket.socket(fileno=line) as channel:
        number = str(os.getpid()).encode()
        socket.send_fds(channel, [number], [os.pidfd_open(os.getpid())])
        if channel.recv(16) != b"go":
            raise RuntimeError("the room ended before it began")


def refuse(replies, error):
    why = f"{type(error).__name__}: {error}"
    with suppress(OSError):
        os.write(replies, json.dumps({"refused": why}).encode() + b"\n")
