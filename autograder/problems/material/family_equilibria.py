"""Where a student's own arm rests, and what is said of configurations where it does not.

q: two angles, rad, as the arm `own` measures them. φ: the angles of the links from the x axis.
"""

import itertools
from functools import partial
from math import pi

import numpy as np

from autograder.judging.claims import Claim
from autograder.judging.diagnosis import Mistake
from autograder.judging.quantities import each
from autograder.problems.material import sampling
from autograder.problems.material.conventions import BOOK, SLOPE, Convention
from autograder.problems.p4_gravity.checks import configurations, torques_and_distances
from autograder.problems.p4_gravity.mistakes import DEGREES, STRETCHED
from autograder.protocol import Call

WHERE = (
    "In which directions does the weight of a link turn no joint? Which way does gravity pull on your "
    "arm, and from where are q1 and q2 measured? The table below the set-up cell says it."
)
AGAINST = (
    "Your configurations are equilibria, but in all of them link 1 points against the pull of "
    "gravity. In which other direction does link 1 need no torque?"
)
ALONG = (
    "Your configurations are equilibria, but in all of them link 1 hangs along the pull of gravity. "
    "In which other direction does link 1 need no torque?"
)
STABLE = (
    "Your answer holds only the arm hanging along the pull of gravity. An equilibrium need not be "
    "stable: where else do both torques vanish?"
)
UPRIGHT = (
    "Your answer holds only the arm standing against the pull of gravity. Where else do both torques "
    "vanish?"
)


def of_equilibria(own: Convention) -> each:
    """The torques and distances of p4's check: in the angles of the book, with gravity turned to
    where it pulls there."""

    @each
    def parts(call, value):
        turned = own.directions(configurations(value)) - SLOPE * own.slope
        return torques_and_distances.parts(call, BOOK.angles_at(turned))

    return parts


def told_apart(own: Convention, configurations: np.ndarray) -> bool:
    """Whether no other configurations, (k, 2), give the numbers that the check sees of these.

    It sees how far a link is from the pull of gravity, and not to which side.
    """
    phi = own.directions(configurations)
    for sides in ((-1, 1), (1, -1), (-1, -1)):
        other = own.pull + np.array(sides) * (phi - own.pull)
        apart = np.abs(np.exp(1j * phi)[:, None] - np.exp(1j * other)).sum(axis=-1)
        if np.max(np.min(apart, axis=0)) > 1e-6 and _same_numbers(own, phi, other):
            return False
    return True


def _same_numbers(own: Convention, phi: np.ndarray, other: np.ndarray) -> bool:
    call = Call("equilibria", (sampling.planar_2r(np.random.default_rng(0)),))
    seen = [of_equilibria(own).parts(call, own.angles_at(at)) for at in (phi, other)]
    return all(np.allclose(*numbers) for numbers in zip(*seen, strict=True))


def mistaken(own: Convention) -> tuple[Mistake, ...]:
    """Mistakes in the equilibria of this arm: some of them alone, and degrees."""
    along, against = own.pull, own.pull + pi
    return (
        _held("stretched only", own, [(along, along), (against, against)], STRETCHED),
        _held("stable only", own, [(along, along)], STABLE),
        _held("upright only", own, [(against, against)], UPRIGHT),
        _held("link 1 up only", own, [(against, along), (against, against)], AGAINST),
        _held("link 1 down only", own, [(along, along), (along, against)], ALONG),
        *(
            Mistake(
                f"in degrees from {least}",
                partial(_in_degrees, own, least),
                DEGREES,
                claim=Claim.WHOLE,
            )
            for least in (-179, -90, 0)
        ),
    )


def askew(own: Convention) -> tuple[Mistake, ...]:
    """Configurations in which links are not along gravity's pull, but at 30°, 60° or 90° to it."""
    return tuple(
        _askew(own, first, second)
        for first, second in itertools.product((0, 30, 60, 90), repeat=2)
        if (first, second) != (0, 0)
    )


def _askew(own: Convention, first: int, second: int) -> Mistake:
    """Each link at so many degrees to the pull of gravity, or to its opposite."""
    ways = [own.pull + np.radians(off) + np.array([0.0, pi]) for off in (first, second)]
    said = f"link 1 lies {_at(first)} and link 2 {_at(second)}"
    if first == second:
        said = f"both links lie {_at(first)}"
    return _held(
        f"links at {first}° and {second}°",
        own,
        list(itertools.product(*ways)),
        f"At your configurations {said}. {WHERE}",
    )


def _at(degrees: int) -> str:
    return f"at {degrees}° to the pull of gravity" if degrees else "along the pull of gravity"


def _in_degrees(own: Convention, least: float, arm) -> np.ndarray:
    """The right angles, each from `least` to a whole turn more."""
    return least + np.remainder(np.round(np.degrees(own.equilibria()), 9) - least, 360.0)


def _held(name: str, own: Convention, directions: list, sentence: str) -> Mistake:
    return Mistake(
        name, lambda arm: own.angles_at(np.array(directions)), sentence, claim=Claim.WHOLE
    )
