"""The checks of lesson 05, gravity."""

from math import cos, hypot, radians, sin

from autograder.lesson_checks.arm import ARM
from autograder.lesson_checks.choice import Choice, Option
from autograder.lesson_checks.number import Number, WrongNumber

# By the numbers of the lesson's list: where a student shows each goal.
GOALS = {
    1: ("p4-potential_energy", "p4-g_vec", "p4-gravity_from_jacobians"),
    2: ("05-lever", "05-moon"),
    3: ("p4-equilibria", "05-spring"),
    4: ("05-sag", "05-upright"),
}

# The largest torques of the directions of link 1 and of link 2, N·m.
A = (ARM.m1 * ARM.lc1 + ARM.m2 * ARM.l1) * ARM.g
B = ARM.m2 * ARM.lc2 * ARM.g

# A load of 2 kg in the hand; link 1 at 50°, link 2 level.
WEIGHT = 2.0 * ARM.g
OUT, UP = ARM.l1 * cos(radians(50)), ARM.l1 * sin(radians(50))

LEVER = Number(
    id="05-lever",
    text="what the load adds to the torque of joint 1",
    unit="N·m",
    right=WEIGHT * (OUT + ARM.l2),
    wrong=(
        WrongNumber(
            "mass for weight",
            2.0 * (OUT + ARM.l2),
            "Your lever arm is right, but a mass in kg is not yet a force. What does the load weigh?",
        ),
        WrongNumber(
            "q2 from the x axis",
            WEIGHT * (OUT + ARM.l2 * cos(radians(50))),
            "You took q2 for the angle of link 2 with the x axis. From where is q2 measured, and which "
            "way does link 2 point here?",
        ),
        WrongNumber(
            "at the centre of mass",
            WEIGHT * (OUT + ARM.lc2),
            "You hung the load at the centre of mass of link 2. Where is the hand?",
        ),
        WrongNumber(
            "straight distance",
            WEIGHT * hypot(OUT + ARM.l2, UP),
            "You took the straight distance from joint 1 to the load. Which part of it does a weight, "
            "which pulls straight down, turn the joint by?",
        ),
        WrongNumber(
            "vertical distance",
            WEIGHT * UP,
            "You took the height of the load above joint 1. Which way does a weight pull, and which "
            "distance counts then?",
        ),
        WrongNumber(
            "from the elbow",
            WEIGHT * ARM.l2,
            "This is what the load adds to joint 2. How much further away is joint 1?",
        ),
        WrongNumber(
            "to the elbow",
            WEIGHT * OUT,
            "You went from joint 1 to the elbow. The load hangs in the hand: what is left of the way?",
        ),
        WrongNumber(
            "stretched and level",
            WEIGHT * (ARM.l1 + ARM.l2),
            "This is the torque of an arm that is stretched out level. Link 1 rises here.",
        ),
        WrongNumber(
            "all weights",
            WEIGHT * (OUT + ARM.l2) + A * cos(radians(50)) + B,
            "This is the torque of all three weights. Only what the load adds is asked for.",
        ),
        WrongNumber(
            "sign",
            -WEIGHT * (OUT + ARM.l2),
            "The sign is reversed. Which way does the motor have to turn joint 1 to hold up a load to "
            "the right of it? Counter-clockwise is positive.",
        ),
    ),
    otherwise=(
        "This is not a weight times a lever arm of this pose. Draw the arm: how far to the right of "
        "joint 1 does the load hang? In Python, cosines take radians."
    ),
    further="The load's weight times its horizontal distance: two numbers, and no matrix.",
    hints=(
        "Draw the arm to scale, and the load's weight as an arrow with a vertical line through it.",
        "Link 2 makes the angle q1 + q2 with the x axis. So how long is its shadow on the ground, and "
        "how long is that of link 1?",
    ),
)

MOON = Choice(
    id="05-moon",
    text="what the Moon, the inertia and the motion do to g(q)",
    options=(
        Option(
            "It falls to less than a sixth, because the Moon pulls less, and an arm that is already "
            "moving needs less torque to be carried.",
            "You let the velocity into g(q). Which term of the equation of motion has q̇ in it?",
        ),
        Option(
            "It stays the same, because $q$ is the same, and $g$ is a function of $q$ alone.",
            "In g(q), q is the only variable, but there are constants too. Which of them is another "
            "on the Moon?",
        ),
        Option(
            "It falls to a sixth, because of the Moon alone: $P$ holds no inertia and no velocity.",
        ),
        Option(
            "It falls to a half: a sixth from the Moon, times three from the inertia.",
            "You let the inertia into g(q). Which numbers of a body say how high its weight is lifted?",
        ),
    ),
    further=(
        "Inertia and motion do need torques, too, but these stand in the other terms of the equation "
        "of motion."
    ),
    hints=(
        "Write down P of one link. Which of the three changes touches a letter in it?",
        "A flywheel that turns about its own centre of mass has no more weight than one at rest.",
    ),
)

