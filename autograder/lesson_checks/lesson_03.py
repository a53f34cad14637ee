"""The checks of lesson 03, the inertia matrix."""

import numpy as np

from autograder.judging.check import Check, Criterion
from autograder.judging.diagnosis import Mistake
from autograder.judging.quantities import array, each
from autograder.lesson_checks.choice import Choice, Option
from autograder.lesson_checks.number import Number, WrongNumber
from autograder.protocol import Call

# By the numbers of the lesson's list: where a student shows each goal.
GOALS = {
    1: ("03-energy",),
    2: ("p1-inertia_from_links", "p1-M", "03-turned"),
    3: ("p1-singular_arm", "p1-proof", "03-hand"),
    4: ("p1-is_spd",),
    5: ("03-ellipse", "03-brake"),
}

# A body in the plane: kg, kg·m² about the centre of mass, m from the joint to it, along x; the joint's
# velocity along y, m/s, and the angular velocity, rad/s.
MASS, I_C, C, V, OMEGA = 2.0, 0.1, 0.3, 1.0, 2.0
# What the blocks of the spatial inertia give, J.
SLIDING, TURNING, STEINER = MASS * V**2 / 2, I_C * OMEGA**2 / 2, MASS * C**2 * OMEGA**2 / 2
COUPLING = MASS * C * OMEGA * V

ENERGY = Number(
    id="03-energy",
    text="the kinetic energy of the link",
    unit="J",
    right=SLIDING + TURNING + STEINER + COUPLING,
    wrong=(
        WrongNumber(
            "no coupling",
            SLIDING + TURNING + STEINER,
            "You left out the blocks that couple turning and sliding. When do they vanish, and is "
            "that so here?",
        ),
        WrongNumber(
            "coupling once",
            SLIDING + TURNING + STEINER + COUPLING / 2,
            "You took one of the two coupling blocks. The spatial inertia has one on either side "
            "of its diagonal.",
        ),
        WrongNumber(
            "no Steiner",
            SLIDING + TURNING + COUPLING,
            "You put the inertia about the centre of mass beside blocks that belong to the joint. "
            "Which inertia stands in the upper left there?",
        ),
        WrongNumber(
            "the joint as the centre of mass",
            SLIDING + TURNING,
            "You let the centre of mass move as the joint does. How fast is it, 0.3 m away?",
        ),
        WrongNumber(
            "Steiner twice",
            SLIDING + TURNING + 2 * STEINER + COUPLING,
            "You took the velocity of the centre of mass and the inertia about the joint. What "
            "belongs to one point, and what to the other?",
        ),
        WrongNumber(
            "minus",
            SLIDING + TURNING + STEINER - COUPLING,
            "You subtracted the two velocities. The link turns counter-clockwise: which way does "
            "that move a point to the right of the joint?",
        ),
        WrongNumber(
            "no turning",
            SLIDING + STEINER + COUPLING,
            "This is the energy of a point mass in the centre of mass. What else does this link "
            "do?",
        ),
        WrongNumber(
            "without the half",
            2 * (SLIDING + TURNING + STEINER + COUPLING),
            "This is twice the energy. Which factor stands before the product?",
        ),
    ),
    otherwise=(
        "This is not the energy of that motion. How fast does the centre of mass move, and how "
        "fast does the link turn about it?"
    ),
    further="About the centre of mass it is a sum of two terms, about the joint of four: one number.",
    hints=(
        "Choose the point: about the joint with all blocks of the spatial inertia, or about the "
        "centre of mass with its own velocity.",
        "The velocity of the centre of mass is v + ω × c. In the plane, turning by ω moves a point "
        "at the distance x to the right upwards, at ω x.",
    ),
)


def _rotations(rng, count):
    calls = []
    for _ in range(count):
        R, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        R *= np.linalg.det(R)  # a rotation and no reflection
        places = rng.normal(size=(6, 3))
        places -= np.mean(places, axis=0)
        I_link = np.sum(places**2) * np.eye(3) - places.T @ places
        calls.append(Call("my_turned", (R, I_link)))
    return calls


@each
def _matrices(call, value):
    return (array(value, 3, 3),)


ONE_SIDE = (
    "You turned one side. In the energy an angular velocity stands on either side of the inertia: "
    "does your matrix stay symmetric?"
)
ENTRY_BY_ENTRY = "In NumPy `*` multiplies entry by entry. Which sign multiplies matrices?"
TURNED = Check(
    id="03-turned",
    signature="my_turned(R, I_link)",
    reference=lambda R, I_link: R @ I_link @ R.T,
    calls=_rotations,
    quantities=_matrices,
    criteria=(Criterion("the inertia along the axes of the world", "kg·m²"),),
    mistakes=(
        Mistake(
            "not turned",
            lambda R, I_link: I_link,
            "This is the inertia of the data sheet. Its numbers belong to the axes of the link: is "
            "the energy right if the angular velocity comes along the world's?",
        ),
        Mistake(
            "the other way",
            lambda R, I_link: R.T @ I_link @ R,
            "You turned the other way. R takes a vector from the axes of the link to those of the "
            "world: what takes it back?",
        ),
        Mistake("left alone", lambda R, I_link: R @ I_link, ONE_SIDE),
        Mistake("right alone", lambda R, I_link: I_link @ R.T, ONE_SIDE),
        Mistake("left alone, back", lambda R, I_link: R.T @ I_link, ONE_SIDE),
        Mistake("right alone, back", lambda R, I_link: I_link @ R, ONE_SIDE),
        Mistake(
            "no transpose",
            lambda R, I_link: R @ I_link @ R,
            "You turned both sides in the same way. On the left of the inertia stands a row, ωᵀ, "
            "and on the right a column: what turns a row?",
        ),
        Mistake("entry by entry", lambda R, I_link: R * I_link * R.T, ENTRY_BY_ENTRY),
        Mistake("entry by entry, left", lambda R, I_link: (R * I_link) @ R.T, ENTRY_BY_ENTRY),
        Mistake("entry by entry, right", lambda R, I_link: (R @ I_link) * R.T, ENTRY_BY_ENTRY),
    ),
    hints=(
        "The energy ½ ωᵀ I ω is one number, whatever axes ω and I are written in. How does one ω "
        "follow from the other?",
        "Write ω_link with ω_world and put it into the energy. What stands between ω_worldᵀ and "
        "ω_world?",
    ),
    further="The same holds for all six rows, with R twice on a diagonal: the trap that comes next.",
)

