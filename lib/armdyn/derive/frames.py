"""Describes a serial chain in the frames in which its equation of motion has the fewest terms.

A link's frame may lie anywhere in the link, and part of a link's mass may be counted to the link
before it, without any change of M, C, g and P. Frames by the rule of Denavit and Hartenberg make most
entries of the joints' rotations 0 or 1. What lies on a joint's axis does not feel that joint: counted
to the link before, it leaves seven inertial numbers a revolute link instead of ten.

The masses of a link are one symmetric (4, 4) matrix J = ∫ x xᵀ dm over the points x = [r; 1]: second
moments Σ, first moments h and the mass m. Placed at T, they are T J Tᵀ. Here its entries are
coefficients, (4, 4, p), of p inertial parameters; of the number 1 where the masses are numbers.

Sources: J. Denavit, R. S. Hartenberg (1955), A Kinematic Notation for Lower-Pair Mechanisms Based on
Matrices; M. Gautier, W. Khalil (1990), Direct Calculation of Minimum Set of Inertial Parameters of
Serial Robots.
"""

from dataclasses import dataclass, replace

import numpy as np

# Axes at an angle whose sine is below this have their common normal too far away to be of use.
PARALLEL = 0.05
QUARTER = np.pi / 2


@dataclass(frozen=True)
class Joint:
    """A link's frame in that of the link before: at `position`, turned about x, then about z.

    revolute: it turns about z, by q + offset + quarters·π/2; otherwise it slides along z by q, and
    the same angle without q is fixed. One of offset and quarters is 0. cos, sin: of the angle about
    x. position: (3,), at q = 0, m. J: (4, 4, p), the link's masses.
    """

    revolute: bool
    cos: float
    sin: float
    offset: float
    quarters: int
    position: np.ndarray
    J: np.ndarray

    @property
    def transform(self) -> np.ndarray:
        """(4, 4), at q = 0."""
        about_x = np.array([[1, 0, 0], [0, self.cos, -self.sin], [0, self.sin, self.cos]])
        quarter = _axes_cleared(_about_z(self.quarters * QUARTER), 1e-15)
        return _transform(about_x @ quarter @ _about_z(self.offset), self.position)


@dataclass(frozen=True)
class Frames:
    """The chain in new frames.

    gravity: (3,), in the frame that the first joint starts from, m/s². still: P less that of the
    masses in the joints' J, with that frame's origin at height 0, (p,), J.
    """

    joints: tuple[Joint, ...]
    gravity: np.ndarray
    still: np.ndarray


def frames(links, gravity, masses, tolerance: float) -> Frames:
    """The same chain in the frames described above.

    links: with joint, axis, rotation and translation each, as `armdyn.models.Link` has them. masses:
    J of each link in its own frame, (4, 4, p). What is at most `tolerance` times the largest of its
    kind is taken for 0.
    """
    # Where the robot stands changes nothing but P's constant: the first joint's place does not count.
    places = [link.com for link in links] + [link.translation for link in links[1:]]
    length = float(np.max(np.abs(places))) or 1.0
    gravity = np.array(gravity, dtype=float)
    base, transforms, moved = _new_frames(links, gravity, tolerance, length)
    joints = []
    for link, transform, at, J in zip(links, transforms, moved, masses, strict=True):
        J = _carried(np.linalg.inv(at), J)
        joints.append(_joint(link.joint == "revolute", transform, J, tolerance, length))
    total = sum(J[3, 3] for J in masses)
    pull = base[:3, :3].T @ gravity
    pull = _cleared(pull, tolerance * np.linalg.norm(pull))
    regrouped, rest = _regrouped(joints, tolerance, length)
    return Frames(tuple(regrouped), pull, -(pull @ rest[:3, 3]) - total * (gravity @ base[:3, 3]))


def _new_frames(links, gravity, tolerance, length):
    """(base, transforms, moved): the base's new frame in the old, and for each link the new frame in
    the new frame of the link before at q = 0, and in the link's own old frame."""
    upright = [_transform(_with_z_along(np.array(link.axis))) for link in links]
    placed = [
        _transform(link.rotation, link.translation) @ up
        for link, up in zip(links, upright, strict=True)
    ]
    base = placed[0]
    transforms: list[np.ndarray] = []
    moved: list[np.ndarray] = []
    for k, link in enumerate(links):
        at = np.linalg.inv(moved[k - 1]) @ placed[k] if k else np.eye(4)
        if k + 1 < len(links):
            following = np.linalg.inv(upright[k]) @ placed[k + 1]
            choice = _towards(following, link.joint, tolerance, length)
        else:
            choice = _shortest(at, link.joint)
        if k == 0:
            # The base's frame is as free as a link's.
            start = choice
            if link.joint == "revolute":
                across = (base @ start)[:3, :2].T @ gravity
                if np.linalg.norm(across) > tolerance * np.linalg.norm(gravity):
                    start = start @ _transform(_about_z(np.arctan2(across[1], across[0])))
            base = base @ start
            # Not from `base`, whose place may be large beside the robot.
            at = np.linalg.inv(start)
        transforms.append(at @ choice)
        moved.append(upright[k] @ choice)
    return base, transforms, moved


