"""Estimates inertial parameters from measured motion and torque, by linear least squares.

Joint torques show only the base parameters, so only they are estimated: see
`armdyn.base_parameters`.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse.csgraph import connected_components

from armdyn.base_parameters import BaseParameters, base_parameters, motors_apart
from armdyn.consistency import Consistency, consistent_parameters
from armdyn.geometry import geometry, joint_units, powers_of_length, reach
from armdyn.manipulator import Manipulator
from armdyn.models import SerialChain
from armdyn.parameters import state_vector, state_vectors
from armdyn.regressor import armature_columns, friction_columns, regressor

# A singular value below this share of the largest, columns scaled to length 1, counts as 0: geometry
# with rounded angles, which are off by up to this much, shows no parameter better.
DEFICIENT = 1e-5
# What rounding in double precision alone can show; and how much of the null space couples two columns.
ROUNDING, COUPLED = 1e-13, 1e-3


@dataclass(frozen=True, eq=False)
class Excitation:
    """How well a motion shows the parameters.

    names: of the base parameters, then of motors and of friction. rank: of the stacked regressor's
    columns, at most len(names). condition: the ratio of its singular values, each column scaled to
    length 1, so that units do not enter; infinite where the rank falls short. confused: groups of
    parameters that the motion cannot tell apart; a group of one has no effect on the torques at all.
    What shows below the tolerance (see `excitation`) does not count. base: the base parameters.
    """

    names: tuple[str, ...]
    rank: int
    condition: float
    confused: tuple[tuple[str, ...], ...]
    base: BaseParameters

    @property
    def sufficient(self) -> bool:
        return self.rank == len(self.names)

    def __str__(self):
        if self.sufficient:
            return f"shows all {self.rank} parameters, condition number {self.condition:.3g}"
        groups = "; ".join(
            f"{group[0]} has no effect"
            if len(group) == 1
            else f"{', '.join(group)}: not told apart"
            for group in self.confused
        )
        return f"shows {self.rank} of {len(self.names)} parameters ({groups})"


@dataclass(frozen=True, eq=False)
class Identification:
    """What least squares found.

    names: of the estimates, the base parameters first, then with armature "armature2" … and with
    friction "viscous1" … and "coulomb1" …. estimate, standard_error: (p,), in the units of π, kg·m²,
    N·m·s/rad and N·m (kg, N·s/m and N for a prismatic joint). residual: the standard deviation of u that
    is left, with the degrees of freedom taken off: in N·m, a force counted as its torque at the arm's
    reach; or where `noise` was given, as a multiple of it.

    consistency: whether bodies exist that have exactly the estimated base parameters, and if so
    one full π of theirs. It judges the estimate, not its error bars: where noise alone has made a
    light link's inertia negative, it says that no such body exists, and a nearby one may. Where a base
    parameter holds an armature, a motor may have any part of it that is not negative.
    """

    base: BaseParameters
    names: tuple[str, ...]
    estimate: np.ndarray
    standard_error: np.ndarray
    residual: float
    excitation: Excitation
    consistency: Consistency
    weighted: bool
    model: Manipulator
    motors: bool

    def torque(self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike) -> np.ndarray:
        """u of any motion by the estimates, friction and motors included if they were, (..., n).

        q, qd, qdd: (..., n), as for `identify`. Of a motion that the estimates have not seen, it shows
        whether they are good for more than the fit. Raises ValueError for states of the wrong shape or
        not finite.
        """
        q, qd, qdd = np.broadcast_arrays(*state_vectors(self.model.n, q=q, qd=qd, qdd=qdd))
        base = self.estimate[: self.base.rank]
        u = regressor(self.model, q, qd, qdd)[..., list(self.base.independent)] @ base
        if self.motors:
            joints = [int(name.removeprefix("armature")) - 1 for name in self.armature]
            u = u + armature_columns(qdd)[..., joints] @ list(self.armature.values())
        elif isinstance(self.model, SerialChain):
            u = u + np.array(self.model.armature) * qdd
        return u + friction_columns(qd) @ self.friction if self.friction.size else u

    @property
    def rank(self) -> int:
        return self.excitation.rank

    @property
    def condition(self) -> float:
        return self.excitation.condition

    @property
    def consistent(self) -> bool:
        return self.consistency.exists

    @property
    def friction(self) -> np.ndarray:
        """Viscous coefficients, then Coulomb torques, (2n,); empty if friction was not asked for."""
        return self._named("viscous", "coulomb")

    @property
    def armature(self) -> dict[str, float]:
        """By name, "armature2" …, kg·m² or kg: of the joints whose motors torque tells from links."""
        names = (name for name in self.names if name.startswith("armature"))
        return dict(zip(names, self._named("armature").tolist(), strict=True))

    def _named(self, *kinds) -> np.ndarray:
        return self.estimate[[name.startswith(kinds) for name in self.names]]

    def __str__(self):
        width = max(map(len, self.names))
        rows = (
            f"{name:<{width}}  {value: .5g} ± {error:.1g}"
            for name, value, error in zip(
                self.names, self.estimate, self.standard_error, strict=True
            )
        )
        bodies = "exist" if self.consistent else "do not exist"
        unit = "times the noise" if self.weighted else "N·m"
        last = f"residual {self.residual:.3g} {unit}; bodies with these parameters {bodies}"
        return "\n".join(filter(None, [*rows, self.base.remark, last]))


def excitation(
    model: Manipulator,
    q: ArrayLike,
    qd: ArrayLike,
    qdd: ArrayLike,
    friction: bool = False,
    columns: Sequence[int] | None = None,
    tolerance: float | None = None,
    noise: ArrayLike | None = None,
    armature: bool = False,
) -> Excitation:
    """What a motion shows of the parameters, before any torque is measured.

    Arguments and errors are those of `identify`, except that too few samples show as a lower rank.
    """
    q, qd, qdd = _samples(model, q=q, qd=qd, qdd=qdd)
    base = base_parameters(model, columns, tolerance)
    stacked = _columns(model, base, q, qd, qdd, friction, noise, armature)
    return _excitation(base, *stacked, tolerance)


def identify(
    model: Manipulator,
    q: ArrayLike,
    qd: ArrayLike,
    qdd: ArrayLike,
    u: ArrayLike,
    friction: bool = False,
    columns: Sequence[int] | None = None,
    tolerance: float | None = None,
    noise: ArrayLike | None = None,
    armature: bool = False,
) -> Identification:
    """Base parameters, and with `friction` the friction of each joint, by least squares.

    model: gives the geometry and gravity, and the armature if that is not estimated; its masses,
    inertias and friction do not enter. q, qd, qdd, u: samples of a motion, (..., n), rad, rad/s,
    rad/s², N·m; for a prismatic joint m, m/s, m/s², N. columns, tolerance: as for `base_parameters`.
    What the motion shows by less than the tolerance, 1e-5 by default, counts as not shown: rounded
    angles in the geometry can do that alone.
    noise: (n,), the standard deviation of each joint's u, N·m or N, or any numbers in proportion; by
    default the same at all joints, with a force counted as its torque at the arm's reach.

    armature: whether to estimate the inertia of the motors, too. Otherwise the model's own is taken as
    known, and its part of u is subtracted. Of the first joint's motor, and on some arms of others',
    torque shows only the sum with inertia of the links; that sum is then the base parameter's estimate,
    as its name says.

    The standard errors are those of ordinary least squares: u has independent noise at each sample and
    joint, in proportion to `noise`, and q, q̇, q̈ have none. Noise in q̈ biases the estimates towards 0,
    and no error bar shows it.

    Raises ValueError for bad arguments, for samples too few to leave a residual, for a motion that
    cannot tell the parameters apart, naming them, and where nothing at all loads the joints.

    Source: C. G. Atkeson, C. H. An, J. M. Hollerbach (1986), Estimation of Inertial Parameters of
    Manipulator Loads and Links.
    """
    q, qd, qdd, u = _samples(model, q=q, qd=qd, qdd=qdd, u=u)
    base = base_parameters(model, columns, tolerance)
    W, names, full = _columns(model, base, q, qd, qdd, friction, noise, armature)
    equations, unknowns = W.shape
    if not unknowns:
        raise ValueError("columns: none of these parameters loads a joint; needs one that does")
    if equations <= unknowns:
        raise ValueError(
            f"q: {q.size // model.n} samples give {equations} equations; {unknowns} parameters and "
            f"their standard errors need at least {unknowns // model.n + 1} samples"
        )
    shown = _excitation(base, W, names, full, tolerance)
    if not shown.sufficient:
        raise ValueError(
            f"q, qd, qdd: the motion {shown}; needs a motion that moves more of the arm, or a smaller "
            "tolerance if the geometry is exact"
        )

    if isinstance(model, SerialChain) and not armature:
        u = u - np.array(model.armature) * qdd
    measured = (u / _noise(noise, model)).ravel()
    size = np.linalg.norm(W, axis=0)
    left, values, right = np.linalg.svd(W / size, full_matrices=False)
    estimate = right.T @ (left.T @ measured / values) / size
    rest = measured - W @ estimate
    residual = np.sqrt(rest @ rest / (equations - unknowns))
    standard_error = residual * np.linalg.norm(right.T / values, axis=1) / size
    consistency = consistent_parameters(
        *(base.combination, estimate[: base.rank], base.columns, model.n, reach(model)),
        motors=_motors_among(model, base) if armature else None,
    )
    return Identification(
        *(base, names, estimate, standard_error, residual, shown, consistency),
        weighted=noise is not None,
        model=model,
        motors=bool(armature),
    )


def _samples(model, **named) -> tuple[np.ndarray, ...]:
    arrays = np.broadcast_arrays(*state_vectors(model.n, **named))
    if arrays[0].size == 0:
        raise ValueError(
            f"{', '.join(named)}: got shape {arrays[0].shape}, needs at least 1 sample"
        )
    return arrays


def _noise(noise, model) -> np.ndarray:
    if noise is None:
        return 1 / joint_units(model)
    scale = state_vector("noise", noise, model.n)
    if scale.shape != (model.n,) or np.any(scale <= 0):
        raise ValueError(
            f"noise = {scale.tolist()}: needs {model.n} numbers greater than 0, one per joint, in N·m "
            "(N for a prismatic joint)"
        )
    return scale


def _shortened(sum_: str) -> str:
    """The first term is the base parameter's own; in space dozens may follow."""
    return sum_ if len(sum_) <= 48 else re.split(" [+−] ", sum_, maxsplit=1)[0] + " + …"


