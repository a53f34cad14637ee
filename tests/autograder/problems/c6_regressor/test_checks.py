"""c6-regressor: right answers in many styles pass at any seed, whole notebooks get what they earn, and
the references agree with armdyn."""

import numpy as np
import pytest

from armdyn import Planar2R
from armdyn.base_parameters import base_parameters, on_link_axes
from armdyn.identify import identify
from armdyn.regressor import parameters, regressor
from autograder.judging.check import VISIBLE_CASES
from autograder.judging.verdict import State
from autograder.notebook.grade import grade
from autograder.notebook.recognise import grade_id
from autograder.problems import CHECKS
from autograder.problems.c6_regressor import mistakes
from autograder.problems.c6_regressor.checks import CHECKS as C6
from autograder.problems.c6_regressor.checks import LEAST_SHOWN, MOTIONS
from autograder.problems.material import planar_2r, sampling
from tests.autograder.course_problems import problem, states
from tests.autograder.seeds import A_THOUSAND
from tests.autograder.verdicts import (
    assert_right,
    function_of,
    judged,
    judged_in,
    namespace_of,
    sentences,
)
from tests.submissions.answers import answered

PROBLEM = problem("c6-regressor")

# The equation of motion, as the notebook gives it, and arms made of π: links of these m, m ℓc, J.
TORQUES = """
def torques(q, qd, qdd, l1, g, m1, mc1, J1, m2, mc2, J2):
    c2, s2, c12 = np.cos(q[1]), np.sin(q[1]), np.cos(q[0] + q[1])
    M = np.array([[J1 + J2 + m2 * l1**2 + 2 * l1 * mc2 * c2, J2 + l1 * mc2 * c2],
                  [J2 + l1 * mc2 * c2, J2]])
    h = -l1 * mc2 * s2
    C = h * np.array([[qd[1], qd[0] + qd[1]], [-qd[0], 0]])
    g2 = mc2 * g * c12
    return M @ qdd + C @ qd + [(mc1 + m2 * l1) * g * np.cos(q[0]) + g2, g2]
"""
ENTRIES = """
l1, g = arm.l1, arm.g
(q1, q2), (v1, v2), (a1, a2) = q, qd, qdd
c1, c2, s2, c12 = np.cos(q1), np.cos(q2), np.sin(q2), np.cos(q1 + q2)
top = [0, g*c1, a1, l1**2*a1 + l1*g*c1, l1*(c2*(2*a1 + a2) - s2*(2*v1*v2 + v2**2)) + g*c12, a1 + a2]
low = [0, 0, 0, 0, l1*(c2*a1 + s2*v1**2) + g*c12, a1 + a2]
"""
LINK_BY_LINK = """
def planar_link(angle, rate, spin, joint_dd):
    x = np.array([np.cos(angle), np.sin(angle)])
    y = np.array([-x[1], x[0]])
    x_dd = spin * y - rate**2 * x
    cross = lambda a, b: a[0] * b[1] - a[1] * b[0]
    forces = [joint_dd, x_dd, 0 * x]
    return forces, [0, cross(x, joint_dd), spin], x, x_dd

up = np.array([0, arm.g])
f1, n1, x1, x1_dd = planar_link(q[0], qd[0], qdd[0], up)
f2, n2, _, _ = planar_link(q.sum(), qd.sum(), qdd.sum(), up + arm.l1 * x1_dd)
elbow = arm.l1 * x1
carried = [n + elbow[0] * f[1] - elbow[1] * f[0] for n, f in zip(n2, f2)]
return [[*n1, *carried], [0, 0, 0, *n2]]
"""
LAGRANGE = """
def parts(q, qd):
    s = np.array([np.sin(q[0]), np.sin(q[0] + q[1])])
    w = np.array([qd[0], qd[0] + qd[1]])
    elbow = arm.l1 * w[0]
    K = [0, 0, w[0]**2/2, elbow**2/2, elbow * w[1] * np.cos(q[1]), w[1]**2/2]
    P = [0, arm.g*s[0], 0, arm.g*arm.l1*s[0], arm.g*s[1], 0]
    return np.array(K), np.array(P)

def momentum(i, q, qd, e=1e-3):
    d = e * np.eye(2)[i]
    return (parts(q, qd + d)[0] - parts(q, qd - d)[0]) / (2 * e)

Y, e = np.zeros((2, 6)), 1e-5
for i in range(2):
    d = e * np.eye(2)[i]
    later, before = (momentum(i, q + s*e*qd, qd + s*e*qdd) for s in (1, -1))
    (Kp, Pp), (Km, Pm) = parts(q + d, qd), parts(q - d, qd)
    Y[i] = (later - before) / (2 * e) - (Kp - Km) / (2 * e) + (Pp - Pm) / (2 * e)
return Y
"""
SYMBOLIC = """
q1, q2, v1, v2, a1, a2, *pi = sp.symbols("q1 q2 v1 v2 a1 a2 m1 b1 J1 m2 b2 J2")
m1, b1, J1, m2, b2, J2 = pi
l, g = arm.l1, arm.g
M11 = J1 + J2 + m2 * l**2 + 2 * l * b2 * sp.cos(q2)
M12 = J2 + l * b2 * sp.cos(q2)
h = -l * b2 * sp.sin(q2)
P = g * (b1 * sp.sin(q1) + m2 * l * sp.sin(q1) + b2 * sp.sin(q1 + q2))
tau = sp.Matrix([M11*a1 + M12*a2 + h*(2*v1*v2 + v2**2), M12*a1 + J2*a2 - h*v1**2])
Y = (tau + sp.Matrix([P]).jacobian([q1, q2]).T).jacobian(pi)
"""
STATE = "dict(zip((q1, q2, v1, v2, a1, a2), (*q, *qd, *qdd)))"
# Rows of all samples for the other two questions, with the regressor above.
ROWS = "def regressor(q, qd, qdd, arm):\n" + "".join(
    f"    {line}\n" for line in [*ENTRIES.strip().splitlines(), "return np.array([top, low])"]
)
W = f"{ROWS}W = np.vstack([regressor(*s, arm) for s in zip(q, qd, qdd)])\n"
WB = f"{W}W, t = W[:, [1, 2, 4, 5]], np.ravel(u)\n"
RIGHT = {
    "c6-regressor": [
        f"{ENTRIES}return np.array([top, low])",
        f"{ENTRIES}return [top, low]",
        f"{ENTRIES}return np.array([top, low], dtype=np.float32)",
        f"{ENTRIES}return sp.Matrix([top, low])",
        f"{ENTRIES}return list(zip(top, low)) and tuple(map(tuple, (top, low)))",
        f"{TORQUES}return np.array([torques(q, qd, qdd, arm.l1, arm.g, *e) for e in np.eye(6)]).T",
        f"{TORQUES}tau = lambda p: torques(q, qd, qdd, arm.l1, arm.g, *p)\n"
        "return np.array([(tau(1 + d) - tau(1 - d)) / 2e-3 for d in 1e-3 * np.eye(6)]).T",
        LINK_BY_LINK,
        LAGRANGE,
        f"{SYMBOLIC}return Y.subs({STATE})",
        f"{SYMBOLIC}return sp.lambdify((q1, q2, v1, v2, a1, a2), Y)(*q, *qd, *qdd)",
        "z1, z2 = np.exp(1j * q[0]), np.exp(1j * q.sum())\n"
        "acc = lambda z, w, a: (1j * a - w**2) * z\n"
        "e_dd = arm.l1 * acc(z1, qd[0], qdd[0]) + 1j * arm.g\n"
        "z2_dd = acc(z2, qd.sum(), qdd.sum())\n"
        "dot = lambda v, f: (np.conj(v) * f).real\n"
        "n2 = dot(1j * z2, e_dd)\n"
        "return [[0, dot(1j * z1, 1j * arm.g), qdd[0], dot(1j * arm.l1 * z1, e_dd), "
        "n2 + dot(1j * arm.l1 * z1, z2_dd), qdd.sum()], [0, 0, 0, 0, n2, qdd.sum()]]",
    ],
    "c6-rank_of_excitation": [
        f"{W}return np.linalg.matrix_rank(W)",
        f"{W}s = np.linalg.svd(W, compute_uv=False)\nreturn int((s > 1e-10 * s[0]).sum())",
        f"{W}return np.linalg.matrix_rank(W, tol=1e-6)",
        f"{W}return float(np.linalg.matrix_rank(W.T @ W, rtol=1e-10))",
        f"{W}return [np.linalg.matrix_rank(W[:, [1, 2, 4, 5]])]",
        f"{W}return np.linalg.matrix_rank(np.float32(W))",
        f"{W}R = scipy.linalg.qr(W, pivoting=True)[1]\nd = abs(np.diag(R))\n"
        "return np.sum(d > 1e-9 * d[0])",
        f"{W}return 6 - scipy.linalg.null_space(W, rcond=1e-9).shape[1]",
        f"{W}return scipy.linalg.orth(W, rcond=1e-9).shape[1]",
        f"{W}return np.sum(np.linalg.eigvalsh(W.T @ W) > 1e-8)",
        f"{W}r = np.linalg.lstsq(W, np.ones(len(W)), rcond=1e-9)[2]\nreturn np.array([[r]])",
        f"{W}kept = []\nfor c in W.T:\n"
        "    for _ in range(2):\n        for k in kept:\n            c = c - k * (k @ c)\n"
        "    if np.linalg.norm(c) > 1e-6:\n        kept.append(c / np.linalg.norm(c))\n"
        "return len(kept)",
    ],
    "c6-identify": [
        f"{WB}return np.linalg.lstsq(W, t)[0]",
        f"{WB}return np.linalg.pinv(W) @ t",
        f"{WB}return list(np.linalg.solve(W.T @ W, W.T @ t))",
        f"{WB}Q, R = np.linalg.qr(W)\nreturn scipy.linalg.solve_triangular(R, Q.T @ t)[:, None]",
        f"{WB}return np.float32(np.linalg.lstsq(W, t)[0])",
        f"{WB}return np.linalg.lstsq(np.float32(W), np.float32(t))[0]",
        f"{WB}return scipy.optimize.least_squares(lambda b: W @ b - t, np.zeros(4), xtol=1e-12, "
        "ftol=1e-12, gtol=1e-12).x",
        f"{W}p = np.linalg.lstsq(W, np.ravel(u), rcond=1e-9)[0]\n"
        "return p[1] + arm.l1 * p[3], p[2] + arm.l1**2 * p[3], p[4], p[5]",
        f"{ROWS}Y = [regressor(*s, arm)[:, [1, 2, 4, 5]] for s in zip(q, qd, qdd)]\n"
        "return np.linalg.solve(sum(y.T @ y for y in Y), sum(y.T @ t for y, t in zip(Y, u)))",
        f"{WB}A = np.r_[W[::2], W[1::2]]\nreturn np.linalg.lstsq(A, u.ravel(order='F'))[0]",
        f"{WB}P, b = 1e9 * np.eye(4), np.zeros(4)\nfor w, y in zip(W, t):\n"
        "    k = P @ w / (1 + w @ P @ w)\n    b, P = b + k * (y - w @ b), P - np.outer(k, w @ P)\n"
        "return b + np.linalg.lstsq(W, t - W @ b)[0]",
        f"{WB}size = np.linalg.norm(W, axis=0)\nreturn np.linalg.lstsq(W / size, t)[0] / size",
    ],
}  # fmt: skip
CASES = [(check_id, k) for check_id, variants in RIGHT.items() for k in range(len(variants))]


