"""Right answers about Ṁ and C, each found in another way."""

H = "a, b = qd\nh = -arm.m2 * arm.l1 * arm.lc2 * np.sin(q[1])\n"
INERTIA = """
def M(q):
    c, d = arm.m2 * arm.l1 * arm.lc2 * np.cos(q[1]), arm.I2 + arm.m2 * arm.lc2**2
    M11 = arm.I1 + arm.m1 * arm.lc1**2 + arm.m2 * arm.l1**2 + d + 2 * c
    return np.array([[M11, d + c], [d + c, d]])
def by_difference(k, e=1e-6):
    step = e * np.eye(2)[k]
    return (M(q + step) - M(q - step)) / (2 * e)
"""
SYMBOLIC = """
x, v = sp.symbols("x1 x2"), sp.symbols("v1 v2")
c, d = arm.m2 * arm.l1 * arm.lc2 * sp.cos(x[1]), arm.I2 + arm.m2 * arm.lc2**2
M11 = arm.I1 + arm.m1 * arm.lc1**2 + arm.m2 * arm.l1**2 + d + 2 * c
M = sp.Matrix([[M11, d + c], [d + c, d]])
Mdot = M.diff(x[0]) * v[0] + M.diff(x[1]) * v[1]
"""
# The velocity of each centre of mass and its Jacobian, by the arm's geometry.
JACOBIANS = """
def J(q):
    s1, s12 = np.array([-np.sin(q[0]), np.cos(q[0])]), np.array([-np.sin(q.sum()), np.cos(q.sum())])
    J1 = np.array([arm.lc1 * s1, 0 * s1]).T
    J2 = np.array([arm.l1 * s1 + arm.lc2 * s12, arm.lc2 * s12]).T
    return J1, J2
def Jdot(e=1e-6):
    return [(p - m) / (2 * e) for p, m in zip(J(q + e * qd), J(q - e * qd), strict=True)]
"""
MASSES = "zip((arm.m1, arm.m2), J(q), Jdot(), strict=True)"
CHRISTOFFEL = "[[h * b, h * (a + b)], [-h * a, 0]]"
NUMERIC_CHRISTOFFEL = INERTIA + (
    "D = [by_difference(k) for k in range(2)]\n"
    "h = lambda i, j, k: (D[k][i, j] + D[j][i, k] - D[i][j, k]) / 2\n"
    "return [[sum(h(i, j, k) * qd[k] for k in range(2)) for j in range(2)] for i in range(2)]"
)
SUM = (
    "n = len(q)\n"
    "def h(i, j, k):\n"
    "    return (M[i, j].diff(q[k]) + M[i, k].diff(q[j]) - M[j, k].diff(q[i])) / 2\n"
    "def c(i, j):\n"
    "    return sum(h(i, j, k) * qd[k] for k in range(n))\n"
)
FORWARD = INERTIA + "return (M(q + 1e-7 * qd) - M(q)) / 1e-7"
RIGHT = {
    "p2-M_dot": [
        H + "return ((2 * h * b, h * b), (h * b, 0 * b))",
        H + f"C = np.array({CHRISTOFFEL})\nreturn C + C.T",
        INERTIA + "return (M(q + 1e-6 * qd) - M(q - 1e-6 * qd)) / 2e-6",
        FORWARD,
        INERTIA + "return M(q + 1e-30j * qd).imag / 1e-30",
        INERTIA + "return by_difference(0) * qd[0] + by_difference(1) * qd[1]",
        SYMBOLIC + "return sp.lambdify([*x, *v], Mdot)(*q, *qd)",
        JACOBIANS + f"return sum(m * (J.T @ Jd + Jd.T @ J) for m, J, Jd in {MASSES})",
    ],
    "p2-C": [
        H + f"return np.array({CHRISTOFFEL})",
        H + "return h * np.outer([1, 0], [b, a + b]) - h * np.outer([0, 1], [a, 0])",
        H
        + "half_of_M_dot = h * b / 2 * np.array([[2, 1], [1, 0]])\n"
        + "return half_of_M_dot + h * (a + b / 2) * np.array([[0, 1], [-1, 0]])",
        H + "h = np.array([[[0, h], [h, h]], [[-h, 0], [0, 0]]])\nreturn h @ qd",
        NUMERIC_CHRISTOFFEL,
        INERTIA
        + "D = np.stack([by_difference(0), by_difference(1)], axis=-1)\n"
        + "return (D + D.swapaxes(1, 2) - D.transpose(2, 0, 1)) @ qd / 2",
        SYMBOLIC
        + "N = sp.Matrix(2, 2, lambda i, j: sum((M[j, k].diff(x[i]) - M[i, k].diff(x[j])) * v[k]\n"
        + "                                     for k in range(2)))\n"
        + "return sp.lambdify([*x, *v], (Mdot - N) / 2)(*q, *qd)",
        JACOBIANS + f"return sum(m * J.T @ Jd for m, J, Jd in {MASSES})",
        H + f"return np.asfortranarray({CHRISTOFFEL}).tolist()",
    ],
    "p2-C_other": [
        H + "return [[0, h * (2 * a + b)], [-h * a, 0]]",
        H + "return np.array([[2 * h * b, h * b], [-h * a, 0]])",
        H + f"return np.array({CHRISTOFFEL}) + np.outer([1, 2], [b, -a])",
        H + f"return np.array({CHRISTOFFEL}) + 5 * a * b * np.outer([0, 1], [b, -a])",
        H + f"return sp.Matrix({CHRISTOFFEL}) + sp.Matrix([[b, -a], [b, -a]])",
        H + "return [[h * b, h * (a + b)], [-h * a - b, a]]",
        # C q̇ divided back by q̇: a matrix of rank one.
        H + f"return np.outer(np.array({CHRISTOFFEL}) @ qd, qd) / (qd @ qd)",
        H + "return np.diag([h * (2 * b + b**2 / a), -h * a**2 / b])",
        INERTIA
        + "grad = np.array([qd @ by_difference(k) @ qd / 2 for k in range(2)])\n"
        + "return by_difference(1) * qd[1] - np.outer(grad, [1 / qd[0], 0])",
    ],
    "p2-christoffel": [
        SUM + "return sp.Matrix(n, n, c)",
        SUM + "return sp.ImmutableMatrix(n, n, c)",
        SUM + "return [[c(i, j) for j in range(n)] for i in range(n)]",
        SUM + "return tuple(tuple(c(i, j) for j in range(n)) for i in range(n))",
        SUM + "return np.array([[c(i, j) for j in range(n)] for i in range(n)])",
        SUM + "return sp.Array([[c(i, j) for j in range(n)] for i in range(n)])",
        SUM + "return sp.Matrix(n, n, c).expand()",
        SUM + "return sp.Matrix(n, n, c).applyfunc(sp.nsimplify)",
        # ½(Ṁ + (∂(M q̇)/∂q) − its transpose).
        "Mv = M * sp.Matrix(qd)\nG = Mv.jacobian(q)\n"
        "Mdot = sum((M.diff(x) * v for x, v in zip(q, qd, strict=True)), sp.zeros(len(q)))\n"
        "return (Mdot + G - G.T) / 2",
        # Derivatives that are named and not taken.
        "n = len(q)\ndef d(i, j, k):\n    return sp.Derivative(M[i, j], q[k])\n"
        "return sp.Matrix(n, n, lambda i, j: sum((d(i, j, k) + d(i, k, j) - d(j, k, i)) * qd[k] / 2\n"
        "                                        for k in range(n)))",
        # From the energy: half the Hessian of the velocity torque with respect to q̇.
        "v = sp.Matrix(qd)\nK = (v.T * M * v)[0] / 2\n"
        "p = [K.diff(w) for w in qd]\n"
        "tau = [sum(x.diff(y) * w for y, w in zip(q, qd, strict=True)) - K.diff(y)\n"
        "       for x, y in zip(p, q, strict=True)]\n"
        "return sp.Matrix([[t.diff(w) / 2 for w in qd] for t in tau])",
    ],
}
# Those that come nearest to a tolerance; of symbols any.
DELICATE = {
    "p2-M_dot": [FORWARD],
    "p2-C": [NUMERIC_CHRISTOFFEL],
    "p2-christoffel": [RIGHT["p2-christoffel"][0]],
}
