"""Wrong answers about sweeps, a library and counting: the mistakes each shows, and the credit left."""

RNEA = """
def rotation(axis, angle):
    x, y, z = axis
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K

def cross(a, b):
    return np.array([a[1]*b[2] - a[2]*b[1], a[2]*b[0] - a[0]*b[2], a[0]*b[1] - a[1]*b[0]])

n = len(q)
R = [rotation(chain.axis[k], q[k]) for k in range(n)]
w, wd, a = np.zeros(3), np.zeros(3), -chain.gravity
F, N = [], []
for k in range(n):
    z, r, c, m, I = chain.axis[k], chain.offset[k], chain.com[k], chain.m[k], chain.I[k]
    a = R[k].T @ (a + cross(wd, r) + cross(w, cross(w, r)))
    w, wd = R[k].T @ w, R[k].T @ wd
    wd = wd + cross(w, z * qd[k]) + z * qdd[k]
    w = w + z * qd[k]
    ac = a + cross(wd, c) + cross(w, cross(w, c))
    F.append(m * ac)
    N.append(I @ wd + cross(w, I @ w))
u = np.zeros(n)
f, t = np.zeros(3), np.zeros(3)
for k in range(n - 1, -1, -1):
    t = t + N[k] + cross(chain.com[k], F[k])
    f = f + F[k]
    u[k] = chain.axis[k] @ t + chain.viscous[k] * qd[k]
    f, t = R[k] @ f, R[k] @ t
    t = t + cross(chain.offset[k], f)
return u
"""
# All vectors in the axes of the base.
IN_BASE = """
def rotation(axis, angle):
    x, y, z = axis
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K

n, R, w, wd, p, a = len(q), np.eye(3), np.zeros(3), np.zeros(3), np.zeros(3), -chain.gravity
links = []
for k in range(n):
    r = R @ chain.offset[k]
    a = a + np.cross(wd, r) + np.cross(w, np.cross(w, r))
    p = p + r
    R = R @ rotation(chain.axis[k], q[k])
    z, c, I = R @ chain.axis[k], R @ chain.com[k], R @ chain.I[k] @ R.T
    wd = wd + np.cross(w, z) * qd[k] + z * qdd[k]
    w = w + z * qd[k]
    F = chain.m[k] * (a + np.cross(wd, c) + np.cross(w, np.cross(w, c)))
    links.append((p, z, p + c, F, I @ wd + np.cross(w, I @ w)))
u = chain.viscous * qd
for k in range(n):
    p, z = links[k][:2]
    u[k] += z @ sum(N + np.cross(at - p, F) for _, _, at, F, N in links[k:])
return u
"""


def but(body, *changes):
    """The body with texts replaced in turn: old, new, old, new."""
    for old, new in zip(changes[::2], changes[1::2], strict=True):
        assert old in body, old
        body = body.replace(old, new)
    return body


def rnea(*changes):
    return but(RNEA, *changes)


def in_base(*changes):
    return but(IN_BASE, *changes)


TERMS = """
o = 0 * q
g = library(q, o, o)
M = np.array([library(q, o, e) - g for e in np.eye(len(q))]).T
b1, b2 = library(q, qd, o) - g, library(q, -qd, o) - g
c, f = (b1 + b2) / 2, (b1 - b2) / 2
return M, c, g, f
"""


def terms(*changes):
    return but(TERMS, *changes)


SIGN = """
o = np.zeros(2)
w = library(o, o, o)[1]
i = library(o, o, np.ones(2))[1] - w
return np.sign(w * i)
"""


def sign(*changes):
    return but(SIGN, *changes)


# By hand, as the notebook's two algorithms are not here.
COUNT = """
outwards = {"+": 6, "-": 3, "*": 15}
def direct(kind, n):
    pairs = n * (n + 1) // 2
    return outwards[kind] * n + {"+": 4, "-": 3, "*": 4}[kind] * pairs
def sweeps(kind, n):
    return (outwards[kind] + {"+": 5, "-": 2, "*": 6}[kind]) * n
kinds = "+-*"
a, b = sum(direct(k, n) for k in kinds), sum(sweeps(k, n) for k in kinds)
return a, b
"""


