"""Small URDF files, and the chain that each describes when every joint of it moves."""

from dataclasses import dataclass

import numpy as np
from hypothesis import strategies as st

from armdyn import Link, SerialChain
from armdyn.spatial import rotation
from tests.armdyn.arms import between, frictions, inertias, masses
from tests.armdyn.chains import angles, points, rotations

NONE = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Part:
    """One joint and the link on it, by the names of the URDF elements."""

    type: str
    xyz: tuple = NONE
    rpy: tuple = NONE
    axis: tuple = (0.0, 0.0, 1.0)
    mass: float = 1.0
    com: tuple = NONE
    com_rpy: tuple = NONE
    principal: tuple = (1.0, 1.0, 1.0)
    damping: float = 0.0
    friction: float = 0.0


@st.composite
def parts(draw, types=("revolute", "continuous", "prismatic", "fixed")):
    spread = np.array([draw(inertias) for _ in range(3)])
    return Part(
        type=draw(st.sampled_from(types)),
        xyz=draw(points(1)),
        rpy=draw(st.tuples(angles, between(-1.5, 1.5), angles)),
        axis=tuple(draw(rotations())[:, 2]),
        mass=draw(masses),
        com=draw(points(1)),
        com_rpy=draw(st.tuples(angles, between(-1.5, 1.5), angles)),
        principal=tuple(spread.sum() - spread),
        damping=draw(frictions),
        friction=draw(frictions),
    )


@st.composite
def arms_of_parts(draw, most=6):
    """One to `most` parts, of which one at least moves."""
    arm = draw(st.lists(parts(), min_size=0, max_size=most - 1))
    arm.insert(draw(st.integers(0, len(arm))), draw(parts(("revolute", "prismatic"))))
    return arm


def text(numbers) -> str:
    return " ".join(f"{x:.17g}" for x in numbers)


def joint(name, parent, child, part, extra="") -> str:
    moving = part.type != "fixed"
    axis = f'<axis xyz="{text(part.axis)}"/>' if moving else ""
    dynamics = f'<dynamics damping="{part.damping:.17g}" friction="{part.friction:.17g}"/>'
    return (
        f'<joint name="{name}" type="{part.type}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{text(part.xyz)}" rpy="{text(part.rpy)}"/>{axis}'
        f'<limit lower="-1" upper="1" effort="1" velocity="1"/>{dynamics if moving else ""}'
        f"{extra}</joint>"
    )


def link(name, part) -> str:
    a, b, c = (f"{x:.17g}" for x in part.principal)
    return (
        f'<link name="{name}"><inertial><origin xyz="{text(part.com)}" rpy="{text(part.com_rpy)}"/>'
        f'<mass value="{part.mass:.17g}"/><inertia ixx="{a}" iyy="{b}" izz="{c}" ixy="0" ixz="0" '
        'iyz="0"/></inertial></link>'
    )


def robot(*elements) -> str:
    return '<?xml version="1.0"?>\n<robot name="arm">' + "\n".join(elements) + "</robot>\n"


def chain_file(arm) -> str:
    """The parts in a row: link1 on the joint j1 on the link base, and so on."""
    names = ["base", *(f"link{k}" for k in range(1, len(arm) + 1))]
    elements = ['<link name="base"/>']
    for k, part in enumerate(arm):
        elements += [link(names[k + 1], part), joint(f"j{k + 1}", names[k], names[k + 1], part)]
    return robot(*elements)


def from_rpy(rpy) -> np.ndarray:
    x, y, z = np.eye(3)
    return rotation(z, rpy[2]) @ rotation(y, rpy[1]) @ rotation(x, rpy[0])


def all_moving(arm) -> SerialChain:
    """The parts as a chain in which the fixed joints are revolute; at q = 0 they are where they
    should be."""
    return SerialChain(
        tuple(
            Link(
                "prismatic" if part.type == "prismatic" else "revolute",
                part.mass,
                part.com,
                from_rpy(part.com_rpy) @ np.diag(part.principal) @ from_rpy(part.com_rpy).T,
                part.axis,
                from_rpy(part.rpy),
                part.xyz,
            )
            for part in arm
        ),
        viscous=[part.damping for part in arm],
        coulomb=[part.friction for part in arm],
    )
