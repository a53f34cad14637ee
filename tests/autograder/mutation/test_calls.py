"""What is evaluated of all calls at once is what each call gives by itself."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from autograder.judging.models import OfCalls
from autograder.mechanisms import MECHANISMS
from autograder.mutation.answers import ANSWERS
from autograder.mutation.calls import Model
from autograder.mutation.checks import check_of
from autograder.mutation.generated import Generated
from autograder.mutation.mistakes import mistakes_of, numbers_of
from autograder.mutation.shared import shared
from autograder.mutation.steps import solved
from autograder.protocol import Reply

SEEDS = st.integers(0, 2**32 - 1)


def same(found, expected):
    for one, other in zip(found, expected, strict=True):
        scale = np.max(np.abs(other), initial=1e-12)
        np.testing.assert_allclose(one, other, rtol=1e-11, atol=1e-11 * scale, equal_nan=True)


@settings(max_examples=25)
@given(st.sampled_from(list(MECHANISMS)), st.sampled_from(list(ANSWERS)), SEEDS)
def test_right_answers_and_terms_of_all_calls_are_those_of_each(name, answer, seed):
    check = check_of(MECHANISMS[name], answer)
    calls = check.calls(np.random.default_rng(seed), 6)
    for model in (check.reference, *(term.model for term in check.terms())):
        assert isinstance(model, OfCalls)
        same(model.for_calls(calls), [model(*call.args) for call in calls])


@settings(max_examples=12)
@given(
    st.sampled_from([("pendulum", "f"), ("pendulum", "M"), ("planar-2r", "C"), ("cart-pole", "f")]),
    SEEDS,
    st.data(),
)
def test_mistakes_of_all_calls_are_those_of_each(of, seed, data):
    mechanism, answer = MECHANISMS[of[0]], of[1]
    calls = check_of(mechanism, answer).calls(np.random.default_rng(seed), 6)
    known = mistakes_of(mechanism, answer)
    k = data.draw(st.integers(0, len(known) - 1))
    alone = [known[k].wrong(*call.args) for call in calls]
    same(numbers_of(mechanism, answer, calls)[k], alone)


def test_terms_take_numbers_one_by_one_too():
    """As in `lagrangian(q, qd, m, lc, I, g)` of p3."""
    pendulum, made = MECHANISMS["pendulum"], Generated("pendulum", "lagrangian")
    calls = check_of(pendulum, "lagrangian").calls(np.random.default_rng(4), 6)
    plain = [replace(c, args=(*c.args[0], *c.args[1], *vars(c.args[2]).values())) for c in calls]
    for term in made.terms():
        same(term.model.for_calls(plain), term.model.for_calls(calls))
        same(term.model.for_calls(plain), [term.model(*call.args) for call in plain])


@pytest.mark.parametrize("answer", ["M", "f", "energy_drift"])
def test_a_check_evaluates_all_calls_at_once(answer, monkeypatch):
    """Of an answer that no mistake explains: the right one, its terms, whether the answer stays the
    same, what it depends on, and what it gives in other units.
    """
    check = check_of(MECHANISMS["planar-2r"], answer)
    right = check.reference
    asked = []

    def ask(calls):
        asked.append(len(calls))
        values = [np.array(value, dtype=float) for value in right.for_calls(calls)]
        return [Reply(value=v + 0.3 * np.sin(7 * np.abs(v))) for v in values]

    def one_by_one(self, *args):
        raise AssertionError("a model is called for one call alone")

    monkeypatch.setattr(Model, "__call__", one_by_one)
    verdict = check.run(ask, np.random.default_rng(1))
    assert verdict.state.name in ("INCORRECT", "PARTLY_CORRECT"), verdict.problem
    # Once more; then other arguments and other units, at the few calls that tell most; of the drift
    # for each of its parts, which have calls of their own.
    assert len(asked) == (11 if answer == "energy_drift" else 7)


def test_many_torques_are_solved_as_each_is():
    rng = np.random.default_rng(5)
    M, torques = rng.normal(size=(4, 3, 3)), rng.normal(size=(6, 4, 3))
    M[2, 1] = 2 * M[2, 0]  # no inverse
    found = solved(M, torques)
    for k, case in np.ndindex(6, 4):
        if case == 2:
            assert np.isnan(found[k, case]).all()
        else:
            np.testing.assert_allclose(M[case] @ found[k, case], torques[k, case], atol=1e-12)
    np.testing.assert_allclose(solved(np.array([M, 2 * M]), torques[:2])[0], found[0], rtol=1e-12)


def test_what_is_shared_follows_from_its_arguments():
    counted = []
    double = shared(lambda *arrays: counted.append(1) or 2 * arrays[0])
    x, y = np.ones(2), np.zeros(2)
    assert double(x, y) is double(x, y)
    assert len(counted) == 1
    with pytest.raises(ValueError, match="read-only"):
        double(x, y)[0] = 5.0
    np.testing.assert_array_equal(double(y, y), y)
    np.testing.assert_array_equal(double(x.copy(), y), 2 * x)
    assert len(counted) == 3


def test_an_answer_may_be_changed_without_changing_the_next():
    M = check_of(MECHANISMS["planar-2r"], "M").reference
    q, arm = np.array([0.3, 0.4]), MECHANISMS["planar-2r"].drawn(np.random.default_rng(0))
    first = M(q, arm)
    before = first.copy()
    first[0, 0] = 99.0
    np.testing.assert_array_equal(M(q, arm), before)
    other = SimpleNamespace(**vars(arm) | {"I1": arm.I1 + 1.0})
    assert M(q, other)[0, 0] == pytest.approx(before[0, 0] + 1.0)
