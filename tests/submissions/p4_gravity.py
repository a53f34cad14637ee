"""Submissions to p4-gravity, made from the released notebook by editing it as a student would."""

from tests.submissions.answers import Answers, answered, cell_of

RIGHT = Answers(
    {
        "potential_energy": """
def potential_energy(q, arm):
    y1 = arm.lc1 * np.sin(q[0])
    y2 = arm.l1 * np.sin(q[0]) + arm.lc2 * np.sin(q[0] + q[1])
    return arm.m1 * arm.g * y1 + arm.m2 * arm.g * y2
""",
        "g_vec": """
def g_vec(q, arm):
    step = 1e-6
    return [
        (potential_energy(q + np.array(d), arm) - potential_energy(q - np.array(d), arm)) / 2 / step
        for d in ([step, 0], [0, step])
    ]
""",
        "gravity_from_jacobians": """
def gravity_from_jacobians(jacobians_v, masses, g0):
    total = np.zeros(jacobians_v.shape[2])
    for i in range(len(masses)):
        total -= masses[i] * g0 @ jacobians_v[i]
    return total
""",
        "equilibria": """
def equilibria(arm):
    return [(a, b) for a in (np.pi / 2, 3 * np.pi / 2) for b in (0, -np.pi)]
""",
    }
)
POINTS = {
    "p4-potential_energy": 2.0,
    "p4-g_vec": 3.0,
    "p4-gravity_from_jacobians": 3.0,
    "p4-equilibria": 2.0,
}

function, right_but = RIGHT.function, RIGHT.right_but


def right(release):
    notebook = right_but(release)
    cell_of(notebook, "p4-check").source = "g2 = ∂P/∂q2 has one term, g1 has three, ..."
    return notebook


def wrong(release):
    """Four mistakes, one a cell, each about the whole of its answer."""
    return answered(
        release,
        potential_energy=function(
            "potential_energy",
            "-arm.g * (arm.m1 * arm.lc1 * np.sin(q[0])"
            " + arm.m2 * (arm.l1 * np.sin(q[0]) + arm.lc2 * np.sin(q[0] + q[1])))",
        ),
        g_vec="""
def g_vec(q, arm):
    g2 = arm.m2 * arm.lc2 * arm.g * np.cos(q[1])
    return np.array([(arm.m1 * arm.lc1 + arm.m2 * arm.l1) * arm.g * np.cos(q[0]) + g2, g2])
""",
        gravity_from_jacobians=function(
            "gravity_from_jacobians", "sum(m * J.T @ g0 for m, J in zip(masses, jacobians_v))"
        ),
        equilibria=function("equilibria", "[(0, 0), (np.pi, 0), (0, np.pi), (np.pi, np.pi)]"),
    )


def partly_right(release):
    """P without the elbow's height, g1 without link 2, only two of four equilibria; the rest right."""
    return right_but(
        release,
        potential_energy=function(
            "potential_energy",
            "arm.g * (arm.m1 * arm.lc1 * np.sin(q[0]) + arm.m2 * arm.lc2 * np.sin(q[0] + q[1]))",
        ),
        g_vec=function(
            "g_vec",
            "[(arm.m1 * arm.lc1 + arm.m2 * arm.l1) * arm.g * np.cos(q[0]),"
            " arm.m2 * arm.lc2 * arm.g * np.cos(q[0] + q[1])]",
        ),
        equilibria=function("equilibria", "[(np.pi / 2, 0), (-np.pi / 2, 0)]"),
    )


def crashing(release):
    """g_vec ends Python when called, the cell of equilibria ends it when run."""
    return right_but(
        release,
        g_vec="import os\n" + function("g_vec", "os._exit(1)"),
        equilibria="import os\nos._exit(1)\n" + RIGHT["equilibria"],
    )
