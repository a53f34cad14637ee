"""Every mistake about the inertia matrix, as a student would type it: its sentence and its credit."""

import json
from pathlib import Path

import numpy as np
import pytest

from autograder.problems.material.definiteness import MATRICES, Kind, is_symmetric, least_eigenvalue
from autograder.judging.criterion import TOLERANCE
from autograder.problems.p1_inertia import mistakes as p1_inertia
from autograder.judging.verdict import State
from tests.autograder.verdicts import assert_named, judged, sentences_of

ROOT = Path(__file__).parents[4]

# The arm's inertias and its coupling, for bodies of a function that change one of them.
ARM = """
l1, l2, lc1, lc2 = arm.l1, arm.l2, arm.lc1, arm.lc2
m1, m2, I1, I2 = arm.m1, arm.m2, arm.I1, arm.I2
q1, q2 = q
c = m2 * l1 * lc2 * np.cos(q2)
M22 = I2 + m2 * lc2**2
M12 = M22 + c
M21 = M12
M11 = I1 + m1 * lc1**2 + M22 + m2 * l1**2 + 2 * c
"""
RESULT = "\nreturn [[M11, M12], [M21, M22]]"
LINKS = "sum(J.T @ I @ J for J, I in zip(jacobians, inertias))"


def arm(*changes: str, first: str = "") -> str:
    """The body of a right M with lines before the formulas, and lines after them."""
    formulas = ARM.replace("q1, q2 = q\n", f"q1, q2 = q\n{first}\n")
    return formulas + "\n".join(changes) + RESULT


def coupled(coupling: str) -> str:
    """The body of M with another coupling of the two links."""
    return arm(f"old, c = c, {coupling}", "M12 += c - old", "M21 = M12", "M11 += 2 * (c - old)")


ABSOLUTE = (
    "This is M for an absolute second angle: your link 2 turns with q̇2 alone. Hold joint 2 still "
    "and move joint 1: does link 2 turn?"
)

