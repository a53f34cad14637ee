"""What only p1-inertia asks: bodies' inertias, matrices of every kind, and an arm that is singular."""

import numpy as np
import pytest

from armdyn import Planar2R, SerialChain
from armdyn.models.link import Link
from autograder.judging.check import VISIBLE_CASES
from autograder.judging.verdict import State
from autograder.problems import CHECKS
from autograder.problems.material.definiteness import MATRICES, Kind, is_symmetric, least_eigenvalue
from tests.autograder.problems.p1_inertia.table import BASE, TABLE, singular
from tests.autograder.verdicts import judged


def test_links_agree_with_the_library():
    """M of a spatial arm of armdyn, from its own Jacobians and inertias."""
    inertia = tuple(map(tuple, np.diag([0.3, 0.2, 0.4])))
    links = [
        Link("revolute", mass=2.0, com=(0.3, 0.1, -0.2), inertia=inertia, axis=axis)
        for axis in ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0))
    ]
    model = SerialChain(tuple(links))
    q = np.array([0.3, -0.8, 1.1])
    jacobians = np.array(list(model._jacobians(model._transforms(q))))
    M = CHECKS["p1-inertia_from_links"].reference(jacobians, np.array(model._inertias))
    np.testing.assert_allclose(M, model.M(q), rtol=1e-12, atol=1e-14)


@pytest.mark.parametrize("seed", range(5))
def test_the_spatial_inertias_are_those_of_bodies(seed):
    """Positive definite, with the mass in the lower block and a centre of mass beside the origin."""
    calls = CHECKS["p1-inertia_from_links"].calls(np.random.default_rng(seed), 24)
    assert {call.args[0].shape[0] for call in calls} >= {1, 2, 3}
    assert {call.args[0].shape[2] for call in calls} >= {1, 2, 6}
    for I in np.concatenate([call.args[1] for call in calls]):
        mass = I[3, 3]
        np.testing.assert_array_equal(I[3:, 3:], mass * np.eye(3))
        cross = I[:3, 3:] / mass
        np.testing.assert_allclose(cross, -cross.T)
        about_com = I[:3, :3] + mass * cross @ cross
        a, b, c = np.linalg.eigvalsh(about_com)
        assert a > 0
        assert c < a + b
        assert np.min(np.linalg.norm(cross, axis=0)) > 0.3


@pytest.mark.parametrize("q2", [0.0, 0.7, np.pi / 2, np.pi, -2.0])
def test_singular_exactly_where_the_library_says(q2):
    """Every choice of which of I1, I2, ℓc1, ℓc2 vanish, against the rank of armdyn's M."""
    for bits in range(16):
        names = ("I1", "I2", "lc1", "lc2")
        zero = {name: 0.0 if bits >> k & 1 else 0.4 for k, name in enumerate(names)}
        M = Planar2R(**(BASE | zero)).M(np.array([0.2, q2]))
        expected = np.linalg.matrix_rank(M, tol=1e-9) < 2
        correct = judged("p1-singular_arm", singular(zero, f"[0.2, {q2}]")).state is State.CORRECT
        assert correct == expected


def test_the_criteria_of_is_spd_see_both_kinds():
    """Every criterion has matrices to accept and to refuse, so that no constant earns anything."""
    check = CHECKS["p1-is_spd"]
    calls = check.calls(np.random.default_rng(0), VISIBLE_CASES)
    assert len(calls) == len(MATRICES)
    right = check.quantities(calls, [np.array(float(check.reference(*c.args))) for c in calls])
    for k in range(len(check.criteria)):
        assert set(np.concatenate([np.ravel(parts[k]) for parts in right])) == {0.0, 1.0}


def test_worst_case_of_is_spd_is_a_matrix():
    for _, body, _ in TABLE["p1-is_spd"]:
        assert judged("p1-is_spd", body).witness.call.startswith("is_spd(np.array([[")


def test_worst_case_of_a_truth_value():
    verdict = judged("p1-is_spd", "True")
    asked = "(positive definite told from indefinite)"
    shown = " ".join(str(verdict).split())
    assert f"gave True; the right answer is False {asked}. " in shown
    shown = " ".join(str(verdict.returned()).split())
    assert f"Worst case: your function gave True; the right answer is False {asked}." in shown


@pytest.mark.parametrize("seed", range(200))
def test_the_matrices_are_what_they_are_said_to_be(seed):
    """Far from both limits, and such that each half of a test is fooled by some."""
    rng = np.random.default_rng(seed)
    skewed = []
    for kind, make in MATRICES:
        A = make(rng)
        gap = np.max(np.abs(A - A.T)) / np.max(np.abs(A))
        least = least_eigenvalue(A)
        assert is_symmetric(A) == (kind is not Kind.SKEWED)
        if kind is Kind.SKEWED:
            assert gap > 0.01
            skewed.append(A)
        elif kind is Kind.ROUNDED:
            assert 0 < gap < 1e-15
            assert least > 0.1
        else:
            assert gap == 0
            if kind is Kind.DEFINITE:
                assert least > 0.1
            elif kind in (Kind.INDEFINITE, Kind.NEGATIVE_DIAGONAL):
                assert least < -0.03
            else:
                assert abs(least) < 1e-14
    assert [np.linalg.eigvalsh(A)[0] > 0 for A in skewed] == [True, False, False, True]
    assert [np.all(np.linalg.eigvals(A).real > 0) for A in skewed] == [False, True, True, True]
    assert [least_eigenvalue(A) > 0 for A in skewed] == [False, False, True, True]
