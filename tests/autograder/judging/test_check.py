"""Class Check: what it refuses to be made of, and whose error is whose when it runs."""

import dataclasses
import re

import numpy as np
import pytest

from autograder.judging.check import CannotRunError, Check, Criterion
from autograder.judging.diagnosis import Mistake
from autograder.judging.quantities import UnfitError
from autograder.judging.terms import Term
from autograder.judging.verdict import State
from autograder.problems import CHECKS
from autograder.protocol import Call, Reply


def check(**changes) -> Check:
    """A check of square(x), with some fields changed."""
    fields = {
        "id": "x-square",
        "signature": "square(x)",
        "reference": lambda x: x**2,
        "calls": lambda rng, count: [Call("square", (x,)) for x in rng.random(count)],
        "criteria": (Criterion("the square", "m²"),),
    }
    return Check(**fields | changes)


def shares(*given: float) -> tuple[Criterion, ...]:
    return tuple(Criterion(f"part {k}", "m", share) for k, share in enumerate(given))


def right(calls: list[Call]) -> list[Reply]:
    return [Reply(value=np.array(call.args[0] ** 2)) for call in calls]


def run(judging: Check, ask=right):
    return judging.run(ask, np.random.default_rng(0))


def test_its_name_is_the_functions():
    assert check().name == "square"


@pytest.mark.parametrize("given", [(1,), (0.5, 0.5), (1 / 3,) * 3, (1 / 7,) * 7, (0.1,) * 10])
def test_shares_that_add_up(given):
    verdict = run(check(criteria=shares(*given), quantities=lambda calls, values: [
        (value,) * len(given) for value in values
    ]))  # fmt: skip
    assert (verdict.state, verdict.credit) == (State.CORRECT, 1)


@pytest.mark.parametrize(
    ("given", "total"),
    [((0.5, 0.4), "0.9"), ((0.5, 0.6), "1.1"), ((0.33, 0.33, 0.33), "0.99"), ((1, 1), "2")],
)
def test_shares_that_do_not_add_up(given, total):
    said = f"check x-square: the shares add up to {total}, must be 1"
    with pytest.raises(ValueError, match=f"^{re.escape(said)}$"):
        check(criteria=shares(*given))


def test_no_criteria():
    with pytest.raises(ValueError, match="check x-square: it has no criteria"):
        check(criteria=())


@pytest.mark.parametrize("share", [0, -0.5, 1.5, float("nan")])
def test_a_share_that_is_none(share):
    with pytest.raises(ValueError, match=r"criterion 'the square': share is .*, must be in"):
        Criterion("the square", "m²", share)


def test_a_truth_value_with_a_unit():
    with pytest.raises(ValueError, match="'is it square\\?': a truth value has no unit 'm'"):
        Criterion("is it square?", "m", is_truth=True)


@pytest.mark.parametrize(
    ("field", "twice", "name"),
    [
        ("criteria", (Criterion("the square", "m", 0.5),) * 2, "the square"),
        ("mistakes", (Mistake("cubed", lambda x: x**3, "Look at it."),) * 2, "cubed"),
        ("terms", (Term("the one", lambda x: x),) * 2, "the one"),
        ("hints", ("Multiply.", "Think.", "Multiply."), "Multiply."),
    ],
)
def test_the_same_twice(field, twice, name):
    with pytest.raises(ValueError, match=f"check x-square: two of its {field} are '{name}'"):
        check(**{field: twice})


def test_nobody_changes_a_check():
    with pytest.raises(dataclasses.FrozenInstanceError):
        CHECKS["p3-M"].criteria = ()


@pytest.mark.parametrize(
    "broken",
    [
        {"calls": lambda rng, count: 1 / 0},
        {"reference": lambda x: x / 0},
        {"quantities": lambda calls, values: [(1 / 0,) for _ in values]},
        {"mistakes": (Mistake("none", lambda x: [1.0][1], "Look at it."),)},
    ],
)
def test_an_error_of_the_check_is_not_the_students(broken):
    verdict = run(check(**broken), lambda calls: [Reply(value=np.array(7.0)) for _ in calls])
    assert verdict.state is State.CHECK_FAILED
    assert "in the check x-square" in verdict.problem
    assert "not your fault" in verdict.next_step


def test_a_mistake_of_the_wrong_shape_is_not_the_students():
    verdict = run(
        check(mistakes=(Mistake("two", lambda x: [x, x], "Look at it."),)),
        lambda calls: [Reply(value=np.array(7.0)) for _ in calls],
    )
    assert verdict.state is State.CHECK_FAILED
    assert verdict.problem.startswith(UnfitError.__name__)


def test_numbers_of_the_wrong_shape_are_the_students():
    verdict = run(check(), lambda calls: [Reply(value=np.ones(2)) for _ in calls])
    assert verdict.state is State.ERROR
    assert verdict.problem.startswith("square(x) returned 2 numbers of shape (2,)")


def test_an_answer_that_cannot_be_run_here():
    def ask(calls):
        raise CannotRunError("there is no Octave")

    verdict = run(check(), ask)
    assert verdict.state is State.CHECK_FAILED
    assert "there is no Octave" in verdict.problem


@pytest.mark.parametrize("error", [OSError, RuntimeError, KeyboardInterrupt])
def test_what_else_ask_raises_goes_on_to_the_caller(error):
    def ask(calls):
        raise error

    with pytest.raises(error):
        run(check(), ask)
