"""The room: what a notebook would show comes back, and calls are answered."""

import base64
from types import SimpleNamespace

import numpy as np
import pytest

from autograder.protocol import Call, Fault, FaultKind, Riddle, Symbol, sentence_of
from autograder.sandbox import room as sandbox
from autograder.sandbox.inside.left_out import INPUT
from tests.autograder.sandbox.rooms import EVERY_WAY, failed, printed


@EVERY_WAY
class TestOutputs:
    def test_prints_go_to_their_streams(self, room):
        outputs = room.run("import sys\nprint('out')\nprint('err', file=sys.stderr)")
        assert outputs == [
            {"output_type": "stream", "name": "stdout", "text": "out\n"},
            {"output_type": "stream", "name": "stderr", "text": "err\n"},
        ]

    def test_quiet_cell_shows_nothing(self, room):
        assert room.run("x = 1") == []
        assert room.run("") == []

    def test_last_expression_is_shown(self, room):
        assert "42" in str(room.run("6 * 7"))

    def test_error_has_its_traceback(self, room):
        *_, error = room.run("print('before')\ndef f():\n    return 1 / 0\nf()")
        assert (error["ename"], error["evalue"]) == ("ZeroDivisionError", "division by zero")
        assert "return 1 / 0" in "\n".join(error["traceback"])
        assert "\x1b" not in "\n".join(error["traceback"])

    def test_syntax_error_names_its_line(self, room):
        said = failed(room, "x = 1\ndef f(q)\n    return q")
        assert said == "SyntaxError: expected ':', line 2: def f(q)"
        assert failed(room, "  x = 1\n y = 2").startswith("IndentationError: ")

    def test_display_gives_text_and_latex_but_no_html(self, room):
        (output,) = room.run(
            "class A:\n"
            "    def __repr__(self): return 'plain'\n"
            "    def _repr_latex_(self): return '$q$'\n"
            "    def _repr_html_(self): return '<script>alert(1)</script>'\n"
            "    def _repr_javascript_(self): return 'alert(1)'\n"
            "display(A())"
        )
        assert output["data"] == {"text/plain": "plain", "text/latex": "$q$"}

    def test_figures_are_png(self, room):
        outputs = room.run("import matplotlib.pyplot as plt\nplt.plot([0, 1])\nplt.show()")
        pictures = [
            out["data"]["image/png"] for out in outputs if "image/png" in out.get("data", {})
        ]
        assert len(pictures) == 1
        assert base64.b64decode(pictures[0]).startswith(b"\x89PNG")
        assert not any("image/png" in str(out) for out in room.run("1"))

    def test_raw_bytes_of_a_picture_are_encoded(self, room):
        (output,) = room.run(
            "class A:\n    def _repr_png_(self): return b'\\x89PNG raw'\ndisplay(A())"
        )
        assert base64.b64decode(output["data"]["image/png"]) == b"\x89PNG raw"

    def test_input_says_that_nobody_answers(self, room):
        said = failed(room, "x = input('m = ')")
        assert said == f"RuntimeError: {INPUT}"

    def test_long_output_is_cut(self, room):
        (output,) = room.run("print('x' * 10**6)")
        assert 10**5 < len(output["text"]) <= 200_000

    def test_half_a_surrogate_pair_is_replaced(self, room):
        assert printed(room, "print('a\\ud800b')") == "a?b"
        assert failed(room, "raise ValueError('\\udfff')") == "ValueError: ?"
        assert printed(room, "print('\\U0001f600')") == "\U0001f600"


@EVERY_WAY
class TestCells:
    def test_cells_share_their_names(self, room):
        room.run("m = 3")
        assert printed(room, "print(m, __name__)") == "3 __main__"

    def test_top_level_loop_costs_its_limit_and_the_room_lives_on(self, room):
        room.run("kept = 5")
        before = room.used
        said = failed(room, "while True:\n    pass", seconds=0.5)
        assert said == "TimeoutError: this cell ran longer than 0.5 s"
        assert room.used - before < 1.5  # under the grace that ends a room
        assert printed(room, "print(kept)") == "5"

    @pytest.mark.parametrize(
        ("source", "error"),
        [
            ("raise SystemExit(0)", "SystemExit: 0"),
            ("raise KeyboardInterrupt", "KeyboardInterrupt: "),
            ("class E(BaseException): pass\nraise E('own')", "E: own"),
            ("class E(Exception):\n    def __str__(self): 1 / 0\nraise E", "E: (a message"),
            ("class E(Exception):\n    def __repr__(self): 1 / 0\nE()", "ZeroDivisionError: "),
            ("%no_such_magic", "UsageError: "),
        ],
    )
    def test_no_error_ends_the_room(self, room, source, error):
        outputs = room.run(source)
        assert printed(room, "print('alive')") == "alive"
        said = [f"{out['ename']}: {out['evalue']}" for out in outputs if "ename" in out]
        assert said == [] or said[0].startswith(error)
        assert outputs

    def test_armdyn_and_autograder_are_stubs(self, room):
        said = failed(room, "from armdyn.models import Pendulum")
        assert said.startswith(
            "ImportError: armdyn contains the formulas that this problem asks for"
        )
        assert room.run("from autograder import check\ncheck('p3-M')\ncheck('x', fresh=True)") == []
        assert failed(room, "import autograder.judging.check").startswith("ModuleNotFoundError")
        assert failed(room, "from autograder.problems import CHECKS").startswith("ModuleNotFound")


