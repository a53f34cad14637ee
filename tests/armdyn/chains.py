"""Random physical spatial chains, as Hypothesis strategies, and planar arms as spatial ones."""

import numpy as np
from hypothesis import strategies as st

from armdyn import Link, SerialChain
from armdyn.spatial import rotation
from tests.armdyn.arms import between, frictions, inertias, masses

angles = between(-3.2, 3.2)
none = st.just(0.0)


def points(size):
    return st.tuples(*[between(-size, size)] * 3)


@st.composite
def rotations(draw):
    """Any rotation: by its three Euler angles."""
    about = np.eye(3)[[2, 0, 2]]
    turns = [rotation(axis, draw(angles)) for axis in about]
    return turns[0] @ turns[1] @ turns[2]


@st.composite
def links(draw, joints=("revolute", "prismatic")):
    # Second moments of a mass distribution: the inertia that they give is physical.
    spread = np.array([draw(inertias) for _ in range(3)])
    principal = draw(rotations())
    return Link(
        joint=draw(st.sampled_from(joints)),
        mass=draw(masses),
        com=draw(points(1)),
        inertia=principal @ np.diag(spread.sum() - spread) @ principal.T,
        axis=draw(rotations())[:, 2],
        rotation=draw(rotations()),
        translation=draw(points(1)),
    )


@st.composite
def spatial_chains(draw, most=4, friction=frictions, armature=none):
    chain = draw(st.lists(links(), min_size=1, max_size=most))
    return SerialChain(
        tuple(chain),
        gravity=draw(points(10)),
        viscous=draw(st.tuples(*[friction] * len(chain))),
        coulomb=draw(st.tuples(*[friction] * len(chain))),
        armature=draw(st.tuples(*[armature] * len(chain))),
    )


def spatial(planar) -> SerialChain:
    """A PlanarChain in the plane z = 0 of space.

    Moments of inertia about axes in the plane do no work there: those of a ball will do.
    """
    before = (0.0, *planar.l[:-1])
    return SerialChain(
        tuple(
            Link(
                "revolute",
                mass=m,
                com=(lc, ly, 0),
                inertia=np.diag([I, I, I]),
                translation=(l, 0, 0),
            )
            for m, lc, ly, I, l in zip(
                planar.m, planar.lc, planar.ly, planar.I, before, strict=True
            )
        ),
        gravity=(0, -planar.g, 0),
        viscous=planar.viscous,
        coulomb=planar.coulomb,
    )
