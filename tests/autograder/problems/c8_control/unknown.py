"""Wrong answers about controllers that are no known mistake, and what is no answer."""

from tests.autograder.problems.c8_control.table import Y, hold, law, rate

TRACED = {
    "c8-gravity_compensation": [
        (
            hold(damper="- 1.5 * arm.kd * qd"),
            "In your torque in motion, the damping comes out 50 % too large.",
        ),
    ],
    "c8-regressor_r": [
        (
            Y().replace("return np", "return np.cos(np.arange(12)).reshape(2, 6) + np"),
            *(
                f"What is off in your {columns} is the same whatever the arguments are. Which of your "
                "terms is a mere number?"
                for columns in (
                    "columns of the masses m1 and m2",
                    "column of m1 ℓc1",
                    "columns of the inertias J1 and J2",
                    "column of m2 ℓc2, joint 1",
                    "column of m2 ℓc2, joint 2",
                )
            ),
        ),
    ],
    "c8-slotine_li": [
        (
            law(both="np.cos(np.arange(8)) + np.concatenate([u, rate])"),
            *(
                f"What is off in your {part} is the same whatever the arguments are. Which of your "
                "terms is a mere number?"
                for part in (
                    "torque u",
                    "rates of the estimates of m1 and m2",
                    "rates of the estimates of m1 ℓc1 and m2 ℓc2",
                    "rates of the estimates of J1 and J2",
                )
            ),
        ),
    ],
    "c8-V_dot": [
        (
            rate("-D + 1.3 * R - F"),
            "In your V̇ with a valid C that is not skew, the part with Ṁ comes out 30 % too large.",
        ),
        (
            rate("-D + R - F + s @ s * q[0]"),
            *(
                f"In your V̇ with {which}, the values depend on q[0]; the right ones do not."
                for which in ("the Christoffel C", "a valid C that is not skew")
            ),
        ),
        (
            rate("-1.3 * D + R - F"),
            "In your V̇ with the Christoffel C, every value is 30 % too large. Which factor belongs "
            "to all terms?",
            "In your V̇ with a valid C that is not skew, the damping comes out 30 % too large.",
        ),
    ],
}
UNEXPLAINED: dict = {}
NEARLY = {"c8-slotine_li": [law(both="np.concatenate([u * 1.0001, rate])")]}
UNFIT = {
    "c8-gravity_compensation": [(hold("0", "0", "+ qd[0]"), "it must return shape (2,)")],
    "c8-regressor_r": [
        (
            Y().replace("return np.array(", "return np.transpose("),
            "shape (6, 2); it must return one row for each joint and one column for each of the six",
        ),
    ],
    "c8-slotine_li": [
        (law(both="u"), "it must return shape (8,)"),
        (law(both="(u, rate)"), "a tuple of 2 unlike parts; it must return numbers."),
    ],
    "c8-V_dot": [(rate("s"), "it must return one number.")],
}
