"""Attacks on the judge: on what it runs with, and on where it may keep the right answers."""

from tests.submissions.attack import FORGE, GOT, LAST, OUTSIDE, ROOT, attack, cheat, last


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


@attack(fallback="modules that it writes outside its folder stay, for other programs to import")
def shadowed_modules(release):
    """Writes modules that shadow those of the judge, and has them imported."""
    return cheat(
        release,
        """
import os, sys
for name in ("protocol", "json", "numpy", "runner", "autograder", "sitecustomize", "armdyn"):
    for folder in (".", "/tmp", "/room", os.path.expanduser("~")):
        try:
            with open(os.path.join(folder, name + ".py"), "w") as file:
                file.write("print('shadowed')")
        except OSError:
            pass
sys.path.insert(0, os.getcwd())
for name in ("protocol", "json", "runner", "__main__"):
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


@attack(fallback="the checkout's modules can be imported")
def hunts_modules(release):
    """Looks for the problems and the models among the modules, loaded or not."""
    return cheat(
        release,
        g_vec=f"""
import importlib, sys
sys.path[:0] = [{str(ROOT)!r}, {str(ROOT / "lib")!r}, {str(ROOT / "autograder")!r}]
for name in ("autograder", "armdyn"):
    sys.modules.pop(name, None)
def g_vec(q, pend):
    for name in ("autograder.judging.check", "autograder.problems", "armdyn.models", "check"):
        try:
            importlib.import_module(name)
        except ImportError:
            continue
        raise RuntimeError({GOT!r})
    if any(name.startswith(("autograder.", "armdyn.")) for name in sys.modules):
        raise RuntimeError({GOT!r})
    return 1 + 0 * q
""",
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


@attack(lost=LAST, says="p3-small_angle_frequency: ")
def forged_replies(release):
    """Writes replies of its own to the runner's descriptors, ahead of the calls."""
    lines = b'{"outputs": []}\n{"replies": [' + b",".join([b'{"value": 4.0}'] * 24) + b"]}\n"
    return last(release, FORGE.format(lines))


@attack(lost=LAST, says="p3-small_angle_frequency: error in your code")
def forged_verdicts(release):
    """Writes what is no reply: a verdict, a score, nothing, half a line."""
    lines = (
        b'{"outputs": []}\n{"replies": [{"value": 1, "credit": 1.0}, {"credit": 1e6}, null]}\n{"a'
    )
    return last(release, FORGE.format(lines))


@attack()
def patched_wall(release):
    """Patches the part of the protocol that is in the room, to always have an answer."""
    return cheat(
        release,
        """
import numpy as np, protocol
answer = protocol.answer
def patched(call, namespace):
    if call.name == "g_vec":
        return protocol.Reply(value=np.ones(1))
    return answer(call, namespace)
protocol.answer = patched
read = protocol.read_numbers
protocol.read_numbers = lambda value: read(value)
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
