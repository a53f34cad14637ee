"""Number and Choice: what they refuse to be made of, and whatever a student types."""

import re
from dataclasses import replace

import numpy as np
import pytest
import sympy as sp

from autograder.judging.card import html_card
from autograder.judging.verdict import State
from autograder.lesson_checks.choice import Choice, Option
from autograder.lesson_checks.number import DEGREES, SIGN, Number, WrongNumber


def number(*wrong: float, right: float = 10.0, names: str = "", tolerance: float = 0.01) -> Number:
    made = [
        WrongNumber(name, value, f"It is {name}.")
        for name, value in zip(names or "stuvwxyz", wrong, strict=False)
    ]
    return Number("99-torque", "a torque", "N·m", right, tuple(made), "No.", "Yes.", (), tolerance)


def choice(*said: str) -> Choice:
    options = tuple(Option(f"option {k}", sentence) for k, sentence in enumerate(said))
    return Choice("99-way-out", "which way", options, "Yes.", ())


@pytest.mark.parametrize(
    "typed", ["10", "10.09", "9.91", "np.float32(10)", "[10]", "sp.Integer(10)"]
)
def test_a_number_is_right_to_its_tolerance(typed):
    assert number(5.0).judge({"my_torque": eval(typed)}).state is State.CORRECT


@pytest.mark.parametrize(
    ("typed", "sentence"),
    [("10.2", "No."), ("-10", "It is t."), ("5.04", "It is s."), ("5.06", "No."), ("0", "It is u."),
     ("0.006", "No."), ("1e-9", "It is u.")],
)  # fmt: skip
def test_a_wrong_number_is_named_to_its_tolerance(typed, sentence):
    found = number(5.0, -10.0, 0.0).judge({"my_torque": float(typed)})
    assert (found.state, found.diagnosis) == (State.INCORRECT, (sentence,))
    assert found.rows[0].text == "a torque (N·m)"


@pytest.mark.parametrize(
    ("unit", "typed", "sentence"),
    [("rad/s", -10.0, SIGN), ("rad/s", 573.0, DEGREES), ("rad/s", 0.1745, "No."),
     ("N·m/rad", 0.1745, DEGREES), ("N·m/rad", 573.0, "No."), ("N·m", 573.0, "No."),
     ("", 0.1745, "No."), ("rad/s", -573.0, "No.")],
)  # fmt: skip
def test_a_wrong_sign_and_degrees_are_named_in_every_check(unit, typed, sentence):
    asked = replace(number(5.0), unit=unit)
    found = asked.judge({"my_torque": typed})
    assert (found.state, found.diagnosis) == (State.INCORRECT, (sentence,))


@pytest.mark.parametrize(
    ("unit", "typed", "factor"),
    [("N·m", 20.0, "2."), ("N·m", 98.1, "9.81."), ("N·m", 1.0194, "9.81."), ("N·m", 0.01, "1000."),
     ("N·m", 19.7, ""), ("N·m", 100.0, ""), ("N·m", 40.0, ""), ("N·m", -20.0, ""), ("", 20.0, "")],
)  # fmt: skip
@pytest.mark.parametrize("tolerance", [0.01, 0.05])
def test_a_factor_is_named_before_what_else_is_said(unit, typed, factor, tolerance):
    asked = replace(number(5.0), unit=unit, tolerance=tolerance)
    (found,) = asked.judge({"my_torque": typed}).diagnosis
    assert found.endswith("No.")
    assert ("You are off by a factor of " + factor in found) == bool(factor)
    assert ("factor" in found) == bool(factor)


def test_numbers_that_cannot_be_told_apart_are_refused():
    number(9.7)
    for wrong in ((9.81,), (5.0, 5.09), (10.0,)):
        with pytest.raises(ValueError, match="too close"):
            number(*wrong)
    with pytest.raises(ValueError, match="Choice"):
        number(right=0.0)
    with pytest.raises(ValueError, match="one name"):
        number(1.0, 2.0, names="ss")


def test_options_that_cannot_be_told_apart_are_refused():
    choice("No.", "", "Never.")
    for said in (("No.", "Never."), ("", ""), ("No.", "No.", "")):
        with pytest.raises(ValueError, match="check 99-way-out"):
            choice(*said)


class Hostile:
    """Raises whatever is asked of it."""

    def __repr__(self):
        raise RuntimeError("repr")

    def __array__(self, *_, **__):
        raise RuntimeError("array")

    def __float__(self):
        raise RuntimeError("float")


NO_NUMBER = {
    "a text": (
        "'28.3'",
        "my_torque is the text '28.3'. Type one number, without quotes and without its unit.",
    ),
    "a comma": (
        "28,3",
        "my_torque is 2 numbers. Type one number, without its unit. Its decimals come after a point",
    ),
    "with a unit": ("'28.3 N·m'", "my_torque is the text '28.3 N·m'."),
    "nothing": ("None", "my_torque is None."),
    "a truth": ("True", "my_torque is True."),
    "two": ("[1, 2]", "my_torque is 2 numbers. Type one number, without its unit."),
    "no end": ("float('nan')", "my_torque is nan."),
    "infinite": ("np.inf", "my_torque is inf."),
    "complex": ("1j", "my_torque is the complex number 1j."),
    "symbols": ("sp.Symbol('m') * 2", "my_torque is an expression that still contains m."),
    "a function": ("np.sin", "my_torque is the function sin itself."),
    "rows": ("[[1], [2, 3]]", "my_torque is rows of different lengths."),
    "hostile": ("Hostile()", "my_torque is an object"),
    "long": ("'<img src=x onerror=alert(1)>$x$' * 999", "my_torque is the text '<img src=x"),
}


@pytest.mark.parametrize("kind", NO_NUMBER)
def test_what_is_no_number_is_said_to_be_none(kind):
    typed, said = NO_NUMBER[kind]
    found = number(5.0).judge({"my_torque": eval(typed)})
    assert found.state is State.ERROR
    assert found.problem.startswith(said)
    assert len(found.problem) < 400
    html = html_card(found)
    assert "<img" not in html
    assert re.search(r'class="armdyn-problem tex2jax_ignore mathjax_ignore"', html)


@pytest.mark.parametrize("typed", ["'d'", "'ab'", "''", "2", "sp.Symbol('b')", "None", "np.sin",
                                   "['b']", "Hostile()", "'<b>' * 999", "b'b'"])  # fmt: skip
def test_what_is_no_letter_is_said_to_be_none(typed):
    found = choice("No.", "", "Never.").judge({"my_way_out": eval(typed)})
    assert found.state is State.ERROR
    assert found.problem.startswith("my_way_out is ")
    assert found.problem.endswith('Type one letter in quotes: "a", "b" or "c".')
    assert len(found.problem) < 400
    assert "<b>" not in html_card(found)


@pytest.mark.parametrize("check", [number(), choice("")], ids=["number", "choice"])
def test_a_variable_that_is_renamed_is_missed(check):
    found = check.judge({"torque": np.array(10.0), "x": sp.Symbol("x")})
    assert found.state is State.ERROR
    assert re.match(r"There is no my_\w+\. Keep this name", found.problem)
