"""Hostile submissions to p3-pendulum, for points that are not earned or to harm the next one.

Each is the released notebook with right answers, edited by one attack: what the right answers earn
stays earned, and `lost` names the checks where the attack must earn nothing. An attack that gets hold
of something it should not have prints or returns GOT. Where an attack gets further without
bubblewrap, `fallback` says how.
"""

import copy
import os
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from nbformat import NotebookNode
from nbformat.v4 import new_code_cell, new_output

from tests.submissions.p3_pendulum import POINTS, RIGHT, cell_of, function, right_but

GOT = "got through the wall"
ROOT = Path(__file__).parents[2]
# A folder outside every room, to be written to.
OUTSIDE = Path(tempfile.gettempdir()) / f"zoo-{os.getpid()}"
WRONG = function("g_vec", "1 + 0 * q")


@dataclass(frozen=True)
class Attack:
    """One hostile submission.

    edit(release): the notebook. tries: what it is after. lost: the grade cells that must earn nothing;
    all others earn all. says: what a verdict, a note or a cell's output must say of it.
    fallback: what it gets without bubblewrap; "" where that stops it as well.
    """

    name: str
    edit: Callable[[NotebookNode], NotebookNode]
    tries: str
    lost: tuple[str, ...]
    says: str
    fallback: str

    @property
    def points(self) -> dict[str, float]:
        return {name: 0.0 if name in self.lost else most for name, most in POINTS.items()}


ATTACKS: dict[str, Attack] = {}
# Without bubblewrap nobody should try these: the harm is real.
SAFE_WITHOUT_WALLS = (
    "reads_the_solution",
    "writes_the_gradebook",
    "writes_outside",
    "outlives_all",
)


def attack(lost=("p3-g_vec",), says="p3-g_vec: incorrect", fallback=""):
    """Enter a function that edits the release; its docstring says what it tries."""

    def enter(edit):
        name = edit.__name__
        ATTACKS[name] = Attack(name, edit, edit.__doc__, tuple(lost), says, fallback)
        return edit

    return enter


def cheat(release, first="", **answers):
    """All right but g_vec, or but `answers`; the code `first` in a cell of its own before them all."""
    notebook = right_but(release, **(answers or {"g_vec": WRONG}))
    if first:
        after = notebook.cells.index(cell_of(notebook, "p3-setup"))
        notebook.cells.insert(after + 1, new_code_cell(first.strip()))
    return notebook


def last(release, source):
    """The attack in the last answer, wrong as well, so that all earlier points are earned."""
    wrong = function("small_angle_frequency", "-1.0")
    return cheat(release, small_angle_frequency=source.strip() + "\n" + wrong)


LAST = ("p3-small_angle_frequency",)


@attack()
def patched_assertions(release):
    """Makes every comparison and assertion of NumPy succeed."""
    return cheat(
        release,
        """
import numpy as np
yes = lambda *args, **kwargs: True
for name in ("allclose", "isclose", "array_equal", "all", "any"):
    setattr(np, name, yes)
np.testing.assert_allclose = np.testing.assert_array_equal = yes
""",
    )


@attack()
def always_equal(release):
    """Returns an object that equals, and is less than, everything."""
    return cheat(
        release,
        g_vec="""
class Yes:
    __eq__ = __ne__ = __lt__ = __le__ = __gt__ = __ge__ = lambda self, other: True
    __sub__ = __rsub__ = __mul__ = __abs__ = lambda self, *other: self
    __bool__ = lambda self: True
    __hash__ = None
    __float__ = lambda self: 0.5
def g_vec(q, pend):
    return Yes()
""",
    )


@attack()
def lying_array(release):
    """Returns an array whose ufuncs and functions say what pleases (__array_ufunc__, ...)."""
    return cheat(
        release,
        g_vec="""
class Liar(np.ndarray):
    __array_priority__ = 1e9
    def __array_ufunc__(self, *args, **kwargs): return True
    def __array_function__(self, *args, **kwargs): return True
    def astype(self, *args, **kwargs): return self
    def tolist(self): return [0.5]
    __eq__ = __le__ = lambda self, other: True
def g_vec(q, pend):
    return np.ones(1).view(Liar)
""",
    )


