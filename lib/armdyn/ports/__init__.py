"""Runs the planar 2R arm, and what `codegen` writes, in other languages: states in, numbers out.

    from armdyn import Planar2R, ports

    arm = Planar2R(1, 1, 0.5, 0.5, 1, 1, 0.1, 0.1)
    ports.run("java", arm, states).M

A language is a module here that provides

* `toolchain() -> Toolchain`: how its programs are compiled and started; raises MissingToolError.
* `hand_written() -> dict[str, str]`: the files, name → text, of the arm written by hand and of the
  driver that speaks for it.
* `generated(derivation) -> dict[str, str]`: the files of what `codegen` writes for a derivation,
  and the same driver.

The driver reads requests and writes answers as `toolchain.conversation` says. With the p parameters
of the arm (by hand: l1, l2, lc1, lc2, m1, m2, I1, I2, g, the two `viscous` and the two `coulomb`,
p = 13; generated: derivation.parameters) and n joints, all vectors in order, a request is

* 0, then for each of any number of rows: parameters (p), q (n), q̇ (n), u (n). The answer has for
  each row M and C by rows, g, f (n), the potential energy, and q̈ (n): 2n² + 3n + 1 numbers.
* 1, then parameters (p), x0 = [q; q̇] (2n), u (n), dt, steps, stride. The answer has the states
  after 0, stride, 2 stride, … ≤ steps steps of RK4 with u held: 2n numbers each.
"""

from armdyn.ports.calls import LANGUAGES, built, missing, run, simulate, start
from armdyn.ports.program import Program, Terms
from armdyn.ports.toolchain import BuildError, MissingToolError, ProgramError

__all__ = [
    "LANGUAGES",
    "BuildError",
    "MissingToolError",
    "Program",
    "ProgramError",
    "Terms",
    "built",
    "missing",
    "run",
    "simulate",
    "start",
]
