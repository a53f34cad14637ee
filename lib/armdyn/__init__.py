"""Reference models of robot equations of motion, M(q) q̈ + C(q, q̇) q̇ + g(q) + f(q̇) = u."""

from armdyn.manipulator import Manipulator
from armdyn.models import (
    Link,
    Pendulum,
    Planar2R,
    PlanarChain,
    SerialChain,
    reflected_inertia,
)

__all__ = [
    "Link",
    "Manipulator",
    "Pendulum",
    "Planar2R",
    "PlanarChain",
    "SerialChain",
    "reflected_inertia",
]
