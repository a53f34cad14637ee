"""Mistakes about the first-order form, integrators and the energy along a run."""

from types import SimpleNamespace

import numpy as np

from autograder.judging.diagnosis import Mistake
from autograder.judging.terms import Term
from autograder.problems.material import sentences
from autograder.problems.material.planar_2r import (
    C,
    M,
    f_vec,
    g_vec,
    kinetic_energy,
    potential_energy,
)
from autograder.problems.material.systems import rk4, run

# The arm of the notebook; a test holds the two together.
EXAMPLE = SimpleNamespace(
    l1=1.0, l2=0.8, lc1=0.5, lc2=0.4, m1=2.0, m2=1.5, I1=0.17, I2=0.08, g=9.81,
    viscous=np.array([0.3, 0.2]), coulomb=np.array([0.4, 0.25]),
)  # fmt: skip


def torque(q, qd, u, arm):
    """What is left of u to accelerate the arm, (2,), N·m."""
    return u - C(q, qd, arm) @ qd - g_vec(q, arm) - f_vec(qd, arm)


def rate(x, u, arm):
    """ẋ of the arm, (4,): the right answer."""
    q, qd = x[:2], x[2:]
    return np.concatenate([qd, np.linalg.solve(M(q, arm), torque(q, qd, u, arm))])


def _part(torque_of):
    """A term of q̈: M⁻¹ times a torque."""

    def model(x, u, arm):
        q, qd = x[:2], x[2:]
        part = np.linalg.solve(M(q, arm), torque_of(q, qd, u, arm))
        return np.concatenate([np.zeros(2), part])

    return model


RATE_TERMS = (
    Term("M⁻¹ u", _part(lambda q, qd, u, arm: u)),
    Term("M⁻¹ C q̇", _part(lambda q, qd, u, arm: -C(q, qd, arm) @ qd)),
    Term("M⁻¹ g", _part(lambda q, qd, u, arm: -g_vec(q, arm))),
    Term("viscous friction", _part(lambda q, qd, u, arm: -arm.viscous * qd)),
    Term("Coulomb friction", _part(lambda q, qd, u, arm: -arm.coulomb * np.sign(qd))),
)

INTERLEAVED = (
    "You read x as if it were [q1, q̇1, q2, q̇2]. In which order does the notation table put the "
    "four entries?"
)
SMOOTH_SIGN = (
    "Your Coulomb friction fades out at low speed, as a tanh does. In this model it jumps: how "
    "large is dry friction at 0.001 rad/s?"
)
AT_REST = (
    "Your Coulomb friction is not zero in a joint at rest. In which direction would it push there? "
    "What does NumPy's own sign give for 0?"
)