# check, the body that a student would write, the credit left, the sentences.
TABLE = [
    (
        "p1-inertia_from_links",
        "sum(J.T @ J for J in jacobians)",
        0,
        "The spatial inertias are not used: this is what comes out where each is the identity. What "
        "stands between Jᵀ and J in the energy of one link?",
    ),
    (
        "p1-inertia_from_links",
        "sum(J.T @ np.diag(np.diag(I)) @ J for J, I in zip(jacobians, inertias))",
        0,
        "You use only the diagonal of each spatial inertia. What do the entries beside it do where "
        "the centre of mass is not at the origin?",
    ),
    (
        "p1-inertia_from_links",
        "sum(J[:3].T @ I[:3, :3] @ J[:3] + J[3:].T @ I[3:, 3:] @ J[3:] "
        "for J, I in zip(jacobians, inertias))",
        0,
        "You add the energy of rotation and the energy of translation, each by itself. That is "
        "enough about the centre of mass only: which blocks of I couple the two?",
    ),
    (
        "p1-inertia_from_links",
        "J = np.concatenate([jacobians[:, 3:], jacobians[:, :3]], axis=1)\n"
        "return sum(j.T @ I @ j for j, I in zip(J, inertias))",
        0,
        "The upper and the lower three rows of each Jacobian have changed places, but those of the "
        "inertia have not. In what order do the rows come in both?",
    ),
    (
        "p1-inertia_from_links",
        "sum(J.T @ np.linalg.solve(I, J) for J, I in zip(jacobians, inertias))",
        0,
        "The inverse of each spatial inertia stands where the inertia belongs. Which of them turns "
        "a velocity into a momentum?",
    ),
    (
        "p1-inertia_from_links",
        f"0.5 * {LINKS}",
        0,
        "Your matrix is half the right one. The ½ of K = ½ q̇ᵀ M q̇: does it belong to M?",
    ),
    (
        "p1-inertia_from_links",
        "for J, I in zip(jacobians, inertias):\n    M = J.T @ I @ J\nreturn M",
        0.5,
        "This is the last link alone. Does your loop add to what it has, or write over it?",
    ),
    (
        "p1-inertia_from_links",
        "for J, I in zip(jacobians, inertias):\n    return J.T @ I @ J",
        0.5,
        "This is the first link alone. Is the return inside the loop?",
    ),
    (
        "p1-inertia_from_links",
        "M = np.zeros((jacobians.shape[2],) * 2)\nfor k in range(len(jacobians) - 1):\n"
        "    M += jacobians[k].T @ inertias[k] @ jacobians[k]\nreturn M",
        0,
        "The last link is left out. Where does your loop stop?",
    ),
    (
        "p1-inertia_from_links",
        "M = np.zeros((jacobians.shape[2],) * 2)\nfor k in range(1, len(jacobians)):\n"
        "    M += jacobians[k].T @ inertias[k] @ jacobians[k]\nreturn M",
        0,
        "The first link is left out. Where does your loop start?",
    ),
    (
        "p1-inertia_from_links",
        "np.mean([J.T @ I @ J for J, I in zip(jacobians, inertias)], axis=0)",
        0.5,
        "You divide by the number of links. Is the energy of the arm the mean of the links' "
        "energies, or their sum?",
    ),
    (
        "p1-inertia_from_links",
        "J, I = sum(jacobians), sum(inertias)\nreturn J.T @ I @ J",
        0.5,
        "You add up the Jacobians and the inertias first, and multiply then. Each link has its own "
        "velocity: what can be added, velocities of different bodies or energies?",
    ),
    (
        "p1-inertia_from_links",
        f"np.linalg.inv({LINKS})",
        0,
        "This is the inverse of the matrix that is asked for. Which of M and M⁻¹ stands in "
        "K = ½ q̇ᵀ M q̇?",
    ),
    (
        "p1-M",
        arm("M12 -= I2", "M21 -= I2"),
        0.75,
        "Your M12 is right except that I2 is missing. Where does link 2's own rotation enter, if "
        "its angular velocity is made of both q̇1 and q̇2?",
    ),
    (
        "p1-M",
        arm("M11 -= I2"),
        0.5,
        "Your M11 is right except that I2 is missing. Joint 1 moves and joint 2 is held: which of "
        "the two bodies turn?",
    ),
    (
        "p1-M",
        arm(first="I2 = 0"),
        0,
        "I2 is missing: link 2 moves in your M, but does not turn. What is its angular velocity?",
    ),
    (
        "p1-M",
        arm(first="I1 = 0"),
        0.5,
        "I1 is missing. Link 1 turns about the shoulder: is the motion of its centre of mass all "
        "its energy?",
    ),
    (
        "p1-M",
        arm("M11 -= m2 * l1**2"),
        0.5,
        "A term is missing in your M11: joint 1 carries all of link 2 around. How fast does the "
        "elbow move?",
    ),
    (
        "p1-M",
        arm("M11 -= m1 * lc1**2"),
        0.5,
        "I1 is about the centre of mass of link 1, and that moves as well. What is missing in M11 "
        "for link 1 to turn about the shoulder?",
    ),
    (
        "p1-M",
        arm("lost = m2 * lc2**2", "M11 -= lost", "M12 -= lost", "M21 -= lost", "M22 -= lost"),
        0,
        "I2 is about the centre of mass of link 2, and that moves about the elbow as well. What is "
        "missing for link 2 to turn about the elbow?",
    ),
    (
        "p1-M",
        arm("M11 += m1 * lc1**2"),
        0.5,
        "The motion of link 1's centre of mass is in your M11 twice. Has the parallel-axis theorem "
        "been applied once too often?",
    ),
    (
        "p1-M",
        arm(first="I2 = I2 + m2 * lc2**2"),
        0,
        "The motion of link 2's centre of mass about the elbow is in your M twice. Has the "
        "parallel-axis theorem been applied once too often?",
    ),
    (
        "p1-M",
        arm(first="lc1 = l1"),
        0.5,
        "Your m1 sits at the end of link 1. How far from the shoulder is the centre of mass of link 1?",
    ),
    (
        "p1-M",
        arm(first="lc2 = l2"),
        0,
        "Your m2 sits at the hand. How far from the elbow is the centre of mass of link 2?",
    ),
    (
        "p1-M",
        coupled("m2 * l1 * l2 * np.cos(q2)"),
        0.25,
        "In the coupling of the two links stands ℓ2. Which point of link 2 stands for its mass?",
    ),
    (
        "p1-M",
        arm(first="l1 = lc1"),
        0.25,
        "Your link 2 is hinged at the centre of mass of link 1. How far from the shoulder is the elbow?",
    ),
    (
        "p1-M",
        coupled("m2 * lc1 * lc2 * np.cos(q2)"),
        0.25,
        "In the coupling of the two links stands ℓc1. Which point of link 1 carries link 2?",
    ),
    (
        "p1-M",
        arm("M11 += m2 * (lc1**2 - l1**2)"),
        0.5,
        "In your M11, m2 is carried at the distance ℓc1 from the shoulder. Which point of link 1 "
        "carries link 2?",
    ),
    (
        "p1-M",
        coupled("m1 * l1 * lc2 * np.cos(q2)"),
        0.25,
        "In the coupling of the two links stands m1. Whose speed depends on both joints at once?",
    ),
    (
        "p1-M",
        coupled("m2 * l1 * lc2 * np.cos(q1)"),
        0.25,
        "Your M changes with q1. Turn the whole arm about the shoulder with the elbow locked: does "
        "its inertia change? Which angle sets its shape?",
    ),
    (
        "p1-M",
        coupled("m2 * l1 * lc2 * np.cos(q1 + q2)"),
        0.25,
        "Your coupling takes the angle of link 2 from the x axis. Which angle lies between the two "
        "links?",
    ),
    (
        "p1-M",
        coupled("m2 * l1 * lc2 * np.sin(q2)"),
        0.25,
        "Your coupling vanishes where the arm is stretched out. At which q2 is link 2 farthest from "
        "the shoulder, and what must the coupling be there?",
    ),
    (
        "p1-M",
        coupled("-c"),
        0.25,
        "Your coupling has the wrong sign: your arm resists most where it is folded. Which way does "
        "link 2 point at q2 = 0?",
    ),
    (
        "p1-M",
        coupled("m2 * l1 * lc2"),
        0.25,
        "Your M is that of the stretched arm in every configuration. What changes when the elbow "
        "bends?",
    ),
    (
        "p1-M",
        arm(first="q2 = np.deg2rad(q2)"),
        0.25,
        "The angle is turned from degrees to radians once too often: q comes in radians already.",
    ),
    (
        "p1-M",
        arm(first="q2 = np.rad2deg(q2)"),
        0.25,
        "The cosine is taken of an angle in degrees: NumPy's cosine wants radians, and q is in "
        "radians already.",
    ),
    (
        "p1-M",
        arm("M11 -= c"),
        0.5,
        "The coupling in your M11 is half of what it should be. Square the speed of link 2's centre "
        "of mass: how often does the mixed product occur?",
    ),
    (
        "p1-M",
        coupled("0"),
        0.25,
        "Your M does not change with q2. When the elbow bends, mass comes nearer to the shoulder: "
        "which term knows it?",
    ),
    (
        "p1-M",
        arm("M11 -= 2 * c"),
        0.5,
        "Your M11 does not change with q2. When the elbow bends, mass comes nearer to the shoulder: "
        "which term of M11 knows it?",
    ),
    (
        "p1-M",
        arm("M12 = M21 = M22"),
        0.75,
        "Your M12 does not change with q2. Which product of q̇1 and q̇2 in the energy holds the "
        "angle between the links?",
    ),
    (
        "p1-M",
        arm("M12 += c", "M21 += c"),
        0.75,
        "The coupling in your M12 is twice what it should be. M12 and M21 share the mixed term of "
        "q̇ᵀ M q̇: what does that leave for each?",
    ),
    (
        "p1-M",
        arm("M22 = M12"),
        0.75,
        "Your M22 changes with q2. Hold joint 1 still and turn joint 2: can link 2 feel how the "
        "elbow is bent?",
    ),
    (
        "p1-M",
        arm("M12 = M21 = m2 * l1 * lc2 * np.cos(q2 - q1)", "M11 -= M22 + 2 * c"),
        0.25,
        ABSOLUTE,
    ),
    ("p1-M", arm("M12 = M21 = c", "M11 -= M22 + 2 * c"), 0.25, ABSOLUTE),
    (
        "p1-M",
        arm("M21 = 0"),
        0.75,
        "Your M21 is zero. Only a symmetric M can be read off an energy: what must M21 be?",
    ),
    (
        "p1-M",
        arm("M12 = 0"),
        0.75,
        "Your M12 is zero. Only a symmetric M can be read off an energy: what must M12 be?",
    ),
    (
        "p1-M",
        arm("M12 = M21 = 0"),
        0.75,
        "Your M12 and M21 are zero, as if the joints did not feel each other. Accelerate joint 2 "
        "alone: does joint 1 need a torque to stay where it is?",
    ),
    (
        "p1-M",
        arm("M21 = -M12"),
        0.75,
        "Your M21 is −M12. Only a symmetric M can be read off an energy: what must M21 be?",
    ),
    (
        "p1-M",
        arm("M12 = M21 = 2 * M12"),
        0.75,
        "Your M12 and M21 each hold the whole mixed term of q̇ᵀ M q̇. Multiply it out: how often "
        "does q̇1 q̇2 occur?",
    ),
    (
        "p1-M",
        arm("M12 *= 2", "M21 = 0"),
        0.75,
        "The energy of your M is right, but the whole mixed term sits in M12. How must M12 and M21 "
        "share it for M to be symmetric?",
    ),
    (
        "p1-M",
        arm("M11, M22 = M22, M11"),
        0.25,
        "M11 and M22 have changed places. Which joint carries both links?",
    ),
    (
        "p1-M",
        arm("return np.linalg.inv([[M11, M12], [M21, M22]])"),
        0,
        "This is the inverse of M. Which of M and M⁻¹ multiplies q̈ in the equation of motion?",
    ),
    (
        "p1-M",
        arm("return np.array([[M11, M12], [M21, M22]]) / 2"),
        0,
        "Your M is half the right one. The ½ of K = ½ q̇ᵀ M q̇: does it belong to M?",
    ),
    (
        "p1-M",
        arm(first="l1, lc1, lc2, m1, m2, I1, I2 = 0.45, 0.20, 0.18, 2.4, 1.6, 0.045, 0.025"),
        0,
        "These are the numbers of the example arm, whatever arm comes in. Where do you take the "
        "masses and lengths from?",
    ),
    (
        "p1-is_spd",
        "try:\n    np.linalg.cholesky(A)\nexcept np.linalg.LinAlgError:\n    return False\nreturn True",
        0.5,
        "You accept matrices that are not symmetric: cholesky and eigvalsh read one triangle and "
        "never look at the other. What must be asked before them?",
    ),
    (
        "p1-is_spd",
        "np.all(np.linalg.eigvalsh(A) > 0)",
        0.5,
        "You accept matrices that are not symmetric: cholesky and eigvalsh read one triangle and "
        "never look at the other. What must be asked before them?",
    ),
    (
        "p1-is_spd",
        "np.all(np.linalg.eigvals(A) > 0)",
        0.5,
        "You accept matrices that are not symmetric, as long as their eigenvalues are positive. "
        "Positive eigenvalues are one half of the question; what is the other?",
    ),
    (
        "p1-is_spd",
        "np.linalg.eigvalsh((A + A.T) / 2).min() > 0",
        0.5,
        "You judge the symmetric part of the matrix, which xᵀ A x cannot tell from A. What else is "
        "asked for besides xᵀ A x > 0?",
    ),
    (
        "p1-is_spd",
        "np.linalg.det(A) > 0",
        0.2,
        "Your answer is that of the determinant: positive or not. What is the sign of a product of "
        "two negative eigenvalues?",
    ),
    (
        "p1-is_spd",
        "np.allclose(A, A.T) and np.linalg.det(A) > 1e-10",
        0.7,
        "You accept symmetric matrices with two negative eigenvalues: their determinant is positive "
        "too. What must be positive besides it?",
    ),
    (
        "p1-is_spd",
        "np.allclose(A, A.T) and np.linalg.eigvalsh(A)[0] > -1e-9",
        0.8,
        "You accept an eigenvalue of zero: that matrix is semidefinite. Is there a velocity for "
        "which its energy vanishes?",
    ),
    (
        "p1-is_spd",
        "np.allclose(A, A.T) and np.linalg.eigvalsh(A)[0] >= 0",
        0.8,
        "You accept an eigenvalue of zero: that matrix is semidefinite. Is there a velocity for "
        "which its energy vanishes?",
    ),
    (
        "p1-is_spd",
        "np.allclose(A, A.T) and np.linalg.eigvalsh(A)[0] > 0",
        0.8,
        "You accept a matrix whose smallest eigenvalue is 1e-15 of the largest. That is a zero "
        "with a rounding error: above what share of the largest is a number positive?",
    ),
    (
        "p1-is_spd",
        "np.all(A == A.T) and np.linalg.eigvalsh(A)[0] > 1e-9",
        0.8,
        "You refuse matrices that differ from their transpose in the last digit alone, as a product "
        "JᵀIJ may. How far apart may two numbers be that are equal up to rounding?",
    ),
    (
        "p1-is_spd",
        "np.allclose(A, A.T)",
        0.3,
        "You accept every symmetric matrix. What tells a positive definite one from the others?",
    ),
    (
        "p1-is_spd",
        "np.allclose(A, A.T) and np.diag(A).min() > 0",
        0.5,
        "You accept symmetric matrices whose diagonal is positive. It has to be, but that is not "
        "enough: what if the entries beside it are larger?",
    ),
    (
        "p1-is_spd",
        "np.allclose(A, A.T) and A.min() > 0",
        0,
        "You ask for positive entries. May the product of inertia of two joints be negative, and "
        "what exactly must be positive?",
    ),
    (
        "p1-is_spd",
        "np.allclose(A, A.T) and any(np.linalg.eigvalsh(A) > 0)",
        0.3,
        "You accept matrices with one positive eigenvalue. How many of them must be positive?",
    ),
    (
        "p1-is_spd",
        "values = np.linalg.eigvalsh(A)\n"
        "return np.allclose(A, A.T) and (all(values > 1e-9) or all(values < -1e-9))",
        0.7,
        "You accept matrices whose eigenvalues are all negative. Which sign has a kinetic energy?",
    ),
    (
        "p1-is_spd",
        "not (np.allclose(A, A.T) and np.linalg.eigvalsh(A)[0] > 1e-9)",
        0,
        "Your True and False have changed places.",
    ),
    ("p1-is_spd", "True", 0, "Your function accepts every matrix."),
    ("p1-is_spd", "False", 0, "Your function refuses every matrix."),
]

