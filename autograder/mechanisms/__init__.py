"""The mechanisms that problems are made of, by their names in `MECHANISMS`.

SymPy is imported with the first of them, or with a class that holds formulas; what is kept of a
mechanism is read without it.
"""

from importlib import import_module
from typing import TYPE_CHECKING

from autograder.mechanisms.outline import Coordinate, Parameter

if TYPE_CHECKING:
    from autograder.mechanisms.built_in import MECHANISMS
    from autograder.mechanisms.friction import FrictionTerm, joint_friction
    from autograder.mechanisms.mechanism import EnergyTerm, Mechanism

__all__ = [
    "MECHANISMS",
    "Coordinate",
    "EnergyTerm",
    "FrictionTerm",
    "Mechanism",
    "Parameter",
    "joint_friction",
]


_MODULES = {
    "MECHANISMS": "built_in",
    "EnergyTerm": "mechanism",
    "FrictionTerm": "friction",
    "Mechanism": "mechanism",
    "joint_friction": "friction",
}


def __getattr__(name: str):
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_MODULES[name]}"), name)