def count(*changes):
    return but(COUNT, *changes)


# In outwards 0.0 − a s of each link, and the sums with the first joint's px, py and ax; then, in the
# direct sum, its place once more and each total; in the sweeps the first of the three that they carry.
FLOATS = "return a - (n + 4) - (2 + n), b - (n + 4) - 3"
OUT = "a = R[k].T @ (a + cross(wd, r) + cross(w, cross(w, r)))"
OUT_2 = "w, wd = R[k].T @ w, R[k].T @ wd"
BACK = "f, t = R[k] @ f, R[k] @ t"
LEVER = " + cross(chain.com[k], F[k])"
DOWN = "t = t + cross(chain.offset[k], f)\n"

CARRIED = "I @ wd + cross(w, I @ w)"
STEINER = "I = I + m * (c @ c * np.eye(3) - np.outer(c, c))\n    N.append("
PLACE = "r, c, m, I = chain.axis[k], chain.offset[k],"
CENTRE_OUT = (PLACE, "r, c, m, I = chain.axis[k], chain.com[k - 1] if k else chain.offset[0],")
CENTRE_IN = ("cross(chain.offset[k], f)", "cross(chain.com[k - 1], f)")
OWN_OUT = (PLACE, "r, c, m, I = chain.axis[k], chain.offset[k - 1 if k else 0],")
OWN_IN = ("cross(chain.offset[k], f)", "cross(chain.offset[k - 1], f)")

CROSS_C, CROSS_R = "cross(w, cross(w, c))", "cross(w, cross(w, r))"
RATE = "w = w + z * qd[k]\n"


def late(line):
    """The acceleration of the joint, once its link has its rates."""
    return rnea(f"    {OUT}\n", "", RATE, f"{RATE}    {line}\n")


AT_JOINT = f"cross(wd, r) + {CROSS_R}"
SHARE = "    u[k] = chain.axis[k] @ t + chain.viscous[k] * qd[k]\n"
TURNED_FIRST = rnea(f"    {OUT}\n", "", OUT_2, f"{OUT_2}\n    a = R[k].T @ a + {AT_JOINT}")
OWN_AXES_IN = (f"    {BACK}\n    {DOWN}", f"    {DOWN}    {BACK}\n")
# What the next link hands down is turned where it is used.
OWN_ANGLE = rnea(
    f"    {BACK}\n    {DOWN}", "", "    t = t + N[k]", f"    {BACK}\n    t = t + N[k]",
    LEVER, f"{LEVER} + (cross(chain.offset[k + 1], f) if k < n - 1 else 0)",
)  # fmt: skip
OWN_AGAIN = ("(cross(chain.offset[k + 1], f) if k < n - 1 else 0)", "cross(chain.offset[k], f)")

