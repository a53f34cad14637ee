"""Wrong answers about gravity that are no known mistake, and what is no answer."""

from tests.autograder.problems.p4_gravity.table import SUM, of_links, with_lines

TRACED = {
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
    ],
}
UNEXPLAINED = {
    "p4-potential_energy": ["q[0] ** 2 + q[1]"],
    "p4-gravity_from_jacobians": ["1e4 * np.ones(jacobians_v.shape[2])"],
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