# The arm with link 1 down and link 2 up: H = [[A − B, −B], [−B, −B]], and the spring adds to H22.
SPRING = Number(
    id="05-spring",
    text="the stiffness above which the spring makes this equilibrium stable",
    unit="N·m/rad",
    right=A * B / (A - B),
    wrong=(
        WrongNumber(
            "H22 alone",
            B,
            "At your stiffness H22 is zero. A matrix whose diagonal is positive is not yet positive "
            "definite: what else does a 2×2 matrix need?",
        ),
        WrongNumber(
            "H22 without gravity",
            B**2 / (A - B),
            "You left out what H22 is without the spring. Which part of it comes from gravity?",
        ),
        WrongNumber(
            "both up",
            A * B / (A + B),
            "You put in the sines of the upright arm. Which link points down here?",
        ),
        WrongNumber(
            "both down",
            -A * B / (A + B),
            "You put in the sines of the hanging arm. Which link points up here?",
        ),
        WrongNumber(
            "the other saddle",
            -A * B / (A - B),
            "The size is right and the sign is not. Is link 1 down and link 2 up in your H? And does a "
            "spring that pulls back make H22 larger or smaller?",
        ),
        WrongNumber(
            "without gravity",
            A * B / (A - B) / ARM.g,
            "Masses and lengths alone make no stiffness. With which factor do they become torques?",
        ),
    ),
    otherwise=(
        "At your stiffness the determinant of H with the spring is not zero. Put the two sines into H "
        "first, then add the spring to the entry of its joint."
    ),
    further=(
        "A motor with a position gain is such a spring: with enough gain, it holds an arm where "
        "gravity alone would let it fall."
    ),
    hints=(
        "Put the two sines of this place into H, in A and B. The spring of joint 2 adds k to one entry.",
        "A symmetric 2×2 matrix is positive definite if its determinant and one entry of its diagonal "
        "are positive. Where does the determinant change its sign?",
    ),
)

TWO_DEGREES = radians(2)
SAG = Number(
    id="05-sag",
    text="the smallest gain of joint 2 that keeps link 2 within 2° of level",
    unit="N·m/rad",
    right=B * cos(TWO_DEGREES) / TWO_DEGREES,
    wrong=(
        WrongNumber(
            "degrees",
            B * cos(TWO_DEGREES) / 2,
            "You divided by an angle in degrees. The gain is in N·m/rad: how many rad is 2°?",
        ),
        WrongNumber(
            "mass for weight",
            B / ARM.g * cos(TWO_DEGREES) / TWO_DEGREES,
            "A mass times a distance is not yet a torque. What does link 2 weigh?",
        ),
        WrongNumber(
            "length of link 2",
            B * ARM.l2 / ARM.lc2 / TWO_DEGREES,
            "You put the weight of link 2 at its end. Where does it act?",
        ),
        WrongNumber(
            "torque of joint 1",
            (A + B) / TWO_DEGREES,
            "This is what joint 1 would need. Which weights does joint 2 carry?",
        ),
        WrongNumber(
            "sine",
            B * sin(TWO_DEGREES) / TWO_DEGREES,
            "You took the sine of the angle with the x axis. How large is the torque of a link that is "
            "nearly level: nearly zero, or nearly the largest?",
        ),
        WrongNumber(
            "upside down",
            TWO_DEGREES / B,
            "You divided the angle by the torque. How many newton metres must the spring give for each "
            "rad by which it is stretched?",
        ),
    ),
    otherwise=(
        "At rest the motor's torque, gain times error, carries the weight of link 2. Set the two equal "
        "where link 2 is 2° below level."
    ),
    further="Half the sag needs twice the gain, and noise and flexible joints set a limit to gains.",
    hints=(
        "At rest, what does the motor of joint 2 have to carry? And how large is its torque, with the "
        "gain k and the error e?",
        "Solve gravity torque = gain times error for the gain, with the error in rad.",
    ),
)

UPRIGHT = Choice(
    id="05-upright",
    text="how large the error is upright, with strong and with weak gains",
    options=(
        Option(
            "About 10° with the strong gains and ten times as much with the weak ones, because "
            "$e_i = g_i/k_{p,i}$.",
            "You took g(q) of another place. How large is g(q) where the arm stands upright?",
        ),
        Option(
            "None with either, because $g = 0$ at the target, so that there is nothing to carry.",
            "Where g = 0 the arm can rest. Does it also come back to this place from beside it?",
        ),
        Option(
            "None with the strong gains. With the weak ones the arm falls over, because gravity pushes "
            "it away from upright harder than they pull it back.",
        ),
        Option(
            "It falls over with both, because upright is a maximum of $P$.",
            "Upright is a maximum of P, but P is not all that acts: the gains are springs. What bends "
            "the sum of P and of their energy upwards?",
        ),
    ),
    further="The strong gains outweigh the negative stiffness of gravity, and the weak ones do not.",
    hints=(
        "Near the target gravity is a spring too, with the stiffness H. Which sign has it upright?",
        "Compare, for joint 1 and joint 2, the gains with the entries of H at the upright arm.",
    ),
)

CHECKS = (LEVER, MOON, SPRING, SAG, UPRIGHT)
