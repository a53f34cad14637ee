"""A student's curve against the right one, where it says more than a number."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from autograder.judging.check import Check
from autograder.pictures.equations import Equations, NoMotionError, bounded, students
from autograder.pictures.motion import generated
from autograder.pictures.plot import Axis, Line, document, plot
from autograder.problems.material.systems import FreeRun, exact_run, finely, rk4, run
from autograder.protocol import Call, real

WIDTH, HEIGHT = 560, 260
POINTS = 72  # of a whole turn: one each 5°
AROUND = 1.0  # m to each side, where the coordinate is a length
SECONDS, ROWS = 2.0, 161
LONG = 60  # steps of a free run
HALVINGS = 7
LARGEST_STEP = 0.8  # s
# What counts as the same, as a share of the right curve's size.
SAME = 1e-6
# An error that is no more than rounding has no order.
ROUNDING = 1e-13


@dataclass(frozen=True)
class Curves:
    """Lines over one axis, and what their numbers show."""

    title: str
    right: Line
    theirs: Line
    x: Axis
    y: Axis
    said: tuple[str, ...]

    def svg(self, alt: str) -> str:
        body = plot([self.right, self.theirs], self.x, self.y, WIDTH, HEIGHT)
        return document(body, WIDTH, HEIGHT, alt)


Drawing = Callable[[Check, Callable, Call, list[Call]], Curves]


def curves_of(check: Check) -> Drawing | None:
    """How the curves of this check's answer are made, from the worst call and all calls; None if not."""
    of = generated(check)
    name = of.answer if of else check.name
    return {
        "g_vec": over_position,
        "potential_energy": over_position,
        "energy_drift": drift,
        "simulate": free_energy,
        "rk4_step": error_of_step,
    }.get(name)


def over_position(check: Check, function: Callable, call: Call, calls: list[Call]) -> Curves:
    """g or P while one coordinate goes round and the others stay: the one whose curves differ most."""
    of = generated(check)
    assert of is not None
    m, (q0, arm) = of.mechanism, (np.ravel(call.args[0]).astype(float), call.args[-1])
    is_vector = of.answer == "g_vec"
    right = students(check, check.reference, (m.n,) if is_vector else ())
    theirs = students(check, function, (m.n,) if is_vector else ())
    best: Curves | None = None
    largest = -1.0
    for i, c in enumerate(m.coordinates):
        turns = c.unit == "rad"
        along = (
            np.linspace(-np.pi, np.pi, POINTS + 1)
            if turns
            else q0[i] + np.linspace(-AROUND, AROUND, POINTS + 1)
        )
        path = np.tile(q0, (len(along), 1))
        path[:, i] = along
        with bounded():
            pairs = [(right(q, arm), theirs(q, arm)) for q in path]
        one, other = (np.array([pair[k] for pair in pairs]) for k in (0, 1))
        if is_vector:
            one, other = one[:, i], other[:, i]
        else:  # any constant is right
            one, other = one - one[0], other - other[0]
        apart = float(np.max(np.abs(one - other)) / max(np.max(np.abs(one)), 1e-9))
        if apart <= largest:
            continue
        largest = apart
        entry = f"g{i + 1}" if m.n > 1 else "g"
        unit = "N" if is_vector and c.unit == "m" else "N·m" if is_vector else "J"
        what = (
            entry if is_vector else f"P, from its value at {c.name} = {written(along[0])} {c.unit},"
        )
        others = [
            f"{o.name} = {written(q0[k])} {o.unit}" for k, o in enumerate(m.coordinates) if k != i
        ]
        best = Curves(
            f"{what} over {c.name}{', with ' if others else ''}{' and '.join(others)}",
            Line("right", along, one),
            Line("yours", along, other, is_theirs=True),
            Axis(f"{c.name} ({c.unit})"),
            Axis(f"{entry if is_vector else 'P'} ({unit})"),
            tuple(_likeness(along, one, other, turns, f"{c.name}", c.unit, unit)),
        )
    assert best is not None
    return best


def _likeness(x, right, theirs, turns: bool, name: str, of_x: str, of_y: str) -> list[str]:
    size = max(float(np.max(np.abs(right))), 1e-12)

    def same(one, other) -> bool:
        return bool(np.max(np.abs(one - other)) <= SAME * size)

    if same(right, theirs):
        return [f"Along {name} your curve is the right one."]
    if np.ptp(theirs) <= SAME * size < np.ptp(right):
        return [f"Your curve does not change with {name}; the right one does."]
    if np.ptp(right) <= SAME * size < np.ptp(theirs):
        return [f"Your curve changes with {name}; the right one does not."]
    if same(-right, theirs):
        return ["Your curve is the right one turned upside down."]
    share = float(right @ theirs / (right @ right)) if np.any(right) else 0.0
    if share > 0 and same(share * right, theirs):
        return [f"Your curve is {written(share)} times as high as the right one everywhere."]
    apart = float(np.mean(theirs - right))
    if same(right + apart, theirs):
        way = "above" if apart > 0 else "below"
        return [f"Your curve is {written(abs(apart))} {of_y} {way} the right one everywhere."]
    if turns and same(right[0], right[-1]):
        for k in range(1, POINTS):
            if same(np.roll(right[:-1], k), theirs[:-1]):
                degrees = 360 * k / POINTS
                ahead = degrees <= 180
                degrees = degrees if ahead else 360 - degrees
                return [
                    f"Your curve is the right one, moved {degrees:g}° to the "
                    f"{'right' if ahead else 'left'}."
                ]
    k = int(np.argmax(np.abs(theirs - right)))
    # What is no more than rounding is 0.
    yours, other = (written(y if abs(y) > SAME * size else 0.0) for y in (theirs[k], right[k]))
    where = written(x[k])
    return [
        f"They are furthest apart at {name} = {where} {of_x}: yours is {yours} {of_y}, the right one "
        f"{other} {of_y}."
    ]


