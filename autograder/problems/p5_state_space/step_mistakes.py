"""Mistakes about one step of an integrator."""

from autograder.judging.diagnosis import Mistake
from autograder.problems.material.systems import rk4


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
