"""Timing two things in turn, so that a ratio holds where the machine's speed drifts.

Times are the process's own (CPU) time: all that is timed here runs in one thread, and other work on
the machine then does not count.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Row:
    """One figure: our time and the peer's, s, and how large ours/peer may be (or must be, inverted).

    at_most: the goal for ours/peer; 1/30 stands for "30 times faster".
    """

    what: str
    ours: float
    peer_name: str
    peer: float
    at_most: float

    @property
    def ratio(self) -> float:
        return self.ours / self.peer

    @property
    def met(self) -> bool:
        return self.ratio <= self.at_most


def in_turn(
    ours: Callable, peer: Callable, number: int = 1, rounds: int = 15
) -> tuple[float, float]:
    """The least time of one call of each, over rounds of `number` calls taken in turn."""
    best = [float("inf"), float("inf")]
    for _ in range(rounds):
        for k, call in enumerate((ours, peer)):
            start = time.process_time()
            for _ in range(number):
                call()
            best[k] = min(best[k], (time.process_time() - start) / number)
    return best[0], best[1]


def table(rows: list[Row]) -> str:
    """The rows as a Markdown table."""
    lines = ["| what | ours | peer | ratio | goal | met |", "|---|---|---|---|---|---|"]
    for row in rows:
        lines.append(
            f"| {row.what} | {_time(row.ours)} | {row.peer_name} {_time(row.peer)} "
            f"| {_ratio(row.ratio)} | {_ratio(row.at_most)} | {'yes' if row.met else 'no'} |"
        )
    return "\n".join(lines) + "\n"


def _time(seconds: float) -> str:
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds / 1e-9:.3g} ns"


def _ratio(ratio: float) -> str:
    return f"{ratio:.2f} ×" if ratio > 0.2 else f"1/{1 / ratio:.3g}"
