"""Mistakes about the inertia matrix, and about matrices that are or are not positive definite."""

from types import SimpleNamespace

import numpy as np

from autograder.problems.material import planar_2r
from autograder.problems.material.definiteness import ROUNDING, is_symmetric, least_eigenvalue
from autograder.judging.diagnosis import Mistake
from autograder.problems.material.planar_2r import changed

# The arm that stands in the notebook, for those who write its numbers into a function.
EXAMPLE = SimpleNamespace(
    l1=0.45, l2=0.40, lc1=0.20, lc2=0.18, m1=2.4, m2=1.6, I1=0.045, I2=0.025, g=9.81
)


def _links(matrix):
    """A wrong model of Σ JᵀIJ from what it does to one link's J and I."""
    return lambda jacobians, inertias: sum(
        matrix(J, I) for J, I in zip(jacobians, inertias, strict=True)
    )


def _right(jacobians, inertias):
    return _links(lambda J, I: J.T @ I @ J)(jacobians, inertias)


def _without_coupling(I):
    apart = np.array(I)
    apart[:3, 3:] = apart[3:, :3] = 0
    return apart


HALVES_SWAPPED = [3, 4, 5, 0, 1, 2]

INERTIA_FROM_LINKS = (
    Mistake(
        "I not used",
        _links(lambda J, I: J.T @ J),
        "The spatial inertias are not used: this is what comes out where each is the identity. What "
        "stands between Jᵀ and J in the energy of one link?",
    ),
    Mistake(
        "only the diagonal of I",
        _links(lambda J, I: J.T @ np.diag(np.diag(I)) @ J),
        "You use only the diagonal of each spatial inertia. What do the entries beside it do where "
        "the centre of mass is not at the origin?",
    ),
    Mistake(
        "coupling of rotation and translation dropped",
        _links(lambda J, I: J.T @ _without_coupling(I) @ J),
        "You add the energy of rotation and the energy of translation, each by itself. That is "
        "enough about the centre of mass only: which blocks of I couple the two?",
    ),
    Mistake(
        "halves of J swapped",
        _links(lambda J, I: J[HALVES_SWAPPED].T @ I @ J[HALVES_SWAPPED]),
        "The upper and the lower three rows of each Jacobian have changed places, but those of the "
        "inertia have not. In what order do the rows come in both?",
    ),
    Mistake(
        "inverse of I",
        _links(lambda J, I: J.T @ np.linalg.inv(I) @ J),
        "The inverse of each spatial inertia stands where the inertia belongs. Which of them turns "
        "a velocity into a momentum?",
    ),
    Mistake(
        "half",
        lambda jacobians, inertias: _right(jacobians, inertias) / 2,
        "Your matrix is half the right one. The ½ of K = ½ q̇ᵀ M q̇: does it belong to M?",
    ),
    Mistake(
        "last link only",
        lambda jacobians, inertias: jacobians[-1].T @ inertias[-1] @ jacobians[-1],
        "This is the last link alone. Does your loop add to what it has, or write over it?",
    ),
    Mistake(
        "first link only",
        lambda jacobians, inertias: jacobians[0].T @ inertias[0] @ jacobians[0],
        "This is the first link alone. Is the return inside the loop?",
    ),
    Mistake(
        "last link left out",
        lambda jacobians, inertias: (
            _right(jacobians[:-1], inertias[:-1])
            if len(jacobians) > 1
            else 0.0 * _right(jacobians, inertias)
        ),
        "The last link is left out. Where does your loop stop?",
    ),
    Mistake(
        "first link left out",
        lambda jacobians, inertias: (
            _right(jacobians[1:], inertias[1:])
            if len(jacobians) > 1
            else 0.0 * _right(jacobians, inertias)
        ),
        "The first link is left out. Where does your loop start?",
    ),
    Mistake(
        "mean for sum",
        lambda jacobians, inertias: _right(jacobians, inertias) / len(jacobians),
        "You divide by the number of links. Is the energy of the arm the mean of the links' "
        "energies, or their sum?",
    ),
    Mistake(
        "links added before they are multiplied",
        lambda jacobians, inertias: (
            np.sum(jacobians, 0).T @ np.sum(inertias, 0) @ np.sum(jacobians, 0)
        ),
        "You add up the Jacobians and the inertias first, and multiply then. Each link has its own "
        "velocity: what can be added, velocities of different bodies or energies?",
    ),
    Mistake(
        "inverse for matrix",
        lambda jacobians, inertias: np.linalg.inv(_right(jacobians, inertias)),
        "This is the inverse of the matrix that is asked for. Which of M and M⁻¹ stands in "
        "K = ½ q̇ᵀ M q̇?",
    ),
)


