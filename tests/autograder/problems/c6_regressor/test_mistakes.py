"""Every mistake of challenge 6, as a student would type it: its exact sentence, credit and witness.

The table is typed out on purpose: a mistake's wording is read by students, and changes only with
intent.
"""

import numpy as np
import pytest

from autograder.judging.criterion import TOLERANCE
from autograder.judging.diagnosis import Known, mistakes_shown
from autograder.judging.check import VISIBLE_CASES
from autograder.problems import CHECKS
from autograder.judging.verdict import State
from tests.autograder.verdicts import assert_named, assert_told_apart, judged

REGRESSOR = """
l1, g = arm.l1, arm.g
(q1, q2), (v1, v2), (a1, a2) = q, qd, qdd
c1, c2, s2, c12 = np.cos(q1), np.cos(q2), np.sin(q2), np.cos(q1 + q2)
m1, mc1, J1, m2, mc2, J2 = np.zeros((6, 2))
mc1[0] = g * c1
J1[0] = a1
m2[0] = l1**2 * a1 + l1 * mc1[0]
mc2[0] = l1 * c2 * (2 * a1 + a2) - l1 * s2 * (2 * v1 * v2 + v2**2) + g * c12
mc2[1] = l1 * c2 * a1 + l1 * s2 * v1**2 + g * c12
J2[:] = a1 + a2
Y = np.array([m1, mc1, J1, m2, mc2, J2]).T
return Y
"""


def but(body, *changes):
    """The body with texts replaced in turn: old, new, old, new."""
    for old, new in zip(changes[::2], changes[1::2], strict=True):
        assert old in body
        body = body.replace(old, new)
    return body


def Y(*changes):
    return but(REGRESSOR, *changes)


def using(body, regressor=REGRESSOR):
    """A body that calls regressor(q, qd, qdd, arm), which is defined in its first lines."""
    lines = "".join(f"    {line}\n" for line in regressor.strip().splitlines())
    return f"def regressor(q, qd, qdd, arm):\n{lines}{body.strip()}"


ROWS = "Y = np.array([regressor(*s, arm) for s in zip(q, qd, qdd)])\n"
FIT = f"""{ROWS}W, t = Y[:, :, [1, 2, 4, 5]].reshape(-1, 4), u.ravel()
b = np.linalg.lstsq(W, t)[0]
return b
"""
COUNT = f"""{ROWS}W = Y.reshape(-1, 6)
return np.linalg.matrix_rank(W)
"""


def fit(*changes, regressor=REGRESSOR):
    return using(but(FIT, *changes), regressor)


def count(*changes, regressor=REGRESSOR):
    return using(but(COUNT, *changes), regressor)


