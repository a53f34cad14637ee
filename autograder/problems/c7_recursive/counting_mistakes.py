"""Mistakes in counting operations."""

from autograder.judging.diagnosis import Mistake
from autograder.problems.c7_recursive.counting import Counted, count, direct, operations, outwards
from autograder.problems.c7_recursive.counting import sweeps as by_sweeps


def _counted(kinds: str):
    return lambda n: tuple(
        sum(number for kind, number in operations(algorithm, n).items() if kind in kinds)
        for algorithm in (direct, by_sweeps)
    )


def _of_both(algorithms, n: int, number=Counted) -> tuple[int, int]:
    first, second = (sum(operations(algorithm, n, number).values()) for algorithm in algorithms)
    return first, second


class _NotFromTheRight(Counted):
    """Does not count where the number on the left is a float."""

    def _uncounted(self, other):
        return self

    __radd__ = __rsub__ = __rmul__ = _uncounted


def _outwards(n: int) -> int:
    return _of_both((outwards, outwards), n)[0]


COUNT = (
    Mistake(
        "products only",
        _counted("*"),
        "You count the multiplications only. What else costs an operation?",
    ),
    Mistake(
        "sums only",
        _counted("+-"),
        "You count sums and differences only. What else costs an operation?",
    ),
    Mistake("plus only", _counted("+"), "You count the signs + only. What else is asked for?"),
    Mistake(
        "without subtractions",
        _counted("+*"),
        "Your count leaves the subtractions out. Which method of your number stands for −?",
    ),
    Mistake(
        "exchanged",
        lambda n: count(n)[::-1],
        "Your two counts are right, but in the other order. Which of them does the docstring ask for "
        "first?",
    ),
    Mistake(
        "not set back",
        lambda n: (count(n)[0], sum(count(n))),
        "Your second count includes the first one. When does your counter start again from zero?",
    ),
    Mistake(
        "not set back, the sweeps first",
        lambda n: (sum(count(n)), count(n)[1]),
        "Your first count includes the second one. When does your counter start again from zero?",
    ),
    Mistake(
        "one link fewer",
        lambda n: count(n - 1),
        "Your counts are those of an arm with one link fewer. How long are the lists that you pass?",
    ),
    Mistake(
        "one link more",
        lambda n: count(n + 1),
        "Your counts are those of an arm with one link more. How long are the lists that you pass?",
    ),
    Mistake(
        "without those of a float",
        lambda n: _of_both((direct, by_sweeps), n, _NotFromTheRight),
        "Your count leaves out where a float stands on the left, as in 0.0 + x. Which method does "
        "Python call then, and does yours count there?",
    ),
    Mistake(
        "without the outward sweep",
        lambda n: tuple(total - _outwards(n) for total in count(n)),
        "Your counts leave out what both algorithms do first. What does outwards cost?",
    ),
    Mistake(
        "direct sum without the outward sweep",
        lambda n: (count(n)[0] - _outwards(n), count(n)[1]),
        "Your count of the direct sum leaves out what it does first. What does outwards cost?",
    ),
    Mistake(
        "inward sweep alone",
        lambda n: (count(n)[0], count(n)[1] - _outwards(n)),
        "Of the two sweeps you count the inward one alone. What does outwards cost?",
    ),
    Mistake(
        "first sums of the direct sum",
        lambda n: (count(n)[0] - n, count(n)[1]),
        "Your count of the direct sum is short by one for each joint. total begins as 0.0: what does it "
        "cost to add to it?",
    ),
    Mistake(
        "n times one link",
        lambda n: tuple(n * number for number in count(1)),
        "You take n times the operations of one link. Look at the loops: in which algorithm does a link "
        "cost more when the arm is longer?",
    ),
    Mistake(
        "pairs counted twice",
        lambda n: (count(n)[0] + (count(n)[0] - n * count(1)[0]), count(n)[1]),
        "You count each pair of links twice. Where does the inner loop of the direct sum begin?",
    ),
    Mistake(
        "pairs without the link itself",
        lambda n: (
            count(n)[0] - (count(1)[0] - _outwards(1)) * n,
            count(n)[1],
        ),
        "In your direct sum no link counts for its own joint. Where does the inner loop begin?",
    ),
)