def _coupling(q, arm):
    return arm.m2 * arm.l1 * arm.lc2 * np.cos(q[1])


def _coupled_by(factor):
    """M of an arm whose two links are coupled by `factor(q, arm)` for cos q2."""
    return lambda q, arm: planar_2r.inertia(arm, arm.m2 * arm.l1 * arm.lc2 * factor(q, arm))


def _plus(M11=None, M12=None, M22=None):
    """M with something added to its entries, functions of q and arm; M12 stands for both."""

    def wrong(q, arm):
        m11, m12, m22 = (add(q, arm) if add else 0.0 for add in (M11, M12, M22))
        return planar_2r.M(q, arm) + np.array([[m11, m12], [m12, m22]])

    return wrong


def _plus_everywhere(add):
    """M with one more term in the inertia of link 2 about the elbow."""
    return _plus(add, add, add)


def _absolute(angle):
    """M of an arm whose second velocity is that of link 2 itself."""

    def wrong(q, arm):
        first = arm.I1 + arm.m1 * arm.lc1**2 + arm.m2 * arm.l1**2
        both = arm.m2 * arm.l1 * arm.lc2 * np.cos(angle(q))
        return np.array([[first, both], [both, arm.I2 + arm.m2 * arm.lc2**2]])

    return wrong


def _times(*factors):
    """M with its entries M11, M12, M21, M22 multiplied."""
    return lambda q, arm: planar_2r.M(q, arm) * np.reshape(factors, (2, 2))


ABSOLUTE = (
    "This is M for an absolute second angle: your link 2 turns with q̇2 alone. Hold joint 2 still "
    "and move joint 1: does link 2 turn?"
)

