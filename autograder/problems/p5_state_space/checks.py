"""p5-state-space: the arm in first-order form, the classical Runge–Kutta method, and its drift.

A simulator is judged by what its user sees. Where the rate does not depend on the state, every
consistent method is exact, so that rows, times and held torques are judged apart from the method. On
smooth systems the steps are drawn so long that RK4's own error is a fifth of the tolerance: every
method of order 4 or more passes, and any tight adaptive solver, while one of order 3 does not.
"""

import numpy as np

from autograder.judging.carried.follows import Follows
from autograder.judging.check import Check, Criterion
from autograder.judging.criterion import TOLERANCE, Answered, Said
from autograder.judging.quantities import UnfitError, each, vector
from autograder.judging.section import Section
from autograder.mutation.generated import Generated
from autograder.problems.material import following, planar_2r, sampling
from autograder.problems.material.systems import (
    METHOD,
    FreeRun,
    exact_run,
    finely,
    fitted,
    free_runs,
    signed,
    smooth,
    steady,
    step_lengths,
    times,
    torque_function,
)
from autograder.problems.p5_state_space import (
    drift_mistakes,
    mistakes,
    run_mistakes,
    step_mistakes,
)
from autograder.protocol import Call, Function

# What order 4 looks like where the step is not yet small. A method of order 3 shows 3.3 at most.
LEAST_ORDER = 3.5
# Methods of order 3 differ from RK4, and from each other, by little more than the tolerance; so a method
# is named only where it matches to the rounding of single precision.
EXACTLY = 3e-7


