"""Errors as Python, NumPy and SymPy really word them, and what a student reads of them.

Each row runs the wrong code. If a new version words it otherwise, no sentence is found, and this fails.
"""

import json
import linecache
import math
from types import SimpleNamespace

import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from autograder import protocol
from autograder.protocol import Call, Fault, FaultKind, Reply, Symbol, sentence_of
from autograder.protocol.riddles import decode_riddle, uses_caret
from autograder.protocol.riddles.reading import KNOWN, MOST_WORD, TABLE, Riddle

ARM = SimpleNamespace(l1=1.0, l2=0.8, lc1=0.5, m1=2.0)
Q = np.array([0.3, 0.4])
ARGUMENTS = {"q": Q, "qd": 2 * Q, "arm": ARM, "J": np.ones((6, 3)), "I": np.eye(6), "A": np.eye(2)}
NUMBER = iter(range(10**6))


def defined(body: str, arguments: str = "q, qd, arm, J, I, A") -> dict:
    """The namespace of a cell with def f, whose source Python can show as in a notebook."""
    body = body if "return" in body or "\n" in body else f"return {body}"
    lines = "".join(f"    {line}\n" for line in body.splitlines())
    source = f"def f({arguments}):\n{lines}"
    name = f"/tmp/ipykernel_1/{next(NUMBER)}.py"
    linecache.cache[name] = (len(source), None, source.splitlines(True), name)
    namespace = {"__name__": "__main__", "np": np, "sp": sp, "math": math}
    exec(compile(source, name, "exec"), namespace)
    return namespace


def fault_of(body: str) -> Fault:
    reply = protocol.answer(Call("f", tuple(ARGUMENTS.values())), defined(body))
    assert reply.fault is not None, reply
    return reply.fault


