"""Right answers about Y, ranks and fits, each found in another way."""

# The equation of motion, as the notebook gives it, and arms made of π: links of these m, m ℓc, J.
TORQUES = """
def torques(q, qd, qdd, l1, g, m1, mc1, J1, m2, mc2, J2):
    c2, s2, c12 = np.cos(q[1]), np.sin(q[1]), np.cos(q[0] + q[1])
    M = np.array([[J1 + J2 + m2 * l1**2 + 2 * l1 * mc2 * c2, J2 + l1 * mc2 * c2],
                  [J2 + l1 * mc2 * c2, J2]])
    h = -l1 * mc2 * s2
    C = h * np.array([[qd[1], qd[0] + qd[1]], [-qd[0], 0]])
    g2 = mc2 * g * c12
    return M @ qdd + C @ qd + [(mc1 + m2 * l1) * g * np.cos(q[0]) + g2, g2]
"""
ENTRIES = """
l1, g = arm.l1, arm.g
(q1, q2), (v1, v2), (a1, a2) = q, qd, qdd
c1, c2, s2, c12 = np.cos(q1), np.cos(q2), np.sin(q2), np.cos(q1 + q2)
top = [0, g*c1, a1, l1**2*a1 + l1*g*c1, l1*(c2*(2*a1 + a2) - s2*(2*v1*v2 + v2**2)) + g*c12, a1 + a2]
low = [0, 0, 0, 0, l1*(c2*a1 + s2*v1**2) + g*c12, a1 + a2]
"""
LINK_BY_LINK = """
def planar_link(angle, rate, spin, joint_dd):
    x = np.array([np.cos(angle), np.sin(angle)])
    y = np.array([-x[1], x[0]])
    x_dd = spin * y - rate**2 * x
    cross = lambda a, b: a[0] * b[1] - a[1] * b[0]
    forces = [joint_dd, x_dd, 0 * x]
    return forces, [0, cross(x, joint_dd), spin], x, x_dd

up = np.array([0, arm.g])
f1, n1, x1, x1_dd = planar_link(q[0], qd[0], qdd[0], up)
f2, n2, _, _ = planar_link(q.sum(), qd.sum(), qdd.sum(), up + arm.l1 * x1_dd)
elbow = arm.l1 * x1
carried = [n + elbow[0] * f[1] - elbow[1] * f[0] for n, f in zip(n2, f2)]
return [[*n1, *carried], [0, 0, 0, *n2]]
"""
LAGRANGE = """
def parts(q, qd):
    s = np.array([np.sin(q[0]), np.sin(q[0] + q[1])])
    w = np.array([qd[0], qd[0] + qd[1]])
    elbow = arm.l1 * w[0]
    K = [0, 0, w[0]**2/2, elbow**2/2, elbow * w[1] * np.cos(q[1]), w[1]**2/2]
    P = [0, arm.g*s[0], 0, arm.g*arm.l1*s[0], arm.g*s[1], 0]
    return np.array(K), np.array(P)

def momentum(i, q, qd, e=1e-3):
    d = e * np.eye(2)[i]
    return (parts(q, qd + d)[0] - parts(q, qd - d)[0]) / (2 * e)

Y, e = np.zeros((2, 6)), 1e-5
for i in range(2):
    d = e * np.eye(2)[i]
    later, before = (momentum(i, q + s*e*qd, qd + s*e*qdd) for s in (1, -1))
    (Kp, Pp), (Km, Pm) = parts(q + d, qd), parts(q - d, qd)
    Y[i] = (later - before) / (2 * e) - (Kp - Km) / (2 * e) + (Pp - Pm) / (2 * e)
return Y
"""
SYMBOLIC = """
q1, q2, v1, v2, a1, a2, *pi = sp.symbols("q1 q2 v1 v2 a1 a2 m1 b1 J1 m2 b2 J2")
m1, b1, J1, m2, b2, J2 = pi
l, g = arm.l1, arm.g
M11 = J1 + J2 + m2 * l**2 + 2 * l * b2 * sp.cos(q2)
M12 = J2 + l * b2 * sp.cos(q2)
h = -l * b2 * sp.sin(q2)
P = g * (b1 * sp.sin(q1) + m2 * l * sp.sin(q1) + b2 * sp.sin(q1 + q2))
tau = sp.Matrix([M11*a1 + M12*a2 + h*(2*v1*v2 + v2**2), M12*a1 + J2*a2 - h*v1**2])
Y = (tau + sp.Matrix([P]).jacobian([q1, q2]).T).jacobian(pi)
"""
STATE = "dict(zip((q1, q2, v1, v2, a1, a2), (*q, *qd, *qdd)))"
# Rows of all samples for the other two questions, with the regressor above.
ROWS = "def regressor(q, qd, qdd, arm):\n" + "".join(
    f"    {line}\n" for line in [*ENTRIES.strip().splitlines(), "return np.array([top, low])"]
)
W = f"{ROWS}W = np.vstack([regressor(*s, arm) for s in zip(q, qd, qdd)])\n"
WB = f"{W}W, t = W[:, [1, 2, 4, 5]], np.ravel(u)\n"
SINGLE = "q, qd, qdd = map(np.float32, (q, qd, qdd))\n"
RIGHT = {
    "c6-regressor": [
        f"{SINGLE}{ENTRIES}return np.float32([top, low])",
        f"{ENTRIES}return list(zip(top, low)) and tuple(map(tuple, (top, low)))",
        f"{TORQUES}return np.array([torques(q, qd, qdd, arm.l1, arm.g, *e) for e in np.eye(6)]).T",
        f"{TORQUES}tau = lambda p: torques(q, qd, qdd, arm.l1, arm.g, *p)\n"
        "return np.array([(tau(1 + d) - tau(1 - d)) / 2e-3 for d in 1e-3 * np.eye(6)]).T",
        LINK_BY_LINK,
        LAGRANGE,
        f"{SYMBOLIC}return Y.subs({STATE})",
        f"{SYMBOLIC}return sp.lambdify((q1, q2, v1, v2, a1, a2), Y)(*q, *qd, *qdd)",
        "z1, z2 = np.exp(1j * q[0]), np.exp(1j * q.sum())\n"
        "acc = lambda z, w, a: (1j * a - w**2) * z\n"
        "e_dd = arm.l1 * acc(z1, qd[0], qdd[0]) + 1j * arm.g\n"
        "z2_dd = acc(z2, qd.sum(), qdd.sum())\n"
        "dot = lambda v, f: (np.conj(v) * f).real\n"
        "n2 = dot(1j * z2, e_dd)\n"
        "return [[0, dot(1j * z1, 1j * arm.g), qdd[0], dot(1j * arm.l1 * z1, e_dd), "
        "n2 + dot(1j * arm.l1 * z1, z2_dd), qdd.sum()], [0, 0, 0, 0, n2, qdd.sum()]]",
    ],
    "c6-rank_of_excitation": [
        f"{W}return np.linalg.matrix_rank(W)",
        f"{W}s = np.linalg.svd(W, compute_uv=False)\nreturn int((s > 1e-10 * s[0]).sum())",
        f"{W}return np.linalg.matrix_rank(W, tol=1e-6)",
        f"{W}return float(np.linalg.matrix_rank(W.T @ W, rtol=1e-10))",
        f"{W}return [np.linalg.matrix_rank(W[:, [1, 2, 4, 5]])]",
        f"{W}return np.linalg.matrix_rank(np.float32(W))",
        f"{W}R = scipy.linalg.qr(W, pivoting=True)[1]\nd = abs(np.diag(R))\n"
        "return np.sum(d > 1e-9 * d[0])",
        f"{W}return 6 - scipy.linalg.null_space(W, rcond=1e-9).shape[1]",
        f"{W}return scipy.linalg.orth(W, rcond=1e-9).shape[1]",
        f"{W}return np.sum(np.linalg.eigvalsh(W.T @ W) > 1e-8)",
        f"{W}r = np.linalg.lstsq(W, np.ones(len(W)), rcond=1e-9)[2]\nreturn np.array([[r]])",
        f"{W}kept = []\nfor c in W.T:\n"
        "    for _ in range(2):\n        for k in kept:\n            c = c - k * (k @ c)\n"
        "    if np.linalg.norm(c) > 1e-6:\n        kept.append(c / np.linalg.norm(c))\n"
        "return len(kept)",
    ],
    "c6-identify": [
        f"{WB}return np.linalg.lstsq(W, t)[0]",
        f"{WB}return np.linalg.pinv(W) @ t",
        f"{WB}return list(np.linalg.solve(W.T @ W, W.T @ t))",
        f"{WB}Q, R = np.linalg.qr(W)\nreturn scipy.linalg.solve_triangular(R, Q.T @ t)[:, None]",
        f"{WB}return np.linalg.lstsq(np.float32(W), np.float32(t))[0]",
        f"{WB}return scipy.optimize.least_squares(lambda b: W @ b - t, np.zeros(4), xtol=1e-12, "
        "ftol=1e-12, gtol=1e-12).x",
        f"{W}p = np.linalg.lstsq(W, np.ravel(u), rcond=1e-9)[0]\n"
        "return p[1] + arm.l1 * p[3], p[2] + arm.l1**2 * p[3], p[4], p[5]",
        f"{ROWS}Y = [regressor(*s, arm)[:, [1, 2, 4, 5]] for s in zip(q, qd, qdd)]\n"
        "return np.linalg.solve(sum(y.T @ y for y in Y), sum(y.T @ t for y, t in zip(Y, u)))",
        f"{WB}A = np.r_[W[::2], W[1::2]]\nreturn np.linalg.lstsq(A, u.ravel(order='F'))[0]",
        f"{WB}P, b = 1e9 * np.eye(4), np.zeros(4)\nfor w, y in zip(W, t):\n"
        "    k = P @ w / (1 + w @ P @ w)\n    b, P = b + k * (y - w @ b), P - np.outer(k, w @ P)\n"
        "return b + np.linalg.lstsq(W, t - W @ b)[0]",
        f"{WB}size = np.linalg.norm(W, axis=0)\nreturn np.linalg.lstsq(W / size, t)[0] / size",
    ],
}
# Those that come nearest to a tolerance.
DELICATE = {
    "c6-regressor": [RIGHT["c6-regressor"][0]],
    "c6-rank_of_excitation": [f"{W}return np.linalg.matrix_rank(np.float32(W))"],
    "c6-identify": [f"{WB}return np.linalg.lstsq(np.float32(W), np.float32(t))[0]"],
}
