"""Wrong answers about Y, fits and ranks: the mistakes each shows, and the credit left."""

REGRESSOR = """
l1, g = arm.l1, arm.g
(q1, q2), (v1, v2), (a1, a2) = q, qd, qdd
c1, c2, s2, c12 = np.cos(q1), np.cos(q2), np.sin(q2), np.cos(q1 + q2)
m1, mc1, J1, m2, mc2, J2 = np.zeros((6, 2))
mc1[0] = g * c1
J1[0] = a1
m2[0] = l1**2 * a1 + l1 * mc1[0]
mc2[0] = l1 * c2 * (2 * a1 + a2) - l1 * s2 * (2 * v1 * v2 + v2**2) + g * c12
mc2[1] = l1 * c2 * a1 + l1 * s2 * v1**2 + g * c12
J2[:] = a1 + a2
Y = np.array([m1, mc1, J1, m2, mc2, J2]).T
return Y
"""


def but(body, *changes):
    """The body with texts replaced in turn: old, new, old, new."""
    for old, new in zip(changes[::2], changes[1::2], strict=True):
        assert old in body
        body = body.replace(old, new)
    return body


def Y(*changes):
    return but(REGRESSOR, *changes)


def using(body, regressor=REGRESSOR):
    """A body that calls regressor(q, qd, qdd, arm), which is defined in its first lines."""
    lines = "".join(f"    {line}\n" for line in regressor.strip().splitlines())
    return f"def regressor(q, qd, qdd, arm):\n{lines}{body.strip()}"


ROWS = "Y = np.array([regressor(*s, arm) for s in zip(q, qd, qdd)])\n"

FIT = f"""{ROWS}W, t = Y[:, :, [1, 2, 4, 5]].reshape(-1, 4), u.ravel()
b = np.linalg.lstsq(W, t)[0]
return b
"""

COUNT = f"""{ROWS}W = Y.reshape(-1, 6)
return np.linalg.matrix_rank(W)
"""


def fit(*changes, regressor=REGRESSOR):
    return using(but(FIT, *changes), regressor)


def count(*changes, regressor=REGRESSOR):
    return using(but(COUNT, *changes), regressor)


LIST = "[m1, mc1, J1, m2, mc2, J2]).T"

WEIGHTS = "w = 1 + np.arange(len(t)) % 2\nb ="

EXAMPLE_L1 = ("arm.l1, arm.g", "0.45, 9.81")

ALL_V = "- l1 * s2 * (2 * v1 * v2 + v2**2)"
ALONE = "np.array([np.linalg.pinv(y[:, [1, 2, 4, 5]]) @ t for y, t in zip(Y, u)]).mean(0)"
RIDGE = "b = np.linalg.inv(W.T @ W + {} * np.eye(4)) @ W.T @ t\n"
SOLVE = "b = np.linalg.lstsq(W, t)[0]\n"

