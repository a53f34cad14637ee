"""The checks of lesson 01, the canonical form."""

from math import pi, sin, sqrt

from autograder.lesson_checks.arm import ARM
from autograder.lesson_checks.choice import Choice, Option
from autograder.lesson_checks.number import Number, WrongNumber

# By the numbers of the lesson's list: where a student shows each goal.
GOALS = {
    1: ("01-bead",),
    2: ("p3-lagrangian", "p3-g_vec", "p3-derivation"),
    3: ("01-twice", "01-swing"),
    4: ("01-ring", "01-program"),
}

# A bead of 0.5 kg on a wire that turns at 4 rad/s, 0.3 m from the axis, moving out at 2 m/s.
MASS, TURN, OUT, SPEED = 0.5, 4.0, 0.3, 2.0
BEAD = Number(
    id="01-bead",
    text="the force along the wire",
    unit="N",
    right=-MASS * TURN**2 * OUT,
    wrong=(
        WrongNumber(
            "sign",
            MASS * TURN**2 * OUT,
            "The size is right. Which sign has the second term of the Euler–Lagrange equation? "
            "Without a force, which way would the bead go?",
        ),
        WrongNumber(
            "halved",
            -MASS * TURN**2 * OUT / 2,
            "This is half of it. What becomes of the ½ when a square is differentiated?",
        ),
        WrongNumber(
            "doubled",
            -MASS * TURN**2 * OUT * 2,
            "This is twice as much: either the mass is missing, or the ½ of K.",
        ),
        WrongNumber(
            "turn not squared",
            -MASS * TURN * OUT,
            "The wire's rate enters K with a square.",
        ),
        WrongNumber(
            "velocity for place",
            -MASS * TURN**2 * SPEED,
            "You put the velocity where the place belongs. By what is K differentiated in the "
            "second term?",
        ),
        WrongNumber(
            "nothing",
            0.0,
            "Nothing accelerates along the wire, but K holds q as well as q̇. Which term of the "
            "Euler–Lagrange equation sees that?",
        ),
        WrongNumber(
            "place left out",
            -MASS * TURN**2,
            "Your force is the same everywhere on the wire. Differentiate the square of q once "
            "more.",
        ),
    ),
    otherwise=(
        "Write down L with P = 0, then the two terms of the Euler–Lagrange equation: the first has "
        "only q̈ in it, the second only q. Then put the numbers in."
    ),
    further=(
        "Without this force the bead is thrown outwards. Wherever K changes with q there is such a "
        "term: in an arm it is a centrifugal torque."
    ),
    hints=(
        "First the derivative of L by q̇, then its time derivative. What is left of it where q̈ = 0?",
        "K depends on q, too. Take its derivative by q, with q̇ held, and mind the minus before it.",
    ),
)

# C q̇ of joint 1 in the picture: h (2 q̇1 q̇2 + q̇2²) at q2 = 45°, q̇ = (2, 3).
SHOWN = -ARM.m2 * ARM.l1 * ARM.lc2 * sin(pi / 4) * (2 * 2 * 3 + 3**2)
TWICE = Number(
    id="01-twice",
    text="C q̇ of joint 1, backwards and twice as fast",
    unit="N·m",
    right=4 * SHOWN,
    wrong=(
        WrongNumber(
            "sign",
            -4 * SHOWN,
            "The size is right. Does a product of two velocities change its sign when both of them "
            "do?",
        ),
        WrongNumber(
            "doubled",
            2 * SHOWN,
            "You doubled it. The velocities are in it twice: in the matrix C, and beside it.",
        ),
        WrongNumber(
            "doubled and turned",
            -2 * SHOWN,
            "You treated it as a velocity. How many velocities are in each of its products?",
        ),
        WrongNumber(
            "the same",
            SHOWN,
            "You left it as it was, as if it depended on the pose alone. Which term does?",
        ),
        WrongNumber(
            "turned",
            -SHOWN,
            "You changed its sign only. Look up in the table how it depends on the velocities.",
        ),
        WrongNumber(
            "cubed",
            8 * SHOWN,
            "This grows with the third power of the speed. Look up in the table how it depends on "
            "the velocities.",
        ),
    ),
    otherwise="Multiply the bar of the picture by one factor. Which one, and with which sign?",
    further=(
        "A motion and the same motion backwards need the same C q̇. Friction is the term that "
        "knows which way the arm goes."
    ),
    hints=(
        "No formula for C is needed. What does the table say that this term is in the velocities?",
        "Each of its parts is a number times a product of two velocities. What becomes of such a "
        "product here?",
    ),
)

