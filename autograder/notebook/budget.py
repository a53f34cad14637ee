"""What the code of a notebook may use together, and what used it up.

One slow notebook must not hold up all others. But what a student tries out in cells of their own takes
no time from the answers, and one answer none from the checks of another.
"""

from dataclasses import dataclass, field

from autograder.protocol import PATIENCE, one_line

OWN_SECONDS = 60.0
GIVEN_SECONDS = 60.0
# For the calls of each function. All three are processor time; to wait, there is PATIENCE times as long.
CALLS_SECONDS = 60.0
MOST_NAMED = 2
MOST_OF_A_LINE = 40
AGAIN = "running the cells again after Python had ended"


@dataclass
class Budget:
    """The time of one kind of code. whose: "your own cells"; used: by what took it, processor time and
    time of waiting, s.
    """

    whose: str
    seconds: float
    used: dict[str, tuple[float, float]] = field(default_factory=dict)

    def take(self, what: str, seconds: float, idle: float) -> None:
        before, idle_before = self.used.get(what, (0.0, 0.0))
        self.used[what] = before + seconds, idle_before + idle

    @property
    def left(self) -> float:
        """Of the processor time, s."""
        return self.seconds - sum(seconds for seconds, _ in self.used.values())

    @property
    def idle_left(self) -> float:
        """Of the time in which nothing computes, s."""
        return PATIENCE * self.seconds - sum(idle for _, idle in self.used.values())

    @property
    def is_over(self) -> bool:
        return self.left <= 0 or self.idle_left <= 0

    @property
    def is_over_by_waiting(self) -> bool:
        return self.left > 0 and self.idle_left <= 0

    def spent(self) -> str:
        """That it is used up, and what took most."""
        waited = self.is_over_by_waiting
        most = PATIENCE * self.seconds if waited else self.seconds
        took = {what: idle if waited else seconds for what, (seconds, idle) in self.used.items()}
        longest = sorted(took, key=lambda what: -took[what])[:MOST_NAMED]
        named = " and ".join(f"{what} took {took[what]:.3g} s" for what in longest)
        how = "waited" if waited else "used up"
        return f"{self.whose} had {how} the {most:g} s that they have together ({named})"


def cell(source: str) -> str:
    """How a sentence names a cell: a graded notebook numbers none."""
    lines = (line.strip() for line in source.split("\n"))
    first = next((line for line in lines if line), "")
    return f"the cell that begins with “{one_line(first, MOST_OF_A_LINE)}”"
