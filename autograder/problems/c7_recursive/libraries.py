"""Libraries that compute u = M q̈ + C q̇ + g + f of one arm, as functions of q, q̇ and q̈.

Their equations are written out, with numbers for the parameters: an arm on a turning column, the same
with a wheel at its elbow, and the planar 2R.
"""

import numpy as np

from autograder.protocol import Function


def _numbers(rng, *ranges) -> list[str]:
    return [f"{rng.uniform(low, high):.3g}" for low, high in ranges]


def column(rng: np.random.Generator, gravity: float = 1.0, load: bool = False) -> Function:
    """A column that turns about the vertical, and an arm on it at the angle q2 above the level.

    gravity: how often the arm's weight counts. load: whether the torque comes back with the sign of the
    one by which the arm resists.
    """
    J, mass, inertia, d1, d2 = _numbers(
        rng, (0.5, 1.5), (0.6, 2), (0.2, 0.6), (0.1, 0.5), (0.1, 0.5)
    )
    weight = f"{gravity * rng.uniform(3, 12):.3g}"
    first = f"({J} + {mass}*cos(q[1])**2)*qdd[0] - {mass}*sin(2*q[1])*qd[0]*qd[1] + {d1}*qd[0]"
    second = (
        f"{float(mass) + float(inertia):.3g}*qdd[1] + {mass}*sin(q[1])*cos(q[1])*qd[0]**2"
        f" + {weight}*cos(q[1]) + {d2}*qd[1]"
    )
    return _function(first, second, load=load)


def with_wheel(rng: np.random.Generator) -> Function:
    """The column and the arm, with a wheel on the arm that turns about the axis of the second joint."""
    J, mass, inertia, wheel = _numbers(rng, (0.5, 1.5), (0.6, 2), (0.2, 0.6), (0.2, 0.6))
    weight, d1, d2, d3 = _numbers(rng, (3, 12), (0.1, 0.5), (0.1, 0.5), (0.1, 0.5))
    first = f"({J} + {mass}*cos(q[1])**2)*qdd[0] - {mass}*sin(2*q[1])*qd[0]*qd[1] + {d1}*qd[0]"
    second = (
        f"{float(mass) + float(inertia):.3g}*qdd[1] + {wheel}*(qdd[1] + qdd[2])"
        f" + {mass}*sin(q[1])*cos(q[1])*qd[0]**2 + {weight}*cos(q[1]) + {d2}*qd[1]"
    )
    return _function(first, second, f"{wheel}*(qdd[1] + qdd[2]) + {d3}*qd[2]")


def planar_2r(rng: np.random.Generator) -> Function:
    """Two links in a vertical plane."""
    b, inner, outer, d1, d2 = _numbers(
        rng, (0.3, 0.7), (1.2, 2.5), (0.6, 1.2), (0.1, 0.5), (0.1, 0.5)
    )
    w1, w2 = _numbers(rng, (5, 15), (2, 6))
    coupled = f"({outer} + {b}*cos(q[1]))"
    first = (
        f"({inner} + {outer} + 2*{b}*cos(q[1]))*qdd[0] + {coupled}*qdd[1]"
        f" - {b}*sin(q[1])*(2*qd[0]*qd[1] + qd[1]**2)"
        f" + {w1}*cos(q[0]) + {w2}*cos(q[0] + q[1]) + {d1}*qd[0]"
    )
    second = (
        f"{coupled}*qdd[0] + {outer}*qdd[1] + {b}*sin(q[1])*qd[0]**2"
        f" + {w2}*cos(q[0] + q[1]) + {d2}*qd[1]"
    )
    return _function(first, second)


def _function(*entries: str, load: bool = False) -> Function:
    given = [f"-({entry})" for entry in entries] if load else entries
    return Function("q, qd, qdd", f"[{', '.join(given)}]".replace("+ -", "- "))
