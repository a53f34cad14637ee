"""The checks of lesson 04, Coriolis and skew-symmetry."""

import numpy as np

from autograder.judging.check import Check, Criterion
from autograder.judging.diagnosis import Mistake
from autograder.judging.terms import Term
from autograder.lesson_checks.arm import ARM
from autograder.lesson_checks.choice import Choice, Option
from autograder.lesson_checks.number import Number, WrongNumber
from autograder.protocol import Call

# By the numbers of the lesson's list: where a student shows each goal.
GOALS = {
    1: ("04-entry", "p2-C_other"),
    2: ("04-power", "p2-proof"),
    3: ("04-rate", "p2-proof"),
    4: ("04-upright",),
    5: ("04-needs",),
}

# C q̇ of a first row (5, 4) at q̇ = (2, −1), and what the row (0, x) must give.
ENTRY = Number(
    id="04-entry",
    text="the second entry of the other first row",
    unit="kg·m²/s",
    right=-6.0,
    wrong=(
        WrongNumber(
            "sign of the velocity",
            6.0,
            "The size is right. Which sign does the velocity have that multiplies your entry?",
        ),
        WrongNumber(
            "entry kept",
            4.0,
            "You kept the second entry. Then the row gives another product with the velocities, now "
            "that its first entry is gone.",
        ),
        WrongNumber(
            "sum of the row",
            9.0,
            "You kept the sum of the row: that is its product with a vector of ones. With which vector "
            "does the equation of motion multiply C?",
        ),
        WrongNumber(
            "speeds for velocities",
            14.0,
            "You took the size of the second velocity, without its sign. Compute the product of the "
            "first row again.",
        ),
        WrongNumber(
            "speed, then sign",
            -14.0,
            "You took the size of the second velocity in the one product, and its sign in the other.",
        ),
    ),
    otherwise=(
        "Your row gives another product with the velocities than the library's. Compute that product "
        "first."
    ),
    further="Each row has one such number to choose, so two joints have two: a and b of this section.",
    hints=(
        "What does the library's first row give when it is multiplied by the velocities?",
        "The new row must give the same. Its first entry is zero, so its second one does all the work.",
    ),
)


def _powers(rng, count):
    sizes = rng.integers(2, 5, size=count)
    return [Call("my_power", tuple(rng.uniform(-3, 3, size=(3, n)))) for n in sizes]


POWER = Check(
    id="04-power",
    signature="my_power(qd, u, f)",
    reference=lambda qd, u, f: qd @ (u - f),
    calls=_powers,
    criteria=(Criterion("rate of the energy", "W"),),
    terms=(
        Term("the power of the motors", lambda qd, u, f: qd @ u),
        Term("the power of friction", lambda qd, u, f: -qd @ f),
    ),
    mistakes=(
        Mistake(
            "friction added",
            lambda qd, u, f: qd @ (u + f),
            "Your friction brings energy into the arm. Does it brake the arm or drive it?",
        ),
        Mistake(
            "friction left out",
            lambda qd, u, f: qd @ u,
            "This is the power of the motors alone. What takes energy out of the arm?",
        ),
        Mistake(
            "sign of the whole",
            lambda qd, u, f: qd @ (f - u),
            "The sign is reversed: your energy falls where the motors push in the direction of motion.",
        ),
        Mistake(
            "halved",
            lambda qd, u, f: qd @ (u - f) / 2,
            "Your rate is half of the right one. The ½ of the kinetic energy is gone once it is "
            "differentiated: why?",
        ),
        Mistake(
            "torques alone",
            lambda qd, u, f: np.sum(u - f),
            "You added up torques. A torque gives power only where its joint turns: what is it "
            "multiplied by?",
        ),
        Mistake(
            "sizes",
            lambda qd, u, f: np.abs(qd) @ np.abs(u - f),
            "You took sizes without signs. What does a motor do that pushes against the motion?",
        ),
    ),
    hints=(
        "A torque on a joint that turns gives power, as a force on a body that moves does. What comes "
        "in, and what goes out?",
        "The energy changes by the power of the motors less the power that friction takes. Each is a "
        "product of the velocities with torques, summed over the joints: `@` does both.",
    ),
    further="M, C and g are not in it, so a power meter at the motors needs no model of the arm.",
)

