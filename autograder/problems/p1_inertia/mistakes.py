"""Mistakes about the inertia matrix, and about matrices that are or are not positive definite."""

from types import SimpleNamespace

import numpy as np

from autograder.judging.claims import Claim
from autograder.judging.diagnosis import Mistake
from autograder.problems.material import planar_2r, sentences
from autograder.problems.material.definiteness import ROUNDING, is_symmetric, least_eigenvalue

# The arm that stands in the notebook, for those who write its numbers into a function.
EXAMPLE = SimpleNamespace(
    l1=0.45, l2=0.40, lc1=0.20, lc2=0.18, m1=2.4, m2=1.6, I1=0.045, I2=0.025, g=9.81
)


def _links(matrix):
    """A wrong model of Σ JᵀIJ from what it does to one link's J and I."""
    return lambda jacobians, inertias: sum(
        matrix(J, I) for J, I in zip(jacobians, inertias, strict=True)
    )


def _of(links):
    """The right model with some of the links only: none gives zeros."""
    return lambda jacobians, inertias: _right(jacobians[links], inertias[links])


def _right(jacobians, inertias):
    return np.einsum("lai,lab,lbj->ij", jacobians, inertias, jacobians)


def _without_coupling(I):
    apart = np.array(I)
    apart[:3, 3:] = apart[3:, :3] = 0
    return apart


HALF = "Your M is half the right one. There is a ½ in K = ½ q̇ᵀ M q̇: is it a part of M?"
HALVES_SWAPPED = [3, 4, 5, 0, 1, 2]

INERTIA_FROM_LINKS = (
    Mistake(
        "I not used",
        _links(lambda J, I: J.T @ J),
        "You do not use the spatial inertias: your matrix is right only where each of them is the "
        "identity. What stands between Jᵀ and J in the energy of one link?",
    ),
    Mistake(
        "only the diagonal of I",
        _links(lambda J, I: J.T @ np.diag(np.diag(I)) @ J),
        "You use only the diagonal of each spatial inertia. What do the other entries do when the "
        "centre of mass is not at the origin?",
    ),
    Mistake(
        "coupling of rotation and translation dropped",
        _links(lambda J, I: J.T @ _without_coupling(I) @ J),
        "You add the energy of rotation to the energy of translation, and nothing more. That is "
        "enough only about the centre of mass. Which blocks of I couple the two?",
    ),
    Mistake(
        "halves of J swapped",
        _links(lambda J, I: J[HALVES_SWAPPED].T @ I @ J[HALVES_SWAPPED]),
        "You swap the upper and the lower three rows of each Jacobian, but not those of its "
        "inertia. In what order do the rows come in both?",
    ),
    Mistake(
        "inverse of I",
        _links(lambda J, I: J.T @ np.linalg.inv(I) @ J),
        "You use the inverse of each spatial inertia. Which of the two, the inertia or its "
        "inverse, turns a velocity into a momentum?",
    ),
    Mistake("half", lambda jacobians, inertias: _right(jacobians, inertias) / 2, HALF),
    Mistake("last link only", _of(slice(-1, None)), sentences.LAST_LINK_ONLY),
    Mistake("first link only", _of(slice(0, 1)), sentences.FIRST_LINK_ONLY),
    Mistake("last link left out", _of(slice(None, -1)), sentences.LAST_LINK_LEFT_OUT),
    Mistake("first link left out", _of(slice(1, None)), sentences.FIRST_LINK_LEFT_OUT),
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
        "You add up the Jacobians and the inertias first, and multiply afterwards. Each link has "
        "its own velocity. Which can you add: the velocities of different bodies, or their "
        "energies?",
    ),
    Mistake(
        "diagonal of the matrix alone",
        lambda jacobians, inertias: np.diag(np.diag(_right(jacobians, inertias))),
        "Your matrix is diagonal. Does no joint feel the acceleration of another?",
    ),
    Mistake(
        "upper triangle of the matrix alone",
        lambda jacobians, inertias: np.triu(_right(jacobians, inertias)),
        "Your matrix is 0 below its diagonal. Which property does an inertia matrix have?",
    ),
    Mistake(
        "inverse for matrix",
        lambda jacobians, inertias: np.linalg.inv(_right(jacobians, inertias)),
        "You return the inverse of the matrix. Which of the two, M or M⁻¹, stands in K = ½ q̇ᵀ M q̇?",
    ),
)