NO_GRAVITY = (
    "Gravity is missing from your Y. Y π is the whole left side M q̈ + C q̇ + g: which columns does "
    "the weight of a link enter?"
)
REVERSED = (
    "Gravity has the wrong sign in your Y. On which side of the equation does g(q) stand, and which "
    "way must the motors push to hold the arm out to the right?"
)
NO_WEIGHT_OF_M2 = (
    "In your column of m2 the weight is missing. The elbow carries m2: who holds it up?"
)
NO_GRAVITY_OF_LINK_2 = (
    "In your column of m2 ℓc2 gravity is missing. Where in g(q) does the product m2 ℓc2 stand?"
)
NO_FACTOR_2 = (
    "In your column of m2 ℓc2, q̈1 counts too little at joint 1. Look at the coupling term of M11 "
    "and of M12: are they the same?"
)
CENTRIFUGAL = (
    "A product of velocities has the wrong sign in your column of m2 ℓc2. Compare with C q̇: which "
    "joint gets h and which gets −h, and which sign has h itself?"
)
SPIN = "In your column of J2, link 2 turns with q̈2 only. What is its angular acceleration in space?"
ABOUT_COM = (
    "Your Y uses ℓc. It is one of the things to be found, and Y holds only what is known. About "
    "which point must the inertia in π be taken, so that ℓc² goes into it?"
)
ORDER = (
    "The columns are right, but they stand in another order than the parameters in π. Write the "
    "names of the six parameters above your columns."
)
LIST = "[m1, mc1, J1, m2, mc2, J2]).T"
EXAMPLE_ARM = (
    "This is the Y of the arm in the set-up cell, whatever arm is given. Where does your function "
    "read ℓ1 and g of its own argument?"
)
ONE_SAMPLE = (
    "Your estimate uses one sample only: two equations for four numbers. Stack all samples under "
    "each other, and solve once."
)
REGULARISED = (
    "Your estimate is pulled towards zero, by something added to the diagonal of WᵀW. This motion "
    "shows all four numbers: does the system need it?"
)
OFFSET = (
    "Your fit has an offset as a further unknown. It is zero without noise, but with noise it takes "
    "a part of the torque. Is there a constant torque in the equation of motion?"
)
STACKING = (
    "The rows of your W and the entries of your torque vector are in different orders: one goes "
    "sample by sample, the other joint by joint. Look at the first three of each."
)
ESTIMATE_ORDER = (
    "These are the right four numbers in another order. In which order does the docstring ask for "
    "them?"
)
STANDS_ON = (
    "Your fit is least squares, but the regressor that it uses is wrong: make the card of part A "
    "green, or look at what you changed in it here."
)
COUNTED = (
    "You count the parameters, not what a motion shows of them: your number is the same for every "
    "motion. What does an arm at rest tell?"
)
ROUNDING_COUNTS = (
    "You count singular values that are only rounding. Print them all, divided by the largest: there "
    "is a wide gap, and only those above it are real."
)
ONE_STATE = (
    "Your number is never above 2: it is the rank of a matrix with one row for each joint. Put the "
    "rows of all samples under each other first."
)
WEIGHTS = "w = 1 + np.arange(len(t)) % 2\nb ="
EXAMPLE_L1 = ("arm.l1, arm.g", "0.45, 9.81")
ALL_V = "- l1 * s2 * (2 * v1 * v2 + v2**2)"

