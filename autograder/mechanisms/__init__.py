"""The mechanisms that problems are made of, by their names in `MECHANISMS`.

SymPy is imported with the first of them, or with the class; a check that is kept needs neither.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from autograder.mechanisms.built_in import MECHANISMS
    from autograder.mechanisms.mechanism import Coordinate, EnergyTerm, Mechanism, Parameter

__all__ = ["MECHANISMS", "Coordinate", "EnergyTerm", "Mechanism", "Parameter"]


def __getattr__(name: str):
    if name == "MECHANISMS":
        from autograder.mechanisms import built_in

        return built_in.MECHANISMS
    if name in __all__:
        from autograder.mechanisms import mechanism

        return getattr(mechanism, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