BASE = {"l1": 1.0, "l2": 0.8, "lc1": 0.0, "lc2": 0.4, "m1": 2, "m2": 3, "I1": 0, "I2": 0, "g": 9.81}
SINGULAR = [
    (
        {"lc1": 0.5, "I1": 0.1, "I2": 0.05},
        [0, np.pi],
        0,
        "Your M is positive definite: I2 is not zero, so link 2 cannot turn without energy. Which "
        "motion must be free of energy for M to be singular?",
    ),
    (
        {},
        [0, 180],
        0,
        "Your M is positive definite: the parameters would do, but not at this q2. At which q2 can "
        "both joints move so that the mass of link 2 stays at rest? Mind that q is in radians.",
    ),
    (
        {"lc1": 0.5},
        [1.0, 0.0],
        0,
        "Your M is positive definite: with ℓc2 > 0, the mass of link 2 can stay at rest only while "
        "link 1 turns. What of link 1 must vanish for that to be free of energy?",
    ),
    (
        {"lc1": 0.5},
        [1.0, 1.0],
        0,
        "Your M is positive definite, though link 2 is a point mass. It still moves whenever a joint "
        "does: where could its mass sit so that joint 2 cannot move it?",
    ),
    (
        {"m2": 0.0},
        [0, 0.3],
        0.5,
        "A link without mass is left out of the question: m1 and m2 must be positive. Which other "
        "parameters may vanish?",
    ),
    (
        {"l1": 0.0},
        [0, 0.3],
        0.5,
        "A link without length is left out of the question: ℓ1 and ℓ2 must be positive. Which other "
        "parameters may vanish?",
    ),
    (
        {"lc2": -0.4},
        [0, 0],
        0.5,
        "A parameter is negative. None of them may be: which can be zero?",
    ),
]