def _rate_calls(rng, count):
    """Both joints moving, then one at rest, then one slow: what tells a sign from what looks like it.

    Each joint in turn, so that friction which is wrong in one of them alone shows. Where both move, this
    one is slower and turns against the other, so that the sum of the velocities has another sign.
    """
    calls = []
    first = rng.integers(2)
    for k in range(count):
        q, qd = sampling.angles(rng), sampling.velocities(rng)
        joint = (first + k // 3) % 2
        if k % 3 == 0:
            slow, fast = np.sort(np.abs(qd))
            way = (-1.0) ** (k // 6)  # so that each joint turns both ways within six calls
            qd[joint], qd[1 - joint] = -way * slow, way * fast
        qd[joint] = qd[joint] * (1.0, 0.0, 0.001)[k % 3] + 0.0  # and no -0.0
        u = rng.choice([-1.0, 1.0], 2) * rng.uniform(1.0, 8.0, 2)
        calls.append(
            Call("f", (np.concatenate([q, qd]), u, sampling.planar_2r(rng, friction=True)))
        )
    return calls


@each
def _halves(call, value):
    x = vector(value, 4)
    return x[:2], x[2:]


def _step_calls(rng, count):
    """Every other system steady, then smooth; of one to four states and one or two inputs."""
    calls = []
    for k in range(count):
        size, inputs = int(rng.integers(1, 5)), int(rng.integers(1, 3))
        x, u = signed(rng, 0.5, 1.5, size), signed(rng, 0.5, 1.0, inputs)
        f, dt = steady(rng, size, inputs), rng.uniform(0.1, 0.3)
        if k % 2:
            f = smooth(rng, size, inputs)
            (dt,) = fitted(f, x, u, np.array([dt]), METHOD)
        calls.append(Call("rk4_step", (f, x, u, float(dt))))
    return calls


def _is_steady(call) -> bool:
    return "x[" not in call.args[0].returns


NOTHING = np.zeros(0)


@each
def _step_parts(call, value):
    """The state after the step, under the criterion that this system belongs to."""
    x = vector(value, len(call.args[1]))
    return (x, NOTHING) if _is_steady(call) else (NOTHING, x)


def _run_calls(rng, count):
    """Groups of five runs: steady with a torque vector, steady with a torque function, smooth, and a
    free one twice, the second time with half the step. Two groups of 6 cases, four of 24."""
    calls = []
    for k in range(2 + count // 12):
        n = 1 + k % 2
        x0, x1, x2 = (signed(rng, 0.5, 1.5, 2 * n) for _ in range(3))
        u = signed(rng, 0.5, 1.0, n)
        ramp, f = steady(rng, 2 * n, n), smooth(rng, 2 * n, n)
        fit = fitted(f, x2, u, step_lengths(rng, 6), METHOD)
        calls += [
            Call("simulate", (ramp, x0, u, times(rng, step_lengths(rng, 5)))),
            Call("simulate", (ramp, x1, torque_function(rng, n), times(rng, step_lengths(rng, 5)))),
            Call("simulate", (f, x2, u, times(rng, fit))),
            *free_runs(rng, n),
        ]
    return calls


def _run_parts(calls, values):
    """For each criterion, what the runs that belong to it say of it."""
    values = [_read_states(call, value) for call, value in zip(calls, values, strict=True)]
    parts = []
    for k, (call, (raw, states)) in enumerate(zip(calls, values, strict=True)):
        judged = [NOTHING] * 5
        if isinstance(call, FreeRun):
            if isinstance(calls[k - 1], FreeRun):
                judged[3] = np.array(_observed_order(call, values[k - 1][1], states))
                judged[4] = _energy_share(call, states)
        elif not _is_steady(call):
            judged[2] = states
        elif isinstance(call.args[2], Function):
            judged[1] = states
        else:
            judged[0] = raw
        parts.append(tuple(judged))
    return parts


def _read_states(call, value):
    """The states as they came and, where rows and columns are exchanged, turned round."""
    rows, columns = len(call.args[3]), len(call.args[1])
    if np.shape(value) == (columns, rows):
        return np.reshape(value, (rows, columns)), value.T
    if np.shape(value) == (rows - 1, columns):
        raise UnfitError(
            f"{rows - 1} rows for {rows} times; it must return one row for each time, and the "
            "state at t[0] is x0"
        )
    if np.shape(value) != (rows, columns):
        raise UnfitError(
            f"an array of shape {np.shape(value)}; it must return one row for each time and one "
            f"column for each entry of the state, shape {(rows, columns)}"
        )
    return value, value


def _observed_order(call, coarse, fine) -> float:
    """p, where halving the step divides the error of the last state by 2**p; 4 counts as reached from
    LEAST_ORDER on, and where the error is no larger than RK4 may leave."""
    first, second = (np.max(np.abs(states[-1] - call.end)) for states in (coarse, fine))
    if second <= TOLERANCE * np.max(np.abs(call.end)):
        return 4.0
    order = float(np.log2(max(first, 1e-12) / second))
    return 4.0 if order >= LEAST_ORDER else order


def _energy_share(call, states):
    """E(t)/E(0); nothing counts as kept where the run does not even come near the end."""
    x0 = call.args[1]
    kept = call.energy(states) / call.energy(x0[None])
    arrived = np.linalg.norm(states[-1] - call.end) < 0.5 * np.linalg.norm(x0 - call.end)
    return kept if arrived else 0 * kept


def _ends_astray(answered: Answered) -> bool:
    """Whether a free run's energy was put to 0, as `_energy_share` does where it ends elsewhere."""
    return any(np.size(case[4]) and not np.any(case[4]) for case in answered.given)


def _drift_calls(rng, count):
    """In turn: only K changes, only P changes, both do."""
    calls = []
    for k in range(count):
        rows = int(rng.integers(5, 9))
        q = np.array([sampling.angles(rng) for _ in range(rows)])
        qd = np.array([sampling.velocities(rng) for _ in range(rows)])
        if k % 3 == 0:
            q[:] = q[0]
        elif k % 3 == 1:
            qd[:] = 0.0
        arm = sampling.planar_2r(rng, friction=True)
        calls.append(Call("energy_drift", (np.hstack([q, qd]), arm)))
    return calls


@each
def _drift_parts(call, value):
    x = call.args[0]
    judged = [NOTHING] * 3
    which = 1 if not np.any(x[:, 2:]) else 2 if np.any(np.diff(x[:, :2], axis=0)) else 0
    judged[which] = vector(value, len(x))
    return tuple(judged)


READ = "p5-discussion"  # by a person
CHECKS = (
    Check(
        id="p5-f",
        signature="f(x, u, arm)",
        reference=mistakes.rate,
        calls=_rate_calls,
        quantities=_halves,
        criteria=(
            Criterion("velocities in ẋ", "rad/s", 0.25),
            Criterion("accelerations in ẋ", "rad/s²", 0.75),
        ),
        catalogue=Generated("planar-2r", "f", mistakes.RATE_SAID, mistakes.EXAMPLE),
        terms=mistakes.RATE_TERMS,
        hints=(
            "Cut x into its two halves first. One half of ẋ is then there already, without any "
            "physics.",
            "Solve the equation of motion for M q̈. How many torques act beside u, and which of them "
            "depend on q, on q̇, or on both?",
            "Write the friction torque on a line of its own, with arm.viscous, arm.coulomb and "
            "np.sign. Then let np.linalg.solve divide by M, and join the halves with np.concatenate.",
        ),
        section=Section("10-state-space-and-simulation", "10-state", "1 · The state form"),
        further=(
            "An integrator sees nothing of the arm but f. With one wrong sign in it, it would "
            "simulate another arm, and just as exactly."
        ),
        pose=lambda call: planar_2r.joints(call.args[0][:2], call.args[2]),
    ),
    Check(
        id="p5-rk4_step",
        signature="rk4_step(f, x, u, dt)",
        reference=finely,
        calls=_step_calls,
        quantities=_step_parts,
        criteria=(
            Criterion(
                "step under a constant rate",
                "",
                0.25,
                otherwise=(
                    "Your step goes wrong even where f gives the same slope everywhere. What do "
                    "the weights of the slopes add up to, and where do x, u and dt enter?"
                ),
            ),
            Criterion(
                "step under a smooth rate, as exact as order 4 allows",
                "",
                0.75,
                otherwise=(
                    "Your step ends further from the exact motion than one of order 4 does. Compare it "
                    "line by line with the four slopes in the text: where do you take each of them, and "
                    "how much does it count?"
                ),
                matching=EXACTLY,
            ),
        ),
        mistakes=step_mistakes.STEP,
        hints=(
            "f(x, u) is a slope: how fast the state changes there. Write the four slopes on four "
            "lines; each one needs the one before it.",
            "k2 and k3 are taken half a step ahead, k4 a whole step ahead, each from x and along "
            "the newest slope. u is the same in all four.",
            "The new state is x plus dt times a mean of the slopes. The two middle slopes count "
            "twice; the weights add up to 1.",
        ),
        section=Section("10-state-space-and-simulation", "10-steps", "2 · One step"),
        further=(
            "Your step calls f four times. Four of Euler's steps, each a quarter as long, cost "
            "the same, and at small steps they are far less exact."
        ),
    ),
    Check(
        id="p5-simulate",
        signature="simulate(f, x0, u, t)",
        returns="x",
        reference=exact_run,
        calls=_run_calls,
        quantities=_run_parts,
        criteria=(
            Criterion(
                "row for each time, with u a vector",
                "",
                0.2,
                otherwise=(
                    "Your rows go wrong even under a rate that does not change. Which state is "
                    "row 0, and how long is step k?"
                ),
            ),
            Criterion(
                "row for each time, with u a function, held over each step",
                "",
                0.2,
                otherwise=(
                    "Your rows go wrong when u is a function. At which time, and with which "
                    "state, do you ask u in step k?"
                ),
            ),
            Criterion(
                "agreement with the exact motion",
                "",
                0.2,
                otherwise=(
                    "Your states are further from the exact motion than RK4 would be. Is your "
                    "step right? If you use a solver, are its tolerances tight enough?"
                ),
                matching=EXACTLY,
            ),
            Criterion(
                "observed order (should be 4)",
                "",
                0.2,
                otherwise=(
                    "Half the step should leave a sixteenth of the error, and yours leaves more. "
                    "Is your step right? If you use a solver, are its tolerances tight enough?"
                ),
                is_property=True,
                is_bound=True,
            ),
            Criterion(
                "energy of a free motion, as a share of its start",
                "",
                0.2,
                otherwise=(
                    Said(
                        "Your free motion does not come near the state where it should end, so its "
                        "energy counts for nothing.",
                        _ends_astray,
                    ),
                    Said(
                        "A free motion without friction keeps its energy. Yours changes it by more "
                        "than RK4 would."
                    ),
                ),
                is_property=True,
            ),
        ),
        mistakes=run_mistakes.SIMULATE,
        hints=(
            "First make an array of len(t) rows, with x0 in the first row. How many steps are "
            "then left to take?",
            "Step k leads from t[k] to t[k + 1], and from row k to row k + 1. Where u is a "
            "function, ask it once, at the start of the step; callable(u) tells.",
            "In a loop over range(len(t) - 1): the torque, from t[k] and states[k]; then "
            "states[k + 1] = rk4_step(...). Assign to the row; do not change an array in place.",
        ),
        section=Section("10-state-space-and-simulation", "10-steps", "2 · One step"),
        follows=(
            Follows(
                ("p5-rk4_step",),
                "Each of your rows is one step of your own rk4_step from the row before, so this part "
                "is right. The mistake is in the step: mend it, and the run follows.",
                following.RUN_OF_STEPS,
            ),
        ),
        further=(
            "Between two rows, the cubic that has both states and both slopes f(x, u) is a smooth "
            "curve close to the motion: for a picture you need no smaller steps."
        ),
    ),
    Check(
        id="p5-energy_drift",
        signature="energy_drift(x, arm)",
        reference=drift_mistakes.drift,
        calls=_drift_calls,
        quantities=_drift_parts,
        criteria=(
            Criterion("change of the kinetic energy", "J", 0.35),
            Criterion("change of the potential energy", "J", 0.35),
            Criterion("drift where both change", "J", 0.3),
        ),
        catalogue=Generated(
            "planar-2r", "energy_drift", drift_mistakes.DRIFT_SAID, mistakes.EXAMPLE
        ),
        terms=drift_mistakes.DRIFT_TERMS,
        hints=(
            "First write a function for the energy of one state; then use it on every row.",
            "For the potential energy you need the heights of the two centres of mass. The second "
            "one sits on the elbow and points along q1 + q2.",
            "Put the energies into an array E of len(x) entries. The drift compares all of them "
            "with one of them. Which entry of your result is 0?",
        ),
        section=Section(
            "10-state-space-and-simulation", "10-energy", "3 · The energy as an instrument"
        ),
        further=(
            "Your function uses K and P, and not f. So it judges a simulator by formulas that the "
            "simulator has never seen."
        ),
    ),
)
