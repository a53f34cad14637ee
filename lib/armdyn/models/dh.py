"""Links from a table of Denavit–Hartenberg parameters."""

from collections.abc import Sequence
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from armdyn.models.link import Joint, Link
from armdyn.parameters import nonnegative, numbers, real_array
from armdyn.spatial import rotation

Convention = Literal["standard", "modified"]
X, Z = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)


def dh_links(
    a: ArrayLike,
    alpha: ArrayLike,
    d: ArrayLike,
    theta: ArrayLike,
    mass: ArrayLike,
    com: ArrayLike | None,
    inertia: ArrayLike | None,
    joints: str | Sequence[str] | None,
    convention: Convention,
    triangle: Literal["error", "warn"],
) -> tuple[Link, ...]:
    """The links of `SerialChain.from_dh`, which says what the arguments are."""
    if convention not in get_args(Convention):
        raise ValueError(f"convention = {convention!r}: needs 'standard' or 'modified'")
    n = _joint_count(a)
    a, d = numbers("a", a, (n,), "m"), numbers("d", d, (n,), "m")
    alpha, theta = numbers("alpha", alpha, (n,), "rad"), numbers("theta", theta, (n,), "rad")
    mass = numbers("mass", mass, (n,), "kg")
    com = numbers("com", np.zeros((n, 3)) if com is None else com, (n, 3), "m")
    inertia = np.zeros((n, 3, 3)) if inertia is None else inertia
    inertia = numbers("inertia", inertia, (n, 3, 3), "kg·m²")
    across = [
        (rotation(X, twist), np.array([step, 0, 0])) for twist, step in zip(alpha, a, strict=True)
    ]
    here = (np.eye(3), np.zeros(3))
    # A joint moves the frame of its Link about or along that frame's own z. In the standard
    # convention the step across a and α comes after that, inside the link: it moves what the link
    # has, and the joint after it.
    if convention == "standard":
        before, inside = [here, *across[:-1]], across
    else:
        before, inside = across, [here] * n
    links = []
    for k, kind in enumerate(_kinds(joints, n)):
        (R, p), (R_in, p_in) = before[k], inside[k]
        links.append(
            Link(
                kind,
                nonnegative(f"mass[{k}]", mass[k], "kg"),
                tuple(R_in @ com[k] + p_in),
                R_in @ inertia[k] @ R_in.T,
                rotation=R @ rotation(Z, theta[k]),
                translation=tuple(p + R @ [0, 0, d[k]]),
                name=f"link{k + 1}",
                triangle=triangle,
            )
        )
    return tuple(links)


def _joint_count(a) -> int:
    array = real_array("a", a, "one number per joint, in m")
    if array.ndim != 1 or array.size == 0:
        raise ValueError(f"a: got shape {array.shape}, needs one number per joint, in m")
    return array.size


def _kinds(joints, n) -> list[Joint]:
    if joints is None:
        return ["revolute"] * n
    if isinstance(joints, str) or not hasattr(joints, "__len__") or len(joints) != n:
        raise ValueError(f"joints = {joints!r}: needs {n} of 'revolute' and 'prismatic'")
    for k, kind in enumerate(joints):
        if kind not in get_args(Joint):
            raise ValueError(f"joints[{k}] = {kind!r}: needs 'revolute' or 'prismatic'")
    return list(joints)
