"""Mistakes about a run: its rows, the lengths of its steps, the torque that is held in each."""

import numpy as np

from autograder.judging.diagnosis import Mistake
from autograder.problems.material.systems import run
from autograder.problems.p5_state_space.step_mistakes import METHODS


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
