"""The checks of lesson 10, state space and simulation."""

from math import log, log10

from autograder.lesson_checks.choice import Choice, Option
from autograder.lesson_checks.number import Number, WrongNumber

# By the numbers of the lesson's list: where a student shows each goal.
GOALS = {
    1: ("p5-f",),
    2: ("10-ahead", "10-halved", "p5-rk4_step"),
    3: ("10-balance", "p5-energy_drift"),
    4: ("10-promise",),
    5: ("10-tips",),
}

# Two slopes, the second one two thirds of the step ahead.
AHEAD_BY = 2 / 3
AHEAD = Number(
    id="10-ahead",
    text="the weight of the second slope",
    unit="",
    right=1 / (2 * AHEAD_BY),
    wrong=(
        WrongNumber(
            "weight of the first",
            1 - 1 / (2 * AHEAD_BY),
            "This is the weight of the first slope. What is left for the second?",
        ),
        WrongNumber(
            "half of c",
            AHEAD_BY / 2,
            "You multiplied by c. The second order condition has a product on its left side.",
        ),
        WrongNumber(
            "without the half",
            1 / AHEAD_BY,
            "You set the product of b2 and c to 1. What stands before f′f in Taylor's series?",
        ),
        WrongNumber(
            "a plain mean",
            0.5,
            "You took the plain mean of both slopes. For which c would that be right?",
        ),
        WrongNumber(
            "c itself",
            AHEAD_BY,
            "This is c, where the second slope is taken. Its weight is asked for.",
        ),
        WrongNumber(
            "the second alone",
            1.0,
            "You took the second slope alone. For which c would that be right?",
        ),
    ),
    otherwise="With your weight, one of the two order conditions does not hold. Put it into both.",
    further=(
        "For every c but 0 there is such a pair of weights, so there is a whole family of methods of "
        "order 2."
    ),
    hints=(
        "There are two order conditions. Which of them has c in it?",
        "Put c = 2/3 into the second condition, and solve it for b2.",
    ),
)

# The change from one run to the next, as the number of steps is doubled.
FIRST, SECOND = 3.2e-4, 4.0e-5
RATIO = FIRST / SECOND
HALVED = Number(
    id="10-halved",
    text="the order of the method",
    unit="",
    right=log(RATIO) / log(2),
    wrong=(
        WrongNumber(
            "ratio",
            RATIO,
            "This is the ratio of the two changes. To which power is 2 raised to give it?",
        ),
        WrongNumber(
            "order 4",
            4.0,
            "A method of order 4 makes the change fall to a sixteenth when the step is halved. How far "
            "does it fall here?",
        ),
        WrongNumber(
            "natural logarithm",
            log(RATIO),
            "You took the natural logarithm. The step was halved, so which base has the logarithm?",
        ),
        WrongNumber(
            "logarithm to base 10",
            log10(RATIO),
            "You took the logarithm to base 10. The step was halved, so which base has the logarithm?",
        ),
        WrongNumber(
            "from first to last",
            log(RATIO) / log(4),
            "You took both changes as if the step had been quartered between them. By how much is the "
            "step shorter from one change to the next?",
        ),
        WrongNumber(
            "upside down",
            -log(RATIO) / log(2),
            "An order is positive: does the change grow or fall when the step is halved?",
        ),
        WrongNumber(
            "inverse ratio",
            1 / RATIO,
            "This is what is left of the change. To which power is the half raised to give it?",
        ),
    ),
    otherwise="Divide the first change by the second. To which power of 2 is that equal?",
    further=(
        "A method of this order lies between the two of section 2: to measure, you need not know who "
        "wrote it or how it works."
    ),
    hints=(
        "If the error goes as a power of the step, then so does the change from one run to the next.",
        "How many times in a row must you halve the first change to come to the second?",
    ),
)