ABSOLUTE = (
    "Your M belongs to an absolute second angle: its link 2 turns with q̇2 alone. Hold joint 2 "
    "still and move joint 1: does link 2 turn?"
)


def _at_distance(squared):
    """M with a wrong M11: that of a link 2 whose centre of mass is as far away as `squared` says."""

    def wrong(q, arm):
        M = planar_2r.M(q, arm)
        M[0, 0] = arm.I1 + arm.m1 * arm.lc1**2 + arm.I2 + arm.m2 * squared(q[1], arm.l1, arm.lc2)
        return M

    return wrong


COUPLED_TWICE = (
    "Your M11 has the inertia of the stretched arm, and the coupling on top of it. How far is the "
    "centre of mass of link 2 from the shoulder when the elbow is bent?"
)
COSINE_ON_A_SUM = (
    "In your M11, the cosine multiplies more than it should. How far is the centre of mass of link 2 "
    "from the shoulder when the elbow makes a right angle?"
)
ALONG_ONE_LINK = (
    "Your M11 counts only how far the centre of mass of link 2 is from the shoulder along one of the "
    "links. How far is it when the elbow makes a right angle?"
)
# What stands in M11 for the square of the distance from the shoulder to the centre of mass of link 2.
INERTIA = tuple(
    Mistake(name, _at_distance(squared), sentence)
    for name, squared, sentence in (
        (
            "square of the sum and twice the coupling",
            lambda q2, a, b: (a + b) ** 2 + 2 * a * b * np.cos(q2),
            COUPLED_TWICE,
        ),
        (
            "square of the sum and the coupling",
            lambda q2, a, b: (a + b) ** 2 + a * b * np.cos(q2),
            COUPLED_TWICE,
        ),
        (
            "cosine on the square of the sum",
            lambda q2, a, b: (a + b) ** 2 * np.cos(q2),
            COSINE_ON_A_SUM,
        ),
        (
            "cosine on the whole distance",
            lambda q2, a, b: (a**2 + b**2 + 2 * a * b) * np.cos(q2) ** 2,
            COSINE_ON_A_SUM,
        ),
        (
            "distance along link 1",
            lambda q2, a, b: (a + b * np.cos(q2)) ** 2,
            ALONG_ONE_LINK,
        ),
        (
            "distance along link 2",
            lambda q2, a, b: (a * np.cos(q2) + b) ** 2,
            ALONG_ONE_LINK,
        ),
    )
)

