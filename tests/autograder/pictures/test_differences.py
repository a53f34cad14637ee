"""Each sentence on a motion is true of its numbers, whichever entries are wrong."""

import re
from functools import partial

import numpy as np
import pytest

from autograder.pictures.differences import differences, sentences, title
from autograder.pictures.equations import Equations
from autograder.pictures.motion import compared
from autograder.problems import known_check
from tests.autograder.pictures.wrong import MINUS, OTHER_SIGN_C, UPWARD, played

METRES = {"m": 1.0, "cm": 0.01}
COORDINATE = re.compile(r"(\w+) is ([\d.e+]+) (?:rad|m) too (large|small)")


def near(said: float, exact: float) -> bool:
    """Two digits are said."""
    return abs(said - exact) <= 0.06 * abs(exact) + 1e-9


def times_said(sentence: str) -> float:
    """How many times the right term theirs is, by a sentence."""
    found = re.search(r"([\d.]+) times", sentence)
    size = float(found.group(1)) if found else 1.0
    if "no gravity" in sentence or "is zero" in sentence:
        return 0.0
    return -size if "the other way" in sentence or "opposite sign" in sentence else size


def assert_true(both, sentence: str) -> None:
    last = both.common - 1
    shift = both.tips(both.theirs)[last] - both.tips(both.right)[last]
    rises = [both.tips(m)[last, 1] - both.tips(m)[0, 1] for m in (both.right, both.theirs)]
    apart = both.theirs.x[last] - both.right.x[last]
    names = [c.name for c in both.mechanism.coordinates]
    if "as if" in sentence or "Along the right motion" in sentence:
        assert times_said(sentence) == pytest.approx(both.times, rel=1e-3, abs=1e-6)
    elif "where it should be" in sentence:
        parts = re.findall(r"([\d.]+) (m|cm) (above|below|left of|right of)", sentence)
        assert parts
        for number, unit, way in parts:
            exact = shift[1 if way in ("above", "below") else 0]
            assert near(float(number) * METRES[unit], abs(exact))
            assert (exact > 0) == (way in ("above", "right of"))
    elif found := COORDINATE.findall(sentence):
        for name, number, way in found:
            exact = apart[names.index(name)]
            assert near(float(number), abs(exact))
            assert (exact > 0) == (way == "large")
    elif "In this time the tip should go" in sentence:
        said = re.findall(r"([\d.]+) (m|cm) (up|down)", sentence)
        for (number, unit, way), exact in zip(said, rises, strict=True):
            assert near(float(number) * METRES[unit], abs(exact))
            assert (exact > 0) == (way == "up")
    elif "the other way" in sentence:
        of = re.search(r"velocit(?:y|ies) of (.+?) starts? to", sentence).group(1)
        for name in re.split(r", | and ", of):
            k = len(names) + names.index(name)
            first, theirs = (m.x[1, k] - m.x[0, k] for m in (both.right, both.theirs))
            assert first * theirs < 0
    elif "keeps its energy" in sentence:
        E, kept = (both.equations.energy(m.x) for m in (both.theirs, both.right))
        number, way = re.search(r"([\d.]+) J (more|less)", sentence).groups()
        assert near(float(number), abs(E[-1] - E[0]))
        assert (E[-1] > E[0]) == (way == "more")
        assert np.ptp(kept) < 0.1 * abs(E[-1] - E[0])
    elif "does not show here" in sentence or "does not move the arm" in sentence:
        change = np.max(np.abs(both.right.x - both.right.x[0]))
        assert np.max(np.abs(apart[: len(names)])) <= 0.05 * change
    else:
        assert "With your" in sentence
        assert both.theirs.stopped in sentence


MECHANISMS_PLAYED = ("planar-2r", "cart-pole", "turn-and-slide", "furuta", "slider-crank")
GRAVITY = (
    "np.array([(arm.m1 * arm.lc1 + arm.m2 * arm.l1) * arm.g * np.cos(q[0])"
    " + arm.m2 * arm.lc2 * arm.g * np.cos(q[0] + q[1]),"
    " arm.m2 * arm.lc2 * arm.g * np.cos(q[0] + q[1])])"
)
FACTORS = (-1.0, 0.0, 0.5, 0.99, 1.0, 1.0, 1.0, 2.0)


@pytest.mark.parametrize("name", MECHANISMS_PLAYED)
@pytest.mark.parametrize("answer", ["M", "C", "g_vec", "f"])
def test_sentences_on_wrong_entries_are_true(name, answer):
    check, rng = known_check(f"{name}-{answer}"), np.random.default_rng(0)
    shape = np.shape(check.reference(*check.calls(rng, 1)[0].args))
    for call in check.calls(rng, 6)[:3]:
        right = check.reference
        if answer == "f":  # the same, and quicker
            equations = Equations(check.catalogue.mechanism, call.args[2], friction=True)
            right = partial(_rate, equations)
        times = rng.choice(FACTORS, shape)
        both = compared(check, lambda *args, times=times, right=right: times * right(*args), call)
        said = sentences(both)
        assert said
        for sentence in said:
            assert_true(both, sentence)


def test_a_reversed_gravity_is_seen_to_go_the_other_way():
    both = played("p4-g_vec", UPWARD)
    as_if, shift, _, ways, energy = sentences(both)
    assert as_if == "It moves as if gravity pulled the other way."
    assert shift.startswith("After 0.5 s with your g_vec, the tip is ")
    assert re.fullmatch(r"In this time the tip should go .* down; yours goes .* up\.", ways)
    assert energy.startswith("The right motion keeps its energy")


@pytest.mark.parametrize(
    ("id", "body", "times", "said"),
    [
        ("p4-g_vec", f"return 0.5 * {GRAVITY}", 0.5, "as if gravity were 0.5 times as strong."),
        ("p4-g_vec", "np.zeros(2)", 0.0, "It moves as if there were no gravity."),
        (
            "p2-C",
            OTHER_SIGN_C,
            -1.0,
            "your C q̇ is as large as the right one, with the opposite sign.",
        ),
        ("p2-C", "np.zeros((2, 2))", 0.0, "your C q̇ is zero, and the right one is not."),
        ("p3-M", "21 * pend.I", 21.0, "Along the right motion your M is 21 times the right one."),
        ("spring-cart-g_vec", "0 * q", 0.0, "your g_vec is zero, and the right one is not."),
    ],
)
def test_a_multiple_is_named_where_it_is_one(id, body, times, said):
    both = played(id, body)
    assert both.times == pytest.approx(times, abs=1e-12)
    assert sentences(both)[0].endswith(said)
    exact = [both.equations.term(known_check(id).name, x) for x in both.right.x[::7]]
    assert np.any(exact)


@pytest.mark.parametrize("body", ["0.5 * q", "np.array([1.0, 2.0])"])
def test_no_multiple_is_named_where_there_is_none(body):
    both = played("p4-g_vec", body)
    assert both.times is None
    assert "as if" not in " ".join(sentences(both))


def test_the_title_says_where_it_starts():
    both = played("p1-M", MINUS)
    q1, q2 = both.right.x[0, :2]
    start = f"0.5 s, from rest at q1 = {q1:.2f} rad, q2 = {q2:.2f} rad"
    assert title(both) == start.replace("-", "−")


def test_no_sentence_holds_a_formula_or_a_right_entry():
    for sentence in differences(played("p4-g_vec", UPWARD)):
        assert not re.search(r"cos|sin|l1|m2|arm\.", sentence)


def _rate(equations, x, u, arm):
    return equations.rate(x, u)