SIDES = "Each row of the matrix is an equation and needs its number on the right side."
PRODUCT = "In a product A @ B, the last length of A must be the first of B."
ENTRY_BY_ENTRY = "The signs +, −, * and / join arrays entry by entry."
COLUMNS = "some of its columns follow from others, or are zero. Which columns?"
CONDITION = "A condition needs one True or False, and"
MUST_HOLD = "Must all of them hold (np.all), or is one enough (np.any)?"
CASES = [
    (
        "symbol put into",
        "C = np.zeros((2, 2))\nx = sp.Symbol('x')\nC[0, 1] += sp.cos(x)\nreturn C",
        "C is an array of numbers, as np.zeros makes it, and this is a SymPy expression. "
        "A matrix made by sp.zeros takes it.",
    ),
    (
        "array for a symbol",
        "arm.m1 * sp.sin(q)",
        "sp.sin is for symbols, and this is an array of numbers: NumPy's own is np.sin.",
    ),
    (
        "two lists",
        "np.array([1.0, q[0]], [q[0], 2.0])",
        "np.array takes one list: its rows stand in one more pair of square brackets.",
    ),
    (
        "index of number",
        "u = eval('lambda t, x: x[0]')  # as the check's own\nreturn u(q, q[0])",
        "u got a single number where it takes an array. Are its arguments in the right order?",
    ),
    (
        "power",
        "arm.m1 ^ 2 / 2 - arm.l1 * (1 - q[0])",
        "In Python ^ is no power; the power is **, as in x**2.",
    ),
    ("matmul", "J @ I @ J.T", "J is (6, 3), and I is (6, 6). " + PRODUCT),
    ("matmul", "np.dot(J, I)", "J is (6, 3), and I is (6, 6). " + PRODUCT),
    ("matmul", "J.dot(I)", "J is (6, 3), and I is (6, 6). " + PRODUCT),
    ("matmul", "J.T @ I @ J.T", "J.T @ I is (3, 6), and J.T is (3, 6). " + PRODUCT),
    ("matmul", "K = sp.ones(2, 3)\nreturn K * K", "K is (2, 3), and K is (2, 3). " + PRODUCT),
    (
        "matmul of unknown shapes",
        "np.linalg.pinv(J) @ q",
        PRODUCT + " Here they are 6 and 2.",
    ),
    ("matmul of unknown shapes", "np.dot(J, np.dot(I, J))", PRODUCT + " Here they are 3 and 6."),
    ("two sides", "np.linalg.solve(I, q)", f"I is (6, 6), and q is (2,). {SIDES}"),
    ("two sides", "np.linalg.solve(I, J.T)", f"I is (6, 6), and J.T is (3, 6). {SIDES}"),
    ("two sides", "np.linalg.lstsq(J, q)[0]", f"J is (6, 3), and q is (2,). {SIDES}"),
    (
        "matmul number",
        "arm.m1 @ J",
        "arm.m1 is a single number, and @ multiplies matrices and vectors. A number is multiplied by *.",
    ),
    ("broadcast", "q * np.ones(3) if 0 else q + I", "q is (2,), and I is (6, 6). " + ENTRY_BY_ENTRY),
    ("broadcast", "q[:1] * 2 + J.T * I", "J.T is (3, 6), and I is (6, 6). " + ENTRY_BY_ENTRY),
    (
        "broadcast",
        "g = np.zeros(2)\ng -= J.T @ I @ J @ J[0]\nreturn g",
        "g is (2,), and J.T @ I @ J @ J[0] is (3,). " + ENTRY_BY_ENTRY,
    ),
    (
        "shape that stays",
        "x = np.zeros(2)\nx += np.diag(q) * qd\nreturn x",
        "x has the shape (2,), which += and its like do not change, and what would come out has (2,2). "
        "Is there a * where the product of a matrix and a vector, @, belongs?",
    ),
    (
        "whole numbers",
        "x = np.array([0, 0])\nx += q\nreturn x",
        "x is an array of whole numbers, as np.array([0, 0]) is, and can hold no others. Make it with "
        "np.zeros, or write 0.0.",
    ),
    (
        "called entry",
        "q(1) * arm.l1",
        "The entries of q stand in square brackets, q[1], and are counted from 0.",
    ),
    (
        "called entry",
        "2.0 * A(0, 1)",
        "The entries of A stand in square brackets, A[0, 1], and are counted from 0.",
    ),
    (
        "put into",
        "x = np.zeros(4)\nx[2:] = A\nreturn x",
        "An array of shape (2,2) does not fit where you put it: the place has the shape (2,).",
    ),
    (
        "singular",
        "W = np.array([[1.0, 2.0], [2.0, 4.0]])\nreturn np.linalg.solve(W, q)",
        f"W is (2, 2), and its rank is only 1: {COLUMNS}",
    ),
    (
        "singular",
        "W = np.array([[1.0, 0.0], [2.0, 0.0]])\nreturn np.linalg.inv(W.T @ W)",
        f"W.T @ W is (2, 2), and its rank is only 1: {COLUMNS}",
    ),
    (
        "some singular",
        "np.linalg.inv(np.zeros((2, 2)))",
        "Some columns of this matrix follow from others, or are zero. Which columns?",
    ),
    (
        "some singular",
        "sp.zeros(2, 2).inv()",
        "Some columns of this matrix follow from others, or are zero. Which columns?",
    ),
    ("square", "np.linalg.inv(J)", "J is (6, 3), and only a square matrix has an inverse."),
    (
        "index",
        "q[2]",
        "q has 2 entries, and Python counts from 0: q[0] is q1 and q[1] is q2.",
    ),
    ("index", "qd[2]", "qd has 2 entries, and Python counts from 0: qd[0] is q̇1 and qd[1] is q̇2."),
    (
        "index",
        "x = [1.0, 2.0, 3.0]\nreturn x[3]",
        "x has 3 entries, and Python counts from 0: x[0] is its first entry and x[2] is its last one.",
    ),
    (
        "index",
        "x = (1.0,)\nreturn x[1]",
        "x has 1 entry, and Python counts from 0: x[0] is its first entry.",
    ),
    ("index of matrix", "A[2, 2]", "A has the shape (2, 2), and Python counts rows and columns from 0."),
    ("many indices", "q[0, 1]", "q has the shape (2,): it takes 1 index."),
    (
        "joined",
        "qdd = A * qd\nreturn np.concatenate([qd, qdd])",
        "The parts have the shapes qd (2,), qdd (2, 2). Is one of them a matrix where a vector belongs?",
    ),
    (
        "truth",
        "if q > 0:\n    return 1",
        f"{CONDITION} q > 0 is an array of them. {MUST_HOLD}",
    ),
    (
        "truth",
        "1 if q else 0",
        f"{CONDITION} q is an array of them of shape (2,). {MUST_HOLD}",
    ),
    (
        "one number",
        "math.cos(q)",
        "math.cos takes one number, and q has the shape (2,). Use np.cos, or one entry.",
    ),
    (
        "one number",
        "float(q + 1)",
        "float takes one number, and q + 1 has the shape (2,). Which entry is meant?",
    ),
    (
        "one number",
        "math.cos(np.abs(q))",
        "math.cos takes one number, and np.abs(q) is an array. Use np.cos, or one entry.",
    ),
    (
        "joined, of unknown shapes",
        "np.concatenate([qd, np.linalg.solve(A, A * qd)])",
        "Print the shape of each part: is one of them a matrix where a vector belongs? A * B multiplies "
        "entry by entry, and A @ B is the product of matrices.",
    ),
    ("some truth", "max(q, qd)", f"{CONDITION} this one is an array of them. {MUST_HOLD}"),
    (
        "one number",
        "x = [1.0, 2.0]\nreturn math.sqrt(x)",
        "math.sqrt takes one number, and x has the shape (2,). Use np.sqrt, or one entry.",
    ),
    (
        "entry",
        "coupling = np.cos(q)\nreturn np.array([[1.0, coupling], [2.0, 3.0]])",
        "coupling is an array of shape (2,). Does one number belong there?",
    ),
    (
        "some entry",
        "np.array([[1.0, 2.0], [3.0]])",
        "The rows of an array must have one length. Is there an array where one number belongs?",
    ),
    (
        "symbols",
        "x = sp.Symbol('x')\nreturn np.cos(x)",
        "np.cos takes only numbers, and this is a SymPy expression: SymPy's own is sp.cos.",
    ),
    (
        "symbols",
        "x = sp.Symbol('x')\nreturn np.arctan(2 * x)",
        "np.arctan takes only numbers, and this is a SymPy expression: SymPy's own is sp.atan.",
    ),
    (
        "symbols",
        "x = sp.Symbol('x')\nreturn math.sin(x + 1)",
        "math.sin takes only numbers, and this is a SymPy expression: SymPy's own is sp.sin.",
    ),
    ("power", "arm.lc1^2", "In Python ^ is no power; the power is **, as in x**2."),
    ("power", "q ^ 3", "In Python ^ is no power; the power is **, as in x**3."),
    (
        "power",
        "x = sp.Symbol('x')\nreturn x ^ 2",
        "In Python ^ is no power; the power is **, as in x**2.",
    ),
    ("by name", "arm['l1']", "arm keeps its numbers by name: write arm.l1, not arm['l1']."),
    ("by name", "arm[0]", "arm keeps its numbers by name: write arm.l1, not arm[0]."),
    ("no name", "arm.L2", "arm has no L2. It has l1, l2, lc1, m1. Did you mean l2?"),
    ("no name", "arm.gravity", "arm has no gravity. It has l1, l2, lc1, m1."),
    ("array attribute", "q.cos()", "q is an array of shape (2,), which has no cos. Write np.cos(q)."),
    ("array attribute", "q.l1", "q is an array of shape (2,), which has no l1."),
    (
        "list attribute",
        "M = [[1.0]]\nreturn M.T",
        "M is a list. An array has .T: make it one with np.array(M).",
    ),
    ("none", "M = None\nreturn M + 1.0", "M is None. Does a function lack its return?"),
    ("none", "M = None\nreturn M[0]", "M is None. Does a function lack its return?"),
    (
        "some none",
        "def M(q):\n    q * 2\nreturn 1.0 + M(q)",
        "A value is None there. Does a function lack its return?",
    ),
    (
        "function",
        "np.cos * q[1]",
        "np.cos is a function. Call it: write its arguments behind it, in round brackets.",
    ),
    (
        "function",
        "def M(q):\n    return q\nreturn 2.0 * M",
        "M is a function. Call it: write its arguments behind it, in round brackets.",
    ),
    (
        "function",
        "np.array[1, 2]",
        "np.array is a function. Call it: write its arguments behind it, in round brackets.",
    ),
    (
        "called number",
        "arm.m1(arm.l1 + arm.l2)",
        "arm.m1 is no function, and brackets right behind it call it. Is a * missing there?",
    ),
    (
        "called number",
        "K = sp.ones(2, 2)\nreturn K(q)",
        "K is no function, and brackets right behind it call it. Is a * missing there?",
    ),
    (
        "called number",
        "a = sp.Symbol('a')\nreturn (a + 1)(q[0])",
        "a + 1 is no function, and brackets right behind it call it. Is a * missing there?",
    ),
    ("text", "x = 'l1'\nreturn x * arm.m1", "x is a text, as it stands in quotes."),
    ("text", "'q' + q", "'q' is a text, as it stands in quotes."),
    (
        "list times",
        "x = [1.0, 2.0]\nreturn 0.5 * x",
        "x is a list, and lists have no arithmetic: make it an array with np.array(x).",
    ),
    (
        "list times",
        "x = [1.0, 2.0]\nreturn x - x",
        "x is a list, and lists have no arithmetic: make it an array with np.array(x).",
    ),
    (
        "list index",
        "M = [[1.0]]\nreturn M[0, 0]",
        "M is a list. An array takes two indices: make it one with np.array(M).",
    ),
    ("complex", "float((-2.0) ** 0.5)", "The number is complex. Is it a root of something negative?"),
    (
        "domain",
        "x = -2.0\nreturn math.sqrt(x)",
        "math.sqrt has no value at x. Is that negative, or out of its range?",
    ),
    ("zero", "x = 0.0\nreturn 1 / abs(x)", "abs(x) is 0 in this call."),
    (
        "numpy name",
        "cos(q[0])",
        "cos needs a prefix: np.cos for numbers, sp.cos for symbols.",
    ),
    ("numpy name", "array([1.0])", "array needs a prefix: np.array."),
    ("number of an argument", "m1 * np.cos(q[0])", "m1 alone is no name here: write arm.m1."),
    ("not imported", "random.random() * q", "It has to be imported first: import random."),
    ("not imported", "plt.plot(q)", "It has to be imported first: import matplotlib.pyplot as plt."),
    (
        "relation",
        "x = sp.Symbol('x')\nreturn 1 if x > 0 else 0",
        "A condition on symbols is neither True nor False before they have values.",
    ),
]  # fmt: skip