def _with_motors(names, joints, shares) -> tuple[str, ...]:
    """The names with what torque does not tell from them, such as "Jzz1 + armature1"."""
    summed = list(names)
    for j in np.delete(np.arange(shares.shape[1]), joints):
        for i in np.flatnonzero(shares[:, j]):
            sign, size = "+" if shares[i, j] > 0 else "−", abs(shares[i, j])
            times = "" if np.isclose(size, 1) else f"{size:.4g} "
            summed[i] += f" {sign} {times}armature{j + 1}"
    return tuple(summed)


def _motors_among(model, base) -> np.ndarray:
    """What the armatures that torque does not tell from links add to the base parameters."""
    joints, shares = motors_apart(model, base)
    return np.delete(shares[: base.rank], joints, axis=1)


def _columns(
    model, base, q, qd, qdd, friction, noise, armature
) -> tuple[np.ndarray, tuple[str, ...], np.ndarray]:
    """The columns of the unknowns, one row per sample and joint, in units of the noise; their names;
    and how large each would be if this motion loaded it in full."""
    if not isinstance(armature, bool | np.bool_):
        raise ValueError(
            f"armature = {armature!r}: needs True to estimate it or False; known values are the model's"
        )
    scale = _noise(noise, model)
    Y = regressor(model, q, qd, qdd)[..., list(base.independent)]
    names = tuple(map(_shortened, base.descriptions))
    full = _full_effect(model, base, q, qd, qdd) * np.linalg.norm(1 / (scale * joint_units(model)))
    if armature:
        motors, shares = motors_apart(model, base)
        Y = np.concatenate([Y, armature_columns(qdd)[..., motors]], axis=-1)
        names = _with_motors((*names, *(f"armature{j + 1}" for j in motors)), motors, shares)
        full = np.concatenate([full, np.zeros(len(motors))])
    if friction:
        Y = np.concatenate([Y, friction_columns(qd)], axis=-1)
        joints = range(1, model.n + 1)
        names += tuple(f"{kind}{i}" for kind in ("viscous", "coulomb") for i in joints)
        full = np.concatenate([full, np.zeros(2 * model.n)])
    return (Y / scale[:, np.newaxis]).reshape(q.size, len(names)), names, full


