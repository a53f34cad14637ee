"""A sentence that names an entry or a row is true of all of it, whatever else is wrong in the answer."""

import re

import numpy as np
import pytest

from autograder.judging.check import VISIBLE_CASES
from autograder.mechanisms import MECHANISMS
from autograder.mutation.checks import check_of
from autograder.mutation.composed import catalogue_of
from autograder.problems import CHECKS
from autograder.protocol import Reply

PLANAR = MECHANISMS["planar-2r"]
ASKED = [
    (CHECKS["c6-regressor"], PLANAR, "regressor"),
    (CHECKS["p1-M"], PLANAR, "M"),
    *((check_of(PLANAR, answer), PLANAR, answer) for answer in ("C", "M_dot")),
    (check_of(MECHANISMS["cart-pole"], "g_vec"), MECHANISMS["cart-pole"], "g_vec"),
]
WAYS = ("noise in one entry", "two mutants", "parts of two", "scaled", "in one column", "permuted")


def spoilt(way, one, other, right, rng):
    """A mutant's numbers, (calls, …), with more that is wrong."""
    part = rng.random(right.shape[1:]) < 0.5
    if way == "noise in one entry":
        noise = np.zeros(right.shape[1:])
        noise[tuple(rng.integers(noise.shape))] = 1.0 + rng.random()
        return one + noise
    if way == "two mutants":
        return one + other - right
    if way == "parts of two":
        return np.where(part, one, other)
    if way == "scaled":
        return np.where(part, one, rng.choice([-1.0, 0.0, 0.5, 1.3, 2.0]) * right)
    if way == "in one column":
        return np.where(
            np.arange(right.shape[-1]) == rng.integers(right.shape[-1]), one, 1.3 * right
        )
    axis = int(rng.integers(1, right.ndim))
    return np.take(one, rng.permutation(right.shape[axis]), axis=axis)


def in_a_column(same):
    """Whether entries of a row, (calls, columns), are the same in one column: what "here" claims."""
    return np.any(np.all(same, axis=0))


def at(mutant, values, check, calls):
    """Of the values that a student returned, those that the mutant's sentence is about; None for all."""
    if row := re.fullmatch(r"row (\d)", mutant.entry):
        r = int(row[1]) - 1
        if check.name == "C":
            return np.array([(C @ call.args[1])[r] for C, call in zip(values, calls, strict=True)])
        return None if mutant.term.startswith("the column of") else values[:, r]
    if entry := re.fullmatch(r"(?:[MCgṀ])(\d)(\d)?", mutant.entry):
        return values[(slice(None), *(int(k) - 1 for k in entry.groups() if k))]
    return None


@pytest.mark.parametrize(("check", "mechanism", "answer"), ASKED, ids=[c.id for c, *_ in ASKED])
def test_what_names_a_place_is_true_of_the_place(check, mechanism, answer):
    calls = check.calls(np.random.default_rng(0), VISIBLE_CASES)
    known = check.catalogue(calls)
    values = [np.array(numbers, dtype=float) for _, numbers in known]
    right = np.array([check.reference(*call.args) for call in calls], dtype=float)
    mutant_of = {m.name: m for m in catalogue_of(mechanism, answer).mutants}
    rng = np.random.default_rng(5)
    placed = [
        i
        for i, (m, _) in enumerate(known)
        if m.name in mutant_of
        and not mutant_of[m.name].source
        and at(mutant_of[m.name], right, check, calls) is not None
    ]
    seen = 0
    for k in range(60):
        one, other = values[rng.choice(placed)], values[rng.integers(len(values))]
        given = spoilt(WAYS[k % len(WAYS)], one, other, right, rng)
        replies = iter([[Reply(value=value) for value in given]])
        found = check.run(
            lambda _, replies=replies: next(replies, []), np.random.default_rng(0), VISIBLE_CASES
        ).diagnosis
        named = [i for i, (m, _) in enumerate(known) if m.sentence in found and m.name in mutant_of]
        for sentence in found:
            own = [i for i in named if known[i][0].sentence == sentence]
            places = [mutant_of[known[i][0].name] for i in own]
            if not own or any(m.source or at(m, right, check, calls) is None for m in places):
                continue
            seen += 1
            beside = [0 * right, *(values[i] - right for i in named if i not in own)]
            said_of = np.all if not sentence.startswith("Here, ") else in_a_column
            assert any(
                said_of(
                    np.isclose(
                        at(m, given, check, calls),
                        at(m, values[i] + more, check, calls),
                        rtol=1e-5,
                        atol=1e-6,
                    )
                )
                for i, m in zip(own, places, strict=True)
                for more in beside
            ), (sentence, WAYS[k % len(WAYS)])
    assert seen > 0