RATE_SAID = {
    "halves of ẋ swapped": (
        "You swapped the two halves of ẋ. Which half of x is q, and which half of ẋ is its rate "
        "of change?"
    ),
    "q for its rate": (
        "The first half of your ẋ is q itself. What is the rate of change of q, and where in x "
        "does it stand?"
    ),
    "state read as q̇ and q": (
        "Your accelerations come out as if x were [q̇; q]. Which half of x do you call q?"
    ),
    "state interleaved": INTERLEAVED,
    "states interleaved": INTERLEAVED,
    "dropped / C q̇": (
        "The Coriolis and centrifugal torque is missing from your q̈. Which term of the "
        "equation of motion is quadratic in the velocities?"
    ),
    "wrong sign / C q̇": (
        "The Coriolis and centrifugal torque has the wrong sign in your q̈. On which side of "
        "the equation of motion does it stand?"
    ),
    "C times ones in the torque": (
        "Your Coriolis torque is the sum of each row of C. What must C multiply?"
    ),
    "transposed / in C": (
        "Your Coriolis torque uses C with its rows and columns swapped. Does q̇ stand to the "
        "right or to the left of C?"
    ),
    "dropped / g(q)": (
        "Gravity is missing from your q̈. Which torque acts on the arm when it is at rest?"
    ),
    "wrong sign / g(q)": (
        "Gravity has the wrong sign in your q̈: your arm falls upwards. On which side of the "
        "equation of motion does g(q) stand?"
    ),
    "gravity of Earth / 9.81 / g / in g_vec": (
        "Your q̈ is right only on Earth, because you typed 9.81 into it. The check also uses "
        "other planets: which parameter of arm gives g?"
    ),
    "dropped / the friction": (
        "Friction is missing from your q̈. Which two parameters of arm have you not used yet?"
    ),
    "wrong sign / the friction": (
        "Friction has the wrong sign in your q̈: it drives the joints. Does friction add energy "
        "to an arm or take it out?"
    ),
    "dropped / the viscous friction": (
        "The viscous part of the friction is missing. Which part of f grows with the speed?"
    ),
    "wrong sign / the viscous friction": (
        "The viscous part of your friction has the wrong sign: the faster a joint moves, the "
        "harder it is pushed on. Must friction speed a joint up or slow it down?"
    ),
    "quadratic friction / the viscous friction": (
        "Your viscous friction grows with the square of the speed. Look at the unit of its "
        "coefficient."
    ),
    "dropped / the Coulomb friction": (
        "The Coulomb part of the friction is missing. Which part of f has the same size at "
        "every speed?"
    ),
    "wrong sign / the Coulomb friction": (
        "The Coulomb part of your friction has the wrong sign: it pushes the joint on. Must "
        "friction speed a joint up or slow it down?"
    ),
    "friction in one direction / the Coulomb friction": (
        "Your Coulomb friction always acts in the same direction. What decides the direction of "
        "friction?"
    ),
    "absolute value for sign / the Coulomb friction": (
        "Your Coulomb friction uses |q̇| where the sign of q̇ belongs: it grows with the speed "
        "and never changes direction."
    ),
    "velocity for its sign / the Coulomb friction": (
        "Your Coulomb friction grows with the speed. Dry friction does not depend on how fast a "
        "joint moves: what does it depend on?"
    ),
    "sign of the coordinate / the Coulomb friction": (
        "Your Coulomb friction has the sign of the angle. Does friction depend on where a joint "
        "is, or on how it moves?"
    ),
    "smooth sign / the Coulomb friction / *": SMOOTH_SIGN,
    "friction at rest / the Coulomb friction / *": AT_REST,
    "coefficients exchanged / the friction": (
        "You swapped the two friction coefficients. Which of them is in N·m, and which in "
        "N·m·s/rad?"
    ),
    "not divided by M / the friction": (
        "You subtract the friction from the acceleration. Friction is a torque: how does a "
        "torque become an acceleration?"
    ),
    "dropped / the input u": (
        "The input u is missing from your q̈. What makes the arm move where you want it to?"
    ),
    "wrong sign / the input u": (
        "The input u has the wrong sign in your q̈: the motor turns the wrong way. On which "
        "side of the equation of motion does u stand?"
    ),
    "M not inverted": ("You multiply by M. In M q̈ = …, how do you get q̈ alone?"),
    "torque for acceleration": ("The second half of your ẋ is a torque, in N·m. What resists it?"),
    "divided by the diagonal of M": (
        "You divide by the diagonal of M, as if the joints did not feel each other. What do the "
        "other entries do?"
    ),
    "entries of M inverted": (
        "You invert each entry of M by itself, which does not invert the matrix. Which NumPy "
        "function solves a linear system?"
    ),
    "divided by M entry by entry": (
        "You divide by M entry by entry. Which NumPy function solves a linear system?"
    ),
    "numbers of the example": (
        "Your f always uses the arm of this notebook. The check passes other arms to f: in which "
        "argument do they come?"
    ),
}


def explicit(rows, weights):
    """One step of the explicit method with these coefficients."""

    def step(f, x, u, dt):
        slopes: list = []
        for row in rows:
            ahead = sum((a * k for a, k in zip(row, slopes, strict=True) if a), 0.0)
            slopes.append(f(x + dt * ahead, u))
        return x + dt * sum(b * k for b, k in zip(weights, slopes, strict=True) if b)

    return step


def _without_brackets(f, x, u, dt):
    k1 = f(x, u)
    k2 = f(x + dt / 2 * k1, u)
    k3 = f(x + dt / 2 * k2, u)
    return x + dt / 6 * k1 + 2 * k2 + 2 * k3 + f(x + dt * k3, u)


ROWS = ((), (1 / 2,), (0, 1 / 2), (0, 0, 1))
WEIGHTS = (1 / 6, 1 / 3, 1 / 3, 1 / 6)

