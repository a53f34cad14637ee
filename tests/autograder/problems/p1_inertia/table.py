"""Wrong answers about inertia: the mistakes that each shows, and the credit left."""

# The arm's inertias and its coupling, for bodies of a function that change one of them.
ARM = """
l1, l2, lc1, lc2 = arm.l1, arm.l2, arm.lc1, arm.lc2
m1, m2, I1, I2 = arm.m1, arm.m2, arm.I1, arm.I2
q1, q2 = q
c = m2 * l1 * lc2 * np.cos(q2)
M22 = I2 + m2 * lc2**2
M12 = M22 + c
M21 = M12
M11 = I1 + m1 * lc1**2 + M22 + m2 * l1**2 + 2 * c
"""

RESULT = "\nreturn [[M11, M12], [M21, M22]]"

LINKS = "sum(J.T @ I @ J for J, I in zip(jacobians, inertias))"


def arm(*changes: str, first: str = "") -> str:
    """The body of a right M with lines before the formulas, and lines after them."""
    formulas = ARM.replace("q1, q2 = q\n", f"q1, q2 = q\n{first}\n")
    return formulas + "\n".join(changes) + RESULT


def coupled(coupling: str) -> str:
    """The body of M with another coupling of the two links."""
    return arm(f"old, c = c, {coupling}", "M12 += c - old", "M21 = M12", "M11 += 2 * (c - old)")


BASE = {"l1": 1.0, "l2": 0.8, "lc1": 0.0, "lc2": 0.4, "m1": 2, "m2": 3, "I1": 0, "I2": 0, "g": 9.81}


def singular(parameters: dict, q: str) -> str:
    """The answer of singular_arm: an arm of point masses, but for these parameters, and a q."""
    return f"{BASE | parameters}, {q}"