@pytest.mark.parametrize(("kind", "body", "said"), CASES)
def test_what_the_error_means(kind, body, said):
    fault = fault_of(body)
    assert fault.kind is FaultKind.RAISED
    assert fault.riddle is not None, fault.message
    assert (fault.riddle.kind, sentence_of(fault.riddle)) == (kind, said)


def test_every_row_is_tried():
    assert {kind for kind, *_ in CASES} == set(TABLE)


@pytest.mark.parametrize(("kind", "body", "said"), CASES)
def test_it_crosses_to_the_judge(kind, body, said):
    message = json.loads(json.dumps(protocol.encode_reply(Reply(fault=fault_of(body)))))
    assert sentence_of(protocol.decode_reply(message).fault.riddle) == said


@pytest.mark.parametrize(
    "body",
    [
        "int('l1')",
        "arm.l1 / 0",
        "raise ValueError('matmul: mine')\n",
        "raise KeyError('l1')\n",
        "q[0] + undefined",
        "ARM = {'l1': 1.0}\nreturn ARM['l2']",
    ],
)
def test_other_errors_stay_as_they_are(body):
    assert fault_of(body).riddle is None


def test_without_its_source_an_error_is_read_as_far_as_its_message_goes():
    namespace = {"__name__": "__main__", "np": np}
    exec(compile("def f(q): return np.array([[1.0], q])", "<ipython-input-9>", "exec"), namespace)
    fault = protocol.answer(Call("f", (Q,)), namespace).fault
    assert fault.riddle == Riddle("some entry")


