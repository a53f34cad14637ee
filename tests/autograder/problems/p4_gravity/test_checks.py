"""p4-gravity: right answers in many styles pass at any seed, whole notebooks get what they earn, and
the references agree with armdyn."""

from types import SimpleNamespace

import numpy as np
import pytest

import armdyn.equilibria
from armdyn import Planar2R
from autograder.judging.check import HIDDEN_CASES, VISIBLE_CASES
from autograder.judging.verdict import State
from autograder.notebook.grade import grade, stream
from autograder.notebook.recognise import grade_id
from autograder.problems import CHECKS
from autograder.problems.material import sampling
from autograder.problems.p4_gravity import mistakes
from autograder.problems.p4_gravity.checks import CHECKS as P4
from tests.autograder.course_problems import problem, states
from tests.autograder.seeds import A_THOUSAND
from tests.autograder.verdicts import (
    assert_right,
    assert_told_apart,
    function_of,
    judged,
    judged_in,
    namespace_of,
    sentences,
)
from tests.submissions.answers import answered

PROBLEM = problem("p4-gravity")

HEIGHTS = (
    "s1, s12 = np.sin(q[0]), np.sin(q[0] + q[1])\n"
    "y1, y2 = arm.lc1 * s1, arm.l1 * s1 + arm.lc2 * s12\n"
)
P = f"{HEIGHTS}return arm.g * (arm.m1 * y1 + arm.m2 * y2)"
TORQUE = (
    "g2 = arm.m2 * arm.lc2 * arm.g * np.cos(q[0] + q[1])\n"
    "g1 = (arm.m1 * arm.lc1 + arm.m2 * arm.l1) * arm.g * np.cos(q[0]) + g2\n"
)
NESTED_P = "def P(q):\n" + "".join(f"    {line}\n" for line in P.splitlines())
SYMBOLIC = """
q1, q2 = sp.symbols("q1 q2")
y1 = arm.lc1 * sp.sin(q1)
y2 = arm.l1 * sp.sin(q1) + arm.lc2 * sp.sin(q1 + q2)
P = arm.g * (arm.m1 * y1 + arm.m2 * y2)
"""
JACOBIANS = """
s1, c1, s12, c12 = np.sin(q[0]), np.cos(q[0]), np.sin(q[0] + q[1]), np.cos(q[0] + q[1])
J1 = np.array([[-arm.lc1 * s1, 0], [arm.lc1 * c1, 0]])
J2 = np.array([[-arm.l1 * s1 - arm.lc2 * s12, -arm.lc2 * s12],
               [arm.l1 * c1 + arm.lc2 * c12, arm.lc2 * c12]])
down = np.array([0, -arm.g])
return -arm.m1 * J1.T @ down - arm.m2 * J2.T @ down
"""
COMPLEX_STEP = """
def P(q1, q2):
    y1 = arm.lc1 * np.sin(q1)
    y2 = arm.l1 * np.sin(q1) + arm.lc2 * np.sin(q1 + q2)
    return arm.g * (arm.m1 * y1 + arm.m2 * y2)

return P(q[0] + 1e-30j, q[1]).imag / 1e-30, P(q[0], q[1] + 1e-30j).imag / 1e-30
"""
ROOTS = f"""
def g(q):
    {TORQUE.replace(chr(10), chr(10) + "    ")}
    return [g1, g2]

found = []
for start in ((1.2, 0.3), (1.9, 2.9), (-1.2, -0.2), (-1.8, 3.3)):
    found.append(scipy.optimize.fsolve(g, start, xtol=1e-10))
return found
"""
RIGHT = {
    "p4-potential_energy": [
        P,
        f"{HEIGHTS}return [arm.g * (arm.m1 * y1 + arm.m2 * y2)]",
        f"{HEIGHTS}return np.float32(arm.g * (arm.m1 * y1 + arm.m2 * y2))",
        f"{HEIGHTS}return np.array([[arm.g * (arm.m1 * y1 + arm.m2 * y2)]])",
        f"{HEIGHTS}return arm.m1 * arm.g * (y1 + arm.lc1) + arm.m2 * arm.g * (y2 + arm.l1 + arm.lc2)",
        f"{HEIGHTS}return 1000 + arm.g * (arm.m1 * y1 + arm.m2 * y2)",
        f"{HEIGHTS}return np.dot([arm.m1, arm.m2], [y1, y2]) * arm.g",
        f"{HEIGHTS}down = np.array([0, -arm.g])\n"
        "return -sum(m * down @ p for m, p in ((arm.m1, [7, y1]), (arm.m2, [-3, y2])))",
        "z1 = np.exp(1j * q[0])\nz2 = arm.l1 * z1 + arm.lc2 * np.exp(1j * (q[0] + q[1]))\n"
        "return arm.g * (arm.m1 * arm.lc1 * z1 + arm.m2 * z2).imag",
        f"{SYMBOLIC}return P.subs({{q1: q[0], q2: q[1]}})",
        "return (arm.m1*arm.lc1 + arm.m2*arm.l1)*arm.g*np.cos(q[0] - np.pi/2) - 2*arm.m2*arm.lc2*"
        "arm.g*np.sin(np.pi/4 - (q[0] + q[1])/2)**2",
    ],
    "p4-g_vec": [
        f"{TORQUE}return np.array([g1, g2])",
        f"{TORQUE}return [g1, g2]",
        f"{TORQUE}return np.array([[g1], [g2]])",
        f"{TORQUE}return np.array([g1, g2], dtype=np.float32)",
        f"{TORQUE}return sp.Matrix([g1, g2])",
        JACOBIANS,
        COMPLEX_STEP,
        f"{SYMBOLIC}return [sp.diff(P, angle).subs({{q1: q[0], q2: q[1]}}) for angle in (q1, q2)]",
        f"{SYMBOLIC}g = sp.Matrix([P]).jacobian([q1, q2])\nreturn sp.lambdify((q1, q2), g)(*q)",
        f"{NESTED_P}return [(P(q + d) - P(q - d)) / 2e-6 for d in 1e-6 * np.eye(2)]",
        f"{NESTED_P}return [(P(q + d) - P(q)) / 1e-8 for d in 1e-8 * np.eye(2)]",
    ],
    "p4-gravity_from_jacobians": [
        "return -sum(m * Jv.T @ g0 for m, Jv in zip(masses, jacobians_v))",
        "return -np.einsum('l,lin,i->n', masses, jacobians_v, g0)",
        "return -np.tensordot(masses, jacobians_v, 1).T @ g0",
        "return -(masses @ (g0 @ jacobians_v))",
        "return -np.sum(masses[:, None] * (np.transpose(jacobians_v, (0, 2, 1)) @ g0), axis=0)",
        "return [float(-sum(masses * (jacobians_v[:, :, j] @ g0)))"
        " for j in range(jacobians_v.shape[2])]",
        "J, w = np.vstack(jacobians_v), np.kron(masses, g0)\nreturn -J.T @ w[:, None]",
        "J, m = np.float32(jacobians_v), np.float32(masses)\n"
        "return -np.einsum('l,lin,i->n', m, J, np.float32(g0))",
        "up = -g0\nreturn sum(m * up @ Jv for m, Jv in zip(masses, jacobians_v))",
        "def P(dq):\n    return -sum(m * g0 @ (Jv @ dq) for m, Jv in zip(masses, jacobians_v))\n"
        "return [P(e) for e in np.eye(jacobians_v.shape[2])]",
    ],
    "p4-equilibria": [
        "return np.array([[np.pi/2, 0], [-np.pi/2, 0], [np.pi/2, np.pi], [-np.pi/2, np.pi]])",
        "return [(a, b) for a in (np.pi/2, 3*np.pi/2) for b in (0, -np.pi)]",
        "return [[-np.pi/2, 3*np.pi], [np.pi/2, 2*np.pi], [5*np.pi/2, -np.pi], [-np.pi/2, -2*np.pi]]",
        "return [(a, d - a) for a in (1.5*np.pi, 0.5*np.pi) for d in (1.5*np.pi, 0.5*np.pi)]",
        "return np.float32([[np.pi/2, 0], [3*np.pi/2, 0], [np.pi/2, np.pi], [3*np.pi/2, np.pi]])",
        "return [(s * sp.pi/2, k * sp.pi) for s in (-1, 1) for k in (0, 1)]",
        "return np.reshape([np.pi/2, 0, -np.pi/2, 0, np.pi/2, np.pi, -np.pi/2, np.pi], (4, 2, 1))",
        "return [(np.arccos(s * 0.0) * s, np.arccos(k)) for s in (-1, 1) for k in (-1, 1)]",
        "return [(a, b) for a in (-np.pi/2, np.pi/2) for b in (-np.pi, 0, np.pi)]",
        ROOTS,
    ],
}  # fmt: skip
CASES = [(check_id, body) for check_id, variants in RIGHT.items() for body in variants]


