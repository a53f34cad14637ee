"""Computes the regressor Y of the inertial parameters: M q̈ + C q̇ + g = Y(q, q̇, q̈) π.

Y holds only geometry (lengths, joint axes, gravity), π only inertia: per link the mass, the first
moment m c and the inertia about the joint frame. In these, and not in ℓc and an inertia about the
centre of mass, the equation of motion is linear. Friction is no inertial parameter: it has columns
of its own, `friction_columns`; so has the inertia of motors, `armature_columns`.

π per link, in this order:

- planar arms and the pendulum, 4: m (kg), m cx, m cy (kg·m), J (kg·m²). x is along the link, y
  across it, the origin at the link's joint.
- spatial chains, 10: m, m cx, m cy, m cz, Jxx, Jxy, Jyy, Jxz, Jyz, Jzz, in the link's frame. J is the
  inertia matrix about the frame's origin, so that Jxy = −∫ x y dm.

Source: C. G. Atkeson, C. H. An, J. M. Hollerbach (1986), Estimation of Inertial Parameters of
Manipulator Loads and Links.
"""

from dataclasses import dataclass
from functools import singledispatch

import numpy as np

from armdyn.models import Pendulum, Planar2R, PlanarChain, SerialChain
from armdyn.parameters import state_vector, state_vectors

PLANAR = ("m{0}", "m{0} cx{0}", "m{0} cy{0}", "J{0}")
SPATIAL = (
    *("m{0}", "m{0} cx{0}", "m{0} cy{0}", "m{0} cz{0}"),
    *("Jxx{0}", "Jxy{0}", "Jyy{0}", "Jxz{0}", "Jyz{0}", "Jzz{0}"),
)
# The entries of the inertia matrix in that order.
INERTIA = ((0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2))


@dataclass(frozen=True)
class _PlanarGeometry:
    """Link lengths (m) and the gravitational acceleration (m/s²) in the axes q1 is measured in."""

    l: tuple[float, ...]
    gravity: tuple[float, float]

    names = PLANAR

    @property
    def n(self) -> int:
        return len(self.l)

    @property
    def length(self) -> float:
        return sum(self.l) / self.n

    def regressor(self, q, qd, qdd) -> np.ndarray:
        return _planar_regressor(self, q, qd, qdd)


@dataclass(frozen=True)
class _SpatialGeometry:
    chain: SerialChain

    names = SPATIAL

    @property
    def n(self) -> int:
        return self.chain.n

    @property
    def length(self) -> float:
        lengths = [np.linalg.norm(link.translation) for link in self.chain.links]
        return float(sum(lengths) / self.n)

    def regressor(self, q, qd, qdd) -> np.ndarray:
        return _spatial_regressor(self.chain, q, qd, qdd)


@singledispatch
def _geometry(model):
    raise ValueError(
        f"model: got {type(model).__name__}, needs a Pendulum, a Planar2R, a PlanarChain or a "
        "SerialChain"
    )


@_geometry.register
def _(model: Pendulum):
    return _PlanarGeometry(l=(0.0,), gravity=(model.g, 0.0))


@_geometry.register
def _(model: Planar2R):
    return _PlanarGeometry(l=(model.l1, model.l2), gravity=(0.0, -model.g))


@_geometry.register
def _(model: PlanarChain):
    return _PlanarGeometry(l=model.l, gravity=(0.0, -model.g))


@_geometry.register
def _(model: SerialChain):
    return _SpatialGeometry(model)


@singledispatch
def parameters(model) -> np.ndarray:
    """π of a model, all links in a row: (4n,) for planar arms, (10n,) for spatial chains.

    The order and units are the module's. Raises ValueError for a model that has no links to read
    them from.
    """
    _geometry(model)
    raise NotImplementedError(f"{type(model).__name__} has a geometry, but no parameters")


@parameters.register
def _(model: Pendulum):
    return np.array([model.m, model.m * model.lc, 0.0, model.I])


@parameters.register
def _(model: Planar2R):
    return _planar_parameters(
        (model.m1, model.m2), (model.lc1, model.lc2), (0.0, 0.0), (model.I1, model.I2)
    )


