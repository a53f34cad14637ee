"""Submissions to c8-control, made from the released notebook by editing it as a student would."""

from tests.submissions.answers import Answers, cell_of

RIGHT = Answers(
    {
        "gravity_compensation": """
def gravity_compensation(q, qd, q_star, arm):
    error = q - q_star
    return g_vec(q, arm) - np.array([arm.kp[i] * error[i] + arm.kd[i] * qd[i] for i in (0, 1)])
""",
        "regressor_r": """
def regressor_r(q, qd, qd_r, qdd_r, arm):
    c1, c2, s2, c12 = np.cos(q[0]), np.cos(q[1]), np.sin(q[1]), np.cos(q[0] + q[1])
    l1, g = arm.l1, arm.g
    Y = np.zeros((2, 6))
    Y[0, 1] = g * c1
    Y[0, 2] = qdd_r[0]
    Y[0, 3] = l1**2 * qdd_r[0] + l1 * g * c1
    Y[0, 4] = l1 * c2 * (2 * qdd_r[0] + qdd_r[1]) + g * c12
    Y[0, 4] -= l1 * s2 * (qd[1] * qd_r[0] + (qd[0] + qd[1]) * qd_r[1])
    Y[1, 4] = l1 * c2 * qdd_r[0] + l1 * s2 * qd[0] * qd_r[0] + g * c12
    Y[:, 5] = qdd_r[0] + qdd_r[1]
    return Y
""",
        "slotine_li": """
def slotine_li(q, qd, ref, pi_hat, gains, arm):
    s = (qd - ref.qd) + gains.Lam.dot(q - ref.q)
    Y = regressor_r(q, qd, qd - s, ref.qdd - gains.Lam.dot(qd - ref.qd), arm)
    u = Y.dot(pi_hat) - gains.KD.dot(s)
    rate = -gains.Gamma.dot(Y.T.dot(s))
    return [*u, *rate]
""",
        "V_dot": """
def V_dot(q, qd, s, C_used, gains, arm):
    half_M_dot = (C(q, qd, arm) + C(q, qd, arm).T) / 2
    return s @ (half_M_dot - C_used - gains.KD) @ s
""",
    }
)
POINTS = {
    "c8-gravity_compensation": 2.0,
    "c8-regressor_r": 3.0,
    "c8-slotine_li": 3.0,
    "c8-V_dot": 2.0,
}

right_but = RIGHT.right_but


def right(release):
    notebook = right_but(release)
    cell_of(notebook, "c8-discussion").source = "With g(q*) the soft spring lets the arm fall, ..."
    return notebook


def wrong(release):
    """Gravity upside down in A and B, the sum of A's spring left; s turned round; no damping in D."""
    return right_but(
        release,
        gravity_compensation=RIGHT["gravity_compensation"].replace("return g_vec", "return -g_vec"),
        regressor_r=RIGHT["regressor_r"]
        .replace("arm.l1, arm.g", "arm.l1, -arm.g")
        .replace("Y[:, 5] = qdd_r[0] + qdd_r[1]", "Y[:, 5] = qdd_r[1]"),
        slotine_li=RIGHT["slotine_li"].replace("s = (qd - ref.qd) + ", "s = (qd - ref.qd) - "),
        V_dot=RIGHT["V_dot"].replace(" - gains.KD", ""),
    )


def partly_right(release):
    """Gravity at the goal, the other valid C in Y_r (and so in the law), and skewness for granted."""
    return right_but(
        release,
        gravity_compensation=RIGHT["gravity_compensation"].replace("g_vec(q,", "g_vec(q_star,"),
        regressor_r=RIGHT["regressor_r"].replace(
            "(qd[1] * qd_r[0] + (qd[0] + qd[1]) * qd_r[1])", "((2 * qd[0] + qd[1]) * qd_r[1])"
        ),
        V_dot=RIGHT["V_dot"].replace("half_M_dot - C_used - gains.KD", "-gains.KD"),
    )
