"""The checks of lesson 09, the same arm in four languages."""

from math import log

from autograder.lesson_checks.choice import Choice, Option
from autograder.lesson_checks.number import Number, WrongNumber

# By the numbers of the lesson's list: where a student shows each goal.
GOALS = {
    1: ("09-push",),
    2: ("09-joint",),
    3: ("09-loop",),
    4: ("09-rod",),
    5: ("09-single",),
}

# M = L D Lᵀ and r, on paper.
M11, M12, M22, R1, R2 = 4.0, 2.0, 1.5, 6.0, 2.0
L21 = M12 / M11
D2 = M22 - L21 * M12
Y2 = R2 - L21 * R1


def _upwards(z2, sign=-1.0):
    return R1 / M11 + sign * L21 * z2


PUSH = Number(
    id="09-push",
    text="the acceleration of joint 1, by LDLᵀ",
    unit="rad/s²",
    right=_upwards(Y2 / D2),
    wrong=(
        WrongNumber(
            "joint 2",
            Y2 / D2,
            "This is the acceleration of joint 2, and it is right. One step is left, upwards.",
        ),
        WrongNumber(
            "as if alone",
            R1 / M11,
            "This is what joint 1 would do if joint 2 did not accelerate. What does the step upwards "
            "take away?",
        ),
        WrongNumber(
            "sign upwards",
            _upwards(Y2 / D2, 1.0),
            "In the step upwards, the sign is wrong. Is the acceleration of joint 2 positive here?",
        ),
        WrongNumber(
            "nothing downwards",
            _upwards(R2 / D2),
            "You kept r2 as it is. What does the step downwards do with y1?",
        ),
        WrongNumber(
            "sign downwards",
            _upwards((R2 + L21 * R1) / D2),
            "In the step downwards, the sign is wrong: what joint 1 takes is no longer there for "
            "joint 2.",
        ),
        WrongNumber(
            "M22 for D2",
            _upwards(Y2 / M22),
            "You divided by M22. What is left of it after the square is completed?",
        ),
        WrongNumber(
            "sign in D2",
            _upwards(Y2 / (M22 + L21 * M12)),
            "Your D2 is larger than M22. Does the freedom of joint 1 make joint 2 heavier or lighter?",
        ),
        WrongNumber(
            "undivided",
            R1 - L21 * Y2,
            "You went from y straight upwards. Which step stands between?",
        ),
        WrongNumber(
            "D2 not divided by",
            _upwards(Y2),
            "You divided by D1 and not by D2.",
        ),
        WrongNumber(
            "determinant",
            M22 * R1 - M12 * R2,
            "You solved by the inverse, and left out the determinant. Three steps make it appear by "
            "itself, as D1 times D2.",
        ),
    ),
    otherwise=(
        "Write down D1, L21 and D2 first. Then y downwards, z by two divisions, and the accelerations "
        "upwards. Put them into M to see that they give r."
    ),
    further=(
        "Two factors and three short steps, with nothing inverted: the inverse would have taken a "
        "solve for each column before the first product."
    ),
    hints=(
        "D1 is an entry of M. L21 is a ratio of two entries. D2 is what is left of M22 when the square "
        "is completed.",
        "Downwards: y1 is r1, and y2 is r2 less L21 times y1. Then divide each y by its D.",
        "The last z is the acceleration of joint 2 already. Joint 1 loses L21 times that.",
    ),
)

JOINT = Choice(
    id="09-joint",
    text="the same line in MATLAB",
    options=(
        Option(
            "`M(1,:)*qdd + C(1,:)*qd + g(1)`",
            "You kept the number 1. From where does each of the two languages count?",
        ),
        Option(
            "`M(:,2)'*qdd + C(:,2)'*qd + g(2)`",
            "You took the columns of M and C. For M that is the same, because it is symmetric. Is it "
            "for C?",
        ),
        Option(
            "`M(2,2)*qdd(2) + C(2,2)*qd(2) + g(2)`",
            "You took one entry of each matrix. Which entries does the product with a vector use for "
            "one entry of the result?",
        ),
        Option("`M(2,:)*qdd + C(2,:)*qd + g(2)`"),
        Option(
            "`M(2,:).*qdd + C(2,:).*qd + g(2)`",
            "The dot makes it entry by entry. What does MATLAB make of a row and a column then?",
        ),
    ),
    further="It is the torque of joint 2 without friction: one row of the equation of motion.",
    hints=(
        "Java counts the entries of a vector from 0, MATLAB from 1. Which joint is it?",
        "One entry of a product of a matrix and a vector is one row of the matrix times the vector.",
    ),
)