SUBTRACTED = (
    "You subtracted the two entries. Which part of C is the rate of M made of, the symmetric or the "
    "skew-symmetric one?"
)
RATE = Number(
    id="04-rate",
    text="the rate of M12",
    unit="kg·m²/s",
    right=-3.0,
    wrong=(
        WrongNumber(
            "twice C12",
            4.0,
            "You took twice C12. The rate of M is symmetric and C is not: which other entry of C "
            "takes part?",
        ),
        WrongNumber(
            "twice C21",
            -10.0,
            "You took twice C21. The rate of M is symmetric and C is not: which other entry of C "
            "takes part?",
        ),
        WrongNumber(
            "difference",
            7.0,
            SUBTRACTED,
        ),
        WrongNumber(
            "difference the other way",
            -7.0,
            SUBTRACTED,
        ),
        WrongNumber(
            "mean",
            -1.5,
            "You took the mean. The symmetric part of a matrix is half of something: of what?",
        ),
        WrongNumber(
            "sign",
            3.0,
            "The sign is reversed. Go through the sum again: which entry is larger in size?",
        ),
    ),
    otherwise="Two entries of C make this number. Which, and how does this section put them together?",
    further="So a library with the Christoffel C tells you how fast M changes, without a derivative.",
    hints=(
        "Which equation of this section has the rate of M on one side and C on the other?",
        "Write that equation for the entry in row 1 and column 2. What is the transpose's entry there?",
    ),
)

# From upright to hanging, both centres of mass come down by twice their distance from the base.
BY_LEVER = ARM.m1 * ARM.lc1 + ARM.m2 * (ARM.l1 + ARM.lc2)
UPRIGHT = Number(
    id="04-upright",
    text="the most that can be taken out of the upright arm",
    unit="J",
    right=2 * BY_LEVER * ARM.g,
    wrong=(
        WrongNumber(
            "down to level",
            BY_LEVER * ARM.g,
            "You let the arm fall to the level of its base. Is this as low as it can hang?",
        ),
        WrongNumber(
            "without gravity",
            2 * BY_LEVER,
            "You have masses times heights. What does a mass weigh?",
        ),
        WrongNumber(
            "nothing",
            0.0,
            "From this arm something can be taken: P can still fall. From which place could it not?",
        ),
        WrongNumber(
            "sign",
            -2 * BY_LEVER * ARM.g,
            "The size is right. This is the work W that the motors do; the energy that you take out "
            "counts the other way.",
        ),
        WrongNumber(
            "elbow at the base",
            2 * (ARM.m1 * ARM.lc1 + ARM.m2 * ARM.lc2) * ARM.g,
            "You measured the centre of mass of link 2 from the elbow. How high above the base is it?",
        ),
        WrongNumber(
            "at the ends",
            2 * (ARM.m1 * ARM.l1 + ARM.m2 * (ARM.l1 + ARM.l2)) * ARM.g,
            "You put the weights at the ends of the links. Where do they act?",
        ),
    ),
    otherwise=(
        "This is not the energy that the arm can lose. How high are both centres of mass at the start, "
        "and how low can they come?"
    ),
    further="That is E(0) less the smallest energy that the arm can have, and no input gets more.",
    hints=(
        "The bound of this section needs the energy at the start, and the least energy of all.",
        "By how much does each centre of mass come down from upright to hanging? Weight times that, for "
        "both links.",
    ),
)

NEEDS = Choice(
    id="04-needs",
    text="which of the statements C' spoils",
    options=(
        Option(
            "The simulation of the arm, because another $C$ gives other accelerations.",
            "The accelerations need the vector C q̇ alone. Is it another one with C'?",
        ),
        Option(
            "$\\dot E = \\dot q^{\\mathsf T}(u - f)$, because it needs a skew-symmetric "
            "$\\dot M - 2C$.",
            "This statement has the same velocity on both sides of the matrix and within it. What did "
            "section 2 need for it?",
        ),
        Option(
            "None, because $C'$ is valid: what is true with $C$ is true with it.",
            "Valid means that C' q̇ is right. Is there a statement with C' times another vector?",
        ),
        Option(
            "$\\dot V = -d\\,z^{\\mathsf T}z$, because there a vector other than $\\dot q$ stands on "
            "both sides of $\\dot M - 2C$.",
        ),
    ),
    further="Before you trust a proof with such a term, ask which C your library returns.",
    hints=(
        "Go through the three statements, and ask of each: is C multiplied by the velocity, or by "
        "something else?",
        "Skew-symmetry is about every vector, the energy about one.",
    ),
)

CHECKS = (ENTRY, POWER, RATE, UPRIGHT, NEEDS)
