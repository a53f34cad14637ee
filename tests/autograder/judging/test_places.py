"""The card says where: the index in the student's own array, of every entry of every answer."""

import re
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.judging.check import VISIBLE_CASES, Check
from autograder.judging.loops import Loop
from autograder.judging.models import evaluated
from autograder.judging.places import Place
from autograder.judging.verdict import Verdict, Witness
from autograder.mechanisms import MECHANISMS
from autograder.mutation.answers import ANSWERS
from autograder.mutation.checks import check_of
from autograder.problems import CHECKS
from autograder.protocol import Call, Reply

SEED = 3
SHORT = ("cart-pole", "furuta")  # in `make test`; every mechanism in a night
# What is asked for is one number, a truth value, or no array.
WITHOUT_ENTRIES = {
    "start-kinetic-energy", "p1-is_spd", "p1-singular_arm", "p3-lagrangian", "p3-M", "p3-C", "p3-g_vec",
    "p3-inertia_about_pivot", "p3-small_angle_frequency", "p4-potential_energy",
    "c6-rank_of_excitation", "c7-terms", "c7-gravity_sign", "c8-V_dot",
}  # fmt: skip


def single_calls(check: Check, rng=None, count: int = VISIBLE_CASES) -> list[Call]:
    """The check's calls but its loops, whose figures are no entries."""
    rng = rng or np.random.default_rng(SEED)
    return [call for call in check.calls(rng, count) if not isinstance(call, Loop)]


def right_values(check: Check) -> list[np.ndarray]:
    calls = single_calls(check)
    return [np.array(evaluated(check.reference, [call])[0], dtype=float) for call in calls]


def judged(check: Check, values: list) -> Verdict:
    """The verdict on these values; to what is asked afterwards there is no reply."""
    calls = partial(single_calls, check)
    plain = replace(check, mistakes=(), catalogue=None, terms=(), calls=calls)
    replies = iter([[Reply(value=np.asarray(value)) for value in values]])
    return plain.run(
        lambda calls: next(replies, []),
        np.random.default_rng(SEED),
        VISIBLE_CASES,
    )


RIGHT_Y = right_values(CHECKS["c6-regressor"])


def named(witness: Witness, shape: tuple[int, ...], name: str) -> set[tuple[int, ...]]:
    """The entries that a worst case names, of an array of this shape."""
    if f"all of {name}" in witness.returned:
        return set(np.ndindex(shape))
    found = set()
    for inside in re.findall(rf"(?<![\w]){re.escape(name)}\[([^\]]*)\]", witness.returned):
        *row, last = inside.split(", ")
        columns = range(shape[-1]) if last == ":" else [int(last)]
        found |= {(*map(int, row), column) for column in columns}
    return found


def assert_each_entry_is_named(check: Check) -> None:
    right, at_points = right_values(check), bool(check.calls(np.random.default_rng(0), 1)[0].at)
    shapes = [value.shape[at_points:] for value in right]  # calls may differ in them
    shape = max(shapes, key=np.prod)
    assert np.prod(shape) > 1
    for entry in np.ndindex(shape):
        values = [value.copy() for value in right]
        for value, own in zip(values, shapes, strict=True):
            if own == shape:
                value[(slice(None),) * at_points + entry] += 0.7
        witness = judged(check, values).witness
        assert witness is not None, entry
        found = named(witness, shape, check.returns or check.name)
        assert entry in found, (entry, witness)
        if witness.where:
            assert found == {entry}, witness
            assert f" at {witness.where} (" in f"{witness.returned} ("
        else:
            assert "made of" in witness.returned, witness
            assert len(found) < np.prod(shape), witness


@pytest.mark.parametrize("check_id", sorted(set(CHECKS) - WITHOUT_ENTRIES))
def test_the_card_names_the_entry_that_is_wrong(check_id):
    assert_each_entry_is_named(CHECKS[check_id])


@pytest.mark.parametrize("answer", [a for a in ANSWERS if a != "energy"])
@pytest.mark.parametrize(
    "name",
    [n if n in SHORT else pytest.param(n, marks=pytest.mark.long) for n in MECHANISMS],
)
def test_the_card_names_the_entry_of_a_mechanism(name, answer):
    mechanism = MECHANISMS[name]
    check = check_of(mechanism, answer)
    if ANSWERS[answer].shape(mechanism.n) not in ((), (1,), (1, 1)):
        assert_each_entry_is_named(check)


@pytest.mark.parametrize(
    "check_id", sorted(WITHOUT_ENTRIES - {"p1-is_spd", "p1-singular_arm", "c7-terms"})
)
def test_one_number_has_no_index(check_id):
    rng = np.random.default_rng(SEED)
    values = [
        v * (1 + rng.uniform(0.2, 0.8, v.shape)) + 1.0 for v in right_values(CHECKS[check_id])
    ]
    witness = judged(CHECKS[check_id], values).witness
    assert "[" not in witness.returned
    assert not witness.where


@pytest.mark.parametrize(
    ("entries", "shape", "said"),
    [
        ([(0, 1)], (2, 2), "C[0, 1]"),
        ([(0, 1), (1, 0)], (2, 2), "C[0, 1] and C[1, 0]"),
        ([(1, 0), (1, 1)], (2, 2), "C[1, :]"),
        ([(1, 0), (1, 1), (2, 0)], (3, 2), "C[1, :] and C[2, 0]"),
        ([(0, 0), (0, 1), (1, 0), (1, 1)], (2, 2), "all of C"),
        ([(0,), (2,)], (4,), "C[0] and C[2]"),
        ([(0,), (1,)], (2,), "all of C"),
        ([(0, 0), (1, 0)], (3, 1), "C[0, 0] and C[1, 0]"),
        ([], (2, 2), ""),
    ],
)
def test_entries_in_words(entries, shape, said):
    assert str(Place("C", tuple(entries), shape, False)) == said


def test_a_column_has_the_index_of_a_column():
    """A vector may come as (2, 1): then the student's own index has two numbers."""
    values = [
        value.reshape(2, 1) + np.array([[0.0], [0.7]]) for value in right_values(CHECKS["p4-g_vec"])
    ]
    assert judged(CHECKS["p4-g_vec"], values).witness.where == "g[1, 0]"


@given(st.sets(st.sampled_from(list(np.ndindex(2, 6))), min_size=1))
def test_that_no_other_entry_is_wrong_is_said_where_it_is_so(entries):
    """Of the criterion that the worst case belongs to."""
    of_criteria = [[(0, 0), (1, 0), (0, 3), (1, 3)], [(0, 1), (1, 1)],
                   [(0, 2), (1, 2), (0, 5), (1, 5)], [(0, 4)], [(1, 4)]]  # fmt: skip
    values = [value.copy() for value in RIGHT_Y]
    for entry in entries:
        values[7][entry] += 5.0  # in one case of twelve
    first = next(own for own in of_criteria if entries & set(own))
    alone = len(first) > 1 and len(entries & set(first)) == 1
    assert (
        "no other entry is wrong" in judged(CHECKS["c6-regressor"], values).witness.returned
    ) == alone


def test_without_inputs_the_entry_is_still_named():
    values = [value + np.array([[0.0, 0.7], [0.0, 0.0]]) for value in right_values(CHECKS["p1-M"])]
    verdict = judged(CHECKS["p1-M"], values).returned()
    assert "Worst case: M[0, 1] is off by 0.7 kg·m²" in " ".join(verdict.lines())
