"""p2-energy-skew: right answers in many styles pass at any seed, whole notebooks get what they earn,
and the references agree with armdyn."""

import numpy as np
import pytest
import sympy as sp

from armdyn import Planar2R
from autograder.judging.check import HIDDEN_CASES, VISIBLE_CASES
from autograder.judging.verdict import State
from autograder.notebook.grade import is_judged, stream
from autograder.notebook.sitting import Sitting
from autograder.problems import CHECKS
from autograder.problems.p2_energy_skew.checks import CHECKS as P2
from autograder.protocol import real
from tests.autograder.course_problems import problem
from tests.autograder.seeds import A_THOUSAND
from tests.autograder.verdicts import (
    assert_right,
    assert_told_apart,
    function_of,
    judged,
    sentences,
)

PROBLEM = problem("p2-energy-skew")

H = "a, b = qd\nh = -arm.m2 * arm.l1 * arm.lc2 * np.sin(q[1])\n"
INERTIA = """
def M(q):
    c, d = arm.m2 * arm.l1 * arm.lc2 * np.cos(q[1]), arm.I2 + arm.m2 * arm.lc2**2
    M11 = arm.I1 + arm.m1 * arm.lc1**2 + arm.m2 * arm.l1**2 + d + 2 * c
    return np.array([[M11, d + c], [d + c, d]])
def by_difference(k, e=1e-6):
    step = e * np.eye(2)[k]
    return (M(q + step) - M(q - step)) / (2 * e)
"""
SYMBOLIC = """
x, v = sp.symbols("x1 x2"), sp.symbols("v1 v2")
c, d = arm.m2 * arm.l1 * arm.lc2 * sp.cos(x[1]), arm.I2 + arm.m2 * arm.lc2**2
M11 = arm.I1 + arm.m1 * arm.lc1**2 + arm.m2 * arm.l1**2 + d + 2 * c
M = sp.Matrix([[M11, d + c], [d + c, d]])
Mdot = M.diff(x[0]) * v[0] + M.diff(x[1]) * v[1]
"""
# The velocity of each centre of mass and its Jacobian, by the arm's geometry.
JACOBIANS = """
def J(q):
    s1, s12 = np.array([-np.sin(q[0]), np.cos(q[0])]), np.array([-np.sin(q.sum()), np.cos(q.sum())])
    J1 = np.array([arm.lc1 * s1, 0 * s1]).T
    J2 = np.array([arm.l1 * s1 + arm.lc2 * s12, arm.lc2 * s12]).T
    return J1, J2
def Jdot(e=1e-6):
    return [(p - m) / (2 * e) for p, m in zip(J(q + e * qd), J(q - e * qd), strict=True)]
"""
MASSES = "zip((arm.m1, arm.m2), J(q), Jdot(), strict=True)"
CHRISTOFFEL = "[[h * b, h * (a + b)], [-h * a, 0]]"
NUMERIC_CHRISTOFFEL = INERTIA + (
    "D = [by_difference(k) for k in range(2)]\n"
    "h = lambda i, j, k: (D[k][i, j] + D[j][i, k] - D[i][j, k]) / 2\n"
    "return [[sum(h(i, j, k) * qd[k] for k in range(2)) for j in range(2)] for i in range(2)]"
)
SUM = (
    "n = len(q)\n"
    "def h(i, j, k):\n"
    "    return (M[i, j].diff(q[k]) + M[i, k].diff(q[j]) - M[j, k].diff(q[i])) / 2\n"
    "def c(i, j):\n"
    "    return sum(h(i, j, k) * qd[k] for k in range(n))\n"
)
RIGHT = {
    "p2-M_dot": [
        H + "return np.array([[2 * h * b, h * b], [h * b, 0.0]])",
        H + "return [[2 * h * b, h * b], [h * b, 0]]",
        H + "return np.float32(h * b) * np.array([[2, 1], [1, 0]], dtype=np.float32)",
        H + "return ((2 * h * b, h * b), (h * b, 0 * b))",
        H + f"C = np.array({CHRISTOFFEL})\nreturn C + C.T",
        H + "return sp.Matrix([[2 * h * b, h * b], [h * b, 0]])",
        INERTIA + "return (M(q + 1e-6 * qd) - M(q - 1e-6 * qd)) / 2e-6",
        INERTIA + "return (M(q + 1e-7 * qd) - M(q)) / 1e-7",
        INERTIA + "return M(q + 1e-30j * qd).imag / 1e-30",
        INERTIA + "return by_difference(0) * qd[0] + by_difference(1) * qd[1]",
        SYMBOLIC + "return sp.lambdify([*x, *v], Mdot)(*q, *qd)",
        JACOBIANS + f"return sum(m * (J.T @ Jd + Jd.T @ J) for m, J, Jd in {MASSES})",
    ],
    "p2-C": [
        H + f"return np.array({CHRISTOFFEL})",
        H + f"return {CHRISTOFFEL}",
        H + f"return np.float32({CHRISTOFFEL})",
        H + f"return sp.Matrix({CHRISTOFFEL})",
        H + "return h * np.outer([1, 0], [b, a + b]) - h * np.outer([0, 1], [a, 0])",
        H
        + "half_of_M_dot = h * b / 2 * np.array([[2, 1], [1, 0]])\n"
        + "return half_of_M_dot + h * (a + b / 2) * np.array([[0, 1], [-1, 0]])",
        H + "h = np.array([[[0, h], [h, h]], [[-h, 0], [0, 0]]])\nreturn h @ qd",
        NUMERIC_CHRISTOFFEL,
        INERTIA
        + "D = np.stack([by_difference(0), by_difference(1)], axis=-1)\n"
        + "return (D + D.swapaxes(1, 2) - D.transpose(2, 0, 1)) @ qd / 2",
        SYMBOLIC
        + "N = sp.Matrix(2, 2, lambda i, j: sum((M[j, k].diff(x[i]) - M[i, k].diff(x[j])) * v[k]\n"
        + "                                     for k in range(2)))\n"
        + "return sp.lambdify([*x, *v], (Mdot - N) / 2)(*q, *qd)",
        JACOBIANS + f"return sum(m * J.T @ Jd for m, J, Jd in {MASSES})",
        H + f"return np.asfortranarray({CHRISTOFFEL}).tolist()",
    ],
    "p2-C_other": [
        H + "return [[0, h * (2 * a + b)], [-h * a, 0]]",
        H + "return np.array([[2 * h * b, h * b], [-h * a, 0]])",
        H + "return np.float32([[0, h * (2 * a + b)], [-h * a, 0]])",
        H + f"return np.array({CHRISTOFFEL}) + np.array([[-b, a], [0, 0]])",
        H + f"return np.array({CHRISTOFFEL}) + np.outer([1, 2], [b, -a])",
        H + f"return np.array({CHRISTOFFEL}) + 5 * a * b * np.outer([0, 1], [b, -a])",
        H + f"return sp.Matrix({CHRISTOFFEL}) + sp.Matrix([[b, -a], [b, -a]])",
        H + "return [[h * b, h * (a + b)], [-h * a - b, a]]",
        # C q̇ divided back by q̇: a matrix of rank one.
        H + f"return np.outer(np.array({CHRISTOFFEL}) @ qd, qd) / (qd @ qd)",
        H + "return np.diag([h * (2 * b + b**2 / a), -h * a**2 / b])",
        INERTIA
        + "grad = np.array([qd @ by_difference(k) @ qd / 2 for k in range(2)])\n"
        + "return by_difference(1) * qd[1] - np.outer(grad, [1 / qd[0], 0])",
    ],
    "p2-christoffel": [
        SUM + "return sp.Matrix(n, n, c)",
        SUM + "return sp.ImmutableMatrix(n, n, c)",
        SUM + "return [[c(i, j) for j in range(n)] for i in range(n)]",
        SUM + "return tuple(tuple(c(i, j) for j in range(n)) for i in range(n))",
        SUM + "return np.array([[c(i, j) for j in range(n)] for i in range(n)])",
        SUM + "return sp.Array([[c(i, j) for j in range(n)] for i in range(n)])",
        SUM + "return sp.Matrix(n, n, c).expand()",
        SUM + "return sp.Matrix(n, n, c).applyfunc(sp.nsimplify)",
        # ½(Ṁ + (∂(M q̇)/∂q) − its transpose).
        "Mv = M * sp.Matrix(qd)\nG = Mv.jacobian(q)\n"
        "Mdot = sum((M.diff(x) * v for x, v in zip(q, qd, strict=True)), sp.zeros(len(q)))\n"
        "return (Mdot + G - G.T) / 2",
        # Derivatives that are named and not taken.
        "n = len(q)\ndef d(i, j, k):\n    return sp.Derivative(M[i, j], q[k])\n"
        "return sp.Matrix(n, n, lambda i, j: sum((d(i, j, k) + d(i, k, j) - d(j, k, i)) * qd[k] / 2\n"
        "                                        for k in range(n)))",
        # From the energy: half the Hessian of the velocity torque with respect to q̇.
        "v = sp.Matrix(qd)\nK = (v.T * M * v)[0] / 2\n"
        "p = [K.diff(w) for w in qd]\n"
        "tau = [sum(x.diff(y) * w for y, w in zip(q, qd, strict=True)) - K.diff(y)\n"
        "       for x, y in zip(p, q, strict=True)]\n"
        "return sp.Matrix([[t.diff(w) / 2 for w in qd] for t in tau])",
    ],
}
CASES = [(check_id, body) for check_id, variants in RIGHT.items() for body in variants]