# What a student's function returns, the credit left, the sentence; by the mistake's name.
REGRESSOR_TABLE = {
    "gravity missing": (Y("arm.l1, arm.g", "arm.l1, 0"), 0.2, NO_GRAVITY),
    "sign of gravity": (Y("arm.l1, arm.g", "arm.l1, -arm.g"), 0.2, REVERSED),
    "gravity missing in the column of m2": (Y(" + l1 * mc1[0]", ""), 0.8, NO_WEIGHT_OF_M2),
    "gravity missing in the column of m2 lc2": (
        Y(" + g * c12", ""),
        0.55,
        NO_GRAVITY_OF_LINK_2,
    ),
    "gravity of m2 lc2 missing at joint 1": (
        Y("v2**2) + g * c12", "v2**2)"),
        0.75,
        "In your column of m2 ℓc2 gravity is missing at joint 1. Does the direction of link 2 change "
        "when joint 1 turns?",
    ),
    "sine for cosine in gravity": (
        Y(
            "c1, c2, s2, c12 = np.cos(q1)",
            "c1, c2, s2, c12 = np.sin(q1)",
            "np.cos(q1 +",
            "np.sin(q1 +",
        ),
        0.2,
        "Gravity varies with the sine in your Y, as if the angles were measured from the vertical. "
        "From which axis is q1 measured, and at which q1 does the weight of link 1 pull most?",
    ),
    "absolute second angle in gravity": (
        Y("np.cos(q1 + q2)", "np.cos(q2)"),
        0.55,
        "In the gravity of link 2 you take q2 for its direction in space. From what is q2 measured?",
    ),
    "coupling without the factor 2": (Y("(2 * a1 + a2)", "(a1 + a2)"), 0.75, NO_FACTOR_2),
    "sine for cosine in the coupling": (
        Y("l1 * c2", "l1 * s2"),
        0.55,
        "The accelerations in your column of m2 ℓc2 come with the sine of q2. Which function of q2 "
        "stands in M, and is it largest with the arm stretched?",
    ),
    "cos q1 in the coupling": (
        Y("l1 * c2", "l1 * c1"),
        0.55,
        "The accelerations in your column of m2 ℓc2 come with the cosine of q1. Would the inertia of "
        "the arm change if the whole arm turned about the shoulder?",
    ),
    "velocity products left out": (
        Y(ALL_V, "", "+ l1 * s2 * v1**2", ""),
        0.55,
        "Your Y does not depend on the velocities. Where does C(q, q̇) q̇ enter, and with which "
        "product of parameters?",
    ),
    "velocity products left out at joint 2": (
        Y("+ l1 * s2 * v1**2", ""),
        0.8,
        "The row of joint 2 has no product of velocities in your Y. What does link 2 feel at the "
        "elbow when only joint 1 turns?",
    ),
    "Coriolis without the factor 2": (
        Y("2 * v1 * v2", "v1 * v2"),
        0.75,
        "The product q̇1 q̇2 counts half in your column of m2 ℓc2. How many entries of C contribute it "
        "to C q̇?",
    ),
    "centrifugal part missing at joint 1": (
        Y(" + v2**2", ""),
        0.75,
        "The square of q̇2 is missing at joint 1 in your column of m2 ℓc2. Multiply C by q̇ once more, "
        "entry by entry.",
    ),
    "sign of the velocity products": (
        Y("- l1 * s2", "+ l1 * s2", "c2 * a1 + l1", "c2 * a1 - l1"),
        0.55,
        CENTRIFUGAL,
    ),
    "sign of the velocity products at joint 1": (Y("- l1 * s2", "+ l1 * s2"), 0.75, CENTRIFUGAL),
    "sign of the velocity products at joint 2": (
        Y("c2 * a1 + l1", "c2 * a1 - l1"),
        0.8,
        CENTRIFUGAL,
    ),
    "C times ones": (
        Y("(2 * v1 * v2 + v2**2)", "(v1 + 2 * v2)", "v1**2", "v1"),
        0.55,
        "Your velocities stand alone, not in products: you have added up the rows of C. By which "
        "vector must C be multiplied?",
    ),
    "no acceleration": (
        Y("(a1, a2) = q, qd, qdd", "(a1, a2) = q, qd, 0 * qdd"),
        0.15,
        "Your Y does not depend on the accelerations. It is the whole left side M q̈ + C q̇ + g.",
    ),
    "absolute acceleration of link 2": (Y("J2[:] = a1 + a2", "J2[:] = a2"), 0.8, SPIN),
    "absolute acceleration of link 2 at joint 2": (
        Y("J2[:] = a1 + a2", "J2[:] = a1 + a2, a2"),
        0.8,
        "In your column of J2, joint 2 does not feel q̈1. Is J2 in M12?",
    ),
    "J2 left out at joint 1": (
        Y("J2[:] = a1", "J2[1] = a1"),
        0.8,
        "In your column of J2 the row of joint 1 is empty. Must joint 1 not turn link 2 as well?",
    ),
    "J1 at joint 2": (
        Y("J1[0] = a1", "J1[:] = a1"),
        0.8,
        "In your column of J1 joint 2 has a torque. Which joints does link 1 load: those before it or "
        "those behind it?",
    ),
    "l1 not squared": (
        Y("l1**2 * a1", "l1 * a1"),
        0.8,
        "In your column of m2, look at the units: what must m2 be multiplied with to be an inertia?",
    ),
    "inertia of m2 at the elbow missing": (
        Y("l1**2 * a1 + ", ""),
        0.8,
        "In your column of m2 only its weight is left. Joint 1 also accelerates the elbow: what "
        "inertia has a mass m2 there?",
    ),
    "column of m2 missing": (
        Y("m2[0] = l1**2 * a1 + l1 * mc1[0]", "m2[0] = 0"),
        0.8,
        "Your column of m2 is empty. Put all of m2 into the elbow, so that ℓc2 = 0: does joint 1 "
        "feel it?",
    ),
    "inertia about the centre of mass": (
        Y("Y = np", "m1[0] = arm.lc1**2 * a1\nm2 += arm.lc2**2 * (a1 + a2)\nY = np"),
        0.8,
        ABOUT_COM,
    ),
    "inertia about the centre of mass, in the column of m lc": (
        Y("Y = np", "mc1[0] += arm.lc1 * a1\nmc2 += arm.lc2 * (a1 + a2)\nY = np"),
        0.4,
        ABOUT_COM,
    ),
    "weight of link 1 in the column of m1": (
        Y("Y = np", "m1[0], mc1[0] = arm.lc1 * g * c1, 0\nY = np"),
        0.65,
        "You put the weight of link 1 into the column of m1, with ℓc1 in Y. ℓc1 is one of the things "
        "to be found: which entry of π has it already?",
    ),
    "parameters in Y": (
        Y(
            "return Y",
            "M1, M2, L1, L2 = arm.m1, arm.m2, arm.lc1, arm.lc2\n"
            "return Y * [M1, M1*L1, arm.I1 + M1*L1**2, M2, M2*L2, arm.I2 + M2*L2**2]",
        ),
        0,
        "Your columns add up to the torque: each still carries its own parameter. What is left of a "
        "column when π is taken out of it?",
    ),
    "all reversed": (
        Y("return Y", "return -Y"),
        0,
        "Every entry of your Y has the wrong sign. On which side of the equation of motion do the "
        "torques u stand?",
    ),
    "by kind": (Y(LIST, "[m1, m2, mc1, mc2, J1, J2]).T"), 0, ORDER),
    "each link reversed": (Y(LIST, "[J1, mc1, m1, J2, mc2, m2]).T"), 0.6, ORDER),
    "inertia first": (Y(LIST, "[J1, m1, mc1, J2, m2, mc2]).T"), 0, ORDER),
    "inertia before first moment": (Y(LIST, "[m1, J1, mc1, m2, J2, mc2]).T"), 0.2, ORDER),
    "first moment first": (Y(LIST, "[mc1, m1, J1, mc2, m2, J2]).T"), 0.2, ORDER),
    "link 2 first": (Y(LIST, "[m2, mc2, J2, m1, mc1, J1]).T"), 0, ORDER),
    "rows swapped": (
        Y("return Y", "return Y[::-1]"),
        0,
        "The rows of the two joints have changed places.",
    ),
    "reshaped for transposed": (
        Y(LIST, "[m1, mc1, J1, m2, mc2, J2]).reshape(2, 6)"),
        0,
        "Reshaping an array is not transposing it: the shape fits, but the entries are in other "
        "places.",
    ),
    "l2 for l1": (
        Y("arm.l1", "arm.l2"),
        0.35,
        "You use ℓ2 where link 2 begins. Which length leads from the shoulder to the elbow?",
    ),
    "lc1 for l1": (
        Y("arm.l1", "arm.lc1"),
        0.35,
        "You let link 2 begin at the centre of mass of link 1. Where on link 1 is the elbow?",
    ),
    "g missing": (
        Y("arm.l1, arm.g", "arm.l1, 1"),
        0.2,
        "The gravitational acceleration g is missing from your Y. It is known, so it belongs there.",
    ),
    "9.81": (
        Y("arm.l1, arm.g", "arm.l1, 9.81"),
        0.2,
        "Your Y is right on Earth only: 9.81 is written into it. The check also puts the arm on other "
        "planets; which parameter of arm gives g?",
    ),
    "example arm": (Y(*EXAMPLE_L1), 0.2, EXAMPLE_ARM),
    "radians taken for degrees": (
        Y("= q, qd, qdd", "= np.radians(q), qd, qdd"),
        0.2,
        "The angles are turned from degrees to radians once too often: q comes in radians already.",
    ),
    "angles in degrees": (
        Y("= q, qd, qdd", "= np.degrees(q), qd, qdd"),
        0.2,
        "NumPy takes angles in radians, and q is in radians already: nothing is to be converted.",
    ),
}
ALONE = "np.array([np.linalg.pinv(y[:, [1, 2, 4, 5]]) @ t for y, t in zip(Y, u)]).mean(0)"
RIDGE = "b = np.linalg.inv(W.T @ W + {} * np.eye(4)) @ W.T @ t\n"
SOLVE = "b = np.linalg.lstsq(W, t)[0]\n"
IDENTIFY_TABLE = {
    "joint 1 only": (
        fit("lstsq(W, t)", "lstsq(W[::2], t[::2])"),
        0.6,
        "Your fit uses the torques of joint 1 only. Without noise they suffice; with noise, what do "
        "the equations of joint 2 still tell?",
    ),
    "joint 2 only": (
        fit("lstsq(W, t)", "lstsq(W[1::2], t[1::2])"),
        0,
        "Your fit uses the torques of joint 2 only. Which of the four numbers can that joint feel?",
    ),
    "joint after joint": (
        fit(
            SOLVE,
            "two = np.linalg.lstsq(W[1::2, 2:], t[1::2])[0]\n"
            "one = np.linalg.lstsq(W[::2, :2], t[::2] - W[::2, 2:] @ two)[0]\n"
            "b = [*one, *two]\n",
        ),
        0.6,
        "You fit link 2 to the torques of joint 2 and then the rest to those of joint 1. Without "
        "noise that suffices; with noise, what does joint 1 tell about link 2?",
    ),
    "mean of both joints": (
        fit(
            SOLVE, "b = (np.linalg.pinv(W[::2]) @ t[::2] + np.linalg.pinv(W[1::2]) @ t[1::2]) / 2\n"
        ),
        0,
        "You fit each joint by itself and take the mean. Can joint 2 tell all four numbers? Put the "
        "rows of both joints into one system.",
    ),
    "first sample": (fit("lstsq(W, t)", "lstsq(W[:2], t[:2])"), 0, ONE_SAMPLE),
    "last sample": (fit("lstsq(W, t)", "lstsq(W[-2:], t[-2:])"), 0, ONE_SAMPLE),
    "last sample forgotten": (
        fit("lstsq(W, t)", "lstsq(W[:-2], t[:-2])"),
        0.6,
        "The last sample is left out of your fit. Where does your loop end?",
    ),
    "first sample forgotten": (
        fit("lstsq(W, t)", "lstsq(W[2:], t[2:])"),
        0.6,
        "The first sample is left out of your fit. At which index does an array begin?",
    ),
    "mean of the samples' own solutions": (
        fit("return b", f"return {ALONE}"),
        0,
        "You solve each sample by itself and take the mean. Each has two equations for four numbers, "
        "so none of them has one solution. Stack the samples first, then solve.",
    ),
    "torques joint by joint": (fit("u.ravel()", "u.ravel(order='F')"), 0, STACKING),
    "rows joint by joint": (fit("(-1, 4)", "(-1, 4, order='F')"), 0, STACKING),
    "ridge 1": (fit(SOLVE, RIDGE.format(1)), 0, REGULARISED),
    "ridge 0.1": (fit(SOLVE, RIDGE.format(0.1)), 0, REGULARISED),
    "ridge 0.01": (fit(SOLVE, RIDGE.format(0.01)), 0, REGULARISED),
    "ridge 0.001": (fit(SOLVE, RIDGE.format(1e-3)), 0, REGULARISED),
    "one offset": (
        fit("lstsq(W, t)[0]", "lstsq(np.column_stack([W, np.ones(len(t))]), t)[0][:4]"),
        0.6,
        OFFSET,
    ),
    "an offset for each joint": (
        fit("lstsq(W, t)[0]", "lstsq(np.hstack([W, np.tile(np.eye(2), (len(u), 1))]), t)[0][:4]"),
        0.6,
        OFFSET,
    ),
    "columns scaled and not scaled back": (
        fit("lstsq(W, t)", "lstsq(W / np.sqrt(np.sum(W**2, axis=0)), t)"),
        0,
        "You scale the columns of W before the fit. What must then be done with the solution?",
    ),
    "total least squares": (
        fit(SOLVE, "v = np.linalg.svd(np.c_[W, t])[2][-1]\nb = -v[:4] / v[4]\n"),
        0.6,
        "Your fit also allows errors in W. Here only the torques are noisy: which sum of squares is "
        "to be as small as possible?",
    ),
    "entries of the shortest π": (
        fit(SOLVE, "b = np.linalg.lstsq(Y.reshape(-1, 6), t)[0][[1, 2, 4, 5]]\n"),
        0,
        "You solve for six parameters and then give four of them. The six are not unique: of all that "
        "fit, lstsq gives the shortest. What of it do the torques really show?",
    ),
    "inertias first": (fit("[1, 2, 4, 5]", "[2, 1, 5, 4]"), 0, ESTIMATE_ORDER),
    "by kind": (fit("[1, 2, 4, 5]", "[1, 4, 2, 5]"), 0, ESTIMATE_ORDER),
    "inertias first, by kind": (fit("[1, 2, 4, 5]", "[2, 5, 1, 4]"), 0, ESTIMATE_ORDER),
    "link 2 first": (fit("[1, 2, 4, 5]", "[4, 5, 1, 2]"), 0, ESTIMATE_ORDER),
    "sign": (
        fit("return b", "return -b"),
        0,
        "All four numbers have the wrong sign: your arm has negative masses. On which sides of the "
        "equation do Y π and u stand?",
    ),
    "example arm": (
        "return 4.2 * 0.21 + 2.6 * 0.45, 0.075 + 4.2 * 0.21**2 + 2.6 * 0.45**2, 2.6 * 0.17, "
        "0.034 + 2.6 * 0.17**2",
        0,
        "These are the numbers of the arm in the set-up cell, whatever was measured. What is known of "
        "this arm stands in q, q̇, q̈ and u.",
    ),
}
IDENTIFY_TABLE |= {
    f"fit: {name}": (fit(regressor=REGRESSOR_TABLE[name][0]), 0, STANDS_ON)
    for name in (
        "gravity missing",
        "sign of gravity",
        "sine for cosine in gravity",
        "absolute second angle in gravity",
        "coupling without the factor 2",
        "velocity products left out",
        "sign of the velocity products",
        "no acceleration",
        "absolute acceleration of link 2",
        "l2 for l1",
        "9.81",
        "example arm",
    )
}
RANK_TABLE = {
    "number of columns": (count("np.linalg.matrix_rank(W)", "W.shape[1]"), 0, COUNTED),
    "five": ("5", 0, COUNTED),
    "four": ("4", 0, COUNTED),
    "smaller of rows and columns": (
        count("np.linalg.matrix_rank(W)", "min(W.shape)"),
        0,
        "This is the smaller number of the rows and the columns: the rank that W could have. Do the "
        "columns depend on each other?",
    ),
    "rows, but at most four": (
        "min(2 * len(q), 4)",
        0,
        "You take every motion with enough samples for a rich one. Which columns of W vanish, or are "
        "multiples of each other, when the arm stands still?",
    ),
    # Written down, as what rounding leaves differs from one machine to the other; see below.
    "tolerance zero": ("min(2 * len(q), 5 if qd.any() else 4)", 0, ROUNDING_COUNTS),
    "columns that are not zero": (
        count("np.linalg.matrix_rank(W)", "np.count_nonzero(np.abs(W).max(axis=0))"),
        0,
        "You count the columns that are not zero. Can a column be made of the others?",
    ),
    "first sample": (count("matrix_rank(W)", "matrix_rank(Y[0])"), 0, ONE_STATE),
    "sum of the samples": (count("matrix_rank(W)", "matrix_rank(sum(Y))"), 0, ONE_STATE),
    "side by side": (count("matrix_rank(W)", "matrix_rank(np.hstack(Y))"), 0, ONE_STATE),
    "joint 1 only": (
        count("(W)", "(Y[:, 0])"),
        0.35,
        "You count what joint 1 shows. Does the torque of joint 2 show something more?",
    ),
    "joint 2 only": (
        count("(W)", "(Y[:, 1])"),
        0,
        "You count what joint 2 shows. What of link 1 can joint 2 feel?",
    ),
    "number of samples": (
        "len(q)",
        0,
        "This is the number of samples. Ten times the same sample: is that ten times as much known?",
    ),
    "number of rows": (
        count("np.linalg.matrix_rank(W)", "sum(map(np.linalg.matrix_rank, Y))"),
        0,
        "You count every equation, two for each sample. Does a sample that repeats another tell "
        "anything new?",
    ),
    "gravity ignored": (
        count(regressor=REGRESSOR_TABLE["gravity missing"][0]),
        0,
        "You count what would be seen without gravity. Which g does arm have?",
    ),
    "9.81": (
        count(regressor=REGRESSOR_TABLE["9.81"][0]),
        0.65,
        "You count what would be seen on Earth. The check also takes the arm into orbit, where g is "
        "0: which parameter of arm gives g?",
    ),
    "no acceleration": (
        count("qdd)]", "0 * qdd)]"),
        0,
        "Your regressor does not see the accelerations here. Which arguments reach it?",
    ),
    "what is missing": (
        count("np.linalg.matrix_rank(W)", "6 - np.linalg.matrix_rank(W)"),
        0,
        "This is how many columns are lost: 6 less the rank. How many are shown?",
    ),
}
TABLES = {
    "c6-regressor": REGRESSOR_TABLE,
    "c6-identify": IDENTIFY_TABLE,
    "c6-rank_of_excitation": RANK_TABLE,
}


