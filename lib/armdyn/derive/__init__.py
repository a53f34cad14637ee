"""Derives M, C (Christoffel) and g in symbols: from energies, from links, or of a `SerialChain`."""

from armdyn.derive.chain import serial_chain
from armdyn.derive.derivation import Derivation, christoffel_symbols
from armdyn.derive.energies import from_energies, from_lagrangian
from armdyn.derive.links import Link, from_links
from armdyn.derive.mechanisms import elastic_joints, slider_crank
from armdyn.derive.planar import planar_2r, planar_chain

__all__ = [
    "Derivation",
    "Link",
    "christoffel_symbols",
    "elastic_joints",
    "from_energies",
    "from_lagrangian",
    "from_links",
    "planar_2r",
    "planar_chain",
    "serial_chain",
    "slider_crank",
]
