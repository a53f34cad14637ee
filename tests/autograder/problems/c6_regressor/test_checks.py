"""What only c6-regressor asks: ranks, noise, and what is said of all of Y."""

import numpy as np
import pytest

from armdyn import Planar2R
from armdyn.base_parameters import base_parameters, on_link_axes
from armdyn.identify import identify
from armdyn.regressor import parameters
from autograder.judging import diagnosis
from autograder.judging.check import VISIBLE_CASES
from autograder.judging.criterion import Criterion
from autograder.judging.diagnosis import Wrong
from autograder.judging.stacked import layouts
from autograder.judging.verdict import State
from autograder.problems import CHECKS
from autograder.problems.c6_regressor import fit_mistakes, mistakes, regressors
from autograder.problems.c6_regressor.checks import LEAST_SHOWN, MOTIONS
from autograder.problems.material import planar_2r, sampling
from autograder.protocol import Reply, real
from tests.autograder.course_problems import problem
from tests.autograder.problems.c6_regressor.table import WEIGHTS, count, fit
from tests.autograder.verdicts import judged, judged_in, sentences

PROBLEM = problem("c6-regressor")


@pytest.mark.parametrize("constant", range(7))
def test_no_constant_is_a_rank(constant):
    namespace = {"rank_of_excitation": lambda *motion: constant}
    assert judged_in(namespace, "c6-rank_of_excitation", 0, VISIBLE_CASES).credit == 0


@pytest.mark.parametrize("seed", range(10))
def test_parameters_agree_with_the_library(seed):
    for call in CHECKS["c6-regressor"].calls(np.random.default_rng(seed), 6):
        *state, arm = call.args
        model = Planar2R(**vars(arm))
        columns = list(on_link_axes(model))
        base, pi = base_parameters(model, columns), parameters(model)
        np.testing.assert_allclose(planar_2r.parameters(arm), pi[columns], rtol=1e-14)
        assert tuple(columns[j] for j in planar_2r.BASE_COLUMNS) == base.independent
        np.testing.assert_allclose(planar_2r.base_parameters(arm), base.combination @ pi, rtol=1e-9)
        torque = model.inverse_dynamics(*state)
        Y = planar_2r.regressor(*state, arm)
        np.testing.assert_allclose(Y @ planar_2r.parameters(arm), torque, rtol=1e-10)


def test_estimates_agree_with_the_library():
    for call in CHECKS["c6-identify"].calls(np.random.default_rng(2), 6):
        q, qd, qdd, u, arm = call.args
        model = Planar2R(lc1=0.3, lc2=0.3, m1=1.0, m2=1.0, I1=0.1, I2=0.1, **vars(arm))
        theirs = identify(model, q, qd, qdd, u, columns=on_link_axes(model))
        np.testing.assert_allclose(fit_mistakes.fit(q, qd, qdd, u, arm), theirs.estimate, rtol=1e-9)


def test_ranks_are_those_of_the_course():
    """Four with ℓ1 known, three in orbit; two held still, three and four with a joint held."""
    check = CHECKS["c6-rank_of_excitation"]
    for seed in range(20):
        calls = check.calls(np.random.default_rng(seed), VISIBLE_CASES)
        assert [check.reference(*call.args) for call in calls] == [4, 3, 2, 3, 4, 2, 4, 2]
        for call in calls:
            values = np.linalg.svd(regressors.stacked(planar_2r.regressor(*call.args)))[1]
            assert not np.any((values > 1e-12 * values[0]) & (values < LEAST_SHOWN * values[0]))
            assert values[0] * LEAST_SHOWN > 1e-5  # a limit of 1e-6 N·m is as good
    assert len(MOTIONS) == 8


def test_noise_makes_the_truth_wrong():
    """With noise the estimate is asked for, not the arm's own parameters."""
    rng = np.random.default_rng(3)
    check = CHECKS["c6-identify"]
    for place, call in enumerate(check.calls(rng, 12)):
        q, qd, qdd, u, arm = call.args
        W = regressors.stacked(planar_2r.regressor(q, qd, qdd, arm))[:, planar_2r.BASE_COLUMNS]
        left = np.ravel(u) - W @ fit_mistakes.fit(q, qd, qdd, u, arm)
        assert (np.max(np.abs(left)) > 0.1) == bool(place % 2)
        assert set(vars(arm)) == {"l1", "l2", "g"}


