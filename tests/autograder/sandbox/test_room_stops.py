"""Cells that hold on to life at their limit: each ends soon, with our sentence, and the room goes on."""

from autograder.protocol import Call, Fault, FaultKind
from autograder.sandbox import room as sandbox
from autograder.sandbox.room import Room, TooLongError
from tests.autograder.sandbox.rooms import COLD_AT_NIGHT, failed, printed

LIMIT = 0.2
# Until a stop has come through all that catches it, s of processor time.
SOON = 1.5

DYING = """
class Dying:
    def __del__(self):
        sum(range(2_000))
"""
CELLS = {
    "a loop": "while True: pass",
    "except Exception": """
while True:
    try:
        sum(range(1000))
    except Exception:
        pass""",
    "a bare except": """
try:
    while True: pass
except:
    pass
print('swallowed')""",
    "an error of its own": """
try:
    while True: pass
except BaseException as error:
    raise ValueError('mine') from error""",
    "finally": """
try:
    while True: pass
finally:
    sum(range(300_000))""",
    "finally, and a loop in it": """
try:
    while True: pass
finally:
    while True: pass""",
    "contexts": """
import contextlib
while True:
    with contextlib.suppress(Exception):
        sum(range(100))""",
    "destructors": f"{DYING}\nwhile True: Dying()",
    "destructors below C": f"{DYING}\nall(Dying() for _ in iter(int, 1))",
    "destructors in a lambda": f"{DYING}\nwhile True: max(map(lambda _: Dying() and 1, 'ab'))",
    "a destructor that never ends": """
class Endless:
    def __del__(self):
        while True: pass
Endless()
while True: pass""",
    "generators": """
def given():
    try:
        while True: yield 1
    finally:
        sum(range(100))
while True: next(given())""",
    "recursion": """
def deep(n):
    try:
        return deep(n + 1)
    except RecursionError:
        return n
while True: deep(0)""",
    "SymPy": "sp.simplify(sum(sp.sin(k * x) ** k / (x + k) for k in range(1, 40)))",
    "below a magic": "%%time\nwhile True: pass",
    "a cell that a cell runs": "get_ipython().run_cell('while True: pass')\nprint('after')",
    "await": "import asyncio\nwhile True: await asyncio.sleep(0)",
}


@COLD_AT_NIGHT
def test_a_cell_ends_at_its_limit_with_our_sentence_whatever_it_catches(way):
    said, slow = {}, {}
    with Room(way) as room:
        room.run("import sympy as sp\nx = sp.symbols('x')")
        for name, source in CELLS.items():
            before = room.used
            said[name] = failed(room, source, LIMIT)
            if room.used - before > SOON:
                slow[name] = room.used - before
        assert printed(room, "print(sp.diff(x**2, x))") == "2*x"
    assert said == dict.fromkeys(CELLS, "TimeoutError: this cell ran longer than 0.2 s")
    assert slow == {}


@COLD_AT_NIGHT
def test_a_cell_that_swallows_every_stop_is_a_loss_that_is_named(way, monkeypatch):
    monkeypatch.setattr(sandbox, "GRACE_SECONDS", 0.4)
    cell = "while True:\n    try:\n        while True: pass\n    except: pass"
    with Room(way) as room:
        try:
            said = room.run(cell, LIMIT)[-1]["evalue"]
        except TooLongError as lost:
            said = str(lost)
    # The first where a stop came between one try and the next.
    told = "this cell ran longer than 0.2 s", "no reply within 1 s of processor"
    assert any(one in said for one in told)


@COLD_AT_NIGHT
def test_a_call_ends_at_its_limit_whatever_it_catches(way, monkeypatch):
    monkeypatch.setattr(sandbox, "GRACE_SECONDS", 30.0)
    names = ("a bare except", "destructors below C", "generators", "SymPy")
    with Room(way) as room:
        room.run("import sympy as sp, autograder\nx = sp.symbols('x')")
        room.run("import protocol.calls\nprotocol.calls.CALL_SECONDS = 0.2")
        for number, name in enumerate(names):
            body = CELLS[name].strip().replace("\n", "\n    ")
            room.run(f"def f{number}():\n    {body}\n    return 1.0")
            before = room.used
            (reply,) = room.ask([Call(f"f{number}", ())])
            assert reply.fault == Fault(FaultKind.TIMED_OUT, "0.2 s"), name
            assert room.used - before < SOON, name
        assert printed(room, "print('alive')") == "alive"
