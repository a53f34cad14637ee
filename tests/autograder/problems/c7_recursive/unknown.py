"""Wrong answers about the sweeps and a library that are no known mistake, and what is no answer."""

from tests.autograder.problems.c7_recursive.table import count, rnea, sign, terms

TRACED = {
    "c7-rnea": [
        (
            rnea("return u", "return u + np.cos(np.arange(n))"),
            *(
                "With every mass and inertia doubled, and all else that holds kilograms, the right "
                f"values double, and those of your torques {torques} do not. Do all its terms have the "
                f"same unit?{more}"
                for torques, more in (
                    ("at rest, in gravity", ""),
                    ("of a start from rest, without gravity", ""),
                    ("at constant joint rates, without gravity", ""),
                    (
                        "with all of these at once",
                        " What is off in your torques with all of these at once is the same whatever "
                        "the arguments are. Which of your terms is a mere number?",
                    ),
                )
            ),
        ),
        (
            rnea("-chain.gravity", "-1.1 * chain.gravity"),
            "In your torques at rest, in gravity, every value is 10 % too large. Which factor belongs "
            "to all terms?",
            "In your torques with all of these at once, gravity comes out 10 % too large.",
        ),
        (
            rnea("+ chain.viscous[k] * qd[k]", "+ 3 * chain.viscous[k] * qd[k]"),
            "In your torques at constant joint rates, without gravity, friction is 3 times as large as "
            "it should be.",
            "In your torques with all of these at once, friction is 3 times as large as it should be.",
        ),
    ],
    "c7-terms": [
        (
            terms("(b1 + b2) / 2, (b1 - b2) / 2", "b1 + b2, b1 - b2"),
            "In your C q̇, every value is twice the right one. Is a ½ missing, or does something "
            "count twice?",
            "In your f, every value is twice the right one. Is a ½ missing, or does something count "
            "twice?",
        ),
        (
            terms("M, c, g, f", "M, c, -g, f"),
            "In your g, every value has the wrong sign. What turns the sign of the whole?",
        ),
    ],
}
UNEXPLAINED = {
    "c7-gravity_sign": [sign("np.sign(w * i)", "w * i")],
    "c7-count": [count("return a, b", "return a + 5 * n % 7, b")],
}
NEARLY: dict = {}
UNFIT = {
    "c7-rnea": [
        (rnea("return u", "return u[:1]"), "an array of shape (1,); it must return shape (2,)"),
        ("return robot.m", "'robot'"),
    ],
    "c7-terms": [
        (
            terms("M, c, g, f", "M, c, g"),
            "something else than four things; it must return M, C q̇, g and f",
        ),
        (
            terms("M, c, g, f", "M[0], c, g, f"),
            "M with the shape (2,); for 2 joints it must be (2, 2)",
        ),
        (
            terms("M, c, g, f", "M, M, g, f"),
            "a matrix for C q̇; it must be the vector, of shape (2,)",
        ),
    ],
    "c7-gravity_sign": [(sign("[1]", ""), "it must return one number.")],
    "c7-count": [("return 37 * n", "it must return shape (2,)")],
}