@pytest.mark.parametrize(("check_id", "k"), CASES)
def test_right_in_any_style(check_id, k):
    body = RIGHT[check_id][k]
    for seed in range(3):
        assert_right(judged(check_id, body, seed, VISIBLE_CASES))


def test_ten_variants_at_least():
    assert all(len(variants) >= 10 for variants in RIGHT.values())


def in_single_precision(model):
    """The model with arguments and result rounded to single precision."""

    def rounded(*args):
        *arrays, arm = args
        return np.float32(model(*(np.float32(x).astype(float) for x in arrays), arm))

    return rounded


@A_THOUSAND
@pytest.mark.parametrize("check", C6, ids=lambda check: check.id)
def test_no_false_alarm_over_a_thousand_seeds(check, seeds):
    """In single precision, which is the harder one, and every fifth seed in double."""
    double, single = check.reference, in_single_precision(check.reference)
    for seed in seeds:
        for model in (single, double) if seed % 5 == 0 else (single,):
            verdict = judged_in({check.name: model}, check.id, seed, VISIBLE_CASES)
            assert verdict.state is State.CORRECT, f"seed {seed}: {verdict}"


@pytest.mark.parametrize(
    ("check_id", "k"), [("c6-regressor", 2), ("c6-rank_of_excitation", 0), ("c6-identify", 5)]
)
def test_no_false_alarm_on_a_students_own_lines(check_id, k):
    namespace = namespace_of(check_id, RIGHT[check_id][k])
    for seed in range(100):
        assert judged_in(namespace, check_id, seed, VISIBLE_CASES).state is State.CORRECT


