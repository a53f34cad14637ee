"""Wrong answers about gravity: the mistakes that each shows, and the credit left."""

NAMES = "\n".join(f"{name} = arm.{name}" for name in ("l1", "l2", "lc1", "lc2", "m1", "m2", "g"))

ANGLES = "q1, q2 = q\n"


def P(returned):
    """A body that names the arm's parameters, as most students begin."""
    return f"{NAMES}\n{ANGLES}return {returned}"


def of_links(kind="np.sin", first="q1", second="q1 + q2"):
    return P(f"g * (m1*lc1*{kind}({first}) + m2*(l1*{kind}({first}) + lc2*{kind}({second})))")


def torque(kind="np.cos", first="q1", second="q1 + q2", sign=""):
    return P(
        f"[{sign}((m1*lc1 + m2*l1)*g*{kind}({first}) + m2*lc2*g*{kind}({second})), "
        f"{sign}m2*lc2*g*{kind}({second})]"
    )


def with_lines(body, *lines):
    """The body, with these lines before its last."""
    *first, last = body.splitlines()
    return "\n".join([*first, *lines, last])


EXAMPLE_LINES = (
    "l1, lc1, m1 = 0.45, 0.21, 4.2",
    "lc2, m2, g = 0.17, 2.6, 9.81",
)

LINKS = "zip(masses, jacobians_v)"
SUM = f"sum({{}} for m, Jv in {LINKS})"

LOOP = """
g = np.zeros(jacobians_v.shape[2])
for i in range({}):
    g {} -masses[i] * jacobians_v[i].T @ g0
return g
"""

HALF_PI = "np.pi / 2"

