"""Links from screw axes: the product of exponentials."""

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from armdyn.models.link import TOLERANCE, Joint, Link
from armdyn.parameters import numbers, real_array
from armdyn.spatial import rigid_inertia


def screw_links(
    screws: ArrayLike, homes: ArrayLike, inertias: ArrayLike, triangle: Literal["error", "warn"]
) -> tuple[Link, ...]:
    """The links of `SerialChain.from_screws`, which says what the arguments are."""
    needs = "real numbers of shape (n, 6), a row [ω; v] per joint"
    n = len(np.atleast_1d(real_array("screws", screws, needs)))
    if np.shape(screws) != (n, 6) or n == 0:
        raise ValueError(f"screws: got shape {np.shape(screws)}, needs {needs}")
    screws = numbers("screws", screws, (n, 6), "1 and m")
    homes = numbers("homes", homes, (n, 4, 4), "1 and m")
    inertias = numbers("inertias", inertias, (n, 6, 6), "SI units")
    links = []
    R_before, at_before = np.eye(3), np.zeros(3)
    for k in range(n):
        R, home = _placement(f"homes[{k}]", homes[k])
        joint, direction, point = _axis(f"screws[{k}]", screws[k])
        mass, com, inertia = _body(f"inertias[{k}]", inertias[k])
        # A Link's frame lies on the axis of its joint: where the link's own frame is nearest to it.
        at = home
        if joint == "revolute":
            at = point + direction * (direction @ (home - point))
        links.append(
            Link(
                joint,
                mass,
                tuple(com + R.T @ (home - at)),
                inertia,
                tuple(R.T @ direction),
                R_before.T @ R,
                tuple(R_before.T @ (at - at_before)),
                name=f"link{k + 1}",
                triangle=triangle,
            )
        )
        R_before, at_before = R, at
    return tuple(links)


def _placement(name, home) -> tuple[np.ndarray, np.ndarray]:
    R = home[:3, :3]
    error = max(np.max(np.abs(R.T @ R - np.eye(3))), np.max(np.abs(home[3] - [0, 0, 0, 1])))
    if not (error <= TOLERANCE and np.linalg.det(R) > 0):
        raise ValueError(
            f"{name} = {home.tolist()}: needs a rotation and an origin over the row 0 0 0 1"
        )
    return R, home[:3, 3]


def _axis(name, screw) -> tuple[Joint, np.ndarray, np.ndarray]:
    """The kind of joint, its direction, and a point on its axis."""
    omega, v = screw[:3], screw[3:]
    spin, speed = float(np.linalg.norm(omega)), float(np.linalg.norm(v))
    if spin == 0 and abs(speed - 1) <= TOLERANCE:
        return "prismatic", v / speed, np.zeros(3)
    pitch = omega @ v
    if abs(spin - 1) <= TOLERANCE and abs(pitch) <= TOLERANCE * max(1, speed):
        return "revolute", omega / spin, np.cross(omega, v)
    raise ValueError(
        f"{name} = {screw.tolist()}: needs [ω; v] with ω of length 1 and ωᵀv = 0 (a revolute joint; "
        f"has {spin:.6g} and {pitch:.6g}), or with ω = 0 and v of length 1 (a prismatic one)"
    )


def _body(name, spatial) -> tuple:
    """Mass, centre of mass and the inertia about it, of a body with this spatial inertia."""
    mass = np.trace(spatial[3:, 3:]) / 3
    if mass < 0:
        raise ValueError(f"{name}[3, 3] = {mass:.6g}: the mass must not be negative (kg)")
    moment = spatial[:3, 3:]
    com = np.array([moment[2, 1], moment[0, 2], moment[1, 0]]) / (mass or 1.0)
    about_com = spatial[:3, :3] - rigid_inertia(mass, com, np.zeros((3, 3)))[:3, :3]
    symmetric = (about_com + about_com.T) / 2
    error = np.abs(rigid_inertia(mass, com, symmetric) - spatial)
    if np.max(error) > TOLERANCE * np.max(np.abs(spatial)):
        raise ValueError(
            f"{name}: needs the spatial inertia of a rigid body, [[J, m c×], [−m c×, m 1]], symmetric"
        )
    return float(mass), com, symmetric