def test_the_notebooks_own_cells_say_what_the_text_says(capsys):
    found = PROBLEM.namespace()
    printed = capsys.readouterr().out
    assert "Write" not in printed
    assert "twice m1    : the torques change by [0. 0.] N·m" in printed
    ranks = [line.split()[-1] for line in printed.splitlines() if " rank " in line]
    assert ranks == ["4", "3", "2", "3", "4", "2", "5", "3"]
    assert vars(found["robot"]) == vars(mistakes.EXAMPLE)
    rng = np.random.default_rng(0)
    for _ in range(20):
        arm, state = sampling.planar_2r(rng), rng.normal(size=(3, 2))
        expected = Planar2R(**vars(arm)).inverse_dynamics(*state)
        np.testing.assert_allclose(found["torques"](*state, arm), expected, rtol=1e-11, atol=1e-11)
    q, qd, qdd = found["rich_motion"](4001)
    np.testing.assert_allclose(np.gradient(q, 0.001, axis=0)[1:-1], qd[1:-1], atol=1e-4)
    np.testing.assert_allclose(np.gradient(qd, 0.001, axis=0)[1:-1], qdd[1:-1], atol=1e-4)


def test_six_for_centres_off_the_axes_and_four_of_them_in_orbit():
    """What the model answer says of links that are not symmetric."""
    for g, ranks in ((9.81, (6, 4)), (0.0, (4, 3))):
        model = Planar2R(**vars(mistakes.EXAMPLE) | {"g": g})
        on_axes = base_parameters(model, on_link_axes(model)).rank
        assert (base_parameters(model).rank, on_axes) == ranks


def test_singular_values_of_rounding_are_called_so():
    for seed in range(5):
        body = count("np.linalg.matrix_rank(W)", "np.sum(np.linalg.svd(W)[1] > 0)")
        said = judged("c6-rank_of_excitation", body, seed, VISIBLE_CASES).diagnosis
        (counts,) = sentences("c6-rank_of_excitation", "tolerance zero")
        assert counts in said or any("singular values" in sentence for sentence in said)


def test_a_weighted_fit_is_told_what_least_squares_means():
    verdict = judged(
        "c6-identify", fit("lstsq(W, t)", "lstsq(W * w[:, None], w * t)", "b =", WEIGHTS)
    )
    assert verdict.credit == pytest.approx(0.6)
    assert verdict.diagnosis == (CHECKS["c6-identify"].criteria[-1].otherwise,)


def test_a_doubled_error_is_not_two_mistakes():
    """Two orders of the columns leave a column empty; taken twice, that would make it −1 times it."""
    right = [(np.array([2.0]),), (np.array([3.0]),)]
    theirs = [(-value,) for (value,) in right]
    both = list(CHECKS["c6-regressor"].mistakes[:2])
    empty = Wrong(both, [np.zeros((2, layouts(theirs, right)[0].length))])
    said = diagnosis.sentences(
        (Criterion("column"),),
        right,
        theirs,
        [False],
        empty,
        lambda: [],
        lambda k: "",
        lambda k: "",
        lambda: [],
    )
    assert said == [()]


@pytest.mark.parametrize(
    ("spoilt", "said"),
    [
        (lambda Y: np.multiply(Y, [1, 1, 1, 1, -1, 1]), "Every entry"),
        (lambda Y: np.where(np.arange(6) == 4, Y[0], Y), "swapped the rows"),
        (lambda Y: Y * [[1, 0, 1, 1, 1, 1], [1] * 6], "the column of m1,"),
    ],
)
def test_what_is_said_of_all_of_Y_is_true_of_all_of_it(spoilt, said):
    check = CHECKS["c6-regressor"]

    def ask(calls):
        right = [np.array(check.reference(*map(real, call.args)), float) for call in calls]
        return [Reply(value=spoilt(Y)) for Y in right]

    verdict = check.run(ask, np.random.default_rng(5))
    assert verdict.state is State.PARTLY_CORRECT
    assert said not in " ".join(verdict.diagnosis)