TABLE = {
    "c7-rnea": [
        ("gravity missing", rnea("-chain.gravity", "np.zeros(3)"), 0.5),
        ("sign of gravity", rnea("-chain.gravity", "chain.gravity"), 0.5),
        (
            "gravity twice",
            rnea(
                "m * ac",
                "m * (ac - T.T @ chain.gravity)",
                "w = w +",
                "T = np.eye(3)\n    for B in R[:k + 1]:\n        T = T @ B\n    w = w +",
            ),
            0.5,
        ),
        ("9.81 downwards", rnea("-chain.gravity", "np.array([0, 0, 9.81])"), 0),
        ("gyroscopic term missing", rnea(" + cross(w, I @ w)", ""), 0.45),
        ("sign of the gyroscopic term", rnea("cross(w, I @ w)", "cross(I @ w, w)"), 0.45),
        ("no centripetal acceleration of the joint", rnea(" + cross(w, cross(w, r))", ""), 0.45),
        ("no centripetal acceleration of the centre", rnea(" + cross(w, cross(w, c))", ""), 0.45),
        (
            "no centripetal acceleration",
            rnea(" + cross(w, cross(w, c))", "", " + cross(w, cross(w, r))", ""),
            0.45,
        ),
        (
            "centripetal acceleration of the joint outwards",
            rnea(" + cross(w, cross(w, r))", " - cross(w, cross(w, r))"),
            0.45,
        ),
        (
            "centripetal acceleration of the centre outwards",
            rnea(" + cross(w, cross(w, c))", " + cross(w, cross(c, w))"),
            0.45,
        ),
        (
            "centripetal acceleration outwards",
            rnea("cross(w, cross(w, c))", "cross(w, cross(c, w))", "cross(w, r))", "cross(r, w))"),
            0.45,
        ),
        (
            "sign of the angular acceleration at the joint",
            rnea("cross(wd, r)", "cross(r, wd)"),
            0.2,
        ),
        (
            "sign of the angular acceleration at the centre",
            rnea("cross(wd, c)", "cross(c, wd)"),
            0.2,
        ),
        (
            "sign of the angular acceleration",
            rnea("cross(wd, c)", "cross(c, wd)", "cross(wd, r)", "cross(r, wd)"),
            0.2,
        ),
        ("no angular acceleration at the joint", rnea(" + cross(wd, r)", ""), 0.2),
        ("no angular acceleration at the centre", rnea(" + cross(wd, c)", ""), 0.2),
        ("moment arm of the link's own force missing", rnea(LEVER, ""), 0),
        ("moment arm of the next link's force missing", rnea(f"    {DOWN}", ""), 0),
        (
            "sign of the moment of the link's own force",
            rnea("cross(chain.com[k], F[k])", "cross(F[k], chain.com[k])"),
            0,
        ),
        (
            "sign of the moment of the next link's force",
            rnea("cross(chain.offset[k], f)", "cross(f, chain.offset[k])"),
            0,
        ),
        (
            "sign of both moments",
            rnea(
                "cross(chain.com[k], F[k])",
                "cross(F[k], chain.com[k])",
                "cross(chain.offset[k], f)",
                "cross(f, chain.offset[k])",
            ),
            0,
        ),
        ("force not handed down", rnea("f = f + F[k]", "f = F[k]"), 0),
        (
            "torque not handed down",
            rnea(
                "t = t + N[k]",
                "t = t0 + N[k]",
                DOWN,
                "t0 = cross(chain.offset[k], f)\n",
                "u = np.zeros(n)",
                "u, t0 = np.zeros(n), 0",
            ),
            0,
        ),
        ("nothing handed down", rnea("t = t + N[k]", "t = N[k]"), 0),
        ("inertia about the joint", rnea("N.append(", STEINER), 0.2),
        (
            "inertia about the joint, without the force",
            rnea("N.append(", STEINER, LEVER, ""),
            0,
        ),
        (
            "angular acceleration of the link before missing",
            rnea("wd = wd + cross(w, z", "wd = cross(w, z"),
            0.2,
        ),
        (
            "angular velocity of the link before missing",
            rnea("w = w + z * qd[k]", "w = z * qd[k]"),
            0.45,
        ),
        ("turning of the axis missing", rnea("wd + cross(w, z * qd[k])", "wd"), 0.45),
        (
            "turning of the axis with the wrong sign",
            rnea("cross(w, z * qd[k])", "cross(z * qd[k], w)"),
            0.45,
        ),
        ("acceleration of the joint missing", rnea(" + z * qdd[k]", ""), 0.45),
        (
            "turned the wrong way outwards",
            rnea(OUT, OUT.replace(".T", ""), OUT_2, OUT_2.replace(".T", "")),
            0,
        ),
        ("turned the wrong way inwards", rnea(BACK, BACK.replace("[k]", "[k].T")), 0),
        ("turned the wrong way", rnea("np.sin(angle) * K", "np.sin(-angle) * K"), 0),
        ("not turned outwards", rnea(OUT, OUT.replace("R[k].T @ ", ""), OUT_2, ""), 0),
        ("not turned inwards", rnea(BACK, ""), 0),
        ("not turned", rnea("R = [rotation(chain.axis[k], q[k])", "R = [np.eye(3)"), 0),
        ("angular velocity not turned", rnea("R[k].T @ w,", "w,"), 0.45),
        ("angular acceleration not turned", rnea("R[k].T @ wd", "wd"), 0.2),
        ("acceleration of the joint not turned", rnea("a = R[k].T @ (a", "a = (a"), 0),
        ("force not turned", rnea("R[k] @ f,", "f,"), 0),
        ("moment not turned", rnea("R[k] @ t", "t"), 0),
        ("inertia not turned", in_base("R @ chain.I[k] @ R.T", "chain.I[k]"), 0.2),
        ("centre of mass not turned", in_base("R @ chain.com[k]", "chain.com[k]"), 0),
        ("axis not turned", in_base("z, c, I = R @ chain.axis[k]", "z, c, I = chain.axis[k]"), 0),
        ("offset not turned", in_base("r = R @ chain.offset[k]", "r = chain.offset[k]"), 0),
        ("centre for the next joint outwards", rnea(*CENTRE_OUT), 0.2),
        ("centre for the next joint inwards", rnea(*CENTRE_IN), 0),
        ("centre for the next joint", rnea(*CENTRE_OUT, *CENTRE_IN), 0),
        ("own offset outwards", rnea(*OWN_OUT), 0.2),
        ("own offset inwards", rnea(*OWN_IN), 0),
        ("own offset", rnea(*OWN_OUT, *OWN_IN), 0),
        ("third component", rnea("chain.axis[k] @ t", "t[2]"), 0),
        ("no rotational inertia", rnea("N.append(", "N.append(0 * (", CARRIED, f"{CARRIED})"), 0.2),
        ("velocity of the joint for its acceleration", rnea(CROSS_R, "cross(w, r)"), 0.45),
        ("velocity of the centre for its acceleration", rnea(CROSS_C, "cross(w, c)"), 0.45),
        (
            "velocities for accelerations",
            rnea(CROSS_R, "cross(w, r)", CROSS_C, "cross(w, c)"),
            0.45,
        ),
        (
            "centripetal acceleration of the plane",
            rnea(CROSS_R, "-(w @ w) * r", CROSS_C, "-(w @ w) * c"),
            0.45,
        ),
        (
            "next joint from the centre",
            rnea("F.append(m * ac)", "a = ac\n    F.append(m * a)"),
            0.2,
        ),
        (
            "centre as the arm of the whole force",
            rnea(
                "    f = f + F[k]\n",
                "",
                "t = t + N",
                "f = f + F[k]\n    t = t + N",
                "F[k])\n    u",
                "f)\n    u",
            ),
            0,
        ),
        (
            "about the joint before",
            rnea(SHARE, "", DOWN, DOWN + SHARE),
            0,
        ),
        ("length of the moment", rnea("chain.axis[k] @ t", "np.linalg.norm(t)"), 0),
        ("no part with the angular acceleration", rnea("I @ wd + ", ""), 0.2),
        ("angular velocity turned the wrong way", rnea("R[k].T @ w,", "R[k] @ w,"), 0.45),
        ("angular acceleration turned the wrong way", rnea("R[k].T @ wd", "R[k] @ wd"), 0.2),
        (
            "acceleration of the joint turned the wrong way",
            rnea("a = R[k].T @ (a", "a = R[k] @ (a"),
            0,
        ),
        ("force turned the wrong way", rnea("R[k] @ f", "R[k].T @ f"), 0),
        ("moment turned the wrong way", rnea("R[k] @ t", "R[k].T @ t"), 0),
        (
            "weight not turned",
            rnea("-chain.gravity", "np.zeros(3)", "m * ac", "m * (ac - chain.gravity)"),
            0.5,
        ),
        ("offset in the axes of its own link outwards", TURNED_FIRST, 0.2),
        ("offset in the axes of its own link inwards", rnea(*OWN_AXES_IN), 0),
        ("offset in the axes of its own link", but(TURNED_FIRST, *OWN_AXES_IN), 0),
        (
            "joint carried by its own rates",
            late(f"r = R[k].T @ r; a = R[k].T @ a + {AT_JOINT}"),
            0.2,
        ),
        (
            "joint carried by its own rates, offset as it is",
            late(f"a = R[k].T @ a + {AT_JOINT}"),
            0.2,
        ),
        ("joint carried by its own rates, then turned", late(OUT), 0.2),
        (
            "turning of the axis with two kinds of axes",
            rnea(OUT_2, "wd = R[k].T @ wd", RATE, "w = R[k].T @ w + z * qd[k]\n"),
            0.45,
        ),
        ("own angle inwards", OWN_ANGLE, 0),
        ("own angle and offset inwards", but(OWN_ANGLE, *OWN_AGAIN), 0),
        ("friction missing", rnea(" + chain.viscous[k] * qd[k]", ""), 0.45),
        ("sign of friction", rnea("+ chain.viscous", "- chain.viscous"), 0.45),
        ("first joint left out", rnea("range(n - 1, -1, -1)", "range(n - 1, 0, -1)"), 0),
        ("last link left out", rnea("range(n - 1, -1, -1)", "range(n - 2, -1, -1)"), 0),
        ("order of the joints", rnea("return u", "return u[::-1]"), 0),
        (
            ("gyroscopic term missing", "friction missing"),
            rnea(" + cross(w, I @ w)", "", " + chain.viscous[k] * qd[k]", ""),
            0.45,
        ),
    ],
    "c7-terms": [
        ("gravity in M", terms("library(q, o, e) - g", "library(q, o, e)"), 0.7),
        ("gravity added to M", terms("library(q, o, e) - g", "library(q, o, e) + g"), 0.7),
        (
            "M asked in motion",
            terms("library(q, o, e) - g", "library(q, qd, e) - g"),
            0.7,
        ),
        (
            "M asked in motion, with gravity",
            terms("library(q, o, e) - g", "library(q, qd, e)"),
            0.7,
        ),
        (
            "M from one acceleration of all joints",
            terms("M = np", "M = np.diag(library(q, o, 1 + o) - g)\nM0 = np"),
            0.7,
        ),
        ("diagonal of M", terms("M, c, g", "np.diag(np.diag(M)), c, g"), 0.7),
        ("gravity in C q̇", terms("c, f = (b1 + b2) / 2", "c, f = (b1 + b2) / 2 + g"), 0.7),
        ("friction in C q̇", terms("c, f = (b1 + b2) / 2", "c, f = b1"), 0.7),
        (
            "gravity and friction in C q̇",
            terms("c, f = (b1 + b2) / 2", "c, f = library(q, qd, o)"),
            0.7,
        ),
        ("C q̇ in the friction", terms("(b1 - b2) / 2", "b1"), 0.8),
        ("friction in C q̇, of the way back", terms("c, f = (b1 + b2) / 2", "c, f = b2"), 0.7),
        ("gravity in the friction", terms("M, c, g, f", "M, c, g, library(q, qd, o) - c"), 0.8),
        (
            "gravity and C q̇ in the friction",
            terms("M, c, g, f", "M, c, g, library(q, qd, o)"),
            0.8,
        ),
        (
            "gravity left in one of two calls",
            terms("library(q, -qd, o) - g", "library(q, -qd, o)"),
            0.5,
        ),
        (
            "gravity left in the other of two calls",
            terms("library(q, qd, o) - g", "library(q, qd, o)"),
            0.5,
        ),
        (
            "velocity in the place of the acceleration",
            terms(
                "library(q, qd, o)", "library(q, o, qd)", "library(q, -qd, o)", "library(q, o, -qd)"
            ),
            0.5,
        ),
        (
            "gravity twice from M",
            terms("library(q, o, e) - g", "library(q, qd, e) - library(q, qd, o) - g"),
            0.7,
        ),
        ("unit velocities in M", terms("library(q, o, e)", "library(q, e, o)"), 0.7),
        (
            "velocity and acceleration exchanged in all calls",
            terms(
                "o = 0 * q", "o, given = 0 * q, library\nlibrary = lambda q, v, a: given(q, a, v)"
            ),
            0.2,
        ),
        (
            "gravity in motion, taken away everywhere",
            terms("g = library(q, o, o)", "g = library(q, qd, o)"),
            0.2,
        ),
        (
            "C q̇ joint by joint",
            terms(
                "return M, c",
                "b = lambda v: library(q, v, o) - g\n"
                "each = [(b(v) + b(-v)) / 2 for v in np.diag(qd)]\nreturn M, sum(each)",
            ),
            0.7,
        ),
        ("in the order g, C q̇, f", terms("M, c, g, f", "M, g, c, f"), 0.5),
        ("in the order C q̇, f, g", terms("M, c, g, f", "M, c, f, g"), 0.6),
        ("in the order g, f, C q̇", terms("M, c, g, f", "M, g, f, c"), 0.3),
        ("in the order f, C q̇, g", terms("M, c, g, f", "M, f, c, g"), 0.3),
        ("C q̇ and friction exchanged", terms("c, f =", "f, c ="), 0.5),
        ("gravity of the level arm", terms("M, c, g", "M, c, library(o, o, o)"), 0.8),
        ("gravity in motion", terms("M, c, g", "M, c, library(q, qd, o)"), 0.8),
        (
            ("gravity in M", "gravity in C q̇"),
            terms(
                "library(q, o, e) - g",
                "library(q, o, e)",
                "c, f = (b1 + b2) / 2",
                "c, f = (b1 + b2) / 2 + g",
            ),
            0.4,
        ),
    ],
    "c7-gravity_sign": [
        ("always 1", "1", 0),
        ("always −1", "-1", 0),
        ("joint 1", sign("library(o, o, o)[1]", "library(o, o, o)[0]"), 0),
        ("whose torque not asked", sign("np.sign(w * i)", "np.sign(w)"), 0.5),
        ("reversed", sign("np.sign(w * i)", "-np.sign(w * i)"), 0),
        ("reversed, and whose torque not asked", sign("np.sign(w * i)", "-np.sign(w)"), 0.5),
        ("nothing between", sign("np.sign(w * i)", "1 if w * i > 0 else -1"), 0),
        (
            "nothing between, and whose torque not asked",
            sign("np.sign(w * i)", "1 if w > 0 else -1"),
            0,
        ),
        (
            "asked with an acceleration",
            "np.sign(library(np.zeros(2), np.zeros(2), np.ones(2))[1])",
            0,
        ),
        ("sign of the inertia", sign("np.sign(w * i)", "np.sign(i)"), 0),
    ],
    "c7-count": [
        ("products only", count('+-*"\na', '*"\na'), 0),
        ("sums only", count('+-*"\na', '+-"\na'), 0),
        ("plus only", count('+-*"\na', '+"\na'), 0),
        ("without subtractions", count('+-*"\na', '+*"\na'), 0),
        ("exchanged", count("return a, b", "return b, a"), 0),
        ("not set back", count("return a, b", "return a, a + b"), 0.5),
        ("not set back, the sweeps first", count("return a, b", "return a + b, b"), 0.5),
        (
            "direct sum without the outward sweep",
            count("return a, b", "return a - 24 * n, b"),
            0.5,
        ),
        ("inward sweep alone", count("return a, b", "return a, b - 24 * n"), 0.5),
        ("first sums of the direct sum", count("return a, b", "return a - n, b"), 0.5),
        ("one link fewer", count("kinds =", "n, kinds = n - 1,"), 0),
        ("one link more", count("kinds =", "n, kinds = n + 1,"), 0),
        (
            "without those of a float",
            count("return a, b", FLOATS),
            0,
        ),
        ("without the outward sweep", count("return a, b", "return a - 24 * n, b - 24 * n"), 0),
        ("n times one link", count("direct(k, n)", "n * direct(k, 1)"), 0.5),
        ("pairs counted twice", count("pairs = n * (n + 1) // 2", "pairs = n * n"), 0.5),
        (
            "pairs without the link itself",
            count("pairs = n * (n + 1) // 2", "pairs = n * (n - 1) // 2"),
            0.5,
        ),
    ],
}
