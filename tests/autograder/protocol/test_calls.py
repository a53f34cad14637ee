"""The protocol: what goes in comes out the same, only numbers come back, nothing breaks the judge."""

import json
import linecache
import signal
import sys
import time
from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from autograder import protocol
from autograder.protocol import (
    Call,
    Fault,
    FaultKind,
    NotNumbersError,
    Reply,
    Symbol,
    arguments,
    calls,
    limits,
    readings,
    words,
)

FLOATS = st.floats(allow_nan=False)
ARRAYS = hnp.arrays(float, hnp.array_shapes(min_dims=0, max_side=4), elements=FLOATS)
NAMES = st.text(st.characters(categories=["L"]), min_size=1, max_size=5)
SYMBOLS = NAMES.map(Symbol)
ARGUMENTS = st.recursive(
    FLOATS | ARRAYS | SYMBOLS,
    lambda inner: st.dictionaries(NAMES, inner, max_size=3).map(lambda d: SimpleNamespace(**d)),
    max_leaves=6,
)
JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
    lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner),
    max_leaves=12,
)


def same(one, other) -> bool:
    if isinstance(one, SimpleNamespace):
        return vars(one).keys() == vars(other).keys() and all(
            same(value, vars(other)[name]) for name, value in vars(one).items()
        )
    if isinstance(one, np.ndarray):
        return other.dtype == one.dtype and np.array_equal(one, other)
    return type(one) is type(other) and one == other


def ask(source: str, *args, at=(), truth=False) -> Reply:
    """The reply of the student's function f, defined in a cell, to one call."""
    namespace = {"__name__": "__main__", "np": np, "sp": sp}
    exec(compile(source, "<ipython-input-1-0>", "exec"), namespace)
    return protocol.answer(Call("f", args, at, truth=truth), namespace)


@given(ARGUMENTS)
def test_arguments_cross_unchanged(value):
    assert same(arguments.decode(json.loads(json.dumps(arguments.encode(value)))), value)


@given(
    NAMES,
    st.lists(ARGUMENTS, max_size=4).map(tuple),
    st.lists(st.dictionaries(NAMES, FLOATS, max_size=3), max_size=3).map(tuple),
)
def test_calls_cross_unchanged(name, args, at):
    call = protocol.decode_call(json.loads(json.dumps(protocol.encode_call(Call(name, args, at)))))
    assert (call.name, call.at) == (name, at)
    assert len(call.args) == len(args)
    assert all(map(same, call.args, args))


@given(hnp.arrays(float, hnp.array_shapes(min_dims=0, max_side=4)))
def test_numbers_come_back_unchanged(value):
    reply = protocol.decode_reply(json.loads(json.dumps(protocol.encode_reply(Reply(value=value)))))
    assert reply.fault is None
    np.testing.assert_array_equal(reply.value, value)


@pytest.mark.parametrize("kind", FaultKind)
def test_faults_come_back_unchanged(kind):
    fault = Fault(kind, "a message", "line 3: return q")
    message = json.loads(json.dumps(protocol.encode_reply(Reply(fault=fault))))
    assert protocol.decode_reply(message) == Reply(fault=fault)


@given(JSON)
@settings(max_examples=60)
def test_no_message_makes_the_judge_raise(message):
    if not isinstance(message, dict) or not message.keys() & {"value", "fault"}:
        assert protocol.decode_reply(message) == Reply(fault=Fault(FaultKind.GARBLED))
    for reply in map(protocol.decode_reply, (message, {"value": message}, {"fault": message})):
        assert (reply.value is None) != (reply.fault is None)
        assert reply.fault or reply.value.dtype == float


@pytest.mark.parametrize(
    "message",
    [
        None,
        {"value": {}},
        {"value": [[1.0], [1.0, 2.0]]},
        {"value": ["one"]},
        {"value": 10**400},
        {"fault": {"kind": "raised", "message": "m"}},
        {"fault": {"kind": "clever", "message": "m", "line": ""}},
        {"fault": {"kind": [], "message": "m", "line": ""}},
        {"fault": {"kind": "raised", "message": 1, "line": ""}},
    ],
)
def test_what_is_no_reply_is_garbled(message):
    assert protocol.decode_reply(message) == Reply(fault=Fault(FaultKind.GARBLED))


