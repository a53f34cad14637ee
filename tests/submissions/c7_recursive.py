"""Submissions to c7-recursive, made from the released notebook by editing it as a student would."""

from tests.submissions.answers import Answers, answered, cell_of

RIGHT = Answers(
    {
        "rnea": """
def rnea(q, qd, qdd, chain):
    # everything in the axes of the base
    n, R = len(q), np.eye(3)
    w, wd, p, a = np.zeros(3), np.zeros(3), np.zeros(3), -chain.gravity
    zs, ps, cs, Fs, Ns = [], [], [], [], []
    for k in range(n):
        r = R @ chain.offset[k]
        a = a + np.cross(wd, r) + np.cross(w, np.cross(w, r))
        p = p + r
        R = R @ rotation(chain.axis[k], q[k])
        z, c = R @ chain.axis[k], R @ chain.com[k]
        I = R @ chain.I[k] @ R.T
        wd = wd + qd[k] * np.cross(w, z) + qdd[k] * z
        w = w + qd[k] * z
        zs.append(z)
        ps.append(p)
        cs.append(p + c)
        Fs.append(chain.m[k] * (a + np.cross(wd, c) + np.cross(w, np.cross(w, c))))
        Ns.append(I @ wd + np.cross(w, I @ w))
    u = np.zeros(n)
    f, t = np.zeros(3), np.zeros(3)
    for k in range(n)[::-1]:
        if k < n - 1:
            t = t + np.cross(ps[k + 1] - ps[k], f)
        t = t + Ns[k] + np.cross(cs[k] - ps[k], Fs[k])
        f = f + Fs[k]
        u[k] = zs[k] @ t + chain.viscous[k] * qd[k]
    return u
""",
        "terms": """
def terms(library, q, qd):
    zero = np.zeros_like(q)
    g = library(q, zero, zero)
    M = np.zeros((len(q), len(q)))
    for j in range(len(q)):
        e = np.zeros(len(q))
        e[j] = 1
        M[:, j] = library(q, zero, e) - g
    f = (library(q, qd, zero) - library(q, -qd, zero)) / 2
    c = library(q, qd, zero) - g - f
    return M, c, g, f
""",
        "gravity_sign": """
def gravity_sign(library):
    zero = np.zeros(2)
    hold = library(zero, zero, zero)[1]
    lift = library(zero, zero, np.array([0.0, 1.0]))[1]
    if hold == 0:
        return 0
    return 1 if hold * (lift - hold) > 0 else -1
""",
        "count": """
def count(n):
    outwards = 24 * n
    pairs = n * (n + 1) // 2
    return outwards + 11 * pairs, outwards + 13 * n
""",
    }
)
POINTS = {"c7-rnea": 5.0, "c7-terms": 2.0, "c7-gravity_sign": 2.0, "c7-count": 2.0}

function, right_but = RIGHT.function, RIGHT.right_but


def right(release):
    notebook = right_but(release)
    cell_of(notebook, "c7-discussion").source = "Newton's law has the weight on the right side ..."
    return notebook


def wrong(release):
    """Nothing handed down, all terms in each other, one sign for all, and products only."""
    return answered(
        release,
        rnea=RIGHT["rnea"].replace("t = t + Ns[k]", "t = Ns[k]"),
        terms=RIGHT["terms"]
        .replace("(q, zero, e) - g", "(q, zero, e)")
        .replace("zero) - g - f", "zero) - f")
        .replace("return M, c, g, f", "return M, c, library(q, qd, zero), f + c - g"),
        gravity_sign=function("gravity_sign", "return 1"),
        count=function("count", "return 15 * n + 2 * n * (n + 1), 21 * n"),
    )


def partly_right(release):
    """No ω × Iω; C q̇ with the friction in it; whose torque not asked; n times one link."""
    return right_but(
        release,
        rnea=RIGHT["rnea"].replace(" + np.cross(w, I @ w)", ""),
        terms=RIGHT["terms"].replace("zero) - g - f", "zero) - g"),
        gravity_sign=RIGHT["gravity_sign"].replace("hold * (lift - hold) > 0", "hold > 0"),
        count=function("count", "return 35 * n, 37 * n"),
    )