def drift(check: Check, function: Callable, call: Call, calls: list[Call]) -> Curves:
    """E(t) − E(0) of a motion that the right equations give, from the first state of the call."""
    of = generated(check)
    assert of is not None
    m, (x0, arm) = of.mechanism.full, (np.asarray(call.args[0], dtype=float)[0], call.args[-1])
    resisted = bool(m.friction) and all(hasattr(arm, term.coefficient) for term in m.friction)
    equations = Equations(m, arm, friction=resisted)
    t = np.linspace(0.0, SECONDS, ROWS)
    x = run(equations.rate, x0, np.zeros(m.n), t)
    if not np.all(np.isfinite(x)):
        raise NoMotionError("the right motion cannot be played from there")
    right = check.reference(x, arm)
    with bounded():
        theirs = students(check, function, (ROWS,))(x, arm)
    return Curves(
        f"the drift along a motion {'with friction' if resisted else 'without friction'}",
        Line("right", t, np.ravel(right)),
        Line("yours", t, theirs, is_theirs=True),
        Axis("time (s)"),
        Axis("E(t) − E(0) (J)"),
        tuple(_over_time(t, np.ravel(right), theirs, "J")),
    )


def free_energy(check: Check, function: Callable, call: Call, calls: list[Call]) -> Curves:
    """E(t)/E(0) of a free run without friction, longer than those of the check."""
    runs = [c for c in calls if isinstance(c, FreeRun)]
    free = call if isinstance(call, FreeRun) else runs[0]
    assert free.energy is not None
    f, x0, u, grid = free.args
    t = grid[0] + (grid[1] - grid[0]) * np.arange(LONG + 1)
    right = exact_run(real(f), x0, u, t)
    with bounded():
        x = students(check, function, right.shape)(f, x0, u, t)
    start = free.energy(x0[None])
    shares = [free.energy(states) / start for states in (right, x)]
    return Curves(
        "the energy of a free motion without friction, as a share of its start",
        Line("right", t, shares[0]),
        Line("yours", t, shares[1], is_theirs=True),
        Axis("time (s)"),
        Axis("E(t)/E(0)"),
        tuple(_over_time(t, shares[0], shares[1], "")),
    )


def _over_time(t, right, theirs, unit: str) -> list[str]:
    k = int(np.argmax(np.abs(theirs - right)))
    if abs(theirs[k] - right[k]) <= 1e-4 * max(float(np.max(np.abs(right))), 1e-9):
        return ["Along this motion your curve is the right one."]
    end = f"{written(t[-1] - t[0])} s"

    def at(value: float) -> str:
        return f"{written(value)} {unit}".rstrip()

    said = f"After {end} yours is at {at(theirs[-1])}, the right one at {at(right[-1])}."
    if abs(theirs[k] - right[k]) > 2 * abs(theirs[-1] - right[-1]):
        apart = at(abs(theirs[k] - right[k]))
        said += f" They are furthest apart after {written(t[k] - t[0])} s, by {apart}."
    return [said]


def error_of_step(check: Check, function: Callable, call: Call, calls: list[Call]) -> Curves:
    """The error of one step of a smooth system over the step's length, beside RK4's own."""
    smooth = [c for c in [call, *calls] if "x[" in c.args[0].returns]
    f, x, u, _ = smooth[0].args
    rate, theirs = real(f), students(check, function, np.shape(x))
    lengths = LARGEST_STEP / 2.0 ** np.arange(HALVINGS)
    errors = []
    with bounded():
        for dt in lengths:
            exact = x
            for _ in range(8):
                exact = finely(rate, exact, u, dt / 8)
            size = max(float(np.max(np.abs(exact))), 1.0)
            ends = rk4(rate, x, u, dt), theirs(f, x, u, float(dt))
            errors.append([np.max(np.abs(end - exact)) / size for end in ends])
    right, own = np.maximum(np.array(errors).T, ROUNDING)
    return Curves(
        "the error of one step over its length",
        Line("RK4", lengths[::-1], right[::-1]),
        Line("yours", lengths[::-1], own[::-1], is_theirs=True),
        Axis("dt (s)", logarithmic=True),
        Axis("error, share of |x|", logarithmic=True),
        tuple(_order(right, own)),
    )


def written(value: float) -> str:
    """A number in a sentence."""
    return f"{value:.3g}".replace("-", "−")


def _order(right, own) -> list[str]:
    """By how much half the step divides the errors, where they fall evenly."""
    factors = [_factor(errors) for errors in (own, right)]
    if np.allclose(own, right, rtol=0.05):
        return ["On this system your step is as good as RK4's."]
    if factors[0] is None or factors[1] is None:
        return [f"At the shortest step your error is {own[-1]:.2g}, RK4's is {right[-1]:.2g}."]
    return [
        f"Half the step divides your error by {factors[0]:.2g}, and RK4's by {factors[1]:.2g}: on these "
        "axes a method of higher order falls more steeply."
    ]


def _factor(errors) -> float | None:
    kept = errors[errors > 100 * ROUNDING]
    if len(kept) < 4:
        return None
    factors = kept[:-1] / kept[1:]
    last = factors[-2:]
    return float(np.mean(last)) if np.ptp(last) < 0.3 * np.mean(last) else None
