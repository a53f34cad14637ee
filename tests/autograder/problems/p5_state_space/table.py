"""Wrong answers about simulation: the mistakes that each shows, and the credit left."""

MATRICES = """
def M(q):
    c = arm.m2 * arm.l1 * arm.lc2 * np.cos(q[1])
    b = arm.I2 + arm.m2 * arm.lc2**2
    return np.array([[arm.I1 + arm.m1 * arm.lc1**2 + arm.m2 * arm.l1**2 + b + 2 * c, b + c], [b + c, b]])
def C(q, qd):
    h = -arm.m2 * arm.l1 * arm.lc2 * np.sin(q[1])
    return h * np.array([[qd[1], qd[0] + qd[1]], [-qd[0], 0.0]])
def g_vec(q):
    g2 = arm.m2 * arm.lc2 * arm.g * np.cos(q[0] + q[1])
    return np.array([(arm.m1 * arm.lc1 + arm.m2 * arm.l1) * arm.g * np.cos(q[0]) + g2, g2])
"""


TORQUE = "u(t[k], x) if callable(u) else u"

STAGES = """
states = [x0]
for now, after in zip(t[:-1], t[1:]):
    def rate(t, x):
        return f(x, u(t, x) if callable(u) else u)
    x, dt = states[-1], after - now
    k1 = rate(now, x)
    k2 = rate(now + dt / 2, x + dt / 2 * k1)
    k3 = rate(now + dt / 2, x + dt / 2 * k2)
    k4 = rate(after, x + dt * k3)
    states.append(x + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4))
return states
"""


def rate(
    torque="u - C @ qd - g - d * qd - k * np.sign(qd)",
    qdd="np.linalg.solve(M, torque)",
    returned="np.concatenate([qd, qdd])",
    state="q, qd = x[:2], x[2:]",
):
    """The body of f, with one line replaced."""
    return f"""{MATRICES}
{state}
M, C, g, d, k = M(q), C(q, qd), g_vec(q), arm.viscous, arm.coulomb
torque = {torque}
qdd = {qdd}
return {returned}
"""


def step(
    k2="f(x + dt / 2 * k1, u)",
    k3="f(x + dt / 2 * k2, u)",
    k4="f(x + dt * k3, u)",
    returned="x + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)",
):
    """The body of rk4_step, with one line replaced."""
    return f"""k1 = f(x, u)
k2 = {k2}
k3 = {k3}
k4 = {k4}
return {returned}
"""


def loop(
    start="states[0] = x0",
    over="range(len(t) - 1)",
    now="states[k]",
    torque="u(t[k], NOW) if callable(u) else u",
    dt="t[k + 1] - t[k]",
    inside="states[k + 1] = rk4_step(f, NOW, TORQUE, DT)",
    returned="states",
    method=None,
):
    """The body of simulate, with one line replaced; method: the body of its rk4_step."""
    inside = inside.replace("TORQUE", torque).replace("NOW", now).replace("DT", dt)
    method = (method or step()).replace("\n", "\n    ")
    return f"""
def rk4_step(f, x, u, dt):
    {method}
states = np.zeros((len(t), len(x0)))
{start}
for k in {over}:
    {inside}
return {returned}
"""


def drift(
    K="0.5 * qd @ M(q) @ qd",
    P="P1 + arm.m2 * arm.g * (arm.l1 * np.sin(q[0]) + arm.lc2 * np.sin(q[0] + q[1]))",
    E="K + P",
    returned="E - E[0]",
):
    """The body of energy_drift, with one line replaced."""
    return f"""{MATRICES}
E = np.zeros(len(x))
for k, row in enumerate(x):
    q, qd = row[:2], row[2:]
    S1 = arm.m1 * arm.lc1 + arm.m2 * arm.l1
    P1 = arm.m1 * arm.g * arm.lc1 * np.sin(q[0])
    K = {K}
    P = {P}
    E[k] = {E}
return {returned}
"""


ALIASED = f"""
def rk4_step(f, x, u, dt):
    {step().replace(chr(10), chr(10) + "    ")}
x = np.array(x0)
states = [x]
for k in range(len(t) - 1):
    x += rk4_step(f, x, {TORQUE}, t[k + 1] - t[k]) - x
    states.append(x)
return states
"""

