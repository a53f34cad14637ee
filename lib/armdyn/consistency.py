"""Finds out whether inertial parameters can belong to bodies: positive masses at real points.

A link's π is physically consistent when some distribution of positive mass has it: m > 0, and the
second moments about the centre of mass are positive semidefinite. Both say that the link's
pseudo-inertia matrix [[Σ, h], [hᵀ, m]] is positive semidefinite, with h = m c and Σ = ½ tr(J) 1 − J the
matrix of second moments ∫ x xᵀ dm. Of a planar link only tr Σ = J is known, and [[J, hᵀ], [h, m 1]] ⪰ 0
says the same: J ≥ |h|²/m.

Source: P. M. Wensing, S. Kim, J.-J. E. Slotine (2018), Linear Matrix Inequalities for Physically
Consistent Inertial Parameter Identification: A Statistical Perspective on the Mass Distribution.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import null_space

from armdyn.geometry import column_indices
from armdyn.parameters import all_finite, positive, real_array, state_vector

# In units of the arm's own size: what counts as 0, and the most that Σ of all traces may reach.
TOLERANCE = 1e-9
MODEST_TRACE, LARGEST_TRACE = 1e2, 1e6


def pseudo_inertia(pi: ArrayLike) -> np.ndarray:
    """The matrix that is positive semidefinite for consistent π of one link.

    pi: (..., 4) for a planar link, giving (..., 3, 3), or (..., 10) for a spatial one, giving
    (..., 4, 4); order as in `armdyn.regressor`. Raises ValueError for another size.
    """
    pi = all_finite("pi", real_array("pi", pi))
    size = pi.shape[-1] if pi.ndim else 0
    if size not in _ENTRIES:
        raise ValueError(f"pi: got shape {pi.shape}, needs (..., 4) or (..., 10)")
    return np.einsum("...p,pij->...ij", pi, _ENTRIES[size])


def _planar_entries() -> np.ndarray:
    entries = np.zeros((4, 3, 3))
    entries[0, [1, 2], [1, 2]] = 1
    entries[1, [0, 1], [1, 0]] = 1
    entries[2, [0, 2], [2, 0]] = 1
    entries[3, 0, 0] = 1
    return entries


def _spatial_entries() -> np.ndarray:
    entries = np.zeros((10, 4, 4))
    entries[0, 3, 3] = 1
    for axis in range(3):
        entries[1 + axis, [axis, 3], [3, axis]] = 1
    for p, i, j in ((4, 0, 0), (5, 0, 1), (6, 1, 1), (7, 0, 2), (8, 1, 2), (9, 2, 2)):
        entries[p, [i, j], [j, i]] = -1
        if i == j:
            entries[p, :3, :3] += np.eye(3) / 2
    return entries


_ENTRIES = {4: _planar_entries(), 10: _spatial_entries()}


@dataclass(frozen=True, eq=False)
class Consistency:
    """Whether bodies with these parameters exist.

    margin: the smallest eigenvalue that all pseudo-inertia matrices can be given at once, in units
    of the arm's size (about 1e-3 for slim links, negative where no bodies exist); a lower bound
    where they exist, an upper bound where they do not. parameters: such a π, (4n,) or (10n,), or
    None. It is one of many; no parameter that the motion does not show can be read from it. motors: with
    it, the armature of each motor that was asked for, (k,), or None.
    """

    margin: float
    parameters: np.ndarray | None
    motors: np.ndarray | None = None

    @property
    def exists(self) -> bool:
        return self.parameters is not None


def consistent_parameters(
    combination: np.ndarray,
    estimate: ArrayLike,
    columns: Sequence[int] | None,
    n: int,
    length: float = 1.0,
    motors: np.ndarray | None = None,
) -> Consistency:
    """Look for consistent π with combination @ π = estimate, and 0 outside `columns`.

    combination: (b, p). estimate: (b,). n: number of links, so that p/n is 4 or 10. length: a length
    of the arm's size, m, for scaling alone. motors: (b, k), what the armature of each of k motors adds
    to the estimate: then combination @ π + motors @ a = estimate is looked for, with a ≥ 0.

    The search decides: it ends either with a π whose matrices are positive definite or with a bound
    that shows there is none. Two limits remain: an eigenvalue above −1e-9 counts as 0, so that a point
    mass passes, and masses are looked for up to 1e6 times the arm's size.

    Raises ValueError for arguments that are not as described.

    It is the first phase of an interior-point method: least s with all matrices + s·1 ⪰ 0.
    Source: S. Boyd, L. Vandenberghe (2004), Convex Optimization, section 11.4.
    """
    combination = all_finite("combination", real_array("combination", combination))
    sizes = [n * per_link for per_link in _ENTRIES]
    if combination.ndim != 2 or combination.shape[1] not in sizes:
        raise ValueError(
            f"combination: got shape {combination.shape}, needs (b, {sizes[0]}) or (b, {sizes[1]}) for "
            f"n = {n} links"
        )
    estimate = state_vector("estimate", estimate, len(combination))
    columns = list(column_indices(columns, combination.shape[1]))
    length = positive("length", length, "m")
    per_link = combination.shape[1] // n
    powers = np.array([0, 1, 1, 2] if per_link == 4 else [0, 1, 1, 1] + [2] * 6)
    unit = np.tile(length**powers, n)[columns]
    K = combination[:, columns] * unit
    rows = np.linalg.norm(K, axis=1)
    K, target = K / rows[:, np.newaxis], estimate / rows
    motors = np.zeros((len(K), 0)) if motors is None else _motors(motors, len(K))
    per_motor = np.linalg.norm(motors / rows[:, np.newaxis], axis=0)
    per_motor[per_motor == 0] = 1
    K = np.column_stack([K, motors / rows[:, np.newaxis] / per_motor])
    size = np.max(np.abs(target), initial=0.0)
    size = size if size > 0 else 1.0

    def matrices(coordinates):
        pi = np.zeros((*coordinates.shape[:-1], n * per_link))
        pi[..., columns] = coordinates[..., : len(columns)]
        bodies = pseudo_inertia(pi.reshape(*coordinates.shape[:-1], n, per_link))
        rotors = coordinates[..., len(columns) :, np.newaxis, np.newaxis] * np.eye(bodies.shape[-1])
        return np.concatenate([bodies, rotors], axis=-3)

    start, free = np.linalg.pinv(K) @ (target / size), _free(K)
    # Bodies of the arm's own size first: without a bound the search prefers heavy ones.
    for largest in (MODEST_TRACE, LARGEST_TRACE):
        margin, step = _largest_margin(matrices(start), matrices(free.T), largest)
        if step is not None:
            break
    else:
        return Consistency(margin, None)
    found = np.zeros(n * per_link)
    coordinates = (start + free @ step) * size
    found[columns] = coordinates[: len(columns)] * unit
    return Consistency(margin, found, coordinates[len(columns) :] / per_motor)


def _motors(motors, rows) -> np.ndarray:
    motors = all_finite("motors", real_array("motors", motors))
    if motors.ndim != 2 or len(motors) != rows:
        raise ValueError(
            f"motors: got shape {motors.shape}, needs ({rows}, k), one column per motor"
        )
    return motors


def _free(K) -> np.ndarray:
    """All that K does not see, as columns."""
    return null_space(K, rcond=1e-10) if len(K) else np.eye(K.shape[1])


def _largest_margin(base, directions, largest_trace) -> tuple[float, np.ndarray | None]:
    """(margin, z): the eigenvalues of all matrices base + Σ zₖ directions[k] are at least `margin`.

    Stops at the first positive margin. Without a z, the margin is a negative bound that none exceeds.
    """
    k = base.shape[-1]
    trace, trace_slopes = np.einsum("lii->", base), np.einsum("zlii->z", directions)
    # The last unknown is the shift s, which relaxes the bound on the trace as well.
    slopes = np.concatenate([directions, np.broadcast_to(np.eye(k), (1, *base.shape))])
    room_slopes = np.append(-trace_slopes, 1.0)
    x = np.zeros(len(slopes))
    x[-1] = 1 + max(-np.linalg.eigvalsh(base).min(), trace - largest_trace, 0.0)
    weight, barriers = 1.0, base.shape[0] * k + 1
    while True:
        last = np.inf
        for _ in range(1000):
            blocks = base + np.einsum("z,zlij->lij", x, slopes)
            room = largest_trace - trace + room_slopes @ x
            relative = np.linalg.solve(blocks, slopes)
            gradient = -np.einsum("zlii->z", relative) - room_slopes / room
            gradient[-1] += weight
            hessian = np.einsum("zlij,wlji->zw", relative, relative)
            hessian += np.outer(room_slopes, room_slopes) / room**2
            step = -np.linalg.lstsq(hessian, gradient, rcond=None)[0]
            decrement = np.sqrt(max(-gradient @ step, 0.0))
            # So near, a step squares the decrement: where it no longer falls, it is rounding.
            if decrement < 1e-3 or last / 2 < decrement < 0.1:
                break
            last = decrement
            # The barrier is self-concordant: so damped, the step stays inside.
            x = x + step / (1 + decrement)
        else:
            raise RuntimeError("the search for consistent parameters did not converge")
        margin = np.linalg.eigvalsh(base + np.einsum("z,zlij->lij", x[:-1], directions)).min()
        # Off the central path by the decrement, the gap is at most this much wider.
        gap = (barriers + decrement * np.sqrt(barriers)) / weight
        if margin > 0 or gap < TOLERANCE:
            return float(margin), x[:-1]
        if gap - x[-1] < -TOLERANCE:
            return float(gap - x[-1]), None
        weight *= 4