def test_nothing_of_the_students_runs_again():
    """Not even what stands between the names: it may print, take long, or fail otherwise."""
    body = (
        "class Sly:\n"
        "    def __getattr__(self, name):\n"
        "        seen.append(name)\n"
        "        return 0\n"
        "    def __index__(self):\n"
        "        seen.append('index')\n"
        "        return 0\n"
        "    def __array__(self, *given, **named):\n"
        "        seen.append('array')\n"
        "        return np.ones(3)\n"
        "x = Sly()\n"
        "try:\n"
        "    {}\n"
        "finally:\n"
        "    seen.append('the end')\n"
    )
    for failing in ("J[x] @ I", "J[x.row] @ I", "x @ I", "[x, x] @ I", "math.cos([x])"):
        namespace = defined(body.format(failing))
        namespace["seen"] = seen = []
        fault = protocol.answer(Call("f", tuple(ARGUMENTS.values())), namespace).fault
        assert fault.kind is FaultKind.RAISED
        assert seen[-1] == "the end"
        assert len(seen) > 1 or "math" in failing


def test_words_are_short_and_on_one_line():
    name = "x" * 500
    fault = fault_of(f"{name} = [1.0]\nreturn 2.5 * {name}")
    assert max(map(len, fault.riddle.words)) <= MOST_WORD
    assert sentence_of(fault.riddle).isprintable()