@pytest.mark.parametrize(
    ("check_id", "column"), [*(("c6-regressor", j) for j in range(1, 6)), ("c6-identify", None)]
)
def test_wrong_by_1e_4_fails_at_any_seed(check_id, column):
    """Each column of Y by itself; the estimate as a whole."""
    right = CHECKS[check_id].reference
    factor = 1 + 1e-4 * (np.arange(6) == column) if column else 1.0001

    def wrong(*args):
        return right(*args) * factor

    for seed in range(20):
        verdict = judged_in({CHECKS[check_id].name: wrong}, check_id, seed, VISIBLE_CASES)
        assert verdict.state is not State.CORRECT


@pytest.mark.parametrize("k", range(4))
def test_one_parameter_wrong_by_1e_4_fails_at_any_seed(k):
    def wrong(*args):
        return mistakes.fit(*args) * (1 + 1e-4 * (np.arange(4) == k))

    for seed in range(20):
        verdict = judged_in({"identify": wrong}, "c6-identify", seed, VISIBLE_CASES)
        assert verdict.credit == pytest.approx(0.5)


@pytest.mark.parametrize("constant", range(7))
def test_no_constant_is_a_rank(constant):
    namespace = {"rank_of_excitation": lambda *motion: constant}
    assert judged_in(namespace, "c6-rank_of_excitation", 0, VISIBLE_CASES).credit == 0


