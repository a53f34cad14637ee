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

The rows of kinetic and potential energy, with the same π, are in `armdyn.energy_regressor`.

Source: C. G. Atkeson, C. H. An, J. M. Hollerbach (1986), Estimation of Inertial Parameters of
Manipulator Loads and Links.
"""

from functools import singledispatch

import numpy as np
from numpy.typing import ArrayLike

from armdyn.geometry import INERTIA, PLANAR, SPATIAL, PlanarGeometry, geometry, sum_of_those_before
from armdyn.manipulator import Manipulator
from armdyn.models import Pendulum, Planar2R, PlanarChain, SerialChain
from armdyn.parameters import state_vector, state_vectors

# Per entry of the inertia matrix: the matrix in which it is 1, and all others are 0.
UNIT_INERTIAS = np.array(
    [[[float({i, j} == {k, l}) for l in range(3)] for k in range(3)] for i, j in INERTIA]
)


@singledispatch
def parameters(model: Manipulator) -> np.ndarray:
    """π of a model, all links in a row: (4n,) for planar arms, (10n,) for spatial chains.

    The order and units are the module's. Raises ValueError for a model that has no links to read
    them from.
    """
    geometry(model)
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


def parameter_names(model: Manipulator) -> tuple[str, ...]:
    """The names of the entries of π; "J2" is the inertia of link 2 about its joint."""
    shape = geometry(model)
    return tuple(name.format(i + 1) for i in range(shape.n) for name in shape.names)


def regressor(
    model: Manipulator, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike, qd_ref: ArrayLike | None = None
) -> np.ndarray:
    """Y with M q̈ + C q̇ + g = Y π, (..., n, 4n) for planar arms, (..., n, 10n) for spatial chains.

    q, qd, qdd: (..., n), rad, rad/s, rad/s² (m for a prismatic joint). Of the model only the geometry
    and gravity enter, not its masses: another arm of the same geometry has the same Y.

    qd_ref: (..., n), a velocity q̇r that takes the place of q̇ behind C, and nowhere else:
    M q̈ + C(q, q̇) q̇r + g = Y π, with C in Christoffel form. In an adaptive controller q̇r is the
    reference velocity, and its rate the acceleration to give as `qdd`. Y is linear in q̇r, apart
    from its value at q̇r = 0, and C(q, q̇) q̇r = C(q, q̇r) q̇.

    Raises ValueError for states of the wrong shape or not finite, and for a model without links.

    Source, for q̇r: J.-J. E. Slotine, W. Li (1987), On the Adaptive Control of Robot Manipulators,
    International Journal of Robotics Research 6(3). Christoffel symbols are symmetric in the two
    velocities, so C(q, q̇) q̇r is what each product of two velocities in Newton's and Euler's
    equations becomes when it is shared out evenly: a b to (a b_r + a_r b)/2.
    """
    shape = geometry(model)
    named = {"q": q, "qd": qd, "qdd": qdd, "qd_ref": qd if qd_ref is None else qd_ref}
    q, qd, qdd, qd_ref = np.broadcast_arrays(*state_vectors(shape.n, **named))
    if isinstance(shape, PlanarGeometry):
        return _planar_regressor(shape, q, qd, qdd, qd_ref)
    return _spatial_regressor(shape.chain, q, qd, qdd, qd_ref)


def armature_columns(qdd: ArrayLike) -> np.ndarray:
    """A with A a = the motors' part of M q̈, a the armature of each joint; (..., n, n).

    qdd: (..., n), rad/s² (m/s² for a prismatic joint). Raises ValueError for a qdd that is not
    finite numbers.

    The column of a first revolute joint is also that of its link's inertia about the joint's axis:
    torque shows only the sum of the two. On some arms this holds of joints further out, too.

    Source: W. Khalil, E. Dombre (2002), Modeling, Identification and Control of Robots, chapter 9.
    """
    size = np.shape(qdd)[-1:] or (1,)
    return np.eye(*size) * state_vector("qdd", qdd, *size)[..., np.newaxis]


def friction_columns(qd: ArrayLike) -> np.ndarray:
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


def _planar_regressor(shape, q, qd, qdd, qd_ref) -> np.ndarray:
    """Each link's force and moment about its joint are linear in its π; carry them to the joints."""
    rate, acceleration = np.cumsum(qd, axis=-1), np.cumsum(qdd, axis=-1)
    x_axis, y_axis = shape.axes(q)
    spin, swing = (
        acceleration[..., np.newaxis],
        (rate * np.cumsum(qd_ref, axis=-1))[..., np.newaxis],
    )
    # The second derivatives of the two axes, and with them of every point fixed in the link.
    x_axis_dd, y_axis_dd = spin * y_axis - swing * x_axis, -spin * x_axis - swing * y_axis

    length = np.array(shape.l)[:, np.newaxis]
    joint = sum_of_those_before(length * x_axis)
    # Gravity acts as the base's acceleration the other way.
    joint_dd = sum_of_those_before(length * x_axis_dd) - np.array(shape.gravity)

    nothing = np.zeros_like(joint)
    force = np.stack([joint_dd, x_axis_dd, y_axis_dd, nothing], axis=-2)
    moment = np.stack(
        [nothing[..., 0], _cross(x_axis, joint_dd), _cross(y_axis, joint_dd), acceleration], axis=-1
    )
    n = shape.n
    lever = joint[..., np.newaxis, :, :] - joint[..., :, np.newaxis, :]
    torque = moment[..., np.newaxis, :, :] + _cross(
        lever[..., np.newaxis, :], force[..., np.newaxis, :, :, :]
    )
    # A link loads its own joint and those before it.
    torque = np.where(np.triu(np.ones((n, n), dtype=bool))[..., np.newaxis], torque, 0.0)
    return torque.reshape(*q.shape, n * len(PLANAR))