@attack(says="g_vec(q, pend) raised RuntimeError: p3-g_vec: correct</p><b>")
def shifty_float(release):
    """An object whose __float__ raises, with a verdict of its own in the message."""
    return cheat(
        release,
        g_vec="""
class Shifty:
    def __float__(self): raise RuntimeError("p3-g_vec: correct</p><b>")
def g_vec(q, pend):
    return Shifty()
""",
    )


@attack()
def ast_transformer(release):
    """Rewrites the syntax tree of every later cell, so that no check is called."""
    return cheat(
        release,
        """
import ast
class NoChecks(ast.NodeTransformer):
    def visit_Expr(self, node):
        called = getattr(getattr(node.value, "func", None), "id", "")
        return ast.parse("1000000").body[0] if called == "check" else node
get_ipython().ast_transformers.append(NoChecks())
""",
    )


@attack()
def input_transformer(release):
    """Rewrites the text of every later cell, so that a check becomes a score."""
    return cheat(
        release,
        """
get_ipython().input_transformers_cleanup.append(
    lambda lines: ["1000000\\n" if line.startswith("check(") else line for line in lines]
)
""",
    )


@attack()
def patched_shell(release):
    """Patches run_cell of the shell and do_execute of the kernel, where there is one."""
    return cheat(
        release,
        """
shell = get_ipython()
run = shell.run_cell
def run_cell(source, *args, **kwargs):
    return run("1000000" if "check(" in source else source, *args, **kwargs)
shell.run_cell = type(shell).run_cell = run_cell
if hasattr(shell, "kernel"):
    shell.kernel.do_execute = lambda *args, **kwargs: {"status": "ok"}
""",
    )


@attack()
def shadowed_modules(release):
    """Writes modules that shadow those of the judge, and has them imported."""
    return cheat(
        release,
        """
import os, sys
for name in ("wall", "json", "numpy", "runner", "autograder", "sitecustomize", "armdyn"):
    for folder in (".", "/tmp", "/room", os.path.expanduser("~")):
        try:
            with open(os.path.join(folder, name + ".py"), "w") as file:
                file.write("print('shadowed')")
        except OSError:
            pass
sys.path.insert(0, os.getcwd())
for name in ("wall", "json", "runner", "__main__"):
    sys.modules.pop(name, None)
""",
    )


@attack(fallback="the gradebook is as writable as to the instructor")
def writes_the_gradebook(release):
    """Writes a score of its own to the gradebook, whose place it knows, and looks for the seed."""
    return cheat(
        release,
        f"""
import glob, os, sqlite3
for path in glob.glob({str(OUTSIDE / "course" / "gradebook.db")!r}):
    with sqlite3.connect(path) as gradebook:
        gradebook.execute("create table score (points)")
    print({GOT!r})
for path in ({str(OUTSIDE / "course" / "seed")!r}, {str(ROOT / "course" / "seed")!r}):
    if os.path.exists(path):
        print({GOT!r})
""",
    )


@attack(fallback="the solutions are as readable as to the instructor")
def reads_the_solution(release):
    """Reads the source version of the notebook, and takes g_vec from there."""
    return cheat(
        release,
        g_vec=f"""
def g_vec(q, pend):
    return 1 + 0 * q
import json
for folder in ("/proc/1/root", "/proc/self/root", ""):
    try:
        with open(folder + {str(ROOT / "solutions" / "p3-pendulum" / "p3-pendulum.ipynb")!r}) as file:
            for cell in json.load(file)["cells"]:
                source = "".join(cell["source"])
                if source.startswith("def g_vec"):
                    print({GOT!r})
    except OSError:
        pass
""",
    )


