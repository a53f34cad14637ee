from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from armdyn.base_parameters import base_parameters
from armdyn.energy_regressor import kinetic_energy_regressor, potential_energy_regressor
from armdyn.regressor import parameters, regressor
from armdyn.urdf import read_urdf
from tests.armdyn.arms import a_few, assert_close, vectors
from tests.armdyn.chains import spatial_chains
from tests.peers.built import library


def in_pinocchio(chain):
    pin = library("pinocchio")
    joints = {
        "revolute": pin.JointModelRevoluteUnaligned,
        "prismatic": pin.JointModelPrismaticUnaligned,
    }
    model, last = pin.Model(), 0
    model.gravity.linear = np.array(chain.gravity)
    for k, link in enumerate(chain.links):
        placement = pin.SE3(np.array(link.rotation), np.array(link.translation))
        joint = joints[link.joint](np.array(link.axis))
        last = model.addJoint(last, joint, placement, f"joint{k}")
        body = pin.Inertia(link.mass, np.array(link.com), np.array(link.inertia))
        model.appendBodyToJoint(last, body, pin.SE3.Identity())
    return pin, model


@a_few
@given(spatial_chains(most=7), st.data())
def test_regressor_and_parameters_are_those_of_pinocchio(chain, data):
    pin, model = in_pinocchio(chain)
    q, qd, qdd = (data.draw(vectors(chain.n)) for _ in range(3))
    theirs = pin.computeJointTorqueRegressor(model, model.createData(), q, qd, qdd)
    # With one joint, theirs has one axis.
    theirs = theirs.reshape(chain.n, 10 * chain.n)
    assert_close(regressor(chain, q, qd, qdd), theirs, tolerance=1e-12)
    pi = np.concatenate([body.toDynamicParameters() for body in list(model.inertias)[1:]])
    assert_close(parameters(chain), pi)


@a_few
@given(spatial_chains(most=7), st.data())
def test_energy_regressors_are_those_of_pinocchio(chain, data):
    pin, model = in_pinocchio(chain)
    q, qd = (data.draw(vectors(chain.n)) for _ in range(2))
    K = pin.computeKineticEnergyRegressor(model, model.createData(), q, qd)
    P = pin.computePotentialEnergyRegressor(model, model.createData(), q)
    assert_close(kinetic_energy_regressor(chain, q, qd), np.ravel(K), tolerance=1e-12)
    assert_close(potential_energy_regressor(chain, q), np.ravel(P), tolerance=1e-12)


@a_few
@given(spatial_chains(most=7), st.data())
def test_the_reference_velocity_is_behind_pinocchio_s_coriolis_matrix(chain, data):
    pin, model = in_pinocchio(chain)
    q, qd, qd_ref = (data.draw(vectors(chain.n)) for _ in range(3))
    C = pin.computeCoriolisMatrix(model, model.createData(), q, qd)
    still, pi = np.zeros(chain.n), parameters(chain)
    Y = regressor(chain, q, qd, still, qd_ref) - regressor(chain, q, still, still)
    assert_close(Y @ pi, C @ qd_ref, max(1, np.max(np.abs(Y) @ np.abs(pi))))


@a_few
@given(spatial_chains(most=4))
def test_base_parameters_explain_pinocchio_s_torque(chain):
    pin, model = in_pinocchio(chain)
    data, base = model.createData(), base_parameters(chain)
    for q, qd, qdd in np.random.default_rng(0).normal(size=(5, 3, chain.n)):
        Y = pin.computeJointTorqueRegressor(model, data, q, qd, qdd).reshape(chain.n, -1)
        u = pin.rnea(model, data, q, qd, qdd)
        reduced = Y[:, list(base.independent)] @ (base.combination @ parameters(chain))
        assert_close(reduced, u, np.max(np.abs(Y) @ np.abs(parameters(chain))), tolerance=1e-6)


@pytest.mark.parametrize(
    "file",
    [
        "unimation_puma560_description/urdf/puma560_robot.urdf",
        "abb_irb140_description/urdf/irb140.urdf",
        "kuka_description/kuka_kr16/urdf/kr16_2.urdf",
        "kuka_description/kuka_lbr_iiwa/urdf/lbr_iiwa_14_r820.urdf",
    ],
)
def test_files_of_real_robots_have_as_many_base_parameters_as_theory_says(file):
    # Of a link that turns, three of ten parameters go to the link before; of the first link, whose
    # axis is upright, the inertia about it is all that shows. M. Gautier, W. Khalil (1990), Direct
    # Calculation of Minimum Set of Inertial Parameters of Serial Robots.
    arm = read_urdf(Path(library("rtbdata").__file__).parent / "xacro" / file)
    base = base_parameters(arm)
    assert base.rank == 7 * (arm.n - 1) + 1
    assert base.clear
