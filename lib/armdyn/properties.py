"""Shows the structural properties of M, C and g in numbers.

Each function takes a model and states of shape (..., n), looks at all of them, and returns a
`Finding`: the largest violation, where it is, and the floor that rounding alone can reach. A
finding is a number with a witness, not a yes or no; `holds` compares the violation with the floor.

All raise ValueError if the states have the wrong shape or are not finite, or if there are none.

Source of the first three: R. M. Murray, Z. Li, S. S. Sastry (1994), A Mathematical Introduction to
Robotic Manipulation, lemma 4.2.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from armdyn.manipulator import ROUNDING, Manipulator, model_given
from armdyn.parameters import state_vectors

EPS = np.finfo(float).eps
# Fourth-order central differences: truncation h⁴ and rounding EPS/h balance at h = EPS^(1/5).
STEP = EPS**0.2
DIFFERENCE_FLOOR = 100 * EPS**0.8


@dataclass(frozen=True, eq=False)
class Finding:
    """The largest violation of a property over some states.

    violation: relative, without a unit. floor: how large rounding alone can make it. witness: the
    state of the worst case and, by name, what shows the violation there. If a model returns NaN,
    the violation is NaN and the property does not hold.
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
            f"{name} = {' '.join(np.array2string(np.asarray(value), precision=4).split())}"
            for name, value in self.witness.items()
        )
        return f"{self.claim}: {verdict}; {self.violation:.1e} against {self.floor:.1e}, at {where}"


@dataclass(frozen=True, eq=False)
class CoriolisFinding(Finding):
    """Whether C is the Christoffel choice; a second finding says whether at least C q̇ is right.

    Many C give the same C q̇, and so the same motion; one of them is Σ_k h_ijk q̇_k.
    """

    torque: Finding

    @property
    def kind(self) -> str:
        """One of "Christoffel", "merely valid" (C q̇ is right) and "neither"."""
        if self.holds:
            return "Christoffel"
        return "merely valid" if self.torque.holds else "neither"

    def __str__(self):
        return f"{super().__str__()}\n{self.torque}"


def symmetry(model: Manipulator, q: ArrayLike) -> Finding:
    """M = Mᵀ; the violation is max |M − Mᵀ| / max |M|. q: (..., n), rad."""
    (q,) = _states(model, q=q)
    M = model.M(q)
    difference = M - np.swapaxes(M, -1, -2)
    return _worst("M = Mᵀ", _largest(difference), _largest(M), 10 * EPS, q=q)