def in_single_precision(body):
    *lines, last = body.splitlines()
    return "\n".join([*lines, f"return np.float32({last.removeprefix('return ')})"])


@pytest.mark.parametrize(("check_id", "body"), CASES)
def test_right_in_any_style(check_id, body):
    for seed in range(3):
        assert_right(judged(check_id, body, seed))


def test_ten_variants_at_least():
    assert all(len(variants) >= 10 for variants in RIGHT.values())


@A_THOUSAND
@pytest.mark.parametrize("check_id", RIGHT)
def test_no_false_alarm_over_a_thousand_seeds(check_id, seeds):
    """In single precision, which is the harder one, and every fifth seed in double."""
    double = namespace_of(check_id, RIGHT[check_id][0])
    single = namespace_of(check_id, in_single_precision(RIGHT[check_id][0]))
    for seed in seeds:
        for namespace in (single, double) if seed % 5 == 0 else (single,):
            verdict = judged_in(namespace, check_id, seed, VISIBLE_CASES)
            assert verdict.state is State.CORRECT, f"seed {seed}: {verdict}"


@pytest.mark.parametrize("check_id", RIGHT)
def test_wrong_by_1e_4_fails_at_any_seed(check_id):
    *lines, last = RIGHT[check_id][0].splitlines()
    body = "\n".join([*lines, f"return ({last.removeprefix('return ')}) * 1.0001"])
    for seed in range(20):
        assert judged(check_id, body, seed).credit == 0


