"""A rigid link and the joint that carries it: the parts of a serial chain."""

import warnings
from dataclasses import dataclass, field
from typing import Literal, get_args

import numpy as np

from armdyn.parameters import nonnegative, numbers

Joint = Literal["revolute", "prismatic"]
IDENTITY = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
ZERO = (0.0, 0.0, 0.0)
# What a file with ten digits leaves of an exact axis, rotation or triangle inequality.
TOLERANCE = 1e-9
# What double precision leaves of it; beyond this it is made exact.
ROUNDING = 1e-14


@dataclass(frozen=True)
class Link:
    """A joint and the rigid link that it moves.

    The joint's frame lies at (rotation, translation) in the frame of the link before, or of the
    base. The link's own frame is the joint's, turned by q about `axis` or moved by q along it.

    Raises ValueError, naming the link (where it has a name) and the argument: for a joint that is
    neither "revolute" nor "prismatic"; an axis that is not of length 1; a rotation that is not
    orthogonal or is a reflection; a negative mass; an inertia that is not symmetric, has a negative
    principal moment, or has one that is greater than the sum of the other two, as no distribution
    of mass can. These are judged to 1e-9, for numbers from a file.

    Published inertias break these two rules now and then: with triangle="warn" such a link is made,
    with a warning that names it. M(q) can then have negative eigenvalues.
    """

    joint: Joint = field(metadata={"doc": "how the link moves"})
    mass: float = field(metadata={"unit": "kg", "doc": "mass"})
    com: tuple[float, ...] = field(
        default=ZERO, metadata={"unit": "m", "doc": "(3,), centre of mass in the link's frame"}
    )
    inertia: tuple[tuple[float, ...], ...] = field(
        default=(ZERO, ZERO, ZERO),
        metadata={
            "unit": "kg·m²",
            "doc": "(3, 3), about the centre of mass, along the axes of the link's frame",
        },
    )
    axis: tuple[float, ...] = field(
        default=(0.0, 0.0, 1.0),
        metadata={"unit": "1", "doc": "(3,), unit vector along the joint, in the joint's frame"},
    )
    rotation: tuple[tuple[float, ...], ...] = field(
        default=IDENTITY,
        metadata={"unit": "1", "doc": "(3, 3), columns: the joint's axes in the frame before"},
    )
    translation: tuple[float, ...] = field(
        default=ZERO, metadata={"unit": "m", "doc": "(3,), the joint's origin in the frame before"}
    )
    name: str = field(default="", metadata={"doc": "for messages"})
    triangle: Literal["error", "warn"] = field(
        default="error",
        compare=False,
        repr=False,
        metadata={"doc": "for an inertia that no body can have: an error, or a warning alone"},
    )

    def __post_init__(self):
        try:
            self._check()
        except ValueError as error:
            if not isinstance(self.name, str) or not self.name:
                raise
            raise ValueError(f"link {self.name!r}: {error}") from None

    def _check(self):
        if not isinstance(self.name, str):
            raise ValueError(f"name = {self.name!r}: needs text")
        if self.joint not in get_args(Joint):
            raise ValueError(f"joint = {self.joint!r}: needs 'revolute' or 'prismatic'")
        if self.triangle not in ("error", "warn"):
            raise ValueError(f"triangle = {self.triangle!r}: needs 'error' or 'warn'")
        mass = nonnegative("mass", self.mass, "kg")
        com = numbers("com", self.com, (3,), "m")
        exact = {
            "mass": mass,
            "com": com,
            "inertia": self._inertia(mass * (com @ com)),
            "axis": _axis(self.axis),
            "rotation": _rotation(self.rotation),
            "translation": numbers("translation", self.translation, (3,), "m"),
        }
        for name, value in exact.items():
            # Tuples whatever came, so that links compare and hash by their numbers.
            object.__setattr__(self, name, _tuples(value))

    def _inertia(self, steiner) -> np.ndarray:
        inertia = _symmetric(self.inertia)
        # A file's rounding is small against the inertia about the link's origin.
        size = max(np.max(np.abs(inertia)), steiner)
        a, b, c = np.linalg.eigvalsh(inertia)
        # A negative moment breaks the triangle inequality, too.
        if c > a + b + TOLERANCE * size:
            why = (
                f"{_shown(inertia)}: has the negative principal moment {a:.6g}"
                if a < -TOLERANCE * size
                else f"{_shown(inertia)}: the principal moments {a:.6g}, {b:.6g}, {c:.6g} break "
                "the triangle inequality: no distribution of mass has one greater than the sum of "
                "the others"
            )
            if self.triangle == "error":
                raise ValueError(
                    f'{why} (as published, it can be had with triangle="warn", from read_urdf with '
                    'inertia="warn")'
                )
            warnings.warn(f"link {self.name!r}: {why}", stacklevel=5)
        return inertia


def _axis(value) -> np.ndarray:
    axis = numbers("axis", value, (3,), "1")
    length = np.linalg.norm(axis)
    if abs(length - 1) > TOLERANCE:
        raise ValueError(f"axis = {axis.tolist()}: needs length 1, has {length:.6g}")
    return axis if abs(length - 1) <= ROUNDING else axis / length


def _rotation(value) -> np.ndarray:
    R = numbers("rotation", value, (3, 3), "1")
    error = np.max(np.abs(R.T @ R - np.eye(3))) if np.max(np.abs(R)) < 2 else np.inf
    if error > TOLERANCE:
        raise ValueError(f"rotation = {R.tolist()}: needs orthogonal columns of length 1")
    if np.linalg.det(R) < 0:
        raise ValueError(f"rotation = {R.tolist()}: a reflection (determinant −1), not a rotation")
    if error <= ROUNDING:
        return R
    left, _, right = np.linalg.svd(R)
    return left @ right


def _symmetric(value) -> np.ndarray:
    inertia = numbers("inertia", value, (3, 3), "kg·m²")
    if np.max(np.abs(inertia - inertia.T)) > TOLERANCE * np.max(np.abs(inertia)):
        raise ValueError(f"{_shown(inertia)}: needs a symmetric matrix")
    return (inertia + inertia.T) / 2


def _shown(inertia) -> str:
    return f"inertia = {inertia.tolist()} kg·m²"


def _tuples(value):
    return tuple(map(_tuples, value)) if np.ndim(value) else float(value)