# Wrong methods, which show in a step and in a simulation.
METHODS = (
    Mistake(
        "Euler",
        explicit(((),), (1,)),
        "This is Euler's method: only the slope at the start of the step counts, whatever else "
        "you compute. At which states must you take the other three slopes?",
    ),
    Mistake(
        "midpoint",
        explicit(ROWS[:2], (0, 1)),
        "This is the midpoint method, of order 2: only the second slope counts. How much must "
        "each of the four slopes count?",
    ),
    Mistake(
        "Heun",
        explicit(((), (1,)), (1 / 2, 1 / 2)),
        "This is Heun's method, of order 2: you take the mean of the slopes at the two ends. "
        "Where else does RK4 take slopes?",
    ),
    Mistake(
        "k3 from k1",
        explicit((*ROWS[:2], (1 / 2, 0), ROWS[3]), WEIGHTS),
        "Your k3 is the same as k2. Along which slope must k3 set out?",
    ),
    Mistake(
        "k2 twice in the sum",
        explicit((*ROWS[:3], ROWS[3]), (1 / 6, 2 / 3, 0, 1 / 6)),
        "Your sum takes k2 twice and k3 not at all. Look at the two middle terms.",
    ),
    Mistake(
        "k4 from k2",
        explicit((*ROWS[:3], (0, 1, 0)), WEIGHTS),
        "Your k4 sets out along k2. Which slope is the newest by then?",
    ),
    Mistake(
        "k4 from k1",
        explicit((*ROWS[:3], (1, 0, 0)), WEIGHTS),
        "Your k4 sets out along k1. Which slope is the newest by then?",
    ),
    Mistake(
        "half a step in k4",
        explicit((*ROWS[:3], (0, 0, 1 / 2)), WEIGHTS),
        "You take k4 in the middle of the step. How far ahead does the last slope look?",
    ),
    Mistake(
        "whole step in k2",
        explicit(((), (1,), ROWS[2], ROWS[3]), WEIGHTS),
        "You take k2 at the end of the step. How far ahead do the two middle slopes look?",
    ),
    Mistake(
        "whole step in k3",
        explicit((*ROWS[:2], (0, 1), ROWS[3]), WEIGHTS),
        "You take k3 at the end of the step. How far ahead do the two middle slopes look?",
    ),
    Mistake(
        "k4 missing, sum over five",
        explicit(ROWS[:3], (1 / 5, 2 / 5, 2 / 5)),
        "Your sum has three slopes, and the one at the end of the step is missing. Where else does RK4 "
        "take slopes?",
    ),
    Mistake(
        "whole steps in k2 and k3",
        explicit(((), (1,), (0, 1), (0, 0, 1)), WEIGHTS),
        "You take k2 and k3 at the end of the step. How far ahead do the two middle slopes look?",
    ),
    Mistake(
        "equal weights",
        explicit(ROWS, (1 / 4, 1 / 4, 1 / 4, 1 / 4)),
        "Your four slopes have equal weights. Which of them tell more about the whole step?",
    ),
    Mistake(
        "equal weights, sum over six",
        explicit(ROWS, (1 / 6, 1 / 6, 1 / 6, 1 / 6)),
        "Your weights add up to 4/6: the step is too short. How often does each middle slope count?",
    ),
)  # fmt: skip


STEP = (
    *METHODS,
    Mistake(
        "weights in the wrong places",
        explicit(ROWS, (1 / 3, 1 / 6, 1 / 6, 1 / 3)),
        "You swapped the weights: the ends count twice and the middle once. Which slopes tell "
        "more about the whole step?",
    ),
    Mistake(
        "division by six missing",
        explicit(ROWS, (1, 2, 2, 1)),
        "Your step is six times too long. What must the weights of the slopes add up to?",
    ),
    Mistake(
        "dt missing in the sum",
        lambda f, x, u, dt: x + (rk4(f, x, u, dt) - x) / dt,
        "You add a slope to a state. What turns a rate of change into a change?",
    ),
    Mistake(
        "dt missing in the stages",
        lambda f, x, u, dt: x + dt * (rk4(f, x, u, 1.0) - x),
        "The states at which you take k2, k3 and k4 do not depend on dt. How far along a slope is "
        "the middle of the step?",
    ),
    Mistake(
        "dt twice in the stages",
        lambda f, x, u, dt: explicit([[dt * a for a in row] for row in ROWS], WEIGHTS)(f, x, u, dt),
        "For the states at which you take k2, k3 and k4 you multiply by the time step twice. Are your "
        "k's slopes, or changes of the state?",
    ),
    Mistake(
        "brackets missing in the sum",
        _without_brackets,
        "Only the first slope of your sum is multiplied by the time step. Where do its brackets begin "
        "and end?",
    ),
    Mistake(
        "dt twice",
        lambda f, x, u, dt: x + dt * (rk4(f, x, u, dt) - x),
        "You multiply by the time step twice. Are your k's slopes, or changes of the state?",
    ),
    Mistake(
        "change for state",
        lambda f, x, u, dt: rk4(f, x, u, dt) - x,
        "You return the change of the state. Where did the step start?",
    ),
    Mistake(
        "mean slope for state",
        lambda f, x, u, dt: (rk4(f, x, u, dt) - x) / dt,
        "You return a slope. What is the state at the end of the step?",
    ),
    Mistake(
        "step backwards",
        lambda f, x, u, dt: rk4(f, x, u, -dt),
        "Your step goes back in time. Look at the signs in front of dt.",
    ),
    Mistake(
        "change subtracted",
        lambda f, x, u, dt: 2 * x - rk4(f, x, u, dt),
        "You subtract the change from the state. In which direction does a slope lead?",
    ),
    Mistake(
        "input left out",
        lambda f, x, u, dt: rk4(f, x, 0 * u, dt),
        "Your step does not depend on u. What do you pass to f as its second argument?",
    ),
)


