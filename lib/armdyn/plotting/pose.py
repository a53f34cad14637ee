"""Computes where the parts of an arm are, for every picture of one."""

import math
from dataclasses import dataclass
from functools import singledispatch

import numpy as np
from numpy.typing import ArrayLike

from armdyn.manipulator import Manipulator
from armdyn.models import Pendulum, Planar2R, PlanarChain
from armdyn.parameters import state_vector


@dataclass(frozen=True)
class Skeleton:
    """The links of a planar arm, m, each (n,); `zero` is the direction of q1 = 0, rad from x.

    The centre of mass of link k is at lc[k] along the link and ly[k] to the left of it.
    """

    l: np.ndarray
    lc: np.ndarray
    ly: np.ndarray
    zero: float

    @property
    def reach(self) -> float:
        """The radius of the circle that no part leaves, m; 1 where every part is at the joint."""
        bases = np.concatenate([[0], np.cumsum(self.l)])
        return float(max(bases[-1], np.max(bases[:-1] + np.hypot(self.lc, self.ly)))) or 1.0

    def angles(self, q: ArrayLike) -> np.ndarray:
        """Each link's own direction, rad from x, of the shape of q."""
        return self.zero + np.cumsum(q, axis=-1)


@dataclass(frozen=True)
class Pose:
    """Joints and tip (..., n + 1, 2) and centres of mass (..., n, 2), m; and the directions from
    which the angles count (..., n), rad.
    """

    joints: np.ndarray
    centres: np.ndarray
    zeros: np.ndarray


@singledispatch
def skeleton(model: Manipulator) -> Skeleton:
    """The links of a model. Raises TypeError for one that cannot be drawn."""
    raise TypeError(
        f"plotting draws a Pendulum, a Planar2R or a PlanarChain, got {type(model).__name__}"
    )


@skeleton.register
def _(model: Pendulum) -> Skeleton:
    # A pendulum has no length: the uniform rod with this m, lc and I ends here, a point mass at lc.
    beyond = math.sqrt(3 * max(model.I / model.m - model.lc**2, 0.0))
    return _skeleton([model.lc + beyond], [model.lc], [0.0], -math.pi / 2)


@skeleton.register
def _(model: Planar2R) -> Skeleton:
    return _skeleton([model.l1, model.l2], [model.lc1, model.lc2], [0.0, 0.0], 0.0)


@skeleton.register
def _(model: PlanarChain) -> Skeleton:
    return _skeleton(model.l, model.lc, model.ly, 0.0)


def pose(model: Manipulator, q: ArrayLike) -> Pose:
    """The pose at q, (..., n), rad. Raises as `skeleton`, and ValueError for another shape."""
    parts = skeleton(model)
    q = state_vector("q", q, model.n)
    angles = parts.angles(q)
    along, left = direction(angles), direction(angles + math.pi / 2)
    ends = np.cumsum(parts.l[:, np.newaxis] * along, axis=-2)
    joints = np.concatenate([np.zeros_like(ends[..., :1, :]), ends], axis=-2)
    offsets = parts.lc[:, np.newaxis] * along + parts.ly[:, np.newaxis] * left
    return Pose(joints, joints[..., :-1, :] + offsets, angles - q)


def direction(angle: ArrayLike) -> np.ndarray:
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def _skeleton(l, lc, ly, zero) -> Skeleton:
    return Skeleton(np.array(l, float), np.array(lc, float), np.array(ly, float), zero)
