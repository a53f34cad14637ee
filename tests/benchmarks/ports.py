"""The same arm in each language, states a second: python -m tests.benchmarks.ports [FILE].

Prints the section, and writes it to FILE if one is given. The numbers are compared with Planar2R's
before anything is timed.
"""

import sys
import time
from collections.abc import Callable
from dataclasses import astuple, dataclass
from pathlib import Path

import numpy as np

from armdyn import Planar2R, derive, ports
from armdyn.simulate import simulate
from tests.benchmarks import report

ARM = Planar2R(1.0, 0.8, 0.5, 0.4, 3.0, 2.0, 0.25, 0.11)
U = [1.0, -2.0]
DT = 1e-3
# How many states and steps each gets through in about a second.
AMOUNTS = {
    "cpp": (200_000, 200_000),
    "java": (200_000, 200_000),
    "matlab": (2_000, 2_000),
    "wolfram": (50, 20),
}
ROUNDS = 5

HOW = """\
The 2R arm in four languages, each a program of its own that is asked over a pipe: states whose M, C,
g, f, P and q̈ it gives back a second, and steps of RK4 a second; wall clock, the best of {rounds} runs
after a first one. The start is from nothing to the first answer, compiled before. The rows of Python
are for comparison: `Planar2R`, all states in one call and one at a time. {machine}.

| program | start | states/s | RK4 steps/s |
|---|---|---|---|
"""


@dataclass(frozen=True)
class Speed:
    """What one program does: seconds to its first answer, and how much it gets through a second."""

    program: str
    start: float | None
    states: float
    steps: float

    def line(self) -> str:
        start = "" if self.start is None else f"{self.start:.2g} s"
        return f"| {self.program} | {start} | {_round(self.states)} | {_round(self.steps)} |\n"


def of_language(language: str, derivation: derive.Derivation | None) -> Speed:
    """The speed of the source by hand, or of what codegen writes for a derivation."""
    how = "by hand" if derivation is None else "generated"
    parameters = _parameters(derivation)
    many, steps = AMOUNTS[language]
    states = np.random.default_rng(0).uniform(-3, 3, size=(many, 4))
    t = DT * np.arange(steps + 1)
    ports.built(language, derivation)
    begin = time.perf_counter()
    with ports.start(language, derivation, seconds=300) as program:
        found = program.terms(parameters, states[:1], U)
        start = time.perf_counter() - begin
        np.testing.assert_allclose(
            found.qdd, ARM.dynamics(states[:1, :2], states[:1, 2:], U), 1e-10
        )
        by_states = _least(lambda: program.terms(parameters, states, U))
        by_steps = _least(lambda: program.simulate(parameters, [0.3, 0.4, 0.0, 0.0], U, t))
    return Speed(f"{language}, {how}", start, many / by_states, steps / by_steps)


def of_python() -> list[Speed]:
    """Planar2R's, all states in one call, and one at a time."""
    states = np.random.default_rng(0).uniform(-3, 3, size=(200_000, 4))

    def terms(q, qd):
        ARM.M(q), ARM.C(q, qd), ARM.g_vec(q), ARM.f_vec(qd), ARM.potential_energy(q)
        ARM.dynamics(q, qd, U)

    together = _least(lambda: terms(states[:, :2], states[:, 2:]))
    few = states[:2_000]
    single = _least(lambda: [terms(state[:2], state[2:]) for state in few])
    t = DT * np.arange(2_001)
    steps = _least(lambda: simulate(ARM.state_derivative, [0.3, 0.4, 0.0, 0.0], U, t))
    return [
        Speed("Python, all in one call", None, len(states) / together, float("nan")),
        Speed("Python, one at a time", None, len(few) / single, 2_000 / steps),
    ]


def _parameters(derivation) -> np.ndarray:
    if derivation is None:
        return np.hstack(astuple(ARM))
    return np.array([getattr(ARM, symbol.name) for symbol in derivation.parameters])


def _least(call: Callable) -> float:
    """The least wall-clock time, s, of several runs after a first."""
    call()
    least = float("inf")
    for _ in range(ROUNDS):
        begin = time.perf_counter()
        call()
        least = min(least, time.perf_counter() - begin)
    return least


def _round(rate: float) -> str:
    """Two digits: the machine's speed is not steadier."""
    return "" if np.isnan(rate) else f"{float(f'{rate:.2g}'):,.0f}"


def main(arguments: list[str]) -> None:
    text = HOW.format(rounds=ROUNDS, machine=report.machine())
    for language in ports.LANGUAGES:
        if line := ports.missing(language):
            raise SystemExit(f"the table needs every language: {line}")
        for derivation in (None, derive.planar_chain(2)):
            text += of_language(language, derivation).line()
    text += "".join(speed.line() for speed in of_python())
    print(text)
    for file in arguments:
        report.put(Path(file), "Ports", text, measured=("start", "states/s", "RK4 steps/s"))


if __name__ == "__main__":
    main(sys.argv[1:])
