"""Closed-form models."""

from armdyn.models.pendulum import Pendulum
from armdyn.models.planar_2r import Planar2R

__all__ = ["Pendulum", "Planar2R"]