INERTIA_SAID = {
    "dropped / the rotation of link 2 / M12": (
        "Your M12 is right except that I2 is missing. Where does link 2's own rotation enter, if "
        "its angular velocity is made of both q̇1 and q̇2?"
    ),
    "dropped / the rotation of link 2 / M11": (
        "Your M11 is right except that I2 is missing. Hold joint 2 and move joint 1: which of the "
        "two links turn?"
    ),
    "dropped / the rotation of link 2": (
        "I2 is missing: in your M, link 2 moves but does not turn. What is its angular velocity?"
    ),
    "dropped / the rotation of link 1": (
        "I1 is missing. Link 1 turns about the shoulder: is all its energy in the motion of its "
        "centre of mass?"
    ),
    "dropped / the mass of link 2 at the elbow": (
        "A term is missing from your M11. Joint 1 carries the whole of link 2 around: how fast "
        "does the elbow move?"
    ),
    "dropped / the centre of mass of link 1 about the shoulder": (
        "I1 is the inertia of link 1 about its centre of mass, but the centre of mass moves as "
        "well. What must you add to M11 to get the inertia about the shoulder?"
    ),
    "dropped / the centre of mass of link 2 about the elbow": (
        "I2 is the inertia of link 2 about its centre of mass, but the centre of mass moves about "
        "the elbow as well. What must you add to get the inertia about the elbow?"
    ),
    "doubled / the centre of mass of link 1 about the shoulder": (
        "Your M11 counts the motion of link 1's centre of mass twice. Have you applied the "
        "parallel-axis theorem once too often?"
    ),
    "doubled / the centre of mass of link 2 about the elbow": (
        "Your M counts the motion of link 2's centre of mass about the elbow twice. Have you "
        "applied the parallel-axis theorem once too often?"
    ),
    "wrong parameter / the centre of mass of link 1 about the shoulder / l1 / lc1": (
        "You put m1 at the end of link 1. How far is link 1's centre of mass from the shoulder?"
    ),
    "wrong parameter / l2 / lc2": (
        "You put m2 at the hand. How far from the elbow is the centre of mass of link 2?"
    ),
    "wrong parameter / the coupling of the two links / l2 / lc2": (
        "You use ℓ2 in the coupling of the two links. At which point of link 2 does its mass act?"
    ),
    "wrong parameter / lc1 / l1": (
        "You hinge link 2 at the centre of mass of link 1. How far from the shoulder is the elbow?"
    ),
    "wrong parameter / the coupling of the two links / lc1 / l1": (
        "You use ℓc1 in the coupling of the two links. Which point of link 1 carries link 2?"
    ),
    "wrong parameter / the mass of link 2 at the elbow / lc1 / l1": (
        "Your M11 carries m2 at the distance ℓc1 from the shoulder. Which point of link 1 carries "
        "link 2?"
    ),
    "wrong parameter / the coupling of the two links / m1 / m2": (
        "You use m1 in the coupling of the two links. Which link has a speed that depends on both "
        "joints?"
    ),
    "wrong angle / the coupling of the two links / q1 / q2": (
        "Your M changes with q1. Turn the whole arm about the shoulder with the elbow locked: does "
        "its inertia change? Which angle sets its shape?"
    ),
    "wrong angle / the coupling of the two links / q1 + q2 / q2": (
        "Your coupling measures the angle of link 2 from the x axis. Which angle lies between the "
        "two links?"
    ),
    "sine for cosine / the coupling of the two links": (
        "Your coupling vanishes when the arm is stretched out. At which q2 is link 2 farthest "
        "from the shoulder, and what must the coupling be there?"
    ),
    "wrong sign / the coupling of the two links": (
        "Your coupling has the wrong sign: your arm resists most when it is folded. Which way "
        "does link 2 point at q2 = 0?"
    ),
    "wave lost / the coupling of the two links / q2": (
        "Your M is that of the stretched arm in every configuration. What changes when the elbow "
        "bends?"
    ),
    "radians converted / the coupling of the two links": sentences.RADIANS_CONVERTED,
    "angle in degrees / the coupling of the two links": sentences.IN_DEGREES,
    "halved / the coupling of the two links / M11": (
        "The coupling in your M11 is half of what it should be. Square the speed of link 2's centre "
        "of mass: how often does the mixed product occur?"
    ),
    "dropped / the coupling of the two links": (
        "Your M does not change with q2. When the elbow bends, mass comes nearer to the shoulder: "
        "which term should show it?"
    ),
    "dropped / the coupling of the two links / M11": (
        "Your M11 does not change with q2. When the elbow bends, mass comes nearer to the "
        "shoulder: which term of M11 should show it?"
    ),
    "dropped / the coupling of the two links / M12": (
        "Your M12 does not change with q2. Which term of the energy holds q̇1 q̇2 together with "
        "the angle between the links?"
    ),
    "doubled / the coupling of the two links / M12": (
        "The coupling in your M12 is twice what it should be. M12 and M21 share the mixed term of "
        "q̇ᵀ M q̇: what does that leave for each?"
    ),
    "velocity left out / qd2 / qd1 / in the energy": ABSOLUTE,
    "upper triangle alone": (
        "Your M21 is zero. The M of a kinetic energy is symmetric: what must M21 be?"
    ),
    "diagonal alone": (
        "Your M12 and M21 are zero, as if the joints did not feel each other. Accelerate joint 2 "
        "alone: does joint 1 need a torque to stay where it is?"
    ),
    "inverse": sentences.INVERSE_OF_M,
    "half of the whole": HALF,
    "numbers of the example": (
        "You always use the numbers of the example arm, whatever arm is given. Where do your "
        "masses and lengths come from?"
    ),
    "astray / the coupling of the two links / M22 / M12": (
        "Your M22 changes with q2. Hold joint 1 still and turn joint 2: does it matter how far "
        "the elbow is bent?"
    ),
    "absolute angle / q2 / q1 / in the energy": ABSOLUTE,
    "lower triangle alone": (
        "Your M12 is zero. The M of a kinetic energy is symmetric: what must M12 be?"
    ),
    "sign below the diagonal": (
        "Your M21 is −M12. The M of a kinetic energy is symmetric: what must M21 be?"
    ),
    "mixed terms not shared": (
        "Your M12 and M21 each hold the whole mixed term of q̇ᵀ M q̇. Multiply it out: how "
        "often does q̇1 q̇2 occur?"
    ),
    "mixed terms in one triangle": (
        "The energy of your M is right, but the whole mixed term sits in M12. How must M12 and "
        "M21 share it for M to be symmetric?"
    ),
    "joints exchanged": ("You swapped M11 and M22. Which joint carries both links?"),
}