@given(st.recursive(st.none() | st.text() | st.integers(), st.lists, max_leaves=6))
def test_what_is_no_riddle_is_none(message):
    riddle = decode_riddle(message)
    assert riddle is None or sentence_of(riddle)


@given(st.sampled_from(sorted(KNOWN)), st.lists(st.text(), max_size=5))
def test_forged_words_fill_only_the_places_that_a_sentence_has(kind, words):
    riddle = decode_riddle([kind, words])
    assert (riddle is not None) == (len(words) == KNOWN[kind].places)
    if riddle:
        assert sentence_of(riddle).isprintable()
        assert all(len(word) <= MOST_WORD for word in riddle.words)


@pytest.mark.parametrize(
    ("body", "used"),
    [("2 ^ 3", True), ("x = 2\nx ^= 3\nreturn x", True), ("2 ** 3", False), ("2 | 3", False),
     ("def g(k):\n    return (-1)^k\nreturn g(2)", True)],
)  # fmt: skip
def test_a_caret_that_raises_nothing_is_seen(body, used):
    namespace = defined(body, arguments="")
    assert uses_caret(namespace["f"]) is used
    reply = protocol.answer(Call("f", ()), namespace)
    assert reply.caret is used
    message = json.loads(json.dumps(protocol.encode_reply(reply)))
    assert protocol.decode_reply(message).caret is used


@pytest.mark.parametrize("other", [len, np.sin, SimpleNamespace(__code__=3), None])
def test_what_has_no_python_code_has_no_caret(other):
    assert uses_caret(other) is False


def test_print_in_place_of_return():
    fault = fault_of("print(q)\nx = 1")
    assert fault.kind is FaultKind.NOTHING
    said = "f calls print, which only shows a value; return gives it to the caller."
    assert sentence_of(fault.riddle) == said
    assert fault_of("x = q\ny = x").riddle is None


def test_a_symbol_where_numbers_are_given():
    riddle = fault_of("np.cos(sp.Symbol('x'))").riddle
    assert sentence_of(riddle, symbolic=False) == (
        "np.cos takes only numbers, and this is a SymPy expression. The arguments are numbers: where "
        "does the symbol come from?"
    )
    reply = protocol.answer(
        Call("f", (Symbol("q"),), at=({"q": 1.0},)), defined("np.sqrt(q)", arguments="q")
    )
    assert sentence_of(reply.fault.riddle).endswith("SymPy's own is sp.sqrt.")
