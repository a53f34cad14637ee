"""The files of a model's program in MATLAB, which GNU Octave runs.

Beside this file: the package `+planar_2r`, the arm by hand, one function per file; `demo_2r.m`, which
shows it; and `driver.m` with `model.m`, `terms.m` and `simulation.m`, which speak for it. All but
the driver run in MATLAB as they do in Octave.
"""

import subprocess
from pathlib import Path

from armdyn.codegen.matlab import RESERVED, matlab
from armdyn.codegen.naming import identifiers
from armdyn.derive import Derivation
from armdyn.ports.toolchain import TOOLCHAINS, ProgramError

toolchain = TOOLCHAINS["matlab"]

FOLDER = Path(__file__).parent
_DRIVER = ("driver.m", "terms.m", "simulation.m")
_MODEL = """function value = model()
%MODEL  What the driver needs of the generated arm: its size, its parameters and its functions.
  value.n = {n};
  value.parameters = {count};
  value.arm = @(p) struct({fields});
  value.M = @Arm.M;
  value.C = @Arm.C;
  value.g_vec = @Arm.g_vec;
  value.f_vec = @Arm.f_vec;
  value.potential_energy = @Arm.potential_energy;
  value.dynamics = @Arm.dynamics;
end
"""


def hand_written() -> dict[str, str]:
    """The arm of the package planar_2r, with the driver."""
    package = (f"+planar_2r/{path.name}" for path in sorted((FOLDER / "+planar_2r").glob("*.m")))
    return _files("model.m", *_DRIVER, *package)


def generated(derivation: Derivation) -> dict[str, str]:
    """What codegen writes for the derivation, with the driver; ValueError as `codegen.matlab`."""
    files = matlab(derivation, "Arm")
    # The names that the generated source reads: some are taken in MATLAB, and marked.
    symbols = (*derivation.q, *derivation.qd, *derivation.parameters)
    named = identifiers(symbols, {*RESERVED, "Arm"})
    fields = [f"'{named[s]}', p({i})" for i, s in enumerate(derivation.parameters, 1)]
    model = _MODEL.format(n=derivation.n, count=len(fields), fields=", ".join(fields))
    return _files(*_DRIVER) | files | {"model.m": model}


def demo(seconds: float = 60) -> str:
    """What demo_2r.m prints in Octave: the terms of an arm, its structure, its free motion.

    Raises MissingToolError, and ProgramError where Octave fails or takes longer than `seconds`.
    """
    command = [*toolchain().start[:-1], "demo_2r.m"]
    try:
        done = subprocess.run(
            command, cwd=FOLDER, capture_output=True, text=True, timeout=seconds, check=False
        )
    except subprocess.TimeoutExpired:
        raise ProgramError(f"demo_2r.m did not end within {seconds:g} s") from None
    if done.returncode:
        raise ProgramError(f"demo_2r.m failed: {done.stderr.strip()}")
    return done.stdout


def _files(*names):
    return {name: (FOLDER / name).read_text(encoding="utf-8") for name in names}
