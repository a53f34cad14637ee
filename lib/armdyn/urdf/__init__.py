"""Reads serial chains from URDF files, the robot description format of ROS."""

import os
import reprlib
from collections.abc import Sequence
from typing import IO, Literal

import numpy as np

from armdyn.models.link import Joint, Link
from armdyn.models.serial_chain import SerialChain
from armdyn.parameters import state_vector
from armdyn.spatial import skew
from armdyn.urdf.elements import Mass, robot_of
from armdyn.urdf.tree import Stance, Tree, known, positions, unit_axis

__all__ = ["read_urdf"]

KINDS: dict[str, Joint] = {
    "revolute": "revolute",
    "continuous": "revolute",
    "prismatic": "prismatic",
}


def read_urdf(
    source: str | bytes | os.PathLike | IO,
    gravity: Sequence[float] = (0.0, 0.0, -9.81),
    *,
    tip: str | None = None,
    base: str | None = None,
    locked=(),
    inertia: Literal["error", "warn"] = "error",
) -> SerialChain:
    """A chain of revolute, continuous and prismatic joints in a URDF file.

    source: the file's path, an open file, or the text itself. gravity: (3,), in the frame of the
    file's root link, m/s².

    base, tip: names of links. The chain's joints are those that lead from `base` (the root if it is
    not given) to `tip`. Without `tip` all joints beyond `base` must be one chain. The chain's base
    has the frame of the link `base`.
    locked: names of joints that do not move, or a mapping from such names to positions, rad or m;
    the position is 0 if none is given.

    All other joints stand still: at 0, or, if they mimic a joint, where that puts them. What they
    and fixed joints carry becomes part of the link that carries it. Each Link has the name of the
    URDF link that its joint moves.

    A joint's damping and friction become its viscous and Coulomb friction, and Drake's elements
    `drake:rotor_inertia` and `drake:gear_ratio` of its actuator its armature. Limits, and visual and
    collision elements, are not looked at.

    inertia: "warn" reads a link whose inertia no body can have (it breaks the triangle inequality,
    or has a negative principal moment), as in many published files, with a warning that
    names it. A link is judged together with all that is held on it.

    Raises ValueError, naming the argument, the joint or the link: for a text that is not URDF; for
    links and joints that are not one tree; for names that the file does not have; where the chain
    branches, or has joints that are floating or planar or mimic another; where a joint beside it
    mimics one that moves; where no joint moves; and for masses, inertias and friction that are not
    physical, as `Link` and `SerialChain` do. Raises FileNotFoundError where there is no such file,
    and IsADirectoryError for a folder.
    """
    if inertia not in ("error", "warn"):
        raise ValueError(f"inertia = {inertia!r}: needs 'error' or 'warn'")
    robot = robot_of(source)
    tree = Tree(robot)
    for name, link in (("base", base), ("tip", tip)):
        if link is not None:
            known("link", link, tree.links, f"{name}: ")
    base = tree.root if base is None else base
    stance = Stance(tree, base, tip, positions(locked, tree.joints))
    pull = state_vector("gravity", gravity, 3)
    for joint in tree.path(tree.root, base):
        pull = pull @ stance.placement(joint)[:3, :3]
    links, joints = [], []
    _, moving = _rigid(base, np.eye(4), tree, stance)
    while moving:
        if len(moving) > 1:
            names = ", ".join(repr(joint.name) for _, joint in moving)
            tips = reprlib.repr(tree.tips(base))
            raise ValueError(
                f"the joints {names} branch: needs one joint after the other; tip picks a chain "
                f"(to one of {tips}), locked holds joints"
            )
        ((placement, joint),) = moving
        masses, moving = _rigid(joint.child, np.eye(4), tree, stance)
        links.append(_link(joint, placement, _together(masses), inertia))
        joints.append(joint)
    if not links:
        between = f" between the links {base!r} and {tip!r}" if tip else ""
        raise ValueError(f"{robot.source}: no joint moves{between}")
    return SerialChain(
        tuple(links),
        tuple(pull.tolist()),
        viscous=tuple(joint.damping for joint in joints),
        coulomb=tuple(joint.friction for joint in joints),
        armature=tuple(robot.armature.get(joint.name, 0.0) for joint in joints),
    )


def _rigid(link, placement, tree, stance):
    """What moves with a link: its masses, and the moving joints beyond it with their placements.

    placement: (4, 4), of the link in the frame in which all is wanted.
    """
    masses, moving = [], []
    part = tree.links[link]
    if part is not None:
        R = placement[:3, :3]
        com = R @ part.com + placement[:3, 3]
        masses.append(Mass(part.mass, com, R @ part.inertia @ R.T))
    for joint in tree.below[link]:
        there = placement @ stance.placement(joint)
        if joint.name in stance.moving:
            moving.append((there, joint))
            continue
        more = _rigid(joint.child, there, tree, stance)
        masses += more[0]
        moving += more[1]
    return masses, moving


def _together(masses) -> Mass:
    """Several rigid parts as one."""
    total = sum(part.mass for part in masses)
    com = np.zeros(3)
    if total > 0:
        com = sum(part.mass * part.com for part in masses) / total
    inertia = np.zeros((3, 3))
    for part in masses:
        apart = skew(part.com - com)
        inertia = inertia + part.inertia + part.mass * apart @ apart.T
    return Mass(total, com, inertia)


def _link(joint, placement, body, triangle) -> Link:
    return Link(
        KINDS[joint.type],
        float(body.mass),
        body.com,
        body.inertia,
        axis=tuple(unit_axis(joint)),
        rotation=placement[:3, :3],
        translation=placement[:3, 3],
        name=joint.child,
        triangle=triangle,
    )