def _at_the_stages(f, x0, u, t):
    """u asked for anew at each of the four slopes."""
    if not callable(u):
        return run(f, x0, u, t)

    def rate(state, _):
        return np.append(f(state[:-1], u(state[-1], state[:-1])), 1.0)

    start = np.append(x0, t[0])
    return run(rate, start, np.zeros(0), t)[:, :-1]


def _moved_on(f, x0, u, t):
    """Each row after its step, and all steps as long as the first."""
    return run(f, x0, u, np.append(t, t[-1]), steps=np.full(len(t), t[1] - t[0]))[1:]


# Made of the right rows, or of the times.
ROWS_OF_RUN = {
    "all rows equal": (
        lambda f, x0, u, t: np.tile(run(f, x0, u, t)[-1], (len(t), 1)),
        "All your rows are the last state. Do you store the same array again and again, and "
        "change it in place (as x += ... does)?",
    ),
    "transposed": (
        lambda f, x0, u, t: run(f, x0, u, t).T,
        "Your states stand in columns. Each time must have a row of its own: how do you exchange "
        "rows and columns?",
    ),
    "rows one step ahead": (
        lambda f, x0, u, t: np.vstack([run(f, x0, u, t)[1:], 0 * x0]),
        "Your row k holds the state after step k, and the start is lost. Which state belongs to "
        "t[0]?",
    ),
    "first row is no start, equal steps": (
        _moved_on,
        "Your first row is the state after a step, and all steps are as long as the first. Which "
        "state belongs to t[0], and how long is step k?",
    ),
    "run from time zero": (
        lambda f, x0, u, t: run(f, x0, u, np.append(0.0, t))[1:],
        "Your run starts at time zero, although t need not. At which time is the state x0?",
    ),
    "last step missing": (
        lambda f, x0, u, t: np.vstack([run(f, x0, u, t)[:-1], 0 * x0]),
        "Your last row is still zero: you never take the last step. How many steps lie between "
        "len(t) times?",
    ),
    "state never moved on": (
        lambda f, x0, u, t: np.array(
            [x0, *(run(f, x0, u, t[k : k + 2])[-1] for k in range(len(t) - 1))]
        ),
        "Each of your steps starts from x0 again. Where must step k start?",
    ),
    "start repeated": (
        lambda f, x0, u, t: np.tile(x0, (len(t), 1)),
        "All your rows are x0: nothing moves. Do you store the result of the step anywhere?",
    ),
    "input left out": (
        lambda f, x0, u, t: run(f, x0, 0 * (u(t[0], x0) if callable(u) else u), t),
        "Your run does not depend on u. What do you pass on to the step?",
    ),
    "torque at the stages": (
        _at_the_stages,
        "Your torque changes inside the step. Here a computer drives the arm: how often in one step "
        "does it read the clock and the state?",
    ),
}
# The lengths of the steps.
LENGTHS = {
    "steps taken to be equal": (
        lambda t: np.full(len(t) - 1, t[1] - t[0]),
        "You make all time steps as long as the first one. The times in t need not be equally "
        "spaced: how long is step k?",
    ),
    "equal steps from start to end": (
        lambda t: np.full(len(t) - 1, (t[-1] - t[0]) / (len(t) - 1)),
        "You spread the time evenly over the steps. The times in t need not be equally spaced: how "
        "long is step k?",
    ),
    # The first goes back over the whole run.
    "last step's length": (
        lambda t: t[:-1] - np.roll(t, 1)[:-1],
        "Your step k is as long as the step before it should be. Between which two times does the "
        "state move from row k to row k + 1?",
    ),
}
# The torque that is held in step k.
HELD = {
    "torque of the start only": (
        lambda u, t, k, x, x0: u(t[0], x0),
        "You ask u once, at the start, and hold it for the whole run. How often does the controller "
        "read the clock and the state?",
    ),
    "torque of the end of the step": (
        lambda u, t, k, x, x0: u(t[k + 1], x),
        "You ask u at the end time of each step. When does the controller read the clock, and until "
        "when does it hold the torque?",
    ),
    "torque of the middle of the step": (
        lambda u, t, k, x, x0: u((t[k] + t[k + 1]) / 2, x),
        "You ask u at the middle of each step. When does the controller read the clock, and until "
        "when does it hold the torque?",
    ),
    "torque of the first state": (
        lambda u, t, k, x, x0: u(t[k], x0),
        "You pass x0 to u in every step. Which state does the controller see at t[k]?",
    ),
    "torque of time zero": (
        lambda u, t, k, x, x0: u(0.0, x),
        "You pass the time zero to u in every step. What is the time at the start of step k?",
    ),
    "clock from zero": (
        lambda u, t, k, x, x0: u(t[k] - t[0], x),
        "Your clock starts at zero, although t need not. Which time does the controller read?",
    ),
}