def _symmetric_and(accepts):
    return lambda A: is_symmetric(A) and accepts(A)


def _all_positive(eigenvalues):
    return np.min(eigenvalues) > ROUNDING * np.max(np.abs(eigenvalues))


# What a criterion sees of one alone first, as later ones share it with these.
IS_SPD = (
    Mistake(
        "zero eigenvalue accepted",
        _symmetric_and(lambda A: least_eigenvalue(A) >= -ROUNDING),
        "You accept a matrix with an eigenvalue of zero, which is only semidefinite. Is there a "
        "velocity for which its energy vanishes?",
    ),
    Mistake(
        "rounding taken for a positive eigenvalue",
        _symmetric_and(lambda A: least_eigenvalue(A) > 0),
        "You accept a matrix whose smallest eigenvalue is 1e-15 of the largest. That is zero with "
        "a rounding error. What share of the largest must an eigenvalue exceed to count as "
        "positive?",
    ),
    Mistake(
        "exact symmetry",
        lambda A: np.array_equal(A, A.T) and least_eigenvalue(A) > ROUNDING,
        "You refuse matrices that differ from their transpose only in the last digit, as a "
        "product JᵀIJ may. How far apart can two numbers be and still be equal up to rounding?",
    ),
    Mistake(
        "symmetry alone",
        is_symmetric,
        "You accept every symmetric matrix that was tried. What tells a positive definite one from "
        "the others?",
    ),
    Mistake(
        "diagonal alone",
        _symmetric_and(lambda A: np.all(np.diag(A) > 0)),
        "You accept every symmetric matrix with a positive diagonal that was tried. The diagonal must "
        "be positive, but that is not enough: what if the other entries are larger?",
    ),
    Mistake(
        "determinant of a symmetric matrix",
        _symmetric_and(lambda A: np.linalg.det(A) > ROUNDING),
        "You accept symmetric matrices with two negative eigenvalues: their determinant is "
        "positive too. What else must be positive?",
    ),
    Mistake(
        "entries positive",
        _symmetric_and(lambda A: np.all(A > 0)),
        "You ask for positive entries. Can the entry that couples two joints be negative? What "
        "exactly must be positive?",
    ),
    Mistake(
        "one positive eigenvalue",
        _symmetric_and(lambda A: np.linalg.eigvalsh(A)[-1] > 0),
        "You accept a symmetric matrix as soon as one eigenvalue is positive. How many of them "
        "must be positive?",
    ),
    Mistake(
        "eigenvalues of one sign",
        _symmetric_and(lambda A: least_eigenvalue(A) > ROUNDING or least_eigenvalue(-A) > ROUNDING),
        "You accept matrices whose eigenvalues are all negative. What sign does a kinetic energy "
        "have?",
    ),
    Mistake(
        "one triangle read",
        # eigvalsh reads the lower triangle, as cholesky does, and raises nothing. What counts as zero
        # is another mistake, here and below.
        lambda A: _all_positive(np.linalg.eigvalsh(A)),
        "You accept matrices that are not symmetric: cholesky and eigvalsh read one triangle and "
        "never look at the other. What must you test before you call them?",
    ),
    Mistake(
        "eigenvalues of any matrix",
        lambda A: _all_positive(np.linalg.eigvals(A).real),
        "You accept matrices that are not symmetric, as long as their eigenvalues are positive. "
        "That is one half of the question. What is the other half?",
    ),
    Mistake(
        "symmetric part only",
        lambda A: least_eigenvalue(A) > ROUNDING,
        "You test the symmetric part of the matrix. xᵀ A x cannot tell that part from A: what "
        "must hold besides xᵀ A x > 0?",
    ),
    Mistake(
        "determinant alone",
        lambda A: np.linalg.det(A) > 0,
        "You ask only whether the determinant is positive. What sign does the product of two "
        "negative eigenvalues have?",
    ),
    Mistake(
        "answer reversed",
        lambda A: not (is_symmetric(A) and least_eigenvalue(A) > ROUNDING),
        "You swapped True and False. What should your function say of the identity?",
        claim=Claim.WHOLE,
    ),
    Mistake(
        "always True",
        lambda A: True,
        "Your function accepts every matrix that was tried. What should it say of −1 times the "
        "identity?",
        claim=Claim.WHOLE,
    ),
    Mistake(
        "always False",
        lambda A: False,
        "Your function refuses every matrix that was tried. What should it say of the identity?",
        claim=Claim.WHOLE,
    ),
)