@EVERY_WAY
class TestCalls:
    def test_numbers_come_back(self, room):
        room.run("import numpy as np\ndef f(q, pend): return pend.m * np.sin(q)")
        calls = [Call("f", (np.array([a]), SimpleNamespace(m=2.0))) for a in (0.1, 0.2)]
        for call, reply in zip(calls, room.ask(calls), strict=True):
            np.testing.assert_array_equal(reply.value, 2 * np.sin(call.args[0]))

    def test_expressions_are_evaluated_inside(self, room):
        room.run("import sympy as sp\ndef L(q): return sp.sin(q) + 1")
        (reply,) = room.ask([Call("L", (Symbol("q"),), ({"q": 0.0}, {"q": np.pi / 2}))])
        np.testing.assert_allclose(reply.value, [1.0, 2.0])

    def test_prints_and_warnings_of_a_call_do_not_mix_with_its_numbers(self, room):
        room.run(
            "import os, sys, warnings, numpy as np\n"
            "def f():\n"
            "    print('{\"replies\": []}'); sys.__stdout__.write('x\\n'); os.write(1, b'x\\n')\n"
            "    warnings.warn('w'); os.system('echo x')\n"
            "    return 1 + 0 * np.log(np.zeros(1) + 1)"
        )
        assert room.ask([Call("f", ())])[0].value == 1.0

    def test_faults_name_the_students_line(self, room):
        room.run("def f(q):\n    r = 1\n    return q / 0")
        assert room.ask([Call("f", (1.0,))] * 3)[0].fault == Fault(
            FaultKind.RAISED, "ZeroDivisionError: float division by zero", "line 3: return q / 0"
        )

    def test_errors_are_read_in_the_room(self, room):
        room.run("import numpy as np\nJ = np.ones((6, 3))")
        room.run("def f(q):\n    return J @ (2 * np.array([q, q]))")
        (reply,) = room.ask([Call("f", (1.0,))])
        # What a call returned is not known any more.
        assert reply.fault.riddle == Riddle("matmul of unknown shapes", ("3", "2"))
        room.run("def f(q):\n    pair = np.array([q, q])\n    return J @ (2 * pair)")
        (reply,) = room.ask([Call("f", (1.0,))])
        assert sentence_of(reply.fault.riddle).startswith("J is (6, 3), and 2 * pair is (2,). ")
        room.run("def f(q):\n    return q + 10^-3")
        assert "**" in sentence_of(room.ask([Call("f", (1.0,))])[0].fault.riddle)
        room.run("def f(q):\n    return q + (10^-3)")
        assert room.ask([Call("f", (1.0,))])[0].caret

    def test_a_fault_in_another_cell_names_that_cell(self, room):
        room.run("x = 1")
        room.run("def inner(q):\n    return q[7]")
        room.run("def f(q):\n    r = 1\n    s = 2\n    return inner(q)")
        fault = room.ask([Call("f", (np.zeros(2),))])[0].fault
        assert fault.line == "the cell of inner, line 2: return q[7]"
        room.run("third = lambda q: q[9]")
        room.run("def f(q):\n    return third(q)")
        fault = room.ask([Call("f", (np.zeros(2),))])[0].fault
        assert fault.line == "another cell, line 1: third = lambda q: q[9]"
        room.run("def g(q):\n    return q[8]")
        fault = room.ask([Call("g", (np.zeros(2),))])[0].fault
        assert fault.line == "line 2: return q[8]"
        *_, told = room.run("inner([1])")
        assert told["at"] == 1
        assert told["line"] == "the cell of inner, line 2: return q[7]"

    def test_slow_calls_that_keep_their_own_limit_are_answered(self, room, monkeypatch):
        monkeypatch.setattr(sandbox, "GRACE_SECONDS", 0.0)
        monkeypatch.setattr(sandbox, "CELL_SECONDS", 0.1)
        room.run("import time\ndef f():\n    time.sleep(0.2)\n    return 1", seconds=10.0)
        assert [reply.fault for reply in room.ask([Call("f", ())] * 3)] == [None] * 3