INERTIA = (
    Mistake(
        "I2 missing in M12",
        _plus(M12=lambda q, arm: -arm.I2),
        "Your M12 is right except that I2 is missing. Where does link 2's own rotation enter, if "
        "its angular velocity is made of both q̇1 and q̇2?",
    ),
    Mistake(
        "I2 missing in M11",
        _plus(M11=lambda q, arm: -arm.I2),
        "Your M11 is right except that I2 is missing. Joint 1 moves and joint 2 is held: which of "
        "the two bodies turn?",
    ),
    Mistake(
        "I2 missing",
        _plus_everywhere(lambda q, arm: -arm.I2),
        "I2 is missing: link 2 moves in your M, but does not turn. What is its angular velocity?",
    ),
    Mistake(
        "I1 left out",
        _plus(M11=lambda q, arm: -arm.I1),
        "I1 is missing. Link 1 turns about the shoulder: is the motion of its centre of mass all "
        "its energy?",
    ),
    Mistake(
        "mass of link 2 at the elbow left out",
        _plus(M11=lambda q, arm: -arm.m2 * arm.l1**2),
        "A term is missing in your M11: joint 1 carries all of link 2 around. How fast does the "
        "elbow move?",
    ),
    Mistake(
        "parallel axis missing for link 1",
        _plus(M11=lambda q, arm: -arm.m1 * arm.lc1**2),
        "I1 is about the centre of mass of link 1, and that moves as well. What is missing in M11 "
        "for link 1 to turn about the shoulder?",
    ),
    Mistake(
        "parallel axis missing for link 2",
        _plus_everywhere(lambda q, arm: -arm.m2 * arm.lc2**2),
        "I2 is about the centre of mass of link 2, and that moves about the elbow as well. What is "
        "missing for link 2 to turn about the elbow?",
    ),
    Mistake(
        "parallel axis doubled for link 1",
        _plus(M11=lambda q, arm: arm.m1 * arm.lc1**2),
        "The motion of link 1's centre of mass is in your M11 twice. Has the parallel-axis theorem "
        "been applied once too often?",
    ),
    Mistake(
        "parallel axis doubled for link 2",
        _plus_everywhere(lambda q, arm: arm.m2 * arm.lc2**2),
        "The motion of link 2's centre of mass about the elbow is in your M twice. Has the "
        "parallel-axis theorem been applied once too often?",
    ),
    Mistake(
        "l1 for lc1",
        _plus(M11=lambda q, arm: arm.m1 * (arm.l1**2 - arm.lc1**2)),
        "Your m1 sits at the end of link 1. How far from the shoulder is the centre of mass of link 1?",
    ),
    Mistake(
        "l2 for lc2",
        lambda q, arm: planar_2r.M(q, changed(arm, lc2=arm.l2)),
        "Your m2 sits at the hand. How far from the elbow is the centre of mass of link 2?",
    ),
    Mistake(
        "l2 for lc2 in the coupling",
        _coupled_by(lambda q, arm: arm.l2 / arm.lc2 * np.cos(q[1])),
        "In the coupling of the two links stands ℓ2. Which point of link 2 stands for its mass?",
    ),
    Mistake(
        "lc1 for l1",
        lambda q, arm: planar_2r.M(q, changed(arm, l1=arm.lc1)),
        "Your link 2 is hinged at the centre of mass of link 1. How far from the shoulder is the elbow?",
    ),
    Mistake(
        "lc1 for l1 in the coupling",
        _coupled_by(lambda q, arm: arm.lc1 / arm.l1 * np.cos(q[1])),
        "In the coupling of the two links stands ℓc1. Which point of link 1 carries link 2?",
    ),
    Mistake(
        "lc1 for l1 at the elbow",
        _plus(M11=lambda q, arm: arm.m2 * (arm.lc1**2 - arm.l1**2)),
        "In your M11, m2 is carried at the distance ℓc1 from the shoulder. Which point of link 1 "
        "carries link 2?",
    ),
    Mistake(
        "m1 in the coupling",
        _coupled_by(lambda q, arm: arm.m1 / arm.m2 * np.cos(q[1])),
        "In the coupling of the two links stands m1. Whose speed depends on both joints at once?",
    ),
    Mistake(
        "cos q1 for cos q2",
        _coupled_by(lambda q, arm: np.cos(q[0])),
        "Your M changes with q1. Turn the whole arm about the shoulder with the elbow locked: does "
        "its inertia change? Which angle sets its shape?",
    ),
    Mistake(
        "cos(q1 + q2) for cos q2",
        _coupled_by(lambda q, arm: np.cos(q[0] + q[1])),
        "Your coupling takes the angle of link 2 from the x axis. Which angle lies between the two "
        "links?",
    ),
    Mistake(
        "sin q2 for cos q2",
        _coupled_by(lambda q, arm: np.sin(q[1])),
        "Your coupling vanishes where the arm is stretched out. At which q2 is link 2 farthest from "
        "the shoulder, and what must the coupling be there?",
    ),
    Mistake(
        "sign of the coupling",
        _coupled_by(lambda q, arm: -np.cos(q[1])),
        "Your coupling has the wrong sign: your arm resists most where it is folded. Which way does "
        "link 2 point at q2 = 0?",
    ),
    Mistake(
        "coupling constant",
        _coupled_by(lambda q, arm: 1.0),
        "Your M is that of the stretched arm in every configuration. What changes when the elbow "
        "bends?",
    ),
    Mistake(
        "radians taken for degrees",
        _coupled_by(lambda q, arm: np.cos(np.radians(q[1]))),
        "The angle is turned from degrees to radians once too often: q comes in radians already.",
    ),
    Mistake(
        "angle in degrees",
        _coupled_by(lambda q, arm: np.cos(np.degrees(q[1]))),
        "The cosine is taken of an angle in degrees: NumPy's cosine wants radians, and q is in "
        "radians already.",
    ),
    Mistake(
        "coupling of M11 missing its factor",
        _plus(M11=lambda q, arm: -_coupling(q, arm)),
        "The coupling in your M11 is half of what it should be. Square the speed of link 2's centre "
        "of mass: how often does the mixed product occur?",
    ),
    Mistake(
        "coupling missing",
        lambda q, arm: planar_2r.inertia(arm, 0.0),
        "Your M does not change with q2. When the elbow bends, mass comes nearer to the shoulder: "
        "which term knows it?",
    ),
    Mistake(
        "coupling missing in M11",
        _plus(M11=lambda q, arm: -2 * _coupling(q, arm)),
        "Your M11 does not change with q2. When the elbow bends, mass comes nearer to the shoulder: "
        "which term of M11 knows it?",
    ),
    Mistake(
        "coupling missing in M12",
        _plus(M12=lambda q, arm: -_coupling(q, arm)),
        "Your M12 does not change with q2. Which product of q̇1 and q̇2 in the energy holds the "
        "angle between the links?",
    ),
    Mistake(
        "coupling doubled in M12",
        _plus(M12=_coupling),
        "The coupling in your M12 is twice what it should be. M12 and M21 share the mixed term of "
        "q̇ᵀ M q̇: what does that leave for each?",
    ),
    Mistake(
        "coupling in M22",
        _plus(M22=_coupling),
        "Your M22 changes with q2. Hold joint 1 still and turn joint 2: can link 2 feel how the "
        "elbow is bent?",
    ),
    Mistake("absolute second angle", _absolute(lambda q: q[1] - q[0]), ABSOLUTE),
    Mistake("absolute second velocity", _absolute(lambda q: q[1]), ABSOLUTE),
    Mistake(
        "M21 left zero",
        _times(1, 1, 0, 1),
        "Your M21 is zero. Only a symmetric M can be read off an energy: what must M21 be?",
    ),
    Mistake(
        "M12 left zero",
        _times(1, 0, 1, 1),
        "Your M12 is zero. Only a symmetric M can be read off an energy: what must M12 be?",
    ),
    Mistake(
        "M diagonal",
        _times(1, 0, 0, 1),
        "Your M12 and M21 are zero, as if the joints did not feel each other. Accelerate joint 2 "
        "alone: does joint 1 need a torque to stay where it is?",
    ),
    Mistake(
        "M21 of the other sign",
        _times(1, 1, -1, 1),
        "Your M21 is −M12. Only a symmetric M can be read off an energy: what must M21 be?",
    ),
    Mistake(
        "mixed term not shared",
        _times(1, 2, 2, 1),
        "Your M12 and M21 each hold the whole mixed term of q̇ᵀ M q̇. Multiply it out: how often "
        "does q̇1 q̇2 occur?",
    ),
    Mistake(
        "mixed term in M12 alone",
        _times(1, 2, 0, 1),
        "The energy of your M is right, but the whole mixed term sits in M12. How must M12 and M21 "
        "share it for M to be symmetric?",
    ),
    Mistake(
        "joints swapped",
        lambda q, arm: planar_2r.M(q, arm)[::-1, ::-1],
        "M11 and M22 have changed places. Which joint carries both links?",
    ),
    Mistake(
        "inverse for matrix",
        lambda q, arm: np.linalg.inv(planar_2r.M(q, arm)),
        "This is the inverse of M. Which of M and M⁻¹ multiplies q̈ in the equation of motion?",
    ),
    Mistake(
        "half",
        _times(0.5, 0.5, 0.5, 0.5),
        "Your M is half the right one. The ½ of K = ½ q̇ᵀ M q̇: does it belong to M?",
    ),
    Mistake(
        "example arm hard-coded",
        lambda q, arm: planar_2r.M(q, EXAMPLE),
        "These are the numbers of the example arm, whatever arm comes in. Where do you take the "
        "masses and lengths from?",
    ),
)


