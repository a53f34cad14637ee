"""The closed loops of c8: arms, goals, motions and gains for which the right controller does its work.

What the controller is not told (the payload in the hand) stays with the judge.
"""

from types import SimpleNamespace

import numpy as np

from autograder.judging.loops import Loop, loop
from autograder.problems.c8_control import law, mistakes
from autograder.problems.material import planar_2r, sampling
from autograder.problems.material.driven_arm import Sway, ToGoal, Tracking

GOAL_STEPS = 200  # 4 s
TRACKING_STEPS = 150  # 3 s
UPRIGHT = np.array([np.pi / 2, 0.0])


def known(arm) -> SimpleNamespace:
    """What an adaptive controller is told of an arm."""
    return SimpleNamespace(l1=arm.l1, l2=arm.l2, g=arm.g)


def gained(rng, arm) -> SimpleNamespace:
    """The arm with kp (N·m/rad) and kd (N·m·s/rad), (2,) each, that bring it to rest in some seconds."""
    inertia = np.diag(planar_2r.M(np.array([0.0, 1.0]), arm))
    speed = rng.uniform(3.2, 3.8)
    return planar_2r.changed(
        arm,
        kp=speed**2 * inertia * rng.uniform(1.0, 1.5, 2),
        kd=2 * speed * inertia * rng.uniform(0.9, 1.2, 2),
    )


def to_goal(rng) -> Loop:
    """To a bent q*, from a bend to the same side, so that the arm does not pass through the line."""
    arm = gained(rng, sampling.planar_2r(rng))
    side = rng.choice([-1.0, 1.0])
    q = np.array([rng.uniform(-np.pi, np.pi), side * rng.uniform(0.7, 2.2)])
    q_star = q + rng.choice([-1.0, 1.0], 2) * [rng.uniform(0.5, 1.2), 0.0]
    q_star[1] = side * rng.uniform(0.7, 2.2)
    return loop("gravity_compensation", ToGoal(arm, q, q_star, GOAL_STEPS), mistakes.to_goal)


def to_upright(rng) -> Loop:
    """To nearly upright, with a spring that is softer than gravity pulls: the torque of q* alone would
    let the arm fall."""
    arm = planar_2r.changed(sampling.planar_2r(rng), g=rng.uniform(11.0, 15.0))
    beyond = arm.m2 * arm.lc2 * arm.g
    carried = (arm.m1 * arm.lc1 + arm.m2 * arm.l1) * arm.g
    kp = 0.5 * np.array([carried + beyond, beyond]) * rng.uniform(0.8, 1.2, 2)
    kd = 1.6 * np.sqrt(kp * np.diag(planar_2r.M(np.zeros(2), arm))) * rng.uniform(0.9, 1.1, 2)
    arm = planar_2r.changed(arm, kp=kp, kd=kd)
    q_star = UPRIGHT + rng.uniform(-0.15, 0.15, 2)
    q = q_star + rng.choice([-1.0, 1.0], 2) * rng.uniform(0.25, 0.5, 2)
    return loop("gravity_compensation", ToGoal(arm, q, q_star, GOAL_STEPS), mistakes.to_goal)


def mixed(rng, n: int, most: float) -> np.ndarray:
    """A symmetric positive definite matrix near the identity, (n, n)."""
    below = np.tril(rng.uniform(-most, most, (n, n)), -1)
    return np.eye(n) + below + below.T


def tracking(rng) -> Loop:
    """A motion with a payload of which the estimates know nothing; without adaptation it goes wrong."""
    while True:
        plant = _tracking(rng)
        without = loop("slotine_li", plant, NO_ADAPTATION).right
        found = loop("slotine_li", plant, law.adaptive)
        if without[0] > 2.5 * found.right[0] and without[1] > 0.1 and found.right[1] < 0.02:
            return found


NO_ADAPTATION = law.law(rate=lambda w: np.zeros(6))


def _tracking(rng) -> Tracking:
    arm = sampling.planar_2r(rng)
    bend = rng.choice([-1.0, 1.0]) * rng.uniform(1.0, 1.6)
    wanted = Sway(
        np.array([rng.uniform(-np.pi, np.pi), bend]),
        rng.uniform(0.3, 0.6, 2),
        rng.uniform(2.0, 3.5, 2),
        rng.uniform(-np.pi, np.pi, 2),
    )
    pi = planar_2r.parameters(arm)
    Gamma = pi[:, np.newaxis] * mixed(rng, 6, 0.12) * pi
    gains = SimpleNamespace(
        Lam=3.0 * mixed(rng, 2, 0.15),
        KD=6.0 * planar_2r.M(wanted.centre, arm),
        Gamma=Gamma * (8.0**2 / _stiffness(arm, wanted, Gamma)),
    )
    return Tracking(
        arm=planar_2r.with_payload(arm, rng.uniform(0.3, 0.6) * arm.m2),
        wanted=wanted,
        off=rng.choice([-1.0, 1.0], 2) * rng.uniform(0.1, 0.25, 2),
        pi=pi,
        gains=gains,
        known=known(arm),
        steps=TRACKING_STEPS,
    )


def _stiffness(arm, wanted, Gamma) -> float:
    """The largest eigenvalue of M⁻¹ Y Γ Yᵀ along the motion, 1/s²: how fast the estimates act back."""
    largest = 0.0
    for t in np.linspace(0.0, 3.0, 7):
        at = wanted(t)
        Y = planar_2r.regressor(at.q, at.qd, at.qdd, arm)
        rates = np.linalg.eigvals(np.linalg.solve(planar_2r.M(at.q, arm), Y @ Gamma @ Y.T))
        largest = max(largest, float(np.max(rates.real)))
    return largest
