"""One robot, a SerialChain, built in each of the libraries to compare with.

A builder returns a Peer: functions of one state, in the notation of the course, without friction.
What a library has no function for is None.
"""

from collections.abc import Callable
from dataclasses import dataclass
from xml.sax.saxutils import quoteattr

import numpy as np
import pytest
from scipy.spatial.transform import Rotation


def library(module: str):
    """The module of a library to compare with; skips where it is not installed."""
    why = f"needs {module}: pip install -c constraints.txt -e .[peers]"
    return pytest.importorskip(module, reason=why)


@dataclass(frozen=True)
class Peer:
    M: Callable
    Cqd: Callable
    g_vec: Callable
    inverse_dynamics: Callable
    dynamics: Callable
    C: Callable | None = None
    kinetic_energy: Callable | None = None
    potential_energy: Callable | None = None


def pinocchio(chain) -> Peer:
    return of_pinocchio(pinocchio_model(chain))


def pinocchio_model(chain):
    pin = library("pinocchio")
    model = pin.Model()
    model.gravity.linear = np.array(chain.gravity)
    last = 0
    for k, link in enumerate(chain.links):
        joint = {
            "revolute": pin.JointModelRevoluteUnaligned,
            "prismatic": pin.JointModelPrismaticUnaligned,
        }[link.joint](np.array(link.axis))
        placement = pin.SE3(np.array(link.rotation), np.array(link.translation))
        last = model.addJoint(last, joint, placement, f"joint{k}")
        body = pin.Inertia(link.mass, np.array(link.com), np.array(link.inertia))
        model.appendBodyToJoint(last, body, pin.SE3.Identity())
    model.armature = np.array(chain.armature)
    return model


def of_pinocchio(model, configuration=lambda q: q) -> Peer:
    """configuration(q): q as Pinocchio has it, which turns a continuous joint by its cos and sin."""
    pin = library("pinocchio")
    data = model.createData()
    at = configuration

    def M(q):
        return pin.crba(model, data, at(q))

    def C(q, qd):
        return pin.computeCoriolisMatrix(model, data, at(q), qd).copy()

    def kinetic_energy(q, qd):
        return pin.computeKineticEnergy(model, data, at(q), qd)

    def potential_energy(q):
        return pin.computePotentialEnergy(model, data, at(q))

    return Peer(
        M=M,
        C=C,
        Cqd=lambda q, qd: (
            pin.nonLinearEffects(model, data, at(q), qd)
            - pin.computeGeneralizedGravity(model, data, at(q))
        ),
        g_vec=lambda q: pin.computeGeneralizedGravity(model, data, at(q)).copy(),
        inverse_dynamics=lambda q, qd, qdd: pin.rnea(model, data, at(q), qd, qdd).copy(),
        dynamics=lambda q, qd, u: pin.aba(model, data, at(q), qd, u).copy(),
        # Pinocchio 4.1 counts the motors of some joints only: not the K of its own M.
        kinetic_energy=None if np.any(model.armature) else kinetic_energy,
        potential_energy=potential_energy,
    )


def roboticstoolbox(chain) -> Peer:
    """Its joints turn about or move along z: each link's frame is turned so that its axis is z."""
    rtb = library("roboticstoolbox")
    links, turn = [], np.eye(3)
    for link in chain.links:
        placement = np.eye(4)
        upright = _with_z_along(link.axis)
        placement[:3, :3] = turn.T @ np.array(link.rotation) @ upright
        placement[:3, 3] = turn.T @ np.array(link.translation)
        turn = upright
        moving = rtb.ET.Rz() if link.joint == "revolute" else rtb.ET.tz()
        links.append(
            rtb.Link(
                rtb.ET.SE3(placement) * moving,
                name=f"link{len(links)}",
                parent=links[-1].name if links else None,
                m=link.mass,
                r=upright.T @ np.array(link.com),
                I=upright.T @ np.array(link.inertia) @ upright,
                Jm=chain.armature[len(links)],
                G=1.0,
            )
        )
    # Its gravity is the acceleration of a falling body, whatever its documentation says.
    robot = rtb.Robot(links, gravity=list(chain.gravity))
    # `coriolis` works on a copy without friction, whose links still name those of the first robot
    # as their parents. There is no friction here.
    robot.nofriction = lambda *_: robot

    def dynamics(q, qd, u):
        if chain.n > 1:
            return robot.accel(q, qd, u)
        # `accel` of a single joint loses an axis and raises.
        return (u - robot.rne(q, qd, 0 * q)) / robot.inertia(q)[0]

    return Peer(
        M=robot.inertia,
        C=robot.coriolis,
        Cqd=lambda q, qd: robot.rne(q, qd, 0 * q) - robot.rne(q, 0 * q, 0 * q),
        g_vec=robot.gravload,
        inverse_dynamics=robot.rne,
        dynamics=dynamics,
    )


