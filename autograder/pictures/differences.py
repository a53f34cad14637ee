"""Says how two motions of one mechanism differ: only what their numbers show."""

import numpy as np

from autograder.judging.criterion import TOLERANCE
from autograder.pictures.motion import Comparison

LEAST_WAY = 0.005  # m; less is not seen in the picture
# A direction is left out that is less than this share of a shift; a change of energy, of its scale.
LITTLE = 0.05


def sentences(of: Comparison) -> list[str]:
    """For a student, most useful first."""
    if not of.theirs.stopped:
        return differences(of)
    if of.common == 1:
        return [f"With your {of.name} there is no motion: {of.theirs.stopped}."]
    at = _number(of.theirs.t[-1])
    return [*differences(of), f"With your {of.name} it stops after {at} s: {of.theirs.stopped}."]


def differences(of: Comparison) -> list[str]:
    """The sentences that quote nothing."""
    if of.common == 1:
        return []
    return _same(of) if of.alike else _apart(of, f"{_number(of.theirs.t[-1])} s")


def title(of: Comparison) -> str:
    """What is played, for how long and from where."""
    n = of.mechanism.n
    x0 = of.right.x[0]
    at = ", ".join(
        f"{c.name} = {value:.2f} {c.unit}".replace("-", "−")
        for c, value in zip(of.mechanism.coordinates, x0, strict=False)
    )
    start = "in motion" if np.any(x0[n:]) else "from rest"
    return f"{of.right.t[-1]:g} s, {start} at {at}"


def _apart(of: Comparison, at: str) -> list[str]:
    return [
        *_as_if(of),
        *_shift(of, at),
        *_coordinates(of, at),
        *(_ways(of) or _starts(of)),
        *_energy(of),
    ]


def _same(of: Comparison) -> list[str]:
    if of.name == "C" and of.times is not None and abs(of.times - 1) <= TOLERANCE:
        return [
            "Both move alike: the motion sees C only in C q̇, and that is right with yours. What is "
            "wrong with your C does not move the arm."
        ]
    return [
        f"Both move alike from this state: what is wrong with your {of.name} does not show here."
    ]


def _as_if(of: Comparison) -> list[str]:
    """What a term means that is a multiple of the right one all along the motion."""
    if of.times is None:
        return []
    times = round(of.times, 6) + 0.0  # and no -0.0
    weighs = all(term.name.startswith("the weight") for term in of.mechanism.potential)
    if of.name == "g_vec" and weighs:
        if times == 0:
            return ["It moves as if there were no gravity."]
        if times == -1:
            return ["It moves as if gravity pulled the other way."]
        way = "" if times > 0 else " and pulled the other way"
        return [f"It moves as if gravity were {abs(times):.4g} times as strong{way}."]
    term = "C q̇" if of.name == "C" else of.name
    if times == 0:
        return [f"Along the right motion your {term} is zero, and the right one is not."]
    size = "as large as" if abs(times) == 1 else f"{abs(times):.4g} times"
    sign = "" if times > 0 else ", with the opposite sign"
    return [f"Along the right motion your {term} is {size} the right one{sign}."]


def _shift(of: Comparison, at: str) -> list[str]:
    """Where the tip is, at the end of what both have."""
    shift = of.tips(of.theirs)[-1] - of.tips(of.right)[of.common - 1]
    if not np.hypot(*shift) >= LEAST_WAY:
        return []
    words = ("below", "above"), ("left of", "right of")
    parts = [
        f"{_length(part)} {way[int(part > 0)]}"
        for part, way in zip(shift[::-1], words, strict=True)
        if abs(part) >= LITTLE * np.hypot(*shift)
    ]
    return [f"After {at} with your {of.name}, the tip is {' and '.join(parts)} where it should be."]


def _coordinates(of: Comparison, at: str) -> list[str]:
    apart = of.theirs.x[-1] - of.right.x[of.common - 1]
    parts = [
        f"{c.name} is {_number(abs(d))} {c.unit} too {'large' if d > 0 else 'small'}"
        for c, d in zip(of.mechanism.coordinates, apart, strict=False)
        if abs(d) >= 0.005
    ]
    return [f"Then {_listed(parts)}."] if parts else []


def _starts(of: Comparison) -> list[str]:
    """Which coordinates start the other way: their accelerations have opposite signs."""
    if of.common < 3:
        return []
    n, last = of.mechanism.n, 2
    first, theirs = (m.x[last, n:] - m.x[0, n:] for m in (of.right, of.theirs))
    large = 0.1 * max(np.max(np.abs(first)), np.max(np.abs(theirs)))
    names = [
        c.name
        for c, one, other in zip(of.mechanism.coordinates, first, theirs, strict=True)
        if one * other < 0 and min(abs(one), abs(other)) >= large
    ]
    if not names:
        return []
    velocity = "velocity" if len(names) == 1 else "velocities"
    starts = "starts" if len(names) == 1 else "start"
    return [f"The {velocity} of {_listed(names)} {starts} to change the other way."]


def _ways(of: Comparison) -> list[str]:
    """Up or down, where one tip goes the other way."""
    right, theirs = of.tips(of.right)[: of.common, 1], of.tips(of.theirs)[:, 1]
    rise, other = right[-1] - right[0], theirs[-1] - theirs[0]
    if rise * other >= 0 or min(abs(rise), abs(other)) < LEAST_WAY:
        return []
    way = {True: "up", False: "down"}
    return [
        f"In this time the tip should go {_length(rise)} {way[bool(rise > 0)]}; yours goes "
        f"{_length(other)} {way[bool(other > 0)]}."
    ]


def _energy(of: Comparison) -> list[str]:
    """What the right K + P does along each motion, where nothing takes energy out or puts it in."""
    if not of.is_free:
        return []
    E = of.equations.energy(of.theirs.x)
    right = of.equations.energy(of.right.x)
    change, kept = E[-1] - E[0], np.ptp(right)
    n = of.mechanism.n
    swing = np.ptp([_potential(of, x[:n]) for x in of.right.x])
    if abs(change) < max(LITTLE * swing, 10 * kept):
        return []
    more = "more" if change > 0 else "less"
    return [
        "The right motion keeps its energy K + P. Yours ends with "
        f"{_number(abs(change))} J {more} than it began with."
    ]


def _potential(of: Comparison, q: np.ndarray) -> float:
    return float(of.equations.energy(np.concatenate([q, np.zeros_like(q)])[None])[0])


def _length(metres: float) -> str:
    size = abs(metres)
    return f"{_number(size)} m" if size >= 1 else f"{_number(100 * size)} cm"


def _number(size: float) -> str:
    """Two digits that count: 0.31, 31, 310."""
    return f"{float(f'{size:.2g}'):g}"


def _listed(parts: list[str]) -> str:
    *others, last = parts
    return f"{', '.join(others)} and {last}" if others else last
