"""Positive definite as a computer can tell it, and random matrices that are, or fail to be in one way.

What is below 1e-9 of the largest number counts as zero. The matrices leave a wide gap on both sides of
that, so that any sensible tolerance judges them alike.
"""

from enum import Enum
from functools import lru_cache

import numpy as np

# What differs by less than this share of a matrix's largest entry, or eigenvalue, is rounding.
ROUNDING = 1e-9


def is_symmetric(A) -> bool:
    return _seen(A.tobytes(), len(A))[0]


def least_eigenvalue(A) -> float:
    """Of the symmetric part of A, as a share of the largest."""
    return _seen(A.tobytes(), len(A))[1]


@lru_cache(maxsize=256)  # each known mistake asks this of the same matrices
def _seen(numbers: bytes, n: int) -> tuple[bool, float]:
    A = np.frombuffer(numbers).reshape(n, n)
    symmetric = np.max(np.abs(A - A.T)) <= ROUNDING * np.max(np.abs(A))
    values = np.linalg.eigvalsh((A + A.T) / 2)
    return bool(symmetric), float(values[0] / np.max(np.abs(values)))


def _definite(rng, n):
    """Symmetric positive definite, the eigenvalues within a factor of 3, one entry negative."""
    while True:
        turn = _reflection(rng, n)
        A = _symmetrised(turn * rng.uniform(0.4, 1.2, n) @ turn.T)
        i, j = np.unravel_index(np.argmax(np.abs(np.triu(A, 1))), A.shape)
        if abs(A[i, j]) > 0.1:
            side = np.ones(n)
            side[i] = -np.sign(A[i, j])  # the same body with this joint's angle counted backwards
            return A * np.outer(side, side)


def _reflection(rng, n):
    """A random orthogonal matrix, (n, n), at a tenth of the cost of a QR decomposition."""
    v = rng.normal(size=n)
    return np.eye(n) - 2 / (v @ v) * np.outer(v, v)


def _symmetrised(A):
    return (A + A.T) / 2


def _diagonal(rng, n):
    return np.diag(rng.uniform(0.5, 1.5, n))


def _saddle(rng, sign):
    """Two joints, one eigenvalue negative, the diagonal positive."""
    A = _diagonal(rng, 2)
    A[0, 1] = A[1, 0] = sign * rng.uniform(1.3, 2) * np.sqrt(A[0, 0] * A[1, 1])
    return A


def _two_negative(rng):
    """Three joints, two eigenvalues negative, the diagonal and the determinant positive."""
    v = rng.uniform(0.9, 1.1, 3) * rng.choice([-1, 1], 3)
    return rng.uniform(6, 9) * np.outer(v, v) / (v @ v) - np.diag(rng.uniform(0.5, 1, 3))


def _negative_diagonal(rng):
    A = _definite(rng, 3)
    A[1, 1] *= -1
    return A


def _massless_joint(rng):
    """The last joint moves nothing."""
    A = np.zeros((3, 3))
    A[:2, :2] = _definite(rng, 2)
    return A


def _nearly_singular(rng, n):
    """The smallest eigenvalue is what rounding leaves of a zero."""
    turn = _reflection(rng, n)
    return _symmetrised(turn * np.array([3e-15, *rng.uniform(0.4, 1, n - 1)]) @ turn.T)


def _beside(rng, upper, lower, n=3):
    """A diagonal, with two entries beside it as shares of the geometric mean of their diagonal ones."""
    A = _diagonal(rng, n)
    mean = np.sqrt(A[0, 0] * A[1, 1])
    A[0, 1], A[1, 0] = upper * mean, lower * mean
    return A


def _slightly_skewed(rng):
    A = _definite(rng, 3)
    A[0, 2] += 0.03 * np.max(A)
    return A


def _rounded(rng, n):
    """Positive definite, and symmetric but for the last digit, as a product JᵀIJ may be."""
    A = _definite(rng, n)
    above = np.triu_indices(n, 1)
    A[above] = np.nextafter(A[above], 2 * A[above])
    return A


class Kind(Enum):
    """What is to be said of a matrix: all but the first and the last are to be refused."""

    DEFINITE = "positive definite"
    INDEFINITE = "indefinite or negative definite"
    NEGATIVE_DIAGONAL = "indefinite, as its diagonal shows"
    SEMIDEFINITE = "semidefinite, exactly or to rounding"
    SKEWED = "not symmetric"
    ROUNDED = "positive definite, and symmetric to rounding"


# Each takes a generator and gives a matrix of the size of 1.
MATRICES = (
    (Kind.DEFINITE, lambda rng: _definite(rng, 2)),
    (Kind.DEFINITE, lambda rng: _definite(rng, 3)),
    (Kind.DEFINITE, lambda rng: _definite(rng, 5)),
    (Kind.INDEFINITE, lambda rng: _saddle(rng, 1)),
    (Kind.INDEFINITE, lambda rng: _saddle(rng, -1)),
    (Kind.INDEFINITE, lambda rng: -_definite(rng, 2)),
    (Kind.INDEFINITE, _two_negative),
    (Kind.NEGATIVE_DIAGONAL, _negative_diagonal),
    (Kind.SEMIDEFINITE, _massless_joint),
    (Kind.SEMIDEFINITE, lambda rng: _nearly_singular(rng, 3)),
    (Kind.SEMIDEFINITE, lambda rng: _nearly_singular(rng, 4)),
    # The lower triangle is that of a definite matrix; then the eigenvalues are positive; then xᵀAx.
    (Kind.SKEWED, lambda rng: _beside(rng, rng.uniform(5, 8), rng.uniform(0.3, 0.6), 2)),
    (Kind.SKEWED, lambda rng: _beside(rng, 0.0, rng.uniform(2.5, 4))),
    (Kind.SKEWED, lambda rng: _beside(rng, -(skew := rng.uniform(1.5, 2.5)), skew, 2)),
    (Kind.SKEWED, _slightly_skewed),
    (Kind.ROUNDED, lambda rng: _rounded(rng, 2)),
    (Kind.ROUNDED, lambda rng: _rounded(rng, 4)),
)
