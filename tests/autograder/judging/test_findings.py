"""What is said of wrong numbers that no mistake explains: it is said where it holds, and only there."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from autograder.judging.criterion import Criterion
from autograder.judging.findings import of_numbers
from autograder.judging.terms import Term, terms_off

ASKED = Criterion("torque", "N·m")
SEEDS = st.integers(0, 2**32 - 1)


def drawn(seed: int, count: int = 8, shape: tuple = (2,)) -> list[np.ndarray]:
    rng = np.random.default_rng(seed)
    return [rng.uniform(0.5, 3.0, shape) * rng.choice([-1, 1], shape) for _ in range(count)]


def term(name: str) -> Term:
    return Term(name, lambda: None)


def times(factor: float, values: list) -> list:
    return [factor * value for value in values]


@pytest.mark.parametrize(
    ("factor", "said"),
    [
        (-1, "every value has the wrong sign."),
        (2, "every value is twice the right one."),
        (1 / 2, "every value is half of the right one."),
        (180 / np.pi, "every value is 57.3 times the right one, that is 180/π."),
        (np.pi / 180, "every value is the right one divided by 57.3, that is 180/π."),
        (9.81, "every value is 9.81 times the right one."),
        (1 / 9.81, "every value is the right one divided by 9.81."),
        (0, "every value is 0."),
        (1.3, "every value is 30 % too large."),
        (0.9, "every value is 10 % too small."),
        (3, "every value is 3 times the right one."),
        (-0.25, "every value is −0.25 times the right one."),
        (9.8 / 9.81, "every value is 0.1 % too small. Is a constant rounded?"),
    ],
)
def test_a_factor_of_the_whole_is_named(factor, said):
    right = drawn(1)
    assert of_numbers(ASKED, right, times(factor, right), []).startswith(f"In your torque, {said}")


@given(SEEDS, st.floats(-60, 60).filter(lambda f: abs(f - 1) > 1e-2), st.floats(1e-3, 1))
def test_a_factor_is_said_only_where_it_is_one(seed, factor, noise):
    right = drawn(seed)
    assert "every value" in of_numbers(ASKED, right, times(factor, right), [])
    spoilt = times(factor, right)
    spoilt[3] = spoilt[3] + noise * max(1, abs(factor))
    assert "every value" not in of_numbers(ASKED, right, spoilt, [])


@pytest.mark.parametrize("made", [np.trunc, np.round, lambda value: np.trunc(3 * value) + 1])
def test_whole_numbers_are_told_as_an_array_of_them_would_keep_them(made):
    right = drawn(1)
    said = of_numbers(ASKED, right, [made(value) for value in right], [])
    assert said.startswith("In your torque, every value is a whole number. Do you round")
    whole = [made(value) for value in right]
    whole[2] = whole[2] + 0.25
    assert "whole number" not in of_numbers(ASKED, right, whole, [])


@pytest.mark.parametrize(
    ("right", "theirs"),
    [
        (times(4, [np.trunc(v) + 1 for v in drawn(1)]), [np.trunc(v) for v in drawn(2)]),
        (drawn(1), [np.ones(2)] * 8),
        (times(1e20, drawn(1)), times(1e20, drawn(2))),
    ],
)
def test_whole_numbers_that_say_nothing_of_an_array(right, theirs):
    assert "whole number" not in of_numbers(ASKED, right, theirs, [])


def test_one_number_that_is_always_the_same_is_no_multiple():
    assert of_numbers(ASKED, [np.array(2.0)] * 6, [np.array(3.0)] * 6, []) == ""


@pytest.mark.parametrize("criterion", [Criterion("rank"), Criterion("sum", "W", is_property=True)])
def test_a_count_and_a_property_are_no_multiples(criterion):
    right = drawn(1)
    assert of_numbers(criterion, right, times(2, right), []) == ""


@given(
    SEEDS,
    st.lists(st.sampled_from([-1.0, 0.0, 0.5, 0.9, 1.0, 1.0, 2.0, 3.0]), min_size=3, max_size=3),
)
def test_the_terms_that_are_off_are_found_and_no_others(seed, held):
    """The right answer holds three terms once each, and something else; the answer, `held` times."""
    parts = [drawn(seed + k) for k in range(3)]
    right = [sum(values) for values in zip(drawn(seed + 3), *parts, strict=True)]
    theirs = [
        value + sum((h - 1) * part[i] for h, part in zip(held, parts, strict=True))
        for i, value in enumerate(right)
    ]
    terms = [(term(f"part {k}"), part) for k, part in enumerate(parts)]
    off = {one.name: times for one, times in terms_off(right, theirs, terms)}
    assert off == pytest.approx({f"part {k}": h for k, h in enumerate(held) if h != 1}, abs=1e-6)


@pytest.mark.parametrize(
    ("held", "said"),
    [
        (0, "the weight is missing."),
        (-1, "the weight has the wrong sign."),
        (2, "the weight is counted twice."),
        (0.5, "the weight is half of what it should be."),
        (0.9, "the weight comes out 10 % too small."),
        (1.25, "the weight comes out 25 % too large."),
        (3, "the weight is 3 times as large as it should be."),
        (-0.5, "the weight has the wrong sign and is 0.5 times as large as it should be."),
    ],
)
def test_a_term_that_is_off_in_words(held, said):
    weight, rest = drawn(1), drawn(2)
    right = [a + b for a, b in zip(weight, rest, strict=True)]
    theirs = [held * a + b for a, b in zip(weight, rest, strict=True)]
    assert (
        of_numbers(ASKED, right, theirs, [(term("the weight"), weight)])
        == f"In your torque, {said}"
    )


@given(SEEDS, st.floats(0.01, 3))
def test_an_error_beside_the_terms_is_not_put_into_them(seed, size):
    """That it is nearly a multiple of a term is not enough: so it was said before, and was false."""
    weight, other = drawn(seed), drawn(seed + 1)
    right = [a + b for a, b in zip(weight, drawn(seed + 2), strict=True)]
    theirs = [r + a + 0.1 * size * b for r, a, b in zip(right, weight, other, strict=True)]
    assert of_numbers(ASKED, right, theirs, [(term("the weight"), weight)]) == ""


def test_few_numbers_prove_no_term():
    right, theirs = [np.array(1.0), np.array(2.0)], [np.array(1.5), np.array(1.0)]
    terms = [
        (term("a"), [np.array(1.0), np.array(0.0)]),
        (term("b"), [np.array(0.0), np.array(1.0)]),
    ]
    assert of_numbers(ASKED, right, theirs, terms) == ""


@given(SEEDS, st.floats(1e-4, 1e-3))
def test_nearly_right_is_said_with_how_near(seed, size):
    right, noise = drawn(seed), np.random.default_rng(seed).uniform(0.2, 1, (8, 2))
    theirs = [r * (1 + size * e) for r, e in zip(right, noise, strict=True)]
    said = of_numbers(ASKED, right, theirs, [])
    assert said.startswith("In your torque, the values are right to 0.")


@given(SEEDS, st.floats(-2, 2).filter(lambda e: abs(e) > 0.01))
def test_two_entries_that_should_be_one(seed, apart):
    right = [np.full(2, value[0]) for value in drawn(seed)]
    symmetric = [
        value + apart * other[0] for value, other in zip(right, drawn(seed + 1), strict=True)
    ]
    assume("every value" not in of_numbers(ASKED, right, symmetric, []))
    assert of_numbers(ASKED, right, symmetric, []) == ""
    skewed = [value + np.array([apart, 0]) for value in symmetric]
    said = "The entries of your torque differ from each other. Should they?"
    assert of_numbers(ASKED, right, skewed, []) == said
