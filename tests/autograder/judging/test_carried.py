"""Errors carried on: what follows from an own wrong answer is said to, and counts as a course chose."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from autograder.judging.carried.judge import NOT_HERE, TOO_PLAIN, UNDECIDED, Carrying
from autograder.judging.check import HIDDEN_CASES, VISIBLE_CASES
from autograder.judging.verdict import State, Verdict
from autograder.problems import CHECKS, check_for
from autograder.protocol import answer_all
from tests.autograder.verdicts import function_of, namespace_of

# P with cosines for sines, and its gradient.
P = "-arm.g * ((arm.m1*arm.lc1 + arm.m2*arm.l1)*np.cos(q[0]) + arm.m2*arm.lc2*np.cos(q[0] + q[1]))"
GRADIENT = """
g2 = arm.g * arm.m2 * arm.lc2 * np.sin(q[0] + q[1])
return np.array([arm.g * (arm.m1*arm.lc1 + arm.m2*arm.l1) * np.sin(q[0]) + g2, g2])
"""
TWICE_M_DOT = "-2*arm.m2*arm.l1*arm.lc2*np.sin(q[1])*qd[1] * np.array([[2, 1], [1, 0]])"
TWICE = "h = -2*arm.m2*arm.l1*arm.lc2*np.sin(q[1])\n"
TWICE_C = TWICE + "return h * np.array([[qd[1], qd[0] + qd[1]], [-qd[0], 0]])"
TWICE_OTHER = TWICE + "return h * np.array([[0, 2*qd[0] + qd[1]], [-qd[0], 0]])"
I_AND_MORE = "np.array([[pend.I + pend.m*pend.lc**2]])"
EULER = "x + dt*f(x, u)"
RUN = """
x = [np.array(x0)]
for k in range(len(t) - 1):
    x.append(rk4_step(f, x[-1], u(t[k], x[-1]) if callable(u) else u, t[k + 1] - t[k]))
return np.array(x)
"""
Y = """
c1, c2, s2, c12 = np.cos(q[0]), np.cos(q[1]), np.sin(q[1]), np.cos(q[0] + q[1])
swing_1 = c2*(2*qdd[0] + qdd[1]) - s2*(2*qd[0]*qd[1] + qd[1]**2)
swing_2 = c2*qdd[0] + s2*qd[0]**2
return np.array([[0, arm.g*c1, qdd[0], arm.l1**2*qdd[0], arm.l1*swing_1 + arm.g*c12, 0],
                 [0, 0, 0, 0, arm.l1*swing_2 + arm.g*c12, 0]])
"""
STACKED = "W = np.vstack([regressor(*sample, arm) for sample in zip(q, qd, qdd)])\n"
RANK = STACKED + "return np.linalg.matrix_rank(W)"
FIT = STACKED + "return np.linalg.lstsq(W[:, [1, 2, 4, 5]], np.ravel(u))[0]"
Y_R = """
c1, c2, c12 = np.cos(q[0]), np.cos(q[1]), np.cos(q[0] + q[1])
spin = qdd_r[0] + qdd_r[1]
elbow = arm.l1**2*qdd_r[0] + arm.l1*arm.g*c1
return np.array([[0, arm.g*c1, qdd_r[0], elbow, arm.l1*c2*(2*qdd_r[0] + qdd_r[1]) + arm.g*c12, spin],
                 [0, 0, 0, 0, arm.l1*c2*qdd_r[0] + arm.g*c12, spin]])