def modern_robotics(chain) -> Peer:
    """Links by the frames at their centres of mass at q = 0, joints by their screws in the base."""
    mr = library("modern_robotics")
    steps, inertias, screws = [], [], []
    before, joint = np.eye(4), np.eye(4)
    for link in chain.links:
        joint = joint @ _homogeneous(link.rotation, link.translation)
        at_com = joint @ _homogeneous(np.eye(3), link.com)
        steps.append(np.linalg.inv(before) @ at_com)
        before = at_com
        inertia = np.zeros((6, 6))
        inertia[:3, :3], inertia[3:, 3:] = link.inertia, link.mass * np.eye(3)
        inertias.append(inertia)
        axis = joint[:3, :3] @ link.axis
        if link.joint == "revolute":
            screws.append([*axis, *np.cross(joint[:3, 3], axis)])
        else:
            screws.append([0, 0, 0, *axis])
    arm = (np.array([*steps, np.eye(4)]), np.array(inertias), np.array(screws).T)
    gravity, free = np.array(chain.gravity), np.zeros(6)
    return Peer(
        M=lambda q: mr.MassMatrix(q, *arm),
        Cqd=lambda q, qd: mr.VelQuadraticForces(q, qd, *arm),
        g_vec=lambda q: mr.GravityForces(q, gravity, *arm),
        inverse_dynamics=lambda q, qd, qdd: mr.InverseDynamics(q, qd, qdd, gravity, free, *arm),
        dynamics=lambda q, qd, u: mr.ForwardDynamics(q, qd, u, gravity, free, *arm),
    )


def mujoco(chain) -> Peer:
    mj = library("mujoco")
    model = mj.MjModel.from_xml_string(mjcf(chain))
    data = mj.MjData(model)

    def at(q, qd=0.0, u=0.0):
        data.qpos[:], data.qvel[:], data.qfrc_applied[:] = q, qd, u
        mj.mj_forward(model, data)
        return data

    def M(q):
        at(q)
        columns = np.empty((chain.n, chain.n))
        for column, axis in zip(columns, np.eye(chain.n), strict=True):
            mj.mj_mulM(model, data, column, axis)
        return columns.T

    def bias(q, qd):
        return at(q, qd).qfrc_bias.copy()

    def inverse_dynamics(q, qd, qdd):
        at(q, qd).qacc[:] = qdd
        mj.mj_inverse(model, data)
        return data.qfrc_inverse.copy()

    def energies(q, qd):
        at(q, qd)
        mj.mj_energyPos(model, data)
        mj.mj_energyVel(model, data)
        return data.energy.copy()

    return Peer(
        M=M,
        Cqd=lambda q, qd: bias(q, qd) - bias(q, 0.0),
        g_vec=lambda q: bias(q, 0.0),
        inverse_dynamics=inverse_dynamics,
        dynamics=lambda q, qd, u: at(q, qd, u).qacc.copy(),
        kinetic_energy=lambda q, qd: energies(q, qd)[1],
        potential_energy=lambda q: energies(q, 0.0)[0],
    )


