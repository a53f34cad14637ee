"""What is done wrong where gravity does not pull along the −y axis of a student's own arm.

P and g of the arm are linear in ℓc2, so that each link can have a pull of its own.
"""

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace

from autograder.problems.material.conventions import SLOPE, Convention

RADIANS = (
    "Your function takes the 30° of gravity's pull as 30 radians. In which unit do np.sin and np.cos "
    "need their angle?"
)
ONE_LINK = (
    "With your function gravity pulls on link {tilted} as your table says, and on link {level} beyond "
    "its joint along the −y axis. Does it pull on the two in different directions?"
)


def other_pulls(own: Convention) -> list[Convention]:
    """The arm with gravity taken to the other side, and at 60° for 30°."""
    return [replace(own, slope=slope) for slope in (-1, 2, -2)] if own.slope else []


def mistaken(own: Convention, answer: str) -> list[tuple[str, Callable, str]]:
    """Name, function of q and arm, and sentence of each mistake in P or g, as `answer` says."""
    if not own.slope:
        return []
    level = replace(own, slope=False)
    return [
        *(
            (
                f"slope of {degrees} rad",
                getattr(replace(own, slope=degrees / SLOPE), answer),
                RADIANS,
            )
            for degrees in (30, -30)
        ),
        *(
            (
                f"slope for link {tilted} alone",
                _of_links(getattr(first, answer), getattr(second, answer)),
                ONE_LINK.format(tilted=tilted, level=3 - tilted),
            )
            for tilted, first, second in ((1, own, level), (2, level, own))
        ),
    ]


def _of_links(first: Callable, second: Callable) -> Callable:
    """P or g with the part of link 2 beyond the elbow from another function than the rest."""

    def answer(q, arm):
        to_elbow = SimpleNamespace(**vars(arm) | {"lc2": 0.0})
        return first(q, to_elbow) + second(q, arm) - second(q, to_elbow)

    return answer
