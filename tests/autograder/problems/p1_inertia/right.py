"""Right answers about inertia, each found in another way."""

CLOSED = """
k = arm.m2 * arm.l1 * arm.lc2 * np.cos(q[1])
b = arm.I2 + arm.m2 * arm.lc2**2
a = arm.I1 + arm.m1 * arm.lc1**2 + arm.m2 * arm.l1**2
"""
# Velocities of the centres of mass as functions of q̇, for M through the energy.
ENERGY = """
def K(qd):
    w1, w2 = qd[0], qd[0] + qd[1]
    vx = -arm.l1 * np.sin(q[0]) * w1 - arm.lc2 * np.sin(q[0] + q[1]) * w2
    vy = arm.l1 * np.cos(q[0]) * w1 + arm.lc2 * np.cos(q[0] + q[1]) * w2
    translation = arm.m1 * (arm.lc1 * w1)**2 + arm.m2 * (vx**2 + vy**2)
    return 0.5 * (translation + arm.I1 * w1**2 + arm.I2 * w2**2)
e = np.eye(2)
"""
JACOBIANS = """
s1, s12, c1, c12 = np.sin(q[0]), np.sin(sum(q)), np.cos(q[0]), np.cos(sum(q))
J1 = np.array([[-arm.lc1 * s1, 0], [arm.lc1 * c1, 0]])
J2 = np.array([[-arm.l1 * s1 - arm.lc2 * s12, -arm.lc2 * s12],
               [arm.l1 * c1 + arm.lc2 * c12, arm.lc2 * c12]])
w1, w2 = np.array([[1, 0]]), np.array([[1, 1]])
"""
SYMBOLIC = """
a, b, c, d = sp.symbols("a b c d", real=True)
P1 = sp.Matrix([arm.lc1 * sp.cos(a), arm.lc1 * sp.sin(a)])
P2 = sp.Matrix([arm.l1 * sp.cos(a) + arm.lc2 * sp.cos(a + b),
                arm.l1 * sp.sin(a) + arm.lc2 * sp.sin(a + b)])
speed = lambda P: P.jacobian([a, b]) * sp.Matrix([c, d])
K = arm.m1 * speed(P1).dot(speed(P1)) / 2 + arm.m2 * speed(P2).dot(speed(P2)) / 2
K += arm.I1 * c**2 / 2 + arm.I2 * (c + d)**2 / 2
H = sp.hessian(K, (c, d))
"""
POSITIONS = """
def centres(q):
    elbow = arm.l1 * np.array([np.cos(q[0]), np.sin(q[0])])
    along = np.array([np.cos(q[0] + q[1]), np.sin(q[0] + q[1])])
    return np.concatenate([arm.lc1 / arm.l1 * elbow, elbow + arm.lc2 * along])
h = 1e-6
J = np.array([(centres(q + h * e) - centres(q - h * e)) / (2 * h) for e in np.eye(2)]).T
J = np.vstack([J, [[1, 0], [1, 1]]])
"""
PAIRS = "for J, I in zip(jacobians, inertias)"
SPD = "np.allclose(A, A.T)"
ARM = {"l1": 1.0, "l2": 0.8, "lc1": 0.0, "lc2": 0.4, "m1": 2, "m2": 3, "I1": 0, "I2": 0, "g": 9.81}

INSIDE = (
    "J, I = np.float32(jacobians), np.float32(inertias)\n"
    "return np.sum([j.T @ i @ j for j, i in zip(J, I)], axis=0)"
)

