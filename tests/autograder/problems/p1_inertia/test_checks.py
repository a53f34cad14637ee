"""p1-inertia: right answers in many styles pass at any seed; references and notebook hold."""

import numpy as np
import pytest

from armdyn import Planar2R, SerialChain
from armdyn.models.link import Link
from autograder.judging.check import VISIBLE_CASES
from autograder.judging.verdict import State
from autograder.problems import CHECKS
from autograder.problems.material.definiteness import MATRICES
from autograder.problems.p1_inertia.checks import CHECKS as P1
from tests.autograder.course_problems import problem
from tests.autograder.seeds import A_THOUSAND
from tests.autograder.verdicts import assert_right, judged, judged_in, namespace_of, sentences

PROBLEM = problem("p1-inertia")

CLOSED = """
k = arm.m2 * arm.l1 * arm.lc2 * np.cos(q[1])
b = arm.I2 + arm.m2 * arm.lc2**2
a = arm.I1 + arm.m1 * arm.lc1**2 + arm.m2 * arm.l1**2
"""
# Velocities of the centres of mass as functions of q̇, for M through the energy.
ENERGY = """
def K(qd):
    w1, w2 = qd[0], qd[0] + qd[1]
    vx = -arm.l1 * np.sin(q[0]) * w1 - arm.lc2 * np.sin(q[0] + q[1]) * w2
    vy = arm.l1 * np.cos(q[0]) * w1 + arm.lc2 * np.cos(q[0] + q[1]) * w2
    translation = arm.m1 * (arm.lc1 * w1)**2 + arm.m2 * (vx**2 + vy**2)
    return 0.5 * (translation + arm.I1 * w1**2 + arm.I2 * w2**2)
e = np.eye(2)
"""
JACOBIANS = """
s1, s12, c1, c12 = np.sin(q[0]), np.sin(sum(q)), np.cos(q[0]), np.cos(sum(q))
J1 = np.array([[-arm.lc1 * s1, 0], [arm.lc1 * c1, 0]])
J2 = np.array([[-arm.l1 * s1 - arm.lc2 * s12, -arm.lc2 * s12],
               [arm.l1 * c1 + arm.lc2 * c12, arm.lc2 * c12]])
w1, w2 = np.array([[1, 0]]), np.array([[1, 1]])
"""
SYMBOLIC = """
a, b, c, d = sp.symbols("a b c d", real=True)
P1 = sp.Matrix([arm.lc1 * sp.cos(a), arm.lc1 * sp.sin(a)])
P2 = sp.Matrix([arm.l1 * sp.cos(a) + arm.lc2 * sp.cos(a + b),
                arm.l1 * sp.sin(a) + arm.lc2 * sp.sin(a + b)])
speed = lambda P: P.jacobian([a, b]) * sp.Matrix([c, d])
K = arm.m1 * speed(P1).dot(speed(P1)) / 2 + arm.m2 * speed(P2).dot(speed(P2)) / 2
K += arm.I1 * c**2 / 2 + arm.I2 * (c + d)**2 / 2
H = sp.hessian(K, (c, d))
"""
POSITIONS = """
def centres(q):
    elbow = arm.l1 * np.array([np.cos(q[0]), np.sin(q[0])])
    along = np.array([np.cos(q[0] + q[1]), np.sin(q[0] + q[1])])
    return np.concatenate([arm.lc1 / arm.l1 * elbow, elbow + arm.lc2 * along])
h = 1e-6
J = np.array([(centres(q + h * e) - centres(q - h * e)) / (2 * h) for e in np.eye(2)]).T
J = np.vstack([J, [[1, 0], [1, 1]]])
"""
PAIRS = "for J, I in zip(jacobians, inertias)"
SPD = "np.allclose(A, A.T)"
ARM = {"l1": 1.0, "l2": 0.8, "lc1": 0.0, "lc2": 0.4, "m1": 2, "m2": 3, "I1": 0, "I2": 0, "g": 9.81}

