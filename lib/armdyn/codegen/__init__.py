"""A derivation as code: fast callables for Python, and readable source for other languages."""

from armdyn.codegen.numpy_code import NumpyModel, numpy_model

__all__ = ["NumpyModel", "numpy_model"]
