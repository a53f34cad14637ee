"""A URDF file read by armdyn and by Pinocchio gives one and the same robot."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from armdyn.urdf import read_urdf
from tests.armdyn.arms import assert_close, vectors
from tests.armdyn.urdf_files import arms_of_parts, chain_file
from tests.peers.built import library, of_pinocchio

pytest.importorskip("yourdfpy")
pin = library("pinocchio")

# The file of each example is written over that of the one before.
files = settings(
    max_examples=50, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
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
