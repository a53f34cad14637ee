"""Mistakes about matrices that are or are not positive definite, and about an arm with such an M."""

import numpy as np

from autograder.judging.claims import Claim
from autograder.judging.diagnosis import Mistake
from autograder.problems.material import planar_2r
from autograder.problems.material.definiteness import ROUNDING, is_symmetric, least_eigenvalue
from autograder.problems.p1_inertia.mistakes import EXAMPLE


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
