"""Models of arms: in closed form for two joints, and for chains of any number."""

from armdyn.models.link import Link
from armdyn.models.motor import reflected_inertia
from armdyn.models.pendulum import Pendulum
from armdyn.models.planar_2r import Planar2R
from armdyn.models.planar_chain import PlanarChain
from armdyn.models.serial_chain import SerialChain

__all__ = ["Link", "Pendulum", "Planar2R", "PlanarChain", "SerialChain", "reflected_inertia"]
