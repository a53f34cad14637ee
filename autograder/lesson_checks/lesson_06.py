"""The checks of lesson 06, linear in the parameters."""

import numpy as np

from autograder.judging.check import Check, Criterion
from autograder.judging.diagnosis import Mistake
from autograder.judging.quantities import each, vector
from autograder.lesson_checks.arm import ARM
from autograder.lesson_checks.choice import Choice, Option
from autograder.lesson_checks.number import Number, WrongNumber
from autograder.problems.material import sentences
from autograder.protocol import Call

# By the numbers of the lesson's list: where a student shows each goal.
GOALS = {
    1: ("06-motor",),
    2: ("c6-regressor", "06-row"),
    3: ("c6-rank_of_excitation", "06-count", "06-tool"),
    4: ("c6-identify", "06-row"),
    5: ("06-bodies",),
}

# A motor of 1.5 kg on the line of link 2, 0.6 m from its joint, with its inertia about its own centre.
MASS, AT, OWN = 1.5, 0.6, 0.05
LINK = ARM.I2 + ARM.m2 * ARM.lc2**2
BOTH = LINK + OWN + MASS * AT**2
COMMON = BOTH - (ARM.m2 * ARM.lc2 + MASS * AT) ** 2 / (ARM.m2 + MASS)
MOTOR = Number(
    id="06-motor",
    text="J2 of link 2 with the motor on it",
    unit="kg·m²",
    right=BOTH,
    wrong=(
        WrongNumber(
            "motor as a point",
            BOTH - OWN,
            "You took the motor for a point mass. But it turns along with the link: which of its "
            "numbers is left?",
        ),
        WrongNumber(
            "link about its centre",
            ARM.I2 + OWN + MASS * AT**2,
            "You moved the motor's inertia to the joint and left the link's at its own centre of "
            "mass.",
        ),
        WrongNumber(
            "motor about its centre",
            LINK + OWN,
            "You moved the link's inertia to the joint and left the motor's at its own centre.",
        ),
        WrongNumber(
            "both about their centres",
            ARM.I2 + OWN,
            "You added two inertias, each about another point. About which point does J count?",
        ),
        WrongNumber(
            "about the common centre",
            COMMON,
            "This is the inertia about the common centre of mass. About which point does J count?",
        ),
        WrongNumber(
            "distance not squared",
            LINK + OWN + MASS * AT,
            "You multiplied the motor's mass by its distance once. What is the integral that "
            "defines J?",
        ),
        WrongNumber(
            "distance from the link's centre",
            LINK + OWN + MASS * (AT - ARM.lc2) ** 2,
            "You measured the motor's distance from the centre of mass of the link. From where "
            "does J count?",
        ),
        WrongNumber(
            "distance from the shoulder",
            LINK + OWN + MASS * (ARM.l1 + AT) ** 2,
            "You measured the motor's distance from joint 1. Which joint is that of link 2?",
        ),
        WrongNumber(
            "motor alone",
            OWN + MASS * AT**2,
            "This is what the motor adds. The link itself is still there.",
        ),
    ),
    otherwise=(
        "J is a sum over the pieces of the body. Take the link and the motor one by one, each "
        "about the joint of link 2."
    ),
    further=(
        "In π, bodies that are bolted together simply add up: mass, first moment and J. Their "
        "centres of mass and the inertias about these do not."
    ),
    hints=(
        "J is the integral of x² + y² over the mass, measured from the joint. So of a body of two "
        "parts it is the sum of two integrals.",
        "For each part: the inertia about its own centre, and its mass times the square of the "
        "distance of that centre from the joint.",
    ),
)

# A planar 3R on a level table: no gravity, centres of mass on the lines of the links.
COUNT = Number(
    id="06-count",
    text="how many base parameters the arm on the table has",
    unit="",
    right=5,
    wrong=(
        WrongNumber(
            "all columns",
            9,
            "You counted all parameters, three a link. Which columns are zero, and which are made "
            "of others?",
        ),
        WrongNumber(
            "one less",
            8,
            "Nine less one is still too many: at least one more column is zero or made of others.",
        ),
        WrongNumber(
            "two less",
            7,
            "Nine less two is still too many. Of which of the three masses can the same be said "
            "as of that of link 2 in this section?",
        ),
        WrongNumber(
            "with gravity",
            6,
            "This is the count on a wall, where gravity acts. What does weight alone show?",
        ),
        WrongNumber("two links with gravity", 4, "This is the count for two links, with gravity."),
        WrongNumber(
            "two links",
            3,
            "This is the count for two links, without gravity. What does a third link bring along?",
        ),
    ),
    otherwise=(
        "Count the columns first, three a link. Then strike out those that are zero and those "
        "that are made of others."
    ),
    further=(
        "Each mass moves over to the link before it, and the first moment of link 1 shows itself "
        "by its weight alone. On the wall it counts, too."
    ),
    hints=(
        "How many parameters has a link whose centre of mass lies on its line? Which of them did "
        "the 2R lose, and why?",
        "A mass in any elbow is as good as one fixed to the end of the link before. And what of "
        "the first moment of link 1 is left where nothing has weight?",
    ),
)