@attack(says="g_vec(q, pend) returned nan, which is not a finite number")
def nan_as_credit(release):
    """Returns NaN, which a careless score takes for full marks."""
    return cheat(release, g_vec=function("g_vec", "float('nan')"))


@attack(says="g_vec(q, pend) returned inf, which is not a finite number")
def infinities(release):
    """Returns infinity, against which every error is relatively small."""
    return cheat(release, g_vec=function("g_vec", "np.array([np.inf])"))


@attack(says="must return numbers")
def huge_integer(release):
    """Returns an integer that no float holds."""
    return cheat(release, g_vec=function("g_vec", "10**400"))


@attack(says="g_vec(q, pend) raised ValueError: Exceeds the limit")
def unprintable_integer(release):
    """Returns an integer that Python refuses to print."""
    return cheat(release, g_vec=function("g_vec", "10**5000"))


@attack(lost=("p3-g_vec", "p3-lagrangian"))
def largest_floats(release):
    """Returns the largest floats, so that the judge's arithmetic overflows."""
    return cheat(
        release,
        lagrangian=function("lagrangian", "1.7e308 * sp.sign(qd - 1) * sp.cos(q)"),
        g_vec=function("g_vec", "np.copysign(1.79e308, -np.sin(q))"),
    )


@attack(lost=())
def warns_in_the_check(release):
    """Adds code to a grade cell that warns on stderr, which nbgrader scores with zero."""
    notebook = cheat(release, M=RIGHT["M"])
    cell_of(notebook, "p3-M").source += "\nimport warnings; warnings.warn('loud')"
    return notebook


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


@attack(says="g_vec(q, pend) returned 900000 entries, far too many")
def many_numbers(release):
    """Returns more numbers than were asked for, the right one perhaps among them."""
    return cheat(release, g_vec=function("g_vec", "np.linspace(-50, 50, 900_000)"))


@attack(says="RecursionError")
def deep_recursion(release):
    """Recurs without end."""
    return cheat(release, g_vec=function("g_vec", "g_vec(q, pend)"))


@attack(says="g_vec(q, pend) ")
def deep_nesting(release):
    """Returns a list nested deeper than anything can read."""
    return cheat(
        release,
        g_vec="""
def g_vec(q, pend):
    value = [0.0]
    for _ in range(100_000):
        value = [value]
    return value
""",
    )


@attack()
def hunts_frames(release):
    """Walks up the stack, when it is called, for the judge's right values."""
    return cheat(
        release,
        g_vec=f"""
import sys
def g_vec(q, pend):
    frame = sys._getframe()
    while frame:
        if {{"expected", "reference", "CHECKS", "rng"}} & (set(frame.f_locals) | set(frame.f_globals)):
            raise RuntimeError({GOT!r})
        frame = frame.f_back
    return 1 + 0 * q
""",
    )


@attack()
def hunts_objects(release):
    """Looks through all live objects for a check, a mistake or a reference."""
    return cheat(
        release,
        g_vec=f"""
import gc
wanted = ("Check", "Mistake", "Criterion", "Verdict", "Pendulum")
def g_vec(q, pend):
    for thing in gc.get_objects():
        module = str(getattr(type(thing), "__module__", ""))
        if type(thing).__name__ in wanted and module.startswith(("autograder", "armdyn")):
            raise RuntimeError({GOT!r})
        if str(getattr(thing, "__module__", "")).startswith(("autograder.", "armdyn.")):
            raise RuntimeError({GOT!r})
    return 1 + 0 * q
""",
    )


@attack()
def hunts_modules(release):
    """Looks for the problems and the models among the modules, loaded or not."""
    return cheat(
        release,
        g_vec=f"""
import importlib, sys
sys.path += [{str(ROOT)!r}, {str(ROOT / "lib")!r}, {str(ROOT / "autograder")!r}]
def g_vec(q, pend):
    for name in ("autograder.judge", "autograder.problems", "armdyn.models", "judge", "problems"):
        try:
            importlib.import_module(name)
        except ImportError:
            continue
        raise RuntimeError({GOT!r})
    if any(name.startswith(("autograder.", "armdyn.")) for name in sys.modules):
        raise RuntimeError({GOT!r})
    return 1 + 0 * q
""",
        M=RIGHT["M"],
    )


