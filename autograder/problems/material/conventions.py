"""The conventions of the planar 2R arm that make a family, each with its equations of motion.

q enters by φ = T q + φ₀ alone: M = TᵀM_φT, C = TᵀC_φT and g = Tᵀ∂P/∂φ, as a constant T keeps the
Christoffel form. q, qd: (2,), rad and rad/s. arm: as in `planar_2r`.
"""

import itertools
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from autograder.problems.material import planar_2r
from autograder.problems.material.described import SLOPE, Described, drawn_of, family, folded

if TYPE_CHECKING:
    from autograder.mechanisms import Mechanism

__all__ = ["BOOK", "FAMILY", "SLOPE", "Convention", "drawn", "folded", "nearest_first"]


@dataclass(frozen=True)
class Convention(Described):
    """One member of the family, by whose name `mechanisms.built_in` has its energies."""

    @property
    def mechanism(self) -> "Mechanism":
        """The same arm by its energies. KeyError for what is no member of the family."""
        from autograder.mechanisms.built_in import named  # loads SymPy

        return named(self.name)

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

    def joints(self, q, arm) -> list[tuple[float, float]]:
        """Shoulder, elbow and hand, (x, y) in m, to be drawn."""
        return planar_2r.joints(BOOK.angles_at(self._directions(q)), arm)

    def energy(self, q, qd, arm) -> float:
        """K + P, J."""
        return 0.5 * qd @ self.M(q, arm) @ qd + self.potential_energy(q, arm)

    def equilibria(self) -> np.ndarray:
        """The q with g(q) = 0, (4, 2), rad: each link along gravity or against it."""
        ways = [self.pull + np.pi, self.pull]
        return self.angles_at(np.array(list(itertools.product(ways, ways))))


BOOK = Convention()
FAMILY = family(Convention)


def drawn(name: str, year: int = 0) -> Convention:
    """The member of the student with this name, as `drawn_of` tells."""
    return drawn_of(FAMILY, name, year)


def nearest_first(own: Convention) -> list[Convention]:
    """The other members: those that share most with this one first."""
    others = [member for member in FAMILY if member != own]
    return sorted(others, key=lambda member: sum(map(str.__ne__, member.facts, own.facts)))
