"""Mistakes about the regressor."""

from types import SimpleNamespace

import numpy as np

from autograder.judging.claims import Claim
from autograder.judging.diagnosis import Mistake
from autograder.problems.c6_regressor.regressors import (
    J1,
    J2,
    M1,
    M2,
    MC1,
    MC2,
    absolute_acceleration,
    columns,
    coupling_once,
    plus,
    plus_column_of,
    with_,
)
from autograder.problems.material import sentences
from autograder.problems.material.planar_2r import regressor

# The arm of the notebook's set-up cell.
EXAMPLE = SimpleNamespace(
    l1=0.45, l2=0.38, lc1=0.21, lc2=0.17, m1=4.2, m2=2.6, I1=0.075, I2=0.034, g=9.81
)

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
    "wrong angle / the weight of link 2 beyond the elbow / q2 / q1 + q2 / in g_vec": sentences.Q2_ALONE,
    "halved / the coupling of the two links / M11 / in M": COUPLING_ONCE,
    "sine for cosine / the coupling of the two links / in M": sentences.COUPLING_WITH_SINE,
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

# This one also follows from the arm, but there what is halved is never one of two mistakes.
REGRESSOR = (
    Mistake("coupling without the factor 2", coupling_once, COUPLING_ONCE),
    Mistake(
        "absolute acceleration of link 2",
        absolute_acceleration,
        "In your column of J2, link 2 turns with q̈2 only. What is its angular acceleration in space?",
    ),
    Mistake(
        "absolute acceleration of link 2 at joint 2",
        plus(lambda s, arm: {(1, J2): -s.qdd1}),
        "In your column of J2, joint 2 does not feel q̈1. Is J2 in M12?",
    ),
    Mistake(
        "acceleration of joint 1 for link 2 at joint 1",
        plus(lambda s, arm: {(0, J2): s.qdd1 - s.spin_2}),
        "In your column of J2, joint 1 does not feel q̈2. Is J2 in M12?",
    ),
    Mistake(
        "acceleration of link 2 for link 1",
        plus(lambda s, arm: {(0, J1): s.spin_2 - s.qdd1}),
        "In your column of J1, joint 1 feels q̈2. Does link 1 turn faster as joint 2 does?",
    ),
    Mistake(
        "J1 at joint 2",
        plus(lambda s, arm: {(1, J1): s.qdd1}),
        "In your column of J1, joint 2 has a torque. Which joints does link 1 load: those before "
        "it or those after it?",
    ),
    Mistake(
        "inertia about the centre of mass",
        plus(
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
        plus(
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
        plus(lambda s, arm: {(0, M1): arm.lc1 * arm.g * s.c1, (0, MC1): -arm.g * s.c1}),
        "You put the weight of link 1 into the column of m1, with ℓc1 in Y. ℓc1 is one of the "
        "unknowns: which entry of π holds it already?",
        claim=Claim.WHOLE,
    ),
    Mistake("each link reversed", columns(J1, MC1, M1, J2, MC2, M2), ORDER, claim=Claim.WHOLE),
    Mistake("inertia first", columns(J1, M1, MC1, J2, M2, MC2), ORDER, claim=Claim.WHOLE),
    Mistake(
        "inertia before first moment", columns(M1, J1, MC1, M2, J2, MC2), ORDER, claim=Claim.WHOLE
    ),
    Mistake("first moment first", columns(MC1, M1, J1, MC2, M2, J2), ORDER, claim=Claim.WHOLE),
    Mistake("link 2 first", columns(M2, MC2, J2, M1, MC1, J1), ORDER, claim=Claim.WHOLE),
    *(
        Mistake(
            f"the column of {name} in that of m1",
            plus_column_of(column),
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
        with_(l1="lc1"),
        "You let link 2 begin at the centre of mass of link 1. Where on link 1 is the elbow?",
    ),
)
