"""URDF files whose links branch."""

from dataclasses import dataclass, replace

import numpy as np
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from tests.armdyn.urdf_files import Part, from_rpy, joint, link, parts, robot

TORSO = Part("revolute", xyz=(0, 0, 0.2), axis=(0.6, 0, 0.8), mass=9)


@dataclass(frozen=True)
class PartTree:
    """parents[k]: the number of the part that carries part k, −1 for the base."""

    parts: tuple[Part, ...]
    parents: tuple[int, ...]

    def path(self, k) -> list[int]:
        """The parts from the base to part k."""
        return [] if k < 0 else [*self.path(self.parents[k]), k]


@st.composite
def trees(draw, most=7):
    """Two parts or more that move."""
    several = draw(st.lists(parts(("revolute", "prismatic")), min_size=2, max_size=most))
    parents = tuple(draw(st.integers(-1, k - 1)) for k in range(len(several)))
    return PartTree(tuple(several), parents)


def leaves(tree) -> list[int]:
    return [k for k in range(len(tree.parts)) if k not in tree.parents]


def tree_file(tree, fixed=(), at=None) -> str:
    """Joint jk carries linkk. fixed: parts to write as fixed. at: part → how far it is moved on."""
    names = ["base", *(f"link{k}" for k in range(len(tree.parts)))]
    elements = [f'<link name="{names[0]}"/>']
    for k, part in enumerate(tree.parts):
        part = _moved(part, (at or {}).get(k, 0.0))
        if k in fixed:
            part = replace(part, type="fixed")
        carrier = names[tree.parents[k] + 1]
        elements += [link(names[k + 1], part), joint(f"j{k}", carrier, names[k + 1], part)]
    return robot(*elements)


def _moved(part, q) -> Part:
    R = from_rpy(part.rpy)
    if part.type == "prismatic":
        return replace(part, xyz=tuple(part.xyz + R @ part.axis * q))
    turned = R @ Rotation.from_rotvec(np.array(part.axis) * q).as_matrix()
    return replace(part, rpy=tuple(Rotation.from_matrix(turned).as_euler("xyz")))


def humanoid() -> str:
    """A pelvis with two legs of one joint, and on a waist a head and two arms of two."""
    elements = [link("pelvis", TORSO)]

    def add(name, parent, child, part):
        elements.extend((link(child, part), joint(name, parent, child, part)))

    add("waist", "pelvis", "torso", TORSO)
    add("neck", "torso", "head", Part("revolute", xyz=(0, 0, 0.6)))
    for side, y in (("left", 0.2), ("right", -0.2)):
        limb = Part("revolute", xyz=(0, y, 0.5), axis=(1, 0, 0), com=(0, y, -0.1), mass=2)
        add(f"{side} shoulder", "torso", f"{side} arm", limb)
        add(f"{side} elbow", f"{side} arm", f"{side} hand", replace(limb, axis=(0, 1, 0)))
        add(f"{side} hip", "pelvis", f"{side} foot", replace(limb, xyz=(0, y, 0)))
    return robot(*elements)