def _symmetric_and(accepts):
    return lambda A: is_symmetric(A) and accepts(A)


# What a criterion sees of one alone first, as later ones share it with these.
IS_SPD = (
    Mistake(
        "zero eigenvalue accepted",
        _symmetric_and(lambda A: least_eigenvalue(A) >= -ROUNDING),
        "You accept an eigenvalue of zero: that matrix is semidefinite. Is there a velocity for "
        "which its energy vanishes?",
    ),
    Mistake(
        "rounding taken for a positive eigenvalue",
        _symmetric_and(lambda A: least_eigenvalue(A) > 0),
        "You accept a matrix whose smallest eigenvalue is 1e-15 of the largest. That is a zero "
        "with a rounding error: above what share of the largest is a number positive?",
    ),
    Mistake(
        "exact symmetry",
        lambda A: np.array_equal(A, A.T) and least_eigenvalue(A) > ROUNDING,
        "You refuse matrices that differ from their transpose in the last digit alone, as a product "
        "JᵀIJ may. How far apart may two numbers be that are equal up to rounding?",
    ),
    Mistake(
        "symmetry alone",
        is_symmetric,
        "You accept every symmetric matrix. What tells a positive definite one from the others?",
    ),
    Mistake(
        "diagonal alone",
        _symmetric_and(lambda A: np.all(np.diag(A) > 0)),
        "You accept symmetric matrices whose diagonal is positive. It has to be, but that is not "
        "enough: what if the entries beside it are larger?",
    ),
    Mistake(
        "determinant of a symmetric matrix",
        _symmetric_and(lambda A: np.linalg.det(A) > 0),
        "You accept symmetric matrices with two negative eigenvalues: their determinant is positive "
        "too. What must be positive besides it?",
    ),
    Mistake(
        "entries positive",
        _symmetric_and(lambda A: np.all(A > 0)),
        "You ask for positive entries. May the product of inertia of two joints be negative, and "
        "what exactly must be positive?",
    ),
    Mistake(
        "one positive eigenvalue",
        _symmetric_and(lambda A: np.linalg.eigvalsh(A)[-1] > 0),
        "You accept matrices with one positive eigenvalue. How many of them must be positive?",
    ),
    Mistake(
        "eigenvalues of one sign",
        _symmetric_and(lambda A: abs(np.sum(np.sign(np.linalg.eigvalsh(A)))) == len(A)),
        "You accept matrices whose eigenvalues are all negative. Which sign has a kinetic energy?",
    ),
    Mistake(
        "one triangle read",
        # eigvalsh reads the lower triangle, as cholesky does, and raises nothing.
        lambda A: np.linalg.eigvalsh(A)[0] > 0,
        "You accept matrices that are not symmetric: cholesky and eigvalsh read one triangle and "
        "never look at the other. What must be asked before them?",
    ),
    Mistake(
        "eigenvalues of any matrix",
        lambda A: np.all(np.linalg.eigvals(A).real > 0),
        "You accept matrices that are not symmetric, as long as their eigenvalues are positive. "
        "Positive eigenvalues are one half of the question; what is the other?",
    ),
    Mistake(
        "symmetric part only",
        lambda A: np.linalg.eigvalsh((A + A.T) / 2)[0] > 0,
        "You judge the symmetric part of the matrix, which xᵀ A x cannot tell from A. What else is "
        "asked for besides xᵀ A x > 0?",
    ),
    Mistake(
        "determinant alone",
        lambda A: np.linalg.det(A) > 0,
        "Your answer is that of the determinant: positive or not. What is the sign of a product of "
        "two negative eigenvalues?",
    ),
    Mistake(
        "answer reversed",
        lambda A: not (is_symmetric(A) and least_eigenvalue(A) > ROUNDING),
        "Your True and False have changed places.",
    ),
    Mistake("always True", lambda A: True, "Your function accepts every matrix."),
    Mistake("always False", lambda A: False, "Your function refuses every matrix."),
)


