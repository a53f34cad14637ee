"""Every mistake of problem 5, as a student would type it: its sentence, its credit and its witness.

The table is typed out on purpose: a mistake's wording is read by students, and changes only with
intent.
"""

import numpy as np
import pytest
import scipy.integrate  # noqa: F401  (so that no call with a time limit pays for it)

from autograder.judging.check import HIDDEN_CASES, VISIBLE_CASES
from autograder.problems.p5_state_space import mistakes as p5_state_space
from autograder.problems.p5_state_space.mistakes import explicit
from autograder.problems import CHECKS
from autograder.problems.material.systems import run
from autograder.judging.verdict import State
from autograder.protocol import real
from tests.autograder.verdicts import assert_named, judged, sentences_of

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
EXAMPLE_ARM = """
from types import SimpleNamespace
arm = SimpleNamespace(
    l1=1.0, l2=0.8, lc1=0.5, lc2=0.4, m1=2.0, m2=1.5, I1=0.17, I2=0.08, g=9.81,
    viscous=np.array([0.3, 0.2]), coulomb=np.array([0.4, 0.25]),
)
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

# check, the body that a student would write, the credit left, the sentence.
TABLE = [
    (
        "p5-f",
        rate(returned="np.concatenate([qdd, qd])"),
        0,
        "The two halves of your ẋ are swapped. Which half of x is q, and which half of ẋ is its "
        "rate of change?",
    ),
    (
        "p5-f",
        rate(returned="np.concatenate([q, qdd])"),
        0.75,
        "The first half of your ẋ is q itself. What is the rate of change of q, and where in x "
        "does it stand?",
    ),
    (
        "p5-f",
        rate(state="qd, q = x[:2], x[2:]"),
        0,
        "Your accelerations come out as if x were [q̇; q]. Which half do you call q?",
    ),
    (
        "p5-f",
        rate(state="q, qd = x[::2], x[1::2]"),
        0,
        "You read x as if it were [q1, q̇1, q2, q̇2]. In which order does the notation table put "
        "the four entries?",
    ),
    (
        "p5-f",
        rate(state="q, qd = x[::2], x[1::2]", returned="[qd[0], qdd[0], qd[1], qdd[1]]"),
        0,
        "You read x as if it were [q1, q̇1, q2, q̇2]. In which order does the notation table put "
        "the four entries?",
    ),
    (
        "p5-f",
        rate("u - g - d * qd - k * np.sign(qd)"),
        0.25,
        "The Coriolis and centrifugal torque is missing from your q̈. Which term of the equation "
        "of motion is quadratic in the velocities?",
    ),
    (
        "p5-f",
        rate("u + C @ qd - g - d * qd - k * np.sign(qd)"),
        0.25,
        "The Coriolis and centrifugal torque has the wrong sign in your q̈. On which side of the "
        "equation of motion does it stand?",
    ),
    (
        "p5-f",
        rate("u - C @ np.ones(2) - g - d * qd - k * np.sign(qd)"),
        0.25,
        "Your Coriolis torque is the sum of each row of C. What does C multiply?",
    ),
    (
        "p5-f",
        rate("u - qd @ C - g - d * qd - k * np.sign(qd)"),
        0.25,
        "Your Coriolis torque uses C with rows and columns exchanged. Does q̇ stand to the right "
        "or to the left of C?",
    ),
    (
        "p5-f",
        rate("u - C @ qd - d * qd - k * np.sign(qd)"),
        0.25,
        "Gravity is missing from your q̈. Which torque acts on the arm when it is at rest?",
    ),
    (
        "p5-f",
        rate("u - C @ qd + g - d * qd - k * np.sign(qd)"),
        0.25,
        "Gravity has the wrong sign in your q̈: your arm falls upwards. On which side of the "
        "equation of motion does g(q) stand?",
    ),
    (
        "p5-f",
        rate("u - C @ qd - g / arm.g * 9.81 - d * qd - k * np.sign(qd)"),
        0.25,
        "Your q̈ is right on Earth only: 9.81 is written into it. The check also uses other "
        "planets.",
    ),
    (
        "p5-f",
        rate("u - C @ qd - g"),
        0.25,
        "Friction is missing from your q̈. Which two parameters of arm have you not used yet?",
    ),
    (
        "p5-f",
        rate("u - C @ qd - g + d * qd + k * np.sign(qd)"),
        0.25,
        "Friction has the wrong sign in your q̈: it drives the joints. Does friction add energy "
        "to an arm or take it out?",
    ),
    (
        "p5-f",
        rate("u - C @ qd - g - k * np.sign(qd)"),
        0.25,
        "The viscous part of the friction is missing. Which part of f grows with the speed?",
    ),
    (
        "p5-f",
        rate("u - C @ qd - g + d * qd - k * np.sign(qd)"),
        0.25,
        "The viscous part of your friction has the wrong sign: the faster the joint, the more it "
        "is pushed on.",
    ),
    (
        "p5-f",
        rate("u - C @ qd - g - d * qd * abs(qd) - k * np.sign(qd)"),
        0.25,
        "Your viscous friction grows with the square of the speed. Look at the unit of its "
        "coefficient.",
    ),
    (
        "p5-f",
        rate("u - C @ qd - g - d * qd"),
        0.25,
        "The Coulomb part of the friction is missing. Which part of f has the same size at every "
        "speed?",
    ),
    (
        "p5-f",
        rate("u - C @ qd - g - d * qd + k * np.sign(qd)"),
        0.25,
        "The Coulomb part of your friction has the wrong sign: it pushes the joint on.",
    ),
    (
        "p5-f",
        rate("u - C @ qd - g - d * qd - k"),
        0.25,
        "Your Coulomb friction always acts in the same direction. What decides in which direction"
        " friction acts?",
    ),
    (
        "p5-f",
        rate("u - C @ qd - g - d * qd - k * np.abs(qd)"),
        0.25,
        "Your Coulomb friction uses |q̇| where its sign is needed: it grows with the speed and "
        "never changes direction.",
    ),
    (
        "p5-f",
        rate("u - C @ qd - g - (d + k) * qd"),
        0.25,
        "Your Coulomb friction grows with the speed. Which property of q̇, and not its size, does"
        " dry friction depend on?",
    ),
    (
        "p5-f",
        rate("u - C @ qd - g - d * qd - k * np.sign(q)"),
        0.25,
        "Your Coulomb friction looks at the sign of the angle. Does friction depend on where a "
        "joint is, or on how it moves?",
    ),
    (
        "p5-f",
        rate("u - C @ qd - g - d * qd - k * np.tanh(qd)"),
        0.25,
        "Your Coulomb friction fades out at low speed, as with a tanh. The model asked for jumps:"
        " how large is dry friction at 0.001 rad/s?",
    ),
    (
        "p5-f",
        rate("u - C @ qd - g - d * qd - k * np.tanh(10 * qd)"),
        0.25,
        "Your Coulomb friction fades out at low speed, as with a tanh. The model asked for jumps:"
        " how large is dry friction at 0.001 rad/s?",
    ),
    (
        "p5-f",
        rate("u - C @ qd - g - d * qd - k * np.tanh(20 * qd)"),
        0.25,
        "Your Coulomb friction fades out at low speed, as with a tanh. The model asked for jumps:"
        " how large is dry friction at 0.001 rad/s?",
    ),
    (
        "p5-f",
        rate("u - C @ qd - g - d * qd - k * np.tanh(100 * qd)"),
        0.25,
        "Your Coulomb friction fades out at low speed, as with a tanh. The model asked for jumps:"
        " how large is dry friction at 0.001 rad/s?",
    ),
    (
        "p5-f",
        rate("u - C @ qd - g - d * qd - k * np.tanh(qd / 1e-3)"),
        0.25,
        "Your Coulomb friction fades out at low speed, as with a tanh. The model asked for jumps:"
        " how large is dry friction at 0.001 rad/s?",
    ),
    (
        "p5-f",
        rate("u - C @ qd - g - d * qd - k * np.copysign(1, qd)"),
        0.25,
        "Your Coulomb friction is not zero in a joint at rest. In which direction would it push "
        "there? What does NumPy's own sign give for 0?",
    ),
    (
        "p5-f",
        rate("u - C @ qd - g - d * qd - k * np.where(qd > 0, 1, -1)"),
        0.25,
        "Your Coulomb friction is not zero in a joint at rest. In which direction would it push "
        "there? What does NumPy's own sign give for 0?",
    ),
    (
        "p5-f",
        rate("u - C @ qd - g - k * qd - d * np.sign(qd)"),
        0.25,
        "The two friction coefficients are swapped. Which of them is in N·m, and which in "
        "N·m·s/rad?",
    ),
    (
        "p5-f",
        rate("-C @ qd - g - d * qd - k * np.sign(qd)"),
        0.25,
        "The input u is missing from your q̈. What makes the arm move in a direction you choose?",
    ),
    (
        "p5-f",
        rate("-u - C @ qd - g - d * qd - k * np.sign(qd)"),
        0.25,
        "The input u has the wrong sign in your q̈: the motor turns the wrong way.",
    ),
    (
        "p5-f",
        rate("u - C @ qd - g", qdd="np.linalg.solve(M, torque) - d * qd - k * np.sign(qd)"),
        0.25,
        "Your friction is subtracted from the acceleration. It is a torque: what must happen to a"
        " torque before it is an acceleration?",
    ),
    (
        "p5-f",
        rate(qdd="M @ torque"),
        0.25,
        "You multiply by M. In M q̈ = ..., how do you get q̈ alone?",
    ),
    (
        "p5-f",
        rate(qdd="torque"),
        0.25,
        "The second half of your ẋ is a torque, in N·m. What resists it?",
    ),
    (
        "p5-f",
        rate(qdd="torque / np.diag(M)"),
        0.25,
        "You divide by the diagonal of M, as if the joints did not feel each other. What do the "
        "entries beside the diagonal do?",
    ),
    (
        "p5-f",
        rate(qdd="1 / M @ torque"),
        0.25,
        "You invert each entry of M by itself. The inverse of a matrix is something else: which "
        "NumPy function solves a linear system?",
    ),
    (
        "p5-f",
        rate(qdd="sum(torque / M)"),
        0.25,
        "You divide by M entry by entry. Which NumPy function solves a linear system?",
    ),
    (
        "p5-f",
        EXAMPLE_ARM + rate(),
        0.25,
        "Your f always uses the arm of this notebook. The check hands over other arms, as the "
        "third argument.",
    ),
    (
        "p5-rk4_step",
        step(k2="f(x, u)", k3="f(x, u)", k4="f(x, u)"),
        0.25,
        "This is Euler's method: only the slope at the start of the step counts, whatever else is"
        " computed. At which states must the other three slopes be taken?",
    ),
    (
        "p5-rk4_step",
        step(returned="x + dt * k2"),
        0.25,
        "This is the midpoint method, of order 2: only the second slope counts. How do the four "
        "slopes share in the step?",
    ),
    (
        "p5-rk4_step",
        step(k2="f(x + dt * k1, u)", returned="x + dt / 2 * (k1 + k2)"),
        0.25,
        "This is Heun's method, of order 2: the mean of the slopes at the two ends. Where else "
        "does RK4 take slopes?",
    ),
    (
        "p5-rk4_step",
        step(k3="f(x + dt / 2 * k1, u)"),
        0.25,
        "Your k3 is the same as k2. From which slope must k3 set out?",
    ),
    (
        "p5-rk4_step",
        step(returned="x + dt / 6 * (k1 + 2 * k2 + 2 * k2 + k4)"),
        0.25,
        "Your sum takes k2 twice and k3 not at all. Look at the two middle terms.",
    ),
    (
        "p5-rk4_step",
        step(k4="f(x + dt * k2, u)"),
        0.25,
        "Your k4 sets out along k2. Which is the newest slope by then?",
    ),
    (
        "p5-rk4_step",
        step(k4="f(x + dt * k1, u)"),
        0.25,
        "Your k4 sets out along k1. Which is the newest slope by then?",
    ),
    (
        "p5-rk4_step",
        step(k4="f(x + dt / 2 * k3, u)"),
        0.25,
        "Your k4 is taken in the middle of the step. How far ahead does the last slope look?",
    ),
    (
        "p5-rk4_step",
        step(k2="f(x + dt * k1, u)", k3="f(x + dt * k2, u)"),
        0.25,
        "Your k2 and k3 are taken at the end of the step. How far ahead do the two middle slopes "
        "look?",
    ),
    (
        "p5-rk4_step",
        step(returned="x + dt * (k1 + k2 + k3 + k4) / 4"),
        0.25,
        "Your four slopes have equal weights. Which of them tell more about the whole step?",
    ),
    (
        "p5-rk4_step",
        step(returned="x + dt * (k1 + k2 + k3 + k4) / 6"),
        0,
        "Your weights add up to 4/6: the step is too short. How often does each middle slope "
        "count?",
    ),
    (
        "p5-rk4_step",
        step(returned="x + dt / 6 * (2 * k1 + k2 + k3 + 2 * k4)"),
        0.25,
        "Your weights are exchanged: the ends count twice, the middle once.",
    ),
    (
        "p5-rk4_step",
        step(returned="x + dt * (k1 + 2 * k2 + 2 * k3 + k4)"),
        0,
        "Your step is six times too long. What must the weights of the slopes add up to?",
    ),
    (
        "p5-rk4_step",
        step(returned="x + (k1 + 2 * k2 + 2 * k3 + k4) / 6"),
        0,
        "You add a slope to a state. What turns a rate of change into a change?",
    ),
    (
        "p5-rk4_step",
        step(k2="f(x + k1 / 2, u)", k3="f(x + k2 / 2, u)", k4="f(x + k3, u)"),
        0.25,
        "The states at which you take k2, k3 and k4 do not depend on dt. How far along a slope is"
        " the middle of the step?",
    ),
    (
        "p5-rk4_step",
        step(returned="x + dt * dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)"),
        0,
        "The time step is multiplied in twice. Are your k's slopes, or changes of the state?",
    ),
    (
        "p5-rk4_step",
        step(returned="dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)"),
        0,
        "You return the change of the state. Where did the step start?",
    ),
    (
        "p5-rk4_step",
        step(returned="(k1 + 2 * k2 + 2 * k3 + k4) / 6"),
        0,
        "You return a slope. What is the state at the end of the step?",
    ),
    (
        "p5-rk4_step",
        "dt = -dt\n" + step(),
        0,
        "Your step goes back in time. Look at the signs in front of dt.",
    ),
    (
        "p5-rk4_step",
        step(returned="x - dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)"),
        0,
        "You subtract the change from the state. In which direction does a slope lead?",
    ),
    (
        "p5-rk4_step",
        "u = 0 * u\n" + step(),
        0,
        "Your step does not feel u. What do you hand to f as its second argument?",
    ),
    (
        "p5-simulate",
        ALIASED,
        0.4,
        "All rows are the last state. Do you store the same array again and again, and change it "
        "in place (as x += ... does)?",
    ),
    (
        "p5-simulate",
        loop(returned="states.T"),
        0.8,
        "Your states stand in columns. One row for each time is asked for: which way do rows and "
        "columns go?",
    ),
    (
        "p5-simulate",
        loop(
            start="x = x0",
            inside="x = rk4_step(f, x, TORQUE, t[k + 1] - t[k]); states[k] = x",
            now="x",
        ),
        0,
        "Your row k holds the state after the step, and the start is lost. Which state belongs to"
        " t[0]?",
    ),
    (
        "p5-simulate",
        loop(
            start="x = x0",
            over="range(len(t))",
            inside="x = rk4_step(f, x, TORQUE, t[1] - t[0]); states[k] = x",
            now="x",
        ),
        0.2,
        "Your first row is the state after a step, and all steps are as long as the first. Which "
        "state belongs to t[0], and how long is step k?",
    ),
    (
        "p5-simulate",
        loop(dt="t[1] - t[0]"),
        0.4,
        "You take all time steps to be as long as the first one. The times in t need not be "
        "equally spaced: how long is step k?",
    ),
    (
        "p5-simulate",
        loop(dt="(t[-1] - t[0]) / (len(t) - 1)"),
        0.4,
        "You spread the time evenly over the steps. The times in t need not be equally spaced: "
        "how long is step k?",
    ),
    (
        "p5-simulate",
        loop(dt="t[k] - t[k - 1]"),
        0,
        "Step k of yours is as long as the step before it should be. Between which two times does"
        " the state of row k move on to row k + 1?",
    ),
    (
        "p5-simulate",
        loop(
            start="t = np.append(0, t); states = np.append([x0], states, axis=0)",
            returned="states[1:]",
        ),
        0,
        "Your run starts at time zero, although t need not. At which time is the state x0?",
    ),
    (
        "p5-simulate",
        loop(over="range(len(t) - 2)"),
        0,
        "Your last row is still zero: the last step is never taken. How many steps lie between "
        "len(t) times?",
    ),
    (
        "p5-simulate",
        loop(now="x0"),
        0,
        "Each of your steps starts from x0 again. Where must step k start?",
    ),
    (
        "p5-simulate",
        loop(start="states[:] = x0", inside="rk4_step(f, states[k], TORQUE, t[k + 1] - t[k])"),
        0,
        "All rows are x0: nothing moves. Is the result of the step stored anywhere?",
    ),
    (
        "p5-simulate",
        loop(torque="u(t[0], x0) if callable(u) else u"),
        0.8,
        "You ask u once, at the start, and hold it for the whole run. How often does the "
        "controller read the clock and the state?",
    ),
    (
        "p5-simulate",
        loop(torque="u(t[k + 1], states[k]) if callable(u) else u"),
        0.8,
        "You ask u at the end time of each step. When does the controller read the clock, and "
        "until when does it hold the torque?",
    ),
    (
        "p5-simulate",
        loop(torque="u((t[k] + t[k + 1]) / 2, states[k]) if callable(u) else u"),
        0.8,
        "You ask u at the middle of each step. When does the controller read the clock, and until"
        " when does it hold the torque?",
    ),
    (
        "p5-simulate",
        loop(torque="u(t[k], x0) if callable(u) else u"),
        0.8,
        "You hand x0 to u in every step. Which state does the controller see at t[k]?",
    ),
    (
        "p5-simulate",
        loop(torque="u(0, states[k]) if callable(u) else u"),
        0.8,
        "You ask u for the time zero in every step. What is the time at the start of step k?",
    ),
    (
        "p5-simulate",
        loop(torque="u(t[k] - t[0], states[k]) if callable(u) else u"),
        0.8,
        "Your clock starts at zero, although t need not. Which time does the controller read?",
    ),
    (
        "p5-simulate",
        STAGES,
        0.8,
        "Your torque changes inside the step. Here a computer drives the arm: how often in one "
        "step does it read the clock and the state?",
    ),
    (
        "p5-simulate",
        loop(torque="np.zeros(len(x0) // 2)"),
        0.4,
        "Your run does not feel u. What do you hand on to the step?",
    ),
    (
        "p5-simulate",
        loop(method=step(k2="k1", k3="k1", k4="k1")),
        0.4,
        "This is Euler's method: only the slope at the start of the step counts, whatever else is"
        " computed. At which states must the other three slopes be taken?",
    ),
    (
        "p5-simulate",
        loop(method=step(returned="x + dt * k2")),
        0.4,
        "This is the midpoint method, of order 2: only the second slope counts. How do the four "
        "slopes share in the step?",
    ),
    (
        "p5-simulate",
        loop(method=step(k2="f(x + dt * k1, u)", returned="x + dt / 2 * (k1 + k2)")),
        0.4,
        "This is Heun's method, of order 2: the mean of the slopes at the two ends. Where else "
        "does RK4 take slopes?",
    ),
    (
        "p5-simulate",
        loop(method=step(k3="f(x + dt / 2 * k1, u)")),
        0.4,
        "Your k3 is the same as k2. From which slope must k3 set out?",
    ),
    (
        "p5-simulate",
        loop(method=step(returned="x + dt / 6 * (k1 + 4 * k2 + k4)")),
        0.4,
        "Your sum takes k2 twice and k3 not at all. Look at the two middle terms.",
    ),
    (
        "p5-simulate",
        loop(method=step(k4="f(x + dt * k2, u)")),
        0.4,
        "Your k4 sets out along k2. Which is the newest slope by then?",
    ),
    (
        "p5-simulate",
        loop(method=step(k4="f(x + dt * k1, u)")),
        0.4,
        "Your k4 sets out along k1. Which is the newest slope by then?",
    ),
    (
        "p5-simulate",
        loop(method=step(k4="f(x + dt / 2 * k3, u)")),
        0.4,
        "Your k4 is taken in the middle of the step. How far ahead does the last slope look?",
    ),
    (
        "p5-simulate",
        loop(method=step(k2="f(x + dt * k1, u)", k3="f(x + dt * k2, u)")),
        0.4,
        "Your k2 and k3 are taken at the end of the step. How far ahead do the two middle slopes "
        "look?",
    ),
    (
        "p5-simulate",
        loop(method=step(returned="x + dt / 4 * (k1 + k2 + k3 + k4)")),
        0.4,
        "Your four slopes have equal weights. Which of them tell more about the whole step?",
    ),
    (
        "p5-simulate",
        loop(method=step(returned="x + dt / 6 * (k1 + k2 + k3 + k4)")),
        0,
        "Your weights add up to 4/6: the step is too short. How often does each middle slope "
        "count?",
    ),
    (
        "p5-energy_drift",
        drift(K="qd @ M(q) @ qd"),
        0.35,
        "Your kinetic energy is twice the right one. What stands in front of a kinetic energy?",
    ),
    (
        "p5-energy_drift",
        drift(K="0.5 * M(q).diagonal() @ qd**2"),
        0.35,
        "Your kinetic energy uses the diagonal of M only. What happens to it when both joints "
        "turn?",
    ),
    (
        "p5-energy_drift",
        drift(K="0.5 * qd @ M(x[0, :2]) @ qd"),
        0.7,
        "Your kinetic energy uses M at the first state all along. What does M depend on?",
    ),
    (
        "p5-energy_drift",
        drift(K="0.5 * qd @ (M(q) + C(q, qd)) @ qd"),
        0.35,
        "There is a term with C in your energy. Which two energies does the arm have?",
    ),
    (
        "p5-energy_drift",
        drift(K="0.5 * qd @ C(q, qd) @ qd"),
        0.35,
        "Your kinetic energy is made with C. Which matrix gives the kinetic energy?",
    ),
    (
        "p5-energy_drift",
        drift(P="0"),
        0.35,
        "The potential energy is missing. What does the arm gain as it rises?",
    ),
    (
        "p5-energy_drift",
        drift(K="0"),
        0.35,
        "The kinetic energy is missing. What does the arm gain as it moves faster?",
    ),
    (
        "p5-energy_drift",
        drift(E="K - P"),
        0.35,
        "Your potential energy falls as the arm rises. Is E the sum of K and P, and is P positive"
        " upwards?",
    ),
    (
        "p5-energy_drift",
        drift(P="P1 + arm.m2 * arm.g * (arm.l1 * np.sin(q[0]) + arm.lc2 * np.sin(q[1]))"),
        0.35,
        "Your P takes q2 from the x axis. From where is q2 measured, and so how high is the "
        "second centre of mass?",
    ),
    (
        "p5-energy_drift",
        drift(P="arm.g * (S1 * np.cos(q[0]) + arm.m2 * arm.lc2 * np.cos(q[0] + q[1]))"),
        0.35,
        "Your heights use the cosine. From which axis is q1 measured, and how high is the arm at "
        "q = 0?",
    ),
    (
        "p5-energy_drift",
        drift(P="P1 + arm.m2 * arm.g * arm.lc2 * np.sin(q[0] + q[1])"),
        0.35,
        "The height of the second centre of mass is taken from the elbow. How high is the elbow?",
    ),
    (
        "p5-energy_drift",
        drift(P="g_vec(q) @ q"),
        0.35,
        "Your P is the gravity torque times the angle. A torque that changes on the way must be "
        "summed along it: what are the heights of the two centres of mass?",
    ),
    (
        "p5-energy_drift",
        "arm.g = 9.81\n" + drift(),
        0.35,
        "Your P is right on Earth only: 9.81 is written into it. The check also uses other "
        "planets.",
    ),
    (
        "p5-energy_drift",
        drift(returned="np.append(0, E[1:] - E[:-1])"),
        0,
        "You give the change from each row to the next. From which state is the drift counted?",
    ),
    (
        "p5-energy_drift",
        drift(returned="abs(E - E[0])"),
        0,
        "You give the size of the drift. Its sign is asked for too: does the run gain energy or "
        "lose it?",
    ),
    (
        "p5-energy_drift",
        drift(returned="E[0] - E"),
        0,
        "Your drift has the wrong sign: what grows counts as positive.",
    ),
    (
        "p5-energy_drift",
        drift(returned="E"),
        0,
        "This is the energy itself. By how much has it changed since the first row?",
    ),
    (
        "p5-energy_drift",
        drift(returned="E - E.mean()"),
        0,
        "You subtract the mean of the energy. From which state is the drift counted?",
    ),
    (
        "p5-energy_drift",
        drift(returned="E - E[-1]"),
        0,
        "You subtract the energy of the last row. From which state is the drift counted?",
    ),
    (
        "p5-energy_drift",
        drift(returned="(E - E[0]) / E[0]"),
        0,
        "You divide by the energy of the start. That share depends on where P is zero; the drift "
        "in J does not.",
    ),
    (
        "p5-energy_drift",
        EXAMPLE_ARM + drift(),
        0,
        "Your energy is always that of the arm of this notebook. The check hands over other arms,"
        " as the second argument.",
    ),
]


@pytest.mark.parametrize(("check_id", "body", "credit", "sentence"), TABLE)
def test_sentence_credit_and_witness(check_id, body, credit, sentence):
    assert_named(check_id, body, credit, sentence)


def test_every_mistake_has_its_row():
    assert sentences_of(p5_state_space) <= {sentence for *_, sentence in TABLE}


@pytest.mark.parametrize(
    ("check_id", "body"),
    [
        ("p5-f", rate()),
        ("p5-rk4_step", step()),
        ("p5-simulate", loop()),
        ("p5-energy_drift", drift()),
    ],
)
def test_bodies_are_right_before_they_are_spoilt(check_id, body):
    assert judged(check_id, body).state is State.CORRECT


def test_two_wrong_torques_are_both_named():
    verdict = judged("p5-f", rate("u + C @ qd - g - d * qd"))
    assert len(verdict.diagnosis) == 2
    assert "Coriolis and centrifugal torque has the wrong sign" in verdict.diagnosis[0]
    assert "Coulomb part of the friction is missing" in verdict.diagnosis[1]


def test_two_wrong_energies_are_both_named():
    verdict = judged("p5-energy_drift", drift(K="qd @ M(q) @ qd", E="K - P"))
    assert len(verdict.diagnosis) == 2
    assert "twice the right one" in verdict.diagnosis[0]
    assert "falls as the arm rises" in verdict.diagnosis[1]


@pytest.mark.parametrize(
    ("check_id", "body", "said"),
    [
        (
            "p5-f",
            rate("u - C @ qd - 1.1 * g - d * qd - k * np.sign(qd)"),
            "accelerations in ẋ varies like M⁻¹ g (+0.1 times it)",
        ),
        (
            "p5-f",
            rate("0.5 * u - C @ qd - g - d * qd - k * np.sign(qd)"),
            "varies like M⁻¹ u (-0.5 times it)",
        ),
        (
            "p5-f",
            rate("u - C @ qd - g - 3 * d * qd - k * np.sign(qd)"),
            "varies like viscous friction (+2 times it)",
        ),
        (
            "p5-energy_drift",
            drift(K="0.6 * qd @ M(q) @ qd"),
            "change of the kinetic energy varies like the change of K (+0.2 times it)",
        ),
    ],
)
def test_unknown_error_is_sought_in_the_terms(check_id, body, said):
    (first, *_) = judged(check_id, body).diagnosis
    assert said.replace("+", "") in first.replace("+", "")


RALSTON = step(
    k2="f(x + 2 / 3 * dt * k1, u)", k3="0", k4="0", returned="x + dt / 4 * (k1 + 3 * k2)"
)
KUTTA_3 = step(
    k3="f(x + dt * (2 * k2 - k1), u)", k4="0", returned="x + dt / 6 * (k1 + 4 * k2 + k3)"
)


KUTTA = ((), (1 / 2,), (-1, 2)), (1 / 6, 2 / 3, 1 / 6)


@pytest.mark.parametrize("method", [RALSTON, KUTTA_3])
def test_unknown_method_is_told_its_order_and_no_name(method):
    for seed in range(10):
        verdict = judged("p5-rk4_step", method, seed, VISIBLE_CASES)
        (sentence,) = verdict.diagnosis
        assert "is not of order 4" in sentence
        assert verdict.credit == 0.25
    verdict = judged("p5-simulate", loop(method=method))
    assert [row.met for row in verdict.rows] == [True, True, False, False, False]
    assert any("sixteenth of the error" in sentence for sentence in verdict.diagnosis)


@pytest.mark.parametrize(
    ("tolerances", "met", "said"),
    [
        ("", [True, False, False, False, False], "tolerances tight enough"),
        (", rtol=1e-8, atol=1e-10", [True, False, True, True, True], "changes inside the step"),
    ],
)
def test_solver_over_the_whole_run(tolerances, met, said):
    """Right where u is a vector and the tolerances are tight; never holds the torque."""
    verdict = judged(
        "p5-simulate",
        f"""
