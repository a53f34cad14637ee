"""Mistakes about fitting with the regressor."""

import numpy as np

from autograder.judging.diagnosis import Mistake
from autograder.problems.c6_regressor.mistakes import EXAMPLE
from autograder.problems.c6_regressor.regressors import (
    absolute_acceleration,
    coupling_once,
    parts,
    stacked,
    with_,
)
from autograder.problems.material.planar_2r import BASE_COLUMNS, base_parameters, regressor


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
    "gravity missing": parts(gravity=0.0),
    "sign of gravity": parts(gravity=-1.0),
    "sine for cosine in gravity": parts(weighed_at=lambda q1, q2: (q1 - np.pi / 2, q2)),
    "absolute second angle in gravity": parts(weighed_at=lambda q1, q2: (q1, q2 - q1)),
    "coupling without the factor 2": coupling_once,
    "velocity products left out": parts(velocity=0.0),
    "no acceleration": parts(acceleration=0.0),
    "sign of the velocity products": parts(velocity=-1.0),
    "absolute acceleration of link 2": absolute_acceleration,
    "l2 for l1": with_(l1="l2"),
    "9.81": with_(g=9.81),
    "example arm": with_(l1=EXAMPLE.l1, g=EXAMPLE.g),
}
IDENTIFY += tuple(
    Mistake(f"fit: {name}", _fit(_least_squares, Y), STANDS_ON) for name, Y in FITTED.items()
)
