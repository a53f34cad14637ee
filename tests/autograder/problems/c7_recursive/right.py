"""Right answers about the two sweeps, a library, and counting, each found in another way."""

from tests.autograder.problems.c7_recursive.table import (
    COUNT,
    IN_BASE,
    RNEA,
    SIGN,
    TERMS,
    rnea,
    terms,
)

ROTATION = RNEA[: RNEA.index("def cross")]
SINGLE = """
from types import SimpleNamespace
single = np.float32
q, qd, qdd = map(single, (q, qd, qdd))
chain = SimpleNamespace(**{name: single(value) for name, value in vars(chain).items()})
"""
# Spatial vectors, angular part first.
SPATIAL = f"""{ROTATION}
def S(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])

def crossed(v):
    return np.block([[S(v[:3]), np.zeros((3, 3))], [S(v[3:]), S(v[:3])]])

n, X, I, s = len(q), [], [], []
for k in range(n):
    E, c, m = rotation(chain.axis[k], q[k]).T, S(chain.com[k]), chain.m[k]
    X.append(np.block([[E, np.zeros((3, 3))], [-E @ S(chain.offset[k]), E]]))
    I.append(np.block([[chain.I[k] - m * c @ c, m * c], [-m * c, m * np.eye(3)]]))
    s.append(np.concatenate([chain.axis[k], np.zeros(3)]))
v, a, f = np.zeros(6), np.concatenate([np.zeros(3), -chain.gravity]), []
for k in range(n):
    v = X[k] @ v + s[k] * qd[k]
    a = X[k] @ a + s[k] * qdd[k] + crossed(v) @ s[k] * qd[k]
    f.append(I[k] @ a - crossed(v).T @ (I[k] @ v))
u, carried = chain.viscous * qd, np.zeros(6)
for k in reversed(range(n)):
    carried = carried + f[k]
    u[k] += s[k] @ carried
    carried = X[k].T @ carried
return u
"""
# No sweep inwards: Σ Jᵀ of each link's force and moment, and gravity as a force.
JACOBIANS = f"""{ROTATION}
n, R, p = len(q), np.eye(3), np.zeros(3)
joints, u = [], np.array(chain.viscous * qd)
w, wd, a = np.zeros(3), np.zeros(3), np.zeros(3)
for k in range(n):
    r = R @ chain.offset[k]
    p, a = p + r, a + np.cross(wd, r) + np.cross(w, np.cross(w, r))
    R = R @ rotation(chain.axis[k], q[k])
    z, c, I = R @ chain.axis[k], R @ chain.com[k], R @ chain.I[k] @ R.T
    joints.append((z, p))
    wd, w = wd + qd[k] * np.cross(w, z) + qdd[k] * z, w + qd[k] * z
    F = chain.m[k] * (a + np.cross(wd, c) + np.cross(w, np.cross(w, c)) - chain.gravity)
    N = I @ wd + np.cross(w, I @ w)
    for j, (axis, at) in enumerate(joints):
        u[j] += np.cross(axis, p + c - at) @ F + axis @ N
return u
"""
# Euler and Lagrange, with the derivatives by complex and by central steps.
LAGRANGE = f"""{ROTATION}
def energies(q, qd):
    R, p, w, v, K, P = np.eye(3), np.zeros(3), np.zeros(3), np.zeros(3), 0, 0
    for k in range(len(q)):
        r = R @ chain.offset[k]
        p, v = p + r, v + np.cross(w, r)
        R = R @ rotation(chain.axis[k], q[k])
        w = w + R @ chain.axis[k] * qd[k]
        c, I = R @ chain.com[k], R @ chain.I[k] @ R.T
        vc = v + np.cross(w, c)
        K = K + (chain.m[k] * vc @ vc + w @ I @ w) / 2
        P = P - chain.m[k] * chain.gravity @ (p + c)
    return K, P

def rate_of(x, direction, part):
    e = 1e-30j
    return (part(x + e * direction)).imag / 1e-30

n, h = len(q), 1e-4
u = np.array(chain.viscous * qd)
for i, one in enumerate(np.eye(n)):
    def momentum(t):
        at, rate = q + t * qd + t * t / 2 * qdd, qd + t * qdd
        return rate_of(rate, one, lambda x: energies(at, x)[0])
    slopes = [(momentum(s * h) - momentum(-s * h)) / (2 * s * h) for s in (1, 2)]
    u[i] += (4 * slopes[0] - slopes[1]) / 3
    u[i] -= rate_of(q, one, lambda x: energies(x, qd)[0] - energies(x, qd)[1])
return u
"""


def returning(what):
    return terms("M, c, g, f", what)


