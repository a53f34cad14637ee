"""The tree of links and joints in a URDF file: which of its joints move, and where the rest stand."""

import difflib
import reprlib
from collections import defaultdict
from collections.abc import Iterable, Mapping

import numpy as np

from armdyn.parameters import finite
from armdyn.spatial import rotation
from armdyn.urdf.elements import MOVING, Robot, UrdfJoint

# A file may hang its robot on it without a link of that name.
WORLD = "world"


class Tree:
    """The links below one root. Raises ValueError, naming the joint or link, where they are none."""

    def __init__(self, robot: Robot):
        self.links = dict(robot.links)
        self.joints = robot.joints
        self.carrier: dict[str, UrdfJoint] = {}
        self.below: dict[str, list[UrdfJoint]] = defaultdict(list)
        if any(joint.parent == WORLD for joint in self.joints.values()):
            self.links.setdefault(WORLD, None)
        for joint in self.joints.values():
            for link in (joint.parent, joint.child):
                known("link", link, self.links, f"joint {joint.name!r}: ")
            if joint.child in self.carrier:
                raise ValueError(
                    f"link {joint.child!r}: has two parent joints, "
                    f"{self.carrier[joint.child].name!r} and {joint.name!r}, a loop; needs one"
                )
            self.carrier[joint.child] = joint
            self.below[joint.parent].append(joint)
        roots = [link for link in self.links if link not in self.carrier]
        if not roots:
            raise ValueError(
                "every link has a parent joint, so the joints form a loop: needs one link without, "
                "the root"
            )
        if len(roots) != 1:
            raise ValueError(
                f"the links {reprlib.repr(roots)} have no parent joint: needs one such link, the "
                "root"
            )
        (self.root,) = roots
        apart = sorted(
            self.links.keys() - {self.root, *(j.child for j in self.all_below(self.root))}
        )
        if apart:
            raise ValueError(f"link {apart[0]!r}: no joints lead to it from the root")

    def leaders(self, joint) -> list[UrdfJoint]:
        """The joint that this one mimics, the one that that mimics, and so on."""
        followed = [joint]
        while (mimic := followed[-1].mimic) is not None:
            where = f"joint {followed[-1].name!r}: mimics {mimic.leader!r}, but "
            followed.append(known("joint", mimic.leader, self.joints, where))
            if followed[-1] in followed[:-1]:
                names = ", ".join(repr(each.name) for each in followed[:-1])
                raise ValueError(f"the joints {names} mimic each other")
        return followed[1:]

    def all_below(self, link) -> list[UrdfJoint]:
        """The joints that a link carries, and those further out, each after the one before it."""
        found = list(self.below[link])
        for joint in found:
            found += self.below[joint.child]
        return found

    def path(self, base, tip) -> list[UrdfJoint]:
        """The joints from the link `base` to the link `tip`, outwards."""
        joints: list[UrdfJoint] = []
        link = tip
        while link != base:
            if link not in self.carrier:
                raise ValueError(f"tip = {tip!r}: the link {base!r} does not carry it")
            joints.insert(0, self.carrier[link])
            link = joints[0].parent
        return joints

    def tips(self, base) -> list[str]:
        """The links on the last moving joints."""
        moving = [joint for joint in self.all_below(base) if joint.type in MOVING]
        return [
            joint.child
            for joint in moving
            if not any(further.type in MOVING for further in self.all_below(joint.child))
        ]


class Stance:
    """Which joints move, and the placement of each other one at the position where it is held.

    locked: joint → position, rad or m. Where `tip` is None, all joints beyond `base` move that are
    neither locked nor follow a joint that is held.
    """

    def __init__(self, tree: Tree, base, tip, locked: Mapping[str, float]):
        self.tree, self.locked = tree, locked
        joints = tree.all_below(base) if tip is None else tree.path(base, tip)
        free = [joint for joint in joints if joint.name not in locked and joint.type != "fixed"]
        self.moving = {joint.name for joint in free if joint.mimic is None}
        for joint in free:
            where = f"joint {joint.name!r}: "
            if joint.type not in MOVING:
                raise ValueError(
                    f"{where}is of type {joint.type!r}, needs {', '.join(MOVING)} or fixed; locked "
                    "holds a joint where it is"
                )
            # One in the chain that follows a joint beside it is held, but only if told to be.
            if joint.mimic is not None and tip is not None:
                raise ValueError(
                    f"{where}mimics {joint.mimic.leader!r}, and does not move by itself; locked can "
                    "hold it"
                )

    def placement(self, joint) -> np.ndarray:
        """Of the joint's child in its parent, (4, 4); of one that moves, at q = 0."""
        if joint.type not in MOVING or joint.name in self.moving:
            return joint.origin
        q = self._position(joint)
        if q == 0:
            return joint.origin
        step = np.eye(4)
        axis = unit_axis(joint)
        if joint.type == "prismatic":
            step[:3, 3] = q * axis
        else:
            step[:3, :3] = rotation(axis, q)
        return joint.origin @ step

    def _position(self, joint) -> float:
        if joint.name in self.locked:
            return self.locked[joint.name]
        if joint.mimic is None:
            return 0.0
        leader = self.tree.leaders(joint)[0]
        if leader.name in self.moving:
            raise ValueError(
                f"joint {joint.name!r}: mimics {leader.name!r}, which moves, and does not move by "
                "itself; locked can hold one of them, and tip can end the chain before them"
            )
        return joint.mimic.multiplier * self._position(leader) + joint.mimic.offset


def unit_axis(joint) -> np.ndarray:
    """The format asks for a unit vector, but files round it."""
    length = np.linalg.norm(joint.axis)
    if length == 0:
        raise ValueError(f"joint {joint.name!r}: axis = 0 0 0, needs a direction")
    return joint.axis / length


def positions(locked, joints: Mapping[str, UrdfJoint]) -> dict[str, float]:
    """The argument `locked` of `read_urdf`, checked: joint → position."""
    if isinstance(locked, str) or not isinstance(locked, Iterable):
        raise ValueError(
            f"locked = {locked!r}: needs names of joints, or a mapping of such names to positions"
        )
    held = {}
    for name in locked:
        joint = known("joint", name, joints, "locked: ")
        value = locked[name] if isinstance(locked, Mapping) else 0.0
        held[name] = finite(f"locked[{name!r}]", value, "rad or m")
        if joint.type not in MOVING and held[name] != 0:
            raise ValueError(
                f"locked[{name!r}] = {value!r}: this joint is {joint.type}, and can only be held "
                "at 0"
            )
    return held


def known(kind, name, names: Mapping, where):
    """names[name]; ValueError that lists the names like it if there is none."""
    if isinstance(name, str) and name in names:
        return names[name]
    near = difflib.get_close_matches(str(name), names, cutoff=0.5) or sorted(names)[:8]
    listed = ", ".join(map(repr, near)) or "none at all"
    raise ValueError(f"{where}there is no {kind} {name!r}; near it: {listed}")
