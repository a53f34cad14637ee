"""Honest submissions to p3-pendulum that look unusual: all answers are right, so they must lose nothing.

Each is a function that edits the released notebook; its docstring says what is unusual about it.
"""

import copy

from nbformat.v4 import new_code_cell, new_markdown_cell

from tests.submissions.answers import cell_of
from tests.submissions.p3_pendulum import RIGHT, function, right_but

VARIANTS = {}


def variant(edit):
    VARIANTS[edit.__name__] = edit
    return edit


def after(notebook, grade_id, *cells):
    """Put the cells behind the one of this grade_id."""
    at = notebook.cells.index(cell_of(notebook, grade_id)) + 1
    notebook.cells[at:at] = cells
    return notebook


@variant
def warnings_on_stderr(release):
    """Warns when a cell runs and in every call: a zero division, a warning, a print to stderr."""
    return right_but(
        release,
        g_vec="""
import sys, warnings
np.log(np.zeros(2))
warnings.warn("about this cell")
def g_vec(q, pend):
    np.array([1.0]) / np.zeros(1)
    warnings.warn("about this call")
    print("careful", file=sys.stderr)
    return pend.m * pend.g * pend.lc * np.sin(q)
""",
    )


@variant
def warnings_as_errors_elsewhere(release):
    """Turns warnings into errors while trying something out, and leaves it so."""
    return after(
        right_but(release),
        "p3-setup",
        new_code_cell("import warnings\nwarnings.simplefilter('error')\nnp.seterr(all='raise')"),
    )


@variant
def prints(release):
    """Prints in cells and in calls, with letters of all alphabets."""
    return right_but(
        release,
        M="print('M für q̇', '机器人', '\\U0001f916')\n"
        + function("M", "[[print('M of', q) or pend.I]]"),
    )


@variant
def plots(release):
    """Draws at top level, with and without show."""
    return after(
        right_but(release),
        "answer-g_vec",
        new_code_cell(
            "import matplotlib.pyplot as plt\nplt.plot([0, 1])\nplt.show()\nplt.figure()\n"
            "plt.plot([1, 0]);"
        ),
        new_code_cell("fig, ax = plt.subplots()\nax.plot(*np.ones((2, 4)))"),
    )


@variant
def inline_magic(release):
    """`%matplotlib inline` and other magics of an interactive session."""
    return after(
        right_but(release),
        "p3-setup",
        new_code_cell("%matplotlib inline\n%config InlineBackend.figure_format = 'retina'"),
        new_code_cell("%time sum(range(9))\nnp.sin?"),
    )


@variant
def helper_cells(release):
    """Functions of its own in cells between the graded ones."""
    notebook = right_but(
        release,
        g_vec=function("g_vec", "weight(pend) * lever(q, pend)"),
        M=function("M", "np.atleast_2d(inertia(pend))"),
    )
    helper = "def weight(pend):\n    return pend.m * pend.g\n\ninertia = lambda pend: pend.I"
    after(notebook, "p3-setup", new_code_cell(helper))
    lever = "def lever(q, pend):\n    return pend.lc * np.sin(q)"
    return after(notebook, "answer-C", new_code_cell(lever))


@variant
def lists_for_arrays(release):
    """Lists, tuples and plain floats where arrays are asked for."""
    return right_but(
        release,
        M=function("M", "((pend.I,),)"),
        C=function("C", "[[0]]"),
        g_vec="from math import sin\n"
        + function("g_vec", "[pend.m * pend.g * pend.lc * sin(angle) for angle in q]"),
    )


@variant
def single_precision(release):
    """Computes and returns in float32."""
    return right_but(
        release,
        M=function("M", "np.array([[pend.I]], dtype=np.float32)"),
        g_vec=function(
            "g_vec",
            "np.float32(pend.m) * np.float32(pend.g) * np.float32(pend.lc)"
            " * np.sin(q.astype(np.float32))",
        ),
        small_angle_frequency=function(
            "small_angle_frequency",
            "np.sqrt(np.float32(pend.m * pend.g * pend.lc) / np.float32(pend.I))",
        ),
    )


@variant
def sympy_numbers(release):
    """Evaluates a SymPy expression, and returns its numbers as they are."""
    return right_but(
        release,
        g_vec=function(
            "g_vec", "[sp.Float(pend.m * pend.g * pend.lc) * sp.sin(float(q[0])).n(20)]"
        ),
        M=function("M", "sp.Matrix([[pend.I]])"),
    )


@variant
def lambdified(release):
    """Derives g from its Lagrangian with SymPy, and turns it into a function."""
    return right_but(
        release,
        g_vec="""
_s = sp.symbols("q qd m lc I g", real=True)
_g = sp.lambdify(_s, -sp.diff(lagrangian(*_s), _s[0]))
def g_vec(q, pend):
    return _g(q, 0.0, pend.m, pend.lc, pend.I, pend.g)
""",
    )


@variant
def vectorised(release):
    """Written for a batch of states: broadcasting, einsum, no loop."""
    return right_but(
        release,
        M=function("M", "np.broadcast_to(pend.I, np.shape(q) + (1,))"),
        C=function("C", "np.einsum('...i,...j->...ij', qd, 0 * qd)"),
        g_vec=function("g_vec", "pend.m * pend.g * pend.lc * np.sin(np.asarray(q))[..., :1]"),
    )


@variant
def markdown_moved(release):
    """Moves the text around, and adds notes and an attachment."""
    notebook = right_but(release)
    texts = [cell for cell in notebook.cells if cell.cell_type == "markdown"]
    texts = [cell for cell in texts if "nbgrader" not in cell.metadata]
    for cell in texts[::2]:
        notebook.cells.remove(cell)
        notebook.cells.append(cell)
    note = new_markdown_cell("My notes ![photo](attachment:a.png)")
    note.attachments = {"a.png": {"image/png": "iVBORw0KGgo="}}
    notebook.cells.insert(0, note)
    return notebook