SWING = Choice(
    id="01-swing",
    text="which motor has to give a torque, and why",
    options=(
        Option(
            "Neither, because no joint accelerates and $g = 0$.",
            "The first and the third term are zero, and there is no friction. What about the "
            "second one?",
        ),
        Option(
            "Motor 1 alone, a positive torque: it keeps the arm turning.",
            "Motor 1 would then give power all the time. Where would that go, without friction and "
            "at a kinetic energy that stays the same?",
        ),
        Option(
            "Motor 2 alone, a positive torque: it holds link 2 back from swinging outwards.",
        ),
        Option(
            "Motor 2 alone, a negative torque: it pushes against the turning of joint 1.",
            "It is motor 2. But which way does link 2 go if the motor lets go of it, and which way "
            "has the motor to turn it then?",
        ),
        Option(
            "Both, because an inertia matrix that is not diagonal couples the joints.",
            "That coupling multiplies accelerations. Are there any?",
        ),
    ),
    further="It is the pull with which you hold a bucket that you swing around: no power goes into it.",
    hints=(
        "Which of the four terms are zero here? Think of the bead on the turning wire for what is "
        "left.",
        "Imagine that joint 2 is loose. Where does link 2 swing to while joint 1 turns?",
    ),
)

RING = Number(
    id="01-ring",
    text="the wrong frequency divided by the right one",
    unit="",
    right=sqrt(2),
    wrong=(
        WrongNumber(
            "not rooted",
            2.0,
            "This is the rod's factor, and it is the ratio of the ring's two inertias. How does an "
            "inertia enter a frequency?",
        ),
        WrongNumber(
            "upside down",
            1 / sqrt(2),
            "You have the ratio upside down. Does a body swing more slowly with a smaller inertia?",
        ),
        WrongNumber(
            "upside down, not rooted",
            0.5,
            "You divided the two inertias. How does an inertia enter a frequency, and does a "
            "smaller one make it fall?",
        ),
        WrongNumber(
            "no difference",
            1.0,
            "Your two frequencies are the same. How far is the nail from the ring's centre of mass?",
        ),
        WrongNumber(
            "accelerations of the rod",
            4.0,
            "This is the rod's factor of its accelerations. The ring has its mass elsewhere, and "
            "the frequencies are asked for.",
        ),
    ),
    otherwise=(
        "Find both inertias first: about the ring's centre, and about the nail. Then put both into "
        "the frequency."
    ),
    further="So a stopwatch tells the two inertias apart, and the size of the factor tells the body.",
    hints=(
        "All the mass of the ring is at the same distance from its centre. How large is its "
        "inertia about the centre, and how far away is the nail?",
        "The frequency goes with one over the square root of the inertia.",
    ),
)

PROGRAM = Choice(
    id="01-program",
    text="what is wrong with the program, and how you know",
    options=(
        Option(
            "The sign of $P$: all gravity torques come out reversed.",
            "Turn the signs of the right torques around. What would the program say of the hanging "
            "arm?",
        ),
        Option(
            "The zero of the angle: the program counts $q_1$ from hanging down.",
        ),
        Option(
            "The inertia: it is taken about the centres of mass, and not about the joints.",
            "The arm is at rest in both poses. Which term has the inertia in it, and what is it "
            "then?",
        ),
        Option(
            "Nothing: the program only has another constant in its $P$.",
            "A constant in P has no slope, so no torque shows it. Are these the torques of our arm?",
        ),
    ),
    further="Two poses are enough to see it: one where the arm rests by itself, and the level one.",
    hints=(
        "What are the right torques in both poses? One of the two is printed above.",
        "For each of the four: what would it do to the torques of the arm that hangs at rest?",
    ),
)

CHECKS = (BEAD, TWICE, SWING, RING, PROGRAM)
