"""`run` and `simulate` build a model's program, if it is not kept from before, and ask it."""

import dataclasses
import reprlib
from collections.abc import Mapping, Sequence
from functools import lru_cache
from pathlib import Path

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike

from armdyn.codegen.build import cache_folder
from armdyn.derive import Derivation, planar_chain
from armdyn.derive.derivation import derivation_given
from armdyn.models import Planar2R
from armdyn.models.planar_2r import as_written
from armdyn.parameters import finite, state_vector
from armdyn.ports import cpp, java, matlab, wolfram
from armdyn.ports.program import Program, Terms
from armdyn.ports.toolchain import Conversation, build
from armdyn.ports.toolchain import missing as missing_tool

_MODULES = {"cpp": cpp, "java": java, "matlab": matlab, "wolfram": wolfram}
LANGUAGES = tuple(_MODULES)


def missing(language: str) -> str | None:
    """What the language needs and this computer lacks, in one line; None if nothing is missing."""
    return missing_tool(_module(language).toolchain)


def built(language: str, derivation: Derivation | None = None) -> Path:
    """The folder with the sources of the program that `start` starts, and what was made of them.

    Built now or kept from before; what the compiler said is in compiler.txt. Raises as `start`.
    """
    module = _module(language)
    if derivation is not None:
        derivation_given("derivation", derivation)
    toolchain = module.toolchain()
    return build(_files(language, derivation), toolchain.compile, cache_folder() / "ports")


def start(language: str, derivation: Derivation | None = None, *, seconds: float = 60) -> Program:
    """The program of the arm written by hand, or of what codegen writes for a derivation, started.

    seconds: the time limit of each answer. By hand the parameters are those of Planar2R in its
    order, `viscous` and `coulomb` as two numbers each; else derivation.parameters.
    Raises ValueError for an unknown language, MissingToolError, and BuildError with the compiler's
    own message.
    """
    folder = built(language, derivation)
    toolchain = _module(language).toolchain()
    n, count = (2, 13) if derivation is None else (derivation.n, len(derivation.parameters))
    return Program(Conversation(toolchain.started_in(folder), seconds=seconds), n, count)


def run(
    language: str,
    model,
    states: ArrayLike,
    u: ArrayLike | None = None,
    *,
    values=None,
    generated: bool = False,
    seconds: float = 60,
) -> Terms:
    """The terms of the equation of motion at the states, computed in another language.

    model: a Planar2R; a sequence of them, one for each row of states (k, 2n); or a Derivation,
    whose parameters `values` gives as a mapping of names to numbers, or a sequence of those.
    states: (..., 2n), [q; q̇]. u: (..., n), zero if None. generated: what codegen writes for the
    arm instead of what is written by hand, as it always is for a Derivation.
    Raises ValueError, MissingToolError, BuildError and ProgramError, as `start` and
    `Program.terms`, and where u or values do not fit the model.
    """
    derivation, parameters = _model(model, values, generated)
    with start(language, derivation, seconds=seconds) as program:
        return program.terms(parameters, states, u)


def simulate(
    language: str,
    model,
    x0: ArrayLike,
    u: ArrayLike,
    t: ArrayLike,
    *,
    values=None,
    generated: bool = False,
    substeps: int = 1,
    seconds: float = 60,
) -> np.ndarray:
    """States (len(t), 2n) of one model by RK4 in another language, from x0 (2n,), u (n,) held.

    t: (T,), evenly spaced, s, `substeps` steps from each to the next. All else as `run`.
    """
    derivation, parameters = _model(model, values, generated)
    with start(language, derivation, seconds=seconds) as program:
        return program.simulate(parameters, x0, u, t, substeps=substeps)


def by_hand() -> Derivation:
    """What the arm written by hand says, in symbols: planar_chain(2) with friction."""
    coefficients = (sp.symbols(f"{name}1:3", real=True) for name in ("viscous", "coulomb"))
    return planar_chain(2).with_friction(*coefficients)


def _module(language):
    if language not in _MODULES:
        raise ValueError(f"language = {language!r}: needs one of {', '.join(_MODULES)}")
    return _MODULES[language]


@lru_cache(maxsize=32)  # to write a long chain takes seconds
def _files(language, derivation):
    module = _MODULES[language]
    return module.hand_written() if derivation is None else module.generated(derivation)


def _model(model, values, generated):
    """(derivation or None for the arm by hand, parameters (..., p))."""
    if isinstance(model, Derivation):
        return model, _listed(values, Mapping, "values", lambda v: _in_order(model, v))
    if values is not None:
        raise ValueError("values: only a Derivation takes them; an arm has its own")
    parameters = _listed(model, Planar2R, "model", _flat)
    if not generated:
        return None, parameters
    frictionless = planar_chain(2)
    inertial, friction = np.split(parameters, [len(frictionless.parameters)], axis=-1)
    return (by_hand(), parameters) if friction.any() else (frictionless, inertial)


def _listed(given, kind, name, numbers):
    if isinstance(given, kind):
        return numbers(given)
    if isinstance(given, Sequence) and given and all(isinstance(g, kind) for g in given):
        return np.array([numbers(g) for g in given])
    wanted = {
        "model": "a Planar2R, a sequence of them, or a Derivation (of a SerialChain, "
        "chain.derivation())"
    }
    raise ValueError(
        f"{name} = {reprlib.repr(given)}: needs "
        f"{wanted.get(name, 'a mapping of names to numbers, or several')}"
    )


def _flat(arm):
    if not as_written(arm):
        raise ValueError(
            f"model = {arm}: has another M, C, g or f than Planar2R, which the program has; needs a "
            "Planar2R, or a Derivation"
        )
    return np.hstack([getattr(arm, field.name) for field in dataclasses.fields(Planar2R)])


def _in_order(derivation, values):
    names = [symbol.name for symbol in derivation.parameters]
    if set(values) != set(names):
        raise ValueError(
            f"values: got {', '.join(map(str, values)) or 'none'}; needs {', '.join(names) or 'none'}"
        )
    return state_vector(
        "values",
        [finite(f"values[{n!r}]", values[n], "the model's units") for n in names],
        len(names),
    )