def _answer(q2=np.pi, **parameters):
    """A wrong answer of singular_arm: point masses on an arm that is folded, but for what is given."""
    arm = planar_2r.changed(EXAMPLE, lc1=0.0, I1=0.0, I2=0.0)
    return lambda: (planar_2r.changed(arm, **parameters), (0.0, q2))


SINGULAR_ARM = (
    Mistake(
        "link 2 has a size",
        _answer(I2=0.1),
        "Your M is positive definite: I2 is not zero, so it takes energy to turn link 2. Which "
        "motion must cost no energy for M to be singular?",
    ),
    Mistake(
        "point masses in a bent arm",
        _answer(q2=np.pi / 2),
        "Your M is positive definite: these parameters would do, but not with the elbow bent like "
        "this. How must link 2 lie for both joints to move while its mass stays at rest? Remember "
        "that q is in radians.",
    ),
    Mistake(
        "link 1 resists",
        _answer(I1=0.1),
        "Your M is positive definite: with ℓc2 > 0, the mass of link 2 can stay at rest only "
        "while link 1 turns. Which parameters of link 1 must be zero for that to cost no energy?",
    ),
    Mistake(
        "point masses beside their joints",
        _answer(q2=np.pi / 2, I1=0.1),
        "Your M is positive definite, though link 2 is a point mass. That mass still moves "
        "whenever a joint does: where could it sit so that joint 2 cannot move it?",
    ),
    Mistake(
        "massless link",
        _answer(m2=0.0),
        "One of your links has no mass, but m1 and m2 must be positive here. Which other "
        "parameters may be zero?",
    ),
    Mistake(
        "link without length",
        _answer(l1=0.0),
        "One of your links has no length, but ℓ1 and ℓ2 must be positive here. Which other "
        "parameters may be zero?",
    ),
    Mistake(
        "negative parameter",
        _answer(l1=-0.45),
        "One of your parameters is negative, and none may be. Which of them may be zero?",
    ),
)