@pytest.mark.parametrize(("check_id", "body"), CASES)
def test_right_in_any_style(check_id, body):
    assert_right(judged(check_id, body, seed=1))


def test_ten_variants_at_least():
    assert all(len(variants) >= 10 for variants in RIGHT.values())


@A_THOUSAND
@pytest.mark.parametrize("check_id", ["p2-M_dot", "p2-C", "p2-C_other"])
def test_no_false_alarm_over_a_thousand_seeds(check_id, seeds):
    """In single precision, which is the harder one."""
    single = RIGHT[check_id][2]
    assert "float32" in single
    for seed in seeds:
        verdict = judged(check_id, single, seed, VISIBLE_CASES)
        assert verdict.state is State.CORRECT, f"seed {seed}: {verdict}"


@pytest.mark.parametrize(("check_id", "body"), [("p2-C", NUMERIC_CHRISTOFFEL),
                                                ("p2-M_dot", RIGHT["p2-M_dot"][7])])  # fmt: skip
def test_no_false_alarm_on_numerical_derivatives(check_id, body):
    for seed in range(200):
        assert judged(check_id, body, seed, VISIBLE_CASES).state is State.CORRECT


def test_no_false_alarm_on_symbols():
    right = RIGHT["p2-christoffel"][0]
    for seed in range(40):
        assert judged("p2-christoffel", right, seed, VISIBLE_CASES).state is State.CORRECT


