"""The two motions: the right one is armdyn's, the student's that of their term in armdyn's arm."""

import time

import numpy as np
import pytest

from armdyn import Pendulum, Planar2R
from armdyn.simulate import simulate
from autograder.mechanisms import MECHANISMS
from autograder.pictures.differences import sentences
from autograder.pictures.equations import BUDGET
from autograder.pictures.motion import FRAMES, STEPS, Motion, compared
from autograder.problems import known_check
from autograder.problems.material.conventions import BOOK, Convention
from tests.autograder.pictures.wrong import (
    CART,
    COSINE,
    MINUS,
    NOT_SKEW_C,
    OTHER_SIGN_C,
    UPWARD,
    first_call,
    function,
    played,
)

EXACTLY = 1e-10


def by_armdyn(model, motion: Motion, u=None) -> np.ndarray:
    """The states that armdyn's RK4 gives at the same times, with the same steps."""
    t = np.linspace(0.0, motion.t[-1], STEPS * (len(motion.t) - 1) + 1)
    u = np.zeros(model.n) if u is None else u
    return simulate(model.state_derivative, motion.x[0], u, t)[::STEPS]


def with_term(model, name: str, student, arm):
    """armdyn's model with the student's function in the place of one of its terms."""

    class Mistaken(type(model)):
        pass

    setattr(Mistaken, name, lambda self, *state: np.reshape(student(*state, arm), shape))
    shape = {"M": (model.n, model.n), "C": (model.n, model.n), "g_vec": (model.n,)}[name]
    return Mistaken(**vars(arm))


@pytest.mark.parametrize(
    ("id", "body"),
    [("p1-M", MINUS), ("p2-C", OTHER_SIGN_C), ("p4-g_vec", UPWARD), ("p3-g_vec", COSINE)],
)
def test_right_is_armdyns_motion_and_theirs_is_that_with_their_term(id, body):
    both = played(id, body)
    arm = first_call(id).args[-1]
    model = (Pendulum if id.startswith("p3") else Planar2R)(**vars(arm))
    assert len(both.right.t) == len(both.theirs.t) == FRAMES + 1
    assert both.theirs.stopped == ""
    np.testing.assert_allclose(both.right.x, by_armdyn(model, both.right), atol=EXACTLY)
    theirs = with_term(model, known_check(id).name, function(id, body), arm)
    np.testing.assert_allclose(both.theirs.x, by_armdyn(theirs, both.theirs), atol=EXACTLY)
    assert np.max(np.abs(both.theirs.x - both.right.x)) > 0.1
    np.testing.assert_array_equal(both.theirs.x[0], both.right.x[0])


def test_a_rate_is_played_with_its_torque_and_with_friction():
    id = "p5-f"
    call = first_call(id)
    x0, u, arm = call.args
    both = played(id, "np.concatenate([x[2:], u])")
    model = Planar2R(**vars(arm))
    np.testing.assert_allclose(both.right.x, by_armdyn(model, both.right, u), atol=1e-6)
    t = both.theirs.t[:, None]
    np.testing.assert_allclose(both.theirs.x[:, 2:], x0[2:] + u * t, atol=1e-9)
    np.testing.assert_allclose(both.theirs.x[:, :2], x0[:2] + x0[2:] * t + u * t**2 / 2, atol=1e-9)
    assert not both.is_free


def test_an_arm_of_ones_own_moves_as_the_arm_of_the_book():
    own = Convention("crossed", "hanging")
    check = known_check("p4-g_vec", own)
    call = check.calls(np.random.default_rng(1), 6)[0]
    both = compared(check, lambda q, arm: 0 * q, call)
    model = Planar2R(**vars(call.args[-1]))
    directions = own.directions(both.right.x[:, :2])
    start = BOOK.angles_at(directions[0])
    t = np.linspace(0.0, both.right.t[-1], STEPS * FRAMES + 1)
    x = simulate(model.state_derivative, [*start, 0, 0], [0, 0], t)[::STEPS]
    np.testing.assert_allclose(BOOK.directions(x[:, :2]), directions, atol=1e-6)
    np.testing.assert_allclose(both.theirs.x, np.tile(both.theirs.x[0], (FRAMES + 1, 1)))


