"""Closed-form models, for two joints and for any number."""

from armdyn.models.pendulum import Pendulum
from armdyn.models.planar_2r import Planar2R
from armdyn.models.planar_chain import PlanarChain

__all__ = ["Pendulum", "Planar2R", "PlanarChain"]
