"""Reads serial chains from URDF files, the robot description format of ROS.

The XML is read by yourdfpy, which the extra `urdf` installs; here its links and joints become a
`SerialChain`.
"""

import os
from collections import Counter, defaultdict
from typing import NamedTuple
from xml.etree import ElementTree

import numpy as np

from armdyn.models.link import Joint, Link
from armdyn.models.serial_chain import SerialChain
from armdyn.parameters import finite, nonnegative
from armdyn.spatial import skew

MOVING: dict[str, Joint] = {
    "revolute": "revolute",
    "continuous": "revolute",
    "prismatic": "prismatic",
}


class Mass(NamedTuple):
    """A part of a link: mass, centre of mass (3,), and inertia (3, 3) about that centre."""

    mass: float
    com: np.ndarray
    inertia: np.ndarray


def read_urdf(path, gravity=(0.0, 0.0, -9.81)) -> SerialChain:
    """The chain of the revolute, continuous and prismatic joints in a URDF file.

    path: of the file. gravity: (3,), in the frame of the file's root link, m/s².

    Links behind fixed joints become part of the link that carries them, and what is fixed to the
    root does not move. A joint's damping and friction become its viscous and Coulomb friction.
    Limits, meshes, visual and collision elements are not looked at. Each Link has the name of the
    URDF link that its joint moves.

    Raises ValueError, naming the joint or the link, for a file that is not one open chain: branches,
    loops, parts without a joint, mimic joints, floating, planar and unknown joints, no moving
    joint at all; and for masses, inertias and friction that are not physical, as `Link` and
    `SerialChain` do. Raises FileNotFoundError where there is no such file, and ImportError, saying
    what to install, where yourdfpy is missing.
    """
    robot = _parsed(path)
    below = _joints_below(robot)
    inertial = {link.name: link.inertial for link in robot.links}
    at, moving = _rigid(_root(robot), np.eye(4), below, inertial)[1:]
    links, viscous, coulomb, seen = [], [], [], at
    while moving:
        if len(moving) > 1:
            names = ", ".join(repr(joint.name) for _, joint in moving)
            raise ValueError(f"the joints {names} branch: needs one joint after the other")
        ((placement, joint),) = moving
        masses, reached, moving = _rigid(joint.child, np.eye(4), below, inertial)
        links.append(_link(joint, placement, _together(masses)))
        viscous.append(_friction(joint, "damping"))
        coulomb.append(_friction(joint, "friction"))
        seen |= reached
    apart = sorted(inertial.keys() - seen)
    if apart:
        raise ValueError(f"link {apart[0]!r}: no joints lead to it from the root")
    if not links:
        raise ValueError(f"{os.fspath(path)}: no joint moves")
    return SerialChain(tuple(links), gravity, tuple(viscous), tuple(coulomb))


def _parsed(path):
    try:
        import yourdfpy
    except ImportError:
        raise ImportError("read_urdf needs yourdfpy: pip install 'armdyn[urdf]'") from None
    path = os.fspath(path)
    if not os.path.isfile(path):
        raise FileNotFoundError(f"{path}: no such file")
    try:
        # If a file breaks off, yourdfpy would read the part that is there.
        ElementTree.parse(path)
        return yourdfpy.URDF.load(path, build_scene_graph=False, load_meshes=False).robot
    except Exception as error:  # it raises whatever its parsers do
        raise ValueError(f"{path}: cannot be read as URDF: {error!r}") from error


def _joints_below(robot) -> dict[str, list]:
    """Link → the joints that it carries, each checked by itself."""
    names = {link.name for link in robot.links}
    for kind, parts in (("link", robot.links), ("joint", robot.joints)):
        twice = [name for name, count in Counter(p.name for p in parts).items() if count > 1]
        if twice:
            raise ValueError(f"{kind} {twice[0]!r}: appears more than once")
    below: dict[str, list] = defaultdict(list)
    carried: dict[str, str] = {}
    for joint in robot.joints:
        where = f"joint {joint.name!r}"
        if joint.type not in (*MOVING, "fixed"):
            raise ValueError(
                f"{where}: is of type {joint.type!r}, needs {', '.join(MOVING)} or fixed"
            )
        if joint.mimic is not None:
            raise ValueError(f"{where}: mimics {joint.mimic.joint!r}, and does not move by itself")
        for link in (joint.parent, joint.child):
            if link not in names:
                raise ValueError(f"{where}: there is no link {link!r}")
        if joint.child in carried:
            raise ValueError(
                f"link {joint.child!r}: has two parent joints, {carried[joint.child]!r} and "
                f"{joint.name!r}, a loop; needs one"
            )
        carried[joint.child] = joint.name
        below[joint.parent].append(joint)
    return below


def _root(robot) -> str:
    children = {joint.child for joint in robot.joints}
    roots = [link.name for link in robot.links if link.name not in children]
    if len(roots) != 1:
        raise ValueError(f"the links {roots} have no parent joint: needs one such link, the root")
    return roots[0]


def _rigid(link, placement, below, inertial):
    """What moves with a link: its masses, the links' names, and the moving joints with placements.

    placement: (4, 4), of the link in the frame in which all is wanted.
    """
    masses, names, moving = [], {link}, []
    part = inertial[link]
    if part is not None:
        masses.append(_mass(link, part, placement))
    for joint in below[link]:
        there = placement if joint.origin is None else placement @ joint.origin
        if joint.type in MOVING:
            moving.append((there, joint))
            continue
        more = _rigid(joint.child, there, below, inertial)
        masses += more[0]
        names |= more[1]
        moving += more[2]
    return masses, names, moving


def _mass(link, part, placement) -> Mass:
    where = f"link {link!r}: "
    if part.mass is None or part.inertia is None:
        raise ValueError(f"{where}its inertial element needs a mass and an inertia")
    at = placement if part.origin is None else placement @ part.origin
    R = at[:3, :3]
    mass = nonnegative(f"{where}mass", float(part.mass), "kg")
    return Mass(mass, at[:3, 3], R @ part.inertia @ R.T)


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


def _link(joint, placement, body) -> Link:
    length = np.linalg.norm(joint.axis)
    return Link(
        MOVING[joint.type],
        float(body.mass),
        body.com,
        body.inertia,
        # The format asks for a unit vector, but files round it.
        axis=joint.axis / length if length > 0 else joint.axis,
        rotation=placement[:3, :3],
        translation=placement[:3, 3],
        name=joint.child,
    )


def _friction(joint, kind) -> float:
    value = getattr(joint.dynamics, kind, None)
    if value is None:
        return 0.0
    name = f"joint {joint.name!r}: {kind}"
    try:
        return nonnegative(name, finite(name, float(value), "SI units"), "SI units")
    except ValueError:
        raise ValueError(f"{name} = {value!r}: needs a number that is not negative") from None