@pytest.mark.parametrize(
    ("check_id", "name"), [(check_id, name) for check_id, table in TABLES.items() for name in table]
)
def test_sentence_credit_and_witness(check_id, name):
    assert_named(check_id, *TABLES[check_id][name])


@pytest.mark.parametrize("check_id", TABLES)
def test_every_mistake_has_its_row(check_id):
    rows = {name: sentence for name, (_, _, sentence) in TABLES[check_id].items()}
    assert rows == {mistake.name: mistake.sentence for mistake in CHECKS[check_id].mistakes}


@pytest.mark.parametrize(
    ("body", "credit", "sentences"),
    [
        (
            Y("(2 * a1 + a2)", "(a1 + a2)", " + l1 * mc1[0]", ""),
            0.55,
            [NO_WEIGHT_OF_M2, NO_FACTOR_2],
        ),
        (
            Y("J2[:] = a1 + a2", "J2[:] = a2", "c2 * a1 + l1", "c2 * a1 - l1"),
            0.6,
            [SPIN, CENTRIFUGAL],
        ),
        (
            Y("(2 * a1 + a2)", "(a1 + a2)", "- l1 * s2", "+ l1 * s2"),
            0.75,
            [NO_FACTOR_2, CENTRIFUGAL],
        ),
        (
            Y("arm.l1, arm.g", "arm.l1, 0", "c2 * a1 + l1", "c2 * a1 - l1"),
            0.2,
            [NO_WEIGHT_OF_M2, NO_GRAVITY, NO_GRAVITY_OF_LINK_2, CENTRIFUGAL],
        ),
    ],
)
def test_two_mistakes_at_once_are_told_apart(body, credit, sentences):
    verdict = judged("c6-regressor", body)
    assert sorted(verdict.diagnosis) == sorted(sentences)
    assert verdict.credit == pytest.approx(credit)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        (
            ("mc2[1] = l1 * c2 * a1", "mc2[1] = 1.2 * l1 * c2 * a1"),
            "The error in your column of m2 ℓc2, joint 2 varies like its part of accelerations "
            "(+0.2 times it).",
        ),
        (
            ("mc1[0] = g * c1", "mc1[0] = 0.7 * g * c1", "l1 * mc1[0]", "l1 * g * c1"),
            "The error in your column of m1 ℓc1 varies like its part of gravity (-0.3 times it).",
        ),
        (
            (ALL_V, f"- 2.5{ALL_V[1:].replace('l1', '* l1', 1)}"),
            "The error in your column of m2 ℓc2, joint 1 varies like its part of velocities "
            "(+1.5 times it).",
        ),
    ],
)
def test_an_unknown_error_is_traced_to_its_term(changes, said):
    assert judged("c6-regressor", Y(*changes)).diagnosis == (said,)


