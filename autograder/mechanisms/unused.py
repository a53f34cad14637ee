"""Each parameter of a mechanism stands somewhere: in an energy, in the friction, or in what is drawn."""

from types import SimpleNamespace

import numpy as np
import sympy as sp

from autograder.mechanisms.mechanism import Mechanism


class _Watched(SimpleNamespace):
    """Parameters' numbers, and of which of them somebody asks."""

    def __getattribute__(self, name: str):
        if name == "__dict__":
            return super().__getattribute__(name)
        value = super().__getattribute__(name)
        if not name.startswith("_"):
            super().__getattribute__("__dict__")["_asked"].add(name)
        return value


def refuse_unused(mechanism: Mechanism) -> None:
    """ValueError, naming a parameter that is in no energy, in no friction, and in nothing drawn."""
    terms = [term.energy for term in (*mechanism.kinetic, *mechanism.potential)]
    terms += [term.torque for term in mechanism.friction]
    held = {s.name for term in terms for s in sp.sympify(term).free_symbols}
    rng = np.random.default_rng(0)
    arm = _Watched(**vars(mechanism.drawn(rng)), _asked=set())
    mechanism.points(mechanism.placed(rng), arm)
    mechanism.shapes(mechanism.placed(rng), arm)
    held |= arm._asked
    for parameter in mechanism.parameters:
        if parameter.name not in held:
            raise ValueError(
                f"mechanism {mechanism.name!r}: the parameter {parameter.name!r} is in no energy, in no "
                "friction and in no place that is drawn; write where it acts, or take it out"
            )