RIGHT = {
    "p1-inertia_from_links": [
        f"sum(J.T @ I @ J {PAIRS})",
        "np.einsum('kia,kij,kjb->ab', jacobians, inertias, jacobians)",
        "(jacobians.transpose(0, 2, 1) @ inertias @ jacobians).sum(axis=0)",
        f"sum(J.T @ I @ J {PAIRS}).tolist()",
        f"np.float32(sum(J.T @ I @ J {PAIRS}))",
        "J, I = np.float32(jacobians), np.float32(inertias)\n"
        "return np.sum([j.T @ i @ j for j, i in zip(J, I)], axis=0)",
        f"sum((np.linalg.cholesky(I).T @ J).T @ (np.linalg.cholesky(I).T @ J) {PAIRS})",
        "L, _, n = jacobians.shape\nM = np.zeros((n, n))\nfor k in range(L):\n"
        "    for i in range(n):\n        for j in range(n):\n"
        "            M[i, j] += jacobians[k][:, i] @ inertias[k] @ jacobians[k][:, j]\nreturn M",
        "import functools\nfrom operator import add\n"
        f"return functools.reduce(add, [J.T @ (I @ J) {PAIRS}])",
        "J = jacobians.reshape(-1, jacobians.shape[2])\nI = np.zeros((len(J), len(J)))\n"
        "for k, i in enumerate(inertias):\n    I[6 * k:6 * k + 6, 6 * k:6 * k + 6] = i\n"
        "return J.T @ I @ J",
        f"sp.Matrix(sum(J.T @ I @ J {PAIRS}))",
        f"M = sum(J.T @ I @ J {PAIRS})\nreturn M.item() if M.size == 1 else M",
    ],
    "p1-M": [
        CLOSED + "return np.array([[a + b + 2 * k, b + k], [b + k, b]])",
        CLOSED + "return [[a + b + 2 * k, b + k], [b + k, b]]",
        CLOSED + "return ((a + b + 2 * k, b + k), (b + k, b))",
        CLOSED + "return np.float32([[a + b + 2 * k, b + k], [b + k, b]])",
        CLOSED + "return sp.Matrix([[a + b + 2 * k, b + k], [b + k, b]])",
        CLOSED + "T = np.array([[1, 0], [1, 1]])\nreturn T.T @ np.array([[a, k], [k, b]]) @ T",
        ENERGY + "return [[K(a + b) - K(a) - K(b) for a in e] for b in e]",
        ENERGY
        + "h = 1e-3\nreturn [[(K(h * (a + b)) - K(h * (a - b)) - K(h * (b - a)) + K(-h * (a + b)))"
        " / (4 * h * h) for a in e] for b in e]",
        JACOBIANS + "return (arm.m1 * J1.T @ J1 + arm.m2 * J2.T @ J2 + arm.I1 * w1.T @ w1"
        " + arm.I2 * w2.T @ w2)",
        POSITIONS + "return J.T @ np.diag([arm.m1] * 2 + [arm.m2] * 2 + [arm.I1, arm.I2]) @ J",
        SYMBOLIC + "return sp.lambdify((a, b), H, 'numpy')(*q)",
        SYMBOLIC + "return H.subs({a: q[0], b: q[1]})",
    ],
    "p1-is_spd": [
        f"{SPD} and np.linalg.eigvalsh(A)[0] > 1e-9 * np.linalg.eigvalsh(A)[-1]",
        f"{SPD} and all(np.linalg.eigvalsh(A) > 1e-9)",
        f"bool({SPD} and np.all(np.linalg.eigvals(A) > 1e-8))",
        f"int({SPD} and np.linalg.eigvalsh(A).min() > 1e-10)",
        "np.abs(A - A.T).max() < 1e-12 * np.abs(A).max() and np.linalg.eigvalsh(A)[0] > 1e-12",
        f"if not {SPD}:\n    return False\ntry:\n"
        "    np.linalg.cholesky(A - 1e-9 * np.max(np.abs(A)) * np.eye(len(A)))\n"
        "except np.linalg.LinAlgError:\n    return False\nreturn True",
        f"{SPD} and all(np.linalg.det(A[:k, :k]) > 1e-9 for k in range(1, len(A) + 1))",
        f"np.array([{SPD} and np.linalg.eigvalsh(A)[0] > 1e-9])",
        f"float({SPD} and np.linalg.eigvalsh(A)[0] > 1e-6)",
        "values, vectors = np.linalg.eig((A + A.T) / 2)\n"
        "return np.linalg.norm(A - A.T) < 1e-6 and values.min() / values.max() > 1e-9"
        " and values.max() > 0",
        "A = np.round(A, 9)\n"
        "return bool((A == A.T).all() and (np.linalg.svd(A)[1] > 1e-8).all()"
        " and (np.linalg.eigvalsh(A) > 0).all())",
    ],
    "p1-singular_arm": [
        f"{ARM}, [0, np.pi]",
        f"{ARM}, (0.4, 0)",
        f"[{ARM}, np.array([0.4, -np.pi])]",
        f"{ARM}, np.array([[0.4], [2 * np.pi]])",
        f"{ARM}, np.float32([0.4, np.pi])",
        f"{ARM | {'lc2': 1.0}}, [0, sp.pi]",
        f"{ARM | {'lc2': 0, 'lc1': 0.5, 'I1': 0.3}}, [0.3, 1.0]",
        f"{ARM | {'lc2': 0.0, 'lc1': 0.0}}, (1, 2)",
        f"from types import SimpleNamespace\nreturn SimpleNamespace(**{ARM}), [0, np.pi]",
        f"{ {name: [value] for name, value in ARM.items()} }, [0, 3.14159265]",
        f"{ {name: value for name, value in ARM.items() if name != 'g'} }, [0, 0]",
    ],
}
CASES = [(check_id, body) for check_id, variants in RIGHT.items() for body in variants]


