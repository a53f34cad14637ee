"""Wrong answers about gravity that are no known mistake, and what is no answer."""

from tests.autograder.problems.p4_gravity.table import SUM, P, of_links, torque, with_lines

G1, G2 = (
    "m1*lc1*g*np.cos(q1) + m2*g*(l1*np.cos(q1) + lc2*np.cos(q1 + q2))",
    "m2*lc2*g*np.cos(q1 + q2)",
)
OFF = "What is off in your gravity torque g1 of joint 1"
TRACED = {
    "p4-g_vec": [
        (
            P(f"[{G1} + 5, {G2}]"),
            "With every mass and inertia doubled, and all else that holds kilograms, the right values "
            "double, and those of your gravity torque g1 of joint 1 do not. Do all its terms have the "
            f"same unit? {OFF} is the same whatever the arguments are. Which of your terms is a mere "
            "number?",
        ),
        (
            P(f"[{G1} + m1*lc1*g, {G2}]"),
            f"{OFF} changes with arm.lc1, arm.m1 and arm.g alone. Which of its terms is made of nothing "
            "else?",
        ),
        (
            torque(second="q1 + 3*q2"),
            f"{OFF} changes with q[0], q[1], arm.lc2, arm.m2 and arm.g alone. Which of its terms is "
            "made of nothing else?",
            "The values of your gravity torque g2 of joint 2 are off by a factor that changes with q[0] "
            "and q[1] alone. How should they change with them?",
        ),
    ],
    "p4-potential_energy": [
        (
            with_lines(of_links(), "lc1 = 0.8 * lc1"),
            "In your change of P as link 1 turns from level and link 2 keeps its direction, the weight "
            "of link 1 beyond the shoulder comes out 20 % too small.",
        ),
    ],
    "p4-gravity_from_jacobians": [
        (
            SUM.format("-m * Jv.T @ (g0 * [1, 1, 0.75])"),
            "In your gravity torque from the Jacobians, the pull along z comes out 25 % too small.",
        ),
        (
            "1e4 * np.ones(jacobians_v.shape[2])",
            "In your gravity torque from the Jacobians, the values do not depend on jacobians_v, "
            "masses[0], masses[1] and 4 other numbers; the right ones do.",
        ),
    ],
}
UNEXPLAINED = {
    "p4-potential_energy": ["q[0] ** 2 + q[1]"],
}
NEARLY: dict = {}
ROW = "it must return one row (q1, q2) for each configuration."
UNFIT = {
    "p4-g_vec": [
        (of_links(), "returned one number, as P is; it must return one entry for each joint."),
    ],
    "p4-gravity_from_jacobians": [(SUM.format("-m * Jv @ g0"), "raised ValueError: matmul")],
    "p4-equilibria": [("[]", ROW), ("np.zeros((2, 4))", ROW)],
}