@pytest.mark.parametrize(("check_id", "body", "credit", "sentence"), TABLE)
def test_sentence_credit_and_witness(check_id, body, credit, sentence):
    if check_id != "p1-is_spd":
        assert_named(check_id, body, credit, sentence)
        return
    verdict = judged(check_id, body)
    assert verdict.diagnosis == (sentence,)
    assert verdict.credit == pytest.approx(credit)
    assert verdict.witness.call.startswith("is_spd([[")
    assert verdict.witness.returned.startswith(("True, where False is", "False, where True is"))


def test_worst_case_of_a_truth_value():
    verdict = judged("p1-is_spd", "True")
    asked = "(positive definite told from indefinite)"
    shown = " ".join(str(verdict).split())
    assert f"gave True, where False is right {asked}. Change" in shown
    shown = " ".join(str(verdict.without_inputs()).split())
    assert f"Worst case: your function gave True, where False is right {asked}." in shown


@pytest.mark.parametrize(("parameters", "q", "credit", "sentence"), SINGULAR)
def test_arm_that_does_not_do(parameters, q, credit, sentence):
    verdict = judged("p1-singular_arm", f"{BASE | parameters}, {q}")
    assert verdict.diagnosis == (sentence,)
    assert verdict.credit == credit


def test_every_mistake_has_its_row():
    said = {sentence for *_, sentence in [*TABLE, *SINGULAR]}
    assert sentences_of(p1_inertia) == said