@pytest.mark.parametrize("check", C6, ids=lambda check: check.id)
def test_a_hundredth_too_much_earns_nothing(check):
    def wrong(*args):
        return 1.013 * np.asarray(check.reference(*args)) + 0.01

    assert judged_in({check.name: wrong}, check.id, 1, VISIBLE_CASES).credit == 0


@pytest.mark.parametrize("seed", range(10))
def test_references_agree_with_the_library(seed):
    rng = np.random.default_rng(seed)
    for call in CHECKS["c6-regressor"].calls(rng, 6):
        *state, arm = call.args
        model = Planar2R(**vars(arm))
        columns = list(on_link_axes(model))
        Y, base = regressor(model, *state), base_parameters(model, columns)
        np.testing.assert_allclose(planar_2r.regressor(*state, arm), Y[:, columns], atol=1e-12)
        pi = parameters(model)
        np.testing.assert_allclose(planar_2r.parameters(arm), pi[columns], rtol=1e-14)
        assert tuple(columns[j] for j in planar_2r.BASE_COLUMNS) == base.independent
        np.testing.assert_allclose(planar_2r.base_parameters(arm), base.combination @ pi, rtol=1e-9)
        torque = model.inverse_dynamics(*state)
        np.testing.assert_allclose(
            planar_2r.regressor(*state, arm) @ planar_2r.parameters(arm), torque, rtol=1e-10
        )