def _with(lengths=np.diff, **changed):
    """The right run with something changed: the lengths of its steps, the method, the torque held."""
    return lambda f, x0, u, t: run(f, x0, u, t, steps=lengths(t), **changed)


SIMULATE = (
    *(Mistake(name, wrong, said) for name, (wrong, said) in ROWS_OF_RUN.items()),
    *(Mistake(name, _with(lengths=of), said) for name, (of, said) in LENGTHS.items()),
    *(Mistake(name, _with(held=held), said) for name, (held, said) in HELD.items()),
    *(Mistake(m.name, _with(step=m.wrong), m.sentence) for m in METHODS),
)


def drift(x, arm, kinetic=kinetic_energy, potential=potential_energy):
    """E(t) − E(0), (len(x),), J: the right answer, or with another K or P."""
    energy = np.array([kinetic(s[:2], s[2:], arm) + potential(s[:2], arm) for s in x])
    return energy - energy[0]


def _nothing(*_):
    return 0.0


DRIFT_TERMS = (
    Term("the change of K", lambda x, arm: drift(x, arm, potential=_nothing)),
    Term("the change of P", lambda x, arm: drift(x, arm, kinetic=_nothing)),
)

DRIFT_SAID = {
    "½ of K missing": sentences.HALF_MISSING,
    "diagonal of M alone": (
        "Your kinetic energy uses only the diagonal of M. What does the energy gain when both "
        "joints turn at once?"
    ),
    "M of the start": (
        "Your kinetic energy uses the M of the first state in every row. What does M depend on?"
    ),
    "C in the energy": (
        "There is a term with C in your energy. Which two energies does the arm have?"
    ),
    "C for M": ("You make the kinetic energy with C. Which matrix gives the kinetic energy?"),
    "P missing": ("The potential energy is missing. What does the arm gain as it rises?"),
    "K missing": ("The kinetic energy is missing. What does the arm gain as it moves faster?"),
    "L for the energy": (
        "Your potential energy falls as the arm rises. Is E the sum of K and P, and does your P "
        "grow with height?"
    ),
    "wrong angle / the weight of link 2 beyond the elbow / q2 / q1 + q2": (
        "Your P measures q2 from the x axis. From where is q2 measured, and how high is the "
        "second centre of mass then?"
    ),
    "cosine for sine": (
        "Your heights use the cosine. From which axis is q1 measured, and how high is the arm "
        "at q = 0?"
    ),
    "dropped / the weight of link 2 at the elbow": (
        "You measure the height of the second centre of mass from the elbow. How high is the elbow?"
    ),
    "torque times coordinate": (
        "Your P is the gravity torque times the angle. A torque that changes on the way must be "
        "summed along it: how high are the two centres of mass?"
    ),
    "gravity of Earth / 9.81 / g": (
        "Your P is right only on Earth, because you typed 9.81 into it. The check also uses "
        "other planets: which parameter of arm gives g?"
    ),
    "from the row before": (
        "You return the change from each row to the next. From which state do you count the drift?"
    ),
    "size of the drift": (
        "You return the size of the drift without its sign. Does the run gain energy or lose it?"
    ),
    "sign of the whole": (
        "Your drift has the wrong sign. Is it positive or negative when the energy grows?"
    ),
    "energy for its drift": (
        "You return the energy itself. By how much has it changed since the first row?"
    ),
    "from the mean": (
        "You subtract the mean of the energy. From which state do you count the drift?"
    ),
    "from the end": (
        "You subtract the energy of the last row. From which state do you count the drift?"
    ),
    "share for the drift": (
        "You divide by the energy at the start. That ratio depends on where P is zero, but the "
        "drift in J does not."
    ),
    "numbers of the example": (
        "Your energy is always that of the arm of this notebook. The check passes other arms to "
        "your function: in which argument do they come?"
    ),
}
