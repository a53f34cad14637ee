"""Finds the events of a simulation: the times at which a function of time and state passes zero."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from scipy.optimize import brentq

from armdyn.parameters import all_finite, real_array

FINEST = 4 * np.finfo(float).eps


@dataclass(frozen=True)
class Event:
    """The event that g(t, x), a single number, reaches or passes zero; x: (N,), t in s.

    direction: +1 for rising through zero only, −1 for falling only, 0 for both. terminal: whether
    the simulation stops there. Raises ValueError, naming the argument, if g is not a function, or
    if direction is none of these.
    """

    g: Callable[[float, np.ndarray], float]
    direction: int = 0
    terminal: bool = False

    def __post_init__(self):
        if not callable(self.g):
            raise ValueError(f"g = {self.g!r}: needs a function g(t, x) that gives one number")
        if self.direction not in (-1, 0, 1):
            raise ValueError(f"direction = {self.direction!r}: needs −1, 0 or 1")


@dataclass(frozen=True)
class Trajectory:
    """States over time, and the events on the way.

    t: (T,), s: the times asked for; if a terminal event stopped the simulation, the times before
    it, then its own. x: (T, N), the states at t. event_times: for each event its times, (k,), s;
    event_states: the states there, (k, N). stopped_by: the index of the event that stopped the
    simulation, or None.
    """

    t: np.ndarray
    x: np.ndarray
    event_times: tuple[np.ndarray, ...]
    event_states: tuple[np.ndarray, ...]
    stopped_by: int | None = None


@dataclass
class Watch:
    """Looks, step by step, for sign changes of each event's g.

    It sees an event if g has one sign at the start of a step and the other sign, or zero, at its
    end. It misses a g that turns back within one step. A g that starts at zero is no event.
    """

    events: tuple[Event, ...]
    t: float
    x: np.ndarray
    found: list[tuple[float, int, np.ndarray]] = field(default_factory=list)
    stopped_by: int | None = None

    def __post_init__(self):
        self._g = [self._value(i, self.t, self.x) for i in range(len(self.events))]

    def step(self, t: float, x, at) -> float:
        """Note the events between the last time and t; x is the state at t.

        at(t) gives the states in between. Returns t, or the time of the terminal event before it.
        """
        before, self._g = self._g, [self._value(i, t, x) for i in range(len(self.events))]
        passed = []
        for i, (old, new) in enumerate(zip(before, self._g, strict=True)):
            if old * self.events[i].direction <= 0 and np.sign(old) * np.sign(new) <= 0 and old:
                passed.append((self._root(i, t, old, new, at), i))
        self.t = t
        for time, i in sorted(passed):
            self.found.append((time, i, at(time)))
            if self.events[i].terminal:
                self.stopped_by = i
                return time
        return t

    def trajectory(self, t, x) -> Trajectory:
        times, states = [], []
        for i in range(len(self.events)):
            mine = [(time, state) for time, k, state in self.found if k == i]
            times.append(np.array([time for time, _ in mine], float))
            states.append(np.array([state for _, state in mine]).reshape(-1, x.shape[-1]))
        return Trajectory(t, x, tuple(times), tuple(states), self.stopped_by)

    def _root(self, i, t, old, new, at) -> float:
        # The ends' own values: an interpolant may round to the other sign there.
        known = {self.t: old, t: new}
        return brentq(
            lambda s: known[s] if s in known else self._value(i, s, at(s)),
            *known,
            xtol=1e-14,
            rtol=FINEST,
        )

    def _value(self, i, t, x) -> float:
        name = f"events[{i}].g at t = {t:.6g} s"
        value = all_finite(name, real_array(name, self.events[i].g(t, x)))
        if value.size != 1:
            raise ValueError(f"{name}: got shape {value.shape}, needs one number")
        return float(value.reshape(()))


def listed(events) -> tuple[Event, ...]:
    """One event or several, functions or Events, as a tuple of Events."""
    several = events if isinstance(events, list | tuple) else [events]
    return tuple(event if isinstance(event, Event) else Event(event) for event in several)