def mjcf(chain) -> str:
    """The chain as MuJoCo's XML, each number to the last digit."""

    def text(numbers):
        return quoteattr(" ".join(f"{x:.17g}" for x in np.ravel(numbers)))

    opened = []
    for link, armature in zip(chain.links, chain.armature, strict=True):
        x, y, z, w = Rotation.from_matrix(link.rotation).as_quat()
        I = np.array(link.inertia)
        full = (*np.diag(I), I[0, 1], I[0, 2], I[1, 2])
        kind = {"revolute": "hinge", "prismatic": "slide"}[link.joint]
        opened.append(
            f"<body pos={text(link.translation)} quat={text((w, x, y, z))}>"
            f'<joint type="{kind}" axis={text(link.axis)} limited="false" '
            f"armature={text(armature)}/>"
            f"<inertial pos={text(link.com)} mass={text(link.mass)} fullinertia={text(full)}/>"
        )
    return (
        f'<mujoco><compiler angle="radian"/><option gravity={text(chain.gravity)}/>'
        f"<worldbody>{''.join(opened)}{'</body>' * chain.n}</worldbody></mujoco>"
    )


def drake(chain) -> Peer:
    tree = library("pydrake.multibody.tree")
    MultibodyPlant = library("pydrake.multibody.plant").MultibodyPlant
    math = library("pydrake.math")
    plant = MultibodyPlant(0.0)
    plant.mutable_gravity_field().set_gravity_vector(np.array(chain.gravity))
    last = plant.world_body()
    for k, link in enumerate(chain.links):
        I = np.array(link.inertia)
        about_com = tree.RotationalInertia(*np.diag(I), I[0, 1], I[0, 2], I[1, 2])
        inertia = tree.SpatialInertia.MakeFromCentralInertia(
            link.mass, np.array(link.com), about_com
        )
        body = plant.AddRigidBody(f"link{k}", inertia)
        placement = math.RigidTransform(
            math.RotationMatrix(np.array(link.rotation)), np.array(link.translation)
        )
        base = plant.AddFrame(tree.FixedOffsetFrame(f"joint{k}", last.body_frame(), placement))
        kind = {"revolute": tree.RevoluteJoint, "prismatic": tree.PrismaticJoint}[link.joint]
        joint = kind(f"moves{k}", base, body.body_frame(), np.array(link.axis))
        motor = plant.AddJointActuator(f"motor{k}", plant.AddJoint(joint))
        motor.set_default_rotor_inertia(chain.armature[k])
        motor.set_default_gear_ratio(1.0)
        last = body
    plant.Finalize()
    context = plant.CreateDefaultContext()
    no_force = tree.MultibodyForces(plant)

    def at(q, qd=None):
        plant.SetPositions(context, q)
        plant.SetVelocities(context, np.zeros(chain.n) if qd is None else qd)
        return context

    def inverse_dynamics(q, qd, qdd):
        force = plant.CalcInverseDynamics(at(q, qd), qdd, no_force)
        return force - plant.CalcGravityGeneralizedForces(context)

    def dynamics(q, qd, u):
        plant.get_applied_generalized_force_input_port().FixValue(at(q, qd), u)
        return plant.EvalTimeDerivatives(context).CopyToVector()[chain.n :]

    return Peer(
        M=lambda q: plant.CalcMassMatrix(at(q)),
        Cqd=lambda q, qd: plant.CalcBiasTerm(at(q, qd)),
        g_vec=lambda q: -plant.CalcGravityGeneralizedForces(at(q)),
        inverse_dynamics=inverse_dynamics,
        dynamics=dynamics,
        kinetic_energy=lambda q, qd: plant.CalcKineticEnergy(at(q, qd)),
        potential_energy=lambda q: plant.CalcPotentialEnergy(at(q)),
    )


def _homogeneous(R, p) -> np.ndarray:
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, p
    return T


def _with_z_along(axis) -> np.ndarray:
    """A rotation whose third column is the axis."""
    z = np.array(axis)
    x = np.cross(np.eye(3)[np.argmin(np.abs(z))], z)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z])