@pytest.mark.parametrize("mechanism", MECHANISMS.values(), ids=lambda m: m.name)
def test_the_right_motion_of_every_mechanism_keeps_its_energy(mechanism):
    check = known_check(f"{mechanism.name}-g_vec")
    call = check.calls(np.random.default_rng(2), 6)[0]
    both = compared(check, lambda q, arm: np.zeros(mechanism.n), call)
    E = both.equations.energy(both.right.x)
    n = mechanism.n
    # What is exchanged between P and K says how large a change would be.
    K = E - both.equations.energy(np.hstack([both.right.x[:, :n], 0 * both.right.x[:, n:]]))
    assert np.ptp(E) <= 1e-4 * np.max(np.abs(K))
    assert np.max(K) > 0


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("np.ones((2, 2))", "there is no motion: M is singular there, and no acceleration"),
        ("1e-9 * np.eye(2)", "there is no motion: its speed grows beyond all bounds"),
        ("np.full((2, 2), np.nan)", "there is no motion: M(q, arm) returned nan at [0, 0]"),
        (
            "np.eye(3)",
            "M(q, arm) returned an array of shape (3, 3), where the equation needs (2, 2)",
        ),
        ("[[1, 'x'], [0, 1]]", "there is no motion: M(q, arm) returned"),
        ("1 / (q[0] - q[0]).item()", "M(q, arm) raised ZeroDivisionError: float division by zero"),
        ("exit()", "there is no motion: M(q, arm) raised SystemExit"),
    ],
)
def test_what_cannot_be_played_says_why(body, said):
    both = played("p1-M", body)
    assert len(both.theirs.t) == 1
    (sentence,) = sentences(both)
    assert said in sentence


def test_an_endless_loop_costs_no_more_than_the_budget():
    started = time.process_time()
    both = played("p1-M", "while True:\n    pass\nreturn 0")
    assert "it takes more than 0.3 s of computing" in both.theirs.stopped
    # What is left is the right motion, and SymPy's first use.
    assert time.process_time() - started < 4 * BUDGET + 3


def test_a_motion_that_stops_on_the_way_is_played_as_far_as_it_goes():
    body = (
        f"if abs(q[0] - {first_call('p1-M').args[0][0]!r}) > 0.05:\n    raise ValueError('far')\n"
    )
    both = played("p1-M", f"{body}return np.eye(2)")
    assert 1 < both.common < FRAMES
    *_, last = sentences(both)
    assert last.startswith("With your M it stops after 0.")
    assert last.endswith("s: M(q, arm) raised ValueError: far.")
    np.testing.assert_array_equal(both.theirs.t, both.right.t[: both.common])


def test_what_students_print_or_change_reaches_nobody(capsys):
    both = played("p1-M", "print('loud')\nq[:] = 7.0\narm.l1 = 0.0\nreturn np.eye(2)")
    assert capsys.readouterr() == ("", "")
    assert both.theirs.stopped == ""
    assert both.right.x[0, 0] == first_call("p1-M").args[0][0]
    assert vars(both.arm)["l1"] > 0


def test_a_c_of_which_the_motion_sees_nothing_is_said_to_be_seen_by_nobody():
    both = played("p2-C", NOT_SKEW_C)
    assert both.alike
    assert both.right.t[-1] == 1.0  # tried for longer
    (said,) = sentences(both)
    assert "the motion sees C only in C q̇" in said


def test_a_wrong_c_that_hardly_shows_is_not_called_right_in_its_product():
    both = played("p2-C", f"{NOT_SKEW_C.rstrip()} * (1 + 2e-4)")
    assert both.alike
    (said,) = sentences(both)
    assert said == (
        "Both move alike from this state: what is wrong with your C does not show here."
    )


def test_the_cart_is_played_from_rest():
    both = played("cart-pole-M", CART)
    assert np.all(both.right.x[0, 2:] == 0)
    assert both.tips(both.right).shape == (FRAMES + 1, 2)
    assert not both.alike
