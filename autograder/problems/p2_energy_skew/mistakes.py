"""Mistakes about Ṁ, the Coriolis matrix C and its Christoffel form.

Those of the 2R arm follow from it; here stand their sentences. Those of the Christoffel form are sums
over D[i, j, k] = ∂M_ij/∂q_k, for any n.
"""

import numpy as np

from autograder.judging.at_points import AtPoints
from autograder.judging.diagnosis import Mistake
from autograder.judging.terms import Term
from autograder.problems.material import planar_2r as right
from autograder.problems.material import sentences
from autograder.protocol import Expressions, numbers_at

# How the coupling m2 ℓ1 ℓc2 cos q2 enters M.
PATTERN = np.array([[2.0, 1.0], [1.0, 0.0]])


def christoffel(D, first=0.5, second=0.5, third=-0.5) -> np.ndarray:
    """h_ijk with the numbers given in front of ∂M_ij/∂q_k, ∂M_ik/∂q_j and ∂M_jk/∂q_i."""
    return first * D + second * np.einsum("ikj->ijk", D) + third * np.einsum("jki->ijk", D)


def coriolis(D, qd, **numbers) -> np.ndarray:
    """C_ij = Σ_k h_ijk q̇_k."""
    return christoffel(D, **numbers) @ qd


# Of an arm that somebody took for this one: {0} is the matrix that is asked for.
WRONG_ARMS = {
    "cosine for sine / the coupling of the two links": (
        "Your {0} varies with cos q2. M itself varies with cos q2: how does its derivative vary?"
    ),
    "cosine for sine / the coupling of the two links / −": (
        "Your {0} varies with cos q2, as if M held sin q2. When is the arm hardest to turn: "
        "stretched out (q2 = 0), or with its elbow at a right angle?"
    ),
    "wrong parameter / the coupling of the two links / l2 / lc2": (
        "You use the whole length ℓ2 of link 2. How far from joint 2 is its centre of mass?"
    ),
    "wrong parameter / the coupling of the two links / lc1 / l1": (
        "You use the distance ℓc1 where the length of link 1 belongs. How far from joint 1 is the "
        "joint that carries link 2?"
    ),
    "wrong parameter / the coupling of the two links / m1 / m2": (
        "You use the mass m1. Which link's mass comes nearer to joint 1 when the elbow folds?"
    ),
    "wrong angle / the coupling of the two links / q1 + q2 / q2 / in M": (
        "Your {0} varies with q1 + q2. M can change only with the angle between the links: which "
        "coordinate is that?"
    ),
    "wrong angle / the coupling of the two links / q1 − q2 / q2 / in M": (
        "Your {0} varies with q2 − q1, as if q2 were measured from the x axis. From where is q2 "
        "measured here?"
    ),
    "wrong angle / the coupling of the two links / q1 / q2 / in M": (
        "Your {0} varies with q1. Turning the whole arm about joint 1 does not change its shape: "
        "which angle does?"
    ),
    "radians converted / the coupling of the two links": sentences.RADIANS_CONVERTED,
    "halved / the coupling of the two links / *11*": (
        "Your {0} comes from an M11 whose coupling is half of what it should be. Square the "
        "velocity of link 2's centre of mass again: how often does the mixed product appear?"
    ),
    "astray / the coupling of the two links / *22 / *12*": (
        "Your {0} comes from an M22 that changes with q2. With joint 1 locked, link 2 turns about "
        "joint 2: does its inertia about that joint change?"
    ),
}


def _of_wrong_arms(matrix: str) -> dict[str, str]:
    return {row: sentence.format(matrix) for row, sentence in WRONG_ARMS.items()}


M_DOT_SAID = _of_wrong_arms("Ṁ") | {
    "sign of the whole": (
        "Your Ṁ has the wrong sign. When the elbow folds from q2 = 0, does M11 grow or shrink?"
    ),
    "velocities exchanged": (
        "You multiply ∂M/∂q2 by q̇1. In the chain rule, which velocity goes with the derivative "
        "with respect to q2?"
    ),
    "sum of the velocities": (
        "You multiply ∂M/∂q2 by q̇1 + q̇2. In the chain rule each derivative has its own "
        "velocity: which one belongs to q2?"
    ),
    "chain rule forgotten": (
        "You return the derivative with respect to q2, in kg·m²/rad. Ṁ is the derivative with "
        "respect to time: what does the chain rule add?"
    ),
    "zero": (
        "Your Ṁ is zero. It is true that M does not change with q1. What else in M changes with "
        "time?"
    ),
    "twice C": (
        "You return 2C. q̇ᵀ(2C)q̇ is the same as q̇ᵀṀq̇, but the two matrices differ: compare "
        "them entry by entry."
    ),
    "M": ("You return M itself. How fast does M change?"),
    "constants differentiated": (
        "You multiply M by a velocity, where its derivative belongs. What is the derivative of "
        "the constant parts of M?"
    ),
    "C": (
        "You return C. It is made of the same derivatives as Ṁ, but M is symmetric: can its "
        "derivative be anything else?"
    ),
    "half of the whole": (
        "Your Ṁ is half the right one. There is a ½ in the kinetic energy: is it a part of M?"
    ),
}
M_DOT_TERMS = (
    Term("the right Ṁ itself", right.M_dot),
    Term("its mirror image with q̇1 for q̇2", lambda q, qd, arm: right.h(q, arm) * qd[0] * PATTERN),
)


