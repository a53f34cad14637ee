"""Every mistake of p2, as a student would type it: its exact sentence, its credit and its witness.

The table is typed out on purpose: a mistake's wording is read by students, and changes only with
intent.
"""

import pytest

from autograder.judging.criterion import TOLERANCE
from autograder.problems import CHECKS
from autograder.judging.verdict import State
from tests.autograder.verdicts import assert_named, judged

# What stands above each body, as a student would have it there.
ARM = """
a, b = qd
mll = arm.m2 * arm.l1 * arm.lc2
h = -mll * np.sin(q[1])
M_dot = h * b * np.array([[2, 1], [1, 0]])
D = np.zeros((2, 2, 2))
D[:, :, 1] = [[2 * h, h], [h, 0]]
def M(q):
    c, d = mll * np.cos(q[1]), arm.I2 + arm.m2 * arm.lc2**2
    M11 = arm.I1 + arm.m1 * arm.lc1**2 + arm.m2 * arm.l1**2 + d + 2 * c
    return np.array([[M11, d + c], [d + c, d]])
def matrix(term):
    r = range(2)
    return [[sum(term(i, j, k) for k in r) for j in r] for i in r]
def christoffel(by_q1, by_q2):
    D = np.stack([by_q1, by_q2], axis=-1)
    C = D + D.transpose(0, 2, 1) - D.transpose(2, 0, 1)
    return C / 2 @ qd
"""
SYMBOLS = """
n = len(q)
def right(i, j, k):
    return (d(i, j, k) + d(i, k, j) - d(j, k, i)) / 2 * qd[k]
def matrix(term):
    return sp.Matrix(n, n, lambda i, j: sum(term(i, j, k) for k in range(n)))
def d(i, j, k):
    return sp.diff(M[i, j], q[k])
"""
HEADS = dict.fromkeys(("p2-M_dot", "p2-C", "p2-C_other"), ARM) | {"p2-christoffel": SYMBOLS}
C = "np.array([[h * b, h * (a + b)], [-h * a, 0]])"

