"""Attacks that hook into the room's Python: into what reads, calls, imports, prints and ends there."""

from tests.submissions.attack import FORGE, GOT, LAST, attack, cheat, last


@attack()
def traces_the_caller(release):
    """Traces all frames but a library's, its caller's too, for right values and for ways out."""
    return cheat(
        release,
        f"""
import sys, threading
def trace(frame, event, argument):
    if "site-packages" in frame.f_code.co_filename:
        return None
    if {{"expected", "reference", "verdict"}} & set(frame.f_locals):
        print({GOT!r})
    if event == "return" and frame.f_code.co_name in ("answer", "read_numbers"):
        frame.f_locals.update({{"result": 1.0, "met": True, "credit": 1.0}})
    return trace
sys.settrace(trace)
sys.setprofile(lambda *event: None)
threading.settrace(trace)
""",
    )


@attack(lost=LAST, says="p3-small_angle_frequency: error in your code")
def last_words(release):
    """Has replies written when Python ends, and ends it in the call."""
    lines = b'{"replies": [' + b",".join([b'{"value": 4.0}'] * 24) + b"]}\n"
    forge = FORGE.format(lines).replace("\n", "\n    ")
    say = f"import atexit, sys\ndef say():{forge}\natexit.register(say)\n"
    body = "def small_angle_frequency(pend):\n    say()\n    sys.exit(0)"
    return cheat(release, small_angle_frequency=say + body)


@attack(lost=LAST, says="p3-small_angle_frequency: error in your code")
def replaced_builtins(release):
    """Replaces what Python itself is made of: float, isinstance, len, open, print, __import__."""
    return last(
        release,
        """
import builtins
true_import = builtins.__import__
builtins.__import__ = lambda name, *more: true_import("math" if name == "json" else name, *more)
builtins.isinstance = lambda thing, kind: True
builtins.float = builtins.abs = lambda *value: 0.0
builtins.all = builtins.any = builtins.callable = lambda *things: True
builtins.len = builtins.max = lambda *things: 1
""",
    )


@attack()
def patched_numpy(release):
    """Patches the NumPy that reads its answers, to give the same array for each."""
    return cheat(
        release,
        """
import numpy as np
asarray, array = np.asarray, np.array
def lies(value, *args, **kwargs):
    return array([1.0]) if type(value).__name__ == "Lie" else asarray(value, *args, **kwargs)
np.asarray = np.asanyarray = lies
np.isfinite = lambda value: array(True)
class Lie: pass
""",
        g_vec="def g_vec(q, pend):\n    return Lie()",
    )


@attack()
def shell_hooks(release):
    """Registers with every hook that IPython has: events, exceptions, display, history, magics."""
    return cheat(
        release,
        """
shell = get_ipython()
for event in ("pre_execute", "pre_run_cell", "post_execute", "post_run_cell"):
    shell.events.register(event, lambda *info: globals().update(check=lambda *a, **k: 1e6))
shell.set_custom_exc((Exception,), lambda shell, kind, error, tb, tb_offset=None: None)
shell.display_formatter.format = lambda *args, **kwargs: ({"text/plain": "1000000"}, {})
shell.display_pub.publish = lambda *args, **kwargs: None
shell.showtraceback = shell._showtraceback = lambda *args, **kwargs: None
shell.register_magic_function(lambda line, cell=None: 1e6, "line_cell", "check")
import sys
sys.displayhook = sys.excepthook = sys.unraisablehook = lambda *args: None
""",
    )


@attack()
def import_hooks(release):
    """Puts itself where Python looks for modules, and hands out a judge of its own."""
    return cheat(
        release,
        """
import importlib.abc, importlib.machinery, sys
class Finder(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in ("autograder", "armdyn", "protocol", "json"):
            return importlib.machinery.ModuleSpec(name, self, is_package=True)
    def exec_module(self, module):
        module.check = module.judge = module.dumps = lambda *args, **kwargs: 1e6
sys.meta_path.insert(0, Finder())
for name in ("autograder", "protocol", "json"):
    sys.modules.pop(name, None)
from autograder import check
import protocol
""",
    )


@attack()
def searches_memory(release):
    """Searches its process's whole memory for a name that only the judge's side has."""
    return cheat(
        release,
        f"""
import re
# Written so that this cell is not what it finds.
name = re.compile(b"PENDULUM[_]GRAVITY")
with open("/proc/self/maps") as maps, open("/proc/self/mem", "rb", 0) as memory:
    for line in maps:
        first, end = (int(at, 16) for at in line.split()[0].split("-"))
        try:
            memory.seek(first)
            if name.search(memory.read(min(end - first, 1 << 27))):
                print({GOT!r})
        except (OSError, OverflowError, ValueError):
            pass
""",
    )


@attack()
def more_replies_than_calls(release):
    """Has the room send more replies than there were calls, with credit in them."""
    return cheat(
        release,
        """
import protocol
encode, answer_all = protocol.encode_reply, protocol.answer_all
protocol.encode_reply = lambda reply: encode(reply) | {"credit": 1.0, "state": "correct"}
def many(calls, names):
    return answer_all(calls, names) * (100 if calls[0].name == "g_vec" else 1)
protocol.answer_all = many
""",
    )


@attack(lost=LAST, says="p3-small_angle_frequency: error in your code")
def nested_replies(release):
    """Replies with values nested as deeply as JSON can be read, and outputs nested so."""
    deep = b"[" * 900 + b"]" * 900
    lines = b'{"outputs": [{"output_type": "error", "ename": "a", "evalue": "b", "traceback": '
    lines += deep + b'}]}\n{"replies": [' + b",".join([b'{"value": ' + deep + b"}"] * 4) + b"]}\n"
    return last(release, FORGE.format(lines))


@attack(says="p3-g_vec: error in your code")
def audit_hook(release):
    """Sets an audit hook, which nobody can take away, that ends Python when it is judged."""
    return cheat(
        release,
        g_vec="""
import os, sys
armed = []
def hook(event, arguments):
    if armed:
        os._exit(0)
sys.addaudithook(hook)
def g_vec(q, pend):
    armed.append(1)
    open("/dev/null")
""",
    )
