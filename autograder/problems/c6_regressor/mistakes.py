"""Mistakes about the regressor, about fitting with it, and about counting what a motion shows."""

from types import SimpleNamespace

import numpy as np

from autograder.judging.claims import Claim
from autograder.judging.diagnosis import Mistake
from autograder.problems.material import sentences
from autograder.problems.material.planar_2r import (
    BASE_COLUMNS,
    base_parameters,
    changed,
    regressor,
)

# The arm of the notebook's set-up cell.
EXAMPLE = SimpleNamespace(
    l1=0.45, l2=0.38, lc1=0.21, lc2=0.17, m1=4.2, m2=2.6, I1=0.075, I2=0.034, g=9.81
)
M1, MC1, J1, M2, MC2, J2 = range(6)


def _with(**of):
    """The right Y of an arm, of which some parameters are others of it (by name) or numbers."""
    return lambda q, qd, qdd, arm: regressor(
        q,
        qd,
        qdd,
        changed(arm, **{k: getattr(arm, v) if isinstance(v, str) else v for k, v in of.items()}),
    )


def _parts(gravity=1.0, velocity=1.0, acceleration=1.0, weighed_at=lambda q1, q2: (q1, q2)):
    """The right Y with its three parts times these numbers, gravity at other angles."""

    def wrong(q, qd, qdd, arm):
        weightless, still = changed(arm, g=0.0), 0.0 * qd
        at = np.stack(weighed_at(q[..., 0], q[..., 1]), axis=-1)
        return (
            gravity * regressor(at, still, still, arm)
            + velocity * regressor(q, qd, still, weightless)
            + acceleration * regressor(q, still, qdd, weightless)
        )

    return wrong


def _plus(entries):
    """The right Y with something added: entries gives it by (row, column)."""

    def wrong(q, qd, qdd, arm):
        Y = regressor(q, qd, qdd, arm)
        for (row, column), value in entries(_State(q, qd, qdd), arm).items():
            Y[..., row, column] += value
        return Y

    return wrong


def _columns(*order):
    """The right columns in another order."""
    return lambda q, qd, qdd, arm: regressor(q, qd, qdd, arm)[..., order]


def _plus_column_of(column):
    """The right Y with what belongs in a column also in that of m1, which is empty."""

    def wrong(*state):
        Y = regressor(*state)
        Y[..., M1] = Y[..., column]
        return Y

    return wrong


class _State:
    """The accelerations by name, and cosines, of one state or of many."""

    def __init__(self, q, qd, qdd):
        self.qdd1, self.spin_2 = qdd[..., 0], qdd[..., 0] + qdd[..., 1]
        self.c1, self.c2 = np.cos(q[..., 0]), np.cos(q[..., 1])


NO_GRAVITY = (
    "Gravity is missing from your Y. Y π is the whole left side M q̈ + C q̇ + g: which columns does "
    "the weight of a link enter?"
)
ABOUT_COM = (
    "Your Y uses ℓc. That is one of the unknowns, and Y may hold only what is known. About which "
    "point must you take the inertia in π, so that ℓc² goes into it?"
)
ORDER = (
    "Your columns are right, but they stand in another order than the parameters in π. Write the "
    "names of the six parameters above your columns."
)
HARD_CODED_G = (
    "Your Y is right only on Earth, because you typed 9.81 into it. The check also puts the arm "
    "on other planets: which parameter of arm gives g?"
)
EXAMPLE_ARM = (
    "Your Y is always that of the arm in the set-up cell, whatever arm is given. Where does your "
    "function read ℓ1 and g of its own argument?"
)
COUPLING_ONCE = (
    "In your column of m2 ℓc2, q̈1 counts too little at joint 1. Look at the coupling term of M11 "
    "and of M12: are they the same?"
)
CENTRIFUGAL = (
    "A product of velocities has the wrong sign in your column of m2 ℓc2. Compare with C q̇: "
    "which joint gets h and which gets −h, and what sign does h itself have?"
)

