"""Reference models of robot equations of motion, M(q) q̈ + C(q, q̇) q̇ + g(q) + f(q̇) = u."""

from armdyn.manipulator import Manipulator
from armdyn.models import Pendulum, Planar2R, PlanarChain

__all__ = ["Manipulator", "Pendulum", "Planar2R", "PlanarChain"]
