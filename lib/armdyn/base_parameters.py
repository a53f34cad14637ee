"""Finds the base parameters: the combinations of π that joint torques show.

How many there are depends on which axes are parallel, meet or point along gravity, and a file says that
only to the digits that it writes: an angle of 1.5708 for π/2 makes axes that are not quite parallel, and
parameters that show by a millionth. So the number is read off the singular values of Y, where they drop.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from numbers import Real

import numpy as np

from armdyn.geometry import column_indices, fall_time, joint_units, powers_of_length, reach
from armdyn.manipulator import Manipulator
from armdyn.regressor import armature_columns, parameter_names, regressor

# Singular values as shares of the largest. Of the arms that people build, the smallest that is meant
# is some 1e-2, while angles rounded to three digits give 1e-5 to 1e-4. Between these bounds the widest
# gap is looked for; what lies above shows, what lies below does not.
GAP = (1e-5, 3e-3)
# What rounding leaves of 0.
NOTHING = 1e-13
# Kept and dropped singular values that are closer than this have no clear gap between them.
CLEAR = 10
# In a combination, in units of the arm's length: rounding, and what is not worth a word.
ROUNDING, UNSPOKEN = 1e-10, 1e-5
# An entry of a vector of length 1 that is below this is no good reason to drop the entry's column.
FIRM = 1e-2


@dataclass(frozen=True, eq=False)
class BaseParameters:
    """The combinations of π that the equation of motion contains: Y π = Y[:, independent] (K π).

    independent: the columns of Y that are kept. combination: K, (rank, len(π)): row i is the parameter
    of column independent[i] with its shares of the dropped ones. columns: those that were tried.
    names: of all entries of π.

    singular_values: (len(columns),), of Y at random states as shares of the largest, in units in which
    the arm's length and the gravitational acceleration are 1. cut: those above it are counted. length:
    the arm's, from its first joint to its last, m.

    condition: the ratio of the largest to the smallest singular value of the kept columns, in the same
    units: how many times better the torques of random motion show the most visible combination of base
    parameters than the least visible one. It belongs to the arm; that of one motion is
    `armdyn.identify.Excitation.condition`.
    """

    independent: tuple[int, ...]
    combination: np.ndarray
    columns: tuple[int, ...]
    names: tuple[str, ...]
    singular_values: np.ndarray
    cut: float
    condition: float
    length: float

    @property
    def rank(self) -> int:
        return len(self.independent)

    @property
    def descriptions(self) -> tuple[str, ...]:
        """Each base parameter in words, such as "J1 + 0.25 m2".

        Left out is what changes the parameter by less than 1e-5, with masses moved by the arm's length.
        """
        return tuple(
            _sum([f"+ {self.names[own]}", *_terms(row, spoken, self.names, own)])
            for own, row, spoken in zip(
                self.independent, self.combination, self._spoken, strict=True
            )
        )

    @property
    def dropped(self) -> dict[str, str]:
        """Of each parameter that is dropped, by name, what it acts like: "1.3 m1 cx1 + 1.69 J1".

        1 kg of m2, say, loads the joints as 1.3 kg·m of m1 cx1 and 1.69 kg·m² of J1 do, and no torque
        tells them apart. Where no torque shows it at all, "nothing".
        """
        kept = [self.names[j] for j in self.independent]
        rest = [j for j in self.columns if j not in self.independent]
        sums = {
            self.names[j]: _terms(self.combination[:, j], self._spoken[:, j], kept) for j in rest
        }
        return {name: _sum(terms) or "nothing" for name, terms in sums.items()}

    @property
    def gap(self) -> tuple[float, float]:
        """The smallest singular value that counts and the largest that does not, 0 if none is left."""
        ends = np.concatenate([[np.inf], self.singular_values, [0.0]])
        return float(ends[self.rank]), float(ends[self.rank + 1])

    @property
    def clear(self) -> bool:
        """Whether the number of base parameters is: the two of `gap` are 10 times apart or more."""
        kept, dropped = self.gap
        return kept >= CLEAR * dropped

    @property
    def remark(self) -> str:
        """What to know about the number of base parameters; empty where the geometry leaves no doubt."""
        kept, dropped = self.gap
        hidden = np.count_nonzero(self.singular_values[self.rank :] > NOTHING)
        if not self.clear:
            return (
                f"no clear gap: the last singular value that counts is {kept:.1e} of the largest, the "
                f"next {dropped:.1e}; the number of base parameters depends on the tolerance"
            )
        if hidden:
            return (
                f"{hidden} more would show, by {dropped:.0e} of the largest or less: rounded angles or "
                f"lengths do that, and what is below {self.cut:.0e} does not count"
            )
        return ""

    @property
    def _spoken(self) -> np.ndarray:
        """Which entries of K are worth a word, (rank, len(π)), bool."""
        unit = self.length ** powers_of_length(self.names)
        return np.abs(self.combination) * unit > UNSPOKEN * unit[list(self.independent), np.newaxis]

    def __str__(self):
        lines = [f"{self.rank} base parameters: " + "; ".join(self.descriptions), self.remark]
        return "\n".join(filter(None, lines))


def base_parameters(
    model: Manipulator, columns: Sequence[int] | None = None, tolerance: float | None = None
) -> BaseParameters:
    """The base parameters of a model's geometry, numerically, from random states.

    columns: indices of the entries of π that may be other than 0, all of them by default;
    `on_link_axes(model)` gives those of a planar arm whose centres of mass lie on the links' axes.
    tolerance: singular values up to this share of the largest, 0 ≤ tolerance < 1, count as 0. It is how
    well the geometry is known: axes that are off by an angle of ε make singular values of up to about ε.
    By default the widest gap between 1e-5 and 3e-3 is taken: angles of 1.5708 or 1.571 for π/2 then
    change nothing. With 0 each digit of the geometry is believed.

    A column is dropped if it is a combination of the others, masses first, then first moments, inertias
    last, so that masses move into the parameters of other links. The states come from a fixed seed: the
    same geometry gives the same base.

    Raises ValueError for columns that are not distinct indices of entries of π, and for a tolerance that
    is not as described.

    Source: M. Gautier (1991), Numerical Calculation of the Base Inertial Parameters of Robots; here the
    columns to drop are read from the null space.
    """
    names = parameter_names(model)
    columns = column_indices(columns, len(names))
    if tolerance is not None and not _below_one(tolerance):
        raise ValueError(f"tolerance = {tolerance!r}: needs a number from 0 to below 1, or None")
    W, unit = _random_rows(model)
    tried = W[:, columns]
    _, values, right = np.linalg.svd(tried, full_matrices=False)
    values = values / values[0] if values[0] > NOTHING * np.linalg.norm(W) else 0 * values
    cut = _widest_gap(values) if tolerance is None else max(float(tolerance), NOTHING)
    rank = np.count_nonzero(values > cut)
    # Where the gap is narrow, the null space is no better known.
    firm = max(FIRM, 3 * values[rank] / values[rank - 1]) if 0 < rank < len(values) else FIRM
    drop = _dropped(right[rank:].T, powers_of_length(names)[list(columns)], firm)
    independent = [j for k, j in enumerate(columns) if k not in drop]

    combination = np.zeros((len(independent), len(names)))
    condition = 1.0
    if independent:
        shares = np.linalg.lstsq(W[:, independent], tried, rcond=None)[0]
        shares[np.abs(shares) < ROUNDING] = 0
        combination[:, columns] = shares * unit[independent, np.newaxis] / unit[list(columns)]
        combination[:, independent] = np.eye(len(independent))
        condition = float(np.linalg.cond(W[:, independent]))
    return BaseParameters(
        tuple(independent), combination, columns, names, values, cut, condition, reach(model)
    )


def on_link_axes(model: Manipulator) -> tuple[int, ...]:
    """All columns of Y but those of m cy, which are not needed if the centres lie on the axes.

    Raises ValueError for a spatial chain.
    """
    names = parameter_names(model)
    if len(names) != 4 * model.n:
        raise ValueError(f"model: got {type(model).__name__}, needs a planar arm")
    return tuple(j for j, name in enumerate(names) if " cy" not in name)


def motors_apart(model: Manipulator, base: BaseParameters) -> tuple[np.ndarray, np.ndarray]:
    """Which joints' torques tell the inertia of their motor from that of the links.

    Returns the joints' indices, and shares, (rank + len(indices), n): column j is what the armature of
    joint j acts like, in base parameters and then in the armatures of those joints. So the armature of
    a first revolute joint acts like the inertia of its link, and torque shows only their sum. A share
    below 1e-5, in units of the arm's length, is 0.
    """
    W, unit = _random_rows(model)
    independent = list(base.independent)
    per_joint, motor = joint_units(model), (reach(model) / joint_units(model)) ** 2
    A = armature_columns(_random_states(model)[2]) * (fall_time(model) / reach(model)) ** 2
    A = (A * per_joint[:, np.newaxis] * motor).reshape(-1, model.n)
    columns = W[:, independent]
    apart: list[int] = []
    for j in reversed(range(model.n)):
        own = A[:, j]
        fitted = columns @ np.linalg.lstsq(columns, own, rcond=None)[0]
        if np.linalg.norm(own - fitted) > base.cut * np.linalg.norm(own):
            columns, apart = np.column_stack([columns, own]), [*apart, j]
    joints = np.array(sorted(apart), dtype=int)
    columns = np.column_stack([W[:, independent], A[:, joints]])
    shares = np.linalg.lstsq(columns, A, rcond=None)[0]
    shares[np.abs(shares) < UNSPOKEN] = 0
    per_row = np.concatenate([unit[independent], motor[joints]])
    return joints, shares * per_row[:, np.newaxis] / motor


def _random_rows(model) -> tuple[np.ndarray, np.ndarray]:
    """Y at random states, stacked, in the arm's units, and the unit of each entry of π.

    In these units the arm's length is 1 and so is the gravitational acceleration, if there is any, so
    that an arm a tenth as long has the same rows.
    """
    length, time, per_joint = reach(model), fall_time(model), joint_units(model)
    Y = regressor(model, *_random_states(model))
    unit = length ** powers_of_length(parameter_names(model))
    # Forces of prismatic joints are counted as torques at the arm's length.
    W = Y * per_joint[:, np.newaxis] * (time / length) ** 2 * unit
    return W.reshape(-1, Y.shape[-1]), unit


def _random_states(model) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    time, rng = fall_time(model), np.random.default_rng(0)
    # Several times as many equations as there are columns, 4n or 10n.
    q, qd, qdd = rng.uniform(-np.pi, np.pi, (3, 40, model.n)) * joint_units(model)
    return q, qd / time, qdd / time**2


def _widest_gap(values) -> float:
    """Where to cut, between two singular values or at a bound, in the widest gap within the bounds."""
    low, high = GAP
    inside = values[(values > low) & (values < high)]
    edges = np.concatenate([[high], inside, [low]])
    widest = np.argmin(edges[1:] / edges[:-1])
    return float(np.sqrt(edges[widest] * edges[widest + 1]))


def _dropped(null, power, least) -> set[int]:
    """As many columns as the null space has dimensions, so that the others are independent.

    null: (columns, dimensions), orthonormal. A column can go if some vector of the null space has an
    entry there, of `least` or more, and none at those that have gone.
    """
    gone: list[int] = []
    while len(gone) < null.shape[1]:
        basis = np.linalg.qr(null[gone].T)[0]
        rest = np.linalg.norm(null - null @ basis @ basis.T, axis=1)
        # Masses before first moments before inertias, and of those that will do, later links first.
        firm = rest > least if np.any(rest > least) else rest == np.max(rest)
        first = np.flatnonzero(firm & (power == np.min(power[firm])))
        gone.append(int(first[rest[first] > np.max(rest[first]) / 2][-1]))
    return set(gone)


def _below_one(value) -> bool:
    return isinstance(value, Real) and not isinstance(value, bool) and 0 <= float(value) < 1


def _terms(shares, spoken, names, own=None) -> list[str]:
    """Words such as "+ 1.3 m2", for each share that is worth a word."""
    words = []
    for j in np.flatnonzero(spoken):
        if j != own:
            size = abs(shares[j])
            times = "" if np.isclose(size, 1, rtol=1e-9) else f"{size:.4g} "
            words.append(f"{'+' if shares[j] > 0 else '−'} {times}{names[j]}")
    return words


def _sum(terms) -> str:
    text = " ".join(terms).removeprefix("+ ")
    return "−" + text[2:] if text.startswith("− ") else text
