"""What is said of an error that no mistake explains: what alone changes it, and whether units fit."""

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder.judging.check import Check, Criterion
from autograder.judging.scaling import InOtherUnits, scalings, sentence
from autograder.protocol import Call, Reply, Symbol, real

ALL = {"arm.m1", "arm.m2", "arm.l1", "arm.I1", "q[0]", "q[1]"}


def right(q, arm):
    return np.array(arm.I1 + arm.m1 * arm.l1**2 + arm.m2 * arm.l1**2 * np.cos(q[1]) * np.cos(q[0]))


def calls(rng, count):
    return [
        Call("M", (rng.uniform(-1, 1, 2), SimpleNamespace(
            **dict(zip(("m1", "m2", "l1", "I1"), rng.uniform(1, 2, 4).tolist(), strict=True))
        )))
        for _ in range(count)
    ]  # fmt: skip


CHECK = Check("x-M", "M(q, arm)", right, calls, (Criterion("inertia", "kg·m²"),))


def said(theirs, check=CHECK) -> str:
    def ask(calls):
        return [Reply(value=np.asarray(theirs(*map(real, call.args)), float)) for call in calls]

    return " ".join(check.run(ask, np.random.default_rng(3)).diagnosis)


TERMS = {
    "arm.m1": lambda q, arm: arm.m1**2,
    "arm.m2": lambda q, arm: np.sqrt(arm.m2),
    "arm.l1": lambda q, arm: arm.l1**3,
    "arm.I1": lambda q, arm: arm.I1**2,
    "q[0]": lambda q, arm: q[0] ** 3 + 5,
    "q[1]": lambda q, arm: np.exp(q[1]),
}


@given(st.sets(st.sampled_from(sorted(TERMS)), min_size=1, max_size=4))
def test_a_surplus_is_said_to_change_with_its_own_arguments_alone(used):
    text = said(lambda q, arm: right(q, arm) + np.prod([TERMS[of](q, arm) for of in sorted(used)]))
    assert "What is off in your inertia changes with " in text
    named = text.partition("changes with ")[2].partition(" alone")[0]
    assert {of for of in ALL if of in named} == used


def test_a_mere_number():
    assert "is the same whatever the arguments are" in said(lambda q, arm: right(q, arm) + 2)


@pytest.mark.parametrize("wave", [lambda a: np.sin(3 * a) + 2, np.exp])
def test_a_factor_that_one_argument_changes(wave):
    text = said(lambda q, arm: right(q, arm) * wave(q[1]))
    assert "off by a factor that changes with q[1] alone" in text


def test_where_everything_changes_the_error_nothing_is_said():
    every = [TERMS[of] for of in sorted(TERMS)]
    text = said(lambda q, arm: right(q, arm) + np.prod([term(q, arm) for term in every]))
    assert "alone" not in text


def test_rounding_is_no_error():
    """Of a derivative by differences, whose noise changes with every argument."""
    noise = np.random.default_rng(0)
    text = said(lambda q, arm: (right(q, arm) + arm.m1**2) * (1 + 1e-7 * noise.normal()))
    assert "alone" not in text


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        (
            lambda q, arm: right(q, arm) + arm.m1 * arm.m2 * arm.l1**2,
            "every mass and inertia doubled",
        ),
        (lambda q, arm: right(q, arm) + arm.m1 * arm.l1, "every length doubled"),
    ],
)
def test_units_that_do_not_come_out(wrong, words):
    assert f"With {words}" in said(wrong)


@pytest.mark.parametrize("factor", [1.7, -0.3])
def test_of_right_units_nothing_is_said(factor):
    assert "doubled" not in said(lambda q, arm: right(q, arm) + factor * arm.m1 * arm.l1**2 * q[0])


def test_nothing_is_asked_where_the_right_answer_has_no_one_power():
    """As where a length is a coordinate, which is not told by its name."""
    check = Check(
        "x-M", "M(q, arm)", lambda q, arm: np.array(arm.m1 * q[0] ** 2 + arm.I1), calls,
        (Criterion("inertia", "kg·m²"),),
    )  # fmt: skip
    text = said(lambda q, arm: arm.m1 * q[0] ** 2 + arm.I1 + arm.l1, check)
    assert "every length" not in text


@pytest.mark.parametrize("right", [(3.0, ()), (3.0, 6.0)])
def test_nothing_is_asked_where_units_decide_how_many_values_there_are(right):
    """As of those at which the bounded control does not saturate."""
    call = Call("f", (np.ones(2),))
    tried = InOtherUnits(
        scalings("f(qd)", call), [(np.atleast_1d(one),) for one in right], [([1.0],), ([],)]
    )
    assert sentence("V̇", 0, tried) == ""


def test_a_state_is_half_velocities():
    (*_, fast) = scalings("drift(x)", Call("drift", (np.ones((3, 4)),)))
    np.testing.assert_equal(fast.call.args[0], np.tile([1.0, 1.0, 2.0, 2.0], (3, 1)))


def test_symbols_are_scaled_at_their_points():
    call = Call("L", (Symbol("qd"), Symbol("m")), at=({"qd": 3.0, "m": 2.0},))
    found = {one.change.of: one.call.at for one in scalings("L(qd, m)", call)}
    assert found["every velocity doubled"] == ({"qd": 6.0, "m": 2.0},)
