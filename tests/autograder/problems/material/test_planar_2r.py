"""The problems' own formulas for the 2R arm against the library's."""

import numpy as np
import pytest

from armdyn.models.planar_2r import Planar2R
from autograder.problems.material import planar_2r, sampling


@pytest.mark.parametrize("seed", range(20))
def test_the_formulas_agree_with_armdyn(seed):
    rng = np.random.default_rng(seed)
    arm = sampling.planar_2r(rng, friction=True)
    model = Planar2R(**vars(arm))
    q, qd = sampling.angles(rng), sampling.velocities(rng)
    np.testing.assert_allclose(planar_2r.M(q, arm), model.M(q), rtol=1e-13)
    np.testing.assert_allclose(planar_2r.C(q, qd, arm), model.C(q, qd), rtol=1e-13)
    np.testing.assert_allclose(planar_2r.g_vec(q, arm), model.g_vec(q), rtol=1e-13)
    np.testing.assert_allclose(planar_2r.f_vec(qd, arm), model.f_vec(qd), rtol=1e-13)
    np.testing.assert_allclose(planar_2r.kinetic_energy(q, qd, arm), model.kinetic_energy(q, qd))
    rise = planar_2r.potential_energy(q, arm) - planar_2r.potential_energy(0 * q, arm)
    np.testing.assert_allclose(rise, model.potential_energy(q) - model.potential_energy(0 * q))
    C = planar_2r.C(q, qd, arm)
    np.testing.assert_allclose(planar_2r.M_dot(q, qd, arm), C + C.T, rtol=1e-13)