def test_a_constant_of_each_arm_is_free_but_not_one_that_moves_with_q():
    free = f"{HEIGHTS}return arm.g * (arm.m1 * y1 + arm.m2 * y2) + np.exp(arm.l1 * arm.m2)"
    assert judged("p4-potential_energy", free).credit == 1
    for moves in ("np.sin(q[0]) ** 2", "np.cos(2 * q[1])", "(q[0] + q[1]) ** 3"):
        body = f"{HEIGHTS}return arm.g * (arm.m1 * y1 + arm.m2 * y2) + {moves}"
        verdict = judged("p4-potential_energy", body)
        assert verdict.credit < 1


@pytest.mark.parametrize("seed", range(20))
def test_references_agree_with_the_library(seed):
    """The checks' own references, against armdyn, at the checks' own cases."""
    checks = {check.name: check for check in P4}
    rng = np.random.default_rng(seed)
    for call in checks["g_vec"].calls(rng, 10):
        q, arm = call.args
        expected = Planar2R(**vars(arm)).g_vec(q)
        np.testing.assert_allclose(checks["g_vec"].reference(q, arm), expected, rtol=1e-12)
    calls = checks["potential_energy"].calls(rng, 10)
    changes = checks["potential_energy"].quantities(
        calls, [Planar2R(**vars(arm)).potential_energy(q) for q, arm in (c.args for c in calls)]
    )
    ours = checks["potential_energy"].quantities(
        calls, [np.array(checks["potential_energy"].reference(*call.args)) for call in calls]
    )
    np.testing.assert_allclose(ours, changes, rtol=1e-11)
    arm = sampling.planar_2r(rng)
    known = armdyn.equilibria.equilibria(Planar2R(**vars(arm)))
    call = checks["equilibria"].calls(rng, 6)[0]
    for found in checks["equilibria"].quantities([call], [np.array([one.q for one in known])])[0]:
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