@parameters.register
def _(model: PlanarChain):
    return _planar_parameters(model.m, model.lc, model.ly, model.I)


@parameters.register
def _(model: SerialChain):
    mass = np.array([link.mass for link in model.links])[:, np.newaxis]
    com = np.array([link.com for link in model.links])
    # Steiner: about the frame's origin, m (|c|² 1 − c cᵀ) more than about the centre of mass.
    spread = np.vecdot(com, com)[:, np.newaxis, np.newaxis] * np.eye(3)
    spread = spread - com[:, :, np.newaxis] * com[:, np.newaxis, :]
    J = np.array([link.inertia for link in model.links]) + mass[..., np.newaxis] * spread
    return np.concatenate([mass, mass * com, J[:, *np.transpose(INERTIA)]], axis=-1).ravel()


def parameter_names(model) -> tuple[str, ...]:
    """The names of the entries of π; "J2" is the inertia of link 2 about its joint."""
    geometry = _geometry(model)
    return tuple(name.format(i + 1) for i in range(geometry.n) for name in geometry.names)


def regressor(model, q, qd, qdd) -> np.ndarray:
    """Y with M q̈ + C q̇ + g = Y π, (..., n, 4n) for planar arms, (..., n, 10n) for spatial chains.

    q, qd, qdd: (..., n), rad, rad/s, rad/s² (m for a prismatic joint). Of the model only the geometry
    and gravity enter, not its masses: another arm of the same geometry has the same Y. Raises
    ValueError for states of the wrong shape or not finite, and for a model without links.
    """
    geometry = _geometry(model)
    q, qd, qdd = np.broadcast_arrays(*state_vectors(geometry.n, q=q, qd=qd, qdd=qdd))
    return geometry.regressor(q, qd, qdd)


def reach(model) -> float:
    """A length of the arm's size, m: the mean length of its links, 1 where it has none."""
    return _geometry(model).length or 1.0


def armature_columns(qdd) -> np.ndarray:
    """A with A a = the motors' part of M q̈, a the armature of each joint; (..., n, n).

    qdd: (..., n), rad/s² (m/s² for a prismatic joint). Raises ValueError for a qdd that is not
    finite numbers.

    The column of a first revolute joint is also that of its link's inertia about the joint's axis:
    torque shows only the sum of the two. On some arms this holds of joints further out, too.

    Source: W. Khalil, E. Dombre (2002), Modeling, Identification and Control of Robots, chapter 9.
    """
    size = np.shape(qdd)[-1:] or (1,)
    return np.eye(*size) * state_vector("qdd", qdd, *size)[..., np.newaxis]


def friction_columns(qd) -> np.ndarray:
    """F with f(q̇) = F [d; k]: viscous coefficients d, then Coulomb torques k; (..., n, 2n).

    qd: (..., n), rad/s. Raises ValueError for a qd that is not finite numbers.
    """
    size = np.shape(qd)[-1:] or (1,)
    qd = state_vector("qd", qd, *size)
    each = np.eye(*size)
    return np.concatenate(
        [each * qd[..., np.newaxis], each * np.sign(qd)[..., np.newaxis]], axis=-1
    )


def _planar_parameters(m, lc, ly, I) -> np.ndarray:
    m, lc, ly, I = map(np.asarray, (m, lc, ly, I))
    return np.stack([m, m * lc, m * ly, I + m * (lc**2 + ly**2)], axis=-1).ravel()


