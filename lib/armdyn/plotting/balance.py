"""Computes what an animation tells of motions: the terms of the equation at each joint, and energies."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from armdyn.plotting.style import OKABE_ITO
from armdyn.plotting.torques import TERMS

# The terms as a page writes them, and the dashes of their arcs, where the bars have hatches.
NAMES = ("M q̈", "C q̇", "g", "f", "u")
DASHES = ("none", "6 2", "1.5 1.5", "4 1.5 1 1.5", "10 1.5")
STORES = (
    ("kinetic K", OKABE_ITO["blue"]),
    ("potential P", OKABE_ITO["vermilion"]),
    ("total E = K + P", "currentColor"),
    ("taken by friction", OKABE_ITO["purple"]),
    ("given by motors", OKABE_ITO["yellow"]),
)
# What a quarter turn of an arc may stand for, times a power of ten.
EASY = (1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10)
# The longest arc, in quarter turns. A few peaks shall not make all others too short to see: where
# the largest torque is beyond what this share of the frames need, its arc is cut.
LONGEST = 2.5
SEEN = 0.9


@dataclass(frozen=True)
class Balance:
    """What the model's equation says along B motions, given at the times t, (T,), s.

    q, qd, u: (B, T, n), rad, rad/s and N·m. Raises as the model's `dynamics` does.
    """

    model: Any
    t: np.ndarray
    q: np.ndarray
    qd: np.ndarray
    u: np.ndarray

    @property
    def columns(self) -> int:
        """How many numbers a frame of one motion has that may change with time."""
        extra = np.any(self.model.f_vec(self.qd)) + np.any(np.diff(self.u, axis=1))
        return (3 + extra) * self.model.n + 3 + np.any(self.model.f_vec(self.qd)) + np.any(self.u)

    def terms(self, times: np.ndarray) -> np.ndarray:
        """M q̈, C q̇, g, f and u at the times, (5, B, len(times), n), N·m: u as it was given."""
        q, qd = self.q, self.qd
        inertia = np.matvec(self.model.M(q), self.model.dynamics(q, qd, self.u))
        velocity = np.matvec(self.model.C(q, qd), qd)
        terms = [inertia, velocity, self.model.g_vec(q), self.model.f_vec(qd), self.u]
        # Each between its own values: what sums to u at the times t does so between them.
        return np.stack([along(times, self.t, term) for term in terms])

    def energies(self, times: np.ndarray) -> np.ndarray:
        """K, P, E, what friction took since t[0] and what the motors gave, (5, B, len(times)), J."""
        kinetic = self.model.kinetic_energy(self.q, self.qd)
        potential = self.model.potential_energy(self.q)
        works = (self._work(torque) for torque in (self.model.f_vec(self.qd), self.u))
        stores = np.stack([kinetic, potential, kinetic + potential, *works], axis=-1)
        return np.moveaxis(along(times, self.t, stores), -1, 0)

    def data(self, times: np.ndarray) -> dict:
        """What the page's script reads: whole numbers, each as the change from the one before."""
        terms, energies = self.terms(times), self.energies(times)
        is_used = [k < 3 or bool(np.any(energies[k])) for k in range(len(STORES))]
        energies = energies[is_used]
        unit, decimals = _unit(terms)
        joule, joule_decimals = _unit(energies)
        return {
            "terms": [
                {"name": name, "colour": colour, "dash": dash}
                for name, (_, colour, _), dash in zip(NAMES, TERMS, DASHES, strict=True)
            ],
            "quarter": _quarter(terms),
            "unit": unit,
            "decimals": decimals,
            "values": [
                [[changes(column, unit) for column in term.T] for term in motion]
                for motion in np.moveaxis(terms, 1, 0)
            ],
            "stores": [
                {"name": name, "colour": colour}
                for (name, colour), used in zip(STORES, is_used, strict=True)
                if used
            ],
            "joule": joule,
            "jouleDecimals": joule_decimals,
            "energies": [
                [changes(column, joule) for column in motion]
                for motion in np.moveaxis(energies, 1, 0)
            ],
        }

    def _work(self, torque: np.ndarray) -> np.ndarray:
        power = np.vecdot(self.qd, torque)
        steps = (power[:, 1:] + power[:, :-1]) / 2 * np.diff(self.t)
        return np.concatenate([0 * power[:, :1], np.cumsum(steps, axis=1)], axis=1)


def along(times: np.ndarray, t: np.ndarray, values: np.ndarray) -> np.ndarray:
    """The values, (B, T, n) at the times t, at other times: (B, len(times), n), linear between."""
    return np.stack(
        [
            np.stack([np.interp(times, t, column) for column in motion.T], axis=-1)
            for motion in values
        ]
    )


def changes(column: np.ndarray, unit: float) -> list[int]:
    """The column in whole units, each as the change from the one before; one number if it stays."""
    counts = np.rint(column / unit).astype(int)
    deltas = np.diff(counts, prepend=0).tolist()
    return deltas if any(deltas[1:]) else deltas[:1]


def _unit(values: np.ndarray) -> tuple[float, int]:
    """A power of ten of which the largest value has 200 to 2000, and its decimals."""
    largest = np.max(np.abs(values))
    power = math.ceil(math.log10(largest / 2000)) if largest > 0 else 0
    return 10.0**power, max(-power, 0)


def _quarter(terms: np.ndarray) -> float:
    """The torque of a quarter turn, N·m, for arcs that are seen and seldom cut."""
    peaks = np.max(np.abs(terms), axis=(0, 1, 3))
    needed = float(np.quantile(peaks, SEEN)) / LONGEST
    if needed == 0:
        return 1
    power = math.floor(math.log10(needed))
    easy = next(number for number in EASY if number * 10.0**power >= needed)
    return float(f"{easy * 10.0**power:.3g}")