def test_a_forged_fault_cannot_flood_the_verdict():
    message = {"fault": {"kind": "raised", "message": "x" * 10**6, "line": "y" * 10**6}}
    fault = protocol.decode_reply(message).fault
    assert len(fault.message) == len(fault.line) == words.MOST_CHARACTERS


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (2, 2.0),
        (10**300, 1e300),
        ([1, 2.5], [1.0, 2.5]),
        (((1, 2), [3, 4]), [[1.0, 2.0], [3.0, 4.0]]),
        ([np.array([1.0]), [2]], [[1.0], [2.0]]),
        (np.float32(0.5), 0.5),
        (np.array([[1, 2]], dtype=np.int8), [[1.0, 2.0]]),
        (Fraction(1, 4), 0.25),
        ([Fraction(1, 4), 2], [0.25, 2.0]),
        (sp.Rational(1, 2), 0.5),
        (sp.pi, np.pi),
        (sp.Matrix([[sp.sqrt(2)]]), [[np.sqrt(2)]]),
        ([[sp.Integer(1), 2.0]], [[1.0, 2.0]]),
        ([], []),
    ],
)
def test_whatever_holds_numbers_is_read(value, expected):
    array = readings.read_numbers(value)
    assert array.dtype == float
    assert array.shape == np.shape(expected)
    np.testing.assert_array_equal(array, expected)


@pytest.mark.parametrize(
    ("value", "kind", "message"),
    [
        (None, FaultKind.NOTHING, ""),
        ("m g lc sin q", FaultKind.NOT_NUMBERS, "the text 'm g lc sin q'"),
        (b"12", FaultKind.NOT_NUMBERS, "the bytes b'12'"),
        (1j, FaultKind.NOT_NUMBERS, "the complex number 1j"),
        ([1.0, None], FaultKind.NOT_NUMBERS, "None"),
        ([1.0, "2"], FaultKind.NOT_NUMBERS, "the list [1.0, '2']"),
        ({"q": 1.0}, FaultKind.NOT_NUMBERS, "the dict {'q': 1.0}"),
        ({1.0}, FaultKind.NOT_NUMBERS, "the set {1.0}"),
        ([[1.0], [1.0, 2.0]], FaultKind.NOT_NUMBERS, "rows of different lengths"),
        (
            np.linalg.lstsq(np.eye(3), np.ones(3)),
            FaultKind.NOT_NUMBERS,
            "a tuple of 4 unlike parts",
        ),
        (ask, FaultKind.NOT_NUMBERS, "the function ask itself"),
        (np.sin, FaultKind.NOT_NUMBERS, "the function sin itself"),
        (float, FaultKind.NOT_NUMBERS, "the class float itself"),
        (10**400, FaultKind.NOT_NUMBERS, f"the number 1{'0' * 58}…"),
        (sp.I, FaultKind.NOT_NUMBERS, "the expression I"),
        (
            sp.Symbol("q") * sp.Symbol("m"),
            FaultKind.NOT_NUMBERS,
            "an expression that still contains m, q",
        ),
        (
            sp.Matrix([[1, sp.Symbol("q")]]),
            FaultKind.NOT_NUMBERS,
            "an expression that still contains q",
        ),
        (np.zeros(readings.MOST_NUMBERS + 1), FaultKind.NOT_NUMBERS, "an array of 50001 entries"),
        (
            np.datetime64("2026-01-01"),
            FaultKind.NOT_NUMBERS,
            "the object datetime.date(2026, 1, 1)",
        ),
        (True, FaultKind.NOT_NUMBERS, "True"),
        (np.array([True]), FaultKind.NOT_NUMBERS, "an array of True and False"),
        (np.array([1j]), FaultKind.NOT_NUMBERS, "an array of complex numbers"),
        (sp.true, FaultKind.NOT_NUMBERS, "True"),
        (
            sp.Eq(sp.Symbol("q"), 1),
            FaultKind.NOT_NUMBERS,
            "the equation Eq(q, 1)",
        ),
        (sp.Symbol("q") < 1, FaultKind.NOT_NUMBERS, "the inequality q < 1"),
        ((x for x in "ab"), FaultKind.NOT_NUMBERS, "an object of the type generator"),
    ],
    ids=lambda value: type(value).__name__,
)
def test_whatever_is_no_number_is_refused_and_named(value, kind, message):
    with pytest.raises(NotNumbersError) as refused:
        readings.read_numbers(value)
    assert refused.value.kind is kind
    assert str(refused.value).startswith(message)
    assert len(str(refused.value)) < 100