def test_the_example_arm_is_that_of_the_notebook():
    path = ROOT / "solutions" / "p1-inertia" / "p1-inertia.ipynb"
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    setup = next("".join(cell["source"]) for cell in cells if cell["id"] == "p1-setup")
    namespace = {}
    exec(setup, namespace)
    assert namespace["cutter"] == p1_inertia.EXAMPLE


@pytest.mark.parametrize(
    ("body", "first", "second"),
    [
        (arm("M12 -= I2", "M21 -= I2", first="I1 = 0"), "I1 is missing", "except that I2"),
        (arm("M11 -= I1 + m1 * lc1**2"), "I1 is missing", "What is missing in M11 for link 1"),
        (arm("M11 -= c", "M21 = 0"), "is half of what", "Your M21 is zero"),
    ],
)
def test_two_mistakes_are_both_named(body, first, second):
    said = judged("p1-M", body).diagnosis
    assert len(said) == 2
    assert first in said[0]
    assert second in said[1]


def test_two_mistakes_of_is_spd_are_told_apart():
    verdict = judged("p1-is_spd", "np.all(A == A.T) and np.linalg.eigvalsh(A)[0] > 0")
    assert verdict.credit == pytest.approx(0.6)
    assert len(verdict.diagnosis) == 2
    assert "1e-15 of the largest" in verdict.diagnosis[0]
    assert "last digit alone" in verdict.diagnosis[1]


