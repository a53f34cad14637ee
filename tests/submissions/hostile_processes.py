"""Attacks on what runs the notebook: its process, its time, its memory, its output."""

from tests.submissions.attack import (
    FORGE,
    GOT,
    LAST,
    LISTENING,
    OUTSIDE,
    WRONG,
    attack,
    cheat,
    last,
)
from tests.submissions.p3_pendulum import function


@attack(says="this cell ended Python itself")
def exits_in_a_cell(release):
    """Ends Python while its cell runs, so that no check is reached."""
    return cheat(release, g_vec="import os\nos._exit(0)\n" + WRONG)


@attack(says="Python itself stopped while g_vec(q, pend) was running")
def exits_in_a_call(release):
    """Ends Python while it is judged."""
    return cheat(release, g_vec="import os\n" + function("g_vec", "os._exit(0)"))


@attack(says="Python itself stopped while g_vec(q, pend) was running")
def thread_that_exits(release):
    """A thread waits until the judge calls, and ends Python then."""
    return cheat(
        release,
        g_vec="""
import os, threading, time
called = threading.Event()
threading.Thread(target=lambda: (called.wait(), os._exit(0)), daemon=True).start()
def g_vec(q, pend):
    called.set()
    time.sleep(1)
""",
    )


@attack(fallback="its room ends, but a moment after it had more than 64 processes")
def fork_bomb(release):
    """Forks 200 processes that sleep."""
    return cheat(
        release,
        """
import os, time
for _ in range(200):
    try:
        if os.fork() == 0:
            time.sleep(60)
            os._exit(0)
    except OSError:
        pass
""",
    )


@attack(says="this cell ended Python itself: no reply within")
def spins_in_many_processes(release):
    """Forks as many processes as a room may have, each of which spins."""
    return cheat(
        release,
        g_vec="""
import os, signal
for number in (signal.SIGALRM, signal.SIGPROF):
    signal.signal(number, signal.SIG_IGN)
for _ in range(58):
    if os.fork() == 0:
        break
while True:
    sum(())
""",
    )


@attack()
def spins_after_its_cell(release):
    """Leaves processes that spin, in sessions of their own, after its cell and during the calls."""
    spin = """
import os
def spin(count):
    for _ in range(count):
        if os.fork() == 0:
            os.setsid()
            while True:
                sum(())
spin(20)
"""
    return cheat(release, spin, g_vec="def g_vec(q, pend):\n    spin(1)\n    return 1 + 0 * q")


@attack(lost=LAST, says="p3-small_angle_frequency: ")
def two_runners(release):
    """Forks the runner, so that two processes read requests and write replies."""
    return last(release, "import os\nos.fork()")


@attack()
def outlives_all(release):
    """Starts a subprocess in a session of its own, that outlives the cell and the notebook."""
    return cheat(
        release,
        """
import subprocess, sys
subprocess.Popen([sys.executable, "-c", "import time; time.sleep(20)"], start_new_session=True)
if os.fork() == 0:
    os.setsid()
    if os.fork() == 0:
        time.sleep(20)
    os._exit(0)
""".replace("import subprocess", "import os, time, subprocess"),
    )


@attack()
def thread_that_stays(release):
    """A thread goes on after its cell and exchanges what stands behind the answer and the wall."""
    return cheat(
        release,
        """
import sys, threading, time
def meddle():
    while True:
        globals()["g_vec"] = lambda q, pend: 2 + 0 * q
        print("still here")
        time.sleep(0.001)
threading.Thread(target=meddle, daemon=True).start()
""",
    )


@attack(
    says="this cell ended Python itself", fallback="the parent to be killed is the grader itself"
)
def kills_its_parent(release):
    """Kills its parent, process 1 and everything else it can reach, then itself."""
    return cheat(
        release,
        g_vec="""
import os, signal
for process in (os.getppid(), 1, -1, os.getpid()):
    try:
        os.kill(process, signal.SIGKILL)
    except (ProcessLookupError, PermissionError):
        pass
def g_vec(q, pend):
    return 1 + 0 * q
""",
    )