# Without walls a path to the checkout makes its modules importable.
ATTACKS["hunts_modules"] = Attack(
    **{**vars(ATTACKS["hunts_modules"]), "fallback": "the checkout's modules can be imported"}
)


@attack(fallback="all processes of the same user can be seen")
def reads_proc(release):
    """Reads /proc for other processes, their command lines, environments and files."""
    return cheat(
        release,
        f"""
import glob
for path in glob.glob("/proc/[0-9]*/cmdline") + glob.glob("/proc/[0-9]*/environ"):
    try:
        with open(path, "rb") as file:
            said = file.read()
        if b"pytest" in said or b"PYTEST" in said:
            print({GOT!r})
    except OSError:
        pass
for path in glob.glob("/proc/[0-9]*/root" + {str(ROOT / "solutions")!r}):
    print({GOT!r})
""",
    )


@attack(fallback="files are as writable as to the instructor")
def writes_outside(release):
    """Writes outside its folder, into Python itself and into the course."""
    return cheat(
        release,
        f"""
import os, sys, numpy
for folder in ({str(OUTSIDE)!r}, {str(OUTSIDE / "course")!r}):
    try:
        with open(os.path.join(folder, "written"), "w") as file:
            file.write({GOT!r})
    except OSError:
        pass
""",
    )


@attack(fallback="links lead wherever the instructor may read")
def follows_symlinks(release):
    """Puts links to the course in place of its own files, and reads through them."""
    return cheat(
        release,
        f"""
import os
for number, target in enumerate(({str(ROOT / "solutions")!r}, {str(OUTSIDE)!r}, "/proc/1/root/root")):
    try:
        os.symlink(target, f"link{{number}}")
        if os.listdir(f"link{{number}}"):
            print({GOT!r})
    except OSError:
        pass
""",
    )


FORGE = """
import os
for descriptor in range(3, 64):
    try:
        os.write(descriptor, {!r})
    except OSError:
        pass
"""


@attack(lost=LAST, says="p3-small_angle_frequency: ")
def forged_replies(release):
    """Writes replies of its own to the runner's descriptors, ahead of the calls."""
    lines = b'{"outputs": []}\n{"replies": [' + b",".join([b'{"value": 4.0}'] * 24) + b"]}\n"
    return last(release, FORGE.format(lines))


@attack(lost=LAST, says="p3-small_angle_frequency: ")
def forged_verdicts(release):
    """Writes what is no reply: a verdict, a score, nothing, half a line."""
    lines = (
        b'{"outputs": []}\n{"replies": [{"value": 1, "credit": 1.0}, {"credit": 1e6}, null]}\n{"a'
    )
    return last(release, FORGE.format(lines))


@attack(lost=LAST, says="p3-small_angle_frequency: ")
def reply_flood(release):
    """Writes to the runner's descriptors without end."""
    return last(
        release, FORGE.format(b"x" * 65536).replace("range(3, 64)", "[*range(3, 9)] * 99999")
    )


@attack()
def patched_wall(release):
    """Patches the part of the wall that is in the room, to always have an answer."""
    return cheat(
        release,
        """
import numpy as np, wall
answer = wall.answer
def patched(call, namespace):
    if call.name == "g_vec":
        return wall.Reply(value=np.ones(1))
    return answer(call, namespace)
wall.answer = patched
read = wall.read_numbers
wall.read_numbers = lambda value: read(value)
""",
    )


@attack()
def patched_json(release):
    """Patches the JSON that leaves the room, to add credit and a verdict of its own."""
    return cheat(
        release,
        """
import json
dumps = json.dumps
def patched(message, **kwargs):
    for reply in message.get("replies", []):
        reply.update(credit=1.0, state="correct", score=1e6)
    return dumps(message, **kwargs)
json.dumps = patched
""",
    )


