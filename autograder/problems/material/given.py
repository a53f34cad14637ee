"""M, C and g_vec of a member of the family as Python source, for problems that give them.

A cosine or sine of an angle plus quarter turns is written without them, as a person would.
"""

import numpy as np

from autograder.problems.material.conventions import Convention

M_TEXT = '''\
def M(q, arm):
    """Inertia matrix, (2, 2), kg·m². q: (2,), rad."""
    coupling = {coupling}
'''
M_RELATIVE = """\
    M22 = arm.I2 + arm.m2 * arm.lc2**2
    M12 = M22 + coupling
    M11 = arm.I1 + arm.m1 * arm.lc1**2 + arm.m2 * arm.l1**2 + M22 + 2 * coupling
    return np.array([[M11, M12], [M12, M22]])
"""
M_ABSOLUTE = """\
    M22 = arm.I2 + arm.m2 * arm.lc2**2
    M11 = arm.I1 + arm.m1 * arm.lc1**2 + arm.m2 * arm.l1**2
    return np.array([[M11, coupling], [coupling, M22]])
"""
C_TEXT = '''\
def C(q, qd, arm):
    """Coriolis and centrifugal matrix, (2, 2), kg·m²/s. q: (2,), rad; qd: (2,), rad/s."""
    h = {slope}
'''
C_RELATIVE = """\
    return np.array([[h * qd[1], h * (qd[0] + qd[1])], [-h * qd[0], 0.0]])
"""
C_ABSOLUTE = """\
    return np.array([[0.0, h * qd[1]], [-h * qd[0], 0.0]])
"""
G_TEXT = '''\
def g_vec(q, arm):
    """Gravity vector, (2,), N·m. q: (2,), rad."""
    carried = {first}
    beyond = {second}
    return np.array([{sum}, beyond])
'''
GIVEN = {"p2": ("M",), "p5": ("M", "C", "g_vec")}


def code(own: Convention, problem: str) -> str:
    """The functions that this problem gives, one below the other; "" where it gives none."""
    written = {"M": _M, "C": _C, "g_vec": _g_vec}
    return "\n\n".join(written[name](own) for name in GIVEN.get(problem, ()))


def _M(own: Convention) -> str:
    return M_TEXT.format(coupling=_times("arm.m2 * arm.l1 * arm.lc2", *_between(own))) + (
        M_RELATIVE if _is_relative(own) else M_ABSOLUTE
    )


def _C(own: Convention) -> str:
    angle, quarters = _between(own)
    return C_TEXT.format(slope=_times("arm.m2 * arm.l1 * arm.lc2", angle, quarters + 1)) + (
        C_RELATIVE if _is_relative(own) else C_ABSOLUTE
    )


def _g_vec(own: Convention) -> str:
    relative = _is_relative(own)
    tilt = " - np.pi / 6" if own.slope else ""
    first, second = _quarters(own)
    angle = "q[0] + q[1]" if relative else "q[1]"
    return G_TEXT.format(
        first=_times("(arm.m1 * arm.lc1 + arm.m2 * arm.l1) * arm.g", f"q[0]{tilt}", first),
        second=_times("arm.m2 * arm.lc2 * arm.g", f"{angle}{tilt}", second),
        sum="carried + beyond" if relative else "carried",
    )


def _between(own: Convention) -> tuple[str, int]:
    """The angle from link 1 to link 2, without its quarter turns, and how many these are."""
    first, second = _quarters(own)
    return "q[1]" if _is_relative(own) else "q[1] - q[0]", second - first


def _quarters(own: Convention) -> tuple[int, int]:
    """The angles of the links from the x axis at q = 0, in quarter turns."""
    first, second = (round(zero / (np.pi / 2)) for zero in own.zeros)
    return first, second


def _is_relative(own: Convention) -> bool:
    return own.angles in ("relative", "square")


def _times(factors: str, angle: str, quarters: int) -> str:
    """A product with the cosine of an angle and so many quarter turns."""
    sign, function = [("", "cos"), ("-", "sin"), ("-", "cos"), ("", "sin")][quarters % 4]
    return f"{sign}{factors} * np.{function}({angle})"