RIGHT = {
    "c7-rnea": [
        RNEA,
        IN_BASE,
        SPATIAL,
        JACOBIANS,
        LAGRANGE,
        f"{SINGLE}{RNEA}",
        # The weight as a force on each link, and a base at rest.
        rnea(
            "np.zeros(3), np.zeros(3), -chain.gravity",
            "np.zeros(3), np.zeros(3), np.zeros(3)",
            "F, N = [], []",
            "F, N, down = [], [], chain.gravity",
            "w, wd = R[k].T @ w",
            "down = R[k].T @ down\n    w, wd = R[k].T @ w",
            "F.append(m * ac)",
            "F.append(m * ac - m * down)",
        ),
        # About the joint: the inertia carried over, and the joint's own acceleration.
        rnea(
            "N.append(",
            "J = I + m * (c @ c * np.eye(3) - np.outer(c, c))\n    N.append(m * cross(c, a) + J @ wd "
            "+ cross(w, J @ w)) or (lambda *_: 0)(",
            " + cross(chain.com[k], F[k])",
            "",
        ),
        rnea("return u", "return u[:, None].tolist()"),
    ],
    "c7-terms": [
        TERMS,
        "o = 0.0 * q\ng = library(q, o, o)\n"
        "b = lambda v: library(q, v, o) - g\n"
        "M = [[(library(q, o, ei) - g) @ ej for ei in np.eye(len(q))] for ej in np.eye(len(q))]\n"
        "return M, list((b(qd) + b(-qd)) / 2), list(g), list((b(qd) - b(-qd)) / 2)",
        # By size: b(2v) has four times C q̇ and twice f.
        "o = 0 * q\ng = library(q, o, o)\nb, b2 = (library(q, s * qd, o) - g for s in (1, 2))\n"
        "M = np.column_stack([(library(q, o, 9 * e) - g) / 9 for e in np.eye(len(q))])\n"
        "return M, (b2 - 2 * b) / 2, g, b - (b2 - 2 * b) / 2",
        # M from its differences in motion; f joint by joint.
        "n = len(q)\nl = lambda v, a: np.asarray(library(q, v, a))\n"
        "base = l(qd, np.zeros(n))\n"
        "M = np.array([l(qd, e) - base for e in np.eye(n)])\ng = l(np.zeros(n), np.zeros(n))\n"
        "f = sum((l(v, np.zeros(n)) - l(-v, np.zeros(n))) / 2 for v in np.diag(qd))\n"
        "return [M, base - g - f, g, f]",
        returning("list(map(np.float32, (M, c, g, f)))"),
        returning("M, c[:, None], g[None], f.tolist()"),
        returning("[sp.Matrix(M), sp.Matrix(c), sp.Matrix(g), sp.Matrix(f)]"),
        # With q̈ = −q̈ to take gravity away.
        "o = 0 * q\ng = library(q, o, o)\n"
        "M = np.column_stack([(library(q, o, e) - library(q, o, -e)) / 2 for e in np.eye(len(q))])\n"
        "up, down = library(q, qd, o), library(q, -qd, o)\n"
        "return M, (up + down) / 2 - g, g, (up - down) / 2",
        # From one q̇ and its inverse, and solved as a linear system.
        "o = 0 * q\ns = [0, 1, -1, 3]\nA = np.array([[1, x, x * x] for x in s])\n"
        "g, f, c = np.linalg.lstsq(A, np.array([library(q, x * qd, o) for x in s]))[0]\n"
        "M = np.array([library(q, o, e) - g for e in np.eye(len(q))])\nreturn M, c, g, f",
        terms("(b1 + b2) / 2", "b1 - (b1 - b2) / 2"),
    ],
    "c7-gravity_sign": [
        SIGN,
        "o = np.zeros(2)\nw = library(o, o, o)[1]\ni = library(o, o, np.array([0, 1.0]))[1] - w\n"
        "if abs(w) < 1e-9:\n    return 0\nreturn 1 if (w > 0) == (i > 0) else -1",
        # From the column's inertia, which no gravity touches.
        "o = np.zeros(2)\nreturn [np.sign(library(o, o, o)[1] * library(o, o, np.array([1.0, 0]))[0])]",
        # From the friction, which resists.
        "o = np.zeros(2)\nw = library(o, o, o)[1]\n"
        "return int(np.sign(w) * np.sign((library(o, np.array([0, 1.0]), o)[1] - w)))",
        # Over the top, where the weight pulls the other way.
        "o, q = np.zeros(2), np.array([0.3, np.pi])\nw = library(q, o, o)[1]\n"
        "return -np.sign(w) * np.sign(library(q, o, np.ones(2))[1] - w)",
    ],
    "c7-count": [
        COUNT,
        "return np.array([24 * n + 11 * n * (n + 1) // 2, 37 * n])",
        "direct = 0\nfor k in range(n):\n    direct += 24 + 11 * (n - k)\nreturn direct, 37 * n",
        "return [[(11 * n**2 + 59 * n) / 2, 37.0 * n]]",
    ],
}
# Those that come nearest to a tolerance.
DELICATE = {
    "c7-rnea": [f"{SINGLE}{RNEA}"],
    "c7-terms": [RIGHT["c7-terms"][4]],
    "c7-gravity_sign": [RIGHT["c7-gravity_sign"][4]],
}
