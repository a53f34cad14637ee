"""The structural properties of M, C and g, shown in numbers.

Each function takes a model and states of shape (..., n), looks at all of them, and returns a
`Finding`: the largest violation, where it is, and the floor that rounding alone can reach. A
finding is a number with a witness, not a yes or no; `holds` compares the two.

All raise ValueError for states of the wrong shape, that are not finite, or of which there is none.

Source of the first three: R. M. Murray, Z. Li, S. S. Sastry (1994), A Mathematical Introduction to
Robotic Manipulation, lemma 4.2.
"""

from dataclasses import dataclass

import numpy as np

from armdyn.manipulator import ROUNDING
from armdyn.parameters import state_vectors

EPS = np.finfo(float).eps
# Fourth-order central differences: truncation h⁴ and rounding EPS/h balance at h = EPS^(1/5).
STEP = EPS**0.2
DIFFERENCE_FLOOR = 100 * EPS**0.8


@dataclass(frozen=True, eq=False)
class Finding:
    """The largest violation of a property over some states.

    violation: relative, without unit. floor: what rounding can leave of it. witness: the state at
    the worst case, and what shows the violation there, by name. A model that returns NaN has the
    violation NaN, and the property does not hold.
    """

    claim: str
    violation: float
    floor: float
    witness: dict[str, np.ndarray]

    @property
    def holds(self) -> bool:
        return self.violation <= self.floor

    def __str__(self):
        verdict = "holds" if self.holds else "does not hold"
        where = ", ".join(
            f"{name} = {np.array2string(np.asarray(value), precision=4)}"
            for name, value in self.witness.items()
        )
        return f"{self.claim}: {verdict}; {self.violation:.1e} against {self.floor:.1e}, at {where}"


def symmetry(model, q) -> Finding:
    """M = Mᵀ; the violation is max |M − Mᵀ| / max |M|. q: (..., n), rad."""
    (q,) = _states(model, q=q)
    M = model.M(q)
    difference = M - np.swapaxes(M, -1, -2)
    return _worst("M = Mᵀ", _largest(difference), _largest(M), 10 * EPS, q=q)


def positive_definiteness(model, q) -> Finding:
    """All eigenvalues of M are > 0; the witness holds the smallest one (kg·m²) and its eigenvector.

    The violation is 1 where the smallest eigenvalue is not above rounding, n·1.8e-15 times the largest,
    and 0 elsewhere. Of an M that is not symmetric the symmetric part is judged, since it alone
    enters q̇ᵀ M q̇. q: (..., n), rad.
    """
    (q,) = _states(model, q=q)
    M = model.M(q)
    finite = np.isfinite(M).all(axis=(-2, -1))
    if not finite.all():
        at = tuple(np.argwhere(~finite)[0])
        return Finding("M > 0", np.nan, model.n * ROUNDING, {"q": q[at], "M": M[at]})
    values, vectors = np.linalg.eigh((M + np.swapaxes(M, -1, -2)) / 2)
    smallest, size = values[..., 0], np.max(np.abs(values), axis=-1)
    relative = smallest / np.where(size > 0, size, 1)
    at = np.unravel_index(np.argmin(relative), relative.shape)
    floor = model.n * ROUNDING
    witness = {"q": q[at], "eigenvalue": smallest[at], "eigenvector": vectors[at][:, 0]}
    return Finding("M > 0", float(relative[at] <= floor), floor, witness)


def skew_symmetry(model, q, qd) -> Finding:
    """Ṁ − 2C is skew-symmetric: zᵀ(Ṁ − 2C)z = 0 for every z, not for z = q̇ alone.

    The violation is max |N + Nᵀ| / (max(|Ṁ|, |C|) + |M| |q̇|), with N = Ṁ − 2C and Ṁ by differences
    of M along q̇, so that C is not judged by itself; the witness holds N + Nᵀ. q (rad), qd (rad/s):
    (..., n).
    """
    q, qd = _states(model, q=q, qd=qd)
    C = model.C(q, qd)
    M_dot = _rate_of(model.M, q, qd)
    N = M_dot - 2 * C
    sum_ = N + np.swapaxes(N, -1, -2)
    scale = np.maximum(_largest(M_dot), _largest(C)) + _largest(model.M(q)) * _largest_entry(qd)
    return _worst(
        "Ṁ − 2C is skew-symmetric",
        _largest(sum_),
        scale,
        DIFFERENCE_FLOOR,
        **{"q": q, "qd": qd, "N + Nᵀ": sum_},
    )


