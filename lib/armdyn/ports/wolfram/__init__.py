"""The files of a model's program in the Wolfram Language, which Mathics3 runs.

Beside this file: `planar_2r.wl`, the arm derived from the positions of its centres of mass; and
`driver.wl` with `model.wl`, which speak for it, in Mathics3 through `driver.py`. The .wl files run
in Mathematica as they do in Mathics3. `session` gives what is derived, read by SymPy.
"""

import importlib.util
import sys
from pathlib import Path

from armdyn.codegen.naming import identifiers
from armdyn.codegen.wolfram import RESERVED, wolfram
from armdyn.derive import Derivation
from armdyn.ports.toolchain import IN_BROWSER, MissingToolError, Toolchain

_DRIVER = ("driver.py", "driver.wl")
_MODEL = """(* What the driver needs of the generated arm.wl. *)

Get["arm.wl"];

model`parameters = {{{parameters}}};
model`q = {{{q}}};
model`qd = {{{qd}}};
model`u = {{{u}}};
model`terms := {{
  armM[model`q], armC[model`q, model`qd], armGVec[model`q], armFVec[model`qd],
  armPotentialEnergy[model`q]}};
model`dynamics := armDynamics[model`q, model`qd, model`u];

SetAttributes[model`filledIn, HoldFirst];
model`filledIn[expression_] := expression;
"""


def toolchain() -> Toolchain:
    """driver.py, run by this Python. Raises MissingToolError."""
    for package in ("mathics", "packaging"):
        if importlib.util.find_spec(package) is None:
            if sys.platform == "emscripten":
                raise MissingToolError(f"Mathics3 was not found. {IN_BROWSER}")
            raise MissingToolError(
                f"Mathics3 was not found (the Python package {package}). Debian or Ubuntu, macOS, "
                "Windows: pip install Mathics3 packaging."
            )
    return Toolchain((), (sys.executable, "{folder}/driver.py"))


def hand_written() -> dict[str, str]:
    """The arm of planar_2r.wl, with the driver."""
    return _files("planar_2r.wl", "model.wl", *_DRIVER)


def generated(derivation: Derivation) -> dict[str, str]:
    """What codegen writes for the derivation, with the driver; ValueError as `codegen.wolfram`."""
    arm = wolfram(derivation)
    names = named(derivation)
    model = _MODEL.format(
        parameters=_listed(names[s] for s in derivation.parameters),
        q=_listed(names[s] for s in derivation.q),
        qd=_listed(names[s] for s in derivation.qd),
        u=_listed(f"model`u{i + 1}" for i in range(derivation.n)),
    )
    return _files(*_DRIVER) | {"arm.wl": arm, "model.wl": model}


def named(derivation: Derivation) -> dict:
    """For each symbol of the derivation the one that generated source has in its place.

    Some names are taken in the language, and marked; none has an underscore.
    """
    symbols = (*derivation.q, *derivation.qd, *derivation.parameters)
    return identifiers(symbols, {*RESERVED, "arm"}, mark="Sym", underscores=False)


def _listed(names):
    return ", ".join(map(str, names))


def _files(*names):
    return {name: Path(__file__).with_name(name).read_text(encoding="utf-8") for name in names}