"""
LAW = """
qd_r, qdd_r = ref.qd - gains.Lam @ (q - ref.q), ref.qdd - gains.Lam @ (qd - ref.qd)
s, Y = qd - qd_r, regressor_r(q, qd, qd_r, qdd_r, arm)
return np.concatenate([Y @ pi_hat - gains.KD @ s, -gains.Gamma @ Y.T @ s])
"""
FOUR = "[[0, 0], [0, np.pi], [np.pi, 0], [np.pi, np.pi]]"
WEIGHT = "pend.m*pend.g*pend.lc*np.sin(q)"
# The answer that follows, with the credit that half of the points leaves, and the earlier ones.
FOLLOWING = [
    ("p3-M", 0.5, {"p3-lagrangian": "m*lc**2*qd**2/2 + m*g*lc*sp.cos(q)"}, "pend.m*pend.lc**2"),
    ("p3-g_vec", 0.5, {"p3-lagrangian": "I*qd**2/2 + 2*m*g*lc*sp.cos(q)"}, f"2*{WEIGHT}"),
    (
        "p3-C",
        0.5,
        {"p3-M": "pend.I*(2 + np.cos(q[0]))"},
        "-pend.I*np.sin(q[0])*qd[0]/2",
    ),
    (
        "p3-small_angle_frequency",
        0.5,
        {"p3-M": I_AND_MORE, "p3-g_vec": WEIGHT},
        "np.sqrt(pend.m*pend.g*pend.lc/(pend.I + pend.m*pend.lc**2))",
    ),
    ("p4-g_vec", 0.5, {"p4-potential_energy": P}, GRADIENT),
    ("p4-equilibria", 0.5, {"p4-g_vec": GRADIENT}, FOUR),
    ("p2-C", 0.5, {"p2-M_dot": TWICE_M_DOT}, TWICE_C),
    ("p2-C_other", 0.5, {"p2-C": TWICE_C}, TWICE_OTHER),
    ("p5-simulate", 0.7, {"p5-rk4_step": EULER}, RUN),
    ("c6-rank_of_excitation", 0.5, {"c6-regressor": Y}, RANK),
    ("c6-identify", 0.5, {"c6-regressor": Y}, FIT),
    ("c8-slotine_li", None, {"c8-regressor_r": Y_R}, LAW),
]
IDS = [row[0] for row in FOLLOWING]


def verdict(
    id: str, body: str, earlier: dict[str, str], share: float | None = 0.5, count: int = HIDDEN_CASES,
    states: dict[str, State] | None = None, check=None,
) -> Verdict:  # fmt: skip
    namespace = namespace_of(id, body)
    for own, said in earlier.items():
        exec(function_of(own, said), namespace)
    carrying = Carrying(check_for, share, states)
    return (check or CHECKS[id]).run(
        lambda calls: answer_all(calls, namespace), np.random.default_rng(1), count, carrying
    )


def test_each_relation_has_a_row_here():
    assert {id for id, check in CHECKS.items() if check.follows} == set(IDS)


@pytest.mark.parametrize(("id", "credit", "earlier", "body"), FOLLOWING, ids=IDS)
def test_what_follows_from_a_wrong_answer_is_said_to(id, credit, earlier, body):
    alone = verdict(id, body, earlier, share=0.0)
    found = verdict(id, body, earlier)
    (follows,) = CHECKS[id].follows
    assert found.state is State.PARTLY_CORRECT
    assert found.diagnosis[0].startswith(follows.sentence), str(found)
    assert found.credit > alone.credit
    if credit:
        assert found.credit == pytest.approx(credit)
        assert len(found.diagnosis) == 1  # and nothing else is blamed
        assert found.next_step.startswith("Mend ")


GARBAGE = "np.array([arm.m1, arm.m2])"
ONE_LINK = "arm.m1*arm.g*arm.lc1*{}(q[0])"


@pytest.mark.parametrize(
    ("earlier", "body"),
    [
        ("0.0", "np.zeros(2)"),
        ("1e-9 * arm.g * np.sin(q[0])", "[1e-9 * arm.g * np.cos(q[0]), 0]"),
        ("q @ np.array([arm.m1, arm.m2])", GARBAGE),
        # A P that is made of g: a line's integral, of a g that is a gradient.
        ("0.5 * q @ g_vec(q, arm)", "arm.m1*arm.lc1*arm.g*arm.l1*q + arm.m2*arm.lc2*q"),
        # One that is right when it is judged, as often as the check asks.
        (
            "import sys\nsys.asked = getattr(sys, 'asked', 0) + 1\n"
            "return q @ np.array([arm.m1, arm.m2]) * (sys.asked > 1000)",
            GARBAGE,
        ),
    ],
    ids=["zero", "nearly zero", "linear", "calls back", "counts"],
)
def test_a_p_that_shows_nothing_earns_nothing(earlier, body):
    found = verdict("p4-g_vec", body, {"p4-potential_energy": earlier}, share=1.0)
    assert found.credit == 0
    assert "your own P" not in str(found)


def test_a_part_that_shows_nothing_earns_nothing_beside_one_that_does():
    earlier = {"p4-potential_energy": ONE_LINK.format("np.sin")}
    found = verdict("p4-g_vec", f"[{ONE_LINK.format('np.cos')}, 0]", earlier, share=1.0)
    assert found.credit == 0.5
    first, second = found.rows
    assert "100 %" in first.said[0]
    assert second.said[0].endswith(TOO_PLAIN)


def test_a_right_p_is_not_blamed():
    right = P.replace("-arm.g", "arm.g").replace("cos", "sin")
    found = verdict("p4-g_vec", GRADIENT, {"p4-potential_energy": right})
    assert "your own P" not in str(found)


def test_what_does_not_follow_is_not_said_to():
    found = verdict("p4-g_vec", "-" + GARBAGE, {"p4-potential_energy": P})
    assert "your own P" not in str(found)


@pytest.mark.parametrize("share", [0.0, 0.25, 1.0])
def test_the_share_is_the_courses_choice(share):
    found = verdict("p4-g_vec", GRADIENT, {"p4-potential_energy": P}, share)
    assert found.credit == share
    assert found.state is (State.PARTLY_CORRECT if share else State.INCORRECT)
    assert ("As an error carried on" in str(found)) is bool(share)


def test_a_student_reads_that_the_grader_decides():
    found = verdict("p4-g_vec", GRADIENT, {"p4-potential_energy": P}, None, VISIBLE_CASES)
    assert found.credit == 0
    assert found.diagnosis[0].endswith(UNDECIDED)


@pytest.mark.parametrize("state", [State.CORRECT, State.ERROR, State.NOT_ATTEMPTED, None])
def test_only_an_earlier_answer_that_was_judged_wrong_counts(state):
    states = {"p4-potential_energy": state} if state else {}
    found = verdict("p4-g_vec", GRADIENT, {"p4-potential_energy": P}, 1.0, states=states)
    assert found.credit == 0
    states = {"p4-potential_energy": State.INCORRECT}
    assert verdict("p4-g_vec", GRADIENT, {"p4-potential_energy": P}, 1.0, states=states).credit == 1


def test_slow_functions_are_not_carried_on():
    used = iter(range(0, 10_000, 5))
    namespace = namespace_of("p4-g_vec", GRADIENT)
    exec(function_of("p4-potential_energy", P), namespace)
    carrying = Carrying(check_for, 1.0, spent=lambda: next(used))
    found = CHECKS["p4-g_vec"].run(
        lambda calls: answer_all(calls, namespace), np.random.default_rng(1), 24, carrying
    )
    assert found.credit == 0


def test_a_package_without_formulas_leaves_it_to_the_grader():
    check = CHECKS["p4-g_vec"]
    stored = replace(check, follows=tuple(replace(own, way=None) for own in check.follows))
    found = verdict("p4-g_vec", GRADIENT, {"p4-potential_energy": P}, None, check=stored)
    assert found.remark == NOT_HERE.format("potential_energy", "is")
    assert found.credit == 0
    alone = verdict("p4-g_vec", GRADIENT, {}, None, check=stored)
    assert alone.remark == ""


def test_two_earlier_answers_are_wrong():
    check = CHECKS["p3-small_angle_frequency"]
    stored = replace(check, follows=tuple(replace(own, way=None) for own in check.follows))
    earlier = {"p3-M": "[[2 * pend.I]]", "p3-g_vec": "pend.m * pend.g * pend.lc * np.cos(q)"}
    point = "np.sqrt(pend.g / pend.lc)"
    found = verdict("p3-small_angle_frequency", point, earlier, None, check=stored)
    assert found.remark == NOT_HERE.format("M and g_vec", "are")


@pytest.mark.parametrize("answer", ["M_dot", "C", "g_vec", "f", "energy_drift", "lagrangian"])
def test_every_mechanism_says_what_follows_from_what(answer):
    """With one number of the arm wrong throughout, the first answers are wrong and the others follow."""
    mechanism = "cart-pole"
    namespace = {
        name: _of_a_heavier_arm(check_for(f"{mechanism}-{name}").reference)
        for name in ("M", "M_dot", "C", "g_vec", "potential_energy", "lagrangian", answer)
    }
    check = check_for(f"{mechanism}-{answer}")
    found = check.run(
        lambda calls: answer_all(calls, namespace),
        np.random.default_rng(1),
        12,
        Carrying(check_for, 1),
    )
    sentences = [own.sentence for own in check.follows]
    assert any(said.startswith(own) for said in found.diagnosis for own in sentences), str(found)


def _of_a_heavier_arm(model):
    def answer(*args):
        *state, arm = args
        name = next(name for name in vars(arm) if name.startswith("m"))
        name = "lc" if hasattr(arm, "lc") else name
        return model(*state, SimpleNamespace(**vars(arm) | {name: 1.3 * getattr(arm, name)}))

    return answer