RIGHT = {
    "p1-inertia_from_links": [
        f"sum(J.T @ I @ J {PAIRS})",
        "(jacobians.transpose(0, 2, 1) @ inertias @ jacobians).sum(axis=0)",
        INSIDE,
        f"sum((np.linalg.cholesky(I).T @ J).T @ (np.linalg.cholesky(I).T @ J) {PAIRS})",
        "L, _, n = jacobians.shape\nM = np.zeros((n, n))\nfor k in range(L):\n"
        "    for i in range(n):\n        for j in range(n):\n"
        "            M[i, j] += jacobians[k][:, i] @ inertias[k] @ jacobians[k][:, j]\nreturn M",
        "import functools\nfrom operator import add\n"
        f"return functools.reduce(add, [J.T @ (I @ J) {PAIRS}])",
        "J = jacobians.reshape(-1, jacobians.shape[2])\nI = np.zeros((len(J), len(J)))\n"
        "for k, i in enumerate(inertias):\n    I[6 * k:6 * k + 6, 6 * k:6 * k + 6] = i\n"
        "return J.T @ I @ J",
        f"M = sum(J.T @ I @ J {PAIRS})\nreturn M.item() if M.size == 1 else M",
    ],
    "p1-M": [
        CLOSED + "return ((a + b + 2 * k, b + k), (b + k, b))",
        CLOSED + "T = np.array([[1, 0], [1, 1]])\nreturn T.T @ np.array([[a, k], [k, b]]) @ T",
        ENERGY + "return [[K(a + b) - K(a) - K(b) for a in e] for b in e]",
        ENERGY
        + "h = 1e-3\nreturn [[(K(h * (a + b)) - K(h * (a - b)) - K(h * (b - a)) + K(-h * (a + b)))"
        " / (4 * h * h) for a in e] for b in e]",
        JACOBIANS + "return (arm.m1 * J1.T @ J1 + arm.m2 * J2.T @ J2 + arm.I1 * w1.T @ w1"
        " + arm.I2 * w2.T @ w2)",
        POSITIONS + "return J.T @ np.diag([arm.m1] * 2 + [arm.m2] * 2 + [arm.I1, arm.I2]) @ J",
        SYMBOLIC + "return sp.lambdify((a, b), H, 'numpy')(*q)",
        SYMBOLIC + "return H.subs({a: q[0], b: q[1]})",
    ],
    "p1-is_spd": [
        f"{SPD} and np.linalg.eigvalsh(A)[0] > 1e-9 * np.linalg.eigvalsh(A)[-1]",
        f"{SPD} and all(np.linalg.eigvalsh(A) > 1e-9)",
        f"bool({SPD} and np.all(np.linalg.eigvals(A) > 1e-8))",
        f"int({SPD} and np.linalg.eigvalsh(A).min() > 1e-10)",
        "np.abs(A - A.T).max() < 1e-12 * np.abs(A).max() and np.linalg.eigvalsh(A)[0] > 1e-12",
        f"if not {SPD}:\n    return False\ntry:\n"
        "    np.linalg.cholesky(A - 1e-9 * np.max(np.abs(A)) * np.eye(len(A)))\n"
        "except np.linalg.LinAlgError:\n    return False\nreturn True",
        f"{SPD} and all(np.linalg.det(A[:k, :k]) > 1e-9 for k in range(1, len(A) + 1))",
        f"np.array([{SPD} and np.linalg.eigvalsh(A)[0] > 1e-9])",
        f"float({SPD} and np.linalg.eigvalsh(A)[0] > 1e-6)",
        "values, vectors = np.linalg.eig((A + A.T) / 2)\n"
        "return np.linalg.norm(A - A.T) < 1e-6 and values.min() / values.max() > 1e-9"
        " and values.max() > 0",
        "A = np.round(A, 9)\n"
        "return bool((A == A.T).all() and (np.linalg.svd(A)[1] > 1e-8).all()"
        " and (np.linalg.eigvalsh(A) > 0).all())",
    ],
    "p1-singular_arm": [
        f"{ARM}, [0, np.pi]",
        f"{ARM}, (0.4, 0)",
        f"[{ARM}, np.array([0.4, -np.pi])]",
        f"{ARM}, np.array([[0.4], [2 * np.pi]])",
        f"{ARM}, np.float32([0.4, np.pi])",
        f"{ARM | {'lc2': 1.0}}, [0, sp.pi]",
        f"{ARM | {'lc2': 0, 'lc1': 0.5, 'I1': 0.3}}, [0.3, 1.0]",
        f"{ARM | {'lc2': 0.0, 'lc1': 0.0}}, (1, 2)",
        f"from types import SimpleNamespace\nreturn SimpleNamespace(**{ARM}), [0, np.pi]",
        f"{ {name: [value] for name, value in ARM.items()} }, [0, 3.14159265]",
        f"{ {name: value for name, value in ARM.items() if name != 'g'} }, [0, 0]",
    ],
}
# Those that come nearest to a tolerance.
DELICATE = {"p1-inertia_from_links": [INSIDE], "p1-is_spd": [RIGHT["p1-is_spd"][k] for k in (0, 4)]}