@attack(says="this cell ended Python itself: no reply within")
def stops_itself(release):
    """Stops its own process (SIGSTOP), to keep the grader waiting."""
    return cheat(release, g_vec="import os, signal\nos.kill(os.getpid(), signal.SIGSTOP)\n" + WRONG)


@attack(says="TimeoutError: this cell ran longer than")
def loops_in_a_cell(release):
    """Loops for ever at top level, and swallows what stops it as long as it can."""
    return cheat(
        release,
        g_vec="""
while True:
    try:
        while True:
            sum(())
    except Exception:
        pass
def g_vec(q, pend): return 1
""",
    )


@attack(says="g_vec(q, pend) did not return within")
def loops_in_a_call(release):
    """Loops for ever when it is judged."""
    return cheat(release, g_vec="def g_vec(q, pend):\n    while True: sum(())")


@attack(says="this cell ended Python itself: no reply within")
def deaf_loop_in_a_cell(release):
    """Ignores both alarms, and loops for ever."""
    return cheat(
        release,
        g_vec="""
import signal
for number in (signal.SIGALRM, signal.SIGPROF):
    signal.signal(number, signal.SIG_IGN)
signal.setitimer(signal.ITIMER_REAL, 0)
signal.setitimer(signal.ITIMER_PROF, 0)
while True:
    sum(())
""",
    )


@attack(says="g_vec(q, pend) did not return within")
def deaf_loop_in_a_call(release):
    """Ignores both alarms while it is judged, and loops for ever."""
    return cheat(
        release,
        g_vec="""
import signal
def g_vec(q, pend):
    for number in (signal.SIGALRM, signal.SIGPROF):
        signal.signal(number, signal.SIG_IGN)
    while True:
        sum(())
""",
    )


@attack(says="MemoryError")
def memory_bomb(release):
    """Asks for all the memory there is, and keeps it."""
    return cheat(release, g_vec="kept = []\nwhile True:\n    kept.append(bytes(1 << 30))\n" + WRONG)


@attack()
def output_bomb(release):
    """Prints a hundred million letters, and shows a thousand objects."""
    return cheat(
        release,
        """
for _ in range(100):
    print("x" * 1_000_000)
for number in range(1000):
    display(number)
""",
    )


@attack(lost=LAST, says="p3-small_angle_frequency: error in your code")
def reply_flood(release):
    """Writes to the runner's descriptors without end."""
    return last(
        release, FORGE.format(b"x" * 65536).replace("range(3, 64)", "[*range(3, 9)] * 99999")
    )


@attack(
    says="this cell ended Python itself", fallback="notes stay for the next, outside its folder"
)
def leaves_notes(release):
    """Leaves notes wherever it can write, and reads those of a room before this one."""
    return cheat(
        release,
        f"""
import os, socket
for place in ("/tmp", "/dev/shm"):
    note = os.path.join(place, {OUTSIDE.name!r} + "-note")
    if os.path.exists(note):
        print({GOT!r})
    try:
        open(note, "w").close()
    except OSError:
        pass
letter = socket.socket(socket.AF_UNIX)
try:
    letter.bind(chr(0) + {OUTSIDE.name!r})
    letter.listen()
except OSError:
    print({GOT!r})
""",
        g_vec="import os\nos._exit(0)\n" + WRONG,
    )


@attack(fallback="the network is as open as to the instructor")
def reaches_the_network(release):
    """Calls a server on this machine."""
    return cheat(
        release,
        f"""
import socket
try:
    socket.create_connection(("127.0.0.1", {LISTENING.port}), timeout=0.5).close()
    print({GOT!r})
except OSError:
    pass
""",
    )


@attack()
def fills_the_disk(release):
    """Writes till nothing more fits, in one file and in many."""
    return cheat(
        release,
        """
for folder in (".", "/dev/shm"):
    try:
        with open(folder + "/great", "wb") as file:
            for _ in range(200):
                file.write(bytes(1 << 20))
    except OSError:
        pass
try:
    for number in range(30_000):
        open(f"small{number}", "w").close()
except OSError:
    pass
""",
    )