@pytest.mark.parametrize(
    ("check_id", "body"),
    [
        ("p2-M_dot", H + "return 1.0001 * h * b * np.array([[2, 1], [1, 0]])"),
        ("p2-C", H + f"return 1.0001 * np.array({CHRISTOFFEL})"),
        ("p2-C_other", H + "return [[0, h * (2 * a + b) * 1.0001], [-h * a, 0]]"),
        ("p2-christoffel", SUM + "return 1.0001 * sp.Matrix(n, n, c)"),
    ],
)
def test_wrong_by_1e_4_fails_at_any_seed(check_id, body):
    for seed in range(10):
        assert (
            judged(check_id, body, seed, VISIBLE_CASES).credit <= 0.1
        )  # Ṁ22 is zero, and stays so


@pytest.mark.parametrize("seed", range(20))
def test_references_agree_with_the_library(seed):
    """The checks' own references, against armdyn, at the checks' own cases."""
    for call in CHECKS["p2-C"].calls(np.random.default_rng(seed), 5):
        q, qd, arm = call.args
        model = Planar2R(**vars(arm))
        C = model.C(q, qd)
        np.testing.assert_allclose(CHECKS["p2-C"].reference(*call.args), C, rtol=1e-12)
        np.testing.assert_allclose(CHECKS["p2-M_dot"].reference(*call.args), C + C.T, rtol=1e-12)
        other = CHECKS["p2-C_other"].reference(*call.args)
        np.testing.assert_allclose(other @ qd, C @ qd, rtol=1e-12)
        assert not np.allclose(other + other.T, C + C.T, rtol=1e-2)


def test_symbolic_reference_agrees_with_the_definition():
    """The complex step against SymPy's own derivatives."""
    check = CHECKS["p2-christoffel"]
    for call in check.calls(np.random.default_rng(3), HIDDEN_CASES):
        M, q, qd = map(real, call.args)
        r, (point,) = range(len(q)), call.at
        D = [[[M[i, j].diff(q[k]) for k in r] for j in r] for i in r]
        C = [
            [sum((D[i][j][k] + D[i][k][j] - D[j][k][i]) / 2 * qd[k] for k in r) for j in r]
            for i in r
        ]
        at = {symbol: point[symbol.name] for symbol in (*q, *qd)}
        expected = np.array(sp.Matrix(C).subs(at), dtype=float)
        np.testing.assert_allclose(check.reference.of(call, point), expected, rtol=1e-12)


@pytest.mark.parametrize("check", P2, ids=lambda check: check.id)
def test_no_wrong_model_looks_like_another(check):
    for seed in range(3):
        assert_told_apart(check, seed)


def test_wrong_answers_are_named():
    graded = PROBLEM.graded("wrong")
    for check_id, name in (
        ("p2-M_dot", "velocities exchanged"),
        ("p2-C", "C times ones"),
        ("p2-C_other", "first entry dropped"),
        ("p2-christoffel", "M_dot for C"),
    ):
        assert graded.verdicts[check_id].diagnosis == sentences(check_id, name)


def test_partly_right_answers_get_part_of_the_credit():
    verdicts = PROBLEM.graded("partly_right").verdicts
    assert {name: verdict.credit for name, verdict in verdicts.items()} == {
        "p2-M_dot": 0.55,
        "p2-C": 0.7,
        "p2-C_other": 0.5,
        "p2-christoffel": 1.0,
    }
    assert "not skew-symmetric" in verdicts["p2-C"].diagnosis[0]


def test_all_variants_pass_through_the_room_and_its_wall():
    with Sitting() as sitting:
        for cell in PROBLEM.release.cells:
            if cell.cell_type == "code" and not is_judged(cell):
                sitting.run(cell.source)
        for check_id, body in CASES:
            sitting.run(function_of(check_id, body))
            verdict = CHECKS[check_id].run(sitting.ask, stream("seed", check_id), HIDDEN_CASES)
            assert verdict.state is State.CORRECT, f"{body}\n{verdict}"