def _planar_regressor(geometry, q, qd, qdd) -> np.ndarray:
    """Each link's force and moment about its joint are linear in its π; carry them to the joints."""
    angle = np.cumsum(q, axis=-1)
    rate, acceleration = np.cumsum(qd, axis=-1), np.cumsum(qdd, axis=-1)
    x_axis = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    y_axis = np.stack([-x_axis[..., 1], x_axis[..., 0]], axis=-1)
    spin, swing = acceleration[..., np.newaxis], rate[..., np.newaxis] ** 2
    # The second derivatives of the two axes, and with them of every point fixed in the link.
    x_axis_dd, y_axis_dd = spin * y_axis - swing * x_axis, -spin * x_axis - swing * y_axis

    length = np.array(geometry.l)[:, np.newaxis]
    joint = _sum_of_those_before(length * x_axis)
    # Gravity acts as the base's acceleration the other way.
    joint_dd = _sum_of_those_before(length * x_axis_dd) - np.array(geometry.gravity)

    nothing = np.zeros_like(joint)
    force = np.stack([joint_dd, x_axis_dd, y_axis_dd, nothing], axis=-2)
    moment = np.stack(
        [nothing[..., 0], _cross(x_axis, joint_dd), _cross(y_axis, joint_dd), acceleration], axis=-1
    )
    n = geometry.n
    lever = joint[..., np.newaxis, :, :] - joint[..., :, np.newaxis, :]
    torque = moment[..., np.newaxis, :, :] + _cross(
        lever[..., np.newaxis, :], force[..., np.newaxis, :, :, :]
    )
    # A link loads its own joint and those before it.
    torque = np.where(np.triu(np.ones((n, n), dtype=bool))[..., np.newaxis], torque, 0.0)
    return torque.reshape(*q.shape, n * len(PLANAR))


def _sum_of_those_before(steps) -> np.ndarray:
    """Σ over k < i of steps[..., k, :], for each i."""
    return np.cumsum(steps, axis=-2) - steps


def _cross(a, b) -> np.ndarray:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def _spatial_regressor(chain, q, qd, qdd) -> np.ndarray:
    """As in the plane, but the motion is carried outwards link by link, in the base's axes."""
    R, p = chain.link_placements(q)
    axis = np.matvec(R, np.array([link.axis for link in chain.links]))
    Y = np.zeros((*q.shape, chain.n, len(SPATIAL)))
    rate = spin = origin = np.zeros((*q.shape[:-1], 3))  # ω, ω̇ and the link's origin
    origin_dd = np.broadcast_to(-np.array(chain.gravity), origin.shape)
    for k, link in enumerate(chain.links):
        lever = p[..., k, :] - origin
        origin = p[..., k, :]
        origin_dd = origin_dd + np.cross(spin, lever) + np.cross(rate, np.cross(rate, lever))
        moved, moved_dd = (
            axis[..., k, :] * qd[..., k : k + 1],
            axis[..., k, :] * qdd[..., k : k + 1],
        )
        if link.joint == "revolute":
            spin = spin + moved_dd + np.cross(rate, moved)
            rate = rate + moved
        else:
            origin_dd = origin_dd + moved_dd + 2 * np.cross(rate, moved)
        force, moment = _spatial_load(R[..., k, :, :], rate, spin, origin_dd)
        for j in range(k + 1):
            arm = (p[..., k, :] - p[..., j, :])[..., np.newaxis, :]
            load = force
            if chain.links[j].joint == "revolute":
                load = moment + np.cross(arm, force)
            Y[..., j, k, :] = np.matvec(load, axis[..., j, :])
    return Y.reshape(*q.shape, -1)


def _spatial_load(R, rate, spin, origin_dd) -> tuple[np.ndarray, np.ndarray]:
    """Force and moment about its origin that move a link, per entry of its π: (..., 10, 3) each."""
    axes = np.swapaxes(R, -1, -2)  # rows: the link's axes
    rate_, spin_, origin_dd_ = (v[..., np.newaxis, :] for v in (rate, spin, origin_dd))
    axes_dd = np.cross(spin_, axes) + np.cross(rate_, np.cross(rate_, axes))
    force, moment = np.zeros((2, *R.shape[:-2], len(SPATIAL), 3))
    force[..., 0, :] = origin_dd
    force[..., 1:4, :] = axes_dd
    moment[..., 1:4, :] = np.cross(axes, origin_dd_)
    for column, (i, j) in enumerate(INERTIA, start=4):
        unit = np.zeros((3, 3))
        unit[i, j] = unit[j, i] = 1
        J = R @ unit @ axes
        moment[..., column, :] = np.matvec(J, spin) + np.cross(rate, np.matvec(J, rate))
    return force, moment