HAND = Choice(
    id="03-hand",
    text="of which of the two arms M is singular",
    options=(
        Option(
            "Of (i): there the Jacobian of the hand has rank 1, and $M$ is made of Jacobians.",
            "M is made of the Jacobians of the links, with masses. Is there a motion of the "
            "stretched arm in which no link moves?",
        ),
        Option(
            "Of (ii): its joints can move while the hand rests, so some $\\dot q \\ne 0$ costs "
            "nothing.",
            "The hand rests, but what of the elbow? Which bodies are counted in K?",
        ),
        Option(
            "Of neither: a hand that stands still or cannot go one way does not keep the links "
            "from moving, and links have mass.",
        ),
        Option(
            "Of both: for each there is a $\\dot q \\ne 0$ that the Jacobian of the hand takes to "
            "zero.",
            "There is such a velocity for each, true. But is its kinetic energy zero?",
        ),
    ),
    further=(
        "In a singular configuration it is the hand that cannot go one way. The joints can be "
        "accelerated."
    ),
    hints=(
        "When is M singular at some q? The first lines of section 3 say it in one sentence.",
        "In (ii), hold the hand where it is and let the elbow swing. What moves, and what does it "
        "weigh?",
    ),
)

# The half-axes of an ellipse of 1 J, rad/s.
LONG, SHORT = 2.5, 0.4

ELLIPSE = Number(
    id="03-ellipse",
    text="the largest eigenvalue of M",
    unit="kg·m²",
    right=2 / SHORT**2,
    wrong=(
        WrongNumber(
            "the smallest",
            2 / LONG**2,
            "This is the smallest eigenvalue. Is the ellipse long where much inertia resists, or "
            "where little does?",
        ),
        WrongNumber(
            "without the half of K",
            1 / SHORT**2,
            "Put your eigenvalue and the half-axis into K: is it 1 J?",
        ),
        WrongNumber(
            "the smallest, without the half of K",
            1 / LONG**2,
            "You took the longer half-axis, where little inertia resists; and K would not be 1 J "
            "there.",
        ),
        WrongNumber(
            "not squared",
            2 / SHORT,
            "In K the velocity is squared. Solve it once more for the eigenvalue.",
        ),
        WrongNumber(
            "upside down",
            SHORT**2 / 2,
            "You divided the wrong way round. Much inertia, short half-axis.",
        ),
        WrongNumber(
            "half-axis",
            SHORT,
            "This is a half-axis, a velocity. With which inertia does a motion of that velocity "
            "carry 1 J?",
        ),
    ),
    otherwise=(
        "This inertia does not give 1 J on either half-axis. Put a half-axis into K = ½ λ s², and "
        "solve it for λ."
    ),
    further="Along this direction the arm is as heavy to turn as it can be in this posture.",
    hints=(
        "Along an eigenvector K is ½ λ s², and a half-axis is the s at which it is 1 J.",
        "Which of the two half-axes belongs to the largest eigenvalue?",
    ),
)

BRAKE = Choice(
    id="03-brake",
    text="in which case joint 1 starts faster, and by what factor",
    options=(
        Option(
            "In the first, by a factor below 1.5: the brake makes the arm one body, while a free "
            "link 2 takes away part of the torque.",
            "For the same velocity of joint 1, which motion carries less energy: the one with "
            "joint 2 held, or the one that is best for joint 1?",
        ),
        Option(
            "In the second, by a factor of 1.7: link 2 is free, so it counts as a point mass in "
            "the elbow.",
            "The elbow pushes link 2 at its end, and link 2 gives way and turns. Does it then "
            "resist with its whole mass?",
        ),
        Option(
            "In the second, by a factor of 1.8: the stretched ellipse reaches 1.15 rad/s to the "
            "right and cuts the axis at 0.63 rad/s.",
            "These are the right two readings. How does the inertia that is felt go into such a "
            "velocity: as it is, or as a root?",
        ),
        Option(
            "In the second, by a factor above 3: the motor feels $1/(M^{-1})_{11}$ and not "
            "$M_{11}$, and these go with the squares of the two readings.",
        ),
    ),
    further="So the inertia that one motor feels depends on what the other joints are free to do.",
    hints=(
        "What does q̈ = M⁻¹ u give for joint 1 if u = (1, 0)? And the first row of M q̈ = u if q̈2 "
        "= 0?",
        "Look at the ellipse of the stretched arm: how far does it reach to the right, and where "
        "does it cut the axis? Each reading is a root.",
    ),
)

CHECKS = (ENERGY, TURNED, HAND, ELLIPSE, BRAKE)
