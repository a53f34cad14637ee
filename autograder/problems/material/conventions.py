"""The conventions of the planar 2R arm that make a family: one arm, told apart by how it is described.

Each student may have an arm of the family. What differs is where the zero of each angle is, from where
the second angle is measured, and which way gravity pulls; links, letters and points stay. With φ the
angles of the links from the x axis, q enters by φ = T q + φ₀ alone: M = TᵀM_φT, C = TᵀC_φT and
g = Tᵀ∂P/∂φ, as a constant T keeps the Christoffel form. q, qd: (2,), rad and rad/s. arm: as in
`planar_2r`.
"""

import hashlib
import itertools
import unicodedata
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from autograder.problems.material import planar_2r
from autograder.protocol import OwnArm

if TYPE_CHECKING:
    from autograder.mechanisms import Mechanism

Angles = Literal["relative", "square", "absolute", "crossed"]
SLOPE = np.pi / 6


@dataclass(frozen=True)
class Convention:
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

    @property
    def mechanism(self) -> "Mechanism":
        """The same arm by its energies. KeyError for what is no member of the family."""
        from autograder.mechanisms.built_in import named  # loads SymPy

        return named(self.name)

    def own_arm(self, code: str = "") -> OwnArm:
        return OwnArm(self.turns, self.zeros, self.pull, code)

    def M(self, q, arm) -> np.ndarray:
        """Inertia matrix, (2, 2), kg·m²."""
        phi = self._directions(q)
        coupling = arm.m2 * arm.l1 * arm.lc2 * np.cos(phi[1] - phi[0])
        first = arm.I1 + arm.m1 * arm.lc1**2 + arm.m2 * arm.l1**2
        second = arm.I2 + arm.m2 * arm.lc2**2
        return self.turns.T @ np.array([[first, coupling], [coupling, second]]) @ self.turns

    def C(self, q, qd, arm) -> np.ndarray:
        """Coriolis and centrifugal matrix in Christoffel form, (2, 2), kg·m²/s."""
        phi, rate = self._directions(q), self.turns @ np.asarray(qd, dtype=float)
        k = arm.m2 * arm.l1 * arm.lc2 * np.sin(phi[1] - phi[0])
        return self.turns.T @ np.array([[0.0, -k * rate[1]], [k * rate[0], 0.0]]) @ self.turns

    def M_dot(self, q, qd, arm) -> np.ndarray:
        """dM/dt along q̇, (2, 2), kg·m²/s: of the Christoffel form it is C + Cᵀ."""
        C = self.C(q, qd, arm)
        return C + C.T

    def potential_energy(self, q, arm) -> float:
        """P, J; zero where both links are level."""
        first, second = np.sin(self._directions(q) - SLOPE * self.slope)
        return arm.g * ((arm.m1 * arm.lc1 + arm.m2 * arm.l1) * first + arm.m2 * arm.lc2 * second)

    def g_vec(self, q, arm) -> np.ndarray:
        """Gravity vector ∂P/∂q, (2,), N·m."""
        first, second = np.cos(self._directions(q) - SLOPE * self.slope)
        carried = (arm.m1 * arm.lc1 + arm.m2 * arm.l1) * first
        return self.turns.T @ np.array([carried, arm.m2 * arm.lc2 * second]) * arm.g

    def energy(self, q, qd, arm) -> float:
        """K + P, J."""
        return 0.5 * qd @ self.M(q, arm) @ qd + self.potential_energy(q, arm)

    def equilibria(self) -> np.ndarray:
        """The q with g(q) = 0, (4, 2), rad: each link along gravity or against it."""
        ways = [self.pull + np.pi, self.pull]
        return self.angles_at(np.array(list(itertools.product(ways, ways))))

    def joints(self, q, arm) -> list[tuple[float, float]]:
        """Shoulder, elbow and hand, (x, y) in m, to be drawn."""
        return planar_2r.joints(BOOK.angles_at(self._directions(q)), arm)

    def angles_at(self, directions) -> np.ndarray:
        """q, (…, 2), rad, at which the links have these angles from the x axis."""
        return self.own_arm().angles(directions)

    def directions(self, q) -> np.ndarray:
        """φ, (…, 2), rad."""
        return np.asarray(q, dtype=float) @ self.turns.T + self.zeros

    def _directions(self, q) -> np.ndarray:
        return self.directions(np.reshape(q, 2))


BOOK = Convention()
FAMILY = tuple(
    Convention(angles, zero, slope)
    for angles in ("relative", "square", "absolute", "crossed")
    for zero in ("level", "hanging")
    for slope in (False, True)
)


def drawn(name: str, year: int = 0) -> Convention:
    """The member of the student with this name: the same on every machine, and each year another.

    Capital letters, how many spaces stand where, and how Unicode writes a letter make no difference.
    """
    digest = hashlib.sha256(f"{year}\0{folded(name)}".encode()).digest()
    return FAMILY[int.from_bytes(digest[:8], "big") % len(FAMILY)]


def folded(name: str) -> str:
    """The name as it counts."""
    letters = unicodedata.normalize("NFKC", unicodedata.normalize("NFKC", name).casefold())
    return " ".join(letters.split())


def nearest_first(own: Convention) -> list[Convention]:
    """The other members: those that share most with this one first."""
    others = [member for member in FAMILY if member != own]
    return sorted(others, key=lambda member: sum(map(str.__ne__, member.facts, own.facts)))
