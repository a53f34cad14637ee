"""What Python says of a name that it does not know."""

import ast
import sys
from types import SimpleNamespace

import numpy as np

from .of_names import SAME_IN_SYMPY
from .row import Row, Words
from .scene import Scene

# Of NumPy, what students take to be there without a prefix.
OF_NUMPY = {
    "cos", "sin", "tan", "sqrt", "exp", "log", "pi", "array", "zeros", "eye", "arctan2", "sign", "dot",
    "concatenate", "linalg", "arange", "linspace", "diag", "outer", "cross", "transpose", "inv",
    "rad2deg", "deg2rad", "radians", "degrees",
}  # fmt: skip
# Packages that a notebook of the course may use, beside those that come with Python.
PACKAGES = {"numpy", "scipy", "sympy", "matplotlib"}
SHORT = {"np": "numpy", "sp": "sympy", "plt": "matplotlib.pyplot"}


def _of_argument(scene: Scene, found, error) -> Words | None:
    """A parameter of a robot that was written without the robot."""
    name = str(error.name)
    owner = next((o for o, value in scene.local_names() if _keeps(value, name)), None)
    return (name, f"{owner}.{name}") if owner else None


def _keeps(value, name: str) -> bool:
    return type(value) is SimpleNamespace and name in vars(value)


def _of_numpy(scene: Scene, found, error) -> Words | None:
    name = str(error.name)
    if name not in OF_NUMPY or not hasattr(np, name):
        return None
    both = name in SAME_IN_SYMPY or name == "pi"
    return name, f" for numbers, sp.{name} for symbols" if both else ""


def _of_module(scene: Scene, found, error) -> Words | None:
    """A module that nobody imported: something of it was asked for."""
    name, tree = str(error.name), scene.tree
    wanted = {
        node.value.id
        for node in ast.walk(tree or ast.Module([], []))
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name)
    }
    if name not in wanted:
        return None
    if name in SHORT:
        return (f"import {SHORT[name]} as {name}",)
    return (f"import {name}",) if name in PACKAGES | sys.stdlib_module_names else None


ROWS = (
    Row(
        "number of an argument",
        ("NameError",),
        r"is not defined",
        "{0} alone is no name here: write {1}.",
        _of_argument,
    ),
    Row(
        "numpy name",
        ("NameError",),
        r"is not defined",
        "{0} needs a prefix: np.{0}{1}.",
        _of_numpy,
    ),
    Row(
        "not imported",
        ("NameError",),
        r"is not defined",
        "It has to be imported first: {0}.",
        _of_module,
    ),
)