TABLE = {
    "p5-f": [
        *(
            (f"{name} friction", rate(f"u - C @ qd - g - {friction}"), 0.25)
            for name, friction in (
                ("input for velocity / the Coulomb", "d * qd - k * np.sign(u)"),
                ("input for velocity / the", "d * u - k * np.sign(u)"),
                ("sign for velocity / the viscous", "(d + k) * np.sign(qd)"),
                ("friction multiplied / the", "d * qd * k * np.sign(qd)"),
            )
        ),
        ("signs of the left side", rate("u + C @ qd + g + d * qd + k * np.sign(qd)"), 0.25),
        ("sign of the whole", rate("C @ qd + g + d * qd + k * np.sign(qd) - u"), 0.25),
        ("left side missing", rate("u"), 0.25),
        ("state for its rate", "x", 0),
        ("velocity for acceleration", "np.concatenate([x[2:], x[2:]])", 0.25),
        ("half of the whole", rate(qdd="np.linalg.solve(M, torque) / 2"), 0.25),
        (
            ("added up / the viscous friction", "added up / the Coulomb friction"),
            rate("u - C @ qd - g - d @ qd - k @ np.sign(qd)"),
            0.25,
        ),
        (
            ("wrong sign / C q̇", "wrong sign / g(q)"),
            rate("u + C @ qd + g - d * qd - k * np.sign(qd)"),
            0.25,
        ),
        (
            ("wrong sign / g(q)", "wrong sign / the friction"),
            rate("u - C @ qd + g + d * qd + k * np.sign(qd)"),
            0.25,
        ),
        (
            "coordinate for velocity / the viscous friction",
            rate("u - C @ qd - g - d * q - k * np.sign(qd)"),
            0.25,
        ),
        (
            "coordinate for velocity / the friction",
            rate("u - C @ qd - g - d * q - k * np.sign(q)"),
            0.25,
        ),
        (
            "wrong velocity / the Coulomb friction / qd1 + qd2",
            rate("u - C @ qd - g - d * qd - k * np.sign(qd.sum())"),
            0.25,
        ),
        (
            "wrong velocity / the Coulomb friction / qd1",
            rate("u - C @ qd - g - d * qd - k * np.sign(qd[0])"),
            0.25,
        ),
        (
            "direction of all velocities / the Coulomb friction",
            rate("u - C @ qd - g - d * qd - k * qd / np.linalg.norm(qd)"),
            0.25,
        ),
        (
            "coefficient left out / the Coulomb friction",
            rate("u - C @ qd - g - d * qd - np.sign(qd)"),
            0.25,
        ),
        (
            "friction in one direction / the viscous friction",
            rate("u - C @ qd - g - d * abs(qd) - k * np.sign(qd)"),
            0.25,
        ),
        ("halves of ẋ swapped", rate(returned="np.concatenate([qdd, qd])"), 0),
        ("state interleaved", rate(state="q, qd = x[::2], x[1::2]"), 0),
        (
            "C times ones in the torque",
            rate("u - C @ np.ones(2) - g - d * qd - k * np.sign(qd)"),
            0.25,
        ),
        (
            "quadratic friction / the viscous friction",
            rate("u - C @ qd - g - d * qd * abs(qd) - k * np.sign(qd)"),
            0.25,
        ),
        (
            "sign of the coordinate / the Coulomb friction",
            rate("u - C @ qd - g - d * qd - k * np.sign(q)"),
            0.25,
        ),
        (
            "coefficients exchanged / the friction",
            rate("u - C @ qd - g - k * qd - d * np.sign(qd)"),
            0.25,
        ),
        ("divided by the diagonal of M", rate(qdd="torque / np.diag(M)"), 0.25),
        (
            ("wrong sign / C q̇", "dropped / the Coulomb friction"),
            rate("u + C @ qd - g - d * qd"),
            0.25,
        ),
    ],
    "p5-rk4_step": [
        ("Euler", step(k2="f(x, u)", k3="f(x, u)", k4="f(x, u)"), 0.25),
        ("midpoint", step(returned="x + dt * k2"), 0.25),
        ("Heun", step(k2="f(x + dt * k1, u)", returned="x + dt / 2 * (k1 + k2)"), 0.25),
        ("k3 from k1", step(k3="f(x + dt / 2 * k1, u)"), 0.25),
        ("k2 twice in the sum", step(returned="x + dt / 6 * (k1 + 2 * k2 + 2 * k2 + k4)"), 0.25),
        ("k4 from k2", step(k4="f(x + dt * k2, u)"), 0.25),
        ("k4 from k1", step(k4="f(x + dt * k1, u)"), 0.25),
        ("half a step in k4", step(k4="f(x + dt / 2 * k3, u)"), 0.25),
        ("whole step in k2", step(k2="f(x + dt * k1, u)"), 0.25),
        ("whole step in k3", step(k3="f(x + dt * k2, u)"), 0.25),
        ("k4 missing, sum over five", step(returned="x + dt / 5 * (k1 + 2 * k2 + 2 * k3)"), 0.25),
        (
            "dt twice in the stages",
            "k1 = dt * f(x, u)\nk2 = dt * f(x + dt / 2 * k1, u)\nk3 = dt * f(x + dt / 2 * k2, u)\n"
            "k4 = dt * f(x + dt * k3, u)\nreturn x + (k1 + 2 * k2 + 2 * k3 + k4) / 6",
            0.25,
        ),
        (
            "brackets missing in the sum",
            step(returned="x + dt / 6 * k1 + 2 * k2 + 2 * k3 + k4"),
            0,
        ),
        ("whole steps in k2 and k3", step(k2="f(x + dt * k1, u)", k3="f(x + dt * k2, u)"), 0.25),
        ("equal weights", step(returned="x + dt * (k1 + k2 + k3 + k4) / 4"), 0.25),
        ("equal weights, sum over six", step(returned="x + dt * (k1 + k2 + k3 + k4) / 6"), 0),
        (
            "weights in the wrong places",
            step(returned="x + dt / 6 * (2 * k1 + k2 + k3 + 2 * k4)"),
            0.25,
        ),
        ("division by six missing", step(returned="x + dt * (k1 + 2 * k2 + 2 * k3 + k4)"), 0),
        ("dt missing in the sum", step(returned="x + (k1 + 2 * k2 + 2 * k3 + k4) / 6"), 0),
        (
            "dt missing in the stages",
            step(k2="f(x + k1 / 2, u)", k3="f(x + k2 / 2, u)", k4="f(x + k3, u)"),
            0.25,
        ),
        ("dt twice", step(returned="x + dt * dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)"), 0),
        ("change for state", step(returned="dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)"), 0),
        ("mean slope for state", step(returned="(k1 + 2 * k2 + 2 * k3 + k4) / 6"), 0),
        ("step backwards", "dt = -dt\n" + step(), 0),
        ("change subtracted", step(returned="x - dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)"), 0),
        ("input left out", "u = 0 * u\n" + step(), 0),
    ],
    "p5-simulate": [
        ("all rows equal", ALIASED, 0.4),
        ("transposed", loop(returned="states.T"), 0.8),
        (
            "rows one step ahead",
            loop(
                start="x = x0",
                inside="x = rk4_step(f, x, TORQUE, t[k + 1] - t[k]); states[k] = x",
                now="x",
            ),
            0,
        ),
        (
            "first row is no start, equal steps",
            loop(
                start="x = x0",
                over="range(len(t))",
                inside="x = rk4_step(f, x, TORQUE, t[1] - t[0]); states[k] = x",
                now="x",
            ),
            0.2,
        ),
        ("steps taken to be equal", loop(dt="t[1] - t[0]"), 0.4),
        ("equal steps from start to end", loop(dt="(t[-1] - t[0]) / (len(t) - 1)"), 0.4),
        ("last step's length", loop(dt="t[k] - t[k - 1]"), 0),
        (
            "run from time zero",
            loop(
                start="t = np.append(0, t); states = np.append([x0], states, axis=0)",
                returned="states[1:]",
            ),
            0,
        ),
        ("last step missing", loop(over="range(len(t) - 2)"), 0),
        ("state never moved on", loop(now="x0"), 0),
        (
            "start repeated",
            loop(start="states[:] = x0", inside="rk4_step(f, states[k], TORQUE, t[k + 1] - t[k])"),
            0,
        ),
        ("torque of the start only", loop(torque="u(t[0], x0) if callable(u) else u"), 0.8),
        (
            "torque of the end of the step",
            loop(torque="u(t[k + 1], states[k]) if callable(u) else u"),
            0.8,
        ),
        (
            "torque of the middle of the step",
            loop(torque="u((t[k] + t[k + 1]) / 2, states[k]) if callable(u) else u"),
            0.8,
        ),
        ("torque of the first state", loop(torque="u(t[k], x0) if callable(u) else u"), 0.8),
        ("torque of time zero", loop(torque="u(0, states[k]) if callable(u) else u"), 0.8),
        ("clock from zero", loop(torque="u(t[k] - t[0], states[k]) if callable(u) else u"), 0.8),
        ("torque at the stages", STAGES, 0.8),
        ("input left out", loop(torque="np.zeros(len(x0) // 2)"), 0.4),
        ("Euler", loop(method=step(k2="k1", k3="k1", k4="k1")), 0.4),
        ("midpoint", loop(method=step(returned="x + dt * k2")), 0.4),
        ("Heun", loop(method=step(k2="f(x + dt * k1, u)", returned="x + dt / 2 * (k1 + k2)")), 0.4),
        ("k3 from k1", loop(method=step(k3="f(x + dt / 2 * k1, u)")), 0.4),
        ("k2 twice in the sum", loop(method=step(returned="x + dt / 6 * (k1 + 4 * k2 + k4)")), 0.4),
        ("k4 from k2", loop(method=step(k4="f(x + dt * k2, u)")), 0.4),
        ("k4 from k1", loop(method=step(k4="f(x + dt * k1, u)")), 0.4),
        ("half a step in k4", loop(method=step(k4="f(x + dt / 2 * k3, u)")), 0.4),
        ("whole step in k2", loop(method=step(k2="f(x + dt * k1, u)")), 0.4),
        ("whole step in k3", loop(method=step(k3="f(x + dt * k2, u)")), 0.4),
        (
            "k4 missing, sum over five",
            loop(method=step(returned="x + dt / 5 * (k1 + 2 * k2 + 2 * k3)")),
            0.4,
        ),
        (
            "whole steps in k2 and k3",
            loop(method=step(k2="f(x + dt * k1, u)", k3="f(x + dt * k2, u)")),
            0.4,
        ),
        ("equal weights", loop(method=step(returned="x + dt / 4 * (k1 + k2 + k3 + k4)")), 0.4),
        (
            "equal weights, sum over six",
            loop(method=step(returned="x + dt / 6 * (k1 + k2 + k3 + k4)")),
            0,
        ),
    ],
    "p5-energy_drift": [
        ("M times squares", drift(K="0.5 * np.sum(M(q) @ qd**2)"), 0.35),
        ("½ of K missing", drift(K="qd @ M(q) @ qd"), 0.35),
        ("C in the energy", drift(K="0.5 * qd @ (M(q) + C(q, qd)) @ qd"), 0.35),
        ("K missing", drift(K="0"), 0.35),
        (
            "cosine for sine",
            drift(P="arm.g * (S1 * np.cos(q[0]) + arm.m2 * arm.lc2 * np.cos(q[0] + q[1]))"),
            0.35,
        ),
        ("gravity of Earth / 9.81 / g", "arm.g = 9.81\n" + drift(), 0.35),
        ("sign of the whole", drift(returned="E[0] - E"), 0),
        ("from the end", drift(returned="E - E[-1]"), 0),
        ("share in percent", drift(returned="100 * (E - E[0]) / E[0]"), 0),
        ("range for the drift", drift(returned="E.max() - E.min() + 0 * E"), 0),
        ("M left out of K", drift(K="0.5 * qd @ qd"), 0.35),
        (("½ of K missing", "L for the energy"), drift(K="qd @ M(q) @ qd", E="K - P"), 0),
    ],
}