TABLE = {
    "c6-regressor": [
        ("dropped / g(q)", Y("arm.l1, arm.g", "arm.l1, 0"), 0.2),
        ("wrong sign / g(q)", Y("arm.l1, arm.g", "arm.l1, -arm.g"), 0.2),
        ("dropped / the weight of link 2 at the elbow / in g_vec", Y(" + l1 * mc1[0]", ""), 0.8),
        ("dropped / the weight of link 2 beyond the elbow / in g_vec", Y(" + g * c12", ""), 0.55),
        (
            "dropped / the weight of link 2 beyond the elbow / g1 / in g_vec",
            Y("v2**2) + g * c12", "v2**2)"),
            0.75,
        ),
        (
            "sine for cosine / in g_vec",
            Y(
                "c1, c2, s2, c12 = np.cos(q1)",
                "c1, c2, s2, c12 = np.sin(q1)",
                "np.cos(q1 +",
                "np.sin(q1 +",
            ),
            0.2,
        ),
        (
            "wrong angle / the weight of link 2 beyond the elbow / q2 / q1 + q2 / in g_vec",
            Y("np.cos(q1 + q2)", "np.cos(q2)"),
            0.55,
        ),
        (
            "coupling without the factor 2",
            Y("(2 * a1 + a2)", "(a1 + a2)"),
            0.75,
        ),
        ("sine for cosine / the coupling of the two links / in M", Y("l1 * c2", "l1 * s2"), 0.55),
        (
            "wrong angle / the coupling of the two links / q1 / q2 / in M",
            Y("l1 * c2", "l1 * c1"),
            0.55,
        ),
        ("dropped / C q̇", Y(ALL_V, "", "+ l1 * s2 * v1**2", ""), 0.55),
        ("dropped / C q̇ / row 2", Y("+ l1 * s2 * v1**2", ""), 0.8),
        ("dropped / the coupling of the two links / C11 / in C", Y("2 * v1 * v2", "v1 * v2"), 0.75),
        ("product dropped / row 1 / qd2² / in C", Y(" + v2**2", ""), 0.75),
        (
            "wrong sign / C q̇",
            Y("- l1 * s2", "+ l1 * s2", "c2 * a1 + l1", "c2 * a1 - l1"),
            0.55,
        ),
        ("wrong sign / C q̇ / row 1", Y("- l1 * s2", "+ l1 * s2"), 0.75),
        ("wrong sign / C q̇ / row 2", Y("c2 * a1 + l1", "c2 * a1 - l1"), 0.8),
        ("no velocity / in C", Y("(2 * v1 * v2 + v2**2)", "(v1 + 2 * v2)", "v1**2", "v1"), 0.55),
        ("dropped / M q̈", Y("(a1, a2) = q, qd, qdd", "(a1, a2) = q, qd, 0 * qdd"), 0.15),
        ("absolute acceleration of link 2", Y("J2[:] = a1 + a2", "J2[:] = a2"), 0.8),
        (
            "absolute acceleration of link 2 at joint 2",
            Y("J2[:] = a1 + a2", "J2[:] = a1 + a2, a2"),
            0.8,
        ),
        ("dropped / the column of I2 + m2·lc2² / row 1", Y("J2[:] = a1", "J2[1] = a1"), 0.8),
        (
            "acceleration of joint 1 for link 2 at joint 1",
            Y("J2[:] = a1 + a2", "J2[:] = a1, a1 + a2"),
            0.8,
        ),
        ("acceleration of link 2 for link 1", Y("J1[0] = a1", "J1[0] = a1 + a2"), 0.8),
        ("J1 at joint 2", Y("J1[0] = a1", "J1[:] = a1"), 0.8),
        (
            "square lost / the mass of link 2 at the elbow / l1 / l1² / in M and C",
            Y("l1**2 * a1", "l1 * a1"),
            0.8,
        ),
        ("dropped / the mass of link 2 at the elbow / in M and C", Y("l1**2 * a1 + ", ""), 0.8),
        ("dropped / the column of m2", Y("m2[0] = l1**2 * a1 + l1 * mc1[0]", "m2[0] = 0"), 0.8),
        (
            "inertia about the centre of mass",
            Y("Y = np", "m1[0] = arm.lc1**2 * a1\nm2 += arm.lc2**2 * (a1 + a2)\nY = np"),
            0.8,
        ),
        (
            "inertia about the centre of mass, in the column of m lc",
            Y("Y = np", "mc1[0] += arm.lc1 * a1\nmc2 += arm.lc2 * (a1 + a2)\nY = np"),
            0.4,
        ),
        (
            "weight of link 1 in the column of m1",
            Y("Y = np", "m1[0], mc1[0] = arm.lc1 * g * c1, 0\nY = np"),
            0.65,
        ),
        (
            "parameters inside",
            Y(
                "return Y",
                "M1, M2, L1, L2 = arm.m1, arm.m2, arm.lc1, arm.lc2\n"
                "return Y * [M1, M1*L1, arm.I1 + M1*L1**2, M2, M2*L2, arm.I2 + M2*L2**2]",
            ),
            0,
        ),
        ("sign of the whole", Y("return Y", "return -Y"), 0),
        (
            "columns in another order / m1·lc1, m2, I1 + m1·lc1², m2·lc2, I2 + m2·lc2²",
            Y(LIST, "[m1, mc1, m2, J1, mc2, J2]).T"),
            0.6,
        ),
        ("the column of m1 lc1 in that of m1", Y(LIST, "[mc1, mc1, J1, m2, mc2, J2]).T"), 0.8),
        ("the column of J1 in that of m1", Y(LIST, "[J1, mc1, J1, m2, mc2, J2]).T"), 0.8),
        ("the column of m2 in that of m1", Y(LIST, "[m2, mc1, J1, m2, mc2, J2]).T"), 0.8),
        ("the column of m2 lc2 in that of m1", Y(LIST, "[mc2, mc1, J1, m2, mc2, J2]).T"), 0.8),
        ("the column of J2 in that of m1", Y(LIST, "[J2, mc1, J1, m2, mc2, J2]).T"), 0.8),
        (
            "column of another / the column of I1 + m1·lc1² / I2 + m2·lc2²",
            Y(LIST, "[m1, mc1, J2, m2, mc2, J2]).T"),
            0.8,
        ),
        ("each link reversed", Y(LIST, "[J1, mc1, m1, J2, mc2, m2]).T"), 0.6),
        ("inertia first", Y(LIST, "[J1, m1, mc1, J2, m2, mc2]).T"), 0),
        ("inertia before first moment", Y(LIST, "[m1, J1, mc1, m2, J2, mc2]).T"), 0.2),
        ("first moment first", Y(LIST, "[mc1, m1, J1, mc2, m2, J2]).T"), 0.2),
        ("link 2 first", Y(LIST, "[m2, mc2, J2, m1, mc1, J1]).T"), 0),
        ("joints exchanged", Y("return Y", "return Y[::-1]"), 0),
        ("reshaped for transposed", Y(LIST, "[m1, mc1, J1, m2, mc2, J2]).reshape(2, 6)"), 0),
        ("wrong parameter / l2 / l1 / in M and g", Y("arm.l1", "arm.l2"), 0.35),
        ("lc1 for l1", Y("arm.l1", "arm.lc1"), 0.35),
        ("parameter left out / g / in g_vec", Y("arm.l1, arm.g", "arm.l1, 1"), 0.2),
        ("gravity of Earth / 9.81 / g / in g_vec", Y("arm.l1, arm.g", "arm.l1, 9.81"), 0.2),
        ("numbers of the example", Y(*EXAMPLE_L1), 0.2),
        ("radians converted", Y("= q, qd, qdd", "= np.radians(q), qd, qdd"), 0.2),
        ("angle in degrees", Y("= q, qd, qdd", "= np.degrees(q), qd, qdd"), 0.2),
        (
            (
                "dropped / the weight of link 2 at the elbow / in g_vec",
                "coupling without the factor 2",
            ),
            Y("(2 * a1 + a2)", "(a1 + a2)", " + l1 * mc1[0]", ""),
            0.55,
        ),
        (
            ("absolute acceleration of link 2", "wrong sign / C q̇ / row 2"),
            Y("J2[:] = a1 + a2", "J2[:] = a2", "c2 * a1 + l1", "c2 * a1 - l1"),
            0.6,
        ),
        (
            ("coupling without the factor 2", "wrong sign / C q̇ / row 1"),
            Y("(2 * a1 + a2)", "(a1 + a2)", "- l1 * s2", "+ l1 * s2"),
            0.75,
        ),
        (
            ("dropped / g(q) / row 1", "wrong sign / C q̇ / row 2"),
            Y("arm.l1, arm.g", "arm.l1, 0", "c2 * a1 + l1", "c2 * a1 - l1"),
            0.2,
        ),
    ],
    "c6-identify": [
        ("joint 1 only", fit("lstsq(W, t)", "lstsq(W[::2], t[::2])"), 0.6),
        ("joint 2 only", fit("lstsq(W, t)", "lstsq(W[1::2], t[1::2])"), 0),
        (
            "joint after joint",
            fit(
                SOLVE,
                "two = np.linalg.lstsq(W[1::2, 2:], t[1::2])[0]\n"
                "one = np.linalg.lstsq(W[::2, :2], t[::2] - W[::2, 2:] @ two)[0]\n"
                "b = [*one, *two]\n",
            ),
            0.6,
        ),
        (
            "mean of both joints",
            fit(
                SOLVE,
                "b = (np.linalg.pinv(W[::2]) @ t[::2] + np.linalg.pinv(W[1::2]) @ t[1::2]) / 2\n",
            ),
            0,
        ),
        ("first sample", fit("lstsq(W, t)", "lstsq(W[:2], t[:2])"), 0),
        ("last sample", fit("lstsq(W, t)", "lstsq(W[-2:], t[-2:])"), 0),
        ("last sample forgotten", fit("lstsq(W, t)", "lstsq(W[:-2], t[:-2])"), 0.6),
        ("first sample forgotten", fit("lstsq(W, t)", "lstsq(W[2:], t[2:])"), 0.6),
        ("mean of the samples' own solutions", fit("return b", f"return {ALONE}"), 0),
        ("torques joint by joint", fit("u.ravel()", "u.ravel(order='F')"), 0),
        ("rows joint by joint", fit("(-1, 4)", "(-1, 4, order='F')"), 0),
        ("ridge 1", fit(SOLVE, RIDGE.format(1)), 0),
        ("ridge 0.1", fit(SOLVE, RIDGE.format(0.1)), 0),
        ("ridge 0.01", fit(SOLVE, RIDGE.format(0.01)), 0),
        ("ridge 0.001", fit(SOLVE, RIDGE.format(1e-3)), 0),
        (
            "one offset",
            fit("lstsq(W, t)[0]", "lstsq(np.column_stack([W, np.ones(len(t))]), t)[0][:4]"),
            0.6,
        ),
        (
            "an offset for each joint",
            fit(
                "lstsq(W, t)[0]", "lstsq(np.hstack([W, np.tile(np.eye(2), (len(u), 1))]), t)[0][:4]"
            ),
            0.6,
        ),
        (
            "columns scaled and not scaled back",
            fit("lstsq(W, t)", "lstsq(W / np.sqrt(np.sum(W**2, axis=0)), t)"),
            0,
        ),
        (
            "total least squares",
            fit(SOLVE, "v = np.linalg.svd(np.c_[W, t])[2][-1]\nb = -v[:4] / v[4]\n"),
            0.6,
        ),
        (
            "entries of the shortest π",
            fit(SOLVE, "b = np.linalg.lstsq(Y.reshape(-1, 6), t)[0][[1, 2, 4, 5]]\n"),
            0,
        ),
        ("inertias first", fit("[1, 2, 4, 5]", "[2, 1, 5, 4]"), 0),
        ("by kind", fit("[1, 2, 4, 5]", "[1, 4, 2, 5]"), 0),
        ("inertias first, by kind", fit("[1, 2, 4, 5]", "[2, 5, 1, 4]"), 0),
        ("link 2 first", fit("[1, 2, 4, 5]", "[4, 5, 1, 2]"), 0),
        ("sign", fit("return b", "return -b"), 0),
        (
            "example arm",
            "return 4.2 * 0.21 + 2.6 * 0.45, 0.075 + 4.2 * 0.21**2 + 2.6 * 0.45**2, 2.6 * 0.17, "
            "0.034 + 2.6 * 0.17**2",
            0,
        ),
    ],
    "c6-rank_of_excitation": [
        ("number of columns", count("np.linalg.matrix_rank(W)", "W.shape[1]"), 0),
        ("five", "5", 0),
        ("four", "4", 0),
        ("smaller of rows and columns", count("np.linalg.matrix_rank(W)", "min(W.shape)"), 0),
        ("rows, but at most four", "min(2 * len(q), 4)", 0),
        # Written down, as what rounding leaves differs from one machine to the other; see
        # test_singular_values_of_rounding_are_called_so.
        ("tolerance zero", "min(2 * len(q), 5 if qd.any() else 4)", 0),
        (
            "columns that are not zero",
            count("np.linalg.matrix_rank(W)", "np.count_nonzero(np.abs(W).max(axis=0))"),
            0,
        ),
        ("first sample", count("matrix_rank(W)", "matrix_rank(Y[0])"), 0),
        ("first sample", count("matrix_rank(W)", "matrix_rank(sum(Y))"), 0),
        ("first sample", count("matrix_rank(W)", "matrix_rank(np.hstack(Y))"), 0),
        ("joint 1 only", count("(W)", "(Y[:, 0])"), 0.35),
        ("joint 2 only", count("(W)", "(Y[:, 1])"), 0),
        ("number of samples", "len(q)", 0),
        (
            "number of rows",
            count("np.linalg.matrix_rank(W)", "sum(map(np.linalg.matrix_rank, Y))"),
            0,
        ),
        ("gravity ignored", count(regressor=Y("arm.l1, arm.g", "arm.l1, 0")), 0),
        ("9.81", count(regressor=Y("arm.l1, arm.g", "arm.l1, 9.81")), 0.65),
        ("no acceleration", count("qdd)]", "0 * qdd)]"), 0),
        ("what is missing", count("np.linalg.matrix_rank(W)", "6 - np.linalg.matrix_rank(W)"), 0),
    ],
}
# A right fit with a wrong regressor.
BODIES = {names: body for names, body, _ in TABLE["c6-regressor"]}
TABLE["c6-identify"] += [
    (f"fit: {name}", fit(regressor=BODIES[of_part_A]), 0)
    for name, of_part_A in (
        ("gravity missing", "dropped / g(q)"),
        ("sign of gravity", "wrong sign / g(q)"),
        ("sine for cosine in gravity", "sine for cosine / in g_vec"),
        (
            "absolute second angle in gravity",
            "wrong angle / the weight of link 2 beyond the elbow / q2 / q1 + q2 / in g_vec",
        ),
        ("coupling without the factor 2", "coupling without the factor 2"),
        ("velocity products left out", "dropped / C q̇"),
        ("sign of the velocity products", "wrong sign / C q̇"),
        ("no acceleration", "dropped / M q̈"),
        ("absolute acceleration of link 2", "absolute acceleration of link 2"),
        ("l2 for l1", "wrong parameter / l2 / l1 / in M and g"),
        ("9.81", "gravity of Earth / 9.81 / g / in g_vec"),
        ("example arm", "numbers of the example"),
    )
]