@pytest.mark.parametrize(("check_id", "body"), CASES)
def test_right_in_any_style(check_id, body):
    assert_right(judged(check_id, body, seed=1))


def test_ten_variants_each():
    assert RIGHT.keys() == {check.id for check in P1}
    assert all(len(variants) >= 10 for variants in RIGHT.values())


@A_THOUSAND
@pytest.mark.parametrize(
    ("check_id", "variants"),
    [("p1-inertia_from_links", (1, 5)), ("p1-M", (0, 3)), ("p1-is_spd", (0, 4))],
)
def test_no_false_alarm_over_a_thousand_seeds(check_id, variants, seeds):
    namespaces = [namespace_of(check_id, RIGHT[check_id][k]) for k in variants]
    for seed in seeds:
        verdict = judged_in(namespaces[seed % 2], check_id, seed, VISIBLE_CASES)
        assert verdict.state is State.CORRECT, (seed, str(verdict))


@pytest.mark.parametrize(
    ("check_id", "body"),
    [
        ("p1-inertia_from_links", f"1.0001 * sum(J.T @ I @ J {PAIRS})"),
        ("p1-M", CLOSED + "return [[(a + b + 2 * k) * 1.0001, b + k], [b + k, b]]"),
        ("p1-M", CLOSED + "return [[a + b + 2 * k, b + k], [(b + k) * 1.0001, b]]"),
        ("p1-M", CLOSED + "return [[a + b + 2 * k, b + k], [b + k, b * 1.0001]]"),
        ("p1-singular_arm", f"{ARM | {'I2': 1e-4}}, [0, np.pi]"),
        ("p1-singular_arm", f"{ARM | {'lc1': 1e-3}}, [0, np.pi]"),
        ("p1-singular_arm", f"{ARM}, [0, 3.14]"),
        ("p1-singular_arm", f"{ARM | {'lc2': 1e-9, 'I1': 1, 'l1': 2}}, [0, 1]"),
    ],
)
def test_nearly_right_is_wrong(check_id, body):
    for seed in range(20):
        assert judged(check_id, body, seed, VISIBLE_CASES).state is not State.CORRECT


def test_M_agrees_with_the_library():
    check = CHECKS["p1-M"]
    for call in check.calls(np.random.default_rng(3), 50):
        q, arm = call.args
        np.testing.assert_allclose(check.reference(q, arm), Planar2R(**vars(arm)).M(q), rtol=1e-13)


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
        M = Planar2R(**(ARM | zero)).M(np.array([0.2, q2]))
        singular = np.linalg.matrix_rank(M, tol=1e-9) < 2
        correct = judged("p1-singular_arm", f"{ARM | zero}, [0.2, {q2}]").state is State.CORRECT
        assert correct == singular


def test_the_criteria_of_is_spd_see_both_kinds():
    """Every criterion has matrices to accept and to refuse, so that no constant earns anything."""
    check = CHECKS["p1-is_spd"]
    calls = check.calls(np.random.default_rng(0), VISIBLE_CASES)
    assert len(calls) == len(MATRICES)
    right = check.quantities(calls, [np.array(float(check.reference(*c.args))) for c in calls])
    for k in range(len(check.criteria)):
        assert set(np.concatenate([np.ravel(parts[k]) for parts in right])) == {0.0, 1.0}


def test_wrong_submission_is_told_why():
    said = PROBLEM.graded("wrong").verdicts
    for check_id, name in (
        ("p1-inertia_from_links", "I not used"),
        ("p1-M", "wrong parameter / l2 / lc2"),
        ("p1-is_spd", "always True"),
        ("p1-singular_arm", "link 1 resists"),
    ):
        assert said[check_id].diagnosis == sentences(check_id, name)


def test_partly_right_submission():
    said = PROBLEM.graded("partly_right").verdicts
    credits = {name: round(verdict.credit, 12) for name, verdict in said.items()}
    assert credits == {
        "p1-inertia_from_links": 0.5,
        "p1-M": 0.75,
        "p1-is_spd": 0.5,
        "p1-singular_arm": 0.5,
    }
    assert said["p1-M"].diagnosis == sentences("p1-M", "dropped / the rotation of link 2 / M12")