def _h_times(pattern):
    """A wrong C: h times a matrix of the velocities."""
    return lambda q, qd, arm: right.h(q, arm) * np.array(pattern(*qd))


COLUMN = (
    "You return the vector C q̇, or a matrix made of it. Which square matrix gives this vector "
    "when you multiply it by q̇?"
)
ROW_SUMS = (
    "You have C times a vector of ones, which only sums its rows. By which vector must you "
    "multiply C to get the Coriolis and centrifugal torque?"
)
NOT_SKEW = (
    "Your C gives the right C q̇ and keeps the energy, but Ṁ − 2C is not skew-symmetric: C + Cᵀ "
    "is not Ṁ. The Christoffel form has this property. How does it share the product q̇1 q̇2 "
    "between the entries of a row?"
)
NO_HALF = "Your C is twice the right one. Which factor do the Christoffel symbols begin with?"
TRANSPOSED = (
    "You return the transpose of C, which is also Ṁ − C. It keeps the energy and the "
    "skew-symmetry, but it gives a wrong C q̇: which index of h_ijk numbers the row?"
)
HALF_M_DOT = (
    "You return half of Ṁ. It makes Ṁ − 2C zero, which is skew-symmetric, but it does not give "
    "the right C q̇. Which terms of the Euler–Lagrange equation does it leave out?"
)
M_DOT_FOR_C = (
    "You return Ṁ, which is only one part of what the Euler–Lagrange equation gives. What comes "
    "from the derivative of the kinetic energy with respect to q?"
)
LAST_SIGN = (
    "The last of the three derivatives in your Christoffel symbol has the wrong sign. It comes "
    "from −∂K/∂q: what sign does that give it?"
)
LAST_MISSING = (
    "Your C leaves out −∂K/∂q and holds only the terms from d/dt(∂K/∂q̇). Where else in the "
    "Euler–Lagrange equation is M(q) differentiated?"
)
SECOND_MISSING = (
    "One of the two derivatives with a plus is missing from your Christoffel symbol. d/dt(M q̇) "
    "gives ∂M_ij/∂q_k once: how do the velocities j and k share it?"
)
FIRST_INDEX = (
    "You sum the Christoffel symbols over the wrong index. Which index of h_ijk is left free for the "
    "row, and which one goes with q̇_k?"
)
NO_VELOCITY = (
    "Your sum over k has no velocity in it, so your matrix does not change with q̇. What must "
    "multiply each h_ijk?"
)
WRONG_VELOCITY = (
    "You multiply h_ijk by the velocity of the row or of the column. Over which index does the "
    "sum in C_ij run?"
)
LAST_NOT_HALVED = (
    "The last of the three derivatives in your Christoffel symbol counts twice as much as it should. "
    "The kinetic energy has a ½: what stands in front of its derivative with respect to q?"
)
FIRST_MISSING = (
    "Your Christoffel symbol leaves out the derivative of M_ij itself, with respect to q_k, or "
    "shares it wrongly. Where does d/dt act on M?"
)
SIGN = (
    "Your whole C has the wrong sign. Look at the sign of each derivative of M. On which side of "
    "the equation does C q̇ stand?"
)
M_DOT_LESS_2C = "You return Ṁ − 2C, the matrix that you test later. Which matrix is asked for here?"
M_FOR_C = "You return M, which multiplies q̈. C multiplies q̇, and is made of the derivatives of M."
ZERO = (
    "Your C is zero. Do you differentiate M with respect to the coordinates q, and does M change "
    "with them?"
)