def gravity_gradient(model, q) -> Finding:
    """g = ∂P/∂q, with the gradient by differences of P; the witness holds both.

    The violation is max |g − ∇P| over |g| and the size of P around q. q: (..., n), rad.
    """
    (q,) = _states(model, q=q)
    g_vec = model.g_vec(q)
    gradient = np.stack(
        [_rate_of(model.potential_energy, q, axis) for axis in np.eye(model.n)], axis=-1
    )
    scale = _largest_entry(g_vec) + _potential_size(model, q)
    off = _largest_entry(g_vec - gradient)
    return _worst("g = ∂P/∂q", off, scale, DIFFERENCE_FLOOR, q=q, g=g_vec, gradient=gradient)


def power_balance(model, q, qd, u) -> Finding:
    """dE/dt = q̇ᵀ(u − f) along the motion: what goes in, less friction, is stored.

    The violation is |dE/dt − q̇ᵀ(u − f)| over the sizes of the powers and energies, with dE/dt by
    differences of E along ẋ. q (rad), qd (rad/s), u (N·m): (..., n).
    """
    q, qd, u = _states(model, q=q, qd=qd, u=u)
    qdd = model.dynamics(q, qd, u)
    x, slope = np.concatenate([q, qd], axis=-1), np.concatenate([qd, qdd], axis=-1)
    stored = _rate_of(lambda x: model.energy(x[..., : model.n], x[..., model.n :]), x, slope)
    given = np.vecdot(qd, u - model.f_vec(qd))
    # At rest K is 0, but not where the differences look: what one step along q̈ gives counts too.
    fastest = _largest_entry(slope)[..., np.newaxis]
    step = qdd / np.where(fastest > 0, fastest, 1)
    energies = np.abs(model.kinetic_energy(q, qd)) + np.abs(model.kinetic_energy(q, step))
    energies = energies + _potential_size(model, q)
    scale = np.abs(given) + np.abs(np.vecdot(qd, np.matvec(model.M(q), qdd)))
    scale = scale + energies * _largest_entry(slope)
    return _worst(
        "dE/dt = q̇ᵀ(u − f)", np.abs(stored - given), scale, DIFFERENCE_FLOOR, q=q, qd=qd, u=u
    )


def _states(model, **named) -> list[np.ndarray]:
    arrays = np.broadcast_arrays(*state_vectors(model.n, **named))
    if arrays[0].size == 0:
        raise ValueError(f"{', '.join(named)}: got shape {arrays[0].shape}, needs at least 1 state")
    return arrays


def _potential_size(model, q) -> np.ndarray:
    """|P| and its change over one unit of each coordinate: not 0 at an equilibrium where P = 0."""
    P = model.potential_energy(q)
    changes = sum(np.abs(model.potential_energy(q + axis) - P) for axis in np.eye(model.n))
    return np.abs(P) + changes


def _rate_of(function, x, direction) -> np.ndarray:
    """d/ds function(x + s·direction) at s = 0, by fourth-order central differences."""
    size = _largest_entry(direction)[..., np.newaxis]
    unit = direction / np.where(size > 0, size, 1)
    sample = {k: function(x + k * STEP * unit) for k in (-2, -1, 1, 2)}
    slope = (sample[-2] - 8 * sample[-1] + 8 * sample[1] - sample[2]) / (12 * STEP)
    return slope * size.reshape(size.shape[:-1] + (1,) * (slope.ndim - size.ndim + 1))


def _largest(matrices) -> np.ndarray:
    return np.max(np.abs(matrices), axis=(-2, -1))


def _largest_entry(vectors) -> np.ndarray:
    return np.max(np.abs(vectors), axis=-1)


def _worst(claim, violation, scale, floor, **states) -> Finding:
    relative = np.asarray(violation / np.where(scale > 0, scale, 1))
    at = np.unravel_index(np.argmax(relative), relative.shape)
    return Finding(claim, float(relative[at]), floor, {name: a[at] for name, a in states.items()})