LOOP = Choice(
    id="09-loop",
    text="what the scope shows with one wire cut",
    options=(
        Option(
            "The arm stays at rest, as a hanging arm does: both integrators start from the hanging "
            "pose, and nothing moves it away.",
            "The integrators know where the arm hangs. Does the function block know it, too?",
        ),
        Option(
            "The run stops with an error, because the loop is no longer closed.",
            "Every block still gets a number at each of its inputs. What does the function block "
            "compute from them?",
        ),
        Option(
            "The arm turns faster and faster with a constant $\\ddot q$, because the function block "
            "takes it for a level arm all the time.",
        ),
        Option(
            "The arm swings to and fro about the level pose, because the function block takes this "
            "for the place where it is.",
            "To swing, it must be pulled back. What could change the sign of its acceleration while "
            "the function block sees one and the same pose?",
        ),
    ),
    further=(
        "With q at zero M and g are constant and C is zero. The wires that lead back are what makes an "
        "equation of motion out of three blocks."
    ),
    hints=(
        "Follow the wires: which numbers arrive at the function block at the start, and which a "
        "second later?",
        "How large is C where the sine of q2 is zero? And which way does gravity pull a level arm?",
    ),
)

ROD = Choice(
    id="09-rod",
    text="the wrong line, and what shows it",
    options=(
        Option(
            "Line 1 gives $I_1 = 0$. Then $M$ is not positive definite, or a simulation gains or loses "
            "energy, so one of the two shows it.",
            "The line is the right one. Which terms are left in M11 without I1? Is there an arm with "
            "this M, and what does the energy of that arm do?",
        ),
        Option(
            "Line 2 gives $I_2 = 0$, because 12 is an integer. Neither $M$ nor the energy shows it: it "
            "is the right $M$ of another arm.",
            "Line 2 is read from left to right. Of which type is the number that is divided by 12?",
        ),
        Option(
            "Line 3 gives a wrong $M_{22}$, because `l2 / 2` is cut to an integer. Then $M$ is not "
            "positive definite.",
            "A division is cut only if both of its numbers are integers. Of which type is l2?",
        ),
        Option(
            "Line 1 gives $I_1 = 0$. Neither $M$ nor the energy shows it: it is the right $M$ of "
            "another arm.",
        ),
        Option(
            "Line 5 gives a wrong square, because `std::pow` is called with the integer 2. The "
            "energy of a simulation shows it.",
            "The function pow turns an integer into a double before it computes. In which line are "
            "two integers divided?",
        ),
    ),
    further="Only a comparison finds it: with another program, or with a measured arm.",
    hints=(
        "In C++ the type of a division is that of its two numbers alone. Go through the divisions, "
        "each from left to right.",
        "The mistake leaves one number of the arm at another value. Is an arm with that value "
        "possible?",
    ),
)

# Single precision, and the growth of the wild start.
GROWTH, SINGLE, NEAR = 2.5, 6e-8, 0.01
AGREES = log(NEAR / SINGLE) / GROWTH
SINGLE_FOR_DOUBLE = Number(
    id="09-single",
    text="how long the two programs agree",
    unit="s",
    right=AGREES,
    wrong=(
        WrongNumber(
            "logarithm to base 10",
            AGREES / log(10),
            "You took the logarithm to base 10. Which number is raised to the power of λt in the law of "
            "growth?",
        ),
        WrongNumber(
            "until 1",
            log(1 / SINGLE) / GROWTH,
            "This is when the difference is 1. The question asks for an earlier time.",
        ),
        WrongNumber(
            "double precision",
            log(NEAR / 1e-16) / GROWTH,
            "You started from the rounding of double precision. How large is the difference at first, "
            "if one of the two programs computes in single precision?",
        ),
        WrongNumber(
            "the time of the text",
            log(1e16) / GROWTH,
            "This is the time of the text, for two programs in double precision. What is different "
            "here, at the start and at the end?",
        ),
        WrongNumber(
            "not divided by λ",
            AGREES * GROWTH,
            "This is λt. Divide by λ.",
        ),
        WrongNumber(
            "multiplied by λ",
            AGREES * GROWTH**2,
            "You multiplied by λ. Does a larger λ make them agree for a longer time?",
        ),
        WrongNumber(
            "upside down",
            -AGREES,
            "The time is negative: you took the logarithm of the ratio upside down.",
        ),
    ),
    otherwise=(
        "The difference is 6e-8 at first and is multiplied by e to the power of λt. Set this equal to "
        "0.01, and solve for t."
    ),
    further=(
        "An estimate: in real runs of RK4 it is about a second less, since each step adds a rounding of "
        "its own. With twice as many digits, in double precision, it is less than three times as long."
    ),
    hints=(
        "By which factor has the difference grown when it is 0.01?",
        "The factor is e to the power of λt. Which function gives the exponent?",
    ),
)

CHECKS = (PUSH, JOINT, LOOP, ROD, SINGLE_FOR_DOUBLE)
