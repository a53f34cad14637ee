"""Mistakes about the pendulum."""

from math import cos, degrees, pi, radians, sin, sqrt

import numpy as np

from autograder.judging.diagnosis import Mistake

ALREADY_ABOUT_THE_PIVOT = (
    "The inertia you use is too large by m ℓc²: pend.I is about the pivot already. Where has the "
    "parallel-axis theorem been applied once too often?"
)
INERTIA = (
    Mistake(
        "parallel axis applied again",
        lambda q, pend: pend.I + pend.m * pend.lc**2,
        ALREADY_ABOUT_THE_PIVOT,
    ),
    Mistake(
        "inertia about the centre of mass",
        lambda q, pend: pend.I - pend.m * pend.lc**2,
        "This is the inertia about the centre of mass. The pendulum turns about its pivot: about "
        "which point must the inertia in K = ½ M q̇² be taken?",
    ),
    Mistake(
        "point mass",
        lambda q, pend: pend.m * pend.lc**2,
        "This is the inertia of a point mass at the centre of mass. The body has a size: which "
        "parameter of pend tells how its mass is spread?",
    ),
    Mistake(
        "inverse for matrix",
        lambda q, pend: 1 / pend.I,
        "This is the inverse of the inertia. Which of M and M⁻¹ multiplies q̈ in the equation?",
    ),
    Mistake(
        "mass for inertia",
        lambda q, pend: pend.m,
        "This is the mass. The coordinate is an angle: what resists an angular acceleration?",
    ),
)

CORIOLIS = (
    Mistake(
        "gravity in C",
        lambda q, qd, pend: pend.m * pend.g * pend.lc * sin(q[0]),
        "This is the gravity torque. Gravity does not depend on q̇: where does it belong in the "
        "equation of motion?",
    ),
    Mistake(
        "inertia for C",
        lambda q, qd, pend: pend.I,
        "This is the inertia. It multiplies q̈; C multiplies q̇ and comes from how M changes with q.",
    ),
    Mistake(
        "point-mass centrifugal term",
        lambda q, qd, pend: pend.m * pend.lc * qd[0],
        "C is not zero here, but proportional to m ℓc q̇. The centripetal force points at the "
        "pivot: what is its torque about the pivot?",
    ),
    Mistake(
        "M times velocity",
        lambda q, qd, pend: pend.I * qd[0],
        "C is not zero here, but M q̇, the angular momentum. C comes from ∂M/∂q: does this M change "
        "with q?",
    ),
)

GRAVITY = (
    Mistake(
        "sign of gravity",
        lambda q, pend: -pend.m * pend.g * pend.lc * sin(q[0]),
        "Your gravity torque has the wrong sign: it pushes the pendulum away from hanging. Is q "
        "measured from hanging down, and is g on the left of the equation?",
    ),
    Mistake(
        "cosine for sine",
        lambda q, pend: pend.m * pend.g * pend.lc * cos(q[0]),
        "You have the cosine of q where the sine belongs: hanging straight down (q = 0) your "
        "pendulum feels its largest torque. From which direction is q measured?",
    ),
    Mistake(
        "cosine for sine, reversed",
        lambda q, pend: -pend.m * pend.g * pend.lc * cos(q[0]),
        "Your torque varies as −cos q, as if q were measured from the horizontal. From which "
        "direction is q measured here, and where must the torque vanish?",
    ),
    Mistake(
        "radians taken for degrees",
        lambda q, pend: pend.m * pend.g * pend.lc * sin(radians(q[0])),
        "The angle is turned from degrees to radians once too often: q comes in radians already.",
    ),
    Mistake(
        "angle in degrees",
        lambda q, pend: pend.m * pend.g * pend.lc * sin(degrees(q[0])),
        "The sine is taken of an angle in degrees: NumPy's sine wants radians, and q is in radians "
        "already.",
    ),
    Mistake(
        "lever arm missing",
        lambda q, pend: pend.m * pend.g * sin(q[0]),
        "This is a force, in newtons: the lever arm ℓc is missing. What turns a force into a torque?",
    ),
    Mistake(
        "gravity constant missing",
        lambda q, pend: pend.m * pend.lc * sin(q[0]),
        "The gravitational acceleration g is missing from your torque. What is the weight of m?",
    ),
    Mistake(
        "mass missing",
        lambda q, pend: pend.g * pend.lc * sin(q[0]),
        "The mass is missing from your torque. What is the weight of the body?",
    ),
    Mistake(
        "gravity constant hard-coded",
        lambda q, pend: pend.m * 9.81 * pend.lc * sin(q[0]),
        "Your torque is right on Earth only: 9.81 is written into it. The check also swings the "
        "pendulum on other planets; which parameter of pend gives g?",
    ),
    Mistake(
        "small angle",
        lambda q, pend: pend.m * pend.g * pend.lc * q[0],
        "This holds for small angles only. g(q) is asked for at any q.",
    ),
    Mistake(
        "potential energy for torque",
        lambda q, pend: pend.m * pend.g * pend.lc * (1 - cos(q[0])),
        "This is the potential energy P. What turns P(q) into the gravity torque g(q)?",
    ),
    Mistake(
        "divided by the inertia",
        lambda q, pend: pend.m * pend.g * pend.lc * sin(q[0]) / pend.I,
        "This is an acceleration: the torque has been divided by I already. In M q̈ + g = u, what "
        "does M multiply?",
    ),
)