def _answer(q2=np.pi, **parameters):
    """A wrong answer of singular_arm: point masses on an arm that is folded, but for what is given."""
    arm = changed(EXAMPLE, lc1=0.0, I1=0.0, I2=0.0)
    return lambda: (changed(arm, **parameters), (0.0, q2))


SINGULAR_ARM = (
    Mistake(
        "link 2 has a size",
        _answer(I2=0.1),
        "Your M is positive definite: I2 is not zero, so link 2 cannot turn without energy. Which "
        "motion must be free of energy for M to be singular?",
    ),
    Mistake(
        "point masses in a bent arm",
        _answer(q2=np.pi / 2),
        "Your M is positive definite: the parameters would do, but not at this q2. At which q2 can "
        "both joints move so that the mass of link 2 stays at rest? Mind that q is in radians.",
    ),
    Mistake(
        "link 1 resists",
        _answer(I1=0.1),
        "Your M is positive definite: with ℓc2 > 0, the mass of link 2 can stay at rest only while "
        "link 1 turns. What of link 1 must vanish for that to be free of energy?",
    ),
    Mistake(
        "point masses beside their joints",
        _answer(q2=np.pi / 2, I1=0.1),
        "Your M is positive definite, though link 2 is a point mass. It still moves whenever a joint "
        "does: where could its mass sit so that joint 2 cannot move it?",
    ),
    Mistake(
        "massless link",
        _answer(m2=0.0),
        "A link without mass is left out of the question: m1 and m2 must be positive. Which other "
        "parameters may vanish?",
    ),
    Mistake(
        "link without length",
        _answer(l1=0.0),
        "A link without length is left out of the question: ℓ1 and ℓ2 must be positive. Which other "
        "parameters may vanish?",
    ),
    Mistake(
        "negative parameter",
        _answer(l1=-0.45),
        "A parameter is negative. None of them may be: which can be zero?",
    ),
)