# check, the body that a student would write, the credit left, the sentence.
TABLE = [
    (
        "p2-M_dot",
        "H = -h\nreturn [[2 * H * b, H * b], [H * b, 0]]",
        0.1,
        "Your Ṁ has the wrong sign. When the elbow folds from q2 = 0, does M11 grow or shrink?",
    ),
    (
        "p2-M_dot",
        "return [[2 * h * a, h * a], [h * a, 0]]",
        0.1,
        "You multiply ∂M/∂q2 by q̇1. In the chain rule, with which velocity does the "
        "derivative with respect to q2 go?",
    ),
    (
        "p2-M_dot",
        "return h * (a + b) * np.array([[2, 1], [1, 0]])",
        0.1,
        "You multiply ∂M/∂q2 by q̇1 + q̇2. In the chain rule each derivative has its own "
        "velocity: which is that of q2?",
    ),
    (
        "p2-M_dot",
        "return [[2 * h, h], [h, 0]]",
        0.1,
        "This is the derivative with respect to q2, in kg·m² for each radian. Ṁ is one "
        "with respect to time: what does the chain rule add?",
    ),
    (
        "p2-M_dot",
        "return np.zeros((2, 2))",
        0.1,
        "Your Ṁ is zero. M does not change with q1, that is true. What else in M changes "
        "with time?",
    ),
    (
        "p2-M_dot",
        "return [[h * b, h * b / 2], [h * b / 2, 0]]",
        0.1,
        "Your Ṁ is half of the right one. The ½ stands in the kinetic energy; does it stand in M?",
    ),
    (
        "p2-M_dot",
        "return 2 * np.array([[h * b, h * (a + b)], [-h * a, 0]])",
        0.55,
        "This is 2C. It equals Ṁ only under the quadratic form with q̇; compare the two "
        "matrices entry by entry.",
    ),
    (
        "p2-M_dot",
        "return [[h * b, h * (a + b)], [-h * a, 0]]",
        0.1,
        "This is C. It is made of the same derivatives as Ṁ, but is M symmetric, and can "
        "its derivative be otherwise?",
    ),
    (
        "p2-M_dot",
        "return M(q)",
        0,
        "This is M, not how fast it changes.",
    ),
    (
        "p2-M_dot",
        "return M(q) * qd[1]",
        0,
        "You multiply M by a velocity, where its derivative is to be multiplied. What is "
        "the derivative of the constant parts of M?",
    ),
    (
        "p2-M_dot",
        "H = -mll * np.cos(q[1])\nreturn [[2 * H * b, H * b], [H * b, 0]]",
        0.1,
        "Your Ṁ varies with cos q2. M varies with cos q2 itself: how does its derivative vary?",
    ),
    (
        "p2-M_dot",
        "H = mll * np.cos(q[1])\nreturn [[2 * H * b, H * b], [H * b, 0]]",
        0.1,
        "Your Ṁ varies with cos q2, as if M held sin q2. How does M depend on q2: is the "
        "arm hardest to turn stretched out (q2 = 0) or with its elbow at a right angle?",
    ),
    (
        "p2-M_dot",
        ("H = -arm.m2 * arm.l1 * arm.l2 * np.sin(q[1])\nreturn [[2 * H * b, H * b], [H * b, 0]]"),
        0.1,
        "You use the length ℓ2 of link 2 where the distance to its centre of mass "
        "belongs. Where is its mass, seen from joint 2?",
    ),
    (
        "p2-M_dot",
        ("H = -arm.m2 * arm.lc1 * arm.lc2 * np.sin(q[1])\nreturn [[2 * H * b, H * b], [H * b, 0]]"),
        0.1,
        "You use the distance ℓc1 where the length of link 1 belongs. How far from joint "
        "1 is the joint that carries link 2?",
    ),
    (
        "p2-M_dot",
        ("H = -arm.m1 * arm.l1 * arm.lc2 * np.sin(q[1])\nreturn [[2 * H * b, H * b], [H * b, 0]]"),
        0.1,
        "You use the mass m1. The mass of which link moves nearer to joint 1 when the elbow folds?",
    ),
    (
        "p2-M_dot",
        "H = -mll * np.sin(np.radians(q[1]))\nreturn [[2 * H * b, H * b], [H * b, 0]]",
        0.1,
        "The angle is turned from degrees to radians once too often: q comes in radians already.",
    ),
    (
        "p2-M_dot",
        (
            "H = -mll * np.sin(q[0] + q[1])\n"
            "return [[2 * H * (a + b), H * (a + b)], [H * (a + b), 0]]"
        ),
        0.1,
        "Your Ṁ varies with q1 + q2. M may change with the angle between the links only: "
        "which coordinate is that?",
    ),
    (
        "p2-M_dot",
        "H = -mll * np.sin(q[1] - q[0]) * (b - a)\nreturn [[2 * H, H], [H, 0]]",
        0.1,
        "Your Ṁ varies with q2 − q1, as if q2 were measured from the x axis. From where "
        "is q2 measured here?",
    ),
    (
        "p2-M_dot",
        "H = -mll * np.sin(q[0]) * a\nreturn [[2 * H, H], [H, 0]]",
        0.1,
        "Your Ṁ varies with q1. Turning the whole arm about joint 1 does not change its "
        "shape: which angle does?",
    ),
    (
        "p2-M_dot",
        "return [[h * b, h * b], [h * b, 0]]",
        0.55,
        "Your Ṁ comes from an M11 whose coupling is too small by half. Square the "
        "velocity of link 2's centre of mass again: how often does the mixed product "
        "appear?",
    ),
    (
        "p2-M_dot",
        "return [[2 * h * b, h * b], [h * b, h * b]]",
        0.9,
        "Your Ṁ comes from an M22 that changes with q2. With joint 1 locked, link 2 turns"
        " about joint 2: does its inertia about that joint change?",
    ),
    (
        "p2-C",
        "return [[0, h * (a + b)], [-h * a, 0]]",
        0,
        "The term with q̇1 q̇2 in your C q̇ is half of what it should be. In how many "
        "places of the sum over j and k does this product appear?",
    ),
    (
        "p2-C",
        "return [[0, h * b], [-h * a, 0]]",
        0,
        "The term with q̇1 q̇2 is missing from the first row of your C q̇. What happens "
        "when both joints turn at once?",
    ),
    (
        "p2-C",
        "return [[-h * b, -h * (a + b)], [h * a, 0]]",
        0,
        "All of your C has the wrong sign. Look at the sign of each derivative of M, and "
        "at the side of the equation on which C q̇ stands.",
    ),
    (
        "p2-C",
        "return [[h * b, h * (a - b)], [-h * a, 0]]",
        0,
        "The term with q̇2² in the first row of your C q̇ has the wrong sign. From which "
        "derivative of M does it come?",
    ),
    (
        "p2-C",
        "return [[h * b, h * a], [-h * a, 0]]",
        0,
        "The term with q̇2² is missing from the first row of your C q̇. Does M12 change with q2?",
    ),
    (
        "p2-C",
        "return [[h * b, h * (a + b)], [h * a, 0]]",
        0,
        "The second row of your C has the wrong sign: link 2 would be pulled inwards by "
        "the rotation of link 1. From which term of Euler–Lagrange does this row come, "
        "and with which sign?",
    ),
    (
        "p2-C",
        "return [[h * b, h * (a + b)], [0, 0]]",
        0,
        "The second row of your C is zero. Link 1 alone turns: does link 2 feel nothing of it?",
    ),
    (
        "p2-C",
        "return [[2 * h * b, 2 * h * (a + b)], [-2 * h * a, 0]]",
        0,
        "Your C is twice the right one. What stands in front of the Christoffel symbol?",
    ),
    (
        "p2-C",
        "return [h * (2 * a * b + b**2), -h * a**2]",
        0,
        "This is the vector C q̇, or a matrix made of it. C is the square matrix that "
        "gives this vector when it is multiplied by q̇.",
    ),
    (
        "p2-C",
        "return np.diag([h * (2 * a * b + b**2), -h * a**2])",
        0,
        "This is the vector C q̇, or a matrix made of it. C is the square matrix that "
        "gives this vector when it is multiplied by q̇.",
    ),
    (
        "p2-C",
        "return [[h * (a + 2 * b)], [-h * a]]",
        0,
        "You have C times a vector of ones: its rows are summed. Which vector must C be "
        "multiplied by to give the Coriolis and centrifugal torque?",
    ),
    (
        "p2-C",
        "return np.diag([h * (a + 2 * b), -h * a])",
        0,
        "You have C times a vector of ones: its rows are summed. Which vector must C be "
        "multiplied by to give the Coriolis and centrifugal torque?",
    ),
    (
        "p2-C",
        "return [[h * b, -h * a], [h * (a + b), 0]]",
        0.5,
        "This is the transpose of C, which is also Ṁ − C. It passes the tests of energy "
        "and skew-symmetry, but not C q̇: which index of h_ijk numbers the row?",
    ),
    (
        "p2-C",
        "return M_dot - np.array([[h * b, h * (a + b)], [-h * a, 0]])",
        0.5,
        "This is the transpose of C, which is also Ṁ − C. It passes the tests of energy "
        "and skew-symmetry, but not C q̇: which index of h_ijk numbers the row?",
    ),
    (
        "p2-C",
        "return [[0, h * (2 * a + b)], [-h * a, 0]]",
        0.7,
        "Your C gives the right C q̇, and the energy is kept with it, but Ṁ − 2C is not "
        "skew-symmetric: C + Cᵀ is not Ṁ. What is missing is a property of the "
        "Christoffel choice. How does it share the product q̇1 q̇2 between the entries of"
        " a row?",
    ),
    (
        "p2-C",
        "return [[2 * h * b, h * b], [-h * a, 0]]",
        0.7,
        "Your C gives the right C q̇, and the energy is kept with it, but Ṁ − 2C is not "
        "skew-symmetric: C + Cᵀ is not Ṁ. What is missing is a property of the "
        "Christoffel choice. How does it share the product q̇1 q̇2 between the entries of"
        " a row?",
    ),
    (
        "p2-C",
        "return M_dot",
        0,
        "This is Ṁ. It is one part of what Euler–Lagrange gives with q̇: what comes from "
        "the derivative of the kinetic energy with respect to q?",
    ),
    (
        "p2-C",
        "return M_dot / 2",
        0.5,
        "This is half of Ṁ. It makes Ṁ − 2C zero, and zero is skew; but it does not give "
        "the right C q̇. Which terms of the Euler–Lagrange equation does it leave out?",
    ),
    (
        "p2-C",
        "return M_dot - 2 * np.array([[h * b, h * (a + b)], [-h * a, 0]])",
        0,
        "This is Ṁ − 2C, the matrix that is to be tested. C itself is asked for.",
    ),
    (
        "p2-C",
        "return [[h * a, h * (a + b)], [-h * b, 0]]",
        0,
        "The velocities q̇1 and q̇2 have changed places in your C. With which velocity "
        "does a derivative with respect to q2 go?",
    ),
    (
        "p2-C",
        "return M(q)",
        0,
        "This is M. It multiplies q̈; C multiplies q̇ and is made of the derivatives of M.",
    ),
    (
        "p2-C",
        "return np.zeros((2, 2))",
        0,
        "Your C is zero. Do the derivatives in it act on M with respect to the "
        "coordinates q, and does M change with them?",
    ),
    (
        "p2-C",
        "return matrix(lambda i, j, k: (D[i, j, k] + D[i, k, j] + D[j, k, i]) / 2 * qd[k])",
        0,
        "The last of the three derivatives in your Christoffel symbol has the wrong sign."
        " It comes from −∂K/∂q: what does that do to it?",
    ),
    (
        "p2-C",
        "return matrix(lambda i, j, k: (D[i, j, k] + D[i, k, j]) / 2 * qd[k])",
        0,
        "Your C leaves out −∂K/∂q: only the terms from d/dt(∂K/∂q̇) are in it. Where does"
        " M(q) in the kinetic energy enter once more?",
    ),
    (
        "p2-C",
        "return matrix(lambda i, j, k: (D[i, j, k] - D[j, k, i]) / 2 * qd[k])",
        0,
        "One of the two derivatives with a plus in your Christoffel symbol is missing. "
        "d/dt(M q̇) gives ∂M_ij/∂q_k once; how is it shared between the velocities j and "
        "k?",
    ),
    (
        "p2-C",
        "return matrix(lambda i, j, k: (D[k, i, j] + D[k, j, i] - D[i, j, k]) / 2 * qd[k])",
        0.2,
        "You sum the Christoffel symbols over the wrong index. Which index of h_ijk is "
        "left free for the row, and which one goes with q̇_k?",
    ),
    (
        "p2-C",
        "return matrix(lambda i, j, k: (D[i, j, k] + D[i, k, j] - D[j, k, i]) / 2)",
        0,
        "Your sum over k has no velocity in it: the matrix you return does not change "
        "with q̇. By what is each h_ijk multiplied?",
    ),
    (
        "p2-C",
        "return matrix(lambda i, j, k: (D[i, j, k] + D[i, k, j] - D[j, k, i]) / 2 * qd[j])",
        0,
        "You multiply h_ijk by the velocity of the row or the column instead of that of "
        "the index you sum over. Which index is summed in C_ij?",
    ),
    (
        "p2-C",
        "H = -mll * np.cos(q[1])\nreturn [[H * b, H * (a + b)], [-H * a, 0]]",
        0,
        "Your C varies with cos q2. M varies with cos q2 itself: how does its derivative vary?",
    ),
    (
        "p2-C",
        "H = mll * np.cos(q[1])\nreturn [[H * b, H * (a + b)], [-H * a, 0]]",
        0,
        "Your C varies with cos q2, as if M held sin q2. How does M depend on q2: is the "
        "arm hardest to turn stretched out (q2 = 0) or with its elbow at a right angle?",
    ),
    (
        "p2-C",
        (
            "H = -arm.m2 * arm.l1 * arm.l2 * np.sin(q[1])\n"
            "return [[H * b, H * (a + b)], [-H * a, 0]]"
        ),
        0,
        "You use the length ℓ2 of link 2 where the distance to its centre of mass "
        "belongs. Where is its mass, seen from joint 2?",
    ),
    (
        "p2-C",
        (
            "H = -arm.m2 * arm.lc1 * arm.lc2 * np.sin(q[1])\n"
            "return [[H * b, H * (a + b)], [-H * a, 0]]"
        ),
        0,
        "You use the distance ℓc1 where the length of link 1 belongs. How far from joint "
        "1 is the joint that carries link 2?",
    ),
    (
        "p2-C",
        (
            "H = -arm.m1 * arm.l1 * arm.lc2 * np.sin(q[1])\n"
            "return [[H * b, H * (a + b)], [-H * a, 0]]"
        ),
        0,
        "You use the mass m1. The mass of which link moves nearer to joint 1 when the elbow folds?",
    ),
    (
        "p2-C",
        "H = -mll * np.sin(np.radians(q[1]))\nreturn [[H * b, H * (a + b)], [-H * a, 0]]",
        0,
        "The angle is turned from degrees to radians once too often: q comes in radians already.",
    ),
    (
        "p2-C",
        (
            "H = -mll * np.sin(q[0] + q[1])\n"
            "return christoffel([[2 * H, H], [H, 0]], [[2 * H, H], [H, 0]])"
        ),
        0,
        "Your C varies with q1 + q2. M may change with the angle between the links only: "
        "which coordinate is that?",
    ),
    (
        "p2-C",
        (
            "H = -mll * np.sin(q[1] - q[0])\n"
            "return christoffel([[-2 * H, -H], [-H, 0]], [[2 * H, H], [H, 0]])"
        ),
        0,
        "Your C varies with q2 − q1, as if q2 were measured from the x axis. From where "
        "is q2 measured here?",
    ),
    (
        "p2-C",
        "H = -mll * np.sin(q[0])\nreturn christoffel([[2 * H, H], [H, 0]], np.zeros((2, 2)))",
        0,
        "Your C varies with q1. Turning the whole arm about joint 1 does not change its "
        "shape: which angle does?",
    ),
    (
        "p2-C",
        "return christoffel(np.zeros((2, 2)), [[h, h], [h, 0]])",
        0,
        "Your C comes from an M11 whose coupling is too small by half. Square the "
        "velocity of link 2's centre of mass again: how often does the mixed product "
        "appear?",
    ),
    (
        "p2-C",
        "return christoffel(np.zeros((2, 2)), [[2 * h, h], [h, h]])",
        0,
        "Your C comes from an M22 that changes with q2. With joint 1 locked, link 2 turns"
        " about joint 2: does its inertia about that joint change?",
    ),
    (
        "p2-C_other",
        "return np.array([[h * b, h * (a + b)], [-h * a, 0]])",
        0.5,
        "This is the Christoffel C again. Its Ṁ − 2C is skew-symmetric, and here one is "
        "asked for that is not. What may be added to C without changing C q̇?",
    ),
    (
        "p2-C_other",
        "return np.array([[h * b, h * (a + b)], [-h * a, 0]]).T",
        0,
        "This is the transpose of C, which is also Ṁ − C. It passes the tests of energy "
        "and skew-symmetry, but not C q̇: which index of h_ijk numbers the row?",
    ),
    (
        "p2-C_other",
        "return M_dot / 2",
        0,
        "This is half of Ṁ. It makes Ṁ − 2C zero, and zero is skew; but it does not give "
        "the right C q̇. Which terms of the Euler–Lagrange equation does it leave out?",
    ),
    (
        "p2-C_other",
        "return M_dot",
        0,
        "This is Ṁ. It is one part of what Euler–Lagrange gives with q̇: what comes from "
        "the derivative of the kinetic energy with respect to q?",
    ),
    (
        "p2-C_other",
        "return np.array([[h * b, h * (a + b)], [-h * a, 0]]) @ qd",
        0,
        "This is the vector C q̇, or a matrix made of it. C is the square matrix that "
        "gives this vector when it is multiplied by q̇.",
    ),
    (
        "p2-C_other",
        "return np.array([[h * b, h * (a + b)], [-h * a, 0]]) @ np.ones(2)",
        0,
        "You have C times a vector of ones: its rows are summed. Which vector must C be "
        "multiplied by to give the Coriolis and centrifugal torque?",
    ),
    (
        "p2-C_other",
        "return 2 * np.array([[h * b, h * (a + b)], [-h * a, 0]])",
        0,
        "This is 2C. Multiplying C changes C q̇ as well; what is to be kept is C q̇.",
    ),
    (
        "p2-C_other",
        "return [[0, 0], [0, 0]]",
        0,
        "Your C is zero. Do the derivatives in it act on M with respect to the "
        "coordinates q, and does M change with them?",
    ),
    (
        "p2-C_other",
        "return np.array([[h * b, h * (a + b)], [-h * a, 0]]) + [[0, 1], [-1, 0]]",
        0,
        "What you add to C does not vanish when it is multiplied by q̇. Which (2, 2) "
        "matrices, built from q̇1 and q̇2, send the vector q̇ to zero?",
    ),
    (
        "p2-C_other",
        "return np.array([[h * b, h * (a + b)], [-h * a, 0]]) + [[0, -1], [1, 0]]",
        0,
        "What you add to C does not vanish when it is multiplied by q̇. Which (2, 2) "
        "matrices, built from q̇1 and q̇2, send the vector q̇ to zero?",
    ),
    (
        "p2-C_other",
        "return np.array([[h * b, h * (a + b)], [-h * a, 0]]) + np.eye(2)",
        0,
        "What you add to C does not vanish when it is multiplied by q̇. Which (2, 2) "
        "matrices, built from q̇1 and q̇2, send the vector q̇ to zero?",
    ),
    (
        "p2-C_other",
        "return np.array([[h * b, h * (a + b)], [-h * a, 0]]) + 1",
        0,
        "What you add to C does not vanish when it is multiplied by q̇. Which (2, 2) "
        "matrices, built from q̇1 and q̇2, send the vector q̇ to zero?",
    ),
    (
        "p2-C_other",
        "return [[0, h * (a + b)], [-h * a, 0]]",
        0,
        "The entry that you took out of the first column is lost: C q̇ has half of its "
        "term with q̇1 q̇2 now. Where in the row can it go so that C q̇ stays?",
    ),
    (
        "p2-C_other",
        "return np.array([[h * b, h * (a + b)], [-h * a, 0]])[:, ::-1]",
        0,
        "The columns of C have changed places, but q̇1 and q̇2 have not. Is C q̇ the same?",
    ),
    (
        "p2-christoffel",
        "return matrix(right) * sp.Matrix(qd)",
        0,
        "This is the vector C q̇, or a matrix made of it. C is the square matrix that "
        "gives this vector when it is multiplied by q̇.",
    ),
    (
        "p2-christoffel",
        "return matrix(right) * sp.ones(n, 1)",
        0,
        "You have C times a vector of ones: its rows are summed. Which vector must C be "
        "multiplied by to give the Coriolis and centrifugal torque?",
    ),
    (
        "p2-christoffel",
        "return matrix(lambda i, j, k: (d(i, j, k) + d(i, k, j) - d(j, k, i)) * qd[k])",
        0,
        "Your C is twice the right one. What stands in front of the Christoffel symbol?",
    ),
    (
        "p2-christoffel",
        "return matrix(lambda i, j, k: (d(j, k, i) - d(i, j, k) - d(i, k, j)) / 2 * qd[k])",
        0,
        "All of your C has the wrong sign. Look at the sign of each derivative of M, and "
        "at the side of the equation on which C q̇ stands.",
    ),
    (
        "p2-christoffel",
        "return matrix(lambda i, j, k: (d(i, j, k) - d(i, k, j) + d(j, k, i)) / 2 * qd[k])",
        0,
        "This is the transpose of C, which is also Ṁ − C. It passes the tests of energy "
        "and skew-symmetry, but not C q̇: which index of h_ijk numbers the row?",
    ),
    (
        "p2-christoffel",
        "return matrix(lambda i, j, k: (d(i, j, k) - d(j, k, i) / 2) * qd[k])",
        0.4,
        "Your C gives the right C q̇, and the energy is kept with it, but Ṁ − 2C is not "
        "skew-symmetric: C + Cᵀ is not Ṁ. What is missing is a property of the "
        "Christoffel choice. How does it share the product q̇1 q̇2 between the entries of"
        " a row?",
    ),
    (
        "p2-christoffel",
        "return matrix(lambda i, j, k: (2 * d(i, k, j) - d(j, k, i)) / 2 * qd[k])",
        0.4,
        "Your C gives the right C q̇, and the energy is kept with it, but Ṁ − 2C is not "
        "skew-symmetric: C + Cᵀ is not Ṁ. What is missing is a property of the "
        "Christoffel choice. How does it share the product q̇1 q̇2 between the entries of"
        " a row?",
    ),
    (
        "p2-christoffel",
        "return matrix(lambda i, j, k: d(i, j, k) * qd[k])",
        0,
        "This is Ṁ. It is one part of what Euler–Lagrange gives with q̇: what comes from "
        "the derivative of the kinetic energy with respect to q?",
    ),
    (
        "p2-christoffel",
        "return matrix(lambda i, j, k: (d(i, j, k) + d(j, k, i) - d(j, k, i)) / 2 * qd[k])",
        0,
        "This is half of Ṁ. It makes Ṁ − 2C zero, and zero is skew; but it does not give "
        "the right C q̇. Which terms of the Euler–Lagrange equation does it leave out?",
    ),
    (
        "p2-christoffel",
        "return matrix(lambda i, j, k: (d(j, k, i) - d(i, k, j)) * qd[k])",
        0,
        "This is Ṁ − 2C, the matrix that is to be tested. C itself is asked for.",
    ),
    (
        "p2-christoffel",
        "return matrix(lambda i, j, k: (d(i, j, k) + d(i, k, j) + d(j, k, i)) / 2 * qd[k])",
        0,
        "The last of the three derivatives in your Christoffel symbol has the wrong sign."
        " It comes from −∂K/∂q: what does that do to it?",
    ),
    (
        "p2-christoffel",
        "return matrix(lambda i, j, k: (d(i, j, k) + d(i, k, j)) / 2 * qd[k])",
        0,
        "Your C leaves out −∂K/∂q: only the terms from d/dt(∂K/∂q̇) are in it. Where does"
        " M(q) in the kinetic energy enter once more?",
    ),
    (
        "p2-christoffel",
        "return matrix(lambda i, j, k: ((d(i, j, k) + d(i, k, j)) / 2 - d(j, k, i)) * qd[k])",
        0,
        "The last of the three derivatives in your Christoffel symbol counts twice as "
        "much as it should. The kinetic energy has a ½: what stands in front of its "
        "derivative with respect to q?",
    ),
    (
        "p2-christoffel",
        "return matrix(lambda i, j, k: (d(i, k, j) - d(j, k, i)) / 2 * qd[k])",
        0,
        "The derivative of M_ij itself, with respect to q_k, is missing or shared wrongly"
        " in your Christoffel symbol. Where does d/dt act on M?",
    ),
    (
        "p2-christoffel",
        "return matrix(lambda i, j, k: (d(i, j, k) - d(j, k, i)) / 2 * qd[k])",
        0,
        "One of the two derivatives with a plus in your Christoffel symbol is missing. "
        "d/dt(M q̇) gives ∂M_ij/∂q_k once; how is it shared between the velocities j and "
        "k?",
    ),
    (
        "p2-christoffel",
        "return matrix(lambda i, j, k: (d(k, i, j) + d(k, j, i) - d(i, j, k)) / 2 * qd[k])",
        0,
        "You sum the Christoffel symbols over the wrong index. Which index of h_ijk is "
        "left free for the row, and which one goes with q̇_k?",
    ),
    (
        "p2-christoffel",
        "return matrix(lambda i, j, k: (d(i, j, k) + d(i, k, j) - d(j, k, i)) / 2)",
        0,
        "Your sum over k has no velocity in it: the matrix you return does not change "
        "with q̇. By what is each h_ijk multiplied?",
    ),
    (
        "p2-christoffel",
        "return matrix(lambda i, j, k: (d(i, j, k) + d(i, k, j) - d(j, k, i)) / 2 * qd[j])",
        0,
        "You multiply h_ijk by the velocity of the row or the column instead of that of "
        "the index you sum over. Which index is summed in C_ij?",
    ),
    (
        "p2-christoffel",
        "return matrix(lambda i, j, k: (d(i, j, k) + d(i, k, j) - d(j, k, i)) / 2 * qd[i])",
        0,
        "You multiply h_ijk by the velocity of the row or the column instead of that of "
        "the index you sum over. Which index is summed in C_ij?",
    ),
    (
        "p2-christoffel",
        "return M.adjugate() / M.det() * matrix(right)",
        0,
        "These are Christoffel symbols of the second kind: M⁻¹ has been multiplied in. "
        "That is right for q̈ = …; in M q̈ + C q̇ + … = u, has M⁻¹ a place?",
    ),
    (
        "p2-christoffel",
        "return matrix(lambda i, j, k: M[i, j].diff(qd[k]) * qd[k])",
        0,
        "Your C is zero. Do the derivatives in it act on M with respect to the "
        "coordinates q, and does M change with them?",
    ),
    (
        "p2-christoffel",
        "return M",
        0,
        "This is M. It multiplies q̈; C multiplies q̇ and is made of the derivatives of M.",
    ),
]


