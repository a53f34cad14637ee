"""Wrong answers about the pendulum that are no known mistake, and what is no answer."""

from tests.autograder.problems.p3_pendulum.table import KINETIC, MGL, POTENTIAL

FACTOR = "Which factor belongs to all terms?"
ONE_EXAMPLE = (
    "the values do not depend on pend at all. Did you write the numbers of one example into the "
    "function?"
)
TRACED = {
    "p3-M": [
        (
            "1.1 * pend.I",
            f"In your inertia about the pivot, every value is 10 % too large. {FACTOR}",
        ),
        ("q[0]", f"In your inertia about the pivot, {ONE_EXAMPLE}"),
    ],
    "p3-g_vec": [
        *(
            (
                f"{MGL} * {wrong}",
                "The values of your gravity torque are off by a factor that changes with q[0] alone. "
                "How should they change with it?",
            )
            for wrong in (
                "np.sin(q) * np.cos(q)",
                "np.sin(5 * q)",
                "np.sin(q + 1)",
                "(1 + np.sin(q))",
            )
        ),
        (
            f"{MGL} * np.sin(q) * 1.0001",
            "In your gravity torque, every value is 0.01 % too large. Is a constant rounded?",
        ),
        (
            f"-{MGL} * np.sin(q) * 1.003",
            f"In your gravity torque, every value is −1.003 times the right one. {FACTOR}",
        ),
        ("q[0] ** 4", f"In your gravity torque, {ONE_EXAMPLE}"),
    ],
    "p3-inertia_about_pivot": [
        (
            "I_com + 0.9 * m * lc**2",
            "In your inertia moved to the pivot, the inertia of a point mass comes out 10 % too small.",
        ),
        (
            "I_com + m + lc**2",
            "With every mass and inertia doubled, and all else that holds kilograms, the right values "
            "double, and those of your inertia moved to the pivot do not. Do all its terms have the "
            "same unit? What is off in your inertia moved to the pivot changes with m and lc alone. "
            "Which of its terms is made of nothing else?",
        ),
    ],
    "p3-lagrangian": [
        (
            f"{KINETIC} - m * (g + lc) * (1 - sp.cos(q))",
            "With every length doubled and every inertia four times as large, the right values double, "
            "and those of your potential part of L do not. Do all its terms have the same unit?",
        ),
        (
            f"{KINETIC} - 0.7 * {POTENTIAL}",
            f"In your potential part of L, every value is 30 % too small. {FACTOR}",
        ),
    ],
    "p3-small_angle_frequency": [
        ("1.0", f"In your angular frequency of small swings, {ONE_EXAMPLE}"),
    ],
}
UNEXPLAINED = {
    "p3-C": ["0.3 + q"],
    # The terms of L are asked for by numbers that come one by one.
    "p3-lagrangian": [f"{KINETIC} - {POTENTIAL} * sp.cos(q / 3)"],
}
NEARLY = {"p3-C": ["1e-4 * qd"], "p3-lagrangian": [f"({KINETIC} - {POTENTIAL}) * 1.0001"]}
NUMBERS = "it must return numbers."
EXPRESSION = "it must return a SymPy expression of its arguments."
USE_SYMPY = "takes only numbers, and this is a SymPy expression: SymPy's own is sp.cos."
CALL_IT = "Call it: write its arguments behind it, in round brackets."
UNFIT = {
    "p3-g_vec": [
        (
            "'m g lc sin q'",
            f"returned the text 'm g lc sin q'; {NUMBERS} Without the quotes, Python would compute it.",
        ),
        ("(-pend.m) ** 0.5", f"{NUMBERS} Is it a root of something negative?"),
        ("np.array([1j])", f"{NUMBERS} Is there a root of something negative?"),
        ("np.array([True])", f"returned an array of True and False; {NUMBERS}"),
        ("bool(abs(q[0]) < 9)", f"returned True; {NUMBERS}"),
        ("np.sin", f"returned the function sin itself; {NUMBERS} {CALL_IT}"),
        ("sp.Eq(sp.Symbol('u'), 1)", f"returned the equation Eq(u, 1); {NUMBERS}"),
    ],
    "p3-lagrangian": [
        ("'K - P'", f"returned the text 'K - P'; {EXPRESSION}"),
        ("sp.Eq(q, 1)", f"returned the equation Eq(q, 1); {EXPRESSION}"),
        ("np.array([True])", f"returned True; {EXPRESSION}"),
        ("sp.Symbol('x') * q", f"returned an expression that still contains x; {EXPRESSION}"),
        ("m * np.cos(q)", USE_SYMPY),
        ("import math\nreturn m * math.cos(q)", USE_SYMPY),
    ],
}