REGRESSOR_SAID = {
    "wrong sign / g(q)": (
        "Gravity has the wrong sign in your Y. On which side of the equation does g(q) stand, "
        "and which way must the motors push to hold the arm out to the right?"
    ),
    "dropped / the weight of link 2 at the elbow / in g_vec": (
        "The weight is missing from your column of m2. The elbow carries m2: which joint holds "
        "it up?"
    ),
    "dropped / the weight of link 2 beyond the elbow / in g_vec": (
        "Gravity is missing from your column of m2 ℓc2. Where in g(q) does the product m2 ℓc2 "
        "stand?"
    ),
    "dropped / the weight of link 2 beyond the elbow / g1 / in g_vec": (
        "Gravity is missing at joint 1 in your column of m2 ℓc2. Does the direction of link 2 "
        "change when joint 1 turns?"
    ),
    "dropped / g(q)": NO_GRAVITY,
    "dropped / g(q) / row 1": NO_GRAVITY,  # so that both rows say it once
    "sine for cosine / in g_vec": (
        "In your Y, gravity varies with the sine, as if the angles were measured from the "
        "vertical. From which axis is q1 measured, and at which q1 does the weight of link 1 "
        "pull most?"
    ),
    "wrong angle / the weight of link 2 beyond the elbow / q2 / q1 + q2 / in g_vec": (
        "In the gravity of link 2 you take q2 for its direction in space. From where is q2 "
        "measured?"
    ),
    "halved / the coupling of the two links / M11 / in M": COUPLING_ONCE,
    "sine for cosine / the coupling of the two links / in M": (
        "In your column of m2 ℓc2, the accelerations come with the sine of q2. Which function "
        "of q2 does M hold, and is it largest when the arm is stretched?"
    ),
    "wrong angle / the coupling of the two links / q1 / q2 / in M": (
        "In your column of m2 ℓc2, the accelerations come with the cosine of q1. Would the "
        "inertia of the arm change if the whole arm turned about the shoulder?"
    ),
    "dropped / C q̇ / row 2": (
        "In your Y, the row of joint 2 has no product of velocities. What does link 2 feel at "
        "the elbow when only joint 1 turns?"
    ),
    "dropped / C q̇": (
        "Your Y does not depend on the velocities. Where does C(q, q̇) q̇ enter, and with which "
        "product of parameters?"
    ),
    "dropped / the coupling of the two links / C11 / in C": (
        "In your column of m2 ℓc2, the product q̇1 q̇2 counts only half. How many entries of C "
        "bring it into C q̇?"
    ),
    "product dropped / row 1 / qd2² / in C": (
        "In your column of m2 ℓc2, the square of q̇2 is missing at joint 1. Multiply C by q̇ "
        "once more, entry by entry."
    ),
    "wrong sign / C q̇": CENTRIFUGAL,
    "wrong sign / C q̇ / row 1": CENTRIFUGAL,
    "wrong sign / C q̇ / row 2": CENTRIFUGAL,
    "no velocity / in C": (
        "Your velocities stand alone, not in products: you have added up the rows of C. By "
        "which vector must you multiply C?"
    ),
    "dropped / the column of I2 + m2·lc2² / row 1": (
        "In your column of J2, the row of joint 1 is empty. Does joint 1 not turn link 2 as well?"
    ),
    "square lost / the mass of link 2 at the elbow / l1 / l1² / in M and C": (
        "Look at the units in your column of m2. By what must you multiply m2 to get an inertia?"
    ),
    "dropped / the mass of link 2 at the elbow / in M and C": (
        "Your column of m2 holds only the weight. Joint 1 also accelerates the elbow: what "
        "inertia does a mass m2 have there?"
    ),
    "dropped / M q̈": (
        "Your Y does not depend on the accelerations. Y π is the whole left side M q̈ + C q̇ + "
        "g: which columns does q̈ enter?"
    ),
    "dropped / the column of m2": (
        "Your column of m2 is empty. Put all of m2 into the elbow, so that ℓc2 = 0: does joint "
        "1 feel it?"
    ),
    "parameters inside": (
        "Your columns add up to the torque: each of them still holds its own parameter. What is "
        "left of a column when you take π out of it?"
    ),
    "sign of the whole": (
        "Every entry of your Y has the wrong sign. On which side of the equation of motion do "
        "the torques u stand?"
    ),
    "columns in another order / *": ORDER,
    "joints exchanged": (
        "You swapped the rows of the two joints. Which joint feels the weight of link 1?"
    ),
    "wrong parameter / l2 / l1 / in M and g": (
        "You use ℓ2 where link 2 begins. Which length leads from the shoulder to the elbow?"
    ),
    "parameter left out / g / in g_vec": (
        "The gravitational acceleration g is missing from your Y. Is g one of the unknowns?"
    ),
    "gravity of Earth / 9.81 / g / in g_vec": HARD_CODED_G,
    "numbers of the example": EXAMPLE_ARM,
    "radians converted": sentences.RADIANS_CONVERTED,
    "angle in degrees": sentences.IN_DEGREES,
}
_absolute_acceleration = _plus(lambda s, arm: {(0, J2): -s.qdd1, (1, J2): -s.qdd1})
_coupling_once = _plus(lambda s, arm: {(0, MC2): -arm.l1 * s.c2 * s.qdd1})
# This one also follows from the arm, but there what is halved is never one of two mistakes.
REGRESSOR = (
    Mistake("coupling without the factor 2", _coupling_once, COUPLING_ONCE),
    Mistake(
        "absolute acceleration of link 2",
        _absolute_acceleration,
        "In your column of J2, link 2 turns with q̈2 only. What is its angular acceleration in space?",
    ),
    Mistake(
        "absolute acceleration of link 2 at joint 2",
        _plus(lambda s, arm: {(1, J2): -s.qdd1}),
        "In your column of J2, joint 2 does not feel q̈1. Is J2 in M12?",
    ),
    Mistake(
        "acceleration of joint 1 for link 2 at joint 1",
        _plus(lambda s, arm: {(0, J2): s.qdd1 - s.spin_2}),
        "In your column of J2, joint 1 does not feel q̈2. Is J2 in M12?",
    ),
    Mistake(
        "acceleration of link 2 for link 1",
        _plus(lambda s, arm: {(0, J1): s.spin_2 - s.qdd1}),
        "In your column of J1, joint 1 feels q̈2. Does link 1 turn faster as joint 2 does?",
    ),
    Mistake(
        "J1 at joint 2",
        _plus(lambda s, arm: {(1, J1): s.qdd1}),
        "In your column of J1, joint 2 has a torque. Which joints does link 1 load: those before "
        "it or those after it?",
    ),
    Mistake(
        "inertia about the centre of mass",
        _plus(
            lambda s, arm: {
                (0, M1): arm.lc1**2 * s.qdd1,
                (0, M2): arm.lc2**2 * s.spin_2,
                (1, M2): arm.lc2**2 * s.spin_2,
            }
        ),
        ABOUT_COM,
    ),
    Mistake(
        "inertia about the centre of mass, in the column of m lc",
        _plus(
            lambda s, arm: {
                (0, MC1): arm.lc1 * s.qdd1,
                (0, MC2): arm.lc2 * s.spin_2,
                (1, MC2): arm.lc2 * s.spin_2,
            }
        ),
        ABOUT_COM,
    ),
    Mistake(
        "weight of link 1 in the column of m1",
        _plus(lambda s, arm: {(0, M1): arm.lc1 * arm.g * s.c1, (0, MC1): -arm.g * s.c1}),
        "You put the weight of link 1 into the column of m1, with ℓc1 in Y. ℓc1 is one of the "
        "unknowns: which entry of π holds it already?",
        claim=Claim.WHOLE,
    ),
    Mistake("each link reversed", _columns(J1, MC1, M1, J2, MC2, M2), ORDER, claim=Claim.WHOLE),
    Mistake("inertia first", _columns(J1, M1, MC1, J2, M2, MC2), ORDER, claim=Claim.WHOLE),
    Mistake(
        "inertia before first moment", _columns(M1, J1, MC1, M2, J2, MC2), ORDER, claim=Claim.WHOLE
    ),
    Mistake("first moment first", _columns(MC1, M1, J1, MC2, M2, J2), ORDER, claim=Claim.WHOLE),
    Mistake("link 2 first", _columns(M2, MC2, J2, M1, MC1, J1), ORDER, claim=Claim.WHOLE),
    *(
        Mistake(
            f"the column of {name} in that of m1",
            _plus_column_of(column),
            "Your column of m1 holds what belongs in another one. Put all of m1 into the shoulder, so "
            "that ℓc1 = 0: does joint 1 feel it?",
        )
        for column, name in ((MC1, "m1 lc1"), (J1, "J1"), (M2, "m2"), (MC2, "m2 lc2"), (J2, "J2"))
    ),
    Mistake(
        "reshaped for transposed",
        lambda q, qd, qdd, arm: np.reshape(regressor(q, qd, qdd, arm).T, (2, 6)),
        sentences.RESHAPED,
    ),
    Mistake(
        "lc1 for l1",
        _with(l1="lc1"),
        "You let link 2 begin at the centre of mass of link 1. Where on link 1 is the elbow?",
    ),
)


