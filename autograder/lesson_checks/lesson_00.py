"""The checks of lesson 00, Start here."""

from autograder.judging.check import Check, Criterion
from autograder.judging.diagnosis import Mistake
from autograder.judging.quantities import each, vector
from autograder.judging.terms import Term
from autograder.lesson_checks.choice import Choice, Option
from autograder.lesson_checks.number import Number, WrongNumber
from autograder.protocol import Call

# By the numbers of the lesson's list: where a student shows each goal.
GOALS = {
    1: ("00-torque", "00-size"),
    2: ("00-gripper",),
    3: ("start-kinetic-energy", "00-factor"),
    4: ("00-typed",),
}


def _states(rng, count):
    calls = []
    for n in rng.integers(2, 5, size=count):
        matrices, vectors = rng.uniform(-3, 3, size=(2, n, n)), rng.uniform(-3, 3, size=(4, n))
        calls.append(Call("my_torque", (*matrices, *vectors)))
    return calls


@each
def _one_each_joint(call, value):
    return (vector(value, len(call.args[-1])),)


EXCHANGED = (
    "A matrix of yours multiplies the wrong vector. Which of the two belongs to the velocities, "
    "and which to the accelerations?"
)
TRANSPOSED = (
    "You multiply by the transpose of {0}. In NumPy `v @ A` is that, too: which stands first in the "
    "equation, {0} or its vector?"
)
TORQUE = Check(
    id="00-torque",
    signature="my_torque(M, C, g_vec, f_vec, qd, qdd)",
    reference=lambda M, C, g_vec, f_vec, qd, qdd: M @ qdd + C @ qd + g_vec + f_vec,
    calls=_states,
    quantities=_one_each_joint,
    criteria=(Criterion("torques of the motors", "N·m"),),
    terms=(
        Term("M q̈", lambda M, C, g_vec, f_vec, qd, qdd: M @ qdd),
        Term("C q̇", lambda M, C, g_vec, f_vec, qd, qdd: C @ qd),
        Term("gravity", lambda M, C, g_vec, f_vec, qd, qdd: g_vec),
        Term("friction", lambda M, C, g_vec, f_vec, qd, qdd: f_vec),
    ),
    mistakes=(
        Mistake(
            "M and C exchanged",
            lambda M, C, g_vec, f_vec, qd, qdd: C @ qdd + M @ qd + g_vec + f_vec,
            EXCHANGED,
        ),
        Mistake(
            "both with the accelerations",
            lambda M, C, g_vec, f_vec, qd, qdd: (M + C) @ qdd + g_vec + f_vec,
            EXCHANGED,
        ),
        Mistake(
            "both with the velocities",
            lambda M, C, g_vec, f_vec, qd, qdd: (M + C) @ qd + g_vec + f_vec,
            EXCHANGED,
        ),
        Mistake(
            "friction left out",
            lambda M, C, g_vec, f_vec, qd, qdd: M @ qdd + C @ qd + g_vec,
            "The motors have to overcome something more: one of the four terms is not in your sum.",
        ),
        Mistake(
            "gravity left out",
            lambda M, C, g_vec, f_vec, qd, qdd: M @ qdd + C @ qd + f_vec,
            "One of the four terms is not in your sum. What has an arm to be held against, even at "
            "rest?",
        ),
        Mistake(
            "friction subtracted",
            lambda M, C, g_vec, f_vec, qd, qdd: M @ qdd + C @ qd + g_vec - f_vec,
            "Your friction helps the motors. On which side of the course's equation does it stand, "
            "and with which sign?",
        ),
        Mistake(
            "gravity subtracted",
            lambda M, C, g_vec, f_vec, qd, qdd: M @ qdd + C @ qd - g_vec + f_vec,
            "Your gravity helps the motors. On which side of the course's equation does it stand, "
            "and with which sign?",
        ),
        Mistake(
            "M with both",
            lambda M, C, g_vec, f_vec, qd, qdd: M @ (qdd + qd) + g_vec + f_vec,
            EXCHANGED,
        ),
        Mistake(
            "C with both",
            lambda M, C, g_vec, f_vec, qd, qdd: C @ (qdd + qd) + g_vec + f_vec,
            EXCHANGED,
        ),
        Mistake(
            "transposed",
            lambda M, C, g_vec, f_vec, qd, qdd: qdd @ M + qd @ C + g_vec + f_vec,
            "Your vectors stand to the left of the matrices. Of a matrix that is not symmetric, that "
            "gives another vector: which stands first in the equation?",
        ),
        Mistake(
            "M transposed",
            lambda M, C, g_vec, f_vec, qd, qdd: qdd @ M + C @ qd + g_vec + f_vec,
            TRANSPOSED.format("M"),
        ),
        Mistake(
            "C transposed",
            lambda M, C, g_vec, f_vec, qd, qdd: M @ qdd + qd @ C + g_vec + f_vec,
            TRANSPOSED.format("C"),
        ),
    ),
    hints=(
        "Find each term of the equation at the top of this lesson in the column `in code`. Which "
        "two of them are a matrix times a vector?",
        "A matrix times a vector is `A @ v` in Python. `A * v` multiplies entry by entry, and "
        "gives a matrix.",
    ),
    further="One line serves every arm: with one joint or with seven, only the shapes are others.",
)