CORIOLIS_SAID = _of_wrong_arms("C") | {
    "dropped / the coupling of the two links / C11": (
        "The term with q̇1 q̇2 in your C q̇ is half of what it should be. In how many places of "
        "the sum over j and k does this product appear?"
    ),
    "product dropped / row 1 / qd1 qd2": (
        "The term with q̇1 q̇2 is missing from the first row of your C q̇. What happens when "
        "both joints turn at once?"
    ),
    "sign of the whole": SIGN,
    "product of the wrong sign / row 1 / qd2²": (
        "The term with q̇2² in the first row of your C q̇ has the wrong sign. Which derivative "
        "of M does it come from?"
    ),
    "product dropped / row 1 / qd2²": (
        "The term with q̇2² is missing from the first row of your C q̇. Does M12 change with q2?"
    ),
    "wrong sign / the coupling of the two links / C21": (
        "The second row of your C has the wrong sign: as link 1 turns, it would pull link 2 "
        "inwards. Which term of the Euler–Lagrange equation gives this row, and with which "
        "sign?"
    ),
    "dropped / the coupling of the two links / C21": (
        "The second row of your C is zero. When link 1 turns alone, does link 2 feel nothing of it?"
    ),
    "torque for C": COLUMN,
    "C times ones": ROW_SUMS,
    "twice the whole": NO_HALF,
    "transposed": TRANSPOSED,
    "products in the later column": NOT_SKEW,
    "products in the earlier column": NOT_SKEW,
    "rate of M": M_DOT_FOR_C,
    "half the rate of M": HALF_M_DOT,
    "velocities exchanged": (
        "You swapped the velocities q̇1 and q̇2 in your C. Which velocity goes with a "
        "derivative with respect to q2?"
    ),
    "M": M_FOR_C,
    "zero": ZERO,
    "sign of the last derivative": LAST_SIGN,
    "last derivative missing": LAST_MISSING,
    "second derivative missing": SECOND_MISSING,
    "summed over the first index": FIRST_INDEX,
    "no velocity": NO_VELOCITY,
    "velocity of the column": WRONG_VELOCITY,
    "rate of M less 2C": M_DOT_LESS_2C,
}
CORIOLIS_TERMS = (
    Term("the Coriolis term of row 1 (q̇1 q̇2)", _h_times(lambda a, b: [[b, a], [0.0, 0.0]])),
    Term("the centrifugal term of row 1 (q̇2²)", _h_times(lambda a, b: [[0.0, b], [0.0, 0.0]])),
    Term("the centrifugal term of row 2 (q̇1²)", _h_times(lambda a, b: [[0.0, 0.0], [-a, 0.0]])),
)

PLUS_CONSTANT = (
    "What you add to C does not vanish when it is multiplied by q̇. Which (2, 2) matrices, built from "
    "q̇1 and q̇2, send the vector q̇ to zero?"
)
OTHER = (
    Mistake(
        "C itself",
        right.C,
        "You return the Christoffel C again, for which Ṁ − 2C is skew-symmetric. Here you need a "
        "C for which it is not. What can you add to C without changing C q̇?",
    ),
    Mistake("transposed", lambda q, qd, arm: right.C(q, qd, arm).T, TRANSPOSED),
    Mistake("half of M_dot", lambda q, qd, arm: 0.5 * right.M_dot(q, qd, arm), HALF_M_DOT),
    Mistake("M_dot for C", right.M_dot, M_DOT_FOR_C),
    Mistake("C q̇ for C", lambda q, qd, arm: np.diag(right.C(q, qd, arm) @ qd), COLUMN),
    Mistake("C times ones", lambda q, qd, arm: np.diag(right.C(q, qd, arm) @ np.ones(2)), ROW_SUMS),
    Mistake(
        "scaled",
        lambda q, qd, arm: 2 * right.C(q, qd, arm),
        "You return 2C, and so you change C q̇ as well. What can you add to C without changing C q̇?",
    ),
    Mistake("zero", lambda q, qd, arm: np.zeros((2, 2)), ZERO),
    Mistake(
        "constant skew matrix added",
        lambda q, qd, arm: right.C(q, qd, arm) + np.array([[0.0, 1.0], [-1.0, 0.0]]),
        PLUS_CONSTANT,
    ),
    Mistake(
        "constant skew matrix taken off",
        lambda q, qd, arm: right.C(q, qd, arm) - np.array([[0.0, 1.0], [-1.0, 0.0]]),
        PLUS_CONSTANT,
    ),
    Mistake("unit matrix added", lambda q, qd, arm: right.C(q, qd, arm) + np.eye(2), PLUS_CONSTANT),
    Mistake("ones added", lambda q, qd, arm: right.C(q, qd, arm) + np.ones((2, 2)), PLUS_CONSTANT),
    Mistake(
        "first entry dropped",
        _h_times(lambda a, b: [[0.0, a + b], [-a, 0.0]]),
        "You took an entry out of the first column and lost it: C q̇ now has only half of its "
        "term with q̇1 q̇2. Where in the row can the entry go so that C q̇ stays the same?",
    ),
    Mistake(
        "columns exchanged",
        lambda q, qd, arm: right.C(q, qd, arm)[:, ::-1],
        "You swapped the columns of C, but not q̇1 and q̇2. Is C q̇ still the same?",
    ),
)


