"""p3-pendulum: a manipulator with one degree of freedom, from its Lagrangian to its matrices.

The references are one line each, and stand here rather than come from `armdyn`, so that the two can
be held against each other in a test.
"""

from math import cos, sin, sqrt

import numpy as np

from autograder import sampling
from autograder.wall import Symbol
from autograder.judge import Check, Criterion
from autograder.mistakes import p3_pendulum as mistakes
from autograder.quantities import UnfitError, each
from autograder.wall import Call

LAGRANGIAN_ARGUMENTS = ("q", "qd", "m", "lc", "I", "g")


def _position_calls(name):
    def calls(rng, count):
        return [Call(name, (sampling.angle(rng), sampling.pendulum(rng))) for _ in range(count)]

    return calls


def _coriolis_calls(rng, count):
    return [
        Call("C", (sampling.angle(rng), sampling.velocity(rng), sampling.pendulum(rng)))
        for _ in range(count)
    ]


def _lagrangian_calls(rng, count):
    """Each pendulum at rest hanging, at rest elsewhere, and moving there: three points a call."""
    symbols = tuple(Symbol(name) for name in LAGRANGIAN_ARGUMENTS)
    calls = []
    for _ in range(count):
        pend = vars(sampling.pendulum(rng))
        q, qd = float(sampling.angle(rng)[0]), float(sampling.velocity(rng)[0])
        states = ((0.0, 0.0), (q, 0.0), (q, qd))
        points = tuple({"q": at, "qd": rate, **pend} for at, rate in states)
        calls.append(Call("lagrangian", symbols, points))
    return calls


@each
def _lagrangian_parts(call, value):
    """The change of L with q̇, and with q: a constant in P, which no equation of motion sees, is free."""
    if value.shape != (3,):
        raise UnfitError(f"an expression of shape {value.shape[1:]}; L is one number")
    hanging, at_rest, moving = value
    return (np.array(moving - at_rest), np.array(at_rest - hanging))


def _inertia_calls(rng, count):
    return [
        Call("inertia_about_pivot", tuple(rng.uniform((0.05, 0.5, 0.2), (0.5, 3.0, 0.9)).tolist()))
        for _ in range(count)
    ]


def _frequency_calls(rng, count):
    return [Call("small_angle_frequency", (sampling.pendulum(rng),)) for _ in range(count)]


CHECKS = (
    Check(
        id="p3-lagrangian",
        signature="lagrangian(q, qd, m, lc, I, g)",
        reference=lambda q, qd, m, lc, I, g: 0.5 * I * qd**2 - m * g * lc * (1 - cos(q)),
        calls=_lagrangian_calls,
        quantities=_lagrangian_parts,
        criteria=(
            Criterion("kinetic part of L", "J", 0.5),
            Criterion("potential part of L", "J", 0.5),
        ),
        mistakes=mistakes.LAGRANGIAN,
    ),
    Check(
        id="p3-M",
        signature="M(q, pend)",
        reference=lambda q, pend: pend.I,
        calls=_position_calls("M"),
        criteria=(Criterion("inertia about the pivot", "kg·m²"),),
        mistakes=mistakes.INERTIA,
    ),
    Check(
        id="p3-C",
        signature="C(q, qd, pend)",
        reference=lambda q, qd, pend: 0.0,
        calls=_coriolis_calls,
        criteria=(
            Criterion(
                "Coriolis matrix of one joint",
                "kg·m²/s",
                otherwise="Your C is not zero. Every entry of C is made of derivatives of M with "
                "respect to q: how does this M change with q?",
            ),
        ),
        mistakes=mistakes.CORIOLIS,
    ),
    Check(
        id="p3-g_vec",
        signature="g_vec(q, pend)",
        reference=lambda q, pend: pend.m * pend.g * pend.lc * sin(q[0]),
        calls=_position_calls("g_vec"),
        criteria=(Criterion("gravity torque", "N·m"),),
        mistakes=mistakes.GRAVITY,
    ),
    Check(
        id="p3-inertia_about_pivot",
        signature="inertia_about_pivot(I_com, m, lc)",
        reference=lambda I_com, m, lc: I_com + m * lc**2,
        calls=_inertia_calls,
        criteria=(Criterion("inertia moved to the pivot", "kg·m²"),),
        mistakes=mistakes.INERTIA_ABOUT_PIVOT,
    ),
    Check(
        id="p3-small_angle_frequency",
        signature="small_angle_frequency(pend)",
        reference=lambda pend: sqrt(pend.m * pend.g * pend.lc / pend.I),
        calls=_frequency_calls,
        criteria=(Criterion("angular frequency of small swings", "rad/s"),),
        mistakes=mistakes.SMALL_ANGLE_FREQUENCY,
    ),
)
