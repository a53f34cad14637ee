"""Submissions to c6-regressor, made from the released notebook by editing it as a student would."""

from tests.submissions.answers import Answers, answered, cell_of

RIGHT = Answers(
    {
        "regressor": """
def regressor(q, qd, qdd, arm):
    c1, c2, s2, c12 = np.cos(q[0]), np.cos(q[1]), np.sin(q[1]), np.cos(q[0] + q[1])
    l1, g = arm.l1, arm.g
    Y = np.zeros((2, 6))
    Y[0, 1] = g * c1
    Y[0, 2] = qdd[0]
    Y[0, 3] = l1**2 * qdd[0] + l1 * g * c1
    Y[0, 4] = l1 * c2 * (2 * qdd[0] + qdd[1]) + g * c12
    Y[0, 4] -= l1 * s2 * (2 * qd[0] * qd[1] + qd[1] ** 2)
    Y[1, 4] = l1 * c2 * qdd[0] + l1 * s2 * qd[0] ** 2 + g * c12
    Y[:, 5] = qdd[0] + qdd[1]
    return Y
""",
        "rank_of_excitation": """
def rank_of_excitation(q, qd, qdd, arm):
    rows = []
    for k in range(len(q)):
        rows.extend(regressor(q[k], qd[k], qdd[k], arm))
    return np.linalg.matrix_rank(np.array(rows))
""",
        "identify": """
def identify(q, qd, qdd, u, arm):
    W = np.concatenate([regressor(a, b, c, arm) for a, b, c in zip(q, qd, qdd)])
    W = np.delete(W, [0, 3], axis=1)
    return np.linalg.pinv(W) @ u.reshape(-1)
""",
    }
)
POINTS = {"c6-regressor": 4.0, "c6-rank_of_excitation": 3.0, "c6-identify": 3.0}

function, right_but = RIGHT.function, RIGHT.right_but


def right(release):
    notebook = right_but(release)
    cell_of(notebook, "c6-discussion").source = "The square of ℓc in m ℓc² is ..."
    return notebook


def wrong(release):
    """Gravity upside down in every column that has it, all columns counted, one joint's order."""
    return answered(
        release,
        regressor=RIGHT["regressor"]
        .replace("arm.l1, arm.g", "arm.l1, -arm.g")
        .replace("Y[0, 2] = qdd[0]", "Y[0, 2] = Y[1, 2] = qdd[0]")
        .replace("Y[:, 5] = qdd[0] + qdd[1]", "Y[:, 5] = qdd[1]"),
        rank_of_excitation=function("rank_of_excitation", "return 6"),
        identify=RIGHT["identify"].replace("u.reshape(-1)", "u.T.reshape(-1)"),
    )


def partly_right(release):
    """The coupling without its factor 2, so that the fit is wrong too; and one joint's rank."""
    return right_but(
        release,
        regressor=RIGHT["regressor"].replace("(2 * qdd[0] + qdd[1])", "(qdd[0] + qdd[1])"),
        rank_of_excitation=RIGHT["rank_of_excitation"]
        .replace("rows.extend", "rows.append")
        .replace("qdd[k], arm)", "qdd[k], arm)[0]"),
    )