@pytest.mark.parametrize(
    ("answer", "value"),
    [
        ("True", 1.0),
        ("np.bool_(False)", 0.0),
        ("np.array([True])", [1.0]),
        ("sp.true", 1.0),
        ("sp.Integer(1) > 2", 0.0),
        ("1", 1.0),
        ("0.5", 0.5),
    ],
)
def test_where_a_truth_value_is_asked_for_it_is_read(answer, value):
    np.testing.assert_array_equal(ask(f"def f(): return {answer}", truth=True).value, value)


@pytest.mark.parametrize("answer", ["sp.Symbol('x') > 1", "'True'", "[True, None]"])
def test_what_is_neither_true_nor_false_is_refused(answer):
    fault = ask(f"def f(): return {answer}", truth=True).fault
    assert fault.kind is FaultKind.NOT_NUMBERS


def test_an_object_can_pose_as_an_array_but_gives_numbers_all_the_same():
    value = ask(
        "class A:\n"
        "    __array__ = lambda self, *a, **k: np.array([[7]])\n"
        "    __eq__ = __le__ = lambda self, other: True\n"
        "def f(): return A()"
    ).value
    assert type(value) is np.ndarray
    assert value.dtype == float
    np.testing.assert_array_equal(value, [[7.0]])
    posing = "class A:\n    def __array__(self, *a, **k): return %s\ndef f(): return A()"
    assert ask(posing % "np.array(['7'])").fault.kind is FaultKind.NOT_NUMBERS
    assert ask(posing % "'7'").fault.kind is FaultKind.NOT_NUMBERS


@pytest.mark.parametrize(
    ("source", "fault"),
    [
        ("def g(): return 1", Fault(FaultKind.MISSING)),
        ("def f_(): return 1", Fault(FaultKind.MISSING, "f_")),
        ("f = 3.0", Fault(FaultKind.NOT_CALLABLE, "float")),
        ("def f():\n    raise NotImplementedError", Fault(FaultKind.NOT_IMPLEMENTED)),
        ("def f(): pass", Fault(FaultKind.NOTHING)),
        ("def f(): return 'one'", Fault(FaultKind.NOT_NUMBERS, "the text 'one'")),
        ("def f():\n    exit(3)", Fault(FaultKind.RAISED, "SystemExit: 3", "line 2")),
        ("def f(q): return q", Fault(FaultKind.RAISED, "TypeError: f() missing 1 required")),
        ("def f():\n    return f()", Fault(FaultKind.RAISED, "RecursionError: ", "line 2")),
        (
            "def f():\n    import nothing",
            Fault(FaultKind.RAISED, "ModuleNotFoundError: ", "line 2"),
        ),
        ("def f():\n    return 1 / 0", Fault(FaultKind.RAISED, "ZeroDivisionError: ", "line 2")),
    ],
)
def test_faults_of_a_call(source, fault):
    given = ask(source).fault
    assert given.kind is fault.kind
    assert given.message.startswith(fault.message)
    assert given.line == fault.line