def stacked(Y) -> np.ndarray:
    """The rows of all samples, one under the other: (K, 2, p) as (2K, p)."""
    return np.reshape(Y, (-1, np.shape(Y)[-1]))


def solved(W, u) -> np.ndarray:
    """The least-squares solution of W x = u; of least length where it is not the only one."""
    return np.linalg.lstsq(W, np.ravel(u), rcond=1e-10)[0]


def _fit(solve, Y=regressor):
    """An estimate from Y of the base parameters, (K, 2, 4), and the torques, (K, 2)."""
    return lambda q, qd, qdd, u, arm: solve(
        Y(q, qd, qdd, arm)[..., BASE_COLUMNS], np.reshape(u, (-1, 2))
    )


def _least_squares(Y, u) -> np.ndarray:
    return solved(stacked(Y), u)


fit = _fit(_least_squares)  # the right answer, (4,)


def _of(rows):
    """The fit with some of the samples or of the joints only."""
    return _fit(lambda Y, u: _least_squares(Y[rows], u[rows]))


def _ridge(weight):
    def solve(Y, u):
        W = stacked(Y)
        return np.linalg.solve(W.T @ W + weight * np.eye(4), W.T @ np.ravel(u))

    return _fit(solve)


def _with_offset(offsets):
    """The fit with further columns, one for each column of offsets, (2, k), at every sample."""
    return _fit(lambda Y, u: solved(np.hstack([stacked(Y), np.tile(offsets, (len(u), 1))]), u)[:4])


