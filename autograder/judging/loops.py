"""Calls in a closed loop: a student's controller is asked, and what it drives is simulated out here.

The student's code gets the state that it may measure, one call a step, and gives back its numbers. The
plant, with all that the controller does not know of it, never enters the room: code can change the run
by its numbers alone, as in any other call.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from autograder.protocol import Call, Fault, FaultKind, Reply

# All steps of a check's loops together may use so much of the processor's time, s.
LONGEST = 30.0


class Run(Protocol):
    """One run of a loop, from its start: as far as it has come."""

    def args(self) -> tuple | None:
        """The arguments of the next call; None where the run is over."""

    def tell(self, value: np.ndarray) -> None:
        """Go on by one step with what the controller returned."""

    def figures(self) -> np.ndarray:
        """What is measured of the run, when it is over."""


class Plant(Protocol):
    """What a controller drives, at the start of a run."""

    def begin(self) -> Run: ...


@dataclass(frozen=True)
class Loop(Call):
    """A whole run in place of one call; its reply holds the figures of the run.

    args: those of its first step. right: the figures of the right answer, which every other model that
    is not run is taken to have.
    """

    plant: Plant | None = field(default=None, repr=False)
    right: np.ndarray = field(default_factory=lambda: np.zeros(0), repr=False)

    def begin(self) -> Run:
        assert self.plant is not None
        return self.plant.begin()


def seconds_of(ask: Callable) -> Callable[[], float]:
    """What gives the processor time that a student's code has used, s.

    It runs in this process, or what asks for it knows.
    """
    return getattr(ask, "seconds", time.process_time)


def loop(name: str, plant: Plant, right) -> Loop:
    """The loop of the controller `name`; `right` is the right controller, whose run is the measure."""
    run = plant.begin()
    first = run.args()
    assert first is not None
    while (args := run.args()) is not None:
        run.tell(np.asarray(right(*args), dtype=float))
    return Loop(name, first, plant=plant, right=run.figures())


def asked(
    calls: list[Call], ask: Callable[[list[Call]], list[Reply]]
) -> tuple[list[Call], list[Reply]]:
    """The replies to calls of which some may be loops, in the order of the calls that are returned too:
    where a step of a loop fails, that step is among them, and the last that has a reply.

    The loops go on together, so that a step is one question. None begins where another call fails.
    """
    loops = [call for call in calls if isinstance(call, Loop)]
    if not loops:
        return calls, ask(calls)
    others = [call for call in calls if not isinstance(call, Loop)]
    replies = ask(others) if others else []
    if len(replies) < len(others) or any(reply.fault for reply in replies):
        return others, replies
    runs = [call.begin() for call in loops]
    if failed := _run(loops[0].name, runs, ask):
        step, reply = failed
        return [*others, step, *loops], [*replies, reply]
    figures = iter(runs)
    rest = iter(replies)
    return calls, [
        Reply(value=next(figures).figures()) if isinstance(call, Loop) else next(rest)
        for call in calls
    ]


def _run(name: str, runs: list[Run], ask) -> tuple[Call, Reply] | None:
    """Take all runs to their ends; the step that failed, if one does."""
    seconds = seconds_of(ask)
    ends = seconds() + LONGEST
    while going := [(run, args) for run in runs if (args := run.args()) is not None]:
        steps = [Call(name, args) for _, args in going]
        replies = ask(steps)
        for (run, _), step, reply in zip(going, steps, replies, strict=False):
            if reply.fault:
                return step, reply
            if not isinstance(reply.value, np.ndarray):  # as one from the sandbox may
                return step, Reply(fault=Fault(FaultKind.GARBLED))
            run.tell(reply.value)
        if seconds() > ends or len(replies) < len(steps):
            return steps[0], Reply(fault=Fault(FaultKind.SLOW_LOOP, f"{LONGEST:g} s"))
    return None
