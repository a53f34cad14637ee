"""Mistakes about Ṁ and the Coriolis matrix C of the 2R arm, and those that any C can have.

They follow from the arm; here stand their sentences.
"""

import numpy as np

from autograder.judging.terms import Term
from autograder.problems.material import planar_2r as right
from autograder.problems.material import sentences

# How the coupling m2 ℓ1 ℓc2 cos q2 enters M.
PATTERN = np.array([[2.0, 1.0], [1.0, 0.0]])


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


def h_times(pattern):
    """A wrong C: h times a matrix of the velocities."""
    return lambda q, qd, arm: right.h(q, arm) * np.array(pattern(*qd))


NOT_SKEW = (
    "Your C gives the right C q̇ and keeps the energy, but Ṁ − 2C is not skew-symmetric: C + Cᵀ "
    "is not Ṁ. The Christoffel form has this property. How does it share the product q̇1 q̇2 "
    "between the entries of a row?"
)
WRONG_VELOCITY = (
    "You multiply h_ijk by the velocity of the row or of the column. Over which index does the "
    "sum in C_ij run?"
)
# Steps of any C, by their names in `mutation.steps`: of this arm, of the other C, of symbols.
OF_ANY_C = {
    "torque for C": (
        "You return the vector C q̇, or a matrix made of it. Which square matrix gives this vector "
        "when you multiply it by q̇?"
    ),
    "C times ones": (
        "You have C times a vector of ones, which only sums its rows. By which vector must you "
        "multiply C to get the Coriolis and centrifugal torque?"
    ),
    "twice the whole": (
        "Your C is twice the right one. Which factor do the Christoffel symbols begin with?"
    ),
    "sign of the whole": (
        "Your whole C has the wrong sign. Look at the sign of each derivative of M. On which side of "
        "the equation does C q̇ stand?"
    ),
    "transposed": (
        "You return the transpose of C, which is also Ṁ − C. It keeps the energy and the "
        "skew-symmetry, but it gives a wrong C q̇: which index of h_ijk numbers the row?"
    ),
    "rate of M": (
        "You return Ṁ, which is only one part of what the Euler–Lagrange equation gives. What comes "
        "from the derivative of the kinetic energy with respect to q?"
    ),
    "half the rate of M": (
        "You return half of Ṁ. It makes Ṁ − 2C zero, which is skew-symmetric, but it does not give "
        "the right C q̇. Which terms of the Euler–Lagrange equation does it leave out?"
    ),
    "rate of M less 2C": (
        "You return Ṁ − 2C, the matrix that you test later. Which matrix is asked for here?"
    ),
    "sign of the last derivative": (
        "The last of the three derivatives in your Christoffel symbol has the wrong sign. It comes "
        "from −∂K/∂q: what sign does that give it?"
    ),
    "last derivative missing": (
        "Your C leaves out −∂K/∂q and holds only the terms from d/dt(∂K/∂q̇). Where else in the "
        "Euler–Lagrange equation is M(q) differentiated?"
    ),
    "second derivative missing": (
        "One of the two derivatives with a plus is missing from your Christoffel symbol. d/dt(M q̇) "
        "gives ∂M_ij/∂q_k once: how do the velocities j and k share it?"
    ),
    "summed over the first index": (
        "You sum the Christoffel symbols over the wrong index. Which index of h_ijk is left free for "
        "the row, and which one goes with q̇_k?"
    ),
    "no velocity": (
        "Your sum over k has no velocity in it, so your matrix does not change with q̇. What must "
        "multiply each h_ijk?"
    ),
    "velocity of the column": WRONG_VELOCITY,
    "M": ("You return M, which multiplies q̈. C multiplies q̇, and is made of the derivatives of M."),
    "zero": (
        "Your C is zero. Do you differentiate M with respect to the coordinates q, and does M change "
        "with them?"
    ),
}

HALF_OF_THE_PRODUCT = (
    "The term with q̇1 q̇2 in your C q̇ is half of what it should be. In how many places of the sum over "
    "j and k does this product appear?"
)
CORIOLIS_SAID = (
    _of_wrong_arms("C")
    | OF_ANY_C
    | {
        "dropped / the coupling of the two links / C11": HALF_OF_THE_PRODUCT,
        "product halved / row 1 / qd1 qd2": HALF_OF_THE_PRODUCT,
        "product dropped / row 1 / qd1 qd2": (
            "The term with q̇1 q̇2 is missing from the first row of your C q̇. What happens when "
            "both joints turn at once?"
        ),
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
        "products in the later column": NOT_SKEW,
        "products in the earlier column": NOT_SKEW,
        "velocities exchanged": (
            "You swapped the velocities q̇1 and q̇2 in your C. Which velocity goes with a "
            "derivative with respect to q2?"
        ),
    }
)
CORIOLIS_TERMS = (
    Term("the Coriolis term of row 1 (q̇1 q̇2)", h_times(lambda a, b: [[b, a], [0.0, 0.0]])),
    Term("the centrifugal term of row 1 (q̇2²)", h_times(lambda a, b: [[0.0, b], [0.0, 0.0]])),
    Term("the centrifugal term of row 2 (q̇1²)", h_times(lambda a, b: [[0.0, 0.0], [-a, 0.0]])),
)
