"""A derivation as code: fast callables for Python, and readable source for other languages."""

import warnings
from collections.abc import Mapping

from armdyn.codegen.build import NoCompilerError
from armdyn.codegen.compiled import CompiledModel, c_model
from armdyn.codegen.numpy_code import NumpyModel, numpy_model
from armdyn.derive import Derivation

__all__ = [
    "CompiledModel",
    "NoCompilerError",
    "NumpyModel",
    "c_model",
    "fastest_model",
    "numpy_model",
]


def fastest_model(derivation: Derivation, values: Mapping[str, float]) -> NumpyModel:
    """`c_model`, or `numpy_model` with a RuntimeWarning that says why where no C compiler works.

    Raises ValueError as both do.
    """
    try:
        return c_model(derivation, values)
    except NoCompilerError as error:
        warnings.warn(f"{error} Using NumPy.", RuntimeWarning, stacklevel=2)
        return numpy_model(derivation, values)
