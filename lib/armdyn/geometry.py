"""What a regressor takes from a model: how its links lie and where gravity points, and no mass."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import singledispatch

import numpy as np
from numpy.typing import ArrayLike

from armdyn.manipulator import Manipulator, own_term
from armdyn.models import Pendulum, Planar2R, PlanarChain, SerialChain

PLANAR = ("m{0}", "m{0} cx{0}", "m{0} cy{0}", "J{0}")
SPATIAL = (
    *("m{0}", "m{0} cx{0}", "m{0} cy{0}", "m{0} cz{0}"),
    *("Jxx{0}", "Jxy{0}", "Jyy{0}", "Jxz{0}", "Jyz{0}", "Jzz{0}"),
)
# The entries of the inertia matrix in that order.
INERTIA = ((0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2))
# In m and m/s²: what is shorter or weaker is not there, and is no unit to measure by.
LEAST = 1e-9


@dataclass(frozen=True)
class PlanarGeometry:
    """Link lengths (m) and the gravitational acceleration (m/s²) in the axes q1 is measured in."""

    l: tuple[float, ...]
    gravity: tuple[float, float]
    # Where the potential energy is 0: at q = 0, or with all links at the height of joint 1.
    hangs: bool = False

    names = PLANAR

    @property
    def n(self) -> int:
        return len(self.l)

    @property
    def length(self) -> float:
        # How long the last link is does not enter Y.
        return sum(self.l[:-1])

    @property
    def revolute(self) -> np.ndarray:
        return np.ones(self.n, dtype=bool)

    def axes(self, q: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
        """The links' x and y axes, (..., n, 2) each, for q of shape (..., n)."""
        angle = np.cumsum(q, axis=-1)
        x_axis = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        return x_axis, np.stack([-x_axis[..., 1], x_axis[..., 0]], axis=-1)


@dataclass(frozen=True)
class SpatialGeometry:
    chain: SerialChain

    names = SPATIAL

    @property
    def n(self) -> int:
        return self.chain.n

    @property
    def gravity(self) -> tuple[float, ...]:
        return self.chain.gravity

    @property
    def length(self) -> float:
        # Where the arm stands is no length of its own.
        return float(sum(np.linalg.norm(link.translation) for link in self.chain.links[1:]))

    @property
    def revolute(self) -> np.ndarray:
        return np.array([link.joint == "revolute" for link in self.chain.links])


def geometry(model: Manipulator) -> PlanarGeometry | SpatialGeometry:
    """The geometry of a model.

    Raises ValueError for one without links that π belongs to, and for a subclass or an arm with an M,
    C, g or bias of its own, to which Y would not belong.
    """
    found = _geometry(model)
    for known in (Pendulum, Planar2R, PlanarChain, SerialChain):
        if isinstance(model, known):
            term = own_term(model, known, ("M", "C", "g_vec", "bias"))
            if term:
                raise ValueError(
                    f"model: this {type(model).__name__} has its own {term}, and the regressor is "
                    f"that of a {known.__name__}; needs one whose M, C, g_vec and bias are unchanged"
                )
    return found


@singledispatch
def _geometry(model):
    raise ValueError(
        f"model: got {type(model).__name__}, needs a Pendulum, a Planar2R, a PlanarChain or a "
        "SerialChain"
    )


@_geometry.register
def _(model: Pendulum):
    return PlanarGeometry(l=(0.0,), gravity=(model.g, 0.0), hangs=True)


@_geometry.register
def _(model: Planar2R):
    return PlanarGeometry(l=(model.l1, model.l2), gravity=(0.0, -model.g))


@_geometry.register
def _(model: PlanarChain):
    return PlanarGeometry(l=model.l, gravity=(0.0, -model.g))


@_geometry.register
def _(model: SerialChain):
    return SpatialGeometry(model)


def reach(model: Manipulator) -> float:
    """The arm's length from its first joint to its last, m; 1 where they are all at one place."""
    length = geometry(model).length
    return length if length > LEAST else 1.0


def fall_time(model: Manipulator) -> float:
    """The arm's own unit of time, s: √(reach / gravity), 1 without gravity."""
    gravity = np.linalg.norm(geometry(model).gravity)
    return float(np.sqrt(reach(model) / gravity)) if gravity > LEAST else 1.0


def joint_units(model: Manipulator) -> np.ndarray:
    """(n,): 1 rad for a revolute joint, the arm's reach in m for a prismatic one."""
    return np.where(geometry(model).revolute, 1.0, reach(model))


def powers_of_length(names: Sequence[str]) -> np.ndarray:
    """Of each entry of π by its name: 0 for m (kg), 1 for m c (kg·m), 2 for J (kg·m²)."""
    return np.array([2 if name.startswith("J") else 1 if " c" in name else 0 for name in names])


def sum_of_those_before(steps: np.ndarray) -> np.ndarray:
    """Σ over k < i of steps[..., k, :], for each i."""
    sums = np.cumsum(steps[..., :-1, :], axis=-2)
    return np.concatenate([np.zeros_like(steps[..., :1, :]), sums], axis=-2)


def column_indices(columns: Sequence[int] | None, count: int) -> tuple[int, ...]:
    """`columns`, sorted, all `count` of them for None; ValueError unless they are distinct indices."""
    if columns is None:
        return tuple(range(count))
    given = tuple(columns) if isinstance(columns, Iterable) else ()
    valid = all(
        isinstance(j, int | np.integer) and not isinstance(j, bool) and 0 <= j < count
        for j in given
    )
    if not valid or len(set(given)) != len(given) or not given:
        raise ValueError(f"columns = {columns!r}: needs distinct indices from 0 to {count - 1}")
    return tuple(sorted(int(j) for j in given))
