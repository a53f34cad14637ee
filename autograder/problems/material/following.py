"""What follows from what in the problems of the course, where it is not the same for every mechanism.

The general ways are in `judging.carried.ways`. Right formulas do not enter: all is made of the student's
own functions.
"""

import numpy as np

from autograder.judging.carried.follows import Way
from autograder.judging.carried.ways import SECOND, STEPS, christoffel, derivative
from autograder.protocol import Call, Symbol, real

# Of the one joint, the derivative of its inertia needs one coordinate.
ONE = np.ones(1)
# What is left of a torque at an equilibrium, as a share of the torque half a radian beside it.
NO_TORQUE = 1e-5
HALF_A_RADIAN = 0.5
BASE_COLUMNS = [1, 2, 4, 5]
# Of a singular value of stacked rows, as a share of the largest: less is rounding.
ROUNDING = 1e-9


def symbolic_lagrangian(pend, states) -> Call:
    """The student's L(q, q̇, m, ℓc, I, g) at states (q, q̇) of the pendulum."""
    names = ("q", "qd", "m", "lc", "I", "g")
    points = tuple({"q": float(q), "qd": float(qd), **vars(pend)} for q, qd in states)
    return Call("lagrangian", tuple(map(Symbol, names)), points)


def _inertia(call, value, numbers):
    # L is a square of q̇, so steps as long as these leave no error.
    return np.reshape(SECOND @ np.reshape(numbers[0], 5), (1, 1))


INERTIA_OF_L = Way(
    lambda call, value: [
        symbolic_lagrangian(call.args[1], [(call.args[0][0], qd) for qd in (-2, -1, 0, 1, 2)])
    ],
    _inertia,
)
GRAVITY_OF_L = Way(
    lambda call, value: [
        symbolic_lagrangian(call.args[1], [(call.args[0][0] + step, 0.0) for step in STEPS])
    ],
    lambda call, value, numbers: -derivative(np.reshape(numbers[0], (4, 1))),
)


def _frequency(call, value, numbers):
    M, *torques = (np.reshape(number, ()) for number in numbers)
    stiffness = derivative(torques)
    return np.sqrt(stiffness / M) if M > 0 and stiffness > 0 else None


FREQUENCY = Way(
    lambda call, value: [
        Call("M", (0 * ONE, call.args[0])),
        *(Call("g_vec", (step * ONE, call.args[0])) for step in STEPS),
    ],
    _frequency,
)


def _configurations(value) -> np.ndarray:
    return np.reshape(np.asarray(value, dtype=float), (-1, 2))


def _torques(call, value):
    """At each configuration, and beside it."""
    at = _configurations(value)
    beside = [at + HALF_A_RADIAN * turn for turn in np.eye(2)]
    return [Call("g_vec", (q, *call.args)) for rows in (at, *beside) for q in rows]


def _four_at_rest(call, value, numbers):
    """The answer itself, where the own g vanishes at four configurations and nowhere else in it."""
    at, torques = _configurations(value), np.reshape(numbers, (3, -1, 2))
    sizes = np.max(np.abs(torques), axis=(0, 1))
    turns = np.exp(1j * at)  # equal where angles differ by 2π
    apart = {tuple(np.round(turn, 6) + 0.0) for turn in turns}
    balanced = np.all(np.abs(torques[0]) <= NO_TORQUE * sizes) and np.all(sizes > 0)
    return value if balanced and len(apart) == 4 else None


EQUILIBRIA = Way(_torques, _four_at_rest, of_own=True)


def _other_C(call, value, numbers):
    (qd1, qd2), C = call.args[1], np.reshape(numbers[0], (2, 2))
    return C + np.array([[-qd2, qd1], [0.0, 0.0]])


SAME_PRODUCT = Way(lambda call, value: [Call("C", call.args)], _other_C)


def _steps(call, value):
    """One step from each row that the student's own run has."""
    f, x0, u, t = call.args
    rows = np.reshape(value, (len(t), len(x0)))
    held = real(u)
    return [
        Call("rk4_step", (f, x, held(at, x) if callable(held) else u, float(dt)))
        for x, at, dt in zip(rows[:-1], t[:-1], np.diff(t), strict=True)
    ]


RUN_OF_STEPS = Way(
    _steps,
    lambda call, value, numbers: np.array(
        [call.args[1], *(np.reshape(x, len(call.args[1])) for x in numbers)]
    ),
    of_own=True,
    still=lambda call: np.tile(call.args[1], (len(call.args[3]), 1)),
)


def _samples(call, value):
    q, qd, qdd = call.args[:3]
    return [Call("regressor", (*sample, call.args[-1])) for sample in zip(q, qd, qdd, strict=True)]


def _stacked(numbers) -> np.ndarray:
    return np.vstack([np.reshape(Y, (2, 6)) for Y in numbers])


def _rank(call, value, numbers):
    sizes = np.linalg.svd(_stacked(numbers))[1]
    return np.array(float(np.sum(sizes > ROUNDING * sizes[0])))


RANK_OF_Y = Way(_samples, _rank)


def _fit(call, value, numbers):
    W = _stacked(numbers)[:, BASE_COLUMNS]
    return np.linalg.lstsq(W, np.ravel(call.args[3]), rcond=ROUNDING)[0]


FIT_OF_Y = Way(_samples, _fit)


def _law(q, qd, ref, gains):
    """q̇r, q̈r and s of the law of Slotine and Li."""
    qd_r = ref.qd - gains.Lam @ (q - ref.q)
    return qd_r, ref.qdd - gains.Lam @ (qd - ref.qd), qd - qd_r


def _of_law(call, value):
    q, qd, ref, _, gains, arm = call.args
    qd_r, qdd_r, _ = _law(q, qd, ref, gains)
    return [Call("regressor_r", (q, qd, qd_r, qdd_r, arm))]


def _controlled(call, value, numbers):
    q, qd, ref, pi_hat, gains, _ = call.args
    s, Y = _law(q, qd, ref, gains)[2], np.reshape(numbers[0], (2, 6))
    return np.concatenate([Y @ pi_hat - gains.KD @ s, -gains.Gamma @ Y.T @ s])


LAW_OF_Y = Way(_of_law, _controlled)


def _slope_of_inertia(call, value):
    return [Call("M", (call.args[0] + step, call.args[2])) for step in STEPS]


CORIOLIS_OF_M = Way(
    _slope_of_inertia,
    lambda call, value, numbers: christoffel(
        np.reshape(derivative(np.reshape(numbers, 4)), (1, 1, 1)), call.args[1]
    ),
)