@_fit
def _joint_after_joint(Y, u):
    """Link 2 from the torques of joint 2, then the rest from those of joint 1."""
    of_link_2 = solved(Y[:, 1, 2:], u[:, 1])
    return np.concatenate([solved(Y[:, 0, :2], u[:, 0] - Y[:, 0, 2:] @ of_link_2), of_link_2])


@_fit
def _mean_of_joints(Y, u):
    return (solved(Y[:, 0], u[:, 0]) + solved(Y[:, 1], u[:, 1])) / 2


@_fit
def _mean_of_samples(Y, u):
    return np.mean([np.linalg.pinv(Yk) @ uk for Yk, uk in zip(Y, u, strict=True)], axis=0)


@_fit
def _scaled(Y, u):
    return _least_squares(Y / np.linalg.norm(stacked(Y), axis=0), u)


@_fit
def _total(Y, u):
    *others, last = np.linalg.svd(np.column_stack([stacked(Y), np.ravel(u)]))[2][-1]
    return -np.array(others) / last


def _shortest_pi(q, qd, qdd, u, arm):
    return _least_squares(regressor(q, qd, qdd, arm), u)[[*BASE_COLUMNS]]


def _reordered(*order):
    return _fit(lambda Y, u: _least_squares(Y, u)[[*order]])


ONE_SAMPLE = (
    "Your estimate uses only one sample: two equations for four numbers. Stack all samples under "
    "each other, and solve once."
)
STACKING = (
    "The rows of your W and the entries of your torque vector are in different orders: one goes "
    "sample by sample, the other joint by joint. Look at the first three of each."
)
REGULARISED = (
    "You add something to the diagonal of WᵀW, which pulls your estimate towards zero. This "
    "motion shows all four numbers: does the system need that?"
)
OFFSET = (
    "Your fit has an offset as one more unknown. Without noise it comes out as zero, but with "
    "noise it takes up a part of the torque. Is there a constant torque in the equation of "
    "motion?"
)
ESTIMATE_ORDER = (
    "Your four numbers are right, but in another order. In which order does the docstring ask for "
    "them?"
)

