"""How the planar 2R arm of a family is described: what its angles mean, and which way gravity pulls.

Each student may have an arm of the family. What differs is where the zero of each angle is, from where
the second angle is measured, and which way gravity pulls; links, letters and points stay. With φ the
angles of the links from the x axis, q enters by φ = T q + φ₀ alone. q: (2,), rad.
"""

import hashlib
import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeVar

import numpy as np

from autograder.protocol import OwnArm

Angles = Literal["relative", "square", "absolute", "crossed"]
SLOPE = np.pi / 6


@dataclass(frozen=True)
class Described:
    """One member of the family, by whose name `mechanisms.built_in` has its energies.

    slope: by how many times SLOPE gravity's pull is turned from the −y axis. A member has False or
    True; other numbers are what students take it for.
    """

    angles: Angles = "relative"
    zero: Literal["level", "hanging"] = "level"
    slope: float = False

    @property
    def name(self) -> str:
        slope = [] if not self.slope else ["slope" if self.slope == 1 else f"slope {self.slope:g}"]
        return "-".join(["planar-2r", self.angles, self.zero, *slope])

    @property
    def turns(self) -> np.ndarray:
        """T, (2, 2)."""
        return np.array([[1.0, 0.0], [float(self.angles in ("relative", "square")), 1.0]])

    @property
    def zeros(self) -> np.ndarray:
        """φ₀, (2,), rad."""
        first = 0.0 if self.zero == "level" else -np.pi / 2
        second = {
            "relative": first,
            "square": first + np.pi / 2,
            "absolute": first,
            "crossed": -np.pi / 2 - first,
        }
        return np.array([first, second[self.angles]])

    @property
    def pull(self) -> float:
        """The angle from the x axis at which gravity pulls, rad."""
        return -np.pi / 2 + SLOPE * self.slope

    @property
    def facts(self) -> tuple[str, str, str]:
        """From where q1 and q2 are measured, and which way gravity pulls: each after "whose"."""
        axes = {"level": "the x axis", "hanging": "the −y axis"}
        other = {"level": "hanging", "hanging": "level"}[self.zero]
        second = {
            "relative": "the line of link 1",
            "square": "the direction at a right angle to link 1, to its left",
            "absolute": axes[self.zero],
            "crossed": axes[other],
        }
        towards = "towards" if self.slope > 0 else "away from"
        degrees = f"{abs(np.degrees(SLOPE * self.slope)):.0f}°"
        pulls = (
            f"at {degrees} to the −y axis, {towards} the x axis"
            if self.slope
            else "along the −y axis"
        )
        return (
            f"q1 is measured from {axes[self.zero]}",
            f"q2 is measured from {second[self.angles]}",
            f"gravity pulls {pulls}",
        )

    @property
    def zero_at(self) -> tuple[str, str]:
        """Where q1 and q2 are 0, in words."""
        places = {0: "along the x axis", -1: "along the −y axis"}
        first, second = np.round(self.zeros / (np.pi / 2)).astype(int)
        if self.angles == "relative":
            of_second = "link 2 is in line with link 1"
        elif self.angles == "square":
            of_second = "link 2 is at a right angle to link 1, to its left"
        else:
            of_second = f"link 2 is {places[int(second)]}, wherever link 1 points"
        return f"link 1 is {places[int(first)]}", of_second

    def own_arm(self, code: str = "") -> OwnArm:
        return OwnArm(self.turns, self.zeros, self.pull, code)

    def angles_at(self, directions) -> np.ndarray:
        """q, (…, 2), rad, at which the links have these angles from the x axis."""
        return self.own_arm().angles(directions)

    def directions(self, q) -> np.ndarray:
        """φ, (…, 2), rad."""
        return np.asarray(q, dtype=float) @ self.turns.T + self.zeros

    def _directions(self, q) -> np.ndarray:
        return self.directions(np.reshape(q, 2))


Member = TypeVar("Member", bound=Described)


def family(member: type[Member]) -> tuple[Member, ...]:
    """All arms of the family."""
    return tuple(
        member(angles, zero, slope)
        for angles in ("relative", "square", "absolute", "crossed")
        for zero in ("level", "hanging")
        for slope in (False, True)
    )


def drawn_of(members: Sequence[Member], name: str, year: int = 0) -> Member:
    """The member of the student with this name: the same on every machine, and each year another.

    Capital letters, how many spaces stand where, and how Unicode writes a letter make no difference.
    """
    digest = hashlib.sha256(f"{year}\0{folded(name)}".encode()).digest()
    return members[int.from_bytes(digest[:8], "big") % len(members)]


def folded(name: str) -> str:
    """The name as it counts."""
    letters = unicodedata.normalize("NFKC", unicodedata.normalize("NFKC", name).casefold())
    return " ".join(letters.split())