@pytest.mark.parametrize(("check_id", "body", "credit", "sentence"), TABLE)
def test_sentence_credit_and_witness(check_id, body, credit, sentence):
    assert_named(check_id, HEADS[check_id] + body, credit, sentence)


def test_every_mistake_has_its_row():
    for check_id in HEADS:
        said = {sentence for check, _, _, sentence in TABLE if check == check_id}
        assert {mistake.sentence for mistake in CHECKS[check_id].mistakes} == said


def sentence_of(check_id, name):
    return next(m.sentence for m in CHECKS[check_id].mistakes if m.name == name)


@pytest.mark.parametrize(
    ("check_id", "body", "names"),
    [
        (
            "p2-C",
            "return [[h * b, h * (a - b)], [h * a, 0]]",
            [
                "sign of the centrifugal term of joint 1",
                "sign of the centrifugal term of joint 2",
            ],
        ),
        (
            "p2-C",
            "return [[0, h * (a + b)], [0, 0]]",
            ["2 missing in the Coriolis term", "centrifugal term of joint 2 missing"],
        ),
        (
            "p2-M_dot",
            "return [[h * b, h * b], [h * b, h * b]]",
            ["factor 2 missing in M11", "coupling in M22"],
        ),
    ],
)
def test_two_mistakes_in_different_terms_are_both_named(check_id, body, names):
    said = judged(check_id, HEADS[check_id] + body).diagnosis
    assert said[:2] == tuple(sentence_of(check_id, name) for name in names)