def test_the_example_arm_is_the_one_that_the_mistakes_know(capsys):
    assert vars(PROBLEM.namespace()["robot"]) == vars(mistakes.EXAMPLE)
    assert "Write" not in capsys.readouterr().out  # the cells between the checks run


@pytest.mark.parametrize("check", P4, ids=lambda check: check.id)
def test_no_wrong_model_looks_like_another(check):
    for seed in range(3):
        assert_told_apart(check, seed)


def test_no_hint_gives_the_formula():
    for check in P4:
        assert not any(sign in hint for hint in check.hints for sign in ("cos(", "sin(", "*", "pi"))


def test_wrong_answers_are_named():
    graded = PROBLEM.graded("wrong")
    for check_id, name in (
        ("p4-potential_energy", "sign of the whole"),
        ("p4-g_vec", "wrong angle / the weight of link 2 beyond the elbow / q2 / q1 + q2"),
        ("p4-gravity_from_jacobians", "sign of gravity"),
        ("p4-equilibria", "from the vertical"),
    ):
        assert graded.verdicts[check_id].diagnosis == sentences(check_id, name)


def test_partly_right_answers_get_part_of_the_credit():
    verdicts = PROBLEM.graded("partly_right").verdicts
    assert {name: verdict.credit for name, verdict in verdicts.items()} == {
        "p4-potential_energy": 0.5,
        "p4-g_vec": 0.5,
        "p4-gravity_from_jacobians": 1.0,
        "p4-equilibria": 0.5,
    }


def test_a_crash_costs_its_own_cells_alone():
    verdicts = PROBLEM.graded("crashing").verdicts
    right = {name for name, verdict in verdicts.items() if verdict.state is State.CORRECT}
    assert right == {"p4-potential_energy", "p4-gravity_from_jacobians"}


def test_variants_pass_in_a_graded_notebook():
    """One of each check's other styles, through the room and its wall."""
    bodies = {
        "potential_energy": ("p4-potential_energy", 8),
        "g_vec": ("p4-g_vec", 8),
        "gravity_from_jacobians": ("p4-gravity_from_jacobians", 6),
        "equilibria": ("p4-equilibria", 9),
    }
    answers = {}
    for name, (check_id, k) in bodies.items():
        answers[name] = "import sympy as sp, scipy\n" + function_of(check_id, RIGHT[check_id][k])
    graded = grade(answered(PROBLEM.release, **answers), PROBLEM.source, "seed")
    assert set(states(graded).values()) == {State.CORRECT}


def test_the_visible_arms_do_not_decide():
    """The grader's arms are others than those of the visible check."""
    check = CHECKS["p4-g_vec"]
    seen = [call.args[1] for call in check.calls(np.random.default_rng(0), VISIBLE_CASES)]
    hidden = [call.args[1] for call in check.calls(stream("seed", check.id), HIDDEN_CASES)]
    assert all(isinstance(arm, SimpleNamespace) for arm in seen + hidden)
    assert not any(a.l1 == b.l1 for a in seen for b in hidden)


def test_grade_ids_stay():
    assert [grade_id(cell) for cell in PROBLEM.source.cells if grade_id(cell)] == [
        "p4-setup",
        "answer-potential_energy",
        "p4-potential_energy",
        "answer-g_vec",
        "p4-g_vec",
        "p4-slope",
        "answer-gravity_from_jacobians",
        "p4-gravity_from_jacobians",
        "p4-jacobians",
        "answer-equilibria",
        "p4-equilibria",
        "p4-energies",
        "p4-check",
    ]
