"""What a card says of random wrong answers: each sentence is true of them, and what is true is said.

Whether a sentence is true is decided here by the judged numbers themselves, whatever found it.
"""

import re
import zlib

import numpy as np
import pytest

from autograder.judging.check import Check
from autograder.judging.claims import OF_A_PART, Claim
from autograder.judging.criterion import Answered
from autograder.judging.models import evaluated
from autograder.judging.quantities import UnfitError
from autograder.judging.verdict import Verdict
from autograder.mechanisms import MECHANISMS
from autograder.mutation.answers import ANSWERS
from autograder.mutation.checks import check_of
from autograder.problems import CHECKS
from tests.autograder.mutation.asked import Asked, arrays

KINDS = ("planar-2r", "cart-pole", "furuta", "elastic-joint", "pendulum")
MADE = [check_of(MECHANISMS[name], answer) for name in KINDS for answer in ANSWERS]
# In a night each check of these mechanisms, and more answers.
SOME = [*CHECKS.values(), *MADE[::4]]
FEW, MANY = 16, 160
WAYS = ("one", "noise in one entry", "two", "parts of two", "scaled", "permuted", "in one column")
# Several parts, not one array. tests/autograder/judging/test_truth.py tries the first.
NO_NUMBERS = ("p1-singular_arm", "c7-terms")


def spoilt(way: str, one: list, other: list, right: list, rng) -> list | None:
    """A mistake's values with more that is wrong; None where that cannot be."""
    if way == "one":
        return one
    if any(np.shape(a) != np.shape(r) or np.shape(b) != np.shape(r)
           for a, b, r in zip(one, other, right, strict=True)):  # fmt: skip
        return None
    share, size = rng.random(), 1.0 + rng.random()
    factor, seed = rng.choice([-1.0, 0.0, 0.5, 1.3, 2.0]), rng.integers(2**32)
    if way == "permuted" and any(np.ndim(r) == 0 for r in right):
        return None

    def of_call(a, b, r):
        own = np.random.default_rng(seed)  # the same for all calls of one shape
        if way == "noise in one entry":
            noise = np.zeros(r.size)
            noise[int(share * r.size)] = size
            return a + noise.reshape(r.shape)
        if way == "two":
            return a + b - r
        if way == "permuted":
            axis = int(share * r.ndim)
            return np.take(a, own.permutation(r.shape[axis]), axis=axis)
        if way == "in one column":
            columns = np.arange(r.shape[-1]) if r.ndim else np.zeros(())
            return np.where(columns == int(share * np.size(columns)), a, 1.3 * r)
        part = own.random(r.shape) < 0.5
        return np.where(part, a, b if way == "parts of two" else factor * r)

    return [of_call(a, b, r) for a, b, r in zip(one, other, right, strict=True)]


def assert_true(asked: Asked, verdict: Verdict, values: list) -> None:
    """Each sentence that stands under a criterion, by its kind; one of no kind fails."""
    given = asked.judged(values)
    texts = {text.removeprefix(OF_A_PART) for text in verdict.diagnosis}
    named = [i for text in texts for i in asked.of_text.get(text, [])]
    assert {text for row in verdict.rows for text in row.said} == set(verdict.diagnosis)
    for k, row in enumerate(verdict.rows):
        assert not (row.met and row.said)
        for text in row.said:
            if own := asked.of_text.get(text.removeprefix(OF_A_PART)):
                true = [
                    [
                        asked.bears_out(i, j, given[j], [n for n in named if n != i])
                        for j in range(len(given))
                    ]
                    for i in own
                ]
                changes = [asked.changes(i, k) for i in own]
                true = [parts for parts, here in zip(true, changes, strict=True) if here]
                whole = any(map(all, true))
                assert whole != text.startswith(OF_A_PART), (text, row.text, true)
                assert any(parts[k] for parts in true), (text, row.text)
            else:
                assert_found(asked, k, text, given[k], verdict, values)


def assert_found(asked: Asked, k: int, text: str, given, verdict: Verdict, values: list) -> None:
    """A sentence that names no mistake."""
    criterion, right = asked.check.criteria[k], asked.expected[k]
    if text in {said.text for said in criterion.said}:
        quantities = asked.check.quantities
        answered = Answered(
            quantities(asked.calls, asked.right),
            quantities(asked.calls, values),
            [row.met for row in verdict.rows],
        )
        first = next(said for said in criterion.said if said.holds(answered))
        assert first.text == text
        return
    start = f"In your {criterion.text}, "
    scale = np.max(np.abs(right)) or 1.0
    if "differ from each other" in text:
        assert np.max(np.ptp(given, axis=1)) > 1e-5 * np.max(np.abs(given))
        assert np.max(np.ptp(right, axis=1)) <= 1e-5 * scale
    elif text.startswith(f"{start}the values are right to"):
        share = float(re.search(r"right to (\S+) %", text)[1]) / 100
        assert 0 < np.max(np.abs(given - right)) <= share * scale
    elif text.startswith(f"{start}every value"):
        factor = np.sum(given * right) / np.sum(right * right)
        assert np.allclose(given, factor * right, rtol=1e-4, atol=1e-4 * scale), (text, factor)
        known = {"is 0.": 0, "has the wrong sign": -1, "is half of": 0.5, "is twice": 2}
        for words, value in known.items():
            assert words not in text or abs(factor - value) < 1e-3, (text, factor)
        if off := re.search(r"is ([\d.e+−-]+) % too (large|small)", text):
            told = 1 + float(off[1]) / 100 * (1 if off[2] == "large" else -1)
            assert factor == pytest.approx(told, abs=1e-3)
        if times := re.search(r"is ([\d.e+−-]+) times the right", text):
            assert factor == pytest.approx(float(times[1].replace("−", "-")), rel=1e-3)
    elif text.startswith(start):
        assert_of_terms(asked, k, text, given)
    else:
        pytest.fail(f"a sentence of no known kind under {criterion.text!r}: {text}")


