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


@attack(fallback="there is no limit on processes, but they end with the room")
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


@attack(lost=LAST, says="p3-small_angle_frequency: ")
def two_runners(release):
    """Forks the runner, so that two processes read requests and write replies."""
    return last(release, "import os\nos.fork()")


@attack(fallback="a process in a session of its own outlives the grading")
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
    """Ignores the alarm, and loops for ever."""
    return cheat(
        release,
        g_vec="""
import signal
signal.signal(signal.SIGALRM, signal.SIG_IGN)
signal.setitimer(signal.ITIMER_REAL, 0)
while True:
    sum(())
""",
    )


@attack(says="Python itself stopped while g_vec(q, pend) was running")
def deaf_loop_in_a_call(release):
    """Ignores the alarm while it is judged, and loops for ever."""
    return cheat(
        release,
        g_vec="""
import signal
def g_vec(q, pend):
    signal.signal(signal.SIGALRM, signal.SIG_IGN)
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