SIZE = Number(
    id="00-size",
    text="how many Christoffel symbols an arm with six joints has",
    unit="",
    right=216.0,
    wrong=(
        WrongNumber(
            "a matrix",
            36.0,
            "That is the size of a matrix, such as M. How many indices has one symbol?",
        ),
        WrongNumber(
            "sum of the indices",
            18.0,
            "You added what each index can be. With each value of the first, how many are there of "
            "the second and the third?",
        ),
        WrongNumber(
            "a vector",
            6.0,
            "That is the length of a vector, such as q. How many indices has one symbol?",
        ),
        WrongNumber(
            "the different ones",
            126.0,
            "You counted how many of them can be different. The array holds them all: what is its "
            "shape?",
        ),
        WrongNumber(
            "joints and indices exchanged",
            729.0,
            "You took the number of indices to the power of joints. Which of the two numbers is "
            "how many values an index has?",
        ),
        WrongNumber(
            "from two joints",
            8.0,
            "That is the number for two joints. The arm here has six.",
        ),
    ),
    otherwise="Look up the shape of the symbols in the table. How many joints has this arm?",
    further="An arm with six joints is ordinary, and nobody writes all of these by hand: see lesson 08.",
    hints=(
        "The last column of the table has the shape of each symbol. What is n here?",
        "An array of the shape (a, b) holds a times b numbers. This one has three axes.",
    ),
)

GRIPPER = Choice(
    id="00-gripper",
    text="which question of the map it is, and what makes it easy",
    options=(
        Option(
            "Simulation, because the torque was measured, and the motion follows from it.",
            "The motion follows from the torque, but it was recorded, too. What is it that nobody "
            "knows?",
        ),
        Option(
            "Identification, because $M$ is positive definite, so that the equation can be solved.",
            "The question is right. But for what does a positive definite M let you solve the "
            "equation: for what is asked here?",
        ),
        Option(
            "Control, because the motors' torque has to carry the gripper.",
            "The motors do carry it. But is a torque what is looked for here, or was it recorded?",
        ),
        Option(
            "Identification, because the torques are linear in the parameters: a set of linear "
            "equations.",
        ),
    ),
    further="Each sample of the motion is one more row of linear equations for the same few unknowns.",
    hints=(
        "What was recorded, and what is unknown? The last row of the map has a question for each.",
        "Each property on the map makes one kind of question easy. Which one says how a torque "
        "depends on a mass?",
    ),
)

FACTOR = Number(
    id="00-factor",
    text="the factor by which the kinetic energy grows",
    unit="",
    right=16.0,
    wrong=(
        WrongNumber(
            "a square missing",
            8.0,
            "You left out a square, or added two factors that follow one after the other. Look at "
            "the integral: how do r and q̇ stand in it?",
        ),
        WrongNumber(
            "no squares, or one change",
            4.0,
            "This is too little: either one of the two changes is not in it, or neither is "
            "squared. Look at the integral: how do r and q̇ stand in it?",
        ),
        WrongNumber(
            "mass grows with the length",
            32.0,
            "You let the mass grow with the length. It is the same rod's mass, only spread out "
            "farther.",
        ),
        WrongNumber(
            "a power too high",
            64.0,
            "This is too much: at least one of the two changes acts with a higher power in your "
            "factor than in the formulas above.",
        ),
        WrongNumber(
            "less",
            0.25,
            "Your energy falls. Does a faster rod hold less of it?",
        ),
    ),
    otherwise="Put 2 q̇ for q̇ and 2 ℓ for ℓ into K, with the same m, and divide by the K from before.",
    further="At the same q̇, twice the length makes each piece twice as fast: both changes act alike.",
    hints=(
        "Take one change after the other. By what factor does the first one change the speed of a "
        "piece?",
        "Two changes, one after the other, multiply their factors.",
    ),
)

TYPED = Choice(
    id="00-typed",
    text="what the check says of a mass that is typed in",
    options=(
        Option(
            "Correct: the number is that of the arm in the story, and the check asks about that "
            "arm.",
            "Where are the masses from that a check asks about? Section 4 says whose choice its "
            "inputs are.",
        ),
        Option(
            "Incorrect: it calls the function with arms of its own choice, and so does the grader.",
        ),
        Option(
            "Correct, but the grader then takes the points away, since it has other arms.",
            "The grader has other arms, but checks of the same kind. With which arms does the "
            "check in the notebook call your function?",
        ),
        Option(
            "Error in your code: the function may not use a number that it was not given.",
            "The function runs, and returns numbers of the right shape. Which row of the table "
            "fits that?",
        ),
    ),
    further="The card's worst case shows the arm that was asked about, so that you can see its mass.",
    hints=(
        "Read again what a check calls a function with.",
        "Does the function stop with an error? And are its numbers right for an arm of another "
        "mass?",
    ),
)

CHECKS = (TORQUE, SIZE, GRIPPER, FACTOR, TYPED)
