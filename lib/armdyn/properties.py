"""The structural properties of M, C and g, shown in numbers.

Each function takes a model and states of shape (..., n), looks at all of them, and returns a
`Finding`: the largest violation, where it is, and the floor that rounding alone can reach. A
finding is a number with a witness, not a yes or no; `holds` compares the two.

Source of the properties: R. M. Murray, Z. Li, S. S. Sastry (1994), A Mathematical Introduction to
Robotic Manipulation, lemma 4.2.
"""

from dataclasses import dataclass

import numpy as np

EPS = np.finfo(float).eps
# Fourth-order central differences: truncation h⁴ and rounding EPS/h balance at h = EPS^(1/5).
STEP = EPS**0.2
DIFFERENCE_FLOOR = 100 * EPS**0.8


@dataclass(frozen=True)
class Finding:
    """The largest violation of a property over some states.

    violation: relative, without unit. floor: what rounding can leave of it. witness: the state at
    the worst case, and what shows the violation there, by name.
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
    q = np.asarray(q, dtype=float)
    M = model.M(q)
    difference = M - np.swapaxes(M, -1, -2)
    return _worst("M = Mᵀ", _largest(difference), _largest(M), 10 * EPS, q=q)


def positive_definiteness(model, q) -> Finding:
    """All eigenvalues of M are > 0; the witness holds the smallest one (kg·m²) and its eigenvector.

    The violation is 1 where the smallest eigenvalue is not above rounding, n·EPS times the largest,
    and 0 elsewhere. q: (..., n), rad.
    """
    q = np.asarray(q, dtype=float)
    values, vectors = np.linalg.eigh(model.M(q))
    smallest, largest = values[..., 0], values[..., -1]
    at = np.unravel_index(np.argmin(smallest / largest), smallest.shape)
    floor = model.n * EPS
    violation = float(smallest[at] <= floor * largest[at])
    witness = {"q": q[at], "eigenvalue": smallest[at], "eigenvector": vectors[at][:, 0]}
    return Finding("M > 0", violation, floor, witness)


def skew_symmetry(model, q, qd) -> Finding:
    """Ṁ − 2C is skew-symmetric: zᵀ(Ṁ − 2C)z = 0 for every z, not for z = q̇ alone.

    The violation is max |N + Nᵀ| / max(|Ṁ|, |C|), with N = Ṁ − 2C and Ṁ by differences of M along
    q̇, so that C is not judged by itself. q (rad), qd (rad/s): (..., n).
    """
    q, qd = np.broadcast_arrays(np.asarray(q, dtype=float), np.asarray(qd, dtype=float))
    C = model.C(q, qd)
    M_dot = _rate_of(model.M, q, qd)
    N = M_dot - 2 * C
    scale = np.maximum(_largest(M_dot), _largest(C)) + _largest(model.M(q)) * _largest_entry(qd)
    violation = _largest(N + np.swapaxes(N, -1, -2))
    return _worst("Ṁ − 2C is skew-symmetric", violation, scale, DIFFERENCE_FLOOR, q=q, qd=qd)


def gravity_gradient(model, q) -> Finding:
    """g = ∂P/∂q; the violation is max |g − ∇P| / (|g| + |P|). q: (..., n), rad."""
    q = np.asarray(q, dtype=float)
    g_vec = model.g_vec(q)
    gradient = np.stack(
        [_rate_of(model.potential_energy, q, np.eye(model.n)[i]) for i in range(model.n)], axis=-1
    )
    scale = _largest_entry(g_vec) + np.abs(model.potential_energy(q))
    return _worst("g = ∂P/∂q", _largest_entry(g_vec - gradient), scale, DIFFERENCE_FLOOR, q=q)


def power_balance(model, q, qd, u) -> Finding:
    """dE/dt = q̇ᵀ(u − f) along the motion: what goes in, less friction, is stored.

    The violation is |dE/dt − q̇ᵀ(u − f)| over the sum of the powers' sizes, with dE/dt by
    differences of E along ẋ. q (rad), qd (rad/s), u (N·m): (..., n).
    """
    arrays = (np.asarray(a, dtype=float) for a in (q, qd, u))
    q, qd, u = np.broadcast_arrays(*arrays)
    qdd = model.dynamics(q, qd, u)
    x, slope = np.concatenate([q, qd], axis=-1), np.concatenate([qd, qdd], axis=-1)
    stored = _rate_of(lambda x: model.energy(x[..., : model.n], x[..., model.n :]), x, slope)
    given = np.vecdot(qd, u - model.f_vec(qd))
    scale = np.abs(given) + np.abs(np.vecdot(qd, np.matvec(model.M(q), qdd)))
    scale = scale + np.abs(model.energy(q, qd)) * _largest_entry(slope)
    return _worst(
        "dE/dt = q̇ᵀ(u − f)", np.abs(stored - given), scale, DIFFERENCE_FLOOR, q=q, qd=qd, u=u
    )


def _rate_of(function, x, direction) -> np.ndarray:
    """d/ds function(x + s·direction) at s = 0, by fourth-order central differences."""
    size = np.maximum(_largest_entry(direction), np.finfo(float).tiny)[..., np.newaxis]
    unit = direction / size
    sample = {k: function(x + k * STEP * unit) for k in (-2, -1, 1, 2)}
    slope = (sample[-2] - 8 * sample[-1] + 8 * sample[1] - sample[2]) / (12 * STEP)
    return slope * size.reshape(size.shape[:-1] + (1,) * (slope.ndim - size.ndim + 1))


def _largest(matrices) -> np.ndarray:
    return np.max(np.abs(matrices), axis=(-2, -1))


def _largest_entry(vectors) -> np.ndarray:
    return np.max(np.abs(vectors), axis=-1)


def _worst(claim, violation, scale, floor, **states) -> Finding:
    relative = violation / np.where(scale > 0, scale, 1)
    at = np.unravel_index(np.argmax(relative), relative.shape)
    return Finding(claim, float(relative[at]), floor, {name: a[at] for name, a in states.items()})
