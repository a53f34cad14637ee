"""Mistakes about the pendulum."""

from math import pi, sqrt

import numpy as np

from autograder.judging.diagnosis import Mistake
from autograder.problems.material import sentences

ALREADY_ABOUT_THE_PIVOT = (
    "Your inertia is too large by m ℓc²: pend.I is about the pivot already. Where have you "
    "applied the parallel-axis theorem once too often?"
)
INERTIA_SAID = {
    "parallel axis added / the rotation of the body / m / I": ALREADY_ABOUT_THE_PIVOT,
    "parallel axis taken off / the rotation of the body / m / I": (
        "You use the inertia about the centre of mass. The pendulum turns about its pivot: "
        "about which point must you take the inertia in K = ½ M q̇²?"
    ),
    "point mass / the rotation of the body / m / I": (
        "Your inertia is that of a point mass at the centre of mass. The body has a size: which "
        "parameter of pend tells how its mass is spread?"
    ),
    "inverse": sentences.INVERSE_OF_M,
    "mass for inertia / the rotation of the body / m / I": (
        "You return the mass. The coordinate is an angle: what resists an angular acceleration?"
    ),
}

CORIOLIS_SAID = {
    "gravity for C": (
        "You return the gravity torque. Gravity does not depend on q̇: where does it belong in "
        "the equation of motion?"
    ),
    "M": (
        "You return the inertia, which multiplies q̈. C multiplies q̇, and comes from how M "
        "changes with q."
    ),
    "momentum for C": (
        "Your C is M q̇, the angular momentum. C comes from ∂M/∂q: does this M change with q?"
    ),
}
CORIOLIS = (
    Mistake(
        "point-mass centrifugal term",
        lambda q, qd, pend: pend.m * pend.lc * qd[0],
        "Your C is proportional to m ℓc q̇, as a centripetal force is. That force points at the "
        "pivot: what is its torque about the pivot?",
    ),
)

GRAVITY_SAID = {
    "sign of the whole": (
        "Your gravity torque has the wrong sign: it pushes the pendulum away from hanging down. "
        "From which direction is q measured, and on which side of the equation does g stand?"
    ),
    "cosine for sine / the weight of the body": (
        "You have the cosine of q where the sine belongs: your pendulum feels its largest torque "
        "when it hangs straight down (q = 0). From which direction is q measured?"
    ),
    "cosine for sine / the weight of the body / −": (
        "Your torque varies as −cos q, as if q were measured from the horizontal. From which "
        "direction is q measured here, and where must the torque vanish?"
    ),
    "radians converted / the weight of the body": sentences.RADIANS_CONVERTED,
    "angle in degrees / the weight of the body": sentences.IN_DEGREES,
    "parameter left out / the weight of the body / lc": (
        "You return a force, in newtons: the lever arm ℓc is missing. What turns a force into a "
        "torque?"
    ),
    "parameter left out / the weight of the body / g": (
        "The gravitational acceleration g is missing from your torque. What is the weight of a "
        "mass m?"
    ),
    "parameter left out / the weight of the body / m": (
        "The mass is missing from your torque. What is the weight of the body?"
    ),
    "gravity of Earth / the weight of the body / 9.81 / g": (
        "Your torque is right only on Earth, because you typed 9.81 into it. The check also "
        "swings the pendulum on other planets: which parameter of pend gives g?"
    ),
    "small angle / the weight of the body": (
        "Your torque is right only for small angles. How does it vary when q is large?"
    ),
    "energy for its derivative": (
        "You return the potential energy P. What turns P(q) into the gravity torque g(q)?"
    ),
    "divided by M": (
        "You return an acceleration: you have divided the torque by I already. In M q̈ + g = u, "
        "what does M multiply?"
    ),
}