TOOL = Choice(
    id="06-tool",
    text="what changes, what must be estimated, and from how much",
    options=(
        Option(
            "All four change. So there are four numbers to estimate, from two samples at least.",
            "All four change, but not freely: how many unknowns has the tool?",
        ),
        Option(
            "All four change. But one number is unknown, and one torque of one sample shows it.",
        ),
        Option(
            "Two change, $\\beta_3$ and $\\beta_4$, since the tool sits on link 2: two numbers to "
            "estimate, from one sample.",
            "You left β1 and β2 as they are. Which mass stands in them, besides what belongs to "
            "link 1?",
        ),
        Option(
            "None changes, since $m_2$ is no base parameter. The torques cannot show the tool.",
            "The mass of link 2 has no column of its own, but it is in the torques. To which base "
            "parameters did this lesson move it over?",
        ),
    ),
    further=(
        "A robot that knows itself can weigh what it grips, by the torque of one joint, as long "
        "as its motion in that moment lets the tool be felt there."
    ),
    hints=(
        "Put a point mass at the end of link 2. What does it add to m2, to m2 ℓc2 and to J2?",
        "Now look at the four combinations of section 4. Each of them grows by a known number "
        "times what?",
    ),
)


def _rows(rng, count):
    """Calls with no entry of the row near another or near 0."""
    calls = []
    for _ in range(count):
        q = rng.choice([-1, 1]) * rng.uniform(0.3, 0.6)
        qd = rng.choice([-1, 1]) * rng.uniform(1.5, 3.0)
        calls.append(Call("my_row", (q, qd, rng.uniform(4.0, 6.0), rng.uniform(8.0, 11.0))))
    return calls


@each
def _four(call, value):
    return (vector(value, 4),)


def _row(q, qd, qdd, g):
    return np.array([g * np.sin(q), qdd, qd, np.sign(qd)])


def _changed(place, entry):
    """The row with another entry at a place."""

    def row(q, qd, qdd, g):
        found = _row(q, qd, qdd, g)
        found[place] = entry(q, qd, qdd, g)
        return found

    return row