def test_two_mistakes_in_the_arm_are_both_named():
    verdict = judged("p1-singular_arm", f"{BASE | {'m1': 0, 'lc2': -0.4}}, [0, 0]")
    assert len(verdict.diagnosis) == 2


@pytest.mark.parametrize(
    ("check_id", "body", "said"),
    [
        (
            "p1-M",
            arm("M11 -= 0.1 * m1 * lc1**2"),
            "The error in your M11 varies like the centre of mass of link 1 (-0.1 times it).",
        ),
        (
            "p1-M",
            arm("M12 += 0.5 * c", "M21 += 0.5 * c"),
            "The error in your M12 and M21 varies like the coupling of the two links "
            "(+0.5 times it).",
        ),
        (
            "p1-M",
            arm("M22 += I2"),
            "The error in your M22 varies like the rotation of link 2 (+1 times it).",
        ),
        (
            "p1-inertia_from_links",
            "sum(J.T @ I @ J + 0.5 * J[3:].T @ I[3:, 3:] @ J[3:] for J, I in zip(jacobians, inertias))"
            " if len(jacobians) > 1 else jacobians[0].T @ inertias[0] @ jacobians[0]",
            "The error in your matrix of several links varies like the translation of the links "
            "(+0.5 times it).",
        ),
    ],
)
@pytest.mark.parametrize("count", [6, 24])
def test_unknown_error_is_placed_in_its_term(check_id, body, said, count):
    verdict = judged(check_id, body, count=count)
    assert verdict.diagnosis == (said,)