IDENTIFY = (
    Mistake(
        "joint 1 only",
        _of((slice(None), 0)),
        "Your fit uses only the torques of joint 1. Without noise they are enough. With noise, "
        "what do the equations of joint 2 still tell you?",
    ),
    Mistake(
        "joint 2 only",
        _of((slice(None), 1)),
        "Your fit uses only the torques of joint 2. Which of the four numbers can that joint feel?",
    ),
    Mistake(
        "joint after joint",
        _joint_after_joint,
        "You fit link 2 to the torques of joint 2, and then the rest to those of joint 1. Without "
        "noise that is enough. With noise, what does joint 1 tell you about link 2?",
    ),
    Mistake(
        "mean of both joints",
        _mean_of_joints,
        "You fit each joint by itself and take the mean. Can joint 2 show all four numbers? Put "
        "the rows of both joints into one system.",
    ),
    Mistake(
        "first sample",
        _of(slice(0, 1)),
        ONE_SAMPLE,
    ),
    Mistake("last sample", _of(slice(-1, None)), ONE_SAMPLE),
    Mistake(
        "last sample forgotten",
        _of(slice(None, -1)),
        "You leave the last sample out of your fit. Where does your loop end?",
    ),
    Mistake(
        "first sample forgotten",
        _of(slice(1, None)),
        "You leave the first sample out of your fit. At which index does an array begin?",
    ),
    Mistake(
        "mean of the samples' own solutions",
        _mean_of_samples,
        "You solve each sample by itself and take the mean. A sample gives two equations for four "
        "numbers, which have many solutions. Stack the samples first, then solve.",
    ),
    Mistake(
        "torques joint by joint",
        _fit(lambda Y, u: _least_squares(Y, u.T)),
        STACKING,
    ),
    Mistake(
        "rows joint by joint",
        _fit(lambda Y, u: _least_squares(Y.swapaxes(0, 1), u)),
        STACKING,
    ),
    *(Mistake(f"ridge {w:g}", _ridge(w), REGULARISED) for w in (1.0, 0.1, 0.01, 1e-3)),
    Mistake("one offset", _with_offset(np.ones((2, 1))), OFFSET),
    Mistake("an offset for each joint", _with_offset(np.eye(2)), OFFSET),
    Mistake(
        "columns scaled and not scaled back",
        _scaled,
        "You scale the columns of W before the fit. What must you then do with the solution?",
    ),
    Mistake(
        "total least squares",
        _total,
        "Your fit also allows errors in W. Here only the torques are noisy: which sum of squares "
        "must be as small as possible?",
    ),
    Mistake(
        "entries of the shortest π",
        _shortest_pi,
        "You solve for six parameters and return four of them. The six are not unique: of all "
        "that fit, lstsq gives the shortest. Which part of it do the torques really show?",
    ),
    Mistake("inertias first", _reordered(1, 0, 3, 2), ESTIMATE_ORDER),
    Mistake("by kind", _reordered(0, 2, 1, 3), ESTIMATE_ORDER),
    Mistake("inertias first, by kind", _reordered(1, 3, 0, 2), ESTIMATE_ORDER),
    Mistake("link 2 first", _reordered(2, 3, 0, 1), ESTIMATE_ORDER),
    Mistake(
        "sign",
        _fit(lambda Y, u: -_least_squares(Y, u)),
        "All four numbers have the wrong sign: your arm has negative masses. On which sides of the "
        "equation do Y π and u stand?",
    ),
    Mistake(
        "example arm",
        lambda q, qd, qdd, u, arm: base_parameters(EXAMPLE),
        "You return the numbers of the arm in the set-up cell, whatever was measured. What is "
        "known of this arm is in q, q̇, q̈ and u.",
    ),
)

# Fits that are right but for the regressor they stand on.
STANDS_ON = (
    "You fit by least squares, but with a wrong regressor. First make the card of part A green, "
    "or look at what you changed in it here."
)
FITTED = {
    "gravity missing": _parts(gravity=0.0),
    "sign of gravity": _parts(gravity=-1.0),
    "sine for cosine in gravity": _parts(weighed_at=lambda q1, q2: (q1 - np.pi / 2, q2)),
    "absolute second angle in gravity": _parts(weighed_at=lambda q1, q2: (q1, q2 - q1)),
    "coupling without the factor 2": _coupling_once,
    "velocity products left out": _parts(velocity=0.0),
    "no acceleration": _parts(acceleration=0.0),
    "sign of the velocity products": _parts(velocity=-1.0),
    "absolute acceleration of link 2": _absolute_acceleration,
    "l2 for l1": _with(l1="l2"),
    "9.81": _with(g=9.81),
    "example arm": _with(l1=EXAMPLE.l1, g=EXAMPLE.g),
}
IDENTIFY += tuple(
    Mistake(f"fit: {name}", _fit(_least_squares, Y), STANDS_ON) for name, Y in FITTED.items()
)


