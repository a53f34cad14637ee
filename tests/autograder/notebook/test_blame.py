"""Which cell is blamed for a function that is not there."""

import time

import pytest

from autograder.judging.faults import describe_fault
from autograder.notebook.blame import Ran, explained, ran
from autograder.protocol import Fault, FaultKind

MISSING = Fault(FaultKind.MISSING)
UNWRITTEN = Fault(FaultKind.NOT_IMPLEMENTED)


def stopped(source, at=0, line=""):
    return Ran(source, "NameError: x", True, at, line)


@pytest.mark.parametrize(
    "source",
    [
        "def M(q):\n    return x",
        "import x\n\ndef M (q): return 1",
        "async def M(q): pass",
        "class M: pass",
        "@x\ndef M(q): pass",
        "M = x",
        "C = M = x",
        "M: int = x",
        "C, M = x",
        "(C, M), *D = x",
        "[C,\tM] = x",
        "a = 1; M = x",
        "print(M := x)",
        "import M",
        "import x as M",
        "from x import C, M",
        "from x import (\n    C,\n    M,\n)",
        "from . import M",
        "if x:\n    def M(q): pass\nelse:\n    M = None",
        "try:\n    x\nfinally:\n    M = 1",
        "def make():\n    global M\n    M = x\nmake()",
        "exec('def M(q): return x')",
        "exec('''\ndef M(q):\n    return x\n''')",
        "%matplotlib inline\ndef M(q) return x",
        "def C(q):\n    return 1\nM = x",
    ],
)
def test_the_cell_that_should_define_it_is_blamed(source):
    cells = [Ran("import numpy"), stopped(source, 1, "line 1: x"), Ran("def C(q): pass")]
    blamed = Fault(FaultKind.CELL_FAILED, "NameError: x", "line 1: x")
    assert explained("M", MISSING, cells) == blamed
    assert explained("M", Fault(FaultKind.MISSING, "M_"), cells) == blamed


@pytest.mark.parametrize(
    "source",
    [
        "M(q, arm)",
        "show(M=M)",
        "x = f(M=1)",
        "x = [M == 1]",
        "M == x",
        "M[0] = x",
        "arm.M = x",
        "M += x",
        "# M = x",
        "def C(q):\n    M = x\n    import M\n    return M",
        "class A:\n    def M(self): pass",
        "MM = x",
    ],
)
def test_a_cell_that_only_uses_it_is_not(source):
    assert explained("M", MISSING, [stopped(source)]) == MISSING


@pytest.mark.parametrize(
    "source",
    ["from model import *", "exec(open('M.py').read())", "%run model.py", "globals()[n] = x"],
)
def test_a_cell_that_may_define_anything_is_blamed_where_no_other_is(source):
    cells = [stopped(source)]
    assert explained("M", MISSING, cells).kind is FaultKind.CELL_FAILED
    near = Fault(FaultKind.MISSING, "MM")
    assert explained("M", near, cells) == near
    cells = [Ran("M = x", "ValueError: y", True), *cells]
    assert explained("M", MISSING, cells).message == "ValueError: y"


def test_a_line_that_was_left_out_is_told():
    fault = explained("M", MISSING, [Ran("%run m.py", left_out=("%run m.py was left out: no",))])
    said = describe_fault(fault, "M", "M(q, arm)")
    assert said.endswith("Did you run its cell? Before that, %run m.py was left out: no.")


@pytest.mark.parametrize("fault", [UNWRITTEN, Fault(FaultKind.RAISED, "ValueError: z", "line 1")])
def test_an_earlier_definition_does_not_hide_that_the_last_one_failed(fault):
    cells = [Ran("def M(q): pass"), stopped("x\ndef M(q): pass", 1, "line 1: x")]
    assert explained("M", fault, cells) == Fault(FaultKind.STALE, "NameError: x", "line 1: x")
    assert explained("M", fault, [*cells, Ran("def M(q): pass")]) == fault


@pytest.mark.parametrize(
    "last",
    [
        stopped("def M(q): pass\nx", 2),
        Ran("%time x\ndef M(q): pass", "NameError: x", False, 1),
        stopped("def C(q): pass", 1),
    ],
)
def test_a_cell_that_came_as_far_as_its_definition_is_not_blamed(last):
    assert explained("M", UNWRITTEN, [Ran("def M(q): pass"), last]) == UNWRITTEN


def test_what_is_said_fits_a_line():
    error = {
        "output_type": "error",
        "ename": "E\n",
        "evalue": "x" * 10**6,
        "line": ["?"],
        "at": "?",
    }
    cell = ran("M = 1", [{"output_type": "stream", "left_out": "a\nb"}, error])
    assert len(cell.error) == 300
    assert cell == Ran("M = 1", cell.error, False, 0, "", ("a\\nb",))
    assert "\n" not in cell.error


def test_a_huge_cell_is_read_in_no_time():
    start = time.process_time()
    for line in (
        "as " * 10**5 + "M",
        "M, " * 10**5 + "= M",
        "import (" * 10**5 + "M",
        "M\n" * 10**6,
    ):
        explained("M", MISSING, [stopped(line)])
    assert time.process_time() - start < 1