@variant
def split_cells(release):
    """Splits answers over several cells; the half with the name is the student's own cell."""
    notebook = right_but(release, M="inertia_of = 'pend.I'", g_vec="# see the next cell")
    after(notebook, "answer-M", new_code_cell(RIGHT["M"].strip()))
    return after(
        notebook,
        "answer-g_vec",
        new_code_cell("def torque(q, pend):\n    return pend.m * pend.g * pend.lc * np.sin(q)"),
        new_code_cell("g_vec = torque"),
    )


@variant
def copied_cells(release):
    """Keeps a copy of an answer and of its check further down, as copy and paste leaves them."""
    notebook = right_but(release)
    for name in ("answer-g_vec", "p3-g_vec"):
        notebook.cells.append(copy.deepcopy(cell_of(notebook, name)))
    return notebook


@variant
def first_try_kept(release):
    """Keeps a first, wrong try above the right answer, and an error in a scratch cell."""
    notebook = right_but(release)
    at = notebook.cells.index(cell_of(notebook, "answer-g_vec"))
    notebook.cells[at:at] = [
        new_code_cell(function("g_vec", "pend.m * q")),
        new_code_cell("1 / 0"),
        new_code_cell("def unfinished(:"),
        new_code_cell("%no_such_magic"),
    ]
    return notebook


@variant
def own_imports(release):
    """A cell of its own imports, in its own names, with seeds and print options."""
    notebook = right_but(
        release, g_vec=function("g_vec", "pend.m * pend.g * pend.lc * numpy.sin(q)")
    )
    source = (
        "import json, math, os, random, sys, time, numpy, scipy\n"
        "from numpy import *\nfrom sympy import *\nimport numpy as np, sympy as sp\n"
        "np.set_printoptions(precision=2)\nnp.random.seed(1)\nrandom.seed(1)\ninit_printing()"
    )
    return after(notebook, "p3-setup", new_code_cell(source))


@variant
def type_hints(release):
    """Type hints, keyword-only defaults and a docstring."""
    return right_but(
        release,
        g_vec='''
from __future__ import annotations
from numpy.typing import NDArray
def g_vec(q: NDArray[np.float64], pend: SimpleNamespace, /, *, sign: float = 1.0) -> NDArray:
    """Gravity torque, N·m."""
    torque: float = pend.m * pend.g * pend.lc
    return sign * torque * np.sin(q)
''',
    )


@variant
def classes(release):
    """A dataclass with methods, which the answers use; one answer is a method itself."""
    return right_but(
        release,
        M="""
from dataclasses import dataclass
@dataclass
class Body:
    pend: SimpleNamespace
    @property
    def inertia(self):
        return np.array([[self.pend.I]])
    def gravity(self, q):
        return self.pend.m * self.pend.g * self.pend.lc * np.sin(q)
def M(q, pend):
    return Body(pend).inertia
""",
        g_vec="class Gravity:\n    def __call__(self, q, pend):\n"
        "        return Body(pend).gravity(q)\ng_vec = Gravity()",
    )


@variant
def cached(release):
    """Remembers results with functools, and counts its calls in a global."""
    return right_but(
        release,
        g_vec="""
from functools import lru_cache
count = 0
@lru_cache
def torque(angle, m, g, lc):
    global count
    count += 1
    return m * g * lc * np.sin(angle)
def g_vec(q, pend):
    return torque(float(q[0]), pend.m, pend.g, pend.lc)
""",
    )


@variant
def works_in_place(release):
    """Changes what it is given, in ways that change no second result, and returns a part of it."""
    return right_but(
        release,
        g_vec="""
def g_vec(q, pend):
    q %= 2 * np.pi
    return pend.m * pend.g * pend.lc * np.sin(q)
""",
        C="def C(q, qd, pend):\n    qd[:] = 0\n    pend.m = 0\n    return qd",
    )


@variant
def own_files(release):
    """Writes a data file and reads it back; tries a module of its own."""
    return after(
        right_but(release),
        "p3-setup",
        new_code_cell("%%writefile mine.py\ndef double(x):\n    return 2 * x"),
        new_code_cell("import sys\nsys.path.insert(0, '.')\nimport mine\nmine.double(2)"),
        new_code_cell("np.save('data.npy', np.eye(2))\nnp.load('data.npy')"),
    )


@variant
def threads_and_timing(release):
    """Uses a pool of threads and measures time."""
    return right_but(
        release,
        g_vec="""
import time
from concurrent.futures import ThreadPoolExecutor
def g_vec(q, pend):
    start = time.perf_counter()
    with ThreadPoolExecutor(2) as pool:
        (torque,) = pool.map(lambda angle: pend.m * pend.g * pend.lc * np.sin(angle), q)
    return torque + 0 * (time.perf_counter() - start)
""",
    )


@variant
def asks_for_input(release):
    """A scratch cell asks for something with input()."""
    return after(right_but(release), "p3-setup", new_code_cell("name = input('your name? ')"))


@variant
def old_format(release):
    """Saved by an older Jupyter: nbformat 4.2, no cell ids."""
    notebook = right_but(release)
    notebook.nbformat_minor = 2
    for cell in notebook.cells:
        cell.pop("id", None)
    return notebook


@variant
def another_order_of_working(release):
    """Answers C before M: whole parts moved, each with its check."""
    notebook = right_but(release)
    part = [cell_of(notebook, name) for name in ("answer-C", "p3-C")]
    for cell in part:
        notebook.cells.remove(cell)
    at = notebook.cells.index(cell_of(notebook, "answer-M"))
    notebook.cells[at:at] = part
    return notebook
