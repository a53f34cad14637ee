"""Right answers about gravity, each found in another way."""

HEIGHTS = (
    "s1, s12 = np.sin(q[0]), np.sin(q[0] + q[1])\n"
    "y1, y2 = arm.lc1 * s1, arm.l1 * s1 + arm.lc2 * s12\n"
)
P = f"{HEIGHTS}return arm.g * (arm.m1 * y1 + arm.m2 * y2)"
TORQUE = (
    "g2 = arm.m2 * arm.lc2 * arm.g * np.cos(q[0] + q[1])\n"
    "g1 = (arm.m1 * arm.lc1 + arm.m2 * arm.l1) * arm.g * np.cos(q[0]) + g2\n"
)
NESTED_P = "def P(q):\n" + "".join(f"    {line}\n" for line in P.splitlines())
SYMBOLIC = """
q1, q2 = sp.symbols("q1 q2")
y1 = arm.lc1 * sp.sin(q1)
y2 = arm.l1 * sp.sin(q1) + arm.lc2 * sp.sin(q1 + q2)
P = arm.g * (arm.m1 * y1 + arm.m2 * y2)
"""
JACOBIANS = """
s1, c1, s12, c12 = np.sin(q[0]), np.cos(q[0]), np.sin(q[0] + q[1]), np.cos(q[0] + q[1])
J1 = np.array([[-arm.lc1 * s1, 0], [arm.lc1 * c1, 0]])
J2 = np.array([[-arm.l1 * s1 - arm.lc2 * s12, -arm.lc2 * s12],
               [arm.l1 * c1 + arm.lc2 * c12, arm.lc2 * c12]])
down = np.array([0, -arm.g])
return -arm.m1 * J1.T @ down - arm.m2 * J2.T @ down
"""
COMPLEX_STEP = """
def P(q1, q2):
    y1 = arm.lc1 * np.sin(q1)
    y2 = arm.l1 * np.sin(q1) + arm.lc2 * np.sin(q1 + q2)
    return arm.g * (arm.m1 * y1 + arm.m2 * y2)

return P(q[0] + 1e-30j, q[1]).imag / 1e-30, P(q[0], q[1] + 1e-30j).imag / 1e-30
"""
ROOTS = f"""
def g(q):
    {TORQUE.replace(chr(10), chr(10) + "    ")}
    return [g1, g2]

found = []
for start in ((1.2, 0.3), (1.9, 2.9), (-1.2, -0.2), (-1.8, 3.3)):
    found.append(scipy.optimize.fsolve(g, start, xtol=1e-10))
return found
"""
RIGHT = {
    "p4-potential_energy": [
        f"{HEIGHTS}return np.array([[arm.g * (arm.m1 * y1 + arm.m2 * y2)]])",
        f"{HEIGHTS}return arm.m1 * arm.g * (y1 + arm.lc1) + arm.m2 * arm.g * (y2 + arm.l1 + arm.lc2)",
        f"{HEIGHTS}return 1000 + arm.g * (arm.m1 * y1 + arm.m2 * y2)",
        f"{HEIGHTS}return np.dot([arm.m1, arm.m2], [y1, y2]) * arm.g",
        f"{HEIGHTS}down = np.array([0, -arm.g])\n"
        "return -sum(m * down @ p for m, p in ((arm.m1, [7, y1]), (arm.m2, [-3, y2])))",
        "z1 = np.exp(1j * q[0])\nz2 = arm.l1 * z1 + arm.lc2 * np.exp(1j * (q[0] + q[1]))\n"
        "return arm.g * (arm.m1 * arm.lc1 * z1 + arm.m2 * z2).imag",
        f"{SYMBOLIC}return P.subs({{q1: q[0], q2: q[1]}})",
        "return (arm.m1*arm.lc1 + arm.m2*arm.l1)*arm.g*np.cos(q[0] - np.pi/2) - 2*arm.m2*arm.lc2*"
        "arm.g*np.sin(np.pi/4 - (q[0] + q[1])/2)**2",
    ],
    "p4-g_vec": [
        f"{TORQUE}return [g1, g2]",
        JACOBIANS,
        COMPLEX_STEP,
        f"{SYMBOLIC}return [sp.diff(P, angle).subs({{q1: q[0], q2: q[1]}}) for angle in (q1, q2)]",
        f"{SYMBOLIC}g = sp.Matrix([P]).jacobian([q1, q2])\nreturn sp.lambdify((q1, q2), g)(*q)",
        f"{NESTED_P}return [(P(q + d) - P(q - d)) / 2e-6 for d in 1e-6 * np.eye(2)]",
        f"{NESTED_P}return [(P(q + d) - P(q)) / 1e-8 for d in 1e-8 * np.eye(2)]",
    ],
    "p4-gravity_from_jacobians": [
        "return -sum(m * Jv.T @ g0 for m, Jv in zip(masses, jacobians_v))",
        "return -np.tensordot(masses, jacobians_v, 1).T @ g0",
        "return -(masses @ (g0 @ jacobians_v))",
        "return -np.sum(masses[:, None] * (np.transpose(jacobians_v, (0, 2, 1)) @ g0), axis=0)",
        "return [float(-sum(masses * (jacobians_v[:, :, j] @ g0)))"
        " for j in range(jacobians_v.shape[2])]",
        "J, w = np.vstack(jacobians_v), np.kron(masses, g0)\nreturn -J.T @ w[:, None]",
        "J, m = np.float32(jacobians_v), np.float32(masses)\n"
        "return -np.einsum('l,lin,i->n', m, J, np.float32(g0))",
        "up = -g0\nreturn sum(m * up @ Jv for m, Jv in zip(masses, jacobians_v))",
        "def P(dq):\n    return -sum(m * g0 @ (Jv @ dq) for m, Jv in zip(masses, jacobians_v))\n"
        "return [P(e) for e in np.eye(jacobians_v.shape[2])]",
    ],
    "p4-equilibria": [
        "return np.array([[np.pi/2, 0], [-np.pi/2, 0], [np.pi/2, np.pi], [-np.pi/2, np.pi]])",
        "return [(a, b) for a in (np.pi/2, 3*np.pi/2) for b in (0, -np.pi)]",
        "return [[-np.pi/2, 3*np.pi], [np.pi/2, 2*np.pi], [5*np.pi/2, -np.pi], [-np.pi/2, -2*np.pi]]",
        "return [(a, d - a) for a in (1.5*np.pi, 0.5*np.pi) for d in (1.5*np.pi, 0.5*np.pi)]",
        "return np.float32([[np.pi/2, 0], [3*np.pi/2, 0], [np.pi/2, np.pi], [3*np.pi/2, np.pi]])",
        "return [(s * sp.pi/2, k * sp.pi) for s in (-1, 1) for k in (0, 1)]",
        "return np.reshape([np.pi/2, 0, -np.pi/2, 0, np.pi/2, np.pi, -np.pi/2, np.pi], (4, 2, 1))",
        "return [(np.arccos(s * 0.0) * s, np.arccos(k)) for s in (-1, 1) for k in (-1, 1)]",
        "return [(a, b) for a in (-np.pi/2, np.pi/2) for b in (-np.pi, 0, np.pi)]",
        ROOTS,
    ],
}  # fmt: skip
# Those that come nearest to a tolerance.
DELICATE = {"p4-gravity_from_jacobians": [RIGHT["p4-gravity_from_jacobians"][6]]}