@pytest.mark.parametrize(
    ("check_id", "body", "said"),
    [
        (
            "p2-C",
            "return [[h * b, h * (a + 1.3 * b)], [-h * a, 0]]",
            "The error in your vector C q̇ varies like the centrifugal term of row 1, with q̇2² "
            "(+0.3 times it).",
        ),
        (
            "p2-C",
            "return [[h * b, h * (a + b)], [-0.6 * h * a, 0]]",
            "The error in your vector C q̇ varies like the centrifugal term of row 2, with q̇1² "
            "(-0.4 times it).",
        ),
        (
            "p2-M_dot",
            "return 1.1 * M_dot",
            "The error in your entry Ṁ11 varies like the right Ṁ itself (+0.1 times it).",
        ),
        (
            "p2-C_other",
            "return [[0, h * (a + 1.3 * b)], [-h * a, 0]]",
            "The error in your vector C_other q̇ varies like the Coriolis term of row 1, with "
            "q̇1 q̇2 (-0.5 times it) and the centrifugal term of row 1, with q̇2² (+0.3 times it).",
        ),
        (
            "p2-christoffel",
            "return matrix(lambda i, j, k: (d(i, j, k) + d(i, k, j) - 1.4 * d(j, k, i)) / 2 * qd[k])",
            "The error in your vector C q̇ varies like the last derivative, from −∂K/∂q "
            "(+0.4 times it).",
        ),
    ],
)
def test_an_unknown_error_is_put_in_its_term(check_id, body, said):
    verdict = judged(check_id, HEADS[check_id] + body)
    assert verdict.diagnosis[0] == said