def assert_of_terms(asked: Asked, k: int, text: str, given: np.ndarray) -> None:
    """The error is made of the terms that are named, each as often as is said."""
    terms = asked.check.terms if isinstance(asked.check.terms, tuple) else asked.check.terms()
    named = [term for term in terms if term.name in text]
    assert named, text
    columns = [
        np.ravel(asked.judged(arrays(evaluated(term.model, asked.calls)))[k]) for term in named
    ]
    error = np.ravel(given - asked.expected[k])
    factors = np.linalg.lstsq(np.transpose(columns), error, rcond=None)[0]
    left = np.transpose(columns) @ factors - error
    assert np.max(np.abs(left)) < 1e-3 * np.max(np.abs(error)), text
    for term, factor in zip(named, factors, strict=True):
        words = text.partition(term.name)[2]
        told = {" is missing": 0, " has the wrong sign,": -1, " has the wrong sign.": -1,
                " is counted twice": 2, " is half of what": 0.5}  # fmt: skip
        for start, times in told.items():
            assert not words.startswith(start) or abs(1 + factor - times) < 1e-3, (text, factor)


def assert_said(asked: Asked, i: int, given: list[np.ndarray], verdict: Verdict) -> None:
    """That of mistake i, or of one that is the same in all that it changes, as it stands.

    The limits: nothing is told from zeros alone, and two mistakes are named of one criterion.
    """
    places = [np.max(np.abs(error), axis=0) > 1e-9 for error in asked.errors[i]]
    said = [n for text in verdict.diagnosis for n in asked.of_text.get(text, [])]
    assert any(
        np.allclose(asked.errors[i][k][:, at], asked.errors[n][k][:, at], rtol=1e-4, atol=1e-5)
        for n in said
        for k, at in enumerate(places)
        if np.any(at)
    ) or not any(map(np.any, given)), (asked.wrong[i][0].name, verdict.diagnosis)


def beside(asked: Asked, i: int, rng) -> list | None:
    """The values of mistake i, and noise in an entry that shows in none of the numbers it changes."""
    mistake, values = asked.wrong[i]
    shapes = {np.shape(value) for value in (*values, *asked.right)}
    if mistake.claim is not Claim.CHANGED or len(shapes) > 1:
        return None
    own = asked.judged(values)
    changed = [np.any(np.abs(error) > 1e-9, axis=0) for error in asked.errors[i]]
    seen = [
        np.max(np.abs(error), initial=0.0) > 1e-3 * (np.max(np.abs(right)) or 1.0)
        for error, right, c in zip(
            asked.errors[i], asked.expected, asked.check.criteria, strict=True
        )
        if not (c.is_property or c.is_truth)
    ]
    if not any(seen):
        return None
    for place in rng.permutation(values[0].size):
        noisy = [np.array(value) for value in values]
        for value in noisy:
            value.flat[place] += 1.0 + rng.random()
        try:
            numbers = asked.judged(noisy)
        except UnfitError:
            continue
        hit = [
            np.any((one != other)[:, at])
            for one, other, at, c in zip(numbers, own, changed, asked.check.criteria, strict=True)
            if not (c.is_property or c.is_truth)
        ]
        if not any(hit):
            return noisy
    return None


def assert_shown_where_true(check: Check, count: int) -> None:
    asked = Asked(check)
    rng = np.random.default_rng(zlib.crc32(check.id.encode()))
    for n in range(count):
        i, j = rng.integers(len(asked.wrong), size=2)
        (mistake, one), (_, other) = asked.wrong[i], asked.wrong[j]
        way = WAYS[n % len(WAYS)]
        values = spoilt(way, one, other, asked.right, rng)
        if values is not None and any(c.is_truth for c in check.criteria):
            values = [np.clip(np.round(value), 0.0, 1.0) for value in values]
        if values is not None:
            verdict = asked.verdict(values)
            assert_true(asked, verdict, values)
            if way == "one" and verdict.diagnosis:
                assert len(verdict.diagnosis) == 1
                assert verdict.diagnosis[0] in asked.of_text
        if mistake.claim is Claim.CHANGED and (noisy := beside(asked, i, rng)):
            verdict = asked.verdict(noisy)
            assert_true(asked, verdict, noisy)
            assert_said(asked, i, asked.judged(noisy), verdict)


@pytest.mark.parametrize("check", SOME, ids=[check.id for check in SOME])
def test_a_sentence_is_shown_where_it_is_true(check):
    if check.id not in NO_NUMBERS and check.known_mistakes:
        assert_shown_where_true(check, FEW)


@pytest.mark.long
@pytest.mark.parametrize("check", MADE, ids=[check.id for check in MADE])
def test_a_sentence_is_shown_where_it_is_true_of_every_mechanism(check):
    assert_shown_where_true(check, MANY)