STEP = 1e-30  # no difference is formed, so no digits are lost


def _derivatives_at(M: Expressions, q: list[str], point: dict[str, float]):
    """D, (n, n, n), and M, (n, n), at a point.

    The complex step, Im M(q + i ε) / ε, is exact for analytic entries, and a fraction of the work of
    SymPy's derivatives.
    """
    steps = np.array([point[name] for name in q]) + 1j * STEP * np.eye(len(q))
    values = np.array([numbers_at(M, dict(zip(q, step, strict=True))) for step in steps])
    return np.moveaxis(values.imag, 0, -1) / STEP, values[0].real


def at_points(of):
    """A model of `christoffel` from one of numbers: of(D, q̇, M) → (n, n)."""

    def numbers(call, point):
        M, q, qd = call.args
        D, inertia = _derivatives_at(M, [symbol.name for symbol in q], point)
        return of(D, np.array([point[symbol.name] for symbol in qd]), inertia)

    return AtPoints(numbers)


CHRISTOFFEL = tuple(
    Mistake(name, at_points(of), sentence)
    for name, of, sentence in (
        ("C q̇ for C", lambda D, qd, M: np.diag(coriolis(D, qd) @ qd), COLUMN),
        ("C times ones", lambda D, qd, M: np.diag(coriolis(D, qd) @ np.ones(len(qd))), ROW_SUMS),
        ("half missing", lambda D, qd, M: 2 * coriolis(D, qd), NO_HALF),
        ("sign", lambda D, qd, M: -coriolis(D, qd), SIGN),
        ("transposed", lambda D, qd, M: coriolis(D, qd).T, TRANSPOSED),
        (
            "valid, but not skew: the first derivative twice",
            lambda D, qd, M: coriolis(D, qd, first=1.0, second=0.0),
            NOT_SKEW,
        ),
        (
            "valid, but not skew: the second derivative twice",
            lambda D, qd, M: coriolis(D, qd, first=0.0, second=1.0),
            NOT_SKEW,
        ),
        ("M_dot for C", lambda D, qd, M: D @ qd, M_DOT_FOR_C),
        ("half of M_dot", lambda D, qd, M: 0.5 * D @ qd, HALF_M_DOT),
        ("M_dot less 2C", lambda D, qd, M: D @ qd - 2 * coriolis(D, qd), M_DOT_LESS_2C),
        ("last sign", lambda D, qd, M: coriolis(D, qd, third=0.5), LAST_SIGN),
        ("last term missing", lambda D, qd, M: coriolis(D, qd, third=0.0), LAST_MISSING),
        ("last term not halved", lambda D, qd, M: coriolis(D, qd, third=-1.0), LAST_NOT_HALVED),
        ("first term missing", lambda D, qd, M: coriolis(D, qd, first=0.0), FIRST_MISSING),
        ("second term missing", lambda D, qd, M: coriolis(D, qd, second=0.0), SECOND_MISSING),
        (
            "summed over the first index",
            lambda D, qd, M: np.einsum("kij,k->ij", christoffel(D), qd),
            FIRST_INDEX,
        ),
        ("no velocity", lambda D, qd, M: coriolis(D, np.ones(len(qd))), NO_VELOCITY),
        (
            "velocity of the column",
            lambda D, qd, M: christoffel(D) @ np.ones(len(qd)) * qd,
            WRONG_VELOCITY,
        ),
        (
            "velocity of the row",
            lambda D, qd, M: christoffel(D) @ np.ones(len(qd)) * qd[:, None],
            WRONG_VELOCITY,
        ),
        (
            "second kind",
            lambda D, qd, M: np.linalg.solve(M, coriolis(D, qd)),
            "Your Christoffel symbols are of the second kind: you multiplied M⁻¹ into them. That "
            "is right for q̈ = …, but does M⁻¹ have a place in M q̈ + C q̇ + … = u?",
        ),
        ("zero", lambda D, qd, M: np.zeros((len(qd), len(qd))), ZERO),
        ("M for C", lambda D, qd, M: M, M_FOR_C),
    )
)
CHRISTOFFEL_TERMS = (
    Term(
        "the part from d/dt(M q̇)",
        at_points(lambda D, qd, M: coriolis(D, qd, third=0.0)),
    ),
    Term(
        "the part from −∂K/∂q",
        at_points(lambda D, qd, M: coriolis(D, qd, first=0.0, second=0.0)),
    ),
)