def _towards(following, joint, tolerance, length):
    """A link's frame, its z along its own axis, by where the next joint's axis lies: x along the
    common normal and, for a turning link, the origin at its foot."""
    axis, p = following[:3, 2], following[:3, 3]
    across = np.hypot(axis[0], axis[1])
    if across > tolerance:
        x = np.array([-axis[1], axis[0]]) / across
    elif np.hypot(p[0], p[1]) > tolerance * length:
        x = p[:2] / np.hypot(p[0], p[1])
    else:
        x = np.array([1.0, 0.0])
    turn = _about_z(np.arctan2(x[1], x[0]))
    if joint == "prismatic":
        return _transform(turn, p)
    along = p[2]
    if across > PARALLEL:
        along += axis[2] * (turn.T @ p)[1] / across
    return _transform(turn, (0, 0, along))


def _shortest(at, joint):
    """The last link's frame: no angle about z, and its origin as near as may be."""
    R, p = at[:3, :3], at[:3, 3]
    turn = _about_z(-np.arctan2(-R[0, 1], R[0, 0]))
    back = -R.T @ p
    return _transform(turn, back if joint == "prismatic" else (0, 0, back[2]))


def _joint(revolute, transform, J, tolerance, length):
    R = transform[:3, :3]
    cos, sin = _cleared(np.array([R[2, 2], -R[1, 2]]), tolerance)
    cos, sin = np.array([cos, sin]) / np.hypot(cos, sin)
    angle = np.arctan2(-R[0, 1], R[0, 0])
    quarters = round(angle / QUARTER)
    exact = abs(angle - quarters * QUARTER) <= tolerance
    return Joint(
        revolute=revolute,
        cos=float(cos),
        sin=float(sin),
        offset=0.0 if exact else float(angle),
        quarters=quarters if exact else 0,
        position=_cleared(transform[:3, 3], tolerance * length),
        J=J,
    )


def _regrouped(joints, tolerance, length):
    """(joints, J of the base) with what a joint does not move counted to the link before it."""
    J = [np.zeros_like(joints[0].J), *(joint.J for joint in joints)]
    size = [np.abs(entry) for entry in J]
    for k in reversed(range(len(joints))):
        unmoved = np.zeros((4, 4, 1), dtype=bool)
        # On the axis of a turning link; the turning inertia of one that slides.
        unmoved[(slice(2, 4),) * 2 if joints[k].revolute else (slice(0, 3),) * 2] = True
        T = joints[k].transform
        J[k] = J[k] + _carried(T, np.where(unmoved, J[k + 1], 0))
        size[k] = size[k] + _carried(np.abs(T), np.where(unmoved, size[k + 1], 0))
        left = np.where(unmoved, 0, J[k + 1])
        J[k + 1] = _significant(left, size[k + 1], tolerance, length)
    kept = [replace(joint, J=entry) for joint, entry in zip(joints, J[1:], strict=True)]
    return kept, J[0]


def _significant(J, size, tolerance, length):
    """J without the entries that are rounding beside those they were computed from."""
    mass = size[3, 3]
    largest = np.empty_like(J)
    largest[:3, :3] = np.maximum(np.max(size[:3, :3], axis=(0, 1)), tolerance * mass * length**2)
    largest[:3, 3] = largest[3, :3] = np.maximum(np.max(size[:3, 3], axis=0), mass * length)
    largest[3, 3] = mass
    return _cleared(J, tolerance * largest)


def _carried(T, J):
    """T J Tᵀ of each parameter."""
    return np.einsum("ij,jkp,lk->ilp", T, J, T)


def _cleared(values, least):
    """The values with 0 for those of at most this size."""
    return np.where(np.abs(values) <= least, 0.0, values)


def _axes_cleared(R, tolerance):
    """A rotation with 0 and ±1 for entries as near to them."""
    R = _cleared(R, tolerance)
    return np.where(np.abs(np.abs(R) - 1) <= tolerance, np.sign(R), R)


def _transform(R, p=(0.0, 0.0, 0.0)):
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, p
    return T


def _about_z(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def _with_z_along(axis):
    """The rotation by the least angle that takes z, or −z where that is nearer, to the axis."""
    if axis[2] < 0:
        return np.diag([1.0, -1.0, -1.0]) @ _with_z_along(axis * (1, -1, -1))
    x, y, z = axis
    cross = np.array([[0, 0, x], [0, 0, y], [-x, -y, 0]])
    return np.eye(3) + cross + cross @ cross / (1 + z)