PROMISE = Choice(
    id="10-promise",
    text="what a symplectic method promises for the free arm",
    options=(
        Option(
            "Yes, as it stands: implicit midpoint is a symplectic method, and so its drift stays "
            "bounded.",
            "A step is symplectic in variables of its own. Which are these, and which are stepped "
            "here?",
        ),
        Option(
            "Only if the run steps $(q, p)$ with $p = M\\dot q$: then the drift stays bounded over very "
            "long runs, as long as the steps are small enough.",
        ),
        Option(
            "Only if the run steps $(q, p)$ with $p = M\\dot q$: then the energy does not change at "
            "all, as for the pendulum of section 3.",
            "The pendulum of section 3 was a linear one. What does section 4 promise in general: the "
            "same energy, or bounds?",
        ),
        Option(
            "No, in no variables: $p = M\\dot q$ is $\\dot q$ in another unit, so nothing changes.",
            "This would be so if M were constant. What does the M of this arm depend on?",
        ),
    ),
    further=(
        "Bounds on the energy are no bounds on the error of the motion: where the arm is, no method "
        "knows after so long a time."
    ),
    hints=(
        "In which pair of variables does this section define the word symplectic?",
        "Section 3 shows how implicit midpoint treats a linear pendulum. Is the arm linear?",
    ),
)

# What the energy of a driven arm with friction did, in J.
CHANGE, GIVEN, TAKEN = -7.4, 5.1, 14.2
BALANCE = Number(
    id="10-balance",
    text="the energy that the method added",
    unit="J",
    right=CHANGE - GIVEN + TAKEN,
    wrong=(
        WrongNumber(
            "sign",
            -(CHANGE - GIVEN + TAKEN),
            "The size is right and the sign is not. By the balance, should the arm end with more "
            "energy than in the run, or with less?",
        ),
        WrongNumber(
            "without the motors",
            CHANGE + TAKEN,
            "You left out what the motors gave. The arm has that, too.",
        ),
        WrongNumber(
            "without friction",
            CHANGE - GIVEN,
            "You left out what friction took.",
        ),
        WrongNumber(
            "by the balance",
            GIVEN - TAKEN,
            "This is how the energy should have changed. How far from that is the run?",
        ),
        WrongNumber(
            "change of the run",
            CHANGE,
            "This is how the energy changed in the run. How should it have changed?",
        ),
        WrongNumber(
            "rise for fall",
            -CHANGE - GIVEN + TAKEN,
            "You let the energy rise. It fell: which sign has its change?",
        ),
        WrongNumber(
            "motors counted as a loss",
            CHANGE + GIVEN + TAKEN,
            "You took what the motors gave for a loss. Which sign has the work of u in the balance?",
        ),
    ),
    otherwise=(
        "The balance says by how much the energy should change: what the motors give, less what "
        "friction takes. What the method adds is the rest."
    ),
    further=(
        "The energy fell and the method added some all the same. The fall alone says nothing about a "
        "method: only the balance does."
    ),
    hints=(
        "By how much should the energy have changed, with these two works?",
        "It should have fallen by the difference of the two works. Did it fall by more or by less?",
    ),
)

TIPS = Choice(
    id="10-tips",
    text="what the two students find, and what it means",
    options=(
        Option(
            "Agreement to a millimetre: with order 4, half the step leaves a sixteenth of an error "
            "that is small already.",
            "The order tells how the error falls with the step. What does the wild start do to any "
            "small error in the course of 12 s?",
        ),
        Option(
            "Agreement to a few centimetres: a drift of 0.05 J is about a thousandth of the 36 J that "
            "go to and fro, so the tips are right to about a thousandth, too.",
            "A small drift says that the energy is nearly right. Does one energy belong to one "
            "posture?",
        ),
        Option(
            "No agreement. So at least one of the two programs is wrong: for one start there is one "
            "motion.",
            "There is one motion for each start, and each run is only near to it. How long does a run "
            "that is right stay near?",
        ),
        Option(
            "No agreement, though both may be right. They should compare over a short time, or what "
            "chaos leaves alone, as the energy and the order.",
        ),
    ),
    further="A calm start or friction would do as well: then small differences do not grow.",
    hints=(
        "The two runs differ a little from the very first step on. What does section 7 say of little "
        "differences?",
        "In section 7 the exponent grows by about 1.7 per second. By which factor has a difference "
        "grown after 12 s, if nothing stops it?",
    ),
)

CHECKS = (AHEAD, HALVED, PROMISE, BALANCE, TIPS)