# Lagrangians: the kinetic part and the potential part are judged and diagnosed apart.
LAGRANGIAN = (
    Mistake(
        "half missing",
        lambda q, qd, m, lc, I, g: I * qd**2 - m * g * lc * (1 - cos(q)),
        "The kinetic part of your L is twice the right one. What stands in front of a kinetic energy?",
    ),
    Mistake(
        "parallel axis applied again",
        lambda q, qd, m, lc, I, g: 0.5 * (I + m * lc**2) * qd**2 - m * g * lc * (1 - cos(q)),
        "The kinetic part of your L counts the motion of the centre of mass twice: I is about the "
        "pivot already. What does the parallel-axis theorem add, and has it been added before?",
    ),
    Mistake(
        "inertia about the centre of mass",
        lambda q, qd, m, lc, I, g: 0.5 * (I - m * lc**2) * qd**2 - m * g * lc * (1 - cos(q)),
        "The kinetic part of your L uses the inertia about the centre of mass and leaves out the "
        "motion of that centre. About which point does the body turn?",
    ),
    Mistake(
        "point mass",
        lambda q, qd, m, lc, I, g: 0.5 * m * lc**2 * qd**2 - m * g * lc * (1 - cos(q)),
        "The kinetic part of your L is that of a point mass. Which parameter tells how the mass is "
        "spread?",
    ),
    Mistake(
        "energy for Lagrangian, or P upside down",
        lambda q, qd, m, lc, I, g: 0.5 * I * qd**2 + m * g * lc * (1 - cos(q)),
        "The potential part of your L has the wrong sign. Is L the sum of K and P or their "
        "difference, and does your P grow as the pendulum rises?",
    ),
    Mistake(
        "sine for cosine",
        lambda q, qd, m, lc, I, g: 0.5 * I * qd**2 - m * g * lc * sin(q),
        "The potential part of your L varies with sin q. At what height is the centre of mass when "
        "the pendulum hangs straight down (q = 0), and at q = π/2?",
    ),
    Mistake(
        "sine for cosine, reversed",
        lambda q, qd, m, lc, I, g: 0.5 * I * qd**2 + m * g * lc * sin(q),
        "The potential part of your L varies with −sin q. At what height is the centre of mass when "
        "the pendulum hangs straight down (q = 0), and at q = π/2?",
    ),
    Mistake(
        "lever arm missing",
        lambda q, qd, m, lc, I, g: 0.5 * I * qd**2 - m * g * (1 - cos(q)),
        "The length ℓc is missing from the potential part of your L. How high does the centre of "
        "mass rise?",
    ),
    Mistake(
        "angle in degrees",
        lambda q, qd, m, lc, I, g: 0.5 * I * qd**2 - m * g * lc * (1 - cos(radians(q))),
        "The angle in the potential part of your L is turned from degrees to radians once too "
        "often: q is in radians already.",
    ),
    Mistake(
        "kinetic energy only",
        lambda q, qd, m, lc, I, g: 0.5 * I * qd**2,
        "Your L has no potential part. Which energy does the body gain as it rises?",
    ),
)

INERTIA_ABOUT_PIVOT = (
    Mistake(
        "inertia about the centre of mass",
        lambda I_com, m, lc: I_com,
        "This is the inertia about the centre of mass, as it was given. What does moving the axis "
        "from there to the pivot add?",
    ),
    Mistake(
        "parallel axis subtracted",
        lambda I_com, m, lc: I_com - m * lc**2,
        "You moved the axis the wrong way. About which of all parallel axes is the inertia smallest?",
    ),
    Mistake(
        "distance not squared",
        lambda I_com, m, lc: I_com + m * lc,
        "What you add is not an inertia: look at its unit. What power of the distance gives kg·m²?",
    ),
    Mistake(
        "point mass",
        lambda I_com, m, lc: m * lc**2,
        "This is a point mass at the centre of mass. Where does the body's own inertia enter?",
    ),
    Mistake(
        "half the parallel-axis term",
        lambda I_com, m, lc: I_com + 0.5 * m * lc**2,
        "The parallel-axis term is too small by half. The ½ belongs to a kinetic energy; does it "
        "belong to an inertia?",
    ),
)

SMALL_ANGLE_FREQUENCY = (
    Mistake(
        "point mass",
        lambda pend: sqrt(pend.g / pend.lc),
        "This is the frequency of a point mass on a string. Which inertia does this pendulum have?",
    ),
    Mistake(
        "square root missing",
        lambda pend: pend.m * pend.g * pend.lc / pend.I,
        "This is the square of the frequency: look at its unit.",
    ),
    Mistake(
        "period",
        lambda pend: 2 * pi * sqrt(pend.I / (pend.m * pend.g * pend.lc)),
        "This is the period, in seconds. The angular frequency, in rad/s, is asked for.",
    ),
    Mistake(
        "hertz",
        lambda pend: sqrt(pend.m * pend.g * pend.lc / pend.I) / (2 * pi),
        "This is the frequency in hertz (turns per second). In rad/s is asked for.",
    ),
    Mistake(
        "upside down",
        lambda pend: sqrt(pend.I / (pend.m * pend.g * pend.lc)),
        "Your ratio is upside down: does a pendulum of larger inertia swing faster or slower?",
    ),
    Mistake(
        "parallel axis applied again",
        lambda pend: np.sqrt(pend.m * pend.g * pend.lc / (pend.I + pend.m * pend.lc**2)),
        ALREADY_ABOUT_THE_PIVOT,
    ),
)
