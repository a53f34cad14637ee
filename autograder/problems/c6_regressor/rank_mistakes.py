"""Mistakes about counting what a motion shows."""

import numpy as np

from autograder.judging.diagnosis import Mistake
from autograder.problems.c6_regressor.regressors import parts, stacked, with_
from autograder.problems.material.planar_2r import regressor


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
        _rank_with(parts(gravity=0.0)),
        "You count what a motion would show without gravity. Which g does arm have?",
    ),
    Mistake(
        "9.81",
        _rank_with(with_(g=9.81)),
        "You count what a motion would show on Earth. The check also takes the arm into orbit, "
        "where g is 0: which parameter of arm gives g?",
    ),
    Mistake(
        "no acceleration",
        _rank_with(parts(acceleration=0.0)),
        "Your regressor does not see the accelerations here. Which arguments do you pass to it?",
    ),
    Mistake(
        "what is missing",
        lambda q, qd, qdd, arm: 6 - rank(q, qd, qdd, arm),
        "You return how many columns are lost: 6 minus the rank. How many does the motion show?",
    ),
)
