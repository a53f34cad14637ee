"""Wrong answers about inertia that are no known mistake, and what is no answer."""

from tests.autograder.problems.p1_inertia.table import BASE, LINKS, arm, singular

FIXED = "[[1.7 + 0.4 * np.cos(q[1]), 0.6 + 0.2 * np.cos(q[1])], [0.6 + 0.2 * np.cos(q[1]), 0.6]]"
IN_KILOGRAMS = (
    "With every mass and inertia doubled, and all else that holds kilograms, the right values"
)
SAME_UNIT = "Do all its terms have the same unit?"
TRACED = {
    "p1-M": [
        (
            arm("M11 += np.cos(q2)"),
            f"{IN_KILOGRAMS} double, and those of your M11 do not. {SAME_UNIT} What is off in your M11 "
            "changes with q[1] alone. Which of its terms is made of nothing else?",
        ),
        (
            arm("M11 -= 0.1 * m1 * lc1**2"),
            "In your M11, the centre of mass of link 1 about the shoulder comes out 10 % too small.",
        ),
        (
            arm("M11 += np.sin(q1)"),
            "In your M11, the values depend on q[0]; the right ones do not.",
        ),
        (
            arm("M22 *= 1 + 0.3 * np.sin(q2)"),
            "In your M22, the values depend on q[1]; the right ones do not.",
        ),
        (
            arm("M22 = M22 / l2**2"),
            "In your M22, the values depend on arm.l2; the right ones do not.",
        ),
        (arm("M21 += np.sin(q1)"), "Your M12 and M21 differ from each other. Should they?"),
        (
            FIXED,
            *(
                f"In your {entry}, the values do not depend on arm at all. Did you write the numbers of "
                "one example into the function?"
                for entry in ("M11", "M12 and M21", "M22")
            ),
        ),
    ],
    "p1-inertia_from_links": [
        (
            f"{LINKS} + 1",
            *(
                f"What is off in your matrix of {links} is the same whatever the arguments are. Which "
                "of your terms is a mere number?"
                for links in ("one link", "several links")
            ),
        ),
    ],
}
UNEXPLAINED: dict = {}
NEARLY = {
    "p1-singular_arm": [
        singular({"I2": 1e-4}, "[0, np.pi]"),
        singular({"lc1": 1e-3}, "[0, np.pi]"),
        singular({}, "[0, 3.14]"),
        singular({"lc2": 1e-9, "I1": 1, "l1": 2}, "[0, 1]"),
    ],
}
UNFIT = {
    "p1-inertia_from_links": [
        ("np.zeros((6, 6))", "it must return shape (3, 3)"),
        (LINKS.replace("J.T @ I @ J", "J @ I @ J.T"), "matmul"),
    ],
    "p1-M": [("arm.I1", "it must return shape (2, 2)")],
    "p1-is_spd": [
        ("np.linalg.eigvalsh(A)[0] * 0 + 0.7", "0.7; it must return True or False"),
        ("np.linalg.eigvalsh(A) > 0", "it must return one, True or False"),
        ("'yes'", "returned the text 'yes'; it must return True or False."),
        ("sp.Symbol('x') > 0", "returned the inequality x > 0; it must return True or False."),
    ],
    "p1-singular_arm": [
        ("np.zeros(9)", "it must return (arm, q), with arm a dict"),
        ("{'l1': 1.0}, [0, 0]", "an arm without l2, lc1, lc2, m1, m2, I1, I2"),
        (f"{BASE}, 0", "a q that is not two angles"),
        (singular({"I1": [0, 0]}, "[0, 0]"), "an arm whose I1 is not one number"),
    ],
}