def _rank_with(Y=regressor, rows=slice(None)):
    """The numerical rank of a stacked regressor, of some of the samples or of the joints."""
    return lambda q, qd, qdd, arm: int(np.linalg.matrix_rank(stacked(Y(q, qd, qdd, arm)[rows])))


rank = _rank_with()  # the right answer


def _always(count):
    return lambda q, qd, qdd, arm: count


def _at_most(count):
    """The number of rows, but no more than this."""
    return lambda q, qd, qdd, arm: min(2 * len(q), count)


def _rank_and_rounding(q, qd, qdd, arm):
    """What is counted where every singular value above zero counts: the columns that are not zero
    leave one each, of the right size or of that of rounding; where all is at rest two are exact
    multiples of each other more often than not."""
    moving = np.any(qd) or np.any(qdd)
    return min(2 * len(q), 5 if moving else 4)


def _columns_that_move(q, qd, qdd, arm):
    return int(np.sum(np.any(stacked(regressor(q, qd, qdd, arm)), axis=0)))


ROUNDING_COUNTS = (
    "You count singular values that are only rounding. Print them all, divided by the largest: "
    "there is a wide gap, and only those above it are real."
)
ONE_STATE = (
    "Your number is never above 2: it is the rank of a matrix with one row for each joint. Put the "
    "rows of all samples under each other first."
)
COUNTED = (
    "You count the parameters, not what a motion shows of them: your number is the same for every "
    "motion. What does an arm at rest tell you?"
)

RANK = (
    Mistake("number of columns", _always(6), COUNTED),
    Mistake("five", _always(5), COUNTED),
    Mistake("four", _always(4), COUNTED),
    Mistake(
        "smaller of rows and columns",
        _at_most(6),
        "You return the number of rows or of columns, whichever is smaller. W could have that "
        "rank, but do its columns depend on each other?",
    ),
    Mistake(
        "rows, but at most four",
        _at_most(4),
        "You take every motion with enough samples for a rich one. Which columns of W vanish when "
        "the arm stands still, and which are multiples of each other?",
    ),
    Mistake("tolerance zero", _rank_and_rounding, ROUNDING_COUNTS),
    Mistake(
        "columns that are not zero",
        _columns_that_move,
        "You count the columns that are not zero. Can you make one of them from the others?",
    ),
    # Also that of the sum of the samples, and of all of them side by side: two rows, one rank.
    Mistake("first sample", _rank_with(rows=slice(0, 1)), ONE_STATE),
    Mistake(
        "joint 1 only",
        _rank_with(rows=(slice(None), 0)),
        "You count only what joint 1 shows. Does the torque of joint 2 show anything more?",
    ),
    Mistake(
        "joint 2 only",
        _rank_with(rows=(slice(None), 1)),
        "You count only what joint 2 shows. What can joint 2 feel of link 1?",
    ),
    Mistake(
        "number of samples",
        lambda q, qd, qdd, arm: len(q),
        "You return the number of samples. If the same sample comes ten times, do you know ten "
        "times as much?",
    ),
    Mistake(
        "number of rows",
        lambda q, qd, qdd, arm: 2 * len(q),
        "You count every equation, two for each sample. Does a sample that repeats another tell "
        "you anything new?",
    ),
    Mistake(
        "gravity ignored",
        _rank_with(_parts(gravity=0.0)),
        "You count what a motion would show without gravity. Which g does arm have?",
    ),
    Mistake(
        "9.81",
        _rank_with(_with(g=9.81)),
        "You count what a motion would show on Earth. The check also takes the arm into orbit, "
        "where g is 0: which parameter of arm gives g?",
    ),
    Mistake(
        "no acceleration",
        _rank_with(_parts(acceleration=0.0)),
        "Your regressor does not see the accelerations here. Which arguments do you pass to it?",
    ),
    Mistake(
        "what is missing",
        lambda q, qd, qdd, arm: 6 - rank(q, qd, qdd, arm),
        "You return how many columns are lost: 6 minus the rank. How many does the motion show?",
    ),
)
