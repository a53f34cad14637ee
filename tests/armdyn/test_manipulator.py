import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from armdyn import Pendulum, Planar2R
from armdyn.manipulator import Manipulator
from tests.armdyn.arms import (
    a_few,
    arms,
    arms_and_states,
    assert_close,
    frictions,
    planar_arms,
    rate,
    vectors,
)

ARM = Planar2R(1.0, 0.8, 0.5, 0.4, 2.0, 1.5, 0.2, 0.1, viscous=(0.3, 0.2), coulomb=(0.1, 0.4))
PENDULUM = Pendulum(m=2.0, lc=0.5, I=0.7, viscous=0.1, coulomb=0.2)


@a_few
@given(arms_and_states())
def test_inertia_is_symmetric_and_positive_definite(case):
    arm, q, z, _ = case
    M = arm.M(q)
    np.testing.assert_array_equal(M, np.swapaxes(M, -1, -2))
    assert np.all(np.linalg.eigvalsh(M) > 0)
    moving = np.any(np.abs(z) > 1e-3, axis=-1)
    assert np.all(arm.kinetic_energy(q, z)[moving] > 0)


@a_few
@given(arms_and_states())
def test_rate_of_inertia_is_c_plus_its_transpose_and_n_is_skew(case):
    arm, q, qd, z = case
    C = arm.C(q, qd)
    M_dot = rate(arm.M, q, qd / 6)[...] * 6
    size = np.max(np.abs(arm.M(q))) * 6
    assert_close(M_dot, C + np.swapaxes(C, -1, -2), size, 1e-10)
    assert_close(
        np.vecdot(z, np.matvec(M_dot - 2 * C, z)), np.zeros(q.shape[:-1]), size * 36 * arm.n, 1e-10
    )


@a_few
@given(arms_and_states())
def test_c_is_made_of_the_christoffel_symbols_of_m(case):
    arm, q, qd, _ = case
    # dM[..., i, j, k] = ∂M_ij/∂q_k
    dM = np.stack([rate(arm.M, q, axis) for axis in np.eye(arm.n)], axis=-1)
    h = 0.5 * (dM + np.swapaxes(dM, -1, -2) - np.moveaxis(dM, -1, -3))
    C = np.einsum("...ijk,...k->...ij", h, qd)
    assert_close(arm.C(q, qd), C, np.max(np.abs(arm.M(q))) * 6, 1e-10)


@a_few
@given(arms_and_states())
def test_c_is_linear_in_the_velocity(case):
    arm, q, qd, other = case
    together = arm.C(q, qd - 2 * other)
    size = np.max(np.abs(arm.M(q))) * 18
    assert_close(together, arm.C(q, qd) - 2 * arm.C(q, other), size)


@a_few
@given(arms_and_states())
def test_gravity_is_the_gradient_of_the_potential_energy(case):
    arm, q, _, _ = case
    gradient = np.stack([rate(arm.potential_energy, q, axis) for axis in np.eye(arm.n)], axis=-1)
    size = np.max(np.abs(arm.potential_energy(q))) + np.max(np.abs(arm.g_vec(q))) + 1
    assert_close(arm.g_vec(q), gradient, size, 1e-10)


@a_few
@given(arms_and_states())
def test_dynamics_undoes_inverse_dynamics(case):
    arm, q, qd, qdd = case
    u = arm.inverse_dynamics(q, qd, qdd)
    M = arm.M(q)
    # An error in u of rounding size grows by the inverse of M.
    tolerance = 1e-14 * np.max(np.linalg.cond(M))
    size = max(1, np.max(np.abs(u)) / np.min(np.linalg.eigvalsh(M)[..., -1]))
    assert_close(arm.dynamics(q, qd, u), qdd, size, max(tolerance, 1e-13))


@a_few
@given(arms_and_states())
def test_inverse_dynamics_is_the_sum_of_the_four_terms(case):
    arm, q, qd, qdd = case
    M, C = arm.M(q), arm.C(q, qd)
    inertial = np.einsum("...ij,...j->...i", M, qdd)
    velocity = np.einsum("...ij,...j->...i", C, qd)
    terms = (inertial, velocity, arm.g_vec(q), arm.f_vec(qd))
    size = sum(np.max(np.abs(term)) for term in terms)
    assert_close(arm.inverse_dynamics(q, qd, qdd), sum(terms), size)
    assert_close(arm.bias(q, qd), sum(terms[1:]), size)