def test_estimates_agree_with_the_library():
    for call in CHECKS["c6-identify"].calls(np.random.default_rng(2), 6):
        q, qd, qdd, u, arm = call.args
        model = Planar2R(lc1=0.3, lc2=0.3, m1=1.0, m2=1.0, I1=0.1, I2=0.1, **vars(arm))
        theirs = identify(model, q, qd, qdd, u, columns=on_link_axes(model))
        np.testing.assert_allclose(mistakes.fit(q, qd, qdd, u, arm), theirs.estimate, rtol=1e-9)


def test_ranks_are_those_of_the_course():
    """Four with ℓ1 known, three in orbit; two held still, three and four with a joint held."""
    check = CHECKS["c6-rank_of_excitation"]
    for seed in range(20):
        calls = check.calls(np.random.default_rng(seed), VISIBLE_CASES)
        assert [check.reference(*call.args) for call in calls] == [4, 3, 2, 3, 4, 2, 4, 2]
        for call in calls:
            values = np.linalg.svd(mistakes.stacked(planar_2r.regressor(*call.args)))[1]
            assert not np.any((values > 1e-12 * values[0]) & (values < LEAST_SHOWN * values[0]))
            assert values[0] * LEAST_SHOWN > 1e-5  # a limit of 1e-6 N·m is as good
    assert len(MOTIONS) == 8


def test_noise_makes_the_truth_wrong():
    """With noise the estimate is asked for, not the arm's own parameters."""
    rng = np.random.default_rng(3)
    check = CHECKS["c6-identify"]
    for place, call in enumerate(check.calls(rng, 12)):
        q, qd, qdd, u, arm = call.args
        W = mistakes.stacked(planar_2r.regressor(q, qd, qdd, arm))[:, planar_2r.BASE_COLUMNS]
        left = np.ravel(u) - W @ mistakes.fit(q, qd, qdd, u, arm)
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


def test_no_hint_gives_the_formula():
    for check in C6:
        assert not any(
            sign in hint for hint in check.hints for sign in ("cos(", "sin(", "*", "q̈1 +")
        )


def test_wrong_answers_are_named():
    graded = PROBLEM.graded("wrong")
    for check_id, *names in (
        (
            "c6-regressor",
            "wrong sign / g(q)",
            "absolute acceleration of link 2",
            "J1 at joint 2",
        ),
        ("c6-rank_of_excitation", "number of columns"),
    ):
        assert graded.verdicts[check_id].diagnosis == sentences(check_id, *names)


def test_partly_right_answers_get_part_of_the_credit():
    graded = PROBLEM.graded("partly_right")
    credits = {name: verdict.credit for name, verdict in graded.verdicts.items()}
    assert credits == pytest.approx(
        {"c6-regressor": 0.75, "c6-rank_of_excitation": 0.35, "c6-identify": 0.0}
    )
    assert graded.verdicts["c6-identify"].diagnosis == sentences(
        "c6-identify", "fit: coupling without the factor 2"
    )


def test_variants_pass_in_a_graded_notebook():
    """One of each check's other styles, through the room and its wall."""
    answers = {}
    for check_id, k in (("c6-regressor", 7), ("c6-rank_of_excitation", 6), ("c6-identify", 3)):
        function = function_of(check_id, RIGHT[check_id][k])
        answers[CHECKS[check_id].name] = f"import scipy.linalg\n{function}"
    graded = grade(answered(PROBLEM.release, **answers), PROBLEM.source, "seed")
    assert set(states(graded).values()) == {State.CORRECT}


def test_grade_ids_stay():
    assert [grade_id(cell) for cell in PROBLEM.source.cells if grade_id(cell)] == [
        "c6-setup",
        "answer-regressor",
        "c6-regressor",
        "c6-columns",
        "answer-rank_of_excitation",
        "c6-rank_of_excitation",
        "c6-motions",
        "answer-identify",
        "c6-identify",
        "c6-scatter",
        "c6-second-difference",
        "c6-five-columns",
        "c6-discussion",
    ]