def _excitation(base, W, names, full, tolerance) -> Excitation:
    if not names:
        return Excitation(names, 0, 1.0, (), base)
    deficient = DEFICIENT if tolerance is None else max(float(tolerance), ROUNDING)
    size = np.linalg.norm(W, axis=0)
    # Of a full column, rounded angles can leave their own share where there should be nothing.
    size = np.where(size > np.maximum(deficient * full, ROUNDING * np.max(size)), size, np.inf)
    triangle = np.linalg.qr(np.vstack([W / size, np.zeros((len(names), len(names)))]), mode="r")
    _, values, right = np.linalg.svd(triangle)
    shown = values > deficient * values[0]
    rank = int(np.count_nonzero(shown))
    if rank == len(names):
        return Excitation(names, rank, float(values[0] / values[-1]), (), base)
    # Two parameters are confused when some motion-free change of π changes both: the projector on
    # the null space couples them.
    hidden = right[~shown].T @ right[~shown]
    count, label = connected_components(np.abs(hidden) > COUPLED, directed=False)
    groups = (np.flatnonzero(label == k) for k in range(count))
    confused = tuple(
        tuple(names[j] for j in group)
        for group in groups
        if np.any(np.abs(hidden[group, group]) > COUPLED)
    )
    return Excitation(names, rank, np.inf, confused, base)


def _full_effect(model, base, q, qd, qdd) -> np.ndarray:
    """Per base parameter, over all samples: the torque of a unit of it, far out and straight across."""
    length, units = reach(model), joint_units(model)
    turning = np.sum(np.abs(qdd) / units, axis=-1) + np.sum(np.abs(qd) / units, axis=-1) ** 2
    moving = length * turning + np.linalg.norm(geometry(model).gravity)
    # N·m per kg, per kg·m and per kg·m².
    full = np.linalg.norm([(length * moving).ravel(), moving.ravel(), turning.ravel()], axis=1)
    return full[powers_of_length(base.names)[list(base.independent)]]