NEITHER = (
    "With your C the energy would change where nobody does work: q̇ᵀ(Ṁ − 2C)q̇ is not zero.",
    "With your C the matrix Ṁ − 2C is not skew-symmetric. That is a property of the Christoffel "
    "choice, beyond a right C q̇: how does it share the product q̇1 q̇2 between the entries of a row?",
)


@pytest.mark.parametrize(
    ("body", "met"),
    [
        (f"return {C} + 0.3 * np.outer([1, 2], [-b, a])", (True, True, False)),
        (f"return {C} + 0.3 * np.array([[0, 1], [-1, 0]])", (False, True, True)),
        (f"return {C} + 0.3 * np.array([[b * b, 0], [0, -a * a]])", (False, True, False)),
        (f"return {C} + 0.3 * np.outer([1, 2], [b, 2 * a])", (False, False, False)),
    ],
)
def test_each_step_of_c_has_its_own_credit(body, met):
    verdict = judged("p2-C", ARM + body)
    assert tuple(row.met for row in verdict.rows) == met
    assert verdict.credit == pytest.approx(sum((0.5, 0.2, 0.3)[k] for k in range(3) if met[k]))
    assert set(verdict.diagnosis) <= set(NEITHER)
    for k in (1, 2):
        assert (NEITHER[k - 1] in verdict.diagnosis) is not met[k]


