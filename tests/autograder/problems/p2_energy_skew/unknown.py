"""Wrong answers about Ṁ and C that are no known mistake, and what is no answer."""

from tests.autograder.problems.p2_energy_skew.table import ARM, SYMBOLS, C

ROUNDED = "every value is 0.01 % too large. Is a constant rounded?"
TRACED = {
    "p2-C": [
        (
            ARM + "return [[h * b, h * (a + b)], [-0.6 * h * a, 0]]",
            "In your vector C q̇, the centrifugal term of row 2 (q̇1²) comes out 40 % too small.",
        ),
        (ARM + f"return {C} * 1.0001", f"In your vector C q̇, {ROUNDED}"),
    ],
    "p2-M_dot": [
        (
            ARM + "return M_dot * np.cos(q[1])",
            *(
                f"The values of your {entries} are off by a factor that changes with q[1] alone. How "
                "should they change with it?"
                for entries in ("entry Ṁ11", "entries Ṁ12 and Ṁ21")
            ),
        ),
        (
            ARM + "return 1.1 * M_dot",
            "In your entry Ṁ11, every value is 10 % too large. Which factor belongs to all terms?",
            "In your entries Ṁ12 and Ṁ21, every value is 10 % too large. Which factor belongs to all "
            "terms?",
        ),
    ],
    "p2-C_other": [
        (
            ARM + "return [[0, h * (a + 1.3 * b)], [-h * a, 0]]",
            "In your vector C_other q̇, the Coriolis term of row 1 (q̇1 q̇2) is half of what it "
            "should be, and the centrifugal term of row 1 (q̇2²) comes out 30 % too large.",
        ),
    ],
    "p2-christoffel": [
        (SYMBOLS + "return 1.0001 * matrix(right)", f"In your vector C q̇, {ROUNDED}"),
    ],
}
UNEXPLAINED = {"p2-christoffel": [SYMBOLS + "return sp.zeros(n) + sp.eye(n)"]}
NEARLY = {"p2-christoffel": [SYMBOLS + "return 1.0001 * matrix(right)"]}
UNFIT = {
    "p2-M_dot": [(ARM + "return h * b", "an array of shape (); it must return shape (2, 2)")],
    "p2-C": [(ARM + "return [h, b]", "an array of shape (2,); it must return shape (2, 2)")],
    "p2-C_other": [("np.eye(3)", "an array of shape (3, 3); it must return shape (2, 2)")],
    "p2-christoffel": [
        ("sp.zeros(len(q), 1)", "shape (2, 1); it must return shape (2, 2)"),
        ("'C'", "returned the text 'C'; it must return SymPy expressions of its arguments."),
    ],
}
