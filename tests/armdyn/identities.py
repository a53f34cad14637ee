"""What holds for every manipulator, asserted at given states."""

import numpy as np

from tests.armdyn.arms import assert_close, rate


def assert_canonical(arm, q, qd, z):
    """M symmetric and positive semidefinite, C of Christoffel form, g a gradient; u and E as they
    are defined. q, qd, z: (..., n), at most about 6 in size."""
    M, C = arm.M(q), arm.C(q, qd)
    size = np.max(np.abs(M)) * 6
    np.testing.assert_array_equal(M, np.swapaxes(M, -1, -2))
    assert np.all(np.linalg.eigvalsh(M) > -1e-13 * size)

    # dM[..., i, j, k] = ∂M_ij/∂q_k
    dM = np.stack([rate(arm.M, q, axis) for axis in np.eye(arm.n)], axis=-1)
    h = 0.5 * (dM + np.swapaxes(dM, -1, -2) - np.moveaxis(dM, -1, -3))
    assert_close(C, np.einsum("...ijk,...k->...ij", h, qd), size * arm.n, 1e-10)
    M_dot = np.einsum("...ijk,...k->...ij", dM, qd)
    assert_close(M_dot, C + np.swapaxes(C, -1, -2), size * arm.n, 1e-10)
    assert_close(arm.C(q, qd - 2 * z), C - 2 * arm.C(q, z), size * arm.n)

    P = arm.potential_energy
    gradient = np.stack([rate(P, q, axis) for axis in np.eye(arm.n)], axis=-1)
    height = max(np.max(np.abs(P(q))), np.max(np.abs(arm.g_vec(q))), 1e-6)
    assert_close(arm.g_vec(q), gradient, 10 * height, 1e-10)

    terms = (np.matvec(M, z), np.matvec(C, qd), arm.g_vec(q), arm.f_vec(qd))
    assert_close(arm.inverse_dynamics(q, qd, z), sum(terms), sum(np.max(np.abs(t)) for t in terms))
    K = 0.5 * np.vecdot(qd, np.matvec(M, qd))
    assert_close(arm.kinetic_energy(q, qd), K)
    assert_close(arm.energy(q, qd), K + P(q), height)


def assert_batches(arm, q, qd, z, methods):
    """Every method gives for a batch what it gives for its states one by one.

    methods: name → (arguments out of q, qd, z as a string such as "q qd", axes of the result).
    """
    given = {"q": q, "qd": qd, "z": z}
    batch = q.shape[:-1]
    for name, (arguments, axes) in methods.items():
        values = [given[a] for a in arguments.split()]
        together = getattr(arm, name)(*values)
        assert together.shape == batch + (arm.n,) * axes, name
        for at in np.ndindex(batch):
            one = getattr(arm, name)(*(v[at] for v in values))
            assert_close(together[at], one, np.max(np.abs(together)), 1e-11)