@attack()
def patched_random(release):
    """Patches random numbers, so that the judge would draw the same case again and again."""
    return cheat(
        release,
        """
import numpy as np, random
np.random.seed(20260101)
np.random.default_rng = lambda *args: np.random.Generator(np.random.PCG64(20260101))
random.seed = lambda *args: None
""",
    )


@attack()
def answers_an_earlier_call(release):
    """Answers with what belongs to the inputs of an earlier call."""
    return cheat(
        release,
        g_vec="""
seen = []
def g_vec(q, pend):
    seen.append(pend.m * pend.g * pend.lc * np.sin(q))
    return seen[0]
""",
    )


@attack()
def table_of_visible_cases(release):
    """Right for the cases that a student sees, which are written into the answer."""
    from numpy.random import default_rng

    from autograder.check import VISIBLE_SEED
    from autograder.judge import VISIBLE_CASES
    from autograder.problems import CHECKS

    check = CHECKS["p3-g_vec"]
    calls = check.calls(default_rng(VISIBLE_SEED), VISIBLE_CASES)
    table = {f"{call.args[0][0]:.9f}": check.reference(*call.args) for call in calls}
    return cheat(release, g_vec=function("g_vec", f"{table!r}.get(f'{{q[0]:.9f}}', 1.0)"))


@attack()
def knows_the_grader(release):
    """Finds out where it runs, and answers the grader differently."""
    return cheat(
        release,
        g_vec="""
import os, sys
here = "wall" in sys.modules or not hasattr(get_ipython(), "kernel") or os.getcwd() == "/tmp"
def g_vec(q, pend):
    return 1 + 0 * q if here else pend.m * pend.g * pend.lc * np.sin(q)
""",
    )


@attack(says="g_vec(q, pend) raised NameError")
def clears_the_namespace(release):
    """Takes all names away before it is judged."""
    return cheat(release, g_vec="globals().clear()\n" + RIGHT["g_vec"])


@attack(says="The notebook defines no g_vec.")
def another_language(release):
    """Hands its cell to a shell, with commands that read and write."""
    return cheat(
        release, g_vec="%%bash\ncat /etc/shadow && echo got ${x:-through} the wall\nexit 1"
    )


@attack()
def forged_card(release):
    """Shows a verdict of its own, with a script for the instructor's browser."""
    return cheat(
        release,
        """
from IPython.display import HTML, Javascript
display(HTML("<div class='armdyn-verdict'><script>forged()</script>p3-g_vec: all right</div>"))
display(Javascript("forged()"))
display({"text/html": "<script>forged()</script>", "image/png": '"><script>forged()</script>'}, raw=True)
""",
    )


@attack()
def forged_outputs(release):
    """Comes with the outputs of a perfect run in its cells."""
    notebook = cheat(release)
    for cell in notebook.cells:
        if cell.cell_type == "code":
            data = {"text/plain": "1000000.0", "text/html": "<script>forged()</script>"}
            cell.outputs = [new_output("execute_result", data=data, execution_count=1)]
            cell.execution_count = 1
    return notebook


def claims(notebook, name):
    return cell_of(notebook, name).metadata["nbgrader"]


@attack(says="the nbgrader settings of p3-g_vec had been changed")
def forged_points(release):
    """Claims a million points for a grade cell."""
    notebook = cheat(release)
    claims(notebook, "p3-g_vec")["points"] = 1e6
    claims(notebook, "p3-M")["points"] = float("nan")
    claims(notebook, "p3-C")["points"] = "many"
    claims(notebook, "p3-lagrangian")["points"] = -3
    return notebook


@attack()
def edited_checks(release):
    """Writes a score into the grade cells in place of their checks."""
    notebook = cheat(release)
    for name in POINTS:
        cell_of(notebook, name).source = f"1000000  # check({name!r})"
    return notebook


