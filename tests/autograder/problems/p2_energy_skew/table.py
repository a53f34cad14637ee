"""Wrong answers about Ṁ and C: the mistakes that each shows, and the credit left."""

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

LOOPS = """
C, s = sp.zeros(n), 0
for i in range(n):
    for j in range(n):
        for k in range({}):
            {}
return C
"""


def summed(line: str, ks: str = "n") -> str:
    """The body of christoffel with three loops. line: in the innermost; ks: the range of k."""
    return LOOPS.format(ks, line)


HEADS = dict.fromkeys(("p2-M_dot", "p2-C", "p2-C_other"), ARM) | {"p2-christoffel": SYMBOLS}

C = "np.array([[h * b, h * (a + b)], [-h * a, 0]])"

BODIES = {
    "p2-M_dot": [
        ("sign of the whole", "H = -h\nreturn [[2 * H * b, H * b], [H * b, 0]]", 0.1),
        ("sum of the velocities", "return h * (a + b) * np.array([[2, 1], [1, 0]])", 0.1),
        ("zero", "return np.zeros((2, 2))", 0.1),
        ("twice C", "return 2 * np.array([[h * b, h * (a + b)], [-h * a, 0]])", 0.55),
        ("constants differentiated", "return M(q) * qd[1]", 0),
        (
            "wrong parameter / the coupling of the two links / l2 / lc2",
            "H = -arm.m2 * arm.l1 * arm.l2 * np.sin(q[1])\nreturn [[2 * H * b, H * b], [H * b, 0]]",
            0.1,
        ),
        (
            "wrong angle / the coupling of the two links / q1 + q2 / q2 / in M",
            "H = -mll * np.sin(q[0] + q[1])\n"
            "return [[2 * H * (a + b), H * (a + b)], [H * (a + b), 0]]",
            0.1,
        ),
        (
            (
                "halved / the coupling of the two links / Ṁ11",
                "astray / the coupling of the two links / Ṁ22 / Ṁ12",
            ),
            "return [[h * b, h * b], [h * b, h * b]]",
            0.45,
        ),
    ],
    "p2-C": [
        (
            "wrong wave / the coupling of the two links / q1 + q2 / q2",
            "h = -mll * np.sin(q[0] + q[1] + np.pi / 2)\n"
            "return [[h * b, h * (a + b)], [-h * a, 0]]",
            0,
        ),
        ("last term alone", "return [[h * b, h * b], [0, 0]]", 0.5),
        (
            "dropped / the coupling of the two links / C11",
            "return [[0, h * (a + b)], [-h * a, 0]]",
            0,
        ),
        (
            "wrong sign / the coupling of the two links / C21",
            "return [[h * b, h * (a + b)], [h * a, 0]]",
            0,
        ),
        ("transposed", "return [[h * b, -h * a], [h * (a + b), 0]]", 0.5),
        ("half the rate of M", "return M_dot / 2", 0.5),
        ("zero", "return np.zeros((2, 2))", 0),
        (
            "summed over the first index",
            "return matrix(lambda i, j, k: (D[k, i, j] + D[k, j, i] - D[i, j, k]) / 2 * qd[k])",
            0.2,
        ),
        (
            "wrong parameter / the coupling of the two links / l2 / lc2",
            "H = -arm.m2 * arm.l1 * arm.l2 * np.sin(q[1])\n"
            "return [[H * b, H * (a + b)], [-H * a, 0]]",
            0,
        ),
        (
            (
                "wrong sign / the coupling of the two links / C21",
                "product of the wrong sign / row 1 / qd2²",
            ),
            "return [[h * b, h * (a - b)], [h * a, 0]]",
            0,
        ),
        (
            (
                "dropped / the coupling of the two links / C11",
                "dropped / the coupling of the two links / C21",
            ),
            "return [[0, h * (a + b)], [0, 0]]",
            0.2,
        ),
    ],
    "p2-C_other": [
        ("C itself", "return np.array([[h * b, h * (a + b)], [-h * a, 0]])", 0.5),
        ("transposed", "return np.array([[h * b, h * (a + b)], [-h * a, 0]]).T", 0),
        ("half the rate of M", "return M_dot / 2", 0),
        ("rate of M", "return M_dot", 0),
        ("torque for C", "return np.array([[h * b, h * (a + b)], [-h * a, 0]]) @ qd", 0),
        ("C times ones", "return np.array([[h * b, h * (a + b)], [-h * a, 0]]) @ np.ones(2)", 0),
        ("scaled", "return 2 * np.array([[h * b, h * (a + b)], [-h * a, 0]])", 0),
        ("zero", "return [[0, 0], [0, 0]]", 0),
        (
            "constant skew matrix added",
            "return np.array([[h * b, h * (a + b)], [-h * a, 0]]) + [[0, 1], [-1, 0]]",
            0,
        ),
        (
            "constant skew matrix taken off",
            "return np.array([[h * b, h * (a + b)], [-h * a, 0]]) + [[0, -1], [1, 0]]",
            0,
        ),
        (
            "unit matrix added",
            "return np.array([[h * b, h * (a + b)], [-h * a, 0]]) + np.eye(2)",
            0,
        ),
        ("ones added", "return np.array([[h * b, h * (a + b)], [-h * a, 0]]) + 1", 0),
        ("first entry dropped", "return [[0, h * (a + b)], [-h * a, 0]]", 0),
        ("columns exchanged", "return np.array([[h * b, h * (a + b)], [-h * a, 0]])[:, ::-1]", 0),
    ],
    "p2-christoffel": [
        ("last term alone", summed("C[i, j] = right(i, j, k)"), 0),
        ("first term alone", "return sp.Matrix(n, n, lambda i, j: right(i, j, 0))", 0),
        ("last term left out", summed("C[i, j] += right(i, j, k)", "n - 1"), 0),
        ("first term left out", summed("C[i, j] += right(i, j, k)", "1, n"), 0),
        ("sum never begun anew", summed("s += right(i, j, k); C[i, j] = s"), 0),
        ("upper triangle alone", summed("C[i, j] += right(i, j, k) * int(i <= j)"), 0),
        (
            "upper triangle mirrored",
            "return matrix(lambda i, j, k: right(min(i, j), max(i, j), k))",
            0,
        ),
        (
            "first derivative alone halved",
            "return matrix(lambda i, j, k: (d(i, j, k) / 2 + d(i, k, j) - d(j, k, i)) * qd[k])",
            0,
        ),
        (
            "second derivative alone halved",
            "return matrix(lambda i, j, k: (d(i, j, k) + d(i, k, j) / 2 - d(j, k, i)) * qd[k])",
            0,
        ),
        (
            "last derivative alone halved",
            "return matrix(lambda i, j, k: (d(i, j, k) + d(i, k, j) - d(j, k, i) / 2) * qd[k])",
            0,
        ),
        ("coordinate for velocity", "return matrix(right).subs(dict(zip(qd, q)))", 0),
        ("torque for C", "return matrix(right) * sp.Matrix(qd)", 0),
        ("C times ones", "return matrix(right) * sp.ones(n, 1)", 0),
        (
            "twice the whole",
            "return matrix(lambda i, j, k: (d(i, j, k) + d(i, k, j) - d(j, k, i)) * qd[k])",
            0,
        ),
        (
            "sign of the whole",
            "return matrix(lambda i, j, k: (d(j, k, i) - d(i, j, k) - d(i, k, j)) / 2 * qd[k])",
            0,
        ),
        (
            "transposed",
            "return matrix(lambda i, j, k: (d(i, j, k) - d(i, k, j) + d(j, k, i)) / 2 * qd[k])",
            0,
        ),
        (
            "not symmetrised",
            "return matrix(lambda i, j, k: (d(i, j, k) - d(j, k, i) / 2) * qd[k])",
            0.4,
        ),
        (
            "second derivative twice",
            "return matrix(lambda i, j, k: (2 * d(i, k, j) - d(j, k, i)) / 2 * qd[k])",
            0.4,
        ),
        ("rate of M", "return matrix(lambda i, j, k: d(i, j, k) * qd[k])", 0),
        (
            "half the rate of M",
            "return matrix(lambda i, j, k: (d(i, j, k) + d(j, k, i) - d(j, k, i)) / 2 * qd[k])",
            0,
        ),
        (
            "rate of M less 2C",
            "return matrix(lambda i, j, k: (d(j, k, i) - d(i, k, j)) * qd[k])",
            0,
        ),
        (
            "sign of the last derivative",
            "return matrix(lambda i, j, k: (d(i, j, k) + d(i, k, j) + d(j, k, i)) / 2 * qd[k])",
            0,
        ),
        (
            "last derivative missing",
            "return matrix(lambda i, j, k: (d(i, j, k) + d(i, k, j)) / 2 * qd[k])",
            0,
        ),
        (
            "last derivative not halved",
            "return matrix(lambda i, j, k: ((d(i, j, k) + d(i, k, j)) / 2 - d(j, k, i)) * qd[k])",
            0,
        ),
        (
            "first derivative missing",
            "return matrix(lambda i, j, k: (d(i, k, j) - d(j, k, i)) / 2 * qd[k])",
            0,
        ),
        (
            "second derivative missing",
            "return matrix(lambda i, j, k: (d(i, j, k) - d(j, k, i)) / 2 * qd[k])",
            0,
        ),
        (
            "summed over the first index",
            "return matrix(lambda i, j, k: (d(k, i, j) + d(k, j, i) - d(i, j, k)) / 2 * qd[k])",
            0,
        ),
        (
            "no velocity",
            "return matrix(lambda i, j, k: (d(i, j, k) + d(i, k, j) - d(j, k, i)) / 2)",
            0,
        ),
        (
            "velocity of the column",
            "return matrix(lambda i, j, k: (d(i, j, k) + d(i, k, j) - d(j, k, i)) / 2 * qd[j])",
            0,
        ),
        (
            "velocity of the row",
            "return matrix(lambda i, j, k: (d(i, j, k) + d(i, k, j) - d(j, k, i)) / 2 * qd[i])",
            0,
        ),
        ("second kind", "return M.adjugate() / M.det() * matrix(right)", 0),
        ("zero", "return matrix(lambda i, j, k: M[i, j].diff(qd[k]) * qd[k])", 0),
        ("M", "return M", 0),
    ],
}

TABLE = {
    check_id: [(names, HEADS[check_id] + body, credit) for names, body, credit in rows]
    for check_id, rows in BODIES.items()
}
