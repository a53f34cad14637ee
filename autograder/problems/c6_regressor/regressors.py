"""The regressor with something changed, and that of all samples."""

import numpy as np

from autograder.problems.material.planar_2r import changed, regressor

M1, MC1, J1, M2, MC2, J2 = range(6)


def with_(**of):
    """The right Y of an arm, of which some parameters are others of it (by name) or numbers."""
    return lambda q, qd, qdd, arm: regressor(
        q,
        qd,
        qdd,
        changed(arm, **{k: getattr(arm, v) if isinstance(v, str) else v for k, v in of.items()}),
    )


def parts(gravity=1.0, velocity=1.0, acceleration=1.0, weighed_at=lambda q1, q2: (q1, q2)):
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


def plus(entries):
    """The right Y with something added: entries gives it by (row, column)."""

    def wrong(q, qd, qdd, arm):
        Y = regressor(q, qd, qdd, arm)
        for (row, column), value in entries(State(q, qd, qdd), arm).items():
            Y[..., row, column] += value
        return Y

    return wrong


def columns(*order):
    """The right columns in another order."""
    return lambda q, qd, qdd, arm: regressor(q, qd, qdd, arm)[..., order]


def plus_column_of(column):
    """The right Y with what belongs in a column also in that of m1, which is empty."""

    def wrong(*state):
        Y = regressor(*state)
        Y[..., M1] = Y[..., column]
        return Y

    return wrong


class State:
    """The accelerations by name, and cosines, of one state or of many."""

    def __init__(self, q, qd, qdd):
        self.qdd1, self.spin_2 = qdd[..., 0], qdd[..., 0] + qdd[..., 1]
        self.c1, self.c2 = np.cos(q[..., 0]), np.cos(q[..., 1])


absolute_acceleration = plus(lambda s, arm: {(0, J2): -s.qdd1, (1, J2): -s.qdd1})
coupling_once = plus(lambda s, arm: {(0, MC2): -arm.l1 * s.c2 * s.qdd1})


def stacked(Y) -> np.ndarray:
    """The rows of all samples, one under the other: (K, 2, p) as (2K, p)."""
    return np.reshape(Y, (-1, np.shape(Y)[-1]))