ROW = Check(
    id="06-row",
    signature="my_row(q, qd, qdd, g)",
    reference=_row,
    calls=_rows,
    quantities=_four,
    criteria=(
        Criterion(
            "row of the regressor",
            units=("m/s²", "rad/s²", "rad/s", ""),
            entries=("column of m ℓc", "column of J", "column of d", "column of k"),
            otherwise=(
                "What does the torque gain if m ℓc grows by 1 kg·m and all else stays? Ask the "
                "same of J, of d and of k."
            ),
        ),
    ),
    mistakes=(
        Mistake(
            "cosine",
            _changed(0, lambda q, qd, qdd, g: g * np.cos(q)),
            "You have the cosine, as in the table of section 2. From where does this pendulum "
            "count its angle?",
        ),
        Mistake(
            "sign of gravity",
            _changed(0, lambda q, qd, qdd, g: -g * np.sin(q)),
            "Your gravity has the wrong sign. Which way must the motor turn a pendulum that it "
            "holds at a small positive angle?",
        ),
        Mistake(
            "without g",
            _changed(0, lambda q, qd, qdd, g: np.sin(q)),
            "Your first column has no unit. A torque in N·m over m ℓc in kg·m leaves m/s²: what "
            "is missing?",
        ),
        Mistake(
            "weight at every angle",
            _changed(0, lambda q, qd, qdd, g: g),
            "Your first column is the same at every angle. At which angle does the weight need no "
            "torque?",
        ),
        Mistake(
            "radians converted",
            _changed(0, lambda q, qd, qdd, g: g * np.sin(np.radians(q))),
            sentences.RADIANS_CONVERTED,
        ),
        Mistake(
            "in degrees",
            _changed(0, lambda q, qd, qdd, g: g * np.sin(np.degrees(q))),
            sentences.IN_DEGREES,
        ),
        Mistake(
            "inertia and damping exchanged",
            lambda q, qd, qdd, g: _row(q, qd, qdd, g)[[0, 2, 1, 3]],
            "The columns of J and d have changed places.",
        ),
        Mistake(
            "velocity for its sign",
            _changed(3, lambda q, qd, qdd, g: qd),
            "Your last column grows with the speed, as the one before it. How large is dry friction in "
            "a joint that moves twice as fast?",
        ),
        Mistake(
            "sign of the angle",
            _changed(3, lambda q, qd, qdd, g: np.sign(q)),
            "Your last column has the sign of the angle. Does friction depend on where a pendulum is, "
            "or on how it moves?",
        ),
        Mistake(
            "exchanged",
            lambda q, qd, qdd, g: _row(q, qd, qdd, g)[[1, 0, 2, 3]],
            "The columns of m ℓc and J have changed places.",
        ),
        Mistake(
            "friction exchanged",
            lambda q, qd, qdd, g: _row(q, qd, qdd, g)[[0, 1, 3, 2]],
            "The columns of d and k have changed places.",
        ),
        Mistake(
            "friction drives",
            lambda q, qd, qdd, g: _row(q, qd, qdd, g) * [1, 1, -1, -1],
            "Your friction drives the pendulum. On which side of the equation of motion does f "
            "stand: on that of u, or on that of M q̈?",
        ),
        Mistake(
            "Coulomb without its sign",
            _changed(3, lambda q, qd, qdd, g: 1.0),
            "Your last column is 1 in both directions. What does dry friction do when the motion "
            "turns around?",
        ),
        Mistake(
            "speeds",
            lambda q, qd, qdd, g: np.array([g * np.sin(q), qdd, abs(qd), 1.0]),
            "Your friction has the same sign in both directions. What does it do when the motion "
            "turns around?",
        ),
    ),
    hints=(
        "Write the equation of motion of the pendulum, with friction, as one sum: something times "
        "m ℓc, something times J, something times d, something times k.",
        "The pendulum's gravity torque is in lesson 01; the friction torque stands in this "
        "section. The row is what is left of each term without its parameter: a list of four.",
    ),
    further=(
        "One such row a sample, one under the other, and least squares weighs the pendulum and "
        "measures its friction at once."
    ),
)

# ℓ1 = 0.5 m, β2 = 0.9 kg·m², β3 = 0.8 kg·m.
LENGTH, BETA_2, BETA_3 = 0.5, 0.9, 0.8
BODIES = Number(
    id="06-bodies",
    text="the smallest β4 that bodies can have",
    unit="kg·m²",
    right=(LENGTH * BETA_3) ** 2 / BETA_2,
    wrong=(
        WrongNumber(
            "without the length",
            BETA_3**2 / BETA_2,
            "You left out ℓ1. Which unit does your number have?",
        ),
        WrongNumber(
            "length not squared",
            LENGTH * BETA_3**2 / BETA_2,
            "Your ℓ1 is not squared. Which unit does your number have?",
        ),
        WrongNumber(
            "nothing squared",
            LENGTH * BETA_3 / BETA_2,
            "Your product ℓ1 β3 is not squared. Which unit does your number have?",
        ),
        WrongNumber(
            "not divided",
            (LENGTH * BETA_3) ** 2,
            "This is what the product of β2 and β4 must exceed. One of its factors is known.",
        ),
        WrongNumber(
            "positive alone",
            0.0,
            "A positive β4 is needed, but it is not enough: the third condition ties it to the "
            "others.",
        ),
        WrongNumber(
            "upside down",
            BETA_2 / (LENGTH * BETA_3) ** 2,
            "Your fraction stands upside down. Which unit does your number have?",
        ),
        WrongNumber(
            "the other bound on m2",
            BETA_2 / LENGTH**2,
            "This is the bound on m2 that link 1 gives, in kg. It still has to be put into the "
            "bound that link 2 gives.",
        ),
    ),
    otherwise=(
        "Between the two bounds there must be room for m2. Set the lower one equal to the upper "
        "one, and solve for β4."
    ),
    further=(
        "Below it M is not positive definite at q2 = 0, though each of the three numbers is "
        "positive: no look at them one by one shows that."
    ),
    hints=(
        "Three conditions on β stand in this section. Which of them ties β4 to β2 and β3?",
        "At the edge the third condition is an equation. Solve it for β4, then put in the numbers.",
    ),
)

CHECKS = (MOTOR, COUNT, TOOL, ROW, BODIES)
