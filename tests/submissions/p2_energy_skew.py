"""Submissions to p2-energy-skew, made from the released notebook by editing it as a student would."""

from tests.submissions.answers import Answers, answered, cell_of

RIGHT = Answers(
    {
        "M_dot": """
def M_dot(q, qd, arm):
    eps = 1e-6
    return (M(q + eps * qd, arm) - M(q - eps * qd, arm)) / (2 * eps)
""",
        "C": """
def C(q, qd, arm):
    eps = 1e-6
    d = [(M(q + eps * e, arm) - M(q - eps * e, arm)) / (2 * eps) for e in np.eye(2)]
    C = np.zeros((2, 2))
    for i in range(2):
        for j in range(2):
            for k in range(2):
                C[i, j] += (d[k][i, j] + d[j][i, k] - d[i][j, k]) / 2 * qd[k]
    return C
""",
        "C_other": """
def C_other(q, qd, arm):
    return C(q, qd, arm) + [[0, 0], [qd[1], -qd[0]]]
""",
        "christoffel": """
def christoffel(M, q, qd):
    rows = []
    for i in range(len(q)):
        row = []
        for j in range(len(q)):
            entry = 0
            for k in range(len(q)):
                h = M[i, j].diff(q[k]) + M[i, k].diff(q[j]) - M[j, k].diff(q[i])
                entry += h / 2 * qd[k]
            row.append(entry)
        rows.append(row)
    return rows
""",
    }
)
POINTS = {"p2-M_dot": 2.0, "p2-C": 5.0, "p2-C_other": 2.0, "p2-christoffel": 3.0}

right_but = RIGHT.right_but


def right(release):
    notebook = right_but(release)
    cell_of(notebook, "p2-proof").source = "dE/dt = qd' u + qd' (Mdot - 2C) qd / 2, ..."
    return notebook


def wrong(release):
    """Four mistakes, one a cell."""
    return answered(
        release,
        M_dot="""
def M_dot(q, qd, arm):
    rate = -arm.m2 * arm.l1 * arm.lc2 * np.sin(q[1]) * qd[0]
    return [[2 * rate, rate], [rate, rate]]
""",
        C="""
def C(q, qd, arm):
    h = -arm.m2 * arm.l1 * arm.lc2 * np.sin(q[1])
    return np.array([h * (qd[0] + 2 * qd[1]), -h * qd[0]])
""",
        C_other="""
def C_other(q, qd, arm):
    h = -arm.m2 * arm.l1 * arm.lc2 * np.sin(q[1])
    return [[0, h * (qd[0] + qd[1])], [-h * qd[0], 0]]
""",
        christoffel="""
def christoffel(M, q, qd):
    return sum((M.diff(a) * v for a, v in zip(q, qd, strict=True)), sp.zeros(len(q)))
""",
    )


def partly_right(release):
    """A C that moves the arm but is not skew, the same one again, Ṁ11 too small by half."""
    return right_but(
        release,
        M_dot="""
def M_dot(q, qd, arm):
    rate = -arm.m2 * arm.l1 * arm.lc2 * np.sin(q[1]) * qd[1]
    return [[rate, rate], [rate, 0]]
""",
        C="""
def C(q, qd, arm):
    h = -arm.m2 * arm.l1 * arm.lc2 * np.sin(q[1])
    return [[0, h * (2 * qd[0] + qd[1])], [-h * qd[0], 0]]
""",
        C_other="""
def C_other(q, qd, arm):
    h = -arm.m2 * arm.l1 * arm.lc2 * np.sin(q[1])
    return [[h * qd[1], h * (qd[0] + qd[1])], [-h * qd[0], 0]]
""",
    )
