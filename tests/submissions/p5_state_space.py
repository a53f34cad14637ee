"""Submissions to p5-state-space, made from the released notebook by editing it as a student would."""

from tests.submissions.answers import Answers, cell_of

RIGHT = Answers(
    {
        "f": """
def f(x, u, arm):
    qd = x[2:]
    rest = u - C(x[:2], qd, arm).dot(qd) - g_vec(x[:2], arm)
    for i in range(2):
        rest[i] -= arm.viscous[i] * qd[i]
        if qd[i] != 0:
            rest[i] -= arm.coulomb[i] * qd[i] / abs(qd[i])
    return [*qd, *(np.linalg.inv(M(x[:2], arm)) @ rest)]
""",
        "rk4_step": """
def rk4_step(f, x, u, dt):
    a = dt * f(x, u)
    b = dt * f(x + a / 2, u)
    c = dt * f(x + b / 2, u)
    d = dt * f(x + c, u)
    return x + (a + 2 * b + 2 * c + d) / 6
""",
        "simulate": """
def simulate(f, x0, u, t):
    states = [x0]
    for start, end in zip(t[:-1], t[1:]):
        held = u(start, states[-1]) if callable(u) else u
        states.append(rk4_step(f, states[-1], held, end - start))
    return states
""",
        "energy_drift": """
def energy_drift(x, arm):
    E = []
    for q1, q2, qd1, qd2 in x:
        qd = np.array([qd1, qd2])
        y1 = arm.lc1 * np.sin(q1)
        y2 = arm.l1 * np.sin(q1) + arm.lc2 * np.sin(q1 + q2)
        K = qd @ M(np.array([q1, q2]), arm) @ qd / 2
        E.append(K + arm.g * (arm.m1 * y1 + arm.m2 * y2 + 7.0))
    return [e - E[0] for e in E]
""",
    }
)
POINTS = {"p5-f": 4.0, "p5-rk4_step": 3.0, "p5-simulate": 5.0, "p5-energy_drift": 3.0}

right_but = RIGHT.right_but


def right(release):
    notebook = right_but(release)
    cell_of(
        notebook, "p5-discussion"
    ).source = "The drift is 94 mJ at 0.02 s and 4 mJ at 0.01 s, ..."
    return notebook


def partly_right(release):
    """Friction the wrong way, Euler in the shell of RK4 (which the run shows), a drift of K alone."""
    return right_but(
        release,
        f=RIGHT["f"].replace("-= arm.viscous", "+= arm.viscous"),
        rk4_step=RIGHT["rk4_step"]
        .replace("+ a / 2", "")
        .replace("+ b / 2", "")
        .replace("+ c,", ","),
        energy_drift=RIGHT["energy_drift"].replace("K + arm.g", "K + 0"),
    )


def wrong(release):
    """A mistake in each cell that leaves nothing of it."""
    return right_but(
        release,
        f=RIGHT["f"].replace("[*qd, *(", "np.append(").replace("@ rest)]", "@ rest, qd)"),
        rk4_step=RIGHT["rk4_step"].replace("/ 6", "").replace("x + (a", "(a") + "    ",
        simulate="""
def simulate(f, x0, u, t):
    return [x0 for now in t]
""",
        energy_drift=RIGHT["energy_drift"].replace("e - E[0]", "E[0] - e"),
    )
