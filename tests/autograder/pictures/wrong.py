"""Wrong answers of each kind that the pictures show, as students write them."""

import numpy as np

from autograder.judging.check import VISIBLE_CASES
from autograder.pictures.motion import Comparison, compared
from autograder.problems import known_check
from autograder.student.cell import VISIBLE_SEED
from tests.submissions.answers import indented

MINUS = """
    c = -arm.m2 * arm.l1 * arm.lc2 * np.cos(q[1])
    M22 = arm.I2 + arm.m2 * arm.lc2**2
    M11 = arm.I1 + arm.m1 * arm.lc1**2 + M22 + arm.m2 * arm.l1**2 + 2 * c
    return np.array([[M11, M22 + c], [M22 + c, M22]])
"""
OTHER_SIGN_C = """
    h = arm.m2 * arm.l1 * arm.lc2 * np.sin(q[1])
    return h * np.array([[qd[1], qd[0] + qd[1]], [-qd[0], 0.0]])
"""
# The same C q̇ as the Christoffel C, and Ṁ − 2C is not skew.
NOT_SKEW_C = """
    h = -arm.m2 * arm.l1 * arm.lc2 * np.sin(q[1])
    return h * np.array([[0.0, 2 * qd[0] + qd[1]], [-qd[0], 0.0]])
"""
UPWARD = """
    g2 = arm.m2 * arm.lc2 * arm.g * np.cos(q[0] + q[1])
    return -np.array([(arm.m1 * arm.lc1 + arm.m2 * arm.l1) * arm.g * np.cos(q[0]) + g2, g2])
"""
COSINE = "pend.m * pend.g * pend.lc * np.cos(q)"
CART = """
    c = -arm.m * arm.lc * np.cos(q[1])
    return np.array([[arm.mc + arm.m, c], [c, arm.I + arm.m * arm.lc**2]])
"""


def function(check_id: str, body: str):
    """The student's function of a check of the course's own problems, or of a mechanism."""
    names = {"np": np}
    check = known_check(check_id)
    exec(f"def {check.signature}:\n{indented(body)}\n", names)
    return names[check.name]


def first_call(check_id: str):
    check = known_check(check_id)
    return check.calls(np.random.default_rng(VISIBLE_SEED), VISIBLE_CASES)[0]


def played(check_id: str, body: str) -> Comparison:
    """Both motions from the first case of the visible check."""
    return compared(known_check(check_id), function(check_id, body), first_call(check_id))
