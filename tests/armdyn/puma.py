"""The geometry of the PUMA 560 as robot files write it, with angles of so many digits.

Lengths: P. I. Corke, B. Armstrong-Hélouvry (1994), A Search for Consensus Among Model Parameters
Reported for the PUMA 560 Manipulator. The bodies are made up: slim rods and a small hand.
"""

import numpy as np

from armdyn import Link, SerialChain
from armdyn.spatial import rotation

# To the next joint, from this one: along z and x (m), then turned about x by so many right angles.
STEPS = ((0.0, 0.0, 1), (0.0, 0.4318, 0), (0.15005, 0.0203, -1), (0.4318, 0.0, 1), (0.0, 0.0, -1))
# kg, m, kg·m², each link in the frame of its joint.
BODIES = (
    (12.0, (0.02, 0.0, -0.15), (0.3, 0.3, 0.06)),
    (17.4, (0.16, 0.01, 0.1), (0.13, 0.52, 0.54)),
    (4.8, (-0.02, 0.14, 0.02), (0.07, 0.01, 0.08)),
    (0.8, (0.0, -0.02, -0.08), (2e-3, 2e-3, 1e-3)),
    (0.34, (0.0, 0.01, 0.02), (3e-4, 3e-4, 2e-4)),
    (0.4, (0.01, 0.0, 0.05), (5e-4, 5e-4, 2e-4)),
)


def puma_560(digits=None) -> SerialChain:
    """6 revolute joints, each about the y axis of a frame that lies a right angle from the DH frame.

    digits: of the angles, after the point; None for exact ones.
    """
    right = np.pi / 2 if digits is None else round(np.pi / 2, digits)
    x = (1, 0, 0)
    upright = rotation(x, -np.pi / 2)
    links, turn, step = [], 0, np.zeros(3)
    for k, (mass, com, principal) in enumerate(BODIES):
        links.append(
            Link(
                "revolute",
                mass,
                upright @ com,
                upright @ np.diag(principal) @ upright.T,
                axis=(0.0, 1.0, 0.0),
                rotation=rotation(x, right * turn + right * (k == 0)),
                translation=upright @ step if k else step,
            )
        )
        if k < len(STEPS):
            d, a, turn = STEPS[k]
            step = np.array([a, 0.0, d])
    return SerialChain(tuple(links))
