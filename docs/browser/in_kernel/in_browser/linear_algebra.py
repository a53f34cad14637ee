"""Lets `numpy.linalg` raise LinAlgError in a browser.

NumPy hears of a singular matrix by the processor's flag for an invalid operation, and WebAssembly has no
such flag. There the functions return NaN for a finite matrix, and that is how it is seen here.
"""

from functools import wraps

import numpy as np

SAID = {
    "cholesky": "Matrix is not positive definite",
    "eig": "Eigenvalues did not converge",
    "eigh": "Eigenvalues did not converge",
    "eigvals": "Eigenvalues did not converge",
    "eigvalsh": "Eigenvalues did not converge",
    "inv": "Singular matrix",
    "lstsq": "SVD did not converge in Linear Least Squares",
    "solve": "Singular matrix",
    "svd": "SVD did not converge",
}


def mend() -> None:
    """Wrap the functions of `numpy.linalg`, also for those of its own that call them."""
    from numpy.linalg import _linalg

    for name, said in SAID.items():
        wrapped = _raising(getattr(np.linalg, name), said)
        setattr(np.linalg, name, wrapped)
        setattr(_linalg, name, wrapped)


def _raising(function, said: str):
    @wraps(function)
    def mended(*args, **kwargs):
        result = function(*args, **kwargs)
        numbers = [value for value in (*args, *kwargs.values()) if isinstance(value, _ARRAYS)]
        if _has_nan(result) and not any(map(_is_not_finite, numbers)):
            raise np.linalg.LinAlgError(said)
        return result

    return mended


_ARRAYS = (np.ndarray, list, tuple)


def _has_nan(result) -> bool:
    if isinstance(result, tuple):
        return any(map(_has_nan, result))
    return bool(np.isnan(result).any()) if np.asarray(result).dtype.kind in "fc" else False


def _is_not_finite(value) -> bool:
    array = np.asarray(value)
    return not np.isfinite(array).all() if array.dtype.kind in "fc" else False
