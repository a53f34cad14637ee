"""The files of a model's program in C++ with Eigen."""

from pathlib import Path

from armdyn.codegen.cpp import cpp
from armdyn.derive import Derivation
from armdyn.ports.toolchain import TOOLCHAINS

toolchain = TOOLCHAINS["cpp"]

_MODEL = """#pragma once

#include "arm.hpp"

constexpr int parameters = {count};

inline Arm arm_of(const double*{p}) {{ return {{{values}}}; }}
"""


def hand_written() -> dict[str, str]:
    """The arm of planar_2r.hpp, with the driver."""
    return _files("planar_2r.hpp", "model.hpp", "driver.cpp")


def generated(derivation: Derivation) -> dict[str, str]:
    """What codegen writes for the derivation, with the driver; ValueError as `codegen.cpp`."""
    count = len(derivation.parameters)
    values = ", ".join(f"p[{i}]" for i in range(count))
    model = _MODEL.format(count=count, p=" p" if count else "", values=values)
    return _files("driver.cpp") | {"arm.hpp": cpp(derivation), "model.hpp": model}


def _files(*names):
    return {name: Path(__file__).with_name(name).read_text(encoding="utf-8") for name in names}