@a_few
@given(arms_and_states())
def test_energy_changes_by_the_power_of_input_less_friction(case):
    arm, q, qd, u = case
    n = arm.n
    x, x_dot = np.concatenate([q, qd], -1), arm.state_derivative(np.concatenate([q, qd], -1), u)
    fastest = np.max(np.abs(x_dot)) + 1
    stored = fastest * rate(lambda x: arm.energy(x[..., :n], x[..., n:]), x, x_dot / fastest)
    M, P = arm.M(q), arm.potential_energy
    size = fastest * (36 * np.max(np.abs(M)) + max(np.max(np.abs(P(q + k))) for k in (0, 1, 2)))
    assert_close(stored, np.vecdot(qd, u - arm.f_vec(qd)), size + 1, 1e-9)


@a_few
@given(arms_and_states())
def test_energy_is_kinetic_plus_potential(case):
    arm, q, qd, _ = case
    K = 0.5 * np.einsum("...i,...ij,...j->...", qd, arm.M(q), qd)
    assert_close(arm.kinetic_energy(q, qd), K)
    assert_close(arm.energy(q, qd), K + arm.potential_energy(q), np.max(K))


@a_few
@given(arms_and_states())
def test_friction_takes_energy_out_and_vanishes_at_rest(case):
    arm, _, qd, _ = case
    f = arm.f_vec(qd)
    assert np.all(qd * f >= 0)
    np.testing.assert_array_equal(f, -arm.f_vec(-qd))
    np.testing.assert_array_equal(arm.f_vec(np.zeros_like(qd)), np.zeros_like(qd))


@given(frictions, frictions, vectors(1))
def test_friction_is_viscous_plus_coulomb(viscous, coulomb, qd):
    arm = Pendulum(1, 1, 1, viscous=viscous, coulomb=coulomb)
    dry = coulomb if qd[0] > 0 else -coulomb if qd[0] < 0 else 0
    assert_close(arm.f_vec(qd), [viscous * qd[0] + dry])


def test_each_joint_has_its_own_friction():
    qd = np.array([2.0, -3.0])
    np.testing.assert_allclose(ARM.f_vec(qd), [0.3 * 2 + 0.1, -0.2 * 3 - 0.4])


def test_a_model_without_friction_gives_zeros():
    class Mass(Manipulator):
        n = 1
        M = C = g_vec = potential_energy = None

    np.testing.assert_array_equal(Mass().f_vec([[1.0], [2.0]]), [[0.0], [0.0]])


@a_few
@given(arms_and_states())
def test_a_batch_is_its_states_one_by_one(case):
    arm, q, qd, u = case
    x = np.concatenate([q, qd], axis=-1)
    calls = {
        "M": (arm.M, (q,), 2),
        "C": (arm.C, (q, qd), 2),
        "g": (arm.g_vec, (q,), 1),
        "f": (arm.f_vec, (qd,), 1),
        "P": (arm.potential_energy, (q,), 0),
        "E": (arm.energy, (q, qd), 0),
        "qdd": (arm.dynamics, (q, qd, u), 1),
        "u": (arm.inverse_dynamics, (q, qd, u), 1),
    }
    batch = q.shape[:-1]
    for name, (function, arguments, axes) in calls.items():
        together = function(*arguments)
        assert together.shape == batch + (arm.n,) * axes, name
        for at in np.ndindex(batch):
            one = function(*(a[at] for a in arguments))
            np.testing.assert_allclose(together[at], one, rtol=1e-11, atol=1e-9, err_msg=name)
    x_dot = arm.state_derivative(x, u)
    np.testing.assert_array_equal(x_dot[..., : arm.n], qd)
    np.testing.assert_array_equal(x_dot[..., arm.n :], arm.dynamics(q, qd, u))


