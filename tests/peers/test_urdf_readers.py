"""A URDF file read by armdyn, by Pinocchio and by MuJoCo gives one and the same robot."""

import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from armdyn.urdf import read_urdf
from tests.armdyn.arms import a_few, assert_close, vectors
from tests.armdyn.chains import angles
from tests.armdyn.urdf_files import arms_of_parts, chain_file
from tests.armdyn.urdf_trees import leaves, tree_file, trees
from tests.peers.built import library, of_pinocchio

pin = library("pinocchio")

# The file of each example is written over that of the one before.
files = settings(
    max_examples=50,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)


@files
@given(arms_of_parts(most=7), st.data())
def test_both_readers_agree(tmp_path, parts, data):
    path = tmp_path / "arm.urdf"
    path.write_text(chain_file(parts), encoding="utf-8")
    arm, model = read_urdf(path), pin.buildModelFromUrdf(str(path))
    assert arm.n == model.nv
    np.testing.assert_array_equal(arm.viscous, model.damping)
    np.testing.assert_array_equal(arm.coulomb, model.friction)
    # A continuous joint is a point of the circle there.
    rest = pin.neutral(model)
    other = of_pinocchio(model, configuration=lambda q: pin.integrate(model, rest, q))
    q, qd, z = (data.draw(vectors(arm.n, size=3)) for _ in range(3))
    M, weight = other.M(q), 100 * sum(part.mass for part in parts)
    assert_close(arm.M(q), M)
    size = 9 * np.max(np.abs(M))
    assert_close(arm.C(q, qd), other.C(q, qd), size)
    assert_close(arm.g_vec(q), other.g_vec(q), weight)
    u = other.inverse_dynamics(q, qd, z)
    assert_close(arm.rnea(q, qd, z) - arm.f_vec(qd), u, size + weight)
    exact = max(1e-12, 1e-14 * np.linalg.cond(M))
    assert_close(arm.aba(q, qd, u + arm.f_vec(qd)), other.dynamics(q, qd, u), 1, exact)
    assert_close(arm.kinetic_energy(q, qd), other.kinetic_energy(q, qd))
    assert_close(arm.potential_energy(q), other.potential_energy(q), weight)


@st.composite
def chains_of_trees(draw):
    """A tree, the joints from its base to one of its leaves, and a position for each other joint."""
    tree = draw(trees())
    path = tree.path(draw(st.sampled_from(leaves(tree))))
    held = {k: draw(angles) for k in range(len(tree.parts)) if k not in path}
    return tree, path, held


def read_chain(tree, path, held):
    locked = {f"j{k}": q for k, q in held.items()}
    return read_urdf(tree_file(tree), tip=f"link{path[-1]}", locked=locked)


@a_few
@given(chains_of_trees(), st.data())
def test_a_chain_of_a_tree_is_the_reduced_model_of_pinocchio(case, data):
    tree, path, held = case
    arm, whole = read_chain(*case), pin.buildModelFromXML(tree_file(tree))
    stance = pin.neutral(whole)
    for k, q in held.items():
        stance[whole.joints[whole.getJointId(f"j{k}")].idx_q] = q
    reduced = pin.buildReducedModel(whole, [whole.getJointId(f"j{k}") for k in held], stance)
    assert list(reduced.names)[1:] == [f"j{k}" for k in path]
    other = of_pinocchio(reduced)
    q, qd = (data.draw(vectors(arm.n, size=3)) for _ in range(2))
    M, weight = other.M(q), 100 * sum(part.mass for part in tree.parts)
    assert_close(arm.M(q), M)
    assert_close(arm.C(q, qd), other.C(q, qd), 9 * np.max(np.abs(M)))
    assert_close(arm.g_vec(q), other.g_vec(q), weight)


@a_few
@given(chains_of_trees(), st.data())
def test_a_chain_of_a_tree_is_part_of_mujoco_s_M_and_g(case, data):
    mj = library("mujoco")
    tree, path, held = case
    arm, model = read_chain(*case), mj.MjModel.from_xml_string(tree_file(tree))
    state, q = mj.MjData(model), data.draw(vectors(arm.n, size=3))
    for k, position in {**held, **dict(zip(path, q, strict=True))}.items():
        state.joint(f"j{k}").qpos[0] = position
    mj.mj_forward(model, state)
    M = np.empty((model.nv, model.nv))
    for column, axis in zip(M, np.eye(model.nv), strict=True):
        mj.mj_mulM(model, state, column, axis)
    at = [model.joint(f"j{k}").dofadr[0] for k in path]
    assert_close(arm.M(q), M[np.ix_(at, at)], tolerance=1e-10)
    weight = 100 * sum(part.mass for part in tree.parts)
    assert_close(arm.g_vec(q), state.qfrc_bias[at], weight, 1e-10)