@pytest.mark.parametrize(
    ("check_id", "body"),
    [
        ("c6-regressor", Y("return Y", "return Y + np.cos(np.arange(12)).reshape(2, 6)")),
        ("c6-identify", fit("return b", "return b + 0.1")),
        ("c6-rank_of_excitation", "1.5 * len(q)"),
    ],
)
def test_an_error_of_no_known_kind_is_not_explained(check_id, body):
    verdict = judged(check_id, body)
    known = {mistake.sentence for mistake in CHECKS[check_id].mistakes}
    assert verdict.state is State.INCORRECT
    assert not known & set(verdict.diagnosis)
    assert verdict.witness is not None


def test_singular_values_of_rounding_are_called_so():
    for seed in range(5):
        body = count("np.linalg.matrix_rank(W)", "np.sum(np.linalg.svd(W)[1] > 0)")
        said = judged("c6-rank_of_excitation", body, seed, VISIBLE_CASES).diagnosis
        assert ROUNDING_COUNTS in said or any("singular values" in sentence for sentence in said)


def test_a_weighted_fit_is_told_what_least_squares_means():
    verdict = judged(
        "c6-identify", fit("lstsq(W, t)", "lstsq(W * w[:, None], w * t)", "b =", WEIGHTS)
    )
    assert verdict.credit == pytest.approx(0.6)
    assert verdict.diagnosis == (
        "With noise, your estimate is not the one of least squares: the sum of the squares of all 2K "
        "residuals can still be made smaller.",
    )