def test_the_failing_line_is_the_students_own_with_its_text():
    source = "def inner(q):\n    return np.linalg.inv(q)\n\ndef f(q):\n    return inner(q)\n"
    namespace = {"__name__": "__main__", "np": np}
    name = "ipykernel_1/1.py"  # as JupyterLab's kernel names and caches a cell
    linecache.cache[name] = (len(source), None, source.splitlines(True), name)
    exec(compile(source, name, "exec"), namespace)
    fault = protocol.answer(Call("f", (np.zeros((2, 2)),)), namespace).fault
    assert fault.message == "LinAlgError: Singular matrix"
    assert fault.line == "line 2: return np.linalg.inv(q)"


def test_the_failing_line_of_a_module_beside_the_notebook(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    module = tmp_path / "mine.py"
    module.write_text("def third(q):\n    return q[2]\n\ndef f(q):\n    return third(q)\n")
    namespace: dict = {}
    exec(compile(module.read_text(), module, "exec"), namespace)
    call = Call("f", (np.zeros(2),))
    assert protocol.answer(call, namespace).fault.line == "mine.py, line 2: return q[2]"
    exec(compile("def f(q): return third(q)", "ipykernel_1/2.py", "exec"), namespace)
    assert protocol.answer(call, namespace).fault.line == "mine.py, line 2: return q[2]"


def test_long_messages_are_cut():
    fault = ask("def f(): raise ValueError('x' * 10**6)").fault
    assert len(fault.message) == words.MOST_CHARACTERS


def test_symbols_come_as_real_symbols_and_the_answer_is_evaluated_at_each_point():
    points = ({"q": 0.0, "m": 2.0}, {"q": np.pi / 2, "m": 3.0})
    source = "def f(q, m):\n    assert q.is_real\n    return m * sp.sin(q) + {}"
    args = (Symbol("q"), Symbol("m"))
    np.testing.assert_allclose(ask(source.format("1"), *args, at=points).value, [1.0, 4.0])
    np.testing.assert_allclose(
        ask("def f(q, m): return sp.Matrix([[q, m]])", *args, at=points).value,
        [[[0.0, 2.0]], [[np.pi / 2, 3.0]]],
    )
    np.testing.assert_array_equal(ask("def f(q, m): return 5", *args, at=points).value, [5.0, 5.0])


@pytest.mark.parametrize(
    ("result", "fault"),
    [
        ("q * sp.Symbol('l')", Fault(FaultKind.NOT_NUMBERS, "an expression that still contains l")),
        ("None", Fault(FaultKind.NOTHING)),
        ("'q'", Fault(FaultKind.NOT_NUMBERS, "the text 'q'")),
        ("[1, 'q']", Fault(FaultKind.NOT_NUMBERS, "the list [1, 'q']")),
        ("f", Fault(FaultKind.NOT_NUMBERS, "the function f itself")),
        ("sp.Eq(q, 1)", Fault(FaultKind.NOT_NUMBERS, "the equation Eq(q, 1)")),
        ("[q, sp.Eq(q, 1)]", Fault(FaultKind.NOT_NUMBERS, "the equation Eq(q, 1)")),
        ("q > 1", Fault(FaultKind.NOT_NUMBERS, "the inequality q > 1")),
        ("True", Fault(FaultKind.NOT_NUMBERS, "True")),
        ("np.array([True])", Fault(FaultKind.NOT_NUMBERS, "True")),
        ("{'q': q}", Fault(FaultKind.NOT_NUMBERS, "the dict {'q': q}")),
        ("{q}", Fault(FaultKind.NOT_NUMBERS, "the set {q}")),
        (
            "sp.Function('p')(q).diff(q)",
            Fault(FaultKind.NOT_NUMBERS, "the expression Derivative(p(q), q)"),
        ),
    ],
)
def test_symbolic_answers_that_give_no_numbers(result, fault):
    given = ask(f"def f(q):\n    return {result}", Symbol("q"), at=({"q": 1.0},)).fault
    assert given == fault


def test_a_function_that_changes_its_arguments_harms_no_later_call():
    q, pend = np.array([1.0, 2.0]), SimpleNamespace(m=1.0, axis=np.array([0.0, 1.0]))
    source = (
        "def f(q, pend):\n    value = q.sum() + pend.m + pend.axis.sum()\n"
        "    q *= 0; pend.m = 9.0; pend.axis[:] = 5\n    return value"
    )
    call = Call("f", (q, pend))
    namespace = {"__name__": "__main__"}
    exec(source, namespace)
    values = [float(reply.value) for reply in protocol.answer_all([call] * 3, namespace)]
    assert values == [5.0, 5.0, 5.0]
    np.testing.assert_array_equal(q, [1.0, 2.0])
    np.testing.assert_array_equal(pend.axis, [0.0, 1.0])
    assert pend.m == 1.0


def test_warnings_numpy_errors_and_prints_are_harmless(capsys):
    reply = ask(
        "import sys, warnings\n"
        "def f():\n"
        "    print('out'); print('err', file=sys.stderr); warnings.warn('w')\n"
        "    np.array([1.0]) / np.zeros(1); np.log(np.zeros(1))\n"
        "    return 1"
    )
    assert reply.value == 1.0
    assert np.geterr()["divide"] == "raise"


def answered(body: str) -> tuple[list, list]:
    """The kinds of fault of four calls, x = 0 to 3, and the arguments of those that were made."""
    namespace = {"__name__": "__main__", "calls": []}
    exec(f"def f(x):\n    calls.append(x)\n    {body}", namespace)
    replies = protocol.answer_all([Call("f", (float(x),)) for x in range(4)], namespace)
    return [reply.fault and reply.fault.kind for reply in replies], namespace["calls"]


@pytest.mark.parametrize(
    ("body", "kind"),
    [
        ("return x if x != 1 else None", FaultKind.NOTHING),
        ("return x if x != 1 else 'one'", FaultKind.NOT_NUMBERS),
        ("return 1 / (x - 1)", FaultKind.RAISED),
    ],
)
def test_calls_go_on_after_a_fault_that_others_need_not_have(body, kind):
    assert answered(body) == ([None, kind, None, None], [0.0, 1.0, 2.0, 3.0])


def test_calls_stop_at_a_fault_that_others_share(monkeypatch):
    body = "raise NotImplementedError"
    assert answered(body) == ([FaultKind.NOT_IMPLEMENTED], [0.0])
    monkeypatch.setattr(calls, "CALL_SECONDS", 0.1)
    monkeypatch.setattr(limits, "PATIENCE", 1000.0)
    kinds, made = answered("while x == 1: pass\n    return x")
    assert (kinds, made) == ([None, FaultKind.TIMED_OUT], [0.0, 1.0])


def test_faulty_calls_together_take_no_longer_than_one_may(monkeypatch):
    monkeypatch.setattr(calls, "CALL_SECONDS", 0.4)
    spin = (
        "import time; end = time.process_time() + 0.27\n    while time.process_time() < end: pass"
    )
    kinds, made = answered(f"{spin}\n    raise ValueError")
    assert kinds == 3 * [FaultKind.RAISED]
    assert made == [0.0, 1.0, 2.0]


@pytest.mark.parametrize(
    "body",
    [
        "while True: pass",
        "while True:\n        try:\n            while True: sum(())\n        except Exception: pass",
        "try:\n        while True: sum(())\n    except BaseException:\n        while True: pass",
    ],
)
def test_the_time_limit_ends_a_loop_that_swallows_errors(monkeypatch, body):
    monkeypatch.setattr(calls, "CALL_SECONDS", 0.2)
    monkeypatch.setattr(limits, "PATIENCE", 1000.0)  # a busy machine must not end it first
    before = [signal.getsignal(number) for number in (signal.SIGALRM, signal.SIGPROF)]
    assert ask(f"def f():\n    {body}").fault == Fault(FaultKind.TIMED_OUT, "0.2 s")
    assert [signal.getsignal(number) for number in (signal.SIGALRM, signal.SIGPROF)] == before
    for timer in (signal.ITIMER_REAL, signal.ITIMER_PROF):
        assert signal.getitimer(timer) == (0.0, 0.0)


def test_time_that_the_processor_spends_elsewhere_is_not_the_calls(monkeypatch):
    monkeypatch.setattr(calls, "CALL_SECONDS", 0.1)
    body = "import time\ndef f():\n    time.sleep({})\n    return 1"
    assert ask(body.format(0.25)).value == 1.0
    assert ask(body.format(9)).fault == Fault(FaultKind.STARVED, "0.5 s")


def test_an_alarm_in_a_destructor_is_not_reported_and_the_next_one_ends_the_call(
    monkeypatch, capsys
):
    monkeypatch.setattr(calls, "CALL_SECONDS", 0.1)
    monkeypatch.setattr(limits, "PATIENCE", 1000.0)
    hook = sys.unraisablehook
    slow = "class Slow:\n    def __del__(self):\n        while True: pass\n"
    assert ask(f"{slow}def f():\n    Slow()\n    while True: pass").fault == Fault(
        FaultKind.TIMED_OUT, "0.1 s"
    )
    assert sys.unraisablehook is hook
    assert capsys.readouterr().err == ""


def test_no_except_exception_sees_the_time_limit(monkeypatch):
    monkeypatch.setattr(calls, "CALL_SECONDS", 0.2)
    monkeypatch.setattr(limits, "PATIENCE", 1000.0)
    namespace = {"__name__": "__main__", "seen": []}
    exec(
        "def f():\n    try:\n        while True: sum(())\n    except Exception: seen.append(1)",
        namespace,
    )
    assert protocol.answer(Call("f", ()), namespace).fault.kind is FaultKind.TIMED_OUT
    assert namespace["seen"] == []


def test_the_time_limit_leaves_a_quick_block_alone():
    with protocol.time_limit(0.02):
        pass
    time.sleep(0.12)  # an alarm left behind would end the test run here


@pytest.mark.parametrize(("most", "text"), [(5, "abcde"), (4, "abc…"), (1, "…")])
def test_shortened(most, text):
    assert words.shortened("abcde", most) == text


def test_a_library_that_cannot_do_it_is_no_answer_left_open():
    """SymPy raises NotImplementedError where it finds no solution, and so does input in Validate."""
    namespace: dict = {"__name__": "__main__", "sp": sp, "x": sp.Symbol("x")}
    exec("def f():\n    return sp.solve(x - sp.cos(x) + sp.log(x))", namespace)
    fault = protocol.answer(Call("f", ()), namespace).fault
    assert fault.kind is FaultKind.RAISED
    assert "NotImplementedError: multiple generators" in fault.message


@pytest.mark.parametrize(
    ("lines", "line"),
    [
        (["'''What it returns.'''", "raise NotImplementedError"], ""),
        (["x = 1", "raise NotImplementedError"], ""),
        (["if True:", "    raise NotImplementedError", "return 1"], ""),
        (["'''What.'''", "raise NotImplementedError  # here", "return 1"], "line 3"),
    ],
)
def test_an_answer_below_the_line_that_stops_it_is_seen(lines, line):
    source = "def f():\n" + "".join(f"    {own}\n" for own in lines)
    name = f"/tmp/ipykernel_1/below{len(source)}.py"
    linecache.cache[name] = (len(source), None, source.splitlines(True), name)
    namespace: dict = {"__name__": "__main__"}
    exec(compile(source, name, "exec"), namespace)
    assert protocol.answer(Call("f", ()), namespace).fault == Fault(
        FaultKind.NOT_IMPLEMENTED, line=line
    )


def test_an_error_without_a_message_ends_in_its_name():
    namespace: dict = {"__name__": "__main__"}
    exec("def f():\n    assert False", namespace)
    assert protocol.answer(Call("f", ()), namespace).fault.message == "AssertionError"
