"""A call in Python: pasted with all digits, it passes what the check passes, to the last bit."""

from types import SimpleNamespace

import numpy as np
import pytest
import sympy as sp

from autograder.judging.call_text import EXACT, arguments, by_name, given_by, rounded, shown_call
from autograder.judging.check import VISIBLE_CASES
from autograder.problems import CHECKS
from autograder.protocol import Call, Function, Symbol, real
from autograder.protocol.arguments import changed

NAMES = {"np": np, "sp": sp, "SimpleNamespace": SimpleNamespace}


def calls_of(check) -> list[Call]:
    return check.calls(np.random.default_rng(3), VISIBLE_CASES)


def passed(text: str, name: str) -> tuple:
    """The arguments that a printed call passes."""
    return eval(text, NAMES | {name: lambda *args: args})


@pytest.mark.parametrize("check", CHECKS.values(), ids=CHECKS)
def test_a_call_passes_what_it_says(check):
    names = arguments(check.signature)
    for call in calls_of(check):
        text = shown_call(call, check.signature, EXACT)
        if text.startswith((f"{check.name}({', '.join(names)})", "sp.Matrix(")) and names:
            lines = given_by(call, check.signature, check.id).splitlines()
            assert f'{", ".join(names)} = worst_case("{check.id}")' in lines
            assert "from autograder import worst_case" in lines
            assert ("import sympy as sp" in lines) == text.startswith("sp.")
            continue
        given = passed(text, check.name)
        assert len(given) == len(call.args) == len(names)
        for value, now in zip(call.args, given, strict=True):
            if isinstance(value, Function):
                numbers = [np.arange(1.0 + k, 9.0) for k in range(value.arguments.count(",") + 1)]
                if value.arguments.startswith("t"):
                    numbers[0] = 0.7
                np.testing.assert_array_equal(now(*numbers), real(value)(*numbers))
            else:
                assert changed(value, now) == []


@pytest.mark.parametrize("check", CHECKS.values(), ids=CHECKS)
def test_its_short_form_passes_rounded_numbers(check):
    for call in calls_of(check):
        few = rounded(call)
        assert shown_call(few, check.signature) == shown_call(call, check.signature)
        assert shown_call(few, check.signature, EXACT) == shown_call(call, check.signature)


def test_numbers_stay_floats_and_run_as_python():
    args = (2.0, np.array([[1.0, -0.0], [1e-300, np.nan]]), (0.5, 3.0), SimpleNamespace(m=-np.inf))
    call = Call("f", args)
    text = shown_call(call, "f(a, b, c, d)")
    assert text == (
        "f(2.0, np.array([[1.0, -0.0], [1e-300, float('nan')]]), [0.5, 3.0], "
        "SimpleNamespace(m=float('-inf')))"
    )
    a, b, c, d = passed(text, "f")
    assert isinstance(a, float)
    np.testing.assert_array_equal(b, args[1])
    assert (c, d.m) == ([0.5, 3.0], -np.inf)


def test_functions_say_where_their_names_are_from():
    f = Function("x, u", "[x[1], u[0] - 1.5*sin(x[0]) + pi*exp(-x[1])]")
    text = shown_call(Call("step", (f, 0.1)), "step(f, dt)")
    assert "1.5 * np.sin(x[0]) + np.pi * np.exp(-x[1])" in text
    x = np.array([0.3, 0.4])
    np.testing.assert_array_equal(passed(text, "step")[0](x, x), real(f)(x, x))


def test_symbols_are_filled_in_by_their_names():
    call = Call("L", (Symbol("q"), (Symbol("q1"), Symbol("q2"))), at=({"q": 1.0, "q2": 0.25},))
    assert shown_call(call, "L(a, b)") == "L(a, b).subs({a: 1.0, b[1]: 0.25})"


def test_long_arrays_stand_by_their_names_and_their_shapes_are_told():
    call = Call("f", (np.zeros((5, 3)), 1.0))
    assert shown_call(call, "f(J, m)") == "f(J, m)"
    said = 'from autograder import worst_case\nJ, m = worst_case("x-f")\n# J (5, 3)'
    assert given_by(call, "f(J, m)", "x-f") == said


def test_by_name_a_call_has_the_names_that_the_lines_give():
    short = Call("f", (np.zeros(2), 1.0))
    assert by_name(short, "f(q, m)") == "f(q, m)"
    symbolic = Call("L", (Symbol("q"), 1.0), at=({"q": 0.5},))
    assert by_name(symbolic, "L(q, m)") == shown_call(symbolic, "L(q, m)")


def test_a_function_without_arguments():
    assert arguments("f()") == []
    assert shown_call(Call("f", ()), "f()") == "f()"
    assert given_by(Call("f", ()), "f()", "x-f") == ""
