"""The warm process: everything a notebook imports is loaded, and each room is a fork of it.

It runs inside bubblewrap, holds nothing of the course and never any student code: a request brings
the descriptors of a room, and only that room's fork touches them. The fork goes into namespaces of
its own, as far from the other rooms as bubblewrap's are from each other:

    this process → a fork that enters new namespaces and waits → process 1, which furnishes them,
    gives up all rights and reaps → the runner, where the student's code is.
"""

import gc
import io
import json
import os
import signal
import socket
import sys
from contextlib import suppress

DESCRIPTORS = 3  # requests, replies, and a socket for the handle on process 1


def main():
    channel = socket.socket(fileno=os.dup(0))
    nothing = os.open(os.devnull, os.O_RDWR)
    os.dup2(nothing, 0)
    os.dup2(nothing, 1)
    os.close(nothing)
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    import namespaces

    if os.getuid() == 0:
        namespaces.become_nobody()
    import runner

    shell = runner.new_shell()
    _warm_up()
    if len(os.listdir("/proc/self/task")) > 1:
        raise RuntimeError("a thread was started: no fork of this process would be whole")
    gc.collect()
    gc.freeze()  # a collection in a room would copy every page it looks at
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)
    channel.send(b"ready")
    while True:
        message, descriptors, *_ = socket.recv_fds(channel, 16, DESCRIPTORS)
        if not message:
            return
        if len(descriptors) == DESCRIPTORS and os.fork() == 0:
            _room(descriptors, shell, runner, namespaces)
        for descriptor in descriptors:
            os.close(descriptor)


def _warm_up():
    """Load what notebooks import, and what loads itself at the first figure."""
    import matplotlib.pyplot
    import numpy.linalg
    import sympy
    import wall  # noqa: F401
    from matplotlib.figure import Figure
    from matplotlib_inline import backend_inline  # noqa: F401

    axes = Figure().subplots()
    axes.set(title="$q$", xlabel="t")
    axes.figure.savefig(io.BytesIO())
    matplotlib.pyplot.switch_backend(os.environ["MPLBACKEND"])
    sympy.lambdify(sympy.Symbol("q"), sympy.sin(sympy.Symbol("q")))
    sympy.core.cache.clear_cache()
    # Drawn anew by each process, and dummy symbols sort by it.
    sympy.Dummy._base_dummy_index = 10_000_000
    numpy.linalg.solve([[1.0]], [1.0])


def _room(descriptors, shell, runner, namespaces):
    """Never returns. What goes wrong is said on the room's own channel."""
    try:
        for place, descriptor in enumerate(descriptors):
            os.dup2(descriptor, place)
        os.closerange(DESCRIPTORS, os.sysconf("SC_OPEN_MAX"))
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        namespaces.unshare(namespaces.EVERY_KIND)
        first = os.fork()
        if first:
            with socket.socket(fileno=2) as handles:
                socket.send_fds(handles, [b"started"], [os.pidfd_open(first)])
            os.closerange(0, DESCRIPTORS)
            os.waitpid(first, 0)
            os._exit(0)
        os.close(2)
        os.open(os.devnull, os.O_RDWR)
        namespaces.furnish()
        os.setsid()
        os.chdir("/tmp")
        namespaces.drop_privileges()
        student = os.fork()
        if student == 0:
            runner.serve(shell, walled=True)
            os._exit(0)
        os.closerange(0, DESCRIPTORS)
        # Process 1 gets no signal from within but those it handles.
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        namespaces.close_to_tracing()
        while os.wait()[0] != student:
            pass
    except BaseException as error:
        _refuse(f"{type(error).__name__}: {error}")
    finally:
        os._exit(0)


def _refuse(why):
    with suppress(OSError):
        os.write(1, json.dumps({"refused": why}).encode() + b"\n")


if __name__ == "__main__":
    main()