def _cross(a, b) -> np.ndarray:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def _spatial_regressor(chain, q, qd, qdd, qd_ref) -> np.ndarray:
    """As in the plane, but the motion is carried outwards link by link, in the base's axes."""
    R, p = chain.link_placements(q)
    axis = np.matvec(R, np.array([link.axis for link in chain.links]))
    Y = np.zeros((*q.shape, chain.n, len(SPATIAL)))
    nothing = np.zeros((*q.shape[:-1], 3))
    spin = origin = nothing  # ω̇ and the link's origin
    rates = nothing, nothing  # ω, and ω with q̇r for q̇
    origin_dd = np.broadcast_to(-np.array(chain.gravity), nothing.shape)
    for k, link in enumerate(chain.links):
        lever = p[..., k, :] - origin
        origin = p[..., k, :]
        origin_dd = origin_dd + np.cross(spin, lever) + _swing(rates, lever)
        along = axis[..., k, :]
        steps = along * qd[..., k : k + 1], along * qd_ref[..., k : k + 1]
        step_dd = along * qdd[..., k : k + 1]
        turned = (np.cross(rates[0], steps[1]) + np.cross(rates[1], steps[0])) / 2
        if link.joint == "revolute":
            spin = spin + step_dd + turned
            rates = rates[0] + steps[0], rates[1] + steps[1]
        else:
            origin_dd = origin_dd + step_dd + 2 * turned
        force, moment = _spatial_load(R[..., k, :, :], rates, spin, origin_dd)
        for j in range(k + 1):
            arm = (p[..., k, :] - p[..., j, :])[..., np.newaxis, :]
            load = force
            if chain.links[j].joint == "revolute":
                load = moment + np.cross(arm, force)
            Y[..., j, k, :] = np.matvec(load, axis[..., j, :])
    return Y.reshape(*q.shape, -1)


def _swing(rates, lever) -> np.ndarray:
    """ω × (ω × lever), shared out evenly between the two ω."""
    a, b = rates
    return (np.cross(a, np.cross(b, lever)) + np.cross(b, np.cross(a, lever))) / 2


def _spatial_load(R, rates, spin, origin_dd) -> tuple[np.ndarray, np.ndarray]:
    """Force and moment about its origin that move a link, per entry of its π: (..., 10, 3) each."""
    axes = np.swapaxes(R, -1, -2)  # rows: the link's axes
    a, b = rates
    axes_dd = np.cross(spin[..., np.newaxis, :], axes)
    axes_dd = axes_dd + _swing((a[..., np.newaxis, :], b[..., np.newaxis, :]), axes)
    force, moment = np.zeros((2, *R.shape[:-2], len(SPATIAL), 3))
    force[..., 0, :] = origin_dd
    force[..., 1:4, :] = axes_dd
    moment[..., 1:4, :] = np.cross(axes, origin_dd[..., np.newaxis, :])
    # J ω per entry of J, in the link's own axes.
    spin, a, b = (np.vecmat(w, R) for w in (spin, a, b))
    Jspin, Ja, Jb = (np.einsum("pij,...j->...pi", UNIT_INERTIAS, w) for w in (spin, a, b))
    gyration = np.cross(a[..., np.newaxis, :], Jb) + np.cross(b[..., np.newaxis, :], Ja)
    moment[..., 4:, :] = (Jspin + gyration / 2) @ axes
    return force, moment
