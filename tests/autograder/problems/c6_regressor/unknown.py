"""Wrong answers about the regressor that are no known mistake, and what is no answer."""

from tests.autograder.problems.c6_regressor.table import ALL_V, LIST, Y, count, fit

CONSTANT = "is the same whatever the arguments are. Which of your terms is a mere number?"
TRACED = {
    "c6-regressor": [
        (
            Y("return Y", "return Y + np.cos(np.arange(12)).reshape(2, 6)"),
            *(
                f"What is off in your {columns} {CONSTANT}"
                for columns in (
                    "columns of the masses m1 and m2",
                    "column of m1 ℓc1",
                    "columns of the inertias J1 and J2",
                    "column of m2 ℓc2, joint 1",
                    "column of m2 ℓc2, joint 2",
                )
            ),
        ),
        (
            Y("mc1[0] = g * c1", "mc1[0] = 0.7 * g * c1", "l1 * mc1[0]", "l1 * g * c1"),
            "In your column of m1 ℓc1, every value is 30 % too small. Which factor belongs to all "
            "terms?",
        ),
        (
            Y(ALL_V, f"- 2.5{ALL_V[1:].replace('l1', '* l1', 1)}"),
            "In your column of m2 ℓc2, joint 1, its velocity part is 2.5 times as large as it "
            "should be.",
        ),
    ],
}
UNEXPLAINED = {
    "c6-identify": [fit("return b", "return b + 0.1")],
    "c6-rank_of_excitation": ["1.5 * len(q)"],
}
NEARLY: dict = {}
UNFIT = {
    "c6-regressor": [
        (
            Y(LIST, "[m1, mc1, J1, m2, mc2, J2])"),
            "shape (6, 2); it must return one row for each joint, (2, 6).",
        ),
        (
            Y(LIST, "[mc1, J1, mc2, J2]).T"),
            "shape (2, 4); it must return one row for each joint and one column for each of the six ",
        ),
    ],
    "c6-identify": [
        (
            fit("[1, 2, 4, 5]", "[0, 1, 2, 3, 4, 5]", "(-1, 4)", "(-1, 6)"),
            "6 numbers; it must return the four base parameters, since no motion shows all six of π.",
        ),
        ("return arm.m1, 0, 0, 0", "has no attribute 'm1'"),
        (
            "return np.linalg.lstsq(np.ones((9, 4)), np.ones(9))",
            "a tuple of 4 unlike parts; it must return numbers. Which of its parts is the answer?",
        ),
        (
            "return np.linalg.lstsq(np.ones((2 * len(u), 4)), u)[0]",
            "Incompatible dimensions",
        ),
    ],
    "c6-rank_of_excitation": [(count("matrix_rank(W)", "svd(W)[1]"), "it must return one number.")],
}