TABLE = {
    "p4-potential_energy": [
        (
            "sign of the whole",
            P("-(m1*g*lc1*np.sin(q1) + m2*g*(l1*np.sin(q1) + lc2*np.sin(q1 + q2)))"),
            0,
        ),
        ("cosine for sine", of_links("np.cos"), 0),
        (
            "dropped / the weight of link 2 beyond the elbow",
            P("m1*g*lc1*np.sin(q1) + m2*g*l1*np.sin(q1)"),
            0.5,
        ),
        ("half of the whole", with_lines(of_links(), "g = 0.5 * g"), 0),
        ("parameters exchanged / m1 / m2", with_lines(of_links(), "m1, m2 = m2, m1"), 0),
        ("gravity of Earth / 9.81 / g", with_lines(of_links(), "g = 9.81"), 0),
        ("radians converted", with_lines(of_links(), "q1, q2 = np.deg2rad(q)"), 0),
        (
            (
                "wrong parameter / the weight of link 2 beyond the elbow / l2 / lc2",
                "wrong parameter / the weight of link 1 beyond the shoulder / l1 / lc1",
            ),
            with_lines(of_links(), "lc1, lc2 = l1, l2"),
            0,
        ),
        (
            (
                "dropped / the weight of link 2 beyond the elbow",
                "dropped / the weight of link 2 at the elbow",
            ),
            P("m1*g*lc1*np.sin(q1)"),
            0,
        ),
    ],
    "p4-g_vec": [
        (
            "wrong angle / the weight of link 2 beyond the elbow / q1 + 2 q2 / q1 + q2",
            torque(second="q1 + 2 * q2"),
            0,
        ),
        (
            "wrong wave / the weight of link 2 beyond the elbow / q2 / q1 + q2",
            torque(second="q2 - np.pi / 2"),
            0,
        ),
        (
            "half angle / the weight of link 2 beyond the elbow / q1 + q2",
            torque(second="(q1 + q2) / 2"),
            0,
        ),
        ("sign of the whole", torque(sign="-"), 0),
        (
            "wrong angle / the weight of link 2 beyond the elbow / q2 / q1 + q2",
            torque(second="q2"),
            0,
        ),
        (
            "astray / the weight of link 2 at the elbow / g2 / g1",
            P(
                "[(m1*lc1 + m2*l1)*g*np.cos(q1) + m2*lc2*g*np.cos(q1+q2), "
                "m2*g*(l1*np.cos(q1) + lc2*np.cos(q1+q2))]"
            ),
            0.5,
        ),
        (
            "energies of the links",
            P("[m1*g*lc1*np.sin(q1), m2*g*(l1*np.sin(q1) + lc2*np.sin(q1 + q2))]"),
            0,
        ),
        ("joints exchanged", torque() + "[::-1]", 0),
        (
            "kind left out / kg",
            P("[g*((lc1 + l1)*np.cos(q1) + lc2*np.cos(q1 + q2)), g*lc2*np.cos(q1 + q2)]"),
            0,
        ),
        ("parameter left out / g", with_lines(torque(), "g = 1"), 0),
        ("numbers of the example", with_lines(torque(), *EXAMPLE_LINES), 0),
        (
            (
                "wrong parameter / the weight of link 2 beyond the elbow / l2 / lc2",
                "wrong parameter / the weight of link 1 beyond the shoulder / l1 / lc1",
            ),
            with_lines(torque(), "lc1, lc2 = l1, l2"),
            0,
        ),
        (
            (
                "dropped / the weight of link 2 at the elbow",
                "dropped / the weight of link 2 beyond the elbow / g1",
            ),
            P("[m1*g*lc1*np.cos(q1), m2*lc2*g*np.cos(q1 + q2)]"),
            0.5,
        ),
        (
            (
                "moved / the weight of link 2 at the elbow / g2 / g1",
                "dropped / the weight of link 2 beyond the elbow / g1",
            ),
            P("[m1*g*lc1*np.cos(q1), m2*g*(l1*np.cos(q1) + lc2*np.cos(q1 + q2))]"),
            0,
        ),
    ],
    "p4-gravity_from_jacobians": [
        ("sign of gravity", SUM.format("m * Jv.T @ g0"), 0),
        ("length of g0 against y", SUM.format("m * np.linalg.norm(g0) * Jv[1]"), 0),
        ("length of g0 against z", SUM.format("m * np.linalg.norm(g0) * Jv[2]"), 0),
        ("length of g0 along y", SUM.format("-m * np.linalg.norm(g0) * Jv[1]"), 0),
        ("length of g0 along z", SUM.format("-m * np.linalg.norm(g0) * Jv[2]"), 0),
        ("y component alone", SUM.format("-m * Jv[1] * g0[1]"), 0),
        ("z component alone", SUM.format("-m * Jv[2] * g0[2]"), 0),
        ("9.81 against y", SUM.format("-m * Jv.T @ np.array([0, -9.81, 0])"), 0),
        ("9.81 against z", SUM.format("m * Jv.T @ np.array([0, 0, 9.81])"), 0),
        ("9.81 along g0", SUM.format("-9.81 * m * Jv.T @ (g0 / np.linalg.norm(g0))"), 0),
        ("direction of g0 alone", SUM.format("-m * Jv.T @ (g0 / np.linalg.norm(g0))"), 0),
        ("masses ignored", SUM.format("-Jv.T @ g0"), 0),
        (
            "masses added up from the base",
            "masses = np.cumsum(masses)\nreturn " + SUM.format("-m * Jv.T @ g0"),
            0,
        ),
        (
            "masses added up from the hand",
            "-sum(masses[i:].sum() * jacobians_v[i].T @ g0 for i in range(len(masses)))",
            0,
        ),
        ("total mass at every link", "-np.sum(masses) * np.sum(jacobians_v, axis=0).T @ g0", 0),
        ("first link left out", LOOP.format("1, len(masses)", "+="), 0),
        ("last link left out", LOOP.format("len(masses) - 1", "+="), 0),
        ("last link alone", LOOP.format("len(masses)", "="), 0),
        ("first link alone", f"for m, Jv in {LINKS}:\n    return -m * Jv.T @ g0", 0),
        (
            "first link alone, sign of gravity",
            f"for m, Jv in {LINKS}:\n    return m * g0 @ Jv",
            0,
        ),
        (
            "last link alone, sign of gravity",
            f"for m, Jv in {LINKS}:\n    g = m * Jv.T @ g0\nreturn g",
            0,
        ),
        ("first two links alone", LOOP.format("2", "+="), 0),
        ("mean for sum", f"np.mean([-m * Jv.T @ g0 for m, Jv in {LINKS}], axis=0)", 0),
        ("reshaped for transposed", SUM.format("-m * Jv.reshape(-1, 3) @ g0"), 0),
    ],
    "p4-equilibria": [
        ("stretched only", f"[({HALF_PI}, 0), (-{HALF_PI}, 0)]", 0.5),
        ("stable only", f"[-{HALF_PI}, 0]", 0.5),
        (
            "one value of the inverse cosine",
            "q1 = np.arccos(0)\nreturn [(q1, np.arccos(0) - q1)]",
            0.5,
        ),
        ("link 1 up only", f"[({HALF_PI}, 0), ({HALF_PI}, np.pi)]", 0.5),
        ("link 1 down only", f"[(-{HALF_PI}, 0), (3 * {HALF_PI}, -np.pi)]", 0.5),
        ("from the vertical", "[(0, 0), (0, np.pi), (np.pi, 0), (np.pi, np.pi)]", 0),
        ("from the vertical, stretched only", "[(0, 0), (np.pi, 0)]", 0),
        (
            "absolute second angle",
            f"[(a, b) for a in (-{HALF_PI}, {HALF_PI}) for b in (-{HALF_PI}, {HALF_PI})]",
            0,
        ),
        (
            "folded by a quarter turn",
            f"[(a, b) for a in (-{HALF_PI}, {HALF_PI}) for b in (0, {HALF_PI})]",
            0,
        ),
        (
            "folded by a quarter turn",
            f"[(a, b) for a in (-{HALF_PI}, {HALF_PI}) for b in (0, -{HALF_PI})]",
            0,
        ),
        ("in degrees", "[(90, 0), (-90, 0), (90, 180), (-90, 180)]", 0),
    ],
}