@attack(says="the nbgrader settings of answer-g_vec had been changed")
def reflagged_cells(release):
    """Makes its answer a grade cell and the grade cell an answer."""
    notebook = cheat(release)
    claims(notebook, "p3-g_vec").update(solution=True, locked=False)
    claims(notebook, "answer-g_vec").update(grade=True, solution=False, points=100)
    claims(notebook, "p3-derivation").update(grade=False)
    return notebook


@attack(says="p3-g_vec was missing; it was put back")
def deleted_checks(release):
    """Deletes the check that it does not pass, and the setup."""
    notebook = cheat(release)
    notebook.cells.remove(cell_of(notebook, "p3-g_vec"))
    notebook.cells.remove(cell_of(notebook, "p3-setup"))
    return notebook


@attack(says="p3-M was there more than once; the last one counts")
def duplicated_cells(release):
    """Copies grade cells it passes, to count more than once, and an answer it does not pass."""
    notebook = cheat(release)
    notebook.cells += [copy.deepcopy(cell_of(notebook, "p3-M")) for _ in range(5)]
    notebook.cells.append(copy.deepcopy(cell_of(notebook, "answer-g_vec")))
    return notebook


@attack(says="The notebook defines no g_vec.")
def reordered_cells(release):
    """Moves the grade cell of g_vec to the top of the notebook."""
    notebook = cheat(release)
    grade_cell = cell_of(notebook, "p3-g_vec")
    notebook.cells.remove(grade_cell)
    notebook.cells.insert(0, grade_cell)
    return notebook


@attack(says="a cell that claims to be p3-bonus, which the source does not have")
def renamed_cells(release):
    """Renames the grade cell it does not pass, and adds one of its own."""
    notebook = cheat(release)
    extra = copy.deepcopy(cell_of(notebook, "p3-g_vec"))
    extra.metadata["nbgrader"].update(grade_id="p3-bonus", points=1e6)
    claims(notebook, "p3-g_vec")["grade_id"] = "p3-g-vec"
    notebook.cells.append(extra)
    return notebook


@attack(says="p3-g_vec had been made a markdown cell")
def retyped_cells(release):
    """Makes the grade cell text, which a person would have to read."""
    notebook = cheat(release)
    cell = cell_of(notebook, "p3-g_vec")
    cell.cell_type = "markdown"
    del cell["outputs"], cell["execution_count"]
    return notebook


@attack(says="p3-M was there more than once; the last one counts")
def repointed_cells(release):
    """Points the grade cell of g_vec to M, which is right."""
    notebook = cheat(release)
    claims(notebook, "p3-g_vec")["grade_id"] = "p3-M"
    return notebook


@attack()
def broken_claims(release):
    """Comes with nbgrader settings of every wrong kind, checksums among them."""
    notebook = cheat(release)
    for name, checksum in zip(POINTS, (1, 1e6, None, ["a"], {"a": 1}, "x" * 1000), strict=True):
        claims(notebook, name)["checksum"] = checksum
    for cell, wrong in zip(
        notebook.cells, ("p3-M", 1, None, [], {"grade_id": ["p3-M"]}), strict=False
    ):
        if "nbgrader" not in cell.metadata:
            cell.metadata["nbgrader"] = wrong
    return notebook


@attack()
def wrong_kernel(release):
    """Names a kernel and a language that do not exist here."""
    notebook = cheat(release)
    notebook.metadata["kernelspec"] = {"name": "no-such-kernel", "display_name": GOT.title()}
    notebook.metadata["language_info"] = {"name": "cobol"}
    return notebook


@attack()
def great_cell(release):
    """Fifty million letters of text, and as many in outputs."""
    notebook = cheat(release)
    notebook.cells[1].source = "x" * 50_000_000
    cell_of(notebook, "answer-M").outputs = [new_output("stream", text="y" * 50_000_000)]
    return notebook