@a_few
@given(arms(), st.data())
def test_batch_axes_broadcast(arm, data):
    n = arm.n
    q = data.draw(vectors(n, batch=(5, 1)))
    qd = data.draw(vectors(n, batch=(3,)))
    u = data.draw(vectors(n))
    full = (np.broadcast_to(a, (5, 3, n)) for a in (q, qd, u))
    fq, fqd, fu = full
    for function, few, many in (
        (arm.C, (q, qd), (fq, fqd)),
        (arm.bias, (q, qd), (fq, fqd)),
        (arm.energy, (q, qd), (fq, fqd)),
        (arm.dynamics, (q, qd, u), (fq, fqd, fu)),
        (arm.inverse_dynamics, (q, qd, u), (fq, fqd, fu)),
    ):
        np.testing.assert_allclose(function(*few), function(*many), rtol=1e-11, atol=1e-9)
    x = np.concatenate([fq, fqd], axis=-1)
    assert arm.state_derivative(x, u).shape == (5, 3, 2 * n)
    assert arm.state_derivative(x[0, 0], np.broadcast_to(u, (7, n))).shape == (7, 2 * n)


def test_an_empty_batch_stays_empty():
    q = np.empty((0, 2))
    assert ARM.M(q).shape == (0, 2, 2)
    assert ARM.dynamics(q, q, q).shape == (0, 2)


def test_integers_and_lists_are_numbers():
    np.testing.assert_array_equal(ARM.dynamics([1, 0], (0, 1), [2, 0]), ARM.dynamics(*np.array(
        [[1.0, 0.0], [0.0, 1.0], [2.0, 0.0]]
    )))  # fmt: skip


BAD_VECTORS = {
    "none": (None, "None"),
    "text": ("ab", "'ab'"),
    "text numbers": (["1", "2"], "real numbers"),
    "bool": ([True, False], "bool"),
    "complex": ([1j, 2.0], "complex"),
    "none inside": ([None, 1.0], "object"),
    "nan": ([0.0, np.nan], r"\[1\] = nan"),
    "inf": ([[0.0, 1.0], [-np.inf, 0.0]], r"\[1, 0\] = -inf"),
    "scalar": (1.0, r"shape \(\)"),
    "too long": ([1.0, 2.0, 3.0], r"\(3,\), needs real numbers of shape \(\.\.\., 2\)"),
    "empty": ([], r"\(0,\)"),
    "ragged": ([[1.0], [1.0, 2.0]], "different lengths"),
    "column": ([[1.0], [2.0]], r"\(2, 1\)"),
}


@pytest.mark.parametrize(("value", "says"), BAD_VECTORS.values(), ids=BAD_VECTORS)
def test_a_bad_vector_is_named(value, says):
    ok = [0.1, 0.2]
    for name, call in {
        "q": lambda v: [ARM.M(v), ARM.C(v, ok), ARM.g_vec(v), ARM.potential_energy(v)],
        "qd": lambda v: [ARM.C(ok, v), ARM.f_vec(v), ARM.energy(ok, v)],
        "u": lambda v: ARM.dynamics(ok, ok, v),
        "qdd": lambda v: ARM.inverse_dynamics(ok, ok, v),
    }.items():
        with pytest.raises(ValueError, match=f"^{name}\\b.*{says}"):
            call(value)
    # Each method that takes it, not the first of a list alone.
    for method in (ARM.M, ARM.g_vec, ARM.potential_energy, ARM.f_vec):
        with pytest.raises(ValueError, match=says):
            method(value)


@pytest.mark.parametrize("method", ["M", "g_vec", "potential_energy", "f_vec"])
def test_a_pendulum_takes_one_coordinate(method):
    with pytest.raises(ValueError, match=r"\(2,\), needs real numbers of shape \(\.\.\., 1\)"):
        getattr(PENDULUM, method)([0.0, 1.0])


def test_a_state_of_the_wrong_length_is_named():
    with pytest.raises(ValueError, match=r"^x: got shape \(3,\).*\(\.\.\., 4\)"):
        ARM.state_derivative([0.0, 0.0, 0.0], [0.0, 0.0])


def test_batches_that_do_not_fit_are_named_with_their_shapes():
    q, qd = np.zeros((3, 2)), np.zeros((4, 2))
    for call in (ARM.C, ARM.bias, ARM.energy):
        with pytest.raises(ValueError, match=r"^q \(3, 2\), qd \(4, 2\): needs batch axes"):
            call(q, qd)
    with pytest.raises(ValueError, match=r"u \(5, 2\): needs batch axes"):
        ARM.dynamics(q, q, np.zeros((5, 2)))


@a_few
@given(planar_arms())
def test_arms_are_values(arm):
    again = Planar2R(**{name: getattr(arm, name) for name in arm.__dataclass_fields__})
    assert arm == again
    assert hash(arm) == hash(again)
    with pytest.raises(AttributeError):
        arm.m1 = 1.0
