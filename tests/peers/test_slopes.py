"""Slopes of the dynamics beside Pinocchio's analytical derivatives."""

import numpy as np
import pytest

from armdyn.linearisation import forward_dynamics_slopes, inverse_dynamics_slopes
from tests.peers import built
from tests.peers.test_agreement import as_spatial, robot


@pytest.mark.parametrize("name", ["2r-0", "2r-1", "planar-4r", "spatial-3-0", "spatial-6-1"])
def test_against_pinocchio(name):
    pin = built.library("pinocchio")
    model, q, qd, z = robot(name)
    theirs = built.pinocchio_model(as_spatial(model))
    data = theirs.createData()
    inverse, forward = (
        f(model, q, qd, z) for f in (inverse_dynamics_slopes, forward_dynamics_slopes)
    )
    for k in range(len(q)):
        given = [
            dtau.copy() for dtau in pin.computeRNEADerivatives(theirs, data, q[k], qd[k], z[k])
        ]
        for ours, needed in zip((inverse.q[k], inverse.qd[k]), given, strict=False):
            np.testing.assert_allclose(ours, needed, atol=1e-11 * np.max(np.abs(needed)))
        pin.computeABADerivatives(theirs, data, q[k], qd[k], z[k])
        for ours, needed in (
            (forward.q[k], data.ddq_dq),
            (forward.qd[k], data.ddq_dv),
            (forward.u[k], data.Minv),
        ):
            np.testing.assert_allclose(ours, needed, atol=1e-10 * np.max(np.abs(needed)))
