"""Writes code for a derivation: fast callables for Python, and readable source in other languages."""

import warnings
from collections.abc import Mapping

from armdyn.codegen.build import NoCompilerError
from armdyn.codegen.compiled import CompiledModel, c_model
from armdyn.codegen.cpp import cpp
from armdyn.codegen.java import java
from armdyn.codegen.matlab import matlab
from armdyn.codegen.numpy_code import NumpyModel, numpy_model
from armdyn.codegen.wolfram import wolfram
from armdyn.derive import Derivation

__all__ = [
    "CompiledModel",
    "NoCompilerError",
    "NumpyModel",
    "c_model",
    "cpp",
    "fastest_model",
    "java",
    "matlab",
    "numpy_model",
    "wolfram",
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