# Lagrangians: the kinetic part and the potential part are judged and diagnosed apart.
LAGRANGIAN_SAID = {
    "½ of K missing": (
        "The kinetic part of your L is twice the right one. Which factor belongs in front of a "
        "kinetic energy?"
    ),
    "parallel axis added / the rotation of the body / m / I": (
        "The kinetic part of your L counts the motion of the centre of mass twice: I is about "
        "the pivot already. What does the parallel-axis theorem add, and does I hold that "
        "already?"
    ),
    "parallel axis taken off / the rotation of the body / m / I": (
        "The kinetic part of your L uses the inertia about the centre of mass and leaves out "
        "the motion of that centre. About which point does the body turn?"
    ),
    "point mass / the rotation of the body / m / I": (
        "The kinetic part of your L is that of a point mass. Which parameter tells how the mass "
        "is spread?"
    ),
    "energy for L": (
        "The potential part of your L has the wrong sign. Is L the sum of K and P or their "
        "difference, and does your P grow as the pendulum rises?"
    ),
    "sine for cosine / the weight of the body / −": (
        "The potential part of your L varies with sin q. At what height is the centre of mass "
        "when the pendulum hangs straight down (q = 0), and at q = π/2?"
    ),
    "sine for cosine / the weight of the body": (
        "The potential part of your L varies with −sin q. At what height is the centre of mass "
        "when the pendulum hangs straight down (q = 0), and at q = π/2?"
    ),
    "parameter left out / the weight of the body / lc": (
        "The length ℓc is missing from the potential part of your L. How high does the centre "
        "of mass rise?"
    ),
    "radians converted / the weight of the body": (
        "In the potential part of your L you convert the angle from degrees to radians, but q "
        "is in radians already."
    ),
    "P missing": ("Your L has no potential part. Which energy does the body gain as it rises?"),
}

INERTIA_ABOUT_PIVOT = (
    Mistake(
        "inertia about the centre of mass",
        lambda I_com, m, lc: I_com,
        "You return the inertia about the centre of mass, as it was given. What must you add when "
        "you move the axis from there to the pivot?",
    ),
    Mistake(
        "parallel axis subtracted",
        lambda I_com, m, lc: I_com - m * lc**2,
        "You moved the axis the wrong way. About which of all parallel axes is the inertia smallest?",
    ),
    Mistake(
        "distance not squared",
        lambda I_com, m, lc: I_com + m * lc,
        "What you add is not an inertia: look at its unit. Which power of the distance gives "
        "kg·m²?",
    ),
    Mistake(
        "point mass",
        lambda I_com, m, lc: m * lc**2,
        "Your inertia is that of a point mass at the centre of mass. Where does the body's own "
        "inertia enter?",
    ),
    Mistake(
        "half the parallel-axis term",
        lambda I_com, m, lc: I_com + 0.5 * m * lc**2,
        "Your parallel-axis term is half of what it should be. A ½ belongs to a kinetic energy: "
        "does it belong to an inertia?",
    ),
)

SMALL_ANGLE_FREQUENCY = (
    Mistake(
        "point mass",
        lambda pend: sqrt(pend.g / pend.lc),
        "Your frequency is that of a point mass on a string. Which inertia does this pendulum "
        "have?",
    ),
    Mistake(
        "square root missing",
        lambda pend: pend.m * pend.g * pend.lc / pend.I,
        "You return the square of the frequency. Look at its unit.",
    ),
    Mistake(
        "period",
        lambda pend: 2 * pi * sqrt(pend.I / (pend.m * pend.g * pend.lc)),
        "You return the period, in seconds. The question asks for the angular frequency, in rad/s.",
    ),
    Mistake(
        "hertz",
        lambda pend: sqrt(pend.m * pend.g * pend.lc / pend.I) / (2 * pi),
        "You return the frequency in hertz, in turns per second. How many radians are there in a "
        "turn?",
    ),
    Mistake(
        "upside down",
        lambda pend: sqrt(pend.I / (pend.m * pend.g * pend.lc)),
        "Your ratio is upside down: does a pendulum with a larger inertia swing faster or slower?",
    ),
    Mistake(
        "parallel axis applied again",
        lambda pend: np.sqrt(pend.m * pend.g * pend.lc / (pend.I + pend.m * pend.lc**2)),
        ALREADY_ABOUT_THE_PIVOT,
    ),
)