ROUNDED = "rounding taken for a positive eigenvalue"
# Of M11, all but the part of link 2's motion.
REST = "I1 + m1 * lc1**2 + I2"
TABLE = {
    "p1-inertia_from_links": [
        ("I not used", "sum(J.T @ J for J in jacobians)", 0),
        (
            "only the diagonal of I",
            "sum(J.T @ np.diag(np.diag(I)) @ J for J, I in zip(jacobians, inertias))",
            0,
        ),
        (
            "coupling of rotation and translation dropped",
            "sum(J[:3].T @ I[:3, :3] @ J[:3] + J[3:].T @ I[3:, 3:] @ J[3:] "
            "for J, I in zip(jacobians, inertias))",
            0,
        ),
        (
            "halves of J swapped",
            "J = np.concatenate([jacobians[:, 3:], jacobians[:, :3]], axis=1)\n"
            "return sum(j.T @ I @ j for j, I in zip(J, inertias))",
            0,
        ),
        (
            "inverse of I",
            "sum(J.T @ np.linalg.solve(I, J) for J, I in zip(jacobians, inertias))",
            0,
        ),
        ("half", f"0.5 * {LINKS}", 0),
        (
            "last link only",
            "for J, I in zip(jacobians, inertias):\n    M = J.T @ I @ J\nreturn M",
            0.5,
        ),
        ("first link only", "for J, I in zip(jacobians, inertias):\n    return J.T @ I @ J", 0.5),
        (
            "last link left out",
            "M = np.zeros((jacobians.shape[2],) * 2)\nfor k in range(len(jacobians) - 1):\n"
            "    M += jacobians[k].T @ inertias[k] @ jacobians[k]\nreturn M",
            0,
        ),
        (
            "first link left out",
            "M = np.zeros((jacobians.shape[2],) * 2)\nfor k in range(1, len(jacobians)):\n"
            "    M += jacobians[k].T @ inertias[k] @ jacobians[k]\nreturn M",
            0,
        ),
        (
            "mean for sum",
            "np.mean([J.T @ I @ J for J, I in zip(jacobians, inertias)], axis=0)",
            0.5,
        ),
        (
            "links added before they are multiplied",
            "J, I = sum(jacobians), sum(inertias)\nreturn J.T @ I @ J",
            0.5,
        ),
        ("diagonal of the matrix alone", f"np.diag(np.diag({LINKS}))", 0),
        ("upper triangle of the matrix alone", f"np.triu({LINKS})", 0),
        ("inverse for matrix", f"np.linalg.inv({LINKS})", 0),
    ],
    "p1-M": [
        (
            "square of the sum and twice the coupling",
            arm(f"M11 = {REST} + m2 * (l1 + lc2) ** 2 + 2 * c"),
            0.5,
        ),
        (
            (
                "square of the sum and twice the coupling",
                "double angle / the coupling of the two links / M12 / q2",
            ),
            arm(
                f"M11 = {REST} + m2 * (l1 + lc2) ** 2 + 2 * c",
                "M12 += m2 * l1 * lc2 * np.cos(2 * q2) - c",
                "M21 = M12",
            ),
            0.25,
        ),
        (
            "square of the sum and the coupling",
            arm(f"M11 = {REST} + m2 * (l1 + lc2) ** 2 + c"),
            0.5,
        ),
        (
            "cosine on the square of the sum",
            arm(f"M11 = {REST} + m2 * (l1 + lc2) ** 2 * np.cos(q2)"),
            0.5,
        ),
        (
            "cosine on the whole distance",
            arm(f"M11 = {REST} + m2 * ((l1 + lc2) * np.cos(q2)) ** 2"),
            0.5,
        ),
        (
            "distance along link 1",
            arm(f"M11 = {REST} + m2 * (l1 + lc2 * np.cos(q2)) ** 2"),
            0.5,
        ),
        (
            "distance along link 2",
            arm(f"M11 = {REST} + m2 * (l1 * np.cos(q2) + lc2) ** 2"),
            0.5,
        ),
        (
            "wrong wave / the coupling of the two links / q1 + q2 / q2",
            coupled("m2 * l1 * lc2 * np.sin(q1 + q2)"),
            0.25,
        ),
        (
            "wrong angle / the coupling of the two links / M11 / q1 + 2 q2 / q2",
            arm("M11 += 2 * (m2 * l1 * lc2 * np.cos(q1 + 2 * q2) - c)"),
            0.5,
        ),
        ("dropped / the rotation of link 2 / M12", arm("M12 -= I2", "M21 -= I2"), 0.75),
        (
            "wrong angle / the coupling of the two links / q1 / q2",
            coupled("m2 * l1 * lc2 * np.cos(q1)"),
            0.25,
        ),
        ("wave lost / the coupling of the two links / q2", coupled("m2 * l1 * lc2"), 0.25),
        ("halved / the coupling of the two links / M11", arm("M11 -= c"), 0.5),
        ("upper triangle alone", arm("M21 = 0"), 0.75),
        ("sign below the diagonal", arm("M21 = -M12"), 0.75),
        ("joints exchanged", arm("M11, M22 = M22, M11"), 0.25),
        (
            ("dropped / the rotation of link 1", "dropped / the rotation of link 2 / M12"),
            arm("M12 -= I2", "M21 -= I2", first="I1 = 0"),
            0.25,
        ),
        (
            (
                "dropped / the rotation of link 1",
                "dropped / the centre of mass of link 1 about the shoulder",
            ),
            arm("M11 -= I1 + m1 * lc1**2"),
            0.5,
        ),
        (
            ("halved / the coupling of the two links / M11", "upper triangle alone"),
            arm("M11 -= c", "M21 = 0"),
            0.25,
        ),
    ],
    "p1-is_spd": [
        (
            (ROUNDED, "one triangle read"),
            "try:\n    np.linalg.cholesky(A)\n"
            "except np.linalg.LinAlgError:\n    return False\nreturn True",
            0.5,
        ),
        ((ROUNDED, "one triangle read"), "np.all(np.linalg.eigvalsh(A) > 0)", 0.5),
        ("one triangle read", "np.linalg.eigvalsh(A)[0] > 1e-9", 0.7),
        ("eigenvalues of any matrix", "np.all(np.linalg.eigvals(A).real > 1e-9)", 0.7),
        ("symmetric part only", "np.linalg.eigvalsh((A + A.T) / 2).min() > 1e-9", 0.7),
        ((ROUNDED, "eigenvalues of any matrix"), "np.all(np.linalg.eigvals(A) > 0)", 0.5),
        ((ROUNDED, "symmetric part only"), "np.linalg.eigvalsh((A + A.T) / 2).min() > 0", 0.5),
        ("determinant alone", "np.linalg.det(A) > 0", 0.2),
        (
            "determinant of a symmetric matrix",
            "np.allclose(A, A.T) and np.linalg.det(A) > 1e-10",
            0.7,
        ),
        (
            "zero eigenvalue accepted",
            "np.allclose(A, A.T) and np.linalg.eigvalsh(A)[0] > -1e-9",
            0.8,
        ),
        ("zero eigenvalue accepted", "np.allclose(A, A.T) and np.linalg.eigvalsh(A)[0] >= 0", 0.8),
        (
            ROUNDED,
            "np.allclose(A, A.T) and np.linalg.eigvalsh(A)[0] > 0",
            0.8,
        ),
        ("exact symmetry", "np.all(A == A.T) and np.linalg.eigvalsh(A)[0] > 1e-9", 0.8),
        ("symmetry alone", "np.allclose(A, A.T)", 0.3),
        ("diagonal alone", "np.allclose(A, A.T) and np.diag(A).min() > 0", 0.5),
        ("entries positive", "np.allclose(A, A.T) and A.min() > 0", 0),
        ("one positive eigenvalue", "np.allclose(A, A.T) and any(np.linalg.eigvalsh(A) > 0)", 0.3),
        (
            "eigenvalues of one sign",
            "values = np.linalg.eigvalsh(A)\n"
            "return np.allclose(A, A.T) and (all(values > 1e-9) or all(values < -1e-9))",
            0.7,
        ),
        ("answer reversed", "not (np.allclose(A, A.T) and np.linalg.eigvalsh(A)[0] > 1e-9)", 0),
        ("always True", "True", 0),
        ("always False", "False", 0),
        (
            ("rounding taken for a positive eigenvalue", "exact symmetry"),
            "np.all(A == A.T) and np.linalg.eigvalsh(A)[0] > 0",
            0.6,
        ),
    ],
    "p1-singular_arm": [
        ("link 2 has a size", singular({"lc1": 0.5, "I1": 0.1, "I2": 0.05}, "[0, np.pi]"), 0),
        ("point masses in a bent arm", singular({}, "[0, 180]"), 0),
        ("link 1 resists", singular({"lc1": 0.5}, "[1.0, 0.0]"), 0),
        ("point masses beside their joints", singular({"lc1": 0.5}, "[1.0, 1.0]"), 0),
        ("massless link", singular({"m2": 0.0}, "[0, 0.3]"), 0.5),
        ("link without length", singular({"l1": 0.0}, "[0, 0.3]"), 0.5),
        ("negative parameter", singular({"lc2": -0.4}, "[0, 0]"), 0.5),
        (
            ("massless link", "negative parameter"),
            singular({"m1": 0, "lc2": -0.4}, "[0, 0]"),
            0.5,
        ),
    ],
}
