"""The planar 2R arm of the problems, term by term: what references and wrong models are made of.

Spong, Hutchinson & Vidyasagar 2006, Robot Modeling and Control, section 7.3, in this course's
notation. The formulas stand here rather than come from `armdyn`, so that a test can hold the two
against each other. q, qd: (2,), rad and rad/s. arm: a namespace with l1, l2, lc1, lc2 (m), m1, m2 (kg),
I1, I2 about the centres of mass (kg·m²) and g (m/s²).
"""

from types import SimpleNamespace

import numpy as np


def inertia(arm, coupling: float) -> np.ndarray:
    """M from the coupling m2 ℓ1 ℓc2 times what stands for cos q2; (2, 2), kg·m²."""
    M22 = arm.I2 + arm.m2 * arm.lc2**2
    M12 = M22 + coupling
    M11 = arm.I1 + arm.m1 * arm.lc1**2 + M22 + arm.m2 * arm.l1**2 + 2 * coupling
    return np.array([[M11, M12], [M12, M22]])


def M(q, arm) -> np.ndarray:
    """Inertia matrix, (2, 2), kg·m²."""
    return inertia(arm, arm.m2 * arm.l1 * arm.lc2 * np.cos(q[1]))


def h(q, arm) -> float:
    """The one Christoffel symbol that the others repeat, kg·m²."""
    return -arm.m2 * arm.l1 * arm.lc2 * np.sin(q[1])


def C(q, qd, arm) -> np.ndarray:
    """Coriolis and centrifugal matrix in Christoffel form, (2, 2), kg·m²/s."""
    return h(q, arm) * np.array([[qd[1], qd[0] + qd[1]], [-qd[0], 0.0]])


def M_dot(q, qd, arm) -> np.ndarray:
    """dM/dt along q̇, (2, 2), kg·m²/s."""
    return h(q, arm) * qd[1] * np.array([[2.0, 1.0], [1.0, 0.0]])


def potential_energy(q, arm) -> float:
    """P, J; zero where the arm lies along x."""
    height_1 = arm.lc1 * np.sin(q[0])
    height_2 = arm.l1 * np.sin(q[0]) + arm.lc2 * np.sin(q[0] + q[1])
    return arm.g * (arm.m1 * height_1 + arm.m2 * height_2)


def g_vec(q, arm) -> np.ndarray:
    """Gravity vector ∂P/∂q, (2,), N·m."""
    g2 = arm.m2 * arm.lc2 * arm.g * np.cos(q[0] + q[1])
    return np.array([(arm.m1 * arm.lc1 + arm.m2 * arm.l1) * arm.g * np.cos(q[0]) + g2, g2])


def f_vec(qd, arm) -> np.ndarray:
    """Friction torque, (2,), N·m: viscous and Coulomb."""
    return arm.viscous * qd + arm.coulomb * np.sign(qd)


def kinetic_energy(q, qd, arm) -> float:
    """K, J."""
    return 0.5 * qd @ M(q, arm) @ qd


def joints(q, arm) -> list[tuple[float, float]]:
    """Shoulder, elbow and hand, (x, y) in m, to be drawn."""
    elbow = arm.l1 * np.array([np.cos(q[0]), np.sin(q[0])])
    hand = elbow + arm.l2 * np.array([np.cos(q[0] + q[1]), np.sin(q[0] + q[1])])
    return [(0.0, 0.0), tuple(elbow), tuple(hand)]


def changed(arm, **parameters) -> SimpleNamespace:
    """The same arm with some parameters replaced: a wrong arm for a wrong model."""
    return SimpleNamespace(**vars(arm) | parameters)


def regressor(q, qd, qdd, arm, qd_r=None) -> np.ndarray:
    """Y with M q̈ + C q̇ + g = Y π for π of `parameters`, (..., 2, 6); q, qd, qdd: (..., 2).

    qd_r: (..., 2), a velocity that takes the place of q̇ behind the Christoffel C, and nowhere else.
    Of the arm only l1 and g enter. Atkeson, An & Hollerbach 1986, Estimation of Inertial Parameters
    of Manipulator Loads and Links; with qd_r, Slotine & Li 1987, On the Adaptive Control of Robot
    Manipulators.
    """
    qd_r = qd if qd_r is None else qd_r
    q1, q2, qd1, qd2 = q[..., 0], q[..., 1], qd[..., 0], qd[..., 1]
    r1, r2, qdd1, qdd2 = qd_r[..., 0], qd_r[..., 1], qdd[..., 0], qdd[..., 1]
    weight_2 = arm.g * np.cos(q1 + q2)
    products = qd2 * r1 + (qd1 + qd2) * r2
    swing = np.cos(q2) * (2 * qdd1 + qdd2) - np.sin(q2) * products
    Y = np.zeros((*np.shape(q), 6))
    Y[..., 0, 1] = arm.g * np.cos(q1)
    Y[..., 0, 2] = qdd1
    Y[..., 0, 3] = arm.l1**2 * qdd1 + arm.l1 * arm.g * np.cos(q1)
    Y[..., 0, 4] = arm.l1 * swing + weight_2
    Y[..., 1, 4] = arm.l1 * (np.cos(q2) * qdd1 + np.sin(q2) * qd1 * r1) + weight_2
    Y[..., 0, 5] = Y[..., 1, 5] = qdd1 + qdd2
    return Y


def parameters(arm) -> np.ndarray:
    """π, (6,): for each link its mass, kg, first moment m ℓc, kg·m, inertia about its joint, kg·m²."""
    first_1, first_2 = arm.m1 * arm.lc1, arm.m2 * arm.lc2
    about_joints = arm.I1 + first_1 * arm.lc1, arm.I2 + first_2 * arm.lc2
    return np.array([arm.m1, first_1, about_joints[0], arm.m2, first_2, about_joints[1]])


def with_payload(arm, mass: float) -> SimpleNamespace:
    """The arm with a point mass, kg, in its hand, which is a part of link 2 then."""
    m2 = arm.m2 + mass
    lc2 = (arm.m2 * arm.lc2 + mass * arm.l2) / m2
    I2 = arm.I2 + arm.m2 * (lc2 - arm.lc2) ** 2 + mass * (arm.l2 - lc2) ** 2
    return changed(arm, m2=m2, lc2=lc2, I2=I2)


# The columns of Y that are kept where only base parameters are asked for.
BASE_COLUMNS = (1, 2, 4, 5)


def base_parameters(arm) -> np.ndarray:
    """β with Y π = Y[:, BASE_COLUMNS] β, (4,), kg·m and kg·m² in turn: what torques show of π."""
    m2 = arm.m2
    return parameters(arm)[[*BASE_COLUMNS]] + [m2 * arm.l1, m2 * arm.l1**2, 0.0, 0.0]
