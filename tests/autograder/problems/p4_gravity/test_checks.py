"""What only p4-gravity asks: an energy but for a constant, Jacobians, and the equilibria."""

import itertools
from types import SimpleNamespace

import numpy as np
import pytest

import armdyn.equilibria
from armdyn import Planar2R
from autograder.judging.check import HIDDEN_CASES, VISIBLE_CASES
from autograder.judging.claims import OF_A_PART
from autograder.judging.verdict import State
from autograder.notebook.grade import stream
from autograder.problems import CHECKS
from autograder.problems.material import sampling
from tests.autograder.course_problems import problem
from tests.autograder.problems.p4_gravity.right import HEIGHTS
from tests.autograder.problems.p4_gravity.table import HALF_PI
from tests.autograder.verdicts import judged, sentences

PROBLEM = problem("p4-gravity")
FOUR = [(s * np.pi / 2, e) for s in (-1, 1) for e in (0.0, np.pi)]
# Those that have a name, by their places in FOUR.
NAMES_OF_SUBSETS = {
    (0, 2): "stretched only",
    (0,): "stable only",
    (2,): "one value of the inverse cosine",
    (2, 3): "link 1 up only",
    (0, 1): "link 1 down only",
}
STILL_NEEDED, MISSING = (c.said[1].text for c in CHECKS["p4-equilibria"].criteria)


def test_a_constant_of_each_arm_is_free_but_not_one_that_moves_with_q():
    free = f"{HEIGHTS}return arm.g * (arm.m1 * y1 + arm.m2 * y2) + np.exp(arm.l1 * arm.m2)"
    assert judged("p4-potential_energy", free).credit == 1
    for moves in ("np.sin(q[0]) ** 2", "np.cos(2 * q[1])", "(q[0] + q[1]) ** 3"):
        body = f"{HEIGHTS}return arm.g * (arm.m1 * y1 + arm.m2 * y2) + {moves}"
        verdict = judged("p4-potential_energy", body)
        assert verdict.credit < 1


@pytest.mark.parametrize("seed", range(20))
def test_the_equilibria_are_those_of_the_library(seed):
    rng = np.random.default_rng(seed)
    check, arm = CHECKS["p4-equilibria"], sampling.planar_2r(rng)
    known = armdyn.equilibria.equilibria(Planar2R(**vars(arm)))
    call = check.calls(rng, 6)[0]
    for found in check.quantities([call], [np.array([one.q for one in known])])[0]:
        np.testing.assert_allclose(found, 0.0, atol=1e-7)


def test_jacobian_form_gives_the_arms_own_gravity():
    """Σ over both links of the 2R, against its closed form."""
    rng = np.random.default_rng(5)
    solution = PROBLEM.namespace()
    for _ in range(20):
        arm, q = sampling.planar_2r(rng), sampling.angles(rng)
        jacobians = solution["com_jacobians"](q, arm)
        masses, g0 = np.array([arm.m1, arm.m2]), np.array([0.0, -arm.g, 0.0])
        g = CHECKS["p4-gravity_from_jacobians"].reference(jacobians, masses, g0)
        np.testing.assert_allclose(g, Planar2R(**vars(arm)).g_vec(q), rtol=1e-12)


def test_a_crash_costs_its_own_cells_alone():
    verdicts = PROBLEM.graded("crashing").verdicts
    right = {name for name, verdict in verdicts.items() if verdict.state is State.CORRECT}
    assert right == {"p4-potential_energy", "p4-gravity_from_jacobians"}


def test_the_visible_arms_do_not_decide():
    """The grader's arms are others than those of the visible check."""
    check = CHECKS["p4-g_vec"]
    seen = [call.args[1] for call in check.calls(np.random.default_rng(0), VISIBLE_CASES)]
    hidden = [call.args[1] for call in check.calls(stream("seed", check.id), HIDDEN_CASES)]
    assert all(isinstance(arm, SimpleNamespace) for arm in seen + hidden)
    assert not any(a.l1 == b.l1 for a in seen for b in hidden)


@pytest.mark.parametrize(
    "chosen", [chosen for k in (1, 2, 3) for chosen in itertools.combinations(range(4), k)]
)
def test_some_of_the_equilibria_are_half_of_the_answer(chosen):
    """Every choice of fewer than four: each is right, not all are there, and nothing false is said."""
    verdict = judged("p4-equilibria", repr([FOUR[k] for k in chosen]))
    assert verdict.credit == 0.5
    assert [row.met for row in verdict.rows] == [True, False]
    named = NAMES_OF_SUBSETS.get(chosen)
    assert verdict.diagnosis == (sentences("p4-equilibria", named) if named else (MISSING,))


def test_one_configuration_too_many_costs_the_other_half():
    verdict = judged("p4-equilibria", repr([*FOUR, (0.3, 0.0)]))
    assert [row.met for row in verdict.rows] == [False, True]
    assert verdict.diagnosis == (STILL_NEEDED,)


def test_what_is_missing_is_told_apart_though_another_configuration_is_there():
    """The distances alone must not take absolute angles for angles from the vertical."""
    pairs = f"[(a, b) for a in (-{HALF_PI}, {HALF_PI}) for b in (-{HALF_PI}, {HALF_PI})]"
    said = judged("p4-equilibria", f"{pairs} + [(0, 0)]").diagnosis
    (sentence,) = sentences("p4-equilibria", "absolute second angle")
    assert said[1:] == (f"{OF_A_PART}{sentence}",)


@pytest.mark.parametrize("left_out", range(4))
def test_no_entry_is_to_blame_for_an_equilibrium_that_is_missing(left_out):
    found = [at for k, at in enumerate(FOUR) if k != left_out]
    verdict = judged("p4-equilibria", repr(found))
    assert "equilibria[" not in verdict.witness.returned
    assert "no other entry" not in verdict.witness.returned
