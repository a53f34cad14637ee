"""Right answers about controllers, each found in another way."""

from tests.autograder.problems.c8_control.table import MATRICES, REGRESSOR, Y, hold, law, rate

SINGLE = "q, qd = np.float32(q), np.float32(qd)\n"
# M, the Christoffel C and g of an arm made of π, by numbers.
OF_PI = """
def terms(q, qd, l1, g, m1, b1, J1, m2, b2, J2):
    c, h = l1 * b2 * np.cos(q[1]), -l1 * b2 * np.sin(q[1])
    M = np.array([[J1 + J2 + m2 * l1**2 + 2 * c, J2 + c], [J2 + c, J2]])
    C = h * np.array([[qd[1], qd[0] + qd[1]], [-qd[0], 0]])
    g2 = b2 * g * np.cos(q[0] + q[1])
    return M, C, np.array([(b1 + m2 * l1) * g * np.cos(q[0]) + g2, g2])
"""
TAU = f"""{OF_PI}
def tau(pi):
    M, C, g_vec = terms(q, qd, arm.l1, arm.g, *pi)
    return M @ qdd_r + C @ qd_r + g_vec
"""
# C(q, q̇) q̇r of the Christoffel C as the polar form of C(q, q̇) q̇, a quadratic form of q̇.
POLARISED = f"""{Y().replace("return np", "whole = np")}
def bias(v):
    s2 = arm.l1 * np.sin(q[1])
    return np.array([-s2 * (2 * v[0] * v[1] + v[1]**2), s2 * v[0]**2])
Y = np.array(whole, dtype=float)
Y[:, 4] += (bias(qd + qd_r) - bias(qd - qd_r)) / 4
Y[0, 4] += arm.l1 * s2 * products
Y[1, 4] -= arm.l1 * s2 * v1 * r1
return Y
"""
RIGHT = {
    "c8-gravity_compensation": [
        hold(),
        f"{SINGLE}{hold()}",
        f"{MATRICES}return (g_vec(q) - np.diag(arm.kp) @ (q - q_star) - np.diag(arm.kd) @ qd).tolist()",
        f"{MATRICES}\nu = g_vec(q)\nfor i in range(2):\n"
        "    u[i] += arm.kp[i] * (q_star[i] - q[i])\n    u[i] -= arm.kd[i] * qd[i]\nreturn u[:, None]",
        f"""{MATRICES}
def P(q):
    y2 = arm.l1 * np.sin(q[0]) + arm.lc2 * np.sin(q[0] + q[1])
    spring = arm.kp @ (q - q_star)**2 / 2
    return arm.g * (arm.m1 * arm.lc1 * np.sin(q[0]) + arm.m2 * y2) - spring
d = 1e-5 * np.eye(2)
return np.array([(P(q + d[i]) - P(q - d[i])) / 2e-5 - arm.kd[i] * qd[i] for i in range(2)])
""",
    ],
    "c8-regressor_r": [
        Y(),
        f"{SINGLE}{Y()}",
        f"{TAU}return np.array([tau(e) for e in np.eye(6)]).T",
        f"{TAU}return np.array([(tau(1 + d) - tau(1 - d)) / 2e-3 for d in 1e-3 * np.eye(6)]).T",
        POLARISED,
        f"""{OF_PI}
pi = sp.symbols("m1 b1 J1 m2 b2 J2")
M, C, g_vec = terms(q, qd, arm.l1, arm.g, *pi)
return (sp.Matrix(M) * sp.Matrix(qdd_r) + sp.Matrix(C) * sp.Matrix(qd_r) + sp.Matrix(g_vec)).jacobian(pi)
""",
    ],
    "c8-slotine_li": [
        law(),
        f"{SINGLE}{law()}",
        law(both="[*u, *rate]"),
        law(qd_r="ref.qd - np.dot(gains.Lam, q - ref.q)", rate="-s @ Y @ gains.Gamma"),
        law(
            qd_r="ref.qd + gains.Lam @ (ref.q - q)",
            qdd_r="ref.qdd + gains.Lam @ (ref.qd - qd)",
            s="qd_r - qd",
            u="Y.dot(pi_hat) + gains.KD.dot(s)",
            rate="gains.Gamma.dot(Y.T).dot(s)",
        ),
        law(
            s="ed + gains.Lam @ e",
            rate="-np.einsum('ij,kj,k->i', gains.Gamma, Y, s)",
            both="np.hstack([u, rate])[None]",
        ),
        f"{REGRESSOR}\n"
        "u, rate = np.zeros(2), np.zeros(6)\n"
        "r = [ref.qd[i] - sum(gains.Lam[i, j] * (q[j] - ref.q[j]) for j in (0, 1)) for i in (0, 1)]\n"
        "a = [ref.qdd[i] - sum(gains.Lam[i, j] * (qd[j] - ref.qd[j]) for j in (0, 1)) for i in (0, 1)]\n"
        "Y, s = Y_of(q, qd, r, a), qd - np.array(r)\n"
        "for i in range(2):\n"
        "    for k in range(6):\n        u[i] += Y[i, k] * pi_hat[k]\n"
        "        rate -= gains.Gamma[:, k] * Y[i, k] * s[i]\n"
        "    u[i] -= gains.KD[i] @ s\n"
        "return np.append(u, rate)",
    ],
    "c8-V_dot": [
        rate("-D + R - F"),
        f"{SINGLE}{rate('[[-D + R - F]]')}",
        rate("float(s @ (N / 2 - C_used - K) @ s)"),
        rate("-np.trace(np.outer(s, s) @ (K - (N - C_used - C_used.T) / 2))"),
        f"""{MATRICES}
def along(t):
    return s @ M(q + t * qd) @ s / 2
return [(along(1e-5) - along(-1e-5)) / 2e-5 - s @ (gains.KD + C_used) @ s]
""",
    ],
}
# Those that come nearest to a tolerance.
DELICATE = {
    "c8-regressor_r": [RIGHT["c8-regressor_r"][1]],
    "c8-slotine_li": [RIGHT["c8-slotine_li"][1]],
}