@pytest.mark.parametrize(
    ("check_id", "body"),
    [
        ("p1-M", arm("M11 += np.sin(q1)")),
        ("p1-M", arm("M11 += np.cos(q2)")),
        ("p1-M", arm("M22 *= 1 + 0.3 * np.sin(q2)")),
        ("p1-inertia_from_links", f"{LINKS} + 1"),
    ],
)
def test_unknown_error_is_not_diagnosed(check_id, body):
    for seed in range(20):
        verdict = judged(check_id, body, seed=seed, count=6)
        assert verdict.state is not State.CORRECT
        assert verdict.diagnosis == ()


def test_entries_that_differ_without_a_known_reason_are_compared():
    assert judged("p1-M", arm("M21 += np.sin(q1)")).diagnosis == (
        "M12 and M21 are judged together: are they the same in your matrix?",
    )


def test_mistake_is_named_only_where_it_matches_to_rounding():
    close = arm(f"M11 -= I1 * (1 + {200 * TOLERANCE})")
    assert "I1 is missing" not in judged("p1-M", close).diagnosis[0]
    single = arm("M11 -= I1", "return np.float32([[M11, M12], [M21, M22]])")
    assert "I1 is missing" in judged("p1-M", single).diagnosis[0]


def test_shapes_that_do_not_multiply_say_where():
    verdict = judged("p1-inertia_from_links", LINKS.replace("J.T @ I @ J", "J @ I @ J.T"))
    assert verdict.state is State.ERROR
    assert "matmul" in verdict.problem


@pytest.mark.parametrize(
    ("check_id", "returned", "problem"),
    [
        ("p1-inertia_from_links", "np.zeros((6, 6))", "shape (3, 3) is asked for"),
        ("p1-M", "arm.I1", "shape (2, 2) is asked for"),
        ("p1-is_spd", "np.linalg.eigvalsh(A)[0] * 0 + 0.7", "0.7; True or False is asked for"),
        ("p1-is_spd", "np.linalg.eigvalsh(A) > 0", "one number is asked for"),
        ("p1-singular_arm", "np.zeros(9)", "(arm, q) is asked for, arm a dict"),
        ("p1-singular_arm", "{'l1': 1.0}, [0, 0]", "an arm without l2, lc1, lc2, m1, m2, I1, I2"),
        ("p1-singular_arm", f"{BASE}, 0", "a q that is not two angles"),
        (
            "p1-singular_arm",
            f"{BASE | {'I1': [0, 0]}}, [0, 0]",
            "an arm whose I1 is not one number",
        ),
    ],
)
def test_answers_of_the_wrong_kind(check_id, returned, problem):
    verdict = judged(check_id, returned)
    assert verdict.state is State.ERROR
    assert problem in verdict.problem


def test_no_answer_that_is_always_the_same_earns_anything():
    for returned in ("True", "False"):
        assert judged("p1-is_spd", returned).credit == 0


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