def test_a_mistake_explains_what_it_breaks_and_no_more():
    """The right C q̇ of a known mistake, shared out in a new way: the skew step says so by itself."""
    verdict = judged("p2-C", ARM + "return [[-h * b, h * (2 * a + b)], [-h * a, 0]]")
    assert verdict.diagnosis == (
        sentence_of("p2-C", "2 missing in the Coriolis term"),
        NEITHER[1],
    )


def test_another_c_must_differ_clearly():
    barely = f"return {C} + 1e-4 * h * np.outer([1, 2], [-b, a])"
    verdict = judged("p2-C_other", ARM + barely)
    assert verdict.credit == 0.5
    assert verdict.diagnosis[0].startswith("An answer counts as not skew where")


def test_not_skew_counts_only_with_the_right_c_qd():
    verdict = judged("p2-C_other", ARM + f"return {C} + np.array([[3.0, 1.0], [2.0, 0.5]])")
    assert [row.met for row in verdict.rows] == [False, False]


@pytest.mark.parametrize(
    ("check_id", "body"),
    [
        ("p2-M_dot", "return M_dot * 1.0001"),
        ("p2-C", f"return {C} * 1.0001"),
        ("p2-C_other", "return [[0, h * (2 * a + b) * 1.0001], [-h * a, 0]]"),
        ("p2-christoffel", "return sp.zeros(n) + sp.eye(n)"),
    ],
)
def test_unknown_error_names_no_mistake(check_id, body):
    verdict = judged(check_id, HEADS[check_id] + body)
    known = {mistake.sentence for mistake in CHECKS[check_id].mistakes}
    assert verdict.state is not State.CORRECT
    assert not set(verdict.diagnosis) & known


def test_mistake_is_named_only_where_it_matches_to_rounding():
    transposed = f"return {C}.T * (1 + {20 * TOLERANCE})"
    sentence = sentence_of("p2-C", "transposed")
    assert sentence not in judged("p2-C", ARM + transposed).diagnosis
    assert judged("p2-C", ARM + f"return np.float32({C}.T)").diagnosis == (sentence,)


@pytest.mark.parametrize(
    ("check_id", "body", "said"),
    [
        ("p2-M_dot", "return h * b", "an array of shape (); shape (2, 2) is asked for"),
        ("p2-C", "return [h, b]", "an array of shape (2,); shape (2, 2) is asked for"),
        ("p2-C_other", "return np.eye(3)", "an array of shape (3, 3); shape (2, 2) is asked for"),
        ("p2-christoffel", "return sp.zeros(n, 1)", "shape (2, 1); shape (2, 2) is asked for"),
    ],
)
def test_other_shapes_are_named(check_id, body, said):
    verdict = judged(check_id, HEADS[check_id] + body)
    assert verdict.state is State.ERROR
    assert said in verdict.problem
