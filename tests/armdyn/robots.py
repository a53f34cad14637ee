"""A published robot as a SerialChain: the Franka Emika Panda, seven revolute joints."""

import numpy as np

from armdyn import Link, SerialChain
from armdyn.spatial import rotation

# a and d, m, and the angle α in quarters of a turn, by the maker's own table in Craig's convention.
JOINTS = (
    (0.0, 0.333, 0), (0.0, 0.0, -1), (0.0, 0.316, 1), (0.0825, 0.0, 1),
    (-0.0825, 0.384, -1), (0.0, 0.0, 1), (0.088, 0.0, 1),
)  # fmt: skip
# Mass, centre of mass, and Ixx, Ixy, Ixz, Iyy, Iyz, Izz about it, identified by C. Gaz, M. Cognetti,
# A. Oliva, P. Robuffo Giordano, A. De Luca (2019), Dynamic Identification of the Franka Emika Panda
# Robot With Retrieval of Feasible Parameters Using Penalty-Based Optimization.
# fmt: off
BODIES = (
    (4.970684, (3.875e-3, 2.081e-3, -0.04762),
     (0.70337, -1.39e-4, 6.772e-3, 0.70661, 0.019169, 9.117e-3)),
    (0.646926, (-3.141e-3, -0.02872, 3.495e-3),
     (7.962e-3, -3.925e-3, 0.010254, 0.02811, 7.04e-4, 0.025995)),
    (3.228604, (0.027518, 0.039252, -0.066502),
     (0.037242, -4.761e-3, -0.011396, 0.036155, -0.012805, 0.01083)),
    (3.587895, (-0.05317, 0.104419, 0.027454),
     (0.025853, 7.796e-3, -1.332e-3, 0.019552, 8.641e-3, 0.028323)),
    (1.225946, (-0.011953, 0.041065, -0.038437),
     (0.035549, -2.117e-3, -4.037e-3, 0.029474, 2.29e-4, 8.627e-3)),
    (1.666555, (0.060149, -0.014117, -0.010517),
     (1.964e-3, 1.09e-4, -1.158e-3, 4.354e-3, 3.41e-4, 5.433e-3)),
    (0.735522, (0.010517, -4.252e-3, 0.061597),
     (0.012516, -4.28e-4, -1.196e-3, 0.010027, -7.41e-4, 4.815e-3)),
)
# fmt: on


def panda(quarter: float = np.pi / 2, **arguments) -> SerialChain:
    """quarter: a right angle, as a file may have it, rad."""
    links = []
    for (a, d, turns), (mass, com, (xx, xy, xz, yy, yz, zz)) in zip(JOINTS, BODIES, strict=True):
        R = rotation((1, 0, 0), turns * quarter)
        links.append(
            Link(
                "revolute",
                mass,
                com=com,
                inertia=((xx, xy, xz), (xy, yy, yz), (xz, yz, zz)),
                rotation=R,
                translation=np.array((a, 0, 0)) + R @ (0, 0, d),
            )
        )
    return SerialChain(tuple(links), **arguments)
