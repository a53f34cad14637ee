"""Numbers that are not finite: criteria that do not hang on them keep their credit, and no others."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from autograder.judging.check import VISIBLE_CASES, Check, Criterion
from autograder.judging.partial import partial, where_not_finite
from autograder.judging.quantities import one_number
from autograder.judging.verdict import State
from autograder.problems import CHECKS
from autograder.protocol import Call, Reply, read, real
from tests.autograder.verdicts import judged

NOT_FINITE = (np.nan, np.inf, -np.inf)
# Their answers are arrays of numbers, several at a time.
OF_ARRAYS = ("p1-M", "p1-inertia_from_links", "p2-M_dot", "p2-C", "p2-C_other", "p4-g_vec",
             "p4-equilibria", "p5-f", "p5-rk4_step", "p5-simulate", "p5-energy_drift",
             "c6-regressor", "c6-identify", "c7-rnea", "c7-count")  # fmt: skip
DIVIDING = "q, qd = x[:2], x[2:]\nreturn np.concatenate([qd, {wrong}qd / np.abs(qd)])"


def values_of(check: Check, calls: list[Call]) -> list[np.ndarray]:
    return [read(call, check.reference(*map(real, call.args))) for call in calls]


def verdict_on(check: Check, values: list[np.ndarray]):
    def ask(calls):
        # Nothing more can be found out of numbers that are given.
        return [Reply(value=value) for value in values][: len(calls)]

    return check.run(ask, np.random.default_rng(0), VISIBLE_CASES)


def test_velocities_keep_their_credit_where_the_friction_divides_by_zero():
    verdict = judged("p5-f", DIVIDING.format(wrong=""), count=VISIBLE_CASES)
    assert verdict.state is State.PARTLY_CORRECT
    assert [row.met for row in verdict.rows] == [True, False]
    assert verdict.credit == 0.25
    assert verdict.problem.startswith("f(x, u, arm) returned nan at [")
    assert verdict.failed.count == 2
    assert verdict.failed.tried == VISIBLE_CASES
    assert 0 in verdict.failed.of.args[0][2:]
    assert verdict.diagnosis == ()
    assert verdict.witness is None


def test_what_is_finite_and_wrong_is_diagnosed_beside_it():
    body = DIVIDING.format(wrong="").replace("[qd,", "[2 * qd,")
    verdict = judged("p5-f", body, count=VISIBLE_CASES)
    assert (verdict.state, verdict.credit) == (State.INCORRECT, 0)
    assert "which is not a finite number" in verdict.problem
    assert "(velocities in ẋ)" in verdict.witness.returned
    assert "nan" not in verdict.witness.returned
    assert verdict.worst is verdict.failed.of


@pytest.mark.parametrize("check_id", OF_ARRAYS)
@settings(max_examples=8, deadline=None)
@given(data=st.data())
def test_a_number_that_is_not_finite_gets_no_more_than_any_other(check_id, data):
    """In the right answer: each criterion that changes with the number is not met, the others are."""
    check = CHECKS[check_id]
    calls = check.calls(np.random.default_rng(0), VISIBLE_CASES)
    values = values_of(check, calls)
    k = data.draw(st.integers(0, len(values) - 1))
    at = tuple(data.draw(st.integers(0, length - 1)) for length in values[k].shape)

    def met_with(number):
        values[k] = values[k].copy()
        values[k][at] = number
        verdict = verdict_on(check, values)
        return [row.met for row in verdict.rows] or [False] * len(check.criteria)

    right = values[k][at]
    others = [met_with(right + off) for off in (-right, 1e3, -1e3)]
    spoilt = met_with(data.draw(st.sampled_from(NOT_FINITE)))
    for other in others:
        assert all(ok or not bad for ok, bad in zip(other, spoilt, strict=True))
    assert not all(spoilt)


def sorted_largest(calls, values):
    """Quantities that would hide a NaN: sorting puts it last, and the last is dropped."""
    return [(np.sort(value)[:2], np.array(float(np.any(value > 1e9)))) for value in values]


def test_sorting_and_comparing_hide_nothing():
    calls = [Call("f", (0.0,))]
    found = partial(sorted_largest, calls, [np.array([1.0, 2.0, np.nan])])
    assert found is None or found.spoilt[0]


def last_alone(calls, values):
    return [(value[:1], value[-1:]) for value in values]


def test_what_no_criterion_takes_notice_of_is_not_passed_over():
    calls = 2 * [Call("f", (0.0,))]
    unseen, seen = np.array([1.0, np.nan, 3.0]), np.array([1.0, 2.0, np.nan])
    assert partial(last_alone, calls, [seen, seen]).spoilt == (False, True)
    assert partial(last_alone, calls, [unseen, seen]) is None
    assert partial(last_alone, calls, [unseen, unseen]) is None


def whole(calls, values):
    return [(value[0], np.linalg.svd(np.reshape(value, (2, 2)))[1]) for value in values]


def test_quantities_that_refuse_a_nan_are_none():
    assert partial(whole, [Call("f", ())], [np.array([1.0, np.nan, 0.0, 1.0])]) is None


def test_the_parts_of_an_answer_are_judged_together_or_not_at_all():
    calls, value = [Call("f", (), parts=True)], {"m": np.array(np.nan)}
    assert partial(lambda calls, values: [(np.zeros(1),)], calls, [value]) is None


def test_where_all_hangs_on_it_nothing_is_judged():
    verdict = judged("p3-g_vec", "np.nan * q")
    assert (verdict.state, verdict.rows) == (State.ERROR, ())
    assert verdict.problem == "g_vec(q, pend) returned nan, which is not a finite number."
    assert partial(one_number, [Call("f", ())], [np.array(np.nan)]) is None


def test_a_second_call_that_gives_a_nan_costs_what_hangs_on_it():
    check = Check(
        id="x-pair",
        signature="pair(x)",
        reference=lambda x: np.array([1.0, 2.0]),
        calls=lambda rng, count: [Call("pair", (x,)) for x in rng.random((count, 1))],
        quantities=lambda calls, values: [tuple(value) for value in values],
        criteria=(Criterion("one", "m", 0.5), Criterion("two", "m", 0.5)),
    )

    def ask(calls):
        again = Reply(value=np.array([1.0, np.nan]))
        return [Reply(np.array([1.0, 2.0]), changed=((0, ""),), again=again) for _ in calls]

    verdict = check.run(ask, np.random.default_rng(0))
    assert verdict.credit == 0.5
    assert verdict.problem.startswith("On the second call, pair(x) returned nan at [1]")


@pytest.mark.parametrize(
    ("value", "said"),
    [
        (np.array(np.nan), "nan"),
        (np.array([[np.inf]]), "inf"),
        (np.array([0.0, -np.inf]), "-inf at [1]"),
        (np.array([[0.0, 1.0], [np.nan, np.nan]]), "nan at [1, 0] and [1, 1]"),
        (np.full(7, np.nan), "nan at [0], [1], [2] and 4 more"),
        ([{"m": np.array([1.0, np.nan])}, np.array(0.0)], "nan at [0]['m'][1]"),
    ],
)
def test_the_place_is_the_students(value, said):
    assert where_not_finite(value) == said


def test_a_long_name_of_a_part_is_cut():
    assert len(where_not_finite({"l" * 10**6 + "\n": np.array(np.nan)})) < 60