from scipy.integrate import solve_ivp
def rate(s, x):
    return f(x, u(s, x) if callable(u) else u)
return solve_ivp(rate, (t[0], t[-1]), x0, t_eval=t{tolerances}).y.T
""",
    )
    assert [row.met for row in verdict.rows] == met
    assert any(said in sentence for sentence in verdict.diagnosis)


def test_order_is_observed():
    check = CHECKS["p5-simulate"]
    euler = judged("p5-simulate", loop(method=step(k2="k1", k3="k1", k4="k1")))
    assert [row.met for row in euler.rows] == [True, True, False, False, False]
    observed = {}
    for name, method in (("Euler", explicit(((),), (1,))), ("Kutta 3", explicit(*KUTTA))):
        calls = check.calls(np.random.default_rng(0), HIDDEN_CASES)
        values = [run(*map(real, call.args), step=method) for call in calls]
        orders = [parts[3] for parts in check.quantities(calls, values) if parts[3].size]
        observed[name] = [float(order) for order in orders]
    assert observed["Euler"] == pytest.approx([1.0] * 4, abs=0.4)
    assert observed["Kutta 3"] == pytest.approx([3.0] * 4, abs=0.4)


@pytest.mark.parametrize(
    ("returned", "problem"),
    [
        ("states[1:]", "one row for each time is asked for, and the state at t[0] is x0"),
        ("states[-1]", "one row for each time and one column for each entry of the state"),
        ("states[:, :1]", "one row for each time and one column for each entry of the state"),
    ],
)
def test_other_shapes_are_refused_with_the_shape_that_is_asked_for(returned, problem):
    verdict = judged("p5-simulate", loop(returned=returned))
    assert verdict.state is State.ERROR
    assert problem in verdict.problem


def test_doing_nothing_earns_nothing():
    """A constant keeps its energy, but is no motion."""
    assert judged("p5-simulate", "np.tile(x0, (len(t), 1))").credit == 0
    assert judged("p5-energy_drift", "np.zeros(len(x))").credit == 0
    assert judged("p5-rk4_step", "x").credit == 0