def test_a_mistake_is_named_only_where_it_matches_to_rounding():
    for check_id, name, result in (
        ("c6-regressor", "sine for cosine in gravity", "return Y"),
        ("c6-identify", "joint 2 only", "return b"),
    ):
        body, _, sentence = TABLES[check_id][name]
        close = but(body, result, f"{result} * {1 + 20 * TOLERANCE}")
        single = but(body, result, f"return np.float32({result.removeprefix('return ')})")
        assert judged(check_id, single).diagnosis == (sentence,)
        assert sentence not in judged(check_id, close).diagnosis


def test_a_doubled_error_is_not_two_mistakes():
    """Two orders of the columns leave a column empty; taken twice, that would make it −1 times it."""
    right = [np.array([2.0]), np.array([3.0])]
    empty = [np.zeros(1), np.zeros(1)]
    known = [Known(mistake, empty) for mistake in CHECKS["c6-regressor"].mistakes[:2]]
    assert mistakes_shown(right, [-value for value in right], known) == ()


@pytest.mark.parametrize(
    ("check_id", "body", "said"),
    [
        (
            "c6-regressor",
            Y(LIST, "[m1, mc1, J1, m2, mc2, J2])"),
            "shape (6, 2); one row for each joint is asked for, (2, 6).",
        ),
        (
            "c6-regressor",
            Y(LIST, "[mc1, J1, mc2, J2]).T"),
            "shape (2, 4); one row for each joint and one column for each of the six parameters is",
        ),
        (
            "c6-identify",
            fit("[1, 2, 4, 5]", "[0, 1, 2, 3, 4, 5]", "(-1, 4)", "(-1, 6)"),
            "6 numbers; the four base parameters are asked for, since no motion shows all six of π.",
        ),
        ("c6-identify", "return arm.m1, 0, 0, 0", "has no attribute 'm1'"),
        ("c6-rank_of_excitation", count("matrix_rank(W)", "svd(W)[1]"), "one number is asked for."),
    ],
)
def test_what_is_no_answer_is_an_error(check_id, body, said):
    verdict = judged(check_id, body)
    assert verdict.state is State.ERROR
    assert said in verdict.problem


@pytest.mark.parametrize("check_id", TABLES)
def test_no_wrong_model_looks_like_another(check_id):
    for seed in range(2):
        assert_told_apart(CHECKS[check_id], seed)
