"""The checks' own references against armdyn, at the checks' own cases."""

import numpy as np
import pytest

from armdyn import Pendulum, Planar2R
from armdyn.base_parameters import on_link_axes
from armdyn.regressor import regressor
from autograder.problems import CHECKS
from autograder.protocol import real


def rate_of_M(model, q, qd):
    C = model.C(q, qd)
    return C + C.T


def drift(model, x):
    energy = model.energy(x[:, :2], x[:, 2:])
    return energy - energy[0]


EXPECTED = {
    "M": lambda model, q: model.M(q),
    "M_dot": rate_of_M,
    "C": lambda model, q, qd: model.C(q, qd),
    "potential_energy": lambda model, q: model.potential_energy(q),
    "g_vec": lambda model, q: model.g_vec(q),
    "f": lambda model, x, u: model.state_derivative(x, u),
    "energy_drift": drift,
    "regressor": lambda model, *state: regressor(model, *state)[:, list(on_link_axes(model))],
}
OF_A_ROBOT = [id for id, check in CHECKS.items() if check.name in EXPECTED]


def of_the_library(arm):
    return (Planar2R if hasattr(arm, "l1") else Pendulum)(**vars(arm))


def test_most_checks_are_of_a_robot():
    assert len(OF_A_ROBOT) == 11


@pytest.mark.parametrize("check_id", OF_A_ROBOT)
def test_references_agree_with_the_library(check_id):
    check = CHECKS[check_id]
    calls = check.calls(np.random.default_rng(3), 60)
    args = [[*map(real, call.args)] for call in calls]
    right = [np.asarray(check.reference(*given), dtype=float) for given in args]
    models = [of_the_library(arm) for *_, arm in args]
    expected = [EXPECTED[check.name](m, *given[:-1]) for m, given in zip(models, args, strict=True)]
    # Where P is 0 is free.
    for ours, theirs in zip(*(check.quantities(calls, x) for x in (right, expected)), strict=True):
        for a, b in zip(ours, theirs, strict=True):
            np.testing.assert_allclose(np.squeeze(a), np.squeeze(b), rtol=1e-9, atol=1e-10)