def positive_definiteness(model: Manipulator, q: ArrayLike) -> Finding:
    """All eigenvalues of M are > 0; the witness holds the smallest one (kg·m²) and its eigenvector.

    The violation is 1 if the smallest eigenvalue is not above rounding, n·1.8e-15 times the
    largest, and 0 otherwise. If M is not symmetric, its symmetric part is judged, since only that
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


def skew_symmetry(model: Manipulator, q: ArrayLike, qd: ArrayLike) -> Finding:
    """Ṁ − 2C is skew-symmetric: zᵀ(Ṁ − 2C)z = 0 for every z, not for z = q̇ alone.

    The violation is max |N + Nᵀ| / (max(|Ṁ|, |C|) + |M| |q̇|), with N = Ṁ − 2C and Ṁ by differences
    of M along q̇, so that C is not judged by itself; the witness holds N + Nᵀ. q (rad), qd (rad/s):
    (..., n).
    """
    q, qd = _states(model, q=q, qd=qd)
    C, M_dot, scale = _rates(model, q, qd)
    N = M_dot - 2 * C
    sum_ = N + np.swapaxes(N, -1, -2)
    shown = {"q": q, "qd": qd, "N + Nᵀ": sum_}
    return _worst("Ṁ − 2C is skew-symmetric", _largest(sum_), scale, DIFFERENCE_FLOOR, **shown)


def inertia_rate(model: Manipulator, q: ArrayLike, qd: ArrayLike) -> Finding:
    """Ṁ = C + Cᵀ: the same as skew-symmetry, as long as M is symmetric.

    The violation is max |Ṁ − C − Cᵀ| over the scale of `skew_symmetry`, with Ṁ by differences of M;
    the witness holds both sides. q (rad), qd (rad/s): (..., n).
    """
    q, qd = _states(model, q=q, qd=qd)
    C, M_dot, scale = _rates(model, q, qd)
    sum_ = C + np.swapaxes(C, -1, -2)
    shown = {"q": q, "qd": qd, "Ṁ": M_dot, "C + Cᵀ": sum_}
    return _worst("Ṁ = C + Cᵀ", _largest(M_dot - sum_), scale, DIFFERENCE_FLOOR, **shown)


def christoffel_form(model: Manipulator, q: ArrayLike, qd: ArrayLike) -> CoriolisFinding:
    """C_ij = Σ_k h_ijk q̇_k with h_ijk = ½ (∂M_ij/∂q_k + ∂M_ik/∂q_j − ∂M_jk/∂q_i), or merely valid.

    The derivatives are differences of M, so that C is judged by M alone. The violation is
    max |C − Σ h q̇| over the scale of `skew_symmetry`; that of `torque` is |C q̇ − (Σ h q̇) q̇| over that
    scale times |q̇|; the witnesses hold both sides. q (rad), qd (rad/s): (..., n).
    """
    q, qd = _states(model, q=q, qd=qd)
    C, _, scale = _rates(model, q, qd)
    # slopes[..., k, i, j] = ∂M_ij/∂q_k
    slopes = np.stack([_rate_of(model.M, q, axis) for axis in np.eye(model.n)], axis=-3)
    h = np.einsum("...kij->...ijk", slopes) + np.einsum("...jik->...ijk", slopes)
    h = (h - slopes) / 2  # slopes[..., i, j, k] = ∂M_jk/∂q_i
    expected = np.einsum("...ijk,...k->...ij", h, qd)
    torque, expected_torque = np.matvec(C, qd), np.matvec(expected, qd)
    valid = _worst(
        "C q̇ = Σ h q̇ q̇",
        _largest_entry(torque - expected_torque),
        scale * _largest_entry(qd),
        DIFFERENCE_FLOOR,
        **{"q": q, "qd": qd, "C q̇": torque, "Σ h q̇ q̇": expected_torque},
    )
    shown = {"q": q, "qd": qd, "C": C, "Σ h q̇": expected}
    finding = _worst("C = Σ h q̇", _largest(C - expected), scale, DIFFERENCE_FLOOR, **shown)
    return CoriolisFinding(**vars(finding), torque=valid)


def gravity_gradient(model: Manipulator, q: ArrayLike) -> Finding:
    """g = ∂P/∂q, with the gradient by differences of P; the witness holds both.

    The violation is max |g − ∇P| over |g| and the size of P around q. q: (..., n), rad.
    """
    (q,) = _states(model, q=q)
    g_vec = model.g_vec(q)
    gradient = np.stack(
        [_rate_of(model.potential_energy, q, axis) for axis in np.eye(model.n)], axis=-1
    )
    scale = (_largest_entry(g_vec) + _potential_size(model, q)) * _turns(q)
    off = _largest_entry(g_vec - gradient)
    return _worst("g = ∂P/∂q", off, scale, DIFFERENCE_FLOOR, q=q, g=g_vec, gradient=gradient)


def power_balance(model: Manipulator, q: ArrayLike, qd: ArrayLike, u: ArrayLike) -> Finding:
    """dE/dt = q̇ᵀ(u − f) along the motion: the arm stores what goes in, less what friction takes.

    The violation is |dE/dt − q̇ᵀ(u − f)| over the sizes of the powers and energies, with dE/dt by
    differences of E along ẋ. q (rad), qd (rad/s), u (N·m): (..., n).
    """
    q, qd, u = _states(model, q=q, qd=qd, u=u)
    qdd = model.dynamics(q, qd, u)
    x, slope = np.concatenate([q, qd], axis=-1), np.concatenate([qd, qdd], axis=-1)

    def energy(x):
        return model.energy(x[..., : model.n], x[..., model.n :])

    stored = _rate_of(energy, x, slope)
    given = np.vecdot(qd, u - model.f_vec(qd))
    M = model.M(q)
    inertia, speed = _largest(M), _largest_entry(qd)
    # Where q̇ carries little energy for its size, K is a small sum of large terms, each rounded; at
    # rest there still are the speeds of the difference's own steps. The solution for q̈ leaves a
    # residual of the size of M q̈.
    terms = inertia * (speed + 4 * STEP) ** 2 / 30 + _terms_of(energy, x, slope)
    residual = model.n * ROUNDING / DIFFERENCE_FLOOR * inertia * speed * _largest_entry(qdd)
    energies = np.abs(model.kinetic_energy(q, qd)) + terms + _potential_size(model, q)
    scale = np.abs(given) + np.abs(np.vecdot(qd, np.matvec(M, qdd))) + residual
    scale = (scale + energies * _largest_entry(slope)) * _turns(q)
    return _worst(
        "dE/dt = q̇ᵀ(u − f)", np.abs(stored - given), scale, DIFFERENCE_FLOOR, q=q, qd=qd, u=u
    )


def _states(model, **named) -> tuple[np.ndarray, ...]:
    arrays = np.broadcast_arrays(*state_vectors(model_given("model", model).n, **named))
    if arrays[0].size == 0:
        raise ValueError(f"{', '.join(named)}: got shape {arrays[0].shape}, needs at least 1 state")
    return arrays


def _rates(model, q, qd) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """C, Ṁ by differences, and the size by which rounding and truncation of both are measured."""
    C, M_dot = model.C(q, qd), _rate_of(model.M, q, qd)
    scale = np.maximum(_largest(M_dot), _largest(C)) + _largest(model.M(q)) * _largest_entry(qd)
    return C, M_dot, scale * _turns(q)


def _turns(q) -> np.ndarray:
    """How much the rounding of q itself, which grows with q, adds to that of a difference."""
    return 1 + _largest_entry(q) / 10


def _potential_size(model, q) -> np.ndarray:
    """|P|, its change over one unit of each coordinate, and the terms that may cancel in it.

    The change is not 0 at an equilibrium where P = 0. For an arm balanced by counterweights, P and
    ∂P/∂q are nothing but rounding, and only the size of the terms that cancel shows that g is
    right.
    """
    P, axes = model.potential_energy, np.eye(model.n)
    changes = sum(np.abs(P(q + axis) - P(q)) for axis in axes)
    # Rounding may happen to be small at one place or in one direction, so look at several.
    terms = sum(_terms_of(P, q + k, axes[k % model.n]) for k in range(max(6, model.n)))
    return np.abs(P(q)) + changes + terms


def _terms_of(function, x, direction) -> np.ndarray:
    """The size of the terms whose sum the function is, from how its values are rounded.

    Sixth differences over the steps of `_rate_of` leave nothing else of a smooth function.
    """
    unit, _ = _unit(direction)
    # One more step ahead than behind: a value that is odd about x has no even difference there.
    samples = np.stack([function(x + k * STEP * unit) for k in range(-3, 5)])
    return np.max(np.abs(np.diff(samples, n=6, axis=0)), axis=0) / (10 * EPS)


def _rate_of(function, x, direction) -> np.ndarray:
    """d/ds function(x + s·direction) at s = 0, by fourth-order central differences."""
    unit, size = _unit(direction)
    sample = {k: function(x + k * STEP * unit) for k in (-2, -1, 1, 2)}
    slope = (sample[-2] - 8 * sample[-1] + 8 * sample[1] - sample[2]) / (12 * STEP)
    return slope * size.reshape(size.shape[:-1] + (1,) * (slope.ndim - size.ndim + 1))


def _unit(direction) -> tuple[np.ndarray, np.ndarray]:
    """The direction with a largest entry of 1, and that entry, (..., 1)."""
    size = _largest_entry(direction)[..., np.newaxis]
    return direction / np.where(size > 0, size, 1), size


def _largest(matrices) -> np.ndarray:
    return np.max(np.abs(matrices), axis=(-2, -1))


def _largest_entry(vectors) -> np.ndarray:
    return np.max(np.abs(vectors), axis=-1)


def _worst(claim, violation, scale, floor, **states) -> Finding:
    relative = np.asarray(violation / np.where(scale > 0, scale, 1))
    at = np.unravel_index(np.argmax(relative), relative.shape)
    return Finding(claim, float(relative[at]), floor, {name: a[at] for name, a in states.items()})
